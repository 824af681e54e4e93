//! Enums of the library as values of options: name and help of each.

use crate::answer::overrun::RunningRace;
use crate::clutch::{LAWS, LawName};
use crate::export::Part;
use crate::export::calculix::{SOLID_LAYERS, Variant};
use crate::export::fmu::Fmi;
use crate::wedge::Lengthwise;
use clap::ValueEnum;
use clap::builder::PossibleValue;

macro_rules! choices {
    ($($type:ty { $($name:expr, $value:expr, $help:expr;)+ })+) => {
        $(impl ValueEnum for $type {
            fn value_variants<'a>() -> &'a [Self] {
                &[$($value),+]
            }

            fn to_possible_value(&self) -> Option<PossibleValue> {
                [$(($value, $name, $help)),+]
                    .into_iter()
                    .find(|(value, ..)| value == self)
                    .map(|(_, name, help)| PossibleValue::new(name).help(help))
            }
        })+
    };
}

choices! {
    Part {
        "sprag", Part::Sprag, "One sprag";
        "inner", Part::Inner, "The inner race";
        "outer", Part::Outer, "The outer race";
        "clutch", Part::Clutch, "Both races and all sprags";
    }
    Fmi {
        "2", Fmi::Two, "FMI 2.0, which every tool reads";
        "3", Fmi::Three, "FMI 3.0";
    }
    Variant {
        "plane-strain", Variant::PlaneStrain, "No strain along the axis; races as long as the sprag";
        "plane-stress", Variant::PlaneStress, "No stress along the axis; races as long as the sprag";
        "layer", Variant::Layer, "Plane in the middle of the sprag, free at its ends, one layer; races as long as the sprag";
        "solid", Variant::Solid { layers: SOLID_LAYERS },
            "Several layers, races as wide as designed; minutes become hours unless --mesh is coarse";
    }
    Lengthwise {
        "slices", Lengthwise::Slices, "Slices: (1)-(4) with the slice law, slices on half-spaces with the others";
        "reference", Lengthwise::Reference, "Half-spaces solved on a grid over the patch, two rows a slice; seconds";
        "free-ends", Lengthwise::FreeEnds, "The same with free faces where a body ends (quarter-space correction)";
    }
    RunningRace {
        "inner", RunningRace::Inner, "The inner race, past sprags that stand, or with those that its cage carries";
        "outer", RunningRace::Outer, "The outer race, the sprags with it";
    }
}

/// Contact laws by their names in the design file.
impl ValueEnum for LawName {
    fn value_variants<'a>() -> &'a [Self] {
        const NAMES: [LawName; LAWS.len()] = {
            let mut names = [LawName::Roller; LAWS.len()];
            let mut i = 0;
            while i < LAWS.len() {
                names[i] = LAWS[i].name;
                i += 1;
            }
            names
        };
        &NAMES
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        Some(PossibleValue::new(self.facts().key).help(self.facts().title))
    }
}
