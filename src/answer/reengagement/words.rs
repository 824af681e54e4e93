//! What follows from a blow that is not borne: what would be borne, and what to change.

use super::{BorneSlip, ReengagementAnswer};
use crate::answer::Said;
use crate::report::{Unit, significant};

impl ReengagementAnswer<'_> {
    /// Which number to change, and towards where, after a blow that is not borne.
    pub(super) fn next_step(&self) -> Option<String> {
        if self.is_held() || self.found.holds.is_some() {
            return None;
        }
        let needs = Some(self.found.needs).filter(|mu| mu.is_finite())?;
        let lost = self.found.list.iter().find(|b| !self.bears_it(b));
        let energy = lost.and_then(|b| Some((b, self.energy(b)?.1.filter(|share| *share > 1.0)?)));
        let blow = energy.map_or(String::new(), |(b, share)| {
            format!(
                "; to bear {} of slip its windup must take up {} times as much: less torque (--torque), or a clutch for more (`size --peak`)",
                Unit::Millimetre.show(b.path_m, 3),
                significant(share, 3)
            )
        });
        Some(format!(
            "Next: keep it from slipping at all, with sprags that need less friction than {} (`optimize --objective slip-margin`){blow}",
            significant(needs, 3)
        ))
    }

    pub(super) fn borne_words(&self, borne: &BorneSlip) -> String {
        let path = |m: f64| Unit::Millimetre.show(m, 3);
        let friction = significant(self.case.friction, 3);
        let first = match borne.path_m {
            Some(m) => format!("At a friction of {friction} slip up to {} is borne", path(m)),
            None => format!("At a friction of {friction} no slip is borne, however short"),
        };
        let shortest = self.case.paths_m.first().map_or(String::new(), |m| path(*m));
        let then = match borne.friction {
            Some(mu) if mu > self.case.friction => {
                format!("; {shortest} is borne from a friction of {} on", significant(mu, 4))
            }
            Some(_) => String::new(),
            None => format!("; {shortest} is borne at none that slips"),
        };
        first + &then
    }
}
