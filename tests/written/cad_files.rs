//! Drawings, solids and tables, read back by readers of their own and held against the outline itself.

use crate::program::Folder;
use sprag_design::export::{DrawnClutch, Part, dxf::dxf, rows, step::step, svg::svg};
use sprag_design::profile::Segment;
use sprag_design::{Design, Outline, Profile};
use std::collections::BTreeMap;

/// A circular arc or a line, mm: first point, last point, and centre, radius, angle turned counterclockwise.
#[derive(Debug, Clone, Copy)]
struct Piece {
    ends: [[f64; 2]; 2],
    arc: Option<([f64; 2], f64, f64)>,
}

fn designs() -> Vec<Design> {
    let mut all: Vec<_> = std::fs::read_dir("designs").unwrap().map(|e| e.unwrap().path()).collect();
    all.retain(|p| p.extension().is_some_and(|e| e == "toml"));
    all.sort();
    all.iter().map(|p| Design::read(p).unwrap()).collect()
}

fn closed(design: &Design) -> (sprag_design::Clutch, Profile, Outline) {
    let made = design.as_made().unwrap();
    let profile = made.profile().unwrap();
    let outline = Outline::closed(&profile, &made.sprags.flanks.unwrap()).unwrap();
    (made, profile, outline)
}

/// `f` of the design's subject.
fn with<T>(design: &Design, f: impl Fn(&DrawnClutch) -> T) -> T {
    let (clutch, profile, outline) = closed(design);
    f(&DrawnClutch {
        name: &design.name,
        hash: &design.hash,
        clutch: &clutch,
        profile: &profile,
        outline: Some(&outline),
    })
}

