//! The sprag between its races, to scale: the whole clutch, one sprag large, its arc centres larger still.
//!
//! # Conventions
//! Drawn frame: O below, C_e of the drawn sprag on the vertical through O; positive azimuth is clockwise on
//! the page, to the right. Body frame as in `profile`: origin C_e, y radially outward at first contact, x
//! towards positive azimuth.

mod centres;
mod clutch;
mod detail;
mod live;
mod sheet;

pub use live::{Live, live};

use crate::clutch::Clutch;
use crate::profile::{Outline, Profile, Spiral};

/// Chords of a drawn outline leave its arcs by no more than this, m.
const OUTLINE_M: f64 = 1e-6;

/// One inner arc of a drawn sprag.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DrawnArc {
    /// Radius r_ik, m.
    pub radius_m: f64,
    /// Centre C_k in the body frame, m.
    pub centre_m: [f64; 2],
    /// Turn of the contact direction at which the arc begins, rad.
    pub from_rad: f64,
    /// Turn at which it ends, rad.
    pub until_rad: f64,
}

/// The spiral that the last arcs of a drawn sprag stand for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DrawnSpiral {
    /// Place of its first arc, from 0.
    pub first: usize,
    /// Its spiral; turns and lengths as drawn.
    pub curve: Spiral,
    /// Pole in the body frame, m.
    pub pole_m: [f64; 2],
}

/// One sprag in one position.
#[derive(Debug, Clone, PartialEq)]
pub struct SpragPose {
    /// Name in the legend, e.g. `"first contact"` or the design's name.
    pub label: String,
    /// Closed outline in the body frame, m.
    pub outline_m: Vec<[f64; 2]>,
    /// Outer arc radius r_e about the body frame's origin, m.
    pub outer_radius_m: f64,
    /// Distance OC_e in this position, m.
    pub outer_centre_distance_m: f64,
    /// Rotation of the body relative to the line OC_e since first contact, rad, towards positive azimuth
    /// (engagement is positive).
    pub rotation_rad: f64,
    /// Azimuth beta_0 of C_1 ahead of C_e at first contact, rad.
    pub beta0_rad: f64,
    /// Inner arcs in order of engagement.
    pub arcs: Vec<DrawnArc>,
    /// The spiral that the last of them stand for.
    pub spiral: Option<DrawnSpiral>,
    /// Centroid G in the body frame, m.
    pub centroid_m: Option<[f64; 2]>,
    /// Pivot P of a driven cage in the body frame, m.
    pub pivot_m: Option<[f64; 2]>,
}

/// What is drawn: two races, the sprags between them, and the profiles to compare. The first pose is drawn in
/// full, the others over it as dashed outlines.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawing {
    /// Inner bore (0: solid), inner track, outer track, outer outside, m.
    pub race_radii_m: [f64; 4],
    /// Number of sprags n_s.
    pub count: usize,
    /// Poses.
    pub poses: Vec<SpragPose>,
}

impl SpragPose {
    /// A sprag at first contact at rest. `outline_m` and `centroid_m` in the body frame, m.
    pub fn at_first_contact(
        label: &str,
        profile: &Profile,
        outline_m: Vec<[f64; 2]>,
        centroid_m: Option<[f64; 2]>,
    ) -> Self {
        let drawn = |a: &crate::profile::ProfileArc| DrawnArc {
            radius_m: a.radius_m,
            centre_m: [a.centre_m.x, a.centre_m.y],
            from_rad: a.from_rad,
            until_rad: a.until_rad,
        };
        Self {
            label: label.to_owned(),
            outline_m,
            outer_radius_m: profile.outer_radius_m,
            outer_centre_distance_m: profile.outer_centre_distance_m,
            rotation_rad: 0.0,
            beta0_rad: profile.beta0_rad,
            arcs: profile.arcs.iter().map(drawn).collect(),
            spiral: None,
            centroid_m,
            pivot_m: None,
        }
    }

