//! What a clutch goes through in its life, and what its bodies bear again and again.
//!
//! In: nothing. Out: [`Service`], SI. Absent: what comes of it (`life`). Equations: none.

/// A life's loads, and strengths where they are known.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Service {
    /// Engagements by torque.
    pub loads: Vec<RepeatedLoad>,
    /// Scenarios that swing, by the hour.
    pub swings: Vec<RepeatedSwing>,
    /// Overruns that go on, by the hour.
    pub overruns: Vec<RepeatedSwing>,
    /// Torques over time.
    pub histories: Vec<RepeatedHistory>,
    /// What the contacts bear; `None`: not known, so no life until pitting.
    pub pitting: Option<PittingStrength>,
    /// What the core below the hardened case bears; `None`: not known.
    pub core: Option<CoreStrength>,
    /// What the races bear as rings; `None`: not known.
    pub rings: Option<FatigueStrength>,
    /// What the bodies of the sprags bear in their narrowest section; `None`: not known.
    pub sprags: Option<FatigueStrength>,
    /// Whether the sprags engage at the same places of the races every time (indexing by whole turns); else anywhere.
    pub same_places: bool,
    /// Coefficient of variation of the static friction coefficient: standard deviation over mean.
    pub friction_scatter: f64,
    /// The same of each torque.
    pub torque_scatter: f64,
    /// Slips by chance that may be expected in the life; `None`: nobody has said.
    pub slips_allowed: Option<f64>,
}

/// A torque that is carried again and again, from the lesser to the larger and back.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RepeatedLoad {
    /// The lesser, N m: 0, or where a swing of the torque turns.
    pub from_nm: f64,
    /// The larger, N m.
    pub torque_nm: f64,
    /// How often in the life.
    pub engagements: f64,
}

/// A scenario of the design, a torsional excitation or an overrun, that goes on for some time.
#[derive(Debug, Clone, PartialEq)]
pub struct RepeatedSwing {
    /// Name of the scenario.
    pub scenario: String,
    /// How long in the life, s.
    pub duration_s: f64,
}

/// A measured or computed torque over time that recurs.
#[derive(Debug, Clone, PartialEq)]
pub struct RepeatedHistory {
    /// File, as the design names it.
    pub name: String,
    /// Time, s, and torque, N m, engaging positive.
    pub rows: Vec<[f64; 2]>,
    /// How often in the life.
    pub times: f64,
}

/// One point of the life of a contact, and its slope: cycles = `cycles` (pressure/`pressure_pa`)^-`exponent`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PittingStrength {
    /// Largest Hertz pressure that is borne `cycles` times, Pa.
    pub pressure_pa: f64,
    /// Load cycles at that pressure.
    pub cycles: f64,
    /// Exponent of the pressure.
    pub exponent: f64,
}

/// One point of the life of the core below a hardened case, and its slope: cycles = `cycles` (shear/`shear_pa`)^-`exponent`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CoreStrength {
    /// Largest shear that is borne `cycles` times, Pa.
    pub shear_pa: f64,
    /// Depth of the case, m: the shear there counts, or that of a greater depth where it is larger.
    pub depth_m: f64,
    /// Load cycles at that shear.
    pub cycles: f64,
    /// Exponent of the shear.
    pub exponent: f64,
}

/// One point of the life of a body under a stress about zero, its slope, and its strength once: cycles = `cycles`
/// (amplitude/`amplitude_pa`)^-`exponent`, tensile mean stress after Goodman.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FatigueStrength {
    /// Amplitude about zero that is borne `cycles` times, Pa.
    pub amplitude_pa: f64,
    /// Cycles at that amplitude.
    pub cycles: f64,
    /// Exponent of the amplitude.
    pub exponent: f64,
    /// Tensile strength, Pa.
    pub ultimate_pa: f64,
}
