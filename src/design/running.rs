//! From races and sprags as made to those as run: interference fits, temperatures, where first contact then lies.
//!
//! In: `[races.press_fit]`, `[thermal]`, races and sprags as made. Out: races and sprags as run, [`Running`]. Absent:
//! load; gradients of temperature within a body. Equations: triangle (9); Lame's press fit is asked of `race`.

use super::check::m;
use super::file::DesignFile;
use super::findings::Findings;
use super::geometry::mm;
use super::{Flanks, InnerArc, Materials, Races, Running, Sprags, TrackRun, steels};
use crate::material::Material;
use crate::profile::{Outline, Profile, clearance_m};
use crate::race::Race;

/// Keys that change a radius, for refusals of what they lead to.
const KEYS: [&str; 3] = ["thermal", "races.press_fit", "races"];

/// Races and sprags as run, and how; as made where the file names neither fits nor temperatures.
pub(super) fn running(
    file: &DesignFile,
    made: Races,
    sprags: Sprags,
    materials: &Materials,
    out: &mut Findings,
) -> Option<(Races, Sprags, Option<Running>)> {
    if file.thermal.is_none() && file.races.press_fit.is_none() {
        return Some((made, sprags, None));
    }
    let [sprag_growth, inner_growth, outer_growth] = match &file.thermal {
        None => [0.0; 3],
        Some(t) => {
            let [sprag, inner, outer] = steels::expansions(&file.material, out)?;
            let rise = |celsius: f64| celsius - t.reference_c.unwrap_or(20.0);
            [sprag * rise(t.sprags_c), inner * rise(t.inner_race_c), outer * rise(t.outer_race_c)]
        }
    };
    let (inner_joint, outer_joint) = joints(file, &made, out)?;
    let scale = 1.0 + sprag_growth;
    let inner_side = SideRun {
        inner: true,
        track_m: made.inner_radius_m,
        rim_m: made.inner_bore_radius_m,
        width_m: made.width_m,
        material: materials.inner_race,
        joint: inner_joint,
        growth: inner_growth,
    };
    let outer_side = SideRun {
        inner: false,
        track_m: made.outer_radius_m,
        rim_m: made.outer_outside_radius_m,
        width_m: made.width_m,
        material: materials.outer_race,
        joint: outer_joint,
        growth: outer_growth,
    };
    let (inner, outer) = (inner_side.run(scale)?, outer_side.run(scale)?);
    let [track_i, track_e] = [inner, outer].map(|t| t.made_m + t.by_fit_m + t.by_temperature_m);
    let far = |side: &SideRun| side.joint.map_or(side.rim_m, |j| j.far_rim_m) * (1.0 + side.growth);
    let races = Races {
        inner_bore_radius_m: far(&inner_side),
        inner_radius_m: track_i,
        outer_radius_m: track_e,
        outer_outside_radius_m: far(&outer_side),
        ..made
    };
    let Some((sprags, first_turn_rad)) = placed(&made, &races, &sprags, scale) else {
        refuse_gap(&made, &races, out);
        return None;
    };
    check_outline(&races, &sprags, out)?;
    Some((races, sprags, Some(Running { inner, outer, sprag_scale: scale, first_turn_rad })))
}

/// A joint: half the interference on diameter, and the far rim of the partner, m.
#[derive(Clone, Copy)]
struct Joint {
    radial_m: f64,
    far_rim_m: f64,
}

