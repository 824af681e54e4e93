//! The page of an overrun.

use super::super::page::half;
use super::tables::OverrunPart;
use super::{OilAt, OverrunAnswer, OverrunLine};
use crate::report::plot::{Curve, Dash};
use crate::report::{Page, Plot, Unit, significant};

/// Speeds of a curve.
const POINTS: usize = 24;

/// A lift-off within this multiple of the largest speed asked for is drawn, and these parts of it: on the logarithm drag falls
/// steeply there. Choices.
const NEAR: f64 = 2.0;
const BEFORE_THE_END: [f64; 7] = [0.7, 0.75, 0.8, 0.85, 0.9, 0.95, 0.98];

/// What a plot shows of a line.
type Shown = fn(&OverrunLine) -> Option<f64>;

pub(super) fn draw(answer: &OverrunAnswer<'_>, page: &mut Page) {
    let sets = curves(answer);
    let speed = format!("Speed of the {} race, rpm", answer.question.race.name());
    let plot = |title: &str, shown: Shown| {
        let mut plot = Plot::new(&speed, title);
        plot.log_x = true;
        for (name, lines) in &sets {
            plot.curves.push(Curve::new(name, points(lines, shown)));
        }
        plot
    };
    let mut drag = plot("Drag torque, Nm", |l| Some(l.point.state.drag_torque_nm));
    if let Some((_, lines)) = sets.first() {
        let dry = points(lines, |l| Some(l.dry.state.drag_torque_nm));
        drag.curves.push(Curve { dash: Dash::Dotted, ..Curve::new("dry, by the friction law (12)", dry) });
    }
    if let Some(off) = end(answer).filter(|off| *off <= NEAR * fastest(answer)) {
        // There drag ends.
        drag.curves.iter_mut().for_each(|curve| curve.points.push([Unit::Rpm.from_si(off), 0.0]));
        drag = drag.marker(Unit::Rpm.from_si(off), "lift-off");
    }
    let mut lambda = plot("Film over roughness, λ", |l| l.point.lubricated.map(|f| f.film.lambda))
        .level(1.0, "asperities carry much below");
    lambda.log_y = true;
    let friction = plot("Friction coefficient μ", |l| l.point.lubricated.map(|_| l.point.friction));
    let warmth = plot("Film temperature, °C", |l| l.point.lubricated.map(|f| f.film_c));
    page.figures(&[
        (half(drag), "Drag of all sprags; dotted: by the friction law (12) alone."),
        (
            half(friction),
            if answer.slides_outside() {
                "Stribeck curve of the outer contact, at the load that the sprags settle at."
            } else {
                "Stribeck curve of the inner contact, at the load that the sprags settle at."
            },
        ),
        (
            half(lambda),
            "Thickness of the film where its pressure is largest over the roughness of both surfaces; above 3 asperities hardly touch.",
        ),
        (half(warmth), "Temperature of the film by the heat balance."),
    ]);
    page.heading("Film and drag").table(
        "Regimes: I or V, the oil keeps its viscosity or thickens under pressure; R or E, the bodies stay round or flatten. Film: where the pressure is largest; between round bodies the least is 0.82 of it.",
        &answer.part(OverrunPart::Film),
    );
    page.heading("Heat").table(
        "Means of the bodies; the film is taken to be as warm as the mean of the two that rub.",
        &answer.part(OverrunPart::Heat),
    );
    if answer.knows_warm() {
        page.heading("Fit and gap").table(
            "At the temperatures above, without load, in place of those of the file; bears: peak torque that every limit bears.",
            &answer.part(OverrunPart::Warm),
        );
    }
    page.heading("Swing and wear").table(
        "Growth of a small swing of the sprags on the film, by its friction alone, and dry by the law (12): above 0 the overrun does not \
         stay. Wear of a sprag grows with the power 2/3 of time.",
        &answer.part(OverrunPart::Swing),
    );
}

fn points(lines: &[OverrunLine], shown: Shown) -> Vec<[f64; 2]> {
    lines.iter().filter_map(|l| Some([Unit::Rpm.from_si(l.speed_rad_s), shown(l)?])).collect()
}

/// Speed at which sliding ends, rad/s, where it does.
fn end(answer: &OverrunAnswer<'_>) -> Option<f64> {
    answer.lift_off_rad_s.filter(|_| answer.design.ends_at_lift_off(answer.question.race))
}

/// Largest speed asked for, rad/s.
fn fastest(answer: &OverrunAnswer<'_>) -> f64 {
    answer.question.speeds_rad_s.iter().copied().fold(0.0, f64::max)
}

/// For each temperature the speeds between the least and the largest asked for, evenly on a logarithm.
fn curves(answer: &OverrunAnswer<'_>) -> Vec<(String, Vec<OverrunLine>)> {
    let speeds = || answer.question.speeds_rad_s.iter().copied().filter(|w| *w > 0.0);
    let (low, high) = speeds().fold((f64::INFINITY, 0.0), |(a, b): (f64, f64), w| (a.min(w), b.max(w)));
    if high <= 0.0 {
        return Vec::new();
    }
    let end = end(answer).unwrap_or(f64::INFINITY);
    let low = low.min(0.1 * high);
    let at = |i: usize| low * (high / low).powf(i as f64 / (POINTS - 1) as f64);
    let before = if end <= NEAR * high { &BEFORE_THE_END[..] } else { &[] };
    let mut speeds: Vec<f64> = (0..POINTS).map(at).chain(before.iter().map(|part| part * end)).collect();
    speeds.retain(|w| *w < end);
    speeds.sort_by(f64::total_cmp);
    let one = |&oil_c: &f64| {
        let there = OilAt::new(answer.design, oil_c);
        let line = |w: &f64| there.line(&answer.state, answer.question.race, *w).ok();
        let lines = speeds.iter().filter_map(line).collect();
        (format!("oil at {} °C", significant(oil_c, 3)), lines)
    };
    answer.question.temperatures_c.iter().map(one).collect()
}
