//! Periodic states of a torsional excitation, one or a map over frequency and amplitude, as text, table, JSON and page.

mod body;
mod page;
mod words;

pub use body::{ResonanceBody, ResonanceErrors, StateLine};

use super::left_out::{LeftOut, left_out_of};
use super::simulation::{Eigenfrequency, train::eigenfrequencies};
use super::{Finding, Said, example_torque_nm};
use crate::clutch::{Scenario, ScenarioKind};
use crate::design::Design;
use crate::numeric::setting::{BadSetting, all_in_range, in_range};
use crate::report::{Cell, Page, Screen, Table, Tone};
use crate::scenario::{MotionKind, NoScenario, ResonanceCell, Settings, Steady, closely, prepare, resonance};
use serde_json::Value;

/// States of a table on a terminal.
const MOST_ROWS: usize = 40;

/// What is asked: frequencies (Hz, rising) and amplitudes (N m, rising).
#[derive(Debug, Clone, PartialEq)]
pub struct ResonanceQuestion {
    /// Hz.
    pub frequencies_hz: Vec<f64>,
    /// N m.
    pub amplitudes_nm: Vec<f64>,
}

/// The states found.
#[derive(Debug, Clone)]
pub struct ResonanceAnswer<'a> {
    design: &'a Design,
    scenario: &'a Scenario,
    friction: f64,
    tolerance: f64,
    /// A single state once more, at a tenth of the tolerance.
    finer: Option<Steady>,
    /// Amplitudes asked for.
    asked: usize,
    /// Small free swings of both races about the mean torque, clutch engaged and outer race on its abutment, lowest first; none without a mean
    /// torque that is carried.
    pub eigenfrequencies: Vec<Eigenfrequency>,
    /// Rows by amplitude, each by frequency.
    pub rows: Vec<Vec<ResonanceCell>>,
}

/// Why there are none.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NoResonance {
    /// The scenario has no start.
    #[error("{0}")]
    NoStart(NoScenario),
    /// It is no torsional excitation.
    #[error("the scenario has no torsional excitation, so nothing that repeats")]
    NoExcitation,
    /// A drivetrain takes part, which has motions of its own.
    #[error(
        "a [[drivetrain]] takes part in the scenario, and its rotors, shafts and orders have motions of \
         their own, which resonance does not look for: simulate runs the scenario with them; drivetrain = \
         [] in the scenario leaves them out"
    )]
    Drivetrain,
    /// A frequency, an amplitude or the tolerance is out of its range.
    #[error("{0}")]
    Setting(BadSetting),
    /// Stopped from outside.
    #[error("stopped")]
    Stopped,
}

/// Tolerances that a periodic state is found at.
pub const RESONANCE_TOLERANCES: [f64; 2] = [1e-9, 1e-3];

/// Why ranges make no question.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum NoRange {
    /// Points without a range.
    #[error("points need a range of frequencies, of amplitudes or of both")]
    Points,
    /// One point over a range of frequencies or amplitudes.
    #[error("one point where {} to {} {} are asked for; give one of them, or 2 points", .range[0], .range[1], .of)]
    One {
        /// Of what.
        of: RangeOf,
        /// From and to, in its unit.
        range: [f64; 2],
    },
}

named! {
    /// What a range is of.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum RangeOf {
        /// Frequencies, Hz.
        Frequency = "Hz",
        /// Amplitudes, N m.
        Amplitude = "Nm",
    }
    /// Its unit.
    pub fn unit;
}

impl std::fmt::Display for RangeOf {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.unit())
    }
}

/// Points of a map where nobody says how many.
const POINTS: [usize; 2] = [50, 50];

impl ResonanceQuestion {
    /// Over ranges of frequencies (Hz) and amplitudes (N m), ends included, evenly: so many `points` of each, one where a range has no width.
    ///
    /// # Errors
    /// [`NoRange`].
    pub fn over(
        frequency_hz: Option<[f64; 2]>,
        amplitude_nm: Option<[f64; 2]>,
        points: Option<[usize; 2]>,
    ) -> Result<Self, NoRange> {
        if points.is_some() && frequency_hz.is_none() && amplitude_nm.is_none() {
            return Err(NoRange::Points);
        }
        let [frequencies, amplitudes] = points.unwrap_or(POINTS);
        let even = |of, range: Option<[f64; 2]>, n: usize| match range {
            None => Ok(Vec::new()),
            Some([from, to]) if from == to => Ok(vec![from]),
            Some(range) if n < 2 => Err(NoRange::One { of, range }),
            Some([from, to]) => Ok((0..n).map(|i| from + (to - from) * i as f64 / (n - 1) as f64).collect()),
        };
        Ok(Self {
            frequencies_hz: even(RangeOf::Frequency, frequency_hz, frequencies)?,
            amplitudes_nm: even(RangeOf::Amplitude, amplitude_nm, amplitudes)?,
        })
    }

