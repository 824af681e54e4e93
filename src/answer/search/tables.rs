//! Tables of a search: margins and variables before and after, influence.

use super::Story;
use crate::answer::check::{allowable_cell, demand_cell, margin_cell, unit_cell};
use crate::margin::Margin;
use crate::optimise::NO_INFLUENCE;
use crate::report::{Cell, Column, Table, Unit};

fn held_cell(m: &Margin) -> Cell {
    Cell::Verdict(m.held(), if m.held() { "held" } else { "NOT HELD" }.to_owned())
}

impl Story {
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
