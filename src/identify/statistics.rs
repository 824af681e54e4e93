//! What a least-squares fit knows: confidence, correlation, and directions in which the data are blind.

use nalgebra::{DMatrix, DVector, SVD};

use crate::numeric::student;

/// Correlation from which a combination of two parameters is known better than either.
pub const STRONG: f64 = 0.95;

/// Correlation from which two parameters are determined only together: an error of the model of 1 % moves each by up to
/// 7 %, 1/sqrt(1 - correlation^2), however small the scatter. A choice.
pub const INSEPARABLE: f64 = 0.99;

/// Half width of an interval over the range of the bounds, or over the value, from which the value does not count as
/// determined: the interval is then as wide as what was known before. A choice.
const TOO_WIDE: f64 = 0.5;

/// Smallest singular value over the largest, with columns of equal length, below which the data are blind in a
/// direction: derivatives by differences are good to 1e-6 or so.
const BLIND: f64 = 1e-5;

/// Length of a column over the longest below which an unknown counts as without influence: what differences of
/// interpolated curves see of nothing.
const NOTHING: f64 = 1e-5;

/// Confidence of the intervals.
const CONFIDENCE: f64 = 0.95;

/// One unknown as found.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimate {
    /// Value.
    pub value: f64,
    /// Standard error; `None` where the data do not determine the value.
    pub sigma: Option<f64>,
    /// Half width of the 95 % interval (Student's t); `None` as above.
    pub half_width: Option<f64>,
    /// Half width of the 95 % interval by the error of the contact law alone; `None` as above.
    pub by_law: Option<f64>,
    /// Why the data do not determine the value; `None` where they do.
    pub doubt: Option<Doubt>,
}

/// Why the data do not determine an unknown.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Doubt {
    /// No interval can be stated: a blind direction, or no more observations than unknowns.
    NoInterval,
    /// The value lies at one of its bounds: the best one may lie beyond.
    AtBound,
    /// The interval is as wide as the range of the bounds.
    WiderThanBounds,
    /// The half width of the interval is more than half the value, within bounds of one sign.
    WiderThanValue,
    /// Determined only together with this other unknown (its index), to which its correlation is largest and above
    /// [`INSEPARABLE`] in magnitude.
    Inseparable(usize),
}

/// Two or more unknowns that the data hardly tell apart, or not at all.
#[derive(Debug, Clone, PartialEq)]
pub enum Tied {
    /// Correlation of two unknowns above [`STRONG`] in magnitude.
    Strongly {
        /// Index of the one.
        first: usize,
        /// Index of the other.
        second: usize,
        /// Correlation.
        correlation: f64,
    },
    /// A direction without influence on any residual: changes of the unknowns, the largest of them 1 in magnitude of its unit
    /// times the range of its bounds.
    Blind {
        /// Change of each unknown, as a share of its range.
        direction: Vec<f64>,
    },
}

/// What the data know.
#[derive(Debug, Clone, PartialEq)]
pub struct Knowledge {
    /// One per unknown.
    pub estimates: Vec<Estimate>,
    /// Correlation matrix; absent where the data are blind in a direction of several unknowns. Of an unknown without any
    /// effect NaN beside its own 1.
    pub correlation: Option<Vec<Vec<f64>>>,
    /// Standard deviation of the scaled residuals with `freedom` degrees of freedom; absent without any.
    pub residual_sigma: Option<f64>,
    /// Observations less unknowns that they feel.
    pub freedom: usize,
    /// What cannot be told apart.
    pub tied: Vec<Tied>,
    /// Smallest over largest singular value of the Jacobian of what the data feel, columns of equal length; 0 where they feel
    /// nothing.
    pub singular_ratio: f64,
}

impl Knowledge {
    /// Of data that feel nothing.
    const NONE: Self = Self {
        estimates: Vec::new(),
        correlation: None,
        residual_sigma: None,
        freedom: 0,
        tied: Vec::new(),
        singular_ratio: 0.0,
    };

    /// Unknowns that the data do not determine.
    pub fn undetermined(&self) -> impl Iterator<Item = (usize, Doubt)> {
        self.estimates.iter().enumerate().filter_map(|(j, e)| Some((j, e.doubt?)))
    }

    /// Unknowns that alone make up a blind direction.
    pub fn without_influence(&self) -> Vec<usize> {
        let alone = |tied: &Tied| {
            let Tied::Blind { direction } = tied else { return None };
            let mut moved = (0..direction.len()).filter(|&j| direction[j].abs() > 0.01);
            moved.next().filter(|_| moved.next().is_none())
        };
        self.tied.iter().filter_map(alone).collect()
    }
}

