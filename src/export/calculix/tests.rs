use super::*;
use crate::design::Design;

fn design(text: &str) -> (Design, Profile, Outline) {
    let design = Design::parse(text, "design").unwrap();
    let profile = design.clutch.profile().unwrap();
    let flanks = design.clutch.sprags.flanks.unwrap();
    let outline = Outline::closed(&profile, &flanks).unwrap();
    (design, profile, outline)
}

const SINGLE: &str = include_str!("../../../designs/huang2017-single-arc.toml");
const SECOND: &str = include_str!("../../../designs/fe-check-24.toml");

fn coarse(variant: Variant, torque_nm: f64) -> Options {
    Options { variant, torque_nm, mesh_m: 60e-6, ..Options::default() }
}

/// Node coordinates of a deck by number.
fn nodes(text: &str) -> std::collections::BTreeMap<usize, [f64; 3]> {
    let mut inside = false;
    let mut all = std::collections::BTreeMap::new();
    for line in text.lines().filter(|l| !l.starts_with("**")) {
        if line.starts_with('*') {
            inside = line.starts_with("*NODE, NSET=N");
        } else if inside {
            let f: Vec<f64> = line.split(',').map(|v| v.parse().unwrap()).collect();
            all.insert(f[0] as usize, [f[1], f[2], f[3]]);
        }
    }
    all
}

#[test]
fn the_sprag_begins_with_the_overlap_it_is_said_to_have() {
    for text in [SINGLE, SECOND] {
        let (d, p, o) = design(text);
        let m = model(&d.clutch, &p, &o, &coarse(Variant::Layer, 30.0), &d.hash).unwrap();
        let r = |p: &[f64; 2]| p[0].hypot(p[1]);
        let row = |j: usize| &m.sprag.points[j * m.sprag.size.0..(j + 1) * m.sprag.size.0];
        let least = row(0).iter().map(r).fold(f64::INFINITY, f64::min);
        let most = row(m.sprag.size.1 - 1).iter().map(r).fold(0.0, f64::max);
        let [track_i, track_e] = m.facts.track_mm;
        // Nodes stand off their arcs by h^2/(12 r), 1e-4 mm here, and none need lie at the deepest point.
        assert!((track_i - least - OVERLAP_MM).abs() < 2e-4, "{}", track_i - least);
        assert!((most - track_e - OVERLAP_MM).abs() < 2e-4, "{}", most - track_e);
    }
}

#[test]
fn chords_follow_their_arc_in_the_mean() {
    let (radius, step) = (4.02, 0.05);
    let r = mesh::chord_radius(radius, step);
    let half: f64 = 0.5 * step / r;
    // Mean distance of a chord from the centre, along its length.
    let apothem = r * half.cos();
    let mean = (0..1000)
        .map(|i| (apothem.powi(2) + (((i as f64 + 0.5) / 1000.0 - 0.5) * step).powi(2)).sqrt())
        .sum::<f64>()
        / 1000.0;
    assert!((mean - radius).abs() < 1e-8, "{}", mean - radius);
}

#[test]
fn a_held_rim_keeps_its_radius_while_it_turns() {
    let text = SINGLE.replace("[races]", "[races]\nouter_rim = \"held\"");
    let (d, p, o) = design(&text);
    let (m, text) = (
        model(&d.clutch, &p, &o, &coarse(Variant::Layer, 16.8), &d.hash).unwrap(),
        deck(&d.clutch, &p, &o, &coarse(Variant::Layer, 16.8), &d.hash).unwrap(),
    );
    let control = m.outer.first_node + m.outer.nodes() + 1;
    assert!(!text.contains("ARC0") && text.contains(&format!("*BOUNDARY, AMPLITUDE=ARC1\n{control},2,2,1.")));
    let end: f64 = text
        .lines()
        .filter_map(|l| l.strip_prefix(&format!("{control},1,1,")))
        .map(|v| v.parse().unwrap())
        .fold(0.0, f64::max);
    // A node at the azimuth 0: the tangent ahead is (cos a, -sin a), across it (sin a, cos a).
    let (radius, ahead): (f64, f64) = (m.facts.driven_mm[1], m.facts.ahead_rad[1]);
    let course =
        text.split("*AMPLITUDE, NAME=ARC1\n").nth(1).unwrap().lines().take_while(|l| !l.starts_with('*'));
    let mut most = 0.0f64;
    for row in course {
        let (time, across): (f64, f64) =
            row.split_once(',').map(|(a, b)| (a.parse().unwrap(), b.parse().unwrap())).unwrap();
        let q = time * end;
        let (x, y) = (q * ahead.cos() + across * ahead.sin(), across * ahead.cos() - q * ahead.sin());
        assert!((x.hypot(radius + y) - radius).abs() < 1e-9, "{time}");
        most = most.max(across);
    }
    // It bulges halfway by R (1 - cos a).
    assert!((most / (radius * (1.0 - ahead.cos())) - 1.0).abs() < 1e-2);
}

