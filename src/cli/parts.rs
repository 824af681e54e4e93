//! What the commands share that read a design: the file with what `--set` sets, and the refusal of what is no clutch.

use super::Context;
use super::exit::{Exit, Failure};
use crate::design::Design;
use crate::margin::NoMargins;
use crate::wedge::{NoCurve, NoElastic};
use std::path::{Path, PathBuf};

/// The checked design in `path`, with what `--set` sets.
///
/// # Errors
/// [`Failure::Malformed`] with every fault of the file, or where an output is one of its histories.
pub fn read_design(path: &Path, context: &Context) -> Result<Design, Failure> {
    let design = Design::read_with(path, &context.set)
        .map_err(|refused| Failure::Malformed(miette::Report::new(refused)))?;
    let histories = design.histories.iter().map(PathBuf::as_path);
    let read: Vec<&Path> = std::iter::once(path).chain(histories).collect();
    context.outputs.check(&read, &[])?;
    context.outputs.refuse_foreign()?;
    Ok(design)
}

/// The refusal of a clutch that has no curve: file, reason, and the keys that decide it.
pub fn no_clutch(file: &Path, why: &NoMargins) -> Failure {
    let keys = match why {
        NoMargins::Outline(_) => "sprags.flanks, sprags.inner_arcs",
        NoMargins::Curve(NoCurve::NoElastic(NoElastic::Race(_))) => "races, material",
        NoMargins::Curve(NoCurve::NoElastic(NoElastic::ThinRace { .. })) => {
            "races.inner_bore_radius_mm with races.inner_radius_mm, races.outer_outside_radius_mm with races.outer_radius_mm"
        }
        NoMargins::Curve(NoCurve::NoElastic(NoElastic::Contact(_))) => "contact, material, sprags.length_mm",
        NoMargins::Curve(NoCurve::NoConvergence) => {
            "contact, material, sprags.length_mm, sprags.inner_arcs, races"
        }
        NoMargins::Profile(_) | NoMargins::Curve(NoCurve::NoFirstContact) => {
            "sprags.outer_radius_mm, sprags.centre_distance_mm, sprags.inner_arcs, races.inner_radius_mm, \
             races.outer_radius_mm"
        }
    };
    Failure::NoClutch(format!("{}: {why}; keys that decide it: {keys}", file.display()))
}

/// The answers to `files` one after another; the worst exit code of all. A table or page is of one file. One that fails does not
/// keep the others from being answered.
///
/// # Errors
/// The first [`Failure`], after the answers of all.
pub fn each(
    files: &[PathBuf],
    context: &Context,
    mut one: impl FnMut(&Path) -> Result<Exit, Failure>,
) -> Result<Exit, Failure> {
    if files.len() > 1 && (context.outputs.csv.is_some() || context.outputs.report.is_some()) {
        return Err(Failure::malformed(
            "--csv and --report are of one FILE; `compare` puts several designs side by side on one page",
        ));
    }
    let (mut worst, mut failed) = (Exit::Held, None);
    for (k, file) in files.iter().enumerate() {
        if k > 0 {
            context.answer("\n")?;
        }
        match one(file) {
            Ok(exit) => worst = if exit.code() > worst.code() { exit } else { worst },
            Err(Failure::Interrupted) => return Err(Failure::Interrupted),
            Err(why) => failed = failed.or(Some(why)),
        }
    }
    failed.map_or(Ok(worst), Err)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clutch_without_a_curve_is_told_with_file_and_keys() {
        let why = NoMargins::Curve(NoCurve::NoConvergence);
        let text = no_clutch(Path::new("a.toml"), &why).to_json()["message"].to_string();
        for word in ["a.toml", "did not converge", "contact, material", "sprags.inner_arcs"] {
            assert!(text.contains(word), "{text}");
        }
    }
}
