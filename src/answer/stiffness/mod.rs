//! What the stiffness study answers: the static curve at rest by contact law, at the torques asked for.

mod body;
mod fem;
mod junctions;
mod page;
mod pressure;
mod study;
mod tables;

pub use body::{CurveBody, CurveEnd, CurvePoint, Law, StiffnessBody};
pub use fem::{Distance, Fem, FemPoint, FemRow};
pub use junctions::{Junction, junctions};
pub use page::page;
pub use pressure::{ContactBody, PeakBody, PressureBody, PressureMap, PressureRow};
pub use study::{StiffnessStudy, StudyBody};

use super::left_out::{LeftOut, at_rest, left_out};
use crate::clutch::{Clutch, ContactLaw, LawName};
use crate::contact::ContactError;
use crate::design::Design;
use crate::follow::{Follow, News};
use crate::margin::NoMargins;
use crate::profile::Profile;
use crate::report::Table;
use crate::wedge::{RollOver, SMALLEST_TORQUE_NM, StaticPoint, WedgeCurve};
use rayon::prelude::*;
use serde::{Serialize, Serializer};

/// Rows of an even table.
const EVEN_ROWS: usize = 20;

/// Which curves, and where they are read. The default: the design's own law, 20 even rows.
#[derive(Debug, Clone, Default)]
pub struct StiffnessSettings {
    /// Contact laws, each counted once; none: the design's.
    pub laws: Vec<LawName>,
    /// Torques, N m; none: an even table.
    pub torques_nm: Vec<f64>,
    /// Largest torque of an even table, N m; `None`: the design's peak torque, or the first end of a curve if that is less.
    pub max_torque_nm: Option<f64>,
    /// Ends the computation.
    pub follow: Follow,
}

/// One law's curve and the rows asked for.
#[derive(Debug, Clone)]
pub struct LawCurve {
    /// The law.
    pub name: LawName,
    /// The clutch with this law.
    pub clutch: Clutch,
    /// Its curve at rest.
    pub curve: WedgeCurve,
    /// The same with local deformation alone.
    pub local: WedgeCurve,
    /// Static point at each torque of the table; none beyond the curve's end.
    pub rows: Vec<(f64, Option<StaticPoint>)>,
    /// What comes after the end of the curve.
    pub beyond: Option<RollOver>,
}

/// Curves with what they leave out. As JSON it is the object of `stiffness --json` without the keys that all commands share.
#[derive(Debug, Clone)]
pub struct StiffnessAnswer {
    /// The curves.
    pub laws: Vec<LawCurve>,
    /// Largest relative error of the curves.
    pub error_relative: f64,
    /// What the model leaves out, each with its cost.
    pub left_out: Vec<LeftOut>,
    /// The figures by their keys in JSON.
    pub body: StiffnessBody,
}

impl Serialize for StiffnessAnswer {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.body.serialize(serializer)
    }
}

/// Why there are no curves.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NoStiffness {
    /// There is no clutch to speak of.
    #[error("{0}")]
    NoClutch(NoMargins),
    /// A torque, N m, that is none or smaller than the curve resolves.
    #[error("a torque of {}", allowed_torque(*.0))]
    Torque(f64),
    /// The pressure along the length was not found.
    #[error("no pressure along the length: {0}")]
    Pressure(ContactError),
    /// [`Follow`] was stopped.
    #[error("stopped before every curve was known")]
    Stopped,
}

fn allowed_torque(nm: f64) -> String {
    match nm.abs() < SMALLEST_TORQUE_NM {
        true => format!("{nm:e} Nm is too small: allowed from {SMALLEST_TORQUE_NM:e} Nm up"),
        false => format!("{nm} Nm: allowed are finite ones from {SMALLEST_TORQUE_NM:e} Nm up"),
    }
}

impl StiffnessSettings {
    /// Refuse torques that no curve is read at.
    ///
    /// # Errors
    /// [`NoStiffness::Torque`].
    pub fn validate(&self) -> Result<(), NoStiffness> {
        let least = self.max_torque_nm.map(|t| t / EVEN_ROWS as f64);
        let wrong = |t: &f64| !(*t >= SMALLEST_TORQUE_NM && t.is_finite());
        match self.torques_nm.iter().copied().chain(least).find(wrong) {
            Some(torque) => Err(NoStiffness::Torque(torque)),
            None => Ok(()),
        }
    }

    /// Each law once, in the order asked; the design's own if none was.
    pub fn laws_of(&self, design: &ContactLaw) -> Vec<LawName> {
        let mut list: Vec<LawName> = Vec::new();
        for &name in &self.laws {
            if !list.contains(&name) {
                list.push(name);
            }
        }
        if list.is_empty() { vec![design.name()] } else { list }
    }
}

