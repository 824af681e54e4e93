//! The wedge curve of one design at one mean speed: built once, then only evaluated.
//!
//! On the first arc N ~ (alpha - alpha_0)^(1/0.9) is singular at first contact but analytic in N^0.1, so arc 1
//! is tabulated in s = (alpha - alpha_0)^(1/q) with q = 9 (roller-like laws; 10 for the logarithmic one),
//! later arcs in alpha itself. Inside an arc every lane is one smooth function.

use super::closure::{Closure, FIRST_CONTACT_N, NoClosure, Statics};
use super::elastic::NoElastic;
use crate::design::{Clutch, ContactLaw};
use crate::numeric::{panels::Panels, quadrature, root};
use crate::profile::Profile;

/// Why the curve ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EndReason {
    /// The contact reaches the end of the last arc.
    OffProfile,
    /// Torque has its maximum: beyond it the sprag rolls over.
    RollsOver,
    /// No equilibrium was found.
    NoConvergence,
}

impl EndReason {
    /// Name for reports and JSON.
    pub fn name(self) -> &'static str {
        match self {
            Self::OffProfile => "off-profile",
            Self::RollsOver => "rolls-over",
            Self::NoConvergence => "no-convergence",
        }
    }
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
}

const LANES: usize = 11;

/// Distance from first contact below which the slope of the rolling ratios is held, rad.
const SLOPE_HELD_RAD: f64 = 1e-9;

/// Panels of the first arc in s, as fractions of its end. The lowest two hold N below 1e-10 of the end's and
/// matter only for continuity.
const FIRST_BREAKS: [f64; 6] = [0.0, 0.02, 0.1, 0.3, 0.6, 1.0];

#[derive(Debug, Clone)]
struct Arc {
    alpha_until: f64,
    n_from: f64,
    n_until: f64,
    shift: f64,
    lanes: Panels<LANES>,
    rho_slopes: Panels<2>,
    /// W/s^q on the first arc, W on the later ones.
    windup: Panels<1>,
}

impl Arc {
    /// W at alpha, rad; `first` holds (alpha_0, q) on the first arc.
    fn windup_rad(&self, alpha: f64, first: Option<(f64, f64)>) -> f64 {
        match first {
            Some((alpha0, q)) => {
                let x = (alpha - alpha0).max(0.0);
                x * self.windup.at(x.powf(1.0 / q))[0]
            }
            None => self.windup.at(alpha)[0],
        }
    }
}

/// Wedge curve N(alpha), geometry, rolling ratios and windup, at one mean speed.
#[derive(Debug, Clone)]
pub struct WedgeCurve {
    statics: Statics,
    speed_rad_s: f64,
    exponent: f64,
    alpha0: f64,
    first: usize,
    arcs: Vec<Arc>,
    end: EndReason,
    /// Geometry at first contact, for the open clutch.
    touch: Closure,
}

/// Why a curve cannot be built at all.
#[derive(Debug, Clone, PartialEq)]
pub enum NoCurve {
    /// First contact at this speed lies beyond the profile or the sprag has rolled over.
    NoFirstContact,
    /// A closure did not settle.
    NoConvergence,
    /// The elastic laws cannot be set up.
    NoElastic(NoElastic),
}

impl std::fmt::Display for NoCurve {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::NoFirstContact => f.write_str(
                "no first contact at this speed: it lies beyond the profile, or the sprag has rolled over",
            ),
            Self::NoConvergence => f.write_str("a point of the curve did not converge"),
            Self::NoElastic(why) => write!(f, "{why}"),
        }
    }
}

impl std::error::Error for NoCurve {}

