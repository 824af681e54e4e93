//! The keys of `accuracy --json`.

use super::tables::{Point, points, points_of};
use super::verdict::{WANTED_RAD, gains_over_published, winners};
use super::{AccuracyStudy, map};
use crate::accuracy::{CaseEnd, Halved, Judged, PARAMETERS, Precision};
use crate::answer::ByAlphabet;
use crate::report::Rows;
use serde::ser::{Serialize, SerializeMap, Serializer};

/// Values under keys that stand in a table; in JSON an object.
#[derive(Debug, Clone)]
pub struct Keyed<V>(pub Vec<(&'static str, V)>);

impl<V: Serialize> Serialize for Keyed<V> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        self.0.iter().try_for_each(|(key, value)| map.serialize_entry(key, value))?;
        map.end()
    }
}

/// The reference run of a scene.
#[derive(Debug, Clone, Copy, serde::Serialize)]
pub struct ReferenceBody {
    /// Changes of mode.
    pub events: u64,
    /// Slip margin; null where no friction suffices.
    pub slip_margin: Option<f64>,
    /// What the slip margin moves by at ten times the tolerance and twice the longest step.
    pub slip_margin_error: f64,
    /// Rotation of the inner race at the end, rad.
    pub theta_inner_end_rad: f64,
    /// What the rotation moves by at ten times the tolerance and twice the longest step, rad.
    pub theta_inner_error_rad: f64,
}

/// Time to build a model, s.
#[derive(Debug, Clone, Copy, serde::Serialize)]
pub struct PrepareTimes {
    /// In full.
    pub full: f64,
    /// As planned.
    pub reduced: f64,
}

/// The cheapest point of a method.
#[derive(Debug, Clone, serde::Serialize)]
#[serde(untagged)]
pub enum Cheapest<'a> {
    /// The one that reaches the error wanted at the least cost.
    #[serde(serialize_with = "first_row")]
    Point(Rows<Point<'a>>),
    /// None does.
    None {
        /// Key of the method.
        method: &'static str,
        /// False.
        reached: bool,
    },
}

fn first_row<T, S: Serializer>(rows: &Rows<T>, serializer: S) -> Result<S::Ok, S::Error> {
    rows.object().serialize(serializer)
}

/// A scene with its points.
#[derive(Debug, Clone, serde::Serialize)]
pub struct SceneBody<'a> {
    /// The cheapest point of each method.
    pub cheapest: Vec<Cheapest<'a>>,
    /// Each point.
    pub points: Rows<Point<'a>>,
    /// Time to build the model.
    pub prepare_time_s: PrepareTimes,
    /// Time of the published scheme at its step over that of one run; null: one of both is not known.
    pub published_step_over_one_run: Option<f64>,
    /// What the planner leaves out.
    pub reduced_without: &'a [&'static str],
    /// What its points are compared with.
    pub reference: ReferenceBody,
    /// Name of the scenario.
    pub scenario: &'a str,
}

/// A scene without a start.
#[derive(Debug, Clone, Copy, serde::Serialize)]
pub struct WithoutStart<'a> {
    /// Name of the scenario.
    pub scenario: &'a str,
    /// Why.
    pub why: &'a str,
}

/// Most work of a case.
#[derive(Debug, Clone, Copy, serde::Serialize)]
pub struct WorstBody {
    /// Changes of mode.
    pub events: Option<u64>,
    /// Steps.
    pub steps: Option<u64>,
    /// Evaluations of the equations of motion.
    pub rhs_evaluations: Option<u64>,
}

/// A case of the map.
#[derive(Debug, Clone, serde::Serialize)]
pub struct CaseBody {
    /// Its number.
    pub case: usize,
    /// Its outcome.
    pub outcome: &'static str,
    /// That at half the tolerance.
    pub outcome_at_half: &'static str,
    /// Rotation of the inner race at the end in both, rad.
    pub theta_inner_end_rad: [f64; 2],
    /// First figure that is not finite.
    pub not_finite: Option<&'static str>,
    /// Time reached, s.
    pub time_reached_s: f64,
    /// Changes of mode.
    pub events: u64,
    /// Evaluations of the equations of motion.
    pub rhs_evaluations: u64,
    /// Fastest rate in the motion where the limit of steps was met, rad/s.
    pub fastest_rad_per_s: Option<f64>,
    /// Whether it was run once more, within more steps.
    pub again: bool,
    /// What it is made of, in the units of the keys.
    pub parameters: Keyed<f64>,
}

/// Cases of the map that a drive could have.
#[derive(Debug, Clone, Copy, serde::Serialize)]
pub struct OfDrives {
    /// How many start.
    pub start: usize,
    /// How many of them end without a verdict at a limit of work.
    pub at_a_limit: usize,
}

