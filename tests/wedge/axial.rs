//! Clutches whose sprags are shaped along the axis, tilted, or not as long as the races.

use sprag_design::WedgeCurve;
use sprag_design::clutch::{Clutch, ContactLaw, EndProfile, StressState};
use sprag_design::contact::{Edge, Peak};
use sprag_design::design::Design;
use sprag_design::wedge::{Along, Lengthwise, Side, along};

const SINGLE: &str = include_str!("../../designs/huang2017-single-arc.toml");
const ROLLER: &str = "law = \"roller\"\nroller_coefficient = 3.944e-5";

fn clutch(contact: &str) -> Clutch {
    let start = SINGLE.find("[contact]").unwrap();
    let end = start + SINGLE[start..].find("\n[limits]").unwrap();
    let text = format!("{}[contact]\n{contact}\n{}", &SINGLE[..start], &SINGLE[end..]);
    Design::parse(&text, "x.toml").unwrap_or_else(|e| panic!("{contact}: {e}")).clutch
}

fn curve(clutch: &Clutch) -> WedgeCurve {
    WedgeCurve::build(clutch, &clutch.profile().unwrap(), 0.0).unwrap()
}

fn windup_deg(contact: &str) -> f64 {
    curve(&clutch(contact)).at_torque(16.8).unwrap().windup_rad.to_degrees()
}

#[test]
fn without_a_law_the_elastic_one_holds() {
    let bare = clutch("");
    assert_eq!(bare.contact, ContactLaw::Elastic { state: StressState::Layer });
    assert!(bare.axial.is_straight() && bare.axial.slices == 60);
    assert_eq!(clutch(ROLLER).contact, ContactLaw::Roller { coefficient: 3.944e-5 });
}

#[test]
fn a_shape_softens_the_laws_that_know_it_and_only_those() {
    let shape = "end_profile = { kind = \"crown\", radius_mm = 1000.0 }";
    let tilt = "tilt_mrad = 1.0";
    for law in ["law = \"elastic\"", "law = \"hertz\"", &ROLLER.replace("roller\"", "slice\"")] {
        let [straight, crowned, tilted, both] =
            ["", shape, tilt, &format!("{shape}\n{tilt}")].map(|more| windup_deg(&format!("{law}\n{more}")));
        println!("{law}: {straight:.4} crown {crowned:.4} tilt {tilted:.4} both {both:.4} deg");
        assert!(crowned > 1.005 * straight && tilted > 1.005 * straight && both > crowned);
        // Tilt either way is the same clutch seen from the other end.
        let other = windup_deg(&format!("{law}\ntilt_mrad = -1.0"));
        assert!((other / tilted - 1.0).abs() < 1e-9, "{other} {tilted}");
    }
    for law in [ROLLER, "law = \"din26281\""] {
        assert!(!clutch(law).contact.facts().knows_shape);
        assert_eq!(windup_deg(&format!("{law}\n{shape}\n{tilt}")), windup_deg(law));
    }
}

/// The tabulated windup is the integral of the exact equilibrium's, whatever the shape, although the factor's levelling
/// out far below any load costs the tables some digits.
#[test]
fn shaped_contacts_keep_their_windup() {
    for more in
        ["tilt_mrad = 2.0", "end_profile = { kind = \"lundberg\", design_load_n = 2441.0 }\ntilt_mrad = 0.3"]
    {
        let curve = curve(&clutch(&format!("law = \"elastic\"\n{more}")));
        let statics = curve.statics();
        // Midpoint rule in u = N^0.1, where the integrand is smooth: dW = W_N 10 u^9 du.
        let until = curve.at_torque(16.8).unwrap();
        let steps = 20_000;
        let h = until.normal_inner_n.powf(0.1) / f64::from(steps);
        let sum: f64 = (0..steps)
            .map(|i| {
                let u = h * (f64::from(i) + 0.5);
                let closure = statics.closure(0, u.powi(10), 0.0, 0.0).unwrap();
                closure.windup_slope() * 10.0 * u.powi(9) * h
            })
            .sum();
        let off = until.windup_rad / sum - 1.0;
        println!("{more}: windup off by {off:.1e}, truncation {:.1e}", curve.truncation());
        assert!(off.abs() < 1e-6, "{more}: {off:e}");
        for i in 0..30 {
            let n = 1.32f64.powi(i);
            let c = statics.closure(0, n, 0.0, 0.0).unwrap();
            let p = curve.in_arc(0, c.alpha.v);
            let (normal, rho) = (p.n_bi / n - 1.0, p.rho_i / c.rolling_ratios().0 - 1.0);
            assert!(normal.abs() < 2e-4 && rho.abs() < 2e-7, "{more} {n} N: {normal:e} {rho:e}");
        }
    }
}

