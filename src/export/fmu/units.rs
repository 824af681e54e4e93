//! Units in FMI's words.

use std::f64::consts::TAU;

/// A unit: value in SI = factor * value + offset, with exponents of the SI base units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FmiUnit {
    /// Name, as Modelica has it.
    pub name: &'static str,
    /// Factor.
    pub factor: f64,
    /// Offset.
    pub offset: f64,
    /// Exponents of kg, m, s, K, rad.
    pub exponents: [i8; 5],
}

const fn of(name: &'static str, factor: f64, exponents: [i8; 5]) -> FmiUnit {
    FmiUnit { name, factor, offset: 0.0, exponents }
}

/// As design files have it, and as FMI has it.
pub const UNITS: [(&str, FmiUnit); 23] = [
    ("GPa", of("GPa", 1e9, [1, -1, -2, 0, 0])),
    ("Hz", of("Hz", 1.0, [0, 0, -1, 0, 0])),
    ("N", of("N", 1.0, [1, 1, -2, 0, 0])),
    ("N/µm", of("N/um", 1e6, [1, 0, -2, 0, 0])),
    ("Nm", of("N.m", 1.0, [1, 2, -2, 0, 0])),
    ("Nm s/rad", of("N.m.s/rad", 1.0, [1, 2, -1, 0, -1])),
    ("Nm/rad", of("N.m/rad", 1.0, [1, 2, -2, 0, -1])),
    ("deg", of("deg", TAU / 360.0, [0, 0, 0, 0, 1])),
    ("kg", of("kg", 1.0, [1, 0, 0, 0, 0])),
    ("kg m^2", of("kg.m2", 1.0, [1, 2, 0, 0, 0])),
    ("kg/m^3", of("kg/m3", 1.0, [1, -3, 0, 0, 0])),
    ("m", of("m", 1.0, [0, 1, 0, 0, 0])),
    ("mm", of("mm", 1e-3, [0, 1, 0, 0, 0])),
    ("mrad", of("mrad", 1e-3, [0, 0, 0, 0, 1])),
    ("rad", of("rad", 1.0, [0, 0, 0, 0, 1])),
    ("rad/s", of("rad/s", 1.0, [0, 0, -1, 0, 1])),
    ("rad/s2", of("rad/s2", 1.0, [0, 0, -2, 0, 1])),
    ("rpm", of("rev/min", TAU / 60.0, [0, 0, -1, 0, 1])),
    ("s", of("s", 1.0, [0, 0, 1, 0, 0])),
    ("s/m", of("s/m", 1.0, [0, -1, 1, 0, 0])),
    ("µm", of("um", 1e-6, [0, 1, 0, 0, 0])),
    ("µm/(m K)", of("um/(m.K)", 1e-6, [0, 0, 0, -1, 0])),
    ("°C", FmiUnit { name: "degC", factor: 1.0, offset: 273.15, exponents: [0, 0, 0, 1, 0] }),
];

/// The unit in FMI's words, of the one as design files have it.
pub fn unit(name: &str) -> Option<&'static FmiUnit> {
    UNITS.iter().find(|(own, _)| *own == name).map(|(_, unit)| unit)
}
