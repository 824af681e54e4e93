//! What acts on the races from outside.

use super::model::{Forces, Model, N_STATE};
use super::run::Run;
use super::train::Train;
use crate::numeric::course::Course;
use crate::wedge::WedgePoint;

/// Torques from outside.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Loads {
    /// Constant torque C_bi on the inner race, N m.
    pub inner_nm: f64,
    /// Amplitude of C_be = amplitude sin(omega t) on the outer race, N m.
    pub amplitude_nm: f64,
    /// Angular frequency omega, rad/s.
    pub omega_rad_s: f64,
    /// Abutment stiffness k_ab on the outer race, N m/rad.
    pub abutment_nm_per_rad: f64,
}

/// A torque that is straight over time.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Ramp {
    /// At t = 0, N m.
    pub start_nm: f64,
    /// N m/s.
    pub rate_nm_per_s: f64,
}

/// What a flange does to its race.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FlangeDrive {
    /// It passes on this torque.
    Torque(Ramp),
    /// It moves the race at this acceleration, rad/s^2, whatever torque that takes ([`Model::flange_torques_nm`]).
    Acceleration(f64),
}

/// What acts over time beside [`Loads`]; nothing by default.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Drive {
    /// Engaging torque on the inner race, added as C_bi = -torque, N m.
    pub torque_nm: Option<Course>,
    /// Mean speed Omega(t), rad/s, in place of the curve's; angles are measured from its integral.
    pub speed_rad_s: Option<Course>,
    /// What the flanges do to the inner and to the outer race; torques are added to C_bi and C_be.
    pub flanges: Option<[FlangeDrive; 2]>,
    /// What turns on either side of the clutch. Only a run that begins by [`super::run()`] moves it.
    pub train: Option<Train>,
}

impl Drive {
    fn courses(&self) -> impl Iterator<Item = &Course> {
        let of_train = self.train.iter().flat_map(Train::courses);
        self.torque_nm.iter().chain(&self.speed_rad_s).chain(of_train)
    }

    /// First time after `t` (s) at which a course has a knot: no step may cross it.
    pub fn next_break_s(&self, t: f64) -> f64 {
        self.courses().filter_map(|c| c.next_knot(t)).fold(f64::INFINITY, f64::min)
    }

    /// Until when nothing that acts changes from `t` (s) on, beyond a knot, s; `None`: it changes there.
    fn still_until_s(&self, t: f64) -> Option<f64> {
        let ramp =
            |given: &FlangeDrive| matches!(given, FlangeDrive::Torque(ramp) if ramp.rate_nm_per_s != 0.0);
        let still = self.courses().all(|c| c.at(t).1 == 0.0)
            && !self.flanges.iter().flatten().any(ramp)
            && self.train.as_ref().is_none_or(Train::acts_alike);
        still.then(|| self.next_break_s(t))
    }

    /// `t`, or the first time beyond a knot that a step ended at.
    pub fn past_break_s(&self, t: f64) -> f64 {
        self.courses().fold(t, |t, c| c.past_knot(t))
    }

    /// The same with time counted from `t` (s).
    pub fn from(&self, t: f64) -> Self {
        let later = |c: &Option<Course>| c.as_ref().map(|c| c.from(t));
        let flanges = self.flanges.map(|both| both.map(|given| given.from(t)));
        let train = self.train.as_ref().map(|train| train.from(t));
        Self { torque_nm: later(&self.torque_nm), speed_rad_s: later(&self.speed_rad_s), flanges, train }
    }

    /// The same with the drivetrain as `run` had it when the clutch engaged.
    pub fn after(mut self, run: &Run) -> Self {
        if let Some((train, before)) = self.train.as_mut().zip(run.train.as_ref()) {
            train.begin_at(before);
        }
        self
    }

    /// Engaging torque at `t`, N m.
    pub fn torque_at(&self, t: f64) -> f64 {
        self.torque_nm.as_ref().map_or(0.0, |c| c.at(t).0)
    }
}

