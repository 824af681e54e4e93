//! Proportions of a first design: similar sprags for every race space.
//!
//! The maker's race space of 8.33 mm with its rules (GMN 9050) is the pattern; others are its likeness, since plane
//! elasticity knows no length of its own.

use super::Requirements;
use crate::design::{Draft, KINETIC_SHARE};

/// Race spaces tried, m: preferred numbers about the catalogue's 8.33 mm.
const SPACES_M: [f64; 7] = [2.5e-3, 4.0e-3, 6.0e-3, 8.33e-3, 12.5e-3, 18.0e-3, 25.0e-3];

/// Those of them that there are between the tracks that are asked for: between two there is one.
pub(super) fn spaces_m(wanted: &Requirements) -> Vec<f64> {
    match (wanted.inner_track_m, wanted.outer_track_m) {
        (Some(inner), Some(outer)) => vec![0.5 * (outer - inner)],
        _ => SPACES_M.to_vec(),
    }
}

/// Radii of the tracks, m, with a wall of the inner race of `wall` times that of [`WALLS`] where none is asked for.
fn tracks_m(wanted: &Requirements, space_m: f64, wall: f64) -> [f64; 2] {
    let bore = 0.5 * wanted.bore_m;
    match (wanted.inner_track_m, wanted.outer_track_m) {
        (Some(inner), _) => [0.5 * inner, 0.5 * inner + space_m],
        (None, Some(outer)) => [0.5 * outer - space_m, 0.5 * outer],
        (None, None) => {
            let track = bore + wall * (WALLS.0 * wanted.bore_m).max(WALLS.1 * space_m);
            [track, track + space_m]
        }
    }
}

/// Fewest and most sprags.
pub(super) const COUNTS: (usize, usize) = (8, 120);

/// Length of a sprag over the race space, least and most: one shorter than it is high tilts between the races (the
/// catalogue's are 1.56 to 2.64), beyond 3 the load along it is anybody's guess.
pub(super) const LENGTHS: (f64, f64) = (1.0, 3.0);

/// r_e and r_i1 over the race space: their sum makes tan omega all but constant along the profile, their ratio leaves both
/// contacts near the same pressure as the series that the catalogue's torques identify.
const ARCS: (f64, f64) = (0.66, 0.35);

/// Pitch at mid-gap over the race space, from the catalogue's weights (8.0 of 8.33 mm).
const PITCH: f64 = 0.96;

/// mu_s over tan omega at first contact: 10 % of slip margin, as much again for growth under load, and below mu_c.
const RESERVE: f64 = 1.25;

// First contact must grip with kinetic friction.
const _: () = assert!(KINETIC_SHARE > 1.0 / RESERVE);

/// Inner race's wall over the bore, and over the race space at least.
const WALLS: (f64, f64) = (0.15, 0.5);

/// Inner wall over that of [`WALLS`] that is tried: thicker rings where bending between the sprags decides.
pub(super) const THICKER: [f64; 3] = [1.0, 1.2, 1.4];

/// Normal force of the spring on a sprag in slow overrun, N, at a race space of 8.33 mm: Table 1's 1.25 N rounded up.
const SPRING_N: f64 = 1.5;

/// Races wider than the sprags, over the race space: 3 mm of 8.33.
const WIDER: f64 = 0.36;

/// Outside over outer track that is tried, the catalogue's first: thinner rings where stresses and growth allow.
pub(super) const OUTSIDES: [f64; 4] = [1.4, 1.33, 1.27, 1.22];

/// Steps of the radii outside and of the arcs, m: what a shop puts on a drawing.
const RING_STEP_M: f64 = 1e-4;
const ARC_STEP_M: f64 = 5e-6;

/// To the nearest multiple of `step_m`.
fn to_step(m: f64, step_m: f64) -> f64 {
    (m / step_m).round() * step_m
}

/// Longest sprags, m: of the race space, or of the width asked for.
pub(super) fn longest_m(wanted: &Requirements, space_m: f64) -> f64 {
    let most = LENGTHS.1 * space_m;
    wanted.width_m.map_or(most, |width| most.min(width - wider_m(space_m)))
}

/// By how much the races are wider than the sprags, m, to a tenth of a millimetre.
fn wider_m(space_m: f64) -> f64 {
    (WIDER * space_m * 1e4).round() / 1e4
}

