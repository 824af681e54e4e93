//! Static equilibrium of one sprag at a given inner normal force: the only static iteration of the project.

use super::build::Effort;
use super::bulk::Bulk;
use super::curve::NoCurve;
use super::elastic::{Elastic, NoElastic};
use super::off_centre::turned;
use super::patch::{InnerApproach, InnerCurvature};
use crate::clutch::{Carrier, Clutch};
use crate::kinematics::{self, Deformations, Lengths, Radii};
use crate::numeric::dual::Dual;
use crate::profile::{Profile, ProfileArc};
use nalgebra::Vector2;
use std::f64::consts::TAU;
use std::sync::Arc;

/// Smallest normal force at which a closure is evaluated, N: stands for first contact, where the roller law's
/// slope is infinite.
pub const FIRST_CONTACT_N: f64 = 1e-120;

/// Steps in which the centres may come too close on the way, near the highest place.
const UPRIGHT_ROUNDS: usize = 30;
/// Rounds at most, and from which on the curvature under the patch takes half a step: over the edge of a flat it goes to and fro with
/// the width of the patch for ever otherwise. A handful of rounds suffices elsewhere.
const ROUNDS: usize = 200;
const HALVED_FROM: usize = 60;

#[cfg(test)]
thread_local! {
    /// Closures of this thread.
    pub(super) static CLOSURES: std::cell::Cell<usize> = const { std::cell::Cell::new(0) };
}

/// Why there is no equilibrium.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NoClosure {
    /// The centres have come too close: the sprag has rolled over.
    RolledOver,
    /// The coupling of N_be, or that of the approach at A with the curvature under it, did not settle.
    NoConvergence {
        /// Last relative change of N_be or of the approach, whichever is larger.
        residual: f64,
    },
}

/// Equilibrium at N_bi; every `Dual` carries its derivative by N_bi at fixed arc and speed.
#[derive(Debug, Clone, Copy)]
pub struct Closure {
    /// Normal force at A, N.
    pub n_bi: f64,
    /// Normal force at B, N.
    pub n_be: Dual,
    /// Tangential force at A that equilibrium demands, N.
    pub t_bi: Dual,
    /// T_bi at N_bi = 0 (only the centrifugal force acts), N, and its rise per N_bi: t_bi = offset + ratio N_bi.
    pub t_offset_n: f64,
    /// Pure number, OB sin(beta)/(OB cos(beta) - OA).
    pub t_ratio: f64,
    /// Its derivative by N_bi, 1/N.
    pub t_ratio_slope_per_n: f64,
    /// Tangential force at B, N.
    pub t_be: Dual,
    /// Lengths of (8).
    pub lengths: Lengths,
    /// Deformations behind them.
    pub deformations: Deformations,
    /// Effective curvature 1/R that the approach at A knows, 1/m; for a law that knows none, that of the arc.
    pub curvature_inner_per_m: f64,
    /// By how much the force at A lies ahead of the contact point in the sense of rising azimuth, m: on arcs of unlike
    /// curvature, near a flank, and between unlike bodies (what B asks for included). 0 for a law that keeps it there.
    pub force_ahead_m: f64,
    /// beta, rad, of the contact point.
    pub beta: Dual,
    /// gamma, rad, signed.
    pub gamma: Dual,
    /// OC_g, m.
    pub oc_g: Dual,
    /// Body rotation against the line OC_e since first contact at rest, rad.
    pub rotation: Dual,
    /// alpha, body rotation against the line OG since first contact at rest, rad.
    pub alpha: Dual,
    /// Axis of the inner race against that of the outer: along OC_e, and across it, m. [0, 0]: concentric.
    pub offset_m: [Dual; 2],
    /// By how much the race that carries the offset has turned against the line OC_e since first contact at rest between
    /// concentric races, rad.
    pub carried_rad: f64,
    /// By how much the contacts at A and at B give along the tracks as N_bi grows, m/N; 0 for a law that lets them give
    /// across alone.
    pub give_m_per_n: [f64; 2],
}

