//! The outline in a DXF (text, any release): lines, arcs, circles' arcs, polylines with bulges, splines, chained end to end.

use super::{Drawn, DrawnUnit, NoImport, TAKEN_FOR_MM, number, points};
use nalgebra::Vector2;
use std::f64::consts::{PI, TAU};

pub(super) const STEP_HELP: &str =
    "export the profile of the sprag from the CAD program as DXF, a flat drawing, not as a solid";

/// Ends closer than this belong together, m: what rounding in a drawing leaves.
const JOINED_M: f64 = 10e-6;
/// Points on an arc lie no farther apart than this angle, rad.
const STEP_RAD: f64 = 0.002;
/// Points on each span of a spline.
const PER_SPAN: usize = 24;
/// Curves at most.
const MOST: usize = 200_000;

type Point = Vector2<f64>;

/// One curve: points from end to end, and its line in the file.
pub(super) struct DrawnCurve {
    pub(super) line: usize,
    pub(super) points: Vec<Point>,
    /// Centre of a true arc.
    pub(super) centre: Option<Point>,
}

struct GroupCode<'t> {
    line: usize,
    code: i32,
    value: &'t str,
}

fn groups(text: &str) -> Result<Vec<GroupCode<'_>>, NoImport> {
    const HELP: &str = "save the drawing as DXF in text form; a DWG or a binary DXF is not read";
    if text.trim().is_empty() {
        return Err(NoImport::new(None, "an empty file", HELP));
    }
    if text.trim_start().starts_with("ISO-10303-21") {
        return Err(NoImport::new(1, "a STEP file", STEP_HELP));
    }
    let lines: Vec<&str> = text.lines().collect();
    let mut all = Vec::with_capacity(lines.len() / 2);
    for (i, pair) in lines.chunks(2).enumerate() {
        let line = 2 * i + 1;
        let code = pair[0].trim().trim_start_matches('\u{feff}').parse();
        let code: i32 = code.map_err(|_| {
            let shown: String = pair[0].chars().take(40).collect();
            NoImport::new(line, format!("{shown:?} where a DXF has a group code"), HELP)
        })?;
        let value = pair.get(1).copied().unwrap_or("").trim();
        all.push(GroupCode { line: line + 1, code, value });
    }
    Ok(all)
}

/// Metres in one unit of the drawing; `said`: in place of what it names.
fn unit(groups: &[GroupCode], said: Option<DrawnUnit>, remarks: &mut Vec<String>) -> Result<f64, NoImport> {
    if let Some(said) = said {
        remarks.push(format!("lengths are taken for {}, as asked, whatever the drawing names", said.name()));
        return Ok(said.metres());
    }
    let at = groups.windows(2).find(|g| g[0].code == 9 && g[0].value == "$INSUNITS");
    let (value, line) = at.map_or(("0", 0), |g| (g[1].value, g[1].line));
    match value {
        "4" => Ok(1e-3),
        "0" => {
            remarks.push(format!("the drawing names no unit ($INSUNITS): {TAKEN_FOR_MM}"));
            Ok(1e-3)
        }
        "1" => {
            remarks.push("the drawing is in inches ($INSUNITS = 1): converted to millimetres".to_owned());
            Ok(25.4e-3)
        }
        "5" => Ok(1e-2),
        "6" => Ok(1.0),
        "13" => Ok(1e-6),
        other => Err(NoImport::new(
            line,
            format!("$INSUNITS = {other}"),
            "save the drawing in millimetres ($INSUNITS = 4)",
        )),
    }
}

