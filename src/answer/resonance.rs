//! Periodic states of a torsional excitation, one or a map over frequency and amplitude, as text, table, JSON and page.

use super::left_out::{LeftOut, left_out_of};
use super::page::half;
use super::{Finding, Said};
use crate::clutch::{Scenario, ScenarioKind};
use crate::design::Design;
use crate::dynamics::Run;
use crate::numeric::setting::{BadSetting, all_in_range, in_range};
use crate::report::heat::SHADES;
use crate::report::{Cell, HeatMap, Page, Plot, Rows, Screen, Shade, Table, Tone, Unit, significant};
use crate::scenario::{MotionKind, NoScenario, ResonanceCell, Settings, Steady, closely, resonance};
use serde_json::{Value, json};

/// States of a table on a terminal.
const MOST_ROWS: usize = 40;
/// Rows that the plot of mu_req shows.
const CURVES: usize = 6;

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

impl ResonanceQuestion {
    /// Refuse frequencies and amplitudes that no shaft swings with.
    ///
    /// # Errors
    /// [`BadSetting`].
    pub fn validate(&self) -> Result<(), BadSetting> {
        all_in_range("frequency (Hz)", &self.frequencies_hz, [f64::MIN_POSITIVE, 1e9])?;
        all_in_range("amplitude (Nm)", &self.amplitudes_nm, [f64::MIN_POSITIVE, 1e9])
    }
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

    /// Each state in a line.
    pub fn states(&self) -> Rows<StateLine<'_>> {
        lines(self.cells().map(|c| (c.frequency_hz, c.amplitude_nm, &c.state, c.other.as_ref())))
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

    fn some_rows(&self) -> impl Iterator<Item = &Vec<ResonanceCell>> {
        let (last, shown) = (self.rows.len() - 1, self.rows.len().min(CURVES));
        (0..shown).map(move |k| &self.rows[if shown > 1 { k * last / (shown - 1) } else { 0 }])
    }

    fn plane(&self, title: &str) -> HeatMap {
        let of = |cells: Vec<f64>| edges(&cells);
        HeatMap {
            title: title.to_owned(),
            x_title: "Frequency, Hz".to_owned(),
            y_title: "Amplitude, Nm".to_owned(),
            x_edges: of(self.rows.iter().take(1).flatten().map(|c| c.frequency_hz).collect()),
            y_edges: of(self.rows.iter().filter_map(|row| Some(row.first()?.amplitude_nm)).collect()),
            tiles: Vec::new(),
            legend: Vec::new(),
        }
    }

    /// What rolling needs.
    fn needed(&self) -> HeatMap {
        let range = |held: bool| {
            let side = self.cells().filter_map(|c| c.state.slip_margin).filter(|m| (*m >= 0.0) == held);
            side.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], m| [low.min(m), high.max(m)])
        };
        let (held, broken) = (range(true), range(false));
        let shade = |value: f64, from: f64, to: f64| {
            let share = if to == from { 1.0 } else { (value - from) / (to - from) };
            (share * f64::from(SHADES)).clamp(0.0, f64::from(SHADES - 1)) as u8
        };
        let tile = |c: &ResonanceCell| match c.state.slip_margin {
            None if c.state.rolling.is_err() => (Shade::Missing, None),
            None => (Shade::Void, Some(false)),
            Some(m) if m >= 0.0 => (Shade::Held(shade(m, held[0], held[1])), Some(true)),
            Some(m) => (Shade::Broken(shade(m, broken[1], broken[0])), Some(false)),
        };
        let tiles: Vec<(Shade, Option<bool>)> = self.cells().map(tile).collect();
        let needs = |margin: f64| significant(self.friction / (1.0 + margin), 4);
        let mut legend = Vec::new();
        if held[0] <= held[1] {
            legend.push((Shade::Held(SHADES - 1), format!("needs {}", needs(held[1]))));
            legend.push((Shade::Held(0), format!("needs {}", needs(held[0]))));
        }
        if broken[0] <= broken[1] {
            legend.push((Shade::Broken(0), format!("needs {}", needs(broken[1]))));
            legend.push((Shade::Broken(SHADES - 1), format!("needs {}", needs(broken[0]))));
        }
        if tiles.iter().any(|(shade, _)| *shade == Shade::Void) {
            legend.push((Shade::Void, "would open".to_owned()));
        }
        if tiles.iter().any(|(shade, _)| *shade == Shade::Missing) {
            legend.push((Shade::Missing, "not found".to_owned()));
        }
        HeatMap { tiles, legend, ..self.plane("Static friction needed to roll") }
    }

    /// What the clutch does.
    fn kinds(&self) -> HeatMap {
        let kind = |c: &ResonanceCell| match c.state.kind {
            _ if c.other.is_some() => 5,
            _ if c.state.is_stable() == Some(false) => 6,
            MotionKind::Rolls => 0,
            MotionKind::Slips => 1,
            MotionKind::LiftsOff => 2,
            MotionKind::Overloaded => 3,
            MotionKind::NotFound => 4,
            MotionKind::Disengages => 7,
        };
        const NAMES: [&str; 8] = [
            "rolls",
            "slips each period",
            "lifts off",
            "overloaded",
            "does not repeat",
            "two states",
            "unstable",
            "disengages",
        ];
        // Colours go to those that are there: there are fewer than kinds.
        let there: Vec<usize> = (0..NAMES.len()).filter(|k| self.cells().any(|c| kind(c) == *k)).collect();
        let shade = |of: usize| Shade::Kind(there.iter().position(|k| *k == of).unwrap_or(0));
        let tile = |c: &ResonanceCell| (shade(kind(c)), Some(c.state.kind == MotionKind::Rolls));
        let tiles = self.cells().map(tile).collect();
        let legend = there.iter().map(|&k| (shade(k), NAMES[k].to_owned())).collect();
        HeatMap { tiles, legend, ..self.plane("What the clutch does") }
    }
}

