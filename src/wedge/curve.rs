//! The wedge curve of one design at one mean speed: built once (`build`), then only evaluated.

use super::build::{Effort, arc_end};
use super::closure::{Closure, FIRST_CONTACT_N, Statics};
use super::elastic::NoElastic;
use super::quick::left_out;
use super::table::{ArcTable, levelled, point};
use crate::numeric::{dual::Dual, root};
use std::sync::{Arc, OnceLock};

named! {
    /// Why the curve ends.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum EndReason {
        /// The contact reaches the end of the last arc.
        OffProfile = "off-profile",
        /// Torque has its maximum: beyond it the sprag rolls over.
        RollsOver = "rolls-over",
        /// No equilibrium was found.
        NoConvergence = "no-convergence",
        /// Nobody asked for the arcs beyond.
        NotBuilt = "not-built",
    }
    /// Name for reports and JSON.
    pub fn name;
}

/// What dynamics needs at one alpha. Pure numbers, m, N; slopes are by alpha.
#[derive(Debug, Clone, Copy)]
pub struct WedgePoint {
    /// OA.
    pub oa: f64,
    /// OB.
    pub ob: f64,
    /// OC_g.
    pub oc_g: f64,
    /// OC_g'.
    pub oc_g_slope: f64,
    /// rho_i = b_i*/OA.
    pub rho_i: f64,
    /// rho_e = b_e*/OB.
    pub rho_e: f64,
    /// rho_i'.
    pub rho_i_slope: f64,
    /// rho_e'.
    pub rho_e_slope: f64,
    /// beta + gamma, rad.
    pub beta_gamma: f64,
    /// gamma, rad.
    pub gamma: f64,
    /// N_bi, N.
    pub n_bi: f64,
    /// T_bi that static equilibrium demands, N.
    pub t_static: f64,
    /// Windup of the rolling clutch, rad.
    pub windup: f64,
}

/// Wedge curve N(alpha), geometry, rolling ratios and windup, at one mean speed.
#[derive(Debug, Clone)]
pub struct WedgeCurve {
    pub(super) statics: Statics,
    pub(super) speed_rad_s: f64,
    pub(super) alpha0: f64,
    pub(super) first: usize,
    pub(super) arcs: Vec<Arc<ArcTable>>,
    /// What comes after its end ([`Self::beyond`]); mostly nothing. Only places see it: no torque, no force is looked for there.
    pub(super) over: Vec<ArcTable>,
    pub(super) end: EndReason,
    /// Geometry at first contact, for the open clutch.
    pub(super) touch: Closure,
    /// N at which its last arc, if that went on, would carry most, N, once that was asked for; the same of the curve next to which this
    /// one was built.
    pub(super) peak_n: OnceLock<Option<f64>>,
    pub(super) near_peak_n: Option<f64>,
}

/// Why a curve cannot be built at all.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NoCurve {
    /// First contact at this speed lies beyond the profile or the sprag has rolled over.
    #[error("no first contact at this speed: it lies beyond the profile, or the sprag has rolled over")]
    NoFirstContact,
    /// A closure did not settle.
    #[error("a point of the curve did not converge")]
    NoConvergence,
    /// The elastic laws cannot be set up.
    #[error("{0}")]
    NoElastic(NoElastic),
}

/// d ln C/d ln N below which C is taken to be at its peak: what is left of it is of the square of that.
const LEVEL: f64 = 1e-5;

