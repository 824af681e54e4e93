//! Lift-off in the margin check: its speed, what puts it up, and what a film drags beyond.

use super::overrun::{OverrunRow, OverrunSection};
use crate::answer::overrun::SHOWN_LATER;
use crate::report::{Unit, significant};

/// Clearance outside a pivot that is not known beforehand, um: a choice.
const UNKNOWN_UM: f64 = 10.0;

impl OverrunSection {
    /// Where the sprags lift off, if they do up to `searched_to_rpm`.
    pub(super) fn lift_off_remark(&self, lift_off_rpm: Option<f64>, searched_to_rpm: f64) -> String {
        if let Some(cage) = &self.cage {
            let Some(rpm) = lift_off_rpm else {
                return format!(
                    "Sprags keep contact with the outer race up to {searched_to_rpm:.0} rpm of the inner race at least{}",
                    cage.never_lifts().unwrap_or_default()
                );
            };
            if rpm <= 0.0 {
                return "No spring closes the sprags: nothing presses them on the outer race".to_owned();
            }
            return format!(
                "Sprags lift off the outer race at {rpm:.0} rpm of the inner race{}{}; {} later for each µm of \
                 clearance outside the pivot {}{}",
                if self.on_film {
                    ", on oil by and by from there on: `overrun` has what the film drags beyond"
                } else {
                    ", dry: keep above it in long overrun; on oil, [lubrication], they float on a film that drags"
                },
                match cage.comes_back_there {
                    true => "; they come back at the same speed",
                    false =>
                        "; they open at once as far as the cage lets them, and come back at a lower speed",
                },
                Unit::Percent.show(cage.lift_off_later_per_um, 2),
                match cage.clearance_um {
                    0.0 => "(cage.clearance_um, none here)".to_owned(),
                    um => format!("beyond the {} µm of the file", significant(um, 3)),
                },
                match cage.lift_off_later_at_most {
                    later if later >= SHOWN_LATER => format!(
                        "; up to {} later if the inner race, not the cage, took them along while the drag was measured",
                        Unit::Percent.show(later, 2)
                    ),
                    _ => String::new(),
                }
            );
        }
        let why = match self.centrifugal {
            "engaging" => {
                ": the outer race grows with speed, the sprags turn on, and the centrifugal force changes its sense"
            }
            _ => "",
        };
        let more = self.lift_off_more_drag_rpm.filter(|_| lift_off_rpm.is_some_and(|rpm| rpm > 0.0));
        let more = more.map_or(String::new(), |rpm| format!(" ({rpm:.0} with 10 % more drag)"));
        match (self.outer_race_turns, lift_off_rpm) {
            (true, Some(rpm)) => {
                format!("Sprags lift off the inner race at {rpm:.0} rpm of the outer race{more}{why}")
            }
            (true, None) => format!("Sprags keep contact in overrun up to {searched_to_rpm:.0} rpm at least"),
            (false, Some(rpm)) => format!(
                "No speed of the outer race is named; if it turned in overrun, sprags would lift off the inner race at \
                 {rpm:.0} rpm of it{why}"
            ),
            (false, None) => format!(
                "No speed of the outer race is named; if it turned in overrun, sprags would keep contact up to \
                 {searched_to_rpm:.0} rpm of it at least"
            ),
        }
    }

    /// What the sentence before leaves unsaid: that a lift-off in time may come too late, and that the film drags more beyond.
    pub(super) fn beyond_lift_off(&self, lift_off_rpm: Option<f64>) -> impl Iterator<Item = String> {
        let off_rpm = lift_off_rpm.filter(|rpm| *rpm > 0.0 && self.cage.is_some());
        let said = off_rpm.map(|rpm| [self.perhaps_too_late(rpm), self.drags_beyond(rpm)]);
        said.into_iter().flatten().flatten()
    }

    /// A warning where lift-off at `off_rpm` keeps the limit, and what puts it up may take it beyond.
    fn perhaps_too_late(&self, off_rpm: f64) -> Option<String> {
        let (cage, by_rpm) = (self.cage.as_ref()?, self.lift_off_by_rpm.filter(|by| off_rpm <= *by)?);
        let latest_rpm = off_rpm * (1.0 + cage.lift_off_later_at_most);
        let (room, per_um) = (by_rpm / off_rpm - 1.0, cage.lift_off_later_per_um);
        let by_cage = (room < UNKNOWN_UM * per_um).then(|| {
            format!(
                "more than {} µm of clearance outside the pivot",
                significant(cage.clearance_um + room / per_um, 2)
            )
        });
        let by_race = (latest_rpm > by_rpm).then(|| {
            format!(
                "the inner race, had it taken the sprags along while the drag was measured ({latest_rpm:.0} rpm at the latest),"
            )
        });
        let by: Vec<String> = by_cage.into_iter().chain(by_race).collect();
        (!by.is_empty()).then(|| {
            format!(
                "Warning: lift-off at {off_rpm:.0} rpm is held, by {by_rpm:.0} rpm (lift_off_by_rpm), but {} would put it beyond; a softer \
                 spring leaves more room",
                by.join(", or ")
            )
        })
    }

    /// A note where the film drags more beyond lift-off without oil, at `off_rpm`, than anywhere up to it.
    fn drags_beyond(&self, off_rpm: f64) -> Option<String> {
        let most = |beyond: bool| {
            let there = self.points.iter().filter(|p| p.race == "inner" && (p.speed_rpm > off_rpm) == beyond);
            there.max_by(|a, b| a.drag_torque_nm.total_cmp(&b.drag_torque_nm))
        };
        let (below, beyond) = (most(false)?, most(true).filter(|p| !p.lifted_off)?);
        let at = |p: &OverrunRow| {
            format!("{} at {:.0} rpm", Unit::NewtonMetre.show(p.drag_torque_nm, 3), p.speed_rpm)
        };
        (self.on_film && beyond.drag_torque_nm > below.drag_torque_nm).then(|| {
            format!(
                "Note: on this oil the film drags more beyond lift-off, {}, than up to it, {} at most: lifting off saves wear, not heat; thinner \
                 oil, or less of it at the inlet, drags less",
                at(beyond),
                at(below)
            )
        })
    }
}
