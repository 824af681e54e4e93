//! A new design file from a few lengths.
//!
//! In: [`Draft`], SI. Out: the text of a complete design file, in the file's units, each value with its source. Absent:
//! how the lengths were found, whether they make a clutch (parse it). Equations: none.

use super::check;

use crate::material::Steel;
use crate::numeric::rounded;

/// Box of the variables of a new design file, r_i1 and e_1, over their values there.
pub const BOX: [[f64; 2]; 2] = [[0.9, 1.1], [0.8, 1.2]];

/// A scene of a new design file beside the two that every one has.
#[derive(Debug, Clone, PartialEq)]
pub struct DraftScene {
    /// Name.
    pub name: &'static str,
    /// Kind, as the file names it.
    pub kind: &'static str,
    /// What it stands for: a comment line without its #.
    pub why: String,
    /// Key, value in the file's unit, where the value comes from.
    pub keys: Vec<(&'static str, f64, &'static str)>,
    /// Whether `check` holds the design to it, or only shows it.
    pub checked: bool,
}

/// What a new design file says; one inner arc, a steel of the library, the law `elastic`. The outer race's inertia is
/// left to its radii.
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
    /// K_r, N m/rad per sprag.
    pub spring_nm_per_rad: f64,
    /// C_f, N m.
    pub drag_nm: f64,
    /// The steel of sprags and races.
    pub steel: &'static Steel,
    /// mu_s; mu_c is 0.9 of it.
    pub friction: f64,
    /// Where mu_s comes from.
    pub friction_from: &'static str,
    /// Nominal and peak torque, N m.
    pub torques_nm: [f64; 2],
    /// Where each comes from.
    pub torques_from: [&'static str; 2],
    /// Race gap at nominal and peak torque, m.
    pub gaps_m: [f64; 2],
    /// Overrun speed up to which contact is kept, and that by which the sprags are off, rad/s; `None`: not asked.
    pub contact_rad_s: [Option<f64>; 2],
    /// Where each comes from.
    pub contact_from: [&'static str; 2],
    /// Inertia on the inner race, kg m^2, and where it comes from; `None`: that of the ring alone.
    pub inner_inertia_kg_m2: Option<(f64, String)>,
    /// Mean speed of the scene with the torque step, rad/s.
    pub speed_rad_s: f64,
    /// How long the scene with the torque step lasts, s; the step comes after a tenth of it.
    pub step_duration_s: f64,
    /// Stiffness of the abutment that holds the outer race in that scene, N m/rad.
    pub abutment_nm_per_rad: f64,
    /// Further scenes.
    pub scenes: Vec<DraftScene>,
    /// Engagements at nominal torque that are wanted of it; `None`: not said.
    pub engagements: Option<f64>,
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
        let (r_e, r_i, e_1, length) =
            (mm(self.outer_radius_m), mm(self.inner_radius_m), mm(self.centre_distance_m), mm(self.length_m));
        let body = match self.flanks_m {
            Some((rear, front)) => format!(
                "flanks = {{ rear_mm = {}, front_mm = {} }}   # sides of the body, from the strut outwards: the narrowest that work; mass and centroid follow",
                mm(rear),
                mm(front)
            ),
            None => format!(
                "mass_kg = {}\ninertia_kg_m2 = {}\ncentroid = {{ x_mm = 0.0, y_mm = 0.0 }}",
                digits(
                    self.steel.material.density_kg_m3
                        * self.length_m
                        * (self.outer_radius_m + self.inner_radius_m).powi(2)
                        * 0.6,
                    4
                ),
                digits(
                    1e-2 * self.length_m * self.steel.material.density_kg_m3 * self.outer_radius_m.powi(4),
                    4
                )
            ),
        };
        // Without damping the step is felt twice, so that the crest is at nominal torque: 0.6 + 2 * 0.2.
        let (preload, torque_step) =
            (digits(0.6 * self.torques_nm[0], 6), digits(0.2 * self.torques_nm[0], 6));
        let rpm = |rad_s: f64| digits(check::rpm(rad_s), 8);
        let contact = ["keep_contact_to_rpm", "lift_off_by_rpm"];
        let asked = contact.into_iter().zip(self.contact_rad_s);
        let contact: String = asked
            .zip(self.contact_from)
            .filter_map(|((key, speed), from)| Some(format!("{key} = {}    # {from}\n", rpm(speed?))))
            .collect();
        let inertias = match &self.inner_inertia_kg_m2 {
            Some((inertia, from)) => format!(
                "inner_inertia_kg_m2 = {}        # {from}\n# outer_inertia_kg_m2: absent, so that of the ring alone",
                digits(*inertia, 4)
            ),
            None => {
                "# inner_inertia_kg_m2, outer_inertia_kg_m2: absent, so those of the rings alone".to_owned()
            }
        };
        let checked: String =
            self.scenes.iter().filter(|s| s.checked).map(|s| format!(", \"{}\"", s.name)).collect();
        let scenes: String = self.scenes.iter().map(DraftScene::to_toml).collect();
        let life = self.engagements.map_or(String::new(), |count| {
            format!(
                "\n# What the command life counts. What contacts and rings bear is to be added: pitting, rings.\n[life]\n\
                 loads = [ {{ torque_nm = {nominal}, engagements = {} }} ]\n",
                float(count)
            )
        });
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
{inertias}
viscous_damping_nm_s_per_rad = 0.1  # assumed

[spring]
stiffness_nm_per_rad = {spring}
drag_torque_nm = {drag}

[material]
name = "{steel}"                     # `sprag-design materials` lists them

[friction]
static = {friction}                 # {friction_from}
kinetic = {kinetic}                 # assumed: 0.9 of it
decay_s_per_m = 5.0                 # assumed

[limits]
from_material = true                # Hertz pressures and race stresses of that steel
hoop_inner_bending_mpa = {ring}     # choice: with the bending between the sprags no more than the mean may be
hoop_outer_bending_mpa = {ring}
nominal_torque_nm = {nominal}       # {nominal_from}
peak_torque_nm = {peak}             # {peak_from}
gap_nominal_mm = {gap_nominal}      # GMN 9050: 8.46 mm of a gap of 8.33, in proportion
gap_peak_mm = {gap_peak}            # GMN 9050: 8.60 mm of a gap of 8.33, in proportion
slip_margin = 0.1                   # choice
{contact}
[check]
scenarios = ["rated-static", "rated-step"{checked}]

[[scenarios]]
name = "rated-static"
kind = "static"
torque_nm = {nominal}

# A step of torque on the inner race; it swings as far beyond as the step is high: nominal torque at the crest.
[[scenarios]]
name = "rated-step"
kind = "transient"
preload_nm = {preload}
torque_step_nm = {torque_step}
step_time_s = {step_time}
abutment_stiffness_nm_per_rad = {abutment}
duration_s = {duration}
speed_rpm = {speed}
{scenes}{life}
[optimize]
objective = "slip-margin"
scenarios = ["rated-static", "rated-step"{checked}]
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
            steel = self.steel.name,
            ring = digits(self.steel.race_stress_pa / 1e6, 6),
            friction = digits(self.friction, 6),
            friction_from = self.friction_from,
            nominal_from = self.torques_from[0],
            peak_from = self.torques_from[1],
            speed = rpm(self.speed_rad_s),
            kinetic = digits(KINETIC_SHARE * self.friction, 6),
            abutment = digits(self.abutment_nm_per_rad, 4),
            step_time = digits(0.1 * self.step_duration_s, 4),
            duration = digits(self.step_duration_s, 4),
            ri_min = mm(BOX[0][0] * self.inner_radius_m),
            ri_max = mm(BOX[0][1] * self.inner_radius_m),
            e_min = mm(BOX[1][0] * self.centre_distance_m),
            e_max = mm(BOX[1][1] * self.centre_distance_m),
        )
    }
}

impl DraftScene {
    fn to_toml(&self) -> String {
        let key = |(key, value, from): &(&str, f64, &str)| {
            let line = format!("{key} = {}", digits(*value, 6));
            if from.is_empty() { format!("{line}\n") } else { format!("{line:<40} # {from}\n") }
        };
        let keys: String = self.keys.iter().map(key).collect();
        let Self { name, kind, why, .. } = self;
        format!("\n# {why}\n[[scenarios]]\nname = \"{name}\"\nkind = \"{kind}\"\n{keys}")
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
