//! The whole clutch.

use super::Drawing;
use crate::report::svg::{BODY, EDGE, RACE, SERIES, SOFT, Svg, circle, polyline};
use std::f64::consts::TAU;

/// Side of the small picture, px.
const SMALL: f64 = 200.0;

pub fn small(drawing: &Drawing, widest_m: f64) -> String {
    let mut svg = Svg::new(SMALL, SMALL, "The clutch, all sprags at first contact");
    let [.., outside] = drawing.race_radii_m;
    if outside > 0.0 && outside.is_finite() && widest_m >= outside {
        draw(&mut svg, drawing, [SMALL / 2.0, SMALL / 2.0], (SMALL / 2.0 - 4.0) / widest_m);
    }
    svg.finish()
}

/// Races and all sprags about `o`, px, at `scale` pixels per metre.
pub(super) fn draw(svg: &mut Svg, drawing: &Drawing, o: [f64; 2], scale: f64) {
    let [bore, inner, outer, outside] = drawing.race_radii_m;
    let race = format!("fill=\"{RACE}\" fill-rule=\"evenodd\" stroke=\"{SOFT}\" stroke-width=\"1\"");
    let ring = |a: f64, b: f64| {
        let mut d = circle(o, b * scale);
        if a > 0.0 {
            d.push_str(&circle(o, a * scale));
        }
        d
    };
    svg.path(&ring(outer, outside), &race);
    svg.path(&ring(bore, inner), &race);
    let poses = drawing.drawable();
    for (index, pose) in poses.iter().enumerate() {
        let style = if index == 0 {
            format!("fill=\"{BODY}\" stroke=\"{EDGE}\" stroke-width=\"1\"")
        } else {
            format!(
                "fill=\"none\" stroke=\"{}\" stroke-width=\"1\" stroke-dasharray=\"3 2\"",
                SERIES[index % 6]
            )
        };
        let placed: Vec<[f64; 2]> = pose.outline_m.iter().map(|&p| pose.place(p)).collect();
        for k in 0..drawing.count {
            let (s, c) = (TAU * k as f64 / drawing.count as f64).sin_cos();
            let turned =
                |&[x, y]: &[f64; 2]| [o[0] + scale * (x * c + y * s), o[1] - scale * (y * c - x * s)];
            svg.path(&polyline(&placed.iter().map(turned).collect::<Vec<_>>(), true), &style);
        }
    }
    cross(svg, o);
}

fn cross(svg: &mut Svg, at: [f64; 2]) {
    let style = format!("fill=\"none\" stroke=\"{SOFT}\" stroke-width=\"1\"");
    svg.line([at[0] - 6.0, at[1]], [at[0] + 6.0, at[1]], &style);
    svg.line([at[0], at[1] - 6.0], [at[0], at[1] + 6.0], &style);
}
