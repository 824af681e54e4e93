//! The answer of `sharing` in a scene by its keys in JSON, and its tables.

use super::SharingSceneAnswer;
use crate::answer::Answer;
use crate::dynamics::{ManySample, SpragCourse};
use crate::report::{Rows, Unit};
use crate::scenario::Verdict;
use crate::sharing::OneSprag;
use serde::Serialize;

/// Index of a sprag, what sets it apart, and what became of it; `None`: it is not computed.
pub type SpragRow<'a> = (usize, &'a OneSprag, Option<&'a SpragCourse>);

/// Keys of `sharing` in a scene.
#[derive(Debug, Clone, Serialize)]
pub struct SharingSceneBody<'a> {
    /// How far the axes were apart at most, um.
    pub axes_apart_max_um: Option<f64>,
    /// Frequency of the mass that swings on the bearings, Hz; null: they do not give.
    pub bearing_frequency_hz: Option<f64>,
    /// Mass that swings on the bearings, kg; null: they do not give.
    pub bearing_mass_kg: Option<f64>,
    /// When the bearings hold most, s.
    pub bearing_max_at_s: Option<f64>,
    /// Largest force that the bearings hold, N; null: the axes are one.
    pub bearing_max_n: Option<f64>,
    /// What the inertia of the races that bend would change, of what they bend.
    pub bending_left_out: Option<f64>,
    /// Sprags from 1 in the order in which they catch.
    pub catching: Vec<usize>,
    /// Time reached, s.
    pub end_s: f64,
    /// What the balance of energy leaves, J.
    pub energy_residual_j: f64,
    /// Energy that went through, J.
    pub energy_through_j: f64,
    /// Changes of mode.
    pub events: u64,
    /// When the first sprag slips under load after it has caught, s.
    pub first_slip_at_s: Option<f64>,
    /// The sprag that does, from 1.
    pub first_slip_sprag: Option<usize>,
    /// Why the run did not come to its end, and what would let it.
    pub given_up: Option<String>,
    /// Sprags that lost contact for good beyond the end of their curve.
    pub gone: usize,
    /// Whether the clutch holds to the end of the scene, or lets go where its torque turns round, and no sprag slips under load or goes over.
    pub held: bool,
    /// Every sample.
    pub history: Rows<&'a ManySample>,
    /// Kinds of sprags that were computed.
    pub kinds: usize,
    /// Largest share of the load, over the mean of all places.
    pub largest_share: Option<f64>,
    /// When the share of the load is largest, s.
    pub largest_share_at_s: Option<f64>,
    /// The sprag that has the largest share, from 1.
    pub largest_share_sprag: Option<usize>,
    /// Lowest frequency of the inner race as a ring, Hz; null: the races do not bend.
    pub lowest_mode_inner_hz: Option<f64>,
    /// Lowest frequency of the outer race as a ring, Hz.
    pub lowest_mode_outer_hz: Option<f64>,
    /// By how much the largest normal force differs between two runs, of itself.
    pub normal_max_error: Option<f64>,
    /// Sprags that went beyond the end of their curve.
    pub over: usize,
    /// Evaluations of the equations of motion.
    pub rhs_evaluations: u64,
    /// Name of the scene.
    pub scenario: &'a str,
    /// Frequency at which the scene drives the races, Hz.
    pub scene_hz: Option<f64>,
    /// Seed of what sets the sprags apart by chance.
    pub seed: Option<u64>,
    /// Largest share at rest under the largest torque with races that bend.
    pub share_at_rest: Option<f64>,
    /// Largest share at rest under the largest torque with races that stay round.
    pub share_at_rest_round: Option<f64>,
    /// How many sprags slip under load after they have caught.
    pub slipping: usize,
    /// Every sprag.
    pub sprags: Rows<SpragRow<'a>>,
    /// Steps of the integrator.
    pub steps: u64,
    /// Why the run ended.
    pub stop: &'static str,
    /// By how much the rotation of the inner race differs between two runs, rad.
    pub theta_inner_error_rad: Option<f64>,
    /// Rotation of the inner race at the end, rad.
    pub theta_inner_rad: f64,
    /// Rotation of the outer race at the end, rad.
    pub theta_outer_rad: f64,
    /// The answer in a sentence.
    pub verdict: String,
}

