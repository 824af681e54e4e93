//! Drawings and measured points as sprags: planted outlines come back, what is no outline is refused in words.

use crate::program::{Folder, json, run, stdout};
use nalgebra::Vector2;
use sprag_design::export::{DrawnClutch, Part, dxf::dxf};
use sprag_design::import::{
    DrawnUnit, FittedSprag, NoImport, SpiralKind, Wanted, read_dxf, read_points, sprag,
};
use sprag_design::profile::Segment;
use sprag_design::{Design, Limits, Outline};
use std::fmt::Write;

type Point = Vector2<f64>;

const TEMPLATE: &str = "designs/starter.toml";

fn outline(design: &Design) -> Outline {
    let profile = design.clutch.profile().unwrap();
    Outline::closed(&profile, &design.clutch.sprags.flanks.unwrap()).unwrap()
}

fn drawing(design: &Design) -> String {
    let (profile, outline) = (design.clutch.profile().unwrap(), outline(design));
    let subject = DrawnClutch {
        name: &design.name,
        hash: &design.hash,
        clutch: &design.clutch,
        profile: &profile,
        outline: Some(&outline),
    };
    dxf(Part::Sprag, &subject)
}

fn wanted(design: &Design) -> Wanted {
    let r = &design.clutch.races;
    Wanted { tracks_m: [r.inner_radius_m, r.outer_radius_m], arcs: None, deviation_m: None, swap: false }
}

/// Arcs, centre distance and flanks of a design, come back.
fn same(got: &FittedSprag, design: &Design, scale: f64, within_m: f64) {
    let s = &design.clutch.sprags;
    let near = |a: f64, b: f64, what: &str| assert!((a - b).abs() < within_m, "{what}: {a} {b}");
    near(got.outer_radius_m, scale * s.outer_radius_m, "r_e");
    near(got.centre_distance_m, scale * s.centre_distance_m, "e_1");
    assert_eq!(got.inner_arcs.len(), s.inner_arcs.len());
    for (k, ((radius_m, until), arc)) in got.inner_arcs.iter().zip(&s.inner_arcs).enumerate() {
        near(*radius_m, scale * arc.radius_m, "r_i");
        // The end of the last arc is nowhere to be seen in an outline.
        if k + 1 < s.inner_arcs.len() {
            assert!((until - arc.until_rad).abs() < 1e3 * within_m, "{until} {}", arc.until_rad);
        }
    }
    let flanks = s.flanks.unwrap();
    near(got.flanks.rear_m, scale * flanks.rear_m, "rear");
    near(got.flanks.front_m, scale * flanks.front_m, "front");
    assert!((got.flanks.rear_tilt_rad - flanks.rear_tilt_rad).abs() < 1e3 * within_m);
    assert!((got.flanks.front_tilt_rad - flanks.front_tilt_rad).abs() < 1e3 * within_m);
}

fn table(points: &[Point]) -> String {
    points.iter().fold("x_mm,y_mm\n".to_owned(), |mut text, p| {
        let _ = writeln!(text, "{},{}", 1e3 * p.x, 1e3 * p.y);
        text
    })
}

fn polyline(points: &[Point]) -> String {
    let mut text =
        "  0\nSECTION\n  2\nHEADER\n  9\n$INSUNITS\n 70\n4\n  0\nENDSEC\n  0\nSECTION\n  2\nENTITIES\n  0\n\
                    POLYLINE\n  8\n0\n 66\n1\n 70\n1\n"
            .to_owned();
    for p in points {
        let _ = write!(text, "  0\nVERTEX\n  8\n0\n 10\n{}\n 20\n{}\n", 1e3 * p.x, 1e3 * p.y);
    }
    text + "  0\nSEQEND\n  8\n0\n  0\nENDSEC\n  0\nEOF\n"
}

