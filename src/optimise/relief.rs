//! Where nothing in the box is feasible: by how much the question would have to be easier.

use super::desk::Desk;
use super::outcome::Outcome;
use super::problem::ClutchProblem;
use crate::clutch::ScenarioKind;
use crate::design::Design;
use crate::file::with_keys;
use crate::margin::Margin;
use serde::Serialize;

/// Factor between looks while a value that frees is sought.
const STRIDE: f64 = 1.5;
/// Looks at most: the value grows or falls by a factor of 130.
const LOOKS: usize = 12;
/// Halvings once one is found: good to 1.5^(1/256), 0.16 %.
const HALVINGS: usize = 8;
/// Where a value is 0 the first look, in its unit: a hundredth of Table 1's damping.
const FIRST: f64 = 1e-3;

/// One parameter of the question that was turned, all others and the profile held.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Freed {
    /// Scenario that does not hold.
    pub scenario: String,
    /// Dotted path of the key.
    pub key: String,
    /// What it is, in words.
    pub what: &'static str,
    /// Unit.
    pub unit: &'static str,
    /// Value in the file.
    pub given: f64,
    /// Value nearest to it on a geometric ladder of 1.5, refined to 0.2 %, with which the scenario's margins hold.
    pub needed: Option<f64>,
    /// Farthest value looked at.
    pub tried_to: f64,
}

/// What would free an infeasible problem, with the profile of least violation.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Relief {
    /// Each parameter of each scenario that does not hold.
    pub freed: Vec<Freed>,
    /// Rows that do not hold and belong to no scenario.
    pub other_limits: Vec<String>,
    /// Evaluations of one scenario each.
    pub evaluations: usize,
}

/// Looks for the least preload, abutment stiffness and damping with which the scenarios that fail at `outcome.x` hold.
pub fn relief(design: &Design, problem: &ClutchProblem, outcome: &Outcome, desk: &Desk) -> Relief {
    let mut told = Relief::default();
    let (Ok(text), Ok(assessed)) = (problem.file_at(&outcome.x), problem.assess_at(&outcome.x)) else {
        return told;
    };
    desk.begins("what would free it");
    let failing = |m: &&Margin| !problem.held(m);
    let of_scene = |m: &Margin, name: &str| m.scene.as_deref() == Some(name);
    let rows = || assessed.rows.iter().filter(failing);
    told.other_limits =
        rows().filter(|m| !design.scenarios.iter().any(|s| of_scene(m, &s.name))).map(Margin::code).collect();
    for (i, scene) in design.scenarios.iter().enumerate() {
        if !rows().any(|m| of_scene(m, &scene.name)) {
            continue;
        }
        let alone = problem.for_scenario(&scene.name);
        let mut holds = |key: &str, value: f64| {
            told.evaluations += 1;
            let changed = with_keys(&text, &[(key, value)]).ok()?;
            let found = alone.assess(&alone.parsed(&changed).ok()?).ok()?;
            Some(found.rows.iter().filter(|m| of_scene(m, &scene.name)).all(|m| alone.held(m)))
        };
        let mut turn = |key: String, what, unit, given: f64, ways: &[f64]| {
            let mut best =
                Freed { scenario: scene.name.clone(), key, what, unit, given, needed: None, tried_to: given };
            for &way in ways {
                let (mut before, mut value) = (given, if given == 0.0 { FIRST } else { given * way });
                for _ in 0..LOOKS {
                    best.tried_to = value;
                    if desk.stopped() {
                        return best;
                    }
                    match holds(&best.key, value) {
                        Some(true) => {
                            best.needed = Some(narrowed(&mut holds, &best.key, before, value));
                            return best;
                        }
                        Some(false) => (before, value) = (value, value * way),
                        None => break,
                    }
                }
            }
            best
        };
        let path = |key: &str| format!("scenarios[{i}].{key}");
        if let ScenarioKind::TorsionalExcitation { preload_nm, abutment_stiffness_nm_per_rad, .. }
        | ScenarioKind::Transient { preload_nm, abutment_stiffness_nm_per_rad, .. } = scene.kind
        {
            let (up, both) = ([STRIDE], [STRIDE, 1.0 / STRIDE]);
            let preload = turn(path("preload_nm"), "preload", "Nm", preload_nm, &up);
            let key = path("abutment_stiffness_nm_per_rad");
            let abutment = turn(key, "abutment stiffness", "Nm/rad", abutment_stiffness_nm_per_rad, &both);
            let damping = scene.clutch.races.viscous_damping_nm_s_per_rad;
            let key = "races.viscous_damping_nm_s_per_rad".to_owned();
            let damping = turn(key, "viscous damping between the races", "Nm s/rad", damping, &up);
            told.freed.extend([preload, abutment, damping]);
        }
    }
    told
}

/// The value nearest to `fails` that still holds, by halving the ratio.
fn narrowed(
    holds: &mut impl FnMut(&str, f64) -> Option<bool>,
    key: &str,
    mut fails: f64,
    mut held: f64,
) -> f64 {
    for _ in 0..HALVINGS {
        let middle = if fails > 0.0 { (fails * held).sqrt() } else { 0.5 * (fails + held) };
        if holds(key, middle) == Some(true) {
            held = middle;
        } else {
            fails = middle;
        }
    }
    held
}
