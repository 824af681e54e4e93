//! Points of a box, each by its number alone: whoever computes point 17 gets the same numbers.

use crate::design::{Optimize, OptimizeVariable, nearest};
use crate::numeric::sobol::{MOST_DIMENSIONS, sobol};
use std::fmt;
use std::str::FromStr;

/// Which points of the box.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Sampling {
    /// Scrambled Sobol points over all variables.
    Sobol {
        /// Points.
        count: u64,
        /// Seed of the scrambling.
        seed: u64,
    },
    /// Every combination of evenly spaced values, bounds included; the last variable of the file runs fastest. Variables that are not
    /// named stay at their start.
    Grid(Vec<(String, u64)>),
}

impl fmt::Display for Sampling {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Sobol { count, seed } => write!(f, "sobol {count} seed {seed}"),
            Self::Grid(steps) => {
                let steps: Vec<String> = steps.iter().map(|(name, n)| format!("{name}={n}")).collect();
                write!(f, "grid {}", steps.join(","))
            }
        }
    }
}

impl FromStr for Sampling {
    type Err = ();

    /// As it is displayed.
    fn from_str(text: &str) -> Result<Self, ()> {
        match text.split(' ').collect::<Vec<_>>()[..] {
            ["sobol", count, "seed", seed] => {
                Ok(Self::Sobol { count: count.parse().map_err(|_| ())?, seed: seed.parse().map_err(|_| ())? })
            }
            ["grid", steps] => {
                let step = |text: &str| {
                    let (name, n) = text.split_once('=')?;
                    Some((name.to_owned(), n.parse().ok()?))
                };
                steps.split(',').map(step).collect::<Option<_>>().map(Self::Grid).ok_or(())
            }
            _ => Err(()),
        }
    }
}

/// Why there are no such points.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum NoSample {
    /// The design has no `[optimize]` table.
    #[error("the design has no [optimize] table; add one with objective, scenarios and variables")]
    NoTask,
    /// Of a grid: a name that is no variable; what is.
    #[error("{0} is no variable of [optimize]; {meant}the design's variables are: {names}", names = .1.join(", "),
        meant = nearest(.0, .1).map_or_else(String::new, |near| format!("did you mean {near}? ")))]
    Unknown(String, Vec<String>),
    /// Of a grid: named twice.
    #[error("{0} is named twice")]
    Twice(String),
    /// Of a grid: fewer than two values, or more than a whole-numbered variable has.
    #[error("{name}={found}: {}", .most.map_or_else(
        || "a grid needs 2 values or more of each variable that it names".to_owned(),
        |most| format!("allowed are 2 to {most} values, it takes whole numbers only"),
    ))]
    Steps {
        /// Variable.
        name: String,
        /// Values asked for.
        found: u64,
        /// Most that it has; none where there is no end.
        most: Option<u64>,
    },
    /// No point, or more than can be numbered.
    #[error("1 to 2^63 points are needed")]
    Count,
    /// More variables than the Sobol sequence has dimensions.
    #[error("{0} variables; a Sobol sequence has {MOST_DIMENSIONS} dimensions at most")]
    Dimensions(usize),
}

/// The points that a [`Sampling`] means for one task.
#[derive(Debug, Clone, PartialEq)]
pub struct BoxSample {
    axes: Vec<OptimizeVariable>,
    sampling: Sampling,
    /// Of a grid: values along each axis; 1: it stays at its start.
    steps: Vec<u64>,
    count: u64,
}

impl BoxSample {
    /// The points of `task`'s box that `sampling` means.
    ///
    /// # Errors
    /// [`NoSample`].
    pub fn of(task: &Optimize, sampling: &Sampling) -> Result<Self, NoSample> {
        let axes = task.variables.clone();
        let (steps, count) = match sampling {
            Sampling::Sobol { .. } if axes.len() > MOST_DIMENSIONS => {
                return Err(NoSample::Dimensions(axes.len()));
            }
            Sampling::Sobol { count, .. } => (Vec::new(), Some(*count)),
            Sampling::Grid(named) => {
                let steps = steps(&axes, named)?;
                let count = steps.iter().try_fold(1_u64, |all, &n| all.checked_mul(n));
                (steps, count)
            }
        };
        match count {
            Some(count @ 1..=MOST) => Ok(Self { axes, sampling: sampling.clone(), steps, count }),
            _ => Err(NoSample::Count),
        }
    }

    /// Which points these are.
    pub fn sampling(&self) -> &Sampling {
        &self.sampling
    }

    /// How many.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// Point `index`, counted from 0, in the units of the variables' names.
    pub fn point(&self, index: u64) -> Vec<f64> {
        match self.sampling {
            Sampling::Sobol { seed, .. } => {
                let drawn = |(d, v): (usize, &OptimizeVariable)| share_of(v, sobol(index, d, seed));
                self.axes.iter().enumerate().map(drawn).collect()
            }
            Sampling::Grid(_) => {
                let mut left = index;
                let mut x: Vec<f64> = self.axes.iter().map(|v| v.start).collect();
                for (d, &n) in self.steps.iter().enumerate().rev().filter(|(_, n)| **n > 1) {
                    x[d] = step_of(&self.axes[d], left % n, n);
                    left /= n;
                }
                x
            }
        }
    }
}