pub(super) fn read(text: &str, layer: Option<&str>, said: Option<DrawnUnit>) -> Result<Drawn, NoImport> {
    let groups = groups(text)?;
    let mut remarks = Vec::new();
    let scale = unit(&groups, said, &mut remarks)?;
    let Some(start) = groups.iter().position(|g| g.code == 2 && g.value == "ENTITIES") else {
        return Err(NoImport::new(
            None,
            "no section ENTITIES",
            "save the drawing as DXF again, with its outline",
        ));
    };
    let until = groups[start..].iter().position(|g| g.code == 0 && g.value == "ENDSEC");
    let section = &groups[start + 1..until.map_or(groups.len(), |n| start + n)];
    let mut entities: Vec<&[GroupCode]> = Vec::new();
    let heads: Vec<usize> = (0..section.len()).filter(|i| section[*i].code == 0).collect();
    for (n, from) in heads.iter().enumerate() {
        entities.push(&section[*from..heads.get(n + 1).copied().unwrap_or(section.len())]);
    }
    let on = |e: &[GroupCode], wanted: &str| {
        e.iter().find(|g| g.code == 8).is_some_and(|g| g.value.eq_ignore_ascii_case(wanted))
    };
    let own = entities.iter().any(|e| on(e, "SPRAG"));
    if let Some(layer) = layer.or(own.then_some("SPRAG")) {
        entities.retain(|e| on(e, layer));
        if entities.is_empty() {
            return Err(NoImport::new(
                None,
                format!("nothing on the layer {layer:?}"),
                "name another with `layer`",
            ));
        }
    }
    let curves = curves(&entities, scale)?;
    if curves.is_empty() {
        return Err(NoImport::new(
            None,
            "no line, arc, polyline or spline",
            "draw the outline of one sprag with them; blocks must be exploded first",
        ));
    }
    chained(curves, remarks)
}

/// First number of a code.
fn one(entity: &[GroupCode], code: i32) -> Result<Option<f64>, NoImport> {
    entity.iter().find(|g| g.code == code).map(|g| number(g.value, g.line)).transpose()
}

fn need(entity: &[GroupCode], code: i32) -> Result<f64, NoImport> {
    one(entity, code)?.ok_or_else(|| {
        let found = format!("{} without group {code}", entity[0].value);
        NoImport::new(entity[0].line, found, "save the drawing again: this entity is not whole")
    })
}

fn all(entity: &[GroupCode], code: i32) -> Result<Vec<f64>, NoImport> {
    entity.iter().filter(|g| g.code == code).map(|g| number(g.value, g.line)).collect()
}

/// A polyline that is being read: its line, whether it is closed, its points with their bulges.
type Open = (usize, bool, Vec<(Point, f64)>);

fn curves(entities: &[&[GroupCode]], scale: f64) -> Result<Vec<DrawnCurve>, NoImport> {
    let mut curves: Vec<DrawnCurve> = Vec::new();
    let mut vertices: Option<Open> = None;
    let mut turned = 1.0;
    for e in entities {
        let line = e[0].line;
        if curves.len() > MOST {
            return Err(NoImport::new(line, format!("more than {MOST} curves"), "draw one sprag only"));
        }
        let kind = e[0].value;
        // Seen along -z the drawing's x runs the other way; a VERTEX lies as its polyline does.
        let flat = ["ARC", "CIRCLE", "LWPOLYLINE", "POLYLINE"].contains(&kind);
        let [tilted, below] = [
            one(e, 210)?.unwrap_or(0.0).hypot(one(e, 220)?.unwrap_or(0.0)) > 1e-6,
            one(e, 230)?.is_some_and(|z| z < 0.0),
        ];
        if flat && tilted {
            let found = format!("{kind} that does not lie in the plane of the drawing (extrusion)");
            return Err(NoImport::new(line, found, "flatten the drawing in the CAD program"));
        }
        let over = if flat && below { -1.0 } else { 1.0 };
        let point =
            |x: i32, y: i32| -> Result<Point, NoImport> { Ok(scale * Point::new(need(e, x)?, need(e, y)?)) };
        match kind {
            "LINE" => {
                curves.push(DrawnCurve { line, points: vec![point(10, 20)?, point(11, 21)?], centre: None })
            }
            "ARC" => {
                let (centre, radius) = (point(10, 20)?, scale * need(e, 40)?);
                let [from, to] = [need(e, 50)?.to_radians(), need(e, 51)?.to_radians()];
                let turn = (to - from).rem_euclid(TAU);
                curves.push(match over < 0.0 {
                    false => arc(line, centre, radius, from, turn),
                    true => arc(line, Point::new(-centre.x, centre.y), radius, PI - from, -turn),
                });
            }
            "POLYLINE" => {
                vertices = Some((line, one(e, 70)?.unwrap_or(0.0) as i64 & 1 == 1, Vec::new()));
                turned = over;
            }
            "VERTEX" => {
                if let Some((_, _, list)) = &mut vertices {
                    let at = point(10, 20)?;
                    list.push((Point::new(turned * at.x, at.y), turned * one(e, 42)?.unwrap_or(0.0)));
                }
            }
            "SEQEND" => {
                if let Some((line, closed, list)) = vertices.take() {
                    bulged(&mut curves, line, &list, closed);
                }
            }
            "LWPOLYLINE" => {
                let closed = one(e, 70)?.unwrap_or(0.0) as i64 & 1 == 1;
                let mut list: Vec<(Point, f64)> = Vec::new();
                for g in *e {
                    match (g.code, list.last_mut()) {
                        (10, _) => list.push((Point::new(over * scale * number(g.value, g.line)?, 0.0), 0.0)),
                        (20, Some(last)) => last.0.y = scale * number(g.value, g.line)?,
                        (42, Some(last)) => last.1 = over * number(g.value, g.line)?,
                        _ => {}
                    }
                }
                bulged(&mut curves, line, &list, closed);
            }
            "SPLINE" => curves.push(DrawnCurve { line, points: spline(e, scale)?, centre: None }),
            "INSERT" => {
                return Err(NoImport::new(line, "a block (INSERT)", "explode the block in the CAD program"));
            }
            // Words, points, dimensions, hatches.
            _ => {}
        }
    }
    curves.retain(|c| c.points.len() > 1);
    Ok(curves)
}

