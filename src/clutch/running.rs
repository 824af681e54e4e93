//! From races and sprags as made to those as run: interference fits, temperatures, where first contact then lies.
//!
//! In: [`Fits`], races and sprags as made, SI. Out: races and sprags as run, [`Running`]. Absent: load; gradients of
//! temperature within a body. Equations: triangle (9) is asked of `profile`, Lame's press fit of `race`.

use super::{InnerArc, Materials, Races, Sprags};
use crate::material::Material;
use crate::profile::{Flanks, Outline, OutlineError, azimuth_between, clearance_m};
use crate::race::Race;

/// How one track came from its radius as made to that as run, without load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrackRun {
    /// Radius as made, at the reference temperature, m.
    pub made_m: f64,
    /// What the fit adds, m, outward positive.
    pub by_fit_m: f64,
    /// What the temperature adds, m.
    pub by_temperature_m: f64,
    /// Radius that would have to be made for the gap, in terms of the warm sprag, to be what [`Self::made_m`] draws, m.
    pub to_make_m: f64,
    /// Pressure at the joint with shaft or housing, Pa; 0 without one.
    pub joint_pressure_pa: f64,
    /// Radius of that joint as run, the race's other rim, m.
    pub joint_m: f64,
    /// Hoop stress of the race at its track by the fit alone, Pa, tension positive.
    pub hoop_at_track_pa: f64,
    /// The same at the joint.
    pub hoop_at_joint_pa: f64,
}

/// Fits and temperatures. Races and sprags of the clutch are those as run: a race joined with shaft or housing counts as
/// one piece with it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Running {
    /// Inner track.
    pub inner: TrackRun,
    /// Outer track.
    pub outer: TrackRun,
    /// Sizes of the sprags as run over those as made, pure number.
    pub sprag_scale: f64,
    /// Turn of the contact on the sprag at first contact as run, since that as made, rad; positive in engagement.
    pub first_turn_rad: f64,
}

/// What makes races and sprags run otherwise than they are made.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Fits {
    /// Shaft in the inner race.
    pub inner: Option<Joint>,
    /// Housing round the outer race.
    pub outer: Option<Joint>,
    /// Linear growth of the sprags by temperature, pure number.
    pub sprag_growth: f64,
    /// The same of the inner race and its shaft.
    pub inner_growth: f64,
    /// The same of the outer race and its housing.
    pub outer_growth: f64,
}

/// An interference fit of a race.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Joint {
    /// Half the interference on diameter, m.
    pub radial_m: f64,
    /// Far rim of the partner, m: the hole in the shaft (0: solid), the outside of the housing.
    pub far_rim_m: f64,
}

/// Why a clutch as made is none as run.
#[derive(Debug, Clone, PartialEq)]
pub enum NotRunning {
    /// Radii or widths of a race and its partner are no rings.
    Rings,
    /// The sprags no longer touch both races on their profile.
    Gap {
        /// R_e - R_i as run, m.
        run_m: f64,
    },
    /// The flanks no longer close the outline.
    Outline(OutlineError),
    /// Neighbours overlap at first contact.
    Neighbours {
        /// By this, m.
        overlap_m: f64,
    },
}

impl Fits {
    /// Races and sprags as run, and how they came to run so.
    ///
    /// # Errors
    /// [`NotRunning`].
    pub fn run(
        &self,
        made: &Races,
        sprags: &Sprags,
        materials: &Materials,
    ) -> Result<(Races, Sprags, Running), NotRunning> {
        let scale = 1.0 + self.sprag_growth;
        let inner_side = MadeRace {
            inner: true,
            track_m: made.inner_radius_m,
            rim_m: made.inner_bore_radius_m,
            width_m: made.width_m,
            material: materials.inner_race,
            joint: self.inner,
            growth: self.inner_growth,
        };
        let outer_side = MadeRace {
            inner: false,
            track_m: made.outer_radius_m,
            rim_m: made.outer_outside_radius_m,
            width_m: made.width_m,
            material: materials.outer_race,
            joint: self.outer,
            growth: self.outer_growth,
        };
        let inner = inner_side.run(scale).ok_or(NotRunning::Rings)?;
        let outer = outer_side.run(scale).ok_or(NotRunning::Rings)?;
        let [track_i, track_e] = [inner, outer].map(|t| t.made_m + t.by_fit_m + t.by_temperature_m);
        let far = |side: &MadeRace| side.joint.map_or(side.rim_m, |j| j.far_rim_m) * (1.0 + side.growth);
        let races = Races {
            inner_bore_radius_m: far(&inner_side),
            inner_radius_m: track_i,
            outer_radius_m: track_e,
            outer_outside_radius_m: far(&outer_side),
            ..*made
        };
        let gap = NotRunning::Gap { run_m: races.outer_radius_m - races.inner_radius_m };
        let (sprags, first_turn_rad) = placed(made, &races, sprags, scale).ok_or(gap)?;
        check_outline(&races, &sprags)?;
        Ok((races, sprags, Running { inner, outer, sprag_scale: scale, first_turn_rad }))
    }
}

/// One race with what it is joined to.
struct MadeRace {
    inner: bool,
    track_m: f64,
    rim_m: f64,
    width_m: f64,
    material: Material,
    joint: Option<Joint>,
    /// Linear growth by temperature, pure number.
    growth: f64,
}

