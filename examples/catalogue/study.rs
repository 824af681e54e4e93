//! One way to read the rules, and what comes of it.

use std::error::Error;

use sprag_design::design::Design;
use sprag_design::identify::{Identified, Use};
use sprag_design::report::Unit;

use crate::rows::Row;
use crate::size::{Size, power_law};

/// What is asked of a prediction: rms and worst deviation of the untouched rows, distance of the exponents, windup in deg.
struct Wanted {
    rms: f64,
    worst: f64,
    exponent: f64,
    windup_deg: f64,
}

const WANTED: Wanted = Wanted { rms: 0.10, worst: 0.20, exponent: 0.1, windup_deg: 3.0 };

/// Everything the page shows.
pub(crate) struct Study {
    pub(crate) series: Design,
    pub(crate) all: Vec<Row>,
    pub(crate) printed: Case,
    pub(crate) best: Case,
    pub(crate) gap: Case,
    pub(crate) friction: Case,
}

impl Study {
    pub(crate) fn cases(&self) -> [&Case; 4] {
        [&self.printed, &self.best, &self.gap, &self.friction]
    }
}

/// One reading of the rules with its profile and every size.
pub(crate) struct Case {
    pub(crate) name: &'static str,
    pub(crate) found: Identified,
    pub(crate) sizes: Vec<Size>,
    /// Predicted torque, what decides it, what the row is for; by size.
    pub(crate) predicted: Vec<(f64, String, Use)>,
}

impl Case {
    pub(crate) fn new(name: &'static str, found: Identified, all: &[Row]) -> Result<Self, Box<dyn Error>> {
        let (mut sizes, mut predicted) = (Vec::new(), Vec::new());
        for point in &found.points {
            let row = all.iter().find(|r| r.name == point.observation.label).ok_or("a row without a size")?;
            let said = point.predicted.clone()?;
            sizes.push(Size::new(&found.source, row)?);
            predicted.push((said.value, said.decided_by.unwrap_or_default(), point.observation.purpose));
        }
        Ok(Self { name, found, sizes, predicted })
    }

    /// predicted/catalogue - 1 of the rows for which `keep` says so.
    pub(crate) fn off(&self, keep: impl Fn(&Row, Use) -> bool) -> Vec<f64> {
        let each = self.sizes.iter().zip(&self.predicted).filter(|(s, p)| keep(&s.row, p.2));
        each.map(|(s, p)| p.0 / s.row.torque_nm - 1.0).collect()
    }

    /// Of the rows that took no part in the fit; of all where every row did.
    pub(crate) fn judged(&self) -> Vec<f64> {
        let untouched = self.off(|_, p| p == Use::Check);
        if untouched.is_empty() { self.off(|_, _| true) } else { untouched }
    }

    /// Exponents of d and l and the scatter about the power law: predicted, catalogue.
    pub(crate) fn exponents(&self) -> [(f64, f64, f64); 2] {
        let of = |torque: &dyn Fn(usize) -> f64| -> Vec<(f64, f64, f64)> {
            let each = self.sizes.iter().enumerate();
            each.map(|(i, s)| (s.row.inner_mm, s.row.length_mm, torque(i))).collect()
        };
        [power_law(&of(&|i| self.predicted[i].0)), power_law(&of(&|i| self.sizes[i].row.torque_nm))]
    }

    /// Exponent of d in torque per mm of sprag, by least squares of the logarithms: predicted, catalogue.
    pub(crate) fn growth(&self) -> [f64; 2] {
        let d: Vec<f64> = self.sizes.iter().map(|s| s.row.inner_mm.ln()).collect();
        let mean = d.iter().sum::<f64>() / d.len() as f64;
        let square: f64 = d.iter().map(|d| (d - mean).powi(2)).sum();
        let slope = |torque: &dyn Fn(usize) -> f64| {
            let each = self.sizes.iter().enumerate();
            each.map(|(i, s)| (d[i] - mean) * (torque(i) / s.row.length_mm).ln()).sum::<f64>() / square
        };
        [slope(&|i| self.predicted[i].0), slope(&|i| self.sizes[i].row.torque_nm)]
    }

    /// Largest tan omega of a size from first contact to its predicted torque; largest windup, deg, at the predicted
    /// torque and at the catalogue's.
    pub(crate) fn extremes(&self) -> (f64, f64, f64) {
        let (mut tan, mut windup, mut catalogue) = (0.0f64, 0.0f64, 0.0f64);
        for (size, (torque, ..)) in self.sizes.iter().zip(&self.predicted) {
            tan = tan.max(size.state.first_tan_omega);
            if let Some(p) = size.state.curve.at_torque(*torque) {
                (tan, windup) = (tan.max(p.tan_omega), windup.max(p.windup_rad.to_degrees()));
            }
            catalogue = catalogue.max(size.point.windup_rad.to_degrees());
        }
        (tan, windup, catalogue)
    }

    /// Whether all that was asked came out.
    pub(crate) fn holds(&self) -> bool {
        self.verdicts().iter().all(|(held, _)| *held)
    }

    /// What was asked, with what came out.
    pub(crate) fn verdicts(&self) -> Vec<(bool, String)> {
        let off = self.judged();
        let fitted = self.off(|_, p| p == Use::Fit).len();
        let rows = self.sizes.len();
        let [model, catalogue] = self.exponents();
        let per_mm = self.growth();
        let (tan, windup, at_catalogue) = self.extremes();
        let mu = self.sizes.first().map_or(0.0, |s| s.design.clutch.friction.static_);
        let percent = |x: f64| Unit::Percent.show(x, 3);
        let untouched = if fitted < rows { "untouched rows" } else { "rows, all of them fitted" };
        vec![
            (3 * fitted <= rows, format!("one profile, fitted on {fitted} of {rows} rows")),
            (
                rms(&off) <= WANTED.rms && worst(&off) <= WANTED.worst,
                format!(
                    "{} {untouched}: rms {} (wanted {}), worst {} (wanted {})",
                    off.len(),
                    percent(rms(&off)),
                    percent(WANTED.rms),
                    percent(worst(&off)),
                    percent(WANTED.worst)
                ),
            ),
            (
                (per_mm[0] - per_mm[1]).abs() <= WANTED.exponent,
                format!(
                    "torque per mm of sprag grows as d^{:.3}, the catalogue's as d^{:.3} (wanted within {}); with the width's own exponent \
                     free beside it {:.3} and {:.3}",
                    per_mm[0], per_mm[1], WANTED.exponent, model.0, catalogue.0
                ),
            ),
            (
                tan < mu,
                format!(
                    "largest tan ω of any size, first contact to nominal torque: {tan:.4}, below μ = {mu:.4}"
                ),
            ),
            (
                windup <= WANTED.windup_deg * (1.0 + 1e-6),
                format!(
                    "largest windup at the predicted torques {windup:.2}° (wanted {}° at most); at the catalogue's torques {at_catalogue:.2}°",
                    WANTED.windup_deg
                ),
            ),
        ]
    }
}

pub(crate) fn rms(off: &[f64]) -> f64 {
    (off.iter().map(|o| o * o).sum::<f64>() / off.len() as f64).sqrt()
}

pub(crate) fn worst(off: &[f64]) -> f64 {
    off.iter().fold(0.0, |a: f64, b| a.max(b.abs()))
}