/// From the Jacobian of the scaled residuals by the unknowns over their ranges, and the residuals at the solution; `bounds`
/// are (least, most) of each; `given`: each residual is in standard errors that the data came with, which then bound what
/// is known. Unknowns without effect are left aside, and the others judged without them.
pub(super) fn knowledge(
    jacobian: &DMatrix<f64>,
    residuals: &DVector<f64>,
    values: &[f64],
    bounds: &[(f64, f64)],
    given: bool,
) -> Knowledge {
    let p = jacobian.ncols();
    let lengths: Vec<f64> = jacobian.column_iter().map(|c| c.norm()).collect();
    let largest = lengths.iter().fold(0.0, |a: f64, b| a.max(*b));
    let (felt, unfelt): (Vec<usize>, Vec<usize>) = (0..p).partition(|&j| lengths[j] > NOTHING * largest);
    let pick = |list: &[f64]| felt.iter().map(|&j| list[j]).collect::<Vec<_>>();
    let of_felt: Vec<(f64, f64)> = felt.iter().map(|&j| bounds[j]).collect();
    let known = match felt.is_empty() {
        true => Knowledge::NONE,
        false => of_all_felt(&jacobian.select_columns(&felt), residuals, &pick(values), &of_felt, given),
    };
    let place = |k: usize| felt.iter().position(|&j| j == k);
    let estimates = (0..p).map(|j| match place(j) {
        Some(k) => known.estimates[k].over(&felt),
        None => Estimate {
            value: values[j],
            sigma: None,
            half_width: None,
            by_law: None,
            doubt: Some(Doubt::NoInterval),
        },
    });
    let entry = |c: &[Vec<f64>], i: usize, j: usize| match (place(i), place(j)) {
        (Some(a), Some(b)) => c[a][b],
        _ if i == j => 1.0,
        _ => f64::NAN,
    };
    let correlation = known
        .correlation
        .as_ref()
        .map(|c| (0..p).map(|i| (0..p).map(|j| entry(c, i, j)).collect()).collect());
    let alone = unfelt
        .iter()
        .map(|&j| Tied::Blind { direction: (0..p).map(|i| if i == j { 1.0 } else { 0.0 }).collect() });
    let tied = known.tied.iter().map(|tied| tied.over(&felt, p)).chain(alone).collect();
    Knowledge { estimates: estimates.collect(), correlation, tied, ..known }
}

impl Estimate {
    /// The same with the other unknown by its index among all, of which `felt` are here.
    fn over(&self, felt: &[usize]) -> Self {
        let doubt = self.doubt.map(|doubt| match doubt {
            Doubt::Inseparable(other) => Doubt::Inseparable(felt[other]),
            other => other,
        });
        Self { doubt, ..self.clone() }
    }
}

impl Tied {
    /// As [`Estimate::over`]; `count` unknowns in all.
    fn over(&self, felt: &[usize], count: usize) -> Self {
        match self {
            Self::Strongly { first, second, correlation } => {
                Self::Strongly { first: felt[*first], second: felt[*second], correlation: *correlation }
            }
            Self::Blind { direction } => {
                let mut all = vec![0.0; count];
                felt.iter().zip(direction).for_each(|(&j, d)| all[j] = *d);
                Self::Blind { direction: all }
            }
        }
    }
}

