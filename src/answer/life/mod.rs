//! What a life of loads does to a clutch: loads, places, verdict, curves of life.

mod body;
mod words;

pub use body::{LifeBody, SwingBody, WearBody};

use super::left_out::{LeftOut, left_out_of};
use super::resonance::NoResonance;
use super::{Finding, Said};
use crate::clutch::{RepeatedLoad, RepeatedSwing, Service};
use crate::design::Design;
use crate::life::{Broken, Life, LifePlace, WornLife, life, part_at, worn_life};
use crate::margin::{NoMargins, load_state};
use crate::report::plot::Curve;
use crate::report::{Page, Plot, Screen, Table, Tone, Unit, significant};
use crate::scenario::{MotionKind, Settings, prepare, steady_motion};
use std::fmt;

/// A scenario that goes on for some time, as a load.
#[derive(Debug, Clone, PartialEq)]
pub struct Swung {
    /// Name of the scenario.
    pub scenario: String,
    /// How long in the life, s.
    pub duration_s: f64,
    /// Hz.
    pub frequency_hz: f64,
    /// Torques between which the clutch swings, N m, and how often.
    pub load: RepeatedLoad,
}

/// The life of a design.
#[derive(Debug, Clone)]
pub struct LifeAnswer<'a> {
    design: &'a Design,
    service: &'a Service,
    /// The scenarios of the service.
    pub swung: Vec<Swung>,
    /// The figures.
    pub life: Life,
    /// Wear over the life; `None` where the life has no overruns, or the design no oil.
    pub worn: Option<WornLife>,
}

/// Why there is none.
#[derive(Debug, Clone, PartialEq)]
pub enum NoLife {
    /// The design has no `[life]` table.
    NoService {
        /// Torque of the table that is suggested, N m.
        torque_nm: f64,
    },
    /// There is no clutch to speak of.
    NoClutch(NoMargins),
    /// A scenario of the service has no motion that repeats and rolls.
    NoSwing {
        /// Its name.
        scenario: String,
        /// Why.
        why: String,
    },
}

impl fmt::Display for NoLife {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoService { torque_nm } => write!(
                f,
                "the design has no [life] table; add one with what it goes through, such as\n\n{}\n\n\
                 `sprag-design explain life` lists its keys",
                example(*torque_nm)
            ),
            Self::NoClutch(why) => why.fmt(f),
            Self::NoSwing { scenario, why } => write!(
                f,
                "life.swings: {scenario} does not roll on and on ({why}), so its peaks are no engagements that can be counted; \
                 `sprag-design resonance` says more of it"
            ),
        }
    }
}

impl std::error::Error for NoLife {}

/// A table to begin with.
fn example(torque_nm: f64) -> String {
    format!(
        "[life]\nloads = [ {{ torque_nm = {torque_nm:?}, engagements = 1e5 }} ]\n\
         pitting = {{ pressure_mpa = 4200.0, cycles = 1e6 }}   # from the maker's curve or own tests"
    )
}

impl Design {
    /// What the life that the file names does to the clutch.
    ///
    /// # Errors
    /// [`NoLife`].
    pub fn life(&self) -> Result<LifeAnswer<'_>, NoLife> {
        let service = self
            .service
            .as_ref()
            .ok_or_else(|| NoLife::NoService { torque_nm: super::example_torque_nm(self) })?;
        let swung: Vec<Swung> = service.swings.iter().map(|s| self.swung(s)).collect::<Result<_, _>>()?;
        let loads = service.loads.iter().copied().chain(swung.iter().map(|s| s.load)).collect();
        let life = life(self, &Service { loads, ..service.clone() }).map_err(NoLife::NoClutch)?;
        let worn = worn_life(self, service, &life).map_err(NoLife::NoClutch)?;
        Ok(LifeAnswer { design: self, service, swung, life, worn })
    }

    /// The torques that the clutch carries in a scenario that swings, once its start is forgotten, and how often in the time given.
    fn swung(&self, swing: &RepeatedSwing) -> Result<Swung, NoLife> {
        let not = |why: String| NoLife::NoSwing { scenario: swing.scenario.clone(), why };
        let scenario = self.scenario(&swing.scenario).ok_or_else(|| not("no such scenario".to_owned()))?;
        let frequency_hz =
            scenario.kind.frequency_hz().ok_or_else(|| not("it is no torsional excitation".to_owned()))?;
        if !scenario.drivetrain.is_empty() {
            return Err(not(NoResonance::Drivetrain.to_string()));
        }
        let prepared = prepare(scenario).map_err(|why| not(why.to_string()))?;
        let found = steady_motion(&prepared, &Settings::default(), None);
        let found = found.ok_or_else(|| not("it is no torsional excitation".to_owned()))?;
        let torque_nm = |normal_n: f64| prepared.model.curve.at_normal(normal_n).map(|p| p.torque_nm);
        match found.motion {
            Ok(motion) if found.kind == MotionKind::Rolls => {
                let peaks = motion.run.peaks;
                let ends = torque_nm(peaks.normal_min_n).zip(torque_nm(peaks.normal_max_n));
                let (from_nm, torque_nm) =
                    ends.ok_or_else(|| not(MotionKind::Overloaded.name().to_owned()))?;
                let engagements = frequency_hz * swing.duration_s;
                Ok(Swung {
                    scenario: swing.scenario.clone(),
                    duration_s: swing.duration_s,
                    frequency_hz,
                    load: RepeatedLoad { from_nm, torque_nm, engagements },
                })
            }
            _ => Err(not(found.kind.name().to_owned())),
        }
    }
}