impl Design {
    /// The static curve at rest, torque against windup, forces, angles, stiffness, pressure, by contact law.
    ///
    /// ```
    /// use sprag_design::{Design, answer::stiffness::StiffnessSettings};
    ///
    /// let design = Design::read("designs/huang2017-multi-arc.toml".as_ref())?;
    /// let answer = design.stiffness(&StiffnessSettings { torques_nm: vec![3.34, 16.8], ..StiffnessSettings::default() })?;
    /// let points = &answer.body.laws[0].curve.points;
    /// assert!((points[1].windup_deg - 1.975).abs() < 0.03);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`NoStiffness`].
    pub fn stiffness(&self, settings: &StiffnessSettings) -> Result<StiffnessAnswer, NoStiffness> {
        settings.validate()?;
        let profile = self.clutch.profile().map_err(|e| NoStiffness::NoClutch(NoMargins::Profile(e)))?;
        Ok(StiffnessAnswer::of(curves(self, &profile, settings)?, self.limits.largest_torque_nm()))
    }
}

impl StiffnessAnswer {
    /// All that is said of curves; what the model leaves out at `asked_nm`, N m.
    pub fn of(laws: Vec<LawCurve>, asked_nm: Option<f64>) -> Self {
        // A term that one of the laws compared does hold is left out by the others all the same.
        let mut terms: Vec<LeftOut> = Vec::new();
        for term in laws.iter().flat_map(|l| left_out(&l.clutch, asked_nm)) {
            if terms.iter().all(|t| t.term != term.term) {
                terms.push(term);
            }
        }
        terms.push(at_rest());
        let error_relative = laws.iter().map(|l| l.curve.truncation()).fold(0.0, f64::max);
        Self { body: StiffnessBody::of(&laws), laws, error_relative, left_out: terms }
    }

    /// Every row of every law, for programs.
    pub fn table(&self) -> Table {
        tables::csv_table(&self.laws)
    }
}

/// Curves of the laws asked for, side by side, and their rows; [`StiffnessSettings::follow`] is told of every law that is done.
///
/// # Errors
/// [`NoStiffness`].
fn curves(
    design: &Design,
    profile: &Profile,
    settings: &StiffnessSettings,
) -> Result<Vec<LawCurve>, NoStiffness> {
    let none = |e| NoStiffness::NoClutch(NoMargins::Curve(e));
    let curves = settings
        .laws_of(&design.clutch.contact)
        .into_par_iter()
        .map(|name| {
            if settings.follow.stopped() {
                return Err(NoStiffness::Stopped);
            }
            let contact = name.beside(&design.clutch.contact);
            let clutch = Clutch { contact, ..design.clutch.clone() };
            let curve = WedgeCurve::build(&clutch, profile, 0.0).map_err(none)?;
            let local = WedgeCurve::build_local(&clutch, profile).map_err(none)?;
            settings.follow.news(News::Done);
            Ok((name, clutch, curve, local))
        })
        .collect::<Result<Vec<_>, NoStiffness>>()?;
    let torques = torques(settings, design, &curves);
    let laws = curves.into_par_iter().map(|(name, clutch, curve, local)| {
        let rows = torques.iter().map(|&t| (t, curve.at_torque(t))).collect();
        let beyond = curve.beyond(clutch.brink(profile).as_ref());
        LawCurve { name, clutch, curve, local, rows, beyond }
    });
    Ok(laws.collect())
}

/// Torques of the table, N m: those asked for, or an even table up to the largest asked for or the last end of a curve, else up to the
/// design's peak torque or the first end of a curve, whichever comes first.
fn torques(
    settings: &StiffnessSettings,
    design: &Design,
    curves: &[(LawName, Clutch, WedgeCurve, WedgeCurve)],
) -> Vec<f64> {
    if !settings.torques_nm.is_empty() {
        return settings.torques_nm.clone();
    }
    let first_end = curves.iter().map(|c| c.2.end_torque_nm()).fold(f64::INFINITY, f64::min);
    let last_end = curves.iter().map(|c| c.2.end_torque_nm()).fold(0.0, f64::max);
    let largest = settings
        .max_torque_nm
        .map(|asked| asked.min(last_end))
        .unwrap_or_else(|| design.limits.peak_torque_nm.map_or(first_end, |peak| peak.min(first_end)));
    (1..=EVEN_ROWS).map(|i| largest * i as f64 / EVEN_ROWS as f64).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_law_once_and_the_designs_own_by_default() {
        use LawName::{Din26281, Hertz, Roller};
        let asked =
            |laws: &[LawName]| StiffnessSettings { laws: laws.to_vec(), ..StiffnessSettings::default() };
        assert_eq!(asked(&[Hertz, Roller, Hertz]).laws_of(&ContactLaw::Din26281), [Hertz, Roller]);
        assert_eq!(asked(&[]).laws_of(&ContactLaw::Din26281), [Din26281]);
    }

    #[test]
    fn a_torque_that_is_none_is_refused_with_what_is_allowed() {
        for (torque, word) in
            [(f64::NAN, "NaN"), (-1.0, "-1 Nm"), (1e-9, "too small"), (f64::INFINITY, "inf")]
        {
            let why = StiffnessSettings { torques_nm: vec![3.0, torque], ..StiffnessSettings::default() }
                .validate();
            assert!(why.is_err_and(|w| w.to_string().contains(word)), "{torque}");
        }
    }
}
