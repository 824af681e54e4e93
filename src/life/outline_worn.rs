//! The sprag and the tracks that wear leaves, as a clutch.

use super::Wear;
use crate::clutch::{Clutch, InnerArc};
use crate::design::Design;
use crate::lubrication::flat_depth_m;
use crate::margin::LoadState;
use crate::numeric::root;
use nalgebra::Vector2;

/// Radius of the edge of a flat, as a part of that of its arc: a choice; a sharp edge would be worn blunt itself.
pub const BLUNT: f64 = 0.005;
/// The same for a law that knows the radius, whose patch does not settle on a sharper edge: life until slip is some 17 % longer by it
/// (`designs/lubricated.toml` with either). [`super::WornLife::sharp_share`] says what it would be.
pub const BLUNT_BY_RADIUS: f64 = 0.05;
/// A clutch that has worn.
#[derive(Debug, Clone)]
pub struct Worn {
    /// The clutch with arcs, tracks and centroid as they are then, in the body frame of its own first contact; without flanks.
    pub clutch: Clutch,
    /// Depth of the flat, m, and half its width.
    pub flat_m: [f64; 2],
    /// By how much the sprags lie further in engagement at first contact (alpha), rad: the spring is relaxed by that.
    pub turned_rad: f64,
}

/// Radius of the edge of a flat of `clutch`, as a part of that of its arc.
pub(super) fn blunt_of(clutch: &Clutch) -> f64 {
    if clutch.contact.facts().knows_radius { BLUNT_BY_RADIUS } else { BLUNT }
}

/// An arc of the worn profile in the drawn body frame.
#[derive(Clone, Copy)]
struct Arc {
    radius_m: f64,
    centre_m: Vector2<f64>,
    /// Turn of the contact direction at which it ends, rad.
    until_rad: f64,
}

/// `design`'s clutch with `wear`; `None` where the sprags no longer span the gap.
pub fn worn(design: &Design, state: &LoadState, wear: &Wear) -> Option<Worn> {
    worn_with(design, state, wear, blunt_of(&design.clutch))
}