/// How much is known of a life.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LifeKnown {
    /// Something fails before its end.
    NotHeld,
    /// All is known, and nothing fails.
    Held,
    /// Nothing fails of what is known.
    HeldInPart,
    /// Nothing fails, and no strength is given.
    Nothing,
}

impl LifeAnswer<'_> {
    /// Where sprags of a cage slide beside where they touch when they engage, and what that is worth.
    fn slides_ahead(&self) -> Option<LeftOut> {
        let worn = self.worn.as_ref().filter(|worn| worn.ahead_m > 0.0)?;
        let half_m = worn.states.last()?.half_flat_m;
        Some(LeftOut::new(
            "the place of the flat on the outer arc",
            "a film or the clearance of the cage holds sprags open in overrun: they slide farther ahead than where they touch when they \
             engage, where the flat is taken to be",
            &format!(
                "at most {} ahead as drawn, beside a flat of {} to either side in the end: a bound, the less is missing where \
                 they engage",
                Unit::Millimetre.show(worn.ahead_m, 3),
                Unit::Millimetre.show(half_m, 3)
            ),
        ))
    }

    /// The part of the life after which wear breaks a limit, where that is before its end.
    fn worn_out(&self) -> Option<(f64, Broken)> {
        self.worn.as_ref()?.broken().filter(|(share, _)| *share <= 1.0)
    }

    /// Miner's sum of a place that contacts press, over the life of the clutch as it wears; `None` where nothing is known to wear, or the
    /// strength is not given.
    pub fn used_worn(&self, place: LifePlace) -> Option<f64> {
        let sums = self.worn.as_ref()?.pitting();
        LifePlace::contacts().zip(sums).find(|(contact, _)| *contact == place)?.1
    }

    /// The place that is used up before the end of the life as it wears, and how far.
    fn pitted(&self) -> Option<(LifePlace, f64)> {
        let sums = LifePlace::contacts().filter_map(|place| Some((place, self.used_worn(place)?)));
        sums.filter(|(_, sum)| *sum > 1.0).max_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// How much the answer knows.
    pub fn known(&self) -> LifeKnown {
        match (
            self.life.held() && self.worn_out().is_none() && self.pitted().is_none(),
            self.life.decides(),
            self.not_known().is_empty(),
        ) {
            (false, ..) => LifeKnown::NotHeld,
            (true, None, _) => LifeKnown::Nothing,
            (true, Some(_), false) => LifeKnown::HeldInPart,
            (true, Some(_), true) => LifeKnown::Held,
        }
    }

    /// Scenarios that swing and that the service does not name.
    fn not_counted(&self) -> impl Iterator<Item = &str> {
        let swing = self.design.scenarios.iter().filter(|s| s.kind.frequency_hz().is_some());
        swing.map(|s| s.name.as_str()).filter(|name| self.swung.iter().all(|s| s.scenario != *name))
    }

    /// Torque over engagements until each place with a strength is used up.
    fn curves(&self) -> Plot {
        let mut plot = Plot::new("Engagements", "Torque, Nm");
        plot.log_x = true;
        let Ok(state) = load_state(self.design) else { return plot };
        let end = state.curve.end_torque_nm();
        let torques: Vec<f64> = (1..=POINTS).map(|i| end * i as f64 / POINTS as f64 * (1.0 - 1e-9)).collect();
        for place in LifePlace::ALL {
            let points: Vec<[f64; 2]> = torques
                .iter()
                .filter_map(|&torque| {
                    let part = part_at(self.design, self.service, &state, place, torque)?;
                    Some([1.0 / part, torque]).filter(|p| (1.0..=MOST_ENGAGEMENTS).contains(&p[0]))
                })
                .collect();
            if !points.is_empty() {
                plot.curves.push(Curve::new(place.names().1, points));
            }
        }
        // Dots alone: no load leads to the next.
        let loads =
            self.life.loads.iter().flat_map(|l| [[l.engagements, l.torque_nm], [f64::NAN; 2]]).collect();
        plot.curves.push(Curve {
            dots: true,
            dash: crate::report::plot::Dash::Dotted,
            ..Curve::new("loads of this life", loads)
        });
        plot
    }
}

