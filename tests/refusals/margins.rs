//! Refusals of the keys that margins read: limits of the body, materials by name, fits, temperatures, run-out.

use super::{Case, hold};

#[test]
#[rustfmt::skip] // one way per line
fn a_body_without_flanks_has_no_section() {
    let bare: &[(&str, &str)] = &[("width_mm = 5.05", "width_mm = 0"), ("hoop_inner_mpa = 900.0", "hoop_inner_mpa = 900.0\nbody_yield_mpa = 1500.0")];
    hold(&[
        Case(bare, "limits.body_yield_mpa", "body_yield_mpa", &["narrowest section", "add flanks"]),
        Case(&[("hoop_inner_mpa = 900.0", "body_yield_mpa = 0.0")], "limits.body_yield_mpa", "body_yield_mpa", &["above 0"]),
    ]);
}

const MATERIAL: &str = "youngs_modulus_gpa = 206.0          # with it (5) gives MATLAB's 26 um and 15 um at 4500 N\npoisson_ratio = 0.3                 # as above\ndensity_kg_m3 = 7850.0              # steel, assumed\n";
const WARM: &str = "[thermal]\ninner_race_c = 90.0\nouter_race_c = 60.0\nsprags_c = 80.0\n[friction]";

#[test]
#[rustfmt::skip] // one way per line
fn materials_by_name() {
    hold(&[
        Case(&[(MATERIAL, "name = \"100Cr7\"\n")], "material.name", "100Cr7", &["did you mean 100Cr6?", "34CrMo4V"]),
        Case(&[(MATERIAL, "name = \"unobtainium\"\n")], "material.name", "unobtainium", &["sprag-design materials"]),
        Case(&[(MATERIAL, "[material.sprag]\nname = \"100Cr6\"\n[material.inner_race]\nname = \"16MnCr4\"\n[material.outer_race]\nname = \"100Cr6\"\n")], "material.inner_race.name", "16MnCr4", &["did you mean 16MnCr5?"]),
        Case(&[(MATERIAL, "[material.sprag]\nname = \"100Cr6\"\n[material.inner_race]\npoisson_ratio = 0.3\n[material.outer_race]\nname = \"100Cr6\"\n")], "material.inner_race.youngs_modulus_gpa", "[material.inner_race]", &["add youngs_modulus_gpa", "name of a steel"]),
        Case(&[(MATERIAL, "name = \"100Cr6\"\n[material.sprag]\nname = \"100Cr6\"\n")], "material.youngs_modulus_gpa", "[material]", &["either keys for all bodies"]),
        Case(&[("[limits]", "[limits]\nfrom_material = true")], "limits.from_material", "from_material", &["has a name", "100Cr6"]),
        Case(&[("[limits]", "[limits]\nfrom_material = \"yes\"")], "limits.from_material", "from_material", &["true or false"]),
        Case(&[("keep_contact_to_rpm = 4500", "keep_contact_to_rpm = 4500\nlift_off_by_rpm = 4000")], "limits.lift_off_by_rpm", "lift_off_by_rpm", &["more than keep_contact_to_rpm"]),
    ]);
}

