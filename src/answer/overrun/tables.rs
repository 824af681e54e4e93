//! Overrun over speeds and temperatures: film and drag, heat, swing and wear.

use super::{OverrunAnswer, OverrunLine};
use crate::report::{Cell, Rows, Table, Unit};

/// A part of the columns that fits a page.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OverrunPart {
    /// Film, friction, drag.
    Film,
    /// Heat and temperatures.
    Heat,
    /// Fit and gap at these temperatures.
    Warm,
    /// Growth of the swing, wear.
    Swing,
}

/// Columns of [`OverrunPart::Warm`] where no race is pressed onto anything.
const UNFITTED: &[&str] = &["oil_c", "speed_rpm", "warm_gap_mm", "warm_first_tan_omega", "warm_bears_nm"];

type Lines<'a> = Rows<&'a OverrunLine>;

fn with_film(rows: Lines<'_>, slides_outside: bool) -> Lines<'_> {
    let rows = match slides_outside {
        true => rows
            .number("normal_outer_n", "N at B", Unit::Newton, 4, |l| l.point.state.normal_outer_n)
            .hidden("normal_inner_n", Unit::Newton, |l| l.point.state.normal_inner_n),
        false => rows.number("normal_inner_n", "N at A", Unit::Newton, 4, |l| l.point.state.normal_inner_n),
    };
    rows.number("film_um", "Film", Unit::Micrometre, 3, |l| {
        l.point.lubricated.map(|f| f.film.film.thickness_m)
    })
    .number("lambda", "λ", Unit::One, 3, |l| l.point.lubricated.map(|f| f.film.lambda))
    .text("regime", "Regime", |l| l.point.lubricated.map(|f| f.film.film.regime.name()))
    .number("asperity_share", "By asperities", Unit::One, 3, |l| {
        l.point.lubricated.map(|f| f.film.asperities)
    })
    .shown_in(Unit::Percent)
    .number("friction", "μ", Unit::One, 3, |l| Cell::only_if(l.point.lubricated.is_some(), l.point.friction))
    .number("friction_dry", "μ by (12)", Unit::One, 3, |l| l.dry.friction)
    .number("drag_torque_nm", "Drag", Unit::NewtonMetre, 3, |l| l.point.state.drag_torque_nm)
    .number("drag_torque_dry_nm", "Drag by (12)", Unit::NewtonMetre, 3, |l| l.dry.state.drag_torque_nm)
    .json("lifted_off", |l| l.point.state.sliding_n <= 0.0)
    .json("moes_load", |l| l.point.lubricated.and_then(|f| f.film.film.load))
    .json("moes_lubricant", |l| l.point.lubricated.map(|f| f.film.film.lubricant))
    .json("nahme", |l| l.point.lubricated.map(|f| f.film.shear.nahme))
}

fn with_heat(rows: Lines<'_>) -> Lines<'_> {
    rows.number("heat_w", "Heat", Unit::Watt, 3, |l| l.point.lubricated.map(|f| f.heat.heat_w))
        .number("film_c", "Film, °C", Unit::One, 4, |l| l.point.lubricated.map(|f| f.film_c))
        .number("inner_race_c", "Inner race, °C", Unit::One, 4, |l| {
            l.point.lubricated.map(|f| f.heat.temperatures.inner_race)
        })
        .number("sprags_c", "Sprags, °C", Unit::One, 4, |l| {
            l.point.lubricated.map(|f| f.heat.temperatures.sprags)
        })
        .number("outer_race_c", "Outer race, °C", Unit::One, 4, |l| {
            l.point.lubricated.map(|f| f.heat.temperatures.outer_race)
        })
        .json("contact_c", |l| l.point.lubricated.map(|f| f.heat.temperatures.contact))
        .json("heat_balance_error", |l| l.point.lubricated.map(|f| f.heat.balance_error()))
}

fn with_warm(rows: Lines<'_>) -> Lines<'_> {
    rows.number("warm_gap_mm", "Gap", Unit::Millimetre, 6, |l| l.warm.map(|w| w.gap_m))
        .number("warm_first_tan_omega", "tan ω, first contact", Unit::One, 4, |l| {
            l.warm.map(|w| w.first_tan_omega)
        })
        .number("warm_joint_inner_mpa", "Fit on the shaft", Unit::Megapascal, 3, |l| {
            l.warm.map(|w| w.joint_pa[0]).filter(|pa| *pa != 0.0)
        })
        .number("warm_joint_outer_mpa", "Fit in the housing", Unit::Megapascal, 3, |l| {
            l.warm.map(|w| w.joint_pa[1]).filter(|pa| *pa != 0.0)
        })
        .number("warm_bears_nm", "Bears", Unit::NewtonMetre, 4, |l| l.warm.and_then(|w| w.bears_nm))
}

fn with_swing(rows: Lines<'_>) -> Lines<'_> {
    rows.number("growth_rate_per_s", "Growth on film", Unit::PerSecond, 3, |l| {
        l.point.swing.map(|s| s.growth_rate_per_s)
    })
    .number("growth_by_friction_per_s", "By friction", Unit::PerSecond, 3, |l| {
        l.point.swing_by_friction.map(|s| s.growth_rate_per_s)
    })
    .number("growth_dry_per_s", "By (12)", Unit::PerSecond, 3, |l| l.dry.swing.map(|s| s.growth_rate_per_s))
    .number("sprag_wear_first_hour_um", "Sprag, 1st h", Unit::Micrometre, 3, |l| l.wear.map(|w| w.sprag_m))
    .number("race_wear_um_per_hour", "Race, per h", Unit::Micrometre, 3, |l| l.wear.map(|w| w.race_m))
    .json("swing_frequency_hz", |l| l.point.swing.map(|s| s.frequency_hz))
}

impl OverrunAnswer<'_> {
    fn oil_and_speed(&self) -> Lines<'_> {
        Rows::of(&self.lines).number("oil_c", "Oil, °C", Unit::One, 3, |l| l.oil_c).number(
            "speed_rpm",
            "Speed",
            Unit::Rpm,
            4,
            |l| l.speed_rad_s,
        )
    }

    /// A part of it.
    pub fn part(&self, part: OverrunPart) -> Table {
        let rows = self.oil_and_speed();
        let rows = match part {
            OverrunPart::Film => with_film(rows, self.slides_outside()),
            OverrunPart::Heat => with_heat(rows),
            OverrunPart::Warm => with_warm(rows),
            OverrunPart::Swing => with_swing(rows),
        };
        // Oil and speed say what a row is.
        let table = Table { lead: 2, ..rows.table() };
        let fitted = |l: &OverrunLine| l.warm.is_some_and(|w| w.joint_pa != [0.0; 2]);
        match part {
            OverrunPart::Warm if !self.lines.iter().any(fitted) => table.only(UNFITTED),
            _ => table,
        }
    }

    /// All of it.
    pub fn all(&self) -> Rows<&OverrunLine> {
        with_swing(with_warm(with_heat(with_film(self.oil_and_speed(), self.slides_outside()))))
    }
}
