//! The keys of `accuracy --json`.

use super::tables::{points, points_of};
use super::verdict::{WANTED_RAD, gains_over_published, winners};
use super::{AccuracyStudy, map};
use crate::accuracy::{CaseEnd, Halved, Judged, PARAMETERS, Precision};
use serde::Serialize;
use serde_json::{Map, Value, json};

/// Scenes with their points, and the map.
#[derive(Debug, Serialize)]
pub struct AccuracyBody {
    /// Error that is wanted, rad.
    pub wanted_error_rad: f64,
    /// Points of every method, scene by scene.
    pub scenes: Vec<Value>,
    /// Scenes without a start.
    pub without_start: Vec<Value>,
    /// The stability map.
    pub stability_map: Option<Value>,
}

impl AccuracyBody {
    pub(super) fn of(study: &AccuracyStudy<'_>) -> Self {
        let without = |(name, why): &(String, String)| json!({ "scenario": name, "why": why });
        Self {
            wanted_error_rad: WANTED_RAD,
            scenes: study.scenes.iter().map(scene).collect(),
            without_start: study.without_start.iter().map(without).collect(),
            stability_map: (!study.cases.is_empty()).then(|| stability(study)),
        }
    }
}

fn scene(s: &Precision) -> Value {
    let cheapest = winners(s).into_iter().map(|(m, p)| match p {
        Some(p) => points([(s, m, p)]).object(),
        None => json!({ "method": m.key(), "reached": false }),
    });
    json!({
        "scenario": s.scene,
        "reference": {
            "theta_inner_end_rad": s.theta_inner_rad,
            "slip_margin": s.slip_margin,
            "events": s.events,
            "theta_inner_error_rad": s.reference_error[0],
            "slip_margin_error": s.reference_error[1],
        },
        "prepare_time_s": { "full": s.prepare_s[0], "reduced": s.prepare_s[1] },
        "reduced_without": s.left_out,
        "points": points(points_of(s)).objects(),
        "cheapest": cheapest.collect::<Vec<_>>(),
        "published_step_over_one_run": gains_over_published(s).map(|g| g[0]),
    })
}

fn stability(study: &AccuracyStudy<'_>) -> Value {
    let outcomes: Map<String, Value> =
        map::by_outcome(study).into_iter().map(|(name, c)| (name.to_owned(), json!(c.len()))).collect();
    let most = |f: fn(&Judged) -> u64| study.cases.iter().map(f).max();
    let mut all = json!({
        "seed": study.seed,
        "cases": study.cases.len(),
        "tolerance": study.limit.tolerance,
        "most_steps_per_run": study.limit.most_steps,
        "most_events_per_run": study.limit.most_events,
        "run_time_s": study.map_time_s,
        "outcomes": outcomes,
        "not_converged": study.cases.iter().filter(|c| !c.converged).count(),
        "worst": { "events": most(|c| c.events), "steps": most(|c| c.steps), "rhs_evaluations": most(|c| c.rhs_evaluations) },
        "at_half_the_tolerance": Halved::of(&study.cases),
    });
    if let Some(keys) = all.as_object_mut() {
        for (key, _, is) in map::REMARKABLE {
            let list: Vec<Value> = study.cases.iter().filter(|c| is(c)).map(case).collect();
            keys.insert(key.to_owned(), list.into());
        }
    }
    all
}

fn case(c: &Judged) -> Value {
    let values = PARAMETERS.iter().zip(c.case.values);
    let parameters: Map<String, Value> = values.map(|(p, v)| (p.key.to_owned(), json!(v))).collect();
    json!({
        "case": c.case.number,
        "outcome": c.outcomes[0].name(),
        "outcome_at_half": CaseEnd::name(c.outcomes[1]),
        "theta_inner_end_rad": c.theta_inner_rad,
        "not_finite": c.not_finite,
        "time_reached_s": c.t_s,
        "events": c.events,
        "rhs_evaluations": c.rhs_evaluations,
        "fastest_rad_per_s": c.fastest_rad_s,
        "parameters": parameters,
    })
}
