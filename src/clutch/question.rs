//! What is asked of a clutch: scenarios, and what the rest of the house asks of a kind in place of taking it apart.
//!
//! In: nothing. Out: [`Scenario`], SI: name of its kind, duration, speeds, torques, a sentence. Absent: how one is answered.
//! Equations: none.
//!
//! A further kind is a variant here with its lines below, its keys in `file::scenarios` and its start in
//! `scenario::prepare`.

use super::{Clutch, DriveInertia};
use schemars::JsonSchema;
use serde::Deserialize;

/// What happens to the clutch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ScenarioKind {
    /// Steady torque at rest.
    Static {
        /// Torque, N m.
        torque_nm: f64,
    },
    /// Preload on the inner race (C_bi = -preload), C_be = amplitude sin(2 pi f t) on the outer, outer race tied to an abutment.
    TorsionalExcitation {
        /// Preload C_e1, N m.
        preload_nm: f64,
        /// Amplitude, N m.
        amplitude_nm: f64,
        /// Frequency, Hz.
        frequency_hz: f64,
        /// Abutment stiffness k_ab, N m/rad.
        abutment_stiffness_nm_per_rad: f64,
        /// Duration, s.
        duration_s: f64,
        /// Mean speed Omega of the whole clutch, rad/s.
        speed_rad_s: f64,
    },
    /// Free run of the inner race, then reversal onto an elastic stop (the paper's section 3).
    Engagement {
        /// Initial overrunning speed of the inner race, rad/s.
        free_run_rad_s: f64,
        /// Torque that reverses the inner race, N m, magnitude.
        reversing_torque_nm: f64,
        /// Stiffness of the stop that holds the outer race, N m/rad.
        stop_stiffness_nm_per_rad: f64,
        /// Inertia of the bench on the inner race (I_1 of Table 1), kg m^2.
        bench_inertia_kg_m2: f64,
        /// Duration, s.
        duration_s: f64,
    },
    /// A torque on the inner race over time, engaging positive, the outer race tied to what turns at the mean speed.
    Transient {
        /// Torque at the start, N m; 0 where a history gives it.
        preload_nm: f64,
        /// Jump of the torque, N m; 0: none.
        torque_step_nm: f64,
        /// When it jumps, s.
        step_time_s: f64,
        /// Stiffness that ties the outer race to the mean speed, N m/rad.
        abutment_stiffness_nm_per_rad: f64,
        /// Duration, s.
        duration_s: f64,
        /// Mean speed, rad/s; that of a speed history at its start.
        speed_rad_s: f64,
        /// Inner race faster than outer at the start, rad/s; 0: at rest against it.
        overrun_rad_s: f64,
    },
    /// Steady overrun.
    Overrun {
        /// Speed of the outer race, rad/s.
        speed_rad_s: f64,
        /// Inner race faster than outer by this, rad/s; below 0 the outer race is the faster one.
        overrun_rad_s: f64,
    },
}

/// The equilibrium that a scene under load starts from.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Start {
    /// With the energizing spring, which presses the sprags further in than the torque alone.
    #[default]
    Settled,
    /// Of the torque alone, as in the paper: the spring begins to act when the scene does.
    WithoutSpring,
}

/// One named scenario with the clutch it acts on (per-scenario overrides applied).
#[derive(Debug, Clone, PartialEq)]
pub struct Scenario {
    /// Name, unique in the design.
    pub name: String,
    /// Kind and its data.
    pub kind: ScenarioKind,
    /// Where it starts; means nothing to what starts in overrun.
    pub start: Start,
    /// The clutch with this scenario's overrides.
    pub clutch: Clutch,
    /// Dotted names of the tables that the scenario overrides, for the reports.
    pub overrides: Vec<String>,
    /// Torque on the inner race over time, (s, N m), engaging positive; two points at one time are a jump.
    pub torque_history: Option<Vec<[f64; 2]>>,
    /// Mean speed over time, (s, rad/s).
    pub speed_history: Option<Vec<[f64; 2]>>,
    /// What turns on either side, each after what it is joined to; none: the races alone.
    pub drivetrain: Vec<DriveInertia>,
}