impl<'a> SharingSceneBody<'a> {
    pub(super) fn of(answer: &'a SharingSceneAnswer<'_>) -> Self {
        let (found, run) = (&answer.found, &answer.found.run);
        let axes = found.axes.as_ref();
        let bearing = axes.and_then(|axes| axes.bearing);
        let (bends, most, first_slip) = (found.bends, answer.largest_share(), answer.first_slip());
        Self {
            held: answer.held(),
            verdict: answer.verdict(),
            scenario: &answer.scene,
            stop: run.stop.name(),
            end_s: run.t_s,
            largest_share: most.map(|m| m.1),
            largest_share_sprag: most.map(|m| m.0 + 1),
            largest_share_at_s: most.map(|m| m.2),
            seed: answer.design.sharing.as_ref().map(|sharing| sharing.seed),
            given_up: answer.given_up(),
            bearing_max_n: axes.map(|_| run.bearing_max_n),
            bearing_max_at_s: axes.map(|_| run.bearing_max_s),
            axes_apart_max_um: axes.map(|_| Unit::Micrometre.from_si(run.axis_max_m)),
            bearing_mass_kg: bearing.map(|b| b.mass_kg),
            bearing_frequency_hz: bearing.map(|b| b.frequency_hz()),
            over: answer.over().len(),
            gone: answer.gone(),
            catching: answer.catching().iter().map(|i| i + 1).collect(),
            slipping: answer.slipping(),
            first_slip_sprag: first_slip.map(|(i, _)| i + 1),
            first_slip_at_s: first_slip.map(|(_, t_s)| t_s),
            theta_inner_rad: run.races[0],
            theta_outer_rad: run.races[1],
            theta_inner_error_rad: found.error.map(|e| e[0]),
            normal_max_error: found.error.map(|e| e[1]),
            energy_residual_j: run.residual_j,
            energy_through_j: run.through_j,
            kinds: found.counts.len(),
            events: run.events,
            steps: run.counters.steps,
            rhs_evaluations: run.counters.rhs_evaluations,
            lowest_mode_inner_hz: bends.map(|b| b.lowest_mode_hz[0]),
            lowest_mode_outer_hz: bends.map(|b| b.lowest_mode_hz[1]),
            share_at_rest: found.shares_at_rest[0],
            share_at_rest_round: found.shares_at_rest[1],
            scene_hz: bends.map(|b| b.scene_hz),
            bending_left_out: bends.map(|b| b.left_out()),
            sprags: answer.rows(),
            history: answer.history(),
        }
    }
}

