//! A design as a unit for co-simulation: description, library, design file in one archive.

use super::{ExportArgs, FmiName};
use crate::answer::Envelope;
use crate::answer::left_out::LeftOut;
use crate::cli::Context;
use crate::cli::exit::{Exit, Failure};
use crate::cli::origin::FileKind;
use crate::cli::output::{TOOL, VERSION};
use crate::design::{Design, inputs};
use crate::element::{Beginning, Element, NoElement, Settings};
use crate::export::fmu::{Fmi, MARK, MODEL, description, variables};
use crate::margin::NoMargins;
use crate::scenario::NoScenario;
use rawzip::{CompressionMethod, ZipArchiveWriter};
use serde_json::json;
use std::env::consts::{ARCH, DLL_PREFIX, DLL_SUFFIX, OS};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Level of compression, 0 to 10: a second for the library.
const LEVEL: u8 = 7;

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
    let started = Instant::now();
    // What cannot begin at rest without load is no element anywhere.
    match Element::new(&design.clutch, &Beginning::default(), &Settings::default()) {
        Err(NoElement::NoStart(NoScenario::Profile(e))) => {
            return Err(Failure::no_clutch(&args.file, &NoMargins::Profile(e)));
        }
        Err(NoElement::NoStart(NoScenario::Curve(e))) => {
            return Err(Failure::no_clutch(&args.file, &NoMargins::Curve(e)));
        }
        Err(e) => return Err(Failure::NoClutch(format!("{}: {e}", args.file.display()))),
        Ok(_) => {}
    }
    let library = library(args.library.as_deref())?;
    let fmi = match args.fmi.unwrap_or(FmiName::Two) {
        FmiName::Two => Fmi::Two,
        FmiName::Three => Fmi::Three,
    };
    let platform = platform(fmi)?;
    let inside = format!("binaries/{platform}/{MODEL}{DLL_SUFFIX}");
    let mut files = vec![("modelDescription.xml".to_owned(), description(design, fmi).into_bytes(), false)];
    files.push((inside, library, true));
    files.push(("resources/design.toml".to_owned(), design.source.clone().into_bytes(), true));
    for history in &design.histories {
        let text = std::fs::read(history).map_err(|e| Failure::of(history, e))?;
        let name = history.strip_prefix(&design.folder).unwrap_or(history);
        let parts: Vec<_> = name.components().map(|c| c.as_os_str().to_string_lossy().into_owned()).collect();
        files.push((format!("resources/{}", parts.join("/")), text, true));
    }
    let bytes = packed(&files).map_err(|e| Failure::Failed(format!("{}: {e}", path.display())))?;
    let count = variables(design).len();
    let written = context.outputs.write(path, FileKind::Unit, &bytes);
    let version = if fmi == Fmi::Two { "2.0" } else { "3.0" };
    let answer = Envelope {
        design,
        run_time_s: started.elapsed().as_secs_f64(),
        left_out: left_out(&train),
        error_estimate: None,
        body: json!({
            "format": "fmu",
            "fmi": version,
            "platform": platform,
            "written": written.then(|| path.display().to_string()),
            "bytes": bytes.len(),
            "variables": count,
        }),
    };
    context.print(&answer)?;
    if written {
        context.message(&format!(
            "{}: FMI {version} co-simulation, {platform}, {count} variables, {:.1} MB",
            path.display(),
            bytes.len() as f64 * 1e-6
        ));
    }
    Ok(Exit::Held)
}

/// The library, from where it was named or beside this program.
fn library(named: Option<&Path>) -> Result<Vec<u8>, Failure> {
    let file = format!("{DLL_PREFIX}sprag_design_fmu{DLL_SUFFIX}");
    let beside = || Some(std::env::current_exe().ok()?.parent()?.join(&file));
    let path = named.map(PathBuf::from).or_else(beside).unwrap_or_else(|| PathBuf::from(&file));
    let help = "build it by fmu/build.sh of the source of this version, and name it by --library or put it beside this program";
    let refuse = |found: String| {
        Failure::malformed(format!(
            "{}: the library of a co-simulation unit: {found}; {help}",
            path.display()
        ))
    };
    let bytes = std::fs::read(&path).map_err(|e| match e.kind() {
        std::io::ErrorKind::NotFound => refuse("found no such file".to_owned()),
        _ => refuse(e.to_string()),
    })?;
    let has = |words: &str| bytes.windows(words.len()).any(|w| w == words.as_bytes());
    if has(MARK) { Ok(bytes) } else { Err(refuse(format!("found no library of {TOOL} {VERSION}"))) }
}

/// The folder of this platform.
fn platform(fmi: Fmi) -> Result<String, Failure> {
    let names = [
        ("linux", "x86_64", "linux64", "x86_64-linux"),
        ("linux", "aarch64", "aarch64-linux", "aarch64-linux"),
        ("windows", "x86_64", "win64", "x86_64-windows"),
        ("macos", "x86_64", "darwin64", "x86_64-darwin"),
        ("macos", "aarch64", "darwin64", "aarch64-darwin"),
    ];
    let found = names.iter().find(|(os, arch, ..)| (*os, *arch) == (OS, ARCH));
    found.map(|(_, _, two, three)| (if fmi == Fmi::Two { two } else { three }).to_string()).ok_or_else(|| {
        Failure::malformed(format!("co-simulation units have no name for this platform ({OS}, {ARCH})"))
    })
}

/// An archive of files: name, content, whether it is to be compressed. Without times: the same files, the same bytes.
fn packed(files: &[(String, Vec<u8>, bool)]) -> Result<Vec<u8>, Box<dyn std::error::Error>> {
    let mut archive = ZipArchiveWriter::new(Vec::new());
    for (name, bytes, compress) in files {
        let method = if *compress { CompressionMethod::DEFLATE } else { CompressionMethod::STORE };
        let (mut entry, config) = archive.new_file(name.as_str()).compression_method(method).start()?;
        // Counts and sums up what is packed, wherever it goes.
        let mut plain = config.wrap(std::io::sink());
        plain.write_all(bytes)?;
        let (_, descriptor) = plain.finish()?;
        if *compress {
            entry.write_all(&miniz_oxide::deflate::compress_to_vec(bytes, LEVEL))?;
        } else {
            entry.write_all(bytes)?;
        }
        entry.finish(descriptor)?;
    }
    Ok(archive.finish()?)
}

/// Names of the design's `[[drivetrain]]`.
fn inertias_beyond(design: &Design) -> Vec<String> {
    let all = inputs(&design.source).into_iter();
    let named = all.filter_map(|input| {
        let entry = input.path.strip_prefix("drivetrain[")?;
        Some(entry.split_once(']')?.0.to_owned())
    });
    let mut names: Vec<String> = named.collect();
    names.dedup();
    names
}

fn left_out(train: &[String]) -> Vec<LeftOut> {
    let mut all = vec![LeftOut::new(
        "growth of the races with their speed",
        "it stays that of start.speed; the centrifugal force on the sprags follows the motion",
        "2 um at the outer track from rest to 20 000 rpm (clutch of Table 1)",
    )];
    if !train.is_empty() {
        all.push(LeftOut::new(
            "drivetrain",
            &format!("left out as asked: {}", train.join(", ")),
            "everything that they do, until the other program has them at the flanges",
        ));
    }
    all
}