/// So many points on each arc of the outline, evenly; flanks by their corners alone.
fn measured(outline: &Outline, each: usize) -> Vec<Point> {
    let mut points = Vec::new();
    for s in outline.segments() {
        if let Segment::Arc { centre_m, radius_m, from_azimuth_rad, sweep_rad } = *s {
            for i in 0..=each {
                let azimuth = from_azimuth_rad + sweep_rad * i as f64 / each as f64;
                points.push(centre_m + radius_m * Point::new(azimuth.sin(), azimuth.cos()));
            }
        }
    }
    points
}

#[test]
fn a_drawing_comes_back_as_the_sprag_that_was_drawn() {
    for name in ["starter", "huang2017-single-arc"] {
        let design = Design::read(format!("designs/{name}.toml").as_ref()).unwrap();
        let drawn = read_dxf(&drawing(&design), None, None).unwrap();
        assert!(drawn.remarks.is_empty());
        let got = sprag(&drawn, &wanted(&design)).unwrap();
        assert!(!got.mirrored && got.behind == 0 && got.inner.max_m < 1e-10, "{got:?}");
        same(&got, &design, 1.0, 2e-8);
    }
}

/// A sprag as `new` makes it: its flanks run nearly tangent into the inner arc, at 7 deg.
#[test]
fn gentle_corners_are_found() {
    const SPRAG: &str = "[sprags]\ncount = 24\nlength_mm = 12.0\nouter_radius_mm = 5.5\ncentre_distance_mm = 0.6257\n\
        inner_arcs = [{ radius_mm = 2.915, until_rad = 0.4774 }]\nflanks = { rear_mm = 2.6084, front_mm = 3.1204 }\n\
        [races]\ninner_bore_radius_mm = 20.0\ninner_radius_mm = 27.2\nouter_radius_mm = 35.53\n\
        outer_outside_radius_mm = 43.3\nwidth_mm = 15.0\nviscous_damping_nm_s_per_rad = 0.1\n";
    let text = std::fs::read_to_string(TEMPLATE).unwrap();
    let (before, rest) = text.split_once("[sprags]").unwrap();
    let (_, behind) = rest.split_once("[spring]").unwrap();
    let design = Design::parse(&format!("{before}{SPRAG}[spring]{behind}"), "new.toml").unwrap();
    let got = sprag(&read_dxf(&drawing(&design), None, None).unwrap(), &wanted(&design)).unwrap();
    same(&got, &design, 1.0, 2e-8);
    // Measured with steps of some 4 um.
    let points = measured(&outline(&design), 1500);
    let got = sprag(&read_points(&table(&points), None).unwrap(), &wanted(&design)).unwrap();
    same(&got, &design, 1.0, 2e-8);
}

#[test]
fn where_it_lies_how_large_and_which_side_up_changes_nothing() {
    let design = Design::read("designs/huang2017-single-arc.toml".as_ref()).unwrap();
    let points = measured(&outline(&design), 400);
    for (angle, shift, over, scale, backwards) in [
        (0.0, [0.0, 0.0], false, 1.0, true),
        (2.1, [0.05, -0.2], false, 1.0, false),
        (-1.2, [0.003, 0.001], true, 1.0, true),
        (0.4, [0.0, 0.3], true, 3.0, false),
        (3.0, [-0.1, 0.0], false, 0.2, false),
    ] {
        let (s, c) = f64::sin_cos(angle);
        let place = |p: &Point| {
            let p = scale * Point::new(if over { -p.x } else { p.x }, p.y);
            Point::new(c * p.x - s * p.y, s * p.x + c * p.y) + Point::from(shift)
        };
        let mut all: Vec<Point> = points.iter().map(place).collect();
        if backwards {
            all.reverse();
        }
        let own = wanted(&design);
        let own = Wanted { tracks_m: own.tracks_m.map(|r| scale * r), ..own };
        for drawn in
            [read_points(&table(&all), None).unwrap(), read_dxf(&polyline(&all), None, None).unwrap()]
        {
            let got = sprag(&drawn, &own).unwrap();
            assert_eq!(got.mirrored, over);
            same(&got, &design, scale, 2e-8 * scale.max(1.0));
        }
    }
}

