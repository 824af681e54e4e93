//! The profile under the contact patch at A, which is about as wide as an arc is long: what a law that knows the
//! radius is given there, and where the patch lies on two arcs.
//!
//! Left out: the pressure there is not that of one arc; its peak is off by [`straddling_error`] at most, 0.11 % for
//! Table 1's radii. Its resultant lies off the contact point, towards what is curved less. Law `elastic` puts the force there
//! ([`crate::profile::Profile::approach_curvature_and_lead`]), to first order in the step of curvature
//! ([`shift_left_out`]): dC/dN then passes a junction without most of its jump. Other laws keep the force at the contact
//! point, as the paper does, and the torque curve keeps its kink.

use super::build::Effort;
use super::closure::{Closure, Statics};
use super::curve::WedgeCurve;
use crate::clutch::{Clutch, InnerArc};
use crate::contact::{LineContact, step_peak_error};
use crate::numeric::{dual::Dual, root};
use crate::profile::PatchCurvature;

/// The curvature that a law which knows the radius is given at A.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum InnerCurvature {
    /// Averaged over the patch for the approach ([`crate::profile::Profile::approach_curvature`]): delta_H passes a
    /// junction without a jump.
    Patch,
    /// That of the arc in contact, as the paper takes it: delta_H jumps at a junction and alpha is shifted there to
    /// keep N (the paper's Figure 5). For comparison. Law `elastic` moves the force within the patch all the same.
    Pointwise,
}

/// A junction under the patch at A.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Straddle {
    /// The junction lies at the end of this arc, from 0.
    pub junction: usize,
    /// N_bi at which the patch's edge reaches the junction, N.
    pub from_n: f64,
    /// N_bi at which its other edge leaves it, N; `None` where the curve ends before.
    pub until_n: Option<f64>,
}

/// By what part p_0 at A is off at most while its patch straddles a junction of `clutch`, at any load: the pressure is
/// taken for that of one arc of the mean curvature ([`step_peak_error`]). 0 for a single arc.
pub fn straddling_error(clutch: &Clutch) -> f64 {
    let curvature = |arc: &InnerArc| 1.0 / arc.radius_m + 1.0 / clutch.races.inner_radius_m;
    let junctions =
        clutch.sprags.inner_arcs.windows(2).map(|arcs| (curvature(&arcs[0]), curvature(&arcs[1])));
    junctions.map(|(a, b)| step_peak_error(a, b).max(step_peak_error(b, a))).fold(0.0, f64::max)
}

/// Largest error of tan omega, relative, from the place of the force at A where its patch straddles a junction of `curve`; 0
/// for a single arc. A law that keeps the force at the contact point misplaces it by its whole distance from there. A law
/// that moves it leaves out what is of second order in the step of curvature: a quarter of that step's share of the
/// distance (plane contact, steps to 12 %).
pub fn shift_left_out(curve: &WedgeCurve) -> f64 {
    let statics = curve.statics();
    let at = |k: usize| {
        let (_, c) = curve.closure_at_normal(curve.arc_end_n(k))?;
        let arc = curve.first_arc() + k;
        let arcs = &statics.profile.arcs;
        let (here, beyond) = (arcs.get(arc)?, arcs.get(arc + 1)?);
        let contact = at_curvature(&statics.elastic.inner_contact[arc], c.curvature_inner_per_m);
        let half_m = contact.half_width_m(c.n_bi);
        let [_, lead] = statics.profile.approach_curvature_and_lead(arc, here.until_rad, half_m);
        let off_m = lead.curvature_per_m * half_m / c.curvature_inner_per_m;
        let step = (1.0 / beyond.radius_m - 1.0 / here.radius_m) / c.curvature_inner_per_m;
        let left_m = if statics.elastic.gives_along { 0.25 * step * off_m } else { off_m };
        Some((left_m / (c.lengths.ob.v * c.beta.v.sin())).abs())
    };
    (0..curve.arc_count()).filter_map(at).fold(0.0, f64::max)
}

/// delta_H at A with the curvature behind it, while the closure settles.
pub(super) struct InnerApproach {
    pub(super) approach_m: Dual,
    /// 1/R.
    pub(super) curvature_per_m: Dual,
    /// By how much the force lies ahead of the contact point, m: 0 on one arc, and for a law that keeps it there.
    pub(super) ahead_m: Dual,
    /// d delta_H/d(1/R), m^2; `None` for a law without radius or where the arc's own is wanted.
    by_curvature_m2: Option<f64>,
}

