//! A result of `ccx` as rows of `stiffness`, beside those of the design's own contact law.

use crate::answer::finite_elements::FiniteElements;
use crate::cli::Context;
use crate::cli::exit::{Exit, Failure};
use crate::design::Design;
use crate::export::calculix::read;
use crate::file::{MOST_RESULT, read_text};
use std::path::Path;
use std::time::Instant;

pub(super) fn run(design: &Design, dat: &Path, torques: &[f64], context: &Context) -> Result<Exit, Failure> {
    let deck = dat.with_extension("inp");
    let text = |path: &Path, what: &str| {
        read_text(path, MOST_RESULT)
            .map_err(|e| Failure::malformed(format!("{}: {what}: {e}", path.display())))
    };
    let dat_text = text(dat, "the result to be read")?;
    let deck_text = text(&deck, "the deck of that result, looked for beside it")?;
    let started = Instant::now();
    let facts = design.deck_facts(&deck_text).map_err(|why| Failure::of(&deck, why))?;
    let reading = read(&facts, &dat_text).map_err(|e| Failure::of(dat, e))?;
    let (rows, all) = (reading.at(torques), &reading.rows);
    if !reading.is_whole() {
        context.message(&format!(
            "the last increments are missing: the result goes up to {:.4} Nm, {:.0} % of the turn that its deck asks for; ccx \
             stopped (its output says why; a coarser mesh or more increments may help) or still runs",
            all.last().map_or(0.0, |r| r.torque_nm),
            100.0 * reading.turned
        ));
    }
    for torque in torques.iter().filter(|t| !rows.iter().any(|r| r.torque_nm == **t)) {
        let (low, high) = (all.first().map_or(0.0, |r| r.torque_nm), all.last().map_or(0.0, |r| r.torque_nm));
        context.message(&format!("{torque} Nm lies outside the result, {low:.4} to {high:.4} Nm"));
    }
    if rows.is_empty() {
        return Err(Failure::malformed("the result holds none of the torques asked for"));
    }
    let answer = FiniteElements::of(design, &facts, &rows, reading.turned);
    context.deliver(&answer, started.elapsed().as_secs_f64())
}
