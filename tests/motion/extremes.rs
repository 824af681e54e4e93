//! Extreme but legal designs: every row of `check`, the overrun curve and a scenario give numbers or named outcomes.

use sprag_design::Follow;
use sprag_design::design::Design;
use sprag_design::margin::{
    Capacities, lift_off_rad_s, load_margins, load_state, overrun_curve, scene_margins,
};
use sprag_design::scenario::{Settings, simulate};
use sprag_design::wedge::EndReason;

const MULTI: &str = include_str!("../../designs/huang2017-multi-arc.toml");

/// The file without [optimize], whose bounds belong to its own sizes.
fn base() -> &'static str {
    &MULTI[..MULTI.find("[optimize]").unwrap()]
}

/// Every length of sprags and races times `scale`; torque limits with its cube, inertias with its fifth power.
fn scaled(scale: f64) -> String {
    let mut out = String::new();
    for line in base().lines() {
        let code = line.split('#').next().unwrap();
        let power = |key: &str| match key {
            k if k.ends_with("_mm") => 1,
            k if k.ends_with("_kg") => 3,
            k if k.ends_with("inertia_kg_m2") => 5,
            k if k.ends_with("_nm") => 3,
            k if k.ends_with("nm_per_rad") || k.ends_with("nm_s_per_rad") => 3,
            _ => 0,
        };
        let mut changed = code.to_owned();
        for pair in code.split([',', '{', '}', '[', ']']) {
            let Some((key, value)) = pair.split_once('=') else { continue };
            let (key, value) = (key.trim(), value.trim());
            if let (Ok(number), p @ 1..) = (value.parse::<f64>(), power(key)) {
                let new = format!("{key} = {:e}", number * scale.powi(p));
                changed = changed.replacen(&format!("{key} = {value}"), &new, 1);
            }
        }
        out.push_str(&changed);
        out.push('\n');
    }
    out
}

fn replaced(changes: &[(&str, &str)]) -> String {
    let mut text = base().to_owned();
    for (from, to) in changes {
        assert!(text.contains(from), "the design no longer holds {from:?}");
        text = text.replacen(from, to, 1);
    }
    text
}

/// All that `check` computes of the load state, and one scenario, is a number.
fn answered(name: &str, text: &str) -> Design {
    let design = Design::parse(text, "extreme.toml").unwrap_or_else(|e| panic!("{name}: {e}"));
    let state = load_state(&design).unwrap_or_else(|e| panic!("{name}: {e}"));
    let (end, _) = state.curve.end();
    assert!(matches!(end, EndReason::OffProfile | EndReason::RollsOver), "{name}: {end:?}");
    assert!(state.curve.end_torque_nm() > 0.0 && state.curve.truncation() < 1e-6, "{name}");
    let rows = load_margins(&design, &design.limits, Capacities::Wanted, &state);
    assert!(rows.len() >= 14, "{name}: {} rows", rows.len());
    for row in &rows {
        assert!(
            row.demand.value().is_none_or(f64::is_finite)
                && row.allowable.is_finite()
                && row.margin().is_finite(),
            "{name}: {row:?}"
        );
        assert!(row.torque_capacity_nm.is_none_or(|t| t.is_finite() && t >= 0.0), "{name}: {row:?}");
    }
    let off = lift_off_rad_s(&design, &state, 6000.0);
    let curve = overrun_curve(&design, &state, off.unwrap_or(1000.0), &Follow::nobody())
        .unwrap_or_else(|e| panic!("{name}: {e}"));
    assert_eq!(curve.inner_race.len(), 25, "{name}");
    for p in curve.inner_race.iter().chain(&curve.outer_race) {
        let all = [p.state.drag_torque_nm, p.state.normal_inner_n, p.state.normal_outer_n, p.growth_m];
        assert!(all.iter().all(|x| x.is_finite() && *x >= 0.0), "{name}: {p:?}");
    }
    let scene = design.scenario("low-6").unwrap();
    let ends = match simulate(scene, &Settings::default()) {
        Ok(s) => format!("{:?}", s.verdict),
        Err(why) => format!("not started: {why}"),
    };
    for row in scene_margins(scene, &design.limits, true, None, &Settings::default()) {
        assert!(!row.margin().is_nan() && !row.demand.value().is_some_and(f64::is_nan), "{name}: {row:?}");
    }
    let end_nm = state.curve.end_torque_nm();
    println!("{name}: curve to {end_nm:.4e} Nm ({}), lift-off {off:?} rad/s, low-6 {ends}", end.name());
    design
}

#[test]
fn three_sprags() {
    answered("3 sprags", &replaced(&[("count = 12 ", "count = 3 ")]));
}

#[test]
fn eighty_sprags() {
    let text = replaced(&[
        ("count = 12 ", "count = 80 "),
        ("\ninner_bore_radius_mm = 7.21", "\ninner_bore_radius_mm = 60.0"),
        ("\ninner_radius_mm = 11.11", "\ninner_radius_mm = 100.0"),
        ("\nouter_radius_mm = 19.44", "\nouter_radius_mm = 108.33"),
        ("outer_outside_radius_mm = 26.23", "outer_outside_radius_mm = 150.0"),
    ]);
    answered("80 sprags", &text);
}

#[test]
fn a_solid_shaft() {
    answered("solid shaft", &replaced(&[("inner_bore_radius_mm = 7.21", "inner_bore_radius_mm = 0")]));
}

#[test]
fn paper_thin_races() {
    // A twentieth of a millimetre of steel: the track runs away from the sprags, which roll over or leave their profile.
    let outer =
        answered("thin outer race", &replaced(&[("outside_radius_mm = 26.23", "outside_radius_mm = 19.49")]));
    let inner =
        answered("thin inner race", &replaced(&[("bore_radius_mm = 7.21", "bore_radius_mm = 11.06")]));
    for d in [outer, inner] {
        let end = load_state(&d).unwrap().curve.end_torque_nm();
        assert!(end < 20.0, "{end} Nm");
    }
}

#[test]
fn one_and_five_hundred_millimetres() {
    let small = answered("1 mm", &scaled(0.5 / 11.11));
    let large = answered("500 mm", &scaled(250.0 / 11.11));
    // What scales: angles at first contact are the same to rounding of the radii.
    let tangent = |d: &Design| load_state(d).unwrap().first_tan_omega;
    assert!((tangent(&small) / tangent(&large) - 1.0).abs() < 1e-9);
    assert!((small.clutch.races.inner_radius_m - 0.5e-3).abs() < 1e-12);
}
