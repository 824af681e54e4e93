//! An inner track out of round as made turns with its race and passes the sprags: beside statics, the round track, its energy.

use crate::scenes::{lasting, rising, scene};
use sprag_design::WedgeCurve;
use sprag_design::clutch::{Sharing, Standing, TrackWave};
use sprag_design::dynamics::Stop;
use sprag_design::scenario::Settings;
use sprag_design::sharing::{Asked, Unlike};
use sprag_design::sprags::Many;

fn lobed(lobes: usize, amplitude_m: f64) -> Sharing {
    let wave = TrackWave { outer: false, lobes, amplitude_m, azimuth_rad: 0.3 };
    Sharing { tracks: vec![wave], ..Sharing::default() }
}

/// Next to round: sums over twelve sprags, each on its own place of the track, are those of one.
#[test]
fn a_track_that_is_all_but_round_leaves_the_paper_s_model() {
    let mut scene = scene("huang2017-multi-arc", "high-10");
    lasting(&mut scene, 0.03);
    let one = Many::new(&scene, &Sharing::default(), false).unwrap().run(&Settings::default(), 1e-12, 2);
    let many = Many::new(&scene, &lobed(3, 1e-15), false).unwrap();
    assert_eq!(many.groups.len(), 12);
    let all = many.run(&Settings::default(), 1e-12, 2);
    let theta = (all.races[0] - one.races[0]).abs();
    let normal = (all.courses[5].normal_max_n / one.courses[0].normal_max_n - 1.0).abs();
    println!("{theta:.1e} rad, N {normal:.1e}");
    assert_eq!((all.stop, all.inconsistent_choices), (Stop::Finished, 0));
    assert!(theta < 1e-10 && normal < 1e-10, "{theta:e} {normal:e}");
}

/// A torque that rises by and by winds the races up, and the track passes the sprags: at every time what statics has with the track turned on so
/// far, and not what it has where the track stands.
#[test]
fn a_track_that_passes_slowly_is_shared_as_statics_shares_it() {
    let mut slow = rising(40.0);
    slow.clutch.races.eccentricity = None;
    let curve = WedgeCurve::build(&slow.clutch, &slow.clutch.profile().unwrap(), 0.0).unwrap();
    for (start, lobes) in [(Standing::Caged, 3), (Standing::Sprung, 5)] {
        let mut beside = Vec::new();
        for amplitude_m in [1.5e-6, 3e-6] {
            let sharing = Sharing { start, ..lobed(lobes, amplitude_m) };
            let many = Many::new(&slow, &sharing, false).unwrap();
            let all = many.run(&Settings::default(), 1e-9, 13);
            assert_eq!((all.stop, all.inconsistent_choices), (Stop::Finished, 0));
            let last = all.samples.last().unwrap();
            let gone_rad = all.sprags.iter().map(|sprag| sprag[1]).sum::<f64>() / 12.0;
            let turned_rad = all.races[0] - gone_rad;
            let unbent = Unlike::new(&slow.clutch, &sharing, &curve, 0.0).unbent();
            let off = |turned_rad: f64| {
                let shared = unbent.carrying(Asked::Torque(40.0), turned_rad).unwrap();
                let normal_n = |i: usize| last.normal_n[many.group[i].unwrap()];
                let each = shared.loads.iter().enumerate();
                let off = each.map(|(i, load)| (normal_n(i) / load.normal_inner_n - 1.0).abs());
                let uneven = shared.shares().iter().fold(0.0, |m: f64, s| m.max((s - 1.0).abs()));
                (off.fold(0.0, f64::max), uneven)
            };
            let ((there, uneven), (standing, _)) = (off(turned_rad), off(0.0));
            println!(
                "{start:?} {amplitude_m:e}, {turned_rad} rad: {there:.2e} of {uneven:.2e}; standing {standing:.2e}"
            );
            assert!(
                turned_rad < -0.02 && there < 0.02 * uneven && standing > 20.0 * there,
                "{there:e} {standing:e}"
            );
            beside.push(there);
        }
        // What is left is of second order.
        assert!(beside[1] < 5.0 * beside[0], "{beside:?}");
    }
}

/// Slips, lift-offs, an overrun that turns back: what went in is where it went, track and all.
#[test]
fn energy_balances_while_the_track_passes() {
    for (file, name, seconds) in
        [("huang2017-multi-arc", "high-10", Some(0.03)), ("huang2017-bench", "engagement-hard", None)]
    {
        let mut scene = scene(file, name);
        if let Some(seconds) = seconds {
            lasting(&mut scene, seconds);
        }
        scene.clutch.races.eccentricity = None;
        let round =
            Many::new(&scene, &Sharing::default(), false).unwrap().run(&Settings::default(), 1e-10, 2);
        for (lobes, amplitude_m) in [(2, 3e-6), (5, 2e-6)] {
            let many = Many::new(&scene, &lobed(lobes, amplitude_m), false).unwrap();
            let all = many.run(&Settings::default(), 1e-10, 2);
            let left = all.residual_j / all.through_j;
            let most = |run: &sprag_design::dynamics::ManyRun| {
                run.courses.iter().map(|c| c.normal_max_n).fold(0.0, f64::max)
            };
            let more = most(&all) / most(&round) - 1.0;
            println!(
                "{name} {lobes}: {:?}, energy {left:.1e}, {} changes, N {more:.3}",
                all.stop, all.events
            );
            assert_eq!(all.stop, Stop::Finished);
            assert!(left.abs() < 1e-7 && more.abs() > 1e-3, "{left:e} {more}");
        }
    }
}
