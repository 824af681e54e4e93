//! What a slip under load and the blow after it do to a clutch: each path of slip, verdict, curve.

mod body;
mod page;
mod words;

pub use body::{BorneBody, ReengagementBody, ThrownBody};

use super::check::{Capacity, overrun::outer_turns};
use super::left_out::{LeftOut, left_out_of};
use super::{Finding, Said};
use crate::design::Design;
use crate::dynamics::Stop;
use crate::element::NoElement;
use crate::follow::Follow;
use crate::margin::{Capacities, LIFT_OFF_TO_RAD_S, LoadState, lift_off_rad_s, load_margins, load_state};
use crate::reengage::{Blow, Blows, SlipEnd, SlipUnderLoad, blows, blows_with, both_taken_up_j};
use crate::report::{Page, Screen, Table};
use rayon::prelude::*;
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
    /// Frictions of a table over friction and inertia; none: [`Self::friction`].
    pub over_friction: Vec<f64>,
    /// What turns with the inner race, this included, in that table, kg m^2; none: that of [`Self::inertia_kg_m2`]. Without either list there
    /// is no table.
    pub over_inner_inertia_kg_m2: Vec<f64>,
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
            over_friction: Vec::new(),
            over_inner_inertia_kg_m2: Vec::new(),
            follow: Follow::nobody(),
        }
    }
}

impl ReengagementSettings {
    /// The slip that it asks of `design`, its friction 0 where none is given, or what makes no sense.
    ///
    /// # Errors
    /// [`NoReengagement::Refused`].
    pub fn validate(&self, design: &Design) -> Result<SlipUnderLoad, NoReengagement> {
        let positive = |x: f64| x.is_finite() && x > 0.0;
        let races = &design.clutch.races;
        let own = [races.inner_inertia_kg_m2, races.outer_inertia_kg_m2];
        let running = running(design).filter(|_| self.speed_rad_s.is_none());
        let case = SlipUnderLoad {
            torque_nm: self.torque_nm.or(design.limits.nominal_torque_nm).unwrap_or(0.0),
            speed_rad_s: self.speed_rad_s.or(running.map(|r| r.1)).unwrap_or(0.0),
            inertia_kg_m2: [0, 1].map(|race| self.inertia_kg_m2[race].unwrap_or(own[race])),
            outer_held: self
                .outer_held
                .unwrap_or_else(|| self.inertia_kg_m2[1].is_none() && !outer_turns(design)),
            friction: self.friction.unwrap_or(0.0),
            paths_m: self.paths_m.clone(),
        };
        let rising = case.paths_m.windows(2).all(|w| w[0] < w[1]);
        if !positive(case.torque_nm) {
            return Err(NoReengagement::Refused(
                "a torque above 0, given or as nominal_torque_nm in [limits]",
            ));
        } else if !case.inertia_kg_m2.into_iter().all(positive) {
            return Err(NoReengagement::Refused("inertias above 0"));
        } else if case.outer_held && self.inertia_kg_m2[1].is_some() {
            return Err(NoReengagement::Refused(
                "an outer race that is held, or an inertia of it: one of both",
            ));
        } else if !(case.friction.is_finite() && case.friction >= 0.0) {
            return Err(NoReengagement::Refused("a friction of 0 or more"));
        } else if case.paths_m.is_empty() || !rising || !case.paths_m.iter().copied().all(positive) {
            return Err(NoReengagement::Refused("paths of slip above 0, each longer than the one before"));
        }
        let over = [&self.over_friction, &self.over_inner_inertia_kg_m2];
        if !over[0].iter().all(|mu| mu.is_finite() && *mu >= 0.0) || !over[1].iter().copied().all(positive) {
            return Err(NoReengagement::Refused(
                "frictions of 0 or more and inertias above 0 in the table over both",
            ));
        }
        Ok(case)
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

/// Rows of the table over friction and inertia on a terminal.
const MOST_ROWS: usize = 60;

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
    /// Whether the search for that was stopped.
    pub borne_stopped: bool,
    /// Blows over friction and inertia, each at every path; empty where no such table was asked for.
    pub over: Vec<BlowAt>,
    /// How many were asked for.
    over_asked: usize,
    /// The scenario whose speed was taken; `None`: the speed was given, or the design names none.
    pub speed_of: Option<&'a str>,
    /// Speed of the outer race, rad/s, at which the sprags lift off in overrun; `None`: they do not.
    pub lift_off_rad_s: Option<f64>,
    /// Whether the inertia of the outer race was given.
    outer_given: bool,
}

/// A blow at another friction and inertia.
#[derive(Debug, Clone, PartialEq)]
pub struct BlowAt {
    /// Friction while it slips.
    pub friction: f64,
    /// What turns with the inner race, this included, kg m^2.
    pub inner_inertia_kg_m2: f64,
    /// The blow; `None`: this friction holds the torque, or the sprags are out of reach before the path is walked.
    pub blow: Option<Blow>,
    /// Path of slip, m.
    pub path_m: f64,
    /// Why there is no blow: whether the friction holds the torque.
    pub holds: bool,
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
        let mut case = settings.validate(self)?;
        let running = running(self).filter(|_| settings.speed_rad_s.is_none());
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
            let end_nm = state.curve.end_torque_nm();
            let most_nm = bears.as_ref().map_or(end_nm, |(nm, _)| nm.min(end_nm)).max(case.torque_nm);
            both_taken_up_j(&state.curve, case.torque_nm, [most_nm, end_nm])
        });
        let speed_of = running.map(|r| r.0);
        let mut answer = ReengagementAnswer {
            design: self,
            case,
            found,
            bears,
            takes_up_j,
            borne: None,
            borne_stopped: false,
            over: Vec::new(),
            over_asked: 0,
            speed_of,
            lift_off_rad_s,
            outer_given: settings.inertia_kg_m2[1].is_some(),
        };
        if !answer.is_held() && answer.outcome() != Finding::Stopped {
            answer.borne = answer.borne(&settings.follow).map_err(NoReengagement::NoStart)?;
            answer.borne_stopped = answer.borne.is_none() && settings.follow.stopped();
        }
        let over = [&settings.over_friction, &settings.over_inner_inertia_kg_m2];
        if over.iter().any(|list| !list.is_empty()) {
            answer.table_over(over, &settings.follow).map_err(NoReengagement::NoStart)?;
        }
        Ok(answer)
    }
}