impl WedgeCurve {
    /// alpha at first contact at this speed, rad (0 at rest).
    pub fn first_contact_rad(&self) -> f64 {
        self.alpha0
    }
    /// q: on the first arc all is analytic in (alpha - alpha_0)^(1/q); 9 for roller-like laws, 10 for the logarithmic one.
    pub fn exponent(&self) -> f64 {
        self.statics.exponent
    }
    /// Mean speed of the curve, rad/s.
    pub fn speed_rad_s(&self) -> f64 {
        self.speed_rad_s
    }
    /// What went into it.
    pub fn effort(&self) -> Effort {
        self.statics.effort
    }
    /// Number of arcs that the curve reaches.
    pub fn arc_count(&self) -> usize {
        self.arcs.len()
    }
    /// Number of places that a contact may be in: arcs, and what comes after the curve's end where it is followed.
    pub(crate) fn place_count(&self) -> usize {
        self.arcs.len() + self.over.len()
    }
    /// The table of arc `k`, or of a place after the curve's end.
    #[inline(always)]
    fn place(&self, k: usize) -> &ArcTable {
        match self.arcs.get(k) {
            Some(arc) => arc,
            None => &self.over[k - self.arcs.len()],
        }
    }
    /// alpha at which arc `k` (from 0) ends, rad.
    pub fn arc_end_rad(&self, k: usize) -> f64 {
        self.place(k).alpha_until
    }
    /// Constant shift of alpha on arc `k`, rad: what keeps N at the junction before it (the paper's Figure 5). Rounding
    /// only, but for a law that knows the radius and is given it pointwise.
    pub fn shift_rad(&self, k: usize) -> f64 {
        self.arcs[k].shift
    }
    /// N_bi at the end of arc `k`, N.
    pub fn arc_end_n(&self, k: usize) -> f64 {
        self.arcs[k].n_until
    }
    /// Arc in which `alpha` lies.
    pub fn arc_at(&self, alpha: f64) -> usize {
        self.arcs[..self.arcs.len() - 1].partition_point(|a| a.alpha_until < alpha)
    }
    /// The same among the places after the curve's end too.
    pub(crate) fn place_at(&self, alpha: f64) -> usize {
        let at = self.arc_at(alpha);
        if self.over.is_empty() || alpha <= self.arcs[at].alpha_until {
            return at;
        }
        let beyond = self.over.partition_point(|a| a.alpha_until < alpha);
        self.arcs.len() + beyond.min(self.over.len() - 1)
    }
    /// Why and where (alpha, rad) the curve ends.
    pub fn end(&self) -> (EndReason, f64) {
        (self.end, self.arcs[self.arcs.len() - 1].alpha_until)
    }
    /// The equations behind the curve.
    pub fn statics(&self) -> &Statics {
        &self.statics
    }
    /// Relative size of what the interpolation leaves out, pure number, where N exceeds 1e-10 of its largest; 1e-5
    /// with [`Effort::Search`].
    pub fn truncation(&self) -> f64 {
        self.truncation_of(&self.arcs)
    }

    /// The same of `arcs`, its first ones.
    pub(super) fn truncation_of(&self, arcs: &[Arc<ArcTable>]) -> f64 {
        let of = |(k, arc): (usize, &Arc<ArcTable>)| match self.effort() {
            Effort::Full => arc.lanes.truncation(if k == 0 { 2 } else { 0 }, |_| ()),
            Effort::Search | Effort::Sketch => left_out(&arc.lanes, k == 0, self.exponent(), arc.cuts),
        };
        arcs.iter().enumerate().map(of).fold(0.0, f64::max)
    }

    /// Everything at `alpha`, with the functions of arc `k`, which are continued smoothly a little past its
    /// ends so that a trial step sees no kink. Below first contact N stays 0.
    #[inline(always)]
    pub fn in_arc(&self, k: usize, alpha: f64) -> WedgePoint {
        let arc = self.place(k);
        if k > 0 {
            let v = arc.table.at(alpha);
            return point(&v, v[8], 1.0, 1.0);
        }
        // s = (alpha - alpha_0)^(1/q); N = (s * z/s)^10.
        let x = (alpha - self.alpha0).max(0.0);
        let (at, slope) = levelled(x);
        let q = self.statics.exponent;
        let s = at.powf(1.0 / q);
        let v = arc.table.at(s);
        point(&v, (s * v[8]).powi(10) * (x / at), slope * s / (q * at), x)
    }

