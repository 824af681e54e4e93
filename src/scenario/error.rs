//! The error of a simulation compared with its tolerance, each figure by its natural size.

use super::figures::{ErrorEstimate, FIGURES, Quantity};
use super::prepare::Prepared;
use super::simulate::hertz_peak;
use crate::dynamics::Peaks;

/// By what an error is divided before it is compared with the tolerance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scales {
    length_m: f64,
    time_s: f64,
    force_n: f64,
    pressure_pa: f64,
    contact: f64,
}

impl Scales {
    /// Of a run with the extremes `p`.
    pub(super) fn of(prepared: &Prepared, p: &Peaks) -> Self {
        let or_one = |v: f64| if v > 0.0 { v } else { 1.0 };
        let force_n = or_one(p.normal_max_n);
        Self {
            length_m: prepared.model.curve.touch().lengths.oa.v,
            time_s: prepared.duration_s,
            force_n,
            pressure_pa: or_one(hertz_peak(prepared, p.normal_max_n, p.normal_outer_max_n)),
            // Without a static load the contact margin is one of the largest already.
            contact: if prepared.static_normal_n > 0.0 { force_n / prepared.static_normal_n } else { 1.0 },
        }
    }

    fn scale(&self, quantity: Quantity) -> f64 {
        match quantity {
            Quantity::Angle | Quantity::Friction | Quantity::Margin => 1.0,
            Quantity::Length => self.length_m,
            Quantity::Time => self.time_s,
            Quantity::Force => self.force_n,
            Quantity::Pressure => self.pressure_pa,
            Quantity::ContactMargin => self.contact,
            Quantity::Work | Quantity::Power | Quantity::Flux | Quantity::Rise | Quantity::Depth => {
                f64::INFINITY
            }
        }
    }

    /// The largest error by its scale; infinite where one is no number.
    pub fn worst(&self, e: &ErrorEstimate) -> f64 {
        self.worst_figure(e).1
    }

    /// The same with the name of the figure.
    pub fn worst_figure(&self, e: &ErrorEstimate) -> (&'static str, f64) {
        let mut worst = ("", f64::NEG_INFINITY);
        for figure in FIGURES {
            let share = (figure.error)(e) / self.scale(figure.quantity);
            let share = if share.is_nan() { f64::INFINITY } else { share };
            if share > worst.1 {
                worst = (figure.words, share);
            }
        }
        worst
    }
}
