//! One sprag large.

use super::{Drawing, DrawnArc, SpragPose, spread, subscript};
use crate::report::number::{Unit, plain};
use crate::report::svg::{
    Anchor, BODY, EDGE, INK, PAPER, PHONE_PX, RACE, SERIES, SOFT, Svg, circle, for_both, polyline, text_width,
};

/// In a window, and on a phone.
const SIZES: [[f64; 2]; 2] = [[720.0, 560.0], [PHONE_PX, 430.0]];
/// Columns at both sides for labels.
const COLUMNS: [[f64; 2]; 2] = [[178.0, 178.0], [160.0, 100.0]];
const PITCH: f64 = 19.0;

/// The map from the drawn frame (m, y up) to the figure (px, y down).
pub(super) struct View {
    /// Pixels per metre.
    pub(super) scale: f64,
    middle_m: [f64; 2],
    /// Width and height, px.
    size: [f64; 2],
    /// Widths of the label columns left and right, px.
    columns: [f64; 2],
    /// Labels as a drawing has them: lengths in mm that do not say so, junctions and ends without their word.
    terse: bool,
}

impl View {
    /// The largest that shows a quarter of the gap of either race and keeps clear of the label columns.
    pub(super) fn of(
        drawing: &Drawing,
        poses: &[&SpragPose],
        size: [f64; 2],
        columns: [f64; 2],
    ) -> Option<Self> {
        let [_, inner, outer, _] = drawing.race_radii_m;
        let gap = outer - inner;
        let points = || poses.iter().flat_map(|p| p.outline_m.iter().map(|&q| p.place(q)[0]));
        let left = points().fold(0.0, f64::min);
        let right = points().fold(0.0, f64::max);
        // Outlines of other sizes may stand out of the gap.
        let heights = || poses.iter().flat_map(|p| p.outline_m.iter().map(|&q| p.place(q)[1]));
        let low = heights().fold(inner - 0.25 * gap, |a, y| a.min(y - 0.1 * gap));
        let top = heights().fold(outer + 0.25 * gap, |a, y| a.max(y + 0.1 * gap));
        let high = top - low;
        let wide = (right - left).max(0.5 * gap) * 1.15;
        let scale = (size[1] / high).min((size[0] - columns[0] - columns[1]) / wide);
        let middle_m = [(left + right) / 2.0, (low + top) / 2.0];
        (scale.is_finite() && scale > 0.0).then_some(Self { scale, middle_m, size, columns, terse: false })
    }

    /// The same with terse labels of `pose`, in columns no wider than these.
    pub(super) fn terse(drawing: &Drawing, pose: &SpragPose, size: [f64; 2]) -> Option<Self> {
        let view = |columns| Some(Self { terse: true, ..Self::of(drawing, &[pose], size, columns)? });
        let notes = draw_points(&mut Svg::new(size[0], size[1], ""), &view([0.0; 2])?, pose);
        let widest = |left: bool| {
            let widths = notes.iter().filter(|n| n.left == left).map(|n| text_width(&n.text, 12.0));
            widths.fold(0.0, f64::max) + 16.0
        };
        view([widest(true), widest(false)])
    }

    fn length(&self, m: f64) -> String {
        if self.terse { plain(Unit::Millimetre.from_si(m), 6) } else { Unit::Millimetre.show_plain(m, 6) }
    }

    pub(super) fn px(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [mx, my] = self.middle_m;
        let [width, height] = self.size;
        let centre = (self.columns[0] + width - self.columns[1]) / 2.0;
        [centre + (x - mx) * self.scale, height / 2.0 - (y - my) * self.scale]
    }
}

/// A point with a label in one of the columns.
struct Note {
    at: [f64; 2],
    text: String,
    left: bool,
    /// Height that the label would like, px.
    wanted: f64,
}

pub fn in_window(drawing: &Drawing) -> String {
    svg(drawing, SIZES[0], COLUMNS[0])
}

/// The drawing as a page has it.
pub fn figure(drawing: &Drawing) -> String {
    for_both(&in_window(drawing), &svg(drawing, SIZES[1], COLUMNS[1]))
}

