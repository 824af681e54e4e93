//! Curves of one design with what was asked beside them: finite elements, pressure along the length.

use super::fem::{self, Fem, FemPoint};
use super::pressure::{PressureBody, PressureMap};
use super::{LawCurve, NoStiffness, StiffnessAnswer, StiffnessBody, StiffnessSettings, curves, page, tables};
use crate::answer::{Answer, Envelope, Finding, Provenance};
use crate::design::Design;
use crate::margin::NoMargins;
use crate::profile::Profile;
use crate::report::{Page, Screen, Table};
use crate::wedge::Lengthwise;
use serde::Serialize;
use std::time::Instant;

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
    /// Curves of `design` beside `fem`, with the pressure along the length where that is asked for or the contacts are not straight;
    /// [`StiffnessSettings::follow`] is told of every law that is done.
    ///
    /// # Errors
    /// [`NoStiffness`].
    pub fn of(
        design: Design,
        settings: &StiffnessSettings,
        fem: Option<Fem>,
        pressure: Option<Lengthwise>,
    ) -> Result<Self, NoStiffness> {
        let started = Instant::now();
        settings.validate()?;
        let profile = design.clutch.profile().map_err(|e| NoStiffness::NoClutch(NoMargins::Profile(e)))?;
        let laws = curves(&design, &profile, settings)?;
        let shaped = (!design.clutch.axial.is_straight()).then_some(Lengthwise::Slices);
        let map = |(law, how)| PressureMap::of(law, how).map_err(NoStiffness::Pressure);
        let pressure = laws.first().zip(pressure.or(shaped)).map(map).transpose()?;
        let run_time_s = started.elapsed().as_secs_f64();
        let found = StiffnessAnswer::of(laws, design.limits.largest_torque_nm());
        Ok(Self { design, profile, found, fem, pressure, run_time_s })
    }

    pub(super) fn laws(&self) -> &[LawCurve] {
        &self.found.laws
    }
}

impl Answer for StiffnessStudy {
    type Body<'a> = StudyBody;

    /// Figures alone: limits are held by `check`.
    fn outcome(&self) -> Finding {
        Finding::Shown
    }

    fn verdict(&self) -> String {
        self.laws().first().map_or(String::new(), |law| page::banner(&self.design, law))
    }

    /// Every row of every law.
    fn table(&self) -> Table {
        self.found.table()
    }

    fn text(&self, screen: Screen) -> String {
        tables::text(self, screen)
    }

    fn page(&self, provenance: &Provenance) -> Page {
        page::page(std::slice::from_ref(self), &provenance.command)
    }

    fn envelope(&self, run_time_s: f64) -> Envelope<'_, StudyBody> {
        Envelope {
            design: &self.design,
            run_time_s,
            left_out: self.found.left_out.clone(),
            error_estimate: Some(self.found.error_relative.into()),
            body: StudyBody {
                curves: self.found.body.clone(),
                fem: self.fem.as_ref().map(|fem| fem::points(self, fem)),
                pressure: self.pressure.as_ref().map(PressureMap::body),
            },
        }
    }
}
