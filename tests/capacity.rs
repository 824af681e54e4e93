//! Limits of `check` against hand calculations from textbooks.
use sprag_design::design::Design;
use sprag_design::margin::{Margin, load_margins, load_state};
use std::f64::consts::PI;

const MULTI: &str = include_str!("../designs/huang2017-multi-arc.toml");

/// The design of the file with `keys` added to its limits, and its rows.
fn rows(keys: &str) -> (Design, Vec<Margin>) {
    let text = MULTI.replacen("peak_torque_nm = 110.0", &format!("{keys}\npeak_torque_nm = 110.0"), 1);
    let design = Design::parse(&text, "multi.toml").unwrap();
    let state = load_state(&design).unwrap();
    let rows = load_margins(&design, &design.limits, true, &state);
    (design, rows)
}

fn row<'a>(rows: &'a [Margin], code: &str) -> &'a Margin {
    rows.iter().find(|r| r.code == code).unwrap_or_else(|| panic!("no row {code}"))
}

/// Johnson, Contact Mechanics, 4.2: tau_1 = 0.30 p_0 at 0.78 a, and on the axis
/// sigma_x = -(p_0/a)((a^2 + 2z^2)/sqrt(a^2 + z^2) - 2z), sigma_z = -p_0 a/sqrt(a^2 + z^2). Half width by (4.43) from
/// the radii of the design, not from the pressure.
#[test]
fn shear_below_the_outer_contact_is_johnsons() {
    let depth_m = 0.6e-3;
    let (design, rows) = rows("case_depth_mm = 0.6\ncase_shear_mpa = 1300.0\ncore_shear_mpa = 900.0");
    let state = load_state(&design).unwrap();
    let p = state.curve.at_torque(110.0).unwrap();
    let radius_m = 1.0 / (1.0 / 4.68e-3 - 1.0 / 19.44e-3);
    let modulus_pa = 206e9 / (2.0 * (1.0 - 0.3 * 0.3));
    let line_load = p.normal_outer_n / 6e-3;
    let a = (4.0 * line_load * radius_m / (PI * modulus_pa)).sqrt();
    let p0 = 2.0 * line_load / (PI * a);
    let largest = row(&rows, "subsurface-outer");
    assert!((largest.demand * 1e6 / (0.3003 * p0) - 1.0).abs() < 1e-3, "{largest:?}");
    assert!(largest.name.contains(&format!("{:.3} mm deep", 0.78615 * a * 1e3)), "{}", largest.name);
    let s = a.hypot(depth_m);
    let across = -(p0 / a) * ((a * a + 2.0 * depth_m * depth_m) / s - 2.0 * depth_m);
    let down = -p0 * a / s;
    let core = row(&rows, "subsurface-core-outer");
    assert!(depth_m > 0.78615 * a, "the case is to reach below the largest shear");
    assert!((core.demand * 1e6 / (0.5 * (across - down)) - 1.0).abs() < 1e-9, "{core:?}");
    // The contact at A is narrower: its shear is larger near the surface and fades sooner.
    assert!(row(&rows, "subsurface-inner").demand > largest.demand);
}

#[test]
fn a_capacity_by_shear_is_the_torque_at_which_no_margin_is_left() {
    let (_, before) = rows("case_depth_mm = 0.6\ncase_shear_mpa = 900.0\ncore_shear_mpa = 500.0");
    for code in ["subsurface-inner", "subsurface-outer", "subsurface-core-inner", "subsurface-core-outer"] {
        let at = row(&before, code).torque_capacity_nm.unwrap();
        let there = MULTI.replacen("nominal_torque_nm = 90.0", "nominal_torque_nm = 1.0", 1).replacen(
            "peak_torque_nm = 110.0",
            &format!(
                "peak_torque_nm = {at}\ncase_depth_mm = 0.6\ncase_shear_mpa = 900.0\ncore_shear_mpa = 500.0"
            ),
            1,
        );
        let design = Design::parse(&there, "there.toml").unwrap();
        let state = load_state(&design).unwrap();
        assert!(at < state.curve.end_torque_nm(), "{code} is not reached");
        let margin = row(&load_margins(&design, &design.limits, false, &state), code).margin;
        assert!(margin.abs() < 1e-8, "{code}: {margin} at {at} N m");
    }
}

/// mu = sqrt(F_t^2 + F_a^2)/F_n with the forces of one sprag by hand: C = n_s R_i F_t.
#[test]
fn an_axial_load_takes_its_share_of_the_friction() {
    let axial_n = 1500.0;
    let (design, with) = rows("axial_load_n = 1500.0");
    let (_, without) = rows("");
    let p = load_state(&design).unwrap().curve.at_torque(110.0).unwrap();
    let each_n: f64 = axial_n / 12.0;
    for (code, radius_m, normal_n) in
        [("grip-inner", 11.11e-3, p.normal_inner_n), ("grip-outer", 19.44e-3, p.normal_outer_n)]
    {
        // Torque of one sprag over the radius; the races have grown by some 1e-4 of it.
        let tangential_n: f64 = 110.0 / 12.0 / radius_m;
        let want = (tangential_n * tangential_n + each_n * each_n).sqrt() / normal_n;
        let got = row(&with, code).demand;
        assert!((got / want - 1.0).abs() < 5e-3, "{code}: {got} against {want}");
        let plain = row(&without, code).demand;
        let exact = (plain * plain + (each_n / normal_n).powi(2)).sqrt();
        assert!(got > plain && (got / exact - 1.0).abs() < 1e-12, "{code}: {got} against {exact}");
    }
    // More than friction can ever hold.
    let (_, over) = rows("axial_load_n = 1e6");
    assert!(row(&over, "grip-inner").margin < 0.0);
    assert_eq!(row(&over, "grip-inner").torque_capacity_nm, Some(0.0));
}