fn joints(file: &DesignFile, made: &Races, out: &mut Findings) -> Option<(Option<Joint>, Option<Joint>)> {
    let Some(fit) = &file.races.press_fit else { return Some((None, None)) };
    let before = out.problems.len();
    let key = |name: &str| format!("races.press_fit.{name}");
    let radial = |um: f64| 0.5e-6 * um;
    let inner = fit
        .inner_interference_um
        .map(|um| Joint { radial_m: radial(um), far_rim_m: m(fit.shaft_bore_radius_mm) });
    if let Some(joint) = inner {
        if made.inner_bore_radius_m <= 0.0 {
            out.refuse(
                &[&key("inner_interference_um"), "races.inner_bore_radius_mm"],
                "only with a bore: inner_bore_radius_mm above 0".to_owned(),
                "remove inner_interference_um: a solid inner race has no shaft in it".to_owned(),
            );
        } else if joint.far_rim_m >= made.inner_bore_radius_m {
            out.refuse(
                &[&key("shaft_bore_radius_mm"), "races.inner_bore_radius_mm"],
                format!("less than the bore of the inner race, {} mm", mm(made.inner_bore_radius_m)),
                "give the radius of the hole in the shaft; 0 for a solid one".to_owned(),
            );
        }
    } else if fit.shaft_bore_radius_mm > 0.0 {
        out.refuse(
            &[&key("shaft_bore_radius_mm")],
            "only together with inner_interference_um".to_owned(),
            "add inner_interference_um = ..., or remove shaft_bore_radius_mm".to_owned(),
        );
    }
    let outer = match (fit.outer_interference_um, fit.housing_outside_radius_mm) {
        (Some(um), Some(outside)) => {
            if m(outside) <= made.outer_outside_radius_m {
                out.refuse(
                    &[&key("housing_outside_radius_mm"), "races.outer_outside_radius_mm"],
                    format!("more than the outer race's outside, {} mm", mm(made.outer_outside_radius_m)),
                    "give the radius to which the housing reaches".to_owned(),
                );
            }
            Some(Joint { radial_m: radial(um), far_rim_m: m(outside) })
        }
        (None, None) => None,
        (given, _) => {
            let names = ["outer_interference_um", "housing_outside_radius_mm"];
            let [have, lack] = if given.is_some() { names } else { [names[1], names[0]] };
            out.refuse(
                &[&key(have)],
                format!("only together with {lack}, which is missing"),
                format!("add {lack} = ... to [races.press_fit], or remove {have}"),
            );
            None
        }
    };
    (out.problems.len() == before).then_some((inner, outer))
}

/// One race with what it is joined to.
struct SideRun {
    inner: bool,
    track_m: f64,
    rim_m: f64,
    width_m: f64,
    material: Material,
    joint: Option<Joint>,
    /// Linear growth by temperature, pure number.
    growth: f64,
}

impl SideRun {
    /// The track made at `track_m`: fitted at the reference temperature, then warmed together with its partner, which is
    /// of the same material and so changes no stress. `None` where the radii are out of order.
    fn made_at(&self, track_m: f64) -> Option<TrackRun> {
        let ring = |bore: f64, outside: f64| {
            let make = if self.inner { Race::inner } else { Race::outer };
            make(bore, outside, self.width_m, self.material).ok()
        };
        let fit = match (self.joint, self.inner) {
            (None, _) => None,
            (Some(j), true) => {
                Some(ring(self.rim_m, track_m)?.press_fit(&ring(j.far_rim_m, self.rim_m)?, j.radial_m))
            }
            (Some(j), false) => {
                Some(ring(track_m, self.rim_m)?.press_fit(&ring(self.rim_m, j.far_rim_m)?, j.radial_m))
            }
        };
        let by_fit_m = fit.map_or(0.0, |f| f.track_growth_m);
        Some(TrackRun {
            made_m: track_m,
            by_fit_m,
            by_temperature_m: (track_m + by_fit_m) * self.growth,
            to_make_m: track_m,
            joint_pressure_pa: fit.map_or(0.0, |f| f.pressure_pa),
            joint_m: self.rim_m * (1.0 + self.growth),
            hoop_at_track_pa: fit.map_or(0.0, |f| f.hoop_at_track_pa),
            hoop_at_joint_pa: fit.map_or(0.0, |f| f.hoop_at_joint_pa),
        })
    }

    /// The track as the file has it, with the radius to make: that which runs at the drawn radius times the sprag's own
    /// growth, so that the warm clutch is the drawn one, enlarged. The fit hardly feels the radius: each round leaves a
    /// small part of the miss.
    fn run(&self, sprag_scale: f64) -> Option<TrackRun> {
        let run = self.made_at(self.track_m)?;
        let wanted = self.track_m * sprag_scale;
        let mut to_make_m = self.track_m;
        for _ in 0..60 {
            let Some(tried) = self.made_at(to_make_m) else { break };
            let miss = wanted - (tried.made_m + tried.by_fit_m + tried.by_temperature_m);
            to_make_m += miss;
            if miss.abs() <= 1e-15 {
                break;
            }
        }
        Some(TrackRun { to_make_m, ..run })
    }
}

