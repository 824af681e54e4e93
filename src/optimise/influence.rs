//! Which variable moves which margin.

use super::difference::{own_slopes, table};
use super::evaluate::Evaluate;
use super::journal::{Memo, SearchRun};
use super::outcome::Refusal;
use super::settings::Settings;
use super::space::Space;

/// Slope per range below which a variable counts as without influence: 1e-9, above what rounding leaves of margins of
/// order one over a difference step of 1e-3 (1e-13), below any slope worth a search.
pub const NO_INFLUENCE: f64 = 1e-9;

/// Derivatives d(margin)/d(x scaled to its range) at one point.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Influence {
    /// `objectives[i][variable]`, unit of the objective per range.
    pub objectives: Vec<Vec<f64>>,
    /// `limits[j][variable]`, unit of the limit per range.
    pub limits: Vec<Vec<f64>>,
    /// Of the tie break.
    pub tie_break: Vec<f64>,
    /// Variables of which no difference point could be evaluated; their columns are 0 and mean nothing.
    pub unknown: Vec<usize>,
    /// Evaluations spent.
    pub evaluations: usize,
    /// Derivatives along one variable that the problem gave itself.
    pub derivatives: usize,
}

/// Slope per range from which on a variable is felt for certain: far above what a problem's own slopes are off by.
const FELT: f64 = 1e-3;

impl Influence {
    /// Of `slopes` by output, those of `objectives` first, the tie break's last.
    fn of(mut slopes: Vec<Vec<f64>>, objectives: usize, unknown: Vec<usize>, memo: &Memo) -> Self {
        let tie_break = slopes.pop().unwrap_or_default();
        let limits = slopes.split_off(objectives);
        let (evaluations, derivatives) = (memo.evaluations(), memo.derivatives);
        Self { objectives: slopes, limits, tie_break, unknown, evaluations, derivatives }
    }

    /// Variables whose every slope is below [`NO_INFLUENCE`] in size, the tie break's included; limits at the places `but` tell nothing.
    pub fn without(&self, but: &[usize]) -> Vec<usize> {
        let limits = || self.limits.iter().enumerate().filter(|(j, _)| !but.contains(j)).map(|(_, row)| row);
        let rows = || self.objectives.iter().chain(limits()).chain([&self.tie_break]);
        (0..self.tie_break.len())
            .filter(|i| !self.unknown.contains(i) && rows().all(|row| row[*i].abs() < NO_INFLUENCE))
            .collect()
    }
}

/// Influence of every variable at x0 by central differences of the longest step, which noise disturbs least.
/// A variable on a level stretch (a maximum, a saturated margin) shows none either.
///
/// # Errors
/// As [`maximise_least_margin`](super::maximise_least_margin).
pub fn influence<'a>(
    problem: &'a dyn Evaluate,
    x0: &[f64],
    lo: &[f64],
    hi: &[f64],
    settings: &Settings,
    run: SearchRun<'a>,
) -> Result<Influence, Refusal> {
    settings.validate().map_err(Refusal::Setting)?;
    let space = Space::new(x0, lo, hi)?;
    let mut memo = Memo::new(problem, run, usize::MAX);
    let here = memo.one(x0.to_vec()).map_err(|_| Refusal::StoppedAtStart)?.map_err(Refusal::StartFails)?;
    let h = vec![settings.longest_difference; space.len()];
    let found = table(&mut memo, &space, &space.start(), &here.outputs(), &h, true)
        .map_err(|_| Refusal::StoppedAtStart)?;
    Ok(Influence::of(found.slopes, here.objectives.len(), found.held, &memo))
}

/// The same by the slopes that the problem has itself; `None` where one is not known, or a variable is so little felt that these
/// do not tell whether it is; limits at the places `but` do not count.
///
/// # Errors
/// As [`influence`].
pub(super) fn own_influence<'a>(
    problem: &'a dyn Evaluate,
    x0: &[f64],
    lo: &[f64],
    hi: &[f64],
    but: &[usize],
    run: SearchRun<'a>,
) -> Result<Option<Influence>, Refusal> {
    let space = Space::new(x0, lo, hi)?;
    let mut memo = Memo::new(problem, run, usize::MAX);
    let here = memo.one(x0.to_vec()).map_err(|_| Refusal::StoppedAtStart)?.map_err(Refusal::StartFails)?;
    let found = own_slopes(&mut memo, &space, &space.start(), here.outputs().len());
    let Some(slopes) = found.map_err(|_| Refusal::StoppedAtStart)? else { return Ok(None) };
    let tells = |k: &usize| k.checked_sub(here.objectives.len()).is_none_or(|limit| !but.contains(&limit));
    let is_felt = |i: usize| (0..slopes.len()).filter(tells).any(|k| slopes[k][i].abs() > FELT);
    let known = slopes.iter().flatten().all(|slope| slope.is_finite());
    let told = known && (0..space.len()).all(is_felt);
    Ok(told.then(|| Influence::of(slopes, here.objectives.len(), Vec::new(), &memo)))
}
