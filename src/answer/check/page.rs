//! The margin check as a page.

use super::text::beside_the_rows;
use super::{CheckAnswer, charts, is_beyond, margin_text, people_table, sections};
use crate::answer::page::{CENTRES, drawing, half, opened, pose_at_rest};
use crate::answer::{Answer, Provenance};
use crate::design::Design;
use crate::margin::Margin;
use crate::report::{Bar, Bars, Column, Page, Table, Tone, Unit, greek};

/// A page with verdict, torque capacities and the dimensioned drawing, and the remarks that come later.
pub(super) fn answered(title: &str, check: &CheckAnswer, command: &str) -> (Page, Vec<String>) {
    let design = &check.design;
    let page = opened(title, design, command, |page| {
        page.verdict(check.body.pass, &check.body.verdict());
        page.list(rated(design).into_iter().chain(check.body.capacity_lines()));
    });
    (page, check.body.other_remarks())
}

/// The torques that the clutch is held to, in a line; none where no limit names one.
fn rated(design: &Design) -> Option<String> {
    let limits = &design.limits;
    let named = [(limits.nominal_torque_nm, "nominal"), (limits.peak_torque_nm, "peak")];
    let said: Vec<String> = named
        .into_iter()
        .filter_map(|(torque_nm, name)| Some(format!("{} {name}", Unit::NewtonMetre.show(torque_nm?, 4))))
        .collect();
    (!said.is_empty()).then(|| format!("Rated torque: {}", said.join(", ")))
}

/// The page.
pub(super) fn page(check: &CheckAnswer, provenance: &Provenance) -> Page {
    let design = &check.design;
    let answer = check.envelope(provenance.run_time_s);
    let (mut page, remarks) = answered("Margin check", check, &provenance.command);
    let end_nm = check.state.curve.end_torque_nm();
    page.heading("Limits against torque");
    page.figure(
        &charts::limits(check).to_figure(),
        "Demand over allowable of every limit that depends on torque; a limit is reached at 1. Full lines: the limits that \
         set the torque capacities, named at their torque; dashed: the next required limits; dotted: shown only; grey: \
         farther away. Cut off above 1.5.",
    );
    page.heading("Margins");
    page.table(
        "Margin = allowable / demand − 1, but for the rows that the last table of this page gives another rule; held from \
         0 up. “Reached at” is the torque at which the limit would be reached (>: not before the curve ends).",
        &people_table(&check.rows, end_nm),
    );
    page.list(remarks.into_iter().chain(beside_the_rows(design, &check.rows)));
    page.apart("Margins and torque capacities as bars", |page| {
        page.figure(
            &margin_bars(&check.rows).to_figure(),
            "Margins; a bar that ends in an arrow goes on beyond the chart, grey ones are shown only.",
        );
        let capacities = capacity_bars(design, &check.rows, end_nm);
        if !capacities.bars.is_empty() {
            page.figure(
                &capacities.to_figure(),
                "Torque at which each limit would be reached; “>”: not before the curve ends.",
            );
        }
    });
    page.heading("Gripping");
    let rest = pose_at_rest("first contact, no load", design, &check.state.profile);
    let centres = drawing(design, vec![rest]).centres_figure();
    let [tangents, angles, rise] = charts::gripping(check);
    page.figures(&[
        (half(tangents), "Static demand on friction at both contacts; grip is lost where it reaches μs."),
        (half(angles), "The same as angles: ω and ν lie between the strut AB and OA, OB; friction holds up to arctan μs."),
        (half(rise), "Cam rise: the undeformed sprag's height from A to B over its rotation, and the gap AB that remains \
            under load. What lies between them is pressed in at both contacts and in the body."),
        (centres, CENTRES),
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
        sections::run_out(run_out, &mut page);
    }
    let wanted = design.limits.keep_contact_to_rad_s.map(|w| Unit::Rpm.from_si(w));
    sections::overrun(&answer.body.overrun, &mut page, answer.body.lift_off_rpm, wanted);
    page.apart("What the limits mean", |page| {
        page.table("", &names(&check.rows));
    });
    answer.close(&mut page);
    page
}

/// Each limit once; those of the scenes once for all of them.
fn names(rows: &[Margin]) -> Table {
    let mut table = Table::new(vec![
        Column::text("code", "Limit"),
        Column::text("name", "Meaning"),
        Column::text("rule", "Margin"),
    ]);
    let mut seen: Vec<String> = Vec::new();
    for r in rows {
        let code = match &r.scene {
            Some(_) => format!("{}:SCENE", r.limit.code),
            None => r.code(),
        };
        let name = r.full_name();
        let name = r.scene.as_ref().map_or(name.clone(), |scene| name.replace(scene.as_str(), "the scene"));
        if seen.contains(&code) {
            continue;
        }
        table.row(vec![code.as_str().into(), greek(&name).into(), r.limit.rule.words().into()]);
        seen.push(code);
    }
    table
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
        label: r.code(),
        value: r.shown_margin().map_or(f64::NAN, |margin| Unit::Percent.from_si(margin)),
        text: margin_text(r),
        tone: tone(r),
    };
    let lowest = rows.iter().map(Margin::margin).fold(0.0, f64::min).max(-1.5);
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
            label: r.code(),
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
