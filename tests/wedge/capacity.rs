//! Limits of `check` against hand calculations from textbooks.
use sprag_design::design::Design;
use sprag_design::margin::{Capacities, Margin, load_margins, load_state};
use std::f64::consts::PI;

const MULTI: &str = include_str!("../../designs/huang2017-multi-arc.toml");

/// The design of the file with `keys` added to its limits, and its rows.
fn rows(keys: &str) -> (Design, Vec<Margin>) {
    let text = MULTI.replacen("peak_torque_nm = 110.0", &format!("{keys}\npeak_torque_nm = 110.0"), 1);
    let design = Design::parse(&text, "multi.toml").unwrap();
    let state = load_state(&design).unwrap();
    let rows = load_margins(&design, &design.limits, Capacities::Wanted, &state);
    (design, rows)
}

fn row<'a>(rows: &'a [Margin], code: &str) -> &'a Margin {
    rows.iter().find(|r| r.code() == code).unwrap_or_else(|| panic!("no row {code}"))
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
    assert!((largest.demand_in_unit().unwrap() * 1e6 / (0.3003 * p0) - 1.0).abs() < 1e-3, "{largest:?}");
    assert!(largest.name.contains(&format!("{:.3} mm deep", 0.78615 * a * 1e3)), "{}", largest.name);
    let s = a.hypot(depth_m);
    let across = -(p0 / a) * ((a * a + 2.0 * depth_m * depth_m) / s - 2.0 * depth_m);
    let down = -p0 * a / s;
    let core = row(&rows, "subsurface-core-outer");
    assert!(depth_m > 0.78615 * a, "the case is to reach below the largest shear");
    assert!((core.demand_in_unit().unwrap() * 1e6 / (0.5 * (across - down)) - 1.0).abs() < 1e-9, "{core:?}");
    // The contact at A is narrower: its shear is larger near the surface and fades sooner.
    assert!(row(&rows, "subsurface-inner").demand_in_unit().unwrap() > largest.demand_in_unit().unwrap());
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
        let margin = row(&load_margins(&design, &design.limits, Capacities::LeftOut, &state), code).margin();
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
        let got = row(&with, code).demand_in_unit().unwrap();
        assert!((got / want - 1.0).abs() < 5e-3, "{code}: {got} against {want}");
        let plain = row(&without, code).demand_in_unit().unwrap();
        let exact = (plain * plain + (each_n / normal_n).powi(2)).sqrt();
        assert!(got > plain && (got / exact - 1.0).abs() < 1e-12, "{code}: {got} against {exact}");
    }
    // More than friction can ever hold.
    let (_, over) = rows("axial_load_n = 1e6");
    assert!(row(&over, "grip-inner").margin() < 0.0);
    assert_eq!(row(&over, "grip-inner").torque_capacity_nm, Some(0.0));
}

/// Eccentric compression by hand: A and B of the loaded sprag from their azimuths and radii about O, brought back
/// into the body; sigma = F/(b l) (1 + 6 e/b) with F from the forces at A.
#[test]
fn the_body_is_a_prism_under_an_eccentric_strut() {
    let (design, rows) = rows("body_yield_mpa = 1500.0");
    let state = load_state(&design).unwrap();
    let p = state.curve.at_torque(110.0).unwrap();
    let (_, c) = state.curve.closure_at_torque(110.0).unwrap();
    let force_n = p.normal_inner_n.hypot(p.normal_inner_n * p.tan_omega);
    // Undeformed points of the loaded sprag about O, y along OC_e: both contacts lie on the line from O through their
    // arc's centre, C_i at azimuth beta.
    let arc = &state.profile.arcs[p.arc];
    let (sin_b, cos_b) = c.beta.v.sin_cos();
    let oc_e = c.lengths.oc_e.v;
    let a = [(c.lengths.oc_i.v - arc.radius_m) * sin_b, (c.lengths.oc_i.v - arc.radius_m) * cos_b - oc_e];
    let b = [0.0, 4.68e-3];
    // The body has turned by c.rotation towards positive azimuth: turn back.
    let back = |[x, y]: [f64; 2]| {
        let (s, k) = c.rotation.v.sin_cos();
        [x * k - y * s, x * s + y * k]
    };
    let (a, b) = (back(a), back(b));
    // The strut at first contact, by (9).
    let (oc_i, oc_e0) = (11.11e-3 + 4.02e-3, 19.44e-3 - 4.68e-3);
    let beta0 = ((oc_i * oc_i + oc_e0 * oc_e0 - 0.62e-3_f64.powi(2)) / (2.0 * oc_i * oc_e0)).acos();
    let a0 = [11.11e-3 * beta0.sin(), 11.11e-3 * beta0.cos() - oc_e0];
    let (dx, dy) = (-a0[0], 4.68e-3 - a0[1]);
    let (mx, my) = (0.5 * (a[0] + b[0]) - a0[0], 0.5 * (a[1] + b[1]) - a0[1]);
    let e = (mx * dy - my * dx).abs() / dx.hypot(dy);
    let (width, length) = (5.05e-3, 6e-3);
    let want = force_n / (width * length) * (1.0 + 6.0 * e / width);
    let got = row(&rows, "body-yield");
    println!("F {force_n} N, e {} mm, {} MPa", e * 1e3, got.demand_in_unit().unwrap());
    assert!((got.demand_in_unit().unwrap() * 1e6 / want - 1.0).abs() < 2e-4, "{got:?} against {want}");
    assert!(got.torque_capacity_nm.unwrap() > 110.0);
}

