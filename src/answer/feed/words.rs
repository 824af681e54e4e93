//! What strokes come to, in words: the verdict, which number to change, what the answer rests on.

use super::{FeedAnswer, LOOKS};
use crate::answer::inertia::{InertiaFrom, inertia_from};
use crate::answer::{Finding, Said};
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

    /// Which number to change, and towards where, after strokes that do not feed.
    pub(super) fn next_step(&self) -> Option<String> {
        let case = &self.case;
        let fed = self.list.iter().find(|fed| !self.feeds(fed))?;
        let hz = Unit::Hertz.show(fed.frequency_hz, 3);
        let ratio = (fed.frequency_hz / case.runs_on_from_hz()).powi(2);
        let fewer = match self.limit_hz {
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
            return match self.list.len() < self.asked {
                true => format!("stopped after {} of {} frequencies", self.list.len(), self.asked),
                false => format!("stopped after {} of {} springs", self.springs.len(), self.springs_asked),
            };
        }
        let rests = self.rests_on();
        let (first, last) = (&self.list[0], &self.list[self.list.len() - 1]);
        if self.is_held() {
            return format!(
                "HELD at {}: each stroke feeds {} less than {}, {} of it windup at the torque of the brake{rests}",
                match self.list.len() {
                    1 => hertz(last.frequency_hz),
                    n => format!("all {n} frequencies up to {}", hertz(last.frequency_hz)),
                },
                degrees(-last.error_rad),
                degrees(self.case.stroke_rad),
                degrees(self.windup_rad)
            );
        }
        let why =
            self.list.iter().find(|fed| !self.feeds(fed)).map_or(String::new(), |fed| match self.word(fed) {
                "NOT HELD" => format!(
                    "at {} a stroke feeds {} {} than slow ones, {} is allowed",
                    hertz(fed.frequency_hz),
                    degrees(self.off_rad(fed).abs()),
                    if self.off_rad(fed) > 0.0 { "more" } else { "less" },
                    degrees(self.allowed_rad)
                ),
                "THROWN OUT" => format!(
                    "at {} the sprags are thrown out of reach of their spring",
                    hertz(fed.frequency_hz)
                ),
                "OVERLOADED" => {
                    format!("at {} the clutch is wound up beyond what it bears", hertz(fed.frequency_hz))
                }
                _ => format!("at {} the strokes were not followed to their end", hertz(fed.frequency_hz)),
            });
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
        match self.limit_hz {
            Some(limit) => {
                format!(
                    "NOT HELD: {why}; on the way up from {} it first fails beyond {} (looked for in {LOOKS} steps){again}{rests}",
                    hertz(first.frequency_hz),
                    hertz(limit)
                )
            }
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
        vec![
            format!(
                "The {driving} race turns by {} and back as a cosine; the {race} race, {} kg m²{whose}, stands under a brake of {}",
                Unit::Degree.show(case.stroke_rad, 4),
                significant(case.inertia_kg_m2, 4),
                Unit::NewtonMetre.show(case.brake_nm, 4),
            ),
            format!(
                "Slow strokes feed the stroke less the windup at that torque, {}; where the inertia asks for more than \
                 the brake, the fed race runs on, from {} on",
                Unit::Degree.show(self.windup_rad, 4),
                Unit::Hertz.show(self.case.runs_on_from_hz(), 3)
            ),
            "Feed − stroke: what is fed beyond the stroke; against slow ones: beyond what slow strokes feed (negative: \
             less); runs on: turn of the fed race after the driving one has turned back; unlike: last stroke against the \
             one before; torque: largest, by the normal force; open: time of a stroke without contact at the inner race"
                .to_owned(),
        ]
    }
}
