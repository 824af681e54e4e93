//! What a first design answers: the design, its figures, and the alternatives.

use super::check::{REACHED_AT, ends_first, far_more_than_asked, margin_words, people_table, size_line};
use super::left_out::left_out_of;
use super::page::opened;
use super::{Envelope, Provenance};
use crate::design::shown;
use crate::follow::Follow;
use crate::margin::{Margin, load_state, lowest_capacity};
use crate::report::{Cell, Drawing, Page, Rows, Screen, SpragPose, Table, Unit};
use crate::size::{Made, Sized, Tried};
use serde_json::{Value, json};

/// A first design, with every race space that was tried.
#[derive(Debug, Clone)]
pub struct Sizing<'a> {
    sized: &'a Sized,
    /// End of the curve, N m.
    end_nm: f64,
    /// What one should not overlook.
    warnings: Vec<String>,
}

impl<'a> Sizing<'a> {
    /// Of what was found.
    pub fn of(sized: &'a Sized) -> Self {
        // Of a design whose margins are known there is a curve.
        let (design, made) = (&sized.made.design, &sized.made);
        let state = load_state(design);
        let end_nm = state.as_ref().map_or(f64::INFINITY, |state| state.curve.end_torque_nm());
        let overruns = state.ok().and_then(|state| design.overruns(&state, &Follow::nobody()).ok());
        let limits = &design.limits;
        let asked_nm = limits.largest_torque_nm().unwrap_or(0.0);
        let carries_nm = lowest_capacity(&made.margins, |_| true).map_or(0.0, |(_, nm)| nm.min(end_nm));
        let far = far_more_than_asked(asked_nm, carries_nm);
        Self {
            sized,
            end_nm,
            warnings: overruns
                .and_then(|(section, _)| section.warning)
                .into_iter()
                .chain(far)
                .chain(no_shaft(2.0 * design.clutch.races.inner_bore_radius_m, asked_nm))
                .collect(),
        }
    }

    /// The answer with the keys that all answers share; `run_time_s`: what it took, s; `written`: where the design is.
    pub fn envelope(&self, run_time_s: f64, written: Option<&str>) -> Envelope<'a, Value> {
        let (sized, made) = (self.sized, &self.sized.made);
        let design = &made.design;
        let body = json!({
            "sized": true,
            "written": written,
            "outside_mm": Unit::Millimetre.from_si(2.0 * design.clutch.races.outer_outside_radius_m),
            "width_mm": Unit::Millimetre.from_si(design.clutch.races.width_m),
            "mass_g": Unit::Gram.from_si(made.mass_kg),
            "drag_torque_nm": made.drag.map(|d| d.torque_nm),
            "heat_w": made.drag.map(|d| d.heat_w()),
            "sliding_rpm": made.drag.map(|d| Unit::Rpm.from_si(d.sliding_rad_s)),
            "tried": tried_json(&sized.tried, Some(sized.taken)),
            "warnings": self.warnings,
            "margins": made.margins.iter().map(|r| margin_json(r, self.end_nm)).collect::<Vec<_>>(),
        });
        Envelope { design, run_time_s, left_out: left_out_of(design), error_estimate: None, body }
    }

    /// Every race space tried.
    pub fn csv_table(&self) -> Table {
        tried_table(&self.sized.tried, Some(self.sized.taken))
    }

    /// The answer on a terminal; `written`: where the design is.
    pub fn text(&self, written: Option<&str>, screen: Screen) -> String {
        text(self, written, screen)
    }

    /// The answer as a page under `title`.
    pub fn page(&self, title: &str, provenance: &Provenance, written: Option<&str>) -> Page {
        let (sized, made) = (self.sized, &self.sized.made);
        let design = &made.design;
        let mut page = opened(title, design, &provenance.command, |page| {
            page.verdict(true, &verdict(sized)).list(figures(made).into_iter().chain(self.warnings.clone()));
        });
        page.heading("Alternatives").paragraph(
            "Every race space (gap between the tracks) tried, each as narrow as its limits allow; of those that do it the one of the least \
             volume, from bore to outside, is taken. All at one scale.",
        );
        alternatives(&mut page, sized);
        page.table(&no_flanks(&sized.tried).unwrap_or_default(), &self.csv_table());
        page.heading("Margins").table(REACHED_AT, &people_table(&made.margins, self.end_nm));
        self.envelope(provenance.run_time_s, written).close(&mut page);
        page
    }
}