pub(super) fn arc(line: usize, centre: Point, radius: f64, from: f64, turn: f64) -> DrawnCurve {
    let steps = (turn.abs() / STEP_RAD).ceil().clamp(1.0, 4000.0);
    let at = |i: usize| {
        let (s, c) = (from + turn * i as f64 / steps).sin_cos();
        centre + radius * Point::new(c, s)
    };
    DrawnCurve { line, points: (0..=steps as usize).map(at).collect(), centre: Some(centre) }
}

/// Arcs and lines between vertices; lines in a row are one curve.
fn bulged(curves: &mut Vec<DrawnCurve>, line: usize, list: &[(Point, f64)], closed: bool) {
    let mut straight: Vec<Point> = Vec::new();
    let count = if closed { list.len() } else { list.len().saturating_sub(1) };
    for i in 0..count {
        let ((a, bulge), (b, _)) = (list[i], list[(i + 1) % list.len()]);
        if bulge == 0.0 || a == b {
            if straight.is_empty() {
                straight.push(a);
            }
            straight.push(b);
            continue;
        }
        if straight.len() > 1 {
            curves.push(DrawnCurve { line, points: std::mem::take(&mut straight), centre: None });
        }
        straight.clear();
        let turn = 4.0 * bulge.atan();
        let (way, half) = (b - a, 0.5 * turn);
        let centre = 0.5 * (a + b) + 0.5 * half.tan().recip() * Point::new(-way.y, way.x);
        let out = a - centre;
        curves.push(arc(line, centre, out.norm(), out.y.atan2(out.x), turn));
    }
    if straight.len() > 1 {
        curves.push(DrawnCurve { line, points: straight, centre: None });
    }
}

