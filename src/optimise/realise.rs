//! Flanks that put the centroid where a search wants it, or the nearest that any flanks can.
//!
//! Four numbers shape the flanks (distance and lean of each), two say where the centroid is to be: where it can be
//! reached there are many sprags that do, and the one whose mass is nearest to the given mass is taken.

use super::desk::Desk;
use super::driver::maximise_least_margin;
use super::evaluate::{Evaluate, Evaluation, NoEvaluation};
use super::influence::Influence;
use super::journal::SearchRun;
use super::outcome::Outcome;
use super::problem::{Assessment, ClutchProblem};
use super::search::{NoSearch, Search, Variable, as_checked, search_problem};
use super::settings::Settings;
use super::smooth::ROOM as ROOM_LEFT;
use super::starts::SearchMethod;
use crate::design::{Design, Optimize, OptimizeVariable};
use crate::file::{EditError, other_variables, with_flanks};
use crate::margin::load_state;
use crate::numeric::sobol::sobol;
use crate::profile::Flanks;
use crate::profile::{MassProperties, Outline, Profile, STEEPEST_RAD, clearances_m};
use rayon::prelude::*;

/// Neighbours keep clear by this at least, mm: a choice, above what rounding of the file leaves.
const CLEAR_MM: f64 = 1e-3;
/// A centroid this near to the wanted one is there, mm.
const THERE_MM: f64 = 1e-6;
/// Points of the box of flanks that are looked at for starts, and climbs from the best of them.
const LOOKS: u32 = 4096;
const CLIMBS: usize = 6;
/// Range of a flank's half width about the one found, for the search that follows.
const ROOM: f64 = 0.35;

/// The best that flanks can do for a centroid.
#[derive(Debug, Clone, PartialEq)]
pub struct Nearest {
    /// Flanks.
    pub flanks: Flanks,
    /// Centroid wanted, body frame, m.
    pub wanted_m: [f64; 2],
    /// What the sprag weighs with these flanks, with its centroid.
    pub mass: MassProperties,
    /// Given mass, kg, and inertia, kg m^2.
    pub given: (f64, f64),
    /// From the wanted centroid, m; 0 to rounding where it is reached.
    pub distance_m: f64,
}

impl Nearest {
    /// Whether the centroid is where it was wanted.
    pub fn reached(&self) -> bool {
        self.distance_m <= 2.0 * THERE_MM * 1e-3
    }
}

/// A wanted centroid made real.
#[derive(Debug, Clone)]
pub struct Realised {
    /// Flanks and what comes with them.
    pub nearest: Nearest,
    /// All margins and the objective of the clutch with these flanks, all else as the search left it.
    pub assessed: Assessment,
    /// The objective there, in its own unit.
    pub objective: f64,
    /// Design file with these flanks.
    pub file: String,
    /// The clutch that can be made: the search carried on with the flanks as variables in place of the centroid.
    pub made: Box<Search>,
    /// Whether that search was begun; else `made` stands where the nearest flanks are.
    pub searched: bool,
}

/// Flanks as a vector: half widths in mm, leans in rad.
struct FlankProblem {
    profile: Profile,
    count: usize,
    /// Rotations of the body at which neighbours are looked at, rad.
    rotations: [f64; 2],
    wanted_m: [f64; 2],
    given_mass_kg: f64,
    length_m: f64,
    density_kg_m3: f64,
    /// Whether the centroid is to be met, and the mass to be kept, or the distance to be made small.
    exact: bool,
}

fn flanks_of(x: &[f64]) -> Flanks {
    Flanks { rear_tilt_rad: x[2], front_tilt_rad: x[3], ..Flanks::parallel(x[0] * 1e-3, x[1] * 1e-3) }
}

impl FlankProblem {
    fn weigh(&self, x: &[f64]) -> Result<(Outline, MassProperties), NoEvaluation> {
        let outline = Outline::closed(&self.profile, &flanks_of(x))
            .map_err(|e| NoEvaluation::Refused(e.to_string()))?;
        let mass = outline.mass_properties(self.length_m, self.density_kg_m3);
        Ok((outline, mass))
    }

