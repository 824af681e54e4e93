//! What a scene leaves out beside what every answer leaves out, with the cost where the run itself shows it.

use super::{Effect, Ran, slip};
use crate::answer::left_out::{LeftOut, left_out_of, left_out_of_driven_cage};
use crate::clutch::{ContactLaw, ScenarioKind};
use crate::dynamics::Neglected;
use crate::report::Unit;
use crate::scenario::{overrun_swing, squeezed_out};
use crate::wedge::WedgeCurve;

/// The list for `scene`; `damping`: what contact damping would change.
pub(super) fn of(scene: &Ran, damping: Option<&Effect>) -> Vec<LeftOut> {
    let mut list = left_out_of(&scene.design);
    list.extend(scene.planned.iter().map(|t| LeftOut::new(t.term, &t.why, &t.cost)));
    list.extend(driven_cage(scene));
    list.extend(scene.simulation().and_then(slip::left_out));
    let mut add = |term: &str, why: &str, cost: &str| list.push(LeftOut::new(term, why, cost));
    let kind = &scene.scenario.kind;
    if !kind.is_at_rest() {
        let (term, why) = film(scene);
        let cost = film_squeezed(scene).or_else(|| nothing_slides(scene));
        add(term, why, &cost.unwrap_or_else(|| "not estimated".to_owned()));
        if scene.design.clutch.cage.is_none() {
            add(
                "mass and friction of the cage",
                "the cage is free and massless, the spring reacts on it",
                "not estimated",
            );
        }
    }
    if scene.method == "equilibrium" {
        list.extend(static_outer_force(scene));
        return list;
    }
    if scene.design.clutch.hunt_crossley_s_per_m == 0.0 {
        let cost = damping.map_or("not estimated".to_owned(), Effect::words);
        add(
            "contact damping",
            "the contacts are elastic, as in the paper; damped are only the races against one another",
            &cost,
        );
    }
    add(
        "waves in the bodies where a contact closes",
        &touch(scene.design.clutch.hunt_crossley_s_per_m),
        "not estimated; none where the contact stays closed",
    );
    add(
        "torsional waves and bending of races and shafts",
        "the races are rigid in rotation, their growth is quasi-static",
        &bending(scene).unwrap_or_else(|| "not estimated".to_owned()),
    );
    if !matches!(scene.design.clutch.contact, ContactLaw::Slice { .. }) {
        add(
            "pressure along the length over time",
            "the load is spread as the contact law spreads it at rest",
            "none on the motion; edge pressure in time not estimated: take the slice law",
        );
    }
    let neglected = scene.simulation().map_or(Neglected::default(), |s| s.neglected);
    add(
        "radial inertia of the sprag",
        "N_be closes the radial balance without m_g OC_g''",
        &radial_inertia(&neglected, scene.design.clutch.sprags.mass_kg),
    );
    let speed = match kind {
        ScenarioKind::TorsionalExcitation { speed_rad_s, .. } => *speed_rad_s,
        ScenarioKind::Transient { .. } => {
            scene.outcome.as_ref().map_or(0.0, |(p, _)| p.model.curve.speed_rad_s())
        }
        _ => 0.0,
    };
    add(
        "growth of the races by changes of speed",
        if scene.scenario.speed_history.is_some() {
            "the wedge curve is that at one speed, the middle of the history in Omega^2; centrifugal force follows it"
        } else if speed == 0.0 {
            "the wedge curve is that at rest; speed enters through phi'^2 alone"
        } else {
            "the wedge curve is that at the mean speed; its fluctuation enters through phi'^2 alone"
        },
        &growth(scene, neglected.outer_rate_rad_s, speed),
    );
    if speed != 0.0 {
        add(
            "growth of the inner race by rotation",
            "(7) is the outer race's alone",
            &inner_growth(scene, speed),
        );
    }
    list
}

/// What a scene in motion leaves out of the lubricant, and why: a film is in steady overrun alone ([`crate::scenario::sliding()`]).
fn film(scene: &Ran) -> (&'static str, &'static str) {
    let overruns = matches!(scene.scenario.kind, ScenarioKind::Overrun { .. });
    match (&scene.design.clutch.lubrication, overruns) {
        (Some(_), true) => (
            "time that a film takes to form",
            "friction where the sprags slide is that of the film at speed and load of the moment, at the temperature of steady overrun",
        ),
        (Some(_), false) => (
            "lubricant film and temperature",
            "friction is the law (12) of the sliding speed alone; the film of [lubrication] acts in steady overrun",
        ),
        (None, _) => {
            ("lubricant film and temperature", "friction is the law (12) of the sliding speed alone")
        }
    }
}

/// What a film would do where both contacts have stuck since they carry.
fn nothing_slides(scene: &Ran) -> Option<String> {
    let s = scene.simulation().filter(|s| s.overrun.is_none())?;
    let slides = [s.inner, s.outer].iter().any(|contact| contact.distance_m > 0.0);
    (!slides).then(|| "none: no contact slides in this scene".to_owned())
}

/// What bending adds to the growth of the races where the scene repeats, two waves around, the lowest; `None` elsewhere.
fn bending(scene: &Ran) -> Option<String> {
    let (prepared, _) = scene.outcome.as_ref().ok()?;
    let elastic = &prepared.model.curve.statics().elastic;
    let scene_hz = prepared.period_s?.recip();
    let lowest = [&elastic.inner_race, &elastic.outer_race].map(|race| race.lowest_mode_hz());
    let lowest = lowest.into_iter().filter(|hz| *hz > 0.0).reduce(f64::min)?;
    Some(format!(
        "bending: {} of the races' growth (the softer race alone bends at {}, the torque swings at {}); torsion of shafts: not estimated",
        Unit::Percent.show((scene_hz / lowest).powi(2), 1),
        Unit::Hertz.show(lowest, 3),
        Unit::Hertz.show(scene_hz, 3)
    ))
}

