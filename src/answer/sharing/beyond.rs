//! What follows the end of a sprag among others: `sharing` beyond it.

use super::{SharingAnswer, largest};
use crate::report::{Plot, Rows, Unit};
use crate::sharing::{Bears, Loss, NotShared, PopPoint};

impl SharingAnswer<'_> {
    /// Beyond the end: the torque as the races are turned on.
    pub(super) fn over(&self) -> Rows<&PopPoint> {
        let course = self.pops.as_ref().map(|pops| pops.course.as_slice()).unwrap_or_default();
        Rows::of(course)
            .number("windup_deg", "Windup", Unit::Degree, 4, |p| p.windup_rad)
            .number("torque_nm", "Torque", Unit::NewtonMetre, 4, |p| p.torque_nm)
            .number("over", "Beyond their end", Unit::One, 3, |p| p.over)
            .number("gone", "Gone", Unit::One, 3, |p| p.gone)
    }

    /// Under the torque at which the first comes to its end: who goes over.
    pub(super) fn popped(&self) -> Rows<&Loss> {
        let left = self.pops.as_ref().map(|pops| pops.left.as_slice()).unwrap_or_default();
        let found = |l: &Loss| l.left.clone().ok();
        Rows::of(left)
            .number("popped", "Goes over", Unit::One, 3, |l| l.lost + 1)
            .number("carrying", "Carry then", Unit::One, 3, |l| found(l).map(|s| s.carrying()))
            .number("largest_share", "Largest share", Unit::One, 4, |l| {
                found(l).map(|s| largest(&s.shares()))
            })
            .number("hertz_mpa", "p₀", Unit::Megapascal, 4, |l| {
                found(l).map(|s| s.worst(Bears::hertz_pa).1)
            })
            .text("left", "The others", |l| match &l.left {
                Ok(_) => "carry it".to_owned(),
                Err(why) => why.words(),
            })
    }

    /// The torque as the races are turned on.
    pub(super) fn turned_on(&self) -> Plot {
        let course = self.pops.as_ref().map(|pops| pops.course.as_slice()).unwrap_or_default();
        let points = course.iter().map(|p| [Unit::Degree.from_si(p.windup_rad), p.torque_nm]).collect();
        Plot::new("Windup, °", "Torque, Nm").curve("all sprags", points)
    }

    /// What follows the end, in words.
    pub(super) fn over_words(&self) -> String {
        let Some(pops) = &self.pops else { return String::new() };
        let first = pops.left.first().map_or(0, |l| l.lost + 1);
        let mut said = format!(
            "; turned on beyond it, between round races, the torque is {} at most, at a windup of {} with {} beyond their end",
            Unit::NewtonMetre.show(pops.peak.torque_nm, 4),
            Unit::Degree.show(pops.peak.windup_rad, 4),
            pops.peak.over
        );
        said += &match (pops.left.len(), pops.left_nm) {
            (_, None) => format!(
                "; under the torque of the end, once sprag {first} has gone over, {}",
                match pops.left.last().and_then(|l| l.left.as_ref().err()) {
                    Some(NotShared::NoBalance) =>
                        "whether the others carry it is not known, no balance of their forces was found"
                            .to_owned(),
                    Some(NotShared::NoneCarries) | None => "the others follow: nothing remains".to_owned(),
                    Some(why) => format!("the others do not carry it: {}", why.words()),
                }
            ),
            (1, Some(nm)) => format!(
                "; once sprag {first} has gone over the others carry up to {}",
                Unit::NewtonMetre.show(nm, 4)
            ),
            (many, Some(nm)) => format!(
                "; once sprag {first} has gone over so do {} more, the others carry up to {}",
                many - 1,
                Unit::NewtonMetre.show(nm, 4)
            ),
        };
        said
    }
}
