//! Nominal torques of a maker's series (GMN FE 8000) from its published rules and one profile, found by `identify` on a
//! third of the rows; then with the one rule set free that fails.
//!
//! `cargo run --release --example catalogue` writes reports/catalogue.html (about a minute).

mod page;
mod rows;
mod size;
mod study;
mod wider;

use std::error::Error;

use sprag_design::Follow;
use sprag_design::design::Design;
use sprag_design::identify::{FitSettings, Unknown, identify, observations};

use study::{Case, Study};

const OUT: &str = "reports/catalogue.html";
const SERIES: &str = "examples/catalogue/series.toml";
const FACTS: &str = "tests/reference/gmn_fe8000.csv";

fn main() -> Result<(), Box<dyn Error>> {
    let series = Design::read(SERIES.as_ref())?;
    let all = rows::read(&std::fs::read_to_string(FACTS)?)?;
    let unknown = |name: &str, min, max| Unknown { name: name.to_owned(), min, max };
    let profile = [
        unknown("outer_radius_mm", 4.0, 7.0),
        unknown("r_i1_mm", 1.2, 4.5),
        unknown("centre_distance_mm", 0.3, 2.4),
    ];
    let with = |more: Unknown| profile.iter().cloned().chain([more]).collect::<Vec<_>>();
    let case = |name: &'static str,
                unknowns: &[Unknown],
                every: usize,
                starts: usize|
     -> Result<Case, Box<dyn Error>> {
        let data = observations(&rows::observations(&all, every))?;
        let settings = FitSettings { starts, seed: 1, evaluations: 160 };
        let at = std::time::Instant::now();
        let found = identify(&series, &data, unknowns, &settings, &Follow::nobody())?;
        let (sums, best) = &found.sums;
        eprintln!(
            "{name}: {:.0} s, {} evaluations, {sums:.5?} {best:.5}",
            at.elapsed().as_secs_f64(),
            found.evaluations
        );
        Case::new(name, found, &all)
    };
    let study = Study {
        printed: case("rules as printed", &profile, 3, 4)?,
        best: case("rules as printed, fitted on every row", &profile, 1, 2)?,
        gap: case(
            "gap at nominal torque set free",
            &with(unknown("limits.gap_nominal_mm", 8.40, 8.60)),
            3,
            3,
        )?,
        friction: case("friction set free", &with(unknown("friction.static", 0.10, 0.15)), 3, 3)?,
        series,
        all,
    };
    std::fs::write(OUT, page::page(&study).to_html())?;
    for case in study.cases() {
        println!("{}", case.name);
        for (held, text) in case.verdicts() {
            println!("  {} {text}", if held { "held" } else { "NOT HELD" });
        }
    }
    println!("{OUT}");
    Ok(())
}
