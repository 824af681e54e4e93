//! Derivative tables: those that the problem itself gives, and what it does not by differences: forward while far from the
//! solution, central near it, one-sided at a bound or beside a region in which evaluation fails.

use super::journal::{Halt, Memo};
use super::settings::Settings;
use super::space::Space;

/// Derivatives of every output (objectives, limits, tie break) by every variable scaled to [0, 1].
#[derive(Debug, Clone)]
pub(super) struct Table {
    /// `slopes[output][variable]`, output units per range; 0 for fixed and held variables.
    pub slopes: Vec<Vec<f64>>,
    /// Second derivatives on the diagonal, where two points per variable gave them.
    pub curvatures: Option<Vec<Vec<f64>>>,
    /// Variables with no derivative, since every difference point failed.
    pub held: Vec<usize>,
    /// Whether no slope is a difference of evaluations.
    pub exact: bool,
    /// Steps over which the slopes were followed by secants since they were taken.
    pub secants: usize,
}

impl Table {
    /// Before anything is known: every variable held.
    pub fn unknown(space: &Space) -> Self {
        Table {
            slopes: Vec::new(),
            curvatures: None,
            held: (0..space.len()).collect(),
            exact: false,
            secants: 0,
        }
    }
}

impl Table {
    /// Slopes followed over the step `s`: the least change of each row that makes its slope along the step that of the secant
    /// (Broyden, *Math. Comp.* 19 (1965) 577).
    pub fn follow(&mut self, s: &[f64], before: &[f64], after: &[f64]) {
        let length: f64 = s.iter().map(|v| v * v).sum();
        for (row, (a, b)) in self.slopes.iter_mut().zip(before.iter().zip(after)) {
            let missed = b - a - row.iter().zip(s).map(|(g, v)| g * v).sum::<f64>();
            row.iter_mut().zip(s).for_each(|(g, v)| *g += missed * v / length);
        }
        self.secants += 1;
    }
}

/// Length of the difference steps of each variable.
#[derive(Debug, Clone)]
pub(super) struct Steps {
    pub forward: Vec<f64>,
    pub central: Vec<f64>,
}

impl Steps {
    pub fn shortest(variables: usize, settings: &Settings) -> Self {
        let h = vec![settings.shortest_difference; variables];
        Steps { forward: h.clone(), central: h }
    }

    /// Steps that minimise the bound on the error summed over the outputs j: forward
    /// sum |f''| h/2 + 2 noise/h, so h = 2 sqrt(sum noise / sum |f''|); central with f''' taken as large as f''
    /// (one range is the length on which the margins bend), sum |f''| h^2/6 + noise/h,
    /// so h = (3 sum noise / sum |f''|)^(1/3) (Gill, Murray, Wright, *Practical Optimization*, 8.6).
    /// |f''| counts as no less than |f'|, or a passing inflexion would call for a long step. `None` without
    /// second derivatives.
    pub fn fitted(table: &Table, noise: &[f64], settings: &Settings) -> Option<Self> {
        let curvatures = table.curvatures.as_ref()?;
        let total_noise: f64 = noise.iter().sum();
        let ratio = |i: usize| {
            let bend = curvatures.iter().zip(&table.slopes).map(|(c, s)| c[i].abs().max(s[i].abs()));
            total_noise / bend.sum::<f64>().max(1e-300)
        };
        let clamp = |h: f64| h.clamp(settings.shortest_difference, settings.longest_difference);
        let variables = curvatures.first().map_or(0, Vec::len);
        Some(Steps {
            forward: (0..variables).map(|i| clamp(2.0 * ratio(i).sqrt())).collect(),
            central: (0..variables).map(|i| clamp((3.0 * ratio(i)).cbrt())).collect(),
        })
    }

    /// The shorter of both for each variable: steps only shrink as more curvature is seen.
    pub fn least(&self, other: &Steps) -> Steps {
        let least = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a.min(*b)).collect();
        Steps { forward: least(&self.forward, &other.forward), central: least(&self.central, &other.central) }
    }
}

/// How far from a point the problem is asked for its changes, a fraction of the range: what they leave out of the first order goes
/// with it, and the 1e-12 to which equilibria settle over it.
const BESIDE: f64 = 1e-6;

