//! The local contact laws, each described once: its name, what it reads, what it knows, its words.
//!
//! A further law is a variant and a row here, its approach in `contact`, and the line of `wedge::Elastic` that builds it.

use super::{Axial, Clutch, StressState};
use crate::material::Material;
use schemars::JsonSchema;
use serde::Deserialize;

/// A contact law by its name in the design file.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
#[expect(missing_docs, reason = "its row in LAWS says what each is")]
pub enum LawName {
    Roller,
    Din26281,
    Hertz,
    Slice,
    #[default]
    Elastic,
}

/// Local contact law of a clutch, with its constants.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ContactLaw {
    /// delta_H = K N^0.9 / l^0.8 with the coefficient K in (mm, N).
    Roller {
        /// K, mm and N.
        coefficient: f64,
    },
    /// The roller law with DIN 26281's K = 3.97e-5.
    Din26281,
    /// Logarithmic line-contact approach; knows the radius, averaged over the patch where it straddles a junction.
    Hertz,
    /// Plane elasticity of rings, sprag and layer: nothing fitted, nothing counted twice; knows the radius as above.
    Elastic {
        /// Stress state of bodies and rings.
        state: StressState,
    },
    /// Slice method (1)-(4); compliance from the roller law, so it feels the radius only through the half width in the
    /// influence of slice on slice: a few 1e-5 of the approach at a junction. Number of slices from [`Axial`].
    Slice {
        /// K of the roller law, mm and N.
        coefficient: f64,
    },
}

/// What is to be said of a law whatever the clutch.
#[derive(Debug)]
pub struct LawFacts {
    /// The law.
    pub name: LawName,
    /// Its name in design files, on the command line and in JSON.
    pub key: &'static str,
    /// One line for help.
    pub title: &'static str,
    /// Whether it reads `contact.roller_coefficient`.
    pub reads_coefficient: bool,
    /// Whether it reads `contact.stress_state`.
    pub reads_stress_state: bool,
    /// Whether the approach depends on the radii; what does also takes the mean curvature under a contact that straddles
    /// a junction. Approach over force is then a logarithm, otherwise the power N^0.9.
    pub knows_radius: bool,
    /// Whether the approach follows end profile and tilt; the roller laws spread the load evenly.
    pub knows_shape: bool,
    /// Whether it holds the compression of the sprag's body and of races wider than the sprags, and the rings bend
    /// between the sprags: then (6) is left out.
    pub whole_bodies: bool,
    /// Whether it holds the bulk that (6) adds again.
    pub overlaps_body: bool,
    /// Largest error of windup, and of forces and angles, found beside finite elements, relative; [`Clutch::law_error`] has that
    /// of a clutch.
    pub beside_fem: [f64; 2],
    words: fn(&ContactLaw, &Axial) -> String,
}

/// Windup 3 to 20 % off beside finite elements of six clutches, forces to 1.5 %.
const ROLLER: LawFacts = LawFacts {
    name: LawName::Roller,
    key: "roller",
    title: "Roller law, coefficient of the design (or 3.944e-5, mm and N)",
    reads_coefficient: true,
    reads_stress_state: false,
    knows_radius: false,
    knows_shape: false,
    whole_bodies: false,
    overlaps_body: true,
    beside_fem: [0.20, 0.015],
    words: |law, _| {
        format!(
            "roller, K = {:e} (mm, N): approach K N^0.9/l^0.8 of a steel roller between plates, whatever the radii",
            law.coefficient()
        )
    },
};

/// Every law, in the order of [`LawName`].
pub const LAWS: [LawFacts; 5] = [
    ROLLER,
    LawFacts {
        name: LawName::Din26281,
        key: "din26281",
        title: "Roller law with the coefficient of DIN 26281",
        reads_coefficient: false,
        words: |_, _| {
            "din26281: the roller law with the coefficient of DIN 26281, K = 3.97e-5 (mm, N)".to_owned()
        },
        ..ROLLER
    },
    LawFacts {
        name: LawName::Hertz,
        key: "hertz",
        title: "Logarithmic line contact, knows the radius",
        reads_coefficient: false,
        knows_radius: true,
        knows_shape: true,
        overlaps_body: false,
        words: |_, _| {
            "hertz: logarithmic approach of a line contact, down to half the sprag's height and through the race's \
             wall; knows the radii"
                .to_owned()
        },
        ..ROLLER
    },
    LawFacts {
        name: LawName::Slice,
        key: "slice",
        title: "Slice method (1)-(4), slices of the design (or 60)",
        knows_shape: true,
        words: |law, axial| {
            format!(
                "slice, K = {:e} (mm, N), {} slices: (1)-(4), the roller law shared over slices that influence one \
                 another; at a square end its pressure grows with the number of slices",
                law.coefficient(),
                axial.slices
            )
        },
        ..ROLLER
    },
    LawFacts {
        name: LawName::Elastic,
        key: "elastic",
        title: "Plane elasticity of rings, sprag and layer; knows the radius, matches finite elements",
        reads_coefficient: false,
        reads_stress_state: true,
        knows_radius: true,
        knows_shape: true,
        whole_bodies: true,
        overlaps_body: false,
        // Thirteen clutches, at 3.4 GPa; unlike bodies have a row below.
        beside_fem: [0.007, 0.004],
        words: |law, _| {
            format!(
                "elastic, {}: exact plane elasticity of each ring under its contacts and of the sprag's outline, \
                 contacts that give and creep along the tracks, nothing fitted and no bulk counted twice; up to 3.5 GPa windup \
                 within 0.7 % of finite elements where sprags and races are of like steel, 1.1 % where they are not (thirteen \
                 clutches)",
                match law.stress_state() {
                    StressState::Layer => {
                        "layer (plane strain near the contact, plane stress farther away)"
                    }
                    StressState::PlaneStrain => "plane strain",
                    StressState::PlaneStress => "plane stress",
                }
            )
        },
    },
];

