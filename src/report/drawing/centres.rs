//! The arc centres enlarged: they lie hundredths of a millimetre apart and carry the whole idea of a multi-arc profile.

use super::{Drawing, SpragPose, spread, subscript};
use crate::report::number::Unit;
use crate::report::svg::{
    Anchor, EDGE, INK, PAPER, PHONE_PX, RULE, SERIES, SOFT, Svg, for_both, polyline, text_width,
};

/// Width of the picture itself, px; the texts stand to the right of it.
const PICTURE: f64 = 350.0;
const HEIGHT: f64 = 300.0;
/// Least width of the texts, px.
const COLUMN: f64 = 210.0;
/// From one text to the next, px.
const PITCH: f64 = 18.0;
/// Room on either side of the texts, px.
const BESIDE: f64 = 16.0;
const MARGIN: f64 = 34.0;

/// A point of the body frame with its name.
struct Named {
    at_m: [f64; 2],
    name: String,
    series: Option<usize>,
}

fn named(pose: &SpragPose, index: usize, many: bool) -> Vec<Named> {
    let tail = if many { format!(", {}", pose.label) } else { String::new() };
    let mut points: Vec<Named> = pose
        .arcs
        .iter()
        .enumerate()
        .filter(|(k, _)| !pose.within_spiral(*k) || k + 1 == pose.arcs.len())
        .map(|(k, a)| Named {
            at_m: a.centre_m,
            name: format!("{}{tail}", subscript("C", k + 1)),
            series: Some(index + 1),
        })
        .collect();
    let centroid = pose.centroid_m.filter(|g| g.iter().all(|v| v.is_finite()));
    let pole = pose.spiral.map(|s| Named { at_m: s.pole_m, name: format!("pole{tail}"), series: None });
    let pivot = pose.pivot_m.map(|p| Named { at_m: p, name: format!("P{tail}"), series: None });
    points.extend(pole.into_iter().chain(pivot));
    points.extend(centroid.map(|g| Named { at_m: g, name: format!("G{tail}"), series: None }));
    points
}

/// The drawing as a page has it.
pub fn figure(drawing: &Drawing) -> String {
    let [window, phone] = [false, true].map(|on_phone| svg(drawing, on_phone));
    for_both(&window, &phone)
}

/// With names and places beside the points; on a phone the names alone, and the places in lines below.
pub fn svg(drawing: &Drawing, on_phone: bool) -> String {
    // A sprag drawn in several positions has one body: its centres are shown once.
    let mut poses = drawing.drawable();
    poses.dedup_by(|b, a| a.arcs == b.arcs && a.centroid_m == b.centroid_m);
    let mut points = vec![Named { at_m: [0.0, 0.0], name: "Cₑ".to_owned(), series: None }];
    for (index, pose) in poses.iter().enumerate() {
        points.extend(named(pose, index, poses.len() > 1));
    }
    let text = |point: &Named| {
        // No minus before a zero.
        let [mx, my] = point.at_m.map(|v| (1e4 * Unit::Millimetre.from_si(v)).round() / 1e4 + 0.0);
        format!("{} ({mx:.4}, {my:.4}) mm", point.name).replace('-', "\u{2212}")
    };
    let beside = |point: &Named| if on_phone { point.name.clone() } else { text(point) };
    let widest = points.iter().map(|p| text_width(&beside(p), 12.0)).fold(0.0, f64::max);
    let column = widest + 2.0 * BESIDE;
    let (picture, size) = if on_phone {
        (PHONE_PX - column, [PHONE_PX, HEIGHT + PITCH * points.len() as f64])
    } else {
        (PICTURE, [PICTURE + COLUMN.max(column), HEIGHT])
    };
    let mut svg = Svg::new(size[0], size[1], "Points of the sprag in the body frame, enlarged");
    let range = |axis: usize| {
        let values = points.iter().map(|p| p.at_m[axis]);
        (values.clone().fold(f64::INFINITY, f64::min), values.fold(f64::NEG_INFINITY, f64::max))
    };
    let ((left, right), (low, high)) = (range(0), range(1));
    let width = picture - 2.0 * MARGIN;
    let scale = (width / (right - left)).min((HEIGHT - 2.0 * MARGIN) / (high - low));
    if !scale.is_finite() {
        return svg.finish();
    }
    let middle = [(left + right) / 2.0, (low + high) / 2.0];
    let px = |[x, y]: [f64; 2]| {
        [MARGIN + width / 2.0 + (x - middle[0]) * scale, HEIGHT / 2.0 - (y - middle[1]) * scale]
    };
    // Axes of the body frame through C_e.
    let rule = format!("fill=\"none\" stroke=\"{RULE}\" stroke-width=\"1\"");
    let origin = px([0.0, 0.0]);
    svg.line([8.0, origin[1]], [picture, origin[1]], &rule);
    svg.line([origin[0], 8.0], [origin[0], HEIGHT - 8.0], &rule);
    // Where no leader runs: these all go to the right.
    svg.text([4.0, origin[1] - 5.0], Anchor::Start, SOFT, "x →");
    svg.text([origin[0] + 6.0, 16.0], Anchor::Start, SOFT, "y, radially outward");
    let wanted: Vec<f64> = points.iter().map(|p| px(p.at_m)[1] + 4.0).collect();
    let x = picture + BESIDE;
    for (point, y) in points.iter().zip(spread(&wanted, PITCH, 20.0, HEIGHT - 10.0)) {
        let at = px(point.at_m);
        svg.path(
            &polyline(&[[x - 4.0, y - 4.0], [x - 14.0, y - 4.0], at], false),
            &format!("fill=\"none\" stroke=\"{SOFT}\" stroke-width=\"0.7\""),
        );
        let colour = point.series.map_or(EDGE, |i| SERIES[i % 6]);
        svg.dot(at, 3.4, &format!("fill=\"{colour}\" stroke=\"{PAPER}\" stroke-width=\"1\""));
        svg.text([x, y], Anchor::Start, INK, &beside(point));
    }
    for (k, point) in points.iter().enumerate().filter(|_| on_phone) {
        svg.bare_text([2.0, HEIGHT + PITCH * (k as f64 + 0.6)], Anchor::Start, INK, &text(point));
    }
    svg.finish()
}