/// 5 um of noise on every point. What is left of it in a radius is the standard error of a circle's fit over the arc,
/// 26.8 s/(sqrt(N) phi^2): 0.4 um inside and 0.6 um outside with 40 000 points on each, which is what 2 um ask for with
/// three standard errors in hand. (A tenth of the points would do for 2 um in two measurements of three.)
#[test]
fn five_micrometres_of_noise_leave_the_radii_within_two() {
    let design = Design::read("designs/huang2017-single-arc.toml".as_ref()).unwrap();
    let s = &design.clutch.sprags;
    let exact = measured(&outline(&design), 40_000);
    for seed in [1, 2] {
        let mut random = fastrand::Rng::with_seed(seed);
        let mut gauss = || {
            let (u, v): (f64, f64) = (1.0 - random.f64(), random.f64());
            5e-6 * (-2.0 * u.ln()).sqrt() * (std::f64::consts::TAU * v).cos()
        };
        let noisy: Vec<Point> = exact.iter().map(|p| p + Point::new(gauss(), gauss())).collect();
        let drawn = read_dxf(&polyline(&noisy), None, None).unwrap();
        let got = sprag(&drawn, &wanted(&design)).unwrap();
        assert_eq!(got.inner_arcs.len(), 1);
        for (side, radius_m, span) in
            [(&got.inner, s.inner_arcs[0].radius_m, 1.2), (&got.outer, s.outer_radius_m, 1.0)]
        {
            let arc = side.arcs[0];
            let off = arc.radius_m - radius_m;
            println!(
                "{seed}: {:.3} um off, standard error {:.3} um, span {:.3} rad, {} points",
                1e6 * off,
                1e6 * arc.radius_error_m,
                arc.span_rad,
                arc.points
            );
            assert!(off.abs() < 2e-6 && off.abs() < 4.0 * arc.radius_error_m, "{seed}: {off:e}");
            assert!((side.rms_m / 5e-6 - 1.0).abs() < 0.02, "{}", side.rms_m);
            // The stated standard error is that of the parabola, but for the higher terms of an arc this long.
            assert!(arc.span_rad > span);
            let stated = 26.8 * 5e-6 / ((arc.points as f64).sqrt() * arc.span_rad.powi(2));
            assert!(
                (0.75..1.1).contains(&(arc.radius_error_m / stated)),
                "{:e} {stated:e}",
                arc.radius_error_m
            );
        }
    }
}

/// A logarithmic spiral is no arc: it is followed to what is asked, and what is left is said.
#[test]
fn a_logarithmic_spiral_is_followed_by_arcs() {
    let design = Design::read("designs/huang2017-single-arc.toml".as_ref()).unwrap();
    let mut points = measured(&outline(&design), 600);
    let centre = design.clutch.profile().unwrap().arcs[0].centre_m;
    for p in points.iter_mut().take(601) {
        let out = *p - centre;
        let angle = out.y.atan2(out.x) + std::f64::consts::FRAC_PI_2;
        *p = centre + out * (0.015 * angle).exp();
    }
    let drawn = read_points(&table(&points), None).unwrap();
    let mut last = f64::INFINITY;
    for deviation_m in [2e-6, 0.2e-6] {
        let got = sprag(&drawn, &Wanted { deviation_m: Some(deviation_m), ..wanted(&design) }).unwrap();
        let most = got.inner.max_m;
        println!("{} arcs: {most:e}", got.inner.arcs.len());
        assert!(most <= deviation_m && most < last);
        last = most;
        // Every point lies that near to one of the arcs.
        let off = |p: &Point| {
            let to = |a: &sprag_design::import::Arc| ((p - a.centre_m).norm() - a.radius_m).abs();
            got.inner.arcs.iter().map(to).fold(f64::INFINITY, f64::min)
        };
        assert!(points[30..570].iter().all(|p| off(p) <= most + 1e-12));
    }
    let one = sprag(&drawn, &Wanted { arcs: Some(1), ..wanted(&design) }).unwrap();
    assert!(one.inner.max_m > 1e-6 && one.inner_arcs.len() == 1);
}

