//! Which cases of the map a drive could have: the box is far wider.

use super::cases::Case;
use crate::clutch::Clutch;

/// Part of the torque at the end of the curve that all springs may take there: a choice, some 370 times that of Table 1's clutch.
const SPRINGS_SHARE: f64 = 0.1;

/// What a drive with a clutch of this geometry and steel could have.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drives {
    /// Inertia of the bare rings of inner and outer race, kg m^2: what is fixed to them adds to it.
    pub least_inertia_kg_m2: [f64; 2],
    /// Stiffest spring of a sprag, N m/rad: at the end of the curve all of them push back with a tenth of its torque.
    pub most_spring_nm_per_rad: f64,
    /// Fastest own swing of the outer race on its abutment, rad/s: sqrt(E/rho)/R, with which a thin ring breathes (Love). A race that
    /// swings faster is no rigid body, which (15) takes it for.
    pub fastest_rad_s: f64,
}

impl Drives {
    /// Of `clutch`; `None` where it has no curve at rest.
    pub fn of(clutch: &Clutch) -> Option<Self> {
        let curve = clutch.curve().ok()?;
        let (r, [_, inner_kg, outer_kg]) = (&clutch.races, clutch.masses_kg());
        let ring = |kg: f64, from_m: f64, until_m: f64| 0.5 * kg * (from_m * from_m + until_m * until_m);
        let springs_rad = clutch.sprags.count as f64 * curve.end().1;
        let steel = &clutch.materials.outer_race;
        let mean_m = 0.5 * (r.outer_radius_m + r.outer_outside_radius_m);
        Some(Self {
            least_inertia_kg_m2: [
                ring(inner_kg, r.inner_bore_radius_m, r.inner_radius_m),
                ring(outer_kg, r.outer_radius_m, r.outer_outside_radius_m),
            ],
            most_spring_nm_per_rad: SPRINGS_SHARE * curve.end_torque_nm() / springs_rad,
            fastest_rad_s: (steel.youngs_modulus_pa / steel.density_kg_m3).sqrt() / mean_m,
        })
    }

    /// Whether one could have `case`.
    pub fn have(&self, case: &Case) -> bool {
        let [_, _, _, _, _, _, abutment, _, inner, outer, _, spring] = case.values;
        let [least_inner, least_outer] = self.least_inertia_kg_m2;
        inner >= least_inner
            && outer >= least_outer
            && spring <= self.most_spring_nm_per_rad
            && (abutment / outer).sqrt() <= self.fastest_rad_s
    }
}
