//! Which terms a scene cannot feel, before it runs.

use crate::design::{Scenario, ScenarioKind};
use crate::scenario::{NoScenario, Prepared, Reduction, Settings, prepare_reduced};

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
/// Above this mean speed nobody need ask whether rotation can be left out, rad/s.
const SLOW_RAD_S: f64 = 50.0;
/// How much a swing near resonance may raise a static error: a choice.
const AMPLIFIED: f64 = 10.0;

/// Decide for `scenario`.
///
/// # Errors
/// [`NoScenario`] where the scenario has no start.
pub fn plan(scenario: &Scenario, settings: &Settings) -> Result<(Plan, Prepared), NoScenario> {
    let (torque, speed) = acting(scenario);
    let reach_nm = Some(REACH * torque);
    let mut reduction = Reduction { reach_nm, at_rest: false };
    let (mut left_out, mut kept) = (Vec::new(), Vec::new());
    let mut prepared = None;
    if speed > 0.0 && speed < SLOW_RAD_S {
        let still = Reduction { at_rest: true, ..reduction };
        let p = prepare_reduced(scenario, &still)?;
        let cost = cost_of_rest_rad(&p, scenario, speed);
        let term = Term {
            term: "rotation (centrifugal growth and force)",
            why: format!("the mean speed is {speed:.3} rad/s"),
            cost_rad: Some(cost),
            cost: format!("at most {cost:.1e} rad of the inner race's angle"),
        };
        if cost < settings.tolerance {
            left_out.push(term);
            reduction = still;
            prepared = Some(p);
        } else {
            kept.push(term);
        }
    } else if speed == 0.0 {
        left_out.push(Term::free("centrifugal growth of the races", "the scene is at rest"));
    }
    let prepared = match prepared {
        Some(p) => p,
        None => prepare_reduced(scenario, &reduction)?,
    };
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

/// Largest torque from outside, N m, and mean speed, rad/s (that of a history is not constant: infinite).
fn acting(scenario: &Scenario) -> (f64, f64) {
    let largest = |h: &Vec<[f64; 2]>| h.iter().map(|r| r[1].abs()).fold(0.0, f64::max);
    match scenario.kind {
        ScenarioKind::Static { torque_nm } => (torque_nm, 0.0),
        ScenarioKind::TorsionalExcitation { preload_nm, amplitude_nm, speed_rad_s, .. } => {
            (preload_nm + amplitude_nm, speed_rad_s)
        }
        // What the free run brings along comes on top of the torque.
        ScenarioKind::Engagement { reversing_torque_nm, .. } => (2.0 * reversing_torque_nm, 0.0),
        ScenarioKind::Overrun { speed_rad_s, .. } => (1.0, speed_rad_s.max(SLOW_RAD_S)),
        ScenarioKind::Transient { preload_nm, torque_step_nm, speed_rad_s, .. } => {
            let steps = preload_nm.max((preload_nm + torque_step_nm).abs());
            let torque = scenario.torque_history.as_ref().map_or(steps, largest);
            (torque, if scenario.speed_history.is_some() { f64::INFINITY } else { speed_rad_s })
        }
    }
}

/// Bound on what taking `speed` for rest costs in theta_bi, rad. The race's growth delta does the work N delta
/// against the windup's C dW = n_s N delta, so dW = delta/(OA tan omega); the centrifugal force takes
/// n_s OA F_c OB sin gamma/(OB cos beta - OA) of the torque, and Coriolis' force some, over the tangent stiffness
/// at the preload.
fn cost_of_rest_rad(prepared: &Prepared, scenario: &Scenario, speed: f64) -> f64 {
    let (curve, c) = (&prepared.model.curve, prepared.model.curve.touch());
    let growth = curve.statics().elastic.outer_race.centrifugal_bore_growth_m(speed);
    let (oa, ob) = (c.lengths.oa.v, c.lengths.ob.v);
    let force = scenario.clutch.sprags.mass_kg * c.oc_g.v * speed * speed;
    let moved = (force * ob * c.gamma.v.sin() / (ob * c.beta.v.cos() - oa)).abs();
    let torque = scenario.clutch.sprags.count as f64 * oa * moved;
    let start = curve.at_normal(prepared.static_normal_n).map_or(0.0, |p| p.k_tangent_nm_per_rad);
    // Coriolis: 2 n_s m_g OC_g OC_g' alpha' Omega, alpha' as of a swing over the whole angle.
    let most = curve.at_torque(acting(scenario).0);
    let swing = most.map_or(f64::INFINITY, |p| {
        let races = &scenario.clutch.races;
        let lighter = races.inner_inertia_kg_m2.min(races.outer_inertia_kg_m2);
        let rate = p.alpha_rad
            * (p.k_tangent_nm_per_rad / lighter)
                .sqrt()
                .max(prepared.period_s.map_or(0.0, |t| std::f64::consts::TAU / t));
        let slope = curve.in_arc(curve.arc_at(p.alpha_rad), p.alpha_rad).oc_g_slope;
        2.0 * scenario.clutch.sprags.count as f64
            * scenario.clutch.sprags.mass_kg
            * c.oc_g.v
            * slope.abs()
            * rate
            * speed
    });
    AMPLIFIED * (growth / (oa * c.t_ratio) + (torque + swing) / start)
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
