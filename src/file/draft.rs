//! The text of a new design.
//!
//! In: [`Draft`], SI. Out: a complete design file, in the file's units, each value with its source. Absent: how the lengths
//! were found, whether they make a clutch (parse it). Equations: none.

use crate::design::{
    BOX, Draft, DraftScene, KINETIC_SHARE, NewScene, RATED_STATIC, RATED_STEP, RESERVE, VISCOUS_SHARE, rpm,
};
use crate::numeric::rounded;

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
        let cage = self.pivot_m.map_or(String::new(), |[x, y]| {
            format!(
                "\n# The inner race carries the sprags round; its speed lifts them off the outer one, for the centroid lies ahead of the pivot.\n\
                 [cage]\ndriven_by = \"inner-race\"\npivot = {{ x_mm = {}, y_mm = {} }}   # choice: three tenths of the way from C_e to C_1, a little \
                 below; from C_e, as the centroid\n",
                mm(x),
                mm(y)
            )
        });
        let (viscous, sliding_rad_s) = self.viscous_damping();
        let sliding_rpm = rounded(rpm(sliding_rad_s), 7);
        let rpm = |rad_s: f64| digits(rpm(rad_s), 8);
        let contact = ["keep_contact_to_rpm", "lift_off_by_rpm"];
        let asked = contact.into_iter().zip(self.contact_rad_s);
        let contact: String = asked
            .zip(self.contact_from)
            .filter_map(|((key, speed), from)| Some(format!("{key} = {}    # {from}\n", rpm(speed?))))
            .chain((self.speed_rad_s > 0.0).then(|| {
                format!(
                    "at_speed_rpm = {}         # it carries its torque up to there\n",
                    rpm(self.speed_rad_s)
                )
            }))
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
            self.scenes.iter().filter(|s| s.checked).map(|s| format!(", \"{}\"", s.scene.name)).collect();
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
viscous_damping_nm_s_per_rad = {viscous}  # choice: {viscous_share} of drag_torque_nm where the races slide past one another at {sliding} rpm
{cage}
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
scenarios = ["{static_name}", "{step_name}"{checked}]

[[scenarios]]
name = "{static_name}"
kind = "{static_kind}"
torque_nm = {nominal}

# {step_words}
[[scenarios]]
name = "{step_name}"
kind = "{step_kind}"
preload_nm = {preload}
torque_step_nm = {torque_step}
step_time_s = {step_time}
abutment_stiffness_nm_per_rad = {abutment}
duration_s = {duration}
speed_rpm = {speed}
{scenes}{life}
[optimize]
objective = "slip-margin"
scenarios = ["{static_name}", "{step_name}"{checked}]
variables = [
  {{ name = "r_i1_mm", min = {ri_min}, max = {ri_max} }},
  {{ name = "centre_distance_mm", min = {e_min}, max = {e_max} }},
]
reserve = {RESERVE}                      # choice: what every limit keeps of its margin
seed = 1
"#,
            name = self.name,
            static_name = RATED_STATIC.name,
            static_kind = RATED_STATIC.kind,
            step_name = RATED_STEP.name,
            step_kind = RATED_STEP.kind,
            step_words = RATED_STEP.words,
            count = self.count,
            until = digits(self.until_rad, 4),
            width = mm(self.width_m),
            viscous = digits(viscous, 3),
            sliding = sliding_rpm,
            viscous_share = VISCOUS_SHARE,
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
        let Self { scene: NewScene { name, kind, .. }, why, .. } = self;
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
