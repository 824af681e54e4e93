//! Optima as they can be made: flanks that realise a centroid, and tolerances.

use super::clutch::{HUANG, PEER_A, changed, design, problem, search_with, task};
use sprag_design::Follow;
use sprag_design::clutch::MassSource;
use sprag_design::design::Design;
use sprag_design::optimise::*;
use sprag_design::profile::{Flanks, Outline, clearance_m};

fn realised(design: &Design) -> (Search, Realised) {
    let method = SearchMethod::default();
    let found = search_with(design, &method);
    let made = realise(&found, task(design), &method, &Desk::new(&Follow::nobody(), &mut Forgetful));
    let made = made.unwrap_or_else(|e| panic!("{e}")).expect("a centroid was free");
    (found, made)
}

/// The paper's clutch: flanks put the centroid where the search wants it, and the file says so without naming it.
#[test]
fn the_optimum_with_a_free_centroid_can_be_made() {
    let (found, made) = realised(&design(HUANG));
    let near = &made.nearest;
    assert!(found.wants_centroid() && near.reached(), "{near:?}");
    let new = Design::parse(&made.file, "new.toml").unwrap_or_else(|e| panic!("{e}"));
    let s = &new.clutch.sprags;
    assert_eq!(s.mass_source, MassSource::FromProfile);
    for i in 0..2 {
        assert!((s.centroid_m[i] - near.wanted_m[i]).abs() < 2e-9, "{:?} {:?}", s.centroid_m, near.wanted_m);
    }
    assert!(
        (s.mass_kg - near.mass.mass_kg).abs() < 1e-9
            && (s.inertia_kg_m2 / near.mass.inertia_kg_m2 - 1.0).abs() < 1e-6
    );
    // Given mass to be met if it can: two numbers too many for a centroid.
    assert!((s.mass_kg / 1.8e-3 - 1.0).abs() < 1e-3, "{}", s.mass_kg);
    // Another inertia at 12 000 rpm costs little.
    assert!((made.objective - found.objective.1).abs() < 1e-3, "{} {}", made.objective, found.objective.1);
    assert!(made.assessed.rows.iter().all(|m| m.held()));
    assert!(made.searched);
    let on = &made.made;
    println!("{:?} -> {:?}", made.objective, on.objective);
    assert!(on.feasible() && on.objective.1 >= made.objective - 1e-6);
}

/// A whole number that was searched beside the centroid is among what was found.
#[test]
fn a_whole_number_beside_a_free_centroid_is_told() {
    let with_count = changed(
        HUANG,
        &[
            ("variables = [", "variables = [\n  { name = \"count\", min = 11, max = 12 },"),
            (
                r#"scenarios = ["high-6", "low-10", "rated-45", "rated-45-at-speed"]"#,
                r#"scenarios = ["rated-45-at-speed"]"#,
            ),
        ],
    );
    let (found, made) = realised(&with_count);
    let count = |search: &Search| search.variables.iter().find(|v| v.name == "count").map(|v| v.best);
    let made_with = Design::parse(&made.made.file, "new.toml").unwrap().clutch.sprags.count;
    assert_eq!(count(&made.made), count(&found));
    assert_eq!(count(&made.made), Some(made_with as f64));
}

/// A centroid that no straight flanks reach: the nearest, and no other flanks of the box are nearer.
#[test]
fn a_centroid_out_of_reach_has_a_nearest() {
    let far = changed(
        HUANG,
        &[
            ("centroid = { x_mm = 0.1935, y_mm = 0.5288 }", "centroid = { x_mm = -1.3, y_mm = 1.6 }"),
            (
                "{ name = \"centroid_x_mm\", min = -0.3, max = 0.5 }",
                "{ name = \"centroid_x_mm\", min = -1.4, max = -1.2 }",
            ),
            (
                "{ name = \"centroid_y_mm\", min = 0.2, max = 0.8 }",
                "{ name = \"centroid_y_mm\", min = 1.5, max = 1.7 }",
            ),
            (
                r#"scenarios = ["high-6", "low-10", "rated-45", "rated-45-at-speed"]"#,
                r#"scenarios = ["rated-45-at-speed"]"#,
            ),
        ],
    );
    let (found, made) = realised(&far);
    let near = &made.nearest;
    assert!(!near.reached() && near.distance_m > 0.3e-3, "{near:?}");
    let optimum = Design::parse(&found.file, "x.toml").unwrap();
    let profile = optimum.clutch.profile().unwrap();
    let mut random = fastrand::Rng::with_seed(5);
    let mut closed = 0;
    for _ in 0..20_000 {
        let flanks = Flanks {
            rear_m: 5e-3 * random.f64(),
            front_m: 5e-3 * random.f64(),
            rear_tilt_rad: random.f64() - 0.5,
            front_tilt_rad: random.f64() - 0.5,
        };
        let Ok(outline) = Outline::closed(&profile, &flanks) else { continue };
        let room = Outline::room(&profile, &flanks).unwrap();
        let free = clearance_m(&outline, profile.outer_centre_distance_m, 0.0, 12) > 1e-6;
        if !free || room.iter().flatten().any(|r| *r < 0.02) {
            continue;
        }
        closed += 1;
        let g = outline.mass_properties(6e-3, 7850.0).centroid_m;
        let d = (g[0] - near.wanted_m[0]).hypot(g[1] - near.wanted_m[1]);
        assert!(d > near.distance_m - 1e-6, "{flanks:?} is nearer: {d}, not {}", near.distance_m);
    }
    println!("{closed} other flanks, none nearer than {} mm", near.distance_m * 1e3);
    assert!(closed > 500, "{closed}");
}