/// Sprags at first contact between races with the race space `space_m`, walls of [`THICKER`] and [`OUTSIDES`], the profile's
/// end and flanks still open.
pub(super) fn draft(wanted: &Requirements, space_m: f64, [wall, outside]: [f64; 2]) -> Draft {
    let bore = 0.5 * wanted.bore_m;
    let [track, outer] = tracks_m(wanted, space_m, wall);
    let outside = to_step(outside * outer, RING_STEP_M);
    let outside = wanted.outside_m.map_or(outside, |d| outside.min(0.5 * d));
    let (r_e, r_i) = (to_step(ARCS.0 * space_m, ARC_STEP_M), to_step(ARCS.1 * space_m, ARC_STEP_M));
    let count = (std::f64::consts::PI * (track + outer) / (PITCH * space_m)).floor() as usize;
    let mut draft = Draft {
        name: "sizing".to_owned(),
        why: Vec::new(),
        count,
        length_m: LENGTHS.1 * space_m,
        outer_radius_m: r_e,
        inner_radius_m: r_i,
        centre_distance_m: centre_distance_m(track, outer, r_i, r_e, wanted.friction / RESERVE),
        until_rad: 1.2,
        flanks_m: None,
        pivot_m: wanted.carried.then(|| pivot_m(track, outer, r_e, wanted.friction / RESERVE)),
        races_m: [bore, track, outer, outside],
        width_m: 0.0,
        spring_nm_per_rad: 0.0,
        drag_nm: 0.0,
        sliding_rad_s: wanted.sliding_rad_s(),
        steel: wanted.steel,
        friction: wanted.friction,
        friction_from: wanted.from[0],
        torques_nm: [wanted.torque_nm, wanted.peak_nm],
        torques_from: [wanted.from[1], wanted.from[2]],
        gaps_m: [8.46, 8.60].map(|gap| gap / 8.33 * space_m),
        contact_from: wanted.contact_from,
        inner_inertia_kg_m2: None,
        contact_rad_s: [wanted.keep_contact_rad_s.filter(|&w| w > 0.0), wanted.lift_off_rad_s],
        // The clutch carries torque below the speed by which the sprags are off.
        speed_rad_s: wanted.keep_contact_rad_s.unwrap_or(0.0),
        step_duration_s: 0.02,
        abutment_nm_per_rad: 10.0 * wanted.torque_nm,
        scenes: Vec::new(),
        engagements: wanted.engagements,
    };
    lengthen(&mut draft, longest_m(wanted, space_m));
    spring(&mut draft, SPRING_N * (space_m / 8.33e-3).powi(2));
    draft
}

/// Length of the sprags and all that goes with it: races wider than they are.
pub(super) fn lengthen(draft: &mut Draft, length_m: f64) {
    let [_, track, outer, _] = draft.races_m;
    draft.length_m = length_m;
    draft.width_m = length_m + wider_m(outer - track);
}

/// A spring that presses each sprag with `normal_n` in slow overrun: drag by a coefficient of 0.1, and the stiffness with
/// which Table 1's spring has its free angle of 0.145 rad, in proportion to force and race space.
pub(super) fn spring(draft: &mut Draft, normal_n: f64) {
    let [_, track, outer, _] = draft.races_m;
    draft.drag_nm = 0.1 * draft.count as f64 * normal_n * track;
    draft.spring_nm_per_rad = 0.01 * normal_n / 1.245 * (outer - track) / 8.33e-3;
}

/// Pivot of a driven cage: its azimuth over that of C_1, ahead of C_e, and its depth below C_e over the race space. A choice, some way from
/// either end: behind the centroid, so that speed lifts the sprags off; ahead of C_e, so that play in the pocket tilts them by little; as
/// deep as in `designs/lift-off-inner.toml`, so that they come back at the speed at which they lift off.
const PIVOT: [f64; 2] = [0.3, 0.035];

/// Pivot (x, y) from C_e, m.
fn pivot_m(inner_m: f64, outer_m: f64, r_e: f64, tan: f64) -> [f64; 2] {
    let y = -PIVOT[1] * (outer_m - inner_m);
    let azimuth = PIVOT[0] * beta(inner_m, outer_m, tan);
    [to_step((outer_m - r_e + y) * azimuth.tan(), ARC_STEP_M), to_step(y, ARC_STEP_M)]
}

/// e_1 for which tan omega at first contact is `tan`.
///
/// e_1 closes triangle (9) of the centres, R_i + r_i and R_e - r_e from O under beta.
fn centre_distance_m(inner_m: f64, outer_m: f64, r_i: f64, r_e: f64, tan: f64) -> f64 {
    let beta = beta(inner_m, outer_m, tan);
    let (a, b) = (inner_m + r_i, outer_m - r_e);
    (a * a + b * b - 2.0 * a * b * beta.cos()).sqrt()
}

/// beta at first contact, rad, for which tan omega is `tan`: tan omega = R_e sin beta/(R_e cos beta - R_i) gives
/// sin(omega - beta) = sin omega R_i/R_e.
fn beta(inner_m: f64, outer_m: f64, tan: f64) -> f64 {
    let omega = tan.atan();
    omega - (omega.sin() * inner_m / outer_m).asin()
}
