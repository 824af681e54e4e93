//! The sprag and the tracks that wear leaves, as a clutch.

use super::Wear;
use crate::clutch::{Cage, Clutch, InnerArc};
use crate::design::Design;
use crate::lubrication::flat_depth_m;
use crate::margin::LoadState;
use crate::numeric::root;
use crate::profile::Profile;
use nalgebra::Vector2;

/// Radius of the edge of a flat, as a part of that of its arc: a choice; a sharp edge would be worn blunt itself.
pub const BLUNT: f64 = 0.005;
/// The same for a law that knows the radius, whose patch does not settle on a sharper edge: life until slip is some 17 % longer by it
/// (`designs/lubricated.toml` with either). [`super::WornLife::sharp_share`] says what it would be.
pub const BLUNT_BY_RADIUS: f64 = 0.05;
/// A clutch that has worn.
#[derive(Debug, Clone)]
pub struct Worn {
    /// The clutch with arcs, tracks and centroid as they are then, in the body frame of its own first contact; without flanks. Worn outside: once
    /// the contact has left the edge of the flat.
    pub clutch: Clutch,
    /// Depth of the flat, m, and half its width.
    pub flat_m: [f64; 2],
    /// By how much the sprags lie further in engagement at first contact (alpha), rad: the spring is relaxed by that.
    pub turned_rad: f64,
    /// Where a cage carries the sprags, so that they wear outside.
    pub outside: Option<WornOutside>,
}

/// What sprags have worn into that slide on the outer race.
#[derive(Debug, Clone)]
pub struct WornOutside {
    /// As they stand in overrun, on the flat: an outer arc smaller by its depth about the same centre, the pivot with what clearance is left.
    pub seated: Clutch,
    /// What is left of the clearance outside the pivot, m; below 0 the cage keeps them off the outer race.
    pub clearance_m: f64,
    /// On the front edge of the flat, and by how much the contact direction turns there until the edge is left, rad; `None` without a flat.
    pub edge: Option<(Clutch, f64)>,
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
    let outside = clutch.slides_outside();
    if *wear == Wear::default() {
        let unworn =
            |cage: Cage| WornOutside { seated: clutch.clone(), clearance_m: cage.clearance_m, edge: None };
        return Some(Worn {
            clutch: clutch.clone(),
            flat_m: [0.0; 2],
            turned_rad: 0.0,
            outside: clutch.cage.map(unworn),
        });
    }
    let profile = &state.profile;
    let inner_m = clutch.races.inner_radius_m - wear.inner_track_m;
    let outer_m = clutch.races.outer_radius_m + wear.outer_track_m;
    let between = Between { clutch, profile, inner_m, outer_m };
    let round =
        Round { centre_m: Vector2::zeros(), radius_m: clutch.sprags.outer_radius_m - wear.outer_arc_m };
    let arcs = between.arcs(wear.inner_arcs_m);
    // Where the profile without its flat would touch, and the flat there.
    let relative_m = match outside {
        false => 1.0 / (1.0 / arcs.first()?.radius_m + 1.0 / inner_m),
        true => 1.0 / (1.0 / round.radius_m - 1.0 / outer_m),
    };
    let deep_m = flat_depth_m(wear.sprag_m3, relative_m, clutch.contact_length_m(), 0.0);
    let half_m = (2.0 * relative_m * deep_m).sqrt();
    let flat_m = [deep_m, half_m];
    // Room below the drawn first contact for rounding.
    let room = -1e-3;
    if outside {
        let on_flat = Round { radius_m: round.radius_m - deep_m, ..round };
        let touch = between.touches(&arcs, on_flat, room, 0.0)?;
        let (seated, turned_rad, up) = between.clutch_at(&arcs, on_flat, touch, state);
        let pivot_m = |of: &Clutch, centre_m: f64| {
            of.cage.map_or(0.0, |cage| cage.pivot_m[0].hypot(centre_m + cage.pivot_m[1]))
        };
        let drawn_m = pivot_m(clutch, profile.outer_centre_distance_m);
        let clearance_m = clutch.cage?.clearance_m + drawn_m - pivot_m(&seated, outer_m - on_flat.radius_m);
        let cage = seated.cage.map(|cage| Cage { clearance_m: clearance_m.max(0.0), ..cage });
        let seated = Clutch { cage, ..seated };
        let edge = if half_m > 0.0 {
            // Engaging, B goes back along the outer arc.
            let back = up.x.atan2(up.y) - half_m / round.radius_m;
            let way = Vector2::new(back.sin(), back.cos());
            let radius_m = blunt * round.radius_m;
            let edge = Round { centre_m: (round.radius_m - radius_m) * way, radius_m };
            let touch = between.touches(&arcs, edge, touch.1 - 2.0 * half_m / relative_m, 0.0)?;
            let (on_edge, _, up) = between.clutch_at(&arcs, edge, touch, state);
            Some((on_edge, up.x.atan2(up.y) - back))
        } else {
            None
        };
        let touch = between.touches(&arcs, round, room, 0.0)?;
        let (clutch, ..) = between.clutch_at(&arcs, round, touch, state);
        let outside = Some(WornOutside { seated, clearance_m, edge });
        return Some(Worn { clutch, flat_m, turned_rad, outside });
    }
    let (k, touch_rad) = between.touches(&arcs, round, room, deep_m)?;
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
        let centre_m = arc.centre_m + (arc.radius_m - blunt_m) * profile.contact_direction(edge_rad);
        list.push(Arc { radius_m: blunt_m, centre_m, until_rad: edge_rad });
        list.extend(&arcs[edge_k..]);
        from = edge_rad - 2.0 * half_m / relative_m;
    } else {
        list.extend(&arcs[k..]);
    }
    let touch = between.touches(&list, round, from, 0.0)?;
    let (clutch, turned_rad, _) = between.clutch_at(&list, round, touch, state);
    Some(Worn { clutch, flat_m, turned_rad, outside: None })
}