impl Closure {
    /// Turn of the contact direction in the body since first contact at rest, rad.
    pub fn turn_rad(&self, beta0: f64) -> f64 {
        self.rotation.v - (self.beta.v - beta0)
    }

    /// Torque of the clutch with `count` sprags, N m: C = n_s T_bi OA.
    ///
    /// Eq. (A.8): the printed form has h_i N_bi where (13a) at rest gives h_i N_bi - h_e N_be; with that, and
    /// with the corrected rolling ratios, both say the same (test `printed_and_corrected_a8`).
    #[doc(alias = "Eq. (A.8)")]
    pub fn torque_nm(&self, count: usize) -> Dual {
        self.t_bi * self.lengths.oa * count as f64
    }

    /// OC_g' = d OC_g/d alpha, m/rad.
    pub fn oc_g_slope(&self) -> f64 {
        self.oc_g.d / self.alpha.d
    }

    /// Rolling ratios rho_i, rho_e.
    pub fn rolling_ratios(&self) -> (f64, f64) {
        let (rho_i, rho_e) = kinematics::rolling_ratios(
            self.lengths.oa.v,
            self.lengths.ob.v,
            self.oc_g.v,
            self.oc_g_slope(),
            self.beta.v + self.gamma.v,
            self.gamma.v,
        );
        let [give_i, give_e] = self.give_rad_per_n();
        let (rho_i, rho_e) = (rho_i + give_i / self.alpha.d, rho_e + give_e / self.alpha.d);
        match self.offset_m.map(|o| o.v) {
            [0.0, 0.0] => (rho_i, rho_e),
            // Against OG the offset moves by itself: only the sum has a meaning, the windup's.
            _ => (self.windup_slope() / self.alpha.d - rho_e, rho_e),
        }
    }

    /// d windup / d N_bi, rad/N, with C_e as the reference point, so that no centroid enters:
    /// OA dtheta_bi = dOmega (OA - OC_e cos beta) - sin beta dOC_e, OB dtheta_be = dOmega (OB - OC_e).
    pub fn windup_slope(&self) -> f64 {
        let l = &self.lengths;
        let (sin_b, cos_b) = self.beta.v.sin_cos();
        // The point of the sprag at A against the axis of the inner race, which may move as well.
        let [along, across] = self.offset_m;
        let arm = l.oa.v - l.oc_e.v * cos_b + along.v * cos_b + across.v * sin_b;
        let axis = across.d * cos_b - along.d * sin_b;
        let inner = (self.rotation.d * arm - sin_b * l.oc_e.d - axis) / l.oa.v;
        let outer = self.rotation.d * (l.ob.v - l.oc_e.v) / l.ob.v;
        let [give_i, give_e] = self.give_rad_per_n();
        outer - inner + (give_i + give_e)
    }

    /// By how much each race turns further in engagement as its contact gives, rad/N.
    fn give_rad_per_n(&self) -> [f64; 2] {
        let [inner, outer] = self.give_m_per_n;
        [inner / self.lengths.oa.v, outer / self.lengths.ob.v]
    }
}

/// What the bulk adds to a closure while it settles.
struct Yields {
    /// Compression of the body beyond the disc, m.
    bulk_m: Dual,
    /// By how much the force at A lies ahead for it, m.
    ahead_m: Dual,
}

impl Default for Yields {
    fn default() -> Self {
        let none = Dual::constant(0.0);
        Self { bulk_m: none, ahead_m: none }
    }
}

