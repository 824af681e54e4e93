//! Periodic motions under a torsional excitation, by shooting.
//!
//! What is periodic: alpha, theta_be on its abutment, and the rates that no rolling contact determines; phi and theta_bi enter
//! no force and may run on. Both contacts stick where the period begins: 4 numbers z; one slips: 5, with alpha'; both, or A
//! is open: 6, with phi' too. The period map P(z) is a run of one period, with every change of mode on the way; z = P(z) by
//! Newton,
//!
//!   (1 - DP) dz = P(z) - z,
//!
//! DP by central differences. Its eigenvalues are the Floquet multipliers: a small disturbance is multiplied by them in each
//! period, so the motion comes back where all lie within the unit circle. A pair on it within the error of the multipliers neither
//! grows nor dies away: races that swing together on an abutment, which has no damper, come so near to it. What is not smooth (a change
//! of mode that a disturbance adds or removes) shows as a Newton that does not converge; then the motion is followed for some
//! periods and Newton begins anew. Source of the method: Nayfeh and Balachandran, *Applied Nonlinear Dynamics* (1995), 3.2, 5.5.

use super::model::{Grip, Mode, Model, N_STATE, Place, State};
use super::run::{Run, RunSettings, Stop, run};
use crate::numeric::eigen::eigenvalues;
use nalgebra::{DMatrix, DVector};

/// Numbers of the state that a period map may act on, at most.
const MOST: usize = 6;
/// Newton steps from one start.
const MOST_STEPS: usize = 8;
/// Starts, each after more periods than the one before.
const ROUNDS: u32 = 4;
/// Periods that are run before the second start, and by how much more before each that follows.
const SETTLE: [u64; 2] = [8, 3];
/// Disturbance of a difference, as a part of what the number varies by over the period: a choice between rounding, some
/// tolerance over this, and the third order of the map.
const BESIDE: f64 = 1e-3;
/// Where a multiplier is nearer than this to the unit circle, all are taken once more, by differences twice as wide.
const CLOSE: f64 = 0.01;
/// Ratio of a Newton step to the one before up to which the old Jacobian serves.
const SERVES: f64 = 0.05;
/// Newton step, by range, up to which the Jacobian taken before it is that of the motion.
const NEAR: f64 = 1e-3;
/// Longest Newton step by range, at first.
const LONGEST: f64 = 0.5;
/// By how much longer one may be after one that was shortened and did what the Jacobian said, to [`LINEAR`] of it: races that swing
/// together on a soft abutment are far from where they end, and nothing of it is curved.
const LONGER: f64 = 4.0;
/// How far, by what a shortened step was to change, what it leaves may be from what the Jacobian said.
const LINEAR: f64 = 0.1;
/// Tolerance of the steps over that before, where Newton stops at their error.
const FINER: f64 = 1e-2;
/// Finest tolerance of steps.
pub const FINEST_STEPS: f64 = 1e-12;
/// Samples by which the ranges are taken.
const SAMPLES: usize = 65;

/// A motion that repeats with the period of the excitation.
#[derive(Debug, Clone)]
pub struct Orbit {
    /// State where the sine begins.
    pub state: State,
    /// Mode there.
    pub mode: Mode,
    /// One period from there.
    pub run: Run,
    /// Floquet multipliers, real and imaginary part, the largest first; those of what runs on, 1, left out.
    pub multipliers: Vec<[f64; 2]>,
    /// What a multiplier near the unit circle may be wrong by: tolerance of the steps over the disturbance, and by how much they
    /// move where that is twice as large.
    pub multiplier_error: f64,
    /// The last Newton step by what each number varies by over the period: what the state is wrong by but for the steps of
    /// integration.
    pub error: f64,
    /// Periods that were integrated to find it.
    pub periods: u64,
}

impl Orbit {
    /// The magnitude of the pair of multipliers that is neutral, 1 within [`Self::multiplier_error`]: a swing that neither grows nor
    /// dies away as far as can be told.
    pub fn neutral_multiplier(&self) -> Option<f64> {
        self.neutral().map(|k| magnitude(&self.multipliers[k]))
    }

    /// The first of the neutral pair.
    fn neutral(&self) -> Option<usize> {
        let neutral = |m: &[f64; 2]| m[1] != 0.0 && (magnitude(m) - 1.0).abs() <= self.multiplier_error;
        self.multipliers.iter().position(neutral)
    }

