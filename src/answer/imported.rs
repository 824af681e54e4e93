//! What an import answers: the arcs found, how far the points lie from them, and what the reader should know.

use super::left_out::LeftOut;
use super::{Envelope, VERSION, WRITTEN_BY};
use crate::design::Design;
use crate::file::{EditError, shown, value_at, with_keys, with_spiral, with_sprag};
use crate::import::{Arc, Arcs, Drawn, FittedSpiral, FittedSprag, STANDARD_ERROR, SpiralKind};
use crate::numeric::rounded;
use crate::report::{Rows, Screen, Table, Unit};
use serde::Serialize;
use serde_json::json;
use std::fmt::Write;

/// A radius less well known than this is said to be so, m.
const UNSURE_M: f64 = 2e-6;

/// What [`crate::import`] says, with the options of the command where it names what the caller sets.
pub fn in_options(text: &str) -> String {
    const OPTIONS: [(&str, &str); 6] = [
        ("(`tracks_m`)", "(--template, --inner-radius, --outer-radius)"),
        ("`tracks_m`", "--template, or --inner-radius and --outer-radius"),
        ("`layer`", "--layer"),
        ("`unit`", "--unit"),
        ("`swap`", "--swap"),
        ("`export`", "`export --format csv`"),
    ];
    OPTIONS.iter().fold(text.to_owned(), |text, (set, option)| text.replace(set, option))
}

/// A sprag found in a drawing or in points, on a template.
#[derive(Debug, Clone, Copy)]
pub struct Imported<'a> {
    /// What was read.
    pub drawn: &'a Drawn,
    /// The sprag in it.
    pub found: &'a FittedSprag,
    /// Name of the design file that gives all else.
    pub template: &'a str,
    /// Whether nobody named it.
    pub no_template: bool,
    /// Deviation asked for, m.
    pub deviation_m: Option<f64>,
    /// The spiral that stands in the new design in place of the arcs.
    pub written: Option<FittedSpiral>,
}

/// Name of an arc, its side, and itself.
pub type ArcRow<'a> = (String, &'a Arcs, &'a Arc);

/// A side of the sprag: its arcs, and how far the points lie from them.
#[derive(Debug, Clone, Serialize)]
pub struct SideBody<'a> {
    /// Each arc.
    pub arcs: Rows<ArcRow<'a>>,
    /// Distance of the farthest point, um.
    pub max_um: f64,
    /// Root mean square of the distances, um.
    pub rms_um: f64,
}

/// An inner arc as a design file has it.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct InnerArcBody {
    /// Radius, mm.
    pub radius_mm: f64,
    /// Turn of the contact up to which it reaches, rad.
    pub until_rad: f64,
}

/// Flanks as a design file has them.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct FoundFlanks {
    /// Distance of the front one, mm.
    pub front_mm: f64,
    /// Tilt of the front one, rad.
    pub front_tilt_rad: f64,
    /// Distance of the rear one, mm.
    pub rear_mm: f64,
    /// Tilt of the rear one, rad.
    pub rear_tilt_rad: f64,
}

/// The sprag found, as `[sprags]` of a design file has it.
#[derive(Debug, Clone, Serialize)]
pub struct FoundSprag {
    /// Distance of the centres of the outer and the first inner arc, mm.
    pub centre_distance_mm: f64,
    /// The flanks.
    pub flanks: FoundFlanks,
    /// The inner arcs from first contact on.
    pub inner_arcs: Vec<InnerArcBody>,
    /// Radius of the outer arc, mm.
    pub outer_radius_mm: f64,
}

/// Keys of `import`.
#[derive(Debug, Clone, Serialize)]
pub struct ImportedBody<'a> {
    /// The inner side.
    pub inner: SideBody<'a>,
    /// The outer side.
    pub outer: SideBody<'a>,
    /// What the reader of the numbers should know.
    pub said: Vec<String>,
    /// Spirals through the inner side.
    pub spirals: Rows<&'a FittedSpiral>,
    /// The sprag found.
    pub sprags: FoundSprag,
    /// The design file that gives all else; where nobody named one, that of which races, count, spring, friction and steel are guessed.
    pub template: &'a str,
    /// Where the new design is.
    pub written: Option<&'a str>,
    /// The spiral that stands in the new design in place of the arcs.
    pub written_spiral: Option<&'static str>,
}

