//! The paper's nine statements on slip, how far what it does not give can move before one flips, and its other claims.
//!
//! `cargo run --release --example nine_statements` writes reports/nine-statements.html (2 min on two idle cores).

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
    claims::write(&mut page, &multi, &bench)?;
    let at = std::time::Instant::now();
    flips::write(&mut page, &multi, &thresholds::UNKNOWNS)?;
    eprintln!("thresholds: {:.0} s", at.elapsed().as_secs_f64());
    omissions(&mut page);
    std::fs::write(OUT, page.to_html())?;
    println!("{OUT}");
    Ok(())
}

fn omissions(page: &mut Page) {
    page.heading("Omissions");
    page.list([
        "One unknown moves at a time: combinations may flip a statement sooner. Only mu_c with gamma_b was tried together.",
        "An island narrower than a twentieth of the range between two moves that hold is not seen.",
        "A flip is a change of the verdict. That the contact stress comes close to zero at 3.34 Nm, and that 10 Nm slips more \
         than 8 Nm, stands in the tables above and is not asked at every move.",
        "Mass, inertia and centroid of the sprag stay while e_1, r_e and the junctions move; the other assumed values \
         (centroid, length, contact law, b, damping) do not move at all.",
        "The paper's figures were read in words, not digitised: amplitudes of its curves are not compared.",
        "Contact damping, restitution, lubricant film: not in the paper's model and not here.",
    ]);
}
