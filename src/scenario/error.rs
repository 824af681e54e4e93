//! How far two runs of one scene lie apart, figure by figure.

use super::answer::Simulation;
use super::prepare::Prepared;
use super::simulate::hertz_peak;
use crate::dynamics::Peaks;

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
    /// `f` of each figure here and in `other`.
    fn with(&self, other: &Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let pair = |a: [f64; 2], b: [f64; 2]| [f(a[0], b[0]), f(a[1], b[1])];
        Self {
            theta_inner_rad: f(self.theta_inner_rad, other.theta_inner_rad),
            theta_outer_rad: f(self.theta_outer_rad, other.theta_outer_rad),
            offset_rad: f(self.offset_rad, other.offset_rad),
            net_slip_m: f(self.net_slip_m, other.net_slip_m),
            net_slip_outer_m: f(self.net_slip_outer_m, other.net_slip_outer_m),
            slip_distance_m: pair(self.slip_distance_m, other.slip_distance_m),
            slip_time_s: pair(self.slip_time_s, other.slip_time_s),
            contact_lost_s: f(self.contact_lost_s, other.contact_lost_s),
            tan_demand: pair(self.tan_demand, other.tan_demand),
            normal_min_n: f(self.normal_min_n, other.normal_min_n),
            normal_max_n: f(self.normal_max_n, other.normal_max_n),
            hertz_peak_pa: f(self.hertz_peak_pa, other.hertz_peak_pa),
            required_friction: f(self.required_friction, other.required_friction),
            slip_margin: f(self.slip_margin, other.slip_margin),
            contact_margin: f(self.contact_margin, other.contact_margin),
        }
    }

    /// Each figure's error, at least `share` of that in `other`: two runs may agree by chance.
    pub(super) fn at_least(&self, share: f64, other: &Self) -> Self {
        self.with(other, |own, other| own.max(share * other))
    }
}

impl Simulation {
    /// How far every figure lies from that of `other`.
    pub fn off(&self, other: &Self) -> ErrorEstimate {
        self.figures().with(&other.figures(), |a, b| (a - b).abs())
    }

    /// The figures that have an error; 0 where there is none.
    fn figures(&self) -> ErrorEstimate {
        let (a, b, p) = (self.inner, self.outer, self.peaks);
        ErrorEstimate {
            theta_inner_rad: self.theta_inner_rad,
            theta_outer_rad: self.theta_outer_rad,
            offset_rad: self.offset_rad,
            net_slip_m: a.net_m,
            net_slip_outer_m: b.net_m,
            slip_distance_m: [a.distance_m, b.distance_m],
            slip_time_s: [a.time_s, b.time_s],
            contact_lost_s: self.contact_lost_s,
            tan_demand: [p.tan_inner, p.tan_outer],
            normal_min_n: p.normal_min_n,
            normal_max_n: p.normal_max_n,
            hertz_peak_pa: self.hertz_peak_pa,
            required_friction: self.demand.and_then(|d| d.required_friction).unwrap_or(0.0),
            slip_margin: self.demand.map_or(0.0, |d| d.slip_margin),
            contact_margin: self.demand.map_or(0.0, |d| d.contact_margin),
        }
    }
}

/// By what an error is divided before it is held against the tolerance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scales {
    length_m: f64,
    time_s: f64,
    force_n: f64,
    pressure_pa: f64,
    contact: f64,
    /// Infinite where B holds whatever that takes: its |T|/N then grows without bound as N_be falls to 0 at a touch.
    tan_outer: f64,
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
            tan_outer: if prepared.model.outer_holds { f64::INFINITY } else { 1.0 },
        }
    }

    /// The largest error by its scale; infinite where one is no number.
    pub fn worst(&self, e: &ErrorEstimate) -> f64 {
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