impl Said for ResonanceAnswer<'_> {
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
        let mut cells = self.cells();
        if let (Some(only), None) = (cells.next(), cells.next()) {
            return one_verdict(only);
        }
        let all = self.cells().count();
        let mut parts = Vec::new();
        if self.amplitudes_left() > 0 {
            parts.push(format!("stopped after {} of {} amplitudes", self.rows.len(), self.asked));
        }
        parts.push(format!("{} of {all} states roll", self.count(MotionKind::Rolls)));
        for (kind, one, several) in [
            (MotionKind::Slips, "slips in each period", "slip in each period"),
            (MotionKind::LiftsOff, "lifts off", "lift off"),
            (
                MotionKind::Overloaded,
                "is overloaded, beyond the end of the curve",
                "are overloaded, beyond the end of the curve",
            ),
            (
                MotionKind::Disengages,
                "disengages, its sprags thrown out of reach",
                "disengage, their sprags thrown out of reach",
            ),
            (MotionKind::NotFound, "does not repeat, or was not found", "do not repeat, or were not found"),
        ] {
            match self.count(kind) {
                0 => {}
                1 => parts.push(format!("1 {one}")),
                n => parts.push(format!("{n} {several}")),
            }
        }
        let two = self.cells().filter(|c| c.other.is_some()).count();
        let unstable = self.cells().filter(|c| c.state.is_stable() == Some(false)).count();
        let untold = self.cells().filter(|c| c.state.motion.is_ok() && c.state.is_stable().is_none()).count();
        if two > 0 {
            parts.push(format!("at {two} two states were found"));
        }
        if unstable > 0 {
            parts.push(format!("{unstable} {} unstable", if unstable == 1 { "is" } else { "are" }));
        }
        if untold > 0 {
            let they = if untold == 1 { "it is" } else { "they are" };
            parts.push(format!("of {untold} it cannot be told whether {they} stable"));
        }
        parts.join("; ")
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
        let most = self.cells().filter_map(|c| Some((c, c.state.required_friction?)));
        let most = most.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(c, mu)| {
            format!(
                "Largest static friction that rolling needs where it keeps contact: {} at {} and {}; there is {}",
                significant(mu, 4),
                Unit::Hertz.show(c.frequency_hz, 4),
                Unit::NewtonMetre.show(c.amplitude_nm, 4),
                significant(self.friction, 3),
            )
        });
        let ends = self.count(MotionKind::Overloaded) + self.count(MotionKind::Disengages) > 0;
        let ends = ends.then(|| {
            "overloaded, disengages: no motion repeats there, the swing carries the sprag beyond the end of the curve, off its profile or over \
             its highest point, or farther from the race than is followed"
                .to_owned()
        });
        let neutral = self.cells().filter_map(|c| {
            let motion = c.state.motion.as_ref().ok()?;
            motion.neutral_multiplier().map(|_| motion.multiplier_error)
        });
        let neutral =
            neutral.fold(None, |most: Option<f64>, error| Some(most.map_or(error, |m| m.max(error))));
        let neutral = neutral.map(|error| {
            format!(
                "Multiplier: the largest beside a pair that is 1 within its error of {}: a swing that neither grows nor dies away, such as \
                 that of both races together on an abutment, which has no damper; it counts for no instability",
                significant(error, 2)
            )
        });
        let list = [
            most,
            ends,
            neutral,
            Some(
                "Each state is a motion that repeats with the period of the excitation, its start forgotten; a start may slip where \
                 the state rolls: simulate tells of that"
                    .to_owned(),
            ),
        ];
        list.into_iter().flatten().collect()
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

    fn body(&self) -> Value {
        json!({
            "scenario": self.scenario.name, "amplitudes_left": self.amplitudes_left(), "verdict": self.verdict(), "static_friction": self.friction,
            "rolls": self.rolls(), "states": self.states().objects(),
        })
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
        let Some((state, finer)) = self.cells().next().map(|c| &c.state).zip(self.finer.as_ref()) else {
            return Some(json!({ "tolerance": self.tolerance }));
        };
        let off = |of: &dyn Fn(&Steady) -> Option<f64>| Some((of(state)? - of(finer)?).abs());
        let run = |s: &Steady, of: fn(&Run) -> f64| Some(of(&s.motion.as_ref().ok()?.run));
        Some(json!({
            "required_static_friction": off(&|s| s.required_friction), "contact_margin": off(&|s| s.contact_margin),
            "normal_min_n": off(&|s| run(s, |r| r.peaks.normal_min_n)),
            "normal_max_n": off(&|s| run(s, |r| r.peaks.normal_max_n)),
            "slip_inner_mm": off(&|s| run(s, |r| 1e3 * r.inner.distance_m)),
            "open_s": off(&|s| run(s, |r| r.open_s)),
        }))
    }

    fn draw(&self, page: &mut Page) {
        let wide = self.rows.iter().all(|row| row.len() > 1);
        if wide && self.rows.len() > 1 {
            page.heading("Map");
            page.paragraph(
                "First map: static friction that rolling needs, the deeper green the larger the slip margin, red where there is less; \
                 grey: rolling would open the contact; crossed: no rolling motion that repeats was found. Second map: what the clutch does with the friction that it has. The line is the \
                 border of what rolls.",
            );
            page.figures(&[(self.needed().to_figure(), ""), (self.kinds().to_figure(), "")]);
        }
        if wide {
            let mut needed = Plot::new("Frequency, Hz", "Static friction that rolling needs");
            let mut load = Plot::new("Frequency, Hz", "Largest normal force, N");
            for row in self.some_rows() {
                let name = row.first().map_or(String::new(), |c| Unit::NewtonMetre.show(c.amplitude_nm, 3));
                let points = |of: &dyn Fn(&ResonanceCell) -> Option<f64>| {
                    row.iter().filter_map(|c| Some([c.frequency_hz, of(c)?])).collect::<Vec<_>>()
                };
                needed = needed.curve(&name, points(&|c| c.state.required_friction));
                let largest = |c: &ResonanceCell| Some(c.state.motion.as_ref().ok()?.run.peaks.normal_max_n);
                load = load.curve(&name, points(&largest));
            }
            page.figures(&[
                (
                    half(needed),
                    &format!("Rolling states that keep contact; there is {}.", significant(self.friction, 3)),
                ),
                (half(load), "Of the state with the friction that there is."),
            ]);
        } else {
            page.table("The states.", &Said::table(self));
        }
    }
}