/// Most points: numbers of points stay exact as signed integers, too.
const MOST: u64 = 1 << 63;

/// Values along each axis.
fn steps(axes: &[OptimizeVariable], named: &[(String, u64)]) -> Result<Vec<u64>, NoSample> {
    let mut steps = vec![1; axes.len()];
    for (name, found) in named {
        let Some(at) = axes.iter().position(|v| v.name == *name) else {
            return Err(NoSample::Unknown(name.clone(), axes.iter().map(|v| v.name.clone()).collect()));
        };
        if steps[at] != 1 {
            return Err(NoSample::Twice(name.clone()));
        }
        let most = axes[at].whole.then(|| whole_range(&axes[at])).map(|[low, high]| (high - low) as u64 + 1);
        if *found < 2 || most.is_some_and(|most| *found > most) {
            return Err(NoSample::Steps { name: name.clone(), found: *found, most });
        }
        steps[at] = *found;
    }
    Ok(steps)
}

/// Least and greatest whole number within the bounds.
fn whole_range(v: &OptimizeVariable) -> [f64; 2] {
    let low = v.min.ceil();
    [low, v.max.floor().max(low)]
}

/// The value at `share` of the range, 0 <= share < 1; whole numbers are equally likely.
fn share_of(v: &OptimizeVariable, share: f64) -> f64 {
    if v.whole {
        let [low, high] = whole_range(v);
        return (low + (share * (high - low + 1.0)).floor()).min(high);
    }
    (v.min + share * (v.max - v.min)).clamp(v.min, v.max)
}

/// Value `k` of `n` evenly spaced ones, both bounds included.
fn step_of(v: &OptimizeVariable, k: u64, n: u64) -> f64 {
    let [low, high] = if v.whole { whole_range(v) } else { [v.min, v.max] };
    let last = n - 1;
    if k == last {
        return high;
    }
    let value = low + (high - low) * (k as f64 / last as f64);
    if v.whole { value.round() } else { value.clamp(low, high) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::Design;

    fn task() -> Optimize {
        let text = include_str!("../../designs/huang2017-multi-arc.toml");
        Design::parse(text, "multi-arc").unwrap().optimize.unwrap()
    }

    fn whole(task: &mut Optimize) {
        task.variables[0] =
            OptimizeVariable { min: 9.5, max: 13.2, start: 12.0, whole: true, ..task.variables[0].clone() };
    }

    #[test]
    fn points_lie_within_their_bounds_and_are_as_displayed() {
        let mut task = task();
        whole(&mut task);
        for sampling in [
            Sampling::Sobol { count: 200_000, seed: 3 },
            Sampling::Grid(vec![("r_i3_mm".into(), 5), (task.variables[0].name.clone(), 4)]),
        ] {
            let sample = BoxSample::of(&task, &sampling).unwrap();
            assert_eq!(sampling.to_string().parse(), Ok(sampling.clone()));
            for index in (0..sample.count()).step_by(997).chain([sample.count() - 1]) {
                let x = sample.point(index);
                assert_eq!(task.outside(&x), None);
                assert!(x[0].fract() == 0.0 && (10.0..=13.0).contains(&x[0]), "{x:?}");
            }
        }
    }

    #[test]
    fn a_grid_has_every_combination_once_and_ends_on_the_bounds() {
        let task = task();
        let sampling = Sampling::Grid(vec![("r_i3_mm".into(), 3), ("r_i2_mm".into(), 2)]);
        let sample = BoxSample::of(&task, &sampling).unwrap();
        let points: Vec<[f64; 2]> =
            (0..sample.count()).map(|i| sample.point(i)).map(|x| [x[0], x[1]]).collect();
        assert_eq!(points, [[3.6, 3.6], [3.6, 4.4], [3.6, 5.2], [4.8, 3.6], [4.8, 4.4], [4.8, 5.2]]);
        assert_eq!(sample.point(4)[2..], [0.1935, 0.5288]);
    }

    #[test]
    fn senseless_grids_are_refused_with_what_is_allowed() {
        let mut task = task();
        whole(&mut task);
        let name = task.variables[0].name.clone();
        for (steps, word) in [
            (vec![("r_i3_m".to_owned(), 3)], "did you mean r_i3_mm"),
            (vec![("r_i3_mm".to_owned(), 1)], "2 values or more"),
            (vec![(name.clone(), 5)], "2 to 4 values"),
            (vec![(name.clone(), 2), (name, 2)], "twice"),
            (vec![("r_i3_mm".to_owned(), u64::MAX), ("centroid_x_mm".to_owned(), 2)], "2^63"),
        ] {
            let why = BoxSample::of(&task, &Sampling::Grid(steps)).unwrap_err().to_string();
            assert!(why.contains(word), "{why}");
        }
        assert_eq!(BoxSample::of(&task, &Sampling::Sobol { count: 0, seed: 0 }), Err(NoSample::Count));
    }
}
