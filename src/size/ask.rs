//! What is asked of a new clutch.

use std::f64::consts::PI;
use std::fmt;

/// What a new clutch shall do, SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ask {
    /// Bore of the inner race, diameter, m.
    pub bore_m: f64,
    /// Torque that it carries day by day, N m: the nominal torque.
    pub torque_nm: f64,
    /// Speed of the outer race up to which the sprags keep contact in overrun, rad/s; 0: none asked.
    pub speed_rad_s: f64,
    /// Peak torque over nominal torque.
    pub safety: f64,
    /// Static friction mu_s.
    pub friction: f64,
}

/// A number out of range.
#[derive(Debug, Clone, PartialEq)]
pub struct BadAsk {
    /// Which.
    pub what: &'static str,
    /// What was found, with its unit.
    pub found: String,
    /// What is allowed, with its unit.
    pub allowed: String,
}

impl fmt::Display for BadAsk {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: found {}; allowed: {}", self.what, self.found, self.allowed)
    }
}

impl std::error::Error for BadAsk {}

impl Ask {
    /// Refuse what no clutch of this kind is asked for.
    ///
    /// # Errors
    /// The first [`BadAsk`].
    pub fn check(&self) -> Result<(), BadAsk> {
        let mm = 1e3;
        let rpm = 30.0 / PI;
        for (what, value, per_si, unit, least, most) in [
            ("bore", self.bore_m, mm, "mm", 1.0, 2000.0),
            ("torque", self.torque_nm, 1.0, "Nm", 1e-3, 1e7),
            ("speed", self.speed_rad_s, rpm, "rpm", 0.0, 60_000.0),
            ("safety", self.safety, 1.0, "", 1.0, 10.0),
            ("friction", self.friction, 1.0, "", 0.03, 0.5),
        ] {
            let shown = value * per_si;
            // NaN is in no range; rounding of the units is.
            if !(shown >= least * (1.0 - 1e-9) && shown <= most * (1.0 + 1e-9)) {
                let space = if unit.is_empty() { "" } else { " " };
                return Err(BadAsk {
                    what,
                    found: format!("{shown}{space}{unit}"),
                    allowed: format!("{least} to {most}{space}{unit}"),
                });
            }
        }
        Ok(())
    }
}