    /// What decides whether the motion is stable: the largest magnitude of a multiplier, of those beside a neutral pair where there is
    /// one.
    pub fn deciding_multiplier(&self) -> f64 {
        let neutral = self.neutral().map_or(0..0, |k| k..k + 2);
        let others = self.multipliers.iter().enumerate().filter(|(k, _)| !neutral.contains(k));
        others.map(|(_, m)| magnitude(m)).fold(0.0, f64::max)
    }

    /// Whether small disturbances die away, those of a neutral pair, which stay, left out; `None`: the multipliers are not known well
    /// enough to tell.
    pub fn is_stable(&self) -> Option<bool> {
        let beyond = self.deciding_multiplier() - 1.0;
        (beyond.abs() > self.multiplier_error).then_some(beyond < 0.0)
    }

    /// What theta_bi and theta_be gain in a period, rad.
    pub fn drift_rad(&self) -> [f64; 2] {
        [2, 3].map(|i| self.run.state[i] - self.state[i])
    }
}

/// Why none was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NoOrbit {
    /// The motion ends on the way: it leaves the curve, or a run gives up.
    Ends(Stop),
    /// Newton does not converge, nor does the motion settle: its smallest step, by range.
    NotConverged(f64),
    /// Nothing holds the outer race against the mean torque.
    NothingHolds,
    /// A drivetrain has states of its own.
    Drivetrain,
}

/// Search settings: those of one period, whose length is the duration, how small the last Newton step by range must be, and
/// the periods that are run before the first start.
#[derive(Debug, Clone)]
pub struct Shooting {
    /// Of a run of one period.
    pub period: RunSettings,
    /// Of the last Newton step, by range.
    pub accuracy: f64,
    /// Periods that are run first.
    pub settle: u64,
}

/// Where a period begins.
#[derive(Debug, Clone, Copy)]
struct Section {
    state: State,
    mode: Mode,
}

/// A periodic motion near (`state`, `mode`), or where that leads.
///
/// # Errors
/// [`NoOrbit`], which is an answer.
pub fn orbit(model: &Model, state: State, mode: Mode, shooting: &Shooting) -> Result<Orbit, NoOrbit> {
    if model.drive.train.is_some() {
        return Err(NoOrbit::Drivetrain);
    }
    if model.loads.abutment_nm_per_rad <= 0.0 {
        return Err(NoOrbit::NothingHolds);
    }
    let mut search = Search { model, shooting: shooting.clone(), periods: 0, least: f64::INFINITY };
    let (mut here, mut settle) = (Section { state, mode }, shooting.settle);
    let mut ended = None;
    for _ in 0..ROUNDS {
        for _ in 0..settle {
            here = search.period(&here, 0)?.0;
        }
        let mut found = search.newton(&here);
        // Small steps that grow no smaller are the error of a period, which multipliers near 1 show many times over.
        if matches!(found, Ok(None)) && search.least <= NEAR && search.finer() {
            found = search.newton(&here);
        }
        match found {
            Ok(Some(orbit)) => return Ok(orbit),
            Ok(None) => {}
            Err(NoOrbit::Ends(Stop::Interrupted)) => return Err(NoOrbit::Ends(Stop::Interrupted)),
            // A step too far; what the motion itself does counts.
            Err(why) => ended = Some(why),
        }
        settle = SETTLE[0].max(SETTLE[1] * settle);
    }
    Err(match ended {
        Some(why) if search.least.is_infinite() => why,
        _ => NoOrbit::NotConverged(search.least),
    })
}

struct Search<'a> {
    model: &'a Model,
    shooting: Shooting,
    periods: u64,
    /// Smallest Newton step so far.
    least: f64,
}

