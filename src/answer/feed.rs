//! What an indexing drive feeds with each stroke, over frequency, and where it ends.

use super::inertia::{InertiaFrom, inertia_from};
use super::left_out::{LeftOut, left_out_of};
use super::reengagement::peak_torque_borne;
use super::{Finding, Said};
use crate::design::Design;
use crate::dynamics::Stop;
use crate::element::NoElement;
use crate::feed::{Fed, Strokes, fed};
use crate::follow::Follow;
use crate::margin::load_state;
use crate::report::plot::Curve;
use crate::report::{Cell, Page, Plot, Rows, Table, Unit, plain, significant};
use serde_json::{Value, json};
use std::f64::consts::TAU;
use std::fmt;

/// What a user may choose; what is `None` is taken from the design.
#[derive(Debug, Clone)]
pub struct FeedSettings {
    /// Angle that the driving race turns by and back, rad.
    pub stroke_rad: f64,
    /// Strokes a second, Hz, rising.
    pub frequencies_hz: Vec<f64>,
    /// Torque of the brake on the fed race, N m; `None`: the nominal torque of `[limits]`.
    pub brake_nm: Option<f64>,
    /// What turns with the fed race, this included, kg m^2; `None`: the inertia of that race in the design.
    pub inertia_kg_m2: Option<f64>,
    /// Whether the inner race drives; else the outer one.
    pub inner_drives: bool,
    /// By how much a stroke may feed more or less than slow ones, rad.
    pub allowed_rad: f64,
    /// Followed and stopped by.
    pub follow: Follow,
}

impl Default for FeedSettings {
    fn default() -> Self {
        Self {
            stroke_rad: 30.0 * TAU / 360.0,
            frequencies_hz: vec![1.0, 2.0, 5.0, 10.0, 20.0, 50.0],
            brake_nm: None,
            inertia_kg_m2: None,
            inner_drives: false,
            allowed_rad: 0.1 * TAU / 360.0,
            follow: Follow::nobody(),
        }
    }
}

/// Strokes over frequency.
#[derive(Debug, Clone)]
pub struct FeedAnswer<'a> {
    design: &'a Design,
    /// What was asked, at the first of the frequencies.
    pub case: Strokes,
    /// Whether its inertia was given; else it is that of the file.
    pub inertia_given: bool,
    /// By how much a stroke may feed more or less than slow ones, rad.
    pub allowed_rad: f64,
    /// What slow strokes feed less than the stroke by statics: the windup at the torque of the brake, rad.
    pub windup_rad: f64,
    /// Each frequency.
    pub list: Vec<Fed>,
    /// Frequencies that were asked for.
    pub asked: usize,
    /// The frequency, Hz, at which it first ceases to feed as it should on the way up, where that lies between two that were asked for; it
    /// may do so again beyond.
    pub limit_hz: Option<f64>,
    /// Peak torque that every limit bears, N m, and the limit that sets it.
    pub bears: Option<(f64, String)>,
}

/// Why there is none.
#[derive(Debug, Clone, PartialEq)]
pub enum NoFeed {
    /// The clutch cannot begin so.
    NoStart(NoElement),
    /// The torque of the brake, N m, is not on the curve, which ends at the second one.
    Beyond([f64; 2]),
    /// A setting makes no sense: what was found, and what is allowed.
    Refused {
        /// The setting, its value and unit.
        found: String,
        /// What is allowed.
        allowed: &'static str,
    },
}

impl fmt::Display for NoFeed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoStart(why) => why.fmt(f),
            Self::Beyond(both) => {
                let [found, end] = both.map(|nm| Unit::NewtonMetre.show(nm, 4));
                write!(
                    f,
                    "found a brake of {found}; allowed: above 0 and up to {end}, the most that the clutch carries"
                )
            }
            Self::Refused { found, allowed } => write!(f, "found {found}; allowed: {allowed}"),
        }
    }
}

impl std::error::Error for NoFeed {}

/// A figure of strokes that came to their end.
fn known(fed: &Fed, rad: f64) -> Option<f64> {
    fed.ended.is_none().then_some(rad)
}

/// A number as it may have been typed.
fn typed(value: f64) -> String {
    plain(value, 9)
}

/// Halvings of a ratio of frequencies between one that is held and one that is not.
const HALVINGS: usize = 7;