/// Growth of the inner track at the mean `speed`, rad/s, beside that of the outer one.
fn inner_growth(scene: &Ran, speed: f64) -> String {
    let Ok((prepared, _)) = &scene.outcome else { return "not estimated".to_owned() };
    let elastic = &prepared.model.curve.statics().elastic;
    format!(
        "inner track larger by {}, as a ring of its own, where the outer one is by {}",
        Unit::Micrometre.show(elastic.inner_race.centrifugal_outside_growth_m(speed), 2),
        Unit::Micrometre.show(elastic.outer_race.centrifugal_bore_growth_m(speed), 2)
    )
}

/// How long a film that is there when a scene begins in overrun keeps the contact from gripping; `None` without either.
fn film_squeezed(scene: &Ran) -> Option<String> {
    let found = squeezed_out(&scene.scenario, &scene.simulation()?.overrun?)?;
    if found.time_s == 0.0 {
        return Some("little: the film of the overrun is thinner than the surfaces are rough".to_owned());
    }
    Some(format!(
        "the force of the overrun, {}, squeezes its film of {} down to the roughness in {}; so much later the clutch grips at most, since the \
         force grows meanwhile",
        Unit::Newton.show(found.normal_n, 3),
        Unit::Micrometre.show(found.thickness_m, 3),
        Unit::Millisecond.show(found.time_s, 2)
    ))
}

/// What an impact at touch does in the model; `damping`: of Hunt and Crossley, s/m, whose rebound at small speed v is 1 - 2 c v / 3 of it.
fn touch(damping: f64) -> String {
    if damping == 0.0 {
        return "velocities are continuous at touch, and the contact gives an impact back whole".to_owned();
    }
    format!(
        "velocities are continuous at touch; the damping of the contacts leaves a rebound of {} of an impact of 0.1 m/s",
        Unit::Percent.show(1.0 - 2.0 / 3.0 * damping * 0.1, 1)
    )
}

/// What a scene leaves out of a cage that the inner race drives.
fn driven_cage(scene: &Ran) -> Option<LeftOut> {
    let cage = scene.scenario.clutch.cage.filter(|_| !scene.scenario.kind.is_at_rest());
    let (_, (prepared, _)) = cage.zip(scene.outcome.as_ref().ok())?;
    Some(left_out_of_driven_cage(prepared.model.spring_most_nm(), ", and"))
}

/// Why a run in steady overrun settles beside the equilibrium, and by how much ([`crate::dynamics::swing()`]).
fn static_outer_force(scene: &Ran) -> Option<LeftOut> {
    let (prepared, s) = scene.outcome.as_ref().ok().filter(|_| !scene.scenario.clutch.slides_outside())?;
    let swing = overrun_swing(&scene.scenario, prepared)?;
    let off = swing.normal_inner_n / s.overrun?.normal_inner_n - 1.0;
    Some(LeftOut::new(
        "what friction changes of N_be in the approach of the outer contact, in runs",
        "runs take that approach for a function of alpha, as under a static load, so that stick keeps its energy; this \
         equilibrium has the N_be of the radial equation",
        &format!("runs settle at a normal force at A that is {} off this one", Unit::Percent.show(off, 2)),
    ))
}

/// m_g OC_g' alpha'' at its largest while A carries load, beside N_be then.
fn radial_inertia(neglected: &Neglected, mass_kg: f64) -> String {
    if neglected.radial_m_s2 == 0.0 {
        return "not estimated: the inner contact carries nothing".to_owned();
    }
    format!(
        "at most {} per sprag over this run, where N_be is {}",
        Unit::Newton.show(mass_kg * neglected.radial_m_s2, 2),
        Unit::Newton.show(neglected.normal_outer_n, 3)
    )
}

/// Growth (7) of the outer race that its own `fluctuation` about the mean `speed` would add, rad/s.
fn growth(scene: &Ran, fluctuation: f64, speed: f64) -> String {
    let Ok((prepared, _)) = &scene.outcome else { return "not estimated".to_owned() };
    let race = &prepared.model.curve.statics().elastic.outer_race;
    if let Some(history) = &scene.scenario.speed_history {
        return growth_over(scene, history);
    }
    let change = race.centrifugal_bore_growth_m(speed + fluctuation) - race.centrifugal_bore_growth_m(speed);
    format!("outer race track within {} over this run", Unit::Micrometre.show(change, 2))
}

/// What one wedge curve for a history of speeds leaves out: the windup at the largest torque by the curves at the
/// extremes.
fn growth_over(scene: &Ran, history: &[[f64; 2]]) -> String {
    let ends = [
        history.iter().map(|r| r[1]).fold(f64::INFINITY, f64::min),
        history.iter().map(|r| r[1]).fold(0.0, f64::max),
    ];
    let at = |speed: f64| {
        let curve =
            WedgeCurve::build(&scene.design.clutch, &scene.design.clutch.profile().ok()?, speed).ok()?;
        let windup =
            scene.scenario.held_torque_nm().and_then(|t| curve.at_torque(t)).map_or(0.0, |p| p.windup_rad);
        Some((windup, curve.first_contact_rad()))
    };
    match ends.map(at) {
        [Some(low), Some(high)] => format!(
            "between the slowest and the fastest, {} of windup at the largest torque, {} of sprag rotation at first contact",
            Unit::Radian.show((high.0 - low.0).abs(), 2),
            Unit::Radian.show((high.1 - low.1).abs(), 2)
        ),
        _ => "not estimated: no curve at one of the extremes".to_owned(),
    }
}