fn svg(drawing: &Drawing, size: [f64; 2], columns: [f64; 2]) -> String {
    let mut svg = Svg::new(size[0], size[1], "One sprag between its races, to scale");
    let poses = drawing.drawable();
    let (Some(view), Some((first, others))) = (View::of(drawing, &poses, size, columns), poses.split_first())
    else {
        return svg.finish();
    };
    draw_races(&mut svg, drawing, &view);
    draw_arrow(&mut svg, &view);
    draw_sprags(&mut svg, &view, first, others);
    draw_scale_bar(&mut svg, &view);
    if !others.is_empty() {
        draw_legend(&mut svg, &view, first, others);
    }
    svg.finish()
}

/// The first pose in full with its labels, the others dashed over it.
pub(super) fn draw_sprags(svg: &mut Svg, view: &View, first: &SpragPose, others: &[&SpragPose]) {
    let outline = |pose: &SpragPose| {
        polyline(&pose.outline_m.iter().map(|&p| view.px(pose.place(p))).collect::<Vec<_>>(), true)
    };
    svg.path(
        &outline(first),
        &format!("fill=\"{BODY}\" fill-opacity=\"0.75\" stroke=\"{EDGE}\" stroke-width=\"1.6\""),
    );
    for (index, pose) in others.iter().enumerate() {
        svg.path(&outline(pose), &overlay_style(index));
    }
    let notes = draw_points(svg, view, first);
    draw_notes(svg, view, &notes);
}

/// What the labels name, and the labels.
fn draw_points(svg: &mut Svg, view: &View, pose: &SpragPose) -> Vec<Note> {
    let mut notes = Vec::new();
    draw_strut(svg, view, pose, &mut notes);
    draw_profile(svg, view, pose, &mut notes);
    draw_centres(svg, view, pose, &mut notes);
    notes
}

fn overlay_style(index: usize) -> String {
    format!(
        "fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\" stroke-dasharray=\"7 3\"",
        SERIES[(index + 1) % 6]
    )
}

pub(super) fn draw_races(svg: &mut Svg, drawing: &Drawing, view: &View) {
    let [bore, inner, outer, outside] = drawing.race_radii_m;
    let o = view.px([0.0, 0.0]);
    let style = format!("fill=\"{RACE}\" fill-rule=\"evenodd\" stroke=\"{SOFT}\" stroke-width=\"1.2\"");
    svg.path(&(circle(o, outside * view.scale) + &circle(o, outer * view.scale)), &style);
    let hole = if bore > 0.0 { circle(o, bore * view.scale) } else { String::new() };
    svg.path(&(circle(o, inner * view.scale) + &hole), &style);
    // Each name on its race, as far left as it stands clear of the edges.
    let height = view.size[1];
    let above = |radius: f64, x: f64| {
        let (r, dx) = (radius * view.scale, x - o[0]);
        (r * r > dx * dx).then(|| o[1] - (r * r - dx * dx).sqrt())
    };
    let name = |svg: &mut Svg, name: &str, [outside, inside]: [f64; 2]| {
        let place = |left: f64| {
            let ends = [left, left + text_width(name, 12.0)];
            let top = ends.map(|x| above(outside, x).unwrap_or(height)).into_iter().fold(0.0, f64::max);
            let bottom = ends.map(|x| above(inside, x).unwrap_or(height)).into_iter().fold(height, f64::min);
            (bottom - top > 22.0).then_some([left, 0.5 * (top + bottom) + 4.0])
        };
        if let Some(at) = [14.0, 50.0, 90.0, 130.0, 170.0].into_iter().find_map(place) {
            svg.bare_text(at, Anchor::Start, SOFT, name);
        }
    };
    name(svg, "outer race", [outside, outer]);
    name(svg, "inner race", [inner, bore]);
}

/// Engagement lowers the inner race's angle against the outer's: anticlockwise on the page.
fn draw_arrow(svg: &mut Svg, view: &View) {
    let [width, height] = view.size;
    // Above the scale bar where both find no room side by side.
    let y = height - if width > PHONE_PX { 18.0 } else { 40.0 };
    let (tip, tail) = (width / 2.0 - 106.0, width / 2.0 - 50.0);
    let ink = format!("fill=\"none\" stroke=\"{INK}\" stroke-width=\"1.3\"");
    svg.line([tail, y], [tip, y], &ink);
    svg.path(&polyline(&[[tip + 8.0, y - 4.0], [tip, y], [tip + 8.0, y + 4.0]], false), &ink);
    svg.bare_text([tail + 6.0, y + 4.0], Anchor::Start, INK, "inner race turns to engage");
}

