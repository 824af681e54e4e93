//! Several functions of one variable, interpolated together by piecewise Chebyshev polynomials.
//!
//! Built once, then evaluated without allocation: one Clenshaw recurrence serves all lanes.

use std::f64::consts::PI;
use std::sync::LazyLock;

/// Degree of every panel. Sixteen leaves 1e-13 on the panels that the wedge curve uses (tested there).
pub const DEGREE: usize = 16;
const NODES: usize = DEGREE + 1;

/// Where a panel's functions go on as half-integer powers of the distance from one of its ends: there they are smooth
/// in the root of that distance, which the panel then takes as its variable.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Grade {
    /// Smooth at both ends.
    Smooth,
    /// Powers of sqrt(x - from).
    From,
    /// Powers of sqrt(until - x).
    Until,
}

#[derive(Debug, Clone, PartialEq)]
struct Panel<const M: usize> {
    from: f64,
    until: f64,
    grade: Grade,
    /// coefficients[k][lane] of T_k.
    coefficients: [[f64; M]; NODES],
}

/// `M` functions on adjacent panels.
#[derive(Debug, Clone, PartialEq)]
pub struct Panels<const M: usize> {
    panels: Vec<Panel<M>>,
}

impl<const M: usize> Panel<M> {
    /// The panel's own variable in [-1, 1] at `x`. A graded end does not go on beyond itself.
    fn local(&self, x: f64) -> f64 {
        let length = self.until - self.from;
        match self.grade {
            Grade::Smooth => (2.0 * x - self.from - self.until) / length,
            Grade::From => 2.0 * ((x - self.from) / length).max(0.0).sqrt() - 1.0,
            Grade::Until => 1.0 - 2.0 * ((self.until - x) / length).max(0.0).sqrt(),
        }
    }

    /// x at the panel's own variable `t`.
    fn place(&self, t: f64) -> f64 {
        let length = self.until - self.from;
        match self.grade {
            Grade::Smooth => 0.5 * (self.from + self.until) + 0.5 * length * t,
            Grade::From => self.from + length * (0.5 * (1.0 + t)).powi(2),
            Grade::Until => self.until - length * (0.5 * (1.0 - t)).powi(2),
        }
    }

    /// dt/dx at `t`, off a graded end.
    fn rate(&self, t: f64) -> f64 {
        let length = self.until - self.from;
        match self.grade {
            Grade::Smooth => 2.0 / length,
            Grade::From => 2.0 / (length * (1.0 + t)),
            Grade::Until => 2.0 / (length * (1.0 - t)),
        }
    }

    /// Fit the values of all lanes at the nodes.
    fn fit(from: f64, until: f64, grade: Grade, values: &[[f64; M]; NODES]) -> Self {
        let mut coefficients = [[0.0; M]; NODES];
        for (row, weights) in coefficients.iter_mut().zip(WEIGHTS.iter()) {
            for (value, c) in values.iter().zip(weights) {
                for lane in 0..M {
                    row[lane] += c * value[lane];
                }
            }
        }
        Self { from, until, grade, coefficients }
    }

    /// All lanes at the panel's own variable `t`, by Clenshaw's recurrence.
    fn sum(&self, t: f64) -> [f64; M] {
        let (mut b1, mut b2) = ([0.0; M], [0.0; M]);
        for row in self.coefficients[1..].iter().rev() {
            for lane in 0..M {
                let b = row[lane] + 2.0 * t * b1[lane] - b2[lane];
                b2[lane] = b1[lane];
                b1[lane] = b;
            }
        }
        let mut out = self.coefficients[0];
        for lane in 0..M {
            out[lane] += t * b1[lane] - b2[lane];
        }
        out
    }

    /// Derivative of lanes `lanes` by x.
    fn derivative<const K: usize>(&self, lanes: [usize; K]) -> Panel<K> {
        let mut coefficients = [[0.0; K]; NODES];
        let scale = if self.grade == Grade::Smooth { self.rate(0.0) } else { 1.0 };
        for (out, &lane) in lanes.iter().enumerate() {
            // c'_{k-1} = c'_{k+1} + 2 k c_k; c'_0 halved.
            for k in (1..NODES).rev() {
                let above = if k + 1 < NODES { coefficients[k + 1][out] } else { 0.0 };
                coefficients[k - 1][out] = above + 2.0 * k as f64 * self.coefficients[k][lane];
            }
            coefficients[0][out] *= 0.5;
            for row in &mut coefficients {
                row[out] *= scale;
            }
        }
        let by_t = Panel { from: self.from, until: self.until, grade: self.grade, coefficients };
        if self.grade == Grade::Smooth {
            return by_t;
        }
        let values = std::array::from_fn(|j| by_t.sum(node(j)).map(|d| d * self.rate(node(j))));
        Panel::fit(self.from, self.until, self.grade, &values)
    }
}

impl<const M: usize> Panels<M> {
    /// Interpolate `f` on the panels between consecutive `breaks` (ascending, at least two) at Chebyshev
    /// nodes of the first kind, so `f` is never called at a break itself.
    ///
    /// # Errors
    /// Passes on the first error of `f`.
    pub fn build<E>(breaks: &[f64], f: impl FnMut(f64) -> Result<[f64; M], E>) -> Result<Self, E> {
        Self::build_graded(breaks, &[], f)
    }