impl WedgeCurve {
    /// Build the curve of `clutch` at mean speed `speed_rad_s`.
    ///
    /// # Errors
    /// [`NoCurve`] where there is no first contact. A curve that ends early is a result, see [`Self::end`].
    pub fn build(clutch: &Clutch, profile: &Profile, speed_rad_s: f64) -> Result<Self, NoCurve> {
        let statics = Statics::new(clutch, profile.clone()).map_err(NoCurve::NoElastic)?;
        let exponent = if matches!(clutch.contact, ContactLaw::Hertz) { 10.0 } else { 9.0 };
        let beta0 = profile.beta0_rad;
        // The arc on which first contact lies at this speed: growth of the race may already have turned it.
        let mut first = 0;
        let mut touch =
            statics.closure(0, FIRST_CONTACT_N, speed_rad_s, 0.0).map_err(|_| NoCurve::NoFirstContact)?;
        while touch.turn_rad(beta0) >= profile.arcs[first].until_rad {
            first += 1;
            if first >= profile.arcs.len() {
                return Err(NoCurve::NoFirstContact);
            }
            touch = statics
                .closure(first, FIRST_CONTACT_N, speed_rad_s, 0.0)
                .map_err(|_| NoCurve::NoFirstContact)?;
        }
        let alpha0 = touch.alpha.v;
        let mut arcs: Vec<Arc> = Vec::new();
        let (mut n_from, mut shift, mut windup_from) = (0.0, 0.0, 0.0);
        let mut end = EndReason::OffProfile;
        for k in first..profile.arcs.len() {
            if let Some(last) = arcs.last() {
                // The paper's Figure 5: N stays, arc k starts where it carries N_J, the rest is added from there.
                let raw = statics.closure(k, last.n_until, speed_rad_s, 0.0);
                match raw {
                    Ok(c) => shift = last.alpha_until - c.alpha.v,
                    Err(_) => {
                        end = EndReason::RollsOver;
                        break;
                    }
                }
            }
            let reach = arc_end(&statics, k, speed_rad_s, n_from, shift, profile.arcs[k].until_rad);
            let Some((n_until, reason)) = reach else {
                end = EndReason::RollsOver;
                break;
            };
            let arc = ArcBuilder { statics: &statics, k, speed: speed_rad_s, shift, alpha0, exponent }
                .build(n_from, n_until, windup_from, k == first)
                .map_err(|_| NoCurve::NoConvergence)?;
            windup_from = arc.windup_rad(arc.alpha_until, (k == first).then_some((alpha0, exponent)));
            arcs.push(arc);
            n_from = n_until;
            if let Some(reason) = reason {
                end = reason;
                break;
            }
        }
        if arcs.is_empty() {
            return Err(NoCurve::NoFirstContact);
        }
        Ok(Self { statics, speed_rad_s, exponent, alpha0, first, arcs, end, touch })
    }

    /// alpha at first contact at this speed, rad (0 at rest).
    pub fn first_contact_rad(&self) -> f64 {
        self.alpha0
    }
    /// Mean speed of the curve, rad/s.
    pub fn speed_rad_s(&self) -> f64 {
        self.speed_rad_s
    }
    /// Number of arcs that the curve reaches.
    pub fn arc_count(&self) -> usize {
        self.arcs.len()
    }
    /// alpha at which arc `k` (from 0) ends, rad.
    pub fn arc_end_rad(&self, k: usize) -> f64 {
        self.arcs[k].alpha_until
    }
    /// N_bi at the end of arc `k`, N.
    pub fn arc_end_n(&self, k: usize) -> f64 {
        self.arcs[k].n_until
    }
    /// Arc in which `alpha` lies.
    pub fn arc_at(&self, alpha: f64) -> usize {
        self.arcs[..self.arcs.len() - 1].partition_point(|a| a.alpha_until < alpha)
    }
    /// Why and where (alpha, rad) the curve ends.
    pub fn end(&self) -> (EndReason, f64) {
        (self.end, self.arcs[self.arcs.len() - 1].alpha_until)
    }
    /// The equations behind the curve.
    pub fn statics(&self) -> &Statics {
        &self.statics
    }
    /// Relative size of what the interpolation leaves out, pure number, where N exceeds 1e-10 of its largest.
    pub fn truncation(&self) -> f64 {
        let skip = |k: usize| if k == 0 { 2 } else { 0 };
        self.arcs.iter().enumerate().map(|(k, a)| a.lanes.truncation(skip(k))).fold(0.0, f64::max)
    }

