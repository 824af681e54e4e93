//! `size`: a first design file from what a clutch shall do.

use super::Context;
use super::check::{REACHED_AT, ends_first, people_table};
use super::exit::{Exit, Failure};
use super::left_out::left_out;
use super::origin::Kind;
use super::output::{TOOL, VERSION, path_text, print_json};
use super::parts::{self, Answer};
use crate::design::Design;
use crate::margin::{Margin, load_state};
use crate::report::{Cell, Column, Screen, Table, Unit};
use crate::scenario::Settings;
use crate::size::{Ask, NoSize, Sized, Tried, size};
use clap::Args;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::time::Instant;

const EXAMPLES: &str = "\
Examples:
  sprag-design size --bore 40 --torque 1000 --speed 3000 --safety 1.3 --friction 0.11 -o new.toml
  sprag-design check new.toml
  sprag-design optimize new.toml -o better.toml

Every race space of one family of similar sprags is tried; the smallest ring from bore to outside is taken. The file that
is written holds its limits, with a static scenario at nominal torque and a torque step up to it, and an optimize table.

Exit codes: 0 written; 1 no clutch of the family does it, with the limit that prevents it and the nearest possible.";

/// Arguments of `size`.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct SizeArgs {
    /// Bore of the inner race, diameter, mm
    #[arg(long, value_name = "MM", allow_hyphen_values = true)]
    pub bore: f64,
    /// Nominal torque, Nm
    #[arg(long, value_name = "NM", allow_hyphen_values = true)]
    pub torque: f64,
    /// Speed of the outer race up to which the sprags keep contact in overrun, rpm [0: not asked]
    #[arg(long, value_name = "RPM", default_value_t = 0.0, allow_hyphen_values = true)]
    pub speed: f64,
    /// Peak torque over nominal torque
    #[arg(long, value_name = "FACTOR", default_value_t = 1.3, allow_hyphen_values = true)]
    pub safety: f64,
    /// Static friction
    #[arg(long, value_name = "MU", default_value_t = 0.11, allow_hyphen_values = true)]
    pub friction: f64,
    /// Where to write the design file
    #[arg(long, short, value_name = "NEW.toml")]
    pub output: PathBuf,
}

/// Run the command.
///
/// # Errors
/// [`Failure`].
pub fn run(args: &SizeArgs, context: &Context) -> Result<Exit, Failure> {
    context.outputs.check(&[], &[(&args.output, Kind::Design)])?;
    context.outputs.refuse_foreign()?;
    let ask = Ask {
        bore_m: args.bore / 1e3,
        torque_nm: args.torque,
        speed_rad_s: args.speed * std::f64::consts::PI / 30.0,
        safety: args.safety,
        friction: args.friction,
    };
    let started = Instant::now();
    let settings = Settings { follow: context.follow.unseen(), ..Settings::default() };
    let sized = size(&ask, &settings);
    let run_time_s = started.elapsed().as_secs_f64();
    if context.follow.stopped() {
        return Err(Failure::Interrupted);
    }
    let sized = match sized {
        Ok(sized) => sized,
        Err(NoSize::Ask(why)) => return Err(Failure::malformed(format!("--{why}"))),
        Err(why @ NoSize::None { .. }) => {
            let NoSize::None { tried } = &why else { return Ok(Exit::NotHeld) };
            if context.json {
                print_json(
                    &json!({ "tool": TOOL, "version": VERSION, "sized": false, "why": why.to_string(), "tried": rows_of(tried, None) }),
                )?;
            }
            context.outputs.write_csv(&tried_table(tried, None));
            context.answer(&format!("{}\n{why}\n", tried_table(tried, None).to_text(context.screen)))?;
            return Ok(Exit::NotHeld);
        }
    };
    let design = &sized.design;
    let written = context.outputs.write(&args.output, Kind::Design, design.source.as_bytes());
    let written = written.then_some(args.output.as_path());
    // Of a design whose margins are known there is a curve.
    let end_nm = load_state(design).map_or(f64::INFINITY, |state| state.curve.end_torque_nm());
    let answer = Answer {
        design,
        run_time_s,
        left_out: left_out(&design.clutch),
        error_estimate: None,
        body: json!({
            "sized": true,
            "written": written.map(|path| path.display().to_string()),
            "tried": rows_of(&sized.tried, Some(sized.taken)),
            "margins": sized.margins.iter().map(|r| margin_json(r, end_nm)).collect::<Vec<_>>(),
        }),
    };
    context.outputs.write_csv(&tried_table(&sized.tried, Some(sized.taken)));
    context.outputs.write_report(|| {
        let mut page = parts::page("First design", design, context);
        page.verdict(true, &verdict(&sized));
        if let Ok(profile) = design.clutch.profile() {
            parts::draw_sheet(&mut page, design, &profile);
        }
        page.heading("Race spaces tried").table("", &tried_table(&sized.tried, Some(sized.taken)));
        page.heading("Margins").table(REACHED_AT, &people_table(&sized.margins, end_nm));
        answer.close(&mut page);
        page
    });
    answer.print(context)?;
    context.answer(&text(&sized, end_nm, written, context.screen))?;
    Ok(Exit::Held)
}