impl Said for LifeAnswer<'_> {
    type Body<'a>
        = LifeBody<'a>
    where
        Self: 'a;

    fn title(&self) -> &str {
        "Life"
    }

    fn design(&self) -> &Design {
        self.design
    }

    fn outcome(&self) -> Finding {
        match self.known() {
            LifeKnown::NotHeld => Finding::NotHeld,
            LifeKnown::Held | LifeKnown::HeldInPart => Finding::Held,
            LifeKnown::Nothing => Finding::NotKnown,
        }
    }

    fn verdict(&self) -> String {
        self.verdict_words()
    }

    fn banner(&self) -> (Tone, String) {
        let tone = match self.known() {
            LifeKnown::NotHeld => Tone::Bad,
            LifeKnown::Held => Tone::Good,
            LifeKnown::HeldInPart => Tone::Soft,
            LifeKnown::Nothing => Tone::Plain,
        };
        (tone, self.verdict())
    }

    fn remarks(&self) -> Vec<String> {
        self.remark_words()
    }

    fn table(&self) -> Table {
        self.loads().table()
    }

    fn tables(&self, screen: Screen) -> String {
        // A history has up to fifty.
        let (loads, more) = self.table().first(MOST_ROWS);
        let mut text = format!("{}\n{}", self.places().table().to_text(screen), loads.to_text(screen));
        if more > 0 {
            text += &format!("{more} smaller loads: --csv, --json or --report\n");
        }
        text + &self.wear().map_or(String::new(), |wear| format!("\n{}", wear.table().to_text(screen)))
    }

    fn body(&self) -> LifeBody<'_> {
        LifeBody::of(self)
    }

    fn left_out(&self) -> Vec<LeftOut> {
        let mut all = vec![
            LeftOut::new(
                "calibration",
                "no maker prints a life curve with its pressures: strengths are the file's",
                "as good as the strength that is given; 10 % of pressure is a factor 1.9 of pitting life at the exponent 20/3",
            ),
            LeftOut::new(
                "dynamics",
                "torques of loads and histories are taken as they are given, each engagement as slow; swings have the \
                 torques that the clutch carries",
                "what `simulate` finds beyond the torque given: put its peak here",
            ),
            LeftOut::new(
                "wear, lubricant, residual stress",
                "wear: with `overruns` and oil, by Archard, with the film of the drawn contact; it changes pitting by the forces and \
                 pressures of the worn profile, takes no cracks away, and does not change fatigue of rings and bodies; the others: no model",
                "unknown; pitting strengths hold for the lubricant and surface that they were found with",
            ),
        ];
        let sharp = self.worn.as_ref().and_then(|worn| Some((worn.broken()?.0, worn.sharp_share?)));
        all.extend(sharp.map(|(share, sharp)| {
            LeftOut::new(
                "a sharp edge of the worn flat",
                "the contact law knows the radius and does not settle on an edge sharper than 5 % of its arc; others have 0.5 %",
                &format!(
                    "wear ends the life at {} of it, with an edge of 0.5 % at some {}: straight on from edges of 10 and 5 %",
                    significant(share, 3),
                    significant(sharp, 3)
                ),
            )
        }));
        all.extend(self.slides_ahead());
        all.extend(left_out_of(self.design));
        all
    }

    fn draw(&self, page: &mut Page) {
        let known = self.life.used.iter().any(|u| u.sum.is_some());
        if known {
            page.figure(
                &self.curves().to_figure(),
                "Engagements at one torque alone until a place is used up. Dots: the loads of this life.",
            );
        }
        page.heading("Places").table(
            "Used up: Miner's sum over this life, of the clutch as drawn and as it wears; lives: how often it fits in. Cycles of a track: contacts that one place of it sees.",
            &self.places().table(),
        );
        page.heading("Loads").table(
            "Of histories in classes. Walk: what the contact rolls on sprag and race; hoop: with bending between the sprags.",
            &self.table(),
        );
        if let Some(wear) = self.wear() {
            page.heading("Wear").table(
                "Sprags and tracks as they wear, until a limit is broken: depth of the flat, gap, friction that first \
                 contact and the largest load ask for, lowest torque capacity.",
                &wear.table(),
            );
        }
    }
}

/// Points of a curve of life.
const POINTS: usize = 120;
/// Beyond so many no curve is drawn.
const MOST_ENGAGEMENTS: f64 = 1e10;
/// Loads that the text shows.
const MOST_ROWS: usize = 12;
