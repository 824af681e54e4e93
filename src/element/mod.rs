//! A clutch as an element between two flanges: torques in, motion out, or the other way round, step by step, for programs that
//! integrate the rest.
//!
//! In: a clutch, how it begins, torque or speed of each flange over each step. Out: [`Element`], which can be saved and restored.
//! Absent: what lies beyond the flanges; an integrator of its own (a step is a run of `dynamics` that goes on where the last
//! has ended). Equations: none, (13) and (15) are those of `dynamics`.
//!
//! # Conventions
//! Flange 0 is the inner race, flange 1 the outer one. Angles, speeds and torques are absolute and share the sense in which A
//! lies ahead of B; a torque is what the flange passes on to its race. The clutch engages under a torque on the inner race
//! that is negative against that on the outer one: it then holds an inner race that lags behind, theta_inner - theta_outer
//! having fallen by the windup, and lets one run ahead.

mod motion;

pub use motion::{Contact, Flange, Motion};

use crate::clutch::{Clutch, Scenario, ScenarioKind, Start};
use crate::dynamics::{Drive, FlangeDrive, Memory, Model, Ramp, Run, RunSettings, SlipRecord, Stop, go_on};
use crate::numeric::setting::in_range;
use crate::scenario::{NoScenario, TOLERANCES, prepare};
use serde::{Deserialize, Serialize};

/// How an element begins.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Beginning {
    /// Time, s. A label: nothing depends on it.
    pub t_s: f64,
    /// Speed of the outer race, rad/s, and of the inner one unless that overruns. The growth of the races by centrifugal
    /// force stays that of this speed; the centrifugal force on the sprags follows the motion.
    pub speed_rad_s: f64,
    /// How much faster the inner race is, rad/s, at least 0: above 0 the sprags are in steady overrun, else in balance.
    pub overrun_rad_s: f64,
    /// Engaging torque in that balance, N m, at least 0: -torque at the inner flange, +torque at the outer one or its
    /// abutment. Means nothing in overrun.
    pub torque_nm: f64,
    /// Whether the spring takes part in the balance.
    pub start: Start,
    /// Angle of the outer race, rad, without the turn of an abutment; the inner race has turned against it by the windup of
    /// that torque.
    pub angle_rad: f64,
    /// Stiffness that ties the outer race to what turns at `speed_rad_s`, N m/rad; 0: free.
    pub abutment_nm_per_rad: f64,
}

impl Default for Beginning {
    /// At rest without load at t = 0, nothing tied.
    fn default() -> Self {
        Self {
            t_s: 0.0,
            speed_rad_s: 0.0,
            overrun_rad_s: 0.0,
            torque_nm: 0.0,
            start: Start::Settled,
            angle_rad: 0.0,
            abutment_nm_per_rad: 0.0,
        }
    }
}

/// How an element is integrated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Relative tolerance of a step of the integrator. Default 1e-8.
    pub tolerance: f64,
    /// Longest step of the integrator, s; `None`: as long as it is advanced.
    pub longest_step_s: Option<f64>,
    /// Steps of the integrator, rejected ones included, and twice the mode changes, before an advance ends with a name.
    /// Default 200 000.
    pub most_steps: u64,
    /// Whether [`Run::energy`] is made up. Default no.
    pub energy: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Self { tolerance: 1e-8, longest_step_s: None, most_steps: 200_000, energy: false }
    }
}

/// Shortest and longest advance, s.
const STEPS_S: [f64; 2] = [1e-15, 1e9];

/// Torque of a flange over one advance, straight between its ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Torque {
    /// At the start, N m.
    pub start_nm: f64,
    /// At the end, N m.
    pub end_nm: f64,
}

impl Torque {
    /// The same throughout.
    pub fn constant(torque_nm: f64) -> Self {
        Self { start_nm: torque_nm, end_nm: torque_nm }
    }
}

/// What a flange does to its race over one advance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Port {
    /// It passes on this torque; the motion of the race comes of it.
    Torque(Torque),
    /// It brings the race from the speed that this has to this one, rad/s, evenly over the advance; the torque comes of it
    /// ([`Flange::torque_nm`]). The angle follows, the race does not jump.
    Speed(f64),
    /// The same by its acceleration, rad/s^2.
    Acceleration(f64),
}

impl From<Torque> for Port {
    fn from(torque: Torque) -> Self {
        Self::Torque(torque)
    }
}

/// What was asked makes no sense.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{what}")]
pub struct Malformed {
    /// What was given, and what is allowed.
    pub what: String,
}

/// Why there is no element.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NoElement {
    /// A number of the question is none that is allowed.
    #[error("{0}")]
    Malformed(Malformed),
    /// The clutch cannot begin so.
    #[error("{0}")]
    NoStart(NoScenario),
}