/// One clutch, ready for closures.
#[derive(Debug, Clone)]
pub struct Statics {
    /// Number of sprags.
    pub count: usize,
    /// Elastic laws.
    pub elastic: Elastic,
    /// Placed arcs.
    pub profile: Profile,
    /// The curvature that laws which know the radius are given at A.
    pub inner_curvature: InnerCurvature,
    /// How far a closure settles, and what goes into a curve.
    pub(super) effort: Effort,
    /// q: on the first arc all is analytic in (alpha - alpha_0)^(1/q); 9 for the power of the roller law, 10 for logarithmic laws.
    pub(super) exponent: f64,
    /// Axis of the inner race against that of the outer at this sprag before it rolls on: along OC_e, and across it, m.
    pub(super) offset_m: [f64; 2],
    /// The race that this stays with.
    pub(super) carrier: Carrier,
    /// Whether it is there as it is given, whatever has turned.
    pub(super) offset_stays: bool,
    /// What the body gives beyond the law's disc; nothing for a law that takes no disc, or without an outline.
    pub(super) bulk: Option<Arc<Bulk>>,
    /// What opens the gap at this sprag beside the law: inner track, outer track, and what it lacks in size, m.
    pub(super) opened_m: [f64; 3],
    /// Whether the sprag has passed its highest place, where A, B and the axis lie on one line: beta < 0 from there on.
    pub(super) past: bool,
    /// Whether a step on the way to an equilibrium may lead beyond that place: it is looked for near it.
    pub(super) near_upright: bool,
    /// The way rolled at which the body gives as it does wherever the contact is, m; `None`: where it is.
    pub(super) fixed_roll_m: Option<f64>,
    pub(super) radii: Radii,
    centroid_m: [f64; 2],
    mass_kg: f64,
    gamma0: f64,
    /// Distance and azimuth of each arc's centre from C_e in the body frame.
    centres: Vec<(f64, f64)>,
}

impl Statics {
    /// Prepare; `profile` is the placed profile of this clutch.
    pub fn new(
        clutch: &Clutch,
        profile: Profile,
        inner_curvature: InnerCurvature,
    ) -> Result<Self, NoElastic> {
        let (s, r) = (&clutch.sprags, &clutch.races);
        let gamma0 = -s.centroid_m[0].atan2(profile.outer_centre_distance_m + s.centroid_m[1]);
        Ok(Self {
            count: s.count,
            inner_curvature,
            effort: Effort::Full,
            exponent: if clutch.contact.facts().knows_radius { 10.0 } else { 9.0 },
            offset_m: [0.0; 2],
            carrier: Carrier::default(),
            offset_stays: false,
            opened_m: [0.0; 3],
            past: false,
            near_upright: false,
            fixed_roll_m: None,
            bulk: super::bulk::of(clutch, &profile),
            elastic: Elastic::new(clutch)?,
            radii: Radii {
                inner_race_m: r.inner_radius_m,
                outer_race_m: r.outer_radius_m,
                inner_arc_m: 0.0,
                outer_arc_m: s.outer_radius_m,
            },
            centroid_m: s.centroid_m,
            mass_kg: s.mass_kg,
            gamma0,
            centres: profile
                .arcs
                .iter()
                .map(|a| (a.centre_m.norm(), a.centre_m.x.atan2(a.centre_m.y)))
                .collect(),
            profile,
        })
    }

    /// Prepare for curves at `effort`.
    ///
    /// # Errors
    /// [`NoCurve::NoElastic`].
    pub fn at_effort(clutch: &Clutch, profile: &Profile, effort: Effort) -> Result<Self, NoCurve> {
        let full = Self::new(clutch, profile.clone(), InnerCurvature::Patch).map_err(NoCurve::NoElastic)?;
        Ok(match effort {
            Effort::Full => full,
            quick => Self { effort: quick, elastic: full.elastic.quickly(), ..full },
        })
    }

