//! The functions of [`Panels`] once more, on short pieces of low degree: what is read millions of times.
//!
//! Each panel is cut into [`PIECES`] equal pieces of its own variable, each a polynomial of degree [`LOW`] in powers,
//! summed by Horner's rule with all lanes side by side. A panel of degree 16 whose last coefficients are 1e-13 is
//! analytic in an ellipse of parameter 6.5, whose nearest point lies 2.3 half lengths beyond the panel's end; seen from
//! a piece that is 19 of its own half lengths, an ellipse of parameter 39, and 39^-9 = 5e-15 is left out.

use super::panels::{DEGREE, Grade, Panels};
use std::f64::consts::PI;
use std::sync::LazyLock;

/// Pieces of a panel.
pub const PIECES: usize = 8;
/// Degree of a piece.
pub const LOW: usize = 8;
const POINTS: usize = LOW + 1;

/// `M` functions on the pieces of adjacent panels.
#[derive(Debug, Clone, PartialEq)]
pub struct Pieces<const M: usize> {
    /// Ends of the panels, and how x becomes their own variable.
    panels: Vec<Span>,
    /// powers[panel * PIECES + piece][k][lane] of v^k, v in [-1, 1] on the piece.
    powers: Vec<[[f64; M]; POINTS]>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Span {
    from: f64,
    until: f64,
    scale: f64,
    grade: Grade,
}

impl<const M: usize> Pieces<M> {
    /// All lanes of `panels`, then those of `more` and `last`, which have the same breaks.
    pub fn of<const A: usize, const B: usize, const C: usize>(
        panels: &Panels<A>,
        more: &Panels<B>,
        last: &Panels<C>,
    ) -> Self {
        const { assert!(A + B + C == M, "a lane for each function") };
        Self::made(panels, |i, t| {
            let (a, b, c) = (panels.in_panel(i, t), more.in_panel(i, t), last.in_panel(i, t));
            let mut value = [0.0; M];
            value[..A].copy_from_slice(&a);
            value[A..A + B].copy_from_slice(&b);
            value[A + B..].copy_from_slice(&c);
            value
        })
    }

    /// All lanes of `panels`.
    pub fn of_all(panels: &Panels<M>) -> Self {
        Self::made(panels, |i, t| panels.in_panel(i, t))
    }

    /// On the pieces of `panels`, `value` in a panel at its own variable.
    fn made<const A: usize>(panels: &Panels<A>, value: impl Fn(usize, f64) -> [f64; M]) -> Self {
        let basis = &*BASIS;
        let mut out = Self { panels: Vec::new(), powers: Vec::new() };
        for (i, (from, until, grade)) in panels.spans().enumerate() {
            let scale = if grade == Grade::Smooth { 2.0 / (until - from) } else { 1.0 / (until - from) };
            out.panels.push(Span { from, until, scale, grade });
            for piece in 0..PIECES {
                let centre = (2 * piece + 1) as f64 / PIECES as f64 - 1.0;
                let at = |j: usize| value(i, centre + basis.nodes[j] / PIECES as f64);
                let values: [[f64; M]; POINTS] = std::array::from_fn(at);
                out.powers.push(basis.powers(&values));
            }
        }
        out
    }

