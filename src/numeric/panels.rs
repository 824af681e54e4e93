//! Several functions of one variable, interpolated together by piecewise Chebyshev polynomials.
//!
//! Built once, then evaluated without allocation: one Clenshaw recurrence serves all lanes.

use std::f64::consts::PI;

/// Degree of every panel. Sixteen leaves 1e-13 on the panels that the wedge curve uses (tested there).
pub const DEGREE: usize = 16;
const NODES: usize = DEGREE + 1;

#[derive(Debug, Clone, PartialEq)]
struct Panel<const M: usize> {
    from: f64,
    until: f64,
    /// coefficients[k][lane] of T_k.
    coefficients: [[f64; M]; NODES],
}

/// `M` functions on adjacent panels.
#[derive(Debug, Clone, PartialEq)]
pub struct Panels<const M: usize> {
    panels: Vec<Panel<M>>,
}

impl<const M: usize> Panels<M> {
    /// Interpolate `f` on the panels between consecutive `breaks` (ascending, at least two) at Chebyshev
    /// nodes of the first kind, so `f` is never called at a break itself.
    ///
    /// # Errors
    /// Passes on the first error of `f`.
    pub fn build<E>(breaks: &[f64], mut f: impl FnMut(f64) -> Result<[f64; M], E>) -> Result<Self, E> {
        let mut panels = Vec::with_capacity(breaks.len().saturating_sub(1));
        for pair in breaks.windows(2) {
            let (from, until) = (pair[0], pair[1]);
            let mut values = [[0.0; M]; NODES];
            for (j, value) in values.iter_mut().enumerate() {
                *value = f(0.5 * (from + until) + 0.5 * (until - from) * node(j))?;
            }
            let mut coefficients = [[0.0; M]; NODES];
            for (k, row) in coefficients.iter_mut().enumerate() {
                let scale = if k == 0 { 1.0 } else { 2.0 } / NODES as f64;
                for (j, value) in values.iter().enumerate() {
                    let c = scale * (PI * k as f64 * (j as f64 + 0.5) / NODES as f64).cos();
                    for lane in 0..M {
                        row[lane] += c * value[lane];
                    }
                }
            }
            panels.push(Panel { from, until, coefficients });
        }
        Ok(Self { panels })
    }

    /// Values of all lanes at `x`; outside the panels the end panels are continued.
    pub fn at(&self, x: f64) -> [f64; M] {
        let panel = self.panel(x);
        let t = (2.0 * x - panel.from - panel.until) / (panel.until - panel.from);
        let (mut b1, mut b2) = ([0.0; M], [0.0; M]);
        for row in panel.coefficients[1..].iter().rev() {
            for lane in 0..M {
                let b = row[lane] + 2.0 * t * b1[lane] - b2[lane];
                b2[lane] = b1[lane];
                b1[lane] = b;
            }
        }
        let mut out = panel.coefficients[0];
        for lane in 0..M {
            out[lane] += t * b1[lane] - b2[lane];
        }
        out
    }

    /// The derivative of lanes `lanes` by x as a curve of its own, panel by panel.
    pub fn derivative<const K: usize>(&self, lanes: [usize; K]) -> Panels<K> {
        let panels = self
            .panels
            .iter()
            .map(|p| {
                let mut coefficients = [[0.0; K]; NODES];
                let scale = 2.0 / (p.until - p.from);
                for (out, &lane) in lanes.iter().enumerate() {
                    // c'_{k-1} = c'_{k+1} + 2 k c_k; c'_0 halved.
                    for k in (1..NODES).rev() {
                        let above = if k + 1 < NODES { coefficients[k + 1][out] } else { 0.0 };
                        coefficients[k - 1][out] = above + 2.0 * k as f64 * p.coefficients[k][lane];
                    }
                    coefficients[0][out] *= 0.5;
                    for row in &mut coefficients {
                        row[out] *= scale;
                    }
                }
                Panel { from: p.from, until: p.until, coefficients }
            })
            .collect();
        Panels { panels }
    }

    /// Size of the last two coefficients relative to the largest, worst lane and panel: what the truncated
    /// series still misses, as a pure number. The first `skip` panels are passed over.
    pub fn truncation(&self, skip: usize) -> f64 {
        let mut worst: f64 = 0.0;
        for p in self.panels.iter().skip(skip) {
            for lane in 0..M {
                let largest = p.coefficients.iter().map(|r| r[lane].abs()).fold(0.0, f64::max);
                let tail = p.coefficients[DEGREE][lane].abs().max(p.coefficients[DEGREE - 1][lane].abs());
                if largest > 1e-12 {
                    worst = worst.max(tail / largest);
                }
            }
        }
        worst
    }

    fn panel(&self, x: f64) -> &Panel<M> {
        let last = self.panels.len() - 1;
        &self.panels[self.panels[..last].partition_point(|p| p.until < x)]
    }
}

fn node(j: usize) -> f64 {
    (PI * (j as f64 + 0.5) / NODES as f64).cos()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_and_derivatives_of_smooth_functions() {
        let p = Panels::<2>::build(&[0.0, 0.5, 1.5], |x| Ok::<_, ()>([x.exp(), (3.0 * x).sin()])).unwrap();
        let d = p.derivative([1]);
        for i in 0..=30 {
            let x = i as f64 * 0.05;
            let y = p.at(x);
            assert!((y[0] - x.exp()).abs() < 1e-14 && (y[1] - (3.0 * x).sin()).abs() < 1e-13);
            assert!((d.at(x)[0] - 3.0 * (3.0 * x).cos()).abs() < 1e-11);
        }
        assert!(p.truncation(0) < 1e-13);
    }
}