    /// With an edge after the last arc, over which a contact pivots from the turn at which that arc ends to `until_rad` (rad): an arc
    /// without a radius, which gives as the arc before it does.
    pub(super) fn with_edge(mut self, until_rad: f64) -> Self {
        if let Some(last) = self.profile.arcs.last().copied() {
            let centre_m = last.centre_m + last.radius_m * self.profile.contact_direction(last.until_rad);
            self.profile.arcs.push(ProfileArc {
                radius_m: 0.0,
                centre_m,
                from_rad: last.until_rad,
                until_rad,
            });
            self.centres.push((centre_m.norm(), centre_m.x.atan2(centre_m.y)));
            self.elastic = self.elastic.with_edge();
        }
        self
    }

    /// With the contact outside on the edge of the body at `edge_m` (m) for good: C_e and the outer arc shrink to that point.
    pub(super) fn on_outer_edge(mut self, edge_m: Vector2<f64>) -> Self {
        self.radii.outer_arc_m = 0.0;
        self.centroid_m = [self.centroid_m[0] - edge_m.x, self.centroid_m[1] - edge_m.y];
        let seen = |arc: &ProfileArc| {
            let from = arc.centre_m - edge_m;
            (from.norm(), from.x.atan2(from.y))
        };
        self.centres = self.profile.arcs.iter().map(seen).collect();
        self
    }

    /// gamma at first contact at rest, rad.
    pub fn gamma0_rad(&self) -> f64 {
        self.gamma0
    }

    /// Centroid of the body frame, m.
    pub fn centroid_m(&self) -> [f64; 2] {
        self.centroid_m
    }

    /// What the body yields under `n`, the force at A, after `rolled` of the profile and with 1/R of the contact there: what the
    /// energy n^2 C(s)/2 asks for.
    fn yields(bulk: &Bulk, n: Dual, rolled: Dual, curvature: Dual) -> Yields {
        let at = bulk.at(rolled);
        Yields {
            bulk_m: n * at.give_m_per_n,
            // The moment n ahead works on the turn ds/R of the surfaces against each other.
            ahead_m: n * at.slope_per_n * -0.5 / curvature,
        }
    }

    /// With what opens the gap at this sprag alone.
    fn opened(&self, d: Deformations) -> Deformations {
        let [inner, outer, body] = self.opened_m;
        Deformations {
            race_inner: d.race_inner + inner,
            race_outer: d.race_outer + outer,
            body: d.body + body,
            ..d
        }
    }

