//! A new design from a few lengths.
//!
//! In: nothing. Out: [`Draft`], SI. Absent: its text (`file`), how the lengths were found (`size`). Equations: none.

use crate::material::Steel;

/// Box of the variables of a new design file, r_i1 and e_1, over their values there.
pub const BOX: [[f64; 2]; 2] = [[0.9, 1.1], [0.8, 1.2]];

/// What every limit of a new design file keeps of its margin, and a search of it leaves: a choice, so that rounding and tolerances find room.
pub const RESERVE: f64 = 0.02;

/// A scene as new design files have it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NewScene {
    /// Name.
    pub name: &'static str,
    /// Kind, as the file names it.
    pub kind: &'static str,
    /// What happens.
    pub words: &'static str,
}

/// Nominal torque, in every new file.
pub const RATED_STATIC: NewScene =
    NewScene { name: "rated-static", kind: "static", words: "Nominal torque, steady." };
/// A step of torque, in every new file.
pub const RATED_STEP: NewScene = NewScene {
    name: "rated-step",
    kind: "transient",
    words: "A step of torque on the inner race; it swings as far beyond as the step is high: nominal torque at the crest.",
};
/// A torque that swings.
pub const SWING: NewScene = NewScene {
    name: "swing",
    kind: "torsional-excitation",
    words: "The torque on the outer race swings, up to nominal torque.",
};
/// From overrun into engagement.
pub const ENGAGE: NewScene = NewScene {
    name: "engage",
    kind: "engagement",
    words: "From overrun into engagement, up to the crest of the torque. Shown only.",
};
/// Steady overrun.
pub const OVERRUN: NewScene = NewScene {
    name: "overrun",
    kind: "overrun",
    words: "Steady overrun: both races at constant speeds, the sprags sliding.",
};
/// All of them.
pub const NEW_SCENES: [NewScene; 5] = [RATED_STATIC, RATED_STEP, SWING, ENGAGE, OVERRUN];

/// A scene of a new design file beside the two that every one has.
#[derive(Debug, Clone, PartialEq)]
pub struct DraftScene {
    /// Name and kind.
    pub scene: NewScene,
    /// What it stands for here: a comment line without its #.
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
    /// Pivot (x, y) of a cage that the inner race drives, from C_e, m; `None`: the cage is free.
    pub pivot_m: Option<[f64; 2]>,
    /// R_id, R_i, R_e, R_ed, m.
    pub races_m: [f64; 4],
    /// Axial width of the races, m.
    pub width_m: f64,
    /// K_r, N m/rad per sprag.
    pub spring_nm_per_rad: f64,
    /// C_f, N m.
    pub drag_nm: f64,
    /// Speed at which the races slide past one another in overrun, rad/s; 0: not said.
    pub sliding_rad_s: f64,
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

/// Viscous drag of the races over C_f in the overrun of a draft: a choice. The damper acts on the whole speed at which they slide, so that
/// one chosen for the swing in engagement would brake the overrun with a multiple of what the clutch carries.
pub const VISCOUS_SHARE: f64 = 0.1;

/// Speed at which they slide where nobody has said one, rad/s: 1000 rpm.
pub const USUAL_SLIDING_RAD_S: f64 = 1000.0 * std::f64::consts::PI / 30.0;

impl Draft {
    /// C_rl, N m s/rad, and the speed at which it makes its share of the drag, rad/s.
    pub fn viscous_damping(&self) -> (f64, f64) {
        let sliding = if self.sliding_rad_s > 0.0 { self.sliding_rad_s } else { USUAL_SLIDING_RAD_S };
        (VISCOUS_SHARE * self.drag_nm / sliding, sliding)
    }
}
