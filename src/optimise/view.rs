//! One phase's reading of the outputs: which margins are raised, which are limits, and the merit of a point.

use super::difference::Table;
use super::evaluate::Evaluation;
use super::qp::Linear;

/// Purpose of a phase.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Phase {
    /// Maximise the least objective subject to the limits.
    Margin,
    /// Maximise the least limit until no limit is violated.
    Restore,
    /// Minimise the tie break while every objective stays at least `floor`.
    TieBreak {
        /// Least margin kept, in the unit of the objectives.
        floor: f64,
        /// Size of the tie break at the start of the phase, by which it is divided.
        scale: f64,
    },
}

/// A margin of the phase: `sign * output + offset`.
#[derive(Debug, Clone, Copy)]
struct Row {
    output: usize,
    sign: f64,
    offset: f64,
}

/// Margins of a phase in terms of the outputs (objectives, limits, tie break).
#[derive(Debug, Clone)]
pub(super) struct View {
    pub phase: Phase,
    rises: Vec<Row>,
    limits: Vec<Row>,
}

impl View {
    /// View of `phase` for a problem with `shape` = (objectives, limits).
    pub fn new(phase: Phase, shape: (usize, usize)) -> Self {
        let row = |output, sign, offset| Row { output, sign, offset };
        let objectives = |offset: f64| (0..shape.0).map(move |i| row(i, 1.0, offset));
        let limits = || (shape.0..shape.0 + shape.1).map(|i| row(i, 1.0, 0.0));
        let (rises, limits) = match phase {
            Phase::Margin => (objectives(0.0).collect(), limits().collect()),
            Phase::Restore => (limits().collect(), Vec::new()),
            Phase::TieBreak { floor, scale } => (
                vec![row(shape.0 + shape.1, -1.0 / scale, 0.0)],
                limits().chain(objectives(-floor)).collect(),
            ),
        };
        View { phase, rises, limits }
    }

    fn values(rows: &[Row], outputs: &[f64]) -> Vec<f64> {
        rows.iter().map(|r| r.sign * outputs[r.output] + r.offset).collect()
    }

    /// Values of the phase's margins and limits.
    pub fn values_of(&self, outputs: &[f64]) -> (Vec<f64>, Vec<f64>) {
        (Self::values(&self.rises, outputs), Self::values(&self.limits, outputs))
    }

    /// (least margin t, largest violation v) of the phase.
    pub fn measure(&self, outputs: &[f64]) -> (f64, f64) {
        let t = Self::values(&self.rises, outputs).into_iter().fold(f64::INFINITY, f64::min);
        let v = Self::values(&self.limits, outputs).into_iter().fold(0.0, |worst: f64, c| worst.max(-c));
        (t, v)
    }

    /// Exact penalty function phi = -t + weight v; smaller is better.
    pub fn merit(&self, evaluation: &Evaluation, weight: f64) -> f64 {
        let (t, v) = self.measure(&evaluation.outputs());
        -t + weight * v
    }

    /// Model over the variables `free`, with values from `outputs` and slopes from `table`.
    pub fn linear(&self, outputs: &[f64], table: &Table, free: &[usize]) -> Linear {
        let rows = |rows: &[Row]| {
            let values = Self::values(rows, outputs);
            let slopes = rows
                .iter()
                .map(|r| free.iter().map(|&i| r.sign * table.slopes[r.output][i]).collect::<Vec<_>>());
            values.into_iter().zip(slopes).collect()
        };
        Linear { rises: rows(&self.rises), limits: rows(&self.limits) }
    }

    /// Weight of every output in the Lagrangian L = -sum lambda m - sum mu c.
    pub fn weights(&self, rise: &[f64], limit: &[f64], outputs: usize) -> Vec<f64> {
        let mut weights = vec![0.0; outputs];
        for (row, multiplier) in self.rises.iter().zip(rise).chain(self.limits.iter().zip(limit)) {
            weights[row.output] -= multiplier * row.sign;
        }
        weights
    }

    /// Noise of the merit: the largest of the margins' and `weight` times the largest of the limits'. Limits do not
    /// count in the tie break, where the weight is a wall.
    pub fn noise(&self, noise: &[f64], weight: f64) -> f64 {
        let most = |rows: &[Row]| rows.iter().map(|r| noise[r.output] * r.sign.abs()).fold(0.0, f64::max);
        let limits = if matches!(self.phase, Phase::TieBreak { .. }) { 0.0 } else { most(&self.limits) };
        most(&self.rises) + weight * limits
    }
}