fn verdict(sized: &Sized) -> String {
    let s = &sized.design.clutch.sprags;
    let space = sized.tried[sized.taken].space_m;
    format!(
        "{} sprags of {} in a race space of {}; {} decides",
        s.count,
        Unit::Millimetre.show_plain(s.length_m, 4),
        Unit::Millimetre.show_plain(space, 4),
        sized.tried[sized.taken].decided_by
    )
}

fn text(sized: &Sized, end_nm: f64, written: Option<&Path>, screen: Screen) -> String {
    let design: &Design = &sized.design;
    format!(
        "{}  {}\n\n{}\n{}\n{}\n{REACHED_AT}\n{}\n",
        design.name,
        design.hash.get(..12).unwrap_or(&design.hash),
        tried_table(&sized.tried, Some(sized.taken)).to_text(screen),
        people_table(&sized.margins, end_nm).to_text(screen),
        verdict(sized),
        written.map_or("no design written".to_owned(), |path| format!("written to {}", path_text(path)))
    )
}

fn tried_table(tried: &[Tried], taken: Option<usize>) -> Table {
    let mut table = Table::new(vec![
        Column::number("race_space_mm", "Race space", Unit::Millimetre, 4),
        Column::number("count", "Sprags", Unit::One, 3),
        Column::number("length_mm", "Length", Unit::Millimetre, 4),
        Column::number("volume_cm3", "Volume, cm3", Unit::One, 4),
        Column::number("carries_nm", "Carries", Unit::NewtonMetre, 4),
        Column::text("decided_by", "Decided by"),
        Column::text("verdict", ""),
    ]);
    for (i, t) in tried.iter().enumerate() {
        let word = if taken == Some(i) {
            "taken"
        } else if t.held {
            "possible"
        } else {
            "NOT POSSIBLE"
        };
        table.row(vec![
            t.space_m.into(),
            t.count.into(),
            t.length_m.into(),
            if t.held { Cell::Si(1e6 * t.volume_m3) } else { Cell::Empty },
            t.carries_nm.into(),
            t.decided_by.as_str().into(),
            Cell::Verdict(t.held, word.to_owned()),
        ]);
    }
    table
}

fn rows_of(tried: &[Tried], taken: Option<usize>) -> Vec<Value> {
    tried
        .iter()
        .enumerate()
        .map(|(i, t)| {
            json!({
                "race_space_mm": Unit::Millimetre.from_si(t.space_m), "count": t.count,
                "length_mm": Unit::Millimetre.from_si(t.length_m), "carries_nm": t.carries_nm,
                "decided_by": t.decided_by, "possible": t.held, "taken": taken == Some(i),
            })
        })
        .collect()
}

fn margin_json(r: &Margin, end_nm: f64) -> Value {
    json!({
        "code": r.code(), "demand": r.demand_in_unit(), "allowable": r.shown_allowable(), "unit": r.limit.unit,
        "margin": r.margin(), "slip_margin": r.slip_margin(),
        "torque_capacity_nm": r.torque_capacity_nm, "capacity_beyond_end": ends_first(r, end_nm), "held": r.held(),
    })
}