/// The stability map.
#[derive(Debug, Clone, serde::Serialize)]
pub struct StabilityBody {
    /// What the cases are made by.
    pub seed: u64,
    /// How many there are.
    pub cases: usize,
    /// Tolerance.
    pub tolerance: f64,
    /// Most steps of a run.
    pub most_steps_per_run: u64,
    /// Most changes of mode of a run.
    pub most_events_per_run: u64,
    /// Most steps of a run of a case that met these limits without a verdict and was run once more; none: none was.
    pub most_steps_again: Option<u64>,
    /// Cases that a drive could have.
    pub of_drives: OfDrives,
    /// Wall time, s.
    pub run_time_s: f64,
    /// How many cases have each outcome.
    pub outcomes: Keyed<usize>,
    /// How many have not reached the tolerance.
    pub not_converged: usize,
    /// Most work of a case.
    pub worst: WorstBody,
    /// What half the tolerance makes of the verdicts.
    pub at_half_the_tolerance: Halved,
    /// Cases that a reader must see, a list of each kind.
    #[serde(flatten)]
    pub remarkable: Keyed<Vec<CaseBody>>,
}

/// Scenes with their points, and the map.
#[derive(Debug, Clone, serde::Serialize)]
pub struct AccuracyBody<'a> {
    /// Error that is wanted, rad.
    pub wanted_error_rad: f64,
    /// Points of every method, scene by scene.
    pub scenes: Vec<SceneBody<'a>>,
    /// Scenes without a start.
    pub without_start: Vec<WithoutStart<'a>>,
    /// The stability map.
    pub stability_map: Option<ByAlphabet<StabilityBody>>,
}

impl<'a> AccuracyBody<'a> {
    pub(super) fn of(study: &'a AccuracyStudy<'_>) -> Self {
        let without = |(scenario, why): &'a (String, String)| WithoutStart { scenario, why };
        Self {
            wanted_error_rad: WANTED_RAD,
            scenes: study.scenes.iter().map(SceneBody::of).collect(),
            without_start: study.without_start.iter().map(without).collect(),
            stability_map: (!study.cases.is_empty()).then(|| ByAlphabet(StabilityBody::of(study))),
        }
    }
}

impl<'a> SceneBody<'a> {
    fn of(s: &'a Precision) -> Self {
        let cheapest = winners(s).into_iter().map(|(m, p)| match p {
            Some(p) => Cheapest::Point(points([(s, m, p)])),
            None => Cheapest::None { method: m.key(), reached: false },
        });
        Self {
            scenario: &s.scene,
            reference: ReferenceBody {
                theta_inner_end_rad: s.theta_inner_rad,
                slip_margin: s.slip_margin,
                events: s.events,
                theta_inner_error_rad: s.reference_error[0],
                slip_margin_error: s.reference_error[1],
            },
            prepare_time_s: PrepareTimes { full: s.prepare_s[0], reduced: s.prepare_s[1] },
            reduced_without: &s.left_out,
            points: points(points_of(s)),
            cheapest: cheapest.collect(),
            published_step_over_one_run: gains_over_published(s).map(|g| g[0]),
        }
    }
}

impl StabilityBody {
    fn of(study: &AccuracyStudy<'_>) -> Self {
        let most = |f: fn(&Judged) -> u64| study.cases.iter().map(f).max();
        let those =
            |is: fn(&Judged) -> bool| study.cases.iter().filter(|c| is(c)).map(CaseBody::of).collect();
        let [start, at_a_limit] = study.of_drives();
        Self {
            seed: study.seed,
            cases: study.cases.len(),
            tolerance: study.limit.tolerance,
            most_steps_per_run: study.limit.most_steps,
            most_events_per_run: study.limit.most_events,
            most_steps_again: study.limit.most_steps_again,
            of_drives: OfDrives { start, at_a_limit },
            run_time_s: study.map_time_s,
            outcomes: Keyed(map::by_outcome(study).into_iter().map(|(name, c)| (name, c.len())).collect()),
            not_converged: study.cases.iter().filter(|c| !c.converged).count(),
            worst: WorstBody {
                events: most(|c| c.events),
                steps: most(|c| c.steps),
                rhs_evaluations: most(|c| c.rhs_evaluations),
            },
            at_half_the_tolerance: Halved::of(&study.cases),
            remarkable: Keyed(map::REMARKABLE.into_iter().map(|(key, _, is)| (key, those(is))).collect()),
        }
    }
}

impl CaseBody {
    fn of(c: &Judged) -> Self {
        Self {
            case: c.case.number,
            outcome: c.outcomes[0].name(),
            outcome_at_half: CaseEnd::name(c.outcomes[1]),
            theta_inner_end_rad: c.theta_inner_rad,
            not_finite: c.not_finite,
            time_reached_s: c.t_s,
            events: c.events,
            rhs_evaluations: c.rhs_evaluations,
            fastest_rad_per_s: c.fastest_rad_s,
            again: c.again,
            parameters: Keyed(PARAMETERS.iter().zip(c.case.values).map(|(p, v)| (p.key, v)).collect()),
        }
    }
}
