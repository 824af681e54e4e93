//! Overrun over speeds and temperatures as tables.

use super::{OverrunAnswer, OverrunLine};
use crate::report::{Cell, Column, Table, Unit};

/// What a line has in one column.
type Shown = fn(&OverrunLine) -> Cell;

/// A column and what stands in it.
type Kind = (Column, Shown);

fn maybe(value: Option<f64>) -> Cell {
    value.map_or(Cell::Empty, Cell::Si)
}

fn oil_and_speed() -> [Kind; 2] {
    [
        (Column::number("oil_c", "Oil, C", Unit::One, 3), |l| l.oil_c.into()),
        (Column::number("speed_rpm", "Speed", Unit::Rpm, 4), |l| l.speed_rad_s.into()),
    ]
}

fn of_film() -> Vec<Kind> {
    vec![
        (Column::number("normal_inner_n", "N at A", Unit::Newton, 4), |l| {
            l.point.state.normal_inner_n.into()
        }),
        (Column::number("film_um", "Film", Unit::Micrometre, 3), |l| {
            maybe(l.point.lubricated.map(|f| f.film.film.thickness_m))
        }),
        (Column::number("lambda", "λ", Unit::One, 3), |l| maybe(l.point.lubricated.map(|f| f.film.lambda))),
        (Column::text("regime", "Regime"), |l| {
            l.point.lubricated.map_or(Cell::Empty, |f| f.film.film.regime.name().into())
        }),
        (Column::number("asperities_percent", "By asperities", Unit::Percent, 3), |l| {
            maybe(l.point.lubricated.map(|f| f.film.asperities))
        }),
        (Column::number("friction", "μ", Unit::One, 3), |l| {
            maybe(l.point.lubricated.map(|_| l.point.friction))
        }),
        (Column::number("friction_dry", "μ by (12)", Unit::One, 3), |l| l.dry.friction.into()),
        (Column::number("drag_torque_nm", "Drag", Unit::NewtonMetre, 3), |l| {
            l.point.state.drag_torque_nm.into()
        }),
        (Column::number("drag_torque_dry_nm", "Drag by (12)", Unit::NewtonMetre, 3), |l| {
            l.dry.state.drag_torque_nm.into()
        }),
    ]
}

fn of_heat() -> Vec<Kind> {
    vec![
        (Column::number("heat_w", "Heat", Unit::Watt, 3), |l| {
            maybe(l.point.lubricated.map(|f| f.heat.heat_w))
        }),
        (Column::number("film_c", "Film, C", Unit::One, 4), |l| maybe(l.point.lubricated.map(|f| f.film_c))),
        (Column::number("inner_race_c", "Inner race, C", Unit::One, 4), |l| {
            maybe(l.point.lubricated.map(|f| f.heat.temperatures.inner_race))
        }),
        (Column::number("sprags_c", "Sprags, C", Unit::One, 4), |l| {
            maybe(l.point.lubricated.map(|f| f.heat.temperatures.sprags))
        }),
        (Column::number("outer_race_c", "Outer race, C", Unit::One, 4), |l| {
            maybe(l.point.lubricated.map(|f| f.heat.temperatures.outer_race))
        }),
    ]
}

fn of_swing_and_wear() -> Vec<Kind> {
    vec![
        (Column::number("growth_rate_per_s", "Growth, film", Unit::PerSecond, 3), |l| {
            maybe(l.point.swing.map(|s| s.growth_rate_per_s))
        }),
        (Column::number("growth_by_friction_per_s", "Growth, friction alone", Unit::PerSecond, 3), |l| {
            maybe(l.point.swing_by_friction.map(|s| s.growth_rate_per_s))
        }),
        (Column::number("growth_dry_per_s", "Growth, (12)", Unit::PerSecond, 3), |l| {
            maybe(l.dry.swing.map(|s| s.growth_rate_per_s))
        }),
        (Column::number("sprag_wear_first_hour_um", "Sprag, 1st hour", Unit::Micrometre, 3), |l| {
            maybe(l.wear.map(|w| w.sprag_m))
        }),
        (Column::number("race_wear_um_per_hour", "Race, an hour", Unit::Micrometre, 3), |l| {
            maybe(l.wear.map(|w| w.race_m))
        }),
    ]
}

fn table(answer: &OverrunAnswer<'_>, kinds: impl IntoIterator<Item = Kind>) -> Table {
    let (columns, cells): (Vec<Column>, Vec<Shown>) = kinds.into_iter().unzip();
    // Oil and speed say what a row is.
    let mut table = Table { lead: 2, ..Table::new(columns) };
    for line in &answer.lines {
        table.row(cells.iter().map(|cell| cell(line)).collect());
    }
    table
}

impl OverrunAnswer<'_> {
    /// Film, friction, drag.
    pub fn films(&self) -> Table {
        table(self, oil_and_speed().into_iter().chain(of_film()))
    }

    /// Heat and temperatures.
    pub fn heat(&self) -> Table {
        table(self, oil_and_speed().into_iter().chain(of_heat()))
    }

    /// Growth of the swing, wear.
    pub fn swing_and_wear(&self) -> Table {
        table(self, oil_and_speed().into_iter().chain(of_swing_and_wear()))
    }

    /// All, for CSV.
    pub fn all(&self) -> Table {
        table(self, oil_and_speed().into_iter().chain(of_film()).chain(of_heat()).chain(of_swing_and_wear()))
    }
}
