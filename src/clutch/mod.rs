//! The nouns: a clutch and its parts as it runs, what it is made to, what happens to it.
//!
//! In: values in SI. Out: [`Clutch`], [`Running`], [`Tolerances`], [`Scenario`]; the contact laws by name. Absent: files and
//! their units (`file`), allowables (`margin`), how anything is answered. Equations: none of its own; triangle (9) is asked
//! of `profile`, Lame's press fit of `race`. Table 1 of the paper is a `Clutch`.

mod drivetrain;
mod law;
mod lubrication;
mod question;
mod running;
mod service;
mod sharing;
mod tolerances;

pub use crate::race::Rim;
pub use drivetrain::{DriveInertia, DriveTorque, GasTorque, MOST_SHAFTS, Shaft, Towards};
pub(crate) use law::ROLLER_COEFFICIENT;
pub use law::{ContactLaw, LAWS, LawFacts, LawName};
pub use lubrication::{Lubrication, SlipCase};
pub use question::{Phrase, Scenario, ScenarioKind, Start};
pub use running::{Fits, Joint, NotRunning, Running, TrackRun};
pub use service::{
    CoreStrength, FatigueStrength, PittingStrength, RepeatedHistory, RepeatedLoad, RepeatedSwing, Service,
};
pub use sharing::{GivenSprag, Sharing, Standing, TrackWave};
pub use tolerances::Tolerances;

use crate::material::Material;
use crate::profile::{Brink, Flanks, Outline, Profile, ProfileError, Spiral};
use schemars::JsonSchema;
use serde::Deserialize;
use std::f64::consts::PI;

/// Where the sprag's mass, inertia and centroid come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MassSource {
    /// Printed in the design file.
    Given,
    /// Boundary integrals of the outline (`profile`).
    FromProfile,
}

/// One inner arc of the sprag.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InnerArc {
    /// Radius r_ik, m.
    pub radius_m: f64,
    /// Contact direction turned from first contact at rest at which the arc ends, rad, positive in engagement.
    pub until_rad: f64,
}

/// Shape and number of the sprags. Body frame: origin C_e, y radially outward along OC_e at first
/// contact at rest, x towards positive azimuth.
#[derive(Debug, Clone, PartialEq)]
pub struct Sprags {
    /// Number n_s.
    pub count: usize,
    /// Length l along the axis, m.
    pub length_m: f64,
    /// Outer arc radius r_e, m.
    pub outer_radius_m: f64,
    /// Centre distance e_1 = C_1 C_e, m.
    pub centre_distance_m: f64,
    /// Width b of (6), m; 0: no body compression.
    pub width_m: f64,
    /// Mass m_g of one sprag, kg.
    pub mass_kg: f64,
    /// Inertia I_g of one sprag about its centroid, kg m^2.
    pub inertia_kg_m2: f64,
    /// Centroid G in the body frame, m.
    pub centroid_m: [f64; 2],
    /// Whether the three above were given or computed.
    pub mass_source: MassSource,
    /// Inner arcs in order of engagement, at least one.
    pub inner_arcs: Vec<InnerArc>,
    /// The spiral that the last of them stand for, if any; answers name it, nothing is computed with it.
    pub spiral: Option<Spiral>,
    /// Flanks that close the outline: those of the file, or both at half of `width_m`; absent without either.
    pub flanks: Option<Flanks>,
}

/// The two races as they run: fitted, and at their temperatures. [`Running`] has what was made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Races {
    /// Inner race bore R_id, m; 0: solid shaft.
    pub inner_bore_radius_m: f64,
    /// Inner race track R_i, m.
    pub inner_radius_m: f64,
    /// Outer race track R_e, m.
    pub outer_radius_m: f64,
    /// Outer race outside radius R_ed, m.
    pub outer_outside_radius_m: f64,
    /// Axial width of both races (l of (5)), m.
    pub width_m: f64,
    /// I_bi, kg m^2.
    pub inner_inertia_kg_m2: f64,
    /// I_be, kg m^2.
    pub outer_inertia_kg_m2: f64,
    /// Viscous damping C_rl between the races, N m s/rad.
    pub viscous_damping_nm_s_per_rad: f64,
    /// How the axes of the two tracks lie; `None`: on one another.
    pub eccentricity: Option<Eccentricity>,
    /// How the bore of the inner race is held under load.
    pub inner_rim: Rim,
    /// How the outside of the outer race is held under load.
    pub outer_rim: Rim,
}