    /// The same, panel i graded as `grades[i]` says; panels beyond the end of `grades` are smooth.
    ///
    /// # Errors
    /// Passes on the first error of `f`.
    pub fn build_graded<E>(
        breaks: &[f64],
        grades: &[Grade],
        mut f: impl FnMut(f64) -> Result<[f64; M], E>,
    ) -> Result<Self, E> {
        let mut panels = Vec::with_capacity(breaks.len().saturating_sub(1));
        for (i, pair) in breaks.windows(2).enumerate() {
            let grade = grades.get(i).copied().unwrap_or(Grade::Smooth);
            let empty = Panel { from: pair[0], until: pair[1], grade, coefficients: [[0.0; M]; NODES] };
            let mut values = [[0.0; M]; NODES];
            for (j, value) in values.iter_mut().enumerate() {
                *value = f(empty.place(node(j)))?;
            }
            panels.push(Panel::fit(pair[0], pair[1], grade, &values));
        }
        Ok(Self { panels })
    }

    /// Values of all lanes at `x`; outside the panels the end panels are continued.
    pub fn at(&self, x: f64) -> [f64; M] {
        let panel = self.panel(x);
        panel.sum(panel.local(x))
    }

    /// The derivative of lanes `lanes` by x as a curve of its own, panel by panel.
    pub fn derivative<const K: usize>(&self, lanes: [usize; K]) -> Panels<K> {
        Panels { panels: self.panels.iter().map(|p| p.derivative(lanes)).collect() }
    }

    /// The sum of all lanes, each times its weight, as a curve of its own.
    pub fn combined(&self, weights: &[f64; M]) -> Panels<1> {
        let sum = |row: &[f64; M]| [row.iter().zip(weights).map(|(c, w)| c * w).sum()];
        let panel = |p: &Panel<M>| Panel {
            from: p.from,
            until: p.until,
            grade: p.grade,
            coefficients: p.coefficients.each_ref().map(sum),
        };
        Panels { panels: self.panels.iter().map(panel).collect() }
    }

    /// Size of the last two coefficients relative to the largest, worst lane and panel: what the truncated
    /// series still misses, as a pure number. The first `skip` panels are passed over; `beside` may raise the largest of a lane to
    /// that of another, beside which it counts.
    pub fn truncation(&self, skip: usize, beside: impl Fn(&mut [f64; M])) -> f64 {
        let mut worst: f64 = 0.0;
        for p in self.panels.iter().skip(skip) {
            let mut largest: [f64; M] =
                std::array::from_fn(|lane| p.coefficients.iter().map(|r| r[lane].abs()).fold(0.0, f64::max));
            beside(&mut largest);
            for (lane, largest) in largest.into_iter().enumerate() {
                let tail = p.coefficients[DEGREE][lane].abs().max(p.coefficients[DEGREE - 1][lane].abs());
                if largest > 1e-12 {
                    worst = worst.max(tail / largest);
                }
            }
        }
        worst
    }

    /// Ends and grade of each panel.
    pub(super) fn spans(&self) -> impl Iterator<Item = (f64, f64, Grade)> {
        self.panels.iter().map(|p| (p.from, p.until, p.grade))
    }

    /// All lanes of panel `i` at its own variable `t` in [-1, 1].
    pub(super) fn in_panel(&self, i: usize, t: f64) -> [f64; M] {
        self.panels[i].sum(t)
    }

    fn panel(&self, x: f64) -> &Panel<M> {
        let last = self.panels.len() - 1;
        &self.panels[self.panels[..last].partition_point(|p| p.until < x)]
    }
}

/// What the value at node j adds to the coefficient of T_k.
static WEIGHTS: LazyLock<[[f64; NODES]; NODES]> = LazyLock::new(|| {
    std::array::from_fn(|k| {
        let scale = if k == 0 { 1.0 } else { 2.0 } / NODES as f64;
        std::array::from_fn(|j| scale * (PI * k as f64 * (j as f64 + 0.5) / NODES as f64).cos())
    })
});

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
        assert!(p.truncation(0, |_| ()) < 1e-13);
    }

    #[test]
    fn a_graded_panel_holds_half_integer_powers_and_their_slope() {
        // Singular at 1 from the right and at 2 from the left.
        let f = |x: f64| match x {
            x if x < 1.0 => x.exp(),
            x if x < 1.5 => x.exp() + (x - 1.0).powf(2.5),
            _ => x.exp() + (2.0 - x).max(0.0).powf(1.5),
        };
        let slope = |x: f64| match x {
            x if x < 1.0 => x.exp(),
            x if x < 1.5 => x.exp() + 2.5 * (x - 1.0).powf(1.5),
            _ => x.exp() - 1.5 * (2.0 - x).max(0.0).sqrt(),
        };
        let grades = [Grade::Smooth, Grade::From, Grade::Until];
        let p =
            Panels::<1>::build_graded(&[0.0, 1.0, 1.5, 2.0, 3.0], &grades, |x| Ok::<_, ()>([f(x)])).unwrap();
        let d = p.derivative([0]);
        for i in 0..300 {
            let x = 0.005 + f64::from(i) * 0.01;
            assert!((p.at(x)[0] - f(x)).abs() < 1e-13, "{x}");
            assert!((d.at(x)[0] - slope(x)).abs() < 1e-10, "{x}: {} {}", d.at(x)[0], slope(x));
        }
        let plain = Panels::<1>::build(&[0.0, 1.0, 1.5, 2.0, 3.0], |x| Ok::<_, ()>([f(x)])).unwrap();
        assert!((plain.at(1.99)[0] - f(1.99)).abs() > 1e-7);
    }
}