/// Where an element stands. Numbers only, all finite: through `serde` and back it is the same to the bit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Saved {
    t_s: f64,
    /// Since the beginning, s.
    elapsed_s: f64,
    /// What the races have turned beside the mean speed and what `memory` says, rad.
    turned_rad: [f64; 2],
    /// Torques at the end of the last advance, N m; of a race that was moved 0.
    torques_nm: [f64; 2],
    /// Accelerations at which the races were moved then, rad/s^2.
    #[serde(default, skip_serializing_if = "nobody")]
    held_rad_s2: [Option<f64>; 2],
    /// Since the beginning: time in slip (s), path and net slip (m), at A and B.
    slips: [[f64; 3]; 2],
    ended: Option<Stop>,
    memory: Memory,
}

/// States of elements between torques alone are as short as ever.
fn nobody(held: &[Option<f64>; 2]) -> bool {
    held.iter().all(Option::is_none)
}

/// A clutch between two flanges.
#[derive(Debug, Clone)]
pub struct Element {
    model: Model,
    settings: Settings,
    at: Saved,
}

/// Turn of a race from which on it is counted anew, rad, so that errors stay those of small angles. A choice.
const FULL_TURN_RAD: f64 = 1.0;

/// Refuse what is outside of a range, in which nothing overflows.
fn check(name: &'static str, value: f64, range: [f64; 2]) -> Result<(), Malformed> {
    in_range(name, value, range).map_err(|bad| Malformed { what: bad.to_string() })
}

/// Largest torque of a flange either way, N m.
const MOST_NM: f64 = 1e9;

/// Largest speed of a flange either way, rad/s.
const MOST_RAD_S: f64 = 1e6;
/// Largest acceleration that a flange is moved at, rad/s^2: what brings a race to a machine's speed in a microsecond.
const MOST_RAD_S2: f64 = 1e12;

fn check_speed(race: usize, speed_rad_s: f64) -> Result<(), Malformed> {
    let name = ["speed of the inner flange (rad/s)", "speed of the outer flange (rad/s)"][race];
    check(name, speed_rad_s, [-MOST_RAD_S, MOST_RAD_S])
}

fn check_acceleration(race: usize, acceleration_rad_s2: f64) -> Result<(), Malformed> {
    let name =
        ["acceleration of the inner flange (rad/s^2)", "acceleration of the outer flange (rad/s^2)"][race];
    check(name, acceleration_rad_s2, [-MOST_RAD_S2, MOST_RAD_S2])
}

fn check_torque(race: usize, torque_nm: f64) -> Result<(), Malformed> {
    let name = ["torque of the inner flange (Nm)", "torque of the outer flange (Nm)"][race];
    check(name, torque_nm, [-MOST_NM, MOST_NM])
}

impl Element {
    /// `clutch`, beginning as `beginning` says.
    ///
    /// # Errors
    /// [`NoElement`] for numbers out of range, and where the clutch cannot carry the start.
    pub fn new(clutch: &Clutch, beginning: &Beginning, settings: &Settings) -> Result<Self, NoElement> {
        let b = beginning;
        let either_way = |most: f64| [-most, most];
        let longest_s = settings.longest_step_s.unwrap_or(1.0);
        let checks = [
            check("start time (s)", b.t_s, either_way(1e15)),
            check("speed (rad/s)", b.speed_rad_s, either_way(1e6)),
            check("overrun (rad/s)", b.overrun_rad_s, [0.0, 1e6]),
            check("torque at the start (Nm)", b.torque_nm, [0.0, MOST_NM]),
            check("angle (rad)", b.angle_rad, either_way(1e12)),
            check("abutment stiffness (Nm/rad)", b.abutment_nm_per_rad, [0.0, 1e15]),
            check("tolerance", settings.tolerance, TOLERANCES),
            check("longest step (s)", longest_s, STEPS_S),
        ];
        checks.into_iter().collect::<Result<Vec<()>, _>>().map_err(NoElement::Malformed)?;
        let scene = Scenario {
            name: String::new(),
            kind: ScenarioKind::Transient {
                preload_nm: b.torque_nm,
                torque_step_nm: 0.0,
                step_time_s: 0.0,
                abutment_stiffness_nm_per_rad: b.abutment_nm_per_rad,
                duration_s: 1.0,
                speed_rad_s: b.speed_rad_s,
                overrun_rad_s: b.overrun_rad_s,
            },
            start: b.start,
            clutch: clutch.clone(),
            torque_history: None,
            speed_history: None,
            drivetrain: Vec::new(),
            overrides: Vec::new(),
        };
        let prepared = prepare(&scene).map_err(NoElement::NoStart)?;
        let torque_nm = if b.overrun_rad_s > 0.0 { 0.0 } else { b.torque_nm };
        let outer_nm = if b.abutment_nm_per_rad > 0.0 { 0.0 } else { torque_nm };
        let mut model = prepared.model;
        model.drive = Drive::default();
        let at = Saved {
            t_s: b.t_s,
            elapsed_s: 0.0,
            turned_rad: [b.angle_rad; 2],
            torques_nm: [-torque_nm, outer_nm],
            held_rad_s2: [None; 2],
            slips: [[0.0; 3]; 2],
            ended: None,
            memory: Memory::new(prepared.state, prepared.mode),
        };
        let mut element = Self { model, settings: *settings, at };
        element.under(at.torques_nm, [None; 2]);
        if element.motion().is_finite() {
            Ok(element)
        } else {
            let what = "the clutch: found forces at the start that are no numbers".to_owned();
            Err(NoElement::Malformed(Malformed { what }))
        }
    }

