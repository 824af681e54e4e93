//! Sprags lost one after another: the most pressed one fails, the others take its share.

use super::{Asked, NotShared, Shared, Unlike};

/// The clutch after a loss.
#[derive(Debug, Clone, PartialEq)]
pub struct Loss {
    /// Number of the sprag that is lost.
    pub lost: usize,
    /// What the others carry then; why they do not.
    pub left: Result<Shared, NotShared>,
    /// One of the others that then needs more friction than it has.
    pub slips: Option<usize>,
}

impl Loss {
    /// Sprag `lost` gone from those that are left, and what these carry.
    pub(super) fn new(lost: usize, others: &Unlike<'_>, left: Result<Shared, NotShared>) -> Self {
        let slips = left.as_ref().ok().and_then(|left| others.slipping(left));
        Self { lost, left, slips }
    }
}

impl Unlike<'_> {
    /// A sprag that needs more friction than it has, of several the one that lacks most.
    pub fn slipping(&self, shared: &Shared) -> Option<usize> {
        let lacks = |i: usize| shared.loads[i].required_friction() / self.sprags[i].friction;
        (0..self.sprags.len()).filter(|&i| lacks(i) > 1.0).max_by(|a, b| lacks(*a).total_cmp(&lacks(*b)))
    }

    /// From `whole` on, at its torque: the most pressed sprag is lost, and again, until those left do not carry the torque or one of
    /// them is pressed beyond `allowed_pa` or slips. The last entry is that; empty: `whole` is beyond it already.
    pub fn losses(&self, whole: &Shared, allowed_pa: f64) -> Vec<Loss> {
        let mut left = self.clone();
        let mut now = whole.clone();
        let mut losses = Vec::new();
        let mut slips = self.slipping(whole).is_some();
        while !slips && now.worst(|l| l.hertz_pa()).1 <= allowed_pa {
            let (lost, _) = now.worst(|l| l.hertz_pa());
            left = left.without(lost);
            let after = left.carrying(Asked::Torque(whole.torque_nm), whole.turned_rad);
            let loss = Loss::new(lost, &left, after.clone());
            slips = loss.slips.is_some();
            losses.push(loss);
            match after {
                Ok(after) => now = after,
                Err(_) => break,
            }
        }
        losses
    }
}
