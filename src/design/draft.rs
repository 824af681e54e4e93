//! A new design file from a few lengths.
//!
//! In: [`Draft`], SI. Out: the text of a complete design file, in the file's units, each value with its source. Absent:
//! how the lengths were found, whether they make a clutch (parse it). Equations: none.

use std::f64::consts::PI;

use crate::numeric::rounded;

/// What a new design file says; one inner arc, steel, the law `elastic`.
#[derive(Debug, Clone, PartialEq)]
pub struct Draft {
    /// Name.
    pub name: String,
    /// Why the file exists: comment lines without their #.
    pub why: Vec<String>,
    /// n_s.
    pub count: usize,
    /// l, m.
    pub length_m: f64,
    /// r_e, m.
    pub outer_radius_m: f64,
    /// r_i1, m.
    pub inner_radius_m: f64,
    /// e_1, m.
    pub centre_distance_m: f64,
    /// End of the profile, rad.
    pub until_rad: f64,
    /// Flanks (rear, front), m; without them mass and centroid are placeholders for statics alone.
    pub flanks_m: Option<(f64, f64)>,
    /// R_id, R_i, R_e, R_ed, m.
    pub races_m: [f64; 4],
    /// Axial width of the races, m.
    pub width_m: f64,
    /// I_bi, I_be, kg m^2.
    pub inertias_kg_m2: [f64; 2],
    /// K_r, N m/rad per sprag.
    pub spring_nm_per_rad: f64,
    /// C_f, N m.
    pub drag_nm: f64,
    /// mu_s; mu_c is 0.9 of it.
    pub friction: f64,
    /// Nominal and peak torque, N m.
    pub torques_nm: [f64; 2],
    /// Race gap at nominal and peak torque, m.
    pub gaps_m: [f64; 2],
    /// Overrun speed up to which contact is kept and mean speed of the scene with the torque step, rad/s; 0: none.
    pub speed_rad_s: f64,
    /// How long the scene with the torque step lasts, s; the step comes after a tenth of it.
    pub step_duration_s: f64,
    /// Stiffness of the abutment that holds the outer race in that scene, N m/rad.
    pub abutment_nm_per_rad: f64,
}

/// mu_c over mu_s of a draft.
pub const KINETIC_SHARE: f64 = 0.9;

