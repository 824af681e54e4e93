//! What is drawn or modelled: one body of the clutch, or all of them, as chains of exact arcs and lines.
//!
//! # Conventions
//! A sprag alone lies in its body frame: origin C_e, y radially outward at first contact. Races and the whole clutch lie
//! about O, x to the right, y up, C_e of the first sprag on +y. Seen so, the clutch engages when the inner race turns
//! counterclockwise against the outer one.

use crate::clutch::{Clutch, MassSource};
use crate::profile::{Outline, Profile, Segment};
use nalgebra::Vector2;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

named! {
    /// What is exported.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Part {
        /// One sprag.
        Sprag = "sprag",
        /// The inner race.
        Inner = "inner",
        /// The outer race.
        Outer = "outer",
        /// Both races and all sprags.
        Clutch = "clutch",
    }
    /// Name, as flags and files have it.
    pub fn name;
}

impl Part {
    /// Whether a sprag is part of it, so that its outline must be closed.
    pub fn has_sprag(self) -> bool {
        matches!(self, Self::Sprag | Self::Clutch)
    }
}

/// A clutch to be drawn: as made, its profile placed, its outline closed where flanks are known.
#[derive(Debug, Clone)]
pub struct DrawnClutch<'a> {
    /// Name of the design.
    pub name: &'a str,
    /// Hash of the design.
    pub hash: &'a str,
    /// The clutch.
    pub clutch: &'a Clutch,
    /// Its profile.
    pub profile: &'a Profile,
    /// Its outline; nothing for a part without sprags.
    pub outline: Option<&'a Outline>,
}

impl DrawnClutch<'_> {
    /// First words of every file: tool, version, design.
    pub fn mark(&self) -> String {
        format!("{} {}; design {}", env!("CARGO_PKG_NAME"), env!("CARGO_PKG_VERSION"), self.hash)
    }

    /// Segments of the sprag in its body frame; none without an outline.
    pub fn sprag(&self) -> &[Segment] {
        self.outline.map_or(&[], Outline::segments)
    }

    /// Azimuths of the centres C_e of all sprags, rad, from +y towards +x.
    pub fn azimuths_rad(&self) -> Vec<f64> {
        let count = self.clutch.sprags.count;
        (0..count).map(|i| TAU * i as f64 / count as f64).collect()
    }

    /// C_e of the sprag at an azimuth, m, seen from O.
    pub fn centre_m(&self, azimuth_rad: f64) -> Vector2<f64> {
        let (sin, cos) = azimuth_rad.sin_cos();
        self.profile.outer_centre_distance_m * Vector2::new(sin, cos)
    }

    /// Segments of the sprag at an azimuth, seen from O.
    pub fn sprag_at(&self, azimuth_rad: f64) -> Vec<Segment> {
        let shift = self.centre_m(azimuth_rad);
        self.sprag().iter().map(|s| s.moved(azimuth_rad, shift)).collect()
    }

    /// Radii of the inner race, bore and track, m; no bore in a solid shaft.
    pub fn inner_radii_m(&self) -> (Option<f64>, f64) {
        let r = &self.clutch.races;
        ((r.inner_bore_radius_m > 0.0).then_some(r.inner_bore_radius_m), r.inner_radius_m)
    }

    /// Radii of the outer race, track and outside, m.
    pub fn outer_radii_m(&self) -> (f64, f64) {
        (self.clutch.races.outer_radius_m, self.clutch.races.outer_outside_radius_m)
    }

    /// Mass of the drawn sprag over the mass that the design gives, less 1; nothing where that follows from the outline.
    pub fn mass_excess(&self) -> Option<f64> {
        let s = &self.clutch.sprags;
        let density = self.clutch.materials.sprag.density_kg_m3;
        let drawn = self.outline?.mass_properties(s.length_m, density).mass_kg;
        (s.mass_source == MassSource::Given).then(|| drawn / s.mass_kg - 1.0)
    }
}

/// A full circle about O as two segments, counterclockwise.
pub(super) fn circle(radius_m: f64) -> Vec<Segment> {
    let half = |from_azimuth_rad| Segment::Arc {
        centre_m: Vector2::zeros(),
        radius_m,
        from_azimuth_rad,
        sweep_rad: -PI,
    };
    vec![half(FRAC_PI_2), half(-FRAC_PI_2)]
}

/// Angles of an arc from +x counterclockwise, rad: of its first point, 0 to 2 pi, and from there to its last.
pub(super) fn angles_rad(from_azimuth_rad: f64, sweep_rad: f64) -> (f64, f64) {
    ((FRAC_PI_2 - from_azimuth_rad).rem_euclid(TAU), -sweep_rad)
}

/// Roles of the outline's segments in their order: inner arcs from 1, front flank, outer arc, rear flank.
pub(super) fn surface_names(outline: &Outline) -> Vec<String> {
    let inner = outline.segments().len().saturating_sub(3);
    let arcs = (1..=inner).map(|k| format!("inner arc {k}"));
    arcs.chain(["front flank", "outer arc", "rear flank"].map(str::to_owned)).collect()
}
