//! What a scene says of the drivetrain: columns of its history, eigenfrequencies, figures of its page.

use super::Ran;
use super::history::{SceneHistory, Values};
use super::page::envelope;
use super::stretch::Stretch;
use crate::answer::page::half;
use crate::dynamics::NodeMotion;
use crate::report::{Unit, significant};
use crate::scenario::{Prepared, Simulation};
use serde::Serialize;
use std::collections::BTreeMap;

/// A small free motion of races and drivetrain with the clutch engaged.
#[derive(Debug, Clone, Serialize)]
pub struct Eigenfrequency {
    /// Undamped, Hz.
    pub frequency_hz: f64,
    /// Share of critical damping; 1 where it creeps.
    pub damping_ratio: f64,
    /// What holds most of the kinetic energy.
    pub moves: String,
    /// Amplitude of the races and of each inertia on a shaft, by its own angle, the largest 1.
    pub shape: BTreeMap<String, f64>,
}

impl Eigenfrequency {
    /// The frequency with its damping and what moves most.
    pub(in crate::answer) fn words(&self) -> String {
        format!(
            "{}, damping ratio {}, {} moves most",
            Unit::Hertz.show(self.frequency_hz, 6),
            significant(self.damping_ratio, 3),
            self.moves
        )
    }
}

/// The eigenfrequencies of a scene with a drivetrain, lowest first; none where the clutch does not engage.
pub(super) fn of_drivetrain(prepared: &Prepared) -> Vec<Eigenfrequency> {
    if prepared.model.drive.train.is_some() { eigenfrequencies(prepared) } else { Vec::new() }
}

/// The eigenfrequencies of races and drivetrain of a scene with the clutch engaged, lowest first; none where it does not engage.
pub(in crate::answer) fn eigenfrequencies(prepared: &Prepared) -> Vec<Eigenfrequency> {
    let one = |m: crate::dynamics::TrainMode| Eigenfrequency {
        frequency_hz: m.frequency_hz,
        damping_ratio: m.damping_ratio,
        moves: m.moves,
        shape: m.shape.into_iter().collect(),
    };
    prepared.train_modes().into_iter().flatten().map(one).collect()
}

/// One column of an inertia: what its name ends in, its unit, and how it is taken.
type Of = (&'static str, Unit, fn(&NodeMotion) -> f64);

/// The columns of an inertia: angle since the start, speed, torque that its shaft passes on towards the clutch.
const COLUMNS: [Of; 3] = [
    ("angle_rad", Unit::Radian, |m| m.angle_rad),
    ("speed_rpm", Unit::Rpm, |m| m.speed_rad_s),
    ("shaft_nm", Unit::NewtonMetre, |m| m.shaft_nm),
];

/// Columns of every inertia on a shaft, named by it.
pub(super) fn add(history: &mut SceneHistory, prepared: &Prepared, s: &Simulation) {
    let Some(run) = &s.train else { return };
    let at = |(sample, more): (&crate::dynamics::Sample, &_)| {
        run.train.motions(sample.t, &sample.state, more, prepared.model.mean_speed(sample.t).0)
    };
    let rows: Vec<Vec<NodeMotion>> = s.samples.iter().zip(&run.samples).map(at).collect();
    for (i, name) in run.train.names().enumerate() {
        for (column, unit, of) in COLUMNS {
            let values = rows.iter().map(|row| unit.from_si(of(&row[i]))).collect();
            history.columns.push((format!("{name}_{column}").into(), Values::Numbers(values)));
        }
    }
}

/// Figures of the page: torques of its shafts, speeds; none without a drivetrain.
pub(super) fn figures(scene: &Ran, whole: &Stretch) -> Vec<(String, String)> {
    let mut figures = Vec::new();
    let Some(run) = scene.simulation().and_then(|s| s.train.as_ref()) else { return figures };
    let names: Vec<&str> = run.train.names().collect();
    if names.is_empty() {
        return figures;
    }
    let history = scene.history();
    let Some(time) = history.numbers("time_s") else { return figures };
    for (column, axis, caption) in [
        (
            "shaft_nm",
            "Torque of a shaft, Nm",
            "What each shaft passes on towards the clutch, by the angle of its inertia.",
        ),
        ("speed_rpm", "Speed, rpm", "Speeds of the inertias, each its own."),
    ] {
        let mut drawn = whole.plot(axis);
        for name in &names {
            let wanted = format!("{name}_{column}");
            let found = history.columns.iter().find(|(n, _)| *n == wanted);
            let Some((_, Values::Numbers(values))) = found else { continue };
            let points = time.iter().zip(values).map(|(t, v)| [whole.at(*t), *v]).collect();
            drawn = drawn.curve(name, envelope(points));
        }
        figures.push((half(drawn), caption.to_owned()));
    }
    figures
}
