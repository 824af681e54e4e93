//! What an identification answers: unknowns with their intervals, residuals, what the data cannot tell apart.

mod body;
mod plot;
mod stopped;
mod tables;

pub use body::{IdentificationBody, UnknownRow};
pub use stopped::{StoppedBody, StoppedIdentification, UnknownBody};

use super::{Finding, Said, VERSION, WRITTEN_BY};
use crate::design::Design;
use crate::identify::Identified;
use crate::report::{Page, Screen, Table};
use plot::deviations;
use serde_json::{Value, json};
use tables::{correlation, estimates, in_short, residuals, sentences, verdict};

/// Unknowns found in a design.
#[derive(Debug, Clone, Copy)]
pub struct Identification<'a> {
    /// The design that was given.
    pub design: &'a Design,
    /// What was found.
    pub found: &'a Identified,
    /// Where the new design was written, if it was.
    pub written: Option<&'a str>,
}

impl Identification<'_> {
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

impl Said for Identification<'_> {
    type Body<'a>
        = IdentificationBody<'a>
    where
        Self: 'a;

    fn title(&self) -> &str {
        "Identification"
    }

    fn design(&self) -> &Design {
        self.design
    }

    /// Whether the data determine every unknown.
    fn outcome(&self) -> Finding {
        Finding::of(self.found.knowledge.undetermined().next().is_none())
    }

    fn verdict(&self) -> String {
        verdict(self.found)
    }

    fn remarks(&self) -> Vec<String> {
        sentences(self.found)
    }

    fn table(&self) -> Table {
        residuals(self.found).table()
    }

    fn tables(&self, screen: Screen) -> String {
        format!("{}\n{}", estimates(self.found).table().to_text(screen), self.table().to_text(screen))
    }

    fn body(&self) -> IdentificationBody<'_> {
        IdentificationBody::of(self)
    }

    fn error_estimate(&self) -> Option<Value> {
        Some(json!({ "residual_sigma": self.found.knowledge.residual_sigma }))
    }

    fn draw(&self, page: &mut Page) {
        let found = self.found;
        page.heading("Unknowns").table("Each in the unit of its name.", &estimates(found).table());
        if let Some(table) = correlation(found) {
            page.table("Correlation of what was found.", &table);
        }
        let off = deviations(found);
        page.heading("Observations").figure(&off, "Model over observation, less one, row by row.");
        page.table("", &self.table());
    }
}

/// First lines of a design file that an identification makes; `command`: who asked.
fn head(design: &Design, command: &str) -> String {
    let (name, hash) = (&design.name, &design.hash);
    format!("{WRITTEN_BY} identify {VERSION} from {name:?} (sha256 {hash})\n# by: {command}\n")
}