    /// The sprag of a clutch at first contact at rest, with its outline: the narrowest that works where the design names
    /// no flanks, and none where no flanks close the profile.
    pub fn at_rest(label: &str, clutch: &Clutch, profile: &Profile) -> Self {
        let sprags = &clutch.sprags;
        let outline = match sprags.flanks {
            Some(flanks) => Outline::closed(profile, &flanks),
            None => Outline::narrowest(profile),
        };
        let outline = outline.map(|o| o.polyline(OUTLINE_M)).unwrap_or_default();
        let spiral = sprags.spiral.and_then(|s| {
            let pole = s.pole_m(profile)?;
            let first = profile.arcs.len().saturating_sub(s.arc_count());
            Some(DrawnSpiral { first, curve: s, pole_m: [pole.x, pole.y] })
        });
        Self {
            spiral,
            pivot_m: clutch.cage.map(|cage| cage.pivot_m),
            ..Self::at_first_contact(label, profile, outline, Some(sprags.centroid_m))
        }
    }

    /// Whether arc `k` and the one before are arcs of a spiral, which needs no name there.
    fn within_spiral(&self, k: usize) -> bool {
        self.spiral.is_some_and(|s| k > s.first)
    }

    /// The same sprag in another position: body rotated by `rotation_rad` relative to the line OC_e since first
    /// contact, OC_e as given, m.
    pub fn moved(mut self, label: &str, rotation_rad: f64, outer_centre_distance_m: f64) -> Self {
        label.clone_into(&mut self.label);
        (self.rotation_rad, self.outer_centre_distance_m) = (rotation_rad, outer_centre_distance_m);
        self
    }

    /// A point of the body frame in the drawn frame (origin O, y up through C_e), m: turned by the
    /// rotation towards positive azimuth and raised by OC_e.
    pub fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (s, c) = self.rotation_rad.sin_cos();
        [x * c + y * s, y * c - x * s + self.outer_centre_distance_m]
    }

    /// Contact B on the outer race, drawn frame, m: straight outward of C_e.
    fn outer_contact_m(&self) -> [f64; 2] {
        [0.0, self.outer_centre_distance_m + self.outer_radius_m]
    }

    /// The arc that touches the inner race in this position, and the turn of its contact: A lies on the
    /// line OC_k, so turn = beta_0 + rotation - azimuth of C_k.
    fn active_arc(&self) -> Option<(&DrawnArc, f64)> {
        let turn = |arc: &DrawnArc| {
            let [x, y] = self.place(arc.centre_m);
            self.beta0_rad + self.rotation_rad - x.atan2(y)
        };
        let outside = |arc: &DrawnArc| {
            let turn = turn(arc);
            (arc.from_rad - turn).max(turn - arc.until_rad).max(0.0)
        };
        let nearest = self.arcs.iter().min_by(|a, b| outside(a).total_cmp(&outside(b)))?;
        Some((nearest, turn(nearest)))
    }

    /// Contact A on the inner race, drawn frame, m: the point of the active arc nearest to O.
    fn inner_contact_m(&self) -> Option<[f64; 2]> {
        let (arc, _) = self.active_arc()?;
        let [x, y] = self.place(arc.centre_m);
        let distance = x.hypot(y);
        let keep = 1.0 - arc.radius_m / distance;
        (distance > 0.0).then_some([x * keep, y * keep])
    }

    /// Lay the outline so that its contact with the inner race at first contact, and the direction across it, are those of `other`, which stands
    /// as it is drawn. Nothing but the outline is drawn of it then.
    pub fn lay_at_contact_of(&mut self, other: &Self) {
        let (Some(from), Some(to)) = (self.inner_contact_m(), other.inner_contact_m()) else { return };
        let (s, c) = (to[0].atan2(to[1]) - from[0].atan2(from[1])).sin_cos();
        let placed: Vec<[f64; 2]> = self.outline_m.iter().map(|&p| self.place(p)).collect();
        self.rotation_rad = 0.0;
        let laid = |[x, y]: [f64; 2]| {
            let (x, y) = (x - from[0], y - from[1]);
            // Turned towards positive azimuth, clockwise on the page.
            [to[0] + x * c + y * s, to[1] + y * c - x * s - self.outer_centre_distance_m]
        };
        self.outline_m = placed.into_iter().map(laid).collect();
    }

    /// Point of `arc` at which the contact direction has turned by `turn_rad`, body frame, m.
    fn profile_point_m(&self, arc: &DrawnArc, turn_rad: f64) -> [f64; 2] {
        let (s, c) = (self.beta0_rad - turn_rad).sin_cos();
        [arc.centre_m[0] - arc.radius_m * s, arc.centre_m[1] - arc.radius_m * c]
    }

    fn is_drawable(&self) -> bool {
        let numbers = [self.outer_radius_m, self.outer_centre_distance_m, self.rotation_rad, self.beta0_rad];
        let arcs = self
            .arcs
            .iter()
            .flat_map(|a| [a.radius_m, a.centre_m[0], a.centre_m[1], a.from_rad, a.until_rad]);
        numbers.into_iter().chain(arcs).chain(self.outline_m.iter().flatten().copied()).all(f64::is_finite)
    }
}

