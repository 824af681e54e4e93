//! Spirals for inner profiles: statics against a script that knows the curve and no arcs of it (`tests/reference/spiral.py`),
//! how far the strut angle stays, what more steps gain, the circle as a limit, and what is refused.

use sprag_design::clutch::Clutch;
use sprag_design::design::Design;
use sprag_design::profile::Support;
use sprag_design::wedge::{StaticPoint, WedgeCurve};

const SINGLE: &str = include_str!("../../designs/huang2017-single-arc.toml");
const SPIRAL: &str = include_str!("../../designs/spiral.toml");

/// The single-arc design with other lines for its arc and centre distance.
fn text(lines: &str) -> String {
    let arcs = SINGLE.find("inner_arcs = [").unwrap();
    let until = arcs + SINGLE[arcs..].find("]\n").unwrap() + 2;
    // Without its task, whose variables are those of the arc.
    let task = SINGLE.find("[optimize]").unwrap();
    let with = format!("{}{lines}\n{}", &SINGLE[..arcs], &SINGLE[until..task]);
    let distance = with.lines().find(|l| l.starts_with("centre_distance_mm")).unwrap().to_owned() + "\n";
    with.replacen(&distance, "", 1)
}

fn design(lines: &str) -> Design {
    Design::parse(&text(lines), "spiral.toml").unwrap_or_else(|e| panic!("{e}"))
}

fn clutch(lines: &str) -> Clutch {
    design(lines).clutch
}

fn point(clutch: &Clutch, torque_nm: f64) -> (StaticPoint, WedgeCurve) {
    let curve = clutch.curve().unwrap();
    (curve.at_torque(torque_nm).unwrap(), curve)
}

/// The keys of the curves in `tests/reference/spiral.csv`.
fn reference(curve: &str, steps: usize) -> Clutch {
    clutch(&match curve {
        "constant" => {
            format!("inner_spiral = {{ strut_angle_deg = 4.45, until_rad = 0.4, steps = {steps} }}")
        }
        "logarithmic" => format!(
            "inner_spiral = {{ curve = \"logarithmic\", strut_angle_deg = 4.45, start_radius_mm = 4.02, until_rad = 0.4, \
             steps = {steps} }}"
        ),
        "behind" => format!(
            "centre_distance_mm = 0.62\ninner_arcs = [{{ radius_mm = 4.02, until_rad = 0.06 }}]\n\
             inner_spiral = {{ until_rad = 0.4, steps = {steps} }}"
        ),
        other => panic!("{other}"),
    })
}

/// (windup, tan omega, N, turn) off the reference, each as a part of it but for the turn, rad.
fn off(curve: &str, steps: usize) -> Vec<[f64; 4]> {
    let clutch = reference(curve, steps);
    let mut reader = csv::Reader::from_reader(include_str!("../reference/spiral.csv").as_bytes());
    let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    let of_curve = rows.iter().filter(|row| &row[0] == curve);
    let all: Vec<[f64; 4]> = of_curve
        .map(|row| {
            let [torque, n, tan, turn, windup] = [1, 2, 4, 5, 6].map(|i| row[i].parse::<f64>().unwrap());
            let p = point(&clutch, torque).0;
            [
                p.windup_rad / windup - 1.0,
                p.tan_omega / tan - 1.0,
                p.normal_inner_n / n - 1.0,
                p.contact_turn_rad - turn,
            ]
        })
        .collect();
    assert_eq!(all.len(), 4);
    all
}

/// Windup, tan omega and normal force with the steps of a file that names none are off by no more than what every answer
/// says of tan omega, and with 60 steps by less than 4e-6.
#[test]
fn statics_are_those_of_the_curve_itself() {
    for curve in ["constant", "logarithmic", "behind"] {
        for (steps, most) in [(12, None), (60, Some(4e-6))] {
            let of = reference(curve, steps);
            let said = of.sprags.spiral.unwrap().tan_omega_off(&of.profile().unwrap()).unwrap();
            let most = most.unwrap_or(said);
            for row in off(curve, steps) {
                println!("{curve}, {steps} steps, {said:.1e} said: {row:?}");
                assert!(
                    row[..3].iter().all(|v| v.abs() < most),
                    "{curve}, {steps}: {row:?} against {most:e}"
                );
            }
        }
    }
}

