//! Sections of the page of `check` with plots of their own.

use super::{overrun, run_out};
use crate::answer::page::half;
use crate::report::{Curve, Page, Plot, Unit, greek};

/// What the table of overrun leaves out.
const LEFT_OUT: &str = "Speeds between two that show the same are left out: --overrun-csv has them all.";

/// Section of the page: overrun.
pub(super) fn overrun(
    section: &overrun::OverrunSection,
    page: &mut Page,
    lift_off_rpm: Option<f64>,
    wanted_rpm: Option<f64>,
) {
    let drawn_to = overrun::drawn_to_rpm(&section.named, lift_off_rpm, wanted_rpm);
    let of = |race: &'static str, value: fn(&overrun::OverrunRow) -> f64| {
        let rows = section.points.iter().filter(|p| p.race == race && p.speed_rpm <= drawn_to);
        rows.map(|p| [p.speed_rpm, value(p)]).collect::<Vec<_>>()
    };
    let marked = |mut plot: Plot| {
        for (at, label) in [(lift_off_rpm, "lift-off"), (wanted_rpm, "wanted")] {
            if let Some(at) = at {
                plot = plot.marker(at, label);
            }
        }
        half(plot)
    };
    let mut drag = Plot::new("Speed of the race that runs, rpm", "Drag torque, Nm");
    if section.outer_race_turns {
        drag = drag.curve("outer race runs", of("outer", |p| p.drag_torque_nm));
    }
    let drag = drag.curve("inner race runs", of("inner", |p| p.drag_torque_nm));
    let caged = section.cage.is_some();
    let rides_with = if caged { "inner" } else { "outer" };
    let forces = Plot::new(&format!("Speed of the {rides_with} race, rpm"), "Normal force of one sprag, N")
        .curve("at A", of(rides_with, |p| p.normal_inner_n))
        .curve("at B", of(rides_with, |p| p.normal_outer_n));
    let growth = Plot::new("Speed of the outer race, rpm", "Growth of the outer track, µm")
        .curve("growth, (7)", of("outer", |p| p.outer_race_growth_um));
    page.heading("Overrun").paragraph(&greek(&format!("{}.", section.remark())));
    if caged {
        page.paragraph(
            "The cage carries the sprags with the inner race, and they slide on the outer one. Once the cage bears \
             their centrifugal force, it tilts them about their pivots, off the outer race if the pivot lies behind the centroid. Where only the outer race runs they are at rest.",
        );
        page.figures(&[
            (marked(drag), "Drag torque of the whole clutch: friction at the outer contacts."),
            (marked(forces), "Contact forces of one sprag; 0 at A: the cage bears it; 0 at B: lifted off."),
        ]);
        page.apart("Overrun over speed as a table", |page| {
            page.table(LEFT_OUT, &section.short_table());
        });
        return;
    }
    page.paragraph(
        "The sprags ride with the outer race. Where it stands and the inner race runs they are at rest; where it runs, \
         the centrifugal force presses them in (engaging) or lifts them off the inner race (disengaging). Where \
         friction falls with speed a small swing of the sprags about the equilibrium grows, unless something damps it; \
         the races are taken to keep their speeds.",
    );
    let drag_words = "Drag torque of the whole clutch: friction at the inner contacts.";
    if !section.outer_race_turns {
        page.figures(&[(half(drag), drag_words)]);
        page.apart("Overrun over speed as a table", |page| {
            page.table(LEFT_OUT, &section.short_table());
        });
        return;
    }
    page.figures(&[
        (marked(drag), drag_words),
        (marked(forces), "Contact forces of one sprag; 0 at A: lifted off, carried by the outer race."),
    ]);
    let growth = half(growth);
    page.apart("Growth of the outer track, and overrun over speed as a table", |page| {
        page.figure(&growth, "What the outer track grows by rotation alone; it opens the gap.");
        page.table(LEFT_OUT, &section.short_table());
    });
}

/// Section of the page: load round the circumference.
pub(super) fn run_out(section: &run_out::RunOutSection, page: &mut Page) {
    page.heading("Load round the circumference");
    page.list(section.remarks());
    page.paragraph(
        "Every sprag stands in its own gap, which is widest at 0 deg; the offset also tilts the tracks against each \
         other, most at 90 and 270 deg, so that the two halves differ. All sprags have touched before the clutch \
         engages and are wound up alike. Rows run-out-* hold the worst of them to the limits.",
    );
    let mut plot = Plot::new("Azimuth from the widest gap, deg", "Normal force of a sprag over the mean")
        .level(1.0, "mean");
    for at in &section.at {
        let mut points: Vec<[f64; 2]> = at.sprags.iter().map(|s| [s.azimuth_deg, s.share]).collect();
        points.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let name = format!("{} torque, {}", at.torque, Unit::NewtonMetre.show_plain(at.torque_nm, 4));
        plot.curves.push(Curve { dots: true, ..Curve::new(&name, points) });
    }
    if !section.at.is_empty() {
        page.figures(&[(
            half(plot),
            "Load of each sprag over the mean, by where it stands; of a clutch that turns against the offset, in the \
             position with the largest share.",
        )]);
    }
}