    /// (x, y) from the wanted centroid, mm.
    fn miss_mm(&self, mass: &MassProperties) -> [f64; 2] {
        [0, 1].map(|i| (mass.centroid_m[i] - self.wanted_m[i]) * 1e3)
    }
}

impl Evaluate for FlankProblem {
    fn evaluate(&self, x: &[f64]) -> Result<Evaluation, NoEvaluation> {
        let (outline, mass) = self.weigh(x)?;
        let [dx, dy] = self.miss_mm(&mass);
        let oc_e = self.profile.outer_centre_distance_m;
        let clearance_m = clearances_m(&outline, self.count);
        let clear = self.rotations.map(|rotation| clearance_m(oc_e, rotation) * 1e3 - CLEAR_MM);
        let heavier = mass.mass_kg / self.given_mass_kg - 1.0;
        let (objectives, mut limits) = if self.exact {
            (vec![heavier, -heavier], vec![THERE_MM - dx, THERE_MM + dx, THERE_MM - dy, THERE_MM + dy])
        } else {
            (vec![-(dx * dx + dy * dy)], Vec::new())
        };
        let room =
            Outline::room(&self.profile, &flanks_of(x)).map_err(|e| NoEvaluation::Refused(e.to_string()))?;
        limits.extend(room.into_iter().flatten().map(|left| left - ROOM_LEFT));
        limits.extend(clear);
        Ok(Evaluation { objectives, limits, tie_break: 0.0 })
    }
}

/// Flanks for the centroid of `found`'s optimum, and the search carried on with them; `None` where the centroid was no
/// variable or the optimum cannot be put together.
///
/// # Errors
/// [`NoSearch`] where no flanks at all close the profile, or the clutch with the nearest has no margins.
pub fn realise(
    found: &Search,
    task: &Optimize,
    method: &SearchMethod,
    desk: &Desk,
) -> Result<Option<Realised>, NoSearch> {
    if !found.wants_centroid() {
        return Ok(None);
    }
    let fail = |e: String| NoSearch::Start(NoEvaluation::Refused(e));
    let optimum = found.problem.parsed(&found.file).map_err(NoSearch::Start)?;
    desk.begins("flanks for the centroid");
    let (nearest, ranges) = nearest(&optimum).map_err(fail)?;
    let text = with_flanks(&found.file, &nearest.flanks).map_err(|e| fail(e.to_string()))?;
    let others: Vec<String> = found.searched.iter().filter(|n| !is_centroid(n)).cloned().collect();
    let x: Vec<f64> = found
        .searched
        .iter()
        .zip(&found.outcome.x)
        .filter(|(n, _)| !is_centroid(n))
        .map(|(_, x)| *x)
        .collect();
    let joint = joint_task(task, found, &nearest.flanks, &ranges);
    let text = with_flank_variables(&text, &joint).map_err(|e| fail(e.to_string()))?;
    let problem = found.problem.on(text.clone()).over(others);
    let full = problem.at_fidelity(problem.fidelity().sharper());
    let assessed = full.assess_at(&x).map_err(NoSearch::Start)?;
    let objective = full.value(&assessed, 0);
    desk.begins("search with flanks in place of the centroid");
    let problem = problem.over(joint.variables.iter().map(|v| v.name.clone()).collect());
    let (mut made, searched) = match search_problem(&problem, &joint, &method.carried_on(), desk) {
        Ok(search) => (search, true),
        Err(_) => (standing(found, &problem, &joint)?, false),
    };
    // Whole numbers stay as they were found.
    let whole = |name: &String| task.variables.iter().any(|v| v.whole && v.name == *name);
    made.variables.splice(0..0, found.variables.iter().filter(|v| whole(&v.name)).cloned());
    Ok(Some(Realised { nearest, assessed, objective, file: text, made: Box::new(made), searched }))
}

