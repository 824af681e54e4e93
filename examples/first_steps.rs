//! Load a design, check it, simulate a scene with its history, search for a better one.

use sprag_design::answer::{search, simulation};
use sprag_design::{Design, Follow};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let design = Design::read("designs/huang2017-multi-arc.toml".as_ref())?;

    let check = design.check(&Follow::nobody())?;
    if let Some(least) = &check.body.deciding {
        println!("{} is decided by {}: {:+.1} %", design.name, least.name, 100.0 * least.margin);
    }

    let scene = design.simulate("low-6", &simulation::SimulationSettings::default())?;
    let slip = scene.body.slip_margin.map_or("unknown".to_owned(), |m| format!("{:.1} %", 100.0 * m));
    println!("low-6 {}, slip margin {slip}", scene.verdict().unwrap_or("undecided"));
    let history = scene.history();
    let normal_n = history.numbers("normal_inner_n").unwrap_or_default();
    let most_n = normal_n.iter().fold(0.0_f64, |most, n| most.max(*n));
    println!("{} rows, most at contact A {most_n:.0} N", normal_n.len());

    let ask =
        search::SearchSettings { starts: Some(1), evaluations: 20, ..search::SearchSettings::default() };
    let better = design.optimise(&ask)?;
    let found = &better.body;
    println!(
        "{}: {:?} -> {:?}, {} evaluations",
        found.aim, found.start.objective, found.best.objective, found.evaluations
    );
    Ok(())
}
