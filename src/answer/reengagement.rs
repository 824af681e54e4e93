//! What a slip under load and the blow after it do to a clutch: each path of slip, verdict, curve.

mod words;

use super::check::{Capacity, overrun::outer_turns};
use super::left_out::{LeftOut, left_out_of};
use super::{Finding, Said};
use crate::design::Design;
use crate::dynamics::Stop;
use crate::element::NoElement;
use crate::follow::Follow;
use crate::margin::{Capacities, LIFT_OFF_TO_RAD_S, LoadState, lift_off_rad_s, load_margins, load_state};
use crate::reengage::{Blow, Blows, SlipEnd, SlipUnderLoad, blows, taken_up_j};
use crate::report::plot::{Curve, Dash};
use crate::report::{Cell, Page, Plot, Rows, Screen, Table, Unit, significant};
use serde_json::{Value, json};
use std::fmt;

/// What a user may choose; what is `None` is taken from the design.
#[derive(Debug, Clone)]
pub struct ReengagementSettings {
    /// Torque that is carried when the slip begins, N m; `None`: the nominal torque of `[limits]`.
    pub torque_nm: Option<f64>,
    /// What turns with the inner and the outer race, these included, kg m^2; `None`: the races alone.
    pub inertia_kg_m2: [Option<f64>; 2],
    /// Whether the outer race keeps its speed whatever acts on it; `None`: where the design names no speed of it and no inertia is
    /// given.
    pub outer_held: Option<bool>,
    /// Friction while it slips; `None`: [`SHORT`] of what the torque needs.
    pub friction: Option<f64>,
    /// Speed of both races, rad/s; `None`: the largest at which a scenario of the design carries torque.
    pub speed_rad_s: Option<f64>,
    /// Paths of slip at the inner track, m.
    pub paths_m: Vec<f64>,
    /// Followed and stopped by.
    pub follow: Follow,
}

impl Default for ReengagementSettings {
    fn default() -> Self {
        Self {
            torque_nm: None,
            inertia_kg_m2: [None; 2],
            outer_held: None,
            friction: None,
            speed_rad_s: None,
            paths_m: vec![1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 3e-2],
            follow: Follow::nobody(),
        }
    }
}

/// Share of the friction that a torque needs which a slip has where nothing is said.
pub const SHORT: f64 = 0.95;

/// What would be borne where a blow is not.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BorneSlip {
    /// Longest path of slip at the friction given, m; `None`: not even the shortest that is tried, 1 µm.
    pub path_m: Option<f64>,
    /// Friction from which on the shortest path asked for is borne; `None`: none below what the torque needs.
    pub friction: Option<f64>,
}

/// Shortest path of slip that is tried, m.
const SHORTEST_M: f64 = 1e-6;
/// Halvings of a path, by its logarithm, and of a friction between what is borne and what is not.
const HALVINGS: usize = 10;
/// Share of the friction needed that is the largest tried: nearer to it a slip begins too slowly to be followed.
const NEAREST: f64 = 0.999;

/// Columns for people: the blow; and the way to it.
const BLOW: &[&str] =
    &["path_mm", "peak_torque_nm", "verdict", "times", "peak_by_energy_nm", "energy_j", "of_borne"];
const WAY: &[&str] = &["path_mm", "hertz_inner_mpa", "speed_rpm", "slip_ms", "peak_ms", "path_in_all_mm"];

/// A slip and its blows.
#[derive(Debug, Clone)]
pub struct ReengagementAnswer<'a> {
    design: &'a Design,
    /// What was asked.
    pub case: SlipUnderLoad,
    /// What came of it.
    pub found: Blows,
    /// Peak torque that every limit bears, N m, and the limit that sets it.
    pub bears: Option<(f64, String)>,
    /// Energy that the windup takes up from the torque carried to that one and to the end of the curve, J.
    pub takes_up_j: Option<[f64; 2]>,
    /// What would be borne, where a blow is not.
    pub borne: Option<BorneSlip>,
    /// The scenario whose speed was taken; `None`: the speed was given, or the design names none.
    pub speed_of: Option<&'a str>,
    /// Speed of the outer race, rad/s, at which the sprags lift off in overrun; `None`: they do not.
    pub lift_off_rad_s: Option<f64>,
    /// Whether the inertia of the outer race was given.
    outer_given: bool,
}

