//! What periodic states come to, in words.

use super::ResonanceAnswer;
use crate::answer::simulation::Eigenfrequency;
use crate::clutch::ScenarioKind;
use crate::report::{Unit, significant};
use crate::scenario::{MotionKind, ResonanceCell};

/// How near a natural frequency one must be looked at, as a part of it: at 2 % beside it an undamped swing is 25 times what it is far below.
const NEAR: f64 = 0.02;
/// Share of critical damping from which on nothing of a resonance is left to be missed.
const DAMPED: f64 = 0.3;

impl ResonanceAnswer<'_> {
    /// The answer in a sentence.
    pub(super) fn verdict_words(&self) -> String {
        let mut cells = self.cells();
        if let (Some(only), None) = (cells.next(), cells.next()) {
            return one_verdict(only);
        }
        let all = self.cells().count();
        let mut parts = Vec::new();
        if self.amplitudes_left() > 0 {
            parts.push(format!("stopped after {} of {} amplitudes", self.rows.len(), self.asked));
        }
        parts.push(format!("{} of {all} states roll", self.count(MotionKind::Rolls)));
        for (kind, one, several) in [
            (MotionKind::Slips, "slips in each period", "slip in each period"),
            (MotionKind::LiftsOff, "lifts off", "lift off"),
            (
                MotionKind::Overloaded,
                "is overloaded, beyond the end of the curve",
                "are overloaded, beyond the end of the curve",
            ),
            (
                MotionKind::Disengages,
                "disengages, its sprags thrown out of reach",
                "disengage, their sprags thrown out of reach",
            ),
            (MotionKind::NotFound, "does not repeat, or was not found", "do not repeat, or were not found"),
        ] {
            match self.count(kind) {
                0 => {}
                1 => parts.push(format!("1 {one}")),
                n => parts.push(format!("{n} {several}")),
            }
        }
        let two = self.cells().filter(|c| c.other.is_some()).count();
        let unstable = self.cells().filter(|c| c.state.is_stable() == Some(false)).count();
        let untold = self.cells().filter(|c| c.state.motion.is_ok() && c.state.is_stable().is_none()).count();
        if two > 0 {
            parts.push(format!("at {two} two states were found"));
        }
        if unstable > 0 {
            parts.push(format!("{unstable} {} unstable", if unstable == 1 { "is" } else { "are" }));
        }
        if untold > 0 {
            let they = if untold == 1 { "it is" } else { "they are" };
            parts.push(format!("of {untold} it cannot be told whether {they} stable"));
        }
        parts.join("; ")
    }

    /// What the tables do not say, a sentence each.
    pub(super) fn remark_words(&self) -> Vec<String> {
        let most = self.cells().filter_map(|c| Some((c, c.state.required_friction?)));
        let most = most.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(c, mu)| {
            format!(
                "Largest static friction that rolling needs where it keeps contact: {} at {} and {}; there is {}",
                significant(mu, 4),
                Unit::Hertz.show(c.frequency_hz, 4),
                Unit::NewtonMetre.show(c.amplitude_nm, 4),
                significant(self.friction, 3),
            )
        });
        let ended =
            |c: &&ResonanceCell| matches!(c.state.kind, MotionKind::Overloaded | MotionKind::Disengages);
        let ends = self.cells().any(|c| ended(&c)).then(|| {
            let margin = match self.cells().filter(ended).any(|c| c.state.slip_margin.is_some()) {
                true => "; a slip margin there is what rolling lacks in friction, which would keep the clutch from it",
                false => "",
            };
            format!(
                "overloaded, disengages: no motion repeats there, the swing carries the sprag beyond the end of the curve, \
                 off its profile or over its highest point, or farther from the race than is followed{margin}"
            )
        });
        let neutral = self.cells().filter_map(|c| {
            let motion = c.state.motion.as_ref().ok()?;
            motion.neutral_multiplier().map(|_| motion.multiplier_error)
        });
        let neutral =
            neutral.fold(None, |most: Option<f64>, error| Some(most.map_or(error, |m| m.max(error))));
        let neutral = neutral.map(|error| {
            format!(
                "Multiplier: the largest beside a pair that is 1 within its error of {}: a swing that neither grows nor dies away, such as \
                 that of both races together on an abutment, which has no damper; it counts for no instability",
                significant(error, 2)
            )
        });
        let list = [
            self.natural_words(),
            self.between_words(),
            most,
            ends,
            neutral,
            Some(
                "Each state is a motion that repeats with the period of the excitation, its start forgotten; a start may slip where \
                 the state rolls: simulate tells of that"
                    .to_owned(),
            ),
        ];
        list.into_iter().flatten().collect()
    }
}