    /// Torques of inner and outer flange from now on, N m, which change accelerations and forces at once. An advance names
    /// its own.
    ///
    /// # Errors
    /// [`Malformed`]: a torque that is no number, or beyond any machine's.
    pub fn apply(&mut self, torques_nm: [f64; 2]) -> Result<(), Malformed> {
        [0, 1].into_iter().try_for_each(|race| check_torque(race, torques_nm[race]))?;
        self.under(torques_nm, [None; 2]);
        Ok(())
    }

    /// From now on a race is moved at what is `held`, else under its torque.
    fn under(&mut self, torques_nm: [f64; 2], held: [Option<f64>; 2]) {
        (self.at.torques_nm, self.at.held_rad_s2) = (torques_nm, held);
        let given = |race: usize| match held[race] {
            Some(acceleration) => FlangeDrive::Acceleration(acceleration),
            None => FlangeDrive::Torque(Ramp { start_nm: torques_nm[race], rate_nm_per_s: 0.0 }),
        };
        self.model.drive.flanges = Some([given(0), given(1)]);
    }

    /// `port` over the next `dt_s` (s), as the equations of motion have it.
    fn given(&self, race: usize, port: Port, dt_s: f64) -> Result<FlangeDrive, Malformed> {
        let acceleration = match port {
            Port::Torque(t) => {
                check_torque(race, t.start_nm).and_then(|()| check_torque(race, t.end_nm))?;
                return Ok(FlangeDrive::Torque(Ramp {
                    start_nm: t.start_nm,
                    rate_nm_per_s: (t.end_nm - t.start_nm) / dt_s,
                }));
            }
            Port::Speed(end_rad_s) => {
                check_speed(race, end_rad_s)?;
                let now_rad_s = self.model.curve.speed_rad_s() + self.at.memory.state()[6 + race];
                (end_rad_s - now_rad_s) / dt_s
            }
            Port::Acceleration(acceleration) => acceleration,
        };
        check_acceleration(race, acceleration)?;
        Ok(FlangeDrive::Acceleration(acceleration))
    }

    /// Move on by `dt_s` (s) under what inner and outer flange do: [`Torque`]s, or a [`Port`] each. The run says what happened
    /// on the way, its time counted from here; where it has not [finished](Stop::Finished) the element stands where that ended.
    ///
    /// # Errors
    /// [`Malformed`]: a step that is not above 0, a torque, speed or acceleration that is no number or beyond any machine's, an
    /// element that has come to its end.
    pub fn advance(&mut self, dt_s: f64, flanges: [impl Into<Port>; 2]) -> Result<Run, Malformed> {
        check("step (s)", dt_s, STEPS_S)?;
        let ports: [Port; 2] = flanges.map(Into::into);
        let given = [self.given(0, ports[0], dt_s)?, self.given(1, ports[1], dt_s)?];
        if let Some(stop) = self.at.ended {
            let what = format!("the element has come to its end ({}): restore it or begin anew", stop.name());
            return Err(Malformed { what });
        }
        self.model.drive.flanges = Some(given);
        let before = self.at;
        let (mut run, memory) = go_on(&self.model, &self.at.memory, &self.run_settings(dt_s));
        let finished = run.stop == Stop::Finished;
        let reached_s = if finished { dt_s } else { run.t_s };
        let at = &mut self.at;
        at.t_s += reached_s;
        at.elapsed_s += reached_s;
        for (sum, slip) in at.slips.iter_mut().zip([run.inner, run.outer]) {
            for (sum, more) in sum.iter_mut().zip([slip.time_s, slip.distance_m, slip.net_m]) {
                *sum += more;
            }
        }
        at.ended = matches!(run.stop, Stop::CurveEnd | Stop::FellAway | Stop::NotFinite).then_some(run.stop);
        at.memory = memory;
        let [inner, outer] = [memory.state()[2], memory.state()[3]];
        if inner.abs().max(outer.abs()) > FULL_TURN_RAD {
            // An abutment knows where the outer race is.
            let outer = if self.model.loads.abutment_nm_per_rad > 0.0 { 0.0 } else { outer };
            at.memory = memory.turned_back(inner, outer);
            at.turned_rad = [at.turned_rad[0] + inner, at.turned_rad[1] + outer];
        }
        let reached = |port: Port| match port {
            Port::Torque(t) => t.start_nm + (t.end_nm - t.start_nm) * (reached_s / dt_s),
            Port::Speed(_) | Port::Acceleration(_) => 0.0,
        };
        let held = given.map(|given| match given {
            FlangeDrive::Acceleration(acceleration) => Some(acceleration),
            FlangeDrive::Torque(_) => None,
        });
        self.under(ports.map(reached), held);
        if !self.motion().is_finite() {
            // Nobody can go on from there: it ends where it stood.
            run.stop = Stop::NotFinite;
            self.at = Saved { ended: Some(run.stop), ..before };
            self.under(before.torques_nm, before.held_rad_s2);
        }
        Ok(run)
    }