fn apart(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// Area of closed pieces: polygon and segments of circle.
fn area(pieces: &[Piece]) -> f64 {
    pieces
        .iter()
        .map(|p| {
            let [a, b] = p.ends;
            let bow = p.arc.map_or(0.0, |(_, r, turn)| 0.5 * r * r * (turn - turn.sin()));
            0.5 * (a[0] * b[1] - b[0] * a[1]) + bow
        })
        .sum()
}

fn of_segment(segment: &Segment) -> Piece {
    let mm = |v: [f64; 2]| v.map(|x| 1e3 * x);
    let point = |v: nalgebra::Vector2<f64>| mm([v.x, v.y]);
    let arc = match *segment {
        Segment::Arc { centre_m, radius_m, sweep_rad, .. } => {
            Some((point(centre_m), 1e3 * radius_m, -sweep_rad))
        }
        Segment::Line { .. } => None,
    };
    Piece { ends: [point(segment.start_m()), point(segment.end_m())], arc }
}

fn alike(got: &[Piece], want: &[Piece], within_mm: f64) {
    assert_eq!(got.len(), want.len());
    for (g, w) in got.iter().zip(want) {
        for i in 0..2 {
            assert!(apart(g.ends[i], w.ends[i]) < within_mm, "{g:?} {w:?}");
        }
        assert_eq!(g.arc.is_some(), w.arc.is_some());
        if let (Some((gc, gr, gt)), Some((wc, wr, wt))) = (g.arc, w.arc) {
            assert!(apart(gc, wc) < within_mm && (gr - wr).abs() < within_mm, "{g:?} {w:?}");
            assert!((gt - wt).abs() < within_mm, "{gt} {wt}");
        }
    }
    for (i, g) in got.iter().enumerate() {
        assert!(apart(g.ends[1], got[(i + 1) % got.len()].ends[0]) < within_mm, "open after {i}");
    }
}

/// Turned counterclockwise by `angle` and shifted.
fn moved(p: &Piece, angle: f64, shift: [f64; 2]) -> Piece {
    let (s, c) = angle.sin_cos();
    let place = |[x, y]: [f64; 2]| [c * x - s * y + shift[0], s * x + c * y + shift[1]];
    Piece { ends: p.ends.map(place), arc: p.arc.map(|(m, r, t)| (place(m), r, t)) }
}

/// What a DXF holds: closed outlines with their layers, circles (centre, radius), texts.
struct Dxf {
    outlines: Vec<Vec<Piece>>,
    circles: Vec<([f64; 2], f64, String)>,
    header: BTreeMap<String, String>,
    texts: Vec<String>,
    points: Vec<[f64; 2]>,
}

fn read_dxf(text: &str) -> Dxf {
    assert!(text.is_ascii());
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len() % 2, 0);
    let groups: Vec<(i32, &str)> = lines.chunks(2).map(|g| (g[0].trim().parse().unwrap(), g[1])).collect();
    let mut out =
        Dxf { outlines: vec![], circles: vec![], header: BTreeMap::new(), texts: vec![], points: vec![] };
    for pair in groups.windows(2).filter(|p| p[0].0 == 9) {
        out.header.insert(pair[0].1.to_owned(), pair[1].1.trim().to_owned());
    }
    let start = groups.iter().position(|g| *g == (2, "ENTITIES")).unwrap();
    let mut vertices: Vec<([f64; 2], f64)> = Vec::new();
    for (i, (_, name)) in groups.iter().enumerate().skip(start).filter(|(_, g)| g.0 == 0) {
        let own = groups[i + 1..].iter().take_while(|g| g.0 != 0);
        let own: BTreeMap<i32, &str> = own.map(|g| (g.0, g.1)).collect();
        let number = |code: i32| own[&code].trim().parse::<f64>().unwrap();
        match *name {
            "POLYLINE" => assert_eq!((own[&8], number(70)), ("SPRAG", 1.0)),
            "VERTEX" => vertices.push(([number(10), number(20)], number(42))),
            "SEQEND" => {
                let n = vertices.len();
                let piece = |i: usize| {
                    let ((a, bulge), (b, _)) = (vertices[i], vertices[(i + 1) % n]);
                    let arc = (bulge != 0.0).then(|| {
                        let (turn, chord) = (4.0 * bulge.atan(), apart(a, b));
                        let radius = chord / (2.0 * (turn / 2.0).sin());
                        // The centre lies to the left of the way, as far as the half angle says.
                        let rise = radius * (turn / 2.0).cos() / chord;
                        let centre = [
                            0.5 * (a[0] + b[0]) - rise * (b[1] - a[1]),
                            0.5 * (a[1] + b[1]) + rise * (b[0] - a[0]),
                        ];
                        (centre, radius, turn)
                    });
                    Piece { ends: [a, b], arc }
                };
                out.outlines.push((0..n).map(piece).collect());
                vertices.clear();
            }
            "CIRCLE" => {
                out.circles.push(([number(10), number(20)], number(40), own[&8].to_owned()));
            }
            "TEXT" => out.texts.push(own[&1].to_owned()),
            "POINT" => {
                assert_eq!(own[&8], "CENTRES");
                out.points.push([number(10), number(20)]);
            }
            _ => {}
        }
    }
    assert_eq!(groups.last(), Some(&(0, "EOF")));
    out
}

#[test]
fn a_dxf_holds_the_arcs_of_the_outline() {
    let all = designs();
    assert!(all.len() > 5);
    for design in &all {
        let (clutch, profile, outline) = closed(design);
        let want: Vec<Piece> = outline.segments().iter().map(of_segment).collect();
        let one = read_dxf(&with(design, |s| dxf(Part::Sprag, s)));
        assert_eq!((one.header["$ACADVER"].as_str(), one.header["$INSUNITS"].as_str()), ("AC1009", "4"));
        assert_eq!(one.outlines.len(), 1);
        alike(&one.outlines[0], &want, 1e-9);
        let exact = 1e6 * outline.mass_properties(1.0, 1.0).area_m2;
        assert!((area(&one.outlines[0]) / exact - 1.0).abs() < 1e-10);

        let whole = read_dxf(&with(design, |s| dxf(Part::Clutch, s)));
        assert_eq!(whole.outlines.len(), clutch.sprags.count);
        let oc = 1e3 * profile.outer_centre_distance_m;
        for (i, got) in whole.outlines.iter().enumerate() {
            let angle = -std::f64::consts::TAU * i as f64 / clutch.sprags.count as f64;
            let shift = [-oc * angle.sin(), oc * angle.cos()];
            let want: Vec<Piece> = want.iter().map(|p| moved(p, angle, shift)).collect();
            alike(got, &want, 1e-9);
        }
        let r = &clutch.races;
        let radii = [r.inner_bore_radius_m, r.inner_radius_m, r.outer_radius_m, r.outer_outside_radius_m];
        let radii: Vec<f64> = radii.into_iter().filter(|r| *r > 0.0).map(|r| 1e3 * r).collect();
        let circles: Vec<_> = whole.circles.iter().filter(|c| c.2 == "RACES").collect();
        assert_eq!(circles.len(), radii.len());
        for (c, r) in circles.iter().zip(radii) {
            assert!(apart(c.0, [0.0; 2]) == 0.0 && (c.1 - r).abs() < 1e-9);
        }
        // Between its races, and touching both.
        let far = |p: [f64; 2]| p[0].hypot(p[1]);
        for point in with(design, |s| rows::points(Part::Clutch, s, 1e-7)) {
            if point.body.starts_with("sprag") {
                let at = far(point.at_m);
                assert!(at > r.inner_radius_m - 2e-7 && at < r.outer_radius_m + 2e-7, "{}", design.name);
            }
        }
    }
}

