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
    /// Largest N_be, N.
    pub normal_outer_max_n: f64,
    /// Largest Hertz pressure, Pa.
    pub hertz_peak_pa: f64,
    /// Hertz pressure at A at the smallest N_bi, Pa.
    pub hertz_least_pa: f64,
    /// How long A slips after an overrun has been reversed, s.
    pub initial_slip_s: f64,
    /// By how much the times of the extremes moved between the runs, s, in the order of [`Peaks::at_s`]. That is no bound, and
    /// held against no tolerance: an extreme is flat, and of several that are equal within their error any may be named.
    pub extremes_at_s: [f64; 5],
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
            normal_outer_max_n: f(self.normal_outer_max_n, other.normal_outer_max_n),
            hertz_peak_pa: f(self.hertz_peak_pa, other.hertz_peak_pa),
            hertz_least_pa: f(self.hertz_least_pa, other.hertz_least_pa),
            initial_slip_s: f(self.initial_slip_s, other.initial_slip_s),
            extremes_at_s: std::array::from_fn(|i| f(self.extremes_at_s[i], other.extremes_at_s[i])),
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
            normal_outer_max_n: p.normal_outer_max_n,
            hertz_peak_pa: self.hertz_peak_pa,
            hertz_least_pa: self.hertz_least_pa,
            initial_slip_s: self.initial_slip_s().unwrap_or(0.0),
            extremes_at_s: p.at_s,
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

    /// Every error by its scale, with the name of its figure.
    fn each(&self, e: &ErrorEstimate) -> [(&'static str, f64); 21] {
        [
            ("angle of the inner race at the end", e.theta_inner_rad),
            ("angle of the outer race at the end", e.theta_outer_rad),
            ("offset", e.offset_rad),
            ("net slip at the inner contact", e.net_slip_m / self.length_m),
            ("net slip at the outer contact", e.net_slip_outer_m / self.length_m),
            ("slip path at the inner contact", e.slip_distance_m[0] / self.length_m),
            ("slip path at the outer contact", e.slip_distance_m[1] / self.length_m),
            ("slip time at the inner contact", e.slip_time_s[0] / self.time_s),
            ("slip time at the outer contact", e.slip_time_s[1] / self.time_s),
            ("time without contact", e.contact_lost_s / self.time_s),
            ("largest |T|/N at the inner contact", e.tan_demand[0]),
            ("largest |T|/N at the outer contact", e.tan_demand[1]),
            ("smallest normal force", e.normal_min_n / self.force_n),
            ("largest normal force", e.normal_max_n / self.force_n),
            ("largest normal force at the outer contact", e.normal_outer_max_n / self.force_n),
            ("largest Hertz pressure", e.hertz_peak_pa / self.pressure_pa),
            ("smallest Hertz pressure", e.hertz_least_pa / self.pressure_pa),
            ("initial slip", e.initial_slip_s / self.time_s),
            ("static friction needed to stick", e.required_friction),
            ("slip margin", e.slip_margin),
            ("contact margin", e.contact_margin / self.contact),
        ]
        .map(|(name, v)| (name, if v.is_nan() { f64::INFINITY } else { v }))
    }

    /// The largest error by its scale; infinite where one is no number.
    pub fn worst(&self, e: &ErrorEstimate) -> f64 {
        self.worst_figure(e).1
    }

    /// The same with the name of the figure.
    pub fn worst_figure(&self, e: &ErrorEstimate) -> (&'static str, f64) {
        let [first, others @ ..] = self.each(e);
        others.into_iter().fold(first, |worst, one| if one.1 > worst.1 { one } else { worst })
    }
}