    fn run_settings(&self, dt_s: f64) -> RunSettings {
        RunSettings {
            tolerance: self.settings.tolerance,
            duration_s: dt_s,
            longest_step_s: self.settings.longest_step_s.map_or(dt_s, |longest_s| longest_s.min(dt_s)),
            most_events: self.settings.most_steps / 2,
            most_steps: self.settings.most_steps,
            energy: self.settings.energy,
            ..RunSettings::default()
        }
    }

    /// This motion, gone on with by another clutch: where a number of the design changes on the way. Angles and speeds stay,
    /// forces follow the new curve.
    ///
    /// # Errors
    /// As [`Element::new`], where the other is no clutch.
    pub fn exchanged(&self, clutch: &Clutch) -> Result<Self, NoElement> {
        let beginning = Beginning {
            speed_rad_s: self.model.curve.speed_rad_s(),
            abutment_nm_per_rad: self.model.loads.abutment_nm_per_rad,
            ..Beginning::default()
        };
        self.moved_to(Self::new(clutch, &beginning, &self.settings)?)
    }

    /// As [`Self::exchanged`], by another clutch that is made already, for the same speed and abutment; where that one stands does not
    /// matter.
    ///
    /// # Errors
    /// [`NoElement::Malformed`] where its forces in this motion are no numbers.
    pub fn moved_to(&self, mut other: Self) -> Result<Self, NoElement> {
        other.at = Saved { memory: self.at.memory.moved_to(&other.model), ..self.at };
        other.under(self.at.torques_nm, self.at.held_rad_s2);
        if other.motion().is_finite() {
            Ok(other)
        } else {
            let what = "the other clutch: found forces in this motion that are no numbers".to_owned();
            Err(NoElement::Malformed(Malformed { what }))
        }
    }

    /// Where it stands.
    pub fn save(&self) -> Saved {
        self.at
    }

    /// Stand where `saved` says.
    ///
    /// # Errors
    /// [`Malformed`] where that cannot have been saved from an element of this clutch.
    pub fn restore(&mut self, saved: &Saved) -> Result<(), Malformed> {
        let numbers =
            [saved.t_s, saved.elapsed_s].into_iter().chain(saved.turned_rad).chain(saved.torques_nm);
        let held = saved.held_rad_s2;
        let mut numbers = numbers.chain(saved.slips.into_iter().flatten());
        let refused = || {
            let what = "the state to be restored: found one that no element of this clutch has".to_owned();
            Malformed { what }
        };
        let torques = [0, 1].into_iter().all(|race| check_torque(race, saved.torques_nm[race]).is_ok());
        let moved =
            [0, 1].into_iter().all(|race| held[race].is_none_or(|a| check_acceleration(race, a).is_ok()));
        if !saved.memory.fits(&self.model) || !torques || !moved || !numbers.all(f64::is_finite) {
            return Err(refused());
        }
        let before = std::mem::replace(&mut self.at, *saved);
        self.under(saved.torques_nm, held);
        if !self.motion().is_finite() {
            self.at = before;
            self.under(before.torques_nm, before.held_rad_s2);
            return Err(refused());
        }
        Ok(())
    }

    /// Time, s.
    pub fn t_s(&self) -> f64 {
        self.at.t_s
    }

    /// Why it has come to its end, if it has: no advance leads on from there.
    pub fn ended(&self) -> Option<Stop> {
        self.at.ended
    }

    /// Slip at A and B since the beginning.
    pub fn slips(&self) -> [SlipRecord; 2] {
        self.at.slips.map(|[time_s, distance_m, net_m]| SlipRecord { time_s, distance_m, net_m })
    }

    /// The clutch in its equations of motion: angles counted from [`Element::save`]'s own, rates from the speed at the
    /// beginning.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// State and mode in those.
    pub fn memory(&self) -> &Memory {
        &self.at.memory
    }
}