impl Design {
    /// What each stroke of an indexing drive feeds, at each frequency. Where it is stopped, the frequencies that were done.
    ///
    /// # Errors
    /// [`NoFeed`].
    pub fn feed(&self, settings: &FeedSettings) -> Result<FeedAnswer<'_>, NoFeed> {
        let positive = |x: f64| x.is_finite() && x > 0.0;
        let races = &self.clutch.races;
        let own = if settings.inner_drives { races.outer_inertia_kg_m2 } else { races.inner_inertia_kg_m2 };
        let list = &settings.frequencies_hz;
        let case = Strokes {
            stroke_rad: settings.stroke_rad,
            frequency_hz: list.first().copied().unwrap_or(0.0),
            brake_nm: settings.brake_nm.or(self.limits.nominal_torque_nm).unwrap_or(0.0),
            inertia_kg_m2: settings.inertia_kg_m2.unwrap_or(own),
            inner_drives: settings.inner_drives,
        };
        let refused = |found: String, allowed: &'static str| Err(NoFeed::Refused { found, allowed });
        if !positive(case.stroke_rad) || case.stroke_rad > TAU {
            let found = format!("a stroke of {} deg", typed(Unit::Degree.from_si(case.stroke_rad)));
            return refused(found, "above 0 and up to 360 deg");
        } else if !positive(case.brake_nm) {
            let found = format!("a brake of {} Nm", typed(case.brake_nm));
            return refused(
                found,
                "above 0, given or as nominal_torque_nm in [limits]: without a brake nothing stops the fed race",
            );
        } else if !positive(case.inertia_kg_m2) {
            return refused(format!("an inertia of {} kg m²", typed(case.inertia_kg_m2)), "above 0");
        } else if !positive(settings.allowed_rad) {
            let found =
                format!("an allowed difference of {} deg", typed(Unit::Degree.from_si(settings.allowed_rad)));
            return refused(found, "above 0");
        } else if list.is_empty()
            || !list.windows(2).all(|w| w[0] < w[1])
            || !list.iter().all(|f| (1e-3..=1e4).contains(f))
        {
            let each: Vec<String> = list.iter().map(|hz| typed(*hz)).collect();
            let found = if each.is_empty() {
                "no frequency".to_owned()
            } else {
                format!("frequencies of {} Hz", each.join(", "))
            };
            return refused(found, "0.001 to 10000 Hz, each above the one before");
        }
        let state = load_state(self).ok();
        let windup = |state: &crate::margin::LoadState| {
            state
                .curve
                .at_torque(case.brake_nm)
                .map(|p| p.windup_rad)
                .ok_or([case.brake_nm, state.curve.end_torque_nm()])
        };
        let windup_rad = state.as_ref().map_or(Ok(0.0), windup).map_err(NoFeed::Beyond)?;
        let bears = state.and_then(|state| peak_torque_borne(self, &state));
        let mut found = FeedAnswer {
            design: self,
            case,
            inertia_given: settings.inertia_kg_m2.is_some(),
            allowed_rad: settings.allowed_rad,
            windup_rad,
            list: Vec::new(),
            asked: list.len(),
            limit_hz: None,
            bears,
        };
        let follow = &settings.follow;
        let at = |frequency_hz: f64| {
            fed(&self.clutch, &Strokes { frequency_hz, ..case }, follow).map_err(NoFeed::NoStart)
        };
        for &frequency_hz in list {
            let stroke = at(frequency_hz)?;
            if stroke.ended == Some(Stop::Interrupted) {
                return Ok(found);
            }
            found.list.push(stroke);
        }
        let lost = found.list.iter().position(|fed| !found.feeds(fed));
        if let Some(k) = lost.filter(|k| *k > 0) {
            let (mut held_hz, mut lost_hz) = (list[k - 1], list[k]);
            for _ in 0..HALVINGS {
                let middle_hz = (held_hz * lost_hz).sqrt();
                let stroke = at(middle_hz)?;
                if stroke.ended == Some(Stop::Interrupted) {
                    return Ok(found);
                }
                if found.feeds(&stroke) { held_hz = middle_hz } else { lost_hz = middle_hz }
            }
            found.limit_hz = Some(held_hz);
        }
        Ok(found)
    }
}

