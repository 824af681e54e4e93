//! What a first design answers: the design, its figures, and the alternatives.

use super::check::{
    CheckRow, REACHED_AT, far_more_than_asked, margin_words, much_friction, people_table, size_line,
};
use super::{ByAlphabet, Finding, Said};
use crate::clutch::Scenario;
use crate::design::{Design, USUAL_SLIDING_RAD_S};
use crate::file::shown;
use crate::follow::Follow;
use crate::margin::{Demand, Margin, load_state, lowest_capacity, scene_demand, scene_rows};
use crate::report::{Cell, Drawing, Page, Rows, Screen, SpragPose, Table, Unit, significant};
use crate::scenario::Settings;
use crate::size::{Decider, Made, Requirements, Sized, Tried};
use serde::Serialize;

/// A first design, with every race space that was tried.
#[derive(Debug, Clone)]
pub struct Sizing<'a> {
    sized: &'a Sized,
    /// Title of its page.
    title: &'a str,
    /// Where the design was written, if it was.
    written: Option<&'a str>,
    /// End of the curve, N m.
    end_nm: f64,
    /// What one should not overlook.
    warnings: Vec<String>,
    /// Rows that are shown only, those of the scenes that do not count among them.
    shown: Vec<Margin>,
}

/// Keys of `size`.
#[derive(Debug, Clone, Serialize)]
pub struct SizingBody<'a> {
    /// Drag torque in overrun, N m.
    pub drag_torque_nm: Option<f64>,
    /// Heat of the drag in overrun, W.
    pub heat_w: Option<f64>,
    /// One row for each limit.
    pub margins: ByAlphabet<Vec<CheckRow>>,
    /// Mass of sprags and races, g.
    pub mass_g: f64,
    /// Outside diameter, mm.
    pub outside_mm: f64,
    /// True: a design was found.
    pub sized: bool,
    /// Speed at which the races slide on the sprags in overrun, rev/min.
    pub sliding_rpm: Option<f64>,
    /// Every race space tried, a row of [`tried`].
    pub tried: Rows<(usize, &'a Tried)>,
    /// What one should not overlook.
    pub warnings: &'a [String],
    /// Width of the races, mm.
    pub width_mm: f64,
    /// Where the design was written.
    pub written: Option<&'a str>,
}

impl<'a> SizingBody<'a> {
    fn of(sizing: &'a Sizing<'_>) -> Self {
        let (sized, made) = (sizing.sized, &sizing.sized.made);
        let races = &made.design.clutch.races;
        Self {
            sized: true,
            written: sizing.written,
            outside_mm: Unit::Millimetre.from_si(2.0 * races.outer_outside_radius_m),
            width_mm: Unit::Millimetre.from_si(races.width_m),
            mass_g: Unit::Gram.from_si(made.mass_kg),
            drag_torque_nm: made.drag.map(|d| d.torque_nm),
            heat_w: made.drag.map(|d| d.heat_w()),
            sliding_rpm: made.drag.map(|d| Unit::Rpm.from_si(d.sliding_rad_s)),
            tried: tried(&sized.tried, Some(sized.taken)),
            warnings: &sizing.warnings,
            margins: ByAlphabet(made.margins.iter().map(|r| CheckRow::of(r, sizing.end_nm)).collect()),
        }
    }
}

impl<'a> Sizing<'a> {
    /// Of what was found; `title`: that of the page, `written`: where the design is.
    pub fn of(sized: &'a Sized, title: &'a str, written: Option<&'a str>) -> Self {
        // Of a design whose margins are known there is a curve.
        let (design, made) = (&sized.made.design, &sized.made);
        let state = load_state(design);
        let end_nm = state.as_ref().map_or(f64::INFINITY, |state| state.curve.end_torque_nm());
        let overruns = state.ok().and_then(|state| design.overruns(&state, &Follow::nobody()).ok());
        let limits = &design.limits;
        let aside = design
            .scenarios
            .iter()
            .filter(|s| !design.check_scenarios.contains(&s.name) && !s.kind.is_overrun());
        let of_scene = |scenario: &Scenario| {
            scene_rows(scenario, &scene_demand(scenario, None, &Settings::default()), limits, false)
        };
        let shown = made.margins.iter().filter(|r| !r.required).cloned();
        let shown = shown.chain(aside.flat_map(of_scene)).collect();
        let asked_nm = limits.largest_torque_nm().unwrap_or(0.0);
        let carries_nm = lowest_capacity(&made.margins, |_| true).map_or(0.0, |(_, nm)| nm.min(end_nm));
        let far = far_more_than_asked(asked_nm, carries_nm);
        Self {
            sized,
            title,
            written,
            end_nm,
            warnings: overruns
                .and_then(|(section, _)| section.warning)
                .into_iter()
                .chain(far)
                .chain(much_friction(design))
                .chain(no_shaft(2.0 * design.clutch.races.inner_bore_radius_m, asked_nm))
                .collect(),
            shown,
        }
    }
}