/// Shear stress that no shaft bears, Pa: hardened steel yields at some 700 MPa.
const SHAFT_PA: f64 = 500e6;

/// A warning where the shaft that fills the bore, diameter in m, could not bring the torque, N m: tau = 16 T/(pi d^3).
fn no_shaft(bore_m: f64, torque_nm: f64) -> Option<String> {
    let shear_pa = 16.0 * torque_nm / (std::f64::consts::PI * bore_m.powi(3));
    (shear_pa > SHAFT_PA).then(|| {
        format!(
            "Warning: a solid shaft that fills the bore of {} would be sheared by {} at {}; is the bore in millimetres and the torque \
             in Nm?",
            Unit::Millimetre.show_plain(bore_m, 4),
            Unit::Megapascal.show(shear_pa, 3),
            Unit::NewtonMetre.show(torque_nm, 4)
        )
    })
}

/// Size, mass, drag and heat, a line each.
fn figures(made: &Made) -> Vec<String> {
    let size = size_line(&made.design);
    let drag = made.drag.map(|d| match (d.torque_nm > 0.0, d.sliding_rad_s > 0.0) {
        (false, _) => "In overrun as asked for the sprags are off: no drag, no heat".to_owned(),
        (true, false) => format!(
            "Drag in slow overrun {}: {} of heat at 1000 rpm",
            Unit::NewtonMetre.show(d.torque_nm, 3),
            Unit::Watt.show(d.torque_nm * 1000.0 / Unit::Rpm.from_si(1.0), 3)
        ),
        (true, true) => format!(
            "In overrun, sliding at {}: drag {}, heat {}",
            Unit::Rpm.show_plain(d.sliding_rad_s, 5),
            Unit::NewtonMetre.show(d.torque_nm, 3),
            Unit::Watt.show(d.heat_w(), 3)
        ),
    });
    std::iter::once(size).chain(drag).collect()
}

fn verdict(sized: &Sized) -> String {
    let s = &sized.made.design.clutch.sprags;
    let decides = sized.made.least();
    format!(
        "{} sprags of {} in a race space of {}; {}",
        s.count,
        Unit::Millimetre.show_plain(s.length_m, 4),
        Unit::Millimetre.show_plain(sized.tried[sized.taken].space_m, 4),
        decides.map_or(String::new(), |r| format!("{} decides, {}", r.code(), margin_words(r)))
    )
}

/// A small drawing of each that does it.
fn alternatives(page: &mut Page, sized: &Sized) {
    let made: Vec<(usize, &Tried, &Made)> =
        sized.tried.iter().enumerate().filter_map(|(i, t)| Some((i, t, t.made.as_ref()?))).collect();
    let widest =
        made.iter().map(|(_, _, m)| m.design.clutch.races.outer_outside_radius_m).fold(0.0, f64::max);
    let drawn = |(i, tried, made): &(usize, &Tried, &Made)| {
        let clutch = &made.design.clutch;
        let profile = clutch.profile().ok()?;
        let pose = SpragPose::at_rest("first contact", &clutch.sprags, &profile);
        let word = if *i == sized.taken { "Taken: race" } else { "Race" };
        let caption = format!(
            "{word} space {}, {} sprags; {}",
            Unit::Millimetre.show_plain(tried.space_m, 4),
            tried.count,
            figures(made).join(". ")
        );
        Some((Drawing::of(clutch, vec![pose]).small_svg(widest), caption))
    };
    let drawn: Vec<(String, String)> = made.iter().filter_map(drawn).collect();
    let figures: Vec<(String, &str)> = drawn.iter().map(|(svg, c)| (svg.clone(), c.as_str())).collect();
    page.figures(&figures);
}