impl Search<'_> {
    /// Finer steps from here on; false where they are as fine as rounding lets them.
    fn finer(&mut self) -> bool {
        let tolerance = &mut self.shooting.period.tolerance;
        let before = *tolerance;
        *tolerance = (FINER * before).max(FINEST_STEPS).min(before);
        *tolerance < before
    }

    /// One period: where it ends, angles that run on counted from anew, and the run.
    fn period(&mut self, from: &Section, samples: usize) -> Result<(Section, Run), NoOrbit> {
        self.periods += 1;
        let settings = RunSettings { samples, ..self.shooting.period.clone() };
        let run = run(self.model, from.state, from.mode, &settings);
        if run.stop != Stop::Finished {
            return Err(NoOrbit::Ends(run.stop));
        }
        let mut state = run.state;
        for i in [1, 2, 8, 9] {
            state[i] = 0.0;
        }
        Ok((Section { state, mode: run.mode }, run))
    }

    /// Newton from `from`; `None`: it does not converge.
    fn newton(&mut self, from: &Section) -> Result<Option<Orbit>, NoOrbit> {
        let mut here = *from;
        let (mut end, first) = self.period(&here, SAMPLES)?;
        let ranges = ranges(&first);
        let mut known: Option<DMatrix<f64>> = None;
        let mut before = f64::INFINITY;
        let mut longest = LONGEST;
        // What the Jacobian says that a shortened step leaves, and how far that may be off.
        let mut said: Option<(DVector<f64>, f64)> = None;
        for _ in 0..MOST_STEPS {
            if !same_kind(&here.mode, &end.mode) {
                // A period on, it may begin as it ends.
                (here, known, before, said) = (end, None, f64::INFINITY, None);
                end = self.period(&here, 0)?.0;
                continue;
            }
            let free = free(&here.mode);
            let fresh = known.is_none();
            let Some(jacobian) = (match known.take() {
                Some(old) => Some(old),
                None => self.jacobian(&here, &free, &ranges, BESIDE)?,
            }) else {
                return Ok(None);
            };
            let left = DVector::from_fn(free.len(), |i, _| {
                (end.state[free[i]] - here.state[free[i]]) / ranges[free[i]]
            });
            if said.take().is_some_and(|(rest, within)| (&left - rest).amax() <= within) {
                longest *= LONGER;
            }
            let matrix = DMatrix::identity(free.len(), free.len()) - &jacobian;
            let Some(step) = matrix.lu().solve(&left) else { return Ok(None) };
            let size = step.amax();
            if !size.is_finite() {
                return Ok(None);
            }
            self.least = self.least.min(size);
            if size <= self.shooting.accuracy {
                let jacobian = match fresh || before <= NEAR {
                    true => Some(jacobian),
                    false => self.jacobian(&here, &free, &ranges, BESIDE)?,
                };
                let there = self.moved(&here, &free, &ranges, &step, 1.0);
                return self.found(&there, jacobian, &ranges, size);
            }
            if size > 2.0 * before {
                return Ok(None);
            }
            if size <= SERVES * before && before.is_finite() || fresh && size <= NEAR {
                known = Some(jacobian);
            }
            before = size;
            let share = (longest / size).min(1.0);
            if share < 1.0 {
                said = Some((&left * (1.0 - share), LINEAR * share * left.amax()));
            }
            here = self.moved(&here, &free, &ranges, &step, share);
            end = self.period(&here, 0)?.0;
        }
        Ok(None)
    }

    fn found(
        &mut self,
        there: &Section,
        jacobian: Option<DMatrix<f64>>,
        ranges: &State,
        error: f64,
    ) -> Result<Option<Orbit>, NoOrbit> {
        let (_, run) = self.period(there, self.shooting.period.samples)?;
        let Some(multipliers) = jacobian.and_then(multipliers) else { return Ok(None) };
        let multiplier_error = self.multiplier_error(there, &multipliers, ranges)?;
        let Section { state, mode } = *there;
        let periods = self.periods;
        Ok(Some(Orbit { state, mode, run, multipliers, multiplier_error, error, periods }))
    }

    /// What multipliers near the unit circle may be wrong by: rounding, and the third order of the map where any is near.
    fn multiplier_error(
        &mut self,
        there: &Section,
        found: &[[f64; 2]],
        ranges: &State,
    ) -> Result<f64, NoOrbit> {
        let rounding = self.shooting.period.tolerance / BESIDE;
        let near = |m: &&[f64; 2]| (magnitude(m) - 1.0).abs() < CLOSE;
        if found.iter().all(|m| !near(&m)) {
            return Ok(rounding);
        }
        let wider = self.jacobian(there, &free(&there.mode), ranges, 2.0 * BESIDE)?.and_then(multipliers);
        let Some(wider) = wider else { return Ok(rounding) };
        let off = |m: &[f64; 2]| {
            let each = wider.iter().map(|w| (w[0] - m[0]).hypot(w[1] - m[1]));
            each.fold(f64::INFINITY, f64::min)
        };
        Ok(rounding + found.iter().filter(near).map(off).fold(0.0, f64::max))
    }

    /// `from` moved by `share` of `step` in units of the ranges; rates that rolling determines follow, as at the start of any run.
    fn moved(
        &self,
        from: &Section,
        free: &[usize],
        ranges: &State,
        step: &DVector<f64>,
        share: f64,
    ) -> Section {
        let mut to = *from;
        for (k, &i) in free.iter().enumerate() {
            to.state[i] += share * step[k] * ranges[i];
        }
        let curve = &self.model.curve;
        to.mode.place = match from.mode.place {
            place @ (Place::Open | Place::Carried) => place,
            _ if self.shooting.period.rolling && to.state[0] < curve.first_contact_rad() => Place::Tension,
            _ => Place::Arc(curve.arc_at(to.state[0])),
        };
        to
    }

    /// DP in units of the ranges by disturbances of `beside`; `None` where a disturbed period ends in another mode.
    fn jacobian(
        &mut self,
        here: &Section,
        free: &[usize],
        ranges: &State,
        beside: f64,
    ) -> Result<Option<DMatrix<f64>>, NoOrbit> {
        let n = free.len();
        let mut jacobian = DMatrix::zeros(n, n);
        for k in 0..n {
            let mut ends = [[0.0; MOST]; 2];
            for (end, sign) in ends.iter_mut().zip([1.0, -1.0]) {
                let step = DVector::from_fn(n, |i, _| if i == k { sign * beside } else { 0.0 });
                let moved = self.moved(here, free, ranges, &step, 1.0);
                let (there, _) = self.period(&moved, 0)?;
                if !same_kind(&there.mode, &here.mode) {
                    return Ok(None);
                }
                for (e, &i) in end.iter_mut().zip(free) {
                    *e = there.state[i] / ranges[i];
                }
            }
            for i in 0..n {
                jacobian[(i, k)] = (ends[0][i] - ends[1][i]) / (2.0 * beside);
            }
        }
        Ok(Some(jacobian))
    }
}

