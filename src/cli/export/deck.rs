//! A design as a finite-element deck.

use super::ExportArgs;
use crate::cli::exit::{Exit, Failure};
use crate::cli::origin::FileKind;
use crate::cli::{Context, output};
use crate::design::Design;
use crate::export::calculix::{NoDeck, Options, Variant};
use crate::margin::NoMargins;

pub(super) fn run(design: &Design, args: &ExportArgs, context: &Context) -> Result<Exit, Failure> {
    if context.json || context.outputs.csv.is_some() || context.outputs.report.is_some() {
        return Err(Failure::malformed("a deck is neither JSON, table nor page: those come with --read"));
    }
    let variant = args.variant.unwrap_or(Variant::Layer);
    let usual = Options::default();
    let options = Options {
        variant,
        mesh_m: args.mesh.map_or(usual.mesh_m, |mesh_mm| 1e-3 * mesh_mm),
        friction: args.friction.unwrap_or(usual.friction),
        increments: args.increments,
        ..usual
    };
    let text = design.deck(args.torque, &options).map_err(|why| match why {
        NoDeck::Profile(e) => Failure::no_clutch(&args.file, &NoMargins::Profile(e)),
        NoDeck::Outline(e) => Failure::no_clutch(&args.file, &NoMargins::Outline(e)),
        why => Failure::of(&args.file, format!("no deck: {why}{}", way_out(&why))),
    })?;
    match &args.output {
        Some(path) => {
            if context.outputs.write(path, FileKind::Deck, text.as_bytes()) {
                context.message(&format!(
                    "{}: {} variant, {:.1} MB; next: ccx -i {}",
                    path.display(),
                    variant.name(),
                    text.len() as f64 * 1e-6,
                    path.with_extension("").display()
                ));
            }
        }
        None => output::print(&text)?,
    }
    Ok(Exit::Held)
}

/// Options that lead to a deck.
fn way_out(why: &NoDeck) -> String {
    match why {
        NoDeck::BeyondCurve { .. } => "; give less with --torque".to_owned(),
        NoDeck::NoRoom { most_nm: Some(most), .. } => format!(" (--torque {most})"),
        NoDeck::NoRoom { most_nm: None, .. } => {
            "; take less torque (--torque) or a finer mesh (--mesh)".to_owned()
        }
        NoDeck::NoTorque => "; give one with --torque".to_owned(),
        _ => String::new(),
    }
}
