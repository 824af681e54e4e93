//! Eigenfrequencies of a scene's drivetrain with the clutch engaged.

use super::prepare::Prepared;
use crate::dynamics::{Place, TrainMode};

impl Prepared {
    /// Small free motions of races and drivetrain with the clutch engaged, lowest first: at the start of a scene that begins
    /// in engagement, else under the largest torque that it is about. `None` where that does not engage the clutch.
    pub fn train_modes(&self) -> Option<Vec<TrainMode>> {
        let curve = &self.model.curve;
        let starts_engaged = self.overrun.is_none() && matches!(self.mode.place, Place::Arc(_));
        let (alpha_rad, normal_n) = if starts_engaged {
            let p = self.model.point(self.mode.place, self.state[0]);
            (self.state[0], p.n_bi)
        } else {
            let held = curve.at_normal(self.static_normal_n)?;
            (held.alpha_rad, held.normal_inner_n)
        };
        let carried = curve.at_normal(normal_n).filter(|p| p.torque_nm > 0.0)?;
        self.model.train_modes(carried.torque_nm, alpha_rad)
    }
}
