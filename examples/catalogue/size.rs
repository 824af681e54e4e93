//! One size with the profile found: what each limit would carry, and its state at the catalogue's torque.

use std::error::Error;

use sprag_design::design::Design;
use sprag_design::file::with_keys;
use sprag_design::margin::{Capacities, LoadState, load_margins, load_state};
use sprag_design::profile::{Outline, Profile, clearance_m};
use sprag_design::wedge::StaticPoint;

use crate::rows::Row;

/// A size.
pub(crate) struct Size {
    pub(crate) row: Row,
    pub(crate) design: Design,
    pub(crate) state: LoadState,
    /// At the catalogue's torque.
    pub(crate) point: StaticPoint,
    pub(crate) opening_mm: f64,
    pub(crate) equivalent_outer_mpa: f64,
}

impl Size {
    pub(crate) fn new(found: &str, row: &Row) -> Result<Self, Box<dyn Error>> {
        let design = Design::parse(&with_keys(found, &row.keys())?, &row.name)?;
        let state = load_state(&design)?;
        // Where the curve ends below the catalogue's torque, its end stands in for it.
        let curve = &state.curve;
        let end = || curve.at_normal(curve.arc_end_n(curve.arc_count() - 1));
        let point =
            curve.at_torque(row.torque_nm).or_else(end).ok_or_else(|| format!("{}: no curve", row.name))?;
        let elastic = &state.curve.statics().elastic;
        let opening_mm = 1e3 * elastic.gap_opening_m(point.normal_inner_n, point.normal_outer_n);
        let equivalent_outer_mpa =
            1e-6 * elastic.outer_race.equivalent_pa(design.clutch.sprags.count, point.normal_outer_n);
        Ok(Self { row: row.clone(), design, state, point, opening_mm, equivalent_outer_mpa })
    }

    /// Torque at which the limit of that code would be reached, N m.
    pub(crate) fn capacity(&self, codes: &[&str]) -> f64 {
        let rows = load_margins(&self.design, &self.design.limits, Capacities::Wanted, &self.state);
        let each =
            rows.iter().filter(|r| codes.contains(&r.code().as_str())).filter_map(|r| r.torque_capacity_nm);
        each.fold(f64::INFINITY, f64::min)
    }

    /// Least clearance (mm) between neighbouring sprags of the narrowest outline that works up to `torque_nm`, at rest and
    /// there, and its width; `None` where no outline closes.
    pub(crate) fn clearance(&self, torque_nm: f64) -> Option<(f64, f64)> {
        let point = self.state.curve.at_torque(torque_nm)?;
        let (_, closure) = self.state.curve.closure_at_torque(torque_nm)?;
        let s = &self.design.clutch.sprags;
        let r = &self.design.clutch.races;
        let arcs = [(s.inner_arcs[0].radius_m, 1.02 * point.contact_turn_rad)];
        let profile =
            Profile::new(s.outer_radius_m, s.centre_distance_m, &arcs, r.inner_radius_m, r.outer_radius_m)
                .ok()?;
        let outline = Outline::narrowest(&profile).ok()?;
        let at = |rotation: f64| clearance_m(&outline, profile.outer_centre_distance_m, rotation, s.count);
        let xs: Vec<f64> = outline.polyline(1e-6).iter().map(|p| p[0]).collect();
        let width = xs.iter().fold(f64::MIN, |a, b| a.max(*b)) - xs.iter().fold(f64::MAX, |a, b| a.min(*b));
        Some((1e3 * at(0.0).min(at(closure.rotation.v)), 1e3 * width))
    }
}

/// Exponents of d and l and the scatter (rms of the logarithm) of torque = c d^a l^b.
pub(crate) fn power_law(points: &[(f64, f64, f64)]) -> (f64, f64, f64) {
    let n = points.len() as f64;
    let logs: Vec<[f64; 3]> = points.iter().map(|(d, l, t)| [d.ln(), l.ln(), t.ln()]).collect();
    let mean: Vec<f64> = (0..3).map(|k| logs.iter().map(|p| p[k]).sum::<f64>() / n).collect();
    let s = |i: usize, j: usize| logs.iter().map(|p| (p[i] - mean[i]) * (p[j] - mean[j])).sum::<f64>();
    let det = s(0, 0) * s(1, 1) - s(0, 1) * s(0, 1);
    let a = (s(0, 2) * s(1, 1) - s(1, 2) * s(0, 1)) / det;
    let b = (s(1, 2) * s(0, 0) - s(0, 2) * s(0, 1)) / det;
    let off = |p: &[f64; 3]| p[2] - mean[2] - a * (p[0] - mean[0]) - b * (p[1] - mean[1]);
    (a, b, (logs.iter().map(|p| off(p).powi(2)).sum::<f64>() / n).sqrt())
}