#[test]
fn shorter_flush_and_longer_sprags_have_their_ends_named() {
    let edge = |sprag_mm: f64, race_mm: f64, offset: f64| {
        let mut c = clutch("law = \"elastic\"");
        c.sprags.length_m = 1e-3 * sprag_mm;
        c.races.width_m = 1e-3 * race_mm;
        c.axial.offset_m = 1e-3 * offset;
        let built = curve(&c);
        let contact = built.statics().elastic.inner_contact[0];
        assert!((contact.length_m - c.contact_length_m()).abs() < 1e-15);
        let found = along(&c, &contact, Side::Inner, 1558.0, Lengthwise::Slices).unwrap();
        (c.contact_length_m(), found)
    };
    let (length, short) = edge(6.0, 9.0, 0.0);
    assert!(
        (length - 6e-3).abs() < 1e-12
            && matches!(short.edges, [Edge::Singular { .. }, Edge::Singular { .. }])
    );
    assert!(matches!(short.peak, Peak::AtEnd { .. }));
    let (length, flush) = edge(6.0, 6.0, 0.0);
    assert!((length - 6e-3).abs() < 1e-12 && matches!(flush.edges, [Edge::Flush { .. }, Edge::Flush { .. }]));
    let (length, long) = edge(9.0, 6.0, 0.0);
    assert!(
        (length - 6e-3).abs() < 1e-12 && matches!(long.edges, [Edge::Singular { .. }, Edge::Singular { .. }])
    );
    let (length, aside) = edge(6.0, 6.0, 1.5);
    assert!(
        (length - 4.5e-3).abs() < 1e-12
            && matches!(aside.edges, [Edge::Singular { .. }, Edge::Singular { .. }])
    );
}

#[test]
fn a_tilted_sprag_bears_on_opposite_ends() {
    let c = clutch("law = \"elastic\"\ntilt_mrad = 1.5");
    let elastic = &curve(&c).statics().elastic.clone();
    let inner = along(&c, &elastic.inner_contact[0], Side::Inner, 500.0, Lengthwise::Slices).unwrap();
    let outer = along(&c, &elastic.outer_contact, Side::Outer, 500.0, Lengthwise::Slices).unwrap();
    let bears_at = |found: &Along| found.y_m.iter().zip(&found.load_n).map(|(y, q)| y * q).sum::<f64>();
    assert!(bears_at(&inner) < 0.0 && (bears_at(&inner) / bears_at(&outer) + 1.0).abs() < 0.2);
    // Slices misplace some 2.5 % of the force in a tilted contact (reports/contact-error-vs-time.html).
    let reference = along(&c, &elastic.inner_contact[0], Side::Inner, 500.0, Lengthwise::Reference).unwrap();
    assert!(reference.converged && (bears_at(&reference) / bears_at(&inner) - 1.0).abs() < 0.05);
    assert!((reference.load_n.iter().sum::<f64>() / 500.0 - 1.0).abs() < 1e-6);
    // Free faces take load off a flush end.
    let square = clutch("law = \"elastic\"");
    let end = |how| along(&square, &elastic.inner_contact[0], Side::Inner, 1558.0, how).unwrap().load_n[0];
    assert!(end(Lengthwise::FreeEnds) < 0.8 * end(Lengthwise::Reference));
}

#[test]
fn a_profile_takes_the_singularity_off_the_end() {
    let kinds = [
        "kind = \"lundberg\", design_load_n = 3000.0",
        "kind = \"fujiwara-kawase\", design_load_n = 3000.0, load_factor = 1.2, crowned_ratio = 0.4, end_drop_um = 10.0",
        "kind = \"crown\", radius_mm = 600.0",
        "kind = \"end-relief\", length_mm = 1.0, radius_mm = 60.0",
        "kind = \"table\", points = [ { y_mm = -3.0, drop_um = 9.0 }, { y_mm = -2.0, drop_um = 0.0 }, \
         { y_mm = 2.0, drop_um = 0.0 }, { y_mm = 3.0, drop_um = 9.0 } ]",
    ];
    for kind in kinds {
        let c = clutch(&format!("law = \"elastic\"\nend_profile = {{ {kind} }}"));
        assert_ne!(c.axial.end_profile, EndProfile::Square);
        let contact = curve(&c).statics().elastic.inner_contact[0];
        let found = along(&c, &contact, Side::Inner, 1558.0, Lengthwise::Slices).unwrap();
        assert!(matches!(found.peak, Peak::Bounded { .. }), "{kind}: {:?}", found.peak);
        assert!((found.load_n.iter().sum::<f64>() / 1558.0 - 1.0).abs() < 1e-12);
    }
}