impl<'a> SideBody<'a> {
    fn of(side: &Arcs, arcs: Rows<ArcRow<'a>>) -> Self {
        let um = |m: f64| Unit::Micrometre.from_si(felt(m));
        Self { max_um: um(side.max_m), rms_um: um(side.rms_m), arcs }
    }
}

impl FoundSprag {
    fn of(found: &FittedSprag) -> Self {
        let flanks = &found.flanks;
        let arc = |&(radius_m, until_rad): &(f64, f64)| InnerArcBody { radius_mm: 1e3 * radius_m, until_rad };
        Self {
            outer_radius_mm: 1e3 * found.outer_radius_m,
            centre_distance_mm: 1e3 * found.centre_distance_m,
            inner_arcs: found.inner_arcs.iter().map(arc).collect(),
            flanks: FoundFlanks {
                rear_mm: 1e3 * flanks.rear_m,
                front_mm: 1e3 * flanks.front_m,
                rear_tilt_rad: flanks.rear_tilt_rad,
                front_tilt_rad: flanks.front_tilt_rad,
            },
        }
    }
}

/// The design file `template` with the sprag that was found, as tangent arcs or as `spiral`, between races of `radii_m`, inner
/// and outer, where these are given.
///
/// # Errors
/// [`EditError`] where the template cannot take it.
pub fn design_text(
    template: &Design,
    found: &FittedSprag,
    spiral: Option<&FittedSpiral>,
    radii_m: [Option<f64>; 2],
) -> Result<String, EditError> {
    let flanks = spiral.map_or(&found.flanks, |s| &s.flanks);
    let (outer_m, distance_m) = (found.outer_radius_m, found.centre_distance_m);
    let mut text = with_sprag(&template.source, outer_m, distance_m, &found.inner_arcs, flanks)?;
    if let Some(s) = spiral {
        let rises = (s.kind == SpiralKind::Logarithmic).then_some((s.start_radius_m, s.rise));
        text = with_spiral(&text, s.strut_rad, s.until_rad, rises)?;
    }
    let keys = ["races.inner_radius_mm", "races.outer_radius_mm"].into_iter().zip(radii_m);
    let given = keys.filter_map(|(key, m)| Some((key, rounded(Unit::Millimetre.from_si(m?), 12))));
    with_keys(&text, &given.collect::<Vec<_>>())
}

/// The design file `template` with a count and rims of the races in proportion to tracks of `radii_m`, inner and outer, where these are
/// given and others.
///
/// # Errors
/// [`EditError`].
pub fn in_proportion(template: &str, radii_m: [Option<f64>; 2]) -> Result<String, EditError> {
    let at = |key: &str| value_at(template, key).unwrap_or(0.0);
    let tracks = ["races.inner_radius_mm", "races.outer_radius_mm"].map(at);
    let [inner, outer] = [0, 1].map(|k| radii_m[k].map_or(1.0, |m| Unit::Millimetre.from_si(m) / tracks[k]));
    if [inner, outer] == [1.0; 2] {
        return Ok(template.to_owned());
    }
    let mean = (inner * tracks[0] + outer * tracks[1]) / (tracks[0] + tracks[1]);
    let rim = |key: &'static str, larger: f64| (key, rounded(at(key) * larger, 4));
    with_keys(
        template,
        &[
            ("sprags.count", (at("sprags.count") * mean).floor()),
            rim("races.inner_bore_radius_mm", inner),
            rim("races.outer_outside_radius_mm", outer),
        ],
    )
}

