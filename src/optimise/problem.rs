//! The clutch as a vector and its margins.

use super::evaluate::{Evaluate, Evaluation, Failure};
use crate::design::{Design, EditError, Limits, Optimize, with_limits, with_values};
use crate::margin::{Margin, margins};
use crate::scenario::Settings;

/// Prefix of the rows whose scenario margins are the objectives.
const SLIP: &str = "slip:";

/// A design file with some of its numbers free: maximise the smallest slip margin over the scenarios, subject to
/// every other margin.
#[derive(Debug, Clone)]
pub struct ClutchProblem {
    source: String,
    folder: std::path::PathBuf,
    variables: Vec<String>,
    limits: Limits,
    scenarios: Vec<String>,
    settings: Settings,
}

/// What the optimiser's numbers stand for.
#[derive(Debug, Clone, PartialEq)]
pub struct Names {
    /// Scenario of each objective.
    pub objectives: Vec<String>,
    /// Margin code of each limit.
    pub limits: Vec<String>,
}

impl ClutchProblem {
    /// The task of `design`'s `[optimize]` table with `variables` free (all others stay).
    pub fn new(design: &Design, task: &Optimize, variables: Vec<String>, settings: Settings) -> Self {
        Self {
            source: design.source.clone(),
            folder: design.folder.clone(),
            variables,
            limits: task.limits,
            scenarios: task.scenarios.clone(),
            settings,
        }
    }

    /// The design file at `x`, in the units of the variables' names.
    ///
    /// # Errors
    /// [`EditError`] where a variable has no place in the file.
    pub fn file_at(&self, x: &[f64]) -> Result<String, EditError> {
        let values: Vec<(&str, f64)> =
            self.variables.iter().map(String::as_str).zip(x.iter().copied()).collect();
        with_values(&self.source, &values)
    }

    /// The design at `x`.
    ///
    /// # Errors
    /// [`Failure::Refused`] with the first reason where the geometry at `x` is impossible.
    pub fn design_at(&self, x: &[f64]) -> Result<Design, Failure> {
        let text = self.file_at(x).map_err(|e| Failure::Refused(e.to_string()))?;
        Design::parse_in(&self.folder, &text, "candidate").map_err(|e| {
            let first = e.problems().first().map_or(String::new(), |p| format!("{}: {}", p.key, p.allowed));
            Failure::Refused(first)
        })
    }

    /// All required margins at `x`: those of the static limits, and slip and contact of each scenario.
    ///
    /// # Errors
    /// [`Failure::Refused`] where there is no clutch at `x`.
    pub fn margins_at(&self, x: &[f64], settings: &Settings) -> Result<Vec<Margin>, Failure> {
        let design = self.design_at(x)?;
        let mut rows = margins(&design, &self.limits, &self.scenarios, false, false, settings)
            .map_err(|e| Failure::Refused(e.to_string()))?;
        rows.retain(|m| m.required);
        Ok(rows)
    }

    /// Objectives and limits in the order of [`Evaluation`].
    pub fn names(rows: &[Margin]) -> Names {
        let code = |m: &Margin| m.code.strip_prefix(SLIP).map(str::to_owned);
        Names {
            objectives: rows.iter().filter_map(code).collect(),
            limits: rows.iter().filter(|m| code(m).is_none()).map(|m| m.code.clone()).collect(),
        }
    }

    /// Slip margins mu_s/mu_req - 1, limits, and the largest Hertz pressure in GPa as the tie break.
    pub fn evaluation(&self, rows: &[Margin]) -> Evaluation {
        let wanted = self.limits.slip_margin.unwrap_or(0.0);
        let is_slip = |m: &&Margin| m.code.starts_with(SLIP);
        Evaluation {
            // The row's margin is allowable/demand - 1 with allowable = mu_s/(1 + wanted).
            objectives: rows
                .iter()
                .filter(is_slip)
                .map(|m| (1.0 + m.margin) * if m.margin > -1.0 { 1.0 + wanted } else { 1.0 } - 1.0)
                .collect(),
            limits: rows.iter().filter(|m| !is_slip(m)).map(|m| m.margin).collect(),
            tie_break: rows
                .iter()
                .filter(|m| m.code.starts_with("hertz-"))
                .map(|m| m.demand * 1e-3)
                .fold(0.0, f64::max),
        }
    }
}

impl Evaluate for ClutchProblem {
    fn evaluate(&self, x: &[f64]) -> Result<Evaluation, Failure> {
        self.margins_at(x, &self.settings).map(|rows| self.evaluation(&rows))
    }
}

/// The file of the optimum: values and the sharper limits put in, so that `check` holds it to what was searched for.
///
/// # Errors
/// [`EditError`].
pub fn finished_file(problem: &ClutchProblem, x: &[f64], sharper: &Limits) -> Result<String, EditError> {
    let text = problem.file_at(x)?;
    let rpm = 30.0 / std::f64::consts::PI;
    let entries = [
        ("nominal_torque_nm", sharper.nominal_torque_nm),
        ("peak_torque_nm", sharper.peak_torque_nm),
        ("hertz_nominal_mpa", sharper.hertz_nominal_pa.map(|v| v * 1e-6)),
        ("hertz_peak_mpa", sharper.hertz_peak_pa.map(|v| v * 1e-6)),
        ("hoop_inner_mpa", sharper.hoop_inner_pa.map(|v| v * 1e-6)),
        ("hoop_outer_mpa", sharper.hoop_outer_pa.map(|v| v * 1e-6)),
        ("hoop_inner_bending_mpa", sharper.hoop_inner_bending_pa.map(|v| v * 1e-6)),
        ("hoop_outer_bending_mpa", sharper.hoop_outer_bending_pa.map(|v| v * 1e-6)),
        ("case_depth_mm", sharper.case_depth_m.map(|v| v * 1e3)),
        ("case_shear_mpa", sharper.case_shear_pa.map(|v| v * 1e-6)),
        ("core_shear_mpa", sharper.core_shear_pa.map(|v| v * 1e-6)),
        ("axial_load_n", sharper.axial_load_n),
        ("gap_nominal_mm", sharper.gap_nominal_m.map(|v| v * 1e3)),
        ("gap_peak_mm", sharper.gap_peak_m.map(|v| v * 1e3)),
        ("windup_nominal_deg", sharper.windup_nominal_rad.map(f64::to_degrees)),
        ("equivalent_inner_mpa", sharper.equivalent_inner_pa.map(|v| v * 1e-6)),
        ("equivalent_outer_mpa", sharper.equivalent_outer_pa.map(|v| v * 1e-6)),
        ("slip_margin", sharper.slip_margin),
        // rad/s back to the file's rpm, without the last digit's rounding.
        ("keep_contact_to_rpm", sharper.keep_contact_to_rad_s.map(|v| (v * rpm * 1e9).round() / 1e9)),
    ];
    let values: Vec<(&str, f64)> = entries.iter().filter_map(|(k, v)| v.map(|v| (*k, v))).collect();
    with_limits(&text, &values)
}