/// n_s N sqrt(mu_s^2 - tan^2) is the axial force that a contact has left; from the torque named on it suffices.
#[test]
fn the_torque_from_which_an_axial_load_is_carried_leaves_no_friction() {
    let (design, rows) = rows("axial_load_n = 1500.0");
    let from = row(&rows, "axial-from").demand_in_unit().unwrap();
    let p = load_state(&design).unwrap().curve.at_torque(from).unwrap();
    let left = |normal_n: f64, tangent: f64| 12.0 * normal_n * (0.12f64 * 0.12 - tangent * tangent).sqrt();
    let least = left(p.normal_inner_n, p.tan_omega).min(left(p.normal_outer_n, p.tan_nu));
    println!("axial load carried from {from} Nm");
    assert!((least / 1500.0 - 1.0).abs() < 1e-6, "{least} N at {from} N m");
    assert!(!row(&rows, "axial-from").required);
    assert!(row(&self::rows("").1, "grip-inner").demand_in_unit().unwrap() > 0.0);
}

/// Sprags turn until they touch: clearance by the outline at the torque named, with none left.
#[test]
fn crowding_has_a_torque() {
    // The most sprags of the greatest width that fit at first contact, on a strut so steep that a light load already
    // turns them far: past 0.25 rad their corners come nearer again.
    let text = MULTI
        .replacen("count = 12 ", "count = 15 ", 1)
        .replacen("width_mm = 5.05", "width_mm = 5.12", 1)
        .replacen("centre_distance_mm = 0.62", "centre_distance_mm = 0.39", 1)
        .replacen("peak_torque_nm = 110.0", "peak_torque_nm = 30.0", 1)
        .replacen("nominal_torque_nm = 90.0", "nominal_torque_nm = 20.0", 1);
    let design = Design::parse(&text, "crowded.toml").unwrap();
    let state = load_state(&design).unwrap();
    let rows = load_margins(&design, &design.limits, Capacities::Wanted, &state);
    let capacity = row(&rows, "neighbours").torque_capacity_nm.unwrap();
    println!("crowding at {capacity} Nm; the curve ends at {}", state.curve.end_torque_nm());
    assert!(capacity < state.curve.end_torque_nm(), "neighbours never touch");
    let (_, c) = state.curve.closure_at_torque(capacity).unwrap();
    let gap = sprag_design::profile::clearance_m(
        state.outline.as_ref().unwrap(),
        c.lengths.oc_e.v,
        c.rotation.v,
        15,
    );
    assert!(gap.abs() < 1e-9, "{gap}");
}

