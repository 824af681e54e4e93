//! A design as a unit for co-simulation: where its library is, where the unit goes.

use super::ExportArgs;
use crate::cli::Context;
use crate::cli::context::timed;
use crate::cli::exit::{Exit, Failure};
use crate::cli::origin::FileKind;
use crate::design::Design;
use crate::element::NoElement;
use crate::export::fmu::{Fmi, NoUnit, inertias_beyond};
use crate::margin::NoMargins;
use crate::scenario::NoScenario;
use std::env::consts::{DLL_PREFIX, DLL_SUFFIX};
use std::path::{Path, PathBuf};

pub(super) fn run(design: &Design, args: &ExportArgs, context: &Context) -> Result<Exit, Failure> {
    if context.outputs.csv.is_some() || context.outputs.report.is_some() {
        return Err(Failure::malformed(
            "--csv and --report have no meaning here: a page comes with check --report",
        ));
    }
    let Some(path) = &args.output else {
        return Err(Failure::malformed("-o is needed: a co-simulation unit is no text (-o clutch.fmu)"));
    };
    let train = inertias_beyond(design);
    if !train.is_empty() && !args.clutch_alone {
        return Err(Failure::malformed(format!(
            "{}: [[drivetrain]] ({}): a unit holds the clutch between its two flanges and no shafts; --clutch-alone leaves them out, for \
             the other program to have them (rigid entries too: add their inertia to [races] or there); with them here, `simulate`",
            args.file.display(),
            train.join(", ")
        )));
    }
    let named = library_path(args.library.as_deref());
    let library = library(&named)?;
    let (unit, run_time_s) = timed(|| {
        design.co_simulation_unit(args.fmi.unwrap_or(Fmi::Two), &library, &|path| std::fs::read(path))
    });
    let unit = unit.map_err(|why| match why {
        NoUnit::NoStart(NoElement::NoStart(NoScenario::Profile(e))) => {
            Failure::no_clutch(&args.file, &NoMargins::Profile(e))
        }
        NoUnit::NoStart(NoElement::NoStart(NoScenario::Curve(e))) => {
            Failure::no_clutch(&args.file, &NoMargins::Curve(e))
        }
        NoUnit::NoStart(e) => Failure::NoClutch(format!("{}: {e}", args.file.display())),
        NoUnit::Library => no_library(&named, &why.to_string()),
        NoUnit::Platform => Failure::malformed(why.to_string()),
        NoUnit::History(history, e) => Failure::of(&history, e),
        NoUnit::Archive(e) => Failure::Failed(format!("{}: {e}", path.display())),
    })?;
    let written = context.outputs.write(path, FileKind::Unit, &unit.archive.bytes);
    context.print(&unit.envelope(run_time_s, written.then(|| path.display().to_string())))?;
    if written {
        context.message(&format!("{}: {}", path.display(), unit.words()));
    }
    Ok(Exit::Held)
}

/// The library's name as a file.
fn library_file() -> String {
    format!("{DLL_PREFIX}sprag_design_fmu{DLL_SUFFIX}")
}

/// Where the library is: as named, or beside this program.
fn library_path(named: Option<&Path>) -> PathBuf {
    let file = library_file();
    let beside = || Some(std::env::current_exe().ok()?.parent()?.join(&file));
    named.map(PathBuf::from).or_else(beside).unwrap_or_else(|| PathBuf::from(&file))
}

fn library(path: &Path) -> Result<Vec<u8>, Failure> {
    std::fs::read(path).map_err(|e| match e.kind() {
        std::io::ErrorKind::NotFound => no_library(path, "found no such file"),
        _ => no_library(path, &e.to_string()),
    })
}

fn no_library(path: &Path, found: &str) -> Failure {
    Failure::malformed(format!(
        "{}: the library of a co-simulation unit: {found}; the release archive has it, Python's wheel has not. In the source of version {} it \
         is built by `fmu/build.sh`, which needs Rust's cargo; then add `--library target/release/{}`, or put that file beside this program",
        path.display(),
        env!("CARGO_PKG_VERSION"),
        library_file()
    ))
}
