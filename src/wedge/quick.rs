//! An arc of the curve for a search: closures once, at the nodes of panels over N (over N^0.1 on the first arc), and everything
//! else read off these.
//!
//! The table to be made has its nodes in alpha, where a force must be looked for by Newton; here that is looked for on the
//! polynomials, not by closures. One panel where the full table has two, three or four where it has five: of an ellipse of parameter
//! 6.5 seen from twice as far 4 is left, and 4^-16 = 2e-10. Where a curve asks for more, its last coefficients tell.

use super::closure::{FIRST_CONTACT_N, NoClosure};
use super::table::{ArcBuilder, Edge, LANES, Layout, SHAPED_BREAKS, lanes_of, unit_integral};
use crate::numeric::{panels::Panels, quadrature};

/// The lanes and what the variable of the table follows from: z d alpha/dN, or alpha.
const SAMPLED: usize = LANES + 1;
/// Panels of the first arc, as fractions of its end.
const BREAKS: [f64; 4] = [0.0, 0.3, 0.6, 1.0];
/// The same for a logarithmic law: there z d alpha/dN ~ z ln z is not smooth at first contact, and what the lowest panel makes of it
/// goes on into alpha beyond it, less by the tenth power of their ratio.
const LOGARITHMIC_BREAKS: [f64; 5] = [0.0, 0.1, 0.3, 0.6, 1.0];
/// The same with the bulk of a sprag, a polynomial of fifth degree in the way rolled, which goes with z^9.
const BULK_BREAKS: [f64; 5] = [0.0, 0.12, 0.4, 0.8, 1.0];
/// q of logarithmic laws.
const LOGARITHMIC: f64 = 10.0;
/// Largest truncation of a quick curve that is taken as it is: three tenths of what it may be off.
pub(super) const TRUSTED: f64 = 3e-8;

/// Lowest panels of the first arc for which [`TRUSTED`] is not asked: those below 1e-5 of its largest N, where what a closure
/// leaves unsettled is more than that of OC_g', which is next to nothing there. `exponent`: q of the law; `cuts`: times that they were halved.
fn lowest(exponent: f64, cuts: u32) -> usize {
    if exponent == LOGARITHMIC { 2 << cuts } else { 1 << cuts }
}

/// What the lanes of a quick arc leave out, relative, but in its [`lowest`] panels where it is the `first`: OC_g', some thousandth of rho and
/// nowhere without it, is told beside that.
pub(super) fn left_out(lanes: &Panels<LANES>, first: bool, exponent: f64, cuts: u32) -> f64 {
    let skip = if first { lowest(exponent, cuts) } else { 0 };
    let [rho_i, oc_g_slope] = [2, 5];
    lanes.truncation(skip, |largest| largest[oc_g_slope] = largest[oc_g_slope].max(largest[rho_i]))
}

/// Times that panels are halved at most where they vary more than they follow: of an ellipse of parameter 1 + x about 1 + 2 x is left.
pub(super) const MOST_CUTS: u32 = 2;

/// `breaks` with each panel between them in 2^`times` of equal length.
fn halved(breaks: Vec<f64>, times: u32) -> Vec<f64> {
    (0..times).fold(breaks, |breaks, _| {
        let middles = breaks.windows(2).flat_map(|w| [0.5 * (w[0] + w[1]), w[1]]);
        breaks[..1].iter().copied().chain(middles).collect()
    })
}

/// Where Newton's steps may end, relative: the next would be less than rounding.
const SETTLED: f64 = 1e-9;

