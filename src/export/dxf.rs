//! A drawing as DXF, release 12, in mm: what every CAD program reads. Outlines are closed polylines whose bulges are exact
//! arcs. Written by hand, because no crate's release 12 is taken by AutoCAD LT and by strict readers.

use super::sheet::{Entity, Layer, Sheet};
use super::{DrawnClutch, Part};
use crate::profile::Segment;
use nalgebra::Vector2;
use std::fmt::Write;

/// The drawing of a part.
pub fn dxf(part: Part, subject: &DrawnClutch) -> String {
    let mut out = Groups(String::new());
    let sheet = Sheet::new(part, subject);
    out.group(999, &ascii(&subject.mark()));
    out.head(&sheet);
    out.tables(&sheet);
    out.section("BLOCKS");
    out.group(0, "ENDSEC");
    out.section("ENTITIES");
    for (layer, entity) in &sheet.entities {
        out.entity(*layer, entity);
    }
    out.group(0, "ENDSEC");
    out.group(0, "EOF");
    out.0
}

/// Text as release 12 takes it: letters beyond ASCII by number, % as a code, since %% begins one.
fn ascii(text: &str) -> String {
    let one = |c: char| match c {
        '%' => "%%037".to_owned(),
        ' '..='~' => c.to_string(),
        c => format!("\\U+{:04X}", u32::from(c)),
    };
    text.chars().map(one).collect()
}

struct Groups(String);

impl Groups {
    fn group(&mut self, code: i32, value: &str) {
        let _ = write!(self.0, "{code:>3}\n{value}\n");
    }

    fn number(&mut self, code: i32, value: f64) {
        self.group(code, &format!("{value:.12}"));
    }

    fn whole(&mut self, code: i32, value: i32) {
        self.group(code, &format!("{value:>6}"));
    }

    /// A point in mm, groups `code`, `code` + 10, `code` + 20.
    fn point(&mut self, code: i32, at_m: Vector2<f64>) {
        self.number(code, 1e3 * at_m.x);
        self.number(code + 10, 1e3 * at_m.y);
        self.number(code + 20, 0.0);
    }

    fn section(&mut self, name: &str) {
        self.group(0, "SECTION");
        self.group(2, name);
    }

    fn head(&mut self, sheet: &Sheet) {
        self.section("HEADER");
        self.group(9, "$ACADVER");
        self.group(1, "AC1009");
        // Millimetres: release 12 has no word for it, but its readers take that of later ones.
        self.group(9, "$INSUNITS");
        self.whole(70, 4);
        self.group(9, "$MEASUREMENT");
        self.whole(70, 1);
        for (name, at) in [("$EXTMIN", sheet.extent_m[0]), ("$EXTMAX", sheet.extent_m[1])] {
            self.group(9, name);
            self.point(10, at);
        }
        for (name, at) in [("$LIMMIN", sheet.extent_m[0]), ("$LIMMAX", sheet.extent_m[1])] {
            self.group(9, name);
            self.number(10, 1e3 * at.x);
            self.number(20, 1e3 * at.y);
        }
        self.group(0, "ENDSEC");
    }

    fn table(&mut self, name: &str, entries: i32) {
        self.group(0, "TABLE");
        self.group(2, name);
        self.whole(70, entries);
    }

    fn tables(&mut self, sheet: &Sheet) {
        self.section("TABLES");
        self.table("LTYPE", 2);
        // Long dash, gap, short dash, gap, in letters' heights.
        let dash = 1e3 * sheet.letter_m;
        for (name, words, pattern) in [
            ("CONTINUOUS", "Solid line", vec![]),
            ("CENTER", "Center ____ _ ____ _ ____", vec![3.0 * dash, -0.6 * dash, 0.6 * dash, -0.6 * dash]),
        ] {
            self.group(0, "LTYPE");
            self.group(2, name);
            self.whole(70, 0);
            self.group(3, words);
            self.whole(72, 65);
            self.whole(73, pattern.len() as i32);
            self.number(40, pattern.iter().map(|d: &f64| d.abs()).sum());
            for d in pattern {
                self.number(49, d);
            }
        }
        self.group(0, "ENDTAB");
        self.table("LAYER", 1 + Layer::ALL.len() as i32);
        let named =
            Layer::ALL.map(|l| (l.name(), colour(l), if l.is_dashed() { "CENTER" } else { "CONTINUOUS" }));
        for (name, colour, line) in [("0", 7, "CONTINUOUS")].into_iter().chain(named) {
            self.group(0, "LAYER");
            self.group(2, name);
            self.whole(70, 0);
            self.whole(62, colour);
            self.group(6, line);
        }
        self.group(0, "ENDTAB");
        self.table("STYLE", 1);
        self.group(0, "STYLE");
        self.group(2, "STANDARD");
        self.whole(70, 0);
        for (code, value) in [(40, 0.0), (41, 1.0), (50, 0.0)] {
            self.number(code, value);
        }
        self.whole(71, 0);
        self.number(42, 1e3 * sheet.letter_m);
        self.group(3, "txt");
        self.group(4, "");
        self.group(0, "ENDTAB");
        self.group(0, "ENDSEC");
    }

    fn entity(&mut self, layer: Layer, entity: &Entity) {
        match entity {
            Entity::Closed(segments) => self.closed(layer, segments),
            Entity::Circle { centre_m, radius_m } => {
                self.begin("CIRCLE", layer);
                self.point(10, *centre_m);
                self.number(40, 1e3 * radius_m);
            }
            Entity::Line { from_m, to_m } => {
                self.begin("LINE", layer);
                self.point(10, *from_m);
                self.point(11, *to_m);
            }
            Entity::Point(at_m) => {
                self.begin("POINT", layer);
                self.point(10, *at_m);
            }
            Entity::Text { at_m, height_m, text } => {
                self.begin("TEXT", layer);
                self.point(10, *at_m);
                self.number(40, 1e3 * height_m);
                self.group(1, &ascii(text));
            }
        }
    }

    fn begin(&mut self, name: &str, layer: Layer) {
        self.group(0, name);
        self.group(8, layer.name());
    }

    /// A bulge is the tangent of a quarter of the angle to the next vertex, positive counterclockwise.
    fn closed(&mut self, layer: Layer, segments: &[Segment]) {
        self.begin("POLYLINE", layer);
        self.whole(66, 1);
        self.point(10, Vector2::zeros());
        self.whole(70, 1);
        for segment in segments {
            self.begin("VERTEX", layer);
            self.point(10, segment.start_m());
            let bulge = match segment {
                Segment::Arc { sweep_rad, .. } => (-sweep_rad / 4.0).tan(),
                Segment::Line { .. } => 0.0,
            };
            self.group(42, &format!("{bulge:.15}"));
        }
        self.begin("SEQEND", layer);
    }
}

/// AutoCAD's colour numbers: 7 is black on white paper.
fn colour(layer: Layer) -> i32 {
    match layer {
        Layer::Sprag | Layer::Races | Layer::Text => 7,
        Layer::Centres => 1,
        Layer::CentreLines => 5,
        Layer::ArcEnds => 6,
    }
}
