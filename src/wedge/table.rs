//! One arc of the wedge curve as Chebyshev panels.
//!
//! On the first arc N ~ (alpha - alpha_0)^(1/0.9) is singular at first contact but analytic in N^0.1, so arc 1
//! is tabulated in s = (alpha - alpha_0)^(1/q) with q = 9 (roller-like laws; 10 for the logarithmic one),
//! later arcs in alpha itself. Inside an arc every lane is one smooth function, but where an edge of the patch at A
//! passes a junction and the law knows the radius: there delta_H goes on as (x - x_0)^(5/2), and a panel ends.

use super::build::Effort;
use super::closure::{Closure, FIRST_CONTACT_N, NoClosure, Statics};
use super::curve::WedgePoint;
use super::quick::{MOST_CUTS, left_out};
use crate::numeric::{
    panels::{Grade, Panels},
    pieces::Pieces,
    quadrature,
};

pub(super) const LANES: usize = 11;
/// Lanes of the table that is read: those of the panels, the slopes of rho_i and rho_e, and the windup, W/s^q on the
/// first arc, W on the later ones.
pub(super) const READ: usize = LANES + 3;

/// Distance from first contact below which the geometry is read level, rad.
const LEVEL_RAD: f64 = 1e-9;
/// Where by that the slopes of rho are largest, rad.
pub(crate) const RHO_STEEPEST_RAD: f64 = 1.23 * LEVEL_RAD;
/// From here on, in parts of [`LEVEL_RAD`], nothing is levelled: e^-40 is less than rounding.
const FREE: f64 = 40.0;

/// Where the geometry `x` >= 0 (rad) from first contact is read, and the slope of that. rho' is singular (integrably, as
/// x^(1/q - 1)) at first contact: within 1e-9 rad rho moves by some 1e-4. There x + H e^(-x/H) is read for x, level at
/// x = 0, so that velocities and their constraints agree and nothing jumps: alpha'' holds rho' alpha'^2, and a step of high
/// order would have to end where rho' jumps. The jump at first contact is taken as every jump of rho is.
#[inline(always)]
pub(super) fn levelled(x: f64) -> (f64, f64) {
    if x > FREE * LEVEL_RAD {
        return (x, 1.0);
    }
    let rest = (-x / LEVEL_RAD).exp();
    (x + LEVEL_RAD * rest, 1.0 - rest)
}

/// Panels of the first arc in s, as fractions of its end. The lowest two hold N below 1e-10 of the end's and
/// matter only for continuity.
const FIRST_BREAKS: [f64; 6] = [0.0, 0.02, 0.1, 0.3, 0.6, 1.0];
/// The same with the bulk of a sprag, a polynomial in the turn, which goes with s to the power of q.
const BULK_BREAKS: [f64; 7] = [0.0, 0.02, 0.1, 0.3, 0.6, 0.8, 1.0];
/// The same for contacts that are shaped along the axis, which open and close along their length.
pub(super) const SHAPED_BREAKS: [f64; 14] =
    [0.0, 0.02, 0.1, 0.2, 0.3, 0.35, 0.4, 0.45, 0.5, 0.55, 0.6, 0.7, 0.8, 1.0];

/// Breaks of the first arc up to `end`.
fn first_breaks(statics: &Statics, end: f64) -> Vec<f64> {
    let breaks: &[f64] = match (statics.elastic.is_shaped(), statics.bulk.is_some()) {
        (true, _) => &SHAPED_BREAKS,
        (false, true) => &BULK_BREAKS,
        (false, false) => &FIRST_BREAKS,
    };
    breaks.iter().map(|b| b * end).collect()
}

#[derive(Debug, Clone)]
pub(super) struct ArcTable {
    pub(super) alpha_until: f64,
    pub(super) n_from: f64,
    pub(super) n_until: f64,
    /// Turn of the contact at n_until, rad.
    pub(super) turn_until_rad: f64,
    /// Torque at n_until, N m.
    pub(super) torque_until_nm: f64,
    pub(super) shift: f64,
    /// Where panels had to end, N.
    pub(super) edges: Vec<Edge>,
    /// Times that panels of a quick table were halved.
    pub(super) cuts: u32,
    pub(super) lanes: Panels<LANES>,
    /// The lanes, the slopes of rho_i and rho_e by the variable of the table, the windup.
    pub(super) table: Pieces<READ>,
}

impl ArcTable {
    /// W at alpha, rad; `first` holds (alpha_0, q) on the first arc.
    pub(super) fn windup_rad(&self, alpha: f64, first: Option<(f64, f64)>) -> f64 {
        match first {
            Some((alpha0, q)) => {
                let x = (alpha - alpha0).max(0.0);
                x * self.table.at(x.powf(1.0 / q))[READ - 1]
            }
            None => self.table.at(alpha)[READ - 1],
        }
    }
}

