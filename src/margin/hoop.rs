//! Hoop stress of the races: Lame's mean and with the bending between the sprags.

use super::load::{LoadCase, LoadState};
use crate::clutch::TrackRun;
use crate::design::Design;
use crate::race::{Race, Rim};
use crate::wedge::StaticPoint;

/// A race.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Which {
    Inner,
    Outer,
}

/// Hoop stress with what the fits and, of the outer race, the curve's speed add, Pa: the mean, or with the `bending` of the ring; of the inner race as a magnitude.
///
/// A fitted race is one piece with its partner, so the load's share is Lame's of that piece, at the race's joint and at
/// its track, and the fit's own stress is added at each place. The larger magnitude counts, loaded or at rest: a shaft
/// stretches the inner race most without load. Bending adds what it adds without a fit.
pub(super) fn hoop_pa(case: &LoadCase, p: &StaticPoint, which: Which, bending: bool) -> f64 {
    let (elastic, count) = (case.elastic(), case.count());
    let (race, normal_n) = match which {
        Which::Inner => (&elastic.inner_race, p.normal_inner_n),
        Which::Outer => (&elastic.outer_race, p.normal_outer_n),
    };
    let mean = match which {
        Which::Inner => {
            let bore = race.hoop_at_bore_pa(count, normal_n).abs();
            bore.max(race.hoop_at_track_pa(count, normal_n).abs())
        }
        Which::Outer => {
            let track = race.hoop_at_track_pa(count, normal_n);
            match race.rim() {
                Rim::Free => track,
                Rim::Held => {
                    track.abs().max(race.hoop_at_radius_pa(count, normal_n, race.other_rim_m()).abs())
                }
            }
        }
    };
    let plain = if bending { race.hoop_with_bending_pa(count, normal_n).abs() } else { mean };
    let fitted = case.design.clutch.running.as_ref().map(|running| match which {
        Which::Inner => &running.inner,
        Which::Outer => &running.outer,
    });
    // Of rotation, which stretches; the inner race is pressed together by its load.
    let spun = match which {
        Which::Inner => 0.0,
        Which::Outer => race.rotating_bore_hoop_pa(case.state.curve.speed_rad_s()),
    };
    spun + match fitted.filter(|track| track.joint_pressure_pa != 0.0) {
        None => plain,
        Some(track) => fitted_pa(track, race, count, normal_n) + (plain - mean),
    }
}

/// Hoop stress with bending between the sprags of the inner and the outer race in the static state `p`, Pa, magnitudes.
pub fn rings_pa(design: &Design, state: &LoadState, p: &StaticPoint) -> [f64; 2] {
    let case = LoadCase { design, limits: &design.limits, state };
    [Which::Inner, Which::Outer].map(|which| hoop_pa(&case, p, which, true))
}

/// Hoop stress with bending between the sprags of the inner (0) or the outer race (1), with its sign, Pa, tension positive, at the places
/// where it may be worst: track and joint of a fitted race, else the worst place of the ring twice. `p`: the static state,
/// none at rest, where the fit's own stress is left.
pub fn ring_places_pa(design: &Design, state: &LoadState, race: usize, p: Option<&StaticPoint>) -> [f64; 2] {
    let case = LoadCase { design, limits: &design.limits, state };
    let (elastic, count, running) = (case.elastic(), case.count(), design.clutch.running.as_ref());
    let (ring, normal_n, track) = match race {
        0 => (&elastic.inner_race, p.map_or(0.0, |p| p.normal_inner_n), running.map(|r| &r.inner)),
        _ => (&elastic.outer_race, p.map_or(0.0, |p| p.normal_outer_n), running.map(|r| &r.outer)),
    };
    let bending = ring.hoop_with_bending_pa(count, normal_n);
    match track.filter(|track| track.joint_pressure_pa != 0.0) {
        None => [bending; 2],
        Some(track) => {
            let more = bending - ring.hoop_at_bore_pa(count, normal_n);
            [(ring.track_m(), track.hoop_at_track_pa), (track.joint_m, track.hoop_at_joint_pa)]
                .map(|(at_m, fit_pa)| fit_pa + ring.hoop_at_radius_pa(count, normal_n, at_m) + more)
        }
    }
}

fn fitted_pa(track: &TrackRun, race: &Race, count: usize, normal_n: f64) -> f64 {
    let places = [(race.track_m(), track.hoop_at_track_pa), (track.joint_m, track.hoop_at_joint_pa)];
    let worst = |(at_m, fit_pa): (f64, f64)| {
        fit_pa.abs().max((fit_pa + race.hoop_at_radius_pa(count, normal_n, at_m)).abs())
    };
    places.into_iter().map(worst).fold(0.0, f64::max)
}
