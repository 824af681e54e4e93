//! The dimensioned drawing: the whole clutch from the front, cut along its axis, and one sprag enlarged.

use super::{Drawing, SpragPose, clutch, detail};
use crate::report::number::{Unit, plain};
use crate::report::svg::{
    Anchor, BODY, EDGE, INK, PAPER, PHONE_PX, RACE, SOFT, Svg, for_both, polyline, text_width,
};

/// As wide as A4 between its margins, px.
const WIDTH: f64 = 680.0;
const HEIGHT: f64 = 440.0;
/// Where the enlarged sprag begins, beside the front view.
const SPLIT: f64 = 292.0;
/// Largest diameter of the front view.
const WIDEST: f64 = 222.0;
/// Pixels of a page per metre of paper: 96 an inch.
const PAPER_PX_PER_M: f64 = 96.0 / 0.0254;
/// Scales of a drawing (ISO 5455).
const SCALES: [f64; 14] = [100.0, 50.0, 20.0, 10.0, 5.0, 2.0, 1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005];

/// The largest of [`SCALES`] at which `length_m` takes up no more than `room_px`.
fn scale_for(length_m: f64, room_px: f64) -> Option<f64> {
    SCALES.into_iter().find(|s| s * length_m * PAPER_PX_PER_M <= room_px)
}

/// As a drawing states it: `5:1`, `1:2`.
fn named(scale: f64) -> String {
    if scale >= 1.0 { format!("{}:1", plain(scale, 3)) } else { format!("1:{}", plain(1.0 / scale, 3)) }
}

/// The drawing as a page has it.
pub fn figure(drawing: &Drawing, axial_m: [f64; 2], notes: &[String]) -> String {
    let [window, phone] = [false, true].map(|on_phone| svg(drawing, axial_m, notes, on_phone));
    for_both(&window, &phone)
}

/// Front view and sprag side by side, or on a phone one below the other.
fn svg(drawing: &Drawing, axial_m: [f64; 2], notes: &[String], on_phone: bool) -> String {
    let width = if on_phone { PHONE_PX } else { WIDTH };
    let mut svg = Svg::new(width, HEIGHT, "The clutch and one sprag, with dimensions");
    let [bore, inner, outer, outside] = drawing.race_radii_m;
    let sound = [bore, inner, outer, outside].iter().chain(&axial_m).all(|r| r.is_finite());
    let Some(scale) = scale_for(2.0 * outside, WIDEST).filter(|_| sound && outside > 0.0) else {
        return svg.finish();
    };
    let end = front(&mut svg, drawing, axial_m, scale, notes);
    let at = if on_phone { [0.0, end + 12.0] } else { [SPLIT, 0.0] };
    if let Some(first) = drawing.drawable().first() {
        let end = enlarged(&mut svg, drawing, first, at, width - at[0]);
        svg.reach(end);
    }
    svg.finish()
}

/// The height at which it ends.
fn front(svg: &mut Svg, drawing: &Drawing, axial_m: [f64; 2], scale: f64, notes: &[String]) -> f64 {
    let [bore, inner, outer, outside] = drawing.race_radii_m;
    let px_per_m = scale * PAPER_PX_PER_M;
    let size = |m: f64| m * px_per_m;
    let o = [10.0 + WIDEST / 2.0, 48.0 + WIDEST / 2.0];
    svg.title_text([8.0, 16.0], &format!("Clutch, scale {}", named(scale)));
    clutch::draw(svg, drawing, o, px_per_m);
    let reach = size(outside) + 8.0;
    centre_line(svg, [o[0] - reach, o[1]], [o[0] + reach, o[1]]);
    centre_line(svg, [o[0], o[1] - reach], [o[0], o[1] + reach]);
    let mut y = o[1] + size(outside) + 20.0;
    let mut dimensions: Vec<Across> = section(svg, drawing, axial_m, size, o[1]).into_iter().collect();
    for (radius, name) in
        [(bore, "bore"), (inner, "inner track"), (outer, "outer track"), (outside, "outside")]
    {
        if radius > 0.0 {
            let text = format!("⌀ {} {name}", plain(Unit::Millimetre.from_si(2.0 * radius), 6));
            let ends = [o[0] - size(radius), o[0] + size(radius)];
            let across = Across { ends, from_y: o[1], y, text };
            dimensions.push(across.within(SPLIT - 4.0));
            y += 21.0;
        }
    }
    // Texts last: no line runs through one.
    dimensions.iter().for_each(|d| d.draw_lines(svg));
    dimensions.iter().for_each(|d| d.draw_text(svg));
    for note in notes {
        svg.bare_text([8.0, y + 6.0], Anchor::Start, INK, note);
        y += 16.0;
    }
    y
}