impl Said for Sizing<'_> {
    type Body<'a>
        = SizingBody<'a>
    where
        Self: 'a;

    fn title(&self) -> &str {
        self.title
    }

    fn design(&self) -> &Design {
        &self.sized.made.design
    }

    fn outcome(&self) -> Finding {
        Finding::Held
    }

    fn verdict(&self) -> String {
        let s = &self.design().clutch.sprags;
        format!(
            "{} sprags of {} in a race space of {}; {}",
            s.count,
            Unit::Millimetre.show_plain(s.length_m, 4),
            Unit::Millimetre.show_plain(self.sized.tried[self.sized.taken].space_m, 4),
            self.sized.made.least().map_or(String::new(), |r| format!(
                "{} decides, {}",
                r.code(),
                margin_words(r)
            ))
        )
    }

    fn remarks(&self) -> Vec<String> {
        let written =
            self.written.map_or("no design written".to_owned(), |path| format!("written to {}", shown(path)));
        let shown = shown_broken(&self.shown);
        figures(&self.sized.made)
            .into_iter()
            .chain(self.warnings.clone())
            .chain(shown)
            .chain([written])
            .collect()
    }

    fn table(&self) -> Table {
        tried(&self.sized.tried, Some(self.sized.taken)).table()
    }

    fn tables(&self, screen: Screen) -> String {
        format!(
            "{}{}\n{}{REACHED_AT}\n",
            self.table().to_text(screen),
            no_flanks(&self.sized.tried).map_or(String::new(), |line| line + "\n"),
            people_table(&self.sized.made.margins, self.end_nm).to_text(screen)
        )
    }

    fn body(&self) -> SizingBody<'_> {
        SizingBody::of(self)
    }

    fn draw(&self, page: &mut Page) {
        page.heading("Alternatives").paragraph(
            "Every race space (gap between the tracks) tried, each as narrow as its limits allow; of those that do it the one of the least \
             volume, from bore to outside, is taken. All at one scale.",
        );
        alternatives(page, self.sized);
        page.table(&no_flanks(&self.sized.tried).unwrap_or_default(), &self.table());
        page.heading("Margins").table(REACHED_AT, &people_table(&self.sized.made.margins, self.end_nm));
    }
}

/// A number of a new clutch that nobody has said.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Taken {
    /// What it is.
    pub what: String,
    /// Its value, with its unit.
    pub value: String,
    /// Where it comes from, and what rests on it.
    pub from: String,
}

/// What a new clutch rests on that nobody has said.
pub fn taken(wanted: &Requirements, found: Option<&Sized>) -> Vec<Taken> {
    let inertia = |what: &str, kg_m2: f64, from: &str| Taken {
        what: what.to_owned(),
        value: format!("{} kg m²", significant(kg_m2, 4)),
        from: from.to_owned(),
    };
    let asked = wanted.taken().into_iter().map(|(what, value, from)| Taken {
        what: what.to_owned(),
        value,
        from: from.to_owned(),
    });
    let inertias = found.map(|found| &found.made.design.clutch.races).into_iter().flat_map(|races| {
        [
            inertia(
                "turns with inner race",
                races.inner_inertia_kg_m2,
                "guess: ring and drive; scenes, feed and reengage rest on it (races.inner_inertia_kg_m2)",
            ),
            inertia(
                "turns with outer race",
                races.outer_inertia_kg_m2,
                "the ring alone; reengage rests on it (races.outer_inertia_kg_m2)",
            ),
        ]
    });
    asked.chain(inertias).collect()
}

