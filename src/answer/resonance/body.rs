//! The answer of `resonance` by its keys in JSON, its errors, and its table.

use super::ResonanceAnswer;
use crate::answer::Said;
use crate::answer::simulation::Eigenfrequency;
use crate::dynamics::Run;
use crate::report::{Cell, Rows, Unit};
use crate::scenario::{MotionKind, Steady};
use serde::Serialize;

/// Keys of `resonance`.
#[derive(Debug, Clone, Serialize)]
pub struct ResonanceBody<'a> {
    /// Amplitudes that a stop has left out.
    pub amplitudes_left: usize,
    /// Small free swings of both races about the mean torque with the clutch engaged, lowest first.
    pub eigenfrequencies: &'a [Eigenfrequency],
    /// Whether both contacts roll everywhere.
    pub rolls: bool,
    /// Name of the scenario.
    pub scenario: &'a str,
    /// Each state, a row of [`ResonanceAnswer::states`].
    pub states: Rows<StateLine<'a>>,
    /// Static friction that there is.
    pub static_friction: f64,
    /// The answer in a sentence.
    pub verdict: String,
}

impl<'a> ResonanceBody<'a> {
    pub(super) fn of(answer: &'a ResonanceAnswer<'_>) -> Self {
        Self {
            scenario: &answer.scenario.name,
            amplitudes_left: answer.amplitudes_left(),
            eigenfrequencies: &answer.eigenfrequencies,
            verdict: answer.verdict(),
            static_friction: answer.friction,
            rolls: answer.rolls(),
            states: answer.states(),
        }
    }
}

/// How far off periodic states are.
#[derive(Debug, Clone, Copy, Serialize)]
#[serde(untagged)]
pub enum ResonanceErrors {
    /// Of a map the tolerance that each state is found at.
    Map {
        /// Relative.
        tolerance: f64,
    },
    /// Of a single state what each figure differs by from that at a tenth of the tolerance; null where one has none.
    One {
        /// Static friction that rolling needs.
        required_static_friction: Option<f64>,
        /// Contact margin.
        contact_margin: Option<f64>,
        /// Smallest normal force of one sprag at the inner contact, N.
        normal_min_n: Option<f64>,
        /// Largest normal force of one sprag at the inner contact, N.
        normal_max_n: Option<f64>,
        /// Slip at the inner contact in a period, mm.
        slip_inner_mm: Option<f64>,
        /// Time without contact in a period, s.
        open_s: Option<f64>,
    },
}

impl ResonanceErrors {
    pub(super) fn of(answer: &ResonanceAnswer<'_>) -> Self {
        let first = answer.cells().next().map(|c| &c.state);
        let Some((state, finer)) = first.zip(answer.finer.as_ref()) else {
            return Self::Map { tolerance: answer.tolerance };
        };
        let off = |of: &dyn Fn(&Steady) -> Option<f64>| Some((of(state)? - of(finer)?).abs());
        let run = |s: &Steady, of: fn(&Run) -> f64| Some(of(&s.motion.as_ref().ok()?.run));
        Self::One {
            required_static_friction: off(&|s| s.required_friction),
            contact_margin: off(&|s| s.contact_margin),
            normal_min_n: off(&|s| run(s, |r| r.peaks.normal_min_n)),
            normal_max_n: off(&|s| run(s, |r| r.peaks.normal_max_n)),
            slip_inner_mm: off(&|s| run(s, |r| 1e3 * r.inner.distance_m)),
            open_s: off(&|s| run(s, |r| r.open_s)),
        }
    }
}

impl ResonanceAnswer<'_> {
    /// Each state in a line.
    pub fn states(&self) -> Rows<StateLine<'_>> {
        lines(self.cells().map(|c| (c.frequency_hz, c.amplitude_nm, &c.state, c.other.as_ref())))
    }
}

/// A state, at which frequency (Hz) and amplitude (N m), and another one there.
pub type StateLine<'a> = (f64, f64, &'a Steady, Option<&'a Steady>);