/// Centres of arcs, the centroid and the pivot of a cage are points to snap to.
#[test]
fn a_dxf_of_a_sprag_marks_its_centres_its_centroid_and_its_pivot() {
    for design in designs() {
        let (clutch, profile, outline) = closed(&design);
        let drawn = read_dxf(&with(&design, |s| dxf(Part::Sprag, s)));
        let marked = |at: [f64; 2]| drawn.points.iter().any(|p| apart(*p, at.map(|m| 1e3 * m)) < 1e-9);
        assert!(profile.arcs.iter().all(|arc| marked(arc.centre_m.into())), "{}", design.name);
        assert!(marked([0.0; 2]) && marked(outline.mass_properties(1.0, 1.0).centroid_m), "{}", design.name);
        assert_eq!(clutch.cage.is_some(), drawn.texts.iter().any(|text| text.starts_with("PIVOT P")));
        assert!(clutch.cage.is_none_or(|cage| marked(cage.pivot_m)), "{}", design.name);
    }
    let caged = designs().into_iter().filter(|design| design.clutch.cage.is_some()).count();
    assert!(caged > 0);
}

#[test]
fn a_similar_clutch_has_a_similar_drawing() {
    let design = Design::read("designs/starter.toml".as_ref()).unwrap();
    let mut table: toml::Table = toml::from_str(&design.source).unwrap();
    table.retain(|key, _| {
        ["schema", "name", "sprags", "races", "spring", "material", "friction"].contains(&key)
    });
    fn scale(value: &mut toml::Value, is_length: bool) {
        match value {
            toml::Value::Float(x) if is_length => *x *= 3.0,
            toml::Value::Integer(x) if is_length => *value = toml::Value::Float(3.0 * *x as f64),
            toml::Value::Array(all) => all.iter_mut().for_each(|v| scale(v, false)),
            toml::Value::Table(t) => t.iter_mut().for_each(|(k, v)| scale(v, k.ends_with("_mm"))),
            _ => {}
        }
    }
    for key in ["sprags", "races"] {
        scale(table.get_mut(key).unwrap(), false);
    }
    let large = Design::parse(&toml::to_string(&table).unwrap(), "large").unwrap();
    let [small, large] = [&design, &large].map(|d| read_dxf(&with(d, |s| dxf(Part::Clutch, s))));
    assert_eq!(small.outlines.len(), large.outlines.len());
    for (a, b) in small.outlines.iter().zip(&large.outlines) {
        let three = |p: &Piece| Piece {
            ends: p.ends.map(|e| e.map(|x| 3.0 * x)),
            arc: p.arc.map(|(c, r, t)| (c.map(|x| 3.0 * x), 3.0 * r, t)),
        };
        alike(b, &a.iter().map(three).collect::<Vec<_>>(), 1e-9);
    }
}