/// Tolerances: the worst corner is no better than the drawing or any draw, and the robust design's worst corner is better
/// than that of the optimum at its nominal values, at a price.
#[test]
fn a_robust_design_holds_at_every_corner() {
    // Near the lower of its two optima, where there is no other: at the other the smallest force of high-6 is not least at a corner.
    let design = changed(PEER_A, &[("min = 3.9, max = 4.15", "min = 4.14, max = 4.15")]);
    let method = SearchMethod::default();
    let of = design.tolerances.expect("tolerances");
    let found = search_with(&design, &method);
    let mut nobody = Forgetful;
    let desk = Desk::new(&Follow::nobody(), &mut nobody);
    let made = spread(&found.problem, &found.outcome.x, &of, (60, 7), &desk).unwrap();
    assert_eq!((made.corners, made.draws), (16, (60, 0)));
    for s in &made.spreads {
        assert!(s.worst <= s.nominal && s.percentiles[0] <= s.percentiles[1], "{s:?}");
        assert!(s.worst <= s.percentiles[0] + 1e-3, "{s:?}");
    }
    assert!(!made.held(), "the nominal optimum stands on its limits");
    let again = spread(&found.problem, &found.outcome.x, &of, (60, 7), &desk).unwrap();
    assert_eq!(made, again);
    let (lo, hi) = found.bounds();
    let best =
        robust(&found.problem, &found.outcome.x, (&lo, &hi), 0.005, &of, (60, 7), &method, &desk).unwrap();
    println!(
        "nominal {:?}; robust {:?}, {} rounds, {} evaluations, at {:?}",
        made.objective, best.made.objective, best.rounds, best.evaluations, best.held_at
    );
    assert!(best.made.held(), "{:#?}", best.made.spreads);
    // Its lengths can be made, and every corner was held there.
    assert_eq!(best.step, Some(0.005));
    for (name, x) in found.searched.iter().zip(&best.x).filter(|(name, _)| name.starts_with("r_")) {
        assert!((x / 0.005 - (x / 0.005).round()).abs() < 1e-6, "{name} {x}");
    }
    assert!(best.made.objective.0 < made.objective.0, "robust costs something at the nominal values");
    assert!(best.made.yield_share > made.yield_share);
}

/// A corner of the gap alone against a file with these radii: the profile reseated is the profile placed.
#[test]
fn a_friction_corner_is_the_file_with_that_friction() {
    let text = format!("{HUANG}\n[tolerances]\nfriction = 0.01\n");
    let base = changed(&text, &[]);
    let of = base.tolerances.unwrap();
    let low = corners(&of).into_iter().find(|c| c.shares[5] < 0.0).unwrap();
    let x: Vec<f64> = task(&base).variables.iter().map(|v| v.start).collect();
    let there = problem(&base).at_corners(vec![low]).assess_at(&x).unwrap();
    let file =
        changed(HUANG, &[("static = 0.12 ", "static = 0.11 "), ("kinetic = 0.09 ", "kinetic = 0.0825 ")]);
    let same = problem(&file).assess_at(&x).unwrap();
    assert_eq!(low.name(), "-friction");
    for (a, b) in there.rows.iter().zip(&same.rows) {
        assert!((a.margin() - b.margin()).abs() < 1e-9, "{} {} {}", a.code(), a.margin(), b.margin());
    }
}

/// What follows from the material goes on following from it; only what `[optimize] limits` says otherwise is written.
#[test]
fn limits_that_follow_from_the_material_are_not_frozen() {
    let starter = include_str!("../../designs/starter.toml");
    let task = "\n[optimize]\nobjective = \"slip-margin\"\nscenarios = [\"cranking\"]\n\
                variables = [{ name = \"r_i1_mm\", min = 4.0, max = 4.1 }]\n\
                limits = { slip_margin = 0.03 }\nseed = 1\n";
    let design = Design::parse(&(starter.to_owned() + task), "x.toml").unwrap_or_else(|e| panic!("{e}"));
    let text = problem(&design).finished_file(&[4.05]).unwrap_or_else(|e| panic!("{e}"));
    assert!(text.contains("from_material = true") && text.contains("slip_margin = 0.03"), "{text}");
    assert!(!text.contains("hertz_peak_mpa") && !text.contains("hoop_inner_mpa"), "{text}");
    let new = Design::parse(&text, "new.toml").unwrap_or_else(|e| panic!("{e}"));
    let sharper = design.optimize.as_ref().map(|task| task.limits);
    assert_eq!(Some(new.limits), sharper);
}

/// A leaning that is nothing has no sign, and flanks in place of a centroid are variables of the next search.
#[test]
fn flanks_are_written_without_a_negative_zero_and_as_variables() {
    let flanks = Flanks { front_tilt_rad: -0.0, ..Flanks::parallel(2.5e-3, 2.0e-3) };
    let text = sprag_design::file::with_flanks(HUANG, &flanks).unwrap_or_else(|e| panic!("{e}"));
    assert!(
        text.contains("front_tilt_rad = 0.0") && !text.contains("-0.0 ") && !text.contains("-0.0}"),
        "{text}"
    );
    let drop = |name: &str| name.starts_with("centroid_");
    let other = sprag_design::file::other_variables(&text, &drop, &[("flank_rear_mm", (1.0, 3.0))]);
    let other =
        Design::parse(&other.unwrap_or_else(|e| panic!("{e}")), "x.toml").unwrap_or_else(|e| panic!("{e}"));
    let names: Vec<&str> = task(&other).variables.iter().map(|v| v.name.as_str()).collect();
    assert_eq!(names, ["r_i2_mm", "r_i3_mm", "flank_rear_mm"]);
}
