//! What an indexing drive feeds with each stroke, over frequency, and where it ends.

mod body;
mod words;

pub use body::FeedBody;

use super::left_out::{LeftOut, left_out_of};
use super::reengagement::peak_torque_borne;
use super::{Finding, Said};
use crate::clutch::Clutch;
use crate::design::Design;
use crate::dynamics::Stop;
use crate::element::NoElement;
use crate::feed::{Fed, Strokes, fed};
use crate::follow::Follow;
use crate::margin::load_state;
use crate::report::plot::Curve;
use crate::report::{Page, Plot, Screen, Table, Tone, Unit, plain};
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
    /// Springs to look at beside that of the file: factors of its stiffness and of the drag torque it causes, each 0.001 to 1000.
    pub springs: Vec<f64>,
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
            springs: Vec::new(),
            follow: Follow::nobody(),
        }
    }
}

impl FeedSettings {
    /// The strokes that it asks of `design`, at the first frequency, or what makes no sense.
    ///
    /// # Errors
    /// [`NoFeed::Refused`].
    pub fn validate(&self, design: &Design) -> Result<Strokes, NoFeed> {
        let positive = |x: f64| x.is_finite() && x > 0.0;
        let races = &design.clutch.races;
        let own = if self.inner_drives { races.outer_inertia_kg_m2 } else { races.inner_inertia_kg_m2 };
        let list = &self.frequencies_hz;
        let case = Strokes {
            stroke_rad: self.stroke_rad,
            frequency_hz: list.first().copied().unwrap_or(0.0),
            brake_nm: self.brake_nm.or(design.limits.nominal_torque_nm).unwrap_or(0.0),
            inertia_kg_m2: self.inertia_kg_m2.unwrap_or(own),
            inner_drives: self.inner_drives,
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
        } else if !positive(self.allowed_rad) {
            let found =
                format!("an allowed difference of {} deg", typed(Unit::Degree.from_si(self.allowed_rad)));
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
        if let Some(factor) = self.springs.iter().find(|factor| !(1e-3..=1e3).contains(*factor)) {
            return refused(
                format!("a spring of {} times that of the file", typed(*factor)),
                "0.001 to 1000 times",
            );
        }
        Ok(case)
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
    /// Whether it was stopped between them.
    stopped_between: bool,
    /// Springs that were asked for.
    pub springs_asked: usize,
    /// The way up through the frequencies that were asked for and between them.
    pub climb: FeedClimb,
    /// The same for each other spring that was asked for.
    pub springs: Vec<SpringFeed>,
    /// Peak torque that every limit bears, N m, and the limit that sets it.
    pub bears: Option<(f64, String)>,
}

/// The way up through frequencies and between them, in steps of at most [`STEP`], to the first one at which strokes do not feed as they
/// should.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FeedClimb {
    /// How many frequencies between those that were asked for were looked at.
    pub looks: usize,
    /// The frequency, Hz, at which it first ceases to feed as it should; it may do so again beyond. `None`: nowhere, or already at the
    /// first.
    pub limit_hz: Option<f64>,
    /// The first that was met beyond it, asked for or between two that were.
    pub lost: Option<Fed>,
    /// Whether that is between two that were asked for.
    pub lost_between: bool,
}

/// How far strokes feed as they should with another spring.
#[derive(Debug, Clone, PartialEq)]
pub struct SpringFeed {
    /// Stiffness and drag torque of the spring over those of the file.
    pub factor: f64,
    /// Drag torque of the whole clutch with it, N m.
    pub drag_torque_nm: f64,
    /// As [`FeedClimb::limit_hz`].
    pub limit_hz: Option<f64>,
    /// The first frequency on the way up whose strokes do not feed as they should; `None`: all are held.
    pub lost: Option<Fed>,
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

/// A number as it may have been typed.
fn typed(value: f64) -> String {
    plain(value, 9)
}

/// Largest ratio of one frequency that is looked at to the next: a choice.
pub const STEP: f64 = 1.06;
/// Halvings of a ratio of frequencies between one that is held and one that is not.
const HALVINGS: usize = 5;

impl Design {
    /// What each stroke of an indexing drive feeds, at each frequency. Where it is stopped, the frequencies that were done.
    ///
    /// # Errors
    /// [`NoFeed`].
    pub fn feed(&self, settings: &FeedSettings) -> Result<FeedAnswer<'_>, NoFeed> {
        let case = settings.validate(self)?;
        let list = &settings.frequencies_hz;
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
            stopped_between: false,
            springs_asked: settings.springs.len(),
            climb: FeedClimb::default(),
            springs: Vec::new(),
            bears,
        };
        let follow = &settings.follow;
        for &frequency_hz in list {
            let Some(stroke) = found.stroke(&self.clutch, frequency_hz, follow)? else { return Ok(found) };
            found.list.push(stroke);
        }
        let Some(climb) = found.climb(&self.clutch, &found.list, follow)? else {
            found.stopped_between = true;
            return Ok(found);
        };
        found.climb = climb;
        for &factor in &settings.springs {
            let Some(spring) = found.with_spring(factor, list, follow)? else { return Ok(found) };
            found.springs.push(spring);
        }
        Ok(found)
    }
}

