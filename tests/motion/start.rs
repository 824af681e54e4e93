//! One load, one start: a static load, what a damped transient comes to, and the start of a torsional excitation.

use sprag_design::clutch::{Scenario, ScenarioKind, Start};
use sprag_design::design::Design;
use sprag_design::dynamics::settled;
use sprag_design::kinematics::levers;
use sprag_design::scenario::{Prepared, Settings, prepare, simulate};
use std::path::Path;

const K_AB: f64 = 5000.0;

fn scene(kind: ScenarioKind, start: Start) -> Scenario {
    let design = Design::read(Path::new("designs/huang2017-multi-arc.toml")).unwrap();
    let base = design.scenario("high-6").unwrap().clone();
    Scenario { kind, start, ..base }
}

fn held(torque_nm: f64, start: Start) -> Prepared {
    prepare(&scene(ScenarioKind::Static { torque_nm }, start)).unwrap()
}

fn swung(preload_nm: f64, start: Start) -> Prepared {
    let kind = ScenarioKind::TorsionalExcitation {
        preload_nm,
        amplitude_nm: 1.0,
        frequency_hz: 100.0,
        abutment_stiffness_nm_per_rad: K_AB,
        duration_s: 0.1,
        speed_rad_s: 0.0,
    };
    prepare(&scene(kind, start)).unwrap()
}

#[test]
fn a_static_load_is_what_a_damped_transient_comes_to_and_an_excitation_starts_from() {
    for torque_nm in [0.1, 3.34] {
        let rest = simulate(&scene(ScenarioKind::Static { torque_nm }, Start::Settled), &Settings::default());
        let rest = rest.unwrap().static_normal_n;
        let starts = swung(torque_nm, Start::Settled).static_normal_n;
        // The race damping takes an e-fold of either swing in some 30 ms.
        let mut step = scene(
            ScenarioKind::Transient {
                preload_nm: 0.95 * torque_nm,
                torque_step_nm: 0.05 * torque_nm,
                step_time_s: 0.0,
                abutment_stiffness_nm_per_rad: K_AB,
                duration_s: 1.0,
                speed_rad_s: 0.0,
                overrun_rad_s: 0.0,
            },
            Start::Settled,
        );
        step.clutch.friction.static_ = 0.5;
        let s = simulate(&step, &Settings { samples: 2, tolerance: 1e-9, ..Settings::default() }).unwrap();
        let limit = s.samples.last().unwrap().forces.n_bi;
        println!("{torque_nm} Nm: static {rest} N, transient {limit} N, excitation starts at {starts} N");
        assert!((rest - limit).abs() < 1e-6 && (rest - starts).abs() < 1e-6);
    }
}

/// (13a) at rest as printed, about G, and (13b) with the cage's pin force: an equilibrium by other equations than those
/// that find it.
#[test]
fn the_settled_sprag_is_in_balance_by_the_printed_equations() {
    for torque_nm in [0.1, 3.34, 16.8, 90.0] {
        let p = held(torque_nm, Start::Settled);
        let model = &p.model;
        let point = p.at_rest().unwrap();
        let alpha = p.state[0];
        let c = model.point(p.mode.place, alpha);
        let (b_g, g) = (c.beta_gamma, c.gamma);
        let (n_bi, n_be) = (point.normal_inner_n, point.normal_outer_n);
        let (t_bi, t_be) = (point.tan_omega * n_bi, point.tan_nu * n_be);
        assert!((12.0 * t_bi * c.oa / torque_nm - 1.0).abs() < 1e-12);
        assert!((12.0 * t_be * c.ob / torque_nm - 1.0).abs() < 1e-12);
        let spring = 0.01 * (model.alpha_max_rad - alpha);
        let l = levers(c.oa, c.ob, c.oc_g, b_g, g);
        let moment = l.b_e * t_be + l.b_i * t_bi + spring - l.h_i * n_bi + l.h_e * n_be;
        let tangential =
            n_bi * b_g.sin() - t_bi * b_g.cos() + t_be * g.cos() - n_be * g.sin() - spring / c.oc_g;
        let radial = n_be * g.cos() - n_bi * b_g.cos() - t_bi * b_g.sin() + t_be * g.sin();
        println!("{torque_nm} Nm: moment {moment:e} of {spring:e} Nm, {tangential:e} N, {radial:e} N");
        // Deflections are those of the curve, whose N_be lies 0.02 N beside the one with the spring; without the spring the
        // moment would be off by all of it.
        let off = 5e-3 * spring.abs() + 1e-9 * l.h_i * n_bi;
        assert!(moment.abs() < off && tangential.abs() < off / c.oc_g);
        assert!(radial.abs() < 1e-9 * n_bi);
    }
}