/// A, B, the strut AB that carries the load, and the radius OB that shows how steep it is.
fn draw_strut(svg: &mut Svg, view: &View, pose: &SpragPose, notes: &mut Vec<Note>) {
    let b = pose.outer_contact_m();
    let Some(a) = pose.inner_contact_m() else { return };
    svg.line(
        view.px(a),
        view.px(b),
        &format!("fill=\"none\" stroke=\"{INK}\" stroke-width=\"1.4\" stroke-dasharray=\"10 3 2 3\""),
    );
    // Angle of the strut to OB: tan nu of the drawn position.
    let strut = (a[0] - b[0]).atan2(b[1] - a[1]);
    // omega = azimuth of A seen from O plus nu (triangle OAB).
    let omega = a[0].atan2(a[1]) + strut;
    for (at, text) in [
        (b, format!("B, ν {}", Unit::Degree.show(strut, 3))),
        (a, format!("A, ω {}", Unit::Degree.show(omega, 3))),
    ] {
        svg.dot(view.px(at), 3.6, &format!("fill=\"{INK}\" stroke=\"{PAPER}\" stroke-width=\"1.2\""));
        notes.push(Note { at: view.px(at), text, left: false, wanted: view.px(at)[1] });
    }
}

/// Junction ticks across the profile, first contact and the end of the profile. Contacts follow one another
/// to the right, so their labels on the left stand in the opposite order, downwards: no leader crosses another.
fn draw_profile(svg: &mut Svg, view: &View, pose: &SpragPose, notes: &mut Vec<Note>) {
    let mut ticks: Vec<(&DrawnArc, f64, String)> = Vec::new();
    for (k, arc) in pose.arcs.iter().enumerate() {
        if k == 0 {
            let name = if view.terse { "first contact" } else { "first contact at rest" };
            ticks.push((arc, arc.from_rad, name.to_owned()));
        }
        if k + 1 < pose.arcs.len() && pose.within_spiral(k + 1) {
            continue;
        }
        let name = match (k + 1 < pose.arcs.len(), view.terse) {
            (true, true) => format!("{}|{}", k + 1, k + 2),
            (true, false) => format!("junction {}|{}", k + 1, k + 2),
            (false, true) => "end".to_owned(),
            (false, false) => "end of profile".to_owned(),
        };
        ticks.push((arc, arc.until_rad, format!("{name}, {} rad", plain(arc.until_rad, 4))));
    }
    for (rank, (arc, turn, text)) in ticks.into_iter().enumerate() {
        let at = |part_px: f64| {
            let [x, y] = pose.profile_point_m(arc, turn);
            let step = part_px / (view.scale * arc.radius_m);
            view.px(pose.place([x + step * (x - arc.centre_m[0]), y + step * (y - arc.centre_m[1])]))
        };
        svg.line(at(-7.0), at(7.0), &format!("fill=\"none\" stroke=\"{INK}\" stroke-width=\"1.3\""));
        let at = at(0.0);
        notes.push(Note { at, text, left: true, wanted: at[1] - 26.0 - PITCH * rank as f64 });
    }
}

