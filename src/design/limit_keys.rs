//! Every number of `[limits]`: its key, its unit, its field.
//!
//! In: nothing. Out: [`LIMIT_KEYS`]. Absent: ranges and meanings (`limits_file`), what is held against them (`margin`).
//! Equations: none.

use super::Limits;
use super::check::{m, pa, rad_s};

/// One number of `[limits]`.
#[derive(Debug, Clone, Copy)]
pub struct LimitKey {
    /// Key in the file.
    pub name: &'static str,
    /// Unit of the file, as printed; empty for a pure number.
    pub unit: &'static str,
    /// SI value of one in the file.
    si: fn(f64) -> f64,
    /// Its field, SI.
    field: fn(&mut Limits) -> &mut Option<f64>,
}

impl LimitKey {
    /// Value in the file's unit, to twelve digits: what a file said comes back without the rounding of two changes of unit.
    pub fn value(&self, limits: &Limits) -> Option<f64> {
        let si = *(self.field)(&mut limits.clone());
        si.map(|si| {
            let value = si / (self.si)(1.0);
            format!("{value:.11e}").parse().unwrap_or(value)
        })
    }

    /// `limits` with this one at `value`, in the file's unit.
    pub fn with(&self, limits: &Limits, value: f64) -> Limits {
        let mut changed = *limits;
        *(self.field)(&mut changed) = Some((self.si)(value));
        changed
    }
}

const fn key(
    name: &'static str,
    unit: &'static str,
    si: fn(f64) -> f64,
    field: fn(&mut Limits) -> &mut Option<f64>,
) -> LimitKey {
    LimitKey { name, unit, si, field }
}

/// SI already.
fn same(value: f64) -> f64 {
    value
}

/// All of them, in the order of the file format.
pub const LIMIT_KEYS: [LimitKey; 21] = [
    key("nominal_torque_nm", "Nm", same, |l| &mut l.nominal_torque_nm),
    key("peak_torque_nm", "Nm", same, |l| &mut l.peak_torque_nm),
    key("hertz_nominal_mpa", "MPa", pa, |l| &mut l.hertz_nominal_pa),
    key("hertz_peak_mpa", "MPa", pa, |l| &mut l.hertz_peak_pa),
    key("hoop_inner_mpa", "MPa", pa, |l| &mut l.hoop_inner_pa),
    key("hoop_outer_mpa", "MPa", pa, |l| &mut l.hoop_outer_pa),
    key("hoop_inner_bending_mpa", "MPa", pa, |l| &mut l.hoop_inner_bending_pa),
    key("hoop_outer_bending_mpa", "MPa", pa, |l| &mut l.hoop_outer_bending_pa),
    key("case_depth_mm", "mm", m, |l| &mut l.case_depth_m),
    key("case_shear_mpa", "MPa", pa, |l| &mut l.case_shear_pa),
    key("core_shear_mpa", "MPa", pa, |l| &mut l.core_shear_pa),
    key("body_yield_mpa", "MPa", pa, |l| &mut l.body_yield_pa),
    key("axial_load_n", "N", same, |l| &mut l.axial_load_n),
    key("gap_nominal_mm", "mm", m, |l| &mut l.gap_nominal_m),
    key("gap_peak_mm", "mm", m, |l| &mut l.gap_peak_m),
    key("windup_nominal_deg", "deg", f64::to_radians, |l| &mut l.windup_nominal_rad),
    key("equivalent_inner_mpa", "MPa", pa, |l| &mut l.equivalent_inner_pa),
    key("equivalent_outer_mpa", "MPa", pa, |l| &mut l.equivalent_outer_pa),
    key("slip_margin", "", same, |l| &mut l.slip_margin),
    key("keep_contact_to_rpm", "rpm", rad_s, |l| &mut l.keep_contact_to_rad_s),
    key("lift_off_by_rpm", "rpm", rad_s, |l| &mut l.lift_off_by_rad_s),
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::shape;

    #[test]
    fn the_list_is_the_schemas() {
        let mut listed: Vec<&str> = LIMIT_KEYS.iter().map(|k| k.name).collect();
        listed.sort_unstable();
        let known = shape::keys_of("limits");
        let mut numbers: Vec<&str> =
            known.into_iter().filter(|k| shape::kind_of(&format!("limits.{k}")).is_some()).collect();
        numbers.sort_unstable();
        assert_eq!(listed, numbers);
    }

    #[test]
    fn a_value_comes_back_as_it_was_written() {
        for key in LIMIT_KEYS {
            for value in [0.35, 8.46, 559.9, 4500.0, 1234.567] {
                let limits = key.with(&Limits::default(), value);
                assert_eq!(key.value(&limits), Some(value), "{}", key.name);
                assert!(LIMIT_KEYS.iter().filter(|k| k.value(&limits).is_some()).count() == 1);
            }
        }
    }
}
