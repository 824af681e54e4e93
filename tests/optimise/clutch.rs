//! The optimiser on clutches: noise, threads, whole numbers, prices, what would free a problem.

use sprag_design::Follow;
use sprag_design::design::{Design, Optimize};
use sprag_design::optimise::*;
use std::collections::BTreeMap;

pub const HUANG: &str = include_str!("../../designs/huang2017-multi-arc.toml");
pub const PEER_A: &str = include_str!("designs/a-huang-at-rest.toml");
pub const PEER_B: &str = include_str!("designs/b-huang-at-speed.toml");
pub const PEER_C: &str = include_str!("designs/c-24-sprags.toml");
pub const PEER_D: &str = include_str!("designs/d-indexing-elastic.toml");
pub const PEER_E: &str = include_str!("designs/e-starter-eight.toml");

/// `text` with each `from` replaced once.
pub fn changed(text: &str, changes: &[(&str, &str)]) -> Design {
    let mut text = text.to_owned();
    for (from, to) in changes {
        assert!(text.contains(from), "{from:?} is gone");
        text = text.replacen(from, to, 1);
    }
    Design::parse(&text, "x.toml").unwrap_or_else(|e| panic!("{e}"))
}

pub fn design(text: &str) -> Design {
    changed(text, &[])
}

pub fn task(design: &Design) -> &Optimize {
    design.optimize.as_ref().expect("a task")
}

pub fn problem(design: &Design) -> ClutchProblem {
    let names = task(design).variables.iter().map(|v| v.name.clone()).collect();
    ClutchProblem::new(design, task(design), names, Fidelity::default())
}

pub fn search_with(design: &Design, method: &SearchMethod) -> Search {
    search(design, method, Fidelity::default(), &Desk::new(&Follow::nobody(), &mut Forgetful))
        .unwrap_or_else(|e| panic!("{e}"))
}

pub fn margin(rows: &[sprag_design::Margin], code: &str) -> f64 {
    rows.iter().find(|m| m.code() == code).unwrap_or_else(|| panic!("no row {code}")).margin()
}

fn outputs(problem: &ClutchProblem, x: &[f64]) -> Option<Vec<f64>> {
    let e = problem.evaluate(x).ok()?;
    Some(e.objectives.iter().chain(&e.limits).copied().collect())
}

