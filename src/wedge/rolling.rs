//! How the contacts give along the tracks while they roll under a load that grows: the law `elastic`.
//!
//! In: an equilibrium. Out: what it adds to windup, and the work that rolling loses. Absent: slip within the patch
//! (below). Equations: none of the paper's. Nothing in it is fitted.
//!
//! # Where the force crosses the line of centres
//! Two round bodies of radii R and r turn by theta and Omega against their line of centres, D long. Whatever the patch
//! looks like, the work that its deformation takes knows D and ds = R dtheta - r dOmega alone, as surfaces come to it
//! unstrained but for the growth of a ring; so dW = -N dD + T ds, and the moments of the force about the two centres are
//! T R and T r: it crosses their line at the pitch point, which parts D as R : r
//! ([`crate::kinematics::pitch_points`]), at A delta_H R/(R + r) within R_i, at B delta_H R/(R - r) beyond R_e, where (8)
//! has half of delta_H at both. That lowers tan omega, by 0.20 % for Table 1's clutch at 100 N m. Seen from the patch: it
//! is carried along the tracks and its normal leans by s/D against the line of centres; with s = tan(omega) delta_H its
//! force crosses that line at the same point.
//!
//! # The shift s
//! Gamma = 2/(pi E* l). Under a traction q(xi) of sum T on b < xi < c (material coordinate along the arc, c = x + a
//! ahead, b = x - a behind, x the way rolled) surfaces that stick keep the gradient g'(xi) with which they came
//! together, and s = g(xi) + u(xi). Bounded at c and singular at b,
//!
//!   Gamma T = (1/pi) int_b^c sqrt((xi - b)/(c - xi)) g' dxi
//!   s = T (delta_H/N - Gamma/2) + g(b) + int_b^c g' (1 - F) dxi,   F = 1/2 + asin((xi - x)/a)/pi
//!
//! with the depths of the normal law: the sprag is pressed along its strut and so gives along and across by one bracket,
//! a ring by S of [`crate::race::Race::effective_depth_m`] made of tangential harmonics (0.11 and 0.09 for Table 1's
//! outer race, 0.22 and 0.13 for a thin one, of some 9 for both bodies). Constant T and a: g' = Gamma T/a, Carter's creep
//! (Johnson, *Contact Mechanics*, 8.3). No rolling: q follows the pressure and s = T delta_H/N (Cattaneo and Mindlin;
//! Johnson 7.2). A sprag lies between: x/a is 1.1 at 3 N m, 2.3 at 17, 4.5 at 100 for Table 1's inner contact.
//! What creeps is what leaves the patch behind, dx - da; with a ~ sqrt(N), T ~ N, int (Gamma T/a) da = Gamma T/2:
//!
//!   s = T (delta_H/N - Gamma/2) + int (Gamma T/a) dx
//!
//! which the integral equation with T ~ N, a ~ N^0.5, x ~ N^0.9 meets to 0.2 Gamma T for x/a from 0.6 to 6, 3 % of s
//! (test `the_shift_is_that_of_the_integral_equation`). It adds tan(omega) times 1.0 to 1.7 times the approaches to what
//! the races turn: 0.2 to 0.35 % of windup for Table 1's clutch, 0.6 to 0.8 % where contacts give more than rings do.
//!
//! # Unlike bodies
//! Pressure p draws a surface together by (1 - 2 nu)(1 + nu)/E p: that of a softer race by 2 beta/E* p more, beta Dundurs'. Surfaces
//! that stick keep the strain with which they came together, so Gamma T becomes (1/pi) int sqrt((xi - b)/(c - xi)) (g' - 2 beta p/E*) dxi,
//! and without T surfaces that roll have g' = (2/pi) beta a/R: a softer race turns further by int (2/pi) beta (a/R) dx, and back as
//! far (Bentall and Johnson, *Int. J. Mech. Sci.* 9, 1967). With a ~ sqrt(N), x ~ N^0.9 the integral equation has 6 to 10 % less of it
//! for x/a from 3 to 6 (`tests/reference/unlike_rolling.py --growing`). No work is lost: what T does on that way the normal force does
//! back, it lies (2/pi) beta a T/N behind the contact point, as the shear q of T changes the pressure there,
//! (2/(pi E*)) int p dxi/(x - xi) = x/R + 2 beta q/E* (the same script: to 4 %). With a solid shaft of 110 GPa that lowers tan omega by
//! 0.18 % at 2.6 GPa; finite elements, which slip, have 0.29 % less than with a Poisson's ratio that makes beta 0
//! (`reports/calculix-ten-decks.md`).
//!
//! # Left out
//! Slip at the trailing edge makes the lever of unlike bodies up to 4/3 as long, and creep 2 (1 - sqrt(1 - u))/u as large,
//! u = T/(mu N) (Carter): 1.08 in finite elements
//! with mu = 0.3, 1.3 with tan omega at two thirds of mu. Hoop strain of the ring at the contact beside the mean growth
//! moves the pitch point by 0.06 % of N at 100 N m. What only centrifugal force asks for counts as carried without
//! rolling.

