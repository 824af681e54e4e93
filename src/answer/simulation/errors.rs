//! The errors of a simulation's figures as JSON: derived from [`FIGURES`].

use super::Ran;
use crate::report::Unit;
use crate::scenario::{ErrorEstimate, FIGURES, Figure, Group, Prepared, Quantity, Simulation};
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

/// Errors of the figures, in the order and the units of JSON.
#[derive(Debug, Clone, PartialEq)]
pub struct SimulationErrors(Vec<(&'static str, Vec<f64>)>);

/// The key before which [`LARGER`] stands.
const INNER_TAN: &str = "tan_inner";
/// The larger of the errors of |T|/N at A and B.
const LARGER: &str = "peak_tan_demand";

/// The unit that a key of JSON ends in.
fn unit(quantity: Quantity) -> Unit {
    match quantity {
        Quantity::Length => Unit::Millimetre,
        Quantity::Pressure => Unit::Megapascal,
        Quantity::Flux => Unit::WattPerSquareMillimetre,
        Quantity::Depth => Unit::Micrometre,
        // SI as it is.
        _ => Unit::One,
    }
}

impl SimulationErrors {
    pub(super) fn of(ran: &Ran, prepared: &Prepared, s: &Simulation, e: &ErrorEstimate) -> Self {
        let mut all: Vec<(&str, Vec<f64>)> = Vec::new();
        let is_known = |key: &str| FIGURES.iter().any(|f| f.key == key && (f.of)(s).is_some());
        for figure in FIGURES {
            if figure.line.is_some_and(|line| line.group == Group::Slip) && !is_known(figure.key) {
                continue;
            }
            let error = unit(figure.quantity).from_si(ran.error_of(figure, prepared, s, e));
            if figure.key == INNER_TAN {
                all.push((LARGER, vec![e.tan_inner.max(e.tan_outer)]));
            }
            match all.last_mut().filter(|(key, _)| *key == figure.key) {
                Some((_, both)) => both.push(error),
                None => all.push((figure.key, vec![error])),
            }
        }
        Self(all)
    }

    /// The error by its key in JSON: of one figure, or of the inner and the outer contact.
    pub fn get(&self, key: &str) -> Option<&[f64]> {
        self.0.iter().find(|(k, _)| *k == key).map(|(_, values)| values.as_slice())
    }
}

impl Ran {
    /// The error of a figure, SI: of a pressure with that of its shape.
    pub fn error_of(&self, figure: &Figure, prepared: &Prepared, s: &Simulation, e: &ErrorEstimate) -> f64 {
        let shape = figure.normal_n.zip((figure.of)(s));
        (figure.error)(e) + shape.map_or(0.0, |(n, pa)| pa * self.shape_error(prepared, n(s)))
    }
}

impl Serialize for SimulationErrors {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        for (key, values) in &self.0 {
            match values.as_slice() {
                [one] => map.serialize_entry(key, one)?,
                both => map.serialize_entry(key, both)?,
            }
        }
        map.end()
    }
}