impl ArcBuilder<'_> {
    /// Lanes and windup of an arc; `edges` in N.
    pub(super) fn quickly(
        &self,
        n_from: f64,
        n_until: f64,
        windup_from: f64,
        first: bool,
        edges: &[Edge],
        alpha_until: f64,
        cuts: u32,
    ) -> Result<(Panels<LANES>, Panels<1>), NoClosure> {
        if first {
            self.first_quickly(n_until, edges, cuts)
        } else {
            self.later_quickly(n_from, n_until, windup_from, edges, alpha_until, cuts)
        }
    }

    fn sample(&self, n: f64, more: impl Fn(f64, f64) -> f64) -> Result<[f64; SAMPLED], NoClosure> {
        let c = self.closure(n)?;
        let mut out = [0.0; SAMPLED];
        out[..LANES].copy_from_slice(&lanes_of(&c, n));
        out[LANES] = more(c.alpha.v, c.alpha.d);
        Ok(out)
    }

    /// As [`ArcBuilder::first`].
    fn first_quickly(
        &self,
        n_until: f64,
        edges: &[Edge],
        cuts: u32,
    ) -> Result<(Panels<LANES>, Panels<1>), NoClosure> {
        let z_end = n_until.powf(0.1);
        let edges: Vec<Edge> = edges.iter().map(|e| Edge { at: e.at.powf(0.1), ..*e }).collect();
        let breaks: &[f64] = match self.statics.exponent {
            _ if self.statics.elastic.is_shaped() => &SHAPED_BREAKS,
            _ if self.statics.bulk.is_some() => &BULK_BREAKS,
            LOGARITHMIC => &LOGARITHMIC_BREAKS,
            _ => &BREAKS,
        };
        let over = |end: f64, edges: &[Edge]| {
            let fixed: Vec<f64> = breaks.iter().map(|b| b * end).collect();
            Layout::new(&halved(fixed, cuts), edges)
        };
        let in_z = over(z_end, &edges);
        let sampled: Panels<SAMPLED> =
            in_z.panels(|z| self.sample(z.powi(10).max(FIRST_CONTACT_N), |_, slope| z * slope))?;
        let rate = sampled.combined(&lane(LANES));
        let mean = sure(in_z.panels(|z| {
            Ok::<_, std::convert::Infallible>([
                10.0 * unit_integral(z, &edges, |x| rate.at(z * x)[0] * x.powi(8))
            ])
        }));
        let q = self.statics.exponent;
        let of = |z: f64| (z.powi(9) * mean.at(z)[0]).powf(1.0 / q);
        let s_end = of(z_end);
        let s_edges: Vec<Edge> = edges.iter().map(|e| Edge { at: of(e.at), ..*e }).collect();
        let in_s = over(s_end, &s_edges);
        let lanes = sure(in_s.panels(|s| {
            let mut z = z_end * s / s_end;
            for _ in 0..50 {
                let a = mean.at(z)[0];
                let miss = 9.0 * z.ln() + a.ln() - q * s.ln();
                let step = miss * a / (10.0 * rate.at(z)[0]);
                z *= (-step).exp();
                if step.abs() < SETTLED {
                    break;
                }
            }
            let v = sampled.at(z);
            let mut out = [0.0; LANES];
            out.copy_from_slice(&v[..LANES]);
            out[8] = z / s;
            Ok::<_, std::convert::Infallible>(out)
        }));
        let rho = lanes.combined(&rho());
        let exponent = q as i32 - 1;
        let windup = sure(in_s.panels(|s| {
            let mean = q * unit_integral(s, &s_edges, |x| rho.at(s * x)[0] * x.powi(exponent));
            Ok::<_, std::convert::Infallible>([mean])
        }));
        Ok((lanes, windup))
    }

    /// As [`ArcBuilder::later`].
    fn later_quickly(
        &self,
        n_from: f64,
        n_until: f64,
        windup_from: f64,
        edges: &[Edge],
        alpha_until: f64,
        cuts: u32,
    ) -> Result<(Panels<LANES>, Panels<1>), NoClosure> {
        let in_n = Layout::new(&halved(vec![n_from, n_until], cuts), edges);
        let sampled: Panels<SAMPLED> = in_n.panels(|n| self.sample(n, |alpha, _| alpha))?;
        let alpha_of = sampled.combined(&lane(LANES));
        let slope = alpha_of.derivative([0]);
        let alpha_from = self.closure(n_from)?.alpha.v;
        let at_alpha = |e: &Edge| Edge { at: alpha_of.at(e.at)[0], ..*e };
        let edges: Vec<Edge> = edges.iter().map(at_alpha).collect();
        let layout = Layout::new(&halved(vec![alpha_from, alpha_until], cuts), &edges);
        let lanes = sure(layout.panels(|alpha| {
            let mut n = n_from + (n_until - n_from) * (alpha - alpha_from) / (alpha_until - alpha_from);
            for _ in 0..50 {
                let step = (alpha - alpha_of.at(n)[0]) / slope.at(n)[0];
                n = (n + step).clamp(n_from, n_until);
                if step.abs() < SETTLED * n {
                    break;
                }
            }
            let v = sampled.at(n);
            let mut out = [0.0; LANES];
            out.copy_from_slice(&v[..LANES]);
            out[8] = n;
            Ok::<_, std::convert::Infallible>(out)
        }));
        let rho = lanes.combined(&rho());
        let breaks = &layout.breaks;
        let mut until = vec![windup_from];
        for w in breaks.windows(2) {
            until.push(until[until.len() - 1] + quadrature::integral(w[0], w[1], |a| rho.at(a)[0]));
        }
        let windup = sure(layout.panels(|a| {
            let panel = breaks[1..breaks.len() - 1].partition_point(|&b| b < a);
            let part = quadrature::integral(breaks[panel], a, |a| rho.at(a)[0]);
            Ok::<_, std::convert::Infallible>([until[panel] + part])
        }));
        Ok((lanes, windup))
    }
}

/// Weights that pick one lane.
fn lane(of: usize) -> [f64; SAMPLED] {
    std::array::from_fn(|i| f64::from(u8::from(i == of)))
}

/// Weights of rho_i + rho_e.
fn rho() -> [f64; LANES] {
    std::array::from_fn(|i| f64::from(u8::from(i == 2 || i == 3)))
}

fn sure<T>(built: Result<T, std::convert::Infallible>) -> T {
    match built {
        Ok(it) => it,
    }
}
