//! Limits on what yields as a whole, against hand calculations: opening of the race gap, windup, equivalent stress.

use std::f64::consts::PI;

use sprag_design::design::Design;
use sprag_design::margin::{Capacities, Margin, load_margins, load_state, nominal_capacity};

const MULTI: &str = include_str!("../../designs/huang2017-multi-arc.toml");
const KEYS: &str = "gap_nominal_mm = 8.50\ngap_peak_mm = 8.6\nwindup_nominal_deg = 9.0\nequivalent_inner_mpa = 900.0\n\
                    equivalent_outer_mpa = 750.0";

/// The design of the file with `keys` added to its limits and `changes` made.
fn design(keys: &str, changes: &[(&str, &str)]) -> Design {
    let mut text = MULTI.replacen("peak_torque_nm = 110.0", &format!("{keys}\npeak_torque_nm = 110.0"), 1);
    for (from, to) in changes {
        assert!(text.contains(from), "{from}");
        text = text.replacen(from, to, 1);
    }
    Design::parse(&text, "multi.toml").unwrap()
}

fn rows(design: &Design) -> Vec<Margin> {
    load_margins(design, &design.limits, Capacities::Wanted, &load_state(design).unwrap())
}

fn row<'a>(rows: &'a [Margin], code: &str) -> &'a Margin {
    rows.iter().find(|r| r.code() == code).unwrap_or_else(|| panic!("no row {code}"))
}

/// Lame (Timoshenko, Strength of Materials II, art. 41) with Table 1's radii: u = p R/E [(b^2 + a^2)/(b^2 - a^2) +- nu] under
/// p = n_s N/(2 pi R w).
#[test]
fn the_gap_opens_as_lames_rings_do() {
    let design = design(KEYS, &[]);
    let state = load_state(&design).unwrap();
    let all = rows(&design);
    for (code, torque, gap_mm) in [("gap-nominal", 90.0, 8.50), ("gap-peak", 110.0, 8.60)] {
        let p = state.curve.at_torque(torque).unwrap();
        let growth = |normal_n: f64, track: f64, ratio: f64, nu: f64| {
            let pressure = 12.0 * normal_n / (2.0 * PI * track * 6e-3);
            pressure * track / 206e9 * (ratio + nu)
        };
        let (inner, outer) = ((11.11f64.powi(2), 7.21f64.powi(2)), (26.23f64.powi(2), 19.44f64.powi(2)));
        let by_hand = growth(p.normal_inner_n, 11.11e-3, (inner.0 + inner.1) / (inner.0 - inner.1), -0.3)
            + growth(p.normal_outer_n, 19.44e-3, (outer.0 + outer.1) / (outer.0 - outer.1), 0.3);
        let r = row(&all, code);
        assert!((r.demand_in_unit().unwrap() / (1e3 * by_hand) - 1.0).abs() < 1e-12, "{r:?} {by_hand}");
        // The allowable is an opening too: 8.33 mm are there at rest.
        assert!((r.allowable_in_unit() - (gap_mm - 8.33)).abs() < 1e-9 && r.limit.unit == "mm", "{r:?}");
    }
}