impl Draft {
    /// The text.
    pub fn to_toml(&self) -> String {
        let why: String = self.why.iter().map(|line| format!("# {line}\n")).collect();
        let [bore, track, outer, outside] = self.races_m.map(mm);
        let [nominal, peak] = self.torques_nm.map(|t| digits(t, 6));
        let [gap_nominal, gap_peak] = self.gaps_m.map(mm);
        let [inner_inertia, outer_inertia] = self.inertias_kg_m2.map(|i| digits(i, 4));
        let (r_e, r_i, e_1, length) =
            (mm(self.outer_radius_m), mm(self.inner_radius_m), mm(self.centre_distance_m), mm(self.length_m));
        let body = match self.flanks_m {
            Some((rear, front)) => format!(
                "flanks = {{ rear_mm = {}, front_mm = {} }}   # the narrowest that works; mass and centroid follow from it",
                mm(rear),
                mm(front)
            ),
            None => format!(
                "mass_kg = {}\ninertia_kg_m2 = {}\ncentroid = {{ x_mm = 0.0, y_mm = 0.0 }}",
                digits(7850.0 * self.length_m * (self.outer_radius_m + self.inner_radius_m).powi(2) * 0.6, 4),
                digits(1e-2 * self.length_m * 7850.0 * self.outer_radius_m.powi(4), 4)
            ),
        };
        // Without damping the step is felt twice, so that the crest is at nominal torque: 0.6 + 2 * 0.2.
        let (preload, torque_step) =
            (digits(0.6 * self.torques_nm[0], 6), digits(0.2 * self.torques_nm[0], 6));
        let rpm = digits(self.speed_rad_s * 30.0 / PI, 8);
        let keep = match self.speed_rad_s > 0.0 {
            true => format!("keep_contact_to_rpm = {rpm}    # asked for\n"),
            false => String::new(),
        };
        format!(
            r#"{why}schema = 1
name = "{name}"

[sprags]
count = {count}
length_mm = {length}
outer_radius_mm = {r_e}             # r_e
centre_distance_mm = {e_1}          # e_1: places tan omega at first contact
inner_arcs = [{{ radius_mm = {r_i}, until_rad = {until} }}]
{body}

[races]
inner_bore_radius_mm = {bore}
inner_radius_mm = {track}
outer_radius_mm = {outer}
outer_outside_radius_mm = {outside}
width_mm = {width}
inner_inertia_kg_m2 = {inner_inertia}       # the rings alone, without what is fixed to them
outer_inertia_kg_m2 = {outer_inertia}
viscous_damping_nm_s_per_rad = 0.1  # assumed

[spring]
stiffness_nm_per_rad = {spring}
drag_torque_nm = {drag}

[material]                          # bearing steel
youngs_modulus_gpa = 206.0
poisson_ratio = 0.3
density_kg_m3 = 7850.0

[friction]
static = {friction}                 # asked for
kinetic = {kinetic}                 # assumed: 0.9 of it
decay_s_per_m = 5.0                 # assumed

[limits]
nominal_torque_nm = {nominal}       # asked for
peak_torque_nm = {peak}             # nominal times the safety asked for
hertz_nominal_mpa = 4200.0          # GMN 9050
hertz_peak_mpa = 4600.0             # GMN 9050
gap_nominal_mm = {gap_nominal}      # GMN 9050: 8.46 mm of a gap of 8.33, in proportion
gap_peak_mm = {gap_peak}            # GMN 9050: 8.60 mm of a gap of 8.33, in proportion
equivalent_inner_mpa = 750.0        # GMN 9050, 100Cr6
equivalent_outer_mpa = 750.0        # GMN 9050, 100Cr6
slip_margin = 0.1                   # choice
{keep}
[check]
scenarios = ["rated-static", "rated-step"]

[[scenarios]]
name = "rated-static"
kind = "static"
torque_nm = {nominal}

# A step of torque on the inner race; it swings as far beyond as the step is high, to nominal torque at the crest.
[[scenarios]]
name = "rated-step"
kind = "transient"
preload_nm = {preload}
torque_step_nm = {torque_step}
step_time_s = {step_time}
abutment_stiffness_nm_per_rad = {abutment}
duration_s = {duration}
speed_rpm = {rpm}

[optimize]
objective = "slip-margin"
scenarios = ["rated-static", "rated-step"]
variables = [
  {{ name = "r_i1_mm", min = {ri_min}, max = {ri_max} }},
  {{ name = "centre_distance_mm", min = {e_min}, max = {e_max} }},
]
seed = 1
"#,
            name = self.name,
            count = self.count,
            until = digits(self.until_rad, 4),
            width = mm(self.width_m),
            spring = digits(self.spring_nm_per_rad, 4),
            drag = digits(self.drag_nm, 4),
            friction = digits(self.friction, 6),
            kinetic = digits(KINETIC_SHARE * self.friction, 6),
            abutment = digits(self.abutment_nm_per_rad, 4),
            step_time = digits(0.1 * self.step_duration_s, 4),
            duration = digits(self.step_duration_s, 4),
            ri_min = mm(0.95 * self.inner_radius_m),
            ri_max = mm(1.05 * self.inner_radius_m),
            e_min = mm(0.9 * self.centre_distance_m),
            e_max = mm(1.1 * self.centre_distance_m),
        )
    }
}

/// mm to 0.1 um.
fn mm(m: f64) -> String {
    float((m * 1e7).round() / 1e4)
}

/// So many significant digits, as TOML.
fn digits(value: f64, digits: usize) -> String {
    float(rounded(value, digits))
}

/// A TOML float: always with a point or an exponent.
fn float(value: f64) -> String {
    format!("{value:?}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_floats() {
        assert_eq!(
            (mm(8.33e-3), mm(0.04), digits(1234.5678, 3)),
            ("8.33".into(), "40.0".into(), "1230.0".into())
        );
        assert_eq!((digits(1.2e-7, 4), digits(0.0, 3)), ("1.2e-7".into(), "0.0".into()));
    }
}
