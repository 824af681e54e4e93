//! What an identification answers: unknowns with their intervals, residuals, what the data cannot tell apart.

mod page;
mod stopped;
mod tables;

pub use stopped::StoppedIdentification;

use super::left_out::left_out_of;
use super::{Envelope, Provenance, VERSION, WRITTEN_BY};
use crate::design::Design;
use crate::identify::Identified;
use crate::report::{Page, Screen, Table};
use serde::Serialize;
use serde_json::{Value, json};
use tables::{estimates, in_short, residuals, sentences, use_name, verdict};

/// The answer's own keys.
#[derive(Debug, Serialize)]
pub struct IdentificationBody {
    /// Unknowns with bounds, values and intervals.
    pub unknowns: Vec<Value>,
    /// Correlation of the unknowns.
    pub correlation: Option<Vec<Vec<f64>>>,
    /// Every observation beside what the model says.
    pub observations: Vec<Value>,
    /// Standard deviation of a scaled residual.
    pub residual_sigma: Option<f64>,
    /// Observations more than unknowns.
    pub degrees_of_freedom: usize,
    /// Smallest over largest singular value of the scaled sensitivities.
    pub singular_ratio: f64,
    /// Sum of squared scaled residuals of each start.
    pub sums_of_squares: Vec<f64>,
    /// Evaluations of all fitted observations.
    pub evaluations: usize,
    /// Whether the last step no longer mattered.
    pub converged: bool,
    /// Whether the data determine every unknown.
    pub determined: bool,
    /// How good it is and what cannot be told apart.
    pub remarks: Vec<String>,
    /// Where the new design was written.
    pub written: Option<String>,
}

impl IdentificationBody {
    fn new(found: &Identified, written: Option<&str>) -> Self {
        let k = &found.knowledge;
        let unknowns = found.unknowns.iter().zip(&found.before).zip(&k.estimates);
        Self {
            unknowns: unknowns
                .map(|((u, before), e)| {
                    json!({
                        "name": u.name, "min": u.min, "max": u.max, "before": before, "value": e.value,
                        "sigma": e.sigma, "half_width_95": e.half_width, "half_width_95_by_law": e.by_law, "determined": e.doubt.is_none(),
                    })
                })
                .collect(),
            correlation: k.correlation.clone(),
            observations: found
                .points
                .iter()
                .map(|p| {
                    let o = &p.observation;
                    let predicted = p.predicted.as_ref();
                    json!({
                        "line": o.line, "label": o.label, "quantity": o.kind.column(), "torque_nm": o.torque_nm,
                        "observed": o.value, "predicted": predicted.ok().map(|s| s.value), "relative": p.relative(),
                        "use": use_name(o.purpose), "decided_by": predicted.ok().and_then(|s| s.decided_by.clone()),
                        "why_not": predicted.err().map(ToString::to_string),
                    })
                })
                .collect(),
            residual_sigma: k.residual_sigma,
            degrees_of_freedom: k.freedom,
            singular_ratio: k.singular_ratio,
            sums_of_squares: found.sums.0.clone(),
            evaluations: found.evaluations,
            converged: found.converged,
            determined: k.undetermined().next().is_none(),
            remarks: sentences(found),
            written: written.map(str::to_owned),
        }
    }
}

/// Unknowns found in a design.
#[derive(Debug, Clone, Copy)]
pub struct Identification<'a> {
    /// The design that was given.
    pub design: &'a Design,
    /// What was found.
    pub found: &'a Identified,
}

impl<'a> Identification<'a> {
    /// Whether the data determine every unknown.
    pub fn determined(&self) -> bool {
        self.found.knowledge.undetermined().next().is_none()
    }

    /// The answer with the keys that all answers share; `run_time_s`: what it took, s; `written`: where the new design is.
    pub fn envelope(&self, run_time_s: f64, written: Option<&str>) -> Envelope<'a, IdentificationBody> {
        Envelope {
            design: self.design,
            run_time_s,
            left_out: left_out_of(self.design),
            error_estimate: Some(json!({ "residual_sigma": self.found.knowledge.residual_sigma })),
            body: IdentificationBody::new(self.found, written),
        }
    }

    /// Every observation beside what the model says.
    pub fn csv_table(&self) -> Table {
        residuals(self.found)
    }

    /// The answer on a terminal.
    pub fn text(&self, screen: Screen) -> String {
        let (design, found) = (self.design, self.found);
        let mut out = format!(
            "{}  {}\n\n{}\n{}\n",
            design.name,
            design.short_hash(),
            estimates(found).to_text(screen),
            residuals(found).to_text(screen)
        );
        for line in std::iter::once(verdict(found)).chain(sentences(found)) {
            out.push_str(&line);
            out.push('\n');
        }
        out
    }

    /// The answer as a page.
    pub fn page(&self, provenance: &Provenance, written: Option<&str>) -> Page {
        page::page(self, provenance, written)
    }

    /// The new design file: the old one with its comments, the values found, and who found them.
    pub fn file(&self, command: &str) -> String {
        let found = self.found;
        let changes: String = found
            .unknowns
            .iter()
            .zip(&found.before)
            .zip(&found.knowledge.estimates)
            .map(|((u, before), e)| {
                // The larger of scatter and law, which a reader of the file takes for the whole.
                let width = e.half_width.map(|w| w.max(e.by_law.unwrap_or(0.0)));
                let width = width.map_or(String::new(), |w| format!(" +- {w:.3e} (95 %)"));
                let doubt = e.doubt.map_or(String::new(), |doubt| format!(", {}", in_short(found, doubt)));
                format!("#   {}: {} -> {}{width}{doubt}\n", u.name, before, e.value)
            })
            .collect();
        head(self.design, command) + &changes + "#\n" + &found.source
    }
}

/// First lines of a design file that an identification makes; `command`: who asked.
fn head(design: &Design, command: &str) -> String {
    let (name, hash) = (&design.name, &design.hash);
    format!("{WRITTEN_BY} identify {VERSION} from {name:?} (sha256 {hash})\n# by: {command}\n")
}