/// The state of a single frequency and amplitude.
fn one_verdict(c: &ResonanceCell) -> String {
    let s = &c.state;
    let motion = s.motion.as_ref().ok();
    let slip = motion.map_or(0.0, |o| o.run.inner.distance_m);
    let needs = match s.required_friction {
        Some(mu) => format!("rolling needs a friction of {}", significant(mu, 4)),
        None if s.rolling.is_ok() => "rolling would open the contact".to_owned(),
        None => "no rolling motion that repeats was found".to_owned(),
    };
    let what = match s.kind {
        MotionKind::Rolls => "rolls in each period".to_owned(),
        MotionKind::Slips => format!("slips {} in each period", Unit::Micrometre.show(slip, 4)),
        MotionKind::LiftsOff => format!(
            "lifts off for {} in each period",
            Unit::Millisecond.show(motion.map_or(0.0, |o| o.run.open_s), 3)
        ),
        MotionKind::Overloaded => "overloaded: the swing goes beyond the end of the curve".to_owned(),
        MotionKind::Disengages => "disengages: the swing throws the sprags out of reach".to_owned(),
        MotionKind::NotFound => "no motion that repeats was found; simulate runs the transient".to_owned(),
    };
    let stable = match s.is_stable() {
        Some(false) => "; unstable: it leaves that state by itself",
        None if motion.is_some() => {
            "; whether it is stable cannot be told: its multiplier is 1 within its error"
        }
        _ => "",
    };
    let other = c.other.as_ref().map_or(String::new(), |o| format!("; another state: {}", o.kind.name()));
    format!("{what}{stable}; {needs}{other}")
}

/// A state, at which frequency (Hz) and amplitude (N m), and another one there.
pub type StateLine<'a> = (f64, f64, &'a Steady, Option<&'a Steady>);

