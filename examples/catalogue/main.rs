//! Nominal torques of a maker's series (GMN FE 8000) from its published rules and one profile, found by `identify` on a
//! third of the rows.
//!
//! `cargo run --release --example catalogue` writes reports/catalogue.html (1 min on an idle core).

mod page;
mod rows;
mod size;

use std::error::Error;

use sprag_design::design::Design;
use sprag_design::identify::{Identified, Settings, Unknown, Use, identify, observations};

use rows::Row;
use size::{Size, power_law};

const OUT: &str = "reports/catalogue.html";
const SERIES: &str = "examples/catalogue/series.toml";
const FACTS: &str = "tests/reference/gmn_fe8000.csv";

/// What the maker asks for, and what the issue asks of the prediction.
pub struct Wanted {
    pub rms: f64,
    pub worst: f64,
    pub exponent: f64,
    pub windup_deg: f64,
}
pub const WANTED: Wanted = Wanted { rms: 0.10, worst: 0.20, exponent: 0.1, windup_deg: 3.0 };

/// Everything the page shows.
pub struct Study {
    pub series: Design,
    pub all: Vec<Row>,
    pub found: Identified,
    pub sizes: Vec<Size>,
    /// Predicted torque, by size.
    pub predicted: Vec<(f64, String, Use)>,
}

impl Study {
    /// predicted/catalogue - 1 of the rows for which `keep` says so.
    pub fn off(&self, keep: impl Fn(Use) -> bool) -> Vec<f64> {
        let each = self.sizes.iter().zip(&self.predicted).filter(|(_, p)| keep(p.2));
        each.map(|(s, p)| p.0 / s.row.torque_nm - 1.0).collect()
    }

    /// Exponents of d and l: predicted, catalogue; with the scatter about the power law.
    pub fn exponents(&self) -> [(f64, f64, f64); 2] {
        let of = |torque: &dyn Fn(usize) -> f64| -> Vec<(f64, f64, f64)> {
            let each = self.sizes.iter().enumerate();
            each.map(|(i, s)| (s.row.inner_mm, s.row.length_mm, torque(i))).collect()
        };
        [power_law(&of(&|i| self.predicted[i].0)), power_law(&of(&|i| self.sizes[i].row.torque_nm))]
    }

    /// Largest tan omega of a size, at first contact or at the predicted torque, and largest windup, deg, there.
    pub fn extremes(&self) -> (f64, f64) {
        let mut worst = (0.0f64, 0.0f64);
        for (size, (torque, ..)) in self.sizes.iter().zip(&self.predicted) {
            let at = size.state.curve.at_torque(torque.max(size.row.torque_nm));
            worst.0 = worst.0.max(size.state.first_tan_omega);
            if let Some(p) = at {
                worst = (worst.0.max(p.tan_omega), worst.1.max(p.windup_rad.to_degrees()));
            }
        }
        worst
    }
}

pub fn rms(off: &[f64]) -> f64 {
    (off.iter().map(|o| o * o).sum::<f64>() / off.len() as f64).sqrt()
}

pub fn worst(off: &[f64]) -> f64 {
    off.iter().fold(0.0, |a: f64, b| a.max(b.abs()))
}

fn main() -> Result<(), Box<dyn Error>> {
    let series = Design::read(SERIES.as_ref())?;
    let all = rows::read(&std::fs::read_to_string(FACTS)?)?;
    let data = observations(&rows::observations(&all))?;
    let unknown = |name: &str, min, max| Unknown { name: name.to_owned(), min, max };
    let unknowns = [
        unknown("outer_radius_mm", 4.0, 6.6),
        unknown("r_i1_mm", 1.8, 4.5),
        unknown("centre_distance_mm", 0.3, 2.2),
    ];
    let settings = Settings { starts: 4, seed: 1, evaluations: 150 };
    let started = std::time::Instant::now();
    let found = identify(&series, &data, &unknowns, &settings, None)?;
    eprintln!("identify: {:.0} s, {} evaluations", started.elapsed().as_secs_f64(), found.evaluations);
    let (mut sizes, mut predicted) = (Vec::new(), Vec::new());
    for point in &found.points {
        let row = all.iter().find(|r| r.name == point.observation.label).ok_or("a row without a size")?;
        let said = point.predicted.clone()?;
        sizes.push(Size::new(&found.source, row)?);
        predicted.push((said.value, said.decided_by.unwrap_or_default(), point.observation.purpose));
    }
    let study = Study { series, all, found, sizes, predicted };
    std::fs::write(OUT, page::page(&study).to_html())?;
    for line in page::verdicts(&study) {
        println!("{} {}", if line.0 { "held" } else { "NOT HELD" }, line.1);
    }
    println!("{OUT}");
    Ok(())
}
