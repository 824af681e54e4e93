//! Counts and errors behind reports/cost.html that the command does not print, as JSON: read by reports/cost.py.
//!
//! ```text
//! cost counts FILE        right-hand sides of one evaluation, scene by scene; points on standard input as for `evaluate`
//! cost curve FILE         error and time of the wedge curve at rest: both efforts, and tables of exact equilibria
//! cost slopes FILE K N    N evaluations of a search at the start and as often derivatives along the first K variables, for a
//!                         counter of instructions
//! cost course FILE        the course of the best feasible value of a search: evaluations, derivatives, value; a line for each better one
//! cost robust FILE        the same of a robust search from one climb: the points at which its climbs end, each with a look at every corner
//! cost build FILE HOW N   N curves and nothing else, for a counter of instructions; HOW: full, search
//! ```

use sprag_design::answer::search::{MOST_STARTS, STARTS};
use sprag_design::margin::load_state_at;
use sprag_design::optimise::{
    ClutchProblem, Desk, Entry, Evaluate, Fidelity, Forgetful, ProblemId, Record, SearchMethod, Settings,
    robust, spread,
};
use sprag_design::scenario::{self, demand_quickly};
use sprag_design::wedge::{Closure, Effort};
use sprag_design::{Design, Follow, Profile, WedgeCurve, fidelity, search};
use std::error::Error;
use std::io::BufRead;
use std::path::Path;
use std::time::Instant;

/// Equilibria at which curves are held against exact ones, and the least load of them as a part of the largest.
const LOOKS: usize = 400;
const LEAST: f64 = 0.01;
/// Rows of the tables that anybody would make.
const ROWS: [usize; 6] = [25, 50, 100, 200, 400, 800];

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    match words[..] {
        ["counts", file] => counts(&Design::read(Path::new(file))?),
        ["curve", file] => errors(&Design::read(Path::new(file))?),
        ["slopes", file, along, times] => {
            slopes(&Design::read(Path::new(file))?, along.parse()?, times.parse()?)
        }
        ["course", file] => course(&Design::read(Path::new(file))?),
        ["robust", file] => robust_course(&Design::read(Path::new(file))?),
        ["build", file, how, times] => {
            let design = Design::read(Path::new(file))?;
            let profile = design.clutch.profile()?;
            for _ in 0..times.parse()? {
                std::hint::black_box(curve(&design, &profile, effort(how)?)?);
            }
            Ok(())
        }
        _ => {
            Err("cost counts FILE | curve FILE | slopes FILE K N | course FILE | robust FILE | build FILE full|search N"
                .into())
        }
    }
}

fn effort(how: &str) -> Result<Effort, String> {
    match how {
        "full" => Ok(Effort::Full),
        "search" => Ok(Effort::Search),
        _ => Err(format!("no effort {how}: full, search")),
    }
}

fn curve(design: &Design, profile: &Profile, effort: Effort) -> Result<WedgeCurve, Box<dyn Error>> {
    Ok(WedgeCurve::build_reaching_at(&design.clutch, profile, 0.0, None, effort)?)
}

/// As an evaluation of a search goes through its scenes.
fn counts(design: &Design) -> Result<(), Box<dyn Error>> {
    let task = design.optimize.clone().ok_or("no table `optimize`")?;
    let problem = ClutchProblem::of_task(design, &task, false);
    for line in std::io::stdin().lock().lines() {
        let x: Vec<f64> = serde_json::from_str(&line?)?;
        let at = problem.design_at(&x).map_err(|e| e.to_string())?;
        let state = load_state_at(&at, Effort::Search)?;
        let mut scenes = serde_json::Map::new();
        for scene in at.scenarios.iter().filter(|s| task.scenarios.contains(&s.name)) {
            let (_, prepared) = fidelity::plan_at(scene, Some(state.at_rest(&at)), Effort::Search)?;
            let found = demand_quickly(&prepared, &scenario::Settings::default());
            scenes.insert(scene.name.clone(), found.rhs_evaluations.into());
        }
        println!("{}", serde_json::Value::from(scenes));
    }
    Ok(())
}

