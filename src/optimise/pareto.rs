//! The front between two or three objectives.
//!
//! Anchors first: the best of each objective alone. Then, between them, points of Wierzbicki's achievement function
//! (*The use of reference objectives in multiobjective optimization*, 1980): with objectives scaled to 0 at the worst of
//! the anchors and 1 at the best, maximise min_k (f_k - w_k) for w on an even lattice of the simplex. It is a minimax
//! problem like that of the slip margin, finds points of hollow fronts too, and each climb starts from its neighbour.

use super::desk::Desk;
use super::evaluate::NoEvaluation;
use super::goal::Goal;
use super::search::{NoSearch, Search, refused};
use super::starts::SearchMethod;
use crate::design::{Objective, Optimize};

/// Range of an objective between the anchors below which it is in no conflict with the others, relative to its size.
const NO_CONFLICT: f64 = 1e-6;

/// One point of a front.
#[derive(Debug, Clone, PartialEq)]
pub struct FrontPoint {
    /// Variables, in the order of [`Front::variables`].
    pub x: Vec<f64>,
    /// Objectives, each in its own unit.
    pub values: Vec<f64>,
    /// The objective of which it is the best, for an anchor.
    pub anchor: Option<Objective>,
}

/// A front.
#[derive(Debug, Clone, PartialEq)]
pub struct Front {
    /// Objectives.
    pub aims: Vec<Objective>,
    /// Variables that moved.
    pub variables: Vec<String>,
    /// Points that no other beats in everything, sorted by the first objective, its best first.
    pub points: Vec<FrontPoint>,
    /// Climbs that ended without a feasible point, or at a point that another beats.
    pub beaten: usize,
    /// Evaluations of the clutch.
    pub evaluations: usize,
}

/// The front of `aims`, over the continuous variables of `found`, a search that has ended: `lattice` steps between any two
/// anchors.
///
/// # Errors
/// [`NoSearch`] where an anchor cannot be searched.
pub fn front(
    found: &Search,
    task: &Optimize,
    aims: &[Objective],
    lattice: usize,
    method: &SearchMethod,
    desk: &Desk,
) -> Result<Front, NoSearch> {
    let goals: Vec<Goal> = aims.iter().map(|&a| Goal::plain(a, &task.limits)).collect();
    let all = found.problem.with_goals(goals);
    let (lo, hi) = found.bounds();
    let climb = &method.climb;
    let mut evaluations = 0;
    let mut points: Vec<FrontPoint> = Vec::new();
    let mut beaten = 0;
    let seen = |x: &[f64], evaluations: &mut usize| -> Result<Vec<f64>, NoEvaluation> {
        *evaluations += 1;
        let assessed = all.assess_at(x)?;
        Ok((0..aims.len()).map(|k| all.value(&assessed, k)).collect())
    };
    for &aim in aims {
        desk.begins(&format!("anchor {aim}"));
        let single = found.problem.with_goals(vec![Goal::plain(aim, &task.limits)]);
        let outcome = desk.climb(&single, &found.outcome.x, (&lo, &hi), climb).map_err(refused)?;
        evaluations += outcome.evaluations;
        if outcome.evaluation.violation() > climb.violation_tolerance {
            beaten += 1;
            continue;
        }
        let values = seen(&outcome.x, &mut evaluations).map_err(NoSearch::Start)?;
        points.push(FrontPoint { x: outcome.x, values, anchor: Some(aim) });
    }
    if points.len() == aims.len() {
        let scale = |k: usize| {
            let raised = points.iter().map(|p| p.values[k] * aims[k].sense());
            let best = raised.clone().fold(f64::NEG_INFINITY, f64::max);
            let worst = raised.fold(f64::INFINITY, f64::min);
            (worst, best - worst)
        };
        let scales: Vec<(f64, f64)> = (0..aims.len()).map(scale).collect();
        let fight = scales.iter().all(|(worst, range)| *range > NO_CONFLICT * worst.abs().max(1e-3));
        let mut solved: Vec<(Vec<f64>, Vec<f64>)> =
            points.iter().enumerate().map(|(k, p)| (unit(k, aims.len()), p.x.clone())).collect();
        for w in if fight { simplex(aims.len(), lattice) } else { Vec::new() } {
            if desk.stopped() {
                break;
            }
            desk.begins(&format!("front point {w:.2?}"));
            let goals: Vec<Goal> = aims
                .iter()
                .zip(&scales)
                .zip(&w)
                .map(|((&objective, &(worst, range)), w)| Goal {
                    objective,
                    from: worst + w * range,
                    span: range,
                })
                .collect();
            let distance = |v: &Vec<f64>| v.iter().zip(&w).map(|(a, b)| (a - b).powi(2)).sum::<f64>();
            let near = solved.iter().min_by(|a, b| distance(&a.0).total_cmp(&distance(&b.0)));
            let from = near.map_or_else(|| found.outcome.x.clone(), |(_, x)| x.clone());
            let Ok(outcome) = desk.climb(&all.with_goals(goals), &from, (&lo, &hi), climb) else {
                beaten += 1;
                continue;
            };
            evaluations += outcome.evaluations;
            if outcome.evaluation.violation() > climb.violation_tolerance {
                beaten += 1;
                continue;
            }
            solved.push((w, outcome.x.clone()));
            let Ok(values) = seen(&outcome.x, &mut evaluations) else { continue };
            points.push(FrontPoint { x: outcome.x, values, anchor: None });
        }
    }
    let all_found = points.len();
    let mut points = unbeaten(points, aims);
    beaten += all_found - points.len();
    points.sort_by(|a, b| (b.values[0] * aims[0].sense()).total_cmp(&(a.values[0] * aims[0].sense())));
    Ok(Front { aims: aims.to_vec(), variables: found.searched.clone(), points, beaten, evaluations })
}