pub(super) fn worn_with(design: &Design, state: &LoadState, wear: &Wear, blunt: f64) -> Option<Worn> {
    let clutch = &design.clutch;
    if *wear == Wear::default() {
        return Some(Worn { clutch: clutch.clone(), flat_m: [0.0; 2], turned_rad: 0.0 });
    }
    let profile = &state.profile;
    let (races, sprags) = (&clutch.races, &clutch.sprags);
    let inner_m = races.inner_radius_m - wear.inner_track_m;
    let outer_m = races.outer_radius_m + wear.outer_track_m;
    let outer_arc_m = sprags.outer_radius_m - wear.outer_arc_m;
    let oc_e = outer_m - outer_arc_m;
    // The outward normal and the tangent in the sense of rising turn.
    let normal = |turn: f64| profile.contact_direction(turn);
    let along = |turn: f64| profile.way(turn);
    let [h_0, h_1] = wear.inner_arcs_m;
    // The support h_0 + h_1 t is taken off: points move by -h n - h' n', radii by -h (h'' = 0; h is its mean over the arc).
    let mut begins = 0.0;
    let mut arcs: Vec<Arc> = Vec::new();
    for arc in &profile.arcs {
        let mean = h_0 + h_1 * 0.5 * (begins + arc.until_rad);
        let at_begin = (h_0 + h_1 * begins) * normal(begins) + h_1 * along(begins);
        let start = arc.centre_m + arc.radius_m * normal(begins) - at_begin;
        let radius_m = arc.radius_m - mean;
        let centre_m = match arcs.last() {
            None => start - radius_m * normal(begins),
            Some(last) => last.centre_m + (last.radius_m - radius_m) * normal(begins),
        };
        arcs.push(Arc { radius_m, centre_m, until_rad: arc.until_rad });
        begins = arc.until_rad;
    }
    // Rigid sprags between rigid tracks, `deep_m` overlapping inside: OC_e of the contact at `turn` on an arc, less what there is.
    let miss = |arc: &Arc, turn: f64, deep_m: f64| {
        (arc.centre_m + (inner_m + arc.radius_m - deep_m) * normal(turn)).norm() - oc_e
    };
    let touches = |arcs: &[Arc], from: f64, deep_m: f64| {
        let mut a = from;
        for (k, arc) in arcs.iter().enumerate() {
            let (fa, fb) = (miss(arc, a, deep_m), miss(arc, arc.until_rad, deep_m));
            if fa <= 0.0 && fb >= 0.0 {
                return root::bracketed(a, arc.until_rad, fa, fb, 1e-15, |t| miss(arc, t, deep_m))
                    .map(|t| (k, t));
            }
            a = arc.until_rad;
        }
        None
    };
    // Where the profile without its flat would touch, and the flat there.
    let first = arcs.first().copied()?;
    let relative_m = 1.0 / (1.0 / first.radius_m + 1.0 / inner_m);
    let deep_m = flat_depth_m(wear.sprag_m3, relative_m, clutch.contact_length_m(), 0.0);
    let half_m = (2.0 * relative_m * deep_m).sqrt();
    // Room below the drawn first contact for rounding.
    let (k, touch_rad) = touches(&arcs, -1e-3, deep_m)?;
    let mut list: Vec<Arc> = Vec::new();
    let mut from = touch_rad;
    if half_m > 0.0 {
        // The front edge of the flat: half_m further along the arcs.
        let (mut left_m, mut edge_k, mut edge_rad) = (half_m, k, touch_rad);
        loop {
            let arc = arcs.get(edge_k)?;
            let until = edge_rad + left_m / arc.radius_m;
            if until < arc.until_rad {
                edge_rad = until;
                break;
            }
            left_m -= (arc.until_rad - edge_rad) * arc.radius_m;
            (edge_k, edge_rad) = (edge_k + 1, arc.until_rad);
        }
        let arc = arcs[edge_k];
        let blunt_m = blunt * arc.radius_m;
        let centre_m = arc.centre_m + (arc.radius_m - blunt_m) * normal(edge_rad);
        list.push(Arc { radius_m: blunt_m, centre_m, until_rad: edge_rad });
        list.extend(&arcs[edge_k..]);
        from = edge_rad - 2.0 * half_m / relative_m;
    } else {
        list.extend(&arcs[k..]);
    }
    let (k, turn) = touches(&list, from, 0.0)?;
    let arc = list[k];
    // The axis in the body frame: C_e is its origin.
    let axis = arc.centre_m + (inner_m + arc.radius_m) * normal(turn);
    let up = -axis / axis.norm();
    let azimuth = up.x.atan2(up.y);
    let (sin, cos) = azimuth.sin_cos();
    let turned = |v: [f64; 2]| [v[0] * cos - v[1] * sin, v[0] * sin + v[1] * cos];
    // The body has turned by -azimuth against the line OC_e; against OG by gamma more.
    let drawn = &state.curve;
    let seen = |from: Vector2<f64>| from.x.atan2(from.y);
    let gamma = seen(-axis) - seen(Vector2::from(sprags.centroid_m) - axis);
    let mut out = clutch.clone();
    out.races.inner_radius_m = inner_m;
    out.races.outer_radius_m = outer_m;
    out.sprags.outer_radius_m = outer_arc_m;
    out.sprags.centre_distance_m = arc.centre_m.norm();
    out.sprags.centroid_m = turned(sprags.centroid_m);
    out.sprags.flanks = None;
    out.sprags.spiral = None;
    out.sprags.inner_arcs =
        list[k..].iter().map(|a| InnerArc { radius_m: a.radius_m, until_rad: a.until_rad - turn }).collect();
    Some(Worn {
        clutch: out,
        flat_m: [deep_m, half_m],
        turned_rad: -azimuth + gamma - drawn.statics().gamma0_rad(),
    })
}