/// Slopes at u as the problem itself has them, `[output][variable]`, NaN where it has none; `None`: it has none at all.
pub(super) fn own_slopes(
    memo: &mut Memo,
    space: &Space,
    u: &[f64],
    outputs: usize,
) -> Result<Option<Vec<Vec<f64>>>, Halt> {
    let free = space.free();
    let offsets: Vec<f64> = free.iter().map(|&i| if u[i] > 0.5 { -BESIDE } else { BESIDE }).collect();
    let beside = free.iter().zip(&offsets).map(|(&i, offset)| {
        let mut v = u.to_vec();
        v[i] += offset;
        space.unscaled(&v)
    });
    let beside: Vec<Vec<f64>> = beside.collect();
    let Some(changes) = memo.changes(&space.unscaled(u), &beside)? else { return Ok(None) };
    let mut slopes = vec![vec![0.0; space.len()]; outputs];
    for ((&i, offset), change) in free.iter().zip(offsets).zip(changes) {
        for (k, row) in slopes.iter_mut().enumerate() {
            row[i] = change.get(k).map_or(f64::NAN, |c| c / offset);
        }
    }
    Ok(Some(slopes))
}

/// Derivative table at u, where the outputs are `outputs`: the problem's own slopes, and those of [`table`] where it has none.
pub(super) fn own_table(
    memo: &mut Memo,
    space: &Space,
    u: &[f64],
    outputs: &[f64],
    h: &[f64],
    central: bool,
) -> Result<Table, Halt> {
    let known = |slope: &f64| slope.is_finite();
    let own = own_slopes(memo, space, u, outputs.len())?.unwrap_or_default();
    if !own.is_empty() && own.iter().flatten().all(known) {
        return Ok(Table { slopes: own, curvatures: None, held: Vec::new(), exact: true, secants: 0 });
    }
    let mut found = table(memo, space, u, outputs, h, central)?;
    for (row, own) in found.slopes.iter_mut().zip(own) {
        row.iter_mut().zip(own).filter(|(_, own)| known(own)).for_each(|(slope, own)| *slope = own);
    }
    Ok(found)
}

/// Candidate offsets for one variable, best first, those outside [0, 1] left out.
fn candidates(u: f64, h: f64, central: bool) -> Vec<Vec<f64>> {
    let lists: &[&[f64]] = if central {
        &[&[1.0, -1.0], &[1.0, 2.0], &[-1.0, -2.0], &[0.1, -0.1], &[0.1, 0.2], &[-0.1, -0.2]]
    } else {
        &[&[1.0], &[-1.0], &[0.1], &[-0.1]]
    };
    let inside = |o: &f64| (0.0..=1.0).contains(&(u + o * h));
    lists.iter().filter(|l| l.iter().all(inside)).map(|l| l.iter().map(|o| o * h).collect()).collect()
}

/// Derivative table at u, where the outputs are `outputs`. All points of one attempt are evaluated at once.
pub(super) fn table(
    memo: &mut Memo,
    space: &Space,
    u: &[f64],
    outputs: &[f64],
    h: &[f64],
    central: bool,
) -> Result<Table, Halt> {
    let variables = space.len();
    let mut slopes = vec![vec![0.0; variables]; outputs.len()];
    let mut curvatures = vec![vec![0.0; variables]; outputs.len()];
    let mut pending: Vec<(usize, Vec<Vec<f64>>)> =
        space.free().into_iter().map(|i| (i, candidates(u[i], h[i], central))).collect();
    let mut held = Vec::new();
    while !pending.is_empty() {
        let (plans, exhausted): (Vec<_>, Vec<_>) = pending.into_iter().partition(|(_, c)| !c.is_empty());
        held.extend(exhausted.into_iter().map(|(i, _)| i));
        let moved = |i: usize, o: f64| {
            let mut v = u.to_vec();
            v[i] += o;
            v
        };
        let points: Vec<Vec<f64>> = plans
            .iter()
            .flat_map(|(i, c)| c[0].iter().map(|&o| space.unscaled(&moved(*i, o))).collect::<Vec<_>>())
            .collect();
        let mut outcomes = memo.batch(points)?.into_iter();
        pending = Vec::new();
        for (i, mut list) in plans {
            let offsets = list.remove(0);
            let found: Vec<_> = outcomes.by_ref().take(offsets.len()).collect();
            let rows: Result<Vec<Vec<f64>>, _> = found.into_iter().map(|r| r.map(|e| e.outputs())).collect();
            let Ok(rows) = rows else {
                pending.push((i, list));
                continue;
            };
            for (k, &f0) in outputs.iter().enumerate() {
                let p = |s: usize| (rows[s][k] - f0) / offsets[s];
                if offsets.len() == 1 {
                    slopes[k][i] = p(0);
                } else {
                    // Parabola through three points: f' = p0 - f'' a/2, f'' = 2 (p0 - p1)/(a - b).
                    curvatures[k][i] = 2.0 * (p(0) - p(1)) / (offsets[0] - offsets[1]);
                    slopes[k][i] = p(0) - 0.5 * curvatures[k][i] * offsets[0];
                }
            }
        }
    }
    held.sort_unstable();
    Ok(Table { slopes, curvatures: central.then_some(curvatures), held, exact: false, secants: 0 })
}