/// [`knowledge`] where every column has a length.
fn of_all_felt(
    jacobian: &DMatrix<f64>,
    residuals: &DVector<f64>,
    values: &[f64],
    bounds: &[(f64, f64)],
    given: bool,
) -> Knowledge {
    let (m, p) = jacobian.shape();
    let freedom = m.saturating_sub(p);
    let residual_sigma = (freedom > 0).then(|| (residuals.norm_squared() / freedom as f64).sqrt());
    // Columns of equal length: the ratio of singular values does not depend on the ranges.
    let lengths: Vec<f64> = jacobian.column_iter().map(|c| c.norm()).collect();
    let mut scaled = jacobian.clone();
    for (mut column, length) in scaled.column_iter_mut().zip(&lengths) {
        column /= *length;
    }
    // Rows of zeros make the factorisation square where there are fewer observations than unknowns.
    let padded = scaled.resize(m.max(p), p, 0.0);
    let svd = SVD::new(padded, false, true);
    let v = svd.v_t.map(|v| v.transpose()).unwrap_or_else(|| DMatrix::identity(p, p));
    let s = svd.singular_values;
    let top = s.iter().fold(0.0, |a: f64, b| a.max(*b));
    let mut tied = Vec::new();
    for (k, sigma) in s.iter().enumerate() {
        if *sigma > BLIND * top {
            continue;
        }
        let raw: Vec<f64> = (0..p).map(|j| v[(j, k)] / lengths[j]).collect();
        let most = raw.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
        tied.push(Tied::Blind { direction: raw.iter().map(|x| x / most).collect() });
    }
    let singular_ratio = if top > 0.0 { s.iter().fold(top, |a, b| a.min(*b)) / top } else { 0.0 };
    let blind = !tied.is_empty();
    let t = student::two_sided(CONFIDENCE, freedom);
    let covariance = (!blind).then(|| {
        let mut inner = DMatrix::zeros(p, p);
        for k in 0..p {
            let column = v.column(k);
            inner += column * column.transpose() / (s[k] * s[k]);
        }
        inner
    });
    let mut estimates = (0..p)
        .map(|j| {
            let sigma = covariance
                .as_ref()
                .zip(residual_sigma.map(|s| if given { s.max(1.0) } else { s }))
                .map(|(c, r)| r * c[(j, j)].max(0.0).sqrt() / lengths[j] * (bounds[j].1 - bounds[j].0));
            let half_width = sigma.zip(t).map(|(s, t)| s * t);
            let doubt = width_doubt(values[j], half_width, bounds[j]);
            Estimate { value: values[j], sigma, half_width, by_law: None, doubt }
        })
        .collect::<Vec<_>>();
    let correlation = covariance.map(|c| {
        let of = |i: usize, j: usize| if i == j { 1.0 } else { c[(i, j)] / (c[(i, i)] * c[(j, j)]).sqrt() };
        (0..p).map(|i| (0..p).map(|j| of(i, j)).collect::<Vec<f64>>()).collect::<Vec<_>>()
    });
    if let Some(c) = &correlation {
        for (first, row) in c.iter().enumerate() {
            let others =
                row.iter().enumerate().filter(|(second, r)| *second != first && r.abs() > INSEPARABLE);
            if let Some((other, _)) = others.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs())) {
                estimates[first].doubt.get_or_insert(Doubt::Inseparable(other));
            }
            let after = row.iter().enumerate().skip(first + 1).filter(|(_, r)| r.abs() > STRONG);
            tied.extend(after.map(|(second, &correlation)| Tied::Strongly { first, second, correlation }));
        }
    }
    Knowledge { estimates, correlation, residual_sigma, freedom, tied, singular_ratio }
}

/// How far an error of the residuals with the covariance `law` moves a least-squares solution: 1.96 standard deviations of each
/// unknown, in shares of its range; `None` where the data are blind.
pub(super) fn moved_by(jacobian: &DMatrix<f64>, law: &DMatrix<f64>) -> Option<Vec<f64>> {
    let normal = jacobian.transpose() * jacobian;
    let solution = normal.try_inverse()? * jacobian.transpose();
    let covariance = &solution * law * solution.transpose();
    let widths: Vec<f64> = covariance.diagonal().iter().map(|v| 1.96 * v.max(0.0).sqrt()).collect();
    widths.iter().all(|w| w.is_finite()).then_some(widths)
}

/// Correlation of two unknowns.
pub(super) fn correlation(jacobian: &DMatrix<f64>, i: usize, j: usize) -> Option<f64> {
    let c = (jacobian.transpose() * jacobian).try_inverse()?;
    Some(c[(i, j)] / (c[(i, i)] * c[(j, j)]).sqrt()).filter(|r| r.is_finite())
}

