//! Which terms a scene cannot feel, before it runs.

use crate::clutch::Scenario;
use crate::scenario::{AtRest, NoScenario, Prepared, Reduction, prepare_reduced};
use crate::wedge::{AtSpeed, Effort};

/// One term, left out or kept.
#[derive(Debug, Clone, PartialEq)]
pub struct Term {
    /// The term.
    pub term: &'static str,
    /// Why it is left out, or kept.
    pub why: String,
    /// What leaving it out costs in theta_bi at the end, rad; `None`: known only as words.
    pub cost_rad: Option<f64>,
    /// The same in words.
    pub cost: String,
}

impl Term {
    pub(super) fn free(term: &'static str, why: &str) -> Self {
        Self { term, why: why.to_owned(), cost_rad: Some(0.0), cost: "none".to_owned() }
    }
}

/// What is decided before the run.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// What the model is built without.
    pub reduction: Reduction,
    /// Terms left out.
    pub left_out: Vec<Term>,
    /// Terms that were looked at and kept.
    pub kept: Vec<Term>,
}

/// Arcs are built for this many times the largest torque that acts from outside: a choice; a run that needs more
/// is repeated with all of them.
const REACH: f64 = 2.5;

/// Torque up to which arcs are built for `scenario`, N m; `None`: all of them are.
fn reach_nm(scenario: &Scenario) -> Option<f64> {
    // Torques of a drivetrain are not those of the scene.
    scenario.drivetrain.is_empty().then_some(REACH * scenario.largest_torque_nm())
}

/// The curves at speed that [`plan_at`] asks for, one at each speed, as far as the scene that reaches farthest; without those whose
/// speed a history decides.
pub fn curves_asked<'s>(scenes: impl Iterator<Item = &'s Scenario>) -> Vec<AtSpeed> {
    let asked = scenes
        .filter(|s| !s.kind.is_overrun())
        .map(|scenario| AtSpeed { speed_rad_s: scenario.mean_speed_rad_s(), reach_nm: reach_nm(scenario) });
    AtSpeed::farthest(asked.filter(|a| a.speed_rad_s != 0.0 && a.speed_rad_s.is_finite()))
}

/// Decide for `scenario`; `known`: a curve that need not be built again.
///
/// # Errors
/// [`NoScenario`] where the scenario has no start.
pub fn plan(scenario: &Scenario, known: Option<AtRest>) -> Result<(Plan, Prepared), NoScenario> {
    plan_at(scenario, known, Effort::Full)
}

/// The same with curves at `effort`.
///
/// # Errors
/// As [`plan`].
pub fn plan_at(
    scenario: &Scenario,
    known: Option<AtRest>,
    effort: Effort,
) -> Result<(Plan, Prepared), NoScenario> {
    let (torque, speed) = (scenario.largest_torque_nm(), scenario.mean_speed_rad_s());
    let mut reduction = Reduction { reach_nm: reach_nm(scenario), effort };
    let (mut left_out, mut kept) = (Vec::new(), Vec::new());
    if speed == 0.0 {
        left_out.push(Term::free("centrifugal growth of the races", "the scene is at rest"));
    }
    let prepared = prepare_reduced(scenario, &reduction, known)?;
    let all = scenario.clutch.sprags.inner_arcs.len();
    let built = prepared.model.curve.first_arc() + prepared.model.curve.arc_count();
    if prepared.model.curve.end().0 == crate::wedge::EndReason::NotBuilt {
        let why = format!("arcs {} to {all} lie beyond {:.1} Nm", built + 1, REACH * torque);
        left_out.push(Term::free("arcs that are never touched", &why));
    } else {
        reduction.reach_nm = None;
    }
    if prepared.duration_s > 0.0 {
        kept.push(inertia(scenario));
    }
    Ok((Plan { reduction, left_out, kept }, prepared))
}

/// The sprags' inertia beside that of the lighter race: it is in the equations anyway and costs no time in stick.
fn inertia(scenario: &Scenario) -> Term {
    let (s, r) = (&scenario.clutch.sprags, &scenario.clutch.races);
    let orbit = r.inner_radius_m.midpoint(r.outer_radius_m);
    let sprags = s.count as f64 * (s.mass_kg * orbit * orbit + s.inertia_kg_m2);
    let share = sprags / r.inner_inertia_kg_m2.min(r.outer_inertia_kg_m2);
    Term {
        term: "inertia of the sprags in stick",
        why: "leaving it out saves nothing: the sprags follow the races without a step of their own"
            .to_owned(),
        cost_rad: None,
        cost: format!(
            "it is {:.2} % of the lighter race's: natural frequencies {:.2} %",
            100.0 * share,
            50.0 * share
        ),
    }
}
