//! The contact laws that can be asked for, and the coefficients they take.

use crate::design::{Axial, ContactLaw, StressState};
use clap::ValueEnum;

/// Coefficient of the roller law where the design gives none, mm and N: the public model of the paper's clutch.
const ROLLER_COEFFICIENT: f64 = 3.944e-5;

/// Contact laws by their names in the design file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ContactName {
    /// Roller law, coefficient of the design (or 3.944e-5, mm and N)
    Roller,
    /// Roller law with the coefficient of DIN 26281
    Din26281,
    /// Logarithmic line contact, knows the radius
    Hertz,
    /// Slice method (1)-(4), slices of the design (or 60)
    Slice,
    /// Plane elasticity of rings, sprag and layer; knows the radius, matches finite elements
    Elastic,
}

impl ContactName {
    /// The name in design files and JSON.
    pub(super) fn key(self) -> &'static str {
        match self {
            Self::Roller => "roller",
            Self::Din26281 => "din26281",
            Self::Hertz => "hertz",
            Self::Slice => "slice",
            Self::Elastic => "elastic",
        }
    }

    fn of(law: &ContactLaw) -> Self {
        match law {
            ContactLaw::Roller { .. } => Self::Roller,
            ContactLaw::Din26281 => Self::Din26281,
            ContactLaw::Hertz => Self::Hertz,
            ContactLaw::Slice { .. } => Self::Slice,
            ContactLaw::Elastic { .. } => Self::Elastic,
        }
    }

    /// The law of that name, with what the design's own law has of its constants.
    pub(super) fn law(self, design: &ContactLaw) -> ContactLaw {
        let coefficient = match *design {
            ContactLaw::Roller { coefficient } | ContactLaw::Slice { coefficient } => coefficient,
            ContactLaw::Din26281 | ContactLaw::Hertz | ContactLaw::Elastic { .. } => ROLLER_COEFFICIENT,
        };
        match self {
            Self::Roller => ContactLaw::Roller { coefficient },
            Self::Din26281 => ContactLaw::Din26281,
            Self::Hertz => ContactLaw::Hertz,
            Self::Slice => ContactLaw::Slice { coefficient },
            Self::Elastic => match *design {
                ContactLaw::Elastic { state } => ContactLaw::Elastic { state },
                _ => ContactLaw::Elastic { state: StressState::Layer },
            },
        }
    }
}

/// The laws asked for, each once, in the order asked; the design's own if none was.
pub(super) fn asked(names: &[ContactName], design: &ContactLaw) -> Vec<ContactName> {
    let mut list: Vec<ContactName> = Vec::new();
    for &name in names {
        if !list.contains(&name) {
            list.push(name);
        }
    }
    if list.is_empty() { vec![ContactName::of(design)] } else { list }
}

/// The law with its constants, and what it is.
pub(super) fn description(law: &ContactLaw, axial: &Axial) -> String {
    let slices = axial.slices;
    match law {
        ContactLaw::Roller { coefficient } => format!(
            "roller, K = {coefficient:e} (mm, N): approach K N^0.9/l^0.8 of a steel roller between plates, whatever the radii"
        ),
        ContactLaw::Din26281 => {
            "din26281: the roller law with the coefficient of DIN 26281, K = 3.97e-5 (mm, N)".to_owned()
        }
        ContactLaw::Hertz => {
            "hertz: logarithmic approach of a line contact, down to half the sprag's height and through the race's \
             wall; knows the radii"
                .to_owned()
        }
        ContactLaw::Elastic { state } => format!(
            "elastic, {}: exact plane elasticity of each ring under its contacts and of the sprag as a disc, nothing \
             fitted and no bulk counted twice; windup within 0.9 % of finite elements (three clutches, 32 rows)",
            match state {
                StressState::Layer => "layer (plane strain near the contact, plane stress farther away)",
                StressState::PlaneStrain => "plane strain",
                StressState::PlaneStress => "plane stress",
            }
        ),
        ContactLaw::Slice { coefficient } => format!(
            "slice, K = {coefficient:e} (mm, N), {slices} slices: (1)-(4), the roller law shared over slices that \
             influence one another; at a square end its pressure grows with the number of slices"
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_law_keeps_the_constants_of_the_design() {
        let design = ContactLaw::Slice { coefficient: 3.84e-5 };
        assert_eq!(ContactName::Roller.law(&design), ContactLaw::Roller { coefficient: 3.84e-5 });
        assert_eq!(ContactName::Slice.law(&design), design);
        assert_eq!(ContactName::Roller.law(&ContactLaw::Hertz), ContactLaw::Roller { coefficient: 3.944e-5 });
        let roller = ContactLaw::Roller { coefficient: 4e-5 };
        assert_eq!(ContactName::Slice.law(&roller), ContactLaw::Slice { coefficient: 4e-5 });
    }

    #[test]
    fn each_law_is_asked_once_and_the_designs_by_default() {
        use ContactName::*;
        assert_eq!(asked(&[Hertz, Roller, Hertz], &ContactLaw::Din26281), [Hertz, Roller]);
        assert_eq!(asked(&[], &ContactLaw::Din26281), [Din26281]);
    }
}