    /// The curve continued below first contact by the tension that a bilateral contact would carry:
    /// N(alpha_0 - x) = -N(alpha_0 + x), geometry continued oddly, slopes evenly. Only the pure-rolling run
    /// that measures margins goes there; no real clutch does.
    pub fn mirrored(&self, alpha: f64) -> WedgePoint {
        let x = (self.alpha0 - alpha).max(0.0);
        let m = self.in_arc(0, self.alpha0 + x);
        let t = &self.touch;
        let odd = |there: f64, here: f64| 2.0 * here - there;
        let offset = t.t_offset_n;
        WedgePoint {
            oa: odd(m.oa, t.lengths.oa.v),
            ob: odd(m.ob, t.lengths.ob.v),
            oc_g: odd(m.oc_g, t.oc_g.v),
            beta_gamma: odd(m.beta_gamma, t.beta.v + t.gamma.v),
            gamma: odd(m.gamma, t.gamma.v),
            n_bi: -m.n_bi,
            windup: -m.windup,
            t_static: odd(m.t_static, offset),
            rho_i_slope: -m.rho_i_slope,
            rho_e_slope: -m.rho_e_slope,
            ..m
        }
    }

    /// Geometry of the open clutch at `alpha` <= first contact: the sprag rides on the outer race, OC_e stays,
    /// OC_g' = OC_g tan gamma, b_e* = OB - OC_g/cos gamma, no normal force at A.
    pub fn open(&self, alpha: f64) -> WedgePoint {
        let oc_e = self.touch.lengths.oc_e.v;
        let [gx, gy] = self.statics.centroid_m();
        // G lies at chi = -gamma from the line O C_e; seen from there the body has turned by gamma_0 + alpha against
        // OG. Across OG: OC_e sin chi = across; along it: OC_g = OC_e cos chi + along; chi' = along/(OC_e cos chi).
        let (s, c) = (self.statics.gamma0_rad() + alpha).sin_cos();
        let (across, along) = (gy * s + gx * c, gy * c - gx * s);
        let sin_chi = across / oc_e;
        let cos_chi = (1.0 - sin_chi * sin_chi).sqrt();
        let (sin_g, cos_g, gamma) = (-sin_chi, cos_chi, -sin_chi.asin());
        let oc_g = oc_e * cos_chi + along;
        let gamma_slope = -along / (oc_e * cos_chi);
        let (oa, ob) = (self.touch.lengths.oa.v, self.touch.lengths.ob.v);
        let oc_g_slope = oc_g * sin_g / cos_g;
        let beta_gamma = self.touch.beta.v + gamma;
        let (rho_i, _) = crate::kinematics::rolling_ratios(oa, ob, oc_g, oc_g_slope, beta_gamma, gamma);
        let rho_e = (ob - oc_g / cos_g) / ob;
        // -d/dalpha (OC_g/cos gamma)/OB.
        let rho_e_slope = -(oc_g_slope + oc_g * gamma_slope * sin_g / cos_g) / (cos_g * ob);
        WedgePoint {
            oa,
            ob,
            oc_g,
            oc_g_slope,
            rho_i,
            rho_e,
            rho_i_slope: 0.0,
            rho_e_slope,
            beta_gamma,
            gamma,
            n_bi: 0.0,
            t_static: 0.0,
            windup: 0.0,
        }
    }

    /// Windup W(alpha) >= 0 of the rolling clutch, rad; 0 at and below first contact.
    ///
    /// Eq. (A.7), as the integral of (rho_i + rho_e) d alpha, which the paper replaces by a product and prints
    /// with a minus between the ratios.
    #[doc(alias = "Eq. (A.7)")]
    pub fn windup_rad(&self, alpha: f64) -> f64 {
        if alpha <= self.alpha0 {
            return 0.0;
        }
        let k = self.arc_at(alpha);
        self.arcs[k].windup_rad(alpha, (k == 0).then_some((self.alpha0, self.exponent())))
    }

    /// Exact equilibrium at inner normal force `n_bi`, N, with its arc; `None` beyond the curve's end.
    pub fn closure_at_normal(&self, n_bi: f64) -> Option<(usize, Closure)> {
        let k = self.arcs[..self.arcs.len() - 1].partition_point(|a| a.n_until < n_bi);
        if n_bi > self.arcs[k].n_until * (1.0 + 1e-12) || n_bi.is_nan() {
            return None;
        }
        self.closure_in(k, n_bi).map(|c| (k, c))
    }

