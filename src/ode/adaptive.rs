//! Explicit steps, implicit ones where they go further for the same work.
//!
//! DOP853 is the rule. Where many steps in a row are far shorter than asked for, the Jacobian tells whether
//! stability is what holds them (h |lambda| beyond 2); if so a Radau step four times as long is tried, and if its
//! error lets it pass, implicit steps go on until they are no longer than twice an explicit step at its limit of
//! stability, for they cost about twice as much. An oscillation that is really excited fails the trial: its error
//! is above the tolerance, so it is followed.

use super::radau5::Radau;
use super::rhs::RightHandSide;
use super::step::{Counters, Room, Step, Tolerance};
use nalgebra::{Const, DimMin};
use serde::{Deserialize, Serialize};

/// A length of state whose Jacobian can be factorised: every one that is used is.
pub trait Size: DimMin<Self, Output = Self> + Sized {}

impl<const N: usize> Size for Const<N> where Self: DimMin<Self, Output = Self> {}

/// Shortest step that is still taken, s.
const SHORTEST_STEP: f64 = 1e-15;
/// h |lambda| at which DOP853 ceases to be stable on the negative real axis.
const STABLE: f64 = 6.1;
/// Short steps before the Jacobian is asked; doubles with each answer that keeps explicit steps.
const PATIENCE: u32 = 20;
const MOST_PATIENCE: u32 = 5_000;
/// Weighted error up to which an explicit step is taken at the first trial, 1 after a failed one. Where steps are as long
/// as a radian or two of the fastest swing the estimates of neighbours scatter tenfold, and a step refused costs more than
/// one that is a little too long spoils; where one has failed the right-hand side may be rough and the estimate too small.
const AT_ONCE: f64 = 1.5;
/// Weighted error below which a step may step over a rough place. Of a slope as |s - s_0|^(10/9) somewhere inside a step
/// the error is up to 94 times the estimate, at its ends 0.8 to 3.6 times.
const SMOOTH: f64 = 0.1;
/// Steps shorter than this part of the longest count as short.
const SHORT: f64 = 0.2;
/// How much longer an implicit step must be to be tried.
const WORTH: f64 = 4.0;

/// Step-size and method control of one integration.
#[derive(Debug, Clone)]
pub struct Adaptive<const N: usize>
where
    Const<N>: DimMin<Const<N>, Output = Const<N>>,
{
    /// Length to try next.
    pub h: f64,
    /// What a step's error may be.
    pub tolerance: Tolerance<N>,
    floor: f64,
    implicit: bool,
    short: u32,
    patience: u32,
    radau: Radau<N>,
}

/// What the control of steps knows apart from the right-hand side: plain numbers.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Pace {
    /// Length to try next, s.
    pub h: f64,
    implicit: bool,
    short: u32,
    patience: u32,
}