impl FeedAnswer<'_> {
    /// Feed of a stroke less that of slow ones, rad.
    fn off_rad(&self, fed: &Fed) -> f64 {
        fed.error_rad + self.windup_rad
    }

    /// Whether a stroke feeds what slow ones do, and the clutch bears it.
    fn feeds(&self, fed: &Fed) -> bool {
        let most_nm = self.bears.as_ref().map_or(f64::INFINITY, |(torque_nm, _)| *torque_nm);
        fed.ended.is_none()
            && self.off_rad(fed).abs() <= self.allowed_rad
            && fed.peak.is_some_and(|p| p.torque_nm <= most_nm)
    }

    fn word(&self, fed: &Fed) -> &'static str {
        match fed.ended {
            Some(Stop::FellAway) => "THROWN OUT",
            Some(Stop::CurveEnd) => "OVERLOADED",
            Some(_) => "NOT COMPUTED",
            None if self.feeds(fed) => "held",
            None if self.off_rad(fed).abs() > self.allowed_rad => "NOT HELD",
            None => "OVERLOADED",
        }
    }

    /// The race that is fed.
    fn fed_race(&self) -> &'static str {
        if self.case.inner_drives { "outer" } else { "inner" }
    }

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
    fn next_step(&self) -> Option<String> {
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
                "Next: that the fed race does not run on at {hz}, a brake of {} or more (--brake, now {}), or {} kg m² or less (--inertia, \
                 now {}); or strokes {fewer}",
                Unit::NewtonMetre.show(case.brake_nm * ratio, 3),
                significant(case.brake_nm, 3),
                significant(case.inertia_kg_m2 / ratio, 3),
                significant(case.inertia_kg_m2, 3)
            ),
            "NOT HELD" => format!(
                "Next: strokes {fewer}, or a difference of {} allowed (--allowed)",
                Unit::Degree.show(self.off_rad(fed).abs(), 2)
            ),
            "THROWN OUT" => format!(
                "Next: strokes {fewer}, or a spring that presses more: spring.drag_torque_nm or spring.stiffness_nm_per_rad up"
            ),
            "OVERLOADED" => {
                let bears = self.bears.as_ref().map_or(String::new(), |(nm, code)| {
                    format!(" than the {} that {code} allows", Unit::NewtonMetre.show(*nm, 4))
                });
                format!(
                    "Next: strokes {fewer}, less to be moved (--inertia, now {} kg m²; --brake, now {}), or a clutch for more{bears} (`size \
                     --peak`)",
                    significant(case.inertia_kg_m2, 3),
                    Unit::NewtonMetre.show(case.brake_nm, 4)
                )
            }
            _ => return None,
        })
    }

    /// Each frequency.
    pub fn frequencies(&self) -> Rows<&Fed> {
        Rows::of(&self.list)
            .number("frequency_hz", "Strokes", Unit::Hertz, 4, |f| f.frequency_hz)
            .number("feed_deg", "Feed", Unit::Degree, 6, |f| known(f, f.feed_rad))
            .number("error_deg", "Feed − stroke", Unit::Degree, 4, |f| known(f, f.error_rad))
            .number("off_deg", "Against slow ones", Unit::Degree, 3, |f| known(f, self.off_rad(f)))
            .number("runs_on_deg", "Runs on", Unit::Degree, 3, |f| known(f, f.runs_on_rad))
            .number("unlike_deg", "Unlike", Unit::Degree, 2, |f| known(f, f.unlike_rad))
            .number("peak_torque_nm", "Torque", Unit::NewtonMetre, 4, |f| f.peak.map(|p| p.torque_nm))
            .number("hertz_inner_mpa", "p₀ inner", Unit::Megapascal, 4, |f| {
                f.peak.map(|p| p.hertz_inner_pa)
            })
            .number("open_ms", "Open", Unit::Millisecond, 3, |f| f.open_s)
            .text("verdict", "Verdict", |f| Cell::Verdict(self.feeds(f), self.word(f).to_owned()))
            .json("strokes", |f| f.strokes)
            .json("held", |f| self.feeds(f))
            .json("ended", |f| f.ended.map(Stop::name))
    }
}