impl ReengagementAnswer<'_> {
    fn bears_it(&self, blow: &Blow) -> bool {
        let most_nm = self.bears.as_ref().map_or(f64::INFINITY, |(torque_nm, _)| *torque_nm);
        blow.peak.is_some_and(|p| p.torque_nm <= most_nm)
    }

    /// Fill the table over frictions and inertias; cases that were stopped are left out.
    fn table_over(
        &mut self,
        [frictions, inertias]: [&Vec<f64>; 2],
        follow: &Follow,
    ) -> Result<(), NoElement> {
        let or_own = |list: &Vec<f64>, own: f64| if list.is_empty() { vec![own] } else { list.clone() };
        let inertias = or_own(inertias, self.case.inertia_kg_m2[0]);
        let cases: Vec<[f64; 2]> = or_own(frictions, self.case.friction)
            .into_iter()
            .flat_map(|friction| inertias.iter().map(move |&inertia| [friction, inertia]))
            .collect();
        self.over_asked = cases.len() * self.case.paths_m.len();
        let one = |&[friction, inner_inertia_kg_m2]: &[f64; 2]| -> Result<Vec<BlowAt>, NoElement> {
            let inertia_kg_m2 = [inner_inertia_kg_m2, self.case.inertia_kg_m2[1]];
            let case = SlipUnderLoad { friction, inertia_kg_m2, ..self.case.clone() };
            let found = blows(&self.design.clutch, &case, follow)?;
            if follow.stopped() {
                return Ok(Vec::new());
            }
            let at = |(k, path_m): (usize, &f64)| {
                let blow = found.list.get(k).cloned();
                BlowAt { friction, inner_inertia_kg_m2, blow, path_m: *path_m, holds: found.holds.is_some() }
            };
            Ok(self.case.paths_m.iter().enumerate().map(at).collect())
        };
        let rows: Vec<Vec<BlowAt>> = cases.par_iter().map(one).collect::<Result<_, _>>()?;
        self.over = rows.concat();
        Ok(())
    }

    /// Whether a slip of `path_m` at `friction` is borne; `None`: stopped.
    fn one_is_borne(&self, friction: f64, path_m: f64, follow: &Follow) -> Result<Option<bool>, NoElement> {
        let case = SlipUnderLoad { friction, paths_m: vec![path_m], ..self.case.clone() };
        let found = blows_with(&self.design.clutch, &case, false, follow)?;
        let borne = found.ended.is_none() && found.list.iter().all(|blow| self.bears_it(blow));
        Ok((!follow.stopped()).then_some(borne))
    }

    /// What would be borne beside what was asked; `None`: nothing was found to vary, or it was stopped.
    fn borne(&self, follow: &Follow) -> Result<Option<BorneSlip>, NoElement> {
        let (Some(&shortest_m), needs) = (self.case.paths_m.first(), self.found.needs) else {
            return Ok(None);
        };
        if !needs.is_finite() || follow.stopped() {
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
}

impl Said for ReengagementAnswer<'_> {
    type Body<'a>
        = ReengagementBody<'a>
    where
        Self: 'a;

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
            _ if self.borne_stopped || self.over.len() < self.over_asked => Finding::Stopped,
            Some(stop) if stop.gave_up() => Finding::NotKnown,
            _ => Finding::of(found.ended.is_none() && found.list.iter().all(|blow| self.bears_it(blow))),
        }
    }

    fn verdict(&self) -> String {
        self.verdict_words()
    }

    fn remarks(&self) -> Vec<String> {
        if self.found.list.is_empty() { Vec::new() } else { self.remark_words() }
    }

    fn table(&self) -> Table {
        self.blows().table()
    }

    fn tables(&self, screen: Screen) -> String {
        if self.found.list.is_empty() {
            return String::new();
        }
        let text = [BLOW, WAY].map(|keys| self.table().only(keys).to_text(screen)).join("\n");
        if self.over.is_empty() {
            return text;
        }
        let (rows, more) = self.blows_over().table().first(MOST_ROWS);
        let rest = if more > 0 { format!("{more} more: --json or --report\n") } else { String::new() };
        format!("{text}\n{}{rest}", rows.to_text(screen))
    }

    fn body(&self) -> ReengagementBody<'_> {
        ReengagementBody::of(self)
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
        page::draw(self, page);
    }
}
