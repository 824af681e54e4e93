//! How far the model is off its observations, drawn.

use crate::identify::{Identified, Use};
use crate::report::plot::Dash;
use crate::report::{Curve, Plot};

/// Model over observation, less one, row by row.
pub(super) fn deviations(found: &Identified) -> String {
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