fn fails(drawn: Result<sprag_design::import::Drawn, NoImport>, design: &Design) -> NoImport {
    drawn.and_then(|d| sprag(&d, &wanted(design))).unwrap_err()
}

#[test]
fn what_is_no_outline_is_refused_with_its_line() {
    let design = Design::read(TEMPLATE.as_ref()).unwrap();
    let good = drawing(&design);
    let dxf = |text: &str| fails(read_dxf(text, None, None), &design);
    let csv = |text: &str| fails(read_points(text, None), &design);
    let says = |why: NoImport, line: Option<usize>, word: &str| {
        assert!(why.to_string().contains(word), "{why}");
        assert_eq!(why.line, line, "{why}");
    };
    says(dxf(""), None, "empty");
    says(csv(" \n"), None, "empty");
    says(dxf("ISO-10303-21;\nHEADER;\n"), Some(1), "STEP");
    says(csv("ISO-10303-21;\nHEADER;\n"), Some(1), "STEP");
    says(dxf("hello\nworld\n"), Some(1), "group code");
    says(dxf("  0\nSECTION\n  2\nENTITIES\n  0\nENDSEC\n"), None, "no line, arc");
    says(dxf("  0\nEOF\n"), None, "ENTITIES");
    let line_of = |what: &str| good.lines().position(|l| l.trim() == what).unwrap();
    let vertex = line_of("VERTEX");
    let with = |at: usize, value: &str| {
        let mut lines: Vec<&str> = good.lines().collect();
        lines[at] = value;
        lines.join("\n")
    };
    for value in ["nan", "inf", "1e300", "x"] {
        says(dxf(&with(vertex + 4, value)), Some(vertex + 5), "number");
        says(csv(&format!("x_mm,y_mm\n1,2\n{value},3\n")), Some(3), "number");
    }
    says(csv("a,b\n1,2\n"), Some(1), "x_mm");
    says(csv("x_mm,y_mm\n1\n"), Some(3 - 1), "columns");
    says(csv("x_mm,y_mm\n1,2\n"), None, "points");
    let units = line_of("$INSUNITS") + 2;
    says(dxf(&with(units, "20")), Some(units + 1), "INSUNITS");
    // Closed no more: the last side is missing.
    let closed = line_of("POLYLINE") + 12;
    assert_eq!(good.lines().nth(closed).unwrap().trim(), "1");
    let why = dxf(&with(closed, "     0"));
    assert!(why.line.is_some() && why.found.contains("open outline"), "{why}");
    let points = measured(&outline(&design), 50);
    let half: Vec<Point> = points[..100].to_vec();
    assert!(csv(&table(&half)).found.contains("open outline"));
    // Two sprags.
    let end = good.rfind("  0\nENDSEC").unwrap();
    let far: Vec<Point> = points.iter().map(|p| p + Point::new(0.1, 0.0)).collect();
    let far = polyline(&far).replace("  8\n0\n", "  8\nSPRAG\n");
    let entities = &far[far.find("  0\nPOLYLINE").unwrap()..far.rfind("  0\nENDSEC").unwrap()];
    let twice = format!("{}{entities}{}", &good[..end], &good[end..]);
    assert!(dxf(&twice).to_string().contains("second outline"), "{}", dxf(&twice));
    // A circle is no sprag.
    let ring: Vec<Point> = (0..500)
        .map(|i| f64::from(i) / 500.0 * std::f64::consts::TAU)
        .map(|a| 5e-3 * Point::new(a.cos(), a.sin()))
        .collect();
    says(csv(&table(&ring)), None, "0 corners");
    // Races that it does not span.
    let other = Wanted { tracks_m: [20e-3, 40e-3], ..wanted(&design) };
    let why = sprag(&read_dxf(&good, None, None).unwrap(), &other).unwrap_err();
    assert!(why.found.contains("mm high") && why.help.contains("`tracks_m`"), "{why}");
    // A layer that is not there.
    assert!(read_dxf(&good, Some("NOWHERE"), None).unwrap_err().found.contains("NOWHERE"));
}