/// Along a line through the box: points a millionth of the box apart differ smoothly (second differences below 1e-9 of
/// margins of order one), and between a hundred points across it the largest change of every margin halves with its
/// interval, down to nothing: no jump, at a junction or anywhere else.
#[test]
fn the_objective_has_no_noise_and_no_jump() {
    for (name, text) in [("a", PEER_A), ("b", PEER_B), ("c", PEER_C)] {
        let design = design(text);
        let problem = problem(&design);
        let box_of = task(&design);
        let mut random = fastrand::Rng::with_seed(6);
        let ends: Vec<(f64, f64)> =
            box_of.variables.iter().map(|v| (v.start, v.min + random.f64() * (v.max - v.min))).collect();
        let at = |s: f64| -> Vec<f64> { ends.iter().map(|(a, b)| a + s * (b - a)).collect() };
        let fine: Vec<Vec<f64>> =
            (0..12).map(|i| outputs(&problem, &at(0.3 + 1e-6 * f64::from(i))).unwrap()).collect();
        let rough = (0..fine[0].len()).map(|j| {
            let second = fine.windows(3).map(|w| (w[0][j] - 2.0 * w[1][j] + w[2][j]).abs());
            second.fold(0.0, f64::max) / fine[0][j].abs().max(1.0)
        });
        let rough = rough.fold(0.0, f64::max);
        let row: Vec<(f64, Vec<f64>)> = (0..100)
            .filter_map(|i| Some((f64::from(i) / 99.0, outputs(&problem, &at(f64::from(i) / 99.0))?)))
            .collect();
        assert!(row.len() > 30, "{name}: only {} points of the line have margins", row.len());
        // Margins often change most in the same interval.
        let mut known: BTreeMap<u64, Option<Vec<f64>>> = BTreeMap::new();
        let mut told = |s: f64| known.entry(s.to_bits()).or_insert_with(|| outputs(&problem, &at(s))).clone();
        let mut jump = (0.0, 0);
        for j in 0..row[0].1.len() {
            let Some((mut a, mut b)) = row
                .windows(2)
                .filter(|w| w[1].0 - w[0].0 < 0.011)
                .map(|w| (w[0].clone(), w[1].clone()))
                .max_by(|p, q| (p.1.1[j] - p.0.1[j]).abs().total_cmp(&(q.1.1[j] - q.0.1[j]).abs()))
            else {
                continue;
            };
            // Into the half with the larger change, twelve times: what a jump leaves is the jump.
            for _ in 0..12 {
                let s = 0.5 * (a.0 + b.0);
                let Some(m) = told(s) else { break };
                if (m[j] - a.1[j]).abs() > (b.1[j] - m[j]).abs() { b = (s, m) } else { a = (s, m) }
            }
            // A slope gives the interval beside it the same change, a jump does not.
            let step = b.0 - a.0;
            let beside = [(a.0 - step, a.1[j], -1.0), (b.0 + step, b.1[j], 1.0)]
                .into_iter()
                .find_map(|(s, from, sign)| Some((told(s)?[j] - from) * sign));
            let Some(beside) = beside else { continue };
            let left = (b.1[j] - a.1[j] - beside).abs() / a.1[j].abs().max(1.0);
            if left > jump.0 {
                jump = (left, j);
            }
        }
        println!("{name}: {} points, second differences {rough:.1e}, largest jump {:.1e}", row.len(), jump.0);
        assert!(rough < 1e-9, "{name}: {rough}");
        // A kink where the slope changes by 4 per line is 1e-5 here.
        assert!(jump.0 < 1e-5, "{name}: margin {} jumps by {}", jump.1, jump.0);
    }
}

/// Several climbs and a swarm side by side: the same to the bit with one thread and two.
#[test]
fn threads_do_not_change_a_search() {
    let design = design(PEER_C);
    let method = SearchMethod { starts: 2, swarm: Some(80), seed: 3, ..SearchMethod::default() };
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| search_with(&design, &method))
    };
    let (one, two) = (with(1), with(2));
    assert_eq!(one.outcome.x, two.outcome.x);
    assert_eq!((one.evaluations, &one.starts), (two.evaluations, &two.starts));
    assert_eq!(one.file, two.file);
    assert_eq!(one.starts.len(), 3);
    // Whatever the start, the same optimum: none of them ends better by more than a thousandth.
    let best = one.starts.iter().map(|s| s.least_margin).fold(f64::NEG_INFINITY, f64::max);
    println!("{:#?}", one.starts);
    assert!(one.starts[0].least_margin > best - 1e-3 * best, "{:?}", one.starts);
}

#[test]
fn whole_numbers_are_searched_one_by_one() {
    let design = changed(
        HUANG,
        &[
            ("variables = [\n", "variables = [\n  { name = \"count\", min = 11, max = 13 },\n"),
            (
                r#"scenarios = ["high-6", "low-10", "rated-45", "rated-45-at-speed"]"#,
                r#"scenarios = ["rated-45"]"#,
            ),
        ],
    );
    let found = search_with(&design, &SearchMethod::default());
    let counts: Vec<f64> = found.branches.iter().map(|b| b.values[0].1).collect();
    assert_eq!(counts, [12.0, 11.0, 13.0]);
    let best = found.branches.iter().max_by(|a, b| {
        let key = |b: &Branch| if b.violation <= 1e-8 { b.least_margin } else { f64::NEG_INFINITY };
        key(a).total_cmp(&key(b))
    });
    let count = best.unwrap().values[0].1;
    println!("{:#?}", found.branches);
    assert_eq!(found.variables.iter().find(|v| v.name == "count").unwrap().best, count);
    assert!(found.file.contains(&format!("count = {count} ")), "written as a whole number");
    assert_eq!(Design::parse(&found.file, "new.toml").unwrap().clutch.sprags.count as f64, count);
}

