//! Friction and motion: (11), (13), (15).

use super::*;
use sprag_design::dynamics::*;
use sprag_design::kinematics;
use sprag_design::numeric::quadrature::integral;

/// A clutch under no load but an abutment, without damping: only friction and springs are left.
fn undamped(change: impl Fn(&mut Clutch)) -> (Clutch, Model) {
    let (mut clutch, profile) = common::clutch(&common::SINGLE);
    clutch.races.viscous_damping_nm_s_per_rad = 0.0;
    change(&mut clutch);
    let curve = WedgeCurve::build(&clutch, &profile, 0.0).unwrap();
    let alpha_max = alpha_max_rad(&clutch, &curve);
    let loads = Loads { inner_nm: 0.0, amplitude_nm: 0.0, omega_rad_s: 0.0, abutment_nm_per_rad: 5000.0 };
    (clutch.clone(), Model::new(&clutch, curve, loads, alpha_max, 0.0))
}

/// States on the first arc with every mixture of slip senses, rates of an engagement at speed.
fn slipping_states() -> Vec<(Mode, State)> {
    let mut out = Vec::new();
    for alpha in [0.02, 0.05, 0.11] {
        for (a, b) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
            let mut y = [0.0; N_STATE];
            (y[0], y[3], y[4], y[5]) = (alpha, 1e-3, 40.0, 300.0);
            // Races fast enough or slow enough that v_A and v_B have the wanted signs.
            (y[6], y[7]) = (300.0 + 60.0 * a, 300.0 + 60.0 * b);
            let place = Place::Arc(0);
            out.push((Mode { place, inner: Grip::Slip(a), outer: Grip::Slip(b) }, y));
        }
    }
    out
}

/// (11) prints sgn(Vel) at both contacts. In T_bi, T_be as (13) and (15) count them the signs are opposite: what
/// friction takes is n_s (T_bi v_A - T_be v_B), and it must take at both contacts whatever the senses.
#[test]
fn eq_11_friction_takes_power_at_both_contacts() {
    let (_, model) = undamped(|_| {});
    let mut same_sign_feeds = 0;
    for (mode, y) in slipping_states() {
        let f = model.forces(&mode, 0.0, &y);
        let (at_a, at_b) = (f.t_bi * f.v_a, -f.t_be * f.v_b);
        assert!(f.v_a != 0.0 && f.v_b != 0.0 && at_a < 0.0 && at_b < 0.0, "{mode:?}: {at_a} {at_b} W");
        // As printed: T = N mu sgn(Vel), the same sign at both.
        let printed_a = f.v_a.signum() * f.t_bi.abs() * f.v_a;
        let printed_b = -f.v_b.signum() * f.t_be.abs() * f.v_b;
        same_sign_feeds += usize::from(printed_a.max(printed_b) > 0.0);
    }
    assert_eq!(same_sign_feeds, slipping_states().len());
}

/// (13) with (15): the rate of kinetic and stored energy is what friction takes, to rounding. That holds only
/// with the sprag's mass in m_g OC_g phi'' and with the Coriolis term, which (13b) leaves out.
#[test]
fn eq_13_power_balances_with_mass_and_coriolis() {
    let (clutch, model) = undamped(|_| {});
    let (m, i_g) = (clutch.sprags.mass_kg, clutch.sprags.inertia_kg_m2);
    let (i_i, i_e) = (clutch.races.inner_inertia_kg_m2, clutch.races.outer_inertia_kg_m2);
    for (mode, y) in slipping_states() {
        let p = model.point(mode.place, y[0]);
        let f = model.forces(&mode, 0.0, &y);
        let [da, dp, di, de] = model.rates(&mode, &p, &y);
        let [aa, ap, ai, ae] = f.acceleration;
        let wedge = p.t_static * p.oa * (p.rho_i + p.rho_e);
        let spring = clutch.spring.stiffness_nm_per_rad * (model.alpha_max_rad - y[0]);
        let sprag = i_g * (da + dp) * (aa + ap)
            + m * p.oc_g * dp * (p.oc_g * ap + p.oc_g_slope * da * dp)
            + (wedge - spring) * da;
        let terms = [
            COUNT * sprag,
            i_i * di * ai,
            i_e * de * ae + 5000.0 * y[3] * de,
            -COUNT * f.t_bi * f.v_a,
            COUNT * f.t_be * f.v_b,
        ];
        let scale: f64 = terms.iter().map(|t| t.abs()).sum();
        let left: f64 = terms.iter().sum();
        assert!(left.abs() < 1e-12 * scale, "{mode:?}: {left:e} of {scale:e} W");
        // Without Coriolis phi'' carries 2 OC_g' alpha' phi'/OC_g more, and its power is missing.
        let coriolis = COUNT * 2.0 * m * p.oc_g * p.oc_g_slope * da * dp * dp;
        assert!(coriolis.abs() > 1e3 * left.abs().max(1e-12 * scale), "{coriolis:e} W");
    }
}

