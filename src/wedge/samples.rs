//! The curve as points to draw.

use super::closure::Closure;
use super::curve::WedgeCurve;
use super::stiffness::StaticPoint;

/// Points per arc that a plot 720 px wide cannot tell from the curve.
pub const PLOTTED: usize = 60;

impl WedgeCurve {
    /// Points for plots, N m ascending, up to `up_to_nm` or the curve's end, with the equilibrium behind each, `per_arc` + 1 on each
    /// arc. Every arc keeps both its ends, so jumps at a junction show as jumps.
    pub fn samples(&self, up_to_nm: f64, per_arc: usize) -> Vec<(StaticPoint, Closure)> {
        let mut points = Vec::new();
        let mut from_n = 0.0;
        for arc in 0..self.arc_count() {
            let until_n = self.arc_end_n(arc);
            for i in 0..=per_arc {
                // Denser towards the beginning, where angles and stiffness change most. A junction belongs to the arc
                // before it; the next one begins a hair above.
                let share = (i as f64 / per_arc as f64).powi(2);
                let n = from_n + (until_n - from_n) * share.max(1e-9);
                let both = self.closure_at_normal(n).map(|(k, c)| (self.row(k, &c), c));
                match both {
                    Some((point, _)) if point.torque_nm > up_to_nm => {
                        points.extend(self.sample_at_torque(up_to_nm));
                        return points;
                    }
                    both => points.extend(both),
                }
            }
            from_n = until_n;
        }
        points
    }

    /// The point at `torque_nm` > 0 with its equilibrium; `None` where the curve ends below it.
    pub fn sample_at_torque(&self, torque_nm: f64) -> Option<(StaticPoint, Closure)> {
        self.closure_at_torque(torque_nm).map(|(k, c)| (self.row(k, &c), c))
    }
}