impl SharingSceneAnswer<'_> {
    /// One row a sprag.
    pub(super) fn rows(&self) -> Rows<SpragRow<'_>> {
        let order = self.catching();
        let rows = self.found.sprags.iter().enumerate().map(|(i, s)| (i, s, self.course(i)));
        let um = |m: f64| Unit::Micrometre.from_si(m);
        let slips = |c: Option<&SpragCourse>| c.and_then(|c| c.slips);
        Rows::of(rows)
            .number("number", "Sprag", Unit::One, 3, |(i, ..)| i + 1)
            .number("size_um", "Larger by", Unit::Micrometre, 3, |(_, s, _)| s.size_m)
            .number("gap_um", "Gap", Unit::Micrometre, 3, |(_, s, _)| s.gap_m)
            .number("friction", "μs", Unit::One, 3, |(_, s, _)| s.friction)
            .number("catches_s", "Catches at", Unit::Second, 4, |(_, _, c)| c.and_then(|c| c.catches_s))
            .shown_in(Unit::Millisecond)
            .number("order", "Order", Unit::One, 3, |(i, ..)| {
                order.iter().position(|of| of == i).map(|k| k + 1)
            })
            .number("normal_max_n", "Largest N", Unit::Newton, 4, |(_, _, c)| c.map(|c| c.normal_max_n))
            .number("largest_share", "Largest share", Unit::One, 4, |(_, _, c)| c.map(|c| c.share))
            .number("largest_share_at_s", "At", Unit::Second, 4, |(_, _, c)| {
                c.filter(|c| c.share > 0.0).map(|c| c.share_s)
            })
            .shown_in(Unit::Millisecond)
            .number("used_friction", "Uses μ", Unit::One, 3, |(_, _, c)| c.map(|c| c.tan[0].max(c.tan[1])))
            .number("slips_at_s", "Slips at", Unit::Second, 4, |(_, _, c)| slips(*c).map(|s| s.t_s))
            .shown_in(Unit::Millisecond)
            .number("slip_inner_um", "Slip", Unit::Micrometre, 3, |(_, _, c)| c.map(|c| c.net_m[0]))
            .text("state", "State", |(i, _, c)| match (self.found.idle[*i], c) {
                (Some(idle), _) => idle.words(),
                (None, Some(c)) if c.catches_s.is_none() => "never catches",
                (None, Some(c)) if c.gone_s.is_some() => "rolled over",
                (None, Some(c)) if c.over_s.is_some() => "beyond its end",
                (None, Some(_)) if self.slips(*i) => "slips",
                (None, Some(c)) if c.carried => "with the cage",
                // Among others that hold it holds with them.
                (None, Some(_)) if !self.holds() => {
                    match self.found.group[*i].and_then(|g| self.found.verdicts[g]) {
                        Some(Verdict::SlipsOverrunning) => "overruns",
                        Some(Verdict::Disengages) => "loses contact",
                        _ => "holds",
                    }
                }
                _ => "holds",
            })
            .json_in("azimuth_deg", Unit::Degree, |(_, s, _)| s.azimuth_rad)
            .json("idle", |(i, ..)| self.found.idle[*i].map(|idle| idle.words()))
            .json("normal_max_at_s", |(_, _, c)| c.map(|c| c.normal_max_s))
            .json("used_friction_inner", |(_, _, c)| c.map(|c| c.tan[0]))
            .json("used_friction_outer", |(_, _, c)| c.map(|c| c.tan[1]))
            .json("slips_inner", |(_, _, c)| slips(*c).map(|s| s.inner))
            .json("slips_normal_n", |(_, _, c)| slips(*c).map(|s| s.normal_n))
            .json("slip_outer_um", |(_, _, c)| c.map(|c| um(c.net_m[1])))
            .json("slip_path_inner_um", |(_, _, c)| c.map(|c| um(c.path_m[0])))
            .json("slip_path_outer_um", |(_, _, c)| c.map(|c| um(c.path_m[1])))
            .json("contact_lost_s", |(_, _, c)| c.map(|c| c.open_s))
            .json("over_at_s", |(_, _, c)| c.and_then(|c| c.over_s))
            .json("gone_at_s", |(_, _, c)| c.and_then(|c| c.gone_s))
    }

    /// One row a sample.
    pub(super) fn history(&self) -> Rows<&ManySample> {
        let axes = self.found.axes.as_ref();
        let normal = |s: &ManySample| -> Vec<f64> {
            self.found.group.iter().map(|g| g.map_or(0.0, |g| s.normal_n[g])).collect()
        };
        Rows::of(&self.found.run.samples)
            .number("t_s", "Time", Unit::Second, 4, |s| s.t_s)
            .number("theta_inner_rad", "θ inner", Unit::Radian, 6, |s| s.races[0])
            .number("theta_outer_rad", "θ outer", Unit::Radian, 6, |s| s.races[1])
            .number("bearing_n", "Bearings hold", Unit::Newton, 4, |s| axes.map(|_| s.bearing_n))
            .json("axis_um", |s| axes.map(|_| s.axis_m.map(|m| Unit::Micrometre.from_si(m))))
            .json("shares", |s| self.shares(s))
            .json("normal_inner_n", |s| normal(s))
    }

    /// Normal forces over the mean of all places at `sample`, by sprag; 0 while that is not loaded.
    pub(super) fn shares(&self, sample: &ManySample) -> Vec<f64> {
        let normal = |i: usize| self.found.group[i].map_or(0.0, |g| sample.normal_n[g]);
        let all: Vec<f64> = (0..self.found.sprags.len()).map(normal).collect();
        let mean = all.iter().sum::<f64>() / all.len() as f64;
        let loaded = mean > 0.0 && mean >= self.found.loaded_n;
        all.iter().map(|n| if loaded { n / mean } else { 0.0 }).collect()
    }
}