fn unit(k: usize, n: usize) -> Vec<f64> {
    (0..n).map(|i| f64::from(u8::from(i == k))).collect()
}

/// Points of the lattice with `steps` to an edge, the corners left out.
fn simplex(n: usize, steps: usize) -> Vec<Vec<f64>> {
    let share = |i: usize| i as f64 / steps as f64;
    let mut points = Vec::new();
    match n {
        2 => points.extend((1..steps).map(|i| vec![share(steps - i), share(i)])),
        _ => {
            for i in 0..=steps {
                for j in 0..=steps - i {
                    let w = [i, j, steps - i - j];
                    if w.iter().all(|v| *v < steps) {
                        points.push(w.map(share).to_vec());
                    }
                }
            }
        }
    }
    points
}

/// Points that no other equals or beats in everything.
fn unbeaten(points: Vec<FrontPoint>, aims: &[Objective]) -> Vec<FrontPoint> {
    let beats = |a: &FrontPoint, b: &FrontPoint| {
        let gains = a.values.iter().zip(&b.values).zip(aims).map(|((a, b), aim)| (a - b) * aim.sense());
        let slack = a.values.iter().map(|v| 1e-9 * v.abs()).fold(0.0, f64::max);
        let gains: Vec<f64> = gains.collect();
        gains.iter().all(|g| *g >= -slack) && gains.iter().any(|g| *g > slack)
    };
    let keep: Vec<bool> =
        (0..points.len()).map(|i| !points.iter().any(|other| beats(other, &points[i]))).collect();
    points.into_iter().zip(keep).filter(|(_, k)| *k).map(|(p, _)| p).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lattice_is_even_and_leaves_the_anchors_out() {
        assert_eq!(simplex(2, 4), [[0.75, 0.25], [0.5, 0.5], [0.25, 0.75]]);
        assert_eq!(simplex(3, 4).len(), 15 - 3);
        assert!(simplex(3, 3).iter().all(|w| (w.iter().sum::<f64>() - 1.0).abs() < 1e-15));
    }

    #[test]
    fn a_beaten_point_drops_out() {
        let point = |values: [f64; 2]| FrontPoint { x: vec![], values: values.to_vec(), anchor: None };
        let aims = [Objective::SlipMargin, Objective::PeakPressure];
        // More slip margin and less pressure is better.
        let kept = unbeaten(vec![point([0.4, 4000.0]), point([0.3, 4100.0]), point([0.2, 3900.0])], &aims);
        assert_eq!(kept.iter().map(|p| p.values[0]).collect::<Vec<_>>(), [0.4, 0.2]);
    }
}
