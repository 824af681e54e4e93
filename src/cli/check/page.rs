//! The margin check as a page.

use super::body::{Body, NO_DEMAND, is_beyond, people_table, resolved};
use super::{Check, charts, margin_text, overrunning};
use crate::cli::Context;
use crate::cli::parts::{self, Answer};
use crate::design::Design;
use crate::margin::Margin;
use crate::report::{Bar, Bars, Column, Page, Table, Tone, Unit};

pub(super) fn page(design: &Design, check: &Check, answer: &Answer<'_, Body>, context: &Context) -> Page {
    let mut page = parts::page("Margin check", design, context);
    let tone = match (answer.body.pass, answer.body.shown_broken().as_slice()) {
        (true, []) => Tone::Good,
        (true, _) => Tone::Soft,
        (false, _) => Tone::Bad,
    };
    page.verdict_in(tone, &answer.body.verdict());
    page.list(answer.body.remarks().into_iter().chain(overrunning(design)));
    let end_nm = check.state.curve.end_torque_nm();
    page.heading("Margins");
    page.table(
        "Margin = allowable / demand − 1, but for the rows that the last table of this page gives another rule; held from 0 up. “Reached at” is \
         the torque at which the limit would be reached (>: not before the curve ends).",
        &people_table(&check.rows, end_nm),
    );
    page.figure(
        &margin_bars(&check.rows).to_svg(),
        "Margins; a bar that ends in an arrow goes on beyond the chart, grey ones are shown only.",
    );
    let capacities = capacity_bars(design, &check.rows, end_nm);
    if !capacities.bars.is_empty() {
        page.figure(
            &capacities.to_svg(),
            "Torque at which each limit would be reached; “>”: not before the curve ends.",
        );
    }
    page.heading("Limits against torque");
    page.figure(
        &charts::limits(design, check, &answer.body).to_svg(),
        "Demand over allowable of every limit that depends on torque; a limit is reached at 1. Full lines: the limits that \
         set the torque capacities, named at their torque; dashed: other required limits; dotted: shown only. Cut off \
         above 1.5.",
    );
    page.heading("Gripping");
    let [tangents, angles, rise] = charts::gripping(design, check);
    page.figures(&[
        (parts::half(tangents), "Static demand on friction at both contacts; grip is lost where it reaches μs."),
        (parts::half(angles), "The same as angles: ω and ν lie between the strut AB and OA, OB; friction holds up to arctan μs."),
    ]);
    page.figures(&[
        (parts::half(rise), "Cam rise: the undeformed sprag's height from A to B over its rotation, and the gap AB that remains under load. What lies between them is pressed in at both contacts and in the body."),
    ]);
    if let Some(running) = &answer.body.running {
        page.heading("Radii as made and as run");
        page.paragraph(
            "Every other figure of this page is of the radii as run: fitted, and at the temperatures of [thermal], without \
             load. A race that is joined with shaft or housing counts as one piece with it. As made: the radii of the \
             design file. To make: those with which the radii as run become the ones of the design file, enlarged as the \
             sprags are, so that the gap is right at every torque.",
        );
        page.table("", &running.table());
    }
    if let Some(run_out) = &answer.body.run_out {
        run_out.draw(&mut page);
    }
    let wanted = design.limits.keep_contact_to_rad_s.map(|w| Unit::Rpm.from_si(w));
    answer.body.overrun.draw(&mut page, answer.body.lift_off_rpm, wanted);
    parts::draw(
        &mut page,
        &parts::drawing(
            design,
            vec![parts::pose_at_rest("first contact, no load", design, &check.state.profile)],
        ),
    );
    page.heading("What the limits mean").table("", &names(&check.rows));
    answer.close(&mut page);
    page
}

fn names(rows: &[Margin]) -> Table {
    let mut table = Table::new(vec![
        Column::text("code", "Limit"),
        Column::text("name", "Meaning"),
        Column::text("rule", "Margin"),
    ]);
    for r in rows {
        table.row(vec![r.code.as_str().into(), r.name.as_str().into(), rule(&r.code).into()]);
    }
    table
}

/// How the margin of a limit is made up (`margin`).
fn rule(code: &str) -> &'static str {
    match code.split(':').next().unwrap_or(code) {
        "keep-contact" => "1 − demand / allowable; −1 where the spring closes nothing",
        "lift-off" => "allowable / demand − 1; 1 where the spring closes nothing",
        "neighbours" => "clearance over the gap between the tracks at rest",
        "contact" => "the ratio itself; −1 where the scenario does not start or end",
        "slip" => "allowable / demand − 1; −1 where no friction suffices",
        "axial-from" => "allowable / demand − 1; −1 where it is never carried",
        _ => "allowable / demand − 1",
    }
}

fn tone(r: &Margin) -> Tone {
    match (r.required, r.held()) {
        (false, _) => Tone::Soft,
        (true, true) => Tone::Good,
        (true, false) => Tone::Bad,
    }
}

fn margin_bars(rows: &[Margin]) -> Bars {
    let bar = |r: &Margin| Bar {
        label: r.code.clone(),
        value: if r.margin >= NO_DEMAND { f64::NAN } else { Unit::Percent.from_si(resolved(r.margin)) },
        text: margin_text(r.margin),
        tone: tone(r),
    };
    let lowest = rows.iter().map(|r| r.margin).fold(0.0, f64::min).max(-1.5);
    Bars {
        title: "Margins in percent".into(),
        bars: rows.iter().map(bar).collect(),
        marks: vec![(100.0, "100 %".into()), (50.0, "50 %".into()), (-50.0, "−50 %".into())],
        range: (Unit::Percent.from_si(lowest), 120.0),
    }
}

fn capacity_bars(design: &Design, rows: &[Margin], end_nm: f64) -> Bars {
    let with = rows.iter().filter_map(|r| Some((r, r.torque_capacity_nm?)));
    let bars: Vec<Bar> = with
        .map(|(r, torque)| Bar {
            label: r.code.clone(),
            value: torque,
            text: format!(
                "{}{}",
                if is_beyond(r, torque, end_nm) { "> " } else { "" },
                Unit::NewtonMetre.show(torque, 4)
            ),
            tone: tone(r),
        })
        .collect();
    let limits = &design.limits;
    let marks: Vec<(f64, String)> = [(limits.nominal_torque_nm, "nominal"), (limits.peak_torque_nm, "peak")]
        .into_iter()
        .filter_map(|(torque, name)| Some((torque?, name.to_owned())))
        .collect();
    // Far capacities (a roll-over that never comes) would press the others together.
    let asked = marks.iter().map(|m| m.0).fold(0.0, f64::max);
    let longest = bars.iter().map(|b| b.value).fold(0.0, f64::max);
    let end = if asked > 0.0 { longest.min(2.5 * asked) } else { longest };
    Bars { title: "Torque capacities in Nm".into(), bars, marks, range: (0.0, end.max(asked)) }
}
