//! From a scenario of the design to a model with an initial state.

use super::sliding::{sliding, steady_under, touch};
use crate::clutch::{Clutch, Scenario, ScenarioKind, Start};
use crate::dynamics::{
    Carried, Drive, Grip, Loads, Mode, Model, N_STATE, Overrun, Place, SlidingContact, State, Train,
    alpha_max_rad, preloaded, settled, settled_end_torque_nm, settled_point,
};
use crate::friction::Stribeck;
use crate::numeric::course::Course;
use crate::profile::ProfileError;
use crate::wedge::{AtSpeed, AtSpeeds, Effort, NoCurve, StaticPoint, WedgeCurve};

/// Why a scenario has no start. A named outcome, not a fault of the file.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NoScenario {
    /// The profile cannot be placed.
    #[error("the profile cannot be placed: {0}")]
    Profile(ProfileError),
    /// No wedge curve at this speed.
    #[error("no wedge curve: {0}")]
    Curve(NoCurve),
    /// The curve ends below the preload.
    #[error("{torque_nm} Nm is not carried: the curve ends at {end_torque_nm:.4} Nm ({reason})")]
    NotCarried {
        /// Torque asked for, N m.
        torque_nm: f64,
        /// Torque at the curve's end, N m.
        end_torque_nm: f64,
        /// Name of the curve's end.
        reason: &'static str,
    },
    /// A driven cage where the sprags ride with the outer race.
    #[error(
        "[cage] has the sprags carried by the inner race; {0} knows overrun only with sprags that ride with the outer race: \
         without [cage] they do"
    )]
    DrivenCage(&'static str),
    /// The published scheme integrates the clutch alone, and the scene has a drivetrain.
    #[error(
        "the published scheme moves no drivetrain: take the event method, or give the scenario drivetrain = \
         []"
    )]
    PublishedTrain,
}

/// Ready to run.
#[derive(Debug, Clone)]
pub struct Prepared {
    /// Model under the scenario's loads.
    pub model: Model,
    /// Initial state.
    pub state: State,
    /// Initial mode.
    pub mode: Mode,
    /// Duration, s; 0 for a static scenario.
    pub duration_s: f64,
    /// Shortest period of the excitation, s, if any.
    pub period_s: Option<f64>,
    /// N_bi at the start, N; for an engagement that under the reversing torque, which it leads to, for a transient
    /// that under its largest torque.
    pub static_normal_n: f64,
    /// Steady overrun, for that kind of scenario and as the start of an engagement.
    pub overrun: Option<Overrun>,
    /// What that start follows from, where something happens after it.
    pub free_run: Option<FreeRun>,
    /// Which equilibrium a start under load is.
    pub start: Start,
}

/// A start in steady overrun, which depends on friction.
#[derive(Debug, Clone)]
pub struct FreeRun {
    clutch: Clutch,
    /// Curve at the speed of the start where that is not the model's.
    curve: Option<WedgeCurve>,
    /// How much the inner race is ahead, rad/s.
    speed_rad_s: f64,
}

impl FreeRun {
    /// The steady overrun of the sprags of `model` under the friction law `law`, alpha as of the model's curve.
    fn steady(&self, model: &Model, law: &Stribeck) -> Overrun {
        let curve = self.curve.as_ref().unwrap_or(&model.curve);
        let mu = friction_under(&self.clutch, law, self.speed_rad_s);
        let free = steady_under(&self.clutch, curve, model.alpha_max_rad, self.speed_rad_s, |_| {
            SlidingContact::dry(mu)
        });
        let moved = model.curve.first_contact_rad() - curve.first_contact_rad();
        Overrun { alpha_rad: free.alpha_rad + moved, ..free }
    }
}

impl Prepared {
    /// Start under another friction law: the same but for an overrun.
    pub(super) fn start_under(&self, law: &Stribeck) -> (State, Mode) {
        self.free_run.as_ref().map_or((self.state, self.mode), |f| {
            overrunning(&f.steady(&self.model, law), &self.model, f.speed_rad_s)
        })
    }

    /// Start in overrun of the sprags of another `model` of the scene; `None` where it does not begin so.
    pub fn overrun_of(&self, model: &Model) -> Option<(State, Mode)> {
        let free = self.free_run.as_ref()?;
        let mut sprung = free.clone();
        sprung.clutch.spring.stiffness_nm_per_rad = model.spring_nm_per_rad;
        Some(overrunning(&sprung.steady(model, &model.friction), model, free.speed_rad_s))
    }

