//! The comparison as tables.

use super::verdict::{name, sentence};
use super::{AccuracyStudy, map};
use crate::accuracy::{Precision, Scheme, WorkPoint};
use crate::report::{Rows, Screen, Table, Unit};

/// A point of a method in a scene.
pub type Point<'a> = (&'a Precision, Scheme, &'a WorkPoint);

/// Every point of `scene`.
pub(super) fn points_of(scene: &Precision) -> impl Iterator<Item = Point<'_>> {
    scene.methods.iter().flat_map(move |(m, list)| list.iter().map(move |p| (scene, *m, p)))
}

/// Points, for programs.
pub(super) fn points<'a>(all: impl IntoIterator<Item = Point<'a>>) -> Rows<Point<'a>> {
    let adaptive = |m: Scheme| !matches!(m, Scheme::Published(_));
    Rows::of(all)
        .text("scenario", "Scene", |(s, _, _)| s.scene.as_str())
        .text("method", "Method", |(_, m, _)| m.key())
        .number("tolerance", "Tolerance", Unit::One, 1, |(_, m, p)| adaptive(*m).then_some(p.setting))
        .number("step_s", "Step", Unit::Second, 1, |(_, m, p)| (!adaptive(*m)).then_some(p.setting))
        .number("band_m_per_s", "Band", Unit::MetrePerSecond, 1, |(_, m, _)| m.band_m_s())
        .number("theta_inner_error_rad", "Error of the angle", Unit::Radian, 2, |(_, _, p)| p.theta_error_rad)
        .number("slip_margin_error", "Error of the slip margin", Unit::One, 2, |(_, _, p)| p.margin_error)
        .number("error_estimate_rad", "Stated error", Unit::Radian, 2, |(_, _, p)| p.stated_rad)
        .number("rhs_evaluations", "Right-hand sides", Unit::One, 6, |(_, _, p)| p.rhs_evaluations)
        .number("run_time_s", "Time", Unit::Second, 3, |(_, _, p)| p.seconds)
        .text("stop", "End", |(_, _, p)| p.stop.name())
}

/// One scene, for people.
pub(super) fn scene(scene: &Precision) -> Table {
    Rows::of(scene.methods.iter().flat_map(|(m, list)| list.iter().map(move |p| (*m, p))))
        .text("method", "Method", |(m, _)| name(*m))
        .text("setting", "Tolerance or step", |(m, p)| shown(*m, p))
        .number("theta_inner_error_rad", "Error of the angle", Unit::Radian, 2, |(_, p)| p.theta_error_rad)
        .number("slip_margin_error", "Of the slip margin", Unit::One, 2, |(_, p)| p.margin_error)
        .number("error_estimate_rad", "Stated", Unit::Radian, 2, |(_, p)| p.stated_rad)
        .number("rhs_evaluations", "Right-hand sides", Unit::One, 6, |(_, p)| p.rhs_evaluations)
        .number("run_time_ms", "Time", Unit::Millisecond, 3, |(_, p)| p.seconds)
        .table()
}

fn shown(method: Scheme, point: &WorkPoint) -> String {
    let unit = if method.band_m_s().is_some() { " s" } else { "" };
    format!("{:e}{unit}", point.setting)
}

/// The answer on a terminal.
pub(super) fn text(study: &AccuracyStudy<'_>, screen: Screen) -> String {
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