    /// Values of all lanes at `x`; outside the panels the end pieces are continued: a smooth extension, for trial steps,
    /// which leaves the functions themselves as T_9 grows (6e-12 at a twentieth of a panel).
    #[inline]
    pub fn at(&self, x: f64) -> [f64; M] {
        let last = self.panels.len() - 1;
        let i: usize = self.panels[..last].iter().map(|p| usize::from(p.until < x)).sum();
        let span = &self.panels[i];
        // In [0, PIECES] on the panel.
        let place = (0.5 * PIECES as f64)
            * match span.grade {
                Grade::Smooth => (x - span.from) * span.scale,
                Grade::From => 2.0 * ((x - span.from) * span.scale).max(0.0).sqrt(),
                Grade::Until => 2.0 - 2.0 * ((span.until - x) * span.scale).max(0.0).sqrt(),
            };
        // A float that is no number or negative becomes piece 0.
        let piece = (place as i32).clamp(0, PIECES as i32 - 1) as usize;
        let v = 2.0 * (place - piece as f64) - 1.0;
        let rows = &self.powers[i * PIECES + piece];
        let mut sum = rows[LOW];
        for row in rows[..LOW].iter().rev() {
            for lane in 0..M {
                sum[lane] = sum[lane] * v + row[lane];
            }
        }
        sum
    }
}

/// Chebyshev nodes and how values there become powers.
pub(crate) struct Basis<const POINTS: usize> {
    pub(crate) nodes: [f64; POINTS],
    /// weight[k][j]: what the value at node j adds to the coefficient of v^k.
    weight: [[f64; POINTS]; POINTS],
}

static BASIS: LazyLock<Basis<POINTS>> = LazyLock::new(Basis::new);

impl<const POINTS: usize> Basis<POINTS> {
    pub(crate) fn new() -> Self {
        const { assert!(LOW <= DEGREE && POINTS > 1) };
        let angle = |j: usize| PI * (j as f64 + 0.5) / POINTS as f64;
        // chebyshev[n][k]: coefficient of v^k in T_n, T_n = 2 v T_{n-1} - T_{n-2}.
        let mut chebyshev = [[0.0; POINTS]; POINTS];
        (chebyshev[0][0], chebyshev[1][1]) = (1.0, 1.0);
        for n in 2..POINTS {
            for k in 0..POINTS {
                let raised = if k > 0 { 2.0 * chebyshev[n - 1][k - 1] } else { 0.0 };
                chebyshev[n][k] = raised - chebyshev[n - 2][k];
            }
        }
        let mut weight = [[0.0; POINTS]; POINTS];
        for (n, polynomial) in chebyshev.iter().enumerate() {
            let scale = if n == 0 { 1.0 } else { 2.0 } / POINTS as f64;
            for (row, c) in weight.iter_mut().zip(polynomial) {
                for (j, w) in row.iter_mut().enumerate() {
                    *w += c * scale * (n as f64 * angle(j)).cos();
                }
            }
        }
        Self { nodes: std::array::from_fn(|j| angle(j).cos()), weight }
    }

    /// Powers of v from the values at the nodes.
    pub(crate) fn powers<const M: usize>(&self, values: &[[f64; M]; POINTS]) -> [[f64; M]; POINTS] {
        let mut powers = [[0.0; M]; POINTS];
        for (power, weights) in powers.iter_mut().zip(&self.weight) {
            for (value, w) in values.iter().zip(weights) {
                for lane in 0..M {
                    power[lane] += w * value[lane];
                }
            }
        }
        powers
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_and_panels_agree_to_rounding_graded_ends_and_beyond() {
        let grades = [Grade::Smooth, Grade::From, Grade::Until];
        let f = |x: f64| match x {
            x if x < 1.0 => [x.exp(), 1.0 / (2.0 + x)],
            x if x < 1.5 => [x.exp() + (x - 1.0).powf(2.5), 1.0 / (2.0 + x)],
            _ => [x.exp() + (2.0 - x).max(0.0).powf(1.5), 1.0 / (2.0 + x)],
        };
        let p =
            Panels::<2>::build_graded(&[0.0, 1.0, 1.5, 2.0, 3.0], &grades, |x| Ok::<_, ()>(f(x))).unwrap();
        let d = p.derivative([1]);
        let pieces = Pieces::<4>::of(&p, &d, &p.derivative([0]));
        for i in 0..=3100 {
            let x = -0.05 + 1e-3 * f64::from(i);
            let (a, b) = (pieces.at(x), p.at(x));
            // Powers of degree 8 round by at most (1 + sqrt 2)^8/2 = 577 units of 1.1e-16. Beyond the ends, v outside
            // [-1, 1] on the end piece, values and what is left out grow as T_9(v).
            let v = 1.0 + 2.0 * PIECES as f64 * (-x).max(x - 3.0).max(0.0);
            let grown = (9.0 * v.acosh()).cosh() - 1.0;
            for (a, b) in a.into_iter().zip(b) {
                assert!((a - b).abs() < (4e-14 + 2e-15 * grown) * b.abs(), "{x}: {a} {b}");
            }
            assert!((a[2] - d.at(x)[0]).abs() < 1e-13 + 1e-14 * grown, "{x}: {} {}", a[2], d.at(x)[0]);
        }
        assert!(pieces.at(f64::NAN)[0].is_nan());
    }
}
