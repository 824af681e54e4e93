//! Units of the reports and how a number is written.

use std::f64::consts::PI;

/// What stands where a number is missing or not finite.
pub const MISSING: &str = "–";

named! {
    /// Unit in which a quantity is shown. Values inside the library are SI; only here they change.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Unit {
        /// Pure number.
        One = "",
        /// Percent of a pure number.
        Percent = "%",
        /// Millimetre, from m.
        Millimetre = "mm",
        /// Micrometre, from m.
        Micrometre = "µm",
        /// Degree, from rad.
        Degree = "deg",
        /// Milliradian, from rad.
        Milliradian = "mrad",
        /// Radian.
        Radian = "rad",
        /// Radian per second.
        RadianPerSecond = "rad/s",
        /// Newton.
        Newton = "N",
        /// Newton metre.
        NewtonMetre = "Nm",
        /// Newton metre per radian.
        NewtonMetrePerRadian = "Nm/rad",
        /// Megapascal, from Pa.
        Megapascal = "MPa",
        /// Gigapascal, from Pa.
        Gigapascal = "GPa",
        /// Second.
        Second = "s",
        /// Millisecond, from s.
        Millisecond = "ms",
        /// Hertz.
        Hertz = "Hz",
        /// Rate of growth or decay, 1/s.
        PerSecond = "1/s",
        /// Revolutions per minute, from rad/s.
        Rpm = "rpm",
        /// Metre per second.
        MetrePerSecond = "m/s",
        /// Gram, from kg.
        Gram = "g",
        /// Kilogram square metre.
        KilogramSquareMetre = "kg m²",
        /// Watt.
        Watt = "W",
        /// Joule.
        Joule = "J",
        /// Watt per square millimetre, from W/m^2.
        WattPerSquareMillimetre = "W/mm²",
        /// Kelvin, of a rise.
        Kelvin = "K",
    }
    /// Symbol as printed in a heading; empty for a pure number.
    pub fn symbol;
}

impl Unit {
    /// The SI value in this unit.
    pub fn from_si(self, si: f64) -> f64 {
        match self {
            Self::Percent => si * 100.0,
            Self::Millimetre | Self::Milliradian | Self::Millisecond | Self::Gram => si * 1e3,
            Self::Micrometre => si * 1e6,
            // Divided, not multiplied by 1e-6: 4.2e9 Pa must come out as 4200, not 4199.999….
            Self::Megapascal | Self::WattPerSquareMillimetre => si / 1e6,
            Self::Gigapascal => si / 1e9,
            Self::Degree => si * 180.0 / PI,
            Self::Rpm => si * 30.0 / PI,
            Self::One
            | Self::Radian
            | Self::RadianPerSecond
            | Self::Newton
            | Self::NewtonMetre
            | Self::NewtonMetrePerRadian
            | Self::Second
            | Self::Hertz
            | Self::PerSecond
            | Self::MetrePerSecond
            | Self::KilogramSquareMetre
            | Self::Watt
            | Self::Joule
            | Self::Kelvin => si,
        }
    }

    /// The SI value with `digits` significant digits and the symbol, e.g. `"4.68 mm"`.
    pub fn show(self, si: f64, digits: usize) -> String {
        let value = significant(self.from_si(si), digits);
        if self == Self::One || value == MISSING { value } else { format!("{value} {}", self.symbol()) }
    }

    /// As [`Unit::show`] with [`plain`] digits, e.g. `"7.21 mm"`.
    pub fn show_plain(self, si: f64, digits: usize) -> String {
        let value = plain(self.from_si(si), digits);
        if self == Self::One || value == MISSING { value } else { format!("{value} {}", self.symbol()) }
    }

    /// A heading with its unit, e.g. `"Torque, Nm"`; a pure number has none.
    pub fn heading(self, name: &str) -> String {
        if self == Self::One { name.to_owned() } else { format!("{name}, {}", self.symbol()) }
    }
}