impl FeedAnswer<'_> {
    /// Strokes of one frequency; `None`: stopped.
    fn stroke(&self, clutch: &Clutch, frequency_hz: f64, follow: &Follow) -> Result<Option<Fed>, NoFeed> {
        let stroke = fed(clutch, &Strokes { frequency_hz, ..self.case }, follow).map_err(NoFeed::NoStart)?;
        Ok(Some(stroke).filter(|stroke| stroke.ended != Some(Stop::Interrupted)))
    }

    /// The way up through `list` and between; `None`: stopped.
    fn climb(&self, clutch: &Clutch, list: &[Fed], follow: &Follow) -> Result<Option<FeedClimb>, NoFeed> {
        let mut climb = FeedClimb::default();
        if list.first().is_none_or(|first| !self.feeds(first)) {
            return Ok(Some(climb));
        }
        for pair in list.windows(2) {
            let (mut held_hz, top) = (pair[0].frequency_hz, &pair[1]);
            let steps = ((top.frequency_hz / held_hz).ln() / STEP.ln()).ceil().max(1.0);
            let ratio = (top.frequency_hz / held_hz).powf(1.0 / steps);
            // Held and lost may alternate: the first loss of the walk up is what is halved.
            for _ in 1..steps as usize {
                let Some(stroke) = self.stroke(clutch, held_hz * ratio, follow)? else { return Ok(None) };
                climb.looks += 1;
                if !self.feeds(&stroke) {
                    climb.lost = Some(stroke);
                    climb.lost_between = true;
                    break;
                }
                held_hz = stroke.frequency_hz;
            }
            let lost = climb.lost.take().or_else(|| Some(top.clone()).filter(|top| !self.feeds(top)));
            let Some(lost) = lost else { continue };
            let mut lost_hz = lost.frequency_hz;
            for _ in 0..HALVINGS {
                let middle_hz = (held_hz * lost_hz).sqrt();
                let Some(stroke) = self.stroke(clutch, middle_hz, follow)? else { return Ok(None) };
                if self.feeds(&stroke) { held_hz = middle_hz } else { lost_hz = middle_hz }
            }
            climb.looks += HALVINGS;
            (climb.limit_hz, climb.lost) = (Some(held_hz), Some(lost));
            break;
        }
        Ok(Some(climb))
    }

    /// The same with a spring of `factor` times stiffness and drag torque, on the way up through `list`, Hz; `None`: stopped.
    fn with_spring(&self, factor: f64, list: &[f64], follow: &Follow) -> Result<Option<SpringFeed>, NoFeed> {
        let mut clutch = self.design.clutch.clone();
        clutch.spring.stiffness_nm_per_rad *= factor;
        clutch.spring.drag_torque_nm *= factor;
        let drag_torque_nm = clutch.spring.drag_torque_nm;
        let mut up = Vec::new();
        for &frequency_hz in list {
            let Some(stroke) = self.stroke(&clutch, frequency_hz, follow)? else { return Ok(None) };
            up.push(stroke);
            if up.last().is_some_and(|stroke| !self.feeds(stroke)) {
                break;
            }
        }
        let Some(climb) = self.climb(&clutch, &up, follow)? else { return Ok(None) };
        let lost = climb.lost.or_else(|| up.pop().filter(|stroke| !self.feeds(stroke)));
        Ok(Some(SpringFeed { factor, drag_torque_nm, limit_hz: climb.limit_hz, lost }))
    }

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

    /// The race that drives.
    fn driving_race(&self) -> &'static str {
        if self.case.inner_drives { "inner" } else { "outer" }
    }

    /// The race that is fed.
    fn fed_race(&self) -> &'static str {
        if self.case.inner_drives { "outer" } else { "inner" }
    }
}

impl Said for FeedAnswer<'_> {
    type Body<'a>
        = FeedBody<'a>
    where
        Self: 'a;

    fn title(&self) -> &str {
        "Feed of an indexing drive"
    }

    fn design(&self) -> &Design {
        self.design
    }

    fn outcome(&self) -> Finding {
        if self.list.len() < self.asked || self.stopped_between || self.springs.len() < self.springs_asked {
            Finding::Stopped
        } else if self.list.iter().any(|fed| fed.ended.is_some_and(Stop::gave_up)) {
            Finding::NotKnown
        } else {
            Finding::of(self.list.iter().all(|fed| self.feeds(fed)))
        }
    }

    fn verdict(&self) -> String {
        self.verdict_words()
    }

    fn banner(&self) -> (Tone, String) {
        let tone = match self.outcome() {
            Finding::Held if self.climb.lost_between => Tone::Soft,
            Finding::Held => Tone::Good,
            Finding::NotHeld | Finding::Stopped => Tone::Bad,
            Finding::Shown | Finding::NotKnown => Tone::Plain,
        };
        (tone, self.verdict())
    }

    fn remarks(&self) -> Vec<String> {
        [self.next_step(), self.beyond_the_file()].into_iter().flatten().chain(self.about()).collect()
    }

    fn table(&self) -> Table {
        self.frequencies().table()
    }

    fn tables(&self, screen: Screen) -> String {
        let text = self.table().to_text(screen);
        match self.springs.is_empty() {
            true => text,
            false => text + "\n" + &self.by_spring().table().to_text(screen),
        }
    }

    fn body(&self) -> FeedBody<'_> {
        FeedBody::of(self)
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
        page.table(
            "Each frequency. Feed − stroke: what is fed beyond the stroke; against slow ones: beyond what slow \
             strokes feed (both negative: less).",
            &self.table(),
        );
        if !self.springs.is_empty() {
            page.heading("Springs").table(
                "The frequency up to which strokes feed as they should with other springs: stiffness and drag torque times the factor.",
                &self.by_spring().table(),
            );
        }
    }
}
