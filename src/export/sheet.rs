//! A drawing of a part as lines, arcs and words on named layers, before it is DXF or SVG. Lengths in m.

use super::{DrawnClutch, Part};
use crate::profile::{Profile, Segment};
use nalgebra::Vector2;

named! {
    /// Layers: what lies on them, and how it is drawn.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub(super) enum Layer {
        /// Closed outlines of sprags.
        Sprag = "SPRAG",
        /// Circles of the races.
        Races = "RACES",
        /// Centres of arcs, contacts at first contact, the centroid and the pivot of a driven cage: a cross and a point.
        Centres = "CENTRES",
        /// Radii from centres to the ends of their arcs; axes.
        CentreLines = "CENTRE_LINES",
        /// Short strokes across the outline where one arc ends and the next begins.
        ArcEnds = "ARC_ENDS",
        /// Words.
        Text = "TEXT",
    }
    /// Name in the file.
    pub fn name;
}

impl Layer {
    /// Whether its lines are dash-dotted.
    pub fn is_dashed(self) -> bool {
        self == Self::CentreLines
    }
}

/// One thing drawn.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Entity {
    Closed(Vec<Segment>),
    Circle {
        centre_m: Vector2<f64>,
        radius_m: f64,
    },
    Line {
        from_m: Vector2<f64>,
        to_m: Vector2<f64>,
    },
    /// What a CAD program snaps to.
    Point(Vector2<f64>),
    Text {
        at_m: Vector2<f64>,
        height_m: f64,
        text: String,
    },
}

/// The drawing.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Sheet {
    pub title: String,
    pub entities: Vec<(Layer, Entity)>,
    /// Lower left and upper right corner, m.
    pub extent_m: [Vector2<f64>; 2],
    /// Height of letters, m.
    pub letter_m: f64,
}

/// Which way it locks, for every drawing.
const ENGAGES: &str = "ENGAGES: INNER RACE COUNTERCLOCKWISE AGAINST THE OUTER RACE, SEEN SO";
/// Letters over the size of what is drawn: a choice.
const LETTER: f64 = 0.026;
/// Half a cross over the height of letters.
const CROSS: f64 = 0.35;
/// Lines of text apart, over the height of letters.
const LINE: f64 = 1.7;

/// Columns of a table apart, over the height of letters.
const COLUMN: f64 = 9.0;

impl Sheet {
    pub fn new(part: Part, subject: &DrawnClutch) -> Self {
        let title = format!("{} ({})", subject.name, part.name());
        let zero = Vector2::zeros();
        let mut sheet = Self { title, entities: Vec::new(), extent_m: [zero, zero], letter_m: 0.0 };
        match part {
            Part::Sprag => sheet.sprag(subject),
            Part::Inner | Part::Outer | Part::Clutch => sheet.races(part, subject),
        }
        sheet
    }

    fn put(&mut self, layer: Layer, entity: Entity) {
        self.entities.push((layer, entity));
    }

    fn line(&mut self, layer: Layer, from_m: Vector2<f64>, to_m: Vector2<f64>) {
        self.put(layer, Entity::Line { from_m, to_m });
    }

    fn cross(&mut self, at: Vector2<f64>, half: f64) {
        for way in [Vector2::new(half, 0.0), Vector2::new(0.0, half)] {
            self.line(Layer::Centres, at - way, at + way);
        }
        self.put(Layer::Centres, Entity::Point(at));
    }

    fn text(&mut self, at_m: Vector2<f64>, text: impl Into<String>) {
        let height_m = self.letter_m;
        self.put(Layer::Text, Entity::Text { at_m, height_m, text: text.into() });
    }

    /// Lines of text below the drawing, columns apart by tabs; the extent grows with them.
    fn notes(&mut self, lines: &[String]) {
        let [low, high] = self.extent_m;
        let pitch = LINE * self.letter_m;
        let widest = lines.iter().map(|l| l.chars().count()).max().unwrap_or(0);
        for (i, line) in lines.iter().enumerate() {
            for (column, word) in line.split('\t').enumerate().filter(|(_, word)| !word.is_empty()) {
                let x = low.x + column as f64 * COLUMN * self.letter_m;
                self.text(Vector2::new(x, low.y - (2.0 + i as f64) * pitch), word);
            }
        }
        // Letters of the usual fonts are 0.6 to 1 of their height wide.
        let right = high.x.max(low.x + 0.9 * self.letter_m * widest as f64);
        self.extent_m =
            [Vector2::new(low.x, low.y - (2.5 + lines.len() as f64) * pitch), Vector2::new(right, high.y)];
    }

