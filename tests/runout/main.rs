//! Races off centre: one sprag in its own gap by vectors, energy and virtual work; the ring by hand and by its limits.

#![allow(missing_docs)]

#[path = "../common/mod.rs"]
mod common;
mod coupled;
mod ring;
mod sprag;

use sprag_design::clutch::Carrier;

type Vector = nalgebra::Vector2<f64>;

const CARRIERS: [Carrier; 2] = [Carrier::OuterRace, Carrier::InnerRace];