/// The sprags, enlarged by `scale`, between the races as run, with everything that counts from first contact counted from
/// the new one: turns of the arcs, the body frame of the centroid. The arc on which first contact then lies comes first.
/// Flanks keep their distances from the strut line. `None`: no first contact on the profile.
fn placed(made: &Races, run: &Races, sprags: &Sprags, scale: f64) -> Option<(Sprags, f64)> {
    let arcs: Vec<(f64, f64)> = sprags.inner_arcs.iter().map(|a| (a.radius_m, a.until_rad)).collect();
    let (r_e, e) = (sprags.outer_radius_m, sprags.centre_distance_m);
    let profile = Profile::new(r_e, e, &arcs, made.inner_radius_m, made.outer_radius_m).ok()?;
    let oc_e = run.outer_radius_m - scale * r_e;
    let (first, distance, rotation, turn) = profile.arcs.iter().enumerate().find_map(|(k, arc)| {
        let distance = scale * arc.centre_m.norm();
        let oc_k = run.inner_radius_m + scale * arc.radius_m;
        // (9), as 2 sin^2(beta/2).
        let versed = (distance * distance - (oc_k - oc_e).powi(2)) / (2.0 * oc_k * oc_e);
        if !(versed > 0.0 && versed < 1.0 && oc_e > 0.0) {
            return None;
        }
        let beta = 2.0 * (0.5 * versed).sqrt().asin();
        let rotation =
            (oc_k * beta.sin()).atan2(oc_k * beta.cos() - oc_e) - arc.centre_m.x.atan2(arc.centre_m.y);
        let turn = rotation - (beta - profile.beta0_rad);
        (turn < arc.until_rad).then_some((k, distance, rotation, turn))
    })?;
    let (sin, cos) = rotation.sin_cos();
    let [x, y] = sprags.centroid_m.map(|c| scale * c);
    let inner_arcs = sprags.inner_arcs.iter().skip(first);
    let sprags = Sprags {
        length_m: scale * sprags.length_m,
        outer_radius_m: scale * r_e,
        centre_distance_m: distance,
        width_m: scale * sprags.width_m,
        inertia_kg_m2: scale * scale * sprags.inertia_kg_m2,
        centroid_m: [x * cos + y * sin, y * cos - x * sin],
        inner_arcs: inner_arcs
            .map(|a| InnerArc { radius_m: scale * a.radius_m, until_rad: a.until_rad - turn })
            .collect(),
        flanks: sprags.flanks.map(|f| Flanks { rear_m: scale * f.rear_m, front_m: scale * f.front_m, ..f }),
        ..sprags.clone()
    };
    Some((sprags, turn))
}

fn refuse_gap(made: &Races, run: &Races, out: &mut Findings) {
    let gap = |r: &Races| mm(r.outer_radius_m - r.inner_radius_m);
    out.refuse(
        &KEYS,
        format!(
            "fits and temperatures with which the sprags still touch both races on their profile; the gap is {} mm as \
             made and {} mm as run",
            gap(made),
            gap(run)
        ),
        "make the tracks so that the gap as run is right, or lower interference and temperatures".to_owned(),
    );
}

/// Outline and neighbours, once more, as run.
fn check_outline(races: &Races, sprags: &Sprags, out: &mut Findings) -> Option<()> {
    let Some(flanks) = sprags.flanks else { return Some(()) };
    let arcs: Vec<(f64, f64)> = sprags.inner_arcs.iter().map(|a| (a.radius_m, a.until_rad)).collect();
    let (r_e, e) = (sprags.outer_radius_m, sprags.centre_distance_m);
    let profile = Profile::new(r_e, e, &arcs, races.inner_radius_m, races.outer_radius_m).ok()?;
    let why = match Outline::new(&profile, flanks.rear_m, flanks.front_m) {
        Ok(outline) => {
            let gap = clearance_m(&outline, profile.outer_centre_distance_m, 0.0, sprags.count);
            if gap > 0.0 {
                return Some(());
            }
            format!("neighbours overlap by {} mm at first contact", mm(-gap))
        }
        Err(why) => why.to_string(),
    };
    out.refuse(
        &KEYS,
        format!("fits and temperatures with which the sprag keeps its outline; as run, {why}"),
        "move the flanks, or lower interference and temperatures".to_owned(),
    );
    None
}
