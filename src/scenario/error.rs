//! How far two runs of one scene lie apart, figure by figure.

use super::demand::Demand;
use super::prepare::Prepared;
use super::simulate::{hertz_peak, offset, slips};
use crate::dynamics::Run;

/// Differences between two runs of a simulation.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ErrorEstimate {
    /// theta_bi at the end, rad.
    pub theta_inner_rad: f64,
    /// theta_be at the end, rad.
    pub theta_outer_rad: f64,
    /// Offset, rad.
    pub offset_rad: f64,
    /// Net slip at A, m.
    pub net_slip_m: f64,
    /// Net slip at B, m.
    pub net_slip_outer_m: f64,
    /// Path of slip at A and B, m.
    pub slip_distance_m: [f64; 2],
    /// Time of slip at A and B, s.
    pub slip_time_s: [f64; 2],
    /// Time without contact, s.
    pub contact_lost_s: f64,
    /// Largest |T|/N at A and B.
    pub tan_demand: [f64; 2],
    /// Smallest N_bi, N.
    pub normal_min_n: f64,
    /// Largest N_bi, N.
    pub normal_max_n: f64,
    /// Largest Hertz pressure, Pa.
    pub hertz_peak_pa: f64,
    /// Friction that rolling would need; 0 where none suffices in either run.
    pub required_friction: f64,
    /// Slip margin.
    pub slip_margin: f64,
    /// Contact margin.
    pub contact_margin: f64,
}

impl ErrorEstimate {
    /// Each figure's error, at least `share` of that in `other`: two runs may agree by chance.
    pub(super) fn at_least(&self, share: f64, other: &Self) -> Self {
        let more = |a: f64, b: f64| a.max(share * b);
        let pair = |a: [f64; 2], b: [f64; 2]| [more(a[0], b[0]), more(a[1], b[1])];
        Self {
            theta_inner_rad: more(self.theta_inner_rad, other.theta_inner_rad),
            theta_outer_rad: more(self.theta_outer_rad, other.theta_outer_rad),
            offset_rad: more(self.offset_rad, other.offset_rad),
            net_slip_m: more(self.net_slip_m, other.net_slip_m),
            net_slip_outer_m: more(self.net_slip_outer_m, other.net_slip_outer_m),
            slip_distance_m: pair(self.slip_distance_m, other.slip_distance_m),
            slip_time_s: pair(self.slip_time_s, other.slip_time_s),
            contact_lost_s: more(self.contact_lost_s, other.contact_lost_s),
            tan_demand: pair(self.tan_demand, other.tan_demand),
            normal_min_n: more(self.normal_min_n, other.normal_min_n),
            normal_max_n: more(self.normal_max_n, other.normal_max_n),
            hertz_peak_pa: more(self.hertz_peak_pa, other.hertz_peak_pa),
            required_friction: more(self.required_friction, other.required_friction),
            slip_margin: more(self.slip_margin, other.slip_margin),
            contact_margin: more(self.contact_margin, other.contact_margin),
        }
    }
}

/// The figures themselves.
pub(super) struct Figures(ErrorEstimate);

impl Figures {
    pub(super) fn of(prepared: &Prepared, run: &Run, demand: Option<Demand>) -> Self {
        let [a, b] = slips(run);
        let p = run.peaks;
        Self(ErrorEstimate {
            theta_inner_rad: run.state[2],
            theta_outer_rad: run.state[3],
            offset_rad: offset(prepared, run),
            net_slip_m: a.net_m,
            net_slip_outer_m: b.net_m,
            slip_distance_m: [a.distance_m, b.distance_m],
            slip_time_s: [a.time_s, b.time_s],
            contact_lost_s: run.open_s,
            tan_demand: [p.tan_inner, p.tan_outer],
            normal_min_n: p.normal_min_n,
            normal_max_n: p.normal_max_n,
            hertz_peak_pa: hertz_peak(prepared, p.normal_max_n, p.normal_outer_max_n),
            required_friction: demand.and_then(|d| d.required_friction).unwrap_or(0.0),
            slip_margin: demand.map_or(0.0, |d| d.slip_margin),
            contact_margin: demand.map_or(0.0, |d| d.contact_margin),
        })
    }

