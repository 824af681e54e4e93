//! What `size` and `new` answer: the design, its figures, and the alternatives.

use crate::answer::check::margin_words;
use crate::cli::Context;
use crate::cli::check::{REACHED_AT, ends_first, people_table};
use crate::cli::exit::{Exit, Failure};
use crate::cli::left_out::left_out;
use crate::cli::origin::Kind;
use crate::cli::output::{TOOL, VERSION, path_text, print_json};
use crate::cli::parts::{self, Answer};
use crate::margin::{Margin, load_state};
use crate::report::{Cell, Column, Drawing, Page, Screen, SpragPose, Table, Unit};
use crate::scenario::Settings;
use crate::size::{Ask, Made, NoSize, Sized, Tried, size};
use serde_json::{Value, json};
use std::path::Path;
use std::time::Instant;

/// Compute and tell.
///
/// # Errors
/// [`Failure`].
pub fn answer(ask: &Ask, output: &Path, title: &str, context: &Context) -> Result<Exit, Failure> {
    let started = Instant::now();
    let settings = Settings { follow: context.follow.unseen(), ..Settings::default() };
    let sized = size(ask, &settings);
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
    let made = &sized.made;
    let design = &made.design;
    let written = context.outputs.write(output, Kind::Design, design.source.as_bytes());
    let written = written.then_some(output);
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
            "outside_mm": Unit::Millimetre.from_si(2.0 * design.clutch.races.outer_outside_radius_m),
            "width_mm": Unit::Millimetre.from_si(design.clutch.races.width_m),
            "mass_g": Unit::Gram.from_si(made.mass_kg),
            "drag_torque_nm": made.drag.map(|d| d.torque_nm),
            "heat_w": made.drag.map(|d| d.heat_w()),
            "sliding_rpm": made.drag.map(|d| Unit::Rpm.from_si(d.sliding_rad_s)),
            "tried": rows_of(&sized.tried, Some(sized.taken)),
            "margins": made.margins.iter().map(|r| margin_json(r, end_nm)).collect::<Vec<_>>(),
        }),
    };
    context.outputs.write_csv(&tried_table(&sized.tried, Some(sized.taken)));
    context.outputs.write_report(|| {
        let mut page = parts::page(title, design, context);
        page.verdict(true, &verdict(&sized));
        page.list(figures(made));
        if let Ok(profile) = design.clutch.profile() {
            parts::draw_sheet(&mut page, design, &profile);
        }
        page.heading("Alternatives").paragraph(
            "Every race space tried, each as short as its limits allow; the smallest ring is taken. All at one scale.",
        );
        alternatives(&mut page, &sized);
        page.table("", &tried_table(&sized.tried, Some(sized.taken)));
        page.heading("Margins").table(REACHED_AT, &people_table(&made.margins, end_nm));
        answer.close(&mut page);
        page
    });
    answer.print(context)?;
    context.answer(&text(&sized, end_nm, written, context.screen))?;
    Ok(Exit::Held)
}

/// Size, mass, drag and heat, a line each.
fn figures(made: &Made) -> Vec<String> {
    let r = &made.design.clutch.races;
    let mm = |m: f64| Unit::Millimetre.show_plain(m, 4);
    let size = format!(
        "⌀ {} outside, {} wide, {}",
        mm(2.0 * r.outer_outside_radius_m),
        mm(r.width_m),
        Unit::Gram.show_plain(made.mass_kg, 4)
    );
    let drag = made.drag.map(|d| match (d.torque_nm > 0.0, d.sliding_rad_s > 0.0) {
        (false, _) => "In overrun as asked for the sprags are off: no drag, no heat".to_owned(),
        (true, false) => format!("Drag in slow overrun {}", Unit::NewtonMetre.show(d.torque_nm, 3)),
        (true, true) => format!(
            "In overrun, sliding at {}: drag {}, heat {}",
            Unit::Rpm.show_plain(d.sliding_rad_s, 5),
            Unit::NewtonMetre.show(d.torque_nm, 3),
            Unit::Watt.show(d.heat_w(), 3)
        ),
    });
    std::iter::once(size).chain(drag).collect()
}