/// The same over a run: rolling without loss keeps its energy. The printed (13b) would lose or gain what the
/// Coriolis term carries, summed here along the way.
#[test]
fn eq_13_a_lossless_run_keeps_its_energy() {
    let (clutch, mut model) = undamped(|_| {});
    model.loads.inner_nm = -40.0;
    let (start, place) = preloaded(&model, 40.0).unwrap();
    let mut y = start;
    // The whole clutch swings on the abutment, the wedge between some 20 and 60 Nm.
    for rate in &mut y[5..8] {
        *rate = 10.0;
    }
    let settings = RunSettings {
        tolerance: 1e-11,
        duration_s: 0.005,
        longest_step_s: 1e-4,
        most_events: 1000,
        most_steps: 100_000,
        samples: 501,
        rolling: true,
        ..RunSettings::default()
    };
    let mode = Mode { place, inner: Grip::Stick, outer: Grip::Stick };
    let run = run(&model, y, mode, &settings);
    assert_eq!(run.stop, Stop::Finished);
    // Wedge energy U = int C/n_s dW in (alpha/alpha_end)^(1/9), where it is smooth.
    let wedge = |alpha: f64| {
        let slope = |s: f64| {
            let p = model.curve.in_arc(0, alpha * s.powi(9));
            p.t_static * p.oa * (p.rho_i + p.rho_e) * alpha * 9.0 * s.powi(8)
        };
        integral(0.0, 0.3, slope) + integral(0.3, 0.7, slope) + integral(0.7, 1.0, slope)
    };
    let energy = |s: &Sample| {
        let p = model.point(s.mode.place, s.state[0]);
        let rates = model.rates(&s.mode, &p, &s.state);
        model.energy_without_wedge(&p, &rates, &s.state) + COUNT * wedge(s.state[0])
            - model.loads.inner_nm * s.state[2]
    };
    let energies: Vec<f64> = run.samples.iter().map(energy).collect();
    let drift = energies.iter().map(|e| (e - energies[0]).abs()).fold(0.0, f64::max);
    let dt = settings.duration_s / 500.0;
    let mut carried: f64 = 0.0;
    let mut most: f64 = 0.0;
    for s in &run.samples {
        let p = model.point(s.mode.place, s.state[0]);
        let [da, dp, ..] = model.rates(&s.mode, &p, &s.state);
        carried += COUNT * 2.0 * clutch.sprags.mass_kg * p.oc_g * p.oc_g_slope * da * dp * dp * dt;
        most = most.max(carried.abs());
    }
    println!(
        "lowest N {:.1} N, energy drifts by {drift:.1e} J, Coriolis carries {most:.1e} J",
        run.peaks.normal_min_n
    );
    assert!(drift < 1e-11, "{drift:e} J");
    assert!(most > 100.0 * drift, "{most:e} J");
}

/// (13) prints the spring as a couple on the sprag and nothing else. It sits on the free, massless cage, so
/// inside the clutch: the angular momentum of sprags and races changes by outside torques only.
#[test]
fn eq_13_the_spring_turns_nothing_from_inside() {
    let (clutch, model) = undamped(|_| {});
    let (m, i_g) = (clutch.sprags.mass_kg, clutch.sprags.inertia_kg_m2);
    let mut states = slipping_states();
    let mut open = [0.0; N_STATE];
    (open[0], open[3], open[6]) = (-0.01, 1e-3, 10.0);
    states.push((Mode { place: Place::Open, inner: Grip::Slip(1.0), outer: Grip::Stick }, open));
    for (mode, y) in states {
        let p = model.point(mode.place, y[0]);
        let f = model.forces(&mode, 0.0, &y);
        let [da, dp, ..] = model.rates(&mode, &p, &y);
        let [aa, ap, ai, ae] = f.acceleration;
        let sprags =
            COUNT * (i_g * (aa + ap) + m * p.oc_g * p.oc_g * ap + 2.0 * m * p.oc_g * p.oc_g_slope * da * dp);
        let (i_i, i_e) = (clutch.races.inner_inertia_kg_m2, clutch.races.outer_inertia_kg_m2);
        let rate = sprags + i_i * ai + i_e * ae;
        let scale = sprags.abs() + (i_i * ai).abs() + (i_e * ae).abs();
        let couple = COUNT * clutch.spring.stiffness_nm_per_rad * (model.alpha_max_rad - y[0]);
        assert!((rate + 5000.0 * y[3]).abs() < 1e-11 * scale, "{mode:?}: {rate} Nm");
        assert!(couple.abs() > 1e-8 * scale, "what the print adds, {couple} Nm, would show");
    }
    // At 20 000 rpm it would feed the clutch 36 W for ever.
    let fed = COUNT * clutch.spring.stiffness_nm_per_rad * model.alpha_max_rad * 20_000.0 * RPM;
    assert!((fed - 36.0).abs() < 0.5, "{fed} W");
}