/// What the interval alone says against `value` between the bounds `(least, most)`.
fn width_doubt(value: f64, half_width: Option<f64>, (least, most): (f64, f64)) -> Option<Doubt> {
    let wide = |known: f64| half_width.is_some_and(|w| w >= TOO_WIDE * known);
    match half_width {
        None => Some(Doubt::NoInterval),
        Some(_) if (value - least).min(most - value) <= 1e-9 * (most - least) => Some(Doubt::AtBound),
        Some(_) if wide(most - least) => Some(Doubt::WiderThanBounds),
        // Between bounds of both signs a value near 0 is as good as any other.
        Some(_) if least * most > 0.0 && wide(value.abs()) => Some(Doubt::WiderThanValue),
        Some(_) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Straight line through five points: textbook standard errors (Draper & Smith, *Applied Regression Analysis*, 1.4):
    /// s^2/S_xx for the slope, s^2 sum x^2/(n S_xx) for the intercept, correlation -mean x/sqrt(mean x^2).
    #[test]
    fn a_straight_line_has_the_textbook_errors() {
        let (x, y) = ([1.0, 2.0, 3.0, 4.0, 5.0], [1.1, 1.9, 3.2, 3.8, 5.1]);
        let (mx, my) = (3.0, y.iter().sum::<f64>() / 5.0);
        let sxx: f64 = x.iter().map(|x| (x - mx) * (x - mx)).sum();
        let slope = x.iter().zip(y).map(|(x, y)| (x - mx) * (y - my)).sum::<f64>() / sxx;
        let intercept = my - slope * mx;
        let residuals = DVector::from_fn(5, |i, _| intercept + slope * x[i] - y[i]);
        // Ranges 10 and 2: derivatives by the share of the range.
        let jacobian = DMatrix::from_fn(5, 2, |i, j| if j == 0 { 10.0 } else { 2.0 * x[i] });
        let k = knowledge(&jacobian, &residuals, &[intercept, slope], &[(-5.0, 5.0), (0.5, 2.5)], false);
        let s2 = residuals.norm_squared() / 3.0;
        let square: f64 = x.iter().map(|x| x * x).sum();
        let want = [(s2 * square / (5.0 * sxx)).sqrt(), (s2 / sxx).sqrt()];
        for (e, want) in k.estimates.iter().zip(want) {
            assert!((e.sigma.unwrap() / want - 1.0).abs() < 1e-12, "{e:?} {want}");
            // t(0.975, 3) = 3.182
            assert!((e.half_width.unwrap() / want - 3.182).abs() < 1e-3);
        }
        let rho = k.correlation.as_ref().unwrap()[0][1];
        assert!((rho + mx / (square / 5.0).sqrt()).abs() < 1e-12, "{rho}");
        assert!(k.tied.is_empty());
        // 0.06 +- 0.6 in a range of 10, 0.99 +- 0.18 in one of 2.
        assert_eq!(k.undetermined().count(), 0, "{k:?}");
    }

    #[test]
    fn an_error_common_to_all_rows_moves_a_mean_as_far_as_itself() {
        // The mean of n rows: independent errors shrink by sqrt(n), a common one not at all.
        let ones = DMatrix::from_element(8, 1, 1.0);
        let moved = |covariance: DMatrix<f64>| moved_by(&ones, &covariance).unwrap()[0];
        assert!((moved(DMatrix::from_element(8, 8, 0.01)) - 1.96 * 0.1).abs() < 1e-12);
        assert!((moved(0.01 * DMatrix::identity(8, 8)) - 1.96 * 0.1 / 8f64.sqrt()).abs() < 1e-12);
        assert_eq!(moved_by(&DMatrix::zeros(3, 1), &DMatrix::identity(3, 3)), None);
    }

    /// y = a + b x + c, with a second regressor that is nearly the first: both are seen, but not apart.
    #[test]
    fn an_interval_as_wide_as_the_bounds_or_the_value_determines_nothing() {
        let with = |apart: f64, scatter: f64, bounds: [(f64, f64); 2]| {
            let x = |i: usize| 1.0 + i as f64;
            let near = |i: usize| x(i) + apart * if i.is_multiple_of(2) { 1.0 } else { -1.0 };
            let jacobian = DMatrix::from_fn(6, 2, |i, j| {
                let range = bounds[j].1 - bounds[j].0;
                range * if j == 0 { x(i) } else { near(i) }
            });
            let residuals = DVector::from_fn(6, |i, _| scatter * [1.0, -1.0, -1.0, 1.0, 1.0, -1.0][i]);
            knowledge(&jacobian, &residuals, &[2.0, 0.1], &bounds, false)
        };
        let doubts = |k: &Knowledge| k.undetermined().map(|(_, doubt)| doubt).collect::<Vec<_>>();
        let narrow = [(1.9, 2.1), (0.0, 0.2)];
        let blurred = with(1e-3, 1e-2, narrow);
        assert!(blurred.correlation.as_ref().unwrap()[0][1] < -0.9999, "{blurred:?}");
        assert_eq!(doubts(&blurred), [Doubt::WiderThanBounds; 2], "{blurred:?}");
        // Without scatter the intervals are narrow, and the two are inseparable all the same.
        let sharp = with(1e-3, 1e-9, narrow);
        assert_eq!(doubts(&sharp), [Doubt::Inseparable(1), Doubt::Inseparable(0)], "{sharp:?}");
        // Wide bounds of one sign: 0.1 +- 0.06 or more is known to half its value only.
        let wide = with(1.0, 0.05, [(1.0, 3.0), (0.01, 10.0)]);
        assert_eq!(wide.undetermined().collect::<Vec<_>>(), [(1, Doubt::WiderThanValue)], "{wide:?}");
        assert_eq!(doubts(&with(1.0, 0.05, [(1.0, 3.0), (-5.0, 5.0)])), [], "both signs");
    }

    #[test]
    fn a_sum_that_alone_is_seen_ties_its_terms() {
        // Only a + 2b enters; c enters on its own, d not at all.
        let jacobian = DMatrix::from_fn(6, 4, |i, j| {
            let x = 1.0 + i as f64;
            [x, 2.0 * x, x * x, 0.0][j]
        });
        let k = knowledge(&jacobian, &DVector::from_element(6, 0.1), &[1.0; 4], &[(0.5, 1.5); 4], false);
        assert_eq!(k.correlation, None);
        assert!(k.estimates.iter().all(|e| e.sigma.is_none()));
        let directions: Vec<&Vec<f64>> = k
            .tied
            .iter()
            .map(|t| if let Tied::Blind { direction } = t { direction } else { panic!() })
            .collect();
        assert_eq!(directions.len(), 2, "{directions:?}");
        for d in &directions {
            assert!((d[0] + 2.0 * d[1]).abs() < 1e-6 && d[2].abs() < 1e-9, "{d:?}");
        }
        assert!(directions.iter().any(|d| d[3].abs() > 0.9), "{directions:?}");
    }

    #[test]
    fn an_unknown_without_effect_is_told_by_itself_and_the_others_are_judged() {
        let column = |j: usize, i: usize| [1.0, 1.0 + i as f64][j];
        let residuals = DVector::from_fn(6, |i, _| 1e-3 * [1.0, -1.0, -1.0, 1.0, 1.0, -1.0][i]);
        let alone = knowledge(
            &DMatrix::from_fn(6, 2, |i, j| column(j, i)),
            &residuals,
            &[1.0, 2.0],
            &[(0.5, 1.5), (1.5, 2.5)],
            false,
        );
        let beside = knowledge(
            &DMatrix::from_fn(6, 3, |i, j| [column(0, i), 1e-9, column(1, i)][j]),
            &residuals,
            &[1.0, 7.0, 2.0],
            &[(0.5, 1.5), (6.0, 8.0), (1.5, 2.5)],
            false,
        );
        assert_eq!(alone.undetermined().count(), 0, "{alone:?}");
        assert_eq!([&beside.estimates[0], &beside.estimates[2]], [&alone.estimates[0], &alone.estimates[1]]);
        assert_eq!(beside.undetermined().collect::<Vec<_>>(), [(1, Doubt::NoInterval)]);
        assert_eq!(beside.without_influence(), [1]);
        assert_eq!((beside.freedom, beside.residual_sigma), (alone.freedom, alone.residual_sigma));
        let (a, b) = (alone.correlation.unwrap(), beside.correlation.unwrap());
        assert!(b[0][2] == a[0][1] && b[1][1] == 1.0 && b[0][1].is_nan() && b[1][2].is_nan(), "{b:?}");
        // Nothing is felt at all.
        let none =
            knowledge(&DMatrix::zeros(6, 2), &residuals, &[1.0, 2.0], &[(0.5, 1.5), (1.5, 2.5)], false);
        assert_eq!(none.without_influence(), [0, 1]);
    }

    #[test]
    fn beyond_a_correlation_of_0_99_two_unknowns_are_determined_only_together() {
        let with = |apart: f64| {
            let jacobian = DMatrix::from_fn(6, 2, |i, j| {
                let x = 1.0 + i as f64;
                x + if j == 1 { apart * if i.is_multiple_of(2) { 1.0 } else { -1.0 } } else { 0.0 }
            });
            knowledge(&jacobian, &DVector::from_element(6, 1e-9), &[1.0, 1.0], &[(0.5, 1.5); 2], false)
        };
        let doubts = |k: &Knowledge| k.undetermined().map(|(_, doubt)| doubt).collect::<Vec<_>>();
        let near = with(0.3);
        assert!((0.99..0.9999).contains(&-near.correlation.as_ref().unwrap()[0][1]), "{near:?}");
        assert_eq!(doubts(&near), [Doubt::Inseparable(1), Doubt::Inseparable(0)]);
        let apart = with(0.8);
        assert!((0.95..0.99).contains(&-apart.correlation.as_ref().unwrap()[0][1]), "{apart:?}");
        assert_eq!(doubts(&apart), []);
    }
}
