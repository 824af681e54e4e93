//! A search and its files: text, JSON, page.

use super::{Hints, SearchAnswer, SearchBody, Story};
use crate::answer::check::{Capacity, margin_words};
use crate::answer::page::{begun, draw, draw_sheet, drawing, pose_at_rest};
use crate::answer::{Answer, ByAlphabet, Envelope, Finding, Provenance};
use crate::design::Design;
use crate::file::shown;
use crate::margin::{Capacities, Margin, When, static_margins};
use crate::optimise::{Iteration, Status};
use crate::report::{Curve, Dash, Page, Plot, Screen, Table, Unit, significant};
use crate::wedge::WedgeCurve;
use serde::Serialize;
use serde_json::json;

/// A search and where its design went.
#[derive(Debug, Clone)]
pub struct SearchReport<'a> {
    /// The design searched from.
    pub design: &'a Design,
    /// Everything found.
    pub answer: &'a SearchAnswer,
    /// Where the new design was written, if it was.
    pub written: Option<String>,
    /// Further designs written beside it.
    pub beside: Vec<String>,
    /// The journal, where it was kept.
    pub journal: Option<String>,
    /// What its reader can do about an end.
    pub hints: Hints,
}

/// Keys of `optimize`.
#[derive(Debug, Clone, Serialize)]
pub struct SearchReportBody<'a> {
    /// Everything found.
    #[serde(flatten)]
    pub found: &'a SearchBody,
    /// Where the new design was written, if it was.
    pub written_to: Option<&'a str>,
    /// Further designs written beside it.
    pub written_beside: &'a [String],
    /// The journal, where it was kept.
    pub journal: Option<&'a str>,
}

impl SearchReport<'_> {
    fn story(&self) -> &Story {
        &self.answer.story
    }

    /// What decides in the answer, with its margin, and the torques that the clutch carried and carries.
    fn holds_and_carries(&self) -> String {
        let rows = self.story().margins();
        let decides = decides(rows);
        let capacities = |design: &Design| {
            let (state, rows, _) = static_margins(design, Capacities::Wanted).ok()?;
            Some(Capacity::nominal_and_peak(&rows, state.curve.end_torque_nm()))
        };
        let after = || capacities(&self.answer.design(self.design, "optimum").ok()?);
        let (before, after) = rayon::join(|| capacities(self.design), after);
        let (before, after) = (before.unwrap_or_default(), after.unwrap_or_default());
        let carried = before.into_iter().zip(after).zip(["nominal", "peak"]);
        let carried = carried.filter_map(|((before, after), kind)| {
            let after = after?;
            let before =
                before.map_or(String::new(), |c| format!("{} -> ", significant(c.torque_capacity_nm, 4)));
            let nm = Unit::NewtonMetre.show_plain(after.torque_capacity_nm, 4);
            Some(format!("carries {before}{nm} {kind} ({})", after.code))
        });
        let what = decides.into_iter().chain(carried).collect::<Vec<_>>().join("; ");
        let spare = self.story().feasible() && self.story().found.problem.reserve() == 0.0;
        format!("{what}{}", if spare { self.hints.reserve } else { "" })
    }

    /// Which of the two designs of a robust search all this is of; `None` where there is one.
    fn as_drawn(&self) -> Option<String> {
        let (within, robust) = (self.story().within.as_ref()?, self.story().robust.as_ref()?);
        let what = match within.not_held.len() {
            0 => "it holds every limit at every corner of [tolerances] too".to_owned(),
            n => format!("{n} of its limits are not held at every corner of [tolerances]"),
        };
        let whose =
            if robust.made.held() { "the robust design, which holds them all," } else { "the robust design" };
        Some(format!(
            "This is the best as drawn; {what}. Below, and in the file beside it, stands {whose} with what that costs"
        ))
    }

    /// Profiles before and after, to scale, one over the other.
    fn before_and_after(&self, page: &mut Page) {
        let Ok(after) = self.answer.design(self.design, "optimum") else { return };
        let (Ok(p), Ok(q)) = (self.design.clutch.profile(), after.clutch.profile()) else {
            return;
        };
        draw_sheet(page, &after, "The optimum");
        let poses = vec![pose_at_rest("after", &after, &q), pose_at_rest("before", self.design, &p)];
        draw(page, &drawing(&after, poses));
        let depth = |design: &Design, profile| {
            WedgeCurve::build(&design.clutch, profile, 0.0).ok().map(|curve| {
                let end = curve.end_torque_nm();
                let most = design.limits.peak_torque_nm.map_or(end, |t| t.min(end));
                (1..=120)
                    .filter_map(|i| curve.at_torque(most * f64::from(i) / 120.0))
                    .map(|s| [s.torque_nm, s.tan_omega])
                    .collect::<Vec<_>>()
            })
        };
        let mut plot = Plot::new("Torque, Nm", "tan ω, inner contact");
        // Before is dashed in every picture.
        let before = depth(self.design, &p).map(|points| Curve::new("before", points).coloured(1));
        plot.curves.extend(before.map(|curve| Curve { dash: Dash::Dashed, ..curve }));
        plot.curves.extend(depth(&after, &q).map(|points| Curve::new("after", points).coloured(0)));
        let plot = plot.level(self.design.clutch.friction.static_, "\u{3bc}s");
        page.figure(&plot.to_figure(), "Static friction demand at the inner contact.");
    }
}