impl InnerApproach {
    pub(super) fn new(statics: &Statics, arc: usize, n: Dual) -> Self {
        let own = Dual::constant(1.0 / statics.elastic.inner_contact[arc].effective_radius_m);
        let pointwise = Self {
            approach_m: statics.elastic.pointwise_inner(arc, n),
            curvature_per_m: own,
            ahead_m: Dual::constant(0.0),
            by_curvature_m2: None,
        };
        match statics.inner_curvature {
            InnerCurvature::Patch => Self::curved(statics, arc, n, own).unwrap_or(pointwise),
            InnerCurvature::Pointwise => pointwise,
        }
    }

    fn curved(statics: &Statics, arc: usize, n: Dual, curvature: Dual) -> Option<Self> {
        let at = statics.elastic.curved_inner(arc, n.v, curvature.v)?;
        let slope = at.by_force_m_per_n * n.d + at.by_curvature_m2 * curvature.d;
        Some(Self {
            approach_m: Dual { v: at.approach_m, d: slope },
            curvature_per_m: curvature,
            ahead_m: Dual::constant(0.0),
            by_curvature_m2: Some(at.by_curvature_m2),
        })
    }

    /// Take the curvature at the turn that the last one led to. Returns the relative changes of delta_H and of its
    /// slope.
    pub(super) fn update(
        &mut self,
        statics: &Statics,
        arc: usize,
        n: Dual,
        turn: Dual,
        half_a_step: bool,
    ) -> Dual {
        let moves = statics.elastic.gives_along;
        let edge = statics.profile.arcs[arc].radius_m == 0.0;
        if self.by_curvature_m2.is_none() && !moves || edge {
            return Dual::constant(0.0);
        }
        let contact = &statics.elastic.inner_contact[arc];
        let k = self.curvature_per_m;
        // a ~ (N R)^(1/2)
        let half = at_curvature(contact, k.v).half_width_m(n.v);
        let half_slope = 0.5 * half * (n.d / n.v - k.d / k.v);
        let slope =
            |mean: &PatchCurvature| mean.by_turn_per_m_rad * turn.d + mean.by_half_width_per_m2 * half_slope;
        let profile = &statics.profile;
        let (under, lead) = if moves {
            let [under, lead] = profile.approach_curvature_and_lead(arc, turn.v, half);
            (under, Dual { v: lead.curvature_per_m, d: slope(&lead) })
        } else {
            (profile.approach_curvature(arc, turn.v, half), Dual::constant(0.0))
        };
        let next = Dual {
            v: 1.0 / contact.effective_radius_m + (under.curvature_per_m - 1.0 / profile.arcs[arc].radius_m),
            d: slope(&under),
        };
        self.ahead_m = match moves && under.straddles {
            true => lead * Dual { v: half, d: half_slope } / next,
            false => Dual::constant(0.0),
        };
        let Some(by_curvature) = self.by_curvature_m2 else { return Dual::constant(0.0) };
        if next == k {
            return Dual::constant(0.0);
        }
        let change = Dual {
            v: (by_curvature * (next.v - k.v) / self.approach_m.v).abs(),
            d: (by_curvature * (next.d - k.d) / self.approach_m.d).abs(),
        };
        let taken = if half_a_step { (k + next) * 0.5 } else { next };
        if let Some(updated) = Self::curved(statics, arc, n, taken) {
            *self = Self { ahead_m: self.ahead_m, ..updated };
        }
        change
    }
}

pub(super) fn at_curvature(contact: &LineContact, curvature_per_m: f64) -> LineContact {
    LineContact { effective_radius_m: 1.0 / curvature_per_m, ..*contact }
}

impl Statics {
    /// The contact at A with the curvature that decides its width, and whether its patch straddles a junction: width
    /// and mean curvature under it are found together.
    pub(super) fn patch(&self, arc: usize, c: &Closure) -> (LineContact, bool) {
        let mut contact = self.elastic.inner_contact[arc];
        let turn = c.turn_rad(self.profile.beta0_rad);
        // 1/R of the race alone: what the pointwise contact has beside the arc.
        let race = 1.0 / contact.effective_radius_m - 1.0 / self.profile.arcs[arc].radius_m;
        let mut straddles = false;
        for _ in 0..20 {
            let under = self.profile.patch_curvature(arc, turn, contact.half_width_m(c.n_bi));
            let radius = 1.0 / (race + under.curvature_per_m);
            let change = (radius / contact.effective_radius_m - 1.0).abs();
            contact = LineContact { effective_radius_m: radius, ..contact };
            straddles = under.straddles;
            if change < 1e-14 {
                break;
            }
        }
        (contact, straddles)
    }