    /// The equilibrium at the start of a static scenario, exact; `None` without a load.
    pub fn at_rest(&self) -> Option<StaticPoint> {
        let (curve, torque_nm) = (&self.model.curve, -self.model.loads.inner_nm);
        match self.start {
            _ if torque_nm <= 0.0 => curve.at_normal(self.static_normal_n),
            Start::WithoutSpring => curve.at_torque(torque_nm),
            Start::Settled => settled_point(&self.model, torque_nm, self.state[0]),
        }
    }
}

/// What the model of a scenario may do without.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Reduction {
    /// Torque beyond which no further arc of the curve is built, N m.
    pub reach_nm: Option<f64>,
    /// What goes into its curves.
    pub effort: Effort,
}

/// The whole curve at rest of a clutch, where it is known already: its scenes need not build it again.
#[derive(Debug, Clone, Copy)]
pub struct AtRest<'a> {
    /// The clutch.
    pub clutch: &'a Clutch,
    /// Its curve at rest, all arcs.
    pub curve: &'a WedgeCurve,
    /// Its curves at speed.
    pub at_speeds: &'a AtSpeeds,
}

/// Build model and initial state.
///
/// # Errors
/// [`NoScenario`] where the clutch cannot carry the scenario's start.
pub fn prepare(scenario: &Scenario) -> Result<Prepared, NoScenario> {
    prepare_reduced(scenario, &Reduction::default(), None)
}

/// As [`prepare`], without what `reduction` names, and with the curve at rest that is `known`.
///
/// # Errors
/// As [`prepare`].
pub fn prepare_reduced(
    scenario: &Scenario,
    reduction: &Reduction,
    known: Option<AtRest>,
) -> Result<Prepared, NoScenario> {
    let mut prepared = at_start(scenario, reduction, known)?;
    prepared.start = scenario.start;
    let model = &mut prepared.model;
    // A curve that ends before is one that the scene meets the end of.
    let largest_nm = model.loads.amplitude_nm - model.loads.inner_nm;
    let held =
        model.curve.at_torque(largest_nm).or_else(|| model.curve.at_torque(model.curve.end_torque_nm()));
    model.loaded_n = LOADED * held.map_or(0.0, |p| p.normal_inner_n).max(prepared.static_normal_n);
    Ok(prepared)
}

/// What part of the load that a scene's largest torque gives at rest a contact must carry to count as loaded: a choice.
const LOADED: f64 = 0.01;