impl ResonanceAnswer<'_> {
    /// A warning of a natural frequency that lies within the frequencies looked at and near none of them.
    fn between_words(&self) -> Option<String> {
        let row = self.rows.first()?;
        let hz = || row.iter().map(|c| c.frequency_hz);
        let (low, high) = (hz().fold(f64::INFINITY, f64::min), hz().fold(0.0, f64::max));
        let missed = |e: &&Eigenfrequency| {
            let f = e.frequency_hz;
            let near = NEAR.max(3.0 * e.damping_ratio);
            f > low && f < high && e.damping_ratio < DAMPED && hz().all(|x| (x / f - 1.0).abs() > near)
        };
        let all: Vec<String> =
            self.eigenfrequencies.iter().filter(missed).map(|e| significant(e.frequency_hz, 4)).collect();
        (!all.is_empty()).then(|| {
            format!(
                "Warning: the clutch swings freely at {} Hz, between the frequencies looked at: what it does there these states do not show; \
                 ask for that one (--frequency {}), or for more points",
                all.join(" and "),
                all[0]
            )
        })
    }

    /// The natural frequencies; nothing where there are none.
    fn natural_words(&self) -> Option<String> {
        let ScenarioKind::TorsionalExcitation { preload_nm, .. } = self.scenario.kind else { return None };
        let all: Vec<String> = self.eigenfrequencies.iter().map(Eigenfrequency::words).collect();
        (!all.is_empty()).then(|| {
            format!(
                "Natural frequencies, clutch engaged under the mean torque of {}: {}",
                Unit::NewtonMetre.show(preload_nm, 4),
                all.join("; ")
            )
        })
    }
}

/// The state of a single frequency and amplitude.
fn one_verdict(c: &ResonanceCell) -> String {
    let s = &c.state;
    let motion = s.motion.as_ref().ok();
    let slip = motion.map_or(0.0, |o| o.run.inner.distance_m);
    let needs = match s.required_friction {
        Some(mu) => format!("rolling needs a friction of {}", significant(mu, 4)),
        None if s.rolling.is_ok() => "rolling would open the contact".to_owned(),
        None => "no rolling motion that repeats was found".to_owned(),
    };
    let what = match s.kind {
        MotionKind::Rolls => "rolls in each period".to_owned(),
        MotionKind::Slips => format!("slips {} in each period", Unit::Micrometre.show(slip, 4)),
        MotionKind::LiftsOff if motion.is_some_and(|o| o.run.open_s == 0.0) => {
            "comes loose in each period: the cage takes the sprags along".to_owned()
        }
        MotionKind::LiftsOff => format!(
            "lifts off for {} in each period",
            Unit::Millisecond.show(motion.map_or(0.0, |o| o.run.open_s), 3)
        ),
        MotionKind::Overloaded => "overloaded: the swing goes beyond the end of the curve".to_owned(),
        MotionKind::Disengages => "disengages: the swing throws the sprags out of reach".to_owned(),
        MotionKind::NotFound => "no motion that repeats was found; simulate runs the transient".to_owned(),
    };
    let stable = match s.is_stable() {
        Some(false) => "; unstable: it leaves that state by itself",
        None if motion.is_some() => {
            "; whether it is stable cannot be told: its multiplier is 1 within its error"
        }
        _ => "",
    };
    let other = c.other.as_ref().map_or(String::new(), |o| format!("; another state: {}", o.kind.name()));
    format!("{what}{stable}; {needs}{other}")
}
