//! What a blow rests on, and what follows from one that is not borne: its energy, what would be borne, and what to change.

use super::{BorneSlip, ReengagementAnswer};
use crate::answer::Said;
use crate::answer::check::overrun::outer_turns;
use crate::answer::inertia::{InertiaFrom, drivetrain_apart, inertia_from};
use crate::dynamics::Stop;
use crate::reengage::{Blow, SlipEnd};
use crate::report::{Unit, significant};

impl ReengagementAnswer<'_> {
    /// The answer in a sentence.
    pub(super) fn verdict_words(&self) -> String {
        let cut = match (self.borne_stopped, self.over.len() < self.over_asked) {
            (true, _) => "; stopped before what would be borne was known",
            (false, true) => "; stopped before every friction and inertia was known",
            (false, false) => "",
        };
        self.blow_words() + cut
    }

    /// What each path of slip comes to.
    fn blow_words(&self) -> String {
        if let Some(needed) = self.found.holds {
            return format!(
                "HELD: it does not slip: {} needs a friction of {}, and {} is there",
                Unit::NewtonMetre.show(self.case.torque_nm, 4),
                significant(needed, 3),
                significant(self.case.friction, 3)
            );
        }
        if let Some(end) = self.found.ended {
            return self.lost(&end);
        }
        let limit = self.bears.as_ref().map_or(String::new(), |(torque_nm, code)| {
            format!(", of {} that {code} allows", Unit::NewtonMetre.show(*torque_nm, 4))
        });
        let path = |b: &Blow| Unit::Millimetre.show(b.path_m, 3);
        match self.found.list.iter().find(|b| !self.bears_it(b)) {
            Some(b) => match &b.peak {
                Some(p) => format!(
                    "NOT HELD: after {} of slip the blow comes to {}{limit}",
                    path(b),
                    Unit::NewtonMetre.show(p.torque_nm, 4)
                ),
                None => match b.ended {
                    Some(Stop::Interrupted) => format!("stopped after {} of slip", path(b)),
                    Some(Stop::FellAway) => format!(
                        "NOT HELD: after {} of slip the sprags are out of reach, and nothing brings them back",
                        path(b)
                    ),
                    Some(stop) if stop.gave_up() => format!(
                        "NOT HELD: after {} of slip the clutch has not gripped as long as it was followed ({})",
                        path(b),
                        stop.name()
                    ),
                    _ => format!(
                        "NOT HELD: after {} of slip the blow goes beyond the end of the curve",
                        path(b)
                    ),
                },
            },
            None => {
                let most = self.found.list.iter().filter_map(|b| Some((b, b.peak?.torque_nm)));
                most.max_by(|a, b| a.1.total_cmp(&b.1)).map_or("HELD".to_owned(), |(b, torque_nm)| {
                    format!("HELD: after {} of slip {}{limit}", path(b), Unit::NewtonMetre.show(torque_nm, 4))
                })
            }
        }
    }

    /// What the tables do not say, a sentence each, of a slip that was followed.
    pub(super) fn remark_words(&self) -> Vec<String> {
        let case = &self.case;
        let [inner, outer] = case.inertia_kg_m2.map(|i| significant(i, 4));
        let outer = match case.outer_held {
            true => "rigidly, the outer race is held".to_owned(),
            false => format!("{outer} kg m² with the outer one, both rigidly"),
        };
        let apart = drivetrain_apart(self.design, "--inner-inertia, --outer-inertia");
        let mut all: Vec<String> = self.bare_ring().into_iter().chain(apart).collect();
        all.extend([
            format!(
                "{} carried when the friction falls to {}; {inner} kg m² turn with the inner race, {outer}{}",
                Unit::NewtonMetre.show(case.torque_nm, 4),
                self.short(),
                match self.speed_of {
                    Some(scene) => format!(", at {} as in {scene}", Unit::Rpm.show(case.speed_rad_s, 4)),
                    None => String::new(),
                }
            ),
            "Slip, lasts: path at the inner track and time until the design's friction is back; times: blow over the \
             torque carried; by energy: nothing lost; energy: of the races against one another, of borne: that over what \
             the limits let the windup take up; speed gained: largest speed of the races against one another; in all: \
             path until these stand still against one another"
                .to_owned(),
            "A clutch that slips throws its sprags out: they must come back by their spring before they grip, however \
             short the slip"
                .to_owned(),
        ]);
        if let Some([most_j, end_j]) = self.takes_up_j {
            let limit = self.bears.as_ref().map_or(String::new(), |(torque_nm, code)| {
                format!(" up to {} ({code})", Unit::NewtonMetre.show(*torque_nm, 4))
            });
            all.push(format!(
                "The windup takes up {} from the torque carried{limit}, {} to the end of its curve",
                Unit::Joule.show(most_j, 3),
                Unit::Joule.show(end_j, 3)
            ));
        }
        all.extend(self.borne.map(|b| self.borne_words(&b)));
        all.extend(self.next_step());
        if !outer_turns(self.design) {
            all.push(format!(
                "The design names no speed of the outer race: here it is {}; --outer-held and --outer-free say which",
                if case.outer_held { "held, as in a housing" } else { "free to turn" }
            ));
        }
        if let Some(end) = self.thrown() {
            all.push(format!(
                "From {} of slip on the slip itself throws the sprags out of reach: rows beyond are of races with nothing \
                 between them; by energy: what the speed would come to if the sprags gripped there. Rows above that end \
                 so are thrown out once the friction is back",
                Unit::Millimetre.show(end.path_m, 3)
            ));
            // In a driven cage it is a speed of the inner race.
            let of_outer = self.lift_off_rad_s.filter(|_| !self.design.clutch.slides_outside());
            if let Some(speed) = of_outer.filter(|speed| *speed <= end.outer_rad_s.abs()) {
                all.push(format!(
                    "The outer race runs at {}; in steady overrun its sprags lift off from {} on, slower they come back sooner",
                    Unit::Rpm.show(end.outer_rad_s.abs(), 4),
                    Unit::Rpm.show(speed, 4)
                ));
            }
        }
        all
    }

    /// Why the clutch does not grip, where it does not.
    fn lost(&self, end: &SlipEnd) -> String {
        let when = format!("{} after the slip begins", Unit::Millisecond.show(end.at_s, 3));
        match end.stop {
            Stop::FellAway => {
                let mut said = format!(
                    "NOT HELD: {when} the sprags are thrown farther than their spring reaches, and nothing brings them \
                     back: from then on the torque drives the races apart unhindered"
                );
                let last = self.found.list.last().filter(|b| b.peak.is_none());
                if let Some(b) = last {
                    said += &format!(
                        ", after {} at {} against one another",
                        Unit::Millimetre.show(b.path_m, 3),
                        Unit::Rpm.show(b.speed_rad_s, 3)
                    );
                    said += &match b.by_energy_nm {
                        Some(torque_nm) => format!(
                            "; if a cage made them grip there, their energy would come to {}",
                            Unit::NewtonMetre.show(torque_nm, 4)
                        ),
                        None => "; if a cage made them grip there, their energy would go beyond the end of the curve".to_owned(),
                    };
                }
                said
            }
            Stop::CurveEnd => format!("NOT HELD: {when} the blow goes beyond the end of the curve"),
            Stop::Interrupted => format!("stopped {when}"),
            other => format!(
                "NOT HELD: {when} the clutch has not gripped as long as it was followed ({})",
                other.name()
            ),
        }
    }

    /// The friction of the slip, and its share of what the torque needs.
    fn short(&self) -> String {
        let (friction, needs) = (self.case.friction, self.found.needs);
        let share = needs.is_finite().then(|| {
            format!(" ({} of the {} that it needs)", significant(friction / needs, 2), significant(needs, 3))
        });
        significant(friction, 3) + &share.unwrap_or_default()
    }

    /// That the outer race turns alone, where nobody has said what turns with it: it is the lightest there can be, and sets speed and blow.
    pub(super) fn bare_ring(&self) -> Option<String> {
        let nobody = !self.outer_given && !self.case.outer_held;
        (nobody && inertia_from(self.design, "outer") == InertiaFrom::Ring).then(|| {
            format!(
                "The outer race turns as a bare ring, {} kg m²: the file has no races.outer_inertia_kg_m2 \
                 for what turns with it, and this decides the answer; --outer-inertia says what does, --outer-held that it is held",
                significant(self.case.inertia_kg_m2[1], 4)
            )
        })
    }

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
                "; to bear {} of slip its windup must take up {} times as much: less torque (--torque), or a clutch for \
                 more (`size --peak`)",
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
            None => format!("; {shortest} is not borne at any friction low enough to slip"),
        };
        first + &then
    }
}
