//! The verdict of sprags one by one: that of `simulate` where they are alike, and what one among others changes.

use crate::scenes::{lasting, scene};
use sprag_design::Design;
use sprag_design::clutch::{GivenSprag, Sharing};
use sprag_design::scenario::{Settings, Verdict, simulate};
use sprag_design::sprags::each_sprag;

/// Every verdict that a scene of these files has, of all sprags as one and one by one: the same, and as good.
#[test]
fn sprags_alike_have_the_verdict_of_the_scene() {
    let mut seen = Vec::new();
    for (file, name, seconds) in [
        ("huang2017-bench", "engagement", None),
        ("huang2017-bench", "engagement-weak-spring", None),
        ("huang2017-bench", "engagement-without-spring", None),
        ("huang2017-bench", "high-10-without-spring", Some(0.03)),
        ("huang2017-bench", "high-10-damped", Some(0.05)),
        ("huang2017-bench", "step-up", None),
        ("huang2017-bench", "step-down", None),
        ("huang2017-bench", "in-and-out", None),
        ("huang2017-multi-arc", "high-8", Some(0.05)),
        ("huang2017-multi-arc", "low-8", Some(0.05)),
        ("huang2017-multi-arc", "low-10-mu082", Some(0.1)),
        ("lift-off-inner", "runback", None),
    ] {
        let mut scene = scene(file, name);
        if let Some(seconds) = seconds {
            lasting(&mut scene, seconds);
        }
        let one = simulate(&scene, &Settings::default()).unwrap();
        let all = each_sprag(&scene, &Sharing::default(), &Settings::default()).unwrap();
        let (_, verdict) = all.least().unwrap();
        let held = one.verdict.unwrap().is_as_asked(&scene, one.slipped_engaging_m());
        println!("{name}: {verdict:?}, held {}", all.held(&scene));
        assert_eq!((Some(verdict), all.held(&scene)), (one.verdict, held), "{name}");
        seen.push((verdict, held));
    }
    for met in [
        (Verdict::Sticks, true),
        (Verdict::SlipsOverrunning, true),
        (Verdict::SlipsOverrunning, false),
        (Verdict::SlipsEngaging, false),
        (Verdict::Disengages, false),
    ] {
        assert!(seen.contains(&met), "{met:?}");
    }
}

/// Races that others hold are held, and a sprag that slips under load among them is not.
#[test]
fn the_clutch_does_what_the_sprag_does_that_lets_go_least() {
    let mut scene = scene("huang2017-multi-arc", "low-10-mu082");
    lasting(&mut scene, 0.03);
    (scene.clutch.friction.static_, scene.clutch.friction.kinetic) = (0.09, 0.09);
    let of = |friction: f64| {
        let given = vec![GivenSprag { index: 3, friction: Some(friction), ..GivenSprag::default() }];
        each_sprag(&scene, &Sharing { given, ..Sharing::default() }, &Settings::default()).unwrap()
    };
    let [rough, smooth] = [0.088, 0.0815].map(of);
    for all in [&rough, &smooth] {
        println!("{:?} {:?} {}", all.run.stop, all.verdicts, all.held(&scene));
        assert_eq!(all.least().unwrap().1, Verdict::Sticks);
    }
    let third = smooth.group[3].unwrap();
    assert!(rough.held(&scene) && !smooth.held(&scene) && smooth.slips(third));
    assert_eq!(smooth.verdicts[third], Some(Verdict::SlipsEngaging));
}

/// What the command says of a clutch that overruns, though none of its sprags slips under load.
#[test]
fn an_overrun_without_slip_under_load_is_not_held() {
    let design = Design::read("designs/unlike-sprags.toml".as_ref()).unwrap();
    let answer = design.sharing_in_scene("high-8", &Settings::default()).unwrap();
    let said = sprag_design::answer::Answer::verdict(&answer);
    assert!(said.starts_with("NOT HELD: ") && said.contains("; under load none slips"), "{said}");
    assert!(said.contains("; the clutch overruns: no sprag holds, and "), "{said}");
    assert_eq!(answer.slipping(), 0);
}
