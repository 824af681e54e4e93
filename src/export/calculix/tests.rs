use super::*;
use crate::design::Design;
use crate::scenario::place_profile;

fn design() -> (Design, Profile, Outline) {
    let text = include_str!("../../../designs/huang2017-single-arc.toml");
    let design = Design::parse(text, "single").unwrap();
    let profile = place_profile(&design.clutch).unwrap();
    let flanks = design.clutch.sprags.flanks.unwrap();
    let outline = Outline::new(&profile, flanks.rear_m, flanks.front_m).unwrap();
    (design, profile, outline)
}

#[test]
fn a_deck() {
    let (d, p, o) = design();
    let options = Options { torque_nm: 16.8, ..Options::default() };
    let text = deck(&d.clutch, &p, &o, &options, &d.hash).unwrap();
    std::fs::create_dir_all("/tmp/fem").unwrap();
    std::fs::write("/tmp/fem/a.inp", text).unwrap();
}
