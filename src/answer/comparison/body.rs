//! The answer of `compare` by its keys in JSON; every list of values has one for each design, in their order.

use super::figures::FIGURES;
use super::{Comparison, tables, unit_of};
use crate::compare::{Scene, SideBySide};
use crate::file::Input;
use crate::margin::Margin;
use serde::Serialize;

/// A design.
#[derive(Debug, Clone, Serialize)]
pub struct ComparedDesign<'a> {
    /// Code of the required limit with the least margin.
    pub deciding: Option<String>,
    /// SHA-256 of its file.
    pub design_hash: &'a str,
    /// Where it comes from.
    pub file: &'a str,
    /// Its name.
    pub name: &'a str,
    /// Whether every required limit is held.
    pub pass: bool,
}

/// The value of an input.
#[derive(Debug, Clone, Copy, Serialize)]
#[serde(untagged)]
pub enum InputValue<'a> {
    /// A number, in the unit of the input.
    Number(f64),
    /// A word.
    Text(&'a str),
}

/// An input that differs.
#[derive(Debug, Clone, Serialize)]
pub struct ComparedInput<'a> {
    /// Its key in the file, tables included.
    pub path: &'a str,
    /// Its unit; empty for a pure number.
    pub unit: &'static str,
    /// Its values; null where a design has none.
    pub values: Vec<Option<InputValue<'a>>>,
}

/// A figure.
#[derive(Debug, Clone, Serialize)]
pub struct ComparedFigure {
    /// Its key, the unit at the end.
    pub key: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// Its values.
    pub values: Vec<Option<f64>>,
}

/// A limit; null where a design does not name it.
#[derive(Debug, Clone, Serialize)]
pub struct ComparedMargin<'a> {
    /// Its code.
    pub code: &'a str,
    /// Whether it is held.
    pub held: Vec<Option<bool>>,
    /// Its margin as a number.
    pub margins: Vec<Option<f64>>,
    /// Whether it counts for the verdict.
    pub required: Vec<Option<bool>>,
    /// Torque at which it would be reached, N m, where it depends on torque.
    pub torque_capacities_nm: Vec<Option<Option<f64>>>,
}

/// A scene; null where a design does not have it or nothing is known.
#[derive(Debug, Clone, Serialize)]
pub struct ComparedScene<'a> {
    /// Contact margin.
    pub contact_margin: Vec<Option<Option<f64>>>,
    /// Its name.
    pub name: &'a str,
    /// Static friction from which on it sticks.
    pub required_friction: Vec<Option<Option<f64>>>,
    /// Static over required friction, less 1.
    pub slip_margin: Vec<Option<Option<f64>>>,
}

/// Keys of `compare`.
#[derive(Debug, Clone, Serialize)]
pub struct ComparisonBody<'a> {
    /// The designs, the one before first.
    pub designs: Vec<ComparedDesign<'a>>,
    /// Figures side by side.
    pub figures: Vec<ComparedFigure>,
    /// Inputs that differ.
    pub inputs: Vec<ComparedInput<'a>>,
    /// Margins side by side.
    pub margins: Vec<ComparedMargin<'a>>,
    /// Scenes side by side.
    pub scenes: Vec<ComparedScene<'a>>,
}

/// One value of each design; none of a design without it.
fn values<'a, T, V>(row: &'a SideBySide<T>, value: impl Fn(&'a T) -> V) -> Vec<Option<V>> {
    row.values.iter().map(|v| v.as_ref().map(&value)).collect()
}

impl<'a> ComparisonBody<'a> {
    pub(super) fn of(compared: &'a Comparison<'_>) -> Self {
        let subjects = compared.subjects;
        let designs = subjects.iter().zip(compared.files).map(|(s, file)| ComparedDesign {
            name: &s.design.name,
            file,
            design_hash: &s.design.hash,
            pass: s.held(),
            deciding: s.deciding().map(Margin::code),
        });
        let value = |i: &'a Input| i.number.map_or(InputValue::Text(&i.text), InputValue::Number);
        let inputs = compared.inputs.iter().map(|row| ComparedInput {
            path: &row.key,
            unit: unit_of(row),
            values: values(row, value),
        });
        let figures = FIGURES.iter().map(|f| ComparedFigure {
            key: f.key,
            unit: f.unit.symbol(),
            values: subjects.iter().map(|s| f.shown(s)).collect(),
        });
        let margins = compared.margins.iter().map(|row: &'a SideBySide<&Margin>| ComparedMargin {
            code: &row.key,
            required: values(row, |m| m.required),
            held: values(row, |m| m.held()),
            margins: values(row, |m| m.margin()),
            torque_capacities_nm: values(row, |m| m.torque_capacity_nm),
        });
        let scenes = compared.scenes.iter().map(|row: &'a SideBySide<&Scene>| ComparedScene {
            name: &row.key,
            required_friction: values(row, |s| tables::required_friction(s)),
            slip_margin: values(row, |s| s.found.slip_margin()),
            contact_margin: values(row, |s| s.found.contact_margin()),
        });
        Self {
            designs: designs.collect(),
            inputs: inputs.collect(),
            figures: figures.collect(),
            margins: margins.collect(),
            scenes: scenes.collect(),
        }
    }
}
