//! What was found beside the optimum, part by part: sentences, tables, plots.

use super::relief::relief_parts;
use super::words::{Hints, gain, optima_line, price_sentence, shown};
use super::{Story, steps};
use crate::design::Objective;
use crate::optimise::{Branch, ClimbRecord, Front, Realised, Robust, Search, Status};
use crate::report::{Cell, Plot, Rows, Table, Unit, significant};

fn start_table(starts: &[ClimbRecord]) -> Table {
    Rows::of(starts)
        .text("start", "Start", |s| s.from.as_str())
        .text("ended", "Ended", |s| how_ended(&s.ended))
        .number("least_margin", "Least scaled objective", Unit::One, 6, |s| finite(s.least_margin))
        .number("violation", "Worst violation", Unit::One, 3, |s| finite(s.violation))
        .number("evaluations", "Evaluations", Unit::One, 6, |s| s.evaluations)
        .number("derivatives", "Derivatives", Unit::One, 6, |s| s.derivatives)
        .table()
}

fn how_ended(ended: &Result<Status, String>) -> String {
    ended.as_ref().map_or_else(Clone::clone, |e| e.name().to_owned())
}

fn finite(v: f64) -> Cell {
    if v.is_finite() { v.into() } else { Cell::Empty }
}

fn branch_table(branches: &[Branch]) -> Table {
    let value = |(name, value): &(String, f64)| format!("{name} = {value}");
    Rows::of(branches)
        .text("values", "Whole numbers", |b| b.values.iter().map(value).collect::<Vec<_>>().join(", "))
        .text("ended", "Ended", |b| how_ended(&b.ended))
        .number("least_margin", "Least scaled objective", Unit::One, 6, |b| finite(b.least_margin))
        .number("violation", "Worst violation", Unit::One, 3, |b| finite(b.violation))
        .number("evaluations", "Evaluations", Unit::One, 6, |b| b.evaluations)
        .table()
}

fn spread_table(made: &Robust) -> Table {
    Rows::of(&made.spreads)
        .text("code", "Margin", |s| s.code.as_str())
        .number("nominal", "As drawn", Unit::Percent, 3, |s| s.nominal)
        .number("worst", "Worst corner", Unit::Percent, 3, |s| s.worst)
        .number("p01", "1 %", Unit::Percent, 3, |s| s.percentiles[0])
        .number("p05", "5 %", Unit::Percent, 3, |s| s.percentiles[1])
        .number("p50", "50 %", Unit::Percent, 3, |s| s.percentiles[2])
        .text("worst_at", "Worst at", |s| s.worst_at.as_str())
        .table()
}

fn front_table(front: &Front) -> Table {
    let aim = |(_, a): &(usize, &Objective)| {
        let unit = if a.unit().is_empty() { String::new() } else { format!(", {}", a.unit()) };
        (a.name().to_owned(), format!("{}{unit}", a.words()))
    };
    let variable = |(_, v): &(usize, &String)| (String::clone(v), String::clone(v));
    Rows::of(&front.points)
        .each(front.aims.iter().enumerate(), aim, Unit::One, 5, |p, (i, _)| p.values.get(*i).copied())
        .each(front.variables.iter().enumerate(), variable, Unit::One, 5, |p, (i, _)| p.x.get(*i).copied())
        .text("end", "End of the front", |p| p.anchor.map_or("", Objective::words))
        .table()
}

