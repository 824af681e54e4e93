//! One sprag between its races in parts that a page can move: races about O, the sprag about C_e.

use super::{Drawing, SpragPose};
use crate::report::svg::{BODY, EDGE, INK, PAPER, RACE, SERIES, SOFT, Svg, circle, polyline, px};
use serde::Serialize;

const WIDTH: f64 = 720.0;
const HEIGHT: f64 = 520.0;
/// Marks on a race, one each this many degrees, so that its turn is seen.
const MARK_DEG: f64 = 2.0;

/// The picture and how its parts are placed.
///
/// # Conventions
/// Pixels, y down, azimuths clockwise. The sprag's group is drawn about C_e as origin; a page turns it by the body's rotation
/// and moves it to (O.x, O.y - OC_e scale). Races turn about O.
#[derive(Debug, Clone, Serialize)]
pub struct Live {
    /// SVG with groups of class `outer`, `inner`, `ghost`, `sprag` and an empty one, `forces`.
    pub svg: String,
    /// Pixels per metre.
    pub scale_px_per_m: f64,
    /// O, px.
    pub o_px: [f64; 2],
}

/// The first pose in parts; a second one is the ghost, an outline that stays. None where nothing can be drawn.
pub fn live(drawing: &Drawing) -> Option<Live> {
    let poses = drawing.drawable();
    let (first, ghosts) = poses.split_first()?;
    let [bore, inner, outer, outside] = drawing.race_radii_m;
    let gap = outer - inner;
    let wide = first.outline_m.iter().map(|p| p[0].abs()).fold(0.5 * gap, f64::max) * 2.6;
    let scale_px_per_m = (HEIGHT / (1.6 * gap)).min(WIDTH / wide);
    if !(scale_px_per_m.is_finite() && scale_px_per_m > 0.0) {
        return None;
    }
    let scale = scale_px_per_m;
    let o_px = [0.5 * WIDTH, 0.5 * HEIGHT + 0.5 * (inner + outer) * scale];
    let mut svg = Svg::new(WIDTH, HEIGHT, "One sprag between its races, to scale");
    let style = format!("fill=\"{RACE}\" fill-rule=\"evenodd\" stroke=\"{SOFT}\" stroke-width=\"1.2\"");
    svg.open("outer", "");
    svg.path(&(circle(o_px, outside * scale) + &circle(o_px, outer * scale)), &style);
    svg.path(&marks(o_px, outer * scale, 1.0, WIDTH), &format!("fill=\"none\" stroke=\"{SOFT}\""));
    svg.close();
    svg.open("inner", "");
    let hole = if bore > 0.0 { circle(o_px, bore * scale) } else { String::new() };
    svg.path(&(circle(o_px, inner * scale) + &hole), &style);
    svg.path(&marks(o_px, inner * scale, -1.0, WIDTH), &format!("fill=\"none\" stroke=\"{SOFT}\""));
    svg.close();
    let about_ce = |points: &[[f64; 2]]| {
        polyline(&points.iter().map(|[x, y]| [x * scale, -y * scale]).collect::<Vec<_>>(), true)
    };
    let at = |pose: &SpragPose| {
        let turn = pose.rotation_rad.to_degrees();
        let y = o_px[1] - pose.outer_centre_distance_m * scale;
        format!("transform=\"translate({} {}) rotate({turn:.5})\"", px(o_px[0]), px(y))
    };
    svg.open("sprag", &at(first));
    svg.path(
        &about_ce(&first.outline_m),
        &format!("fill=\"{BODY}\" fill-opacity=\"0.8\" stroke=\"{EDGE}\" stroke-width=\"1.6\""),
    );
    centres(&mut svg, first, scale);
    svg.close();
    if let Some(ghost) = ghosts.first() {
        svg.open("ghost", &at(ghost));
        let style =
            format!("fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\" stroke-dasharray=\"7 4\"", SERIES[1]);
        svg.path(&about_ce(&ghost.outline_m), &style);
        svg.close();
    }
    svg.open("forces", "");
    svg.close();
    Some(Live { svg: svg.finish(), scale_px_per_m, o_px })
}

/// Short radial lines behind the track, as far to both sides as the figure and a turn of it reach.
fn marks(o: [f64; 2], radius_px: f64, outward: f64, width_px: f64) -> String {
    let half_deg = (width_px / radius_px).min(1.0).asin().to_degrees().ceil() + 20.0;
    let count = (half_deg / MARK_DEG).ceil() as i32;
    let mark = |i: i32| {
        let (s, c) = (f64::from(i) * MARK_DEG).to_radians().sin_cos();
        let at = |r: f64| [o[0] + r * s, o[1] - r * c];
        let long = if i % 5 == 0 { 14.0 } else { 7.0 };
        polyline(&[at(radius_px), at(radius_px + outward * long)], false)
    };
    (-count..=count).map(mark).collect()
}

/// C_e, the arc centres, the junctions and the centroid, about C_e.
fn centres(svg: &mut Svg, pose: &SpragPose, scale: f64) {
    let at = |[x, y]: [f64; 2]| [x * scale, -y * scale];
    let mut cross = |point: [f64; 2], colour: &str| {
        let [x, y] = at(point);
        let style = format!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.3\"");
        svg.line([x - 5.0, y], [x + 5.0, y], &style);
        svg.line([x, y - 5.0], [x, y + 5.0], &style);
    };
    cross([0.0, 0.0], EDGE);
    pose.arcs.iter().for_each(|arc| cross(arc.centre_m, SERIES[2]));
    pose.pivot_m.iter().for_each(|p| cross(*p, INK));
    for (k, arc) in pose.arcs.iter().enumerate() {
        let turns = if k == 0 { vec![arc.from_rad, arc.until_rad] } else { vec![arc.until_rad] };
        for turn in turns {
            let [x, y] = pose.profile_point_m(arc, turn);
            let [cx, cy] = arc.centre_m;
            let along = 7.0 / (scale * arc.radius_m);
            let tick = |side: f64| at([x + side * along * (x - cx), y + side * along * (y - cy)]);
            svg.line(tick(-1.0), tick(1.0), &format!("fill=\"none\" stroke=\"{INK}\" stroke-width=\"1.3\""));
        }
    }
    if let Some(g) = pose.centroid_m.filter(|g| g.iter().all(|v| v.is_finite())) {
        svg.dot(at(g), 4.2, &format!("fill=\"{PAPER}\" stroke=\"{INK}\" stroke-width=\"1.3\""));
        svg.dot(at(g), 1.4, &format!("fill=\"{INK}\""));
    }
}
