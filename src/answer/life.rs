//! What a life of loads does to a clutch: loads, places, verdict, curves of life.

use super::left_out::{LeftOut, left_out_of};
use super::resonance::NoResonance;
use super::{Finding, Said};
use crate::clutch::{RepeatedLoad, RepeatedSwing, Service};
use crate::design::Design;
use crate::life::{
    Broken, INDENTING_PA, Life, LifePlace, LoadEffect, Used, WornLife, WornState, life, part_at, worn_life,
};
use crate::margin::{NoMargins, load_state};
use crate::report::plot::Curve;
use crate::report::{Cell, Page, Plot, Rows, Screen, Table, Tone, Unit, significant};
use crate::scenario::{MotionKind, Settings, prepare, steady_motion};
use serde_json::{Value, json};
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
    /// The part of the life after which wear breaks a limit, where that is before its end.
    fn worn_out(&self) -> Option<(f64, Broken)> {
        self.worn.as_ref()?.broken().filter(|(share, _)| *share <= 1.0)
    }

    /// The clutch as it wears; `None` where nothing is known to wear.
    pub fn wear(&self) -> Option<Rows<&WornState>> {
        let worn = self.worn.as_ref()?;
        let (hours, engagements) = (worn.hours, self.life.engagements);
        let rows = Rows::of(&worn.states)
            .number("hours", "Overrun, h", Unit::One, 4, |s| hours * s.share)
            .number("engagements", "Engagements", Unit::One, 4, |s| engagements * s.share)
            .number("flat_um", "Flat", Unit::Micrometre, 3, |s| s.flat_m)
            .number("inner_track_um", "Track", Unit::Micrometre, 3, |s| s.wear.inner_track_m)
            .number("opened_um", "Gap opens", Unit::Micrometre, 3, |s| s.opened_m)
            .number("first_tan_omega", "tan ω first", Unit::One, 4, |s| s.first_tan_omega)
            .number("required_friction", "μ needed", Unit::One, 4, |s| s.required_friction)
            .number("capacity_nm", "Capacity", Unit::NewtonMetre, 4, |s| s.capacity.as_ref().map(|c| c.0))
            .number("lift_off_rpm", "Lift-off", Unit::Rpm, 4, |s| s.lift_off_rad_s)
            .text("state", "State", |s| match s.broken {
                Some(why) => Cell::Verdict(false, why.names().0.to_owned()),
                None => Cell::Verdict(true, "holds".to_owned()),
            })
            .json("share", |s| s.share)
            .json_in("half_flat_um", Unit::Micrometre, |s| s.half_flat_m)
            .json_in("outer_track_um", Unit::Micrometre, |s| s.wear.outer_track_m)
            .json_in("inner_arcs_um", Unit::Micrometre, |s| s.wear.inner_arcs_m[0])
            .json_in("outer_arc_um", Unit::Micrometre, |s| s.wear.outer_arc_m)
            .json("capacity_by", |s| s.capacity.as_ref().map(|c| c.1.clone()))
            .json("normal_inner_n", |s| s.normal_n)
            .json("broken", |s| s.broken.map(|why| why.names().0));
        Some(rows)
    }

    /// What wear comes to, in a sentence.
    fn wear_remark(&self) -> Option<String> {
        let worn = self.worn.as_ref()?;
        let ends = match worn.broken() {
            Some((share, why)) => format!(
                "after {} h of overrun ({} lives) {}",
                significant(share * worn.hours, 3),
                significant(share, 3),
                why.names().1
            ),
            None => "no limit is broken within a hundred lives".to_owned(),
        };
        Some(format!(
            "Wear: {ends} (Archard; the coefficients of [lubrication] are known to a power of ten at best)"
        ))
    }

    /// How much the answer knows.
    pub fn known(&self) -> LifeKnown {
        match (
            self.life.held() && self.worn_out().is_none(),
            self.life.decides(),
            self.not_known().is_empty(),
        ) {
            (false, ..) => LifeKnown::NotHeld,
            (true, None, _) => LifeKnown::Nothing,
            (true, Some(_), false) => LifeKnown::HeldInPart,
            (true, Some(_), true) => LifeKnown::Held,
        }
    }

    /// What no strength is given for, and the key that would give it.
    fn not_known(&self) -> Vec<String> {
        let any = |ring: bool| self.life.not_known().any(|place| place.race().is_some() == ring);
        let mut all = Vec::new();
        if any(false) {
            all.push(
                "pitting of sprags and races (add pitting = { pressure_mpa = ..., cycles = ... } to [life])"
                    .to_owned(),
            );
        }
        if any(true) {
            let strength =
                "rings = { amplitude_mpa = ..., cycles = ..., exponent = ..., ultimate_mpa = ... }";
            all.push(format!("fatigue of the races as rings (add {strength} to [life])"));
        }
        if let Some(expected) = self.life.slips.filter(|_| self.life.slips_allowed.is_none()) {
            let expected = significant(expected, 2);
            all.push(format!("how many of the {expected} slips expected by chance may be (add slips_allowed = ... to [life])"));
        }
        all
    }

    /// Each place: what is used up.
    pub fn places(&self) -> Rows<&Used> {
        let verdict = |used: &Used| match used.sum {
            Some(sum) => Cell::held(sum <= 1.0),
            None if self.life.loads.iter().any(|l| l.state.is_none()) => "torque not carried".into(),
            None => "strength not given".into(),
        };
        Rows::of(&self.life.used)
            .text("place", "Place", |used| used.place.names().1)
            .number("cycles", "Cycles", Unit::One, 4, |used| used.cycles)
            .number("used", "Used up", Unit::One, 3, |used| used.sum)
            .shown_in(Unit::Percent)
            .number("lives", "Lives", Unit::One, 3, |used| used.lives().filter(|l| l.is_finite()))
            .number("mostly_at_nm", "Mostly at", Unit::NewtonMetre, 4, |used| {
                used.sum.map(|_| used.mostly_nm)
            })
            .text("verdict", "Verdict", |used| verdict(used))
            .json("code", |used| used.place.names().0)
    }

    /// Each load: what one engagement at it does.
    pub fn loads(&self) -> Rows<&LoadEffect> {
        Rows::of(&self.life.loads)
            .number("torque_nm", "Torque", Unit::NewtonMetre, 4, |l| l.torque_nm)
            .number("engagements", "Engagements", Unit::One, 4, |l| l.engagements)
            .number("hertz_inner_mpa", "p₀ inner", Unit::Megapascal, 4, |l| {
                l.state.map(|p| p.hertz_inner_pa)
            })
            .number("hertz_outer_mpa", "p₀ outer", Unit::Megapascal, 4, |l| {
                l.state.map(|p| p.hertz_outer_pa)
            })
            .number("hoop_inner_mpa", "Hoop inner", Unit::Megapascal, 4, |l| l.state.map(|_| l.hoop_pa[0]))
            .number("hoop_outer_mpa", "Hoop outer", Unit::Megapascal, 4, |l| l.state.map(|_| l.hoop_pa[1]))
            .number("walk_inner_mm", "Walk inner", Unit::Millimetre, 3, |l| l.state.map(|_| l.walk_m[0]))
            .number("walk_outer_mm", "Walk outer", Unit::Millimetre, 3, |l| l.state.map(|_| l.walk_m[1]))
            .number("slip_probability", "Slips, of one", Unit::One, 2, |l| l.slip)
            .json("carried", |l| l.state.is_some())
            .json("passes_inner", |l| l.passes[0])
            .json("passes_outer", |l| l.passes[1])
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
        let life = &self.life;
        let not_carried: Vec<String> = life
            .loads
            .iter()
            .filter(|l| l.state.is_none())
            .map(|l| Unit::NewtonMetre.show(l.torque_nm, 4))
            .collect();
        if !not_carried.is_empty() {
            return format!("NOT HELD: the clutch does not carry {}", not_carried.join(", "));
        }
        if let Some((share, why)) = self.worn_out() {
            return format!("NOT HELD: after {} of the life {}", Unit::Percent.show(share, 3), why.names().1);
        }
        if let Some(load) = life.slipping() {
            return format!(
                "NOT HELD: it slips at {}: that needs a friction of {}, and {} is there in the mean",
                Unit::NewtonMetre.show(load.torque_nm, 4),
                significant(load.required_friction.unwrap_or(f64::INFINITY), 4),
                significant(life.friction, 4)
            );
        }
        let mut said = Vec::new();
        if life.indents() {
            said.push(format!("{} indents a contact", Unit::NewtonMetre.show(life.largest_nm, 4)));
        }
        if let Some((expected, allowed)) =
            life.slips.zip(life.slips_allowed).filter(|_| life.slips_too_often())
        {
            let (expected, allowed) = (significant(expected, 2), significant(allowed, 2));
            said.push(format!("{expected} slips by chance are expected in the life, {allowed} are allowed"));
        }
        if let Some(used) = life.decides() {
            let decides = format!(
                "{} decides, {} of its life used up, most of it at {}",
                used.place.names().1,
                Unit::Percent.show(used.sum.unwrap_or(0.0), 3),
                Unit::NewtonMetre.show(used.mostly_nm, 4)
            );
            // What fails comes first.
            let at = if used.sum.is_some_and(|sum| sum > 1.0) { 0 } else { said.len() };
            said.insert(at, decides);
        }
        let unknown = self.not_known();
        let word = match self.known() {
            LifeKnown::NotHeld => "NOT HELD: ",
            LifeKnown::Held => "HELD: ",
            LifeKnown::HeldInPart => "HELD as far as is known: ",
            LifeKnown::Nothing => "NOT KNOWN: no strength is given, so no life",
        };
        let mut all = format!("{word}{}", said.join("; "));
        if !unknown.is_empty() {
            all += &format!("; not known: {}", unknown.join(", "));
        }
        all
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
        let life = &self.life;
        let [inner, outer] = life.indentation;
        let mut all = Vec::new();
        if inner > 0.0 {
            let pressure = Unit::Megapascal.show(INDENTING_PA, 4);
            let says = |place: &str, factor: f64| match factor >= 1.0 {
                true => format!("{place} bears {} times its load until it indents", significant(factor, 3)),
                false => {
                    format!("{place} is indented: it bears {} of its load", Unit::Percent.show(factor, 3))
                }
            };
            all.push(format!(
                "At {} the {}, the {} ({pressure}, a permanent 1e-4 of the diameter: ISO 76, line contacts, 58 HRC or more)",
                Unit::NewtonMetre.show(life.largest_nm, 4),
                says("inner contact", inner),
                says("outer contact", outer)
            ));
        }
        if let Some(slips) = life.slips {
            all.push(format!(
                "Slip by chance: {} slips are expected in {} engagements{} (μs {} ± {}, torques ± {}; lognormal, independent)",
                significant(slips, 2),
                significant(life.engagements, 4),
                life.slips_allowed.map_or(String::new(), |most| format!(", {} are allowed", significant(most, 2))),
                significant(self.design.clutch.friction.static_, 4),
                Unit::Percent.show(self.service.friction_scatter, 3),
                Unit::Percent.show(self.service.torque_scatter, 3)
            ));
        }
        if let Some(p) = &self.service.pitting {
            all.push(format!(
                "Pitting: {} cycles at {}, exponent {} of the pressure; places of a track are met {}",
                significant(p.cycles, 4),
                Unit::Megapascal.show(p.pressure_pa, 4),
                significant(p.exponent, 4),
                if self.service.same_places {
                    "in every engagement"
                } else {
                    "where a sprag happens to stand"
                }
            ));
        }
        all.extend(self.wear_remark());
        for s in &self.swung {
            all.push(format!(
                "{}: {} h at {} are {} engagements at {}, its peak as the clutch carries it (peaks above half of the largest: Tsubakimoto); the rings \
                 swing up from {}",
                s.scenario,
                significant(s.duration_s / 3600.0, 4),
                Unit::Hertz.show(s.frequency_hz, 4),
                significant(s.load.engagements, 4),
                Unit::NewtonMetre.show(s.load.torque_nm, 4),
                Unit::NewtonMetre.show(s.load.from_nm, 4),
            ));
        }
        if let Some((peak_nm, indents)) = life.peak_beyond {
            let word = if indents { ", which would indent a contact" } else { "" };
            all.push(format!(
                "Not counted: peak torque, {} by [limits]{word}: {{ torque_nm = {peak_nm:?}, engagements = ... }} among the loads of [life] counts it",
                Unit::NewtonMetre.show(peak_nm, 4)
            ));
        }
        let not_counted: Vec<&str> = self.not_counted().collect();
        if let Some(first) = not_counted.first() {
            all.push(format!(
                "Not counted: {}, which would be an engagement in each period: swings = [{{ scenario = \"{first}\", hours = ... }}] in [life] counts \
                 it, or a history",
                not_counted.join(", ")
            ));
        }
        for history in &self.service.histories {
            all.push(format!(
                "{}: peaks above half of the largest (Tsubakimoto) and what rises from below half of its own peak are an engagement each, rings by \
                 rainflow (ASTM E1049), in hundredths of the largest torque, rounded up; it begins and ends at rest",
                history.name
            ));
        }
        all
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

    fn body(&self) -> Value {
        let life = &self.life;
        let swings = Rows::of(&self.swung)
            .json("scenario", |s| s.scenario.as_str())
            .json("hours", |s| s.duration_s / 3600.0)
            .json("frequency_hz", |s| s.frequency_hz)
            .json("from_nm", |s| s.load.from_nm)
            .json("torque_nm", |s| s.load.torque_nm)
            .json("engagements", |s| s.load.engagements);
        let mut body = json!({
            "swings": swings.objects(), "swings_not_counted": self.not_counted().collect::<Vec<_>>(),
            "held": self.known() != LifeKnown::NotHeld, "verdict": self.verdict(), "engagements": life.engagements,
            "largest_torque_nm": life.largest_nm, "expected_slips": life.slips, "slips_allowed": life.slips_allowed,
            "indents": life.indents(), "not_known": life.not_known().map(|place| place.names().0).collect::<Vec<_>>(),
            "indentation_inner": life.indentation[0], "indentation_outer": life.indentation[1],
            "places": self.places().objects(), "loads": self.loads().objects(),
        });
        if let Some((worn, states)) = self.worn.as_ref().zip(self.wear()) {
            let broken = worn.broken();
            body["wear"] = json!({
                "hours": worn.hours, "broken_after_lives": broken.map(|b| b.0), "broken_by": broken.map(|b| b.1.names().0),
                "states": states.objects(),
            });
        }
        body
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
                "torques of loads and histories are taken as they are given, each engagement as slow; swings have the torques that the clutch carries",
                "what `simulate` finds beyond the torque given: put its peak here",
            ),
            LeftOut::new(
                "wear, lubricant, residual stress",
                "wear: with `overruns` and oil, by Archard, with the film of the drawn contact; it does not change pitting and fatigue; the others: no \
                 model",
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
            "Used up: Miner's sum over this life; lives: how often it fits in. Cycles of a track: contacts that one place of it sees.",
            &self.places().table(),
        );
        page.heading("Loads").table(
            "Of histories in classes. Walk: what the contact rolls on sprag and race; hoop: with bending between the sprags.",
            &self.table(),
        );
        if let Some(wear) = self.wear() {
            page.heading("Wear").table(
                "Sprags and tracks as they wear, until a limit is broken: depth of the flat, gap, friction that first contact and the largest load ask \
                 for, lowest torque capacity.",
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
