//! What `optimize` found beside the optimum, for programs.

use super::optimize_relief::{alone_sentence, freed_sentence, loosened_sentence};
use super::optimize_story::{Story, sentence};
use crate::margin::Margin;
use crate::optimise::{
    Alone, Branch, Freed, Front, Loosened, Price, PriceKind, Realised, Relief, Robust, Start, Status,
};
use serde_json::{Value, json};

impl Story {
    /// Keys of the answer for programs, beside those of the optimum itself.
    pub fn json(&self) -> serde_json::Map<String, Value> {
        let found = &self.found;
        let mut map = serde_json::Map::new();
        let ended = |e: &Result<Status, String>| match e {
            Ok(status) => json!(status.name()),
            Err(why) => json!(why),
        };
        let or_null = |v: f64| if v.is_finite() { json!(v) } else { Value::Null };
        let start = |s: &Start| {
            json!({ "from": s.from, "ended": ended(&s.ended), "least_scaled_objective": or_null(s.least_margin),
                    "violation": or_null(s.violation), "evaluations": s.evaluations })
        };
        map.insert("starts".into(), found.starts.iter().map(start).collect());
        let optima = found.optima;
        let known = json!({ "climbs": optima.climbs, "seen": optima.seen, "expected": optima.expected() });
        map.insert("optima".into(), known);
        let branch = |b: &Branch| {
            let values: serde_json::Map<_, _> = b.values.iter().map(|(n, v)| (n.clone(), json!(v))).collect();
            json!({ "values": values, "ended": ended(&b.ended), "least_scaled_objective": or_null(b.least_margin),
                    "violation": or_null(b.violation), "evaluations": b.evaluations })
        };
        let whole: Vec<Value> = found.branches.iter().filter(|b| !b.values.is_empty()).map(branch).collect();
        map.insert("whole_numbers".into(), json!(whole));
        let price = |p: &Price| {
            let kind = match p.kind {
                PriceKind::Limit => "limit",
                PriceKind::Margin => "margin",
                PriceKind::Lower => "lower-bound",
                PriceKind::Upper => "upper-bound",
            };
            json!({ "of": p.of, "kind": kind, "value": p.value, "unit": p.unit, "gain_per_unit": p.gain_per_unit,
                    "sentence": sentence(found.aim, p) })
        };
        map.insert("prices".into(), found.prices.iter().map(price).collect());
        let sensitivities = found.sensitivity.as_ref().map(|s| {
            json!({ "variables": found.searched, "objectives": found.names.objectives, "limits": found.names.limits,
                    "d_objectives_per_range": s.objectives, "d_limits_per_range": s.limits })
        });
        map.insert("sensitivities".into(), json!(sensitivities));
        let change = |(full, searched): (&Margin, &Margin)| json!({ "code": full.code(), "change": full.margin() - searched.margin() });
        map.insert("change_in_full".into(), found.best.iter().zip(&found.as_searched).map(change).collect());
        map.insert("relief".into(), json!(self.relief.as_ref().map(|r| self.relief_json(r))));
        map.insert("realised".into(), json!(self.realised.as_ref().map(realised_json)));
        map.insert("tolerances".into(), json!(self.made.as_ref().map(robust_json)));
        let robust = self.robust.as_ref().map(|r| {
            let variables: serde_json::Map<_, _> =
                found.searched.iter().cloned().zip(r.x.iter().map(|x| json!(x))).collect();
            json!({ "variables": variables, "ended": self.robust_status(r).name(), "held_at": r.held_at, "rounds": r.rounds,
                    "evaluations": r.evaluations, "made": robust_json(&r.made) })
        });
        map.insert("robust".into(), json!(robust));
        map.insert("not_done".into(), json!(self.why));
        map
    }