/// What arcs leave of tan omega falls by the square of a step's length.
#[test]
fn more_steps_come_nearer() {
    let worst = |steps| off("logarithmic", steps).iter().map(|row| row[1].abs()).fold(0.0, f64::max);
    let said = |steps| {
        let clutch = reference("logarithmic", steps);
        clutch.sprags.spiral.unwrap().tan_omega_off(&clutch.profile().unwrap()).unwrap()
    };
    let mut before = (worst(2), said(2));
    for steps in [6, 18, 54] {
        let now = (worst(steps), said(steps));
        println!("{steps} steps: {now:?}");
        assert!(now.0 <= now.1 + 1e-8 && before.1 / now.1 > 8.5 && before.1 / now.1 < 9.5);
        before = now;
    }
    assert!(before.0 < 2e-6);
}

/// tan omega = p'/(p - s_i + (OA/OB)(r_e - s_e)) of every closure, and so within the giving way of races and contacts of what
/// it was at first contact; a circle of the same first contact moves by fifteen times as much.
#[test]
fn the_strut_angle_stays() {
    let spiral = Design::parse(SPIRAL, "spiral.toml").unwrap().clutch;
    let profile = spiral.profile().unwrap();
    let curve = spiral.curve().unwrap();
    let r_e = spiral.sprags.outer_radius_m;
    let drawn = spiral.races.inner_radius_m / spiral.races.outer_radius_m;
    let start = Support::of(&profile, 0.0).unwrap().tan_omega(r_e * drawn);
    assert!((start - 4.887f64.to_radians().tan()).abs() < 1e-13);
    let said = spiral.sprags.spiral.unwrap().tan_omega_off(&profile).unwrap();
    for i in 1..=40 {
        let torque = 110.0 * f64::from(i) / 40.0;
        let p = curve.at_torque(torque).unwrap();
        let (_, c) = curve.closure_at_normal(p.normal_inner_n).unwrap();
        let (oa, ob) = (c.lengths.oa.v, c.lengths.ob.v);
        // How much less than drawn the sprag reaches at either side, (8).
        let at = Support::of(&profile, p.contact_turn_rad).unwrap();
        let oc_e = at.aside_m / c.beta.v.sin();
        let reach = oc_e * c.beta.v.cos() - oa;
        let tan = at.aside_m / (reach + oa / ob * (ob - oc_e));
        assert!((p.tan_omega / tan - 1.0).abs() < 1e-9, "{torque}: {} {tan}", p.tan_omega);
        // By what that differs from p + (R_i/R_e) r_e.
        let gives = (at.height_m - reach) + drawn * r_e - oa / ob * (ob - oc_e);
        let bound = gives / (at.height_m + drawn * r_e) * 1.02 + said;
        let moved = p.tan_omega / start - 1.0;
        assert!(moved > 0.0 && moved < bound && bound < 0.0125, "{torque}: {moved} {bound}");
    }
    let arc = Design::parse(SINGLE, "single.toml").unwrap().clutch;
    let [a, b] = [(&arc, 0.07778), (&spiral, start)].map(|(c, from)| point(c, 90.0).0.tan_omega / from - 1.0);
    println!("at 90 Nm tan omega has moved by {a} on a circle, by {b}");
    assert!(a > 15.0 * b && b < 0.009);
}

#[test]
fn without_a_rise_it_is_an_arc() {
    let arc = Design::parse(SINGLE, "single.toml").unwrap().clutch;
    let profile = arc.profile().unwrap();
    let inset = arc.sprags.outer_radius_m * arc.races.inner_radius_m / arc.races.outer_radius_m;
    let angle = Support::of(&profile, 0.0).unwrap().tan_omega(inset).atan().to_degrees();
    for rise in ["0", "1e-12"] {
        let circle = clutch(&format!(
            "inner_spiral = {{ curve = \"logarithmic\", strut_angle_deg = {angle:?}, start_radius_mm = 4.02, rise = {rise}, \
             until_rad = 0.45 }}"
        ));
        assert_eq!(circle.sprags.inner_arcs.len(), 24);
        assert!((circle.sprags.centre_distance_m / arc.sprags.centre_distance_m - 1.0).abs() < 1e-12);
        for torque in [3.34, 16.8, 50.0, 100.0] {
            let [a, b] = [&arc, &circle].map(|c| point(c, torque).0);
            for (a, b) in [
                (a.windup_rad, b.windup_rad),
                (a.tan_omega, b.tan_omega),
                (a.normal_inner_n, b.normal_inner_n),
                (a.contact_turn_rad, b.contact_turn_rad),
            ] {
                assert!((a / b - 1.0).abs() < 1e-10, "{rise}, {torque}: {a} {b}");
            }
        }
    }
}

