//! Shear below the contacts: against the case where it is largest, against the core at the depth of the case.

use crate::contact::largest_shear_below;
use crate::design::{Design, Limits};
use crate::wedge::StaticPoint;
use std::f64::consts::PI;

/// One limit on the shear below a contact.
pub(super) struct Subsurface {
    pub code: &'static str,
    pub name: &'static str,
    /// Allowable, Pa, and the depth from which on it is held, m.
    pub allowed: fn(&Limits) -> Option<(f64, f64)>,
    /// p_0, Pa, and normal force, N, of one sprag.
    pub contact: fn(&StaticPoint) -> (f64, f64),
}

impl Subsurface {
    /// Largest shear from that depth on, Pa, and its depth, m. The half width comes from force and pressure,
    /// N/l = pi a p_0/2, and so belongs to the pressure that is reported (curvature averaged over the patch).
    pub fn demand(&self, design: &Design, from_m: f64, p: &StaticPoint) -> (f64, f64) {
        let (pressure_pa, normal_n) = (self.contact)(p);
        let half_width_m = match pressure_pa > 0.0 {
            true => 2.0 * normal_n / (PI * design.clutch.contact_length_m() * pressure_pa),
            false => 0.0,
        };
        largest_shear_below(pressure_pa, half_width_m, from_m)
    }
}

fn core(limits: &Limits) -> Option<(f64, f64)> {
    limits.core_shear_pa.zip(limits.case_depth_m)
}

fn case(limits: &Limits) -> Option<(f64, f64)> {
    limits.case_shear_pa.map(|allowed| (allowed, 0.0))
}

pub(super) const SUBSURFACE: [Subsurface; 4] = [
    Subsurface {
        code: "subsurface-inner",
        name: "largest shear below the inner contact, peak torque",
        allowed: case,
        contact: |p| (p.hertz_inner_pa, p.normal_inner_n),
    },
    Subsurface {
        code: "subsurface-outer",
        name: "largest shear below the outer contact, peak torque",
        allowed: case,
        contact: |p| (p.hertz_outer_pa, p.normal_outer_n),
    },
    Subsurface {
        code: "subsurface-core-inner",
        name: "largest shear beneath the case at the inner contact, peak torque",
        allowed: core,
        contact: |p| (p.hertz_inner_pa, p.normal_inner_n),
    },
    Subsurface {
        code: "subsurface-core-outer",
        name: "largest shear beneath the case at the outer contact, peak torque",
        allowed: core,
        contact: |p| (p.hertz_outer_pa, p.normal_outer_n),
    },
];
