//! The optimiser on problems with known optima: one table of problems, one harness, and the ways a run can end.

mod clutch;
mod ends;
mod goals;
mod made;
mod prices;
mod problems;
mod slopes;
mod unreached;

use sprag_design::optimise::{Outcome, SearchRun, Settings, Status, maximise_least_margin};

use problems::{Model, all};

/// Runs `model` with default settings.
fn run(model: &Model) -> Outcome {
    maximise_least_margin(
        model,
        &model.start,
        &model.lo,
        &model.hi,
        &Settings::default(),
        SearchRun::default(),
    )
    .expect("well posed")
}

/// Value within 1e-6 of the literature's, limits held to 1e-8, status and evaluation count.
#[test]
fn known_optima_are_met_within_the_stated_number_of_evaluations() {
    let mut faults = Vec::new();
    for model in all() {
        let found = run(&model);
        let t = found.evaluation.least_margin();
        let error = (t - model.optimum) / model.optimum.abs().max(1.0);
        println!(
            "{:28} {:3} evaluations (<= {:3}), {:2} steps, t = {:.9} (error {:+.1e}), violation {:.1e}, kkt {:.1e}, {:?}",
            model.name,
            found.evaluations,
            model.evaluations,
            found.history.len(),
            t,
            error,
            found.evaluation.violation(),
            found.residuals.kkt,
            found.status
        );
        let met = error.abs() <= 1e-6
            && found.evaluation.violation() <= 1e-8
            && found.status == Status::Converged
            && found.evaluations <= model.evaluations
            && found.evaluations == found.journal.entries().len();
        if !met {
            faults.push(model.name);
        }
    }
    assert!(faults.is_empty(), "{faults:?}");
}