fn verdict(sized: &Sized) -> String {
    let s = &sized.made.design.clutch.sprags;
    let decides = sized.made.least();
    format!(
        "{} sprags of {} in a race space of {}; {}",
        s.count,
        Unit::Millimetre.show_plain(s.length_m, 4),
        Unit::Millimetre.show_plain(sized.tried[sized.taken].space_m, 4),
        decides.map_or(String::new(), |r| format!("{} decides, {}", r.code(), margin_words(r)))
    )
}

/// A small drawing of each that does it.
fn alternatives(page: &mut Page, sized: &Sized) {
    let made: Vec<(usize, &Tried, &Made)> =
        sized.tried.iter().enumerate().filter_map(|(i, t)| Some((i, t, t.made.as_ref()?))).collect();
    let widest =
        made.iter().map(|(_, _, m)| m.design.clutch.races.outer_outside_radius_m).fold(0.0, f64::max);
    let drawn = |(i, tried, made): &(usize, &Tried, &Made)| {
        let clutch = &made.design.clutch;
        let profile = clutch.profile().ok()?;
        let pose = SpragPose::at_rest("first contact", &clutch.sprags, &profile);
        let word = if *i == sized.taken { "Taken: race" } else { "Race" };
        let caption = format!(
            "{word} space {}, {} sprags; {}",
            Unit::Millimetre.show_plain(tried.space_m, 4),
            tried.count,
            figures(made).join(". ")
        );
        Some((Drawing::of(clutch, vec![pose]).small_svg(widest), caption))
    };
    let drawn: Vec<(String, String)> = made.iter().filter_map(drawn).collect();
    let figures: Vec<(String, &str)> = drawn.iter().map(|(svg, c)| (svg.clone(), c.as_str())).collect();
    page.figures(&figures);
}

fn text(sized: &Sized, end_nm: f64, written: Option<&Path>, screen: Screen) -> String {
    let design = &sized.made.design;
    format!(
        "{}  {}\n\n{}\n{}\n{}\n{}\n{REACHED_AT}\n{}\n",
        design.name,
        design.hash.get(..12).unwrap_or(&design.hash),
        tried_table(&sized.tried, Some(sized.taken)).to_text(screen),
        people_table(&sized.made.margins, end_nm).to_text(screen),
        verdict(sized),
        figures(&sized.made).join("\n"),
        written.map_or("no design written".to_owned(), |path| format!("written to {}", path_text(path)))
    )
}

fn tried_table(tried: &[Tried], taken: Option<usize>) -> Table {
    let mut table = Table::new(vec![
        Column::number("race_space_mm", "Race space", Unit::Millimetre, 4),
        Column::number("count", "Sprags", Unit::One, 3),
        Column::number("length_mm", "Length", Unit::Millimetre, 4),
        Column::number("outside_mm", "⌀", Unit::Millimetre, 4),
        Column::number("mass_g", "Mass", Unit::Gram, 4),
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
        let of = |value: fn(&Made) -> f64| t.made.as_ref().map_or(Cell::Empty, |made| Cell::Si(value(made)));
        table.row(vec![
            t.space_m.into(),
            t.count.into(),
            // Of what finds no room there is no length.
            if t.carries_nm > 0.0 { t.length_m.into() } else { Cell::Empty },
            of(|made| 2.0 * made.design.clutch.races.outer_outside_radius_m),
            of(|made| made.mass_kg),
            if t.carries_nm > 0.0 { t.carries_nm.into() } else { Cell::Empty },
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
            let of = |value: fn(&Made) -> f64| t.made.as_ref().map(value);
            json!({
                "race_space_mm": Unit::Millimetre.from_si(t.space_m), "count": t.count,
                "length_mm": Unit::Millimetre.from_si(t.length_m), "carries_nm": t.carries_nm,
                "outside_mm": of(|m| 2e3 * m.design.clutch.races.outer_outside_radius_m),
                "width_mm": of(|m| 1e3 * m.design.clutch.races.width_m), "mass_g": of(|m| 1e3 * m.mass_kg),
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