/// Where a junction leads to a radius twice as large, the pressure behind it falls while the torque rises: what was larger before counts
/// for pressure, for shear below the contact and for the pressure along it, and limits its torque.
#[test]
fn the_largest_pressure_on_the_way_to_a_torque_counts() {
    let wide = MULTI
        .replacen("length_mm = 6.0", "length_mm = 20.0", 1)
        .replacen("\nwidth_mm = 6.0", "\nwidth_mm = 60.0", 1)
        .replacen("radius_mm = 4.08, until_rad = 0.12", "radius_mm = 4.05, until_rad = 0.14", 1)
        .replacen("radius_mm = 4.15, until_rad = 0.45", "radius_mm = 9.0, until_rad = 0.36", 1)
        .replacen("[contact]", "[contact]\nend_profile = { kind = \"crown\", radius_mm = 8000.0 }", 1)
        .replacen("= 110.0", "= 280.0\ncase_shear_mpa = 900.0\nalong_mpa = 4000.0", 1);
    let made = |text: &str| {
        let design = Design::parse(text, "wide.toml").unwrap();
        let state = load_state(&design).unwrap();
        let rows = load_margins(&design, &design.limits, Capacities::Wanted, &state);
        (state, rows)
    };
    let (state, rows) = made(&wide);
    let p0 = |torque: f64| state.curve.at_torque(torque).unwrap().hertz_inner_pa;
    let (at_nm, largest) = (1..=2800)
        .map(|k| 0.1 * f64::from(k))
        .map(|t| (t, p0(t)))
        .fold((0.0, 0.0), |most, here| if here.1 > most.1 { here } else { most });
    assert!(at_nm < 250.0 && largest > 1.01 * p0(280.0), "{largest} at {at_nm}, {} at the peak", p0(280.0));
    let demand = |code: &str| row(&rows, code).demand_in_unit().unwrap() * 1e6;
    // A step of the torques looked at here is 5e-4 of them, half of that in pressure.
    let beside_grid = demand("hertz-peak-inner") / largest - 1.0;
    assert!((0.0..2.5e-4).contains(&beside_grid), "{beside_grid:e}");
    let shear = demand("subsurface-inner") / (0.300_283 * demand("hertz-peak-inner"));
    assert!((shear - 1.0).abs() < 1e-5, "{shear}");
    assert!(row(&rows, "subsurface-inner").name.contains("on the way"));
    let outer = state.curve.at_torque(280.0).unwrap().hertz_outer_pa;
    assert!(demand("hertz-peak-outer") == outer, "the outer contact has one radius");
    let there = wide.replacen("peak_torque_nm = 280.0", &format!("peak_torque_nm = {at_nm}"), 1);
    let there = there.replacen("nominal_torque_nm = 90.0", "nominal_torque_nm = 50.0", 1);
    let (_, before) = made(&there);
    let along = |code: &str| demand(code) / (row(&before, code).demand_in_unit().unwrap() * 1e6) - 1.0;
    assert!(along("along-middle-inner").abs() < 2.5e-4, "{}", along("along-middle-inner"));
    // The ends bear a growing part, and most at the peak.
    assert!((1e-3..1e-2).contains(&along("along-ends-inner")), "{}", along("along-ends-inner"));

    // The row says where; its torque is not beyond that, however little the top passes what is allowed.
    assert!(row(&rows, "hertz-peak-inner").name.contains("largest on the way, at 20"), "{rows:?}");
    for share in [0.5, 1e-2, 1e-4] {
        let between = largest - share * (largest - p0(280.0));
        let tight =
            wide.replacen("hertz_peak_mpa = 4600.0", &format!("hertz_peak_mpa = {}", 1e-6 * between), 1);
        assert_ne!(tight, wide);
        let (_, tight) = made(&tight);
        let m = row(&tight, "hertz-peak-inner");
        assert!(m.margin() < 0.0 && m.torque_capacity_nm.unwrap() < at_nm + 0.1, "{m:?}");
    }
    // Up to a larger torque it is no less.
    let up_to = |torque: f64| {
        let text = wide.replacen("peak_torque_nm = 280.0", &format!("peak_torque_nm = {torque}"), 1);
        let text = text.replacen("nominal_torque_nm = 90.0", "nominal_torque_nm = 50.0", 1);
        row(&made(&text).1, "hertz-peak-inner").demand_in_unit().unwrap()
    };
    let rising: Vec<f64> = (0..30).map(|k| up_to(200.0 + f64::from(k))).collect();
    assert!(rising.windows(2).all(|w| w[1] >= w[0] * (1.0 - 1e-9)), "{rising:?}");
}