    /// Everything at `alpha`, with the functions of arc `k`, which are continued smoothly a little past its
    /// ends so that a trial step sees no kink. Below first contact N stays 0.
    pub fn in_arc(&self, k: usize, alpha: f64) -> WedgePoint {
        let arc = &self.arcs[k];
        if k > 0 {
            let v = arc.lanes.at(alpha);
            let slopes = arc.rho_slopes.at(alpha);
            return point(&v, v[8], slopes);
        }
        // s = (alpha - alpha_0)^(1/q); N = (s * z/s)^10.
        let x = alpha - self.alpha0;
        let s = x.max(1e-24).powf(1.0 / self.exponent);
        let v = arc.lanes.at(s);
        // rho' is singular (integrably, as x^(1/q - 1)) at first contact; below x = 1e-9 rad rho itself
        // changes by less than 1e-6 and its slope is held.
        let (x, s) = if x > SLOPE_HELD_RAD {
            (x, s)
        } else {
            (SLOPE_HELD_RAD, SLOPE_HELD_RAD.powf(1.0 / self.exponent))
        };
        let slopes = arc.rho_slopes.at(s).map(|d| d * s / (self.exponent * x));
        point(&v, if alpha > self.alpha0 { (s * v[8]).powi(10) } else { 0.0 }, slopes)
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
        let (reach, azimuth) = (gx.hypot(gy), gx.atan2(gy));
        // alpha = Omega + gamma(Omega) - gamma_0; d gamma/d Omega = -(reach^2 + reach oc_e cos)/OC_g^2.
        let mut rotation = alpha;
        let (mut x, mut y) = (0.0, oc_e);
        for _ in 0..30 {
            let (s, c) = (rotation + azimuth).sin_cos();
            (x, y) = (reach * s, oc_e + reach * c);
            let slope = 1.0 - (reach * reach + reach * oc_e * c) / (x * x + y * y);
            let miss = rotation - x.atan2(y) - self.statics.gamma0_rad() - alpha;
            rotation -= miss / slope;
            if miss.abs() < 1e-15 {
                break;
            }
        }
        let (oc_g, gamma) = (x.hypot(y), -x.atan2(y));
        let (oa, ob) = (self.touch.lengths.oa.v, self.touch.lengths.ob.v);
        let (sin_g, cos_g) = gamma.sin_cos();
        let oc_g_slope = oc_g * sin_g / cos_g;
        let beta_gamma = self.touch.beta.v + gamma;
        let (rho_i, _) = crate::kinematics::rolling_ratios(oa, ob, oc_g, oc_g_slope, beta_gamma, gamma);
        let rho_e = (ob - oc_g / cos_g) / ob;
        // d/dalpha (OC_g/cos gamma) with gamma' = dgamma/dOmega / (1 + dgamma/dOmega).
        let (_, c) = (rotation + azimuth).sin_cos();
        let gamma_by_rotation = -(reach * reach + reach * oc_e * c) / (oc_g * oc_g);
        let gamma_slope = gamma_by_rotation / (1.0 + gamma_by_rotation);
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
        }
    }

    /// Windup W(alpha) >= 0 of the rolling clutch, rad; 0 at and below first contact.
    ///
    /// Eq. (A.7), with the integral that the paper replaces by a product.
    #[doc(alias = "Eq. (A.7)")]
    pub fn windup_rad(&self, alpha: f64) -> f64 {
        if alpha <= self.alpha0 {
            return 0.0;
        }
        let k = self.arc_at(alpha);
        self.arcs[k].windup_rad(alpha, (k == 0).then_some((self.alpha0, self.exponent)))
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
            let (fa, fb) = (miss(a), miss(b));
            if fb < 0.0 || fa > 0.0 && k == 0 {
                continue;
            }
            let n = if fa >= 0.0 { a } else { root::bracketed(a, b, fa, fb, 1e-15 * b, miss)? };
            return self.closure_in(k, n).map(|c| (k, c));
        }
        None
    }

    /// alpha at inner normal force `n_bi`.
    pub fn alpha_at_normal(&self, n_bi: f64) -> Option<f64> {
        self.closure_at_normal(n_bi).map(|(_, c)| c.alpha.v)
    }

    /// Torque at the end of the curve, N m.
    pub fn end_torque_nm(&self) -> f64 {
        let k = self.arcs.len() - 1;
        self.closure_in(k, self.arcs[k].n_until).map_or(0.0, |c| c.torque_nm(self.statics.count).v)
    }

    /// Torque at which the sprag would roll over if its last arc went on, N m; the curve's own end where it
    /// rolls over already.
    pub fn roll_over_torque_nm(&self) -> f64 {
        let k = self.arcs.len() - 1;
        if self.end == EndReason::RollsOver {
            return self.end_torque_nm();
        }
        let arc = &self.arcs[k];
        arc_end(&self.statics, self.first + k, self.speed_rad_s, arc.n_from, arc.shift, f64::INFINITY)
            .and_then(|(n, _)| self.closure_in(k, n))
            .map_or(self.end_torque_nm(), |c| c.torque_nm(self.statics.count).v)
    }

    /// Equilibrium at first contact.
    pub fn touch(&self) -> &Closure {
        &self.touch
    }

    fn closure_in(&self, k: usize, n: f64) -> Option<Closure> {
        self.statics.closure(self.first + k, n, self.speed_rad_s, self.arcs[k].shift).ok()
    }

    /// Index in the profile of the curve's first arc (0 but for races that grow past a junction).
    pub fn first_arc(&self) -> usize {
        self.first
    }
}