#[test]
#[rustfmt::skip] // one way per line
fn fits_and_temperatures() {
    let fit = |keys: &str| format!("press_fit = {{ {keys} }}\nwidth_mm = 6.0      ");
    let case = |keys: &str, key: &str, words: &[&str]| {
        let fit = fit(keys);
        hold(&[Case(&[("width_mm = 6.0      ", &fit)], &format!("races.press_fit.{key}"), "press_fit", words)]);
    };
    case("inner_interference_um = -1.0", "inner_interference_um", &["at least 0"]);
    case("inner_interference_um = 10.0, shaft_bore_radius_mm = 7.3", "shaft_bore_radius_mm", &["less than the bore of the inner race, 7.21 mm"]);
    case("shaft_bore_radius_mm = 2.0", "shaft_bore_radius_mm", &["only together with inner_interference_um"]);
    case("outer_interference_um = 10.0", "outer_interference_um", &["housing_outside_radius_mm, which is missing"]);
    case("housing_outside_radius_mm = 40.0", "housing_outside_radius_mm", &["outer_interference_um, which is missing"]);
    case("outer_interference_um = 10.0, housing_outside_radius_mm = 26.0", "housing_outside_radius_mm", &["more than the outer race's outside, 26.23 mm"]);
    case("interference_um = 10.0", "interference_um", &["did you mean inner_interference_um?"]);
    let held = |keys: &str| format!("{keys}\nwidth_mm = 6.0      ");
    let rim = |keys: &str, key: &str, words: &[&str]| {
        let held = held(keys);
        hold(&[Case(&[("width_mm = 6.0      ", &held)], &format!("races.{key}"), key, words)]);
    };
    rim("inner_rim = \"held\"\npress_fit = { inner_interference_um = 10.0 }", "inner_rim", &["the shaft of the fit yields", "remove races.inner_rim"]);
    rim("outer_rim = \"held\"\npress_fit = { outer_interference_um = 10.0, housing_outside_radius_mm = 40.0 }", "outer_rim", &["the housing of the fit yields"]);
    rim("outer_rim = \"stiff\"", "outer_rim", &["\"free\" or \"held\""]);
    let bore = held("inner_rim = \"held\"");
    hold(&[Case(&[("width_mm = 6.0      ", &bore), ("inner_bore_radius_mm = 7.21", "inner_bore_radius_mm = 0")], "races.inner_rim", "inner_rim", &["no bore to be held"])]);
    let solid = fit("inner_interference_um = 10.0");
    hold(&[
        Case(&[("width_mm = 6.0      ", &solid), ("inner_bore_radius_mm = 7.21", "inner_bore_radius_mm = 0")], "races.press_fit.inner_interference_um", "press_fit", &["solid inner race has no shaft"]),
        Case(&[("[friction]", WARM)], "material.expansion_um_per_m_k", "[material]", &["add expansion_um_per_m_k = 12.0 (steel)"]),
        Case(&[("[friction]", &WARM.replace("sprags_c = 80.0\n", ""))], "thermal.sprags_c", "[thermal]", &["add sprags_c"]),
        Case(&[("[friction]", &WARM.replace("90.0", "-300.0"))], "thermal.inner_race_c", "-300.0", &["at least -273.15"]),
        Case(&[("density_kg_m3 = 7850.0 ", "expansion_um_per_m_k = 20.0\ndensity_kg_m3 = 7850.0 "), ("[friction]", &WARM.replace("90.0", "1500.0"))], "thermal", "[thermal]", &["still touch both races", "8.33 mm as made"]),
    ]);
}

#[test]
#[rustfmt::skip] // one way per line
fn axes_apart() {
    let case = |keys: &str, key: &str, words: &[&str]| {
        let apart = format!("eccentricity = {{ {keys} }}\nwidth_mm = 6.0      ");
        let key = if key.is_empty() { "races.eccentricity".to_owned() } else { format!("races.eccentricity.{key}") };
        hold(&[Case(&[("width_mm = 6.0      ", &apart)], &key, "eccentricity", words)]);
    };
    case("offset_mm = -0.01", "offset_mm", &["at least 0"]);
    case("offset_mm = \"0.01\"", "offset_mm", &["number"]);
    case("offset_mm = inf", "offset_mm", &["inf"]);
    case("turning = true", "offset_mm", &["add offset_mm"]);
    case("offset_mm = 0.01, turning = 1", "turning", &["true or false"]);
    case("offset_mm = 0.26", "offset_mm", &["less than 0.25 mm", "least height, 8.08 mm", "half of what a dial indicator reads"]);
    case("offset_mm = 9.0", "offset_mm", &["less than 0.25 mm"]);
    case("offset_mm = 0.01, bearing_stiffness_n_per_um = -1", "bearing_stiffness_n_per_um", &["at least 0"]);
    case("offset_mm = 0.01, turning = true, bearing_stiffness_n_per_um = 0", "turning", &["remove turning", "floats"]);
    case("offset_mm = 0.01, ovality_mm = 0.01", "ovality_mm", &["unknown"]);
    hold(&[Case(&[("width_mm = 6.0      ", "eccentricity_mm = 0.01\nwidth_mm = 6.0      ")], "races.eccentricity_mm", "eccentricity_mm", &["did you mean eccentricity?"])]);
}