    fn sprag(&mut self, subject: &DrawnClutch) {
        let (profile, segments) = (subject.profile, subject.sprag());
        self.put(Layer::Sprag, Entity::Closed(segments.to_vec()));
        let points: Vec<[f64; 2]> = segments.iter().flat_map(|s| s.points_m(1e-5)).collect();
        self.extent_m = extent(&points);
        let size = (self.extent_m[1] - self.extent_m[0]).amax();
        self.letter_m = LETTER * size;

        let mut rows = vec!["ARC\tCENTRE X\tCENTRE Y\tRADIUS\tFROM, DEG\tTO, DEG".to_owned()];
        let (mut inner, mut labels) = (0, Vec::new());
        for segment in segments {
            let Segment::Arc { centre_m, radius_m, from_azimuth_rad, sweep_rad } = *segment else { continue };
            let is_outer = inner == profile.arcs.len();
            inner += 1;
            let name = if is_outer { "CE".to_owned() } else { format!("C{inner}") };
            let (from, turn) = super::part::angles_rad(from_azimuth_rad, sweep_rad);
            rows.push(format!(
                "{}\t{:.5}\t{:.5}\t{:.5}\t{:.4}\t{:.4}",
                if is_outer { "OUTER CE".to_owned() } else { format!("INNER {name}") },
                1e3 * centre_m.x,
                1e3 * centre_m.y,
                1e3 * radius_m,
                from.to_degrees(),
                (from + turn).to_degrees()
            ));
            self.cross(centre_m, CROSS * self.letter_m);
            for end in [segment.start_m(), segment.end_m()] {
                self.line(Layer::CentreLines, centre_m, end);
                let across = (end - centre_m).normalize() * 0.6 * self.letter_m;
                self.line(Layer::ArcEnds, end - across, end + across);
            }
            let label = if is_outer { "CE".to_owned() } else { name };
            // Of a spiral's arcs the first and the last: their centres lie in a row.
            let arcs = profile.arcs.len();
            let of_spiral = subject.clutch.sprags.spiral.map_or(0, |s| s.arc_count());
            if is_outer || inner == arcs || inner <= (arcs + 1).saturating_sub(of_spiral) {
                labels.push((centre_m, format!("{label}  R {:.4}", 1e3 * radius_m)));
            }
        }
        if let Some((spiral, pole)) = subject.clutch.sprags.spiral.and_then(|s| Some((s, s.pole_m(profile)?)))
        {
            let off = spiral.deviation();
            rows.push(format!(
                "SPIRAL FROM TURN {:.4} TO {:.4} DEG: RADIUS OF CURVATURE {:.5} EXP({:.6} TURN/RAD){}, POLE {:.5}, {:.5}",
                spiral.from_rad.to_degrees(),
                spiral.until_rad.to_degrees(),
                1e3 * (spiral.start_radius_m + spiral.inset_m),
                spiral.rise,
                if spiral.inset_m > 0.0 { format!(" - {:.5}", 1e3 * spiral.inset_m) } else { String::new() },
                hundredth_um(pole.x),
                hundredth_um(pole.y)
            ));
            rows.push(format!(
                "{} ARCS STAND FOR IT, BESIDE IT BY AT MOST {:.6} UM",
                spiral.arc_count(),
                1e6 * off.position_m
            ));
            self.cross(pole, CROSS * self.letter_m);
            labels.push((pole, "POLE OF THE SPIRAL".to_owned()));
        }
        for (name, at) in contacts(profile) {
            self.cross(at, CROSS * self.letter_m);
            labels.push((at, name.to_owned()));
        }
        if let Some(outline) = subject.outline {
            let s = &subject.clutch.sprags;
            let density = subject.clutch.materials.sprag.density_kg_m3;
            let weighed = outline.mass_properties(s.length_m, density);
            let g = Vector2::from(weighed.centroid_m);
            self.cross(g, CROSS * self.letter_m);
            labels.push((g, "G".to_owned()));
            rows.push(format!(
                "AREA {:.4} MM2, LENGTH {:.3} MM, MASS {:.4} G, CENTROID G {:.4}, {:.4}",
                1e6 * weighed.area_m2,
                1e3 * s.length_m,
                1e3 * weighed.mass_kg,
                1e3 * g.x,
                1e3 * g.y
            ));
        }
        if let Some(cage) = &subject.clutch.cage {
            let pivot = Vector2::from(cage.pivot_m);
            self.cross(pivot, CROSS * self.letter_m);
            labels.push((pivot, "P".to_owned()));
            rows.push(format!("PIVOT P OF THE CAGE {:.4}, {:.4}", 1e3 * pivot.x, 1e3 * pivot.y));
        }
        self.labels(labels);
        rows.push(
            "ORIGIN CE, Y OUTWARD ALONG O-CE AT FIRST CONTACT; A, B: FIRST CONTACTS; ANGLES FROM +X"
                .to_owned(),
        );
        self.close(subject, rows);
    }

