//! The steels that a design may name, as a table, as JSON and in words.

use crate::material::{STEELS, Steel};
use crate::report::{Rows, Screen, Unit};

/// Thermal expansion, um/(m K). Divided, since 1e6 times 11.4e-6 is 11.399999999999999.
fn expansion_um_per_m_k(steel: &Steel) -> f64 {
    steel.expansion_per_k / 1e-6
}

/// The steels with their constants and allowed stresses, in JSON with the source of each.
pub fn list() -> Rows<&'static Steel> {
    Rows::of(&STEELS)
        .text("name", "Name", |s| s.name)
        .text("also", "Also", |s| s.also.join(", "))
        .number("youngs_modulus_gpa", "E", Unit::Gigapascal, 4, |s| s.material.youngs_modulus_pa)
        .number("poisson_ratio", "Poisson", Unit::One, 3, |s| s.material.poisson_ratio)
        .number("density_kg_m3", "Density, kg/m³", Unit::One, 4, |s| s.material.density_kg_m3)
        .number("expansion_um_per_m_k", "Expansion, µm/(m K)", Unit::One, 3, |s| expansion_um_per_m_k(s))
        .number("race_stress_mpa", "Race stress", Unit::Megapascal, 4, |s| s.race_stress_pa)
        .number("hertz_nominal_mpa", "Hertz, nominal", Unit::Megapascal, 4, |s| s.hertz_nominal_pa)
        .number("hertz_peak_mpa", "Hertz, peak", Unit::Megapascal, 4, |s| s.hertz_peak_pa)
        .json("also", |s| s.also)
        .json("source", |s| s.source)
}

/// The same on a terminal.
pub fn text(screen: Screen) -> String {
    let mut text = list().table().to_text(screen);
    text.push_str("\nNamed in a design as material = { name = \"100Cr6\" } or [material.sprag] name = \"100Cr6\"; keys\n");
    text.push_str(
        "beside the name win over it. [limits] from_material = true takes the stresses as limits.\n\n",
    );
    for s in &STEELS {
        text.push_str(&format!("{}: {}\n", s.name, s.source));
    }
    text
}