/// Why there is none.
#[derive(Debug, Clone, PartialEq)]
pub enum NoReengagement {
    /// The clutch cannot begin so.
    NoStart(NoElement),
    /// A setting makes no sense: what is allowed.
    Refused(&'static str),
}

impl fmt::Display for NoReengagement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoStart(why) => why.fmt(f),
            Self::Refused(allowed) => write!(f, "allowed: {allowed}"),
        }
    }
}

impl std::error::Error for NoReengagement {}

/// Peak torque that every limit bears, N m, and the limit that sets it.
pub(super) fn peak_torque_borne(design: &Design, state: &LoadState) -> Option<(f64, String)> {
    let rows = load_margins(design, &design.limits, Capacities::Wanted, state);
    let [_, peak] = Capacity::nominal_and_peak(&rows, state.curve.end_torque_nm());
    peak.map(|c| (c.torque_capacity_nm, c.code))
}

/// The scenario that carries torque at the largest speed, and that speed, rad/s; `None`: no such scenario turns.
fn running(design: &Design) -> Option<(&str, f64)> {
    let carries = design.scenarios.iter().filter(|s| !s.kind.is_overrun());
    // An infinite mean speed stands for a history.
    let speeds = carries.map(|s| (s.name.as_str(), s.mean_speed_rad_s()));
    let known = speeds.filter(|(_, speed)| speed.is_finite() && *speed != 0.0);
    known.fold(None, |most: Option<(&str, f64)>, one| match most {
        Some(most) if most.1.abs() >= one.1.abs() => Some(most),
        _ => Some(one),
    })
}

impl Design {
    /// Slip under load and the blow when the clutch grips again, for each path of slip.
    ///
    /// # Errors
    /// [`NoReengagement`].
    pub fn reengagement(
        &self,
        settings: &ReengagementSettings,
    ) -> Result<ReengagementAnswer<'_>, NoReengagement> {
        let positive = |x: f64| x.is_finite() && x > 0.0;
        let races = &self.clutch.races;
        let own = [races.inner_inertia_kg_m2, races.outer_inertia_kg_m2];
        let running = running(self).filter(|_| settings.speed_rad_s.is_none());
        let mut case = SlipUnderLoad {
            torque_nm: settings.torque_nm.or(self.limits.nominal_torque_nm).unwrap_or(0.0),
            speed_rad_s: settings.speed_rad_s.or(running.map(|r| r.1)).unwrap_or(0.0),
            inertia_kg_m2: [0, 1].map(|race| settings.inertia_kg_m2[race].unwrap_or(own[race])),
            outer_held: settings
                .outer_held
                .unwrap_or_else(|| settings.inertia_kg_m2[1].is_none() && !outer_turns(self)),
            friction: settings.friction.unwrap_or(0.0),
            paths_m: settings.paths_m.clone(),
        };
        let rising = case.paths_m.windows(2).all(|w| w[0] < w[1]);
        if !positive(case.torque_nm) {
            return Err(NoReengagement::Refused(
                "a torque above 0, given or as nominal_torque_nm in [limits]",
            ));
        } else if !case.inertia_kg_m2.into_iter().all(positive) {
            return Err(NoReengagement::Refused("inertias above 0"));
        } else if case.outer_held && settings.inertia_kg_m2[1].is_some() {
            return Err(NoReengagement::Refused(
                "an outer race that is held, or an inertia of it: one of both",
            ));
        } else if !(case.friction.is_finite() && case.friction >= 0.0) {
            return Err(NoReengagement::Refused("a friction of 0 or more"));
        } else if case.paths_m.is_empty() || !rising || !case.paths_m.iter().copied().all(positive) {
            return Err(NoReengagement::Refused("paths of slip above 0, each longer than the one before"));
        }
        let state = load_state(self).ok();
        if settings.friction.is_none() {
            let at_torque = state.as_ref().and_then(|state| state.curve.at_torque(case.torque_nm));
            case.friction = at_torque.map_or(0.0, |p| SHORT * p.required_friction());
        }
        let found = blows(&self.clutch, &case, &settings.follow).map_err(NoReengagement::NoStart)?;
        let lift_off = |state: &LoadState| lift_off_rad_s(self, state, LIFT_OFF_TO_RAD_S);
        let lift_off_rad_s = state.as_ref().and_then(lift_off);
        let bears = state.as_ref().and_then(|state| peak_torque_borne(self, state));
        let takes_up_j = state.and_then(|state| {
            let up_to = |nm: f64| taken_up_j(&state.curve, case.torque_nm, nm);
            let end_nm = state.curve.end_torque_nm();
            let most_nm = bears.as_ref().map_or(end_nm, |(nm, _)| nm.min(end_nm)).max(case.torque_nm);
            Some([up_to(most_nm)?, up_to(end_nm)?])
        });
        let speed_of = running.map(|r| r.0);
        let mut answer = ReengagementAnswer {
            design: self,
            case,
            found,
            bears,
            takes_up_j,
            borne: None,
            speed_of,
            lift_off_rad_s,
            outer_given: settings.inertia_kg_m2[1].is_some(),
        };
        if !answer.is_held() && !settings.follow.stopped() {
            answer.borne = answer.borne(&settings.follow).map_err(NoReengagement::NoStart)?;
        }
        Ok(answer)
    }
}