    /// Equilibrium on arc `arc` at inner normal force `n_bi` > 0 (N) and mean speed `speed_rad_s`.
    /// `shift_rad` is the arc's constant shift of the body angle (junction crossing).
    ///
    /// Eq. (10) read the other way round: N_bi is given, alpha follows; the curve inverts it. At a mean speed
    /// Omega the sprag is no two-force member, F_c = m_g OC_g Omega^2 acts at G:
    ///
    ///   T_bi = [N_bi OB sin beta - F_c OB sin gamma]/(OB cos beta - OA),  T_be = T_bi OA/OB,
    ///   N_be = [N_bi cos(beta+gamma) + T_bi sin(beta+gamma) - T_be sin gamma + F_c]/cos gamma.
    ///
    /// At rest this is tan omega = OB sin beta/(OB cos beta - OA), N_be = F cos nu.
    ///
    /// With the axis of the inner race off that of the outer by (d, t) ([`super::WedgeCurve::build_off_centre`]) moments about B
    /// and O have OB sin beta -> (OB - d) sin beta + t cos beta, OB cos beta -> (OB - d) cos beta - t sin beta and
    /// T_be OB = T_bi OA - d (N sin beta - T_bi cos beta) + t (N cos beta + T_bi sin beta).
    ///
    /// N_be and, where the law knows the radius, the curvature under the contact at A settle in one fixed-point loop.
    #[doc(alias = "Eq. (10)")]
    pub fn closure(
        &self,
        arc: usize,
        n_bi: f64,
        speed_rad_s: f64,
        shift_rad: f64,
    ) -> Result<Closure, NoClosure> {
        #[cfg(test)]
        CLOSURES.with(|count| count.set(count.get() + 1));
        let (distance, azimuth) = self.centres[arc];
        let radii = Radii { inner_arc_m: self.profile.arcs[arc].radius_m, ..self.radii };
        let mut apart = self.offset_m.map(Dual::constant);
        let mut carried = Dual::constant(0.0);
        let n = Dual::variable(n_bi);
        let mut n_be = n;
        let mut inner = InnerApproach::new(self, arc, n);
        let mut residual = f64::INFINITY;
        let mut slope_residual = f64::INFINITY;
        let mut unsettled = f64::INFINITY;
        let mut body = Yields::default();
        let unlike = self.elastic.unlike != [0.0; 2];
        let mut lag = Dual::constant(0.0);
        let centroid = kinematics::polar(self.centroid_m);
        let (mut known_n, mut outer) = (f64::NAN, (0.0, 0.0));
        for round in 0..ROUNDS {
            // A force that stands still needs no law again.
            if n_be.v != known_n {
                (known_n, outer) = (n_be.v, self.elastic.at_outer(n_be.v));
            }
            let approaches = [inner.approach_m, n_be.chain(outer.0, outer.1)];
            let mut d = self.opened(self.elastic.deformations(n, n_be, approaches, speed_rad_s));
            d.bulk = body.bulk_m;
            let mut l = kinematics::lengths(&radii, &d);
            if self.elastic.gives_along {
                [l.oa, l.ob] = kinematics::pitch_points(&radii, &d, self.effective_radii_m(&inner));
            }
            let triangle = kinematics::beta_off_centre(&l, distance, apart);
            let upright = triangle.is_none();
            if upright && !(self.near_upright && round < UPRIGHT_ROUNDS) {
                return Err(NoClosure::RolledOver);
            }
            let (sin_b, cos_b) = triangle.unwrap_or((Dual::constant(0.0), Dual::constant(1.0)));
            let [along, across] = apart;
            let sin_b = if self.past { -sin_b } else { sin_b };
            let beta = sin_b.atan2(cos_b);
            // C_i has passed below C_e there: the angle goes on over pi.
            let over = if self.past { TAU } else { 0.0 };
            let rotation = (l.oc_i * sin_b + across).atan2(l.oc_i * cos_b - l.oc_e + along)
                + (over + shift_rad - azimuth);
            let g = kinematics::centroid_from(centroid, l.oc_e, rotation);
            // From the contact point at A to the force.
            let ahead = (inner.ahead_m + body.ahead_m) / l.oa - lag;
            let (seen, sin_b, cos_b) = match ahead.v == 0.0 {
                true => (beta, sin_b, cos_b),
                false => {
                    let (sin, cos) = ahead.sin_cos();
                    (beta + ahead, sin_b * cos + cos_b * sin, cos_b * cos - sin_b * sin)
                }
            };
            let to_b = l.ob - along;
            let lever = to_b * cos_b - sin_b * across - l.oa;
            let ratio = (to_b * sin_b + cos_b * across) / lever;
            let (sin_g, cos_g) = g.gamma.sin_cos();
            let f_c = g.oc_g * (self.mass_kg * speed_rad_s * speed_rad_s);
            let offset = -(f_c * l.ob * sin_g / lever);
            let t_bi = n * ratio + offset;
            let couple = (n * cos_b + t_bi * sin_b) * across - (n * sin_b - t_bi * cos_b) * along;
            let t_be = (t_bi * l.oa + couple) / l.ob;
            let (sin_bg, cos_bg) = (seen + g.gamma).sin_cos();
            let next = (n * cos_bg + t_bi * sin_bg - t_be * sin_g + f_c) / cos_g;
            // A sprag that centrifugal force presses off the inner race still never pulls on the outer one.
            let next = if next.v > FIRST_CONTACT_N { next } else { Dual::constant(FIRST_CONTACT_N) };
            let curvature = inner.curvature_per_m.v;
            let turn = rotation - (beta - self.profile.beta0_rad);
            let mut moved = inner.update(self, arc, n, turn, round >= HALVED_FROM);
            if let Some(bulk) = &self.bulk {
                let rolled = self.fixed_roll_m.map_or_else(|| self.rolled_m(arc, turn), Dual::constant);
                let mut now = Self::yields(bulk, n, rolled, inner.curvature_per_m);
                if self.fixed_roll_m.is_some() || self.profile.arcs[arc].radius_m == 0.0 {
                    // Over an edge nothing rolls on.
                    now.ahead_m = Dual::constant(0.0);
                }
                moved.v = moved.v.max(((now.bulk_m.v - body.bulk_m.v) / inner.approach_m.v).abs());
                moved.d = moved.d.max(((now.bulk_m.d - body.bulk_m.d) / inner.approach_m.d).abs());
                body = now;
            }
            if unlike {
                let now = self.lag_rad(&inner, [n, next], [t_bi, t_be], &l);
                moved.v = moved.v.max((now.v - lag.v).abs());
                moved.d = moved.d.max((now.d - lag.d).abs() / now.d.abs().max(f64::MIN_POSITIVE));
                lag = now;
            }
            // The offset turns with a race; without one there is nothing to turn.
            let stays = self.is_concentric() || self.offset_stays;
            let on = if stays { carried } else { self.carried(arc, rotation, turn) };
            let rolled_on = on - carried;
            carried = on;
            let change = (next.v - n_be.v).abs() / next.v;
            let slope_change = (next.d - n_be.d).abs() / next.d.abs().max(1e-3);
            // The turn carries some 5e-15 of rounding, which a large step of curvature makes 1e-15 of delta_H.
            let there = rolled_on.v.abs() <= 1e-14 && rolled_on.d.abs() <= 1e-12 * on.d.abs();
            let still = moved.v <= 1e-14 && moved.d <= 1e-13 && there;
            // What is left is a hundredth of the last change.
            let enough = self.effort != Effort::Full
                && there
                && change.max(moved.v) < 1e-10
                && slope_change.max(moved.d) < 1e-8;
            let settled = enough
                || still && change <= 4.0 * f64::EPSILON && slope_change <= 1e-14
                || still
                    && round > 4
                    && change >= residual
                    && slope_change >= slope_residual
                    && change < 1e-13
                || round > 20 && there && change.max(moved.v) < 1e-13 && slope_change.max(moved.d) < 1e-10
                // Forces stand still; where the curvature changes by the whole within a hair, as on the edge of a flat, the approach
                // keeps the rounding of the turn many times over.
                || round > HALVED_FROM
                    && there
                    && change <= 4.0 * f64::EPSILON
                    && slope_change < 1e-11
                    && moved.v < 1e-10
                    && moved.d < 1e-7;
            let settled = settled && !upright;
            n_be = next;
            (residual, slope_residual, unsettled) = (change, slope_change, change.max(moved.v));
            if settled {
                let mut found = Closure {
                    n_bi,
                    n_be,
                    t_bi,
                    t_offset_n: offset.v,
                    t_ratio: ratio.v,
                    t_ratio_slope_per_n: ratio.d,
                    t_be,
                    lengths: l,
                    deformations: d,
                    curvature_inner_per_m: curvature,
                    force_ahead_m: ahead.v * l.oa.v,
                    beta,
                    gamma: g.gamma,
                    oc_g: g.oc_g,
                    rotation,
                    alpha: rotation + g.gamma - self.gamma0,
                    offset_m: apart,
                    carried_rad: self.carried(arc, rotation, turn).v,
                    give_m_per_n: [0.0; 2],
                };
                found.give_m_per_n = self.give_m_per_n(arc, &found);
                return Ok(found);
            }
            if !self.is_concentric() {
                apart = turned(self.offset_m, carried);
            }
        }
        Err(NoClosure::NoConvergence { residual: unsettled })
    }
}