/// Coefficient of the roller law where a design gives none, mm and N: the public model of the paper's clutch.
pub(crate) const ROLLER_COEFFICIENT: f64 = 3.944e-5;

/// The same of law `elastic` between unlike bodies: a soft solid shaft, ceramic sprags.
const UNLIKE_BESIDE_FEM: [f64; 2] = [0.011, 0.005];
/// Difference of moduli from which bodies are unlike: a choice, the scatter among steels.
const LIKE: f64 = 0.02;

impl Clutch {
    /// Largest error of windup, and of forces and angles, of this clutch's law beside finite elements of clutches like it,
    /// relative.
    pub fn law_error(&self) -> [f64; 2] {
        let m = &self.materials;
        let unlike = |race: &Material| {
            (race.plane_strain_compliance() / m.sprag.plane_strain_compliance()).ln().abs() > LIKE
        };
        match self.contact {
            ContactLaw::Elastic { .. } if unlike(&m.inner_race) || unlike(&m.outer_race) => UNLIKE_BESIDE_FEM,
            law => law.facts().beside_fem,
        }
    }
}

impl LawName {
    /// What is to be said of it.
    pub fn facts(self) -> &'static LawFacts {
        &LAWS[self as usize]
    }

    /// The law with a roller coefficient (mm, N) and a stress state, of which it takes what it reads.
    pub fn with(self, coefficient: f64, state: StressState) -> ContactLaw {
        match self {
            Self::Roller => ContactLaw::Roller { coefficient },
            Self::Din26281 => ContactLaw::Din26281,
            Self::Hertz => ContactLaw::Hertz,
            Self::Slice => ContactLaw::Slice { coefficient },
            Self::Elastic => ContactLaw::Elastic { state },
        }
    }

    /// The law of that name, with what `design` has of its constants.
    pub fn beside(self, design: &ContactLaw) -> ContactLaw {
        self.with(design.coefficient(), design.stress_state())
    }
}

impl ContactLaw {
    /// Its name.
    pub fn name(&self) -> LawName {
        match self {
            Self::Roller { .. } => LawName::Roller,
            Self::Din26281 => LawName::Din26281,
            Self::Hertz => LawName::Hertz,
            Self::Slice { .. } => LawName::Slice,
            Self::Elastic { .. } => LawName::Elastic,
        }
    }

    /// What is to be said of it.
    pub fn facts(&self) -> &'static LawFacts {
        self.name().facts()
    }

    /// The law with its constants, and what it is.
    pub fn description(&self, axial: &Axial) -> String {
        (self.facts().words)(self, axial)
    }

    /// The roller coefficient that it was given, mm and N.
    pub fn roller_coefficient(&self) -> Option<f64> {
        match *self {
            Self::Roller { coefficient } | Self::Slice { coefficient } => Some(coefficient),
            Self::Din26281 | Self::Hertz | Self::Elastic { .. } => None,
        }
    }

    /// The same; that of the paper's clutch where it has none.
    fn coefficient(&self) -> f64 {
        self.roller_coefficient().unwrap_or(ROLLER_COEFFICIENT)
    }

    /// Its stress state; that of a body of finite length where it has none.
    fn stress_state(&self) -> StressState {
        match *self {
            Self::Elastic { state } => state,
            _ => StressState::Layer,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_finds_its_own_row_and_law() {
        for (i, facts) in LAWS.iter().enumerate() {
            let law = facts.name.with(4e-5, StressState::PlaneStress);
            assert_eq!((facts.name as usize, law.name()), (i, facts.name));
            assert!(law.description(&Axial::STRAIGHT).starts_with(facts.key), "{facts:?}");
            assert_eq!(facts.reads_coefficient, law.description(&Axial::STRAIGHT).contains("4e-5"));
        }
    }

    #[test]
    fn a_law_takes_the_constants_that_the_design_has() {
        let design = ContactLaw::Slice { coefficient: 3.84e-5 };
        assert_eq!(LawName::Roller.beside(&design), ContactLaw::Roller { coefficient: 3.84e-5 });
        assert_eq!(LawName::Roller.beside(&ContactLaw::Hertz), ContactLaw::Roller { coefficient: 3.944e-5 });
        let roller = ContactLaw::Roller { coefficient: 4e-5 };
        assert_eq!(LawName::Slice.beside(&roller), ContactLaw::Slice { coefficient: 4e-5 });
        let strain = ContactLaw::Elastic { state: StressState::PlaneStrain };
        assert_eq!(LawName::Elastic.beside(&strain), strain);
    }
}
