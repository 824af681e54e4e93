//! The comparison as tables.

use super::verdict::{name, sentence};
use super::{AccuracyStudy, map};
use crate::accuracy::{Precision, Scheme, WorkPoint};
use crate::report::{Cell, Column, Screen, Table, Unit};

/// Every point of every scene, for programs.
pub(super) fn points(scenes: &[Precision]) -> Table {
    let mut table = Table::new(vec![
        Column::text("scenario", "Scene"),
        Column::text("method", "Method"),
        Column::number("tolerance", "Tolerance", Unit::One, 1),
        Column::number("step_s", "Step", Unit::Second, 1),
        Column::number("band_m_per_s", "Band", Unit::MetrePerSecond, 1),
        Column::number("theta_inner_error_rad", "Error of the angle", Unit::Radian, 2),
        Column::number("slip_margin_error", "Error of the slip margin", Unit::One, 2),
        Column::number("error_estimate_rad", "Stated error", Unit::Radian, 2),
        Column::number("rhs_evaluations", "Right-hand sides", Unit::One, 6),
        Column::number("run_time_s", "Time", Unit::Second, 3),
        Column::text("stop", "End"),
    ]);
    for scene in scenes {
        for (method, point) in scene.methods.iter().flat_map(|(m, list)| list.iter().map(move |p| (m, p))) {
            let [tolerance, step] = match method {
                Scheme::Published(_) => [None, Some(point.setting)],
                _ => [Some(point.setting), None],
            };
            table.row(vec![
                scene.scene.as_str().into(),
                method.key().into(),
                tolerance.into(),
                step.into(),
                method.band_m_s().into(),
                point.theta_error_rad.into(),
                point.margin_error.into(),
                point.stated_rad.into(),
                count(point.rhs_evaluations),
                point.seconds.into(),
                point.stop.name().into(),
            ]);
        }
    }
    table
}

fn count(n: u64) -> Cell {
    Cell::Count(usize::try_from(n).unwrap_or(usize::MAX))
}

/// One scene, for people.
pub(super) fn scene(scene: &Precision) -> Table {
    let mut table = Table::new(vec![
        Column::text("method", "Method"),
        Column::text("setting", "Tolerance or step"),
        Column::number("theta_inner_error_rad", "Error of the angle", Unit::Radian, 2),
        Column::number("slip_margin_error", "Of the slip margin", Unit::One, 2),
        Column::number("error_estimate_rad", "Stated", Unit::Radian, 2),
        Column::number("rhs_evaluations", "Right-hand sides", Unit::One, 6),
        Column::number("run_time_ms", "Time", Unit::Millisecond, 3),
    ]);
    for (method, list) in &scene.methods {
        for p in list {
            table.row(vec![
                name(*method).into(),
                shown(*method, p).into(),
                p.theta_error_rad.into(),
                p.margin_error.into(),
                p.stated_rad.into(),
                count(p.rhs_evaluations),
                p.seconds.into(),
            ]);
        }
    }
    table
}

fn shown(method: Scheme, point: &WorkPoint) -> String {
    let unit = if method.band_m_s().is_some() { " s" } else { "" };
    format!("{:e}{unit}", point.setting)
}

/// The answer on a terminal.
pub(super) fn text(study: &AccuracyStudy, screen: Screen) -> String {
    let mut out = String::new();
    for s in &study.scenes {
        out += &format!("{}\n\n{}\n", sentence(s), scene(s).to_text(screen));
    }
    for (name, why) in &study.without_start {
        out += &format!("{name}: {why}\n\n");
    }
    if !study.cases.is_empty() {
        out += &format!("{}\n\n{}\n", map::summary(study), map::counts(study).to_text(screen));
        out += &map::remarkable(study).to_text(screen);
    }
    out
}