/// What a period map acts on where it begins in `mode`: places in the state.
fn free(mode: &Mode) -> Vec<usize> {
    if mode.place == Place::Carried {
        return vec![3, 6, 7];
    }
    let inner = mode.inner == Grip::Stick && mode.place != Place::Open;
    match (inner, mode.outer == Grip::Stick) {
        (true, true) => vec![0, 3, 6, 7],
        (true, false) | (false, true) => vec![0, 3, 4, 6, 7],
        (false, false) => vec![0, 3, 4, 5, 6, 7],
    }
}

/// Whether both are the same but for the arc.
fn same_kind(a: &Mode, b: &Mode) -> bool {
    let apart = |mode: &Mode| matches!(mode.place, Place::Open | Place::Carried).then_some(mode.place);
    apart(a) == apart(b) && (apart(a).is_some() || a.inner == b.inner) && a.outer == b.outer
}

/// Half of what each number of the state varies by; that of a number that stays, by what the others do.
fn ranges(run: &Run) -> State {
    let range = |i: usize| {
        let each = run.samples.iter().map(|s| s.state[i]);
        let [low, high] = each.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], v| [l.min(v), h.max(v)]);
        0.5 * (high - low)
    };
    let all: [f64; N_STATE] = std::array::from_fn(range);
    let least = |group: std::ops::Range<usize>| 1e-3 * all[group].iter().fold(1e-9_f64, |a, b| a.max(*b));
    let (angle, rate) = (least(0..4), least(4..8));
    std::array::from_fn(|i| all[i].max(if i < 4 { angle } else { rate }))
}

fn magnitude(multiplier: &[f64; 2]) -> f64 {
    multiplier[0].hypot(multiplier[1])
}

/// Eigenvalues, the largest first; `None` where they are not found.
fn multipliers(jacobian: DMatrix<f64>) -> Option<Vec<[f64; 2]>> {
    let mut all: Vec<[f64; 2]> = eigenvalues(jacobian)?.iter().map(|z| [z.re, z.im]).collect();
    all.sort_by(|a, b| magnitude(b).total_cmp(&magnitude(a)).then(b[1].total_cmp(&a[1])));
    Some(all)
}