impl Said for FeedAnswer<'_> {
    fn title(&self) -> &str {
        "Feed of an indexing drive"
    }

    fn design(&self) -> &Design {
        self.design
    }

    fn outcome(&self) -> Finding {
        if self.list.len() < self.asked {
            Finding::Stopped
        } else if self.list.iter().any(|fed| fed.ended.is_some_and(Stop::gave_up)) {
            Finding::NotKnown
        } else {
            Finding::of(self.list.iter().all(|fed| self.feeds(fed)))
        }
    }

    fn verdict(&self) -> String {
        let hertz = |hz: f64| Unit::Hertz.show(hz, 3);
        let degrees = |rad: f64| Unit::Degree.show(rad, 3);
        if self.outcome() == Finding::Stopped {
            return format!("stopped after {} of {} frequencies", self.list.len(), self.asked);
        }
        let rests = self.rests_on();
        let (first, last) = (&self.list[0], &self.list[self.list.len() - 1]);
        if self.is_held() {
            return format!(
                "HELD up to {}: each stroke feeds {} less than {}, {} of it windup at the torque of the brake{rests}",
                hertz(last.frequency_hz),
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
                    "NOT HELD: {why}; on the way up from {} it first fails beyond {}{again}{rests}",
                    hertz(first.frequency_hz),
                    hertz(limit)
                )
            }
            None => format!("NOT HELD: {why}, already at the slowest that was asked for{again}{rests}"),
        }
    }

    fn remarks(&self) -> Vec<String> {
        let case = &self.case;
        let race = self.fed_race();
        let driving = if case.inner_drives { "inner" } else { "outer" };
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
        let next = self.next_step();
        let most_nm = self.list.iter().filter_map(|f| f.peak.map(|p| p.torque_nm)).fold(0.0, f64::max);
        let named = self.design.limits.peak_torque_nm.filter(|peak_nm| most_nm > *peak_nm);
        let beyond = named.map(|peak_nm| {
            format!(
                "Up to {} here, more than the {} of limits.peak_torque_nm: held is what the clutch bears, not what its file asks for",
                Unit::NewtonMetre.show(most_nm, 4),
                Unit::NewtonMetre.show(peak_nm, 4)
            )
        });
        let about = vec![
            format!(
                "The {driving} race turns by {} and back as a cosine; the {race} race, {} kg m²{whose}, stands under a brake of {}",
                Unit::Degree.show(case.stroke_rad, 4),
                significant(case.inertia_kg_m2, 4),
                Unit::NewtonMetre.show(case.brake_nm, 4),
            ),
            format!(
                "Slow strokes feed the stroke less the windup at that torque, {}; where the inertia asks for more than the brake, the fed race \
                 runs on, from {} on",
                Unit::Degree.show(self.windup_rad, 4),
                Unit::Hertz.show(self.case.runs_on_from_hz(), 3)
            ),
            "Feed − stroke: what is fed beyond the stroke; against slow ones: beyond what slow strokes feed (negative: less); runs on: turn of the fed race after the driving one has turned back; unlike: last stroke against the one before; torque: largest, by \
             the normal force; open: time of a stroke without contact at the inner race"
                .to_owned(),
        ];
        next.into_iter().chain(beyond).chain(about).collect()
    }

    fn table(&self) -> Table {
        self.frequencies().table()
    }

    fn body(&self) -> Value {
        let degrees = |rad: f64| Unit::Degree.from_si(rad);
        let case = &self.case;
        json!({
            "held": self.is_held(), "verdict": self.verdict(), "stroke_deg": degrees(case.stroke_rad), "brake_nm": case.brake_nm,
            "inertia_kg_m2": case.inertia_kg_m2, "driver": if case.inner_drives { "inner" } else { "outer" },
            "allowed_deg": degrees(self.allowed_rad), "windup_deg": degrees(self.windup_rad), "limit_hz": self.limit_hz,
            "bears_nm": self.bears.as_ref().map(|b| b.0), "bears_by": self.bears.as_ref().map(|b| b.1.as_str()),
            "frequencies": self.frequencies().objects(),
        })
    }

    fn left_out(&self) -> Vec<LeftOut> {
        let mut all = vec![LeftOut::new(
            "shafts",
            "the brake and its inertia are rigid with the fed race, the driving race is moved as given",
            "a soft shaft feeds less by its own twist: put the drive into [[drivetrain]] and simulate a transient",
        )];
        all.extend(left_out_of(self.design));
        all
    }

    fn draw(&self, page: &mut Page) {
        let points = |of: &dyn Fn(&Fed) -> f64| -> Vec<[f64; 2]> {
            let done = self.list.iter().filter(|f| f.ended.is_none());
            done.map(|f| [f.frequency_hz, Unit::Degree.from_si(of(f))]).collect()
        };
        if self.list.iter().filter(|f| f.ended.is_none()).count() > 1 {
            let mut plot = Plot::new("Strokes a second, Hz", "Feed − stroke, deg");
            plot.log_x = true;
            plot.curves.push(Curve::new("feed − stroke", points(&|f| f.error_rad)));
            plot.curves.push(Curve::new("slow strokes: windup", points(&|_| -self.windup_rad)));
            page.figure(&plot.to_figure(), "What a stroke feeds more or less than the driving race turns.");
        }
        page.table("Each frequency. Feed − stroke: what is fed beyond the stroke; against slow ones: beyond what slow strokes feed (both negative: less).", &self.table());
    }
}