/// States in a line each.
fn lines<'a>(states: impl IntoIterator<Item = StateLine<'a>>) -> Rows<StateLine<'a>> {
    let motion = |s: &StateLine<'a>| s.2.motion.as_ref().ok();
    let run = |s: &StateLine<'a>| motion(s).map(|o| &o.run);
    let drift_rad = |s: &StateLine<'a>| motion(s).map(|o| o.drift_rad());
    Rows::of(states)
        .number("frequency_hz", "Frequency", Unit::Hertz, 5, |(hz, ..)| *hz)
        .number("amplitude_nm", "Amplitude", Unit::NewtonMetre, 5, |(_, nm, ..)| *nm)
        .text("state", "State", |(_, _, s, _)| {
            Cell::Verdict(s.kind == MotionKind::Rolls, s.kind.name().to_owned())
        })
        .text("stable", "Stable", |(_, _, s, _)| match (s.is_stable(), s.motion.is_ok()) {
            (Some(stable), _) => Cell::told(if stable { "yes" } else { "NO" }, stable),
            (None, true) => Cell::told("?", Cell::Empty),
            (None, false) => Cell::Empty,
        })
        .number("required_static_friction", "μ needed", Unit::One, 5, |(_, _, s, _)| s.required_friction)
        .number("slip_margin", "Slip margin", Unit::One, 4, |(_, _, s, _)| s.slip_margin)
        .shown_in(Unit::Percent)
        .number("contact_margin", "Contact margin", Unit::One, 4, |(_, _, s, _)| s.contact_margin)
        .shown_in(Unit::Percent)
        .number("normal_min_n", "N smallest", Unit::Newton, 4, |s| run(s).map(|r| r.peaks.normal_min_n))
        .number("normal_max_n", "N largest", Unit::Newton, 4, |s| run(s).map(|r| r.peaks.normal_max_n))
        .number("slip_inner_mm", "Slip a period", Unit::Millimetre, 4, |s| run(s).map(|r| r.inner.distance_m))
        .shown_in(Unit::Micrometre)
        .number("open_s", "Open a period", Unit::Second, 4, |s| run(s).map(|r| r.open_s))
        .shown_in(Unit::Millisecond)
        // What rolls comes back: what is left of it is rounding.
        .number("drift_rad", "Drift a period", Unit::Radian, 4, |s| {
            drift_rad(s).map(|d| if s.2.kind == MotionKind::Rolls { 0.0 } else { d[0] - d[1] })
        })
        .shown_in(Unit::Milliradian)
        .number("deciding_multiplier", "Multiplier", Unit::One, 6, |s| {
            motion(s).map(|o| o.deciding_multiplier())
        })
        .number("neutral_multiplier", "Neutral one", Unit::One, 6, |s| {
            motion(s).and_then(|o| o.neutral_multiplier())
        })
        .text("other_state", "Other state", |(.., other)| other.map(|other| other.kind.name()))
        .json("other", |(hz, nm, _, other)| other.map(|other| lines([(*hz, *nm, other, None)]).object()))
        .json("multipliers", |s| motion(s).map(|o| o.multipliers.clone()))
        .json("multiplier_error", |s| motion(s).map(|o| o.multiplier_error))
        .json("tan_inner", |s| run(s).map(|r| r.peaks.tan_inner))
        .json("tan_outer", |s| run(s).map(|r| r.peaks.tan_outer))
        .json_in("slip_outer_mm", Unit::Millimetre, |s| run(s).map(|r| r.outer.distance_m))
        .json_in("net_slip_inner_mm", Unit::Millimetre, |s| run(s).map(|r| r.inner.net_m))
        .json("drift_inner_rad", |s| drift_rad(s).map(|d| d[0]))
        .json("drift_outer_rad", |s| drift_rad(s).map(|d| d[1]))
        .json("newton_error", |s| motion(s).map(|o| o.error))
        .json("periods", |(_, _, s, _)| s.periods)
        .json("work_in_j", |s| run(s)?.energy.map(|e| e.torque_inner_j + e.torque_outer_j))
        .json("lost_j", |s| {
            let e = run(s)?.energy?;
            Some(-(e.friction_inner_j + e.friction_outer_j + e.race_damping_j + e.contact_damping_j))
        })
}
