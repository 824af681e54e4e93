//! The oils and greases that a design may name, as a table, as JSON and in words.

use crate::lubrication::{OILS, Oil};
use crate::report::{Rows, Screen, Unit};

/// The oils with what they are reckoned with, in JSON with the source of each.
pub fn list() -> Rows<&'static Oil> {
    Rows::of(&OILS)
        .text("name", "Name", |o| o.name)
        .text("base", "Base oil", |o| o.base.name())
        .number("nu40_mm2_s", "40 C, mm²/s", Unit::One, 4, |o| 1e6 * o.nu40_m2_s)
        .number("nu100_mm2_s", "100 C, mm²/s", Unit::One, 3, |o| 1e6 * o.nu100_m2_s)
        .number("density_kg_m3", "Density 15 C, kg/m³", Unit::One, 4, |o| o.density_kg_m3)
        .number("alpha40_per_gpa", "α 40 C, 1/GPa", Unit::One, 3, |o| {
            1e9 * o.pressure_coefficient_per_pa(40.0)
        })
        .number("alpha100_per_gpa", "α 100 C, 1/GPa", Unit::One, 3, |o| {
            1e9 * o.pressure_coefficient_per_pa(100.0)
        })
        .json("source", |o| o.source)
}

/// The same on a terminal.
pub fn text(screen: Screen) -> String {
    let mut text = list().table().to_text(screen);
    text.push_str(
        "\nNamed in a design as [lubrication] oil = \"ISO VG 32\"; nu40_mm2_s and nu100_mm2_s beside the name win over it. Values are \
         typical of each kind, no maker's promise.\n\n",
    );
    for o in &OILS {
        text.push_str(&format!("{}: {}\n", o.name, o.source));
    }
    text
}
