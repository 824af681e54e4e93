//! What an evaluation of N sprags between races that bend costs beside N of one.

use crate::scenes::{lasting, scene};
use sprag_design::clutch::Sharing;
use sprag_design::dynamics::ManyRun;
use sprag_design::scenario::Settings;
use sprag_design::sprags::Many;

/// Instructions for each evaluation and sprag: of one look at one sprag by itself, and of parts of that at N, as callgrind counts them at 12,
/// 24 and 60 (`examples/sprags_cost.rs`: 1.29, 1.31 and 1.48 times), to a twentieth.
const ONE: f64 = 4090.0;
const LOOK: f64 = 4450.0;
const PASS: f64 = 125.0;
/// Of a product with a matrix and of an inversion, by N and N^2.
const PRODUCT: f64 = 1.75;
const INVERSION: f64 = 2.5;

/// Looks, forces, products and inversions that an evaluation takes, at these prices.
#[test]
fn an_evaluation_of_many_sprags_costs_at_most_one_and_a_half_times_as_many_of_one() {
    for count in [12, 24, 60] {
        let mut scene = scene("huang2017-multi-arc", "low-6");
        scene.clutch.races.eccentricity = None;
        scene.clutch.sprags.count = count;
        lasting(&mut scene, 0.01);
        let unlike = Sharing { seed: 1, size_within_m: 1e-6, ..Sharing::default() };
        let run = |many: Many| many.run(&Settings::default(), 1e-9, 0);
        let one = run(Many::new(&scene, &Sharing::default(), false).unwrap());
        let many = run(Many::bending(&scene, &unlike).unwrap());
        assert_eq!(many.courses.len(), count);
        let each = |number: u64, run: &ManyRun| number as f64 / run.counters.rhs_evaluations as f64;
        let (n, work) = (count as f64, many.bending);
        assert!(work.solutions >= many.looks && work.passes >= work.solutions);
        let cost = LOOK * each(many.looks, &many)
            + (PASS + PRODUCT * n) * each(work.passes, &many)
            + PRODUCT * n * each(work.products, &many)
            + INVERSION * n * n * each(work.inversions, &many);
        let times = cost / (ONE * each(one.looks, &one));
        println!("{count}: {times:.3}, looks {}, {work:?}, {:?}", many.looks, many.counters);
        assert!(times < 1.5, "{count}: {times}");
    }
}