/// Races and sprag cut along the axis, both halves, right of the front view, where there is room.
fn section(
    svg: &mut Svg,
    drawing: &Drawing,
    [width_m, length_m]: [f64; 2],
    size: impl Fn(f64) -> f64,
    axis_y: f64,
) -> Option<Across> {
    let [bore, inner, outer, outside] = drawing.race_radii_m;
    let (left, room) = (28.0 + WIDEST, SPLIT - 38.0 - WIDEST);
    let (width, length) = (size(width_m), size(length_m));
    if !(width > 0.0 && width.max(length) <= room) {
        return None;
    }
    let middle = left + room / 2.0;
    let mut block = |from: f64, until: f64, wide: f64, fill: &str, edge: &str| {
        for side in [-1.0, 1.0] {
            let (a, b) = (axis_y + side * size(from), axis_y + side * size(until));
            let (l, r) = (middle - wide / 2.0, middle + wide / 2.0);
            let style = format!("fill=\"{fill}\" stroke=\"{edge}\" stroke-width=\"1\"");
            svg.path(&polyline(&[[l, a], [r, a], [r, b], [l, b]], true), &style);
        }
    };
    block(bore, inner, width, RACE, SOFT);
    block(outer, outside, width, RACE, SOFT);
    block(inner, outer, length, BODY, EDGE);
    centre_line(svg, [left - 4.0, axis_y], [left + room + 4.0, axis_y]);
    // Above, where no diameter stands.
    Some(Across {
        ends: [middle - width / 2.0, middle + width / 2.0],
        from_y: axis_y - size(outside),
        y: axis_y - size(outside) - 9.0,
        text: plain(Unit::Millimetre.from_si(width_m), 6),
    })
}

/// A dimension: extension lines from `from_y` to an arrowed line at `y`, its text in it where that is long enough, else
/// behind it, or above where the line stands above.
struct Across {
    ends: [f64; 2],
    from_y: f64,
    y: f64,
    text: String,
}

impl Across {
    /// The same with the last word left out where it would reach beyond `x`.
    fn within(mut self, x: f64) -> Self {
        let stands_behind = self.half_text().is_none();
        if stands_behind && self.ends[1] + 6.0 + 0.8 * text_width(&self.text, 12.0) > x {
            self.text = self.text.trim_end_matches(" track").to_owned();
        }
        self
    }

    /// Half of the text and a hair, where it stands in the line.
    fn half_text(&self) -> Option<f64> {
        let half = 0.45 * text_width(&self.text, 12.0);
        (2.0 * half + 14.0 < self.ends[1] - self.ends[0]).then_some(half)
    }

    fn draw_lines(&self, svg: &mut Svg) {
        let thin = format!("fill=\"none\" stroke=\"{SOFT}\" stroke-width=\"0.7\"");
        let ([left, right], y) = (self.ends, self.y);
        for x in [left, right] {
            svg.line([x, self.from_y], [x, y + 3.0_f64.copysign(y - self.from_y)], &thin);
        }
        match self.half_text() {
            Some(half) => {
                let middle = (left + right) / 2.0;
                svg.line([left, y], [middle - half, y], &thin);
                svg.line([middle + half, y], [right, y], &thin);
            }
            None => svg.line([left, y], [right, y], &thin),
        }
        for (x, inward) in [(left, 1.0), (right, -1.0)] {
            let tip = [[x, y], [x + 6.0 * inward, y - 2.2], [x + 6.0 * inward, y + 2.2]];
            svg.path(&polyline(&tip, true), &format!("fill=\"{INK}\""));
        }
    }

