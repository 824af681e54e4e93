//! Tables of a search: margins and variables before and after, influence.

use super::Story;
use crate::answer::check::{allowable_cell, demand_cell, margin_cell, unit_cell};
use crate::margin::Margin;
use crate::optimise::NO_INFLUENCE;
use crate::report::{Cell, Column, Table, Unit};

impl Story {
    fn held_cell(&self, m: &Margin) -> Cell {
        let word = match (self.held(m), m.held()) {
            (true, _) => "held",
            (false, true) => "within the reserve",
            (false, false) => "NOT HELD",
        };
        Cell::Verdict(self.held(m), word.to_owned())
    }

    /// Margins before and after, as `check` shows them.
    pub(crate) fn margin_table(&self) -> Table {
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
        for b in self.margins() {
            let a = self.before(b);
            table.row(vec![
                b.code().into(),
                a.map_or(Cell::Empty, demand_cell),
                demand_cell(b),
                allowable_cell(b),
                unit_cell(b),
                a.map_or(Cell::Empty, margin_cell),
                margin_cell(b),
                self.held_cell(b),
            ]);
        }
        table
    }

    /// The same for programs: every number in full.
    pub(crate) fn csv_table(&self) -> Table {
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
        for b in self.margins() {
            let a = self.before(b);
            let demand = |m: &Margin| m.demand_in_unit().map_or(Cell::Empty, Cell::Si);
            table.row(vec![
                b.code().into(),
                b.limit.unit.into(),
                a.map_or(Cell::Empty, demand),
                demand(b),
                b.shown_allowable().into(),
                a.map_or(Cell::Empty, |a| a.margin().into()),
                b.margin().into(),
                self.held_cell(b),
            ]);
        }
        table
    }

    /// Variables before and after, with their bounds.
    pub(crate) fn variable_table(&self) -> Table {
        let mut table = Table::new(vec![
            Column::text("variable", "Variable"),
            Column::number("min", "From", Unit::One, 6),
            Column::number("max", "To", Unit::One, 6),
            Column::number("before", "Before", Unit::One, 6),
            Column::number("after", "After", Unit::One, 6),
            Column::text("note", "Note"),
        ]);
        for v in &self.made().variables {
            let before = self.found.variables.iter().find(|f| f.name == v.name);
            let bound = match (v.best == v.min, v.best == v.max) {
                (true, _) => Some("lower"),
                (_, true) => Some("upper"),
                _ => None,
            };
            let note = match bound {
                _ if v.dropped => "without influence, dropped".to_owned(),
                Some(bound) if self.value(v) == v.best => format!("at its {bound} bound"),
                Some(bound) => format!("a step from its {bound} bound"),
                None => String::new(),
            };
            table.row(vec![
                v.name.as_str().into(),
                v.min.into(),
                v.max.into(),
                before.map_or(Cell::Empty, |f| f.start.into()),
                self.value(v).into(),
                note.as_str().into(),
            ]);
        }
        table
    }

    /// Change of each margin over the whole range of each variable, at the start.
    pub(crate) fn influence_table(&self) -> Table {
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
            row.extend(slopes.iter().map(|&s| if s.abs() < NO_INFLUENCE { 0.0 } else { s }.into()));
            table.row(row);
        }
        table
    }
}