use std::f64::consts::PI;

use super::closure::{Closure, FIRST_CONTACT_N, Statics};
use super::curve::WedgeCurve;
use super::patch::{InnerApproach, at_curvature};
use crate::contact::LineContact;
use crate::kinematics::Lengths;
use crate::numeric::{dual::Dual, quadrature};

/// What surfaces of unlike bodies roll further, over beta a/R.
const ENTRAINED: f64 = 2.0 / PI;

/// One contact of a sprag; derivatives by N_bi.
struct Seat {
    contact: LineContact,
    /// Dundurs' beta, positive where the race is softer.
    unlike: f64,
    normal_n: Dual,
    tangential_n: Dual,
    approach_m: Dual,
    /// dx/dN_bi.
    rolled_m_per_n: f64,
}

impl Seat {
    /// Gamma T/a, pure number: creep per way rolled.
    fn creepage(&self) -> f64 {
        let half_width = self.contact.half_width_m(self.normal_n.v);
        self.gamma() * self.tangential_n.v / half_width
    }

    /// By how much a race softer than the sprag turns further per way rolled, and back again, pure number.
    fn entrainment(&self) -> f64 {
        let half_width = self.contact.half_width_m(self.normal_n.v);
        ENTRAINED * self.unlike * half_width / self.contact.effective_radius_m
    }

    /// Gamma, m/N.
    fn gamma(&self) -> f64 {
        2.0 / (PI * self.contact.contact_modulus_pa * self.contact.length_m)
    }

    /// ds/dN_bi, m/N; 0 where no friction holds the force.
    fn give_m_per_n(&self) -> f64 {
        if self.tangential_n.v.abs() > self.normal_n.v {
            return 0.0;
        }
        let stuck = self.tangential_n / self.normal_n * self.approach_m;
        stuck.d - 0.5 * self.gamma() * self.tangential_n.d
            + (self.creepage() + self.entrainment()) * self.rolled_m_per_n
    }

    /// T times creep per N_bi, J/N.
    fn loss_j_per_n(&self) -> f64 {
        self.tangential_n.v * self.creepage() * self.rolled_m_per_n
    }
}

impl Statics {
    /// R of both contacts, m.
    pub(super) fn effective_radii_m(&self, inner: &InnerApproach) -> [Dual; 2] {
        let outer = Dual::constant(self.elastic.outer_contact.effective_radius_m);
        [Dual::constant(1.0) / inner.curvature_per_m, outer]
    }

    /// By how much the forces at A and B, between unlike bodies, lie behind the contact points, as one angle at A, rad: the
    /// softer the races the more. `normal_n` and `tangential_n` at A and B, N. No friction holds more than the normal force.
    pub(super) fn lag_rad(
        &self,
        inner: &InnerApproach,
        normal_n: [Dual; 2],
        tangential_n: [Dual; 2],
        l: &Lengths,
    ) -> Dual {
        let [r_i, r_e] = self.effective_radii_m(inner);
        let lag = |side: usize, contact: &LineContact, radius: Dual, to_axis: Dual| {
            let n = normal_n[side];
            let half_m = at_curvature(contact, 1.0 / radius.v).half_width_m(n.v);
            // a ~ (N R)^(1/2)
            let half = Dual { v: half_m, d: 0.5 * half_m * (n.d / n.v + radius.d / radius.v) };
            let ratio = tangential_n[side] / n;
            let held = if ratio.v.abs() > 1.0 { Dual::constant(ratio.v.signum()) } else { ratio };
            half * held * (ENTRAINED * self.elastic.unlike[side]) / to_axis
        };
        // Arcs differ in radius alone.
        lag(0, &self.elastic.inner_contact[0], r_i, l.oa) + lag(1, &self.elastic.outer_contact, r_e, l.ob)
    }