    /// Refuse frequencies and amplitudes that no shaft swings with.
    ///
    /// # Errors
    /// [`BadSetting`].
    pub fn validate(&self) -> Result<(), BadSetting> {
        all_in_range("frequency (Hz)", &self.frequencies_hz, [f64::MIN_POSITIVE, 1e9])?;
        all_in_range("amplitude (Nm)", &self.amplitudes_nm, [f64::MIN_POSITIVE, 1e9])
    }
}

/// That a design has no scene of the kind, and one to begin with.
pub fn no_excitation(design: &Design) -> String {
    let scene = example(example_torque_nm(design));
    format!("the design has no torsional excitation; add one, such as\n\n{scene}\n\n")
}

/// A scene to begin with, for a clutch that is asked to carry `torque_nm`.
pub fn example(torque_nm: f64) -> String {
    format!(
        "[[scenarios]]\nname = \"swing\"\nkind = \"torsional-excitation\"\npreload_nm = {torque_nm:?}      # carried in the mean\n\
         amplitude_nm = {:?}     # swings by that\nfrequency_hz = 50.0\n\
         abutment_stiffness_nm_per_rad = {:?}   # what holds the outer race\nduration_s = 0.1",
        0.5 * torque_nm,
        50.0 * torque_nm
    )
}

impl Design {
    /// Periodic states of `scenario`, one of this design's; where `question` is none, the one at its own frequency and amplitude.
    /// [`Settings::follow`] is told of each state. Of a map that is stopped the amplitudes that were done.
    ///
    /// # Errors
    /// [`NoResonance`].
    pub fn resonance<'a>(
        &'a self,
        scenario: &'a Scenario,
        question: &ResonanceQuestion,
        settings: &Settings,
    ) -> Result<ResonanceAnswer<'a>, NoResonance> {
        let ScenarioKind::TorsionalExcitation { amplitude_nm, frequency_hz, .. } = scenario.kind else {
            return Err(NoResonance::NoExcitation);
        };
        if !scenario.drivetrain.is_empty() {
            return Err(NoResonance::Drivetrain);
        }
        question.validate().map_err(NoResonance::Setting)?;
        let eigenfrequencies = eigenfrequencies(&prepare(scenario).map_err(NoResonance::NoStart)?);
        in_range("tolerance", settings.tolerance, RESONANCE_TOLERANCES).map_err(NoResonance::Setting)?;
        let or_own = |asked: &[f64], own: f64| if asked.is_empty() { vec![own] } else { asked.to_vec() };
        let frequencies = or_own(&question.frequencies_hz, frequency_hz);
        let amplitudes = or_own(&question.amplitudes_nm, amplitude_nm);
        let one = frequencies.len() * amplitudes.len() == 1;
        let settings = if one { closely(settings) } else { settings.clone() };
        let asked = amplitudes.len();
        let run = |settings: &Settings| {
            let rows = resonance(scenario, &frequencies, &amplitudes, settings);
            rows.map_err(NoResonance::NoStart)?.ok_or(NoResonance::Stopped)
        };
        let rows = run(&settings)?;
        let finer = Settings {
            tolerance: 0.1 * settings.tolerance,
            follow: settings.follow.unseen(),
            ..settings.clone()
        };
        let finer = if one { Some(run(&finer)?) } else { None };
        let finer = finer.and_then(|rows| Some(rows.into_iter().flatten().next()?.state));
        let friction = scenario.clutch.friction.static_;
        Ok(ResonanceAnswer {
            design: self,
            scenario,
            friction,
            tolerance: settings.tolerance,
            finer,
            asked,
            eigenfrequencies,
            rows,
        })
    }
}