/// Points on a spline: its fit points where it has them and no control points, else de Boor's points.
fn spline(e: &[GroupCode], scale: f64) -> Result<Vec<Point>, NoImport> {
    let pairs = |x: i32, y: i32| -> Result<Vec<Point>, NoImport> {
        Ok(all(e, x)?.into_iter().zip(all(e, y)?).map(|(x, y)| scale * Point::new(x, y)).collect())
    };
    let (control, fit) = (pairs(10, 20)?, pairs(11, 21)?);
    if control.is_empty() {
        return Ok(fit);
    }
    let (degree, knots) = (one(e, 71)?.unwrap_or(3.0) as usize, all(e, 40)?);
    let mut weights = all(e, 41)?;
    weights.resize(control.len(), 1.0);
    if !(1..=9).contains(&degree) || control.len() <= degree || knots.len() != control.len() + degree + 1 {
        let found = format!("a spline of degree {degree}, {} points, {} knots", control.len(), knots.len());
        return Err(NoImport::new(e[0].line, found, "convert it into a polyline in the CAD program"));
    }
    let mut out = Vec::new();
    for span in degree..control.len() {
        if knots[span + 1] <= knots[span] {
            continue;
        }
        let last = usize::from(span + 1 == control.len());
        for i in 0..PER_SPAN + last {
            let t = knots[span] + (knots[span + 1] - knots[span]) * i as f64 / PER_SPAN as f64;
            let mut d: Vec<(Point, f64)> =
                (span - degree..=span).map(|j| (weights[j] * control[j], weights[j])).collect();
            for r in 1..=degree {
                for j in (r..=degree).rev() {
                    let k = j + span - degree;
                    let share = (t - knots[k]) / (knots[k + 1 + degree - r] - knots[k]);
                    d[j] = (
                        (1.0 - share) * d[j - 1].0 + share * d[j].0,
                        (1.0 - share) * d[j - 1].1 + share * d[j].1,
                    );
                }
            }
            out.push(d[degree].0 / d[degree].1);
        }
    }
    Ok(out)
}

/// One closed line from all curves.
pub(super) fn chained(mut left: Vec<DrawnCurve>, remarks: Vec<String>) -> Result<Drawn, NoImport> {
    let mut points_m: Vec<Point> = Vec::new();
    let mut kinks = Vec::new();
    let mut current = left.remove(0);
    let (first, first_line) = (current.points[0], current.line);
    let opening = (current.points.clone(), current.centre, current.line);
    loop {
        let n = current.points.len();
        let (end, before) = (current.points[n - 1], current.points[n - 2]);
        points_m.extend(&current.points[..n - 1]);
        let kink = |next: &[Point], centre: Option<Point>, line: usize| {
            (current.centre.is_some() && centre.is_some()).then(|| {
                // Chords of equal angle leave their tangents by half of it on either side.
                let (a, b) = (end - before, next[1] - next[0]);
                let bend = |c: Option<Point>, p: Point, q: Point| {
                    c.map_or(0.0, |c| 0.5 * (p - c).perp(&(q - c)).atan2((p - c).dot(&(q - c))))
                };
                let own = bend(current.centre, before, end) + bend(centre, next[0], next[1]);
                (end, a.perp(&b).atan2(a.dot(&b)) - own, line)
            })
        };
        let distance = |c: &DrawnCurve| {
            let ends = [c.points[0], c.points[c.points.len() - 1]];
            (ends[0] - end).norm().min((ends[1] - end).norm())
        };
        let nearest = (0..left.len()).min_by(|a, b| distance(&left[*a]).total_cmp(&distance(&left[*b])));
        let home = (first - end).norm();
        match nearest {
            Some(i) if distance(&left[i]) <= JOINED_M && distance(&left[i]) < home.max(f64::MIN_POSITIVE) => {
                let mut next = left.swap_remove(i);
                if (next.points[0] - end).norm() > JOINED_M {
                    next.points.reverse();
                }
                kinks.extend(kink(&next.points, next.centre, next.line));
                current = next;
            }
            _ if home <= JOINED_M => {
                kinks.extend(kink(&opening.0, opening.1, opening.2));
                if let Some(other) = left.first() {
                    return Err(NoImport::new(
                        other.line,
                        format!("a second outline, {} more curves", left.len()),
                        "leave one sprag in the drawing, or put it on a layer of its own and name that with `layer`",
                    ));
                }
                // Points of a polygon are checked as points are.
                points::closed_joined(&mut points_m)?;
                return Ok(Drawn { points_m, kinks, remarks });
            }
            _ => {
                let gap = nearest.map_or(home, |i| distance(&left[i]).min(home));
                return Err(NoImport::new(
                    current.line,
                    format!(
                        "an open outline: at x = {:.4}, y = {:.4} mm nothing goes on within 0.01 mm, the nearest end is {:.4} mm \
                         away (the outline begins in line {first_line})",
                        1e3 * end.x,
                        1e3 * end.y,
                        1e3 * gap
                    ),
                    "close the outline: inner arcs, flank, outer arc, flank, end to end",
                ));
            }
        }
    }
}
