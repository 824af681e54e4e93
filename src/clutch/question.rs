//! What is asked of a clutch: scenarios.
//!
//! In: nothing. Out: [`Scenario`], SI. Absent: how one is answered. Equations: none.

use super::{Clutch, DriveInertia};

/// What happens to the clutch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ScenarioKind {
    /// Torque held at rest.
    Static {
        /// Torque, N m.
        torque_nm: f64,
    },
    /// Preload on the inner race (C_bi = -preload), C_be = amplitude sin(2 pi f t) on the outer, outer race tied to an abutment.
    TorsionalExcitation {
        /// Preload C_e1, N m.
        preload_nm: f64,
        /// Amplitude, N m.
        amplitude_nm: f64,
        /// Frequency, Hz.
        frequency_hz: f64,
        /// Abutment stiffness k_ab, N m/rad.
        abutment_stiffness_nm_per_rad: f64,
        /// Duration, s.
        duration_s: f64,
        /// Mean speed Omega of the whole clutch, rad/s.
        speed_rad_s: f64,
    },
    /// Free run of the inner race, then reversal onto an elastic stop (the paper's section 3).
    Engagement {
        /// Initial overrunning speed of the inner race, rad/s.
        free_run_rad_s: f64,
        /// Torque that reverses the inner race, N m, magnitude.
        reversing_torque_nm: f64,
        /// Stiffness of the stop that holds the outer race, N m/rad.
        stop_stiffness_nm_per_rad: f64,
        /// Inertia of the bench on the inner race (I_1 of Table 1), kg m^2.
        bench_inertia_kg_m2: f64,
        /// Duration, s.
        duration_s: f64,
    },
    /// A torque on the inner race over time, engaging positive, the outer race tied to what turns at the mean speed.
    Transient {
        /// Torque at the start, N m; 0 where a history gives it.
        preload_nm: f64,
        /// Jump of the torque, N m; 0: none.
        torque_step_nm: f64,
        /// When it jumps, s.
        step_time_s: f64,
        /// Stiffness that ties the outer race to the mean speed, N m/rad.
        abutment_stiffness_nm_per_rad: f64,
        /// Duration, s.
        duration_s: f64,
        /// Mean speed, rad/s; that of a speed history at its start.
        speed_rad_s: f64,
        /// Inner race faster than outer at the start, rad/s; 0: at rest against it.
        overrun_rad_s: f64,
    },
    /// Steady overrun.
    Overrun {
        /// Speed of the outer race, rad/s.
        speed_rad_s: f64,
        /// Inner race faster than outer by this, rad/s, positive.
        overrun_rad_s: f64,
    },
}

/// The equilibrium that a scene under load starts from.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Start {
    /// With the energizing spring, which presses the sprags further in than the torque alone.
    #[default]
    Settled,
    /// Of the torque alone, as in the paper: the spring begins to act when the scene does.
    WithoutSpring,
}

/// One named scenario with the clutch it acts on (per-scenario overrides applied).
#[derive(Debug, Clone, PartialEq)]
pub struct Scenario {
    /// Name, unique in the design.
    pub name: String,
    /// Kind and its data.
    pub kind: ScenarioKind,
    /// Where it starts; means nothing to what starts in overrun.
    pub start: Start,
    /// The clutch with this scenario's overrides.
    pub clutch: Clutch,
    /// Dotted names of the tables that the scenario overrides, for the reports.
    pub overrides: Vec<String>,
    /// Torque on the inner race over time, (s, N m), engaging positive; two points at one time are a jump.
    pub torque_history: Option<Vec<[f64; 2]>>,
    /// Mean speed over time, (s, rad/s).
    pub speed_history: Option<Vec<[f64; 2]>>,
    /// What turns on either side, each after what it is joined to; none: the races alone.
    pub drivetrain: Vec<DriveInertia>,
}