/// A tolerance of all radii together, and wear by the same depth everywhere, are the parallel curve: arcs that are larger alike are those of a spiral of
/// the same rise, and their distances from C_e those of the curve's own support p = c e^(k psi) - d, a further out.
#[test]
fn radii_larger_alike_are_the_parallel_spiral() {
    let made = Design::parse(SPIRAL, "spiral.toml").unwrap().clutch;
    let spiral = made.sprags.spiral.unwrap();
    for outwards_m in [-20e-6, 5e-6, 20e-6] {
        let other = spiral.parallel(outwards_m);
        assert_eq!(other.rise, spiral.rise);
        for ((radius, until), (larger, end)) in spiral.arcs().iter().zip(other.arcs()) {
            assert!((larger - radius - outwards_m).abs() < 1e-16 && end == *until, "{larger} {radius}");
        }
        for turn in [0.0, 0.1, 0.3] {
            assert!((other.radius_m(turn) - spiral.radius_m(turn) - outwards_m).abs() < 1e-17);
        }
        // tan omega = p'/(p + a + q r_e): larger radii alike ask for less friction everywhere.
        let mut moved = made.clone();
        moved.sprags.inner_arcs.iter_mut().for_each(|arc| arc.radius_m += outwards_m);
        let [own, out] = [&made, &moved].map(|c| c.profile().unwrap());
        let own_m = |p: &sprag_design::profile::Profile, turn: f64| {
            let arc = p.arcs.iter().find(|a| a.until_rad > turn).unwrap();
            arc.centre_m.dot(&p.contact_direction(turn)) + arc.radius_m
        };
        // Both are seated anew between the races: the support of each about C_e at a turn from its own first contact.
        let [a, b] = [own_m(&own, 0.2) - own_m(&own, 0.0), own_m(&out, 0.2) - own_m(&out, 0.0)];
        println!("{outwards_m:e}: {a:e} {b:e}");
        assert!((a / b - 1.0).abs() < 0.02, "{a} {b}");
    }
}

/// A scenario, a fit, a temperature: the arcs go with the body, and the spiral keeps its pole.
#[test]
fn a_warm_clutch_keeps_its_spiral() {
    let warm = "[thermal]\ninner_race_c = 90.0\nouter_race_c = 80.0\nsprags_c = 90.0\n\n[spring]";
    let text = SPIRAL.replacen("[spring]", warm, 1).replacen(
        "density_kg_m3",
        "expansion_um_per_m_k = 11.5\ndensity_kg_m3",
        1,
    );
    let design = Design::parse(&text, "warm.toml").unwrap_or_else(|e| panic!("{e}"));
    let (run, made) = (&design.clutch, design.as_made().unwrap());
    let spiral = run.sprags.spiral.unwrap();
    assert_ne!(spiral.from_rad, 0.0);
    // Only where the first arc is still in contact does the profile hold the beginning.
    let of =
        |clutch: &Clutch| clutch.sprags.spiral.unwrap().pole_m(&clutch.profile().unwrap()).unwrap().norm();
    assert!(of(&made) < 1e-16 && of(run) < 1e-9, "{} {}", of(&made), of(run));
    let (p, _) = point(run, 90.0);
    assert!((p.tan_omega / 0.0855 - 1.0).abs() < 0.012);
}