#[test]
fn an_svg_holds_the_same_arcs_in_millimetres() {
    for design in designs() {
        let text = with(&design, |s| svg(Part::Sprag, s));
        let (_, _, outline) = closed(&design);
        let attribute = |name: &str| {
            let rest = &text[text.find(&format!(" {name}=\"")).unwrap() + name.len() + 3..];
            rest[..rest.find('"').unwrap()].to_owned()
        };
        let frame: Vec<f64> = attribute("viewBox").split(' ').map(|v| v.parse().unwrap()).collect();
        assert_eq!(attribute("width"), format!("{:.4}mm", frame[2]));
        assert_eq!(attribute("height"), format!("{:.4}mm", frame[3]));
        let path = attribute("d");
        let mut at: Option<[f64; 2]> = None;
        let mut radii = Vec::new();
        let mut corners = Vec::new();
        for command in path
            .trim_end_matches('Z')
            .split_inclusive(|c: char| !"MLA".contains(c))
            .collect::<String>()
            .replace('M', "\nM")
            .replace('L', "\nL")
            .replace('A', "\nA")
            .lines()
            .filter(|l| !l.is_empty())
        {
            let numbers: Vec<f64> = command[1..].split(' ').map(|v| v.parse().unwrap()).collect();
            let to = [numbers[numbers.len() - 2], numbers[numbers.len() - 1]];
            if command.starts_with('A') {
                // Counterclockwise on the page, the short way.
                assert_eq!(numbers[2..5], [0.0, 0.0, 0.0]);
                radii.push(numbers[0]);
            }
            corners.push(to);
            at = Some(to);
        }
        assert!(at.is_some());
        let want: Vec<Piece> = outline.segments().iter().map(of_segment).collect();
        for (corner, piece) in corners.iter().zip(&want) {
            let start = piece.ends[0];
            assert!(apart([corner[0], -corner[1]], start) < 2e-9);
            // Inside of what is shown.
            assert!(corner[0] > frame[0] && corner[0] < frame[0] + frame[2]);
            assert!(corner[1] > frame[1] && corner[1] < frame[1] + frame[3]);
        }
        let exact: Vec<f64> = want.iter().filter_map(|p| p.arc.map(|a| a.1)).collect();
        assert_eq!(radii.len(), exact.len());
        assert!(radii.iter().zip(&exact).all(|(a, b)| (a - b).abs() < 1e-9));
    }
}

/// Entities of a STEP file: number, name, what stands in the brackets.
fn read_step(text: &str) -> BTreeMap<usize, String> {
    let data = text.split("DATA;\n").nth(1).unwrap().split("ENDSEC;").next().unwrap();
    data.lines()
        .map(|l| {
            let (id, entity) = l.trim_end_matches(';').split_once('=').unwrap();
            (id.trim_start_matches('#').parse().unwrap(), entity.to_owned())
        })
        .collect()
}

fn references(entity: &str) -> Vec<usize> {
    let outside: String = entity.split('\'').step_by(2).collect();
    let ends = |s: &str| s.find(|c: char| !c.is_ascii_digit()).unwrap_or(s.len());
    outside.split('#').skip(1).map(|s| s[..ends(s)].parse().unwrap()).collect()
}

#[test]
fn a_step_file_is_whole_and_every_edge_bounds_two_faces() {
    for design in designs() {
        let (clutch, _, outline) = closed(&design);
        for (part, solids) in [(Part::Sprag, 1), (Part::Inner, 1), (Part::Outer, 1), (Part::Clutch, 3)] {
            let text = with(&design, |s| step(part, s));
            let entities = read_step(&text);
            let mut used: BTreeMap<usize, Vec<bool>> = BTreeMap::new();
            for entity in entities.values() {
                for id in references(entity) {
                    assert!(entities.contains_key(&id), "{entity}: no #{id}");
                }
                if let Some(rest) = entity.strip_prefix("ORIENTED_EDGE('',*,*,#") {
                    let (edge, sense) = rest.split_once(',').unwrap();
                    used.entry(edge.parse().unwrap()).or_default().push(sense == ".T.)");
                }
            }
            let count = |name: &str| entities.values().filter(|e| e.starts_with(name)).count();
            assert_eq!(count("MANIFOLD_SOLID_BREP"), solids);
            assert_eq!(used.len(), count("EDGE_CURVE"));
            for (edge, senses) in used {
                assert!(senses.len() == 2 && senses[0] != senses[1], "#{edge}: {senses:?}");
            }
            if part == Part::Sprag {
                let arcs = outline.segments().iter().filter(|s| matches!(s, Segment::Arc { .. })).count();
                assert_eq!(
                    (count("CYLINDRICAL_SURFACE"), count("PLANE")),
                    (arcs, outline.segments().len() - arcs + 2)
                );
            }
            if part == Part::Clutch {
                assert_eq!(count("NEXT_ASSEMBLY_USAGE_OCCURRENCE"), clutch.sprags.count + 2);
            }
        }
    }
}