fn slopes(design: &Design, along: usize, times: usize) -> Result<(), Box<dyn Error>> {
    let task = design.optimize.clone().ok_or("no table `optimize`")?;
    let problem = ClutchProblem::of_task(design, &task, false);
    let x: Vec<f64> = task.variables.iter().map(|v| v.start).collect();
    let moved = |i: usize| {
        let mut x = x.clone();
        x[i] += 1e-6 * (task.variables[i].max - task.variables[i].min);
        x
    };
    let beside: Vec<Vec<f64>> = (0..along.min(x.len())).map(moved).collect();
    for _ in 0..times {
        std::hint::black_box(problem.evaluate(&x).map_err(|e| e.to_string())?);
        if along > 0 {
            std::hint::black_box(problem.changes(&x, &beside));
        }
    }
    Ok(())
}

/// What a search asked for, as it went on.
#[derive(Default)]
struct Course {
    evaluations: usize,
    derivatives: usize,
    /// Where derivatives were taken: what is asked for twice is taken once.
    taken: Vec<(ProblemId, Vec<f64>)>,
    best: f64,
}

impl Record for Course {
    fn evaluated(&mut self, _: &ProblemId, entry: &Entry) {
        self.evaluations += 1;
        let Ok(found) = &entry.outcome else { return };
        if found.violation() <= Settings::default().violation_tolerance && found.least_margin() > self.best {
            self.best = found.least_margin();
            println!("[{}, {}, {}]", self.evaluations, self.derivatives, self.best);
        }
    }

    fn derived(&mut self, problem: &ProblemId, x: &[f64], along: usize) {
        let at = (problem.clone(), x.to_vec());
        if !self.taken.contains(&at) {
            self.taken.push(at);
            self.derivatives += along;
        }
    }
}

/// As `optimize` without flags searches, on one thread.
fn course(design: &Design) -> Result<(), Box<dyn Error>> {
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global()?;
    let seed = design.optimize.as_ref().ok_or("no table `optimize`")?.seed;
    let (starts, most_starts) = (STARTS, MOST_STARTS);
    let method = SearchMethod { starts, most_starts, seed, ..SearchMethod::default() };
    let mut course = Course { best: f64::NEG_INFINITY, ..Course::default() };
    search(design, &method, Fidelity::default(), &Desk::new(&Follow::default(), &mut course))?;
    Ok(())
}

/// As `optimize --robust --starts 1 --step-mm 0` searches. A point counts once all its corners are looked at, as with other optimisers.
fn robust_course(design: &Design) -> Result<(), Box<dyn Error>> {
    let seed = design.optimize.as_ref().ok_or("no table `optimize`")?.seed;
    let of = design.tolerances.as_ref().ok_or("no table `tolerances`")?;
    let method = SearchMethod { starts: 1, most_starts: 1, seed, ..SearchMethod::default() };
    let mut forgetful = Forgetful;
    let desk = Desk::new(&Follow::default(), &mut forgetful);
    let found = search(design, &method, Fidelity::default(), &desk)?;
    let (lo, hi) = found.bounds();
    let held = robust(&found.problem, &found.outcome.x, (&lo, &hi), 0.0, of, (0, seed), &method, &desk)?;
    let (mut looks, mut best) = (0, f64::NEG_INFINITY);
    for at in &held.passed {
        let made = spread(&found.problem, &at.x, of, (0, seed), &desk)?;
        looks += made.evaluations;
        if made.held() && made.objective.1 > best {
            best = made.objective.1;
            let (evaluations, derivatives) =
                (found.evaluations + at.evaluations + looks, found.derivatives + at.derivatives);
            println!("[{evaluations}, {derivatives}, {best}]");
        }
    }
    Ok(())
}

