//! What turns on either side of the clutch: inertias, each joined towards the clutch by a shaft and a pair of gears.
//!
//! In: nothing. Out: [`DriveInertia`]s, SI. Absent: how they move. Equations: none.

/// Most inertias beyond the races that a shaft lets turn by themselves.
pub const MOST_SHAFTS: usize = 8;

/// What an inertia of the drivetrain is joined to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Towards {
    /// The inner race.
    InnerRace,
    /// The outer race.
    OuterRace,
    /// The inertia of this index, which stands before it in the list.
    Inertia(usize),
}

/// The shaft between an inertia and what it is joined to, by the angle of the inertia: gears lie beyond it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shaft {
    /// Torsional stiffness, N m/rad.
    pub stiffness_nm_per_rad: f64,
    /// Torque per rate of its twist, N m s/rad.
    pub damping_nm_s_per_rad: f64,
}

/// A torque on an inertia, positive in its own positive sense.
#[derive(Debug, Clone, PartialEq)]
pub enum DriveTorque {
    /// The same at all times, N m.
    Constant(f64),
    /// Over time, (s, N m), straight between the points; two at one time are a jump.
    History(Vec<[f64; 2]>),
    /// amplitude sin(order angle + phase) with the angle of the inertia itself.
    Order {
        /// Periods for one turn of the inertia, pure number.
        order: f64,
        /// N m.
        amplitude_nm: f64,
        /// rad.
        phase_rad: f64,
    },
    /// Gas torque of a four-stroke engine whose crank the inertia is.
    Gas(GasTorque),
}

/// A four-stroke engine of evenly fired cylinders on a centred slider-crank.
///
/// The ideal cycle at constant volume with one polytropic exponent for compression and expansion (Taylor, *The Internal
/// Combustion Engine in Theory and Practice*, I, ch. 2; slider-crank: II, ch. 8). Intake and exhaust are at the pressure of
/// the crankcase and give no torque. Torque of the reciprocating masses is not in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GasTorque {
    /// Number of cylinders, at equal distances in two turns.
    pub cylinders: usize,
    /// Swept volume of one cylinder, m^3.
    pub swept_volume_m3: f64,
    /// Largest over smallest volume.
    pub compression_ratio: f64,
    /// Crank radius over length of the connecting rod, below 1.
    pub rod_ratio: f64,
    /// Pressure at the start of compression, Pa.
    pub intake_pa: f64,
    /// Polytropic exponent, above 1.
    pub exponent: f64,
    /// Mean indicated pressure, Pa; 0: turned without firing.
    pub mean_pressure_pa: f64,
    /// Turn of the crank at t = 0 from the upper dead centre at which the first cylinder fires, rad.
    pub phase_rad: f64,
}

/// An inertia of the drivetrain.
#[derive(Debug, Clone, PartialEq)]
pub struct DriveInertia {
    /// Name, unique.
    pub name: String,
    /// Inertia about its own axis, kg m^2; 0 only without a shaft.
    pub inertia_kg_m2: f64,
    /// What it is joined to.
    pub to: Towards,
    /// Turns of this inertia for one turn of what it is joined to; negative: the other way.
    pub ratio: f64,
    /// The shaft; `None`: rigid.
    pub shaft: Option<Shaft>,
    /// Torque per its own speed that brakes it, N m s/rad.
    pub drag_nm_s_per_rad: f64,
    /// What acts on it.
    pub torques: Vec<DriveTorque>,
    /// Where its speed is given over time: (s, rad/s); then it has a shaft, and its inertia means nothing.
    pub speed: Option<Vec<[f64; 2]>>,
}

impl DriveInertia {
    /// Whether a torque or its speed is given over time.
    pub fn has_history(&self) -> bool {
        self.speed.is_some() || self.torques.iter().any(|t| matches!(t, DriveTorque::History(_)))
    }

    /// Whether it turns by itself on a shaft, its speed not given.
    pub fn is_free(&self) -> bool {
        self.shaft.is_some() && self.speed.is_none()
    }
}
