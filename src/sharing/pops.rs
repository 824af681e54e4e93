//! Beyond the end: sprags go over their highest place one after another, and what then remains.
//!
//! Races turned on at will, round, on one axis: each sprag has the torque of its own windup, on the curve and then on
//! the falling branch ([`crate::wedge::RollOver`]), so the clutch has sum C_1(W - lag_i) at the windup W. With sprags
//! alike that is the branch itself. It passes its peak, falls, and what was stored comes back. Under a torque that
//! stays, the sprag that comes to its end first goes over at once: what the others carry then follows from statics
//! with it gone, races bending, and so on.

use super::{Asked, Loss, NotShared, Unlike};
use crate::wedge::{EndReason, RollOver};

/// Windups at which the way is looked at.
const POINTS: usize = 240;
/// Golden sections that sharpen the peak.
const SECTIONS: usize = 50;
/// Halvings that locate what is carried.
const HALVINGS: usize = 24;

/// All sprags at one windup.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PopPoint {
    /// Windup since the first sprag touched, rad.
    pub windup_rad: f64,
    /// Torque of the clutch, N m; below 0 the sprags drive the races on.
    pub torque_nm: f64,
    /// How many have passed their end.
    pub over: usize,
    /// How many of these bear nothing any more.
    pub gone: usize,
}

/// Sprags that go over one after another.
#[derive(Debug, Clone, PartialEq)]
pub struct Pops {
    /// From no load to the loss of the last contact.
    pub course: Vec<PopPoint>,
    /// Where the torque is largest.
    pub peak: PopPoint,
    /// Windup at which each comes to its end, rad; `None`: it carries nothing.
    pub ends_rad: Vec<Option<f64>>,
    /// Under the torque at which the first comes to its end: who goes over, and what the others carry; the last entry
    /// is those that carry it, or that none do.
    pub left: Vec<Loss>,
    /// Torque, N m, that those of the last entry carry before the next comes to its end; `None`: they do not carry it.
    pub left_nm: Option<f64>,
}

impl Unlike<'_> {
    /// Sprag `first` comes to its end at `end_nm`, N m, for `reason`; what follows. `way`: what comes after the end
    /// of the curve. `None` where the axes lie apart: a falling branch knows races on one axis only.
    pub fn pops(
        &self,
        first: (usize, EndReason),
        end_nm: f64,
        turned_rad: f64,
        way: &RollOver,
    ) -> Option<Pops> {
        if self.offset_m != 0.0 {
            return None;
        }
        let begins = self.lag_rad.iter().flatten().copied().fold(f64::INFINITY, f64::min);
        let lags: Vec<Option<f64>> = self.lag_rad.iter().map(|lag| lag.map(|lag| lag - begins)).collect();
        let (end, last) = (self.curve.end_windup_rad(), way.last.windup_rad);
        let count = self.sprags.len() as f64;
        let own_nm = |y: f64| match y {
            _ if y <= 0.0 || y >= last => 0.0,
            _ if y <= end => self.curve.at_windup(y).map_or(0.0, |(p, _)| p.t_static * p.oa),
            _ => way.at_windup(y).map_or(0.0, |p| p.torque_nm / count),
        };
        let at = |windup_rad: f64| {
            let own = || lags.iter().flatten().map(|lag| windup_rad - lag);
            PopPoint {
                windup_rad,
                torque_nm: own().map(own_nm).sum(),
                over: own().filter(|y| *y > end).count(),
                gone: own().filter(|y| *y >= last).count(),
            }
        };
        let until = lags.iter().flatten().copied().fold(0.0, f64::max) + last;
        let course: Vec<PopPoint> = (0..=POINTS).map(|i| at(until * i as f64 / POINTS as f64)).collect();
        let top = (0..=POINTS).max_by(|a, b| course[*a].torque_nm.total_cmp(&course[*b].torque_nm))?;
        let step = until / POINTS as f64;
        let middle = course[top].windup_rad;
        let (mut a, mut b) = ((middle - step).max(0.0), (middle + step).min(until));
        for _ in 0..SECTIONS {
            let (c, d) = (b - 0.618_033_988_749_895 * (b - a), a + 0.618_033_988_749_895 * (b - a));
            if at(c).torque_nm > at(d).torque_nm { b = d } else { a = c }
        }
        let peak = [at(0.5 * (a + b)), course[top]];
        let peak = if peak[0].torque_nm > peak[1].torque_nm { peak[0] } else { peak[1] };
        let ends_rad = lags.iter().map(|lag| lag.map(|lag| lag + end)).collect();
        let (left, left_nm) = self.one_after_another(first.0, end_nm, turned_rad);
        Some(Pops { course, peak, ends_rad, left, left_nm })
    }

    /// Sprag `first` is gone under `torque_nm`, and then whoever comes to its end, until the others carry it or none is left.
    fn one_after_another(&self, first: usize, torque_nm: f64, turned_rad: f64) -> (Vec<Loss>, Option<f64>) {
        let (mut left, mut next, mut losses) = (self.clone(), first, Vec::new());
        loop {
            left = left.without(next);
            let after = left.carrying(Asked::Torque(torque_nm), turned_rad);
            losses.push(Loss::new(next, &left, after.clone()));
            match after {
                Err(NotShared::End(another, _)) => next = another,
                Err(_) => return (losses, None),
                Ok(_) => break,
            }
        }
        // Up to twice the torque at which the first goes: no clutch has more left.
        let (mut held, mut beyond) = (torque_nm, 2.0 * torque_nm);
        for _ in 0..HALVINGS {
            let torque = 0.5 * (held + beyond);
            match left.carrying(Asked::Torque(torque), turned_rad) {
                Ok(_) => held = torque,
                Err(_) => beyond = torque,
            }
        }
        (losses, Some(held))
    }
}
