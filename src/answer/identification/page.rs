//! The page of `identify`.

use super::Identification;
use super::tables::{correlation, estimates, residuals, sentences, verdict};
use crate::answer::Provenance;
use crate::answer::page::opened;
use crate::identify::{Identified, Use};
use crate::report::plot::Dash;
use crate::report::{Curve, Page, Plot};

/// The page.
pub(super) fn page(answer: &Identification<'_>, provenance: &Provenance, written: Option<&str>) -> Page {
    let found = answer.found;
    let mut page = opened("Identification", answer.design, &provenance.command, |page| {
        page.verdict(answer.determined(), &verdict(found));
    });
    page.list(sentences(found));
    page.heading("Unknowns").table("Each in the unit of its name.", &estimates(found));
    if let Some(table) = correlation(found) {
        page.table("Correlation of what was found.", &table);
    }
    page.heading("Observations").figure(&deviations(found), "Model over observation, less one, row by row.");
    page.table("", &residuals(found));
    answer.envelope(provenance.run_time_s, written).close(&mut page);
    page
}

fn deviations(found: &Identified) -> String {
    let of = |purpose: Use| -> Vec<[f64; 2]> {
        let each = found.points.iter().enumerate().filter(|(_, p)| p.observation.purpose == purpose);
        each.filter_map(|(i, p)| Some([i as f64 + 1.0, 100.0 * p.relative()?])).collect()
    };
    let mut plot = Plot::new("Row", "Off, %");
    for (purpose, name) in [(Use::Fit, "fitted"), (Use::Check, "held back")] {
        let points = of(purpose);
        if !points.is_empty() {
            plot.curves.push(Curve { dots: true, dash: Dash::Dotted, ..Curve::new(name, points) });
        }
    }
    plot.level(0.0, "0").to_figure()
}