impl MadeRace {
    /// The track made at `track_m`: fitted at the reference temperature, then warmed together with its partner, which is
    /// of the same material and so changes no stress. `None` where the radii are out of order.
    fn made_at(&self, track_m: f64) -> Option<TrackRun> {
        let ring = |bore: f64, outside: f64| {
            let make = if self.inner { Race::inner } else { Race::outer };
            make(bore, outside, self.width_m, self.material).ok()
        };
        let fit = match (self.joint, self.inner) {
            (None, _) => None,
            (Some(j), true) => {
                Some(ring(self.rim_m, track_m)?.press_fit(&ring(j.far_rim_m, self.rim_m)?, j.radial_m))
            }
            (Some(j), false) => {
                Some(ring(track_m, self.rim_m)?.press_fit(&ring(self.rim_m, j.far_rim_m)?, j.radial_m))
            }
        };
        let by_fit_m = fit.map_or(0.0, |f| f.track_growth_m);
        Some(TrackRun {
            made_m: track_m,
            by_fit_m,
            by_temperature_m: (track_m + by_fit_m) * self.growth,
            to_make_m: track_m,
            joint_pressure_pa: fit.map_or(0.0, |f| f.pressure_pa),
            joint_m: self.rim_m * (1.0 + self.growth),
            hoop_at_track_pa: fit.map_or(0.0, |f| f.hoop_at_track_pa),
            hoop_at_joint_pa: fit.map_or(0.0, |f| f.hoop_at_joint_pa),
        })
    }

    /// The track as the file has it, with the radius to make: that which runs at the drawn radius times the sprag's own
    /// growth, so that the warm clutch is the drawn one, enlarged. The fit hardly feels the radius: each round leaves a
    /// small part of the miss.
    fn run(&self, sprag_scale: f64) -> Option<TrackRun> {
        let run = self.made_at(self.track_m)?;
        let wanted = self.track_m * sprag_scale;
        let mut to_make_m = self.track_m;
        for _ in 0..60 {
            let Some(tried) = self.made_at(to_make_m) else { break };
            let miss = wanted - (tried.made_m + tried.by_fit_m + tried.by_temperature_m);
            to_make_m += miss;
            if miss.abs() <= 1e-15 {
                break;
            }
        }
        Some(TrackRun { to_make_m, ..run })
    }
}

/// The sprags, enlarged by `scale`, between the races as run, with everything that counts from first contact counted from
/// the new one: turns of the arcs, the body frame of the centroid. The arc on which first contact then lies comes first.
/// Flanks stay where they are on the body. `None`: no first contact on the profile, or none beside the flanks.
fn placed(made: &Races, run: &Races, sprags: &Sprags, scale: f64) -> Option<(Sprags, f64)> {
    let r_e = sprags.outer_radius_m;
    let profile = sprags.profile(made).ok()?;
    let oc_e = run.outer_radius_m - scale * r_e;
    let (first, distance, rotation, turn) = profile.arcs.iter().enumerate().find_map(|(k, arc)| {
        let distance = scale * arc.centre_m.norm();
        let oc_k = run.inner_radius_m + scale * arc.radius_m;
        let beta = azimuth_between(oc_k, oc_e, distance)?;
        let rotation =
            (oc_k * beta.sin()).atan2(oc_k * beta.cos() - oc_e) - arc.centre_m.x.atan2(arc.centre_m.y);
        let turn = rotation - (beta - profile.beta0_rad);
        (turn < arc.until_rad).then_some((k, distance, rotation, turn))
    })?;
    let flanks = match sprags.flanks {
        Some(made) => {
            // The races as a sprag sees them that has not grown.
            let [inner_m, outer_m] = [run.inner_radius_m, run.outer_radius_m].map(|m| m / scale);
            Some(profile.reseated(0.0, 0.0, inner_m, outer_m).ok()?.flanks(&profile, &made)?)
        }
        None => None,
    };
    let (sin, cos) = rotation.sin_cos();
    let [x, y] = sprags.centroid_m.map(|c| scale * c);
    let inner_arcs = sprags.inner_arcs.iter().skip(first);
    let sprags = Sprags {
        length_m: scale * sprags.length_m,
        outer_radius_m: scale * r_e,
        centre_distance_m: distance,
        width_m: scale * sprags.width_m,
        inertia_kg_m2: scale * scale * sprags.inertia_kg_m2,
        centroid_m: [x * cos + y * sin, y * cos - x * sin],
        inner_arcs: inner_arcs
            .map(|a| InnerArc { radius_m: scale * a.radius_m, until_rad: a.until_rad - turn })
            .collect(),
        spiral: sprags.spiral.map(|s| s.moved(scale, turn)),
        flanks: flanks.map(|f| Flanks { rear_m: scale * f.rear_m, front_m: scale * f.front_m, ..f }),
        ..sprags.clone()
    };
    Some((sprags, turn))
}

/// Outline and neighbours, once more, as run.
fn check_outline(races: &Races, sprags: &Sprags) -> Result<(), NotRunning> {
    let Some(flanks) = sprags.flanks else { return Ok(()) };
    let gap = NotRunning::Gap { run_m: races.outer_radius_m - races.inner_radius_m };
    let profile = sprags.profile(races).map_err(|_| gap)?;
    let outline = Outline::closed(&profile, &flanks).map_err(NotRunning::Outline)?;
    let clear_m = clearance_m(&outline, profile.outer_centre_distance_m, 0.0, sprags.count);
    if clear_m > 0.0 { Ok(()) } else { Err(NotRunning::Neighbours { overlap_m: -clear_m }) }
}
