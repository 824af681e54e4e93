//! What explicit and implicit steps have in common: tolerances, work done, the step taken and what lies inside it.

use super::rhs::RightHandSide;
use super::{dop853, radau5};

/// Work done.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Counters {
    /// Accepted steps, of both kinds.
    pub steps: u64,
    /// Accepted steps that were implicit.
    pub implicit_steps: u64,
    /// Rejected steps.
    pub rejections: u64,
    /// Evaluations of the right-hand side, those for Jacobians included.
    pub rhs_evaluations: u64,
    /// Jacobians by differences.
    pub jacobians: u64,
    /// Factorisations of the pair of Newton matrices.
    pub factorisations: u64,
}

/// Tolerances per component: |error_i| <= absolute_i + relative |y_i - datum_i|.
#[derive(Debug, Clone, Copy)]
pub struct Tolerance<const N: usize> {
    /// Relative part, pure number.
    pub relative: f64,
    /// Absolute part, in the unit of each component.
    pub absolute: [f64; N],
    /// Implicit steps only: what a component may be wrong by, times h, in the unit of its integral. For rates, the
    /// tolerance of the angle: an oscillation far faster than the step is felt through the angle alone.
    pub integrated: [f64; N],
    /// What the size of a component is counted from: 0, but for what runs on without end.
    pub datum: [f64; N],
}

impl<const N: usize> Tolerance<N> {
    /// Size of the error that component `i` may have.
    pub(super) fn scale(&self, i: usize, a: f64, b: f64) -> f64 {
        let size = |y: f64| (y - self.datum[i]).abs();
        self.absolute[i] + self.relative * size(a).max(size(b))
    }
}

/// Room for the steps of one integration, which are written there and not copied.
#[derive(Debug, Clone)]
pub struct Room<const N: usize> {
    pub(super) explicit: dop853::Step<N>,
    pub(super) implicit: radau5::Step<N>,
}

impl<const N: usize> Room<N> {
    /// Nothing in it.
    pub fn new() -> Self {
        Self { explicit: dop853::Step::new(), implicit: radau5::Step::new() }
    }
}

impl<const N: usize> Default for Room<N> {
    fn default() -> Self {
        Self::new()
    }
}

/// An accepted step.
#[derive(Debug, Clone)]
pub enum Step<'a, const N: usize> {
    /// DOP853.
    Explicit(&'a dop853::Step<N>),
    /// Radau IIA.
    Implicit(&'a radau5::Step<N>),
    /// The beginning of either, up to an event, read off its dense output.
    Part(StepPart<'a, N>),
}

/// The first `h` of a longer step.
#[derive(Debug, Clone)]
pub struct StepPart<'a, const N: usize> {
    h: f64,
    y0: [f64; N],
    y1: [f64; N],
    t: f64,
    dense: &'a Dense<N>,
}

/// Dense output of a step.
#[derive(Debug, Clone)]
pub enum Dense<const N: usize> {
    /// Order 7.
    Explicit(dop853::Dense<N>),
    /// The collocation polynomial, order 3.
    Implicit(radau5::Step<N>),
}

impl<const N: usize> Step<'_, N> {
    /// Start time.
    pub fn t(&self) -> f64 {
        match self {
            Self::Explicit(s) => s.t,
            Self::Implicit(s) => s.t,
            Self::Part(s) => s.t,
        }
    }

    /// Length.
    pub fn h(&self) -> f64 {
        match self {
            Self::Explicit(s) => s.h,
            Self::Implicit(s) => s.h,
            Self::Part(s) => s.h,
        }
    }

    /// State at the start.
    pub fn y0(&self) -> &[f64; N] {
        match self {
            Self::Explicit(s) => &s.y0,
            Self::Implicit(s) => &s.y0,
            Self::Part(s) => &s.y0,
        }
    }

    /// State at the end.
    pub fn y1(&self) -> &[f64; N] {
        match self {
            Self::Explicit(s) => &s.y1,
            Self::Implicit(s) => &s.y1,
            Self::Part(s) => &s.y1,
        }
    }

    /// Whether it is a whole explicit step.
    pub fn is_explicit(&self) -> bool {
        matches!(self, Self::Explicit(_))
    }

    /// Where to probe it, as fractions of its length: an explicit step's right-hand side has been there.
    pub fn probes(&self) -> &'static [f64] {
        if self.is_explicit() { &dop853::PROBES } else { &[0.0, 0.25, 0.5, 0.75, 1.0] }
    }

    /// State at t + theta h without extra evaluations, for a first probe only.
    pub fn glance(&self, theta: f64) -> [f64; N] {
        match self {
            Self::Explicit(s) => s.glance(theta),
            Self::Implicit(s) => s.after(theta * s.h),
            Self::Part(s) => s.dense.after(theta * s.h),
        }
    }

    /// Its first `h`, known by its dense output.
    pub fn until<'d>(&self, h: f64, dense: &'d Dense<N>) -> Step<'d, N> {
        let (t, y0) = (self.t(), *self.y0());
        Step::Part(StepPart { h, y0, y1: dense.after(h), t, dense })
    }

    /// Dense output.
    ///
    /// # Errors
    /// Those of the right-hand side.
    pub fn dense<R: RightHandSide<N>>(
        &self,
        rhs: &mut R,
        counters: &mut Counters,
    ) -> Result<Dense<N>, R::Failure> {
        Ok(match self {
            Self::Explicit(s) => Dense::Explicit(s.dense(rhs, counters)?),
            Self::Implicit(s) => Dense::Implicit((*s).clone()),
            Self::Part(s) => s.dense.clone(),
        })
    }
}

impl<const N: usize> Dense<N> {
    /// State at time `t` inside the step.
    pub fn at(&self, t: f64) -> [f64; N] {
        match self {
            Self::Explicit(d) => d.at(t),
            Self::Implicit(d) => d.at(t),
        }
    }

    /// State `elapsed` (s) after the start of the step: where a step is so short that its start swallows parts of it, time
    /// itself does not tell them apart.
    pub fn after(&self, elapsed: f64) -> [f64; N] {
        match self {
            Self::Explicit(d) => d.after(elapsed),
            Self::Implicit(d) => d.after(elapsed),
        }
    }
}
