//! Tables of a search: margins and variables before and after, influence.

use super::Story;
use crate::answer::check::{allowable_cell, demand_cell, margin_cell, unit_cell};
use crate::margin::Margin;
use crate::optimise::NO_INFLUENCE;
use crate::report::{Cell, Rows, Table, Unit};

/// What stands behind the rows of the objective.
const OF_OBJECTIVE: &str = " (objective)";

impl Story {
    fn held_cell(&self, m: &Margin) -> Cell {
        let word = match (self.held(m), m.held()) {
            (true, _) => "held",
            (false, true) => "within the reserve",
            (false, false) => "NOT HELD",
        };
        Cell::Verdict(self.held(m), word.to_owned())
    }

    /// Margins before and after and what the optimum demands, as `check` shows them: what fits a terminal.
    pub fn margin_table(&self) -> Table {
        Rows::of(self.margins().iter().map(|b| (b, self.before(b))))
            .text("code", "Limit", |(b, _)| b.code())
            .number("demand", "Demand", Unit::One, 4, |(b, _)| demand_cell(b))
            .number("allowable", "Allowable", Unit::One, 4, |(b, _)| allowable_cell(b))
            .text("unit", "Unit", |(b, _)| unit_cell(b))
            .number("margin_before", "Margin before", Unit::Percent, 3, |(_, a)| {
                a.map_or(Cell::Empty, margin_cell)
            })
            .number("margin_after", "Margin after", Unit::Percent, 3, |(b, _)| margin_cell(b))
            .text("held", "Held", |(b, _)| self.held_cell(b))
            .table()
    }

    /// The same for programs: every number in full.
    pub fn csv_table(&self) -> Table {
        let demand = |m: &Margin| m.demand_in_unit().map_or(Cell::Empty, Cell::Si);
        Rows::of(self.margins().iter().map(|b| (b, self.before(b))))
            .text("code", "Limit", |(b, _)| b.code())
            .text("unit", "Unit", |(b, _)| b.limit.unit)
            .number("demand_before", "Demand before", Unit::One, 5, |(_, a)| a.map_or(Cell::Empty, demand))
            .number("demand_after", "Demand after", Unit::One, 5, |(b, _)| demand(b))
            .number("allowable", "Allowable", Unit::One, 5, |(b, _)| b.shown_allowable())
            .number("margin_before", "Margin before", Unit::One, 4, |(_, a)| {
                a.map_or(Cell::Empty, |a| a.margin().into())
            })
            .number("margin_after", "Margin after", Unit::One, 4, |(b, _)| b.margin())
            .text("held", "Held", |(b, _)| self.held_cell(b))
            .table()
    }

    /// Variables before and after, with their bounds.
    pub fn variable_table(&self) -> Table {
        Rows::of(self.made().variables.iter().map(|v| {
            let before = self.found.variables.iter().find(|f| f.name == v.name);
            let bound = match (v.best == v.min, v.best == v.max) {
                (true, _) => Some("lower"),
                (_, true) => Some("upper"),
                _ => None,
            };
            let at = match bound {
                _ if v.dropped => "dropped: no influence".to_owned(),
                Some(bound) if self.value(v) == v.best => format!("at {bound} bound"),
                Some(bound) => format!("next to {bound} bound"),
                None => String::new(),
            };
            let from = if v.start == v.given { String::new() } else { format!("{} in the file", v.given) };
            let note = [from, at].into_iter().filter(|s| !s.is_empty()).collect::<Vec<_>>().join(", ");
            (v, before, note)
        }))
        .text("variable", "Variable", |(v, _, _)| v.name.as_str())
        .number("min", "From", Unit::One, 5, |(v, _, _)| v.min)
        .number("max", "To", Unit::One, 5, |(v, _, _)| v.max)
        .number("before", "Before", Unit::One, 6, |(_, before, _)| {
            before.map_or(Cell::Empty, |f| f.start.into())
        })
        .number("after", "After", Unit::One, 6, |(v, _, _)| self.value(v))
        .text("note", "Note", |(_, _, note)| note.clone())
        .table()
    }

    /// Change of the objective and of the limits that hold the optimum over the whole range of each variable, at the start.
    pub fn deciding_influence(&self) -> Table {
        let active = self.active();
        let decides = |row: &[Cell]| match row.first() {
            Some(Cell::Text(name)) => name.ends_with(OF_OBJECTIVE) || active.contains(name),
            _ => false,
        };
        let mut table = self.influence_table();
        table.rows.retain(|row| decides(row));
        table
    }

    /// Change of each margin over the whole range of each variable, at the start.
    pub fn influence_table(&self) -> Table {
        let (names, slopes) = (&self.found.names, &self.found.influence);
        let objectives = names.objectives.iter().map(|n| format!("{n}{OF_OBJECTIVE}"));
        let rows = objectives.zip(&slopes.objectives).chain(names.limits.iter().cloned().zip(&slopes.limits));
        let name = |(_, v): &(usize, &String)| (String::clone(v), String::clone(v));
        // Below the threshold for "no influence" a slope is rounding, shown as none.
        let felt = |slope: f64| if slope.abs() < NO_INFLUENCE { 0.0 } else { slope };
        Rows::of(rows)
            .text("margin", "Margin", |(name, _)| name.clone())
            .each(self.found.continuous.iter().enumerate(), name, Unit::One, 3, |(_, slopes), (j, _)| {
                slopes.get(*j).copied().map(felt)
            })
            .table()
    }
}