impl ResonanceAnswer<'_> {
    fn cells(&self) -> impl Iterator<Item = &ResonanceCell> {
        self.rows.iter().flatten()
    }

    fn count(&self, kind: MotionKind) -> usize {
        self.cells().filter(|c| c.state.kind == kind).count()
    }

    /// Amplitudes that a stop has left out.
    pub fn amplitudes_left(&self) -> usize {
        self.asked - self.rows.len()
    }

    /// Whether both contacts roll everywhere.
    pub fn rolls(&self) -> bool {
        self.cells().all(|c| c.state.kind == MotionKind::Rolls)
    }

    /// For a terminal: of a single state each figure in a line, of several the columns that tell them apart.
    fn short_table(&self) -> Table {
        let all = Said::table(self);
        let is_zero = |cell: &Cell| matches!(cell, Cell::Empty) || *cell == Cell::Si(0.0);
        let tells = |k: usize| all.rows.iter().any(|row| !is_zero(&row[k]));
        if let [row] = all.rows.as_slice() {
            let mut facts = Table::facts();
            for (k, column) in all.columns.iter().enumerate().filter(|(k, _)| tells(*k)) {
                let cell = match row[k] {
                    Cell::Si(si) => Cell::In(si, column.unit),
                    ref other => other.clone(),
                };
                facts.row(vec![column.heading.as_str().into(), cell]);
            }
            return facts;
        }
        let shown = |k: usize| match all.columns[k].key.as_str() {
            // The slip margin tells the first, the contact margin the second.
            "required_static_friction" | "normal_min_n" | "neutral_multiplier" => false,
            "stable" => self.cells().any(|c| c.state.motion.is_ok() && c.state.is_stable() != Some(true)),
            _ => tells(k),
        };
        let kept: Vec<usize> = (0..all.columns.len()).filter(|k| *k < all.lead || shown(*k)).collect();
        let of = |k: &usize| all.columns[*k].clone();
        let cells = |row: &Vec<Cell>| kept.iter().map(|k| row[*k].clone()).collect();
        Table {
            columns: kept.iter().map(of).collect(),
            rows: all.rows.iter().map(cells).collect(),
            lead: all.lead,
        }
    }
}

impl Said for ResonanceAnswer<'_> {
    type Body<'a>
        = ResonanceBody<'a>
    where
        Self: 'a;

    fn title(&self) -> &str {
        "Resonance"
    }

    fn design(&self) -> &Design {
        self.design
    }

    fn subject(&self) -> String {
        format!("{}, {}", self.design.name, self.scenario.name)
    }

    fn outcome(&self) -> Finding {
        if self.amplitudes_left() > 0 { Finding::Stopped } else { Finding::Shown }
    }

    fn verdict(&self) -> String {
        self.verdict_words()
    }

    fn banner(&self) -> (Tone, String) {
        // A map is to show where it slips: that it does somewhere is no verdict.
        let tone = match (self.cells().count(), self.rolls()) {
            (_, true) => Tone::Plain,
            (1, false) => Tone::Bad,
            _ => Tone::Soft,
        };
        (tone, format!("{}: {}", self.scenario.name, self.verdict()))
    }

    fn remarks(&self) -> Vec<String> {
        self.remark_words()
    }

    fn table(&self) -> Table {
        Table { lead: 2, ..self.states().table() }
    }

    fn tables(&self, screen: Screen) -> String {
        let more = self.cells().nth(1).map_or("", |_| "All columns: --csv, --json or --report\n");
        match self.cells().nth(MOST_ROWS) {
            None => self.short_table().to_text(screen) + more,
            Some(_) => String::new(),
        }
    }

    fn body(&self) -> ResonanceBody<'_> {
        ResonanceBody::of(self)
    }

    fn left_out(&self) -> Vec<LeftOut> {
        let mut list = left_out_of(self.design);
        list.push(LeftOut::new(
            "motions with two or more periods of the excitation",
            "the state is looked for among motions that repeat with its period",
            "a multiplier beyond -1 or a state that is not found tells of one",
        ));
        list.push(LeftOut::new(
            "states that no neighbour leads to",
            "a row is walked upwards and downwards in frequency, from the state at rest",
            "not estimated",
        ));
        list
    }

    /// Of a single state what each figure differs by from that at a tenth of the tolerance, of a map the tolerance asked for.
    fn error_estimate(&self) -> Option<Value> {
        serde_json::to_value(ResonanceErrors::of(self)).ok()
    }

    fn draw(&self, page: &mut Page) {
        page::draw(self, page);
    }
}
