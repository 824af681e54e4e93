//! What a slice solution costs: `cargo test --release --test wedge slice_cost -- --ignored --nocapture`.

use std::time::Instant;

use sprag_design::contact::{AxialFit, EndDrop, LineContact, RollerLaw, SliceContact};

#[test]
#[ignore = "a measurement, printed"]
fn cost_of_a_slice_solution() {
    let c = LineContact::external(11.11e-3, 4.02e-3, 6e-3, 113e9).unwrap();
    let roller = RollerLaw::new(&c, 3.944e-5).unwrap();
    let wave: Vec<[f64; 2]> =
        (0..=400).map(|i| [(i as f64 / 200.0 - 1.0) * 3e-3, 1e-6 * (1.0 - (0.3 * i as f64).cos())]).collect();
    println!(
        "{:>7} {:>12} {:>12} {:>12} {:>12}   time, ms",
        "slices", "square", "Lundberg", "tilted", "wavy table"
    );
    for n in [1, 10, 20, 40, 60, 80, 160, 320, 500, 1000, 2000] {
        let slices = SliceContact::new(c, roller, n).unwrap();
        let cost = |profile: EndDrop, tilt: f64, normal_n: f64| {
            let fit = AxialFit::shaped(6e-3, profile, tilt).unwrap();
            let repeats = (2000 / n).clamp(1, 100);
            let start = Instant::now();
            for _ in 0..repeats {
                std::hint::black_box(slices.solve_along(normal_n, &fit).unwrap());
            }
            1e3 * start.elapsed().as_secs_f64() / repeats as f64
        };
        let times = [
            cost(EndDrop::Square, 0.0, 2441.0),
            cost(EndDrop::lundberg(&c, 2441.0).unwrap(), 0.0, 2441.0),
            cost(EndDrop::Square, 1e-3, 200.0),
            cost(EndDrop::table(wave.clone()).unwrap(), 0.0, 150.0),
        ];
        println!("{n:>7} {:>12.4} {:>12.4} {:>12.4} {:>12.4}", times[0], times[1], times[2], times[3]);
    }
}
