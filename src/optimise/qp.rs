//! The quadratic subproblem of one step, solved by clarabel's interior point method.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, NonnegativeConeT, SolverStatus};
use nalgebra::DMatrix;

/// Model of the margins around a point: values and slopes of the margins to raise and of the limits.
#[derive(Debug, Clone)]
pub(super) struct Linear {
    /// m_i, and their slopes by the variables.
    pub rises: Vec<(f64, Vec<f64>)>,
    /// c_j, and their slopes.
    pub limits: Vec<(f64, Vec<f64>)>,
}

/// What the subproblem asks for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Ask {
    /// Maximise the modelled least margin less `weight` times the modelled violation.
    Merit { weight: f64 },
    /// Minimise the modelled violation alone: how much of it this radius can remove at all.
    Feasibility,
}

/// Solution of the subproblem, over the variables it was given.
#[derive(Debug, Clone)]
pub(super) struct Step {
    /// Step d.
    pub d: Vec<f64>,
    /// Modelled least margin t at x + d.
    pub rise: f64,
    /// Modelled violation e at x + d, the largest max(0, -c_j).
    pub elastic: f64,
    /// Multipliers of the margins (sum 1; none for [`Ask::Feasibility`]) and of the limits (sum at most the weight).
    pub rise_multipliers: Vec<f64>,
    pub limit_multipliers: Vec<f64>,
}

/// Columns of a matrix that is put together row by row.
struct Columns {
    entries: Vec<Vec<(usize, f64)>>,
    bounds: Vec<f64>,
}

impl Columns {
    fn new(variables: usize) -> Self {
        Columns { entries: vec![Vec::new(); variables], bounds: Vec::new() }
    }

    /// Row `coefficients . x <= bound`; exact zeros are not stored.
    fn push(&mut self, coefficients: impl IntoIterator<Item = (usize, f64)>, bound: f64) {
        for (column, value) in coefficients {
            if value != 0.0 {
                self.entries[column].push((self.bounds.len(), value));
            }
        }
        self.bounds.push(bound);
    }

    fn matrix(&self) -> CscMatrix<f64> {
        csc(self.bounds.len(), &self.entries)
    }
}

fn csc(rows: usize, columns: &[Vec<(usize, f64)>]) -> CscMatrix<f64> {
    let mut starts = vec![0];
    let (mut at, mut values) = (Vec::new(), Vec::new());
    for column in columns {
        for &(row, value) in column {
            at.push(row);
            values.push(value);
        }
        starts.push(at.len());
    }
    CscMatrix::new(rows, columns.len(), starts, at, values)
}

/// Modelled least margin min_i (m_i + g_i d) and violation max_j (-c_j - g_j d, 0).
pub(super) fn modelled(linear: &Linear, d: &[f64]) -> (f64, f64) {
    let at = |row: &(f64, Vec<f64>)| row.0 + dot(&row.1, d);
    let rise = linear.rises.iter().map(at).fold(f64::INFINITY, f64::min);
    let violation = linear.limits.iter().map(at).fold(0.0, |worst: f64, c| worst.max(-c));
    (rise, violation)
}

pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Step d within `lower..=upper` (the bounds and the trust radius) for
/// maximise r - 1/2 d'Bd - weight e, r <= m_i + g_i d - min m, e >= -(c_j + g_j d), e >= 0.
///
/// The elastic e makes it feasible whatever the limits. `None` when clarabel reaches no usable solution, or slopes
/// have overflowed.
pub(super) fn solve(
    linear: &Linear,
    hessian: &DMatrix<f64>,
    lower: &[f64],
    upper: &[f64],
    ask: Ask,
) -> Option<Step> {
    let all = linear.rises.iter().chain(&linear.limits);
    if all.flat_map(|(value, slopes)| slopes.iter().chain([value])).any(|v| !v.is_finite()) {
        return None;
    }
    let n = lower.len();
    let (rise, elastic) = (n, n + 1);
    let least = linear.rises.iter().map(|r| r.0).fold(f64::INFINITY, f64::min);
    let count = if ask == Ask::Feasibility { 0 } else { linear.rises.len() };
    // Solved for d / radius with every row divided by its steepest slope over the radius: clarabel's tolerances are
    // absolute near 0, and steps shrink a millionfold on the way to a solution.
    let radius = lower.iter().chain(upper).fold(0.0, |m: f64, v| m.max(v.abs()));
    let radius = if radius > 0.0 { radius } else { 1.0 };
    let steep = |rows: &[(f64, Vec<f64>)]| {
        let most = rows.iter().flat_map(|r| &r.1).fold(0.0, |m: f64, g| m.max(g.abs()));
        if most > 0.0 { radius * most } else { 1.0 }
    };
    let scale = 1.0 / steep(&linear.rises);
    let elastic_unit = steep(&linear.limits);
    let limit_scale = |row: &(f64, Vec<f64>)| 1.0 / steep(std::slice::from_ref(row)).max(row.0.abs());

    let mut rows = Columns::new(n + 2);
    for (value, slopes) in &linear.rises[..count] {
        let slopes = slopes.iter().enumerate().map(|(i, g)| (i, -g * radius * scale));
        rows.push(slopes.chain([(rise, 1.0)]), (value - least) * scale);
    }
    // A limit that no step in the window reaches is none: most of a clutch's.
    let least_in_window = |row: &(f64, Vec<f64>)| {
        let by = |(i, g): (usize, &f64)| (g * lower[i]).min(g * upper[i]);
        row.0 + row.1.iter().enumerate().map(by).sum::<f64>()
    };
    let in_reach: Vec<usize> =
        (0..linear.limits.len()).filter(|&j| least_in_window(&linear.limits[j]) <= 0.0).collect();
    for row in in_reach.iter().map(|&j| &linear.limits[j]) {
        let s = limit_scale(row);
        let slopes = row.1.iter().enumerate().map(|(i, g)| (i, -g * radius * s));
        rows.push(slopes.chain([(elastic, -elastic_unit * s)]), row.0 * s);
    }
    rows.push([(elastic, -1.0)], 0.0);
    for i in 0..n {
        rows.push([(i, 1.0)], upper[i] / radius);
        rows.push([(i, -1.0)], -lower[i] / radius);
    }
    let mut quadratic: Vec<Vec<(usize, f64)>> = vec![Vec::new(); n + 2];
    let mut linear_cost = vec![0.0; n + 2];
    match ask {
        Ask::Merit { weight } => {
            for (i, column) in quadratic.iter_mut().enumerate().take(n) {
                column.extend((0..=i).map(|k| (k, hessian[(k, i)] * radius * radius * scale)));
            }
            linear_cost[rise] = -1.0;
            linear_cost[elastic] = weight * elastic_unit * scale;
        }
        Ask::Feasibility => {
            linear_cost[elastic] = 1.0;
            rows.push([(rise, 1.0)], 1.0);
            rows.push([(rise, -1.0)], 1.0);
        }
    }
    let settings = DefaultSettings {
        verbose: false,
        max_threads: 1,
        tol_gap_abs: 1e-12,
        tol_gap_rel: 1e-12,
        tol_feas: 1e-12,
        ..DefaultSettings::default()
    };
    let p = csc(n + 2, &quadratic);
    let a = rows.matrix();
    let cones = [NonnegativeConeT(rows.bounds.len())];
    let mut solver = DefaultSolver::new(&p, &linear_cost, &a, &rows.bounds, &cones, settings).ok()?;
    solver.solve();
    let found = &solver.solution;
    let usable = matches!(
        found.status,
        SolverStatus::Solved | SolverStatus::AlmostSolved | SolverStatus::InsufficientProgress
    );
    if !usable || found.x.iter().chain(&found.z).any(|v| !v.is_finite()) {
        return None;
    }
    let d: Vec<f64> =
        (0..n).map(|i| snapped(found.x[i] * radius, lower[i], upper[i], 1e-9 * radius)).collect();
    let (rise, elastic) = modelled(linear, &d);
    let mut limit_multipliers = vec![0.0; linear.limits.len()];
    for (&j, z) in in_reach.iter().zip(&found.z[count..]) {
        limit_multipliers[j] = z.max(0.0) * limit_scale(&linear.limits[j]) / scale;
    }
    Some(Step {
        rise,
        elastic,
        rise_multipliers: found.z[..count].iter().map(|z| z.max(0.0)).collect(),
        limit_multipliers,
        d,
    })
}

/// d put exactly on a bound it comes this near to: an interior point never quite reaches one.
fn snapped(d: f64, lower: f64, upper: f64, near: f64) -> f64 {
    if d - lower < near {
        lower
    } else if upper - d < near {
        upper
    } else {
        d
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vertex_of_two_margins_and_a_limit() {
        // m1 = x, m2 = 1 - 2x + y, c = 0.3 - y: with weight 10 the optimum has y = 0.3, x = 1.3/3, t = 1.3/3,
        // multipliers 2/3 and 1/3, limit 1/3.
        let linear = Linear {
            rises: vec![(0.0, vec![1.0, 0.0]), (1.0, vec![-2.0, 1.0])],
            limits: vec![(0.3, vec![0.0, -1.0])],
        };
        let b = DMatrix::zeros(2, 2);
        let step = solve(&linear, &b, &[-1.0; 2], &[1.0; 2], Ask::Merit { weight: 10.0 }).unwrap();
        assert!((step.rise - 1.3 / 3.0).abs() < 1e-9 && step.elastic < 1e-9);
        assert!((step.rise_multipliers[0] - 2.0 / 3.0).abs() < 1e-8);
        assert!((step.limit_multipliers[0] - 1.0 / 3.0).abs() < 1e-8);
    }

    #[test]
    fn a_limit_out_of_reach_has_no_price_and_moves_no_other() {
        // The same with a limit that no step within the window comes near, before the one that holds.
        let near = Linear {
            rises: vec![(0.0, vec![1.0, 0.0]), (1.0, vec![-2.0, 1.0])],
            limits: vec![(0.3, vec![0.0, -1.0])],
        };
        let mut with_far = near.clone();
        with_far.limits.insert(0, (2.5, vec![1.0, 1.0]));
        let solved = |linear: &Linear| {
            solve(linear, &DMatrix::zeros(2, 2), &[-1.0; 2], &[1.0; 2], Ask::Merit { weight: 10.0 }).unwrap()
        };
        let (alone, with_far) = (solved(&near), solved(&with_far));
        assert_eq!(with_far.limit_multipliers[0], 0.0);
        assert!((with_far.limit_multipliers[1] - 1.0 / 3.0).abs() < 1e-8);
        assert!(alone.d.iter().zip(&with_far.d).all(|(a, b)| (a - b).abs() < 1e-9));
    }

    #[test]
    fn infeasible_limits_give_the_least_violation() {
        // x >= 0.7 and x <= 0.3 are both missed by 0.2 at best.
        let linear =
            Linear { rises: vec![(0.0, vec![1.0])], limits: vec![(-0.7, vec![1.0]), (0.3, vec![-1.0])] };
        let b = DMatrix::identity(1, 1);
        let step = solve(&linear, &b, &[0.0], &[1.0], Ask::Feasibility).unwrap();
        assert!((step.elastic - 0.2).abs() < 1e-9 && (step.d[0] - 0.5).abs() < 1e-8);
    }
}