#[test]
fn inches_are_converted_and_arcs_that_are_not_tangent_refused() {
    let design = Design::read("designs/huang2017-single-arc.toml".as_ref()).unwrap();
    let points: Vec<Point> = measured(&outline(&design), 400).iter().map(|p| p / 25.4).collect();
    let text = polyline(&points).replace("$INSUNITS\n 70\n4", "$INSUNITS\n 70\n1");
    let drawn = read_dxf(&text, None, None).unwrap();
    assert!(drawn.remarks.iter().any(|s| s.contains("inches")));
    same(&sprag(&drawn, &wanted(&design)).unwrap(), &design, 1.0, 2e-8);
    let unsaid = read_dxf(&text.replace("$INSUNITS", "$OTHER"), None, None).unwrap();
    assert!(unsaid.remarks.iter().any(|s| s.contains("taken for millimetres")));
    let inch = read_points(&table(&points).replace("x_mm,y_mm", "x_in,y_in"), None).unwrap();
    same(&sprag(&inch, &wanted(&design)).unwrap(), &design, 1.0, 2e-8);

    // The junction of two inner arcs, moved by 0.1 mm along one of them: an edge.
    let multi = Design::read(TEMPLATE.as_ref()).unwrap();
    let good = drawing(&multi);
    let lines: Vec<&str> = good.lines().collect();
    let bulges: Vec<usize> =
        (0..lines.len()).filter(|i| lines[*i].trim() == "42" && lines[i + 1].contains('.')).collect();
    let first = bulges.into_iter().find(|i| lines[i - 9].trim() == "VERTEX").unwrap() + 1;
    let mut bent = lines.clone();
    let more = format!("{}", 1.3 * lines[first].parse::<f64>().unwrap());
    bent[first] = &more;
    let why = fails(read_dxf(&bent.join("\n"), None, None), &multi);
    assert!(why.line.is_some() && why.found.contains("tangents"), "{why}");
}

#[test]
fn the_command_writes_a_design_that_is_checked() {
    let folder = Folder::new();
    let (drawing, new) = (folder.path("sprag.dxf"), folder.path("new.toml"));
    let made = run(&["export", TEMPLATE, "--format", "dxf", "-o", &drawing, "--quiet"]);
    assert_eq!(made.status.code(), Some(0));
    let args = ["import", &drawing, "--template", TEMPLATE, "-o", &new, "--json"];
    let answer = json(&run(&args));
    assert!(answer["inner"]["max_um"].as_f64().unwrap() < 1e-3, "{answer}");
    assert_eq!(answer["inner"]["arcs"].as_array().unwrap().len(), 3);
    let radius = answer["sprags"]["inner_arcs"][1]["radius_mm"].as_f64().unwrap();
    assert!((radius - 4.08).abs() < 1e-4, "{radius}");
    let back = Design::read(new.as_ref()).unwrap();
    let given = Design::read(TEMPLATE.as_ref()).unwrap();
    assert!((back.clutch.sprags.mass_kg / given.clutch.sprags.mass_kg - 1.0).abs() < 1e-5);
    assert!(back.source.contains("# Written by sprag-design import") && back.optimize.is_none());
    // Again, over its own file; not over somebody else's.
    assert_eq!(run(&args).status.code(), Some(0));
    let foreign = folder.path("theirs.toml");
    std::fs::write(&foreign, "schema = 1\n").unwrap();
    let refused = run(&["import", &drawing, "-o", &foreign]);
    assert_eq!(refused.status.code(), Some(2));
    let text = stdout(&run(&["import", &drawing]));
    assert!(text.contains("no --template") && text.contains("no design written"), "{text}");
    for (file, word) in [("no.dxf", "no such file"), (TEMPLATE, "a table of x, y")] {
        let output = run(&["import", file]);
        assert_eq!(output.status.code(), Some(2));
        let text = String::from_utf8(output.stderr).unwrap();
        assert!(text.contains(word), "{text}");
    }
}

