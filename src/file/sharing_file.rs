//! `[sharing]` as written, and the same in SI.
//!
//! In: TOML text. Out: [`Sharing`]. Absent: what the sprags carry (`sharing`). Equations: none. The doc comments are the
//! schema's descriptions.

use super::design_file::DesignFile;
use super::findings::Findings;
use crate::clutch::{Clutch, GivenSprag, Sharing, Standing, TrackWave};
use crate::design::m;
use crate::profile::{Outline, least_pitch_rad};
use schemars::JsonSchema;
use serde::Deserialize;
use std::f64::consts::TAU;

/// Sprags one by one, drawn within bounds from a seed or given by number: read by `sharing`, and by `check` and `optimize`, which then
/// hold the worst sprag.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct SharingFile {
    /// sprung: its own spring turns each sprag until it touches both races; caged: a cage holds all at one angle, where larger ones
    /// take load earlier.
    #[serde(default)]
    pub start: Standing,
    /// Seed of all that is drawn.
    #[serde(default = "first")]
    pub seed: u64,
    /// Bound of the deviation of a sprag's size across its contacts, evenly on both sides, um.
    #[serde(default)]
    #[schemars(extend("minimum" = 0, "maximum" = 1000))]
    pub size_within_um: f64,
    /// Bound of the deviation of a sprag's azimuth from its even place, deg.
    #[serde(default)]
    #[schemars(extend("minimum" = 0, "maximum" = 60))]
    pub azimuth_within_deg: f64,
    /// Bound of the deviation of a sprag's static friction from friction.static.
    #[serde(default)]
    #[schemars(extend("minimum" = 0, "maximum" = 1))]
    pub friction_within: f64,
    /// Largest gap that a sprag lacks to touch both races when torque begins (a weak or broken spring), evenly from 0, um.
    #[serde(default)]
    #[schemars(extend("minimum" = 0, "maximum" = 1000))]
    pub gap_up_to_um: f64,
    /// Radial stiffness of what holds the axes of the races, N/um, 0: free to centre themselves; absent: that of races.eccentricity,
    /// else held.
    #[schemars(extend("minimum" = 0))]
    pub bearing_stiffness_n_per_um: Option<f64>,
    /// Mass that moves on these bearings in a scene: race and what it is fixed to, kg; absent: the inner race as a plain ring.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub bearing_mass_kg: Option<f64>,
    /// Sprags of which something is known.
    #[serde(default)]
    pub sprags: Vec<GivenSpragFile>,
    /// Tracks that are not round as made, a wave each.
    #[serde(default)]
    pub tracks: Vec<TrackWaveFile>,
}

/// A wave of a track's radius as made.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct TrackWaveFile {
    /// The race.
    pub race: TrackFile,
    /// Lobes round the circumference, 2: oval.
    #[schemars(extend("minimum" = 2, "maximum" = 1000))]
    pub lobes: usize,
    /// Amplitude of the radius, um: half of what two-point measurement finds of an even number of lobes.
    #[schemars(extend("minimum" = 0, "maximum" = 1000))]
    pub amplitude_um: f64,
    /// Azimuth of a lobe, deg: of the outer race from sprag 1, with which it stays, of the inner race from the widest gap.
    #[serde(default)]
    pub azimuth_deg: f64,
}

/// Which race.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(super) enum TrackFile {
    Inner,
    Outer,
}

fn first() -> u64 {
    1
}

/// One sprag; what is absent is as drawn.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct GivenSpragFile {
    /// Its number, from 1, in the positive sense; number 1 stands in the widest gap.
    #[schemars(extend("minimum" = 1))]
    pub number: usize,
    /// How much more it measures across its contacts than the drawing, um.
    #[schemars(extend("minimum" = -1000, "maximum" = 1000))]
    pub size_um: Option<f64>,
    /// What it lacks to touch both races when torque begins, um.
    #[schemars(extend("minimum" = 0, "maximum" = 1000))]
    pub gap_um: Option<f64>,
    /// Its static friction.
    #[schemars(extend("minimum" = 0, "maximum" = 1))]
    pub friction: Option<f64>,
    /// Stiffness, and so moment, of its spring over that of the drawing, felt in scenes only; 0: broken.
    #[schemars(extend("minimum" = 0, "maximum" = 10))]
    pub spring_factor: Option<f64>,
    /// How far it stands ahead of its even place, deg.
    #[schemars(extend("minimum" = -60, "maximum" = 60))]
    pub ahead_deg: Option<f64>,
    /// Whether it is not there, or broken.
    #[serde(default)]
    pub missing: bool,
}

/// By how much the azimuths of two neighbours may come nearer until their outlines touch at first contact, deg; without an outline
/// nothing but their order is known.
fn room_deg(count: usize, clutch: Option<&Clutch>) -> f64 {
    let even_rad = TAU / count as f64;
    let least_rad = clutch.and_then(|clutch| {
        let flanks = clutch.sprags.flanks?;
        let profile = clutch.profile().ok()?;
        let outline = Outline::closed(&profile, &flanks).ok()?;
        Some(least_pitch_rad(&outline, profile.outer_centre_distance_m, even_rad))
    });
    (even_rad - least_rad.unwrap_or(0.0)).to_degrees()
}