    /// Labels in a column to the right, each with a line to its point: centres lie within hundredths of a millimetre.
    fn labels(&mut self, mut labels: Vec<(Vector2<f64>, String)>) {
        labels.sort_by(|a, b| b.0.y.total_cmp(&a.0.y));
        let [low, high] = self.extent_m;
        let pitch = LINE * self.letter_m;
        let x = high.x + 2.0 * pitch;
        let mut free = high.y;
        let last = labels.len();
        for (i, (at, text)) in labels.into_iter().enumerate() {
            // Level with its point where nothing stands there and there is room for the rest below.
            let lowest = low.y + (last - 1 - i) as f64 * pitch;
            let y = at.y.min(free).max(lowest.min(free));
            free = y - pitch;
            self.line(Layer::Text, at, Vector2::new(x - 0.4 * self.letter_m, y));
            self.text(Vector2::new(x, y - 0.5 * self.letter_m), text);
        }
        self.extent_m[1].x = x + 14.0 * self.letter_m;
    }

    fn races(&mut self, part: Part, subject: &DrawnClutch) {
        let ((bore, inner), (outer, outside)) = (subject.inner_radii_m(), subject.outer_radii_m());
        let widest = if part == Part::Inner { inner } else { outside };
        self.letter_m = LETTER * widest;
        let reach = 1.08 * widest;
        self.extent_m = [Vector2::new(-reach, -reach), Vector2::new(reach, reach)];
        let mut radii = Vec::new();
        if part != Part::Outer {
            radii.extend(bore.map(|r| ("INNER BORE", r)));
            radii.push(("INNER TRACK", inner));
        }
        if part != Part::Inner {
            radii.extend([("OUTER TRACK", outer), ("OUTER OUTSIDE", outside)]);
        }
        for (_, radius_m) in &radii {
            self.put(Layer::Races, Entity::Circle { centre_m: Vector2::zeros(), radius_m: *radius_m });
        }
        for way in [Vector2::new(reach, 0.0), Vector2::new(0.0, reach)] {
            self.line(Layer::CentreLines, -way, way);
        }
        let mut rows: Vec<String> =
            radii.iter().map(|(name, r)| format!("{name}\t\tDIAMETER {:.4}", 2e3 * r)).collect();
        if part == Part::Clutch {
            for azimuth in subject.azimuths_rad() {
                self.put(Layer::Sprag, Entity::Closed(subject.sprag_at(azimuth)));
                self.cross(subject.centre_m(azimuth), CROSS * self.letter_m);
            }
            let radius_m = subject.profile.outer_centre_distance_m;
            self.put(Layer::CentreLines, Entity::Circle { centre_m: Vector2::zeros(), radius_m });
            let s = &subject.clutch.sprags;
            rows.push(format!(
                "{} SPRAGS, {:.3} LONG, CENTRES CE ON DIAMETER {:.4}",
                s.count,
                1e3 * s.length_m,
                2e3 * radius_m
            ));
        }
        rows.push(format!("RACES {:.3} WIDE", 1e3 * subject.clutch.races.width_m));
        self.close(subject, rows);
    }

    /// What every drawing says below its rows.
    fn close(&mut self, subject: &DrawnClutch, mut rows: Vec<String>) {
        rows.push(ENGAGES.to_owned());
        rows.push("ALL DIMENSIONS IN MM, AT FIRST CONTACT WITHOUT LOAD, AS MADE".to_owned());
        let hash = subject.hash.get(..12).unwrap_or(subject.hash);
        let version = env!("CARGO_PKG_VERSION");
        rows.push(format!("{}; DESIGN {hash}; {} {version}", subject.name, env!("CARGO_PKG_NAME")));
        self.notes(&rows);
    }
}

/// A and B at first contact, body frame, m.
fn contacts(profile: &Profile) -> Vec<(&'static str, Vector2<f64>)> {
    let inner = profile.arcs.first().map(|a| ("A", a.centre_m + a.radius_m * profile.contact_direction(0.0)));
    inner.into_iter().chain([("B", Vector2::new(0.0, profile.outer_radius_m))]).collect()
}

/// m in mm, to 0.01 um; of a zero without its sign.
fn hundredth_um(m: f64) -> f64 {
    (1e8 * m).round() / 1e5 + 0.0
}

fn extent(points: &[[f64; 2]]) -> [Vector2<f64>; 2] {
    let by = |start: f64, pick: fn(f64, f64) -> f64| {
        let axis = |k: usize| points.iter().map(|p| p[k]).fold(start, pick);
        Vector2::new(axis(0), axis(1))
    };
    [by(f64::INFINITY, f64::min), by(f64::NEG_INFINITY, f64::max)]
}
