//! Limits that are held while the clutch turns, and what is said where they are not.

use sprag_design::answer::Answer;
use sprag_design::answer::check::CheckAnswer;
use sprag_design::report::Screen;
use sprag_design::{Design, Follow, WedgeCurve};

/// A clutch whose rows at rest are held and that ends below its peak torque at its own speed is warned of; the figures are those of the curve
/// at that speed.
#[test]
fn rows_at_rest_say_what_speed_changes() {
    let text = std::fs::read_to_string("designs/huang2017-multi-arc.toml").unwrap();
    let calm = Design::parse(&text, "calm.toml").unwrap().check(&Follow::nobody()).unwrap();
    let section = calm.body.at_speed.as_ref().unwrap();
    assert_eq!((section.speed_rpm.round(), section.warning()), (12000.0, None));
    let clutch = &calm.design.clutch;
    let curve =
        WedgeCurve::build(clutch, &clutch.profile().unwrap(), 12000.0 * std::f64::consts::PI / 30.0).unwrap();
    assert!((section.end_torque_nm.unwrap() / curve.end_torque_nm() - 1.0).abs() < 1e-12);
    assert!(curve.end_torque_nm() < calm.state.curve.end_torque_nm());
    let most = 0.5 * (curve.end_torque_nm() + calm.state.curve.end_torque_nm());
    let tight = text.replace("peak_torque_nm = 110.0", &format!("peak_torque_nm = {most}"));
    assert_ne!(tight, text);
    let tight = Design::parse(&tight, "tight.toml").unwrap().check(&Follow::nobody()).unwrap();
    let warning = tight.body.at_speed.as_ref().unwrap().warning().unwrap();
    assert!(
        warning.contains("are not carried") && tight.text(Screen::default()).contains(&warning),
        "{warning}"
    );
    assert!(tight.sheet().text(Screen::default()).contains(&warning));
    // Held at that speed they say so themselves.
    let mut turning = tight.design.clone();
    turning.limits.at_speed_rad_s = Some(12000.0 * std::f64::consts::PI / 30.0);
    let turning = turning.check(&Follow::nobody()).unwrap();
    assert_eq!(turning.body.at_speed.as_ref().unwrap().warning(), None);
    let row =
        |answer: &CheckAnswer, code: &str| answer.rows.iter().find(|row| row.code() == code).unwrap().clone();
    let lost = row(&turning, "end-of-profile");
    assert!(!lost.held() && lost.overloaded() && row(&tight, "end-of-profile").held());
    assert!((lost.left().number() - (curve.end_torque_nm() / most - 1.0)).abs() < 1e-9);
    assert!(lost.full_name().contains("while it turns"), "{}", lost.full_name());
    assert_eq!(row(&turning, "slip:high-10").margin(), row(&tight, "slip:high-10").margin());
}

/// At a speed that the clutch bears, each row at a torque is that at rest or that of the curve there, whichever is worse, and rotation adds
/// Timoshenko's hoop stress of a turning ring.
#[test]
fn limits_are_held_at_the_speed_of_the_clutch() {
    let text = std::fs::read_to_string("designs/huang2017-multi-arc.toml").unwrap();
    let mut rest = Design::parse(&text, "rest.toml").unwrap();
    rest.limits.equivalent_outer_pa = Some(900e6);
    let mut turning = rest.clone();
    let speed = 6000.0 * std::f64::consts::PI / 30.0;
    turning.limits.at_speed_rad_s = Some(speed);
    let [rest, turning] = [rest, turning].map(|design| design.check(&Follow::nobody()).unwrap());
    let race = &rest.state.curve.statics().elastic.outer_race;
    let spun = race.rotating_bore_hoop_pa(speed);
    let curve =
        WedgeCurve::build(&rest.design.clutch, &rest.design.clutch.profile().unwrap(), speed).unwrap();
    let (mut spins, mut worse) = (0, 0);
    for (before, after) in rest.rows.iter().zip(&turning.rows) {
        assert_eq!(before.code(), after.code());
        assert!(after.margin() <= before.margin(), "{}", before.code());
        worse += usize::from(after.margin() < before.margin());
        if before.code() == "equivalent-outer" {
            let n = curve.at_torque(rest.design.limits.nominal_torque_nm.unwrap()).unwrap().normal_outer_n;
            let count = rest.design.clutch.sprags.count;
            // The track bears the pressure across, and along the hoop stresses of the pressure and of rotation.
            let across = -race.track_pressure_pa(count, n);
            let along = race.hoop_at_track_pa(count, n) + spun;
            let wanted = (0.5 * ((across - along).powi(2) + along * along + across * across)).sqrt();
            assert!((after.demand.value().unwrap() / wanted - 1.0).abs() < 1e-9);
            spins += 1;
        }
        if before.code() == "hoop-outer" {
            let n = curve.at_torque(rest.design.limits.peak_torque_nm.unwrap()).unwrap().normal_outer_n;
            let wanted = race.hoop_at_track_pa(rest.design.clutch.sprags.count, n) + spun;
            assert!((after.demand.value().unwrap() / wanted - 1.0).abs() < 1e-9);
            spins += 1;
        }
    }
    assert!(spins == 2 && worse >= 4 && spun > 1e6, "{spins} {worse} {spun}");
}

#[test]
fn rows_that_stay_at_rest_are_named() {
    let mut design = Design::read("designs/unlike-sprags.toml".as_ref()).unwrap();
    design.limits.at_speed_rad_s = Some(300.0);
    let said = design.check(&Follow::nobody()).unwrap().text_with_notes(Screen::default());
    assert!(
        said.contains("(at_speed_rpm)") && said.contains("; run-out-… and sprag-… at rest alone"),
        "{said}"
    );
}
