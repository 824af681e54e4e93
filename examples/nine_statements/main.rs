//! The paper's nine statements on slip, how far what it does not give can move before one flips, and its other claims.
//!
//! `cargo run --release --example nine_statements` writes reports/nine-statements.html (some 4 min on two cores).

mod cells;
mod claims;
mod flips;
mod statement;
mod thresholds;

use std::error::Error;

use sprag_design::design::Design;
use sprag_design::report::{Page, PageHead};

const OUT: &str = "reports/nine-statements.html";

fn main() -> Result<(), Box<dyn Error + Send + Sync>> {
    let multi = Design::read("designs/huang2017-multi-arc.toml".as_ref())?;
    let bench = Design::read("designs/huang2017-bench.toml".as_ref())?;
    let mut page = Page::new(PageHead {
        title: "The paper's nine statements on slip".into(),
        tool: env!("CARGO_PKG_NAME").into(),
        version: env!("CARGO_PKG_VERSION").into(),
        command: "cargo run --release --example nine_statements".into(),
        design: format!("{}; {}", multi.name, bench.name),
        design_hash: format!("{}; {}", multi.hash, bench.hash),
    });
    cells::write(&mut page, &cells::run_all(&multi)?);
    let unknowns: Vec<_> = if std::env::args().count() > 1 { thresholds::UNKNOWNS[..1].iter().collect() } else { thresholds::UNKNOWNS.iter().collect() };
    flips::write(&mut page, &multi, &unknowns)?;
    claims::write(&mut page, &multi, &bench)?;
    std::fs::write(OUT, page.to_html())?;
    println!("{OUT}");
    Ok(())
}
