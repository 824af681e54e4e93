//! The verdict in words, and what of the clutch the figures of a scene are compared with.

use super::Ran;
use crate::answer::roll_over::followed;
use crate::clutch::{Scenario, ScenarioKind};
use crate::dynamics::{Grip, Mode, Place, Stop, Swing};
use crate::margin::{lift_off_rad_s as lift_off, load_state};
use crate::report::{Tone, Unit};
use crate::scenario::{NoScenario, Prepared, Simulation, Verdict, overrun_swing};
use crate::wedge::{StaticPoint, straddling_error};

/// Lift-off is looked for up to this speed of the outer race, rad/s: 60 000 rev/min, a choice.
pub const LIFT_OFF_SEARCH_RAD_S: f64 = 2000.0 * std::f64::consts::PI;

impl Ran {
    /// Verdict by its name, also where the clutch has no start: it does not carry it, or has no curve.
    pub fn verdict(&self) -> Option<&'static str> {
        match &self.outcome {
            Ok((_, s)) => s.verdict.map(Verdict::name),
            Err(NoScenario::NotCarried { .. }) => Some(Verdict::Overloaded.name()),
            Err(NoScenario::PublishedTrain | NoScenario::DrivenCage(_)) => None,
            Err(_) => Some(Verdict::Disengages.name()),
        }
    }

    /// The answer in one line.
    pub fn verdict_line(&self) -> String {
        let name = &self.scenario.name;
        let Some(verdict) = self.verdict() else { return format!("{name}: no verdict") };
        let meaning = match &self.outcome {
            Err(why) => why.to_string(),
            Ok((prepared, s)) if s.verdict == Some(Verdict::Overloaded) => {
                let curve = &prepared.model.curve;
                let end = Unit::NewtonMetre.show(curve.end_torque_nm(), 4);
                let at = Unit::Second.show(s.t_s, 4);
                let then =
                    self.beyond.as_ref().map_or(String::new(), |beyond| format!("; {}", followed(beyond)));
                format!(
                    "the load goes beyond the end of the curve ({} at {end}) at {at}{then}",
                    curve.end().0.name()
                )
            }
            Ok((prepared, s)) => meaning(s, &self.scenario, overrun_swing(&self.scenario, prepared)),
        };
        format!("{name}: {verdict}: {meaning}")
    }

    /// Whether the clutch does what the scenario asks ([`Verdict::is_as_asked`]).
    pub fn held(&self) -> bool {
        match self.simulation().and_then(|s| Some((s, s.verdict?))) {
            // Off the race in overrun: so it may be, but where contact is to be kept at that speed.
            Some((_, Verdict::Disengages)) => match self.scenario.kind {
                ScenarioKind::Overrun { speed_rad_s, .. } => {
                    self.design.limits.keep_contact_to_rad_s.is_none_or(|keep| speed_rad_s > keep)
                }
                _ => false,
            },
            Some((s, verdict)) => verdict.is_as_asked(&self.scenario, s.slipped_engaging_m()),
            None => false,
        }
    }

    /// How the verdict looks on a page.
    pub(super) fn tone(&self) -> Tone {
        let overran = self.simulation().filter(|s| s.verdict == Some(Verdict::SlipsOverrunning));
        match overran.filter(|s| self.scenario.lets_go().is_none() && !s.slips_under_load()) {
            Some(_) => Tone::Plain,
            None if self.held() => Tone::Good,
            None => Tone::Bad,
        }
    }

    /// Speed of the outer race at which the sprags lift off the inner one, rad/s, for an overrun; `None` where they
    /// stay on up to 60 000 rev/min, or in another scenario.
    pub fn lift_off_rad_s(&self) -> Option<f64> {
        if !self.scenario.kind.is_overrun() {
            return None;
        }
        let state = load_state(&self.design).ok()?;
        lift_off(&self.design, &state, LIFT_OFF_SEARCH_RAD_S)
    }

    /// The static state at the nominal torque of `[limits]`: with its pressure at A the paper's 4.1.2 compares.
    pub fn rated(&self) -> Option<StaticPoint> {
        // The scene's own curve may end where the scene has no use for it.
        let state = load_state(&self.design).ok()?;
        state.curve.at_torque(self.design.limits.nominal_torque_nm?)
    }

    /// By what part the pressure's shape makes a Hertz pressure at `normal_n` (N) uncertain: 0 but where a junction lies under
    /// the inner contact.
    pub fn shape_error(&self, prepared: &Prepared, normal_n: f64) -> f64 {
        let at = (normal_n > 0.0).then(|| prepared.model.curve.at_normal(normal_n)).flatten();
        if at.is_some_and(|p| p.straddles_junction) { straddling_error(&self.design.clutch) } else { 0.0 }
    }
}