/// Two tracks whose axes are parallel but apart.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Eccentricity {
    /// Distance of the axes, m: the gap runs from the drawn one less this to the drawn one plus this. A dial indicator on
    /// one track reads twice this as the other turns (total indicator reading).
    pub offset_m: f64,
    /// Whether the engaged clutch turns against the offset (races in two sets of bearings that are out of line), so that
    /// each sprag passes every gap under load. Otherwise the offset stays with the sprags (a track that runs out).
    pub turning: bool,
    /// Which race the offset stays with while the clutch winds up.
    pub carrier: Carrier,
    /// Radial stiffness of what holds the two axes apart, N/m: 0 a race that floats on the sprags, infinite: held.
    pub stiffness_n_per_m: f64,
}

/// The race that an offset of the axes stays with. Sprags roll on along both while they wind up, and so along a gap that
/// narrows or widens.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Carrier {
    /// Its track runs out, or it stands and the bearings are off centre.
    #[default]
    OuterRace,
    /// The same of the inner race.
    InnerRace,
}

/// A cage that turns with the inner race and carries the sprags round: in overrun they slide on the outer race, until the
/// centrifugal force lifts them off it. Without one the sprags ride with the outer race.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cage {
    /// P in the body frame, m: the point of a sprag that the cage keeps from going outward and takes along. A sprag that
    /// nothing presses on the inner race turns about it.
    pub pivot_m: [f64; 2],
    /// How far the cage lets P go outward from where it is when the sprag touches both races, m, not negative.
    pub clearance_m: f64,
}

/// Energizing spring, per sprag.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spring {
    /// K_r, N m/rad per sprag.
    pub stiffness_nm_per_rad: f64,
    /// Drag torque C_f of the whole clutch in slow overrun, N m; fixes alpha_max.
    pub drag_torque_nm: f64,
}

/// Materials of the three bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Materials {
    /// Sprag.
    pub sprag: Material,
    /// Inner race.
    pub inner_race: Material,
    /// Outer race.
    pub outer_race: Material,
}

/// Coefficients of the friction law (12).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Friction {
    /// mu_s.
    pub static_: f64,
    /// mu_c, at most mu_s.
    pub kinetic: f64,
    /// gamma_b, s/m.
    pub decay_s_per_m: f64,
    /// Whether B never slips (model "vernay": Coulomb friction inside, no slip outside).
    pub outer_holds: bool,
}

/// Stress state along the axis for the elastic law.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum StressState {
    /// As a body of finite length is: plane strain near the contact, plane stress farther away and in the rings.
    #[default]
    Layer,
    /// Plane strain throughout, rings too (very long clutches; two-dimensional finite elements).
    PlaneStrain,
    /// Plane stress throughout (thin discs; two-dimensional finite elements).
    PlaneStress,
}

/// What the contacts are like along the axis; alike at A and B.
#[derive(Debug, Clone, PartialEq)]
pub struct Axial {
    /// Slices along a contact where slices are asked for.
    pub slices: usize,
    /// Shape of the sprag along its length.
    pub end_profile: EndProfile,
    /// Tilt of the sprag against the races in the plane of axis and normal, rad; positive opens A towards +y and B
    /// towards -y.
    pub tilt_rad: f64,
    /// Middle of the sprag from the middle of the races, m.
    pub offset_m: f64,
}

impl Axial {
    /// Straight, parallel and in the middle, 60 slices.
    pub const STRAIGHT: Self =
        Self { slices: 60, end_profile: EndProfile::Square, tilt_rad: 0.0, offset_m: 0.0 };

    /// Whether the load spreads evenly but for the ends: no profile, no tilt.
    pub fn is_straight(&self) -> bool {
        self.end_profile == EndProfile::Square && self.tilt_rad == 0.0
    }
}

/// Drop of a sprag's surface along its length.
#[derive(Debug, Clone, PartialEq)]
pub enum EndProfile {
    /// Straight to a sharp end.
    Square,
    /// Lundberg's logarithm.
    Lundberg {
        /// Normal force of one sprag for which it is made, N.
        design_load_n: f64,
    },
    /// Arc of a circle over the whole length.
    Crown {
        /// Radius, m.
        radius_m: f64,
    },
    /// Arcs over the last part of each end.
    EndRelief {
        /// Length of that part, m.
        length_m: f64,
        /// Radius, m.
        radius_m: f64,
    },
    /// Logarithm with three parameters (Fujiwara and Kawase).
    FujiwaraKawase {
        /// Design load, N.
        design_load_n: f64,
        /// K_1.
        load_factor: f64,
        /// K_2.
        crowned_ratio: f64,
        /// z_m, m.
        end_drop_m: f64,
    },
    /// Measured: (y from the middle, drop), m, y rising.
    Table {
        /// Points.
        points_m: Vec<[f64; 2]>,
    },
}

