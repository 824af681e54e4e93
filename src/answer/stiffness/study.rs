//! Curves of one design with what was asked beside them: finite elements, pressure along the length.

use super::fem::{self, Fem, FemPoint};
use super::pressure::{PressureBody, PressureMap};
use super::{LawCurve, StiffnessAnswer, StiffnessBody, tables};
use crate::answer::Envelope;
use crate::design::Design;
use crate::profile::Profile;
use crate::report::Screen;
use serde::Serialize;

/// One design with all that was asked of its stiffness.
#[derive(Debug, Clone)]
pub struct StiffnessStudy {
    /// The design.
    pub design: Design,
    /// Its profile.
    pub profile: Profile,
    /// The curves.
    pub found: StiffnessAnswer,
    /// Finite elements to compare with.
    pub fem: Option<Fem>,
    /// Pressure along the length with the first law; absent: not asked for.
    pub pressure: Option<PressureMap>,
    /// Wall time of the computation, s.
    pub run_time_s: f64,
}

/// Keys of `stiffness`: the curves, and what was asked beside them.
#[derive(Debug, Clone, Serialize)]
pub struct StudyBody {
    /// The curves.
    #[serde(flatten)]
    pub curves: StiffnessBody,
    /// Finite elements and the distance of each law to them, in the order of the laws.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fem: Option<Vec<FemPoint>>,
    /// Pressure along the length.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pressure: Option<PressureBody>,
}

impl StiffnessStudy {
    pub(super) fn laws(&self) -> &[LawCurve] {
        &self.found.laws
    }

    /// The answer with the keys that all answers share.
    pub fn envelope(&self) -> Envelope<'_, StudyBody> {
        Envelope {
            design: &self.design,
            run_time_s: self.run_time_s,
            left_out: self.found.left_out.clone(),
            error_estimate: Some(self.found.error_relative.into()),
            body: StudyBody {
                curves: self.found.body.clone(),
                fem: self.fem.as_ref().map(|fem| fem::points(self, fem)),
                pressure: self.pressure.as_ref().map(PressureMap::body),
            },
        }
    }

    /// The answer on a terminal.
    pub fn text(&self, screen: Screen) -> String {
        tables::text(self, screen)
    }
}