/// A search with flanks that was not begun: its start as the answer.
fn standing(found: &Search, problem: &ClutchProblem, joint: &Optimize) -> Result<Search, NoSearch> {
    let variables: Vec<Variable> = joint.variables.iter().map(Variable::at_start).collect();
    let x: Vec<f64> = variables.iter().map(|v| v.start).collect();
    let as_searched = problem.assess_at(&x).map_err(NoSearch::Start)?;
    let mut best =
        problem.at_fidelity(problem.fidelity().sharper()).assess_at(&x).map_err(NoSearch::Start)?;
    best.rows.extend(problem.besides(&x));
    let file =
        problem.finished_file(&x).map_err(|e| NoSearch::Start(NoEvaluation::Refused(e.to_string())))?;
    let (after, before) = (problem.value(&best, 0), problem.value(&as_searched, 0));
    let evaluation = problem.evaluation(&as_searched);
    Ok(Search {
        names: problem.names(&as_searched),
        start: as_checked(best.rows.clone()),
        objective: (after, after),
        objective_error: (after - before).abs(),
        best: as_checked(best.rows),
        as_searched: as_checked(as_searched.rows),
        influence: Influence::default(),
        continuous: Vec::new(),
        sensitivity: None,
        prices: Vec::new(),
        searched: variables.iter().map(|v| v.name.clone()).collect(),
        starts: Vec::new(),
        branches: Vec::new(),
        outcome: Outcome::stopped_at(x, evaluation),
        variables,
        file,
        problem: problem.clone(),
        evaluations: 2,
        derivatives: 0,
        ..found.clone()
    })
}

/// Whether a variable is a coordinate of the sprag's centroid.
pub fn is_centroid(name: &str) -> bool {
    name.starts_with("centroid_") || name.starts_with("sprags.centroid.")
}

/// The nearest flanks, and bounds (mm, rad) of the box they were sought in.
fn nearest(optimum: &Design) -> Result<(Nearest, [(f64, f64); 4]), String> {
    let clutch = &optimum.clutch;
    let sprags = &clutch.sprags;
    let state = load_state(optimum).map_err(|e| e.to_string())?;
    let peak = optimum.limits.peak_torque_nm.and_then(|t| state.curve.at_torque(t));
    let loaded =
        peak.and_then(|p| state.curve.closure_at_normal(p.normal_inner_n)).map_or(0.0, |(_, c)| c.rotation.v);
    let mut problem = FlankProblem {
        profile: state.profile.clone(),
        count: sprags.count,
        rotations: [0.0, loaded],
        wanted_m: sprags.centroid_m,
        given_mass_kg: sprags.mass_kg,
        length_m: sprags.length_m,
        density_kg_m3: clutch.materials.sprag.density_kg_m3,
        exact: false,
    };
    let widest = sprags.outer_radius_m * 1e3;
    let ranges = [
        (0.05 * widest, widest),
        (0.05 * widest, widest),
        (-STEEPEST_RAD, STEEPEST_RAD),
        (-STEEPEST_RAD, STEEPEST_RAD),
    ];
    let (lo, hi): (Vec<f64>, Vec<f64>) = ranges.iter().copied().unzip();
    let seed = 1;
    let point = |i: u32| -> Vec<f64> {
        (0..4).map(|d| lo[d] + sobol(u64::from(i), d, seed) * (hi[d] - lo[d])).collect()
    };
    let mut looks: Vec<(f64, f64, Vec<f64>)> = (0..LOOKS)
        .into_par_iter()
        .filter_map(|i| {
            let x = point(i);
            let e = problem.evaluate(&x).ok()?;
            Some((e.violation(), -e.least_margin(), x))
        })
        .collect();
    // Clear of the neighbours first, then near.
    looks.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    if looks.is_empty() {
        return Err("no straight flanks close the optimum's profile".to_owned());
    }
    let settings = Settings { max_evaluations: 4000, ..Settings::default() };
    let climb = |problem: &FlankProblem, from: &[f64]| {
        maximise_least_margin(problem, from, &lo, &hi, &settings, SearchRun::default()).ok()
    };
    let near = |problem: &FlankProblem, x: &[f64]| -> Option<f64> {
        let e = problem.evaluate(x).ok()?;
        let (_, mass) = problem.weigh(x).ok()?;
        let [dx, dy] = problem.miss_mm(&mass);
        (e.limits[e.limits.len() - 6..].iter().all(|c| *c >= -1e-8)).then(|| dx.hypot(dy))
    };
    looks.truncate(CLIMBS);
    let ends: Vec<_> = looks
        .par_iter()
        .with_max_len(1)
        .filter_map(|(_, _, from)| climb(&problem, from).and_then(|o| Some((near(&problem, &o.x)?, o.x))))
        .collect();
    let Some((_, mut x)) = ends.into_iter().min_by(|a, b| a.0.total_cmp(&b.0)) else {
        return Err("no straight flanks keep the sprags clear of their neighbours".to_owned());
    };
    // Near enough that it may be met exactly: then by the sprag whose mass is nearest to the given one.
    problem.exact = true;
    let exact = climb(&problem, &x).filter(|o| o.evaluation.violation() <= settings.violation_tolerance);
    if let Some(outcome) = exact {
        x = outcome.x;
    }
    let (_, mass) = problem.weigh(&x).map_err(|e| e.to_string())?;
    let [dx, dy] = problem.miss_mm(&mass);
    Ok((
        Nearest {
            flanks: flanks_of(&x),
            wanted_m: sprags.centroid_m,
            mass,
            given: (sprags.mass_kg, sprags.inertia_kg_m2),
            distance_m: dx.hypot(dy) * 1e-3,
        },
        ranges,
    ))
}

