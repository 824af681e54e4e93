//! A drawing as SVG at full size: one unit is one millimetre, arcs are arcs, each layer is a group.

use super::sheet::{Entity, Layer, Sheet};
use super::{DrawnClutch, Part};
use crate::profile::Segment;
use nalgebra::Vector2;
use std::fmt::Write;

/// Margin round the drawing over the height of letters.
const MARGIN: f64 = 2.0;

/// The drawing of a part.
pub fn svg(part: Part, subject: &DrawnClutch) -> String {
    let sheet = Sheet::new(part, subject);
    let margin = MARGIN * sheet.letter_m;
    let [low, high] = sheet.extent_m;
    // y runs down in SVG.
    let [x, y] = [1e3 * (low.x - margin), -1e3 * (high.y + margin)];
    let [width, height] = [high.x - low.x, high.y - low.y].map(|d| 1e3 * (d + 2.0 * margin));
    let stroke = 0.05 * 1e3 * sheet.letter_m;
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.4}mm\" height=\"{height:.4}mm\" \
         viewBox=\"{x:.6} {y:.6} {width:.4} {height:.4}\">\n<desc>{}</desc>\n<title>{}</title>\n",
        escaped(&subject.mark()),
        escaped(&sheet.title)
    );
    for layer in Layer::ALL {
        let dashes = match layer.is_dashed() {
            true => format!(
                " stroke-dasharray=\"{:.4} {:.4} {:.4} {:.4}\"",
                30.0 * stroke,
                6.0 * stroke,
                6.0 * stroke,
                6.0 * stroke
            ),
            false => String::new(),
        };
        let wide = if matches!(layer, Layer::Sprag | Layer::Races) { 2.0 * stroke } else { stroke };
        let _ = writeln!(
            out,
            "<g id=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{wide:.4}\"{dashes}>",
            layer.name(),
            colour(layer)
        );
        for (_, entity) in sheet.entities.iter().filter(|(on, _)| *on == layer) {
            if let Some(element) = element(entity) {
                let _ = writeln!(out, "{element}");
            }
        }
        out.push_str("</g>\n");
    }
    out.push_str("</svg>\n");
    out
}

/// `None`: a point, whose cross is drawn.
fn element(entity: &Entity) -> Option<String> {
    Some(match entity {
        Entity::Point(_) => return None,
        Entity::Closed(segments) => format!("<path d=\"{}\"/>", path(segments)),
        Entity::Circle { centre_m, radius_m } => {
            let [x, y] = mm(*centre_m);
            format!("<circle cx=\"{x}\" cy=\"{y}\" r=\"{}\"/>", number(1e3 * radius_m))
        }
        Entity::Line { from_m, to_m } => {
            let ([x1, y1], [x2, y2]) = (mm(*from_m), mm(*to_m));
            format!("<line x1=\"{x1}\" y1=\"{y1}\" x2=\"{x2}\" y2=\"{y2}\"/>")
        }
        Entity::Text { at_m, height_m, text } => {
            let [x, y] = mm(*at_m);
            // Capitals are some 0.7 of the font's size high.
            let size = number(1e3 * height_m / 0.7);
            format!(
                "<text x=\"{x}\" y=\"{y}\" font-family=\"monospace\" font-size=\"{size}\" fill=\"#000\" stroke=\"none\" \
                 xml:space=\"preserve\">{}</text>",
                escaped(text)
            )
        }
    })
}

fn path(segments: &[Segment]) -> String {
    let Some(first) = segments.first() else { return String::new() };
    let [x, y] = mm(first.start_m());
    let mut d = format!("M{x} {y}");
    for segment in segments {
        let [x, y] = mm(segment.end_m());
        let _ = match segment {
            Segment::Line { .. } => write!(d, "L{x} {y}"),
            Segment::Arc { radius_m, sweep_rad, .. } => {
                let r = number(1e3 * radius_m);
                let large = i32::from(sweep_rad.abs() > std::f64::consts::PI);
                // Counterclockwise on the page is the negative sense of SVG.
                write!(d, "A{r} {r} 0 {large} {} {x} {y}", i32::from(*sweep_rad > 0.0))
            }
        };
    }
    d + "Z"
}

fn mm(at_m: Vector2<f64>) -> [String; 2] {
    [number(1e3 * at_m.x), number(-1e3 * at_m.y)]
}

/// To a picometre, without trailing zeros.
fn number(value: f64) -> String {
    let text = format!("{value:.9}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

fn colour(layer: Layer) -> &'static str {
    match layer {
        Layer::Sprag | Layer::Races | Layer::Text => "#000",
        Layer::Centres => "#c00",
        Layer::CentreLines => "#06c",
        Layer::ArcEnds => "#909",
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