fn meaning(s: &Simulation, scenario: &Scenario, swing: Option<Swing>) -> String {
    let (kind, clutch) = (&scenario.kind, &scenario.clutch);
    let margin = match s.demand.map(|d| d.required_friction.zip(d.slip_margin)) {
        Some(Some((needed, margin))) => {
            format!("slip margin {} (needs {})", Unit::Percent.show(margin, 3), Unit::One.show(needed, 4))
        }
        _ if s.demand.is_some_and(|d| d.gave_up.is_some()) => {
            "what friction would suffice is not known".to_owned()
        }
        Some(None) if s.demand.is_some_and(|d| d.contact_margin < 0.0) => {
            "no friction would suffice to stick, the contact would open".to_owned()
        }
        Some(None) => "no friction up to 1 would suffice to stick".to_owned(),
        None => String::new(),
    };
    let overruns = kind.is_overrun();
    match s.verdict {
        Some(Verdict::SlipsOverrunning | Verdict::Disengages) if overruns => {
            let drag = s.overrun.map_or(0.0, |o| o.drag_torque_nm);
            if s.verdict == Some(Verdict::Disengages) {
                let track = if clutch.slides_outside() { "outer" } else { "inner" };
                format!("the sprags have lifted off the {track} race: no drag")
            } else {
                let stays = match swing.filter(Swing::grows) {
                    Some(_) => " in an equilibrium that does not stay: the swing of the sprags grows",
                    None => "",
                };
                format!("drag torque {}{stays}", Unit::NewtonMetre.show(drag, 4))
            }
        }
        Some(Verdict::Sticks) if s.demand.is_some_and(|d| d.slip_margin.is_none_or(|m| m < 0.0)) => {
            format!("slips by less than 1 um, which counts as sticking; {margin}")
        }
        Some(Verdict::Sticks) => on_the_way(s).map_or(margin.clone(), |way| format!("{way}; {margin}")),
        Some(Verdict::SlipsEngaging) if kind.is_at_rest() => margin,
        // Sliding is what overrun does.
        Some(Verdict::SlipsOverrunning) if s.demand.is_none() => {
            format!(
                "it overruns to its end at {}: the clutch does not engage within duration_s",
                Unit::Second.show(s.t_s, 4)
            )
        }
        // What friction it would take not to let go is no question where it is to.
        Some(Verdict::SlipsOverrunning) if scenario.lets_go() != Some(false) => {
            let why = match scenario.lets_go() {
                Some(_) => ", as its torque has it",
                None => "",
            };
            let under_load = match s.slips_under_load() {
                true => format!(
                    "under load it slips by {} towards engaging",
                    Unit::Micrometre.show(s.slipped_engaging_m(), 4)
                ),
                false => "under load it does not slip".to_owned(),
            };
            format!("it overruns{why}: {}; {under_load}", shifted(s))
        }
        Some(Verdict::SlipsOverrunning | Verdict::SlipsEngaging) => format!("{}; {margin}", shifted(s)),
        Some(Verdict::Disengages) => {
            if s.peaks.normal_max_n <= 0.0 {
                return "the sprags touch without a force".to_owned();
            }
            let lost = Unit::Millisecond.show(s.contact_lost_s, 4);
            let at = Unit::Second.show(s.t_s, 4);
            match s.stop {
                Stop::CurveEnd => {
                    format!(
                        "contact lost for {lost}, and beyond the end of the curve when it closed, at {at}"
                    )
                }
                stop => format!("contact lost for {lost}, run {} at {at}", stop.name()),
            }
        }
        Some(Verdict::Overloaded) => "the load goes beyond the end of the curve".to_owned(),
        Some(Verdict::AtThreshold) | None => {
            "another verdict is nearer than the error estimate; a smaller tolerance or step decides"
                .to_owned()
        }
    }
}

/// What came before a run that ends sticking: overrunning until the clutch engaged, slip to and fro, contact lost. `None` where it
/// stuck throughout.
fn on_the_way(s: &Simulation) -> Option<String> {
    let time = |t_s: f64| Unit::Millisecond.show(t_s, 4);
    let overran = s.engaged.filter(|e| e.t_s > 0.0).map(|e| format!("overran until {}", time(e.t_s)));
    let slipped = (s.inner.distance_m > 0.0)
        .then(|| format!("slipped by {} in all", Unit::Micrometre.show(s.inner.distance_m, 4)));
    let lost = if s.modes.iter().any(|(_, mode)| mode.is_off()) { "had no" } else { "lost" };
    let open = (s.contact_lost_s > 0.0).then(|| format!("{lost} contact for {}", time(s.contact_lost_s)));
    let parts: Vec<String> = [overran, slipped, open].into_iter().flatten().collect();
    if parts.is_empty() {
        return None;
    }
    let sticks =
        |mode: &Mode| !matches!(mode.place, Place::Open | Place::Carried) && mode.inner == Grip::Stick;
    let first_of_last = s.modes.iter().rposition(|(_, mode)| !sticks(mode)).map(|last| last + 1);
    let from = first_of_last.and_then(|k| s.modes.get(k));
    let since = from.map_or(String::new(), |(t_s, _)| format!(", sticks from {} on", time(*t_s)));
    Some(format!("{}{since}", parts.join(", ")))
}

/// Which way the inner contact has slipped and the inner race gone: with slip at the outer contact and what turns without
/// contact the race may have gone the other way.
fn shifted(s: &Simulation) -> String {
    let sense = |towards: f64| if towards > 0.0 { "overrunning" } else { "engaging" };
    let offset = Unit::Milliradian.show(s.offset_rad.abs(), 4);
    if s.carried_m > 0.0 {
        return format!(
            "once it had gripped it overran again, its sprags with the cage: the inner race has run {offset} towards {}",
            sense(s.offset_rad)
        );
    }
    let (slip, race) = (sense(s.inner.net_m), sense(s.offset_rad));
    if slip == race {
        return format!("slip has shifted the inner race by {offset} towards {race}");
    }
    let net = Unit::Micrometre.show(s.inner.net_m.abs(), 4);
    let by = if s.contact_lost_s > 0.0 { " and while contact was lost" } else { "" };
    format!(
        "the inner contact has slipped by {net} towards {slip}, yet the inner race has gone {offset} towards {race}, by slip \
         at the outer contact{by}"
    )
}