impl ReengagementAnswer<'_> {
    fn bears_it(&self, blow: &Blow) -> bool {
        let most_nm = self.bears.as_ref().map_or(f64::INFINITY, |(torque_nm, _)| *torque_nm);
        blow.peak.is_some_and(|p| p.torque_nm <= most_nm)
    }

    /// Whether a slip of `path_m` at `friction` is borne; `None`: stopped.
    fn one_is_borne(&self, friction: f64, path_m: f64, follow: &Follow) -> Result<Option<bool>, NoElement> {
        let case = SlipUnderLoad { friction, paths_m: vec![path_m], ..self.case.clone() };
        let found = blows(&self.design.clutch, &case, follow)?;
        let borne = found.ended.is_none() && found.list.iter().all(|blow| self.bears_it(blow));
        Ok((!follow.stopped()).then_some(borne))
    }

    /// What would be borne beside what was asked; `None`: nothing was found to vary, or it was stopped.
    fn borne(&self, follow: &Follow) -> Result<Option<BorneSlip>, NoElement> {
        let (Some(&shortest_m), needs) = (self.case.paths_m.first(), self.found.needs) else {
            return Ok(None);
        };
        if !needs.is_finite() {
            return Ok(None);
        }
        let lost = self.found.list.iter().position(|blow| !self.bears_it(blow));
        let lost = lost.unwrap_or(self.found.list.len()).min(self.case.paths_m.len() - 1);
        let held_m = if lost > 0 { Some(self.case.paths_m[lost - 1]) } else { None };
        let mut path_m = held_m;
        if held_m.is_none() {
            match self.one_is_borne(self.case.friction, SHORTEST_M, follow)? {
                Some(true) => path_m = Some(SHORTEST_M),
                Some(false) => {}
                None => return Ok(None),
            }
        }
        if let Some(mut borne_m) = path_m {
            let mut lost_m = self.case.paths_m[lost];
            for _ in 0..HALVINGS {
                let middle_m = (borne_m * lost_m).sqrt();
                match self.one_is_borne(self.case.friction, middle_m, follow)? {
                    Some(true) => borne_m = middle_m,
                    Some(false) => lost_m = middle_m,
                    None => return Ok(None),
                }
            }
            path_m = Some(borne_m);
        }
        let mut friction = None;
        let [mut lost, mut borne] = [self.case.friction, NEAREST * needs];
        // Where the shortest path asked for is borne, so is the friction given.
        if held_m.is_none() && lost < borne {
            match self.one_is_borne(borne, shortest_m, follow)? {
                Some(true) => {
                    for _ in 0..HALVINGS {
                        let middle = 0.5 * (lost + borne);
                        match self.one_is_borne(middle, shortest_m, follow)? {
                            Some(true) => borne = middle,
                            Some(false) => lost = middle,
                            None => return Ok(None),
                        }
                    }
                    friction = Some(borne);
                }
                Some(false) => {}
                None => return Ok(None),
            }
        } else if held_m.is_some() {
            friction = Some(self.case.friction);
        }
        Ok(Some(BorneSlip { path_m, friction }))
    }

    /// Energy of the races against one another that a blow has to take up, J, where it is known, and its share of what is borne.
    fn energy(&self, blow: &Blow) -> Option<(f64, Option<f64>)> {
        let energy_j = self.case.energy_j(self.told(blow)?);
        Some((
            energy_j,
            self.takes_up_j.map(|[most_j, _]| energy_j / most_j).filter(|share| share.is_finite()),
        ))
    }

    /// Speed of the races against one another, rad/s. Where sprags are thrown out once the friction is back, the races are driven apart
    /// as long as they were followed, which is no figure.
    fn told(&self, blow: &Blow) -> Option<f64> {
        let known = blow.peak.is_some() || blow.peak_s.is_none() || blow.ended == Some(Stop::CurveEnd);
        known.then_some(blow.speed_rad_s)
    }

    /// Where the slip itself throws the sprags out of reach.
    fn thrown(&self) -> Option<SlipEnd> {
        self.found.ended.filter(|end| end.stop == Stop::FellAway)
    }

    /// Why the clutch does not grip, where it does not.
    fn lost(&self, end: &SlipEnd) -> String {
        let when = format!("{} after the slip begins", Unit::Millisecond.show(end.at_s, 3));
        match end.stop {
            Stop::FellAway => {
                let mut said = format!(
                    "NOT HELD: {when} the sprags are thrown farther than their spring reaches, and nothing brings them back: from then on the \
                     torque drives the races apart unhindered"
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

    /// Each path of slip with its blow.
    pub fn blows(&self) -> Rows<&Blow> {
        let word = |b: &Blow| match (self.bears_it(b), b.ended) {
            (true, _) => "held",
            (false, None) => "NOT HELD",
            (false, Some(Stop::FellAway)) => "THROWN OUT",
            (false, Some(Stop::CurveEnd)) => "OVERLOADED",
            (false, Some(_)) => "NO GRIP",
        };
        Rows::of(&self.found.list)
            .number("path_mm", "Slip", Unit::Millimetre, 3, |b| b.path_m)
            .number("peak_torque_nm", "Blow", Unit::NewtonMetre, 4, |b| b.peak.map(|p| p.torque_nm))
            .text("verdict", "Verdict", |b| Cell::Verdict(self.bears_it(b), word(b).to_owned()))
            .number("times", "Times", Unit::One, 3, |b| b.peak.map(|p| p.torque_nm / self.case.torque_nm))
            .number("peak_by_energy_nm", "By energy", Unit::NewtonMetre, 4, |b| b.by_energy_nm)
            .number("energy_j", "Energy", Unit::Joule, 3, |b| self.energy(b).map(|e| e.0))
            .number("of_borne", "Of borne", Unit::One, 3, |b| self.energy(b).and_then(|e| e.1))
            .number("hertz_inner_mpa", "p₀ inner", Unit::Megapascal, 4, |b| {
                b.peak.map(|p| p.hertz_inner_pa)
            })
            .number("speed_rpm", "Speed gained", Unit::Rpm, 3, |b| self.told(b))
            .number("slip_ms", "Lasts", Unit::Millisecond, 3, |b| b.slip_s)
            .number("peak_ms", "Blow at", Unit::Millisecond, 3, |b| b.peak_s.filter(|_| b.peak.is_some()))
            .number("path_in_all_mm", "In all", Unit::Millimetre, 3, |b| b.path_in_all_m)
            .json("held", |b| self.bears_it(b))
            .json("ended", |b| b.ended.map(Stop::name))
    }

    /// The friction of the slip, and its share of what the torque needs.
    fn short(&self) -> String {
        let (friction, needs) = (self.case.friction, self.found.needs);
        let share = needs.is_finite().then(|| {
            format!(" ({} of the {} that it needs)", significant(friction / needs, 2), significant(needs, 3))
        });
        significant(friction, 3) + &share.unwrap_or_default()
    }
}

impl Said for ReengagementAnswer<'_> {
    fn title(&self) -> &str {
        "Slip and re-engagement"
    }

    fn design(&self) -> &Design {
        self.design
    }

    fn outcome(&self) -> Finding {
        let found = &self.found;
        let ends = found.list.iter().filter_map(|blow| blow.ended).chain(found.ended.map(|end| end.stop));
        match ends.last() {
            Some(Stop::Interrupted) => Finding::Stopped,
            Some(stop) if stop.gave_up() => Finding::NotKnown,
            _ => Finding::of(found.ended.is_none() && found.list.iter().all(|blow| self.bears_it(blow))),
        }
    }

    fn verdict(&self) -> String {
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
                None => {
                    format!("NOT HELD: after {} of slip the blow goes beyond the end of the curve", path(b))
                }
            },
            None => {
                let most = self.found.list.iter().filter_map(|b| Some((b, b.peak?.torque_nm)));
                most.max_by(|a, b| a.1.total_cmp(&b.1)).map_or("HELD".to_owned(), |(b, torque_nm)| {
                    format!("HELD: after {} of slip {}{limit}", path(b), Unit::NewtonMetre.show(torque_nm, 4))
                })
            }
        }
    }

    fn remarks(&self) -> Vec<String> {
        let case = &self.case;
        if self.found.list.is_empty() {
            return Vec::new();
        }
        let [inner, outer] = case.inertia_kg_m2.map(|i| significant(i, 4));
        let outer = match case.outer_held {
            true => "rigidly, the outer race is held".to_owned(),
            false => format!("{outer} kg m² with the outer one, both rigidly"),
        };
        let mut all: Vec<String> = self.bare_ring().into_iter().collect();
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
            "Slip, lasts: path at the inner track and time until the design's friction is back; times: blow over the torque carried; by energy: \
             nothing lost; energy: of the races against one another, of borne: that over what the limits let the windup take up; speed gained: largest speed of the races against one another; in all: path until these stand still against one another"
                .to_owned(),
            "A clutch that slips throws its sprags out: they must come back by their spring before they grip, however short the slip".to_owned(),
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
                "From {} of slip on the slip itself throws the sprags out of reach: rows beyond are of races with nothing between them; by energy: what \
                 the speed would come to if the sprags gripped there. Rows above that end so are thrown out once the friction is back",
                Unit::Millimetre.show(end.path_m, 3)
            ));
            if let Some(speed) = self.lift_off_rad_s.filter(|speed| *speed <= end.outer_rad_s.abs()) {
                all.push(format!(
                    "The outer race runs at {}; in steady overrun its sprags lift off from {} on, slower they come back sooner",
                    Unit::Rpm.show(end.outer_rad_s.abs(), 4),
                    Unit::Rpm.show(speed, 4)
                ));
            }
        }
        all
    }

    fn table(&self) -> Table {
        self.blows().table()
    }

    fn tables(&self, screen: Screen) -> String {
        if self.found.list.is_empty() {
            return String::new();
        }
        [BLOW, WAY].map(|keys| self.table().only(keys).to_text(screen)).join("\n")
    }

    fn body(&self) -> Value {
        let case = &self.case;
        let rpm = |rad_s: f64| Unit::Rpm.from_si(rad_s);
        let mm = |m: f64| Unit::Millimetre.from_si(m);
        json!({
            "held": self.is_held(), "verdict": self.verdict(), "torque_nm": case.torque_nm, "friction": case.friction,
            "speed_rpm": rpm(case.speed_rad_s), "inertia_inner_kg_m2": case.inertia_kg_m2[0],
            "inertia_outer_kg_m2": (!case.outer_held).then_some(case.inertia_kg_m2[1]), "outer_held": case.outer_held,
            "bears_nm": self.bears.as_ref().map(|b| b.0),
            "bears_by": self.bears.as_ref().map(|b| b.1.as_str()), "blows": self.blows().objects(),
            "bears_j": self.takes_up_j.map(|j| j[0]), "end_of_curve_j": self.takes_up_j.map(|j| j[1]),
            "torque_needs_friction": Some(self.found.needs).filter(|mu| mu.is_finite()),
            "borne": self.borne.map(|b| json!({ "path_mm": b.path_m.map(mm), "friction": b.friction })),
            "speed_of": self.speed_of,
            "needs_friction": self.found.holds, "slip_ended": self.found.ended.map(|end| end.stop.name()),
            "lift_off_rpm": self.lift_off_rad_s.map(rpm),
            "thrown": self.thrown().map(|end| json!({
                "at_ms": Unit::Millisecond.from_si(end.at_s), "path_mm": mm(end.path_m), "speed_rpm": rpm(end.speed_rad_s),
                "outer_rpm": rpm(end.outer_rad_s),
            })),
        })
    }

    fn left_out(&self) -> Vec<LeftOut> {
        let mut all = vec![
            LeftOut::new(
                "shafts",
                if self.case.outer_held {
                    "the inertia is rigid with the inner race, what holds the outer race does not give"
                } else {
                    "both inertias are rigid with their races"
                },
                "a soft shaft lowers the blow: put the drive into [[drivetrain]] and simulate a transient",
            ),
            LeftOut::new(
                "damping between the races",
                "races.viscous_damping_nm_s_per_rad is taken as 0: where nobody has measured it, it would take from the blow",
                "a damper of 0.1 Nm s/rad takes 5 % of the blow of the starter after 30 mm, between light races far more",
            ),
            LeftOut::new(
                "cage and neighbours",
                "a sprag that is thrown out is stopped by nothing but its spring",
                "a cage brings it back sooner: less speed, a smaller blow",
            ),
        ];
        all.extend(left_out_of(self.design));
        all
    }

    fn draw(&self, page: &mut Page) {
        let points = |of: &dyn Fn(&Blow) -> Option<f64>| -> Vec<[f64; 2]> {
            self.found.list.iter().filter_map(|b| Some([1e3 * b.path_m, of(b)?])).collect()
        };
        let mut plot = Plot::new("Slip until the friction is back, mm", "Torque, Nm");
        plot.log_x = true;
        let blow = points(&|b| Some(b.peak?.torque_nm));
        let energy = points(&|b| Some(self.energy(b)?.0));
        // Where most blows have no torque, what they bring says by how much too much it is.
        let few = blow.len() < 3 && blow.len() < energy.len();
        let few = few.then(|| self.energy_plot(energy)).flatten();
        let blow_is_empty = blow.is_empty();
        if !blow_is_empty {
            plot.curves.push(Curve::new("blow", blow));
        }
        let by_energy = points(&|b| b.by_energy_nm);
        let is_empty = blow_is_empty && by_energy.is_empty();
        if !by_energy.is_empty() {
            // Often beside the blow itself.
            plot.curves
                .push(Curve { dash: Dash::Dashed, ..Curve::new("by energy, nothing lost", by_energy) });
        }
        if let Some((most_nm, code)) = &self.bears {
            plot.curves.push(Curve::new(&format!("allowed by {code}"), points(&|_| Some(*most_nm))));
        }
        if !self.found.list.is_empty() {
            if let Some(energy) = few {
                page.figure(
                    &energy.to_figure(),
                    "Energy of the races against one another after each path of slip, and what the windup takes up: to its limits and to the end of \
                     the curve. Beyond that the blow has no torque to draw.",
                );
            } else {
                match is_empty {
                true => page.paragraph(
                    "No curve of the blow over slip: every one of them goes beyond what the clutch carries.",
                ),
                false => page.figure(&plot.to_figure(), "Largest torque when the clutch grips again."),
                };
            }
            page.table("The blow after each path of slip.", &self.table().only(BLOW));
            page.table("The way to it.", &self.table().only(WAY));
        }
    }
}
