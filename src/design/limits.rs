//! Every number of `[limits]`, once: key, range, unit, field, what it needs, words.
//!
//! In: nothing. Out: [`Limits`], SI; [`LIMIT_KEYS`]; `LimitsFile`, as written, whose schema is made of the same rows.
//! Absent: rules that join several keys (`check`), what is compared with them (`margin`). Equations: none.

use schemars::JsonSchema;
use serde::Deserialize;

use super::units::{m, pa, rad_s};

/// Another key without which a limit means nothing, and what that key is.
type Need = (&'static str, &'static str);

const AT_NOMINAL: &[Need] = &[("nominal_torque_nm", "the torque at which this limit is held")];
const AT_PEAK: &[Need] = &[("peak_torque_nm", "the torque at which this limit is held")];
const AT_PEAK_BELOW_CASE: &[Need] = &[AT_PEAK[0], ("case_depth_mm", "the depth at which the core begins")];
const AT_FILM_SPEED: &[Need] = &[("film_at_rpm", "the speed at which this limit is held")];
const ALONE: &[Need] = &[];

/// One number of `[limits]`.
#[derive(Debug, Clone, Copy)]
pub struct LimitKey {
    /// Key in the file.
    pub name: &'static str,
    /// What it is, in the file's unit; also its description in the schema.
    pub words: &'static str,
    /// Unit of the file, as printed; empty for a pure number.
    pub unit: &'static str,
    /// Keys without which it means nothing.
    needs: &'static [Need],
    /// SI value of one in the file.
    si: fn(f64) -> f64,
    /// Its field, SI.
    field: fn(&mut Limits) -> &mut Option<f64>,
    /// Its value as written.
    written: fn(&LimitsFile) -> Option<f64>,
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

    /// Keys without which it means nothing.
    pub fn needs(&self) -> impl Iterator<Item = &'static str> {
        self.needs.iter().map(|need| need.0)
    }

    /// Value that a table of the file gives, in the file's unit.
    pub(crate) fn written(&self, file: &LimitsFile) -> Option<f64> {
        (self.written)(file)
    }

    /// (this key, a key that it needs and `limits` lack, what that is), where this one is given.
    pub(crate) fn missing(&self, limits: &Limits) -> Vec<(&'static str, &'static str, &'static str)> {
        let given = |name: &str| LIMIT_KEYS.iter().any(|k| k.name == name && k.value(limits).is_some());
        let missing = |(needed, what): &Need| (!given(needed)).then_some((self.name, *needed, *what));
        if given(self.name) { self.needs.iter().filter_map(missing).collect() } else { Vec::new() }
    }
}

/// SI already.
fn same(value: f64) -> f64 {
    value
}

/// Makes of each row a key of the file with its range and description, a field in SI, and an entry of [`LIMIT_KEYS`].
macro_rules! limits {
    ($($key:ident: $bound:tt 0, $unit:tt -> $field:ident by $si:expr, $needs:expr, $words:tt;)+) => {
        /// Allowables of the margin check, SI; an absent one is not checked.
        #[derive(Debug, Clone, Copy, PartialEq, Default)]
        pub struct Limits {
            $(
                #[doc = $words]
                ///
                /// Here in SI.
                pub $field: Option<f64>,
            )+
        }

        /// Allowables of the margin check; an absent one is not checked.
        #[derive(Debug, Default, Deserialize, JsonSchema)]
        #[serde(deny_unknown_fields)]
        pub(crate) struct LimitsFile {
            /// true: Hertz pressures and mean hoop stresses that are absent here are those which the library allows the
            /// materials that [material] names, with the torques at which they are held.
            pub from_material: Option<bool>,
            $(
                #[doc = $words]
                #[schemars(extend($bound = 0))]
                pub $key: Option<f64>,
            )+
        }

        /// All of them, in the order of the file format.
        pub const LIMIT_KEYS: &[LimitKey] = &[$(
            LimitKey {
                name: stringify!($key),
                words: $words,
                unit: $unit,
                needs: $needs,
                si: $si,
                field: |limits| &mut limits.$field,
                written: |file| file.$key,
            },
        )+];
    };
}

