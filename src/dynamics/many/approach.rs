//! The approach of the contacts of one sprag over its turn, and the normal force over that: what bent races are solved with.

use crate::numeric::panels::Panels;
use crate::numeric::pieces::Pieces;
use crate::numeric::{quadrature, root};
use crate::wedge::{WedgeCurve, WedgePoint};

/// From here on, rad from first contact, a curve's geometry is its own: nearer it is read level. Below, D is straight and N a power of it.
const NEAR_RAD: f64 = 5e-8;
/// Panels of the first arc, as parts of the way from there to its end in the root of alpha or of D.
const PARTS: [f64; 4] = [0.0, 0.3, 0.6, 1.0];
/// Places on an arc where the slope of N is looked at.
const SLOPES: u32 = 64;
/// Coefficients of the series of a root beside one that is known, and up to which part of that they are enough: 0.08^13/(9 13) = 5e-17.
const SERIES: usize = 12;
const BESIDE: f64 = 0.08;

/// D over alpha of one curve, and N over D.
#[derive(Debug, Clone)]
pub struct SpragApproach {
    alpha0: f64,
    pub(super) exponent: f64,
    /// ((1 + e)^(1/q) - 1)/e by powers of e.
    series: [f64; SERIES],
    /// D' at first contact, m/rad, and at the end of the last place.
    pub(super) slopes: [f64; 2],
    /// D' below first contact, that of the geometry as it is read there, m/rad.
    level: f64,
    /// D/x and (D/x)^(1/q) over s = x^(1/q) on the first arc, x = alpha - alpha_0; D over alpha on the others, and nothing.
    pub(super) by_alpha: Vec<Pieces<2>>,
    /// Where arcs end, m.
    pub(super) ends: Vec<f64>,
    /// z from which on N^0.1/z and its slope are tabled over z = D^(1/q), and that ratio there.
    begins: [f64; 2],
    /// That table of the first arc; N (N) and its slope (N/m) over D on the others.
    by_approach: Vec<Pieces<2>>,
}

/// D' at `p`, m/rad.
fn rise(p: &WedgePoint) -> f64 {
    ratio(p) * p.oa * (p.rho_i + p.rho_e)
}

/// T_bi/N_bi that statics demands of a sprag without mass.
pub(super) fn ratio(p: &WedgePoint) -> f64 {
    let (sin, cos) = (p.beta_gamma - p.gamma).sin_cos();
    p.ob * sin / (p.ob * cos - p.oa)
}

impl SpragApproach {
    /// Of `curve`; `None` where it is too short to tell.
    pub fn new(curve: &WedgeCurve) -> Option<Self> {
        let (alpha0, q) = (curve.first_contact_rad(), curve.exponent());
        let at = |k: usize, alpha: f64| rise(&curve.in_arc(k, alpha));
        let first_end = curve.arc_end_rad(0) - alpha0;
        if first_end <= 2.0 * NEAR_RAD {
            return None;
        }
        let near = at(0, alpha0 + NEAR_RAD);
        let roots = [NEAR_RAD, first_end].map(|x| x.powf(1.0 / q));
        let between = |[from, until]: [f64; 2]| PARTS.map(|part| from + part * (until - from));
        // By s, x = s^q, in pieces.
        let way = |from: f64, until: f64| {
            let rate = |s: f64| at(0, alpha0 + s.powf(q)) * q * s.powf(q - 1.0);
            let piece = 0.25 * (until - from);
            (0..4)
                .map(|i| from + piece * f64::from(i))
                .map(|s| quadrature::integral(s, s + piece, rate))
                .sum::<f64>()
        };
        let first: Result<Panels<2>, ()> = Panels::build(&between(roots), |s| {
            let part = (near * NEAR_RAD + way(roots[0], s)) / s.powf(q);
            Ok([part, part.powf(1.0 / q)])
        });
        let mut found = Self {
            alpha0,
            exponent: q,
            series: series(1.0 / q),
            slopes: [near; 2],
            level: at(0, alpha0),
            by_alpha: vec![Pieces::of_all(&first.ok()?)],
            ends: Vec::new(),
            begins: [0.0; 2],
            by_approach: Vec::new(),
        };
        found.ends.push(found.at(0, curve.arc_end_rad(0)));
        // Beyond the end D goes on with the geometry, and falls again; N over D stays what it is on the arcs.
        for k in 1..curve.place_count() {
            let (from, until) = (curve.arc_end_rad(k - 1), curve.arc_end_rad(k));
            let before = found.ends[k - 1];
            let middle = 0.5 * (from + until);
            let half = |a: f64, b: f64| quadrature::integral(a, b, |alpha| at(k, alpha));
            let to = |alpha: f64| {
                if alpha <= middle { half(from, alpha) } else { half(from, middle) + half(middle, alpha) }
            };
            let panels: Result<Panels<2>, ()> =
                Panels::build(&[from, middle, until], |alpha| Ok([before + to(alpha), 0.0]));
            found.by_alpha.push(Pieces::of_all(&panels.ok()?));
            found.ends.push(found.at(k, until));
        }
        for k in 0..curve.arc_count() {
            let from = if k == 0 { alpha0 + NEAR_RAD } else { curve.arc_end_rad(k - 1) };
            let until = curve.arc_end_rad(k);
            let alpha_of = |d: f64| {
                let miss = |alpha: f64| found.at(k, alpha) - d;
                let (low, high) = (miss(from), miss(until));
                match (low >= 0.0, high <= 0.0) {
                    (true, _) => Some(from),
                    (_, true) => Some(until),
                    _ => root::bracketed(from, until, low, high, 1e-17, miss),
                }
            };
            let normal = |d: f64| Some(curve.in_arc(k, alpha_of(d)?).n_bi);
            let breaks = if k == 0 {
                between([found.at(0, from), found.ends[0]].map(|d| d.powf(1.0 / q))).to_vec()
            } else {
                let (a, b) = (found.ends[k - 1], found.ends[k]);
                vec![a, 0.5 * (a + b), b]
            };
            let value = |x: f64| if k == 0 { Some(normal(x.powf(q))?.powf(0.1) / x) } else { normal(x) };
            let values: Panels<1> = Panels::build(&breaks, |x| value(x).map(|v| [v]).ok_or(())).ok()?;
            let slopes = values.derivative([0]);
            let both: Result<Panels<2>, ()> =
                Panels::build(&breaks, |x| Ok([values.at(x)[0], slopes.at(x)[0]]));
            if k == 0 {
                found.begins = [breaks[0], values.at(breaks[0])[0]];
            }
            found.by_approach.push(Pieces::of_all(&both.ok()?));
        }
        let last = curve.arc_count() - 1;
        found.ends.truncate(last + 1);
        found.slopes[1] = at(last, curve.arc_end_rad(last));
        Some(found)
    }