impl Drawing {
    /// The races of `clutch` with `poses` of its sprags.
    pub fn of(clutch: &Clutch, poses: Vec<SpragPose>) -> Self {
        let r = &clutch.races;
        let race_radii_m =
            [r.inner_bore_radius_m, r.inner_radius_m, r.outer_radius_m, r.outer_outside_radius_m];
        Self { race_radii_m, count: clutch.sprags.count, poses }
    }

    /// The whole clutch with all its sprags, small, at a scale at which a radius of `widest_m`, m, would just find room.
    pub fn small_svg(&self, widest_m: f64) -> String {
        clutch::small(self, widest_m)
    }

    /// One sprag large: outline, contacts, strut, centres, junctions, centroid, dimensions.
    pub fn detail_svg(&self) -> String {
        detail::in_window(self)
    }

    /// The same as a page has it.
    pub fn detail_figure(&self) -> String {
        detail::figure(self)
    }

    /// Front view, section and one enlarged sprag with their dimensions, at scales of ISO 5455 on paper, as a page has it.
    /// `axial_m`: width of the races and length of the sprags, m; `notes` stand below the front view.
    pub fn sheet_figure(&self, axial_m: [f64; 2], notes: &[String]) -> String {
        sheet::figure(self, axial_m, notes)
    }

    /// C_e, the arc centres and the centroid, enlarged until they can be told apart.
    pub fn centres_svg(&self) -> String {
        centres::svg(self, false)
    }

    /// The same as a page has it.
    pub fn centres_figure(&self) -> String {
        centres::figure(self)
    }

    fn drawable(&self) -> Vec<&SpragPose> {
        self.poses.iter().filter(|p| p.is_drawable()).collect()
    }
}

/// Arc number in the paper's way, `C₁`, for the usual one to nine arcs.
fn subscript(letter: &str, number: usize) -> String {
    let digits = ['₀', '₁', '₂', '₃', '₄', '₅', '₆', '₇', '₈', '₉'];
    let tail: String =
        number.to_string().chars().filter_map(|c| c.to_digit(10)).map(|d| digits[d as usize]).collect();
    format!("{letter}{tail}")
}

/// Labels spread downwards so that none covers the next: wanted heights in, heights out, in the same order.
fn spread(wanted: &[f64], pitch: f64, low: f64, high: f64) -> Vec<f64> {
    let mut order: Vec<usize> = (0..wanted.len()).collect();
    order.sort_by(|&a, &b| wanted[a].total_cmp(&wanted[b]));
    let mut placed = vec![0.0; wanted.len()];
    let mut free = low;
    for &i in &order {
        placed[i] = wanted[i].max(free);
        free = placed[i] + pitch;
    }
    // Pushed back up where the lowest would leave the figure.
    let mut limit = high;
    for &i in order.iter().rev() {
        placed[i] = placed[i].min(limit);
        limit = placed[i] - pitch;
    }
    placed
}

#[cfg(test)]
pub(crate) mod tests;
