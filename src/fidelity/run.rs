//! A scene run by its plan, or in full.

use super::plan::{Plan, Term, plan};
use crate::clutch::Scenario;
use crate::dynamics::{Jump, Stop};
use crate::scenario::{
    NoScenario, Prepared, Settings, Simulation, Terms, prepare, simulate_prepared, stand_by_left_out_s,
};
use crate::wedge::asks_for_slices;

/// A simulation with what it left out.
#[derive(Debug, Clone)]
pub struct Planned {
    /// Model and start that were run.
    pub prepared: Prepared,
    /// What happened.
    pub simulation: Simulation,
    /// Terms left out.
    pub left_out: Vec<Term>,
    /// Terms that were looked at and kept.
    pub kept: Vec<Term>,
}

/// Simulate `scenario` with these terms of the equations.
///
/// # Errors
/// [`NoScenario`] where the scenario has no start.
pub fn simulate(scenario: &Scenario, settings: &Settings, terms: Terms) -> Result<Planned, NoScenario> {
    let whole = |settings: &Settings| {
        let prepared = prepare(scenario)?;
        let simulation = simulate_prepared(&prepared, settings, Terms::All);
        let left_out =
            simulation.jumps.iter().map(repeated).chain(stood_by(&simulation, &prepared)).collect();
        Ok(Planned { prepared, simulation, left_out, kept: Vec::new() })
    };
    if terms == Terms::All {
        return whole(&Settings { every_period: true, ..settings.clone() });
    }
    // What a shortened curve does not carry, the whole one may.
    let Ok((Plan { reduction, mut left_out, mut kept }, prepared)) = plan(scenario, None) else {
        return whole(settings);
    };
    let simulation = simulate_prepared(&prepared, settings, Terms::Felt);
    if simulation.rolled {
        left_out.push(friction_law(&simulation, &prepared));
    }
    left_out.extend(simulation.jumps.iter().map(repeated));
    left_out.extend(stood_by(&simulation, &prepared));
    if reduction.reach_nm.is_some() && reached_the_end(&simulation) {
        // The shortened curve was too short after all.
        let all = Planned { kept, ..whole(settings)? };
        return Ok(all);
    }
    if asks_for_slices(&scenario.clutch) && settings.samples == 0 {
        left_out.push(Term::free(
            "slices over time",
            "no history was asked for, so no pressure along the length is",
        ));
    }
    kept.retain(|k| left_out.iter().all(|l| l.term != k.term));
    Ok(Planned { prepared, simulation, left_out, kept })
}

/// Whether the run, or the rolling run beside it, ended where the curve does: a run that met a limit of work would meet it
/// again on the whole curve.
fn reached_the_end(s: &Simulation) -> bool {
    s.stop == Stop::CurveEnd || s.demand.is_some_and(|d| d.overloaded)
}

/// Periods that were not integrated.
fn repeated(jump: &Jump) -> Term {
    let ends_s = jump.from_s + jump.periods as f64 * jump.period_s;
    let why = format!(
        "the motion repeats: {} periods, from {:.6} s to {ends_s:.6} s, are each the one before, and are added",
        jump.periods, jump.from_s
    );
    let cost = format!("at most {:.1e} of the natural size of any figure", jump.error);
    Term { term: "whole periods that repeat", why, cost_rad: Some(jump.error), cost }
}

/// What trials of friction did not stand by.
fn stood_by(s: &Simulation, prepared: &Prepared) -> Option<Term> {
    let left_out_s = stand_by_left_out_s(&prepared.model, &s.jumps);
    (left_out_s > 0.0 && s.demand.is_some_and(|d| d.by_bisection)).then(|| Term {
        term: "stand-by of the trials of friction",
        why: format!(
            "the static friction needed is bisected by runs that stand by {left_out_s:.3} s less: the swing of the sprags \
             has settled before"
        ),
        cost_rad: None,
        cost: "that of another phase of the swing when the torque comes, and of what the swing grows or decays in between: \
               2e-6 of the friction for the clutch of Huang, Liu and Zhao, 0.2 s in place of 10 s"
            .to_owned(),
    })
}

fn friction_law(s: &Simulation, prepared: &Prepared) -> Term {
    let needs = s.demand.and_then(|d| d.required_friction).unwrap_or(0.0);
    let why = format!(
        "stick needs {needs:.4} of the static friction of {:.4}: the pure-rolling run is itself the run",
        prepared.model.friction.static_
    );
    Term { cost: "none: the same equations".to_owned(), ..Term::free("friction law (12) in slip", &why) }
}
