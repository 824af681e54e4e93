//! Materials and limits by name.

use crate::program::*;
use sprag_design::design::Design;
use sprag_design::material::{STEELS, steel};

const MULTI_TEXT: &str = include_str!("../../designs/huang2017-multi-arc.toml");

/// The multi-arc design with another [material], and with `more` at its end.
fn parse(material: &str, limits: &str, more: &str) -> Design {
    let (start, end) = (MULTI_TEXT.find("[material]").unwrap(), MULTI_TEXT.find("[friction]").unwrap());
    let text = [&MULTI_TEXT[..start], material, &MULTI_TEXT[end..], more].concat();
    let text = text.replacen("[limits]", &format!("[limits]\n{limits}"), 1);
    Design::parse(&text, "x.toml").unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn a_name_gives_what_the_library_holds_and_keys_win_over_it() {
    let named = parse("[material]\nname = \"aisi 52100\"\n", "", "");
    assert_eq!(named.clutch.materials.sprag, steel("100Cr6").unwrap().material);
    assert_eq!(named.clutch.materials.outer_race, steel("100Cr6").unwrap().material);
    let mixed = parse(
        "[material.sprag]\nname = \"100Cr6\"\nyoungs_modulus_gpa = 206.0\n[material.inner_race]\nname = \"16MnCr5\"\n\
         [material.outer_race]\nyoungs_modulus_gpa = 200\npoisson_ratio = 0.28\ndensity_kg_m3 = 7800\n",
        "",
        "",
    );
    let m = mixed.clutch.materials;
    assert_eq!((m.sprag.youngs_modulus_pa, m.sprag.poisson_ratio), (206e9, 0.3));
    assert_eq!(m.inner_race, steel("16MnCr5").unwrap().material);
    assert_eq!(m.outer_race.youngs_modulus_pa, 200e9);
}

#[test]
fn a_scenario_that_names_a_steel_inherits_no_key_of_another() {
    let more = "[[scenarios]]\nname = \"hold\"\nkind = \"static\"\ntorque_nm = 10\nmaterial = { name = \"100Cr6\" }\n";
    let d = parse(
        "[material]\nyoungs_modulus_gpa = 300.0\npoisson_ratio = 0.2\ndensity_kg_m3 = 3200.0\n",
        "",
        more,
    );
    assert_eq!(d.clutch.materials.sprag.youngs_modulus_pa, 300e9);
    assert_eq!(d.scenario("hold").unwrap().clutch.materials.inner_race, steel("100Cr6").unwrap().material);
}

/// GMN 9050: 4200 MPa at nominal, 4600 at maximum torque; races 400 MPa (34CrMo4V, 16MnCr5), 600 (20MnCr5), 750 (100Cr6).
#[test]
fn limits_come_from_the_material_where_asked_and_keys_win() {
    let bodies = "[material.sprag]\nname = \"100Cr6\"\n[material.inner_race]\nname = \"16MnCr5\"\n\
                  [material.outer_race]\nname = \"20MnCr5\"\n";
    let l = parse(bodies, "from_material = true", "").limits;
    // The file's own 900 and 750 MPa stand.
    assert_eq!((l.hoop_inner_pa, l.hoop_outer_pa), (Some(900e6), Some(750e6)));
    let text = parse(bodies, "from_material = true", "").source;
    let text = text.replace("hoop_inner_mpa = 900.0\n", "").replace("hoop_outer_mpa = 750.0\n", "");
    let l = Design::parse(&text, "x.toml").unwrap().limits;
    assert_eq!((l.hoop_inner_pa, l.hoop_outer_pa), (Some(400e6), Some(600e6)));
    assert_eq!((l.hertz_nominal_pa, l.hertz_peak_pa), (Some(4200e6), Some(4600e6)));
    let stress = |name: &str| steel(name).unwrap().race_stress_pa;
    assert_eq!(
        (stress("34CrMo4V"), stress("16MnCr5"), stress("20MnCr5"), stress("100Cr6")),
        (400e6, 400e6, 600e6, 750e6)
    );
}

#[test]
fn the_command_lists_them_with_their_sources() {
    let text = stdout(&run(&["materials"]));
    let value = json(&run(&["materials", "--json"]));
    assert_eq!(value["materials"].as_array().unwrap().len(), STEELS.len());
    for s in &STEELS {
        assert!(text.contains(s.name) && text.contains(s.source), "{text}");
    }
}