#[test]
fn without_the_spring_a_load_is_the_point_of_the_curve() {
    for torque_nm in [0.1, 3.34] {
        let (free, rest) = (held(torque_nm, Start::WithoutSpring), held(torque_nm, Start::Settled));
        let curve = free.model.curve.at_torque(torque_nm).unwrap();
        assert_eq!(free.at_rest().unwrap(), curve);
        assert_eq!(swung(torque_nm, Start::WithoutSpring).state[0], curve.alpha_rad);
        // The spring presses harder: 9.64 N become 12.47 N at 0.1 Nm, 0.8 % more at 3.34 Nm.
        let more = rest.static_normal_n / free.static_normal_n - 1.0;
        let expected = if torque_nm == 0.1 { 0.293..0.294 } else { 0.0079..0.0082 };
        assert!(expected.contains(&more), "{torque_nm}: {more}");
        assert!(rest.at_rest().unwrap().tan_omega < curve.tan_omega);
    }
    // A spring of no stiffness does nothing.
    let mut slack = scene(ScenarioKind::Static { torque_nm: 3.34 }, Start::Settled);
    slack.clutch.spring.stiffness_nm_per_rad = 0.0;
    let (slack, free) = (prepare(&slack).unwrap(), held(3.34, Start::WithoutSpring));
    let (a, b) = (slack.at_rest().unwrap(), free.at_rest().unwrap());
    for (a, b) in [
        (a.normal_inner_n, b.normal_inner_n),
        (a.normal_outer_n, b.normal_outer_n),
        (a.tan_omega, b.tan_omega),
        (a.tan_nu, b.tan_nu),
        (a.windup_rad, b.windup_rad),
        (a.k_tangent_nm_per_rad, b.k_tangent_nm_per_rad),
    ] {
        assert!((a / b - 1.0).abs() < 1e-9, "{a} {b}");
    }
}

/// The tangent stiffness of a settled clutch is the slope of its torque over its windup.
#[test]
fn the_stiffness_with_the_spring_is_the_slope_of_torque_over_windup() {
    let p = held(3.34, Start::Settled);
    let windup = |torque: f64| p.model.curve.windup_rad(settled(&p.model, torque).unwrap().0[0]);
    let slope = 2e-3 / (windup(3.341) - windup(3.339));
    let stated = p.at_rest().unwrap().k_tangent_nm_per_rad;
    assert!((stated / slope - 1.0).abs() < 1e-6, "{stated} {slope}");
}

#[test]
fn the_file_names_the_start_and_kinds_that_have_none_refuse_it() {
    let bench = std::fs::read_to_string("designs/huang2017-bench.toml").unwrap();
    let kinds = "\n[[scenarios]]\nname = \"load\"\nkind = \"static\"\ntorque_nm = 3.34\n";
    let parse = |tail: &str| Design::parse(&format!("{bench}{kinds}{tail}"), "designs/tail.toml");
    let start = |tail: &str| parse(tail).unwrap().scenario("load").unwrap().start;
    assert_eq!(start(""), Start::Settled);
    assert_eq!(start("start = \"settled\"\n"), Start::Settled);
    assert_eq!(start("start = \"without-spring\"\n"), Start::WithoutSpring);
    assert_eq!(parse("").unwrap().scenario("high-10-vernay").unwrap().start, Start::WithoutSpring);
    let refused = |tail: &str| format!("{:?}", parse(tail).unwrap_err());
    let overrun = "[[scenarios]]\nname = \"o\"\nkind = \"overrun\"\nspeed_rpm = 1.0\noverrun_rpm = 1.0\n";
    let said = refused(&format!("{overrun}start = \"settled\"\n"));
    assert!(said.contains("start") && said.contains("for kind overrun: speed_rpm, overrun_rpm"), "{said}");
    let engages = bench.replace(
        "free_run_rpm = 300.0                # assumed",
        "free_run_rpm = 300.0\nstart = \"settled\"",
    );
    assert!(engages != bench && Design::parse(&engages, "designs/tail.toml").is_err());
    assert!(parse("start = \"loose\"\n").is_err());
}

/// A history tells of slip what the figures tell; surfaces that move past one another without contact do not slip.
#[test]
fn the_slip_of_a_history_is_that_of_the_figures() {
    let bench = Design::read(Path::new("designs/huang2017-bench.toml")).unwrap();
    for (name, apart) in [
        ("high-10-without-spring", true),
        ("engagement-without-spring", true),
        ("engagement-weak-spring", false),
    ] {
        let settings = Settings { samples: 400, ..Settings::default() };
        let s = simulate(bench.scenario(name).unwrap(), &settings).unwrap();
        let last = s.samples.last().unwrap();
        let before = s.engaged.map_or([0.0; 2], |e| [e.inner.net_m, e.outer.net_m]);
        for (i, net_m) in [s.inner.net_m, s.outer.net_m].into_iter().enumerate() {
            let shown = last.slip_m[i] - before[i];
            println!("{name} {i}: {shown:e} against {net_m:e}, moved {:e}", last.state[8 + i]);
            assert!((shown - net_m).abs() < 1e-12, "{name} {i}: {shown:e} {net_m:e}");
        }
        assert!(!apart || (last.state[9] - last.slip_m[1]).abs() > 1e-5, "{name}");
    }
}
