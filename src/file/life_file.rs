//! `[life]` as written, and the same in SI.
//!
//! In: TOML text, histories. Out: [`Service`]. Absent: what comes of it (`life`). Equations: none. The doc comments are the
//! schema's descriptions.

use super::design_file::DesignFile;
use super::findings::Findings;
use super::history::HistoryKind;
use super::scenario_file::ScenarioFile;
use super::scenarios::{KindFile, Load, refuse_history};
use crate::clutch::{
    CoreStrength, FatigueStrength, PittingStrength, RepeatedHistory, RepeatedLoad, RepeatedSwing, Service,
};
use crate::design::m;
use schemars::JsonSchema;
use serde::Deserialize;

/// What the clutch goes through in its life, and what its bodies bear again and again: read by `life`.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct LifeFile {
    /// Engagements by torque.
    #[serde(default)]
    pub loads: Vec<LoadFile>,
    /// Scenarios of kind torsional-excitation that go on for hours: each period is an engagement at the peak torque that the clutch then
    /// carries, and a swing of the rings down to the least.
    #[serde(default)]
    pub swings: Vec<SwingFile>,
    /// Scenarios of kind overrun that go on for hours: sprags and the race that they slide on wear in them, with the coefficients of
    /// `lubrication`. With a [cage] its `clearance_um` is to be above 0.
    #[serde(default)]
    pub overruns: Vec<SwingFile>,
    /// Torques over time, counted: peaks above half of the largest are an engagement each, rings by rainflow.
    #[serde(default)]
    pub histories: Vec<RepeatedFile>,
    /// What a contact of sprag and race bears; absent: no life until pitting.
    pub pitting: Option<PittingFile>,
    /// What the core bears below the hardened case, limits.case_depth_mm deep, of sprags and races; absent: no life of it.
    pub core: Option<CoreFile>,
    /// What the races bear as rings; absent: no life until they break.
    pub rings: Option<FatigueFile>,
    /// What the bodies of the sprags bear half way between their contacts, where `sprags.flanks` bound them; absent: no life until they
    /// break.
    pub sprags: Option<FatigueFile>,
    /// Whether every engagement finds the sprags at the same places of the races (indexing by whole turns); absent or false: anywhere.
    #[serde(default)]
    pub same_places: bool,
    /// Scatter of the static friction coefficient from engagement to engagement: standard deviation over mean, which is
    /// friction.static; 0: none, and no probability of slip.
    #[serde(default)]
    #[schemars(extend("minimum" = 0, "maximum" = 1))]
    pub friction_scatter: f64,
    /// The same of every torque of `loads` and `histories`, which are means.
    #[serde(default)]
    #[schemars(extend("minimum" = 0, "maximum" = 1))]
    pub torque_scatter: f64,
    /// How many slips by chance may be expected in the whole life; absent: they are counted, without a say in the verdict.
    #[schemars(extend("minimum" = 0))]
    pub slips_allowed: Option<f64>,
}

/// A torque that is carried again and again, from nothing to it and back.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct LoadFile {
    /// Torque, N m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub torque_nm: f64,
    /// Engagements at it in the life.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub engagements: f64,
}

/// A scenario that goes on for some time.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct SwingFile {
    /// Name of the scenario.
    #[schemars(length(min = 1))]
    pub scenario: String,
    /// How long in the life, hours.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub hours: f64,
}

/// A torque over time that recurs.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct RepeatedFile {
    /// CSV file in the folder of the design, header `time_s,torque_nm`; engaging torque positive.
    #[schemars(length(min = 1))]
    pub torque_history_csv: String,
    /// How often in the life.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub times: f64,
}

/// One point of the pitting life of the contacts and its slope: cycles = cycles (pressure/pressure_mpa)^-exponent.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct PittingFile {
    /// Largest Hertz pressure that is borne `cycles` times, MPa.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub pressure_mpa: f64,
    /// Load cycles at it, with the reliability that the life shall have.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub cycles: f64,
    /// Exponent of the pressure; absent: 20/3, twice the 10/3 of the load in ISO 281 for line contacts.
    #[serde(default = "line_contact")]
    #[schemars(extend("minimum" = 1, "maximum" = 50))]
    pub exponent: f64,
}

/// One point of the life of the core below the case and its slope: cycles = cycles (shear/shear_mpa)^-exponent.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct CoreFile {
    /// Largest shear below a contact, at limits.case_depth_mm and deeper, that is borne `cycles` times, MPa.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub shear_mpa: f64,
    /// Load cycles at it, with the reliability that the life shall have.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub cycles: f64,
    /// Exponent of the shear; absent: 20/3, as of the pressure at the surface.
    #[serde(default = "line_contact")]
    #[schemars(extend("minimum" = 1, "maximum" = 50))]
    pub exponent: f64,
}

/// ISO 281:2007: the life of line contacts goes with the load to the power -10/3, and the pressure with its root.
fn line_contact() -> f64 {
    20.0 / 3.0
}

/// One point of the life of a body under a stress about zero, its slope, and the strength of its steel.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct FatigueFile {
    /// Amplitude of the stress about zero (of a race: along its circumference) that is borne `cycles` times, MPa.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub amplitude_mpa: f64,
    /// Cycles at it, with the reliability that the life shall have.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub cycles: f64,
    /// Exponent of the amplitude.
    #[schemars(extend("minimum" = 1, "maximum" = 50))]
    pub exponent: f64,
    /// Tensile strength, MPa: a tensile mean stress takes its share of it (Goodman).
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub ultimate_mpa: f64,
}

