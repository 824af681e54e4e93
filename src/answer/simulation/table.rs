//! A history as a table, or one row with the equilibrium.

use super::{SceneHistory, Values};
use crate::report::{Cell, Column, Table, Unit};

impl SceneHistory {
    /// The columns under their names, as CSV has them.
    pub fn table(&self) -> Table {
        let history = self;
        // The numbers are in the unit of the name already.
        let column = |name: &str| Column::number(name, name, Unit::One, 9);
        let mut table = Table::new(history.columns.iter().map(|(name, _)| column(name)).collect());
        let rows = history.columns.first().map_or(0, |(_, values)| values.len());
        for i in 0..rows {
            table.row(history.columns.iter().map(|(_, values)| cell(values, i)).collect());
        }
        table
    }
}

fn cell(values: &Values, i: usize) -> Cell {
    match values {
        Values::Numbers(v) => v.get(i).map_or(Cell::Empty, |v| Cell::Si(*v)),
        Values::Words(v) => v.get(i).map_or(Cell::Empty, |v| Cell::from(*v)),
        Values::Counts(v) => v.get(i).copied().flatten().map_or(Cell::Empty, Cell::Count),
    }
}
