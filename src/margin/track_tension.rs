//! The largest tension along a track: the ring's hoop stress with its bending, and what the tractions of the patches add beside
//! them.

use crate::contact::{EdgeTension, tension_behind};
use crate::race::Race;
use std::f64::consts::TAU;

/// Places at which a pitch is looked at, closest together at the patch.
const PLACES: usize = 300;

/// One of the equal patches on a track.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrackPatch {
    /// Patches on the track.
    pub count: usize,
    /// Normal force of one, N.
    pub normal_n: f64,
    /// Tangential over normal force.
    pub tan: f64,
    /// Half width, m.
    pub half_width_m: f64,
    /// Peak pressure, Pa.
    pub peak_pa: f64,
    /// Static friction.
    pub friction: f64,
}

/// Where the surface of a track is stretched most.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrackTension {
    /// Hoop stress there, Pa, tension positive.
    pub largest_pa: f64,
    /// How far behind the middle of a patch that is along the track, against the pull of the sprag's force, m.
    pub behind_m: f64,
}

impl TrackPatch {
    /// Hoop stress of `race` at its track, `behind_m` from the middle of the patch, Pa, tension positive; `how` takes what the
    /// traction adds.
    pub fn hoop_pa(&self, race: &Race, behind_m: f64, how: fn(EdgeTension) -> f64) -> f64 {
        self.along(race, how)(behind_m)
    }

    fn along(&self, race: &Race, how: fn(EdgeTension) -> f64) -> impl Fn(f64) -> f64 {
        let (patch, ring) = (*self, race.track_hoop(self.count));
        let (radius_m, pitch) = (race.track_m(), TAU / self.count as f64);
        let beside = move |distance_m: f64| {
            let half_widths = (distance_m / patch.half_width_m).max(1.0);
            how(tension_behind(patch.peak_pa, patch.tan, patch.friction, half_widths))
        };
        move |behind_m| {
            let ring_pa =
                ring.at(pitch - behind_m / radius_m, patch.normal_n, patch.tan.abs() * patch.normal_n);
            // The next patch presses together what lies ahead of it.
            ring_pa + beside(behind_m) - beside(pitch * radius_m - behind_m)
        }
    }
}

/// Of `race` between the edges of `patch` and the next one; `how` says how the traction came. Under the patches the stress is the
/// contact's.
pub fn track_tension(race: &Race, patch: &TrackPatch, how: fn(EdgeTension) -> f64) -> TrackTension {
    let at = patch.along(race, how);
    let whole = TAU / patch.count as f64 * race.track_m() / patch.half_width_m;
    let places = (0..=PLACES).map(|k| {
        let half_widths = (whole - 1.0).max(1.0).powf(k as f64 / PLACES as f64);
        let behind_m = half_widths * patch.half_width_m;
        TrackTension { largest_pa: at(behind_m), behind_m }
    });
    let start = TrackTension { largest_pa: f64::NEG_INFINITY, behind_m: patch.half_width_m };
    places.fold(start, |a, b| if b.largest_pa > a.largest_pa { b } else { a })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::edge_tension;
    use crate::material::Material;

    const STEEL: Material = Material { youngs_modulus_pa: 206e9, poisson_ratio: 0.3, density_kg_m3: 7850.0 };

    fn patch(tan: f64) -> TrackPatch {
        // Table 1's clutch, 20 Nm: (2/pi) N/(a l) = p_0.
        TrackPatch { count: 12, normal_n: 1.9e3, tan, half_width_m: 0.12e-3, peak_pa: 1.68e9, friction: 0.12 }
    }

    fn either(t: EdgeTension) -> f64 {
        t.standing_pa.max(t.rolling_pa)
    }

    #[test]
    fn a_thin_ring_without_traction_is_stretched_most_midway() {
        let ring = Race::outer(19.44e-3, 22.0e-3, 6e-3, STEEL).unwrap();
        let most = track_tension(&ring, &patch(0.0), either);
        assert!((most.largest_pa / ring.hoop_between_pa(12, 1.9e3) - 1.0).abs() < 1e-3, "{most:?}");
        let half_pitch_m = TAU / 24.0 * ring.track_m();
        assert!((most.behind_m / half_pitch_m - 1.0).abs() < 0.03, "{most:?}");
    }

    #[test]
    fn traction_moves_the_most_stretched_place_to_the_edge_of_the_patch() {
        let ring = Race::outer(19.44e-3, 26.23e-3, 6e-3, STEEL).unwrap();
        let (alike, pulled) = (patch(0.0), patch(0.08));
        let most = track_tension(&ring, &pulled, |t| t.standing_pa);
        assert!((most.behind_m / pulled.half_width_m - 1.0).abs() < 1e-12, "{most:?}");
        let ring_pa = alike.hoop_pa(&ring, most.behind_m, either);
        let edge_pa = edge_tension(pulled.peak_pa, pulled.tan, pulled.friction).standing_pa;
        // What is left: the forces along the track that are farther away.
        assert!((most.largest_pa - ring_pa - edge_pa).abs() < 0.03 * edge_pa, "{most:?} {ring_pa} {edge_pa}");
    }
}