/// Refuse azimuths that bring neighbours upon one another.
fn neighbours(sharing: &SharingFile, count: usize, clutch: Option<&Clutch>, out: &mut Findings) {
    let room_deg = room_deg(count, clutch);
    let help = || "neighbours keep their order, and their outlines do not overlap".to_owned();
    let within_deg = sharing.azimuth_within_deg;
    if within_deg >= 0.5 * room_deg {
        let allowed = format!("less than {:.4} deg, half of the room between neighbours", 0.5 * room_deg);
        out.refuse(&["sharing.azimuth_within_deg"], allowed, help());
        return;
    }
    // How far ahead and behind a place a sprag may come to stand.
    let span_deg = |number: usize| {
        let given = sharing.sprags.iter().find(|sprag| sprag.number == number);
        let missing = given.is_some_and(|sprag| sprag.missing);
        let [behind, ahead] = match given.and_then(|sprag| sprag.ahead_deg) {
            Some(ahead) => [ahead; 2],
            None => [-within_deg, within_deg],
        };
        (!missing).then_some([behind, ahead])
    };
    for (i, sprag) in sharing.sprags.iter().enumerate() {
        let Some(ahead_deg) = sprag.ahead_deg.filter(|_| !sprag.missing) else { continue };
        let number = sprag.number;
        let (next, before) = (number % count + 1, (number + count - 2) % count + 1);
        let most = span_deg(next).map_or(f64::INFINITY, |[behind, _]| behind + room_deg);
        let least = span_deg(before).map_or(f64::NEG_INFINITY, |[_, ahead]| ahead - room_deg);
        // A sprag beside one that is missing stays on its side of that place.
        let (least, most) = (least.max(-0.5 * 360.0 / count as f64), most.min(0.5 * 360.0 / count as f64));
        if ahead_deg <= least || ahead_deg >= most {
            let allowed =
                format!("above {least:.4} and below {most:.4} deg, where its neighbours stand as they do");
            out.refuse(&[&format!("sharing.sprags[{i}].ahead_deg")], allowed, help());
        }
    }
}

/// `[sharing]` in SI; problems go to `out`.
pub(super) fn si(
    file: &DesignFile,
    sharing: &SharingFile,
    clutch: Option<&Clutch>,
    out: &mut Findings,
) -> Sharing {
    let count = file.sprags.count;
    for (i, sprag) in sharing.sprags.iter().enumerate() {
        let key = format!("sharing.sprags[{i}].number");
        if !(1..=count).contains(&sprag.number) {
            out.refuse(
                &[&key],
                format!("1 to {count}, the number of sprags"),
                "sprags are counted from 1".to_owned(),
            );
        } else if sharing.sprags[..i].iter().any(|before| before.number == sprag.number) {
            out.refuse(
                &[&key],
                "each sprag once".to_owned(),
                "put what is known of it into one entry".to_owned(),
            );
        }
    }
    neighbours(sharing, count, clutch, out);
    let floats = sharing.bearing_stiffness_n_per_um == Some(0.0);
    if floats && file.races.eccentricity.as_ref().is_some_and(|e| e.turning) {
        out.refuse(
            &["sharing.bearing_stiffness_n_per_um"],
            "above 0 where races.eccentricity.turning is true".to_owned(),
            "nothing turns a race that floats against the sprags".to_owned(),
        );
    }
    let um = |um: f64| m(1e-3 * um);
    let one = |s: &GivenSpragFile| GivenSprag {
        index: s.number.saturating_sub(1),
        size_m: s.size_um.map(um),
        gap_m: s.gap_um.map(um),
        friction: s.friction,
        spring: s.spring_factor,
        azimuth_rad: s.ahead_deg.map(f64::to_radians),
        missing: s.missing,
    };
    Sharing {
        start: sharing.start,
        seed: sharing.seed,
        size_within_m: um(sharing.size_within_um),
        azimuth_within_rad: sharing.azimuth_within_deg.to_radians(),
        friction_within: sharing.friction_within,
        gap_up_to_m: um(sharing.gap_up_to_um),
        // N/um to N/m.
        stiffness_n_per_m: sharing.bearing_stiffness_n_per_um.map(|k| 1e6 * k),
        mass_kg: sharing.bearing_mass_kg,
        given: sharing.sprags.iter().map(one).collect(),
        tracks: sharing
            .tracks
            .iter()
            .map(|t| TrackWave {
                outer: t.race == TrackFile::Outer,
                lobes: t.lobes,
                amplitude_m: um(t.amplitude_um),
                azimuth_rad: t.azimuth_deg.to_radians(),
            })
            .collect(),
    }
}
