//! The drivetrain on the page of a simulation: torques of its shafts, speeds.

use super::page::{envelope, plot};
use crate::answer::simulation::{Ran, Values};
use crate::report::Page;

/// Two figures; none without a drivetrain.
pub(super) fn figures(page: &mut Page, scene: &Ran) {
    let Some(run) = scene.simulation().and_then(|s| s.train.as_ref()) else { return };
    let names: Vec<&str> = run.train.names().collect();
    if names.is_empty() {
        return;
    }
    let history = scene.history();
    let Some(time) = history.numbers("time_s") else { return };
    for (column, axis, caption) in [
        (
            "shaft_nm",
            "Torque of a shaft, Nm",
            "What each shaft passes on towards the clutch, by the angle of its inertia.",
        ),
        ("speed_rpm", "Speed, rpm", "Speeds of the inertias, each its own."),
    ] {
        let mut drawn = plot(axis);
        for name in &names {
            let wanted = format!("{name}_{column}");
            let found = history.columns.iter().find(|(n, _)| *n == wanted);
            let Some((_, Values::Numbers(values))) = found else { continue };
            let points = time.iter().zip(values).map(|(t, v)| [t * 1e3, *v]).collect();
            drawn = drawn.curve(name, envelope(points));
        }
        page.figure(&drawn.to_svg(), caption);
    }
}