    /// [`Closure::give_m_per_n`] of an equilibrium on arc `arc`.
    pub(super) fn give_m_per_n(&self, arc: usize, c: &Closure) -> [f64; 2] {
        match self.elastic.gives_along {
            true => self.seats(arc, c).map(|seat| seat.give_m_per_n()),
            false => [0.0; 2],
        }
    }

    fn seats(&self, arc: usize, c: &Closure) -> [Seat; 2] {
        let (n, ratio) = (Dual::variable(c.n_bi), Dual { v: c.t_ratio, d: c.t_ratio_slope_per_n });
        let tangential_n = n * ratio;
        let turn_slope = c.rotation.d - c.beta.d;
        [
            Seat {
                contact: at_curvature(&self.elastic.inner_contact[arc], c.curvature_inner_per_m),
                unlike: self.elastic.unlike[0],
                normal_n: n,
                tangential_n,
                approach_m: c.deformations.contact_inner,
                rolled_m_per_n: self.profile.arcs[arc].radius_m * turn_slope,
            },
            Seat {
                contact: self.elastic.outer_contact,
                unlike: self.elastic.unlike[1],
                normal_n: c.n_be,
                tangential_n: tangential_n * c.lengths.oa / c.lengths.ob,
                approach_m: c.deformations.contact_outer,
                rolled_m_per_n: self.radii.outer_arc_m * c.rotation.d,
            },
        ]
    }
}

/// What rolling under load loses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CreepLoss {
    /// Work done on the clutch from no load to the load, J.
    pub work_j: f64,
    /// What of it creep has turned to heat, J. Rolling back loses it once more: creep goes with the force, not with the way.
    pub lost_j: f64,
    /// Windup by which a clutch on its way back leads one that is loaded, at no load, rad.
    pub lead_rad: f64,
}

impl CreepLoss {
    /// Damping ratio of a swing between no load and the load, pure number: loss of a cycle over 4 pi times the energy stored.
    pub fn damping_ratio(&self) -> f64 {
        2.0 * self.lost_j / (4.0 * PI * (self.work_j - self.lost_j))
    }
}

impl WedgeCurve {
    /// Loss by creep of one slow rise from no load to the inner normal force `normal_n`, N per sprag; `None` beyond the
    /// curve, or for a law whose contacts do not give along the tracks.
    pub fn creep_loss(&self, normal_n: f64) -> Option<CreepLoss> {
        let statics = self.statics();
        self.closure_at_normal(normal_n).filter(|_| statics.elastic.gives_along)?;
        let count = statics.count;
        let [work_j, lost_j, lead_rad] = quadrature::integrals(0.0, 1.0, |z| {
            let Some((k, c)) = self.closure_at_normal((normal_n * z * z).max(FIRST_CONTACT_N)) else {
                return [0.0; 3];
            };
            let seats = statics.seats(self.first_arc() + k, &c);
            let lost: f64 = seats.iter().map(Seat::loss_j_per_n).sum();
            let turned = seats.iter().zip([c.lengths.oa.v, c.lengths.ob.v]);
            let lead: f64 = turned.map(|(s, radius)| s.creepage() * s.rolled_m_per_n / radius).sum();
            let work = c.torque_nm(count).v * c.windup_slope();
            [work, count as f64 * lost, 2.0 * lead].map(|per_n| 2.0 * normal_n * z * per_n)
        });
        Some(CreepLoss { work_j, lost_j, lead_rad })
    }
}

#[cfg(test)]
mod tests;