#[test]
fn points_leave_the_arcs_by_no_more_than_asked_and_arcs_give_the_area() {
    for design in designs() {
        let (_, _, outline) = closed(&design);
        let exact = outline.mass_properties(1.0, 1.0).area_m2;
        let mut last = f64::INFINITY;
        for deviation in [1e-5, 1e-6, 1e-7] {
            let points = with(&design, |s| rows::points(Part::Sprag, s, deviation));
            let n = points.len();
            let polygon: f64 = (0..n)
                .map(|i| {
                    let ([x0, y0], [x1, y1]) = (points[i].at_m, points[(i + 1) % n].at_m);
                    0.5 * (x0 * y1 - x1 * y0)
                })
                .sum();
            let around: f64 = (0..n).map(|i| apart(points[i].at_m, points[(i + 1) % n].at_m)).sum();
            // A sagitta stands two thirds of itself off its chord in the mean.
            let lost = (exact - polygon) / around;
            assert!(
                lost > 0.0 && lost < deviation * 2.0 / 3.0 && lost < 0.2 * last,
                "{lost:e} {deviation:e}"
            );
            last = lost;
        }
        let pieces: Vec<Piece> = with(&design, |s| rows::arcs(Part::Sprag, s))
            .into_iter()
            .map(|r| Piece {
                ends: r.ends_m.unwrap(),
                arc: r.circle_m.zip(r.angles_rad).map(|((c, radius), [a, b])| {
                    let at = |angle: f64| [c[0] + radius * angle.cos(), c[1] + radius * angle.sin()];
                    let [from, to] = r.ends_m.unwrap();
                    assert!(apart(at(a), from) < 1e-14 && apart(at(b), to) < 1e-14);
                    (c, radius, b - a)
                }),
            })
            .collect();
        assert!((area(&pieces) / exact - 1.0).abs() < 1e-12);
    }
}

/// A press fit and heat change what runs, not what is made.
#[test]
fn drawings_show_the_clutch_as_made() {
    let folder = Folder::new();
    let plain = Design::read("designs/starter.toml".as_ref()).unwrap();
    let file = folder.path("warm.toml");
    let warm = "\n[thermal]\nsprags_c = 90.0\ninner_race_c = 80.0\nouter_race_c = 60.0\n";
    std::fs::write(&file, plain.source.clone() + warm).unwrap();
    let warm = Design::read(file.as_ref()).unwrap();
    assert!(warm.clutch.running.is_some() && warm.clutch.races != plain.clutch.races);
    let of = |d: &Design| with(d, |s| rows::arcs(Part::Clutch, s));
    assert_eq!(of(&warm), of(&plain));
}

#[test]
fn names_from_elsewhere_do_no_harm() {
    let folder = Folder::new();
    let name = "Größe <b>'100 %%c' & */ \\\\ #1";
    let file = folder
        .changed("designs/starter.toml", &[("name = \"Starter, lifts off\"", &format!("name = \"{name}\""))]);
    let design = Design::read(file.as_ref()).unwrap();
    let texts = read_dxf(&with(&design, |s| dxf(Part::Sprag, s))).texts.join("\n");
    assert!(texts.contains("Gr\\U+00F6\\U+00DFe") && texts.contains("100 %%037%%037c"), "{texts}");
    let text = with(&design, |s| svg(Part::Clutch, s));
    assert!(!text.contains("<b>") && text.contains("&lt;b&gt;"));
    let text = with(&design, |s| step(Part::Clutch, s));
    assert!(text.is_ascii() && text.matches('\'').count() % 2 == 0 && text.matches("*/").count() > 0);
    let comment = text.lines().nth(1).unwrap();
    assert!(comment.starts_with("/* sprag-design ") && comment.matches("*/").count() == 1);
    for entity in read_step(&text).values() {
        assert!(references(entity).iter().all(|id| *id > 0));
    }
}
