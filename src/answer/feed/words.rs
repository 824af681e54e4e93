//! What strokes come to, in words: the verdict, which number to change, what the answer rests on.

use super::{FeedAnswer, STEP};
use crate::answer::inertia::{InertiaFrom, drivetrain_apart, inertia_from};
use crate::answer::{Finding, Said};
use crate::feed::Fed;
use crate::report::{Unit, significant};

impl FeedAnswer<'_> {
    /// Which inertia the verdict rests on, where nobody has said it.
    fn rests_on(&self) -> String {
        let from = match (self.inertia_given, inertia_from(self.design, self.fed_race())) {
            (true, _) | (false, InertiaFrom::File) => return String::new(),
            (false, InertiaFrom::Guess) => "a guess of the file",
            (false, InertiaFrom::Ring) => "the ring alone",
        };
        format!(
            "; this rests on {} kg m² that turn with the {} race, {from} (--inertia says what does)",
            significant(self.case.inertia_kg_m2, 4),
            self.fed_race()
        )
    }

    /// The first frequency that was asked for at which strokes do not feed, else the first between.
    fn first_lost(&self) -> Option<&Fed> {
        self.list.iter().find(|fed| !self.feeds(fed)).or(self.climb.lost.as_ref())
    }

    /// What strokes that do not feed do.
    fn loss(&self, fed: &Fed) -> String {
        let hz = Unit::Hertz.show(fed.frequency_hz, 3);
        match self.word(fed) {
            "NOT HELD" => format!(
                "at {hz} a stroke feeds {} {} than slow ones, {} is allowed",
                Unit::Degree.show(self.off_rad(fed).abs(), 3),
                if self.off_rad(fed) > 0.0 { "more" } else { "less" },
                Unit::Degree.show(self.allowed_rad, 3)
            ),
            "THROWN OUT" => format!("at {hz} the sprags are thrown out of reach of their spring"),
            "OVERLOADED" => format!("at {hz} the clutch is wound up beyond what it bears"),
            _ => format!("at {hz} the strokes were not followed to their end"),
        }
    }

    /// Which number to change, and towards where, after strokes that do not feed.
    pub(super) fn next_step(&self) -> Option<String> {
        let case = &self.case;
        let fed = self.first_lost()?;
        let hz = Unit::Hertz.show(fed.frequency_hz, 3);
        let ratio = (fed.frequency_hz / case.runs_on_from_hz()).powi(2);
        let fewer = match self.climb.limit_hz {
            Some(limit) => format!("up to {} (--frequency)", Unit::Hertz.show(limit, 3)),
            None => format!("fewer than {hz} (--frequency)"),
        };
        Some(match self.word(fed) {
            "NOT HELD" if ratio > 1.0 => format!(
                "Next: that the fed race does not run on at {hz}, a brake of {} or more (--brake, now {}), or {} kg m² or \
                 less (--inertia, now {}); or strokes {fewer}",
                Unit::NewtonMetre.show(case.brake_nm * ratio, 3),
                significant(case.brake_nm, 3),
                significant(case.inertia_kg_m2 / ratio, 3),
                significant(case.inertia_kg_m2, 3)
            ),
            "NOT HELD" => format!(
                "Next: strokes {fewer}, or a difference of {} or more allowed (--allowed)",
                // Shown so that it suffices.
                Unit::Degree.show(1.005 * self.off_rad(fed).abs(), 3)
            ),
            "THROWN OUT" => format!(
                "Next: strokes {fewer}, or a spring that presses more: spring.drag_torque_nm or spring.stiffness_nm_per_rad up"
            ),
            "OVERLOADED" => {
                let bears = self.bears.as_ref().map_or(String::new(), |(nm, code)| {
                    format!(" than the {} that {code} allows", Unit::NewtonMetre.show(*nm, 4))
                });
                format!(
                    "Next: strokes {fewer}, less to be moved (--inertia, now {} kg m²; --brake, now {}), or a clutch for \
                     more{bears} (`size --peak`)",
                    significant(case.inertia_kg_m2, 3),
                    Unit::NewtonMetre.show(case.brake_nm, 4)
                )
            }
            _ => return None,
        })
    }

    /// The answer in a sentence.
    pub(super) fn verdict_words(&self) -> String {
        let hertz = |hz: f64| Unit::Hertz.show(hz, 3);
        let degrees = |rad: f64| Unit::Degree.show(rad, 3);
        if self.outcome() == Finding::Stopped {
            return match (self.list.len() < self.asked, self.stopped_between) {
                (true, _) => format!("stopped after {} of {} frequencies", self.list.len(), self.asked),
                (false, true) => format!("stopped between the {} frequencies", self.asked),
                (false, false) => {
                    format!("stopped after {} of {} springs", self.springs.len(), self.springs_asked)
                }
            };
        }
        let rests = self.rests_on();
        let (first, last) = (&self.list[0], &self.list[self.list.len() - 1]);
        let steps = format!("in steps of {} or less", Unit::Percent.show(STEP - 1.0, 2));
        let first_fails = |limit_hz: f64| {
            format!(
                "on the way up from {}, {steps}, it first fails beyond {}",
                hertz(first.frequency_hz),
                hertz(limit_hz)
            )
        };
        if self.is_held() {
            let at = match self.list.len() {
                1 => hertz(last.frequency_hz),
                n => format!("all {n} frequencies up to {}", hertz(last.frequency_hz)),
            };
            let between = match (&self.climb.lost, self.climb.limit_hz) {
                (Some(lost), Some(limit_hz)) => {
                    format!(", NOT BETWEEN THEM: {}; {}", self.loss(lost), first_fails(limit_hz))
                }
                _ if self.climb.looks > 0 => format!(" and between them, {steps}"),
                _ => String::new(),
            };
            return format!(
                "HELD at {at}{between}: a stroke of {} feeds {} at {}, slow ones {} less than the stroke, the windup at the torque of \
                 the brake{rests}",
                degrees(self.case.stroke_rad),
                Unit::Degree.show(last.feed_rad, 5),
                hertz(last.frequency_hz),
                degrees(self.windup_rad)
            );
        }
        let why = self.first_lost().map_or(String::new(), |fed| self.loss(fed));
        let lost = self.list.iter().position(|fed| !self.feeds(fed)).unwrap_or(0);
        let held: Vec<String> = self.list[lost..]
            .iter()
            .filter(|fed| self.feeds(fed))
            .map(|fed| hertz(fed.frequency_hz))
            .collect();
        let again = if held.is_empty() {
            String::new()
        } else {
            format!(", and is held again at {}", held.join(", "))
        };
        match self.climb.limit_hz {
            Some(limit_hz) => format!("NOT HELD: {why}; {}{again}{rests}", first_fails(limit_hz)),
            None => format!("NOT HELD: {why}, already at the slowest that was asked for{again}{rests}"),
        }
    }

    /// That the strokes ask for more than the file does.
    pub(super) fn beyond_the_file(&self) -> Option<String> {
        let most_nm = self.list.iter().filter_map(|f| f.peak.map(|p| p.torque_nm)).fold(0.0, f64::max);
        let named = self.design.limits.peak_torque_nm.filter(|peak_nm| most_nm > *peak_nm);
        named.map(|peak_nm| {
            format!(
                "Up to {} here, more than the {} of limits.peak_torque_nm: held is what the clutch bears, not what its file asks for",
                Unit::NewtonMetre.show(most_nm, 4),
                Unit::NewtonMetre.show(peak_nm, 4)
            )
        })
    }

    /// What was asked, and what the columns are.
    pub(super) fn about(&self) -> Vec<String> {
        let case = &self.case;
        let (race, driving) = (self.fed_race(), self.driving_race());
        let whose = match (self.inertia_given, inertia_from(self.design, race)) {
            (true, _) => " with all that turns with it".to_owned(),
            (false, InertiaFrom::File) => {
                format!(" by races.{race}_inertia_kg_m2 of the file (--inertia says another)")
            }
            (false, InertiaFrom::Guess) => {
                format!(", a guess of the file (races.{race}_inertia_kg_m2; --inertia says another)")
            }
            (false, InertiaFrom::Ring) => {
                format!(
                    ", the ring alone (the file has no races.{race}_inertia_kg_m2; --inertia says another)"
                )
            }
        };
        let between = match (self.list.len(), self.climb.lost.as_ref()) {
            (0 | 1, _) => "Looked at is this frequency alone: another may feed more or less".to_owned(),
            (_, Some(lost)) => format!(
                "Looked at between the frequencies too, {} more, up to {}; beyond, those of the table alone",
                self.climb.looks,
                Unit::Hertz.show(lost.frequency_hz, 3)
            ),
            (_, None) if self.climb.looks > 0 => format!(
                "Looked at between the frequencies too, {} more; a band narrower than their steps is not seen",
                self.climb.looks
            ),
            (_, None) => "Looked at are the frequencies of the table alone".to_owned(),
        };
        let apart = drivetrain_apart(self.design, "--inertia");
        let mut all = vec![
            between,
            format!(
                "The {driving} race turns by {} and back as a cosine; the {race} race, {} kg m²{whose}, stands under a brake of {}",
                Unit::Degree.show(case.stroke_rad, 4),
                significant(case.inertia_kg_m2, 4),
                Unit::NewtonMetre.show(case.brake_nm, 4),
            ),
            format!(
                "Slow strokes feed the stroke less the windup at that torque, {}; where the inertia asks for more than \
                 the brake, the fed race runs on, from some {} on: an estimate, for one that goes as the driving race does; the table has what it \
                 does",
                Unit::Degree.show(self.windup_rad, 4),
                Unit::Hertz.show(self.case.runs_on_from_hz(), 3)
            ),
            "Feed − stroke: what is fed beyond the stroke; against slow ones: beyond what slow strokes feed (negative: \
             less); runs on: turn of the fed race after the driving one has turned back; unlike: last stroke against the \
             one before; torque: largest, by the normal force; open: time of a stroke without contact at the inner race"
                .to_owned(),
        ];
        all.extend(apart);
        all
    }
}
