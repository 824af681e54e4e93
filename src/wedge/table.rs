//! One arc of the wedge curve as Chebyshev panels.
//!
//! On the first arc N ~ (alpha - alpha_0)^(1/0.9) is singular at first contact but analytic in N^0.1, so arc 1
//! is tabulated in s = (alpha - alpha_0)^(1/q) with q = 9 (roller-like laws; 10 for the logarithmic one),
//! later arcs in alpha itself. Inside an arc every lane is one smooth function.

use super::closure::{Closure, FIRST_CONTACT_N, NoClosure, Statics};
use super::curve::WedgePoint;
use crate::numeric::{panels::Panels, quadrature};

pub(super) const LANES: usize = 11;

/// Distance from first contact below which the slope of the rolling ratios is held, rad.
pub(super) const SLOPE_HELD_RAD: f64 = 1e-9;

/// Panels of the first arc in s, as fractions of its end. The lowest two hold N below 1e-10 of the end's and
/// matter only for continuity.
const FIRST_BREAKS: [f64; 6] = [0.0, 0.02, 0.1, 0.3, 0.6, 1.0];

#[derive(Debug, Clone)]
pub(super) struct ArcTable {
    pub(super) alpha_until: f64,
    pub(super) n_from: f64,
    pub(super) n_until: f64,
    pub(super) shift: f64,
    pub(super) lanes: Panels<LANES>,
    pub(super) rho_slopes: Panels<2>,
    /// W/s^q on the first arc, W on the later ones.
    windup: Panels<1>,
}

impl ArcTable {
    /// W at alpha, rad; `first` holds (alpha_0, q) on the first arc.
    pub(super) fn windup_rad(&self, alpha: f64, first: Option<(f64, f64)>) -> f64 {
        match first {
            Some((alpha0, q)) => {
                let x = (alpha - alpha0).max(0.0);
                x * self.windup.at(x.powf(1.0 / q))[0]
            }
            None => self.windup.at(alpha)[0],
        }
    }
}

pub(super) fn point(v: &[f64; LANES], n_bi: f64, slopes: [f64; 2]) -> WedgePoint {
    WedgePoint {
        oa: v[0],
        ob: v[1],
        rho_i: v[2],
        rho_e: v[3],
        oc_g: v[4],
        oc_g_slope: v[5],
        beta_gamma: v[6],
        gamma: v[7],
        n_bi,
        t_static: n_bi * v[9] + v[10],
        rho_i_slope: slopes[0],
        rho_e_slope: slopes[1],
    }
}

fn lanes_of(c: &Closure, normal_lane: f64) -> [f64; LANES] {
    let (rho_i, rho_e) = c.rolling_ratios();
    [
        c.lengths.oa.v,
        c.lengths.ob.v,
        rho_i,
        rho_e,
        c.oc_g.v,
        c.oc_g_slope(),
        c.beta.v + c.gamma.v,
        c.gamma.v,
        normal_lane,
        c.t_ratio,
        c.t_offset_n,
    ]
}

pub(super) struct ArcBuilder<'a> {
    pub(super) statics: &'a Statics,
    pub(super) k: usize,
    pub(super) speed: f64,
    pub(super) shift: f64,
    pub(super) alpha0: f64,
    pub(super) exponent: f64,
}