/// Without a template nothing is held that nobody asked for, and what is a guess says so.
#[test]
fn a_design_without_a_template_is_its_own() {
    let folder = Folder::new();
    let (drawing, new) = (folder.path("sprag 7.dxf"), folder.path("new.toml"));
    assert_eq!(
        run(&["export", TEMPLATE, "--format", "dxf", "-o", &drawing, "--quiet"]).status.code(),
        Some(0)
    );
    let ran = run(&["import", &drawing, "--inner-radius", "30", "-o", &new]);
    assert_eq!(ran.status.code(), Some(0));
    let said = stdout(&ran);
    assert!(said.contains("are guesses, as designs/starter.toml, and nothing is limited"), "{said}");
    let (back, given) = (Design::read(new.as_ref()).unwrap(), Design::read(TEMPLATE.as_ref()).unwrap());
    assert_eq!((back.name.as_str(), &back.limits), ("sprag 7", &Limits::default()));
    assert!(back.scenarios.is_empty() && back.clutch.races.eccentricity.is_none());
    assert_eq!(back.clutch.sprags.count, given.clutch.sprags.count);
    let guessed = |key: &str| {
        let line = back.source.lines().find(|line| line.starts_with(&format!("{key} = "))).unwrap();
        line.ends_with("# guess, as designs/starter.toml")
    };
    for (key, guess) in [
        ("count", true),
        ("inner_radius_mm", false),
        ("outer_radius_mm", false),
        ("inner_bore_radius_mm", true),
        ("static", true),
    ] {
        assert_eq!(guessed(key), guess, "{key}: {}", back.source);
    }
    assert!(!back.source.contains("starter clutch"), "{}", back.source);
    // What needs no limit: whether its sprags bite.
    let checked = json(&run(&["check", &new, "--json"]));
    let codes: Vec<&str> =
        checked["margins"].as_array().unwrap().iter().map(|row| row["code"].as_str().unwrap()).collect();
    assert_eq!(codes, ["re-engagement"]);
    // Other races: count and rims in proportion.
    let args = ["import", &drawing, "--inner-radius", "20", "--outer-radius", "28.33", "-o", &new];
    assert_eq!(run(&args).status.code(), Some(0));
    let back = Design::read(new.as_ref()).unwrap().clutch;
    assert_eq!((back.sprags.count, back.races.inner_bore_radius_m), (18, 8e-3));
}

/// Points in order with the same noise for every one of them, seeded.
fn noisy(points: &[Point], sigma_m: f64) -> Vec<Point> {
    let mut rng = fastrand::Rng::with_seed(5);
    let mut normal = || {
        let (u, v) = (rng.f64().max(1e-300), rng.f64());
        (-2.0 * u.ln()).sqrt() * (std::f64::consts::TAU * v).cos()
    };
    points.iter().map(|p| p + sigma_m * Point::new(normal(), normal())).collect()
}

#[test]
fn a_spiral_comes_back_from_its_drawing() {
    let design = Design::read("designs/spiral.toml".as_ref()).unwrap();
    let given = design.clutch.sprags.spiral.unwrap();
    let strut = given.rise.atan();
    let got = sprag(&read_dxf(&drawing(&design), None, None).unwrap(), &wanted(&design)).unwrap();
    let [constant, logarithmic] = got.spirals[..] else { panic!("{:?}", got.spirals) };
    assert_eq!((constant.kind, logarithmic.kind), (SpiralKind::ConstantStrutAngle, SpiralKind::Logarithmic));
    println!("{constant:?}\n{logarithmic:?}");
    // What its arcs leave is 6e-5 um.
    assert!((constant.strut_rad - strut).abs() < 2e-6, "{} {strut}", constant.strut_rad);
    assert!((constant.start_radius_m - given.start_radius_m).abs() < 2e-8);
    assert!(constant.max_m < 2e-9 && constant.max_m < logarithmic.max_m && constant.max_m < got.inner.max_m);
    // Beyond its end the drawing goes on with the last arc: known to a step of the ends that are tried.
    assert!((constant.until_rad - given.until_rad).abs() < 0.025, "{}", constant.until_rad);
    let flanks = design.clutch.sprags.flanks.unwrap();
    assert!((constant.flanks.rear_m - flanks.rear_m).abs() < 5e-8, "{:?}", constant.flanks);
    assert!((constant.flanks.front_m - flanks.front_m).abs() < 5e-8);

    // Measured with 5 um of noise.
    let points = noisy(&measured(&outline(&design), 400), 5e-6);
    let got = sprag(&read_points(&table(&points), None).unwrap(), &wanted(&design)).unwrap();
    println!("{:?}", got.spirals);
    let constant = got.spirals[0];
    assert!((constant.strut_rad - strut).to_degrees().abs() < 0.03, "{} {strut}", constant.strut_rad);
    assert!((constant.start_radius_m - given.start_radius_m).abs() < 5e-6);
    assert!((4e-6..6e-6).contains(&constant.rms_m), "{}", constant.rms_m);
}