impl Imported<'_> {
    /// First lines of the new design file; `file`: what was read, `command`: who asked.
    pub fn head(&self, file: &str, command: &str) -> String {
        let (found, on) = (self.found, self.template);
        let (max_m, rms_m, what) = match &self.written {
            Some(s) => (s.max_m, s.rms_m, s.kind.name()),
            None => (found.inner.max_m, found.inner.rms_m, "inner arcs"),
        };
        let (with, rest) = match self.no_template {
            true => (String::new(), "What else stands here is a guess; limits are to be added"),
            false => (format!(" on the template {on:?}"), "Races, spring, limits are the template's"),
        };
        format!(
            "{WRITTEN_BY} import {VERSION} from {:?}{with}\n# by: {}\n# Farthest point {:.2} um from the {what}, {:.2} um \
             from the outer arc; rms {:.2} and {:.2} um. {rest}.\n#\n",
            file,
            command,
            1e6 * felt(max_m),
            1e6 * felt(found.outer.max_m),
            1e6 * felt(rms_m),
            1e6 * felt(found.outer.rms_m),
        )
    }

    /// What the reader of the numbers should know, a line each.
    pub fn remarks(&self) -> Vec<String> {
        let found = self.found;
        let mut lines = self.drawn.remarks.iter().map(|remark| in_options(remark)).collect::<Vec<_>>();
        if self.no_template {
            lines.push(format!(
                "no --template: races, count, spring, friction and steel are guesses, as {}, and nothing is limited: put in your own, and \
                 torques and limits (`explain limits`)",
                self.template
            ));
        }
        if found.mirrored {
            lines.push(
                "the drawing was turned over: it shows a clutch that locks the other way round".to_owned(),
            );
        }
        if found.behind > 0 {
            lines
                .push(format!("inner arcs that lie behind first contact and are left out: {}", found.behind));
        }
        let arcs = self.written.is_none();
        lines.extend(self.written.map(|s| {
            format!("written as the {} spiral, up to {:.4} rad of turn", s.kind.name(), s.until_rad)
        }));
        lines.extend(arcs.then(|| format!(
        "end of the profile, {:.4} rad: chosen, 2 % before the flanks cut it; set until_rad of the last arc to what is ground",
        found.inner_arcs.last().map_or(0.0, |a| a.1)
    )));
        let off = found.inner.max_m;
        if let Some(asked) = self.deviation_m.filter(|asked| off > *asked) {
            lines.push(format!(
            "the deviation asked for, {:.3} um, is not reached with {} arcs: the farthest point is {:.3} um off",
            1e6 * asked,
            found.inner.arcs.len(),
            1e6 * off
        ));
        }
        let sides = [("inner arc", &found.inner), ("outer arc", &found.outer)];
        for (name, k, arcs) in sides.iter().flat_map(|(n, a)| (0..a.arcs.len()).map(move |k| (n, k, a))) {
            let arc = &arcs.arcs[k];
            if arc.radius_error_m > UNSURE_M {
                let points = (STANDARD_ERROR * arcs.rms_m / (UNSURE_M * arc.span_rad.powi(2))).powi(2);
                lines.push(format!(
                "{name} {}: the radius is known to {:.1} um (standard error) from {} points over {:.3} rad; 2 um need some {:.0e} \
                 points on it",
                k + 1,
                1e6 * arc.radius_error_m,
                arc.points,
                arc.span_rad,
                points.max(1.0)
            ));
            }
        }
        lines
    }

    /// The arcs found.
    pub fn csv_table(&self) -> Table {
        arcs(Some(&self.found.inner), Some(&self.found.outer)).table()
    }

    /// The answer with the keys that all answers share; `design`: the new one; `run_time_s`: what it took, s; `written`: where
    /// the new design is.
    pub fn envelope<'a>(
        &'a self,
        design: &'a Design,
        run_time_s: f64,
        written: Option<&'a str>,
    ) -> Envelope<'a, ImportedBody<'a>> {
        let found = self.found;
        Envelope {
            design,
            run_time_s,
            left_out: vec![LeftOut::new(
                "edges and chamfers",
                "points within some 2 deg of a corner, seen from the middle, are not fitted",
                "none on the working surfaces",
            )],
            error_estimate: Some(json!({
                "rms_um": worst(found, |a| a.rms_m),
                "max_um": worst(found, |a| a.max_m),
            })),
            body: ImportedBody {
                written,
                template: self.template,
                said: self.remarks(),
                inner: SideBody::of(&found.inner, arcs(Some(&found.inner), None)),
                outer: SideBody::of(&found.outer, arcs(None, Some(&found.outer))),
                spirals: spirals(found),
                written_spiral: self.written.map(|s| s.kind.name()),
                sprags: FoundSprag::of(found),
            },
        }
    }

    /// The answer on a terminal; `written`: where the new design is.
    pub fn text(&self, written: Option<&str>, screen: Screen) -> String {
        let on = self.template;
        let mut people = format!("{}\n", self.csv_table().to_text(screen));
        if !self.found.spirals.is_empty() {
            let _ = writeln!(
                people,
                "Spirals through the inner side from first contact on, as far as its points lie on them (--spiral writes one)\n{}",
                spirals(self.found).table().to_text(screen)
            );
        }
        for line in self.remarks() {
            let _ = writeln!(people, "{line}");
        }
        let [behind, template] = match self.no_template {
            true => [String::new(), String::new()],
            false => [format!(", on the template {on}"), format!("; template {on}")],
        };
        let _ = match written {
            Some(path) => writeln!(people, "written to {}{behind}", shown(path)),
            None => writeln!(people, "no design written: name a file with -o{template}"),
        };
        people
    }
}