    /// Exact equilibrium that carries `torque_nm`, N m > 0; `None` where the curve ends below it.
    pub fn closure_at_torque(&self, torque_nm: f64) -> Option<(usize, Closure)> {
        let count = self.statics.count;
        for (k, arc) in self.arcs.iter().enumerate() {
            let miss = |n: f64| self.closure_in(k, n).map_or(f64::NAN, |c| c.torque_nm(count).v - torque_nm);
            let (a, b) = (arc.n_from.max(FIRST_CONTACT_N), arc.n_until);
            let fb = arc.torque_until_nm - torque_nm;
            if fb < 0.0 {
                continue;
            }
            let fa = miss(a);
            if fa > 0.0 && k == 0 {
                continue;
            }
            if self.effort() != Effort::Full
                && let Some(found) = self.newton(k, torque_nm, [a, b], [fa, fb])
            {
                return Some((k, found));
            }
            let n = if fa >= 0.0 { a } else { root::bracketed(a, b, fa, fb, 1e-15 * b, miss)? };
            return self.closure_in(k, n).map(|c| (k, c));
        }
        None
    }

    /// The same on arc `k` between two forces (N) at which the torque misses `torque_nm` by `misses`, by its slope; `None` where
    /// that leads out of them.
    fn newton(&self, k: usize, torque_nm: f64, [a, b]: [f64; 2], [fa, fb]: [f64; 2]) -> Option<Closure> {
        let mut n = if fa < 0.0 { a + (b - a) * fa / (fa - fb) } else { a };
        for _ in 0..12 {
            let c = self.closure_in(k, n)?;
            let torque = c.torque_nm(self.statics.count);
            let step = (torque_nm - torque.v) / torque.d;
            if step.abs() <= 1e-14 * n {
                return Some(c);
            }
            n += step;
            if !(a..=b).contains(&n) {
                return None;
            }
            if step.abs() < 1e-7 * n {
                return self.closure_in(k, n);
            }
        }
        None
    }

    /// alpha at inner normal force `n_bi`.
    pub fn alpha_at_normal(&self, n_bi: f64) -> Option<f64> {
        self.closure_at_normal(n_bi).map(|(_, c)| c.alpha.v)
    }

    /// Torque at the end of the curve, N m.
    pub fn end_torque_nm(&self) -> f64 {
        self.arcs[self.arcs.len() - 1].torque_until_nm
    }

    /// Torque at which the sprag would roll over if its last arc went on, N m; the curve's own end where it
    /// rolls over already.
    pub fn roll_over_torque_nm(&self) -> f64 {
        if self.end == EndReason::RollsOver {
            return self.end_torque_nm();
        }
        let torque = |n: f64| Some(self.closure_in(self.arcs.len() - 1, n)?.torque_nm(self.statics.count));
        // What the place of a level peak moves by does not enter.
        let level = |torque: &Dual, n: f64| (torque.d * n).abs() < LEVEL * torque.v;
        let beside = self.near_peak_n.and_then(|n| torque(n).filter(|t| level(t, n)));
        let peak = beside.or_else(|| torque((*self.peak_n.get_or_init(|| self.find_peak_n()))?));
        peak.map_or(self.end_torque_nm(), |t| t.v)
    }

    /// N at which its last arc, if that went on, would carry most, N.
    fn find_peak_n(&self) -> Option<f64> {
        let k = self.arcs.len() - 1;
        let arc = &self.arcs[k];
        arc_end(
            &self.statics,
            self.first + k,
            self.speed_rad_s,
            arc.n_from,
            arc.shift,
            f64::INFINITY,
            self.effort(),
        )
        .map(|(n, _)| n)
    }

    /// Equilibrium at first contact.
    pub fn touch(&self) -> &Closure {
        &self.touch
    }

    pub(super) fn closure_in(&self, k: usize, n: f64) -> Option<Closure> {
        self.statics.closure(self.first + k, n, self.speed_rad_s, self.arcs[k].shift).ok()
    }

    /// Index in the profile of the curve's first arc (0 but for races that grow past a junction).
    pub fn first_arc(&self) -> usize {
        self.first
    }
}
