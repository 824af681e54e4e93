//! What sets the sprags of a clutch apart from one another.
//!
//! In: nothing. Out: [`Sharing`], SI. Absent: what they carry then (`sharing`). Equations: none.

use schemars::JsonSchema;
use serde::Deserialize;

/// Deviations of the sprags: drawn within bounds from a seed, and given by number.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Sharing {
    /// How the sprags stand when torque begins.
    pub start: Standing,
    /// Seed of what is drawn.
    pub seed: u64,
    /// Bound of the drawn deviation in size, evenly on both sides, m.
    pub size_within_m: f64,
    /// The same of the azimuth, rad.
    pub azimuth_within_rad: f64,
    /// The same of the static friction.
    pub friction_within: f64,
    /// Largest drawn gap, evenly from 0, m.
    pub gap_up_to_m: f64,
    /// Radial stiffness of what holds the axes, N/m, 0: free to centre itself, infinite: held; `None`: that of the eccentricity,
    /// else held.
    pub stiffness_n_per_m: Option<f64>,
    /// Mass that moves on it in a scene, kg; `None`: that of the inner race as a plain ring.
    pub mass_kg: Option<f64>,
    /// Sprags by number, in place of what is drawn.
    pub given: Vec<GivenSprag>,
    /// Tracks that are not round as made.
    pub tracks: Vec<TrackWave>,
}

impl Sharing {
    /// Waves of the inner track.
    pub fn inner_track(&self) -> impl Iterator<Item = &TrackWave> {
        self.tracks.iter().filter(|wave| !wave.outer)
    }
}

/// A wave of a track's radius as made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrackWave {
    /// Whether it is the outer track, else the inner one.
    pub outer: bool,
    /// Lobes round the circumference, 2: oval.
    pub lobes: usize,
    /// Amplitude of the radius, m, not negative.
    pub amplitude_m: f64,
    /// Azimuth of a lobe, rad: of the outer track from sprag 0, of the inner one from the widest gap.
    pub azimuth_rad: f64,
}

impl TrackWave {
    /// How much the radius is larger at `azimuth_rad`, m.
    pub fn larger_m(&self, azimuth_rad: f64) -> f64 {
        self.amplitude_m * (self.lobes as f64 * (azimuth_rad - self.azimuth_rad)).cos()
    }

    /// The same, and its first and second derivative by the azimuth.
    pub fn larger_with_slopes_m(&self, azimuth_rad: f64) -> [f64; 3] {
        let lobes = self.lobes as f64;
        let (sin, cos) = (lobes * (azimuth_rad - self.azimuth_rad)).sin_cos();
        [cos, -lobes * sin, -lobes * lobes * cos].map(|part| self.amplitude_m * part)
    }
}

/// How sprags stand when torque begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Standing {
    /// Its own spring has turned each one until it touches both races: all take load from one windup on.
    #[default]
    Sprung,
    /// A cage holds all at the same angle, that at which a sprag as drawn touches concentric races: a larger one takes load earlier.
    Caged,
}

/// What the file says of one sprag; `None`: as drawn.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct GivenSprag {
    /// Its number, from 0, in the positive sense from the widest gap.
    pub index: usize,
    /// How much more it measures across its contacts, m.
    pub size_m: Option<f64>,
    /// What it lacks to touch both races when torque begins, m of size.
    pub gap_m: Option<f64>,
    /// Its static friction.
    pub friction: Option<f64>,
    /// Stiffness of its spring over that of the drawing, by which its moment is weaker or stronger in a scene.
    pub spring: Option<f64>,
    /// How far it stands ahead of its even place, rad.
    pub azimuth_rad: Option<f64>,
    /// Whether it is not there, or broken.
    pub missing: bool,
}