#[test]
fn a_logarithmic_spiral_comes_back_too() {
    let text = std::fs::read_to_string("designs/spiral.toml").unwrap();
    let line = "inner_spiral = { strut_angle_deg = 4.887, until_rad = 0.40 }";
    let other = "inner_spiral = { curve = \"logarithmic\", strut_angle_deg = 4.5, start_radius_mm = 3.9, rise = 0.3, until_rad = 0.40, steps = 60 }";
    let text = text.replace(line, other);
    let design = Design::parse(&text, "log.toml").unwrap();
    let got = sprag(&read_dxf(&drawing(&design), None, None).unwrap(), &wanted(&design)).unwrap();
    println!("{:?}", got.spirals);
    let found = got.spirals.iter().find(|s| s.kind == SpiralKind::Logarithmic).unwrap();
    assert!((found.strut_rad.to_degrees() - 4.5).abs() < 1e-3, "{}", found.strut_rad.to_degrees());
    assert!((found.start_radius_m - 3.9e-3).abs() < 1e-6 && (found.rise - 0.3).abs() < 1e-3, "{found:?}");
    // Its last arc leaves it by 1 nm, rise radius u^3/6, within 0.03 rad.
    assert!((found.until_rad - 0.4).abs() < 0.045 && found.max_m < 2e-8, "{found:?}");
}

#[test]
fn a_spiral_is_written_on_request_and_checks_as_the_one_drawn() {
    let folder = Folder::new();
    let dxf = folder.path("spiral.dxf");
    let new = folder.path("new.toml");
    stdout(&run(&["export", "designs/spiral.toml", "--format", "dxf", "-o", &dxf]));
    let args =
        ["import", &dxf, "--template", "designs/spiral.toml", "--spiral", "constant-strut-angle", "-o", &new];
    let text = stdout(&run(&args));
    assert!(text.contains("constant-strut-angle") && text.contains("logarithmic"), "{text}");
    let [a, b] = ["designs/spiral.toml", &new].map(|f| Design::read(f.as_ref()).unwrap());
    let [s, t] = [&a, &b].map(|d| d.clutch.sprags.spiral.unwrap());
    assert!(
        (s.rise - t.rise).abs() < 2e-6 && (s.start_radius_m - t.start_radius_m).abs() < 2e-8,
        "{s:?} {t:?}"
    );
    let tan = |d: &Design| d.clutch.curve().unwrap().at_torque(45.0).unwrap().tan_omega;
    assert!((tan(&a) / tan(&b) - 1.0).abs() < 1e-4, "{} {}", tan(&a), tan(&b));
    let both = run(&["import", &dxf, "--spiral", "logarithmic", "--arcs", "2"]);
    assert_eq!(both.status.code(), Some(2));
}