/// The task with the flanks in place of the centroid, starting where they are.
fn joint_task(task: &Optimize, found: &Search, flanks: &Flanks, ranges: &[(f64, f64); 4]) -> Optimize {
    let mut variables: Vec<OptimizeVariable> = task
        .variables
        .iter()
        .filter(|v| !is_centroid(&v.name) && !is_flank(&v.name) && !v.whole)
        .cloned()
        .map(|v| {
            let start = found.variables.iter().find(|f| f.name == v.name).map_or(v.start, |f| f.best);
            OptimizeVariable { given: start, start, ..v }
        })
        .collect();
    let starts = [flanks.rear_m * 1e3, flanks.front_m * 1e3, flanks.rear_tilt_rad, flanks.front_tilt_rad];
    let names = ["flank_rear_mm", "flank_front_mm", "flank_rear_tilt_rad", "flank_front_tilt_rad"];
    for (i, (name, start)) in names.into_iter().zip(starts).enumerate() {
        let (least, most) = if i < 2 { (start * (1.0 - ROOM), start * (1.0 + ROOM)) } else { ranges[i] };
        variables.push(OptimizeVariable {
            name: name.to_owned(),
            min: least,
            max: most,
            given: start,
            start,
            whole: false,
            links: Vec::new(),
        });
    }
    Optimize { variables, ..task.clone() }
}

/// `[optimize]` variables of the centroid give way to the flanks, so that the file can be searched again.
fn with_flank_variables(text: &str, joint: &Optimize) -> Result<String, EditError> {
    // Bounds of lengths to whole micrometres, outwards.
    let outwards = |v: &OptimizeVariable| match v.name.ends_with("_mm") {
        true => ((v.min * 1e3).floor() / 1e3, (v.max * 1e3).ceil() / 1e3),
        false => (v.min, v.max),
    };
    let flanks: Vec<(&str, (f64, f64))> = joint
        .variables
        .iter()
        .filter(|v| is_flank(&v.name))
        .map(|v| (v.name.as_str(), outwards(v)))
        .collect();
    other_variables(text, &|name| is_centroid(name) || is_flank(name), &flanks)
}

fn is_flank(name: &str) -> bool {
    name.starts_with("flank_") || name.starts_with("sprags.flanks.")
}
