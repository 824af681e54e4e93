//! Half-space contacts as JSON, one per line, each with all that another program needs to solve it again:
//! read by reports/check_half_space.py.

use sprag_design::contact::half_space::HalfSpaceLine;
use sprag_design::contact::{AxialFit, ContactError, EndDrop, LineContact};
use sprag_design::material::{Material, PlaneState};

fn main() -> Result<(), ContactError> {
    let steel = Material { youngs_modulus_pa: 206e9, poisson_ratio: 0.3, density_kg_m3: 7850.0 };
    let contact = LineContact {
        effective_radius_m: 2.9519e-3,
        length_m: 6e-3,
        contact_modulus_pa: PlaneState::Strain.contact_modulus_pa(&steel, &steel),
    };
    let relief = EndDrop::end_relief(0.5e-3, 10e-3)?;
    let cases = [
        ("square", EndDrop::Square, 0.0, 1558.0, 60),
        ("square", EndDrop::Square, 0.0, 8384.0, 120),
        ("Lundberg at its load", EndDrop::lundberg(&contact, 2441.0)?, 0.0, 2441.0, 120),
        ("Lundberg at its load", EndDrop::lundberg(&contact, 2441.0)?, 0.0, 2441.0, 960),
        ("Lundberg at three times its load", EndDrop::lundberg(&contact, 2441.0)?, 0.0, 7323.0, 120),
        ("end relief 0.5 mm, 10 mm radius", relief, 0.0, 2441.0, 120),
        ("square, tilt 0.5 mrad", EndDrop::Square, 5e-4, 1558.0, 60),
        ("square, tilt 2 mrad, lifted", EndDrop::Square, 2e-3, 300.0, 120),
    ];
    for (name, profile, tilt_rad, normal_n, along) in cases {
        let fit = AxialFit::shaped(contact.length_m, profile, tilt_rad)?;
        let across = 64;
        let found = HalfSpaceLine::new(contact, across, along).solve_along(normal_n, &fit)?;
        let case = serde_json::json!({
            "name": name,
            "effective_radius_m": contact.effective_radius_m,
            "length_m": contact.length_m,
            "contact_modulus_pa": contact.contact_modulus_pa,
            "normal_n": normal_n,
            "across": across,
            "along": along,
            "patch_width_m": found.patch_width_m,
            "gap_m": fit.gaps_m(along),
            "hertz_pa": contact.peak_pressure_pa(normal_n),
            "approach_m": found.approach_m,
            "pressure_pa": found.pressure_pa,
            "load_n": found.load_n,
        });
        println!("{case}");
    }
    Ok(())
}