impl<const N: usize> Adaptive<N>
where
    Const<N>: DimMin<Const<N>, Output = Const<N>>,
{
    /// Begin with explicit steps of length `h`. `floor`: size below which a component counts as this large when
    /// its increment for a Jacobian is chosen.
    pub fn new(tolerance: Tolerance<N>, h: f64, floor: f64) -> Self {
        let radau = Radau::new();
        Self { h, tolerance, floor, implicit: false, short: 0, patience: PATIENCE, radau }
    }

    /// Its pace at present.
    pub fn pace(&self) -> Pace {
        Pace { h: self.h, implicit: self.implicit, short: self.short, patience: self.patience }
    }

    /// Go on at `pace`, as after [`Self::forget`].
    pub fn go_on_at(&mut self, pace: Pace) {
        (self.h, self.implicit, self.short, self.patience) =
            (pace.h, pace.implicit, pace.short, pace.patience);
        self.forget();
    }

    /// The right-hand side has changed: nothing known of the old one holds.
    pub fn forget(&mut self) {
        self.radau.forget();
    }

    /// An accepted step of at most `longest`, shortened to `rest`, in `room`; `None` where steps become too short.
    /// Two functions of the length h of a step that has just been tried: `useful`, how much of it is worth another trial
    /// where it has failed (h: all of it), and `smooth`, how far the right-hand side is smooth.
    pub fn step<'a, R: RightHandSide<N>>(
        &mut self,
        room: &'a mut Room<N>,
        rhs: &mut R,
        (useful, smooth): (&impl Fn(f64) -> f64, &impl Fn(f64) -> f64),
        t: f64,
        y: &[f64; N],
        slope: &[f64; N],
        longest: f64,
        rest: f64,
        counters: &mut Counters,
    ) -> Option<Step<'a, N>> {
        let before = self.h;
        let mut h = self.h.min(longest).min(rest);
        let mut rejected = false;
        let mut cuts = 0;
        let mut most = AT_ONCE;
        loop {
            if h < SHORTEST_STEP && (h < rest || rest <= 0.0) {
                return None;
            }
            let (shorter, worth) = if self.implicit {
                match self.radau.step(rhs, t, y, slope, h, &self.tolerance, self.floor, counters) {
                    Some(s) if s.error <= 1.0 => {
                        room.implicit = s;
                        break;
                    }
                    Some(s) => (s.next_h().min(0.9 * h), h),
                    None => (0.25 * h, h),
                }
            } else {
                match room.explicit.take(rhs, t, y, slope, h, &self.tolerance, most, counters) {
                    Ok(()) if room.explicit.error <= most => {
                        // Stages beyond a rough place spoil more than the estimate sees. The second cut lands on it; more
                        // would go on towards it for ever.
                        let sound = if cuts < 2 && room.explicit.error > SMOOTH { smooth(h) } else { h };
                        if sound > 0.99 * h {
                            break;
                        }
                        cuts += 1;
                        (h, sound)
                    }
                    Ok(()) => (room.explicit.next_h().min(0.9 * h), useful(h)),
                    Err(_) => (0.25 * h, h),
                }
            };
            counters.rejections += 1;
            most = 1.0;
            rejected = shorter <= worth;
            h = shorter.min(worth);
        }
        let tried = h;
        let implicit = if self.implicit {
            self.h = room.implicit.next_h();
            let explicit = self.radau.fastest().map_or(f64::INFINITY, |rate| STABLE / rate);
            if self.h.min(longest) < 0.5 * WORTH * explicit {
                (self.implicit, self.h, self.patience) = (false, self.h.min(explicit), PATIENCE);
            }
            true
        } else {
            self.maybe_implicit(room, rhs, slope, longest, rest, counters)
        };
        counters.implicit_steps += u64::from(implicit);
        // No longer at once after a rejection: a step bounded by stability would be rejected every other time.
        if rejected && !implicit {
            self.h = self.h.min(tried);
        }
        // What was cut short from outside says nothing against the length before.
        if !rejected && tried == rest {
            self.h = self.h.max(before);
        }
        Some(if implicit { Step::Implicit(&room.implicit) } else { Step::Explicit(&room.explicit) })
    }

    /// After an explicit step in `room`: the next length, and whether an implicit one of its beginning, then in `room`
    /// too, goes further.
    fn maybe_implicit<R: RightHandSide<N>>(
        &mut self,
        room: &mut Room<N>,
        rhs: &mut R,
        slope: &[f64; N],
        longest: f64,
        rest: f64,
        counters: &mut Counters,
    ) -> bool {
        let step = &room.explicit;
        self.h = step.next_h();
        if step.h >= SHORT * longest.min(rest) {
            self.short = 0;
            return false;
        }
        self.short += 1;
        if self.short < self.patience {
            return false;
        }
        self.short = 0;
        self.patience = (2 * self.patience).min(MOST_PATIENCE);
        let (t, y) = (step.t, &step.y0);
        if self.radau.differentiate(rhs, t, y, slope, self.floor, counters).is_err()
            || self.radau.fastest().is_none_or(|rate| step.h * rate < 2.0)
        {
            return false;
        }
        let h = (WORTH * step.h).min(longest).min(rest);
        match self.radau.step(rhs, t, y, slope, h, &self.tolerance, self.floor, counters) {
            Some(s) if s.error <= 1.0 => {
                (self.implicit, self.h) = (true, s.next_h());
                room.implicit = s;
                true
            }
            _ => false,
        }
    }

    /// Fastest rate of the right-hand side at (t, y), 1/s, and the part of the slope there that is as fast.
    pub fn fastest<R: RightHandSide<N>>(
        &mut self,
        rhs: &mut R,
        t: f64,
        y: &[f64; N],
        counters: &mut Counters,
    ) -> Option<(f64, [f64; N])> {
        let slope = rhs.slope(t, y).ok()?;
        counters.rhs_evaluations += 1;
        self.radau.differentiate(rhs, t, y, &slope, self.floor, counters).ok()?;
        self.radau.fast_part(&slope)
    }
}
