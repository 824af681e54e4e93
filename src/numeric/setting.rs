//! Numbers that are set, and the ranges in which they make sense.

use std::fmt;

/// A setting outside the range in which it makes sense.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BadSetting {
    /// What was set, with its unit.
    pub name: &'static str,
    /// Value given.
    pub value: f64,
    /// Least value allowed.
    pub least: f64,
    /// Greatest value allowed.
    pub most: f64,
}

impl fmt::Display for BadSetting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, value, least, most } = self;
        write!(f, "{name}: found {value}, ")?;
        match *least {
            // Zero without a power of ten.
            0.0 => write!(f, "0 to {most:e} is allowed"),
            least if least == -most => write!(f, "at most {most:e} either way is allowed"),
            least => write!(f, "{least:e} to {most:e} is allowed"),
        }
    }
}

impl std::error::Error for BadSetting {}

/// Refuse a `value` outside `least` to `most`, ends included; NaN lies outside.
///
/// # Errors
/// [`BadSetting`].
pub fn in_range(name: &'static str, value: f64, [least, most]: [f64; 2]) -> Result<(), BadSetting> {
    match (least..=most).contains(&value) {
        true => Ok(()),
        false => Err(BadSetting { name, value, least, most }),
    }
}

/// The same of each of `values`.
///
/// # Errors
/// [`BadSetting`], the first.
pub fn all_in_range(name: &'static str, values: &[f64], range: [f64; 2]) -> Result<(), BadSetting> {
    values.iter().try_for_each(|&value| in_range(name, value, range))
}