    pub(super) fn difference(&self, other: &Self) -> ErrorEstimate {
        let (a, b) = (&self.0, &other.0);
        let pair = |a: [f64; 2], b: [f64; 2]| [(a[0] - b[0]).abs(), (a[1] - b[1]).abs()];
        ErrorEstimate {
            theta_inner_rad: (a.theta_inner_rad - b.theta_inner_rad).abs(),
            theta_outer_rad: (a.theta_outer_rad - b.theta_outer_rad).abs(),
            offset_rad: (a.offset_rad - b.offset_rad).abs(),
            net_slip_m: (a.net_slip_m - b.net_slip_m).abs(),
            net_slip_outer_m: (a.net_slip_outer_m - b.net_slip_outer_m).abs(),
            slip_distance_m: pair(a.slip_distance_m, b.slip_distance_m),
            slip_time_s: pair(a.slip_time_s, b.slip_time_s),
            contact_lost_s: (a.contact_lost_s - b.contact_lost_s).abs(),
            tan_demand: pair(a.tan_demand, b.tan_demand),
            normal_min_n: (a.normal_min_n - b.normal_min_n).abs(),
            normal_max_n: (a.normal_max_n - b.normal_max_n).abs(),
            hertz_peak_pa: (a.hertz_peak_pa - b.hertz_peak_pa).abs(),
            required_friction: (a.required_friction - b.required_friction).abs(),
            slip_margin: (a.slip_margin - b.slip_margin).abs(),
            contact_margin: (a.contact_margin - b.contact_margin).abs(),
        }
    }
}

/// By what an error is divided before it is held against the tolerance.
pub(super) struct Scales {
    length_m: f64,
    time_s: f64,
    force_n: f64,
    pressure_pa: f64,
    contact: f64,
    /// Infinite where B holds whatever that takes: its |T|/N then grows without bound as N_be falls to 0 at a touch.
    tan_outer: f64,
}

impl Scales {
    pub(super) fn of(prepared: &Prepared, run: &Run) -> Self {
        let p = run.peaks;
        let or_one = |v: f64| if v > 0.0 { v } else { 1.0 };
        let force_n = or_one(p.normal_max_n);
        Self {
            length_m: prepared.model.curve.touch().lengths.oa.v,
            time_s: prepared.duration_s,
            force_n,
            pressure_pa: or_one(hertz_peak(prepared, p.normal_max_n, p.normal_outer_max_n)),
            // Without a static load the contact margin is one of the largest already.
            contact: if prepared.static_normal_n > 0.0 { force_n / prepared.static_normal_n } else { 1.0 },
            tan_outer: if prepared.model.outer_holds { f64::INFINITY } else { 1.0 },
        }
    }

    /// The largest error by its scale; infinite where one is no number.
    pub(super) fn worst(&self, e: &ErrorEstimate) -> f64 {
        [
            e.theta_inner_rad,
            e.theta_outer_rad,
            e.offset_rad,
            e.net_slip_m / self.length_m,
            e.net_slip_outer_m / self.length_m,
            e.slip_distance_m[0] / self.length_m,
            e.slip_distance_m[1] / self.length_m,
            e.slip_time_s[0] / self.time_s,
            e.slip_time_s[1] / self.time_s,
            e.contact_lost_s / self.time_s,
            e.tan_demand[0],
            e.tan_demand[1] / self.tan_outer,
            e.normal_min_n / self.force_n,
            e.normal_max_n / self.force_n,
            e.hertz_peak_pa / self.pressure_pa,
            e.required_friction,
            e.slip_margin,
            e.contact_margin / self.contact,
        ]
        .into_iter()
        .fold(0.0, |worst, v| if v.is_nan() { f64::INFINITY } else { v.max(worst) })
    }
}