/// Below this a distance is what rounding leaves, m: a thousandth of an atom's size is no error of a drawing.
const ROUNDING_M: f64 = 1e-13;

/// A distance without what rounding leaves, m.
fn felt(length_m: f64) -> f64 {
    if length_m < ROUNDING_M { 0.0 } else { length_m }
}

fn worst(found: &FittedSprag, of: fn(&Arcs) -> f64) -> f64 {
    1e6 * felt(of(&found.inner).max(of(&found.outer)))
}

/// Arcs of both sides in a line each.
fn arcs<'a>(inner: Option<&'a Arcs>, outer: Option<&'a Arcs>) -> Rows<ArcRow<'a>> {
    let inner = inner.into_iter().flat_map(|side| {
        side.arcs.iter().enumerate().map(move |(k, arc)| (format!("inner arc {}", k + 1), side, arc))
    });
    let outer = outer
        .into_iter()
        .flat_map(|side| side.arcs.iter().map(move |arc| ("outer arc".to_owned(), side, arc)));
    Rows::of(inner.chain(outer))
        .text("surface", "Surface", |(name, _, _)| name.clone())
        .number("radius_mm", "Radius", Unit::Millimetre, 7, |(_, _, arc)| arc.radius_m)
        .number("radius_standard_error_um", "Standard error", Unit::Micrometre, 3, |(_, _, arc)| {
            felt(arc.radius_error_m)
        })
        .number("span_rad", "Spans", Unit::Radian, 4, |(_, _, arc)| arc.span_rad)
        .number("points", "Points", Unit::One, 6, |(_, _, arc)| arc.points)
        .number("max_um", "Farthest", Unit::Micrometre, 4, |(_, side, _)| felt(side.max_m))
        .number("rms_um", "rms", Unit::Micrometre, 4, |(_, side, _)| felt(side.rms_m))
        .json("centre_mm", |(_, _, arc)| {
            [arc.centre_m.x, arc.centre_m.y].map(|m| Unit::Millimetre.from_si(m))
        })
}

/// The spirals in a line each.
fn spirals(found: &FittedSprag) -> Rows<&FittedSpiral> {
    Rows::of(&found.spirals)
        .text("curve", "Curve", |s| s.kind.name())
        .number("strut_angle_deg", "Strut angle", Unit::Degree, 5, |s| s.strut_rad)
        .number("start_radius_mm", "Radius at first contact", Unit::Millimetre, 6, |s| s.start_radius_m)
        .number("rise", "Rise", Unit::One, 4, |s| s.rise)
        .number("until_rad", "Until", Unit::Radian, 4, |s| s.until_rad)
        .number("points", "Points", Unit::One, 6, |s| s.points)
        .number("max_um", "Farthest", Unit::Micrometre, 4, |s| felt(s.max_m))
        .number("rms_um", "rms", Unit::Micrometre, 4, |s| felt(s.rms_m))
}