fn draw_centres(svg: &mut Svg, view: &View, pose: &SpragPose, notes: &mut Vec<Note>) {
    let mut cross = |at: [f64; 2], colour: &str| {
        let style = format!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.4\"");
        svg.line([at[0] - 5.0, at[1]], [at[0] + 5.0, at[1]], &style);
        svg.line([at[0], at[1] - 5.0], [at[0], at[1] + 5.0], &style);
    };
    let ce = view.px(pose.place([0.0, 0.0]));
    cross(ce, EDGE);
    notes.push(Note {
        at: ce,
        text: format!("Cₑ, rₑ {}", view.length(pose.outer_radius_m)),
        left: false,
        wanted: ce[1],
    });
    for (k, arc) in pose.arcs.iter().enumerate() {
        let at = view.px(pose.place(arc.centre_m));
        cross(at, SERIES[1]);
        if pose.within_spiral(k) && k + 1 < pose.arcs.len() {
            continue;
        }
        let text =
            format!("{}, {} {}", subscript("C", k + 1), subscript("rᵢ", k + 1), view.length(arc.radius_m));
        notes.push(Note { at, text, left: false, wanted: at[1] });
    }
    if let Some(spiral) = pose.spiral {
        let at = view.px(pose.place(spiral.pole_m));
        cross(at, INK);
        notes.push(Note { at, text: "pole".to_owned(), left: false, wanted: at[1] });
    }
    if let Some(p) = pose.pivot_m {
        let at = view.px(pose.place(p));
        cross(at, INK);
        notes.push(Note { at, text: "P, pivot".to_owned(), left: true, wanted: at[1] });
    }
    if let Some(g) = pose.centroid_m.filter(|g| g.iter().all(|v| v.is_finite())) {
        let at = view.px(pose.place(g));
        svg.dot(at, 4.2, &format!("fill=\"{PAPER}\" stroke=\"{INK}\" stroke-width=\"1.3\""));
        svg.dot(at, 1.4, &format!("fill=\"{INK}\""));
        notes.push(Note { at, text: "G, centroid".to_owned(), left: false, wanted: at[1] });
    }
}

/// Labels in two columns, each on a leader that ends at its point.
fn draw_notes(svg: &mut Svg, view: &View, notes: &[Note]) {
    let ([width, height], columns) = (view.size, view.columns);
    for left in [true, false] {
        let side: Vec<&Note> = notes.iter().filter(|n| n.left == left).collect();
        let wanted: Vec<f64> = side.iter().map(|n| n.wanted).collect();
        let column = if left { columns[0] - 12.0 } else { width - columns[1] + 24.0 };
        let bend = if left { 14.0 } else { -14.0 };
        for (note, y) in side.iter().zip(spread(&wanted, PITCH, 46.0, height - 50.0)) {
            // A name longer than its column leans into the drawing: nothing of it is cut.
            let most = text_width(&note.text, 12.0);
            let wide = 0.9 * most;
            let x = if left { column.max(wide + 4.0) } else { column.min(width - most - 2.0) };
            let knee = [x + bend, y - 4.0];
            let start = [x + bend / 3.0, y - 4.0];
            svg.path(
                &polyline(&[start, knee, note.at], false),
                &format!("fill=\"none\" stroke=\"{SOFT}\" stroke-width=\"0.8\""),
            );
            svg.text([x, y], if left { Anchor::End } else { Anchor::Start }, INK, &note.text);
        }
    }
}

/// A bar of 1, 2 or 5 times a power of ten millimetres, about a sixth of the figure long.
fn draw_scale_bar(svg: &mut Svg, view: &View) {
    let [width, height] = view.size;
    let wanted = width / 6.0 / view.scale;
    let power = 10f64.powf(wanted.log10().floor());
    let step = [5.0, 2.0, 1.0].into_iter().find(|s| s * power <= wanted).unwrap_or(1.0);
    let length = step * power;
    let (right, y) = (width - 16.0, height - 18.0);
    let left = right - length * view.scale;
    svg.path(
        &polyline(&[[left, y - 4.0], [left, y], [right, y], [right, y - 4.0]], false),
        &format!("fill=\"none\" stroke=\"{INK}\" stroke-width=\"1.4\""),
    );
    svg.bare_text([left - 6.0, y + 3.0], Anchor::End, INK, &Unit::Millimetre.show(length, 1));
}

fn draw_legend(svg: &mut Svg, view: &View, first: &SpragPose, others: &[&SpragPose]) {
    let entries = std::iter::once((
        first.label.as_str(),
        format!("fill=\"none\" stroke=\"{EDGE}\" stroke-width=\"2\""),
    ))
    .chain(others.iter().enumerate().map(|(i, p)| (p.label.as_str(), overlay_style(i))));
    for (i, (label, style)) in entries.enumerate() {
        let y = 22.0 + PITCH * i as f64;
        let x = view.size[0] - 16.0 - text_width(label, 12.0);
        svg.line([x - 34.0, y - 4.0], [x - 8.0, y - 4.0], &style);
        svg.bare_text([x, y], Anchor::Start, INK, label);
    }
}
