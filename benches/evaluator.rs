//! What one evaluation of a design costs, piece by piece. `cargo bench` prints times; the counts of right-hand
//! sides and steps printed first do not depend on the machine, so compare those across machines and versions.

use divan::{Bencher, black_box};
use sprag_design::clutch::StressState;
use sprag_design::dynamics::{Grip, Mode, Place, PublishedSettings, RunSettings, published, run};
use sprag_design::scenario::{Prepared, demand, prepare};
use sprag_design::{ContactLaw, Design, Settings, WedgeCurve, simulate};
use std::time::Instant;

const SOURCE: &str = include_str!("../designs/huang2017-multi-arc.toml");

fn design() -> Design {
    Design::parse(SOURCE, "huang2017-multi-arc.toml").expect("a design of this repository")
}

fn prepared(scenario: &str) -> Prepared {
    prepare(design().scenario(scenario).expect("a scenario of that design")).expect("a start")
}

fn main() {
    let settings = Settings::default();
    for name in ["low-10", "rated-45", "rated-45-at-speed"] {
        let d = demand(&prepared(name), &settings);
        println!("demand of {name}: {} right-hand sides", d.rhs_evaluations);
    }
    for name in ["low-10", "high-10"] {
        let design = design();
        let s = simulate(design.scenario(name).expect("scenario"), &settings).expect("a start");
        println!(
            "simulate {name}: {} right-hand sides, {} steps, {} changes of mode, {:.1} right-hand sides per step",
            s.rhs_evaluations,
            s.steps,
            s.events,
            s.rhs_evaluations as f64 / s.steps as f64
        );
    }
    beside_the_published_scheme();
    divan::main();
}

/// One run of high-10 with the steps that the default tolerance begins with, against one of the published scheme at
/// its own step; medians of 15, in turn.
fn beside_the_published_scheme() {
    let p = prepared("high-10");
    let at = |tolerance: f64| RunSettings {
        tolerance,
        duration_s: p.duration_s,
        longest_step_s: p.period_s.expect("excited") / 4.0,
        most_events: 1_000,
        most_steps: 100_000,
        ..RunSettings::default()
    };
    let scheme = PublishedSettings { duration_s: p.duration_s, step_s: 1e-5, band_m_s: 1e-4, samples: 0 };
    let [mut ours, mut theirs] = [Vec::new(), Vec::new()];
    for _ in 0..15 {
        let start = Instant::now();
        black_box(run(&p.model, p.state, p.mode, &at(1e-4)));
        ours.push(start.elapsed().as_secs_f64());
        let start = Instant::now();
        black_box(published(&p.model, p.state, &scheme, &mut |_| true));
        theirs.push(start.elapsed().as_secs_f64());
    }
    for times in [&mut ours, &mut theirs] {
        times.sort_by(f64::total_cmp);
    }
    let theta = |tolerance: f64| run(&p.model, p.state, p.mode, &at(tolerance)).state[2];
    println!(
        "high-10, one run: {:.2} ms, theta_bi off by {:.1e} rad; published {:.2} ms: {:.1} times",
        ours[7] * 1e3,
        (theta(1e-4) - theta(1e-12)).abs(),
        theirs[7] * 1e3,
        theirs[7] / ours[7]
    );
}

/// The wedge curve of the multi-arc clutch; every evaluation of the optimiser builds two or three.
#[divan::bench(args = [0.0, 12_000.0])]
fn build_curve(bencher: Bencher, rpm: f64) {
    let design = design();
    let profile = design.clutch.profile().expect("profile");
    let speed = rpm * std::f64::consts::PI / 30.0;
    bencher.bench(|| WedgeCurve::build(black_box(&design.clutch), &profile, speed));
}

/// The same for the laws that know the radius; the slice law's table of ratios is built once and kept.
#[divan::bench(args = ["hertz", "elastic", "slice"])]
fn build_curve_that_knows_the_radius(bencher: Bencher, law: &str) {
    let mut clutch = design().clutch;
    clutch.contact = match law {
        "hertz" => ContactLaw::Hertz,
        "elastic" => ContactLaw::Elastic { state: StressState::Layer },
        _ => ContactLaw::Slice { coefficient: 3.944e-5 },
    };
    let profile = clutch.profile().expect("profile");
    bencher.bench(|| WedgeCurve::build(black_box(&clutch), &profile, 0.0));
}

/// One reading of the curve on each arc.
#[divan::bench(args = [0, 1, 2])]
fn in_arc(bencher: Bencher, arc: usize) {
    let curve = prepared("rated-45").model.curve;
    let from = if arc == 0 { 0.0 } else { curve.arc_end_rad(arc - 1) };
    let alpha = 0.5 * (from + curve.arc_end_rad(arc));
    bencher.bench(|| curve.in_arc(black_box(arc), black_box(alpha)));
}

/// One right-hand side: accelerations and contact forces, both contacts rolling or both slipping.
#[divan::bench(args = [true, false])]
fn forces(bencher: Bencher, sticks: bool) {
    let p = prepared("rated-45");
    let (inner, outer) =
        if sticks { (Grip::Stick, Grip::Stick) } else { (Grip::Slip(1.0), Grip::Slip(-1.0)) };
    let mode = Mode { place: Place::Arc(2), inner, outer };
    bencher.bench(|| p.model.forces(black_box(&mode), 0.0, black_box(&p.state)));
}

/// What one scenario costs in the optimiser.
#[divan::bench(args = ["rated-45", "rated-45-at-speed"])]
fn rolling_demand(bencher: Bencher, scenario: &str) {
    let p = prepared(scenario);
    let settings = Settings::default();
    bencher.bench(|| demand(black_box(&p), &settings));
}

/// A whole answer with its error estimate: slipping and rolling run, each at two tolerances.
#[divan::bench]
fn simulate_high_10(bencher: Bencher) {
    let design = design();
    let scene = design.scenario("high-10").expect("scenario");
    let settings = Settings::default();
    bencher.bench(|| simulate(black_box(scene), &settings));
}
