//! The pressure along the contacts as a limit: its own limits, and the end profile at which middle and ends are pressed alike.

use sprag_design::Follow;
use sprag_design::design::Design;
use sprag_design::margin::{Capacities, Margin, load_margins, load_state};
use sprag_design::optimise::{Desk, Fidelity, Forgetful, SearchMethod, search};
use sprag_design::wedge::{Lengthwise, Side, along};

const FILE: &str = "designs/huang2017-multi-arc.toml";

fn crowned(radius_mm: f64, more: &[(&str, &str)]) -> Design {
    let text = std::fs::read_to_string(FILE).unwrap();
    let profile = format!("\n[contact]\nend_profile = {{ kind = \"crown\", radius_mm = {radius_mm:?} }}");
    let mut text =
        text.replace("\n[contact]", &profile).replace("\n[limits]", "\n[limits]\nalong_mpa = 6000.0");
    for (from, to) in more {
        assert!(text.contains(from), "{from}");
        text = text.replace(from, to);
    }
    Design::parse(&text, FILE).unwrap_or_else(|e| panic!("{e}"))
}

/// Middle and ends of the inner contact, MPa, and the pressure without ends.
fn pressed(design: &Design) -> [f64; 3] {
    let state = load_state(design).unwrap();
    let rows = load_margins(design, &design.limits, Capacities::LeftOut, &state);
    let row = |code: &str| -> &Margin { rows.iter().find(|r| r.code() == code).unwrap() };
    ["along-middle-inner", "along-ends-inner", "hertz-peak-inner"]
        .map(|code| row(code).demand_in_unit().unwrap())
}

#[test]
fn a_crown_presses_the_middle_and_a_straight_sprag_its_ends() {
    let [middle, ends, even] = pressed(&crowned(1e7, &[]));
    assert!((middle / even - 1.0).abs() < 0.05 && ends > 1.2 * even, "{middle} {ends} {even}");
    let crowns = [3000.0, 1000.0, 500.0, 150.0].map(|radius_mm| pressed(&crowned(radius_mm, &[])));
    for pair in crowns.windows(2) {
        assert!(pair[1][0] > pair[0][0] && pair[1][1] < pair[0][1], "{crowns:?}");
    }
    let [middle, ends, even] = crowns[3];
    assert!(middle > 1.1 * even && ends < middle, "{middle} {ends} {even}");
    // The same as the map of pressures has, where the contact lies on one arc.
    let design = crowned(
        1000.0,
        &[
            ("peak_torque_nm = 110.0", "peak_torque_nm = 2.0"),
            ("nominal_torque_nm = 90.0", "nominal_torque_nm = 1.0"),
        ],
    );
    let state = load_state(&design).unwrap();
    let p = state.curve.at_torque(2.0).unwrap();
    let elastic = &state.curve.statics().elastic;
    let slices = along(
        &design.clutch,
        &elastic.inner_contact[p.arc],
        Side::Inner,
        p.normal_inner_n,
        Lengthwise::Slices,
    );
    let largest = slices.unwrap().pressure_pa.iter().copied().fold(0.0, f64::max) * 1e-6;
    let [middle, ends, _] = pressed(&design);
    assert!((middle.max(ends) / largest - 1.0).abs() < 1e-9, "{middle} {ends} {largest}");
}

/// `optimize` finds the crown at which both are pressed alike, which is neither end of the range.
#[test]
fn a_search_finds_the_crown_between_pressed_ends_and_pressed_middle() {
    let task = "[optimize]\nobjective = \"peak-pressure\"\nscenarios = [\"low-10\"]\nseed = 1\nvariables = [ { name = \"crown_radius_mm\", min = 100.0, max = 5000.0 } ]\n";
    let text = crowned(3000.0, &[]).source.clone();
    let before = text.split("[optimize]").next().unwrap();
    let after = text.split("[optimize]").nth(1).unwrap();
    let rest = after.find("\n[").map_or("", |at| &after[at..]);
    let design = Design::parse(&format!("{before}{task}{rest}"), FILE).unwrap_or_else(|e| panic!("{e}"));
    let method = SearchMethod { most_starts: 1, ..SearchMethod::default() };
    let found =
        search(&design, &method, Fidelity::default(), &Desk::new(&Follow::nobody(), &mut Forgetful)).unwrap();
    let radius = found.variables[0].best;
    assert!(radius > 110.0 && radius < 4900.0, "{radius}");
    let new = Design::parse(&found.file, FILE).unwrap();
    let [middle, ends, _] = pressed(&new);
    assert!((middle / ends - 1.0).abs() < 2e-3, "{radius}: {middle} {ends}");
    for beside in [0.9, 1.1] {
        let [middle_there, ends_there, _] = pressed(&crowned(beside * radius, &[]));
        assert!(middle_there.max(ends_there) > middle.max(ends), "{radius}");
    }
}