/// States in a line each.
fn lines<'a>(states: impl IntoIterator<Item = StateLine<'a>>) -> Rows<StateLine<'a>> {
    let motion = |s: &StateLine<'a>| s.2.motion.as_ref().ok();
    let run = |s: &StateLine<'a>| motion(s).map(|o| &o.run);
    let drift_rad = |s: &StateLine<'a>| motion(s).map(|o| o.drift_rad());
    Rows::of(states)
        .number("frequency_hz", "Frequency", Unit::Hertz, 5, |(hz, ..)| *hz)
        .number("amplitude_nm", "Amplitude", Unit::NewtonMetre, 5, |(_, nm, ..)| *nm)
        .text("state", "State", |(_, _, s, _)| {
            Cell::Verdict(s.kind == MotionKind::Rolls, s.kind.name().to_owned())
        })
        .text("stable", "Stable", |(_, _, s, _)| match (s.is_stable(), s.motion.is_ok()) {
            (Some(stable), _) => Cell::told(if stable { "yes" } else { "NO" }, stable),
            (None, true) => Cell::told("?", Cell::Empty),
            (None, false) => Cell::Empty,
        })
        .number("required_static_friction", "μ needed", Unit::One, 5, |(_, _, s, _)| s.required_friction)
        .number("slip_margin", "Slip margin", Unit::One, 4, |(_, _, s, _)| s.slip_margin)
        .shown_in(Unit::Percent)
        .number("contact_margin", "Contact margin", Unit::One, 4, |(_, _, s, _)| s.contact_margin)
        .shown_in(Unit::Percent)
        .number("normal_min_n", "N smallest", Unit::Newton, 4, |s| run(s).map(|r| r.peaks.normal_min_n))
        .number("normal_max_n", "N largest", Unit::Newton, 4, |s| run(s).map(|r| r.peaks.normal_max_n))
        .number("slip_inner_mm", "Slip a period", Unit::Millimetre, 4, |s| run(s).map(|r| r.inner.distance_m))
        .shown_in(Unit::Micrometre)
        .number("open_s", "Open a period", Unit::Second, 4, |s| run(s).map(|r| r.open_s))
        .shown_in(Unit::Millisecond)
        // What rolls comes back: what is left of it is rounding.
        .number("drift_rad", "Drift a period", Unit::Radian, 4, |s| {
            drift_rad(s).map(|d| if s.2.kind == MotionKind::Rolls { 0.0 } else { d[0] - d[1] })
        })
        .shown_in(Unit::Milliradian)
        .number("deciding_multiplier", "Multiplier", Unit::One, 6, |s| {
            motion(s).map(|o| o.deciding_multiplier())
        })
        .number("neutral_multiplier", "Neutral one", Unit::One, 6, |s| {
            motion(s).and_then(|o| o.neutral_multiplier())
        })
        .text("other_state", "Other state", |(.., other)| other.map(|other| other.kind.name()))
        .json("other", |(hz, nm, _, other)| other.map(|other| lines([(*hz, *nm, other, None)]).object()))
        .json("multipliers", |s| motion(s).map(|o| o.multipliers.clone()))
        .json("multiplier_error", |s| motion(s).map(|o| o.multiplier_error))
        .json("tan_inner", |s| run(s).map(|r| r.peaks.tan_inner))
        .json("tan_outer", |s| run(s).map(|r| r.peaks.tan_outer))
        .json_in("slip_outer_mm", Unit::Millimetre, |s| run(s).map(|r| r.outer.distance_m))
        .json_in("net_slip_inner_mm", Unit::Millimetre, |s| run(s).map(|r| r.inner.net_m))
        .json("drift_inner_rad", |s| drift_rad(s).map(|d| d[0]))
        .json("drift_outer_rad", |s| drift_rad(s).map(|d| d[1]))
        .json("newton_error", |s| motion(s).map(|o| o.error))
        .json("periods", |(_, _, s, _)| s.periods)
        .json("work_in_j", |s| run(s)?.energy.map(|e| e.torque_inner_j + e.torque_outer_j))
        .json("lost_j", |s| {
            let e = run(s)?.energy?;
            Some(-(e.friction_inner_j + e.friction_outer_j + e.race_damping_j + e.contact_damping_j))
        })
}

/// Edges between values that rise, half way.
fn edges(values: &[f64]) -> Vec<f64> {
    let [Some(first), Some(last)] = [values.first(), values.last()] else { return Vec::new() };
    let between = values.windows(2).map(|w| 0.5 * (w[0] + w[1]));
    let half = |a: usize| values.get(a + 1).map_or(0.5, |next| 0.5 * (next - values[a]));
    // Neither is negative.
    let ends = [(first - half(0)).max(0.0), last + half(values.len().saturating_sub(2))];
    std::iter::once(ends[0]).chain(between).chain([ends[1]]).collect()
}