    fn relief_json(&self, r: &Relief) -> Value {
        let freed = |f: &Freed| {
            json!({ "scenario": f.scenario, "key": f.key, "what": f.what, "unit": f.unit, "given": f.given,
                    "needed": f.needed, "tried_to": f.tried_to, "sentence": freed_sentence(f) })
        };
        let loosened = |l: &Loosened| {
            json!({ "key": l.key, "unit": l.unit, "given": l.given, "needed": l.needed, "tried_from": l.between.0,
                    "tried_to": l.between.1, "sentence": loosened_sentence(l) })
        };
        let alone = |a: &Alone| {
            let changes: serde_json::Map<_, _> =
                a.changes.iter().map(|(n, v)| (n.clone(), json!(v))).collect();
            json!({ "code": a.code, "margin": a.margin, "variables": changes, "sentence": alone_sentence(a) })
        };
        json!({ "freed": r.freed.iter().map(freed).collect::<Vec<_>>(), "other_limits": r.other_limits,
                "numbers": self.loosened.iter().map(loosened).collect::<Vec<_>>(),
                "limits_alone": self.alone.iter().map(alone).collect::<Vec<_>>(),
                "evaluations": r.evaluations + self.loosened.iter().map(|l| l.evaluations).sum::<usize>() })
    }

    /// The front, or the optimum as the only point of one.
    pub fn pareto(&self) -> Value {
        let point = |front: &Front, x: &[f64], values: &[f64]| {
            let named = |names: Vec<String>, values: &[f64]| -> serde_json::Map<String, Value> {
                names.into_iter().zip(values.iter().map(|v| json!(v))).collect()
            };
            json!({ "variables": named(front.variables.clone(), x),
                    "objectives": named(front.aims.iter().map(|a| a.name().to_owned()).collect(), values) })
        };
        match &self.front {
            Some(front) => front.points.iter().map(|p| point(front, &p.x, &p.values)).collect(),
            None => {
                let variables: serde_json::Map<_, _> =
                    self.found.variables.iter().map(|v| (v.name.clone(), json!(v.best))).collect();
                json!([{ "variables": variables, "objective": self.found.objective.1 }])
            }
        }
    }
}

fn realised_json(r: &Realised) -> Value {
    let n = &r.nearest;
    let f = &n.flanks;
    let rows = |rows: &[Margin]| -> Value {
        rows.iter().map(|m| json!({ "code": m.code(), "margin": m.margin() })).collect()
    };
    let search = r.search.as_ref().map(|s| {
        let variables: serde_json::Map<_, _> =
            s.variables.iter().map(|v| (v.name.clone(), json!(v.best))).collect();
        json!({ "variables": variables, "objective": s.objective.1, "feasible": s.feasible(),
                "status": s.outcome.status.name(), "evaluations": s.evaluations, "margins": rows(&s.best) })
    });
    json!({
        "reached": n.reached(),
        "distance_mm": n.distance_m * 1e3,
        "wanted_mm": n.wanted_m.map(|v| v * 1e3),
        "centroid_mm": n.mass.centroid_m.map(|v| v * 1e3),
        "flanks": { "rear_mm": f.rear_m * 1e3, "front_mm": f.front_m * 1e3,
                    "rear_tilt_rad": f.rear_tilt_rad, "front_tilt_rad": f.front_tilt_rad },
        "mass_kg": n.mass.mass_kg, "inertia_kg_m2": n.mass.inertia_kg_m2,
        "objective": r.objective, "margins": rows(&r.looked.rows),
        "searched_on": search,
    })
}

fn robust_json(r: &Robust) -> Value {
    let rows: Vec<Value> = r
        .spreads
        .iter()
        .map(|s| {
            json!({ "code": s.code, "nominal": s.nominal, "worst": s.worst, "worst_at": s.worst_at,
                    "p01": s.percentiles[0], "p05": s.percentiles[1], "p50": s.percentiles[2] })
        })
        .collect();
    let (nominal, worst, [p01, p05, p50]) = r.objective;
    json!({
        "objective": { "nominal": nominal, "worst": worst, "p01": p01, "p05": p05, "p50": p50 },
        "margins": rows, "corners": r.corners, "draws": r.draws.0, "impossible_draws": r.draws.1,
        "not_held": r.not_held.iter().map(|(code, at)| json!({ "code": code, "worst_at": at })).collect::<Vec<_>>(),
        "impossible_corners": r.impossible, "seed": r.seed, "yield": r.yield_share, "held": r.held(),
    })
}
