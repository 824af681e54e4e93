//! A design as a finite-element deck.

use super::ExportArgs;
use crate::cli::exit::{Exit, Failure};
use crate::cli::origin::FileKind;
use crate::cli::{Context, output};
use crate::design::Design;
use crate::export::calculix::{Options, Variant, deck};
use crate::margin::NoMargins;
use crate::profile::Outline;

pub(super) fn run(design: &Design, args: &ExportArgs, context: &Context) -> Result<Exit, Failure> {
    if context.json || context.outputs.csv.is_some() || context.outputs.report.is_some() {
        return Err(Failure::malformed("a deck is neither JSON, table nor page: those come with --read"));
    }
    let variant = args.variant.unwrap_or(Variant::Layer);
    let text = text(design, variant, args)?;
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

fn text(design: &Design, variant: Variant, args: &ExportArgs) -> Result<String, Failure> {
    let clutch = &design.clutch;
    let torque_nm = args
        .torque
        .or(design.limits.nominal_torque_nm)
        .ok_or_else(|| Failure::malformed("--torque is needed: the design names no nominal torque"))?;
    let profile = clutch.profile().map_err(|e| Failure::no_clutch(&args.file, &NoMargins::Profile(e)))?;
    let outline = match clutch.sprags.flanks {
        Some(flanks) => Outline::closed(&profile, &flanks),
        None => Outline::narrowest(&profile),
    }
    .map_err(|e| Failure::no_clutch(&args.file, &NoMargins::Outline(e)))?;
    let usual = Options::default();
    let options = Options {
        variant,
        mesh_m: args.mesh.map_or(usual.mesh_m, |mesh_mm| 1e-3 * mesh_mm),
        torque_nm,
        friction: args.friction.unwrap_or(usual.friction),
        increments: args.increments,
        ..usual
    };
    deck(clutch, &profile, &outline, &options, &design.hash)
        .map_err(|e| Failure::malformed(format!("{}: no deck: {e}", args.file.display())))
}