/// `slope`: d(variable of the table)/d alpha; `unit`: what the windup's lane is to be multiplied by.
#[inline(always)]
pub(super) fn point(v: &[f64; READ], n_bi: f64, slope: f64, unit: f64) -> WedgePoint {
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
        rho_i_slope: v[LANES] * slope,
        rho_e_slope: v[LANES + 1] * slope,
        windup: v[READ - 1] * unit,
    }
}

pub(super) fn lanes_of(c: &Closure, normal_lane: f64) -> [f64; LANES] {
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

/// Where an edge of the patch passes a junction, in one of the variables N, N^0.1, s, alpha.
#[derive(Debug, Clone, Copy)]
pub(super) struct Edge {
    pub(super) at: f64,
    /// The patch comes upon the junction; else it leaves it. Half-integer powers lie on the side where the junction is
    /// under the patch.
    pub(super) comes: bool,
}

/// Panels: their breaks and how each is graded.
pub(super) struct Layout {
    pub(super) breaks: Vec<f64>,
    grades: Vec<Grade>,
}

impl Layout {
    /// `fixed` breaks with those of `edges` that lie inside; a fixed one gives way to an edge near it. An edge so near
    /// to an end or to the one before that its panel would be a thousandth of the whole is left to the panel.
    pub(super) fn new(fixed: &[f64], edges: &[Edge]) -> Self {
        let (from, until) = (fixed[0], fixed[fixed.len() - 1]);
        let apart = 1e-3 * (until - from);
        let mut kept: Vec<Edge> = Vec::new();
        for &e in edges {
            let last = kept.last().map_or(from, |k| k.at);
            if e.at > last + apart && e.at < until - apart {
                kept.push(e);
            }
        }
        let near = |b: f64| 0.1 * (b - from).min(until - b);
        let free = |b: f64| kept.iter().all(|e| (e.at - b).abs() > near(b));
        let mut breaks: Vec<(f64, Option<bool>)> = kept.iter().map(|e| (e.at, Some(e.comes))).collect();
        breaks.extend(fixed.iter().filter(|&&b| b == from || b == until || free(b)).map(|&b| (b, None)));
        breaks.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut layout = Self { breaks: vec![from], grades: Vec::new() };
        for w in breaks.windows(2) {
            match (w[0].1, w[1].1) {
                (Some(true), Some(false)) => {
                    layout.push(0.5 * (w[0].0 + w[1].0), Grade::From);
                    layout.push(w[1].0, Grade::Until);
                }
                (Some(true), _) => layout.push(w[1].0, Grade::From),
                (_, Some(false)) => layout.push(w[1].0, Grade::Until),
                _ => layout.push(w[1].0, Grade::Smooth),
            }
        }
        layout
    }

    fn push(&mut self, until: f64, grade: Grade) {
        self.breaks.push(until);
        self.grades.push(grade);
    }

    pub(super) fn panels<const M: usize, E>(
        &self,
        f: impl FnMut(f64) -> Result<[f64; M], E>,
    ) -> Result<Panels<M>, E> {
        Panels::build_graded(&self.breaks, &self.grades, f)
    }
}

pub(super) struct ArcBuilder<'a> {
    pub(super) statics: &'a Statics,
    pub(super) k: usize,
    pub(super) speed: f64,
    pub(super) shift: f64,
}