fn point(v: &[f64; LANES], n_bi: f64, slopes: [f64; 2]) -> WedgePoint {
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

/// N at which arc `k` ends and, where that ends the curve, why. `None`: nothing of this arc can be used.
fn arc_end(
    statics: &Statics,
    k: usize,
    speed: f64,
    n_from: f64,
    shift: f64,
    until: f64,
) -> Option<(f64, Option<EndReason>)> {
    let beta0 = statics.profile.beta0_rad;
    let last = k + 1 == statics.profile.arcs.len();
    let state = |n: f64| statics.closure(k, n, speed, shift).ok();
    // Positive while the arc goes on: turn left over, and torque still rising.
    let left = |n: f64| state(n).map_or(-1.0, |c| until - c.turn_rad(beta0));
    let rising = |n: f64| state(n).map_or(-1.0, |c| c.torque_nm(1).d);
    let (mut a, mut n) = (n_from.max(FIRST_CONTACT_N), (1.02 * n_from).max(1.0));
    for _ in 0..4000 {
        if left(n) <= 0.0 && state(n).is_some() || rising(n) <= 0.0 {
            break;
        }
        a = n;
        n *= 1.1;
    }
    let off = state(n).is_some() && left(n) <= 0.0;
    let n_off = if off { root::bracketed(a, n, left(a), left(n), 1e-15 * n, left)? } else { n };
    if rising(n_off) > 0.0 && off {
        return Some((n_off, last.then_some(EndReason::OffProfile)));
    }
    let n_over = root::bracketed(a, n_off, rising(a), rising(n_off), 1e-12 * n, rising)?;
    // Stay where the closure exists.
    let n_over = if state(n_over).is_some() { n_over } else { n_over * (1.0 - 1e-9) };
    state(n_over).filter(|_| n_over > n_from)?;
    Some((n_over, Some(EndReason::RollsOver)))
}

struct ArcBuilder<'a> {
    statics: &'a Statics,
    k: usize,
    speed: f64,
    shift: f64,
    alpha0: f64,
    exponent: f64,
}

impl ArcBuilder<'_> {
    fn closure(&self, n: f64) -> Result<Closure, NoClosure> {
        self.statics.closure(self.k, n, self.speed, self.shift)
    }

    fn build(&self, n_from: f64, n_until: f64, windup_from: f64, first: bool) -> Result<Arc, NoClosure> {
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
        Ok(Arc { alpha_until, n_from, n_until, shift, lanes, rho_slopes, windup })
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