/// The row that decides as `check` has it; behind it one that a search alone asks for and that leaves less.
fn decides(rows: &[Margin]) -> Option<String> {
    let least = |searched: bool| {
        rows.iter()
            .filter(|m| m.required && (m.limit.when == When::Outline) == searched && !m.is_not_reached())
            .min_by(|a, b| a.margin().total_cmp(&b.margin()))
    };
    let (asked, searched) = (least(false)?, least(true));
    let tighter = searched.filter(|m| m.margin() < asked.margin()).map_or_else(String::new, |m| {
        format!(" (nearer yet to the search: {}, {}, which `check` does not ask)", m.code(), margin_words(m))
    });
    Some(format!("{} decides, {}{tighter}", asked.code(), margin_words(asked)))
}

impl Answer for SearchReport<'_> {
    type Body<'a>
        = ByAlphabet<SearchReportBody<'a>>
    where
        Self: 'a;

    fn outcome(&self) -> Finding {
        let story = self.story();
        if story.status() == &Status::Interrupted {
            return Finding::Stopped;
        }
        Finding::of(story.feasible() && story.makeable() && story.not_robust().is_none())
    }

    fn verdict(&self) -> String {
        self.story().verdict(&self.hints)
    }

    fn table(&self) -> Table {
        self.story().csv_table()
    }

    fn text(&self, screen: Screen) -> String {
        let story = self.story();
        let mut out = format!(
            "{}\n{}\n{}\nVariables\n{}",
            self.verdict(),
            self.holds_and_carries(),
            self.as_drawn().map_or_else(String::new, |line| format!("{line}\n")),
            story.variable_table().to_text(screen)
        );
        out +=
            &story.notes_on_variables(&self.hints).iter().map(|line| format!("{line}\n")).collect::<String>();
        out += &format!("\nMargins\n{}", story.margin_table().to_text(screen));
        out += &format!(
            "\nInfluence at the start: change of these margins over the whole range of a variable (of all: --report)\n{}",
            story.deciding_influence().to_text(screen)
        );
        out += &format!("\nActive: {}\n", story.active().join(", "));
        for part in story.parts(&self.hints) {
            out += &format!("\n{}\n", part.heading);
            out += &part.lines.iter().map(|l| format!("- {l}\n")).collect::<String>();
            for (caption, table) in &part.tables {
                out += &format!("{caption}\n{}", table.to_text(screen));
            }
        }
        out += &format!("{}\n", story.in_full());
        out += &match &self.written {
            Some(path) => format!("Written: {}\n", shown(path)),
            None if self.beside.is_empty() => "No design written.\n".to_owned(),
            None => String::new(),
        };
        let which = match (&self.written, &story.robust) {
            (None, _) => ", the nearest design; it is no answer, its first line says why",
            (Some(_), Some(_)) => ", the robust design",
            _ => "",
        };
        out += &self.beside.iter().map(|p| format!("Written: {}{which}\n", shown(p))).collect::<String>();
        out
    }

    /// That of the library, and the files.
    fn envelope(&self, run_time_s: f64) -> Envelope<'_, ByAlphabet<SearchReportBody<'_>>> {
        let found = &self.answer.body;
        Envelope {
            design: self.design,
            run_time_s,
            left_out: self.answer.left_out.clone(),
            error_estimate: Some(json!(found.objective_error)),
            body: ByAlphabet(SearchReportBody {
                found,
                written_to: self.written.as_deref(),
                written_beside: &self.beside,
                journal: self.journal.as_deref(),
            }),
        }
    }

    fn page(&self, provenance: &Provenance) -> Page {
        let story = self.story();
        let mut page = begun("Optimisation", self.design, &provenance.command);
        page.verdict(story.feasible() && story.makeable() && story.not_robust().is_none(), &self.verdict());
        page.paragraph(&self.holds_and_carries());
        if let Some(line) = self.as_drawn() {
            page.paragraph(&line);
        }
        if let Some(path) = &self.written {
            page.paragraph(&format!("New design: {path}"));
        }
        self.before_and_after(&mut page);
        page.heading("Variables").table("Before and after, with their bounds", &story.variable_table());
        story.notes_on_variables(&self.hints).iter().for_each(|line| {
            page.paragraph(line);
        });
        page.heading("Margins");
        page.table(
            "Margins before and after; those of the objective are raised, all others are limits",
            &story.margin_table(),
        );
        page.paragraph(&format!("Active at the optimum: {}.", story.active().join(", ")));
        page.paragraph(&story.in_full());
        for part in story.parts(&self.hints) {
            page.heading(part.heading);
            for line in &part.lines {
                page.paragraph(line);
            }
            for (svg, caption) in &part.plots {
                page.figure(svg, caption);
            }
            for (caption, table) in &part.tables {
                page.table(caption, table);
            }
        }
        page.heading("How it was found");
        let history = &story.found.outcome.history;
        let path = |pick: fn(&Iteration) -> f64| -> Vec<[f64; 2]> {
            // The first step is known after the first slopes; it starts where the search did.
            let start = history.first().map(|it| [0.0, pick(it)]);
            start.into_iter().chain(history.iter().map(|it| [it.evaluations as f64, pick(it)])).collect()
        };
        let plot = Plot::new("Evaluations of the clutch", "Margin")
            .curve("least scaled objective", path(|it| it.least_margin))
            .curve("worst violation of a limit", path(|it| it.violation));
        page.figure(&plot.to_figure(), "Path of the search; a violated limit is paid first.");
        page.long_table(
            "Influence at the start: change of each margin over the whole range of each variable",
            &story.influence_table(),
        );
        self.envelope(provenance.run_time_s).close(&mut page);
        page
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::margin::{Demand, limit_of};

    #[test]
    fn the_row_that_decides_is_one_of_check() {
        let row = |code: &str, left: f64, allowable: f64| {
            Margin::new(limit_of(code).unwrap(), Demand::Value(allowable - left), allowable)
        };
        let grip = row("grip-inner", 0.02, 0.11);
        let said = |room: f64| decides(&[grip.clone(), row("flank-rear-inside", room, 1.0)]).unwrap();
        let near = said(0.01);
        assert!(near.starts_with("grip-inner decides, ") && near.contains("flank-rear-inside, "), "{near}");
        let far = said(0.5);
        assert!(far.starts_with("grip-inner decides, ") && !far.contains("flank"), "{far}");
    }
}