impl FlangeDrive {
    fn from(self, t: f64) -> Self {
        match self {
            Self::Torque(ramp) => Self::Torque(Ramp { start_nm: ramp.at(t), ..ramp }),
            given @ Self::Acceleration(_) => given,
        }
    }

    /// Torque at `t` (s), N m, where that is given.
    #[inline(always)]
    fn torque_at(&self, t: f64) -> f64 {
        match self {
            Self::Torque(ramp) => ramp.at(t),
            Self::Acceleration(_) => 0.0,
        }
    }
}

impl Ramp {
    /// At `t` (s), N m.
    #[inline]
    pub fn at(&self, t: f64) -> f64 {
        self.start_nm + self.rate_nm_per_s * t
    }
}

impl Model {
    /// C_bi and C_be at `t` (s), N m.
    #[inline(always)]
    pub fn torques_nm(&self, t: f64) -> [f64; 2] {
        let inner = self.loads.inner_nm - self.drive.torque_at(t);
        let outer = self.loads.amplitude_nm * (self.loads.omega_rad_s * t).sin();
        match &self.drive.flanges {
            Some([more_inner, more_outer]) => {
                [inner + more_inner.torque_at(t), outer + more_outer.torque_at(t)]
            }
            None => [inner, outer],
        }
    }

    /// Until when nothing that acts changes from `t` (s) on, beyond a knot, s; `None`: it changes there.
    pub fn still_until_s(&self, t: f64) -> Option<f64> {
        self.drive.still_until_s(t).filter(|_| self.loads.amplitude_nm == 0.0)
    }

    /// Acceleration at which the inner and the outer race are moved whatever torque that takes, rad/s^2.
    #[inline(always)]
    pub(super) fn held_rad_s2(&self) -> [Option<f64>; 2] {
        let held = |given: &FlangeDrive| match given {
            FlangeDrive::Acceleration(a) => Some(*a),
            FlangeDrive::Torque(_) => None,
        };
        self.drive.flanges.as_ref().map_or([None; 2], |both| [held(&both[0]), held(&both[1])])
    }

    /// Torques of the inner and the outer flange at `t` (s), N m: those given, and where a race is moved at a given
    /// acceleration what (15) leaves for the flange, with the contact forces `f` in the state `y` whose rates are `rates`.
    pub fn flange_torques_nm<const N: usize>(
        &self,
        t: f64,
        y: &[f64; N],
        p: &WedgePoint,
        rates: &[f64; 4],
        f: &Forces,
    ) -> [f64; 2] {
        let given = self.drive.flanges.as_ref().map_or([0.0; 2], |both| [0, 1].map(|i| both[i].torque_at(t)));
        let drag = self.damping_nm_s_per_rad * (rates[2] - rates[3]);
        let spin = self.mean_speed(t).1;
        let [inner, outer] = self.torques_on_nm(t, y);
        let held = self.held_rad_s2();
        let all_inner =
            self.inner_inertia_kg_m2 * (f.acceleration[2] + spin) - self.count * f.t_bi * p.oa + drag;
        let all_outer = self.outer_inertia_kg_m2 * (f.acceleration[3] + spin) + self.count * f.t_be * p.ob
            - drag
            + self.loads.abutment_nm_per_rad * y[3];
        [held[0].map_or(given[0], |_| all_inner - inner), held[1].map_or(given[1], |_| all_outer - outer)]
    }

    /// The same with what the drivetrain brings, where `y` holds its state too.
    #[inline(always)]
    pub(super) fn torques_on_nm<const N: usize>(&self, t: f64, y: &[f64; N]) -> [f64; 2] {
        let [inner, outer] = self.torques_nm(t);
        match &self.drive.train {
            Some(train) if N > N_STATE => {
                let [more_inner, more_outer] = train.on_races_nm(t, y, self.mean_speed(t).0);
                [inner + more_inner, outer + more_outer]
            }
            _ => [inner, outer],
        }
    }
}
