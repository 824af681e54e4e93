//! Table 1's clutch in SI, written out by hand so that the statics are tested without the file reader.
#![allow(dead_code)]

use sprag_design::clutch::*;
use sprag_design::material::Material;
use sprag_design::profile::Flanks;
use sprag_design::profile::Profile;

pub const SINGLE: [(f64, f64); 1] = [(4.02e-3, 0.45)];
pub const MULTI: [(f64, f64); 3] = [(4.02e-3, 0.06), (4.08e-3, 0.12), (4.15e-3, 0.45)];

pub fn clutch(arcs: &[(f64, f64)]) -> (Clutch, Profile) {
    let steel = Material { youngs_modulus_pa: 206e9, poisson_ratio: 0.3, density_kg_m3: 7850.0 };
    let clutch = Clutch {
        sprags: Sprags {
            count: 12,
            length_m: 6e-3,
            outer_radius_m: 4.68e-3,
            centre_distance_m: 0.62e-3,
            width_m: 5.05e-3,
            mass_kg: 1.8e-3,
            inertia_kg_m2: 1.18e-8,
            centroid_m: [0.1935e-3, 0.5288e-3],
            mass_source: MassSource::Given,
            inner_arcs: arcs.iter().map(|&(radius_m, until_rad)| InnerArc { radius_m, until_rad }).collect(),
            spiral: None,
            flanks: Some(Flanks::parallel(2.525e-3, 2.525e-3)),
        },
        races: Races {
            inner_bore_radius_m: 7.21e-3,
            inner_radius_m: 11.11e-3,
            outer_radius_m: 19.44e-3,
            outer_outside_radius_m: 26.23e-3,
            width_m: 6e-3,
            inner_inertia_kg_m2: 1.41e-3,
            outer_inertia_kg_m2: 1.41e-3,
            viscous_damping_nm_s_per_rad: 0.1,
            inner_rim: Rim::Free,
            outer_rim: Rim::Free,
            eccentricity: None,
        },
        running: None,
        spring: Spring { stiffness_nm_per_rad: 0.01, drag_torque_nm: 0.0166 },
        cage: None,
        materials: Materials { sprag: steel, inner_race: steel, outer_race: steel },
        friction: Friction { static_: 0.12, kinetic: 0.09, decay_s_per_m: 5.0, outer_holds: false },
        lubrication: None,
        contact: ContactLaw::Roller { coefficient: 3.944e-5 },
        axial: Axial::STRAIGHT,
        hunt_crossley_s_per_m: 0.0,
    };
    let profile = Profile::new(4.68e-3, 0.62e-3, arcs, 11.11e-3, 19.44e-3).unwrap();
    (clutch, profile)
}