    /// D at `alpha` (rad) with the functions of arc `k`, m; straight on below first contact.
    pub fn at(&self, k: usize, alpha: f64) -> f64 {
        let mut nowhere = NO_ROOT;
        self.rooted(k, alpha, &mut nowhere).0
    }

    /// The same with D^(1/q) where that comes by the way; `last`: a root of alpha - alpha_0 near by.
    pub(super) fn rooted(&self, k: usize, alpha: f64, last: &mut KnownRoot) -> (f64, Option<f64>) {
        if k > 0 {
            return (self.by_alpha[k].at(alpha)[0], None);
        }
        let x = alpha - self.alpha0;
        if x <= NEAR_RAD {
            return (if x < 0.0 { self.level } else { self.slopes[0] } * x, None);
        }
        let s = self.root(x, last);
        let [part, root] = self.by_alpha[0].at(s);
        (x * part, Some(s * root))
    }

    /// x^(1/q), by the series beside `last` where that is near.
    pub(super) fn root(&self, x: f64, last: &mut KnownRoot) -> f64 {
        let beside = (x - last.of) / last.of;
        if beside.abs() < BESIDE {
            return last.root
                * (1.0 + beside * self.series.iter().rev().fold(0.0, |sum, c| sum * beside + c));
        }
        *last = KnownRoot { of: x, root: x.powf(1.0 / self.exponent) };
        last.root
    }

    /// N_bi at the approach `d` (m), N, and its slope, N/m.
    pub fn normal(&self, d: f64) -> (f64, f64) {
        self.normal_by(d, |d| d.powf(1.0 / self.exponent))
    }

    /// The same, `root` (of what is asked for, m) its 1/q-th power.
    #[inline(always)]
    pub(super) fn normal_by(&self, d: f64, root: impl FnOnce(f64) -> f64) -> (f64, f64) {
        if d <= 0.0 {
            return (0.0, 0.0);
        }
        let last = self.ends.len() - 1;
        let k = self.ends[..last].partition_point(|&end| end < d);
        let within = d.min(self.ends[last]);
        let (n, slope) = if k > 0 {
            let [n, slope] = self.by_approach[k].at(within);
            (n, slope)
        } else {
            let z = root(within);
            let [r, bend] =
                if z <= self.begins[0] { [self.begins[1], 0.0] } else { self.by_approach[0].at(z) };
            let n = (z * r).powi(10);
            (n, 10.0 * n * (1.0 + z * bend / r) / (self.exponent * within))
        };
        (n + slope * (d - within), slope)
    }

    /// The steepest slope of N, N/m.
    pub(super) fn steepest(&self) -> f64 {
        let starts = std::iter::once(0.0).chain(self.ends.iter().copied());
        let looks = starts.zip(&self.ends).flat_map(|(from, until)| {
            (1..=SLOPES).map(move |i| from + f64::from(i) / f64::from(SLOPES) * (until - from))
        });
        looks.map(|d| self.normal(d).1).fold(0.0, f64::max)
    }

    /// alpha, rad, at which the approach is `d`, m, near first contact.
    pub(super) fn alpha_at(&self, d: f64) -> f64 {
        let mut x = d / self.slopes[0];
        for _ in 0..20 {
            let step = (d - self.at(0, self.alpha0 + x)) / self.slopes[0];
            x += step;
            if step.abs() < 1e-17 {
                break;
            }
        }
        self.alpha0 + x
    }

    /// int N dD from `from` to `until`, J.
    pub(super) fn stored_j(&self, from: f64, until: f64) -> f64 {
        const PIECES: u32 = 12;
        let q = self.exponent;
        let [a, b] = [from, until].map(|d| d.max(0.0).powf(1.0 / q));
        let piece = (b - a) / f64::from(PIECES);
        let at = |i: u32| a + piece * f64::from(i);
        let rate = |z: f64| self.normal(z.powf(q)).0 * q * z.powf(q - 1.0);
        (0..PIECES).map(|i| quadrature::integral(at(i), at(i + 1), rate)).sum()
    }
}

/// A number and its root.
#[derive(Debug, Clone, Copy)]
pub(super) struct KnownRoot {
    of: f64,
    root: f64,
}

/// Near nothing.
pub(super) const NO_ROOT: KnownRoot = KnownRoot { of: f64::NAN, root: f64::NAN };

/// ((1 + e)^p - 1)/e by powers of e.
fn series(p: f64) -> [f64; SERIES] {
    let mut term = 1.0;
    std::array::from_fn(|k| {
        term *= (p - k as f64) / (k + 1) as f64;
        term
    })
}
