//! Where one arc of a curve hands over to the next.

use crate::wedge::WedgeCurve;
use serde::Serialize;

/// Torque, N m, and alpha, rad, at which each arc of the curve but its last hands over to the next; `arc` counts
/// from 1 and names the arc that ends.
pub fn junctions(curve: &WedgeCurve) -> Vec<Junction> {
    (0..curve.arc_count().saturating_sub(1))
        .filter_map(|k| {
            let point = curve.at_normal(curve.arc_end_n(k))?;
            Some(Junction {
                torque_nm: point.torque_nm,
                alpha_rad: curve.arc_end_rad(k),
                arc: curve.first_arc() + k + 1,
            })
        })
        .collect()
}

/// Where one arc hands over to the next.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Junction {
    /// Torque at which it does, N m.
    pub torque_nm: f64,
    /// Rotation of the sprag there, rad.
    pub alpha_rad: f64,
    /// Number of the arc that ends here, from 1.
    pub arc: usize,
}

impl Junction {
    /// Label in plots, e.g. `1|2`.
    pub fn label(&self) -> String {
        format!("{}|{}", self.arc, self.arc + 1)
    }
}