    fn draw_text(&self, svg: &mut Svg) {
        let ([left, right], y) = (self.ends, self.y + 4.0);
        match self.half_text() {
            Some(_) => svg.text([(left + right) / 2.0, y], Anchor::Middle, INK, &self.text),
            None if self.y < self.from_y => {
                svg.text([(left + right) / 2.0, self.y - 5.0], Anchor::Middle, INK, &self.text);
            }
            None => {
                // The extension lines of larger diameters are broken where they would run through it.
                let (from, until) = (right + 3.0, right + 7.0 + 0.9 * text_width(&self.text, 12.0));
                let ground = [[from, y - 11.0], [until, y - 11.0], [until, y + 4.0], [from, y + 4.0]];
                svg.path(&polyline(&ground, true), &format!("fill=\"{PAPER}\""));
                svg.text([right + 5.0, y], Anchor::Start, INK, &self.text);
            }
        }
    }
}

fn centre_line(svg: &mut Svg, from: [f64; 2], to: [f64; 2]) {
    let style = format!("fill=\"none\" stroke=\"{SOFT}\" stroke-width=\"0.8\" stroke-dasharray=\"12 3 2 3\"");
    svg.line(from, to, &style);
}

/// One sprag with radii, centres, contacts, junctions, so wide from there on; below it the lengths that no line shows. The height at
/// which it ends.
fn enlarged(svg: &mut Svg, drawing: &Drawing, pose: &SpragPose, [left, top]: [f64; 2], width: f64) -> f64 {
    let size = [width, HEIGHT - 62.0];
    let Some(mut view) = detail::View::terse(drawing, pose, size) else { return top };
    // The air beside the sprag in the other view is not needed here.
    let Some(scale) = scale_for(1.0, 1.15 * view.scale) else { return top };
    view.scale = scale * PAPER_PX_PER_M;
    svg.title_text([left, top + 16.0], &format!("Sprag at first contact, no load, scale {}", named(scale)));
    svg.open_part([left, top + 24.0], size);
    detail::draw_races(svg, drawing, &view);
    detail::draw_sprags(svg, &view, pose, &[]);
    let up = view.px([0.0, pose.outer_centre_distance_m]);
    centre_line(svg, [up[0], 0.0], [up[0], size[1]]);
    svg.close_part();
    let mm = |m: f64| Unit::Millimetre.show_plain(m, 6);
    let [_, inner, outer, _] = drawing.race_radii_m;
    let mut lengths = vec![format!("race gap {}", mm(outer - inner))];
    if let Some(a) = pose.inner_contact_m() {
        let b = pose.outer_contact_m();
        let length = (a[0] - b[0]).hypot(a[1] - b[1]);
        lengths.push(format!("strut AB {}", Unit::Millimetre.show_plain(length, 5)));
    }
    if let Some(first) = pose.arcs.first() {
        lengths.push(format!("e₁ = C₁Cₑ {}", mm(first.centre_m[0].hypot(first.centre_m[1]))));
    }
    if let Some(spiral) = pose.spiral {
        let curve = &spiral.curve;
        let [x, y] = spiral.pole_m.map(|v| (1e4 * Unit::Millimetre.from_si(v)).round() / 1e4 + 0.0);
        let arcs = pose.arcs.len() - spiral.first;
        let inside = match curve.inset_m > 0.0 {
            true => format!(" − {}", plain(Unit::Millimetre.from_si(curve.inset_m), 6)),
            false => String::new(),
        };
        lengths.extend([
            format!(
                "ρ = {} e^({} ψ){inside} mm",
                plain(Unit::Millimetre.from_si(curve.start_radius_m + curve.inset_m), 6),
                plain(curve.rise, 6)
            ),
            format!("pole ({x:.4}, {y:.4}) mm from Cₑ, as {arcs} arcs"),
        ]);
    }
    // Engagement lowers the inner race's angle against the outer's.
    lengths.push("to engage the inner race turns anticlockwise".to_owned());
    // In as many lines as they need.
    let mut lines: Vec<String> = Vec::new();
    for length in lengths {
        match lines.last_mut() {
            Some(line) if text_width(&format!("{line}, {length}"), 12.0) <= width => {
                line.push_str(&format!(", {length}"));
            }
            _ => lines.push(length),
        }
    }
    let mut y = top + size[1] + 42.0;
    for line in lines {
        svg.bare_text([left, y], Anchor::Start, INK, &line);
        y += 16.0;
    }
    svg.bare_text([left, y], Anchor::Start, SOFT, "at these scales where printed at 100 %");
    y + 4.0
}
