//! Scenes of the designs, as tests of sprags one by one change them.
#![allow(dead_code)]

use sprag_design::Design;
use sprag_design::clutch::{Scenario, ScenarioKind};

/// Scenes in which sprags slip, lift and catch: file and name.
pub const TRYING: [(&str, &str); 5] = [
    ("huang2017-multi-arc", "high-10"),
    ("huang2017-multi-arc", "low-10-mu082"),
    ("huang2017-bench", "in-and-out"),
    ("huang2017-bench", "engagement-weak-spring"),
    ("huang2017-bench", "step-down"),
];

pub fn scene(file: &str, name: &str) -> Scenario {
    let path = format!("{}/designs/{file}.toml", env!("CARGO_MANIFEST_DIR"));
    Design::read(path.as_ref()).unwrap().scenario(name).unwrap().clone()
}

pub fn lasting(scene: &mut Scenario, seconds: f64) {
    match &mut scene.kind {
        ScenarioKind::TorsionalExcitation { duration_s, .. } | ScenarioKind::Transient { duration_s, .. } => {
            *duration_s = seconds;
        }
        _ => panic!(),
    }
}

/// The single arc's scene low-6 as the independent scripts have it: no springs, sprags next to without inertia, no slip.
pub fn of_scripts(seconds: f64, preload: f64) -> Scenario {
    let mut scene = scene("huang2017-single-arc", "low-6");
    scene.clutch.sprags.mass_kg *= 1e-4;
    scene.clutch.sprags.inertia_kg_m2 *= 1e-4;
    scene.clutch.spring.stiffness_nm_per_rad = 0.0;
    scene.clutch.friction.static_ = 0.5;
    let ScenarioKind::TorsionalExcitation { duration_s, preload_nm, .. } = &mut scene.kind else { panic!() };
    (*duration_s, *preload_nm) = (seconds, preload);
    scene
}

/// A torque that rises by and by to `to_nm` (N m) and stays, without a spring: the swing that the ramp leaves dies away.
pub fn rising(to_nm: f64) -> Scenario {
    let mut slow = scene("huang2017-bench", "step-up");
    slow.torque_history = Some(vec![[0.0, 1.0], [0.5, to_nm], [1.2, to_nm]]);
    slow.clutch.spring.stiffness_nm_per_rad = 0.0;
    lasting(&mut slow, 1.2);
    slow
}