    /// Whether the approach at A, or the place of the force, feels the curvature beyond the arc in contact.
    pub(super) fn feels_junctions(&self) -> bool {
        let own = 1.0 / self.elastic.inner_contact[0].effective_radius_m;
        let by_approach =
            self.inner_curvature == InnerCurvature::Patch && self.elastic.curved_inner(0, 1.0, own).is_some();
        by_approach || self.elastic.gives_along
    }

    /// Normal forces between `n_from` and `n_until` (N) on arc `arc` at which an edge of the patch passes a junction,
    /// with the junction and whether the patch comes upon it, ascending.
    pub(super) fn edge_passages(
        &self,
        arc: usize,
        n_from: f64,
        n_until: f64,
        speed_rad_s: f64,
        shift_rad: f64,
        effort: Effort,
    ) -> Vec<(f64, usize, bool)> {
        // Forces between which each junction is looked for: a passage each way inside one of these would be missed,
        // which costs accuracy of the table and shows in its truncation.
        const PIECES: usize = 4;
        let contact = &self.elastic.inner_contact[arc];
        // Turn and half width of the patch.
        let seat = |n: f64| {
            self.closure(arc, n, speed_rad_s, shift_rad).ok().map(|c| {
                let half = at_curvature(contact, c.curvature_inner_per_m).half_width_m(n);
                (c.turn_rad(self.profile.beta0_rad), half)
            })
        };
        // Distance of the junction from the edge; positive while it lies outside the patch.
        let outside = |junction: usize, seat: Option<(f64, f64)>| {
            seat.map_or(f64::NAN, |(turn, half)| {
                self.profile.junction_distance_m(arc, turn, junction).abs() - half
            })
        };
        let force = |i: usize| {
            (n_from + (n_until - n_from) * i as f64 / PIECES as f64).max(super::closure::FIRST_CONTACT_N)
        };
        let looks: Vec<_> = (0..=PIECES).map(|i| (force(i), seat(force(i)))).collect();
        // A junction beyond one that stays outside the patch stays outside too.
        let meets = |junction: &usize| looks.iter().any(|l| outside(*junction, l.1) <= 0.0);
        let first = (0..arc).rev().take_while(meets).last().unwrap_or(arc);
        let end = (arc..self.profile.arcs.len() - 1).take_while(meets).last().map_or(arc, |last| last + 1);
        let mut found = Vec::new();
        for junction in first..end {
            for pair in looks.windows(2) {
                let (a, b) = (pair[0].0, pair[1].0);
                let (fa, fb) = (outside(junction, pair[0].1), outside(junction, pair[1].1));
                if fa * fb < 0.0
                    && let Some(n) =
                        root::bracketed(a, b, fa, fb, effort.edge_width() * b, |n| outside(junction, seat(n)))
                {
                    found.push((n, junction, fb < 0.0));
                }
            }
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        found
    }
}

impl WedgeCurve {
    /// Where the patch at A straddles a junction, in order of the junctions; whatever the law, with the half width of
    /// the curvature that the law is given.
    pub fn straddles(&self) -> Vec<Straddle> {
        let mut list: Vec<Straddle> = Vec::new();
        for k in 0..self.arc_count() {
            let (n_from, n_until) = (if k == 0 { 0.0 } else { self.arc_end_n(k - 1) }, self.arc_end_n(k));
            let passages = self.statics().edge_passages(
                self.first_arc() + k,
                n_from,
                n_until,
                self.speed_rad_s(),
                self.shift_rad(k),
                Effort::Full,
            );
            for (n, junction, comes) in passages {
                match list.iter_mut().rev().find(|s| s.junction == junction) {
                    Some(open) if !comes => open.until_n = Some(n),
                    _ if comes => list.push(Straddle { junction, from_n: n, until_n: None }),
                    // It lies under the patch from first contact on.
                    _ => list.push(Straddle { junction, from_n: 0.0, until_n: Some(n) }),
                }
            }
        }
        list.sort_by_key(|s| s.junction);
        list
    }
}