/// One part of an answer: heading, sentences, tables with captions, plots with captions.
#[derive(Default)]
pub struct StoryPart {
    /// Heading.
    pub heading: &'static str,
    /// Sentences.
    pub lines: Vec<String>,
    /// Tables.
    pub tables: Vec<(&'static str, Table)>,
    /// Plots as SVG.
    pub plots: Vec<(String, &'static str)>,
}

impl Story {
    /// Parts of the text and of the page, in order.
    pub fn parts(&self, hints: &Hints) -> Vec<StoryPart> {
        let found = &self.found;
        let aim = found.aim;
        let mut parts = Vec::new();
        if found.starts.len() > 1 {
            let tables = vec![("Climbs, each from its own start", start_table(&found.starts))];
            let lines = vec![optima_line(&found.optima, hints)];
            parts.push(StoryPart { heading: "Starts", lines, tables, ..StoryPart::default() });
        }
        if found.branches.len() > 1 {
            let tables =
                vec![("Each whole number with a continuous search inside", branch_table(&found.branches))];
            parts.push(StoryPart { heading: "Whole numbers", tables, ..StoryPart::default() });
        }
        if !self.made().prices.is_empty() {
            let lines = self.made().prices.iter().map(|p| price_sentence(aim, p)).collect();
            parts.push(StoryPart { heading: "What holds the optimum", lines, ..StoryPart::default() });
        }
        parts.extend(self.relief.iter().flat_map(|relief| relief_parts(self, relief)));
        if let Some(realised) = &self.realised {
            parts.push(StoryPart {
                heading: "Centroid",
                lines: realised_lines(found, realised),
                ..StoryPart::default()
            });
        }
        if let Some(stepped) = &self.stepped {
            parts.push(StoryPart {
                heading: "Steps",
                lines: steps::lines(self, stepped),
                ..StoryPart::default()
            });
        }
        parts.extend(self.front.as_ref().map(front_part));
        parts.extend(self.within.as_ref().map(|made| self.made_part(made)));
        if !self.why.is_empty() {
            parts.push(StoryPart { heading: "Not done", lines: self.why.clone(), ..StoryPart::default() });
        }
        parts
    }

    fn made_part(&self, made: &Robust) -> StoryPart {
        let aim = self.found.aim;
        let (drawn, worst, [p01, p05, p50]) = made.objective;
        let mut lines = vec![format!(
            "{}: {} at the nominal values, {} at the worst of {} corners; 1 %, 5 %, 50 % of {} draws (seed {}) lie below {}, {}, {}; \
             every limit holds in {} of them",
            aim.words(),
            shown(aim, drawn),
            shown(aim, worst),
            made.corners,
            made.draws.0,
            made.seed,
            shown(aim, p01),
            shown(aim, p05),
            shown(aim, p50),
            Unit::Percent.show(made.yield_share, 3)
        )];
        if !made.not_held.is_empty() {
            lines.push(format!("the optimum is not held within the tolerances: {}", places(made)));
        }
        if !made.impossible.is_empty() {
            lines.push(format!("cannot be put together at: {}", made.impossible.join("; ")));
        }
        let mut tables = vec![("Margins of the optimum within the tolerances", spread_table(made))];
        if let Some(robust) = &self.robust {
            lines.push(format!(
                "robust design: {} at the nominal values instead of {}, and {} at the worst corner instead of {}: it gives up {} to \
                 {} ({}, {} corners as limits)",
                shown(aim, robust.made.objective.0),
                shown(aim, drawn),
                shown(aim, robust.made.objective.1),
                shown(aim, worst),
                gain(aim, (drawn - robust.made.objective.0) * aim.sense()),
                if robust.made.held() { "hold every limit at every corner" } else { "come as near as it can" },
                self.robust_status(robust).name(),
                robust.held_at.len()
            ));
            lines.extend(robust.step.map(|step| format!("its lengths are multiples of {step} mm")));
            if !robust.made.not_held.is_empty() {
                lines.push(format!(
                    "no design was found that holds every limit at every corner; of this one is not held: {}",
                    places(&robust.made)
                ));
            }
            tables.push(("Margins of the robust design", spread_table(&robust.made)));
        }
        StoryPart { heading: "Within the tolerances", lines, tables, ..StoryPart::default() }
    }
}

/// Limits that are not held, each with its worst corner.
fn places(made: &Robust) -> String {
    let place = |(code, corner): &(String, String)| format!("{code} (worst at {corner})");
    made.not_held.iter().map(place).collect::<Vec<_>>().join(", ")
}

/// Captions of a front's plots.
const TWO: &str = "Front: no design within the limits is better in both.";
/// See [`TWO`].
const THREE: &str =
    "Points of the front seen along the third objective, joined in the order of the first axis.";

fn front_part(front: &Front) -> StoryPart {
    let label = |a: &Objective| {
        let unit = if a.unit().is_empty() { "1" } else { a.unit() };
        format!("{} ({unit})", a.words())
    };
    let mut plots = Vec::new();
    for (i, j) in [(0, 1), (0, 2), (1, 2)] {
        if j < front.aims.len() {
            let mut points: Vec<[f64; 2]> = front.points.iter().map(|p| [p.values[i], p.values[j]]).collect();
            points.sort_by(|a, b| a[0].total_cmp(&b[0]));
            let plot = Plot::new(&label(&front.aims[i]), &label(&front.aims[j])).curve("front", points);
            plots.push((plot.to_figure(), if front.aims.len() == 2 { TWO } else { THREE }));
        }
    }
    let lines = vec![format!(
        "{} points in {} evaluations; {} climbs ended at a point that another beats or that is not feasible",
        front.points.len(),
        front.evaluations,
        front.beaten
    )];
    StoryPart { heading: "Front", lines, tables: vec![("Points of the front", front_table(front))], plots }
}

fn realised_lines(found: &Search, r: &Realised) -> Vec<String> {
    let aim = found.aim;
    let n = &r.nearest;
    let f = &n.flanks;
    let mm = |m: f64| significant(m * 1e3, 5);
    let at = |p: [f64; 2]| format!("({}, {}) mm", mm(p[0]), mm(p[1]));
    let held = r.assessed.rows.iter().filter(|m| !m.held()).map(|m| m.code()).collect::<Vec<_>>();
    let limits = if held.is_empty() {
        "every limit held".to_owned()
    } else {
        format!("not held: {}", held.join(", "))
    };
    let flanks = format!(
        "flanks {} mm at the rear, {} mm in front, leaning {} and {} rad",
        mm(f.rear_m),
        mm(f.front_m),
        significant(f.rear_tilt_rad, 4),
        significant(f.front_tilt_rad, 4)
    );
    let weight = format!(
        "{} g instead of {} g, {} kg m2 instead of {}",
        significant(n.mass.mass_kg * 1e3, 4),
        significant(n.given.0 * 1e3, 4),
        significant(n.mass.inertia_kg_m2, 4),
        significant(n.given.1, 4)
    );
    let mut lines = vec![format!(
        "with its centroid free and its mass given (a bound) the search came to {} {}, the centroid at {}",
        aim.words(),
        shown(aim, found.objective.1),
        at(n.wanted_m)
    )];
    lines.push(if n.reached() {
        format!("realised by {flanks}; the sprag weighs {weight}; {} there {}, {limits}", aim.words(), shown(aim, r.objective))
    } else {
        format!(
            "no two straight flanks realise it; the nearest is {}, {} mm off, by {flanks}; the sprag weighs {weight}; {} there \
             {}, {limits}",
            at(n.mass.centroid_m),
            mm(n.distance_m),
            aim.words(),
            shown(aim, r.objective)
        )
    });
    if let Some(s) = r.searched.then_some(&r.made) {
        let ended = s.outcome.status.name();
        let values: Vec<String> =
            s.variables.iter().map(|v| format!("{} {}", v.name, significant(v.best, 5))).collect();
        let verdict = if s.feasible() { "every limit held" } else { "not every limit held" };
        lines.push(format!(
            "searched on with the flanks in place of the centroid: {} {}, {verdict}, {ended} after {} evaluations: {}",
            aim.words(),
            shown(aim, s.objective.1),
            s.evaluations,
            values.join(", ")
        ));
    }
    lines
}