/// A multiplier is a derivative: a search with the limit raised finds what the price of it promised.
#[test]
fn raising_a_limit_buys_what_its_price_says() {
    let base = design(HUANG);
    let found = search_with(&base, &SearchMethod::default());
    let price = found.prices.iter().find(|p| p.of == "hoop-inner").expect("hoop-inner holds the optimum");
    let raised = changed(HUANG, &[("hoop_inner_mpa = 900.0", "hoop_inner_mpa = 905.0")]);
    let after = search_with(&raised, &SearchMethod::default());
    let (promised, bought) = (5.0 * price.gain_per_unit, after.objective.1 - found.objective.1);
    println!("promised {promised:.6}, bought {bought:.6}");
    assert!(promised > 1e-3 && (bought / promised - 1.0).abs() < 0.05, "{promised} {bought}");
    let bound =
        found.prices.iter().find(|p| p.kind == PriceKind::Lower && p.of == "r_i2_mm").expect("at its bound");
    let wider = changed(HUANG, &[("{ name = \"r_i2_mm\", min = 3.6", "{ name = \"r_i2_mm\", min = 3.55")]);
    let after = search_with(&wider, &SearchMethod::default());
    let (promised, bought) = (0.05 * bound.gain_per_unit, after.objective.1 - found.objective.1);
    println!("promised {promised:.6}, bought {bought:.6}");
    assert!((bought / promised - 1.0).abs() < 0.1, "{promised} {bought}");
}

#[test]
fn a_hopeless_scene_says_what_would_free_it() {
    let design = changed(
        HUANG,
        &[(
            r#"scenarios = ["high-6", "low-10", "rated-45", "rated-45-at-speed"]"#,
            r#"scenarios = ["high-8", "high-10"]"#,
        )],
    );
    let found = search_with(&design, &SearchMethod::default());
    let Status::Infeasible { fighting, .. } = &found.outcome.status else {
        panic!("{:?}", found.outcome.status)
    };
    assert!(fighting.iter().any(|i| found.names.limits[*i] == "contact:high-10"));
    let told = relief(&design, &found.problem, &found.outcome, &Desk::new(&Follow::nobody(), &mut Forgetful));
    println!("{told:#?}");
    assert_eq!(told.freed.len(), 6);
    assert!(told.evaluations < 6 * 35);
    // The least preload: it frees, a hundredth less does not.
    let text = found.problem.file_at(&found.outcome.x).unwrap();
    let preload = told.freed.iter().find(|f| f.what == "preload" && f.scenario == "high-10").unwrap();
    let needed = preload.needed.expect("preload frees");
    let alone = found.problem.for_scenario("high-10");
    let holds = |value: f64| {
        let text = sprag_design::file::with_keys(&text, &[(preload.key.as_str(), value)]).unwrap();
        let rows = alone.assess(&alone.parsed(&text).unwrap()).unwrap().rows;
        margin(&rows, "contact:high-10") >= -1e-8 && margin(&rows, "slip:high-10") >= -1e-8
    };
    assert!(holds(needed) && !holds(0.99 * needed), "{needed}");
    assert!((3.34..10.0).contains(&needed));
}

#[test]
fn a_limit_out_of_reach_is_named() {
    let design =
        changed(HUANG, &[("limits = { keep_contact_to_rpm = 6000 }", "limits = { hoop_inner_mpa = 300 }")]);
    let found = search_with(&design, &SearchMethod::default());
    let Status::Infeasible { fighting, least_violation } = &found.outcome.status else {
        panic!("{:?}", found.outcome.status)
    };
    let names: Vec<&str> = fighting.iter().map(|i| found.names.limits[*i].as_str()).collect();
    assert_eq!(names, ["hoop-inner"], "one limit alone, no fight");
    assert!(*least_violation > 0.5 && !found.feasible());
    let told = relief(&design, &found.problem, &found.outcome, &Desk::new(&Follow::nobody(), &mut Forgetful));
    assert_eq!((told.freed.len(), told.other_limits.as_slice()), (0, ["hoop-inner".to_owned()].as_slice()));
}

