//! What `optimize` prints: text, JSON, page.

use super::Context;
use super::output::{TOOL, path_text};
use super::parts::{self, Answer};
use crate::answer::search::{Hints, SearchAnswer, Story};
use crate::design::Design;
use crate::optimise::Iteration;
use crate::report::{Curve, Dash, Page, Plot};
use crate::wedge::WedgeCurve;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// What the command's reader can do about an end.
const HINTS: Hints = Hints {
    evaluation_limit: ", which --evaluations raises,",
    more_starts: "try more --starts",
    stopped: "stopped by Ctrl-C",
};

/// A search and where its design went.
pub struct Told<'a> {
    /// The design searched from.
    pub design: &'a Design,
    /// Everything found.
    pub answer: &'a SearchAnswer,
    /// Where the new design was written, if it was.
    pub written: Option<&'a Path>,
    /// Further designs written beside it.
    pub beside: Vec<PathBuf>,
    /// The journal, where it was kept.
    pub journal: Option<PathBuf>,
    /// Wall time of the search, s.
    pub run_time_s: f64,
}

impl Told<'_> {
    fn story(&self) -> &Story {
        &self.answer.story
    }

    /// The answer in the terminal.
    pub fn text(&self, context: &Context) -> String {
        let story = self.story();
        let mut out = format!(
            "{}\n\nVariables\n{}",
            story.verdict(&HINTS),
            story.variable_table().to_text(context.screen)
        );
        out += &story.moved_inside().iter().map(|line| format!("{line}\n")).collect::<String>();
        out += &format!("\nMargins\n{}", story.margin_table().to_text(context.screen));
        out += &format!(
            "\nInfluence at the start: change of each margin over the whole range of a variable\n{}",
            story.influence_table().to_text(context.screen)
        );
        out += &format!("\nActive: {}\n", story.active().join(", "));
        for part in story.parts(&HINTS) {
            out += &format!("\n{}\n", part.heading);
            out += &part.lines.iter().map(|l| format!("- {l}\n")).collect::<String>();
            for (caption, table) in &part.tables {
                out += &format!("{caption}\n{}", table.to_text(context.screen));
            }
        }
        out += &format!("{}\n", story.in_full());
        out += &match self.written {
            Some(path) => format!("Written: {}\n", path_text(path)),
            None => "No design written.\n".to_owned(),
        };
        out += &self.beside.iter().map(|p| format!("Written: {}\n", path_text(p))).collect::<String>();
        out
    }

    /// The answer for programs: that of the library, and the files.
    pub fn json(&self) -> Answer<'_, Value> {
        // Numbers that are none become null; the object holds nothing else that has no JSON form.
        let mut body = serde_json::to_value(&self.answer.body).unwrap_or_default();
        if let Some(map) = body.as_object_mut() {
            let shown = |path: &Path| path.display().to_string();
            let beside: Vec<String> = self.beside.iter().map(|p| shown(p)).collect();
            map.insert("written_to".into(), json!(self.written.map(shown)));
            map.insert("written_beside".into(), json!(beside));
            map.insert("journal".into(), json!(self.journal.as_deref().map(shown)));
        }
        Answer {
            design: self.design,
            run_time_s: self.run_time_s,
            left_out: self.answer.left_out.clone(),
            error_estimate: Some(json!(self.answer.body.objective_error)),
            body,
        }
    }

    /// The page.
    pub fn page(&self, context: &Context) -> Page {
        let story = self.story();
        let mut page = parts::page("Optimisation", self.design, context);
        page.verdict(
            story.feasible() && story.makeable() && story.not_robust().is_none(),
            &story.verdict(&HINTS),
        );
        if let Some(path) = self.written {
            page.paragraph(&format!("New design: {}", path.display()));
        }
        self.draw(&mut page);
        page.heading("Variables").table("Before and after, with their bounds", &story.variable_table());
        story.moved_inside().iter().for_each(|line| {
            page.paragraph(line);
        });
        page.heading("Margins");
        page.table(
            "Margins before and after; the slip rows are the objectives, all others are limits",
            &story.margin_table(),
        );
        page.paragraph(&format!("Active at the optimum: {}.", story.active().join(", ")));
        page.paragraph(&story.in_full());
        for part in story.parts(&HINTS) {
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
            history.iter().map(|it| [it.evaluations as f64, pick(it)]).collect()
        };
        let plot = Plot::new("Evaluations of the clutch", "Margin")
            .curve("least scaled objective", path(|it| it.least_margin))
            .curve("worst violation of a limit", path(|it| it.violation));
        page.figure(&plot.to_svg(), "Path of the search; a violated limit is paid first.");
        page.table(
            "Influence at the start: change of each margin over the whole range of each variable",
            &story.influence_table(),
        );
        self.json().close(&mut page);
        page
    }

    /// Profiles before and after, to scale, one over the other.
    fn draw(&self, page: &mut Page) {
        let Ok(after) = self.answer.design(self.design, "optimum") else { return };
        let (Ok(p), Ok(q)) = (self.design.clutch.profile(), after.clutch.profile()) else {
            return;
        };
        parts::draw_sheet(page, &after, &q);
        let poses =
            vec![parts::pose_at_rest("after", &after, &q), parts::pose_at_rest("before", self.design, &p)];
        parts::draw(page, &parts::drawing(&after, poses));
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
        page.figure(&plot.to_svg(), &format!("Static friction demand at the inner contact ({TOOL})."));
    }
}
