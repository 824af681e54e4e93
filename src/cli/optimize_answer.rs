//! What `optimize` says: text, JSON, page.

use super::Context;
use super::check::{allowable_cell, demand_cell, margin_cell, margin_text, unit_cell};
use super::left_out::left_out;
use super::optimize_story::{SHOWN_DIGITS, Story, shown};
use super::output::TOOL;
use super::output::path_text;
use super::parts::{self, Answer};
use crate::design::{Design, Objective};
use crate::margin::Margin;
use crate::optimise::{Search, Status};
use crate::report::{Cell, Column, Curve, Dash, Page, Plot, Table, Unit, error_beside, significant};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// A search and where its design went.
pub struct Told<'a> {
    /// The design searched from.
    pub design: &'a Design,
    /// Everything found.
    pub story: &'a Story,
    /// The search.
    pub found: &'a Search,
    /// Where the new design was written, if it was.
    pub written: Option<&'a Path>,
    /// Further designs written beside it.
    pub beside: Vec<PathBuf>,
    /// The journal, where it was kept.
    pub journal: Option<PathBuf>,
    /// Wall time of the search, s.
    pub run_time_s: f64,
    /// Stopped by Ctrl-C.
    pub interrupted: bool,
}

fn held_cell(m: &Margin) -> Cell {
    Cell::Verdict(m.held(), if m.held() { "held" } else { "NOT HELD" }.to_owned())
}