impl ScenarioKind {
    /// Name in design files, reports and JSON.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Static { .. } => "static",
            Self::TorsionalExcitation { .. } => "torsional-excitation",
            Self::Engagement { .. } => "engagement",
            Self::Overrun { .. } => "overrun",
            Self::Transient { .. } => "transient",
        }
    }

    /// Duration, s; `None` where nothing moves, so that nothing is integrated.
    pub fn duration_s(&self) -> Option<f64> {
        match *self {
            Self::TorsionalExcitation { duration_s, .. }
            | Self::Engagement { duration_s, .. }
            | Self::Transient { duration_s, .. } => Some(duration_s),
            Self::Static { .. } | Self::Overrun { .. } => None,
        }
    }

    /// Frequency of the excitation, Hz; `None` without one.
    pub fn frequency_hz(&self) -> Option<f64> {
        match *self {
            Self::TorsionalExcitation { frequency_hz, .. } => Some(frequency_hz),
            _ => None,
        }
    }

    /// Whether the clutch is at rest under a torque.
    pub fn is_at_rest(&self) -> bool {
        matches!(self, Self::Static { .. })
    }

    /// The overrun that it is or begins with, rad/s: by how much the inner race is ahead, and the speed of the outer one.
    pub fn overrun_rad_s(&self) -> Option<[f64; 2]> {
        match *self {
            Self::Overrun { speed_rad_s, overrun_rad_s } => Some([overrun_rad_s, speed_rad_s]),
            Self::Engagement { free_run_rad_s, .. } => Some([free_run_rad_s, 0.0]),
            Self::Transient { speed_rad_s, overrun_rad_s, .. } => {
                (overrun_rad_s > 0.0).then_some([overrun_rad_s, speed_rad_s])
            }
            Self::Static { .. } | Self::TorsionalExcitation { .. } => None,
        }
    }

    /// Whether it is a steady overrun, in which nothing is to hold.
    pub fn is_overrun(&self) -> bool {
        matches!(self, Self::Overrun { .. })
    }
}

impl Scenario {
    /// Torque that the clutch is held under, N m, at its largest and without an excitation; `None` where none engages it.
    pub fn held_torque_nm(&self) -> Option<f64> {
        let torque_nm = match self.kind {
            ScenarioKind::Static { torque_nm } => torque_nm,
            ScenarioKind::TorsionalExcitation { preload_nm, .. } => preload_nm,
            ScenarioKind::Engagement { reversing_torque_nm, .. } => reversing_torque_nm,
            ScenarioKind::Transient { preload_nm, torque_step_nm, .. } => {
                let rows = self.torque_history.iter().flatten();
                rows.map(|row| row[1]).fold(preload_nm.max(preload_nm + torque_step_nm), f64::max)
            }
            ScenarioKind::Overrun { .. } => return None,
        };
        Some(torque_nm).filter(|&t| t > 0.0)
    }

    /// Largest torque from outside, N m, that the wedge curve is to reach; 1 N m in overrun.
    pub fn largest_torque_nm(&self) -> f64 {
        match self.kind {
            ScenarioKind::Static { torque_nm } => torque_nm,
            ScenarioKind::TorsionalExcitation { preload_nm, amplitude_nm, .. } => preload_nm + amplitude_nm,
            // What the free run brings along comes on top of the torque.
            ScenarioKind::Engagement { reversing_torque_nm, .. } => 2.0 * reversing_torque_nm,
            ScenarioKind::Overrun { .. } => 1.0,
            ScenarioKind::Transient { preload_nm, torque_step_nm, .. } => {
                let steps = preload_nm.max((preload_nm + torque_step_nm).abs());
                let largest = |h: &Vec<[f64; 2]>| h.iter().map(|r| r[1].abs()).fold(0.0, f64::max);
                self.torque_history.as_ref().map_or(steps, largest)
            }
        }
    }