#[test]
fn every_node_number_in_the_deck_exists_and_every_element_has_volume() {
    let (d, p, o) = design(SINGLE);
    for variant in [Variant::PlaneStrain, Variant::PlaneStress, Variant::Layer, Variant::Solid { layers: 3 }]
    {
        let text = deck(&d.clutch, &p, &o, &coarse(variant, 16.8), &d.hash).unwrap();
        let nodes = nodes(&text);
        let mut card = "";
        let (mut elements, mut equations) = (0, 0);
        for line in text.lines().filter(|l| !l.starts_with("**")) {
            if line.starts_with('*') {
                card = line;
            } else if card.starts_with("*ELEMENT, TYPE=C3D8I") {
                let n: Vec<usize> = line.split(',').map(|v| v.parse().unwrap()).collect();
                let [a, b, c, e] = [n[1], n[2], n[4], n[5]].map(|i| nodes[&i]);
                let by = |q: [f64; 3]| [q[0] - a[0], q[1] - a[1], q[2] - a[2]];
                let (u, v, w) = (by(b), by(c), by(e));
                let volume = (u[0] * v[1] - u[1] * v[0]) * w[2];
                assert!(volume > 0.0, "{variant:?} {line}");
                elements += 1;
            } else if card.starts_with("*EQUATION") && line.contains(',') {
                // CalculiX reads twenty characters per field and takes no dependent term that is zero.
                let f: Vec<&str> = line.split(',').collect();
                assert!(f.len().is_multiple_of(3) && f.iter().all(|v| v.len() <= 20), "{line}");
                assert!(f.chunks(3).all(|t| nodes.contains_key(&t[0].parse::<usize>().unwrap())), "{line}");
                assert!(f[2].parse::<f64>().unwrap().abs() > 0.5, "{line}");
                equations += 1;
            }
        }
        assert!(elements > 500 && equations > 100, "{variant:?}: {elements}, {equations}");
    }
}

#[test]
fn no_degree_of_freedom_depends_twice() {
    let (d, p, o) = design(SECOND);
    for variant in [Variant::PlaneStrain, Variant::Layer, Variant::Solid { layers: 2 }] {
        let text = deck(&d.clutch, &p, &o, &coarse(variant, 100.0), &d.hash).unwrap();
        let mut seen = std::collections::HashSet::new();
        let mut inside = false;
        for line in text.lines().filter(|l| !l.starts_with("**")) {
            if line.starts_with('*') {
                inside = line.starts_with("*EQUATION");
            } else if inside && line.contains(',') {
                let f: Vec<&str> = line.split(',').collect();
                assert!(seen.insert((f[0].to_owned(), f[1].to_owned())), "{variant:?} {line}");
            }
        }
    }
}

#[test]
fn senseless_options_are_refused_by_name() {
    let (d, p, o) = design(SINGLE);
    let refused = |options: Options| deck(&d.clutch, &p, &o, &options, &d.hash).unwrap_err();
    let good = coarse(Variant::Layer, 16.8);
    assert!(matches!(refused(Options { mesh_m: f64::NAN, ..good }), NoDeck::Option { name: "mesh", .. }));
    assert!(matches!(refused(Options { torque_nm: 0.0, ..good }), NoDeck::Option { name: "torque", .. }));
    assert!(matches!(
        refused(Options { increments: Some(0), ..good }),
        NoDeck::Option { name: "increments", .. }
    ));
    let solid = Variant::Solid { layers: 0 };
    assert!(matches!(refused(Options { variant: solid, ..good }), NoDeck::Option { name: "layers", .. }));
    let beyond = refused(Options { torque_nm: 1e5, ..good });
    assert!(
        matches!(beyond, NoDeck::BeyondCurve { .. }) && beyond.to_string().contains("(off-profile)"),
        "{beyond}"
    );
    assert!(matches!(refused(Options { mesh_m: 1e-9, ..good }), NoDeck::TooFine { .. }));
    assert!(matches!(refused(Options { mesh_m: 0.01, ..good }), NoDeck::NoRoom { .. }));
}

/// Without a limit of its own `ccx` iterates for ever on a contact that alternates.
#[test]
fn a_deck_has_fixed_increments_an_end_to_its_iterations_and_a_penalty_by_its_mesh() {
    let (d, p, o) = design(SINGLE);
    let slope = |mesh_m: f64| {
        let options = Options { mesh_m, ..coarse(Variant::Layer, 16.8) };
        let text = deck(&d.clutch, &p, &o, &options, &d.hash).unwrap();
        assert!(!text.contains("DIRECT"));
        for step in text.split("*STEP").skip(1) {
            let sizes: Vec<&str> = step.lines().nth(2).unwrap().split(',').collect();
            assert!(sizes[0] == sizes[2] && sizes[2] == sizes[3] && sizes[1] == "1.", "{sizes:?}");
            // Eighth number: attempts beyond the first.
            assert!(step.contains("PARAMETERS=TIME INCREMENTATION\n4,8,9,16,10,4,,0\n*CONTROLS"), "{step}");
            assert!(step.contains("PARAMETERS=CONTACT\n0.001,0.1,100,40\n"), "{step}");
        }
        let behaviour = text.split("PRESSURE-OVERCLOSURE=LINEAR\n").nth(1).unwrap();
        behaviour.lines().next().unwrap().parse::<f64>().unwrap()
    };
    // MPa/mm: 10 E over the mesh width.
    assert!((slope(50e-6) / (10.0 * 206e3 / 0.05) - 1.0).abs() < 1e-12);
    assert!((slope(25e-6) / slope(50e-6) - 2.0).abs() < 1e-12);
}