fn at_start(
    scenario: &Scenario,
    reduction: &Reduction,
    known: Option<AtRest>,
) -> Result<Prepared, NoScenario> {
    let clutch = &scenario.clutch;
    let profile = clutch.profile().map_err(NoScenario::Profile)?;
    let known = known.filter(|k| k.clutch == clutch);
    let build = |speed: f64| {
        let Reduction { reach_nm, effort } = *reduction;
        let asked = AtSpeed { speed_rad_s: speed, reach_nm };
        let of_known = known
            .filter(|k| k.curve.effort() == effort)
            .and_then(|k| k.at_speeds.of(k.curve.statics(), clutch, asked));
        let anew = || WedgeCurve::build_reaching_at(clutch, &profile, speed, reach_nm, effort);
        of_known.map_or_else(anew, Ok).map_err(NoScenario::Curve)
    };
    let at_rest = match known {
        Some(known) => known.curve.reaching(reduction.reach_nm),
        None => build(0.0)?,
    };
    let alpha_max = alpha_max_rad(clutch, &at_rest);
    let stuck = |place| Mode { place, inner: Grip::Stick, outer: Grip::Stick };
    let still = Loads { inner_nm: 0.0, amplitude_nm: 0.0, omega_rad_s: 0.0, abutment_nm_per_rad: 0.0 };
    let train = Train::new(&scenario.drivetrain).filter(|_| !scenario.drivetrain.is_empty());
    let train = train.map(|t| t.in_frame(scenario.speed_history.clone()));
    // First contact in overrun where that is not the curve's, and how a driven cage carries the sprags from there.
    let in_cage = |curve: &WedgeCurve| {
        let Some(cage) = &clutch.cage else { return Ok((None, None)) };
        let touch = touch(clutch, &profile, curve.speed_rad_s()).map_err(NoScenario::Curve)?;
        Ok((Some(Carried::new(clutch, cage, &touch)), Some(touch)))
    };
    let start = |model: &mut Model, torque_nm: f64| {
        let (torque_nm, turn) = model.carries(torque_nm);
        let (found, end_torque_nm) = match scenario.start {
            Start::WithoutSpring => (preloaded(model, torque_nm), model.curve.end_torque_nm()),
            Start::Settled => (settled(model, torque_nm), settled_end_torque_nm(model)),
        };
        let reason = model.curve.end().0.name();
        let (mut state, place) = found.ok_or(NoScenario::NotCarried { torque_nm, end_torque_nm, reason })?;
        if turn != 0.0 {
            (state[2], state[3]) = (state[2] + turn, state[3] + turn);
        }
        Ok((state, place))
    };
    match scenario.kind {
        ScenarioKind::Static { torque_nm } => {
            let loads = Loads { inner_nm: -torque_nm, ..still };
            let mut model = Model::new(clutch, at_rest, loads, alpha_max, 0.0);
            let (state, place) = start(&mut model, torque_nm)?;
            Ok(finish(model, state, stuck(place), 0.0, None, None))
        }
        ScenarioKind::TorsionalExcitation {
            preload_nm,
            amplitude_nm,
            frequency_hz,
            abutment_stiffness_nm_per_rad,
            duration_s,
            speed_rad_s,
        } => {
            let curve = if speed_rad_s == 0.0 { at_rest } else { build(speed_rad_s)? };
            let loads = Loads {
                inner_nm: -preload_nm,
                amplitude_nm,
                omega_rad_s: std::f64::consts::TAU * frequency_hz,
                abutment_nm_per_rad: abutment_stiffness_nm_per_rad,
            };
            let (carried, _) = in_cage(&curve)?;
            let mut model = Model::new(clutch, curve, loads, alpha_max, 0.0).joined(train);
            model.carried = carried;
            let (state, place) = start(&mut model, preload_nm)?;
            Ok(finish(model, state, stuck(place), duration_s, Some(1.0 / frequency_hz), None))
        }
        ScenarioKind::Engagement {
            free_run_rad_s,
            reversing_torque_nm,
            stop_stiffness_nm_per_rad,
            bench_inertia_kg_m2,
            duration_s,
        } => {
            let loads = Loads {
                inner_nm: -reversing_torque_nm,
                abutment_nm_per_rad: stop_stiffness_nm_per_rad,
                ..still
            };
            let (carried, touch) = in_cage(&at_rest)?;
            let mut model = Model::new(clutch, at_rest, loads, alpha_max, bench_inertia_kg_m2).joined(train);
            model.carried = carried;
            let start = FreeRun { clutch: clutch.clone(), curve: touch, speed_rad_s: free_run_rad_s };
            let free = start.steady(&model, &model.friction);
            let (state, mode) = overrunning(&free, &model, free_run_rad_s);
            let held = model.curve.at_torque(reversing_torque_nm).map(|p| p.normal_inner_n);
            let prepared = finish(model, state, mode, duration_s, None, Some(free));
            let static_normal_n = held.unwrap_or(prepared.static_normal_n);
            Ok(Prepared { static_normal_n, free_run: Some(start), ..prepared })
        }
        ScenarioKind::Transient {
            preload_nm,
            torque_step_nm,
            step_time_s,
            abutment_stiffness_nm_per_rad,
            duration_s,
            speed_rad_s,
            overrun_rad_s,
        } => {
            let jump = vec![[step_time_s, preload_nm], [step_time_s, preload_nm + torque_step_nm]];
            let torque = Course::new(scenario.torque_history.clone().unwrap_or(jump));
            let speed = scenario.speed_history.clone().and_then(Course::new);
            let drive = Drive { torque_nm: torque, speed_rad_s: speed, ..Drive::default() };
            let at_start = drive.speed_rad_s.as_ref().map_or(speed_rad_s, |c| c.at(0.0).0);
            // The growth of the races is that of one speed: the middle of the extremes in Omega^2, which drives it.
            let of_curve = drive.speed_rad_s.as_ref().map_or(speed_rad_s, |c| {
                let [low, high] = c.extremes();
                (0.5 * (low * low + high * high)).sqrt()
            });
            let curve = if of_curve == 0.0 { at_rest } else { build(of_curve)? };
            let loads = Loads { abutment_nm_per_rad: abutment_stiffness_nm_per_rad, ..still };
            let (carried, touch) = in_cage(&curve)?;
            let free_run = if overrun_rad_s > 0.0 {
                let curve = match touch {
                    None if at_start != of_curve => Some(build(at_start)?),
                    touch => touch,
                };
                Some(FreeRun { clutch: clutch.clone(), curve, speed_rad_s: overrun_rad_s })
            } else {
                None
            };
            let largest = drive.torque_nm.as_ref().map_or(0.0, |c| c.extremes()[1]);
            let largest = train.as_ref().map_or(largest, |t| largest.max(t.largest_nm()));
            let mut model = Model::new(clutch, curve, loads, alpha_max, 0.0);
            model.drive = drive;
            model.carried = carried;
            let mut model = model.joined(train);
            let free = free_run.as_ref().map(|f| f.steady(&model, &model.friction));
            let (state, mode) = match &free {
                Some(free) => overrunning(free, &model, overrun_rad_s),
                None => {
                    let torque_nm = model.drive.torque_at(0.0).max(0.0);
                    let (state, place) = start(&mut model, torque_nm)?;
                    (state, stuck(place))
                }
            };
            let held = model.curve.at_torque(largest).map(|p| p.normal_inner_n);
            let prepared = finish(model, state, mode, duration_s, None, free);
            let static_normal_n = held.unwrap_or(0.0).max(prepared.static_normal_n);
            Ok(Prepared { static_normal_n, free_run, ..prepared })
        }
        ScenarioKind::Overrun { speed_rad_s, overrun_rad_s } => {
            let curve = if clutch.cage.is_some() {
                touch(clutch, &profile, speed_rad_s).map_err(NoScenario::Curve)?
            } else {
                build(speed_rad_s)?
            };
            // Which race runs ahead is no matter to the sprags: they ride with the outer one, and slide on the inner one as fast.
            let sliding = sliding(clutch, &curve, alpha_max, overrun_rad_s);
            let steady = sliding.state;
            let mut model = Model::new(clutch, curve, still, alpha_max, 0.0);
            model.film = sliding.lubricated.map(|l| l.law);
            let mut state = [0.0; N_STATE];
            state[0] = steady.alpha_rad;
            let mode = Mode { place: Place::Arc(0), inner: Grip::Slip(1.0), outer: Grip::Stick };
            Ok(finish(model, state, mode, 0.0, None, Some(steady)))
        }
    }
}