/// Overrun drag at low speed is the C_f that alpha_max was set for; with the spring as printed it is 0.0131 Nm.
#[test]
fn eq_13_overrun_drag_is_the_drag_that_was_measured() {
    let (clutch, profile) = common::clutch(&common::SINGLE);
    let curve = WedgeCurve::build(&clutch, &profile, 0.0).unwrap();
    let alpha_max = alpha_max_rad(&clutch, &curve);
    assert!((alpha_max - 0.1449).abs() < 5e-5, "{alpha_max}");
    let mu = 0.1;
    let steady = overrun(&clutch, &curve, alpha_max, mu);
    assert!((steady.drag_torque_nm - 0.0166).abs() < 5e-5, "{}", steady.drag_torque_nm);
    // As printed the couple also enters moments about O: T_be OB = T_bi OA - K_r(alpha_max - alpha).
    let left = |n: f64| {
        let (_, c) = curve.closure_at_normal(n).unwrap();
        let (oa, ob, bg, g) = (c.lengths.oa.v, c.lengths.ob.v, c.beta.v + c.gamma.v, c.gamma.v);
        let l = kinematics::levers(oa, ob, c.oc_g.v, bg, g);
        let spring = clutch.spring.stiffness_nm_per_rad * (alpha_max - c.alpha.v);
        let t_bi = -mu * n;
        let t_be = (t_bi * oa - spring) / ob;
        let n_be = (n * bg.cos() + t_bi * bg.sin() - t_be * g.sin()) / g.cos();
        (spring - (l.h_i * n - l.h_e * n_be - l.b_i * t_bi - l.b_e * t_be), COUNT * mu * n * oa)
    };
    let (mut low, mut high) = (1e-3, 10.0);
    assert!(left(low).0 > 0.0 && left(high).0 < 0.0);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if left(middle).0 > 0.0 { low = middle } else { high = middle }
    }
    assert!((left(low).1 - 0.0131).abs() < 5e-5, "{}", left(low).1);
}

/// (13) has no radial equation. With it, contact forces at A and B hold the sprag on its circle about O at speed,
/// with no moment about G: three balances in the plane.
#[test]
fn eq_13_forces_hold_the_sprag_on_its_circle() {
    for rpm in [0.0, 5000.0, 20_000.0] {
        let speed = rpm * RPM;
        let curve = curve(speed, |_| {});
        for n in [10.0, 100.0, 1500.0] {
            let (_, c) = curve.closure_at_normal(n).unwrap();
            let [a, b, g] = points(&c);
            // On the sprag: N_bi outwards, N_be inwards; T_bi acts on the inner race, T_be on the sprag.
            let tangent = |azimuth: f64| [azimuth.cos(), -azimuth.sin()];
            let at_a = from_to(times(c.t_bi.v, tangent(c.beta.v)), times(n, at_azimuth(c.beta.v)));
            let at_b = from_to(times(c.n_be.v, at_azimuth(0.0)), times(c.t_be.v, tangent(0.0)));
            let f_c = 1.8e-3 * c.oc_g.v * speed * speed;
            let centrifugal = times(f_c, at_azimuth(-c.gamma.v));
            for axis in [0, 1] {
                let sum = at_a[axis] + at_b[axis] + centrifugal[axis];
                assert!(sum.abs() < 1e-12 * (n + f_c), "{rpm} rpm, {n} N, axis {axis}: {sum}");
            }
            let m = moment(from_to(g, a), at_a) + moment(from_to(g, b), at_b);
            assert!(m.abs() < 1e-12 * (n + f_c) * 4e-3, "{rpm} rpm, {n} N: {m} Nm");
        }
    }
}

/// (15) prints no abutment, but section 4 ties the outer race to ground. With it the preload is an equilibrium;
/// without, the same state runs away.
#[test]
fn eq_15_the_abutment_holds_the_preload() {
    let (clutch, mut model) = undamped(|c| c.spring.stiffness_nm_per_rad = 0.0);
    model.loads.inner_nm = -16.8;
    let (y, place) = preloaded(&model, 16.8).unwrap();
    let mode = Mode { place, inner: Grip::Stick, outer: Grip::Stick };
    let unit = 16.8 / clutch.races.outer_inertia_kg_m2;
    let held = model.forces(&mode, 0.0, &y).acceleration;
    assert!(held[2].abs() < 1e-9 * unit && held[3].abs() < 1e-9 * unit, "{held:?}");
    model.loads.abutment_nm_per_rad = 0.0;
    let free = model.forces(&mode, 0.0, &y).acceleration;
    // What the wedge carries, 16.8 Nm, accelerates the outer race.
    assert!((free[3] / -unit - 1.0).abs() < 0.01, "{free:?}");
}