#[test]
fn the_own_table_of_arcs_is_read_again() {
    let folder = Folder::new();
    let csv = folder.path("arcs.csv");
    stdout(&run(&["export", TEMPLATE, "--format", "csv", "-o", &csv]));
    let design = Design::read(TEMPLATE.as_ref()).unwrap();
    let text = std::fs::read_to_string(&csv).unwrap();
    let got = sprag(&read_points(&text, None).unwrap(), &wanted(&design)).unwrap();
    same(&got, &design, 1.0, 2e-8);
    let race = text.replace("sprag,", "inner race,");
    assert!(read_points(&race, None).unwrap_err().found.contains("body sprag"));
    let odd = text.replacen(",line,", ",spline,", 1);
    assert!(read_points(&odd, None).unwrap_err().found.contains("spline"));
}

#[test]
fn a_drawing_seen_from_below_is_mirrored_and_a_unit_can_be_said() {
    let design = Design::read(TEMPLATE.as_ref()).unwrap();
    let points = measured(&outline(&design), 400);
    let over: Vec<Point> = points.iter().map(|p| Point::new(-p.x, p.y)).collect();
    // The polyline of the mirrored points, which lies mirrored itself.
    let below = polyline(&over).replace("POLYLINE\n  8\n0\n", "POLYLINE\n  8\n0\n210\n0\n220\n0\n230\n-1\n");
    let got = sprag(&read_dxf(&below, None, None).unwrap(), &wanted(&design)).unwrap();
    assert!(!got.mirrored);
    same(&got, &design, 1.0, 2e-8);
    let tilted =
        polyline(&points).replace("POLYLINE\n  8\n0\n", "POLYLINE\n  8\n0\n210\n0.6\n220\n0\n230\n0.8\n");
    assert!(read_dxf(&tilted, None, None).unwrap_err().found.contains("POLYLINE that does not lie"));
    // True arcs seen from below; lines lie in the world.
    let mut entities = String::new();
    for segment in outline(&design).segments() {
        let _ = match *segment {
            Segment::Arc { centre_m: c, radius_m, from_azimuth_rad, sweep_rad } => {
                // Azimuths run clockwise from +y; the drawing's angles seen from below do so from -x.
                let ends = [from_azimuth_rad, from_azimuth_rad + sweep_rad].map(|a| 90.0 + a.to_degrees());
                let (from, to) = if sweep_rad > 0.0 { (ends[0], ends[1]) } else { (ends[1], ends[0]) };
                write!(
                    entities,
                    "  0\nARC\n  8\n0\n 10\n{}\n 20\n{}\n 40\n{}\n 50\n{from}\n 51\n{to}\n230\n-1\n",
                    -1e3 * c.x,
                    1e3 * c.y,
                    1e3 * radius_m
                )
            }
            Segment::Line { from_m: a, to_m: b } => write!(
                entities,
                "  0\nLINE\n  8\n0\n 10\n{}\n 20\n{}\n 11\n{}\n 21\n{}\n",
                1e3 * a.x,
                1e3 * a.y,
                1e3 * b.x,
                1e3 * b.y
            ),
        };
    }
    let head =
        "  0\nSECTION\n  2\nHEADER\n  9\n$INSUNITS\n 70\n4\n  0\nENDSEC\n  0\nSECTION\n  2\nENTITIES\n";
    let below = format!("{head}{entities}  0\nENDSEC\n  0\nEOF\n");
    let got = sprag(&read_dxf(&below, None, None).unwrap(), &wanted(&design)).unwrap();
    same(&got, &design, 1.0, 2e-8);

    let inches: Vec<Point> = points.iter().map(|p| p / 25.4).collect();
    let bare = polyline(&inches).replace("$INSUNITS\n 70\n4", "$INSUNITS\n 70\n0");
    let said = read_dxf(&bare, None, None).unwrap().remarks;
    assert!(
        said.iter().any(|s| s.contains("taken for millimetres") && s.contains("`unit` inch")),
        "{said:?}"
    );
    let got = sprag(&read_dxf(&bare, None, Some(DrawnUnit::Inch)).unwrap(), &wanted(&design)).unwrap();
    same(&got, &design, 1.0, 2e-8);
}
