//! A scene whose load is beyond the end of the curve, followed: the sprags go on over their highest place, or come back.

use super::demand::{Fineness, STEPS_PER_PERIOD, run_settings};
use super::prepare::Prepared;
use super::simulate::Settings;
use crate::clutch::Clutch;
use crate::dynamics::{EnergyBalance, Place, Run, Stop, run};
use crate::wedge::RollOver;

named! {
    /// What becomes of sprags that have come to the end of the curve.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Fate {
        /// They go over their highest place to the end of the way ([`RollOver::end`]).
        RolledOver = "rolled-over",
        /// The torque falls in time: they are back on the curve when the scene ends, or off the inner race on the side from which they came.
        CameBack = "came-back",
        /// The scene ends with them on the way.
        OnTheWay = "on-the-way",
        /// The run met a limit of work, or was interrupted.
        NotKnown = "not-known",
    }
    /// Name for reports and JSON.
    pub fn name;
}

/// A scene beyond the end of the curve.
#[derive(Debug, Clone)]
pub struct Beyond {
    /// The way as equilibria have it, at the scene's mean speed.
    pub way: RollOver,
    /// What becomes of the sprags.
    pub fate: Fate,
    /// When the run ended, s.
    pub t_s: f64,
    /// Speed then of the races against one another, rad/s, positive in the sense of the windup.
    pub speed_rad_s: f64,
    /// Torque n_s T_bi OA then, N m.
    pub torque_nm: f64,
    /// By how much a run with ten times the tolerance has these, in their order; `None`: it meets another fate.
    pub error: Option<[f64; 3]>,
    /// Where the energy went.
    pub energy: Option<EnergyBalance>,
}

impl Beyond {
    /// The figures that have errors: t_s, speed_rad_s, torque_nm.
    fn figures(&self) -> [f64; 3] {
        [self.t_s, self.speed_rad_s, self.torque_nm]
    }
}

/// Run `prepared`, a scene of `clutch`, on beyond the end of its curve; `None` where there is no way on. Two runs, whose steps differ
/// tenfold in tolerance: the finer is the answer.
pub fn beyond(clutch: &Clutch, prepared: &Prepared, settings: &Settings) -> Option<Beyond> {
    let profile = clutch.profile().ok()?;
    let way = prepared.model.curve.beyond(clutch.brink(&profile).as_ref())?;
    let mut model = prepared.model.clone();
    model.curve = way.curve.clone();
    let settings = Settings { energy: true, slip_heat: false, ..settings.clone() };
    let once = |tolerance: f64| {
        let fineness = Fineness::single(tolerance);
        let of_run = run_settings(prepared, &settings, fineness, 0, STEPS_PER_PERIOD);
        let found = run(&model, prepared.state, prepared.mode, &of_run);
        let forces = model.forces(&found.mode, found.t_s, &found.state);
        let p = model.point(found.mode.place, found.state[0]);
        let rates = model.rates(&found.mode, &p, &found.state);
        Beyond {
            way: way.clone(),
            fate: fate(&found, model.curve.arc_count()),
            t_s: found.t_s,
            speed_rad_s: rates[3] - rates[2],
            torque_nm: clutch.sprags.count as f64 * forces.t_bi * p.oa,
            error: None,
            energy: found.energy,
        }
    };
    let (coarse, fine) = (once(settings.tolerance), once(0.1 * settings.tolerance));
    let (a, b) = (fine.figures(), coarse.figures());
    let error = (coarse.fate == fine.fate).then(|| std::array::from_fn(|i| (a[i] - b[i]).abs()));
    Some(Beyond { error, ..fine })
}

fn fate(run: &Run, arcs: usize) -> Fate {
    match (run.stop, run.mode.place) {
        (Stop::CurveEnd, _) => Fate::RolledOver,
        (Stop::Finished, Place::Arc(k)) if k >= arcs => Fate::OnTheWay,
        (Stop::Finished | Stop::FellAway, _) => Fate::CameBack,
        _ => Fate::NotKnown,
    }
}