#[test]
fn nothing_that_moves_is_said_at_once() {
    let design = changed(
        HUANG,
        &[
            ("law = \"roller\"\nroller_coefficient = 3.944e-5 ", "law = \"elastic\" "),
            ("[sprags]\n", "[sprags]\nflanks = { rear_mm = 2.525, front_mm = 2.525 }\n"),
            (
                r#"scenarios = ["high-6", "low-10", "rated-45", "rated-45-at-speed"]"#,
                r#"scenarios = ["rated-45"]"#,
            ),
            (
                "  { name = \"r_i2_mm\", min = 3.6, max = 4.8 },\n",
                "  { name = \"width_mm\", min = 4.5, max = 5.5 },\n",
            ),
            ("  { name = \"r_i3_mm\", min = 3.6, max = 5.2 },\n", ""),
            ("  { name = \"centroid_x_mm\", min = -0.3, max = 0.5 },\n", ""),
            ("  { name = \"centroid_y_mm\", min = 0.2, max = 0.8 },\n", ""),
        ],
    );
    let found = search(
        &design,
        &SearchMethod::default(),
        Fidelity::default(),
        &Desk::new(&Follow::nobody(), &mut Forgetful),
    );
    assert!(matches!(found, Err(NoSearch::NothingMoves(names)) if names == ["width_mm"]));
}

/// Half of all evaluations of this search went into a flank that passes the inner arc, and six of its climbs ended there, below an
/// optimum beside it: as a limit it is followed.
#[test]
fn a_flank_in_the_way_of_an_arc_is_a_limit_and_no_wall() {
    let count = "  { name = \"count\", min = 21, max = 25 },\n";
    let at_25 = [("count = 23", "count = 25"), (count, "")];
    let found = search_with(
        &changed(PEER_E, &at_25),
        &SearchMethod { starts: 8, most_starts: 8, ..Default::default() },
    );
    assert!(found.names.limits.iter().any(|code| code == "flank-rear-outside"), "{:?}", found.names.limits);
    for climb in &found.starts {
        assert_ne!(climb.ended, Ok(Status::Stalled(Cause::FailingRegion)), "{climb:?}");
    }
    assert!(
        found.objective.1 > 0.45206 && found.evaluations < 800,
        "{:?} {}",
        found.objective,
        found.evaluations
    );
}

/// A slip margin that is raised is no limit of a climb; what a point says of itself counts it against the wanted one, as `check` does.
#[test]
fn a_raised_slip_margin_is_missed_where_check_misses_it() {
    for wanted in ["0.10", "2.0"] {
        let design = changed(HUANG, &[("slip_margin = 0.10", &format!("slip_margin = {wanted}"))]);
        let problem = problem(&design);
        let start: Vec<f64> = task(&design).variables.iter().map(|v| v.start).collect();
        let rows = problem.assess_at(&start).unwrap().rows;
        let worst = rows.iter().min_by(|a, b| a.margin().total_cmp(&b.margin())).unwrap();
        let missed = problem.missed(&problem.evaluate(&start).unwrap());
        assert!((missed - (-worst.margin()).max(0.0)).abs() < 1e-12, "{wanted}: {missed}, {}", worst.code());
        // The start of that design does not keep contact.
        let row = sprag_design::sweep::Sweep::of(&design, &Default::default()).unwrap().row(start);
        let (_, left) = row.deciding().unwrap();
        assert!(!row.feasible() && (left - worst.margin()).abs() < 1e-5, "{wanted}: {left}");
        assert_eq!(worst.is_slip(), wanted == "2.0");
    }
}
