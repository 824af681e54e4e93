//! Plots of the margin check: all limits against torque, gripping angles, cam rise.

use super::CheckAnswer;
use crate::answer::stiffness::junctions;
use crate::margin::{DemandCourse, courses};
use crate::report::{Curve, Dash, Plot, Unit};
use crate::wedge::{PLOTTED, StaticPoint};

/// Demands are drawn up to this multiple of their allowable.
const CUT_AT: f64 = 1.5;
/// Limits that are told apart; the others are seen to be farther away.
const NAMED: usize = 5;

/// Demand over allowable of all limits against torque, those that set the capacities marked.
pub(super) fn limits(check: &CheckAnswer) -> Plot {
    let design = &check.design;
    let curve = &check.state.curve;
    let set_by = check.body.capacities();
    let limits = &design.limits;
    let asked = [limits.nominal_torque_nm, limits.peak_torque_nm].into_iter().flatten().fold(0.0, f64::max);
    let reached = set_by.iter().map(|c| c.1).fold(asked, f64::max);
    let up_to = if reached > 0.0 { 1.25 * reached } else { f64::INFINITY };
    let points: Vec<StaticPoint> = curve.samples(up_to, PLOTTED).into_iter().map(|(p, _)| p).collect();
    let mut plot = Plot::new("Torque, Nm", "Demand / allowable").level(1.0, "limit").sized(720.0, 460.0);
    let sets = |course: &DemandCourse| set_by.iter().any(|(code, _)| *code == course.code);
    let highest =
        |course: &DemandCourse| course.points.iter().map(|p| p[1]).fold(f64::NEG_INFINITY, f64::max);
    let mut all = courses(&check.rows, design, limits, &check.state, &points);
    all.sort_by(|a, b| sets(b).cmp(&sets(a)).then(highest(b).total_cmp(&highest(a))));
    for (place, course) in all.into_iter().enumerate() {
        let dash = match (sets(&course), course.required) {
            (true, _) => Dash::Solid,
            _ if place >= NAMED => Dash::Faint,
            (false, true) => Dash::Dashed,
            (false, false) => Dash::Dotted,
        };
        let name = match dash {
            Dash::Solid => format!("{} (decides)", course.code),
            Dash::Faint => "farther away".to_owned(),
            _ => course.code,
        };
        let cut = |[x, y]: [f64; 2]| [x, if (0.0..=CUT_AT).contains(&y) { y } else { f64::NAN }];
        plot.curves.push(Curve { dash, ..Curve::new(&name, course.points.into_iter().map(cut).collect()) });
    }
    for (code, torque_nm) in set_by {
        plot = plot.marker(torque_nm, &code);
    }
    for (torque, name) in [(limits.nominal_torque_nm, "nominal"), (limits.peak_torque_nm, "peak")] {
        if let Some(torque) = torque {
            plot = plot.marker(torque, name);
        }
    }
    plot
}

/// Friction demand over torque, as tangents and as angles; cam rise over rotation.
pub(super) fn gripping(check: &CheckAnswer) -> [Plot; 3] {
    let curve = &check.state.curve;
    let samples = curve.samples(f64::INFINITY, PLOTTED);
    let over = |value: &dyn Fn(&crate::wedge::StaticPoint) -> f64| {
        samples.iter().map(|(p, _)| [p.torque_nm, value(p)]).collect::<Vec<_>>()
    };
    let friction = &check.design.clutch.friction;
    let mut tangents = Plot::new("Torque, Nm", "Tangential over normal force")
        .curve("inner contact, tan ω", over(&|p| p.tan_omega))
        .curve("outer contact, tan ν", over(&|p| p.tan_nu))
        .level(friction.static_, "μs");
    if friction.kinetic < friction.static_ {
        tangents = tangents.level(friction.kinetic, "μc");
    }
    let degrees = |tangent: f64| Unit::Degree.from_si(tangent.atan());
    let mut angles = Plot::new("Torque, Nm", "Gripping angle, deg")
        .curve("inner contact, ω", over(&|p| degrees(p.tan_omega)))
        .curve("outer contact, ν", over(&|p| degrees(p.tan_nu)))
        .level(degrees(friction.static_), "arctan μs");
    for junction in junctions(curve) {
        tangents = tangents.marker(junction.torque_nm, &junction.label());
        angles = angles.marker(junction.torque_nm, &junction.label());
    }
    let profile = &check.state.profile;
    let rotation = |c: &crate::wedge::Closure| Unit::Degree.from_si(c.rotation.v);
    let mut free = Vec::new();
    let mut loaded = Vec::new();
    for (point, c) in &samples {
        if let Some(arc) = profile.arcs.get(point.arc) {
            // A in the body; B lies straight outward of C_e, at azimuth -Omega in the body.
            let a = arc.centre_m + arc.radius_m * profile.contact_direction(point.contact_turn_rad);
            let (s, cos) = c.rotation.v.sin_cos();
            let b = [-profile.outer_radius_m * s, profile.outer_radius_m * cos];
            free.push([rotation(c), (a.x - b[0]).hypot(a.y - b[1])]);
        }
        // AB^2 = OA^2 + OB^2 - 2 OA OB cos(beta).
        let (oa, ob) = (c.lengths.oa.v, c.lengths.ob.v);
        loaded.push([rotation(c), (oa * oa + ob * ob - 2.0 * oa * ob * c.beta.v.cos()).sqrt()]);
    }
    let height = free.first().map_or(0.0, |p| p[1]);
    let rise = |points: Vec<[f64; 2]>| {
        points.into_iter().map(|[x, y]| [x, Unit::Micrometre.from_si(y - height)]).collect::<Vec<_>>()
    };
    let mut cam = Plot::new("Rotation of the sprag, deg", "Height above first contact, µm")
        .curve("undeformed sprag", rise(free))
        .curve("gap AB under load", rise(loaded));
    for k in 1..profile.arcs.len() {
        if let Some((_, c)) = samples.iter().find(|(p, _)| p.arc == k) {
            cam = cam.marker(rotation(c), &format!("{}|{}", k, k + 1));
        }
    }
    [tangents, angles, cam]
}