/// What of a sprag touches the outer race, in the drawn body frame.
#[derive(Clone, Copy)]
struct Round {
    centre_m: Vector2<f64>,
    radius_m: f64,
}

/// A rigid sprag of a drawn `profile` between rigid tracks.
struct Between<'a> {
    clutch: &'a Clutch,
    profile: &'a Profile,
    inner_m: f64,
    outer_m: f64,
}

impl Between<'_> {
    /// The drawn inner arcs with the support h_0 + h_1 t taken off: points move by -h n - h' n', radii by -h (h'' = 0; h is its mean over
    /// the arc).
    fn arcs(&self, [h_0, h_1]: [f64; 2]) -> Vec<Arc> {
        // The outward normal and the tangent in the sense of rising turn.
        let normal = |turn: f64| self.profile.contact_direction(turn);
        let along = |turn: f64| self.profile.way(turn);
        let mut begins = 0.0;
        let mut arcs: Vec<Arc> = Vec::new();
        for arc in &self.profile.arcs {
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
        arcs
    }

    /// The arc and the turn, from `from` on, at which the sprag touches both tracks, `deep_m` overlapping inside.
    fn touches(&self, arcs: &[Arc], outer: Round, from: f64, deep_m: f64) -> Option<(usize, f64)> {
        // How far the centre of what touches outside is from the axis, less what there is.
        let oc_e = self.outer_m - outer.radius_m;
        let miss = |arc: &Arc, turn: f64| {
            let axis =
                arc.centre_m + (self.inner_m + arc.radius_m - deep_m) * self.profile.contact_direction(turn);
            (axis - outer.centre_m).norm() - oc_e
        };
        let mut a = from;
        for (k, arc) in arcs.iter().enumerate() {
            let (fa, fb) = (miss(arc, a), miss(arc, arc.until_rad));
            if fa <= 0.0 && fb >= 0.0 {
                return root::bracketed(a, arc.until_rad, fa, fb, 1e-15, |t| miss(arc, t)).map(|t| (k, t));
            }
            a = arc.until_rad;
        }
        None
    }

    /// The clutch of sprags that touch so, in the body frame of that contact, by how much alpha is larger there than at that of the drawn
    /// `state`, and where outward is in the drawn frame.
    fn clutch_at(
        &self,
        arcs: &[Arc],
        outer: Round,
        (k, turn): (usize, f64),
        state: &LoadState,
    ) -> (Clutch, f64, Vector2<f64>) {
        let sprags = &self.clutch.sprags;
        let arc = arcs[k];
        // The axis from the centre of what touches outside, which is the origin of the new body frame.
        let touching = arc.centre_m - outer.centre_m;
        let axis = touching + (self.inner_m + arc.radius_m) * self.profile.contact_direction(turn);
        let up = -axis / axis.norm();
        let azimuth = up.x.atan2(up.y);
        let (sin, cos) = azimuth.sin_cos();
        let placed = |[x, y]: [f64; 2]| {
            let v = [x - outer.centre_m.x, y - outer.centre_m.y];
            [v[0] * cos - v[1] * sin, v[0] * sin + v[1] * cos]
        };
        // The body has turned by -azimuth against the line to that centre; against OG by gamma more.
        let seen = |from: Vector2<f64>| from.x.atan2(from.y);
        let centroid = Vector2::from(sprags.centroid_m) - outer.centre_m;
        let gamma = seen(-axis) - seen(centroid - axis);
        let mut out = self.clutch.clone();
        out.races.inner_radius_m = self.inner_m;
        out.races.outer_radius_m = self.outer_m;
        out.sprags.outer_radius_m = outer.radius_m;
        out.sprags.centre_distance_m = touching.norm();
        out.sprags.centroid_m = placed(sprags.centroid_m);
        out.sprags.flanks = None;
        out.sprags.spiral = None;
        out.sprags.inner_arcs = arcs[k..]
            .iter()
            .map(|a| InnerArc { radius_m: a.radius_m, until_rad: a.until_rad - turn })
            .collect();
        out.cage = self.clutch.cage.map(|cage| Cage { pivot_m: placed(cage.pivot_m), ..cage });
        (out, -azimuth + gamma - state.curve.statics().gamma0_rad(), up)
    }
}