/// Everything that acts in one run: the clutch without limits and questions.
#[derive(Debug, Clone, PartialEq)]
pub struct Clutch {
    /// Sprags.
    pub sprags: Sprags,
    /// Races, as run.
    pub races: Races,
    /// How they came to run so; `None` where they run as made.
    pub running: Option<Running>,
    /// Spring.
    pub spring: Spring,
    /// The cage that carries the sprags with the inner race; `None`: a free one without mass, they ride with the outer race.
    pub cage: Option<Cage>,
    /// Materials.
    pub materials: Materials,
    /// Friction.
    pub friction: Friction,
    /// What lubricates contact A where it slides in overrun; `None`: (12) alone.
    pub lubrication: Option<Lubrication>,
    /// Local contact law.
    pub contact: ContactLaw,
    /// How sprag and race lie along the axis.
    pub axial: Axial,
    /// Hunt and Crossley's damping of both contacts: N is raised by this times the rate of approach, s/m; 0: none.
    pub hunt_crossley_s_per_m: f64,
}

impl Sprags {
    /// Number of inner arcs that a file lists: all but those that stand for its spiral.
    pub fn listed_arcs(&self) -> usize {
        self.inner_arcs.len().saturating_sub(self.spiral.map_or(0, |s| s.arc_count()))
    }

    /// Their profile between `races`.
    ///
    /// # Errors
    /// [`ProfileError`].
    pub fn profile(&self, races: &Races) -> Result<Profile, ProfileError> {
        let arcs: Vec<(f64, f64)> = self.inner_arcs.iter().map(|a| (a.radius_m, a.until_rad)).collect();
        let (r_e, e) = (self.outer_radius_m, self.centre_distance_m);
        Profile::new(r_e, e, &arcs, races.inner_radius_m, races.outer_radius_m)
    }
}

impl Clutch {
    /// The sprags' profile between the races as run.
    ///
    /// # Errors
    /// [`ProfileError`]; a design that was read from a file has none.
    pub fn profile(&self) -> Result<Profile, ProfileError> {
        self.sprags.profile(&self.races)
    }

    /// Where the surfaces that the sprags roll on end; `None` where the design has no flanks, or they do not close `profile`.
    pub fn brink(&self, profile: &Profile) -> Option<Brink> {
        Outline::closed(profile, self.sprags.flanks.as_ref()?).ok()?.brink(profile)
    }

    /// Length over which sprag and race overlap along the axis, m.
    pub fn contact_length_m(&self) -> f64 {
        let (sprag, race) = (0.5 * self.sprags.length_m, 0.5 * self.races.width_m);
        let offset = self.axial.offset_m;
        (offset + sprag).min(race) - (offset - sprag).max(-race)
    }

    /// Whether the sprags slide on the outer race in overrun: a driven cage carries them with the inner one. Otherwise they ride with
    /// the outer race and slide on the inner one.
    pub fn slides_outside(&self) -> bool {
        self.cage.is_some()
    }

    /// The overrun, rad/s, in which the race that the sprags ride with runs at `speed_rad_s` and the other stands: by how much the
    /// inner race is ahead, and the speed of the outer one.
    pub fn overrun_of_carrier(&self, speed_rad_s: f64) -> [f64; 2] {
        if self.slides_outside() { [speed_rad_s, 0.0] } else { [-speed_rad_s, speed_rad_s] }
    }

    /// Radius of the track on which the sprags slide in overrun, m.
    pub fn sliding_track_m(&self) -> f64 {
        if self.slides_outside() { self.races.outer_radius_m } else { self.races.inner_radius_m }
    }

    /// Masses of all sprags, of the inner and of the outer race (plain rings as wide as `races.width_mm`), kg.
    pub fn masses_kg(&self) -> [f64; 3] {
        let (s, r, m) = (&self.sprags, &self.races, &self.materials);
        let ring =
            |inner: f64, outer: f64, density: f64| PI * (outer * outer - inner * inner) * r.width_m * density;
        [
            s.count as f64 * s.mass_kg,
            ring(r.inner_bore_radius_m, r.inner_radius_m, m.inner_race.density_kg_m3),
            ring(r.outer_radius_m, r.outer_outside_radius_m, m.outer_race.density_kg_m3),
        ]
    }

    /// Their sum, kg.
    pub fn mass_kg(&self) -> f64 {
        self.masses_kg().iter().sum()
    }
}