#[test]
fn what_is_no_spiral_is_refused_at_its_key() {
    for (lines, key, words) in [
        ("centre_distance_mm = 0.62", "sprags.inner_arcs", "inner_spiral"),
        ("inner_arcs = [{ radius_mm = 4.02, until_rad = 0.45 }]", "sprags.centre_distance_mm", "no such key"),
        ("inner_spiral = { until_rad = 0.4 }", "sprags.inner_spiral.strut_angle_deg", "no inner_arcs before"),
        ("inner_spiral = { strut_angle_deg = 4.45 }", "sprags.inner_spiral.until_rad", "rad"),
        (
            "inner_spiral = { strut_angle_deg = 4.45, until_rad = 2.0 }",
            "sprags.inner_spiral.until_rad",
            "at most 1.57",
        ),
        (
            "inner_spiral = { strut_angle_deg = 0.0, until_rad = 0.4 }",
            "sprags.inner_spiral.strut_angle_deg",
            "above 0",
        ),
        (
            "inner_spiral = { strut_angle_deg = 46.0, until_rad = 0.4 }",
            "sprags.inner_spiral.strut_angle_deg",
            "at most 45",
        ),
        (
            "inner_spiral = { strut_angle_deg = 4.45, until_rad = 0.4, steps = 0 }",
            "sprags.inner_spiral.steps",
            "at least 1",
        ),
        (
            "inner_spiral = { strut_angle_deg = 4.45, until_rad = 0.4, steps = 1.5 }",
            "sprags.inner_spiral.steps",
            "whole",
        ),
        (
            "inner_spiral = { strut_angle_deg = 4.45, until_rad = 0.4, steps = 101 }",
            "sprags.inner_spiral.steps",
            "100",
        ),
        (
            "inner_spiral = { strut_angle_deg = 4.45, until_rad = 0.4, rise = 0.1 }",
            "sprags.inner_spiral.rise",
            "logarithmic",
        ),
        (
            "inner_spiral = { strut_angle_deg = 4.45, until_rad = 0.4, start_radius_mm = 4.0 }",
            "sprags.inner_spiral.start_radius_mm",
            "logarithmic",
        ),
        (
            "inner_spiral = { curve = \"logarithmic\", strut_angle_deg = 4.45, until_rad = 0.4 }",
            "sprags.inner_spiral.start_radius_mm",
            "Radius of curvature",
        ),
        (
            "inner_spiral = { curve = \"archimedean\", strut_angle_deg = 4.45, until_rad = 0.4 }",
            "sprags.inner_spiral.curve",
            "constant-strut-angle",
        ),
        (
            "inner_spiral = { curve = \"logarithmic\", strut_angle_deg = 4.45, start_radius_mm = 4.0, rise = 1.5, until_rad = 0.4 }",
            "sprags.inner_spiral.rise",
            "at most 1",
        ),
        (
            "centre_distance_mm = 12.0\ninner_arcs = [{ radius_mm = 4.02, until_rad = 0.02 }]\n\
             inner_spiral = { until_rad = 1.5, steps = 1 }",
            "sprags.inner_spiral.until_rad",
            "above 0 throughout",
        ),
        (
            "centre_distance_mm = 0.62\ninner_spiral = { strut_angle_deg = 4.45, until_rad = 0.4 }",
            "sprags.centre_distance_mm",
            "strut_angle_deg says it",
        ),
        (
            "centre_distance_mm = 0.62\ninner_arcs = [{ radius_mm = 4.02, until_rad = 0.1 }]\n\
             inner_spiral = { strut_angle_deg = 4.45, until_rad = 0.4 }",
            "sprags.inner_spiral.strut_angle_deg",
            "behind inner_arcs",
        ),
        (
            "inner_arcs = [{ radius_mm = 4.02, until_rad = 0.1 }]\ninner_spiral = { until_rad = 0.4 }",
            "sprags.centre_distance_mm",
            "no such key",
        ),
        (
            "centre_distance_mm = 0.62\ninner_arcs = [{ radius_mm = 4.02, until_rad = 0.4 }]\ninner_spiral = { until_rad = 0.3 }",
            "sprags.inner_spiral.until_rad",
            "more than the end of the arc before, 0.4 rad",
        ),
    ] {
        let refused = Design::parse(&text(lines), "bad.toml").expect_err(lines);
        let said = refused.problems().iter().find(|p| p.key == key);
        let said = said.unwrap_or_else(|| panic!("{lines}: {refused}"));
        let all = format!("{said:?}");
        assert!(all.contains(words), "{lines}: {all}");
        assert!(said.place.is_some(), "{lines}: no line");
    }
    let wide =
        text("inner_spiral = { strut_angle_deg = 4.45, until_rad = 0.4 }").replacen("= 4.68 ", "= 8.4 ", 1);
    let refused = Design::parse(&wide, "bad.toml").unwrap_err().to_string();
    assert!(
        refused.contains("sprags.outer_radius_mm: found 8.4") && refused.contains("8.33 mm"),
        "{refused}"
    );
}
