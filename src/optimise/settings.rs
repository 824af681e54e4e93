//! Settings of a run, each with what it means, its default and the range in which it makes sense.

use crate::numeric::setting::{BadSetting, in_range};

/// Level of noise in the evaluator, which sets how short a difference step may be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Noise {
    /// Known, relative to max(1, |value|).
    Relative(f64),
    /// Measured at the start from a difference table of six more points (Moré and Wild, *Estimating
    /// computational noise*, SIAM J. Sci. Comput. 33 (2011) 1292).
    Measured,
}

/// Settings of [`maximise_least_margin`](super::maximise_least_margin). Variables are scaled to [0, 1], so
/// every length below is a fraction of a variable's range.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// Most evaluations, difference points and failed points counted. Default 500; at least 1.
    pub max_evaluations: usize,
    /// Most steps tried in each phase. Default 100; at least 1.
    pub max_iterations: usize,
    /// A point is feasible when every limit is at least minus this. Default 1e-8; in (0, 1e-2].
    pub violation_tolerance: f64,
    /// Largest component of the projected gradient of the Lagrangian at a solution, per range and relative to
    /// max(1, |t|). Default 1e-4; in (0, 1e-1].
    pub optimality_tolerance: f64,
    /// Gain of the least margin that the model still promises at a solution, relative to max(1, |t|).
    /// Default 1e-8; in (0, 1e-2].
    pub gain_tolerance: f64,
    /// Shortest difference step. Default 1e-3; in [1e-7, 1e-2].
    pub shortest_difference: f64,
    /// Longest difference step. Default 1e-2; from `shortest_difference` to 0.1.
    pub longest_difference: f64,
    /// Noise of the evaluator. Default `Relative(1e-10)`; in [1e-16, 1e-2].
    pub noise: Noise,
    /// First trust radius (largest move of any variable). Default 0.25; in (0, 1].
    pub first_radius: f64,
    /// Whether to finish: central differences before an end is believed, the poll, the choice on a plateau. Default true;
    /// without, a climb ends `gain_tolerance` or so below the optimum.
    pub finish: bool,
    /// What a climb keeps of every limit, in its unit, until it ends: so its points are feasible long before limits are met to
    /// `violation_tolerance`. Where there is no such way up it goes on without. Default 0; to 1e-2.
    pub clearance: f64,
    /// Whether to finish by polling points a difference step away along the active margins. Default true.
    pub poll: bool,
    /// Least margin given up, relative to max(1, |t|), when the tie break chooses on a plateau. Default 1e-6;
    /// in (0, 1e-2].
    pub plateau: f64,
    /// Gain of the tie break, relative to its size at t*, below which the second phase is not worth an
    /// evaluation. Default 1e-4; in (0, 1].
    pub tie_break_gain: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            max_evaluations: 500,
            max_iterations: 100,
            violation_tolerance: 1e-8,
            optimality_tolerance: 1e-4,
            gain_tolerance: 1e-8,
            shortest_difference: 1e-3,
            longest_difference: 1e-2,
            noise: Noise::Relative(1e-10),
            first_radius: 0.25,
            finish: true,
            clearance: 0.0,
            poll: true,
            plateau: 1e-6,
            tie_break_gain: 1e-4,
        }
    }
}

/// How far below its optimum a climb of several may end, as [`Settings::gain_tolerance`]: a fiftieth of what tells two optima
/// apart.
const LOOSE: f64 = 2e-5;
/// The same as [`Settings::optimality_tolerance`].
const LOOSE_SLOPE: f64 = 1e-2;

/// What such a climb keeps of every limit: less than tells two optima apart, where a limit costs the least margin no more than
/// three times what it gives.
const CLEARANCE: f64 = 3e-4;

impl Settings {
    /// The same for one climb of several, of which the best alone is finished.
    pub(super) fn loosely(&self) -> Self {
        Settings {
            finish: false,
            clearance: CLEARANCE,
            gain_tolerance: self.gain_tolerance.max(LOOSE),
            optimality_tolerance: self.optimality_tolerance.max(LOOSE_SLOPE),
            ..self.clone()
        }
    }

    /// # Errors
    /// The first setting that is out of its range.
    pub fn validate(&self) -> Result<(), BadSetting> {
        let noise = match self.noise {
            Noise::Relative(level) => level,
            Noise::Measured => 1e-10,
        };
        let tiny = f64::MIN_POSITIVE;
        let rules = [
            ("max_evaluations", self.max_evaluations as f64, 1.0, f64::MAX),
            ("max_iterations", self.max_iterations as f64, 1.0, f64::MAX),
            ("violation_tolerance", self.violation_tolerance, tiny, 1e-2),
            ("optimality_tolerance", self.optimality_tolerance, tiny, 1e-1),
            ("gain_tolerance", self.gain_tolerance, tiny, 1e-2),
            ("shortest_difference", self.shortest_difference, 1e-7, 1e-2),
            ("longest_difference", self.longest_difference, self.shortest_difference, 0.1),
            ("noise", noise, 1e-16, 1e-2),
            ("first_radius", self.first_radius, tiny, 1.0),
            ("clearance", self.clearance, 0.0, 1e-2),
            ("plateau", self.plateau, tiny, 1e-2),
            ("tie_break_gain", self.tie_break_gain, tiny, 1.0),
        ];
        rules.into_iter().try_for_each(|(name, value, least, most)| in_range(name, value, [least, most]))
    }
}