limits! {
    nominal_torque_nm: "exclusiveMinimum" 0, "Nm" -> nominal_torque_nm by same, ALONE,
        "Torque that comes again and again, at which the limits of nominal torque are held, N m.";
    peak_torque_nm: "exclusiveMinimum" 0, "Nm" -> peak_torque_nm by same, ALONE,
        "Largest torque, which comes seldom, at which the limits of peak torque are held, N m.";
    hertz_nominal_mpa: "exclusiveMinimum" 0, "MPa" -> hertz_nominal_pa by pa, AT_NOMINAL,
        "Allowed Hertz pressure up to nominal torque, MPa.";
    hertz_peak_mpa: "exclusiveMinimum" 0, "MPa" -> hertz_peak_pa by pa, AT_PEAK,
        "Allowed Hertz pressure up to peak torque, MPa.";
    along_mpa: "exclusiveMinimum" 0, "MPa" -> along_pa by pa, AT_PEAK,
        "Allowed pressure anywhere along the contacts up to peak torque, with end profile and tilt, MPa; needs an end_profile.";
    hoop_inner_mpa: "exclusiveMinimum" 0, "MPa" -> hoop_inner_pa by pa, AT_PEAK,
        "Allowed magnitude of the inner race's mean hoop stress at peak torque, MPa.";
    hoop_outer_mpa: "exclusiveMinimum" 0, "MPa" -> hoop_outer_pa by pa, AT_PEAK,
        "Allowed mean hoop stress of the outer race at peak torque, MPa.";
    hoop_inner_bending_mpa: "exclusiveMinimum" 0, "MPa" -> hoop_inner_bending_pa by pa, AT_PEAK,
        "Allowed hoop stress of the inner race with ring bending at peak torque, magnitude, MPa.";
    hoop_outer_bending_mpa: "exclusiveMinimum" 0, "MPa" -> hoop_outer_bending_pa by pa, AT_PEAK,
        "Allowed hoop stress of the outer race with ring bending at peak torque, MPa.";
    case_depth_mm: "exclusiveMinimum" 0, "mm" -> case_depth_m by m, ALONE,
        "Depth of the hardened case of sprag and races, mm.";
    case_shear_mpa: "exclusiveMinimum" 0, "MPa" -> case_shear_pa by pa, AT_PEAK,
        "Allowed largest shear below a contact up to peak torque, MPa.";
    core_shear_mpa: "exclusiveMinimum" 0, "MPa" -> core_shear_pa by pa, AT_PEAK_BELOW_CASE,
        "Allowed shear below a contact at case_depth_mm and deeper up to peak torque, MPa.";
    body_yield_mpa: "exclusiveMinimum" 0, "MPa" -> body_yield_pa by pa, AT_PEAK,
        "Allowed compression of the sprag's body, half way between its contacts, at peak torque, MPa; needs flanks or\na width_mm.";
    axial_load_n: "minimum" 0, "N" -> axial_load_n by same, AT_PEAK,
        "Axial load from race to race through all sprags while they are engaged, N; lowers the friction reserve.";
    gap_nominal_mm: "exclusiveMinimum" 0, "mm" -> gap_nominal_m by m, AT_NOMINAL,
        "Allowed race gap at nominal torque, mm: outer minus inner track radius at rest and the growth of both races.";
    gap_peak_mm: "exclusiveMinimum" 0, "mm" -> gap_peak_m by m, AT_PEAK,
        "Allowed race gap at peak torque, mm.";
    windup_nominal_deg: "exclusiveMinimum" 0, "deg" -> windup_nominal_rad by f64::to_radians, AT_NOMINAL,
        "Allowed windup at nominal torque, deg.";
    equivalent_inner_mpa: "exclusiveMinimum" 0, "MPa" -> equivalent_inner_pa by pa, AT_NOMINAL,
        "Allowed equivalent stress (von Mises) of the inner race under the mean track pressure at nominal torque, MPa.";
    equivalent_outer_mpa: "exclusiveMinimum" 0, "MPa" -> equivalent_outer_pa by pa, AT_NOMINAL,
        "Allowed equivalent stress (von Mises) of the outer race under the mean track pressure at nominal torque, MPa.";
    at_speed_rpm: "exclusiveMinimum" 0, "rpm" -> at_speed_rad_s by rad_s, ALONE,
        "Speed of the clutch at which the limits at nominal and peak torque are held beside rest, rev/min: the races grow, sprags press\noutward, rotation adds to the hoop stress of the outer race.";
    slip_margin: "minimum" 0, "" -> slip_margin by same, ALONE,
        "Smallest slip margin wanted, static friction over required friction minus 1.";
    keep_contact_to_rpm: "exclusiveMinimum" 0, "rpm" -> keep_contact_to_rad_s by rad_s, ALONE,
        "Speed of the outer race, in a driven cage of the inner one, up to which the sprags must not lift off in overrun, rev/min.";
    lift_off_by_rpm: "exclusiveMinimum" 0, "rpm" -> lift_off_by_rad_s by rad_s, ALONE,
        "Speed of the outer race by which the sprags must have lifted off the inner race in overrun, in a driven cage of the\ninner race, off the outer one, rev/min.";
    film_lambda: "exclusiveMinimum" 0, "" -> film_lambda by same, AT_FILM_SPEED,
        "Smallest ratio wanted of film to roughness at the sliding contact, the inner one or in a driven cage the outer one, at film_at_rpm; needs the table `lubrication`.";
    film_at_rpm: "exclusiveMinimum" 0, "rpm" -> film_at_rad_s by rad_s, ALONE,
        "Speed of the inner race in overrun, the outer one at rest, at which film_lambda is held, rev/min.";
}

impl Limits {
    /// The torque that comes again and again, N m: the nominal one, else the peak.
    pub fn usual_torque_nm(&self) -> Option<f64> {
        self.nominal_torque_nm.or(self.peak_torque_nm)
    }

    /// The largest torque at which a limit is held, N m: the peak, else the nominal one.
    pub fn largest_torque_nm(&self) -> Option<f64> {
        self.peak_torque_nm.or(self.nominal_torque_nm)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