impl ArcBuilder<'_> {
    /// Forces inside the arc at which a panel has to end.
    fn edges(&self, n_from: f64, n_until: f64) -> Vec<Edge> {
        if !self.statics.feels_junctions() {
            return Vec::new();
        }
        let passages =
            self.statics.edge_passages(self.k, n_from, n_until, self.speed, self.shift, self.statics.effort);
        passages.into_iter().map(|(n, _, comes)| Edge { at: n, comes }).collect()
    }

    pub(super) fn closure(&self, n: f64) -> Result<Closure, NoClosure> {
        self.statics.closure(self.k, n, self.speed, self.shift)
    }

    pub(super) fn build(
        &self,
        n_from: f64,
        n_until: f64,
        windup_from: f64,
        first: bool,
        like: Option<&ArcTable>,
    ) -> Result<ArcTable, NoClosure> {
        let end = self.closure(n_until)?;
        let alpha_until = end.alpha.v;
        // Next to where they are a panel holds all but the second order of what they move by.
        let edges = like.map_or_else(|| self.edges(n_from, n_until), |like| like.edges.clone());
        let mut cuts = like.map_or(0, |like| like.cuts);
        let (lanes, windup) = if self.statics.effort != Effort::Full {
            // Next to one that does, as often as there.
            let most = if like.is_some() { cuts } else { MOST_CUTS };
            loop {
                let found = self.quickly(n_from, n_until, windup_from, first, &edges, alpha_until, cuts)?;
                let left_out = left_out(&found.0, first, self.statics.exponent, cuts);
                if cuts == most || left_out < self.statics.effort.trusted() {
                    break found;
                }
                cuts += 1;
            }
        } else if first {
            let (lanes, layout, s_edges) = self.first(n_until, &edges)?;
            let windup = first_windup(&lanes, &layout, &s_edges, self.statics.exponent);
            (lanes, windup)
        } else {
            let alpha_from = self.closure(n_from)?.alpha.v;
            let at_alpha = |e: &Edge| Ok(Edge { at: self.closure(e.at)?.alpha.v, ..*e });
            let alpha_edges = edges.iter().map(at_alpha).collect::<Result<Vec<_>, _>>()?;
            let layout =
                Layout::new(&[alpha_from, 0.5 * (alpha_from + alpha_until), alpha_until], &alpha_edges);
            let lanes = self.later(&layout, n_from, n_until)?;
            let windup = later_windup(&lanes, &layout, windup_from);
            (lanes, windup)
        };
        let table = Pieces::of(&lanes, &lanes.derivative([2, 3]), &windup);
        let torque_until_nm = end.torque_nm(self.statics.count).v;
        let turn_until_rad = end.turn_rad(self.statics.profile.beta0_rad);
        Ok(ArcTable {
            alpha_until,
            n_from,
            n_until,
            turn_until_rad,
            torque_until_nm,
            shift: self.shift,
            edges,
            cuts,
            lanes,
            table,
        })
    }

    /// Arc 1, lanes over s. alpha - alpha_0 = 10 int_0^z (z alpha_N) z^8 dz with N = z^10 keeps relative
    /// accuracy down to N -> 0, which a difference of two alphas does not. Returns s at the `edges` (N) as well.
    fn first(&self, n_until: f64, edges: &[Edge]) -> Result<(Panels<LANES>, Layout, Vec<Edge>), NoClosure> {
        let z_end = n_until.powf(0.1);
        let edges: Vec<Edge> = edges.iter().map(|e| Edge { at: e.at.powf(0.1), ..*e }).collect();
        let rate = Layout::new(&first_breaks(self.statics, z_end), &edges)
            .panels::<1, _>(|z| Ok([z * self.closure(z.powi(10).max(FIRST_CONTACT_N))?.alpha.d]))?;
        // A(z) = (alpha - alpha_0)/z^9, split so that each piece of the quadrature is smooth.
        let mean = |z: f64| 10.0 * unit_integral(z, &edges, |x| rate.at(z * x)[0] * x.powi(8));
        let q = self.statics.exponent;
        let of = |z: f64| (z.powi(9) * mean(z)).powf(1.0 / q);
        let s_end = of(z_end);
        let s_edges: Vec<Edge> = edges.iter().map(|e| Edge { at: of(e.at), ..*e }).collect();
        let layout = Layout::new(&first_breaks(self.statics, s_end), &s_edges);
        let lanes = layout.panels(|s| {
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
        })?;
        Ok((lanes, layout, s_edges))
    }

    /// Later arcs, lanes over alpha.
    fn later(&self, layout: &Layout, n_from: f64, n_until: f64) -> Result<Panels<LANES>, NoClosure> {
        let (from, until) = (layout.breaks[0], layout.breaks[layout.breaks.len() - 1]);
        layout.panels(|alpha| {
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

/// Integral of f(x) over [0, 1] in two halves, and split where z x passes an edge: to rounding for the weights x^8
/// and x^9 used here.
pub(super) fn unit_integral(z: f64, edges: &[Edge], f: impl Fn(f64) -> f64) -> f64 {
    let mut splits = vec![0.0, 0.5, 1.0];
    splits.extend(edges.iter().map(|e| e.at / z).filter(|x| *x < 1.0));
    splits.sort_by(f64::total_cmp);
    splits.windows(2).map(|w| quadrature::integral(w[0], w[1], &f)).sum()
}

/// W/s^q on arc 1 as a function of s.
fn first_windup(lanes: &Panels<LANES>, layout: &Layout, edges: &[Edge], q: f64) -> Panels<1> {
    let exponent = q as i32 - 1;
    let mean = |s: f64| {
        q * unit_integral(s, edges, |x| {
            let v = lanes.at(s * x);
            (v[2] + v[3]) * x.powi(exponent)
        })
    };
    let build: Result<_, std::convert::Infallible> = layout.panels(|s| Ok([mean(s)]));
    match build {
        Ok(p) => p,
    }
}

/// W on a later arc as a function of alpha: the integral of rho_i + rho_e from the arc's beginning.
pub(super) fn later_windup(lanes: &Panels<LANES>, layout: &Layout, windup_from: f64) -> Panels<1> {
    let rate = |a: f64| {
        let v = lanes.at(a);
        v[2] + v[3]
    };
    let breaks = &layout.breaks;
    let mut until = vec![0.0];
    for w in breaks.windows(2) {
        until.push(until[until.len() - 1] + quadrature::integral(w[0], w[1], rate));
    }
    let build: Result<_, std::convert::Infallible> = layout.panels(|a| {
        let panel = breaks[1..breaks.len() - 1].partition_point(|&b| b < a);
        Ok([windup_from + (until[panel] + quadrature::integral(breaks[panel], a, rate))])
    });
    match build {
        Ok(p) => p,
    }
}