/// `value` with `digits` significant digits (at least 1): plain between 1e-4 and 1e7, otherwise with a
/// power of ten (`1.18e-8`). Trailing zeros are kept, they say how far the number is known. Not finite: [`MISSING`].
pub fn significant(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return MISSING.to_owned();
    }
    if value == 0.0 {
        return "0".to_owned();
    }
    let digits = digits.clamp(1, 17);
    // The exponent after rounding: 9.996 to three digits is 10.0, not 10.00.
    let scientific = format!("{value:.*e}", digits - 1);
    let exponent: i32 = scientific.split_once('e').and_then(|(_, e)| e.parse().ok()).unwrap_or(0);
    if !(-4..7).contains(&exponent) {
        return scientific.replace('-', "\u{2212}").replacen("e\u{2212}", "e-", 1);
    }
    let decimals = usize::try_from(digits as i32 - 1 - exponent).unwrap_or(0);
    format!("{value:.decimals$}").replace('-', "\u{2212}")
}

/// As [`significant`], without the zeros after the last digit that says something: for dimensions taken
/// from a design file, `7.21` rather than `7.2100`.
pub fn plain(value: f64, digits: usize) -> String {
    let text = significant(value, digits);
    let (mantissa, power) = text.split_at(text.find('e').unwrap_or(text.len()));
    if !mantissa.contains('.') {
        return text;
    }
    format!("{}{power}", mantissa.trim_end_matches('0').trim_end_matches('.'))
}

/// The error of `value` as it stands beside it where it is shown with `digits` significant digits, both in `unit`: words
/// where it is less than half of the last digit.
pub fn error_beside(value: f64, digits: usize, error: f64, unit: &str) -> String {
    let exponent = if value == 0.0 { 0 } else { value.abs().log10().floor() as i32 };
    let last = 10.0_f64.powi(exponent + 1 - digits.max(1) as i32);
    if error.abs() < 0.5 * last {
        "computed to the digits shown".to_owned()
    } else {
        format!("\u{b1} {} {unit}", significant(error.abs(), 1)).trim_end().to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn significant_digits_survive_rounding_up_and_range_ends() {
        for (value, digits, want) in [
            (0.0, 4, "0"),
            (9.996, 3, "10.0"),
            (4402.2, 5, "4402.2"),
            (4402.2, 2, "4402"),
            (0.08537, 4, "0.08537"),
            (1.18e-8, 3, "1.18e-8"),
            (-1.18e-8, 3, "−1.18e-8"),
            (-0.725, 3, "−0.725"),
            (9_999_999.0, 3, "1.00e7"),
            (9.99996e-5, 3, "0.000100"),
            (f64::NAN, 3, MISSING),
            (f64::INFINITY, 3, MISSING),
        ] {
            assert_eq!(significant(value, digits), want, "{value} to {digits}");
        }
    }

    #[test]
    fn an_error_below_the_digits_shown_is_a_word() {
        for (value, error, want) in [
            (144.83, 1e-16, "computed to the digits shown"),
            (144.83, 4.9e-3, "computed to the digits shown"),
            (144.83, 5.1e-3, "\u{b1} 0.005"),
            (-0.246, 2e-4, "\u{b1} 0.0002"),
            (0.0, 1e-9, "computed to the digits shown"),
        ] {
            assert_eq!(error_beside(value, 5, error, ""), want, "{value}");
        }
    }

    #[test]
    fn plain_drops_only_idle_zeros() {
        for (value, want) in
            [(7.21, "7.21"), (7.0, "7"), (100.0, "100"), (1.2e-8, "1.2e-8"), (0.06, "0.06"), (0.0, "0")]
        {
            assert_eq!(plain(value, 5), want);
        }
    }

    #[test]
    fn units_are_those_of_the_design_file() {
        assert_eq!(Unit::Megapascal.show(4.2e9, 4), "4200 MPa");
        assert_eq!(Unit::Millimetre.show(4.68e-3, 3), "4.68 mm");
        assert_eq!(Unit::Degree.show(PI / 6.0, 4), "30.00 deg");
        assert_eq!(Unit::Rpm.show(100.0 * PI / 30.0, 4), "100.0 rpm");
        assert_eq!(Unit::Percent.show(-0.031, 2), "−3.1 %");
        assert_eq!(Unit::One.heading("tan ω"), "tan ω");
        assert_eq!(Unit::NewtonMetre.show(f64::NAN, 4), MISSING);
    }
}