impl Told<'_> {
    /// How it ended. A climb may have converged before others were stopped; the search has not.
    fn status(&self) -> &Status {
        if self.interrupted { &Status::Interrupted } else { &self.found.outcome.status }
    }

    /// Why the robust design that was asked for is not there; `None` where it is, or none was asked for.
    pub fn not_robust(&self) -> Option<&'static str> {
        match (&self.story.robust, self.story.wants_robust) {
            (_, false) => None,
            (None, true) => Some("no robust design found"),
            (Some(robust), true) => (!robust.made.held())
                .then_some("no design found that holds every limit at every corner of the tolerances"),
        }
    }

    /// How it ended, in one sentence.
    pub fn verdict(&self) -> String {
        let (before, after) = self.found.objective;
        let why = match self.status() {
            Status::Converged => "converged".to_owned(),
            Status::Infeasible { least_violation, fighting } => {
                let names: Vec<&str> = fighting
                    .iter()
                    .filter_map(|&i| self.found.names.limits.get(i))
                    .map(String::as_str)
                    .collect();
                if let Some(said) = self.out_of_reach() {
                    return said;
                }
                return format!(
                    "infeasible: no design within the bounds holds every limit; the least violation is \
                     {least_violation:.4}, held up by {}",
                    names.join(" against ")
                );
            }
            Status::EvaluationLimit => {
                "stopped at the evaluation limit, which --evaluations raises,".to_owned()
            }
            Status::Interrupted => "stopped by Ctrl-C".to_owned(),
            Status::Stalled(cause) => format!("stalled ({cause:?})"),
        };
        if self.found.feasible() {
            format!(
                "{} {} -> {} ({}), every limit held{}; {why} after {} evaluations{}{}",
                self.found.aim.words(),
                shown(self.found.aim, before),
                shown(self.found.aim, after),
                error_beside(after, SHOWN_DIGITS, self.found.objective_error),
                self.start_not_held(),
                self.found.evaluations,
                if self.found.wants_centroid() { "; no flanks give its centroid yet" } else { "" },
                self.not_robust().map_or(String::new(), |why| format!("; {why}"))
            )
        } else {
            format!(
                "no feasible design found: {why} after {} evaluations; not held: {}{}",
                self.found.evaluations,
                self.found.not_held().join(", "),
                self.worst()
            )
        }
    }

    /// The limits that the design searched from does not hold, in words behind a design that holds all.
    fn start_not_held(&self) -> String {
        let broken: Vec<String> = self.found.start.iter().filter(|m| !m.held()).map(Margin::code).collect();
        match broken.len() {
            0 => String::new(),
            n => format!(
                " (the start did not hold {n} {}: {})",
                if n == 1 { "limit" } else { "limits" },
                broken.join(", ")
            ),
        }
    }

    /// The worst margin of a design that does not hold all, the nearest one found.
    fn worst(&self) -> String {
        let rows = self.found.best.iter().filter(|m| !m.held());
        rows.min_by(|a, b| a.margin().total_cmp(&b.margin())).map_or(String::new(), |m| {
            format!("; worst margin of this nearest design: {}, {}", margin_text(m), m.code())
        })
    }

    /// What to say where the best slip margin is less than the wanted one and nothing else is broken.
    fn out_of_reach(&self) -> Option<String> {
        let wanted = self.design.optimize.as_ref()?.limits.slip_margin?;
        let found = self.found;
        (found.aim == Objective::SlipMargin && found.best.iter().filter(|m| !m.held()).all(Margin::is_slip)).then(|| {
            format!(
                "infeasible: the largest {} found is {}, and slip_margin asks for {}; it is held down by {}",
                found.aim.words(),
                shown(found.aim, found.objective.1),
                significant(wanted, 4),
                self.active().join(", ")
            )
        })
    }

    /// Margins before and after, as `check` shows them.
    fn margin_table(&self) -> Table {
        let mut table = Table::new(vec![
            Column::text("code", "Limit"),
            Column::number("demand_before", "Demand before", Unit::One, 4),
            Column::number("demand_after", "Demand after", Unit::One, 4),
            Column::number("allowable", "Allowable", Unit::One, 4),
            Column::text("unit", "Unit"),
            Column::number("margin_before", "Margin before", Unit::Percent, 3),
            Column::number("margin_after", "Margin after", Unit::Percent, 3),
            Column::text("held", "Held"),
        ]);
        for (a, b) in self.found.start.iter().zip(&self.found.best) {
            table.row(vec![
                b.code().into(),
                demand_cell(a),
                demand_cell(b),
                allowable_cell(b),
                unit_cell(b),
                margin_cell(a),
                margin_cell(b),
                held_cell(b),
            ]);
        }
        table
    }

    /// The same for programs: every number in full.
    pub fn csv_table(&self) -> Table {
        let mut table = Table::new(vec![
            Column::text("code", "Limit"),
            Column::text("unit", "Unit"),
            Column::number("demand_before", "Demand before", Unit::One, 5),
            Column::number("demand_after", "Demand after", Unit::One, 5),
            Column::number("allowable", "Allowable", Unit::One, 5),
            Column::number("margin_before", "Margin before", Unit::One, 4),
            Column::number("margin_after", "Margin after", Unit::One, 4),
            Column::text("held", "Held"),
        ]);
        for (a, b) in self.found.start.iter().zip(&self.found.best) {
            let demand = |m: &Margin| m.demand_in_unit().map_or(Cell::Empty, Cell::Si);
            table.row(vec![
                b.code().into(),
                b.limit.unit.into(),
                demand(a),
                demand(b),
                b.shown_allowable().into(),
                a.margin().into(),
                b.margin().into(),
                held_cell(b),
            ]);
        }
        table
    }

    fn variable_table(&self) -> Table {
        let mut table = Table::new(vec![
            Column::text("variable", "Variable"),
            Column::number("min", "From", Unit::One, 6),
            Column::number("max", "To", Unit::One, 6),
            Column::number("before", "Before", Unit::One, 6),
            Column::number("after", "After", Unit::One, 6),
            Column::text("note", "Note"),
        ]);
        for v in &self.found.variables {
            let note = if v.dropped {
                "without influence, dropped"
            } else if v.best == v.min {
                "at its lower bound"
            } else if v.best == v.max {
                "at its upper bound"
            } else {
                ""
            };
            table.row(vec![
                v.name.as_str().into(),
                v.min.into(),
                v.max.into(),
                v.start.into(),
                v.best.into(),
                note.into(),
            ]);
        }
        table
    }

    /// Change of each margin over the whole range of each variable, at the start.
    fn influence_table(&self) -> Table {
        let mut columns = vec![Column::text("margin", "Margin")];
        for v in &self.found.continuous {
            columns.push(Column::number(v, v, Unit::One, 3));
        }
        let mut table = Table::new(columns);
        let names = &self.found.names;
        let rows =
            names.objectives.iter().map(|n| format!("{n} (objective)")).zip(&self.found.influence.objectives);
        let limits = names.limits.iter().cloned().zip(&self.found.influence.limits);
        for (name, slopes) in rows.chain(limits) {
            let mut row: Vec<Cell> = vec![name.into()];
            // Below the threshold for "no influence" a slope is rounding, shown as none.
            row.extend(
                slopes.iter().map(|&s| if s.abs() < crate::optimise::NO_INFLUENCE { 0.0 } else { s }.into()),
            );
            table.row(row);
        }
        table
    }

    fn active(&self) -> Vec<String> {
        let a = &self.found.outcome.active;
        let n = &self.found.names;
        let free = &self.found.searched;
        let objectives = a.objectives.iter().filter_map(|&i| n.objectives.get(i)).cloned();
        let limits = a.limits.iter().filter_map(|&i| n.limits.get(i)).cloned();
        let lower = a.lower.iter().filter_map(|&i| free.get(i)).map(|s| format!("{s} at its lower bound"));
        let upper = a.upper.iter().filter_map(|&i| free.get(i)).map(|s| format!("{s} at its upper bound"));
        objectives.chain(limits).chain(lower).chain(upper).collect()
    }

    /// The answer in the terminal.
    pub fn text(&self, context: &Context) -> String {
        let mut out =
            format!("{}\n\nVariables\n{}", self.verdict(), self.variable_table().to_text(context.screen));
        out += &self.moved_inside().iter().map(|line| format!("{line}\n")).collect::<String>();
        out += &format!("\nMargins\n{}", self.margin_table().to_text(context.screen));
        out += &format!(
            "\nInfluence at the start: change of each margin over the whole range of a variable\n{}",
            self.influence_table().to_text(context.screen)
        );
        out += &format!("\nActive: {}\n", self.active().join(", "));
        for part in self.story.parts() {
            out += &format!("\n{}\n", part.heading);
            out += &part.lines.iter().map(|l| format!("- {l}\n")).collect::<String>();
            for (caption, table) in &part.tables {
                out += &format!("{caption}\n{}", table.to_text(context.screen));
            }
        }
        out += &format!("{}\n", self.in_full());
        out += &match self.written {
            Some(path) => format!("Written: {}\n", path_text(path)),
            None => "No design written.\n".to_owned(),
        };
        out += &self.beside.iter().map(|p| format!("Written: {}\n", path_text(p))).collect::<String>();
        out
    }

    /// Variables whose value in the file lies outside their bounds.
    fn moved_inside(&self) -> Vec<String> {
        let outside = self.found.variables.iter().filter(|v| v.start != v.given);
        let line = |v: &crate::optimise::Variable| {
            format!(
                "{} is {} in the file, outside its bounds {} to {} in [optimize]: the search started from {}.",
                v.name, v.given, v.min, v.max, v.start
            )
        };
        outside.map(line).collect()
    }

    /// What the optimum gained or lost when it was looked at with everything.
    fn in_full(&self) -> String {
        let changes = self.found.best.iter().zip(&self.found.as_searched);
        let most = changes
            .map(|(a, b)| ((a.margin() - b.margin()).abs(), a.code()))
            .max_by(|a, b| a.0.total_cmp(&b.0));
        match most {
            Some((change, code)) => format!(
                "Looked at in full, at a true error of 1e-7 or less: no margin moves by more than {change:.0e} ({code})."
            ),
            None => String::new(),
        }
    }

    /// The answer for programs.
    pub fn json(&self) -> Answer<'_, Value> {
        let found = self.found;
        let values = |pick: fn(&crate::optimise::Variable) -> f64| -> serde_json::Map<String, Value> {
            found.variables.iter().map(|v| (v.name.clone(), json!(pick(v)))).collect()
        };
        let row = |m: &Margin| {
            json!({
                "code": m.code(), "name": m.name, "unit": m.limit.unit, "allowable": m.shown_allowable(),
                "margin": m.margin(), "slip_margin": m.slip_margin(), "demand": m.demand_in_unit(),
            })
        };
        let rows = |list: &[Margin]| list.iter().map(row).collect::<Vec<_>>();
        let dropped: Vec<&str> =
            found.variables.iter().filter(|v| v.dropped).map(|v| v.name.as_str()).collect();
        let status = self.status().name();
        let fighting: Vec<&String> = match self.status() {
            Status::Infeasible { fighting, .. } => {
                fighting.iter().filter_map(|&i| found.names.limits.get(i)).collect()
            }
            _ => Vec::new(),
        };
        let mut body = json!({
            "status": status,
            "aim": found.aim.name(),
            "feasible": found.feasible(),
            "best": { "variables": values(|v| v.best), "objective": found.objective.1, "margins": rows(&found.best) },
            "in_file": values(|v| v.given),
            "start": { "variables": values(|v| v.start), "objective": found.objective.0, "margins": rows(&found.start) },
            "evaluations": found.evaluations,
            "failed_evaluations": found.outcome.failures,
            "active_constraints": self.active(),
            "fighting_limits": fighting,
            "dropped_variables": dropped,
            "influence": {
                "objectives": found.names.objectives, "limits": found.names.limits,
                "d_objectives_per_range": found.influence.objectives, "d_limits_per_range": found.influence.limits,
            },
            "pareto": self.story.pareto(),
            "seed": self.design.optimize.as_ref().map(|o| o.seed),
            "written_to": self.written.map(|p| p.display().to_string()),
            "written_beside": self.beside.iter().map(|p| p.display().to_string()).collect::<Vec<_>>(),
            "journal": self.journal.as_ref().map(|p| p.display().to_string()),
        });
        if let Some(map) = body.as_object_mut() {
            map.extend(self.story.json());
        }
        Answer {
            design: self.design,
            run_time_s: self.run_time_s,
            left_out: left_out(&self.design.clutch),
            error_estimate: Some(json!(found.objective_error)),
            body,
        }
    }

    /// The page.
    pub fn page(&self, context: &Context) -> Page {
        let mut page = parts::page("Optimisation", self.design, context);
        page.verdict(self.found.feasible() && self.not_robust().is_none(), &self.verdict());
        if let Some(path) = self.written {
            page.paragraph(&format!("New design: {}", path.display()));
        }
        self.draw(&mut page);
        page.heading("Variables").table("Before and after, with their bounds", &self.variable_table());
        self.moved_inside().iter().for_each(|line| {
            page.paragraph(line);
        });
        page.heading("Margins");
        page.table(
            "Margins before and after; the slip rows are the objectives, all others are limits",
            &self.margin_table(),
        );
        page.paragraph(&format!("Active at the optimum: {}.", self.active().join(", ")));
        page.paragraph(&self.in_full());
        for part in self.story.parts() {
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
        let history = &self.found.outcome.history;
        let path = |pick: fn(&crate::optimise::Iteration) -> f64| -> Vec<[f64; 2]> {
            history.iter().map(|it| [it.evaluations as f64, pick(it)]).collect()
        };
        let plot = Plot::new("Evaluations of the clutch", "Margin")
            .curve("least scaled objective", path(|it| it.least_margin))
            .curve("worst violation of a limit", path(|it| it.violation));
        page.figure(&plot.to_svg(), "Path of the search; a violated limit is paid first.");
        page.table(
            "Influence at the start: change of each margin over the whole range of each variable",
            &self.influence_table(),
        );
        self.json().close(&mut page);
        page
    }

    /// Profiles before and after, to scale, one over the other.
    fn draw(&self, page: &mut Page) {
        let Ok(after) = Design::parse_in(&self.design.folder, &self.found.file, "optimum") else { return };
        let (Ok(p), Ok(q)) = (self.design.clutch.profile(), after.clutch.profile()) else {
            return;
        };
        parts::draw_sheet(page, &after, &q);
        let poses =
            vec![parts::pose_at_rest("after", &after, &q), parts::pose_at_rest("before", self.design, &p)];
        parts::draw(page, &parts::drawing(&after, poses));
        let depth = |design: &Design, profile| {
            crate::wedge::WedgeCurve::build(&design.clutch, profile, 0.0).ok().map(|curve| {
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