impl ArcBuilder<'_> {
    fn closure(&self, n: f64) -> Result<Closure, NoClosure> {
        self.statics.closure(self.k, n, self.speed, self.shift)
    }

    pub(super) fn build(
        &self,
        n_from: f64,
        n_until: f64,
        windup_from: f64,
        first: bool,
    ) -> Result<ArcTable, NoClosure> {
        let end = self.closure(n_until)?;
        let alpha_until = end.alpha.v;
        let (lanes, windup) = if first {
            let lanes = self.first(n_until)?;
            let s_end = (alpha_until - self.alpha0).powf(1.0 / self.exponent);
            let windup = first_windup(&lanes, s_end, self.exponent);
            (lanes, windup)
        } else {
            let alpha_from = self.closure(n_from)?.alpha.v;
            let lanes = self.later(alpha_from, alpha_until, n_from, n_until)?;
            let windup = later_windup(&lanes, alpha_from, alpha_until, windup_from);
            (lanes, windup)
        };
        let rho_slopes = lanes.derivative([2, 3]);
        let shift = self.shift;
        Ok(ArcTable { alpha_until, n_from, n_until, shift, lanes, rho_slopes, windup })
    }

    /// Arc 1, lanes over s. alpha - alpha_0 = 10 int_0^z (z alpha_N) z^8 dz with N = z^10 keeps relative
    /// accuracy down to N -> 0, which a difference of two alphas does not.
    fn first(&self, n_until: f64) -> Result<Panels<LANES>, NoClosure> {
        let z_end = n_until.powf(0.1);
        let rate = Panels::<1>::build(&FIRST_BREAKS.map(|b| b * z_end), |z| {
            Ok([z * self.closure(z.powi(10).max(FIRST_CONTACT_N))?.alpha.d])
        })?;
        // A(z) = (alpha - alpha_0)/z^9, split so that each piece of the quadrature is smooth.
        let mean = |z: f64| 10.0 * unit_integral(|x| rate.at(z * x)[0] * x.powi(8));
        let q = self.exponent;
        let s_end = (z_end.powi(9) * mean(z_end)).powf(1.0 / q);
        Panels::build(&FIRST_BREAKS.map(|b| b * s_end), |s| {
            // q ln s = 9 ln z + ln A(z), by Newton in ln z.
            let mut z = z_end * s / s_end;
            for _ in 0..50 {
                let a = mean(z);
                let miss = 9.0 * z.ln() + a.ln() - q * s.ln();
                let step = miss * a / (10.0 * rate.at(z)[0]);
                z *= (-step).exp();
                if step.abs() < 1e-15 {
                    break;
                }
            }
            Ok(lanes_of(&self.closure(z.powi(10).max(FIRST_CONTACT_N))?, z / s))
        })
    }

    /// Later arcs, lanes over alpha.
    fn later(&self, from: f64, until: f64, n_from: f64, n_until: f64) -> Result<Panels<LANES>, NoClosure> {
        let middle = 0.5 * (from + until);
        Panels::build(&[from, middle, until], |alpha| {
            let mut n = n_from + (n_until - n_from) * (alpha - from) / (until - from);
            let mut c = self.closure(n)?;
            for _ in 0..50 {
                let step = (alpha - c.alpha.v) / c.alpha.d;
                n = (n + step).clamp(0.5 * n_from, 2.0 * n_until);
                c = self.closure(n)?;
                if step.abs() < 1e-13 * n {
                    break;
                }
            }
            Ok(lanes_of(&c, n))
        })
    }
}

/// Integral over [0, 1] in two halves: to rounding for the weights x^8 and x^9 used here.
fn unit_integral(f: impl Fn(f64) -> f64) -> f64 {
    quadrature::integral(0.0, 0.5, &f) + quadrature::integral(0.5, 1.0, &f)
}

/// W/s^q on arc 1 as a function of s.
fn first_windup(lanes: &Panels<LANES>, s_end: f64, q: f64) -> Panels<1> {
    let exponent = q as i32 - 1;
    let mean = |s: f64| {
        q * unit_integral(|x| {
            let v = lanes.at(s * x);
            (v[2] + v[3]) * x.powi(exponent)
        })
    };
    let build: Result<_, std::convert::Infallible> =
        Panels::build(&FIRST_BREAKS.map(|b| b * s_end), |s| Ok([mean(s)]));
    match build {
        Ok(p) => p,
    }
}

/// W on a later arc as a function of alpha: the integral of rho_i + rho_e from the arc's beginning.
fn later_windup(lanes: &Panels<LANES>, from: f64, until: f64, windup_from: f64) -> Panels<1> {
    let rate = |a: f64| {
        let v = lanes.at(a);
        v[2] + v[3]
    };
    let middle = 0.5 * (from + until);
    let half = quadrature::integral(from, middle, rate);
    let build: Result<_, std::convert::Infallible> = Panels::build(&[from, middle, until], |a| {
        let rest = if a > middle {
            half + quadrature::integral(middle, a, rate)
        } else {
            quadrature::integral(from, a, rate)
        };
        Ok([windup_from + rest])
    });
    match build {
        Ok(p) => p,
    }
}
