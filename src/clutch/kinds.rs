//! What the rest of the house asks of a kind of scenario, in place of taking it apart.
//!
//! In: a [`ScenarioKind`]. Out: its name, duration, speeds, torques, SI. Absent: keys of the file (`design`), how it
//! starts (`scenario`). Equations: none.

use super::question::{Scenario, ScenarioKind};

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

    /// Whether the clutch is to let go: in overrun, where it starts in one, or where the torque turns round.
    pub fn lets_go(&self) -> bool {
        match self.kind {
            ScenarioKind::Overrun { .. } => true,
            ScenarioKind::Transient { overrun_rad_s, .. } => {
                let turns = |h: &Vec<[f64; 2]>| h.iter().any(|row| row[1] < 0.0);
                overrun_rad_s > 0.0 || self.torque_history.as_ref().is_some_and(turns)
            }
            _ => false,
        }
    }
}
