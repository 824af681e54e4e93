//! Radii as made and as run, in words and JSON.

use crate::clutch::TrackRun;
use crate::design::Design;
use crate::margin::LoadState;
use crate::report::{Rows, Table, Unit};
use serde::Serialize;

/// One track of the JSON.
#[derive(Debug, Clone, Serialize)]
pub struct Track {
    /// Radius as made, mm.
    pub as_made_mm: f64,
    /// Growth by the press fit, um.
    pub by_fit_um: f64,
    /// Growth by temperature, um.
    pub by_temperature_um: f64,
    /// Radius as run, mm.
    pub as_run_mm: f64,
    /// Radius to make so that the one as run is that of the design file, enlarged as the sprags are.
    pub to_make_mm: f64,
    /// Pressure in the joint, MPa.
    pub joint_pressure_mpa: f64,
    /// Hoop stress of the fit at the track, MPa.
    pub fit_hoop_at_track_mpa: f64,
    /// The same at the joint, MPa.
    pub fit_hoop_at_joint_mpa: f64,
}

/// `running` of the JSON; null where the races run as made.
#[derive(Debug, Clone, Serialize)]
pub struct RunningSection {
    /// Inner track.
    pub inner: Track,
    /// Outer track.
    pub outer: Track,
    /// Growth of the sprags, um/mm.
    pub sprag_growth_um_per_mm: f64,
    /// By how much the contact at A turns from first contact as made to that as run, rad.
    pub first_contact_turn_rad: f64,
    /// Gap between the tracks as made, mm.
    pub gap_as_made_mm: f64,
    /// Gap as run, mm.
    pub gap_as_run_mm: f64,
    /// Gap as run under nominal torque; null without one on the curve.
    pub gap_nominal_mm: Option<f64>,
    /// Gap between the radii to make, loose and at the reference temperature.
    pub gap_to_make_mm: f64,
}

fn track(t: &TrackRun) -> Track {
    let mpa = |pa| Unit::Megapascal.from_si(pa);
    let mm = |m| Unit::Millimetre.from_si(m);
    let um = |m| Unit::Micrometre.from_si(m);
    Track {
        as_made_mm: mm(t.made_m),
        by_fit_um: um(t.by_fit_m),
        by_temperature_um: um(t.by_temperature_m),
        as_run_mm: mm(t.made_m + t.by_fit_m + t.by_temperature_m),
        to_make_mm: mm(t.to_make_m),
        joint_pressure_mpa: mpa(t.joint_pressure_pa),
        fit_hoop_at_track_mpa: mpa(t.hoop_at_track_pa),
        fit_hoop_at_joint_mpa: mpa(t.hoop_at_joint_pa),
    }
}

impl RunningSection {
    pub(super) fn new(design: &Design, state: &LoadState) -> Option<Self> {
        let run = design.clutch.running.as_ref()?;
        let races = &design.clutch.races;
        let gap_m = races.outer_radius_m - races.inner_radius_m;
        let opened = |torque: f64| {
            let (_, c) = state.curve.closure_at_torque(torque)?;
            Some(gap_m + c.deformations.race_inner.v + c.deformations.race_outer.v)
        };
        Some(Self {
            inner: track(&run.inner),
            outer: track(&run.outer),
            sprag_growth_um_per_mm: 1e3 * (run.sprag_scale - 1.0),
            first_contact_turn_rad: run.first_turn_rad,
            gap_as_made_mm: Unit::Millimetre.from_si(run.outer.made_m - run.inner.made_m),
            gap_as_run_mm: Unit::Millimetre.from_si(gap_m),
            gap_nominal_mm: design
                .limits
                .nominal_torque_nm
                .and_then(opened)
                .map(|g| Unit::Millimetre.from_si(g)),
            gap_to_make_mm: Unit::Millimetre.from_si(run.outer.to_make_m - run.inner.to_make_m),
        })
    }

    /// Radii and gap in words, a line each.
    pub fn remarks(&self) -> Vec<String> {
        let nominal = self.gap_nominal_mm.map_or(String::new(), |g| format!(", {g:.4} mm at nominal torque"));
        vec![
            format!(
                "Radii as made {:.4}/{:.4} mm, as run (fits, temperatures; all figures here are of these) {:.4}/{:.4} mm; \
                 gap {:.4} mm as made, {:.4} mm as run{nominal}",
                self.inner.as_made_mm,
                self.outer.as_made_mm,
                self.inner.as_run_mm,
                self.outer.as_run_mm,
                self.gap_as_made_mm,
                self.gap_as_run_mm
            ),
            format!(
                "Radii to make so that the clutch runs with those of the design file, at nominal torque too: {:.4}/{:.4} mm",
                self.inner.to_make_mm, self.outer.to_make_mm
            ),
        ]
    }

    /// Radii as made and as run, what they fit and how they turned.
    pub fn table(&self) -> Table {
        Rows::of([("inner", &self.inner), ("outer", &self.outer)])
            .text("track", "Track", |(name, _)| *name)
            .number("as_made_mm", "As made, mm", Unit::One, 7, |(_, t)| t.as_made_mm)
            .number("by_fit_um", "By fit, µm", Unit::One, 4, |(_, t)| t.by_fit_um)
            .number("by_temperature_um", "By temperature, µm", Unit::One, 4, |(_, t)| t.by_temperature_um)
            .number("as_run_mm", "As run, mm", Unit::One, 7, |(_, t)| t.as_run_mm)
            .number("to_make_mm", "To make, mm", Unit::One, 7, |(_, t)| t.to_make_mm)
            .number("joint_pressure_mpa", "Joint pressure, MPa", Unit::One, 4, |(_, t)| t.joint_pressure_mpa)
            .number("fit_hoop_at_track_mpa", "Fit hoop, track, MPa", Unit::One, 4, |(_, t)| {
                t.fit_hoop_at_track_mpa
            })
            .number("fit_hoop_at_joint_mpa", "Fit hoop, joint, MPa", Unit::One, 4, |(_, t)| {
                t.fit_hoop_at_joint_mpa
            })
            .table()
    }
}
