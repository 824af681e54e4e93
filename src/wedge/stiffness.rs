//! One row of the stiffness curve: statics at a torque or a normal force, in full.

use super::closure::Closure;
use super::curve::WedgeCurve;

/// Smallest torque that the curve's root finding resolves to six digits, N m.
pub const SMALLEST_TORQUE_NM: f64 = 1e-6;

/// Static state of the clutch under torque; per sprag where a force is meant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StaticPoint {
    /// Torque C, N m.
    pub torque_nm: f64,
    /// N_bi, N.
    pub normal_inner_n: f64,
    /// N_be, N.
    pub normal_outer_n: f64,
    /// Demanded tan omega = T_bi/N_bi.
    pub tan_omega: f64,
    /// Demanded tan nu = T_be/N_be.
    pub tan_nu: f64,
    /// alpha, rad.
    pub alpha_rad: f64,
    /// Windup, rad.
    pub windup_rad: f64,
    /// Eq. (A.9): secant stiffness C/windup, N m/rad.
    #[doc(alias = "Eq. (A.9)")]
    pub k_secant_nm_per_rad: f64,
    /// dC/dwindup, N m/rad.
    pub k_tangent_nm_per_rad: f64,
    /// Contact turn in the body, rad.
    pub contact_turn_rad: f64,
    /// Arc in contact, from 0.
    pub arc: usize,
    /// delta_H at A, m.
    pub approach_inner_m: f64,
    /// p_0 at A, Pa, with the profile's curvature averaged over the patch; off by [`super::straddling_error`] at most
    /// where that straddles a junction.
    pub hertz_inner_pa: f64,
    /// p_0 at A, Pa, with the radius at the contact point alone, as the paper takes it: jumps at a junction.
    pub hertz_inner_pointwise_pa: f64,
    /// Whether the patch at A lies on more than one arc.
    pub straddles_junction: bool,
    /// p_0 at B, Pa.
    pub hertz_outer_pa: f64,
    /// Half width of the contact at A, m.
    pub half_width_inner_m: f64,
}

impl StaticPoint {
    /// Static friction with which neither contact slips: the larger of tan omega and tan nu.
    pub fn required_friction(&self) -> f64 {
        self.tan_omega.max(self.tan_nu)
    }

    /// No load at all.
    pub const UNLOADED: Self = Self {
        torque_nm: 0.0,
        normal_inner_n: 0.0,
        normal_outer_n: 0.0,
        tan_omega: 0.0,
        tan_nu: 0.0,
        alpha_rad: 0.0,
        windup_rad: 0.0,
        k_secant_nm_per_rad: 0.0,
        k_tangent_nm_per_rad: 0.0,
        contact_turn_rad: 0.0,
        arc: 0,
        approach_inner_m: 0.0,
        hertz_inner_pa: 0.0,
        hertz_inner_pointwise_pa: 0.0,
        straddles_junction: false,
        hertz_outer_pa: 0.0,
        half_width_inner_m: 0.0,
    };
}

impl WedgeCurve {
    /// Static state at `torque_nm` > 0; `None` where the curve ends below it.
    pub fn at_torque(&self, torque_nm: f64) -> Option<StaticPoint> {
        self.sample_at_torque(torque_nm).map(|(point, _)| point)
    }

    /// Static state at inner normal force `normal_n` > 0; `None` beyond the curve.
    pub fn at_normal(&self, normal_n: f64) -> Option<StaticPoint> {
        self.closure_at_normal(normal_n).map(|(k, c)| self.row(k, &c))
    }

    /// p_0 at A under `normal_n`, Pa: 0 without a force; beyond the curve that of its last arc alone, by Hertz.
    pub fn hertz_inner_pa(&self, normal_n: f64) -> f64 {
        if normal_n <= 0.0 {
            return 0.0;
        }
        let beyond = || {
            let last = self.first_arc() + self.arc_count() - 1;
            self.statics().elastic.inner_contact.get(last).map_or(0.0, |c| c.peak_pressure_pa(normal_n))
        };
        self.at_normal(normal_n).map_or_else(beyond, |p| p.hertz_inner_pa)
    }

    /// The row of one equilibrium.
    pub(super) fn row(&self, k: usize, c: &Closure) -> StaticPoint {
        let statics = self.statics();
        let torque = c.torque_nm(statics.count);
        let windup_rad = self.windup_rad(c.alpha.v);
        let elastic = &statics.elastic;
        let arc = self.first_arc() + k;
        let (patch, straddles) = statics.patch(arc, c);
        StaticPoint {
            torque_nm: torque.v,
            normal_inner_n: c.n_bi,
            normal_outer_n: c.n_be.v,
            tan_omega: c.t_bi.v / c.n_bi,
            tan_nu: c.t_be.v / c.n_be.v,
            alpha_rad: c.alpha.v,
            windup_rad,
            k_secant_nm_per_rad: torque.v / windup_rad,
            k_tangent_nm_per_rad: torque.d / c.windup_slope(),
            contact_turn_rad: c.turn_rad(statics.profile.beta0_rad),
            arc,
            approach_inner_m: c.deformations.contact_inner.v,
            hertz_inner_pa: patch.peak_pressure_pa(c.n_bi),
            hertz_inner_pointwise_pa: elastic.inner_contact[arc].peak_pressure_pa(c.n_bi),
            straddles_junction: straddles,
            hertz_outer_pa: elastic.outer_contact.peak_pressure_pa(c.n_be.v),
            half_width_inner_m: patch.half_width_m(c.n_bi),
        }
    }
}