fn text(sizing: &Sizing<'_>, written: Option<&str>, screen: Screen) -> String {
    let (sized, design) = (sizing.sized, &sizing.sized.made.design);
    let tried = tried_table(&sized.tried, Some(sized.taken)).to_text(screen);
    format!(
        "{}  {}\n\n{tried}{}\n{}\n{}\n{}\n{REACHED_AT}\n{}\n",
        design.name,
        design.short_hash(),
        no_flanks(&sized.tried).map_or(String::new(), |line| line + "\n"),
        people_table(&sized.made.margins, sizing.end_nm).to_text(screen),
        verdict(sized),
        figures(&sized.made).into_iter().chain(sizing.warnings.clone()).collect::<Vec<_>>().join("\n"),
        written.map_or("no design written".to_owned(), |path| format!("written to {}", shown(path)))
    )
}

/// What flanks are, where they decided a race space.
fn no_flanks(tried: &[Tried]) -> Option<String> {
    let any = tried.iter().any(|t| t.decided_by == "flanks");
    any.then(|| "flanks: the sides of a sprag's body between its two profiles; none fit there".to_owned())
}

/// Every race space tried; `taken`: the one of the answer.
pub fn tried_table(tried: &[Tried], taken: Option<usize>) -> Table {
    let word = |i: usize, t: &Tried| match (taken == Some(i), t.held) {
        (true, _) => "taken",
        (false, true) => "possible",
        (false, false) => "NOT POSSIBLE",
    };
    let of = |t: &Tried, value: fn(&Made) -> f64| t.made.as_ref().map(value);
    // Of what finds no room there is no length.
    let carries = |t: &Tried, value: f64| (t.carries_nm > 0.0).then_some(value);
    Rows::of(tried.iter().enumerate())
        .number("race_space_mm", "Race space", Unit::Millimetre, 4, |(_, t)| t.space_m)
        .number("count", "Sprags", Unit::One, 3, |(_, t)| t.count)
        .number("length_mm", "Length", Unit::Millimetre, 4, |(_, t)| carries(t, t.length_m))
        .number("outside_mm", "⌀", Unit::Millimetre, 4, |(_, t)| {
            of(t, |made| 2.0 * made.design.clutch.races.outer_outside_radius_m)
        })
        .number("mass_g", "Mass", Unit::Gram, 4, |(_, t)| of(t, |made| made.mass_kg))
        .number("carries_nm", "Carries", Unit::NewtonMetre, 4, |(_, t)| carries(t, t.carries_nm))
        .text("decided_by", "Decided by", |(_, t)| t.decided_by.as_str())
        .text("verdict", "", |(i, t)| Cell::Verdict(t.held, word(*i, t).to_owned()))
        .table()
}

/// The same as JSON.
pub fn tried_json(tried: &[Tried], taken: Option<usize>) -> Vec<Value> {
    tried
        .iter()
        .enumerate()
        .map(|(i, t)| {
            let of = |value: fn(&Made) -> f64| t.made.as_ref().map(value);
            json!({
                "race_space_mm": Unit::Millimetre.from_si(t.space_m), "count": t.count,
                "length_mm": Unit::Millimetre.from_si(t.length_m), "carries_nm": t.carries_nm,
                "outside_mm": of(|m| 2e3 * m.design.clutch.races.outer_outside_radius_m),
                "width_mm": of(|m| 1e3 * m.design.clutch.races.width_m), "mass_g": of(|m| 1e3 * m.mass_kg),
                "decided_by": t.decided_by, "possible": t.held, "taken": taken == Some(i),
            })
        })
        .collect()
}

fn margin_json(r: &Margin, end_nm: f64) -> Value {
    json!({
        "code": r.code(), "demand": r.demand_in_unit(), "allowable": r.shown_allowable(), "unit": r.limit.unit,
        "margin": r.margin(), "slip_margin": r.slip_margin(),
        "torque_capacity_nm": r.torque_capacity_nm, "capacity_beyond_end": ends_first(r, end_nm), "held": r.held(),
    })
}