/// mu at the contact that slides, where the inner race runs ahead of the sprags by `overrun_rad_s`.
pub fn sliding_friction(clutch: &Clutch, overrun_rad_s: f64) -> f64 {
    friction_under(clutch, &Stribeck::of(&clutch.friction), overrun_rad_s)
}

fn friction_under(clutch: &Clutch, law: &Stribeck, overrun_rad_s: f64) -> f64 {
    law.coefficient(overrun_rad_s * clutch.sliding_track_m())
}

/// Start in steady overrun: the inner race runs ahead by `speed_rad_s` of sprags that ride with the outer race, or with sprags that a
/// driven cage carries.
fn overrunning(free: &Overrun, model: &Model, speed_rad_s: f64) -> (State, Mode) {
    let curve = &model.curve;
    let mut state = [0.0; N_STATE];
    (state[0], state[6]) = (free.alpha_rad, speed_rad_s);
    if model.carried.is_some() {
        (state[0], state[5]) = (curve.first_contact_rad(), speed_rad_s);
        let inner = if free.sliding_n > 0.0 { Mode::PRESSED } else { Mode::OFF };
        return (state, Mode { place: Place::Carried, inner, outer: Grip::Slip(-1.0) });
    }
    let closed = free.normal_inner_n > 0.0;
    let place = if closed { Place::Arc(curve.arc_at(free.alpha_rad)) } else { Place::Open };
    (state, Mode { place, inner: Grip::Slip(1.0), outer: Grip::Stick })
}

fn finish(
    model: Model,
    state: State,
    mode: Mode,
    duration_s: f64,
    period_s: Option<f64>,
    overrun: Option<Overrun>,
) -> Prepared {
    let static_normal_n = model.point(mode.place, state[0]).n_bi;
    let start = Start::default();
    Prepared { model, state, mode, duration_s, period_s, static_normal_n, overrun, free_run: None, start }
}