/// The rows that are shown only and would not hold, and what that means, a line for each scene and one for the others.
fn shown_broken(margins: &[Margin]) -> Vec<String> {
    let mut lines: Vec<(Option<&str>, Vec<&Margin>)> = Vec::new();
    for row in margins.iter().filter(|r| !r.required && r.computed() && !r.held()) {
        let scene = row.scene.as_deref();
        match lines.iter_mut().find(|(known, _)| *known == scene) {
            Some((_, rows)) => rows.push(row),
            None => lines.push((scene, vec![row])),
        }
    }
    let line = |(scene, rows): (Option<&str>, Vec<&Margin>)| {
        let codes: Vec<String> = rows.iter().map(|r| r.code()).collect();
        let opens =
            rows.iter().any(|r| r.is_contact() || matches!(r.demand, Demand::NoneSuffices | Demand::LetsGo));
        let means = match (scene, opens) {
            (Some(scene), true) => format!(
                "in scene {scene} the sprags lose contact for a while, which no friction prevents, and strike again; \
                 `simulate` with --scenario {scene} shows how hard"
            ),
            (Some(scene), false) => format!("`simulate` with --scenario {scene} shows by how much"),
            (None, _) => "`check` shows by how much".to_owned(),
        };
        format!(
            "Shown only, and broken: {}: {means}; its numbers are guesses, and it has no say in the verdict",
            codes.join(", ")
        )
    };
    lines.into_iter().map(line).collect()
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
        (false, _) if made.design.clutch.slides_outside() => {
            "In overrun as asked for the sprags are off: dry, no drag and no heat; on oil, [lubrication], they float on a film that drags"
                .to_owned()
        }
        (false, _) => "In overrun as asked for the sprags are off: no drag, no heat".to_owned(),
        (true, false) => format!(
            "Drag in slow overrun {}: {} of heat at {}",
            Unit::NewtonMetre.show(d.torque_nm, 3),
            Unit::Watt.show(d.torque_nm * USUAL_SLIDING_RAD_S, 3),
            Unit::Rpm.show_plain(USUAL_SLIDING_RAD_S, 5)
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

/// A small drawing of each that does it.
fn alternatives(page: &mut Page, sized: &Sized) {
    let made: Vec<(usize, &Tried, &Made)> =
        sized.tried.iter().enumerate().filter_map(|(i, t)| Some((i, t, t.made.as_ref()?))).collect();
    let widest =
        made.iter().map(|(_, _, m)| m.design.clutch.races.outer_outside_radius_m).fold(0.0, f64::max);
    let drawn = |(i, tried, made): &(usize, &Tried, &Made)| {
        let clutch = &made.design.clutch;
        let profile = clutch.profile().ok()?;
        let pose = SpragPose::at_rest("first contact", clutch, &profile);
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

/// What flanks are, where they decided a race space.
fn no_flanks(tried: &[Tried]) -> Option<String> {
    let any = tried.iter().any(|t| t.decided_by == Decider::Flanks);
    any.then(|| "flanks: the sides of a sprag's body between its two profiles; none fit there".to_owned())
}

/// Every race space tried; `taken`: the one of the answer.
pub fn tried(tried: &[Tried], taken: Option<usize>) -> Rows<(usize, &Tried)> {
    let word = |i: usize, t: &Tried| match (taken == Some(i), t.held) {
        (true, _) => "taken",
        (false, true) => "possible",
        (false, false) => "NOT POSSIBLE",
    };
    let of = |t: &Tried, value: fn(&Made) -> f64| t.made.as_ref().map(value);
    Rows::of(tried.iter().enumerate())
        .number("race_space_mm", "Race space", Unit::Millimetre, 4, |(_, t)| t.space_m)
        .number("count", "Sprags", Unit::One, 3, |(_, t)| t.count)
        .number("length_mm", "Length", Unit::Millimetre, 4, |(_, t)| {
            Cell::only_if(t.carries_nm > 0.0, t.length_m)
        })
        .number("outside_mm", "⌀", Unit::Millimetre, 4, |(_, t)| {
            of(t, |made| 2.0 * made.design.clutch.races.outer_outside_radius_m)
        })
        .number("mass_g", "Mass", Unit::Gram, 4, |(_, t)| of(t, |made| made.mass_kg))
        .number("carries_nm", "Carries", Unit::NewtonMetre, 4, |(_, t)| {
            Cell::only_if(t.carries_nm > 0.0, t.carries_nm)
        })
        .text("decided_by", "Decided by", |(_, t)| t.decided_by.to_string())
        .text("verdict", "", |(i, t)| Cell::Verdict(t.held, word(*i, t).to_owned()))
        .json_in("width_mm", Unit::Millimetre, |(_, t)| of(t, |made| made.design.clutch.races.width_m))
        .json("possible", |(_, t)| t.held)
        .json("taken", |(i, _)| taken == Some(*i))
}