#[test]
fn equivalent_stresses_are_von_mises_of_lame() {
    let design = design(KEYS, &[]);
    let p = load_state(&design).unwrap().curve.at_torque(90.0).unwrap();
    let all = rows(&design);
    let pressure = |normal_n: f64, track: f64| 12.0 * normal_n / (2.0 * PI * track * 6e-3) * 1e-6;
    let (po, pi) = (pressure(p.normal_outer_n, 19.44e-3), pressure(p.normal_inner_n, 11.11e-3));
    let hoop = po * (26.23f64.powi(2) + 19.44f64.powi(2)) / (26.23f64.powi(2) - 19.44f64.powi(2));
    // Principal stresses hoop, -p, 0.
    let outer = (0.5 * ((hoop + po).powi(2) + po * po + hoop * hoop)).sqrt();
    assert!((row(&all, "equivalent-outer").demand_in_unit().unwrap() / outer - 1.0).abs() < 1e-12);
    let bore = 2.0 * pi * 11.11f64.powi(2) / (11.11f64.powi(2) - 7.21f64.powi(2));
    assert!((row(&all, "equivalent-inner").demand_in_unit().unwrap() / bore - 1.0).abs() < 1e-12);
    // A solid shaft is pressed evenly: -p, -p, 0.
    let solid = self::design(KEYS, &[("inner_bore_radius_mm = 7.21 ", "inner_bore_radius_mm = 0.0 ")]);
    let p = load_state(&solid).unwrap().curve.at_torque(90.0).unwrap();
    let want = pressure(p.normal_inner_n, 11.11e-3);
    assert!((row(&rows(&solid), "equivalent-inner").demand_in_unit().unwrap() / want - 1.0).abs() < 1e-12);
}

#[test]
fn a_capacity_is_the_torque_at_which_no_margin_is_left_and_the_least_is_the_nominal_capacity() {
    let keys = KEYS
        .replace("8.50", "8.36")
        .replace("8.6\n", "8.37\n")
        .replace("9.0\n", "6.0\n")
        .replace("900.0", "300.0");
    let keys = keys.replace("750.0", "200.0");
    let design = design(&keys, &[]);
    let before = rows(&design);
    let mut least = f64::INFINITY;
    for code in ["gap-nominal", "gap-peak", "windup-nominal", "equivalent-inner", "equivalent-outer"] {
        let at = row(&before, code).torque_capacity_nm.unwrap();
        let there = self::design(
            &keys,
            &[
                ("nominal_torque_nm = 90.0", &format!("nominal_torque_nm = {at}")),
                ("peak_torque_nm = 110.0", &format!("peak_torque_nm = {at}")),
            ],
        );
        let margin = row(&rows(&there), code).margin();
        assert!(margin.abs() < 1e-8, "{code}: {margin} at {at} N m");
        if code != "gap-peak" {
            least = least.min(at);
        }
    }
    let state = load_state(&design).unwrap();
    let (torque, code) = nominal_capacity(&design, &design.limits, &state).unwrap();
    assert!((torque / least - 1.0).abs() < 1e-8, "{torque} by {code}, {least}");
    // Sprags steeper than friction do not get as far as any limit.
    let slippery =
        self::design(&keys, &[("static = 0.12 ", "static = 0.07 "), ("kinetic = 0.09 ", "kinetic = 0.06 ")]);
    let state = load_state(&slippery).unwrap();
    assert_eq!(nominal_capacity(&slippery, &slippery.limits, &state), Some((0.0, "grip-inner")));
}

#[test]
fn a_gap_that_is_no_more_than_that_at_rest_is_refused() {
    for (keys, word) in [
        ("gap_nominal_mm = 0.13", "more than the gap at rest, 8.33 mm"),
        ("gap_peak_mm = 8.33", "more than the gap at rest, 8.33 mm"),
        ("gap_nominal_mm = -1.0", "gap_nominal_mm"),
        ("windup_nominal_deg = 0.0", "windup_nominal_deg"),
    ] {
        let text = MULTI.replacen("peak_torque_nm = 110.0", &format!("{keys}\npeak_torque_nm = 110.0"), 1);
        let error = Design::parse(&text, "x.toml").unwrap_err().to_string();
        assert!(error.contains(word), "{keys}: {error}");
    }
    let text = MULTI.replacen("\nnominal_torque_nm = 90.0", "\nwindup_nominal_deg = 3.0", 1).replacen(
        "hertz_nominal_mpa = 4200.0",
        "",
        1,
    );
    let error = Design::parse(&text, "x.toml").unwrap_err().to_string();
    assert!(error.contains("limits.nominal_torque_nm, which is missing"), "{error}");
}