/// `[life]` in SI; `None` with the reasons in `out`.
pub(super) fn service(
    whole: &DesignFile,
    file: &LifeFile,
    load: Load<'_>,
    out: &mut Findings,
) -> Option<Service> {
    if file.loads.is_empty() && file.swings.is_empty() && file.histories.is_empty() {
        let help = "add loads = [ { torque_nm = ..., engagements = ... } ], swings or histories".to_owned();
        out.refuse(&["life"], "a table with loads, swings or histories".to_owned(), help);
        return None;
    }
    for (i, swing) in file.swings.iter().enumerate() {
        let swings = |s: &&ScenarioFile| s.kind == KindFile::TorsionalExcitation;
        if !whole.scenarios.iter().filter(swings).any(|s| s.name == swing.scenario) {
            let known: Vec<&str> = whole.scenarios.iter().filter(swings).map(|s| s.name.as_str()).collect();
            let allowed = match known.as_slice() {
                [] => "none, because the file has no torsional-excitation".to_owned(),
                _ => known.join(", "),
            };
            let help = "name a torsional-excitation of this file, or add one of this name".to_owned();
            out.refuse(&[&format!("life.swings[{i}].scenario")], allowed, help);
            return None;
        }
    }
    if whole.cage.as_ref().is_some_and(|cage| cage.clearance_um == 0.0) && !file.overruns.is_empty() {
        out.refuse(
            &["cage.clearance_um", "cage", "life.overruns"],
            "above 0 with life.overruns: as sprags wear, their pivots go outward to stay on the outer race".to_owned(),
            "give what the pocket lets the pivot go outward, or remove life.overruns; `overrun` has the wear of an hour"
                .to_owned(),
        );
        return None;
    }
    for (i, overrun) in file.overruns.iter().enumerate() {
        let overruns = |s: &&ScenarioFile| s.kind == KindFile::Overrun;
        if !whole.scenarios.iter().filter(overruns).any(|s| s.name == overrun.scenario) {
            let known: Vec<&str> = whole.scenarios.iter().filter(overruns).map(|s| s.name.as_str()).collect();
            let allowed = match known.as_slice() {
                [] => "none, because the file has no overrun".to_owned(),
                _ => known.join(", "),
            };
            let help = "name an overrun of this file, or add one of this name".to_owned();
            out.refuse(&[&format!("life.overruns[{i}].scenario")], allowed, help);
            return None;
        }
    }
    if file.torque_scatter > 0.0 && file.friction_scatter == 0.0 {
        let help = "say how far the friction scatters, 0.10 or so; a catalogue's factor of safety hides it"
            .to_owned();
        out.refuse(&["life.friction_scatter"], "above 0 where the torque scatters".to_owned(), help);
        return None;
    }
    let mut histories = Some(Vec::new());
    for (i, entry) in file.histories.iter().enumerate() {
        let rows = load(&entry.torque_history_csv, HistoryKind::Torque);
        let key = format!("life.histories[{i}].torque_history_csv");
        match rows {
            Ok(rows) if rows.iter().any(|row| row[1] > 0.0) => {
                let one =
                    RepeatedHistory { name: entry.torque_history_csv.clone(), rows, times: entry.times };
                histories = histories.map(|all: Vec<_>| all.into_iter().chain([one]).collect());
            }
            Ok(_) => {
                let help = "name a history in which the clutch carries torque, or remove it".to_owned();
                out.refuse(&[&key], "a history with a torque above 0".to_owned(), help);
                histories = None;
            }
            Err(found) => {
                if let Some(found) = found {
                    refuse_history(&key, found, out);
                }
                histories = None;
            }
        }
    }
    let pa = |mpa: f64| mpa * 1e6;
    let core = match (file.core, whole.limits.case_depth_mm) {
        (None, _) => Some(None),
        (Some(c), Some(depth_mm)) => Some(Some(CoreStrength {
            shear_pa: pa(c.shear_mpa),
            depth_m: m(depth_mm),
            cycles: c.cycles,
            exponent: c.exponent,
        })),
        (Some(_), None) => {
            let help = "add case_depth_mm to [limits], or remove core from [life]".to_owned();
            out.refuse(
                &["life.core"],
                "only with limits.case_depth_mm, below which the core begins".to_owned(),
                help,
            );
            None
        }
    };
    let fatigue = |f: FatigueFile| FatigueStrength {
        amplitude_pa: pa(f.amplitude_mpa),
        cycles: f.cycles,
        exponent: f.exponent,
        ultimate_pa: pa(f.ultimate_mpa),
    };
    Some(Service {
        loads: file
            .loads
            .iter()
            .map(|l| RepeatedLoad { from_nm: 0.0, torque_nm: l.torque_nm, engagements: l.engagements })
            .collect(),
        swings: file
            .swings
            .iter()
            .map(|s| RepeatedSwing { scenario: s.scenario.clone(), duration_s: 3600.0 * s.hours })
            .collect(),
        overruns: file
            .overruns
            .iter()
            .map(|s| RepeatedSwing { scenario: s.scenario.clone(), duration_s: 3600.0 * s.hours })
            .collect(),
        histories: histories?,
        pitting: file.pitting.map(|p| PittingStrength {
            pressure_pa: pa(p.pressure_mpa),
            cycles: p.cycles,
            exponent: p.exponent,
        }),
        core: core?,
        rings: file.rings.map(fatigue),
        sprags: file.sprags.map(fatigue),
        same_places: file.same_places,
        friction_scatter: file.friction_scatter,
        torque_scatter: file.torque_scatter,
        slips_allowed: file.slips_allowed,
    })
}