/// The least of 15 runs, s: where other programs run, a median is of interrupted ones.
fn timed<T>(mut run: impl FnMut() -> T) -> f64 {
    let once = |_| {
        let start = Instant::now();
        std::hint::black_box(run());
        start.elapsed().as_secs_f64()
    };
    (0..15).map(once).fold(f64::INFINITY, f64::min)
}

fn errors(design: &Design) -> Result<(), Box<dyn Error>> {
    let profile = design.clutch.profile()?;
    let full = curve(design, &profile, Effort::Full)?;
    let most = full.arc_end_n(full.arc_count() - 1);
    let exact: Vec<(usize, Closure)> = (0..LOOKS)
        .filter_map(|i| {
            full.closure_at_normal(most * (LEAST + (1.0 - LEAST) * (i as f64 + 0.5) / LOOKS as f64))
        })
        .collect();
    let worst = |off: &dyn Fn(usize, &Closure) -> f64| {
        exact.iter().map(|(k, c)| off(*k, c).abs()).fold(0.0, f64::max)
    };
    for (name, how) in [("full", Effort::Full), ("search", Effort::Search)] {
        let found = curve(design, &profile, how)?;
        let normal = worst(&|k, c| found.in_arc(k, c.alpha.v).n_bi / c.n_bi - 1.0);
        let windup =
            worst(&|k, c| found.in_arc(k, c.alpha.v).windup / full.in_arc(k, c.alpha.v).windup - 1.0);
        let time = timed(|| curve(design, &profile, how).is_ok());
        println!(
            "{}",
            serde_json::json!({ "how": name, "normal": normal, "windup": windup, "time_s": time })
        );
    }
    for rows in ROWS {
        let table = Table::of(&full, rows, most);
        let time = timed(|| Table::of(&full, rows, most));
        for (how, cubic) in [("linear", false), ("cubic", true)] {
            let normal = worst(&|k, c| table.at(k, c.alpha.v, cubic) / c.n_bi - 1.0);
            let closures = table.arcs.iter().map(Vec::len).sum::<usize>();
            println!(
                "{}",
                serde_json::json!({ "how": how, "closures": closures, "normal": normal, "time_s": time })
            );
        }
    }
    Ok(())
}

/// What anybody would make: exact equilibria at equal steps of N, arc by arc.
struct Table {
    /// (alpha, N, dN/dalpha) of each arc.
    arcs: Vec<Vec<[f64; 3]>>,
}

impl Table {
    fn of(curve: &WedgeCurve, rows: usize, most: f64) -> Self {
        let arcs = (0..curve.arc_count()).map(|k| {
            let from = if k == 0 { 0.5 * LEAST * most } else { curve.arc_end_n(k - 1) };
            let until = curve.arc_end_n(k);
            let own = ((rows as f64 * (until - from) / most).ceil() as usize).max(2);
            // An end belongs to two arcs: a hair inside it, this one is asked.
            let nodes = (0..=own).map(|i| {
                let n = from + (until - from) * i as f64 / own as f64;
                n.clamp(from * (1.0 + 1e-14), until * (1.0 - 1e-14))
            });
            nodes
                .filter_map(|n| curve.closure_at_normal(n))
                .map(|(_, c)| [c.alpha.v, c.n_bi, 1.0 / c.alpha.d])
                .collect()
        });
        Self { arcs: arcs.collect() }
    }

    /// N at `alpha`, by the straight line or by the cubic through values and slopes.
    fn at(&self, k: usize, alpha: f64, cubic: bool) -> f64 {
        let rows = &self.arcs[k];
        let next = rows.partition_point(|r| r[0] < alpha).clamp(1, rows.len() - 1);
        let ([a0, n0, d0], [a1, n1, d1]) = (rows[next - 1], rows[next]);
        let (h, t) = (a1 - a0, (alpha - a0) / (a1 - a0));
        if !cubic {
            return n0 + t * (n1 - n0);
        }
        let u = 1.0 - t;
        n0 * u * u * (1.0 + 2.0 * t) + n1 * t * t * (3.0 - 2.0 * t) + h * t * u * (u * d0 - t * d1)
    }
}