    /// Mean speed, rad/s; infinite where a history gives it, for it is not constant then.
    pub fn mean_speed_rad_s(&self) -> f64 {
        match self.kind {
            ScenarioKind::Static { .. } | ScenarioKind::Engagement { .. } => 0.0,
            ScenarioKind::Transient { .. } if self.speed_history.is_some() => f64::INFINITY,
            ScenarioKind::TorsionalExcitation { speed_rad_s, .. }
            | ScenarioKind::Overrun { speed_rad_s, .. }
            | ScenarioKind::Transient { speed_rad_s, .. } => speed_rad_s,
        }
    }

    /// Whether the clutch is to let go: in overrun, where no torque engages it or where the torque turns round. `None`: a drivetrain
    /// decides what the clutch is driven with.
    pub fn lets_go(&self) -> Option<bool> {
        match self.kind {
            ScenarioKind::Overrun { .. } => Some(true),
            ScenarioKind::Transient { .. } if !self.drivetrain.is_empty() => None,
            ScenarioKind::Transient { preload_nm, torque_step_nm, .. } => {
                let rows = self.torque_history.iter().flatten().map(|row| row[1]);
                let least_nm = rows.fold(preload_nm.min(preload_nm + torque_step_nm), f64::min);
                Some(least_nm < 0.0 || self.held_torque_nm().is_none())
            }
            _ => Some(false),
        }
    }

    /// What happens, as a sentence: words, and numbers in SI.
    pub fn story(&self) -> Vec<Phrase> {
        use Phrase::{Duration, Frequency, Method, Speed, SpeedCourse, Torque, TorqueCourse, Words};
        match self.kind {
            ScenarioKind::Static { torque_nm } => vec![Torque(torque_nm), Words(", steady, at rest.")],
            ScenarioKind::TorsionalExcitation {
                preload_nm,
                amplitude_nm,
                frequency_hz,
                duration_s,
                speed_rad_s,
                ..
            } => vec![
                Words("Preload "),
                Torque(preload_nm),
                Words(" on the inner race, "),
                Torque(amplitude_nm),
                Words(" at "),
                Frequency(frequency_hz),
                Words(" on the outer race, "),
                Duration(duration_s),
                Words(" long, mean speed "),
                Speed(speed_rad_s),
                Words("; method: "),
                Method,
                Words("."),
            ],
            ScenarioKind::Engagement { free_run_rad_s, reversing_torque_nm, duration_s, .. } => vec![
                Words("The inner race runs free at "),
                Speed(free_run_rad_s),
                Words(", then "),
                Torque(reversing_torque_nm),
                Words(" reverses it onto an elastic stop; "),
                Duration(duration_s),
                Words(" long, method: "),
                Method,
                Words("."),
            ],
            ScenarioKind::Transient { duration_s, overrun_rad_s, .. } => {
                let mut story = vec![
                    Words("Torque on the inner race "),
                    TorqueCourse,
                    Words(", mean speed "),
                    SpeedCourse,
                ];
                if overrun_rad_s > 0.0 {
                    story.extend([Words(", from an overrun at "), Speed(overrun_rad_s)]);
                }
                story.extend([
                    Words("; "),
                    Duration(duration_s),
                    Words(" long, method: "),
                    Method,
                    Words("."),
                ]);
                story
            }
            ScenarioKind::Overrun { speed_rad_s, overrun_rad_s } => vec![
                Words("Outer race at "),
                Speed(speed_rad_s),
                Words(match overrun_rad_s > 0.0 {
                    true => ", the inner race ahead of it by ",
                    false => ", the inner race behind it by ",
                }),
                Speed(overrun_rad_s.abs()),
                Words("."),
            ],
        }
    }
}

/// A piece of a sentence that says what happens.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Phrase {
    /// As it stands.
    Words(&'static str),
    /// Torque, N m.
    Torque(f64),
    /// Frequency, Hz.
    Frequency(f64),
    /// Time, s.
    Duration(f64),
    /// Angular speed, rad/s.
    Speed(f64),
    /// The torque of a transient over time.
    TorqueCourse,
    /// The mean speed of a transient over time.
    SpeedCourse,
    /// How the motion was computed.
    Method,
}
