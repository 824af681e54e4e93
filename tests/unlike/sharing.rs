//! Sprags one by one: alike they are the curve, unlike they are what a hand calculation says.

use sprag_design::answer::Answer;
use sprag_design::answer::sharing::SharingAnswer;
use sprag_design::clutch::{Carrier, Eccentricity, GivenSprag, Sharing, Standing, TrackWave};
use sprag_design::race::Race;
use sprag_design::wedge::SpragDeviation;

use sprag_design::sharing::{Asked, NotShared, Shared, Turn, Unlike};
use sprag_design::{Clutch, Design, EndReason, Material, WedgeCurve};
use std::f64::consts::TAU;

fn clutch(file: &str) -> Clutch {
    let path = format!("{}/designs/{file}.toml", env!("CARGO_MANIFEST_DIR"));
    let mut clutch = Design::read(path.as_ref()).unwrap().clutch;
    clutch.races.eccentricity = None;
    clutch
}

fn curve(clutch: &Clutch) -> WedgeCurve {
    WedgeCurve::build(clutch, &clutch.profile().unwrap(), 0.0).unwrap()
}

fn at(clutch: &Clutch, sharing: &Sharing, curve: &WedgeCurve, torque_nm: f64) -> Shared {
    Unlike::new(clutch, sharing, curve, 0.0).carrying(Asked::Torque(torque_nm), 0.0).unwrap()
}

#[test]
fn sprags_alike_between_concentric_races_are_the_curve() {
    let mut worst: f64 = 0.0;
    for file in ["huang2017-single-arc", "huang2017-multi-arc", "huang2017-elastic", "starter", "fe-check-24"]
    {
        let clutch = clutch(file);
        let curve = curve(&clutch);
        // Angles are found to 1e-15 rad: below 1e-3 of the torque that alone is more than 1e-10 of the windup.
        for share in [1e-3, 0.1, 0.5, 0.99] {
            let torque = share * curve.end_torque_nm();
            for stiffness in [f64::INFINITY, 1e8, 0.0] {
                for start in [Standing::Sprung, Standing::Caged] {
                    let sharing = Sharing { stiffness_n_per_m: Some(stiffness), start, ..Sharing::default() };
                    let shared = at(&clutch, &sharing, &curve, torque);
                    // By the force: the curve's own search by torque leaves 1e-15 of the largest force.
                    for load in &shared.loads {
                        let row = curve.at_normal(load.normal_inner_n).unwrap();
                        let off = [row.torque_nm / torque, row.windup_rad / shared.windup_rad];
                        worst = off.iter().fold(worst, |w, ratio| w.max((ratio - 1.0).abs()));
                    }
                }
            }
        }
    }
    println!("worst {worst:.1e}");
    assert!(worst < 1e-10, "{worst:e}");
}

/// Tracks out of round as made. As many lobes as sprags: a track of another radius. An oval under a cage: sprags of other sizes. The inner
/// lobes pass the sprags in a turn, the outer ones stay. A scene has them too.
#[test]
fn tracks_out_of_round_as_made() {
    // One arc: junctions count from first contact, and would lie elsewhere on the sprag for another radius.
    let clutch = clutch("huang2017-single-arc");
    let curve_at_rest = curve(&clutch);
    let n = clutch.sprags.count;
    let wave = |outer: bool, lobes: usize, amplitude_m: f64, azimuth_rad: f64| TrackWave {
        outer,
        lobes,
        amplitude_m,
        azimuth_rad,
    };
    let with = |tracks: Vec<TrackWave>, start: Standing| Sharing { tracks, start, ..Sharing::default() };
    let alike = at(&clutch, &Sharing::default(), &curve_at_rest, 60.0).loads[0].normal_inner_n;
    for (outer, amplitude_m) in [(false, 1e-5), (true, 1e-5)] {
        let lobed = with(vec![wave(outer, n, amplitude_m, 0.0)], Standing::Sprung);
        let shared = at(&clutch, &lobed, &curve_at_rest, 60.0);
        let mut other = clutch.clone();
        *[&mut other.races.inner_radius_m, &mut other.races.outer_radius_m][usize::from(outer)] +=
            amplitude_m;
        let expected = curve(&other).at_torque(60.0).unwrap().normal_inner_n;
        for load in &shared.loads {
            let off = (load.normal_inner_n - expected) / (expected - alike);
            assert!(off.abs() < 0.1, "{outer} {} {expected} {alike}", load.normal_inner_n);
        }
    }
    let oval = with(vec![wave(true, 2, 5e-6, 0.3)], Standing::Caged);
    let given = (0..n).map(|index| GivenSprag {
        index,
        size_m: Some(-wave(true, 2, 5e-6, 0.3).larger_m(TAU * index as f64 / n as f64)),
        ..GivenSprag::default()
    });
    let sizes = Sharing { given: given.collect(), start: Standing::Caged, ..Sharing::default() };
    let [oval, sizes] = [&oval, &sizes].map(|sharing| at(&clutch, sharing, &curve_at_rest, 60.0).shares());
    let uneven = oval.iter().fold(0.0, |m: f64, s| m.max((s - 1.0).abs()));
    assert!(uneven > 5e-3, "{oval:?}");
    for (a, b) in oval.iter().zip(&sizes) {
        assert!((a - b).abs() < 0.03 * uneven, "{oval:?} {sizes:?}");
    }
    let places = |outer: bool| {
        let sharing = with(vec![wave(outer, 3, 5e-6, 0.0)], Standing::Caged);
        let turn = Turn::new(&clutch, &sharing, &curve_at_rest);
        turn.at(60.0).unwrap().iter().map(|s| s.shares()[0]).collect::<Vec<_>>()
    };
    let (inner, outer) = (places(false), places(true));
    assert!(outer.len() == 1 && inner.len() == 12);
    assert!(inner.iter().any(|s| *s > 1.002) && inner.iter().any(|s| *s < 0.998), "{inner:?}");
    let design = "tracks = [ { race = \"outer\", lobes = 2, amplitude_um = 5.0 } ]";
    let path = format!("{}/designs/unlike-sprags.toml", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path)
        .unwrap()
        .replace("friction_within = 0.01", &format!("{design}\nfriction_within = 0.01"));
    let design = Design::parse(&text, &path).unwrap();
    assert!(design.sharing(None).unwrap().text(Default::default()).contains("2 lobes of 5.00 µm"));
    let scene = design.sharing_in_scene("engagement", &Default::default()).unwrap();
    assert!(scene.found.counts.len() > 3, "{:?}", scene.found.counts);
}

/// Two sprags, one of which lacks 20 um of size at the start: on rings so stiff that they do not bend, both see one windup, the second
/// less by what its gap costs, du/(OA tan omega).
#[test]
fn two_sprags_by_hand() {
    let mut clutch = clutch("huang2017-single-arc");
    clutch.sprags.count = 2;
    for m in [&mut clutch.materials.inner_race, &mut clutch.materials.outer_race] {
        m.youngs_modulus_pa *= 1e9;
    }
    let curve = curve(&clutch);
    let late = GivenSprag { index: 1, gap_m: Some(20e-6), ..GivenSprag::default() };
    let sharing = Sharing { given: vec![late], ..Sharing::default() };
    let unlike = Unlike::new(&clutch, &sharing, &curve, 0.0);
    let touch = curve.touch();
    let tan = touch.t_ratio;
    // Along the way the wedge angle falls by du/OA(1/tan), a percent or so: the mean of both ends.
    let by_hand = 20e-6 / (touch.lengths.oa.v * tan);
    let lag = unlike.lag_rad[1].unwrap();
    assert!((lag / by_hand - 1.0).abs() < 0.05, "{lag} {by_hand}");
    for torque in [0.2, 1.0, 5.0, 15.0] {
        let shared = unlike.carrying(Asked::Torque(torque), 0.0).unwrap();
        let w = shared.windup_rad;
        let alone = |own: f64| curve.at_windup(own).map_or((0.0, 0.0), |(p, _)| (p.n_bi, p.t_static * p.oa));
        let ((n_1, t_1), (n_2, t_2)) = (alone(w), alone(w - lag));
        let [a, b] = [shared.loads[0].normal_inner_n, shared.loads[1].normal_inner_n];
        println!("{torque} {a} {b} by hand {n_1} {n_2} {}", t_1 + t_2);
        assert!((a / n_1 - 1.0).abs() < 1e-6 && (b - n_2).abs() < 1e-6 * n_1, "{a} {n_1} {b} {n_2}");
        assert!(((t_1 + t_2) / torque - 1.0).abs() < 1e-6);
    }
    // The second takes load when the first has wound up by the lag.
    let catches = unlike.catches_nm(0.0);
    assert_eq!(catches[0], Some(0.0));
    let alone = curve.at_windup(lag).map(|(p, _)| p.t_static * p.oa).unwrap();
    assert!((catches[1].unwrap() / alone - 1.0).abs() < 1e-6);
}

/// The windup of a sprag off centre by its own curve (an integral) and by the rigid rolling that `sharing` takes.
#[test]
fn a_sprag_apart_winds_up_as_its_own_curve_says() {
    let clutch = clutch("huang2017-elastic");
    let alike = curve(&clutch);
    let profile = clutch.profile().unwrap();
    let mut worst: f64 = 0.0;
    for carrier in [Carrier::OuterRace, Carrier::InnerRace] {
        for offset_m in [[10e-6, 0.0], [-20e-6, 15e-6], [0.0, 40e-6]] {
            let own = WedgeCurve::build_off_centre(&clutch, &profile, offset_m, carrier).unwrap();
            let mut statics = alike.statics().clone();
            statics.set_apart(SpragDeviation { offset_m, carrier, ..SpragDeviation::default() });
            let g = |n: f64| statics.borne(n).unwrap().rolled.v - alike.statics().borne(n).unwrap().rolled.v;
            for n in [10.0, 500.0, 3000.0] {
                let exact = own.at_normal(n).unwrap().windup_rad;
                let found = alike.at_normal(n).unwrap().windup_rad + g(n) - g(1e-90);
                worst = worst.max((found / exact - 1.0).abs());
            }
        }
    }
    println!("worst {worst:.1e}");
    assert!(worst < 1e-3, "{worst:e}");
}

/// Run-out of stiff rings: forces of `margin::RunOut`, whose sprags know nothing of one another, where the rings do not yield.
#[test]
fn run_out_of_stiff_rings_is_that_of_the_margin_check() {
    let mut design =
        Design::read(format!("{}/designs/starter.toml", env!("CARGO_MANIFEST_DIR")).as_ref()).unwrap();
    for m in [&mut design.clutch.materials.inner_race, &mut design.clutch.materials.outer_race] {
        m.youngs_modulus_pa *= 1e6;
    }
    for (turning, stiffness_n_per_m) in [(false, f64::INFINITY), (true, f64::INFINITY), (true, 2e8)] {
        let e = design.clutch.races.eccentricity.unwrap();
        design.clutch.races.eccentricity = Some(Eccentricity { turning, stiffness_n_per_m, ..e });
        let state = sprag_design::margin::load_state(&design).unwrap();
        let ring = sprag_design::margin::RunOut::new(&design, &state).unwrap();
        let turn = sprag_design::sharing::Turn::new(&design.clutch, &Sharing::default(), &state.curve);
        let torque = 0.4 * ring.end.torque_nm;
        let round = ring.carrying(0, torque).unwrap();
        let shared = turn.at(torque).unwrap().swap_remove(0);
        let mut worst: f64 = 0.0;
        let mean = round.loads.iter().map(|l| l.normal_n).sum::<f64>() / round.loads.len() as f64;
        for (a, b) in round.loads.iter().zip(&shared.loads) {
            worst = worst.max((a.normal_n - b.normal_inner_n).abs() / mean);
        }
        println!(
            "{turning} {stiffness_n_per_m} worst {worst:.1e}, share {} {}",
            round.share().0,
            shared.shares()[round.share().1.engaged]
        );
        assert!(worst < if stiffness_n_per_m.is_finite() { 0.02 } else { 2e-3 }, "{worst:e}");
    }
}

/// Sprags as far apart as deviations go: every answer is a number or a reason.
#[test]
fn far_from_alike_is_answered() {
    for file in ["huang2017-elastic", "series-833-mid", "fe-check-24"] {
        let mut clutch = clutch(file);
        let curve = curve(&clutch);
        for (seed, um, offset_um, stiffness) in [
            (1, 5.0, 0.0, f64::INFINITY),
            (2, 50.0, 100.0, 0.0),
            (3, 200.0, 0.0, 1e7),
            (4, 20.0, 150.0, 1e8),
            (5, 900.0, 300.0, 0.0),
        ] {
            clutch.races.eccentricity = (offset_um > 0.0).then_some(Eccentricity {
                offset_m: 1e-6 * offset_um,
                turning: false,
                carrier: Carrier::InnerRace,
                stiffness_n_per_m: stiffness,
            });
            for start in [Standing::Sprung, Standing::Caged] {
                let sharing = Sharing {
                    start,
                    seed,
                    size_within_m: 1e-6 * um,
                    gap_up_to_m: 1e-6 * um,
                    stiffness_n_per_m: Some(stiffness),
                    ..Sharing::default()
                };
                let unlike = Unlike::new(&clutch, &sharing, &curve, 0.3);
                for share in [1e-4, 0.01, 0.1, 0.3, 0.7] {
                    let torque = share * curve.end_torque_nm();
                    let found = unlike.carrying(Asked::Torque(torque), 0.0);
                    match &found {
                        Ok(s) => {
                            assert!((s.torque_nm / torque - 1.0).abs() < 1e-8);
                            let normal: f64 = s.loads.iter().map(|l| l.normal_inner_n).sum();
                            let held = stiffness.is_infinite();
                            for k in [0, 1] {
                                assert!(
                                    held || (s.radial_n[k] - stiffness * s.shift_m[k]).abs() < 1e-7 * normal,
                                    "{s:?}"
                                );
                            }
                            println!(
                                "{file} {um} {offset_um} {start:?} {share}: {} steps, {} carry",
                                s.steps,
                                s.carrying()
                            );
                        }
                        Err(why) => println!("{file} {um} {offset_um} {start:?} {share}: {why:?}"),
                    }
                }
            }
        }
    }
}

/// One missing; then every other one: what is left of twelve has to be the clutch of six, whose law knows nothing of this one's.
#[test]
fn a_missing_sprag_is_carried_by_the_others() {
    let clutch = clutch("huang2017-elastic");
    let curve = curve(&clutch);
    let gone = GivenSprag { index: 0, missing: true, ..GivenSprag::default() };
    let shared = at(&clutch, &Sharing { given: vec![gone], ..Sharing::default() }, &curve, 30.0);
    let sum: f64 = shared.loads.iter().map(|l| l.torque_nm).sum();
    assert!(
        (sum / 30.0 - 1.0).abs() < 1e-9 && shared.loads[0].normal_inner_n == 0.0 && shared.carrying() == 11
    );
    println!("{:?}", shared.shares());
    // Every other one missing is the clutch of six sprags, to what the law of twelve has of the rings between them.
    let given = (0..12)
        .step_by(2)
        .map(|index| GivenSprag { index, missing: true, ..GivenSprag::default() })
        .collect();
    let half = at(&clutch, &Sharing { given, ..Sharing::default() }, &curve, 30.0);
    let mut six = clutch.clone();
    six.sprags.count = 6;
    let exact = WedgeCurve::build(&six, &six.profile().unwrap(), 0.0).unwrap().at_torque(30.0).unwrap();
    println!(
        "windup {} {}, N {} {}",
        half.windup_rad, exact.windup_rad, half.loads[1].normal_inner_n, exact.normal_inner_n
    );
    assert!((half.windup_rad / exact.windup_rad - 1.0).abs() < 2e-3);
}

/// Ring under point forces against finite elements (tests/reference/ring_influence.py), thick and thin, inner and outer.
#[test]
fn rings_under_point_forces_agree_with_finite_elements() {
    let steel = Material { youngs_modulus_pa: 206e9, poisson_ratio: 0.3, density_kg_m3: 7850.0 };
    let text =
        std::fs::read_to_string(format!("{}/tests/reference/ring_influence.csv", env!("CARGO_MANIFEST_DIR")))
            .unwrap();
    let mut worst = [0.0_f64; 4];
    for line in text.lines().skip(1) {
        let f: Vec<&str> = line.split(',').collect();
        let number = |k: usize| f[k].parse::<f64>().unwrap();
        let (track, other) = (1e-3 * number(1), 1e-3 * number(2));
        let race = match f[0] {
            "outer" => Race::outer(track, other, 6e-3, steel),
            _ => Race::inner(other, track, 6e-3, steel),
        };
        let influence = race.unwrap().influence();
        let forces: &[(f64, [f64; 2])] = match f[3] {
            "normal" => &[(0.0, [1e3, 0.0]), (180.0, [1e3, 0.0])],
            _ => &[(0.0, [0.0, 1e3]), (180.0, [0.0, 1e3]), (90.0, [0.0, -1e3]), (270.0, [0.0, -1e3])],
        };
        let mut moved = [0.0; 2];
        for (at, force) in forces {
            let g = influence.at((number(4) - at).to_radians());
            for row in [0, 1] {
                moved[row] += 1e6 * (g[row][0] * force[0] + g[row][1] * force[1]);
            }
        }
        // Of the largest displacement of that ring under that load.
        let scale = match (f[0], (number(2) - number(1)).abs() > 2.0, f[3]) {
            ("outer", true, "normal") => 25.0,
            ("outer", true, _) => 39.0,
            ("outer", false, "normal") => 4800.0,
            ("outer", false, _) => 5800.0,
            (_, true, "normal") => 9.3,
            (_, true, _) => 4.6,
            (_, false, "normal") => 730.0,
            (_, false, _) => 710.0,
        };
        let off = (moved[0] - number(5)).abs().max((moved[1] - number(6)).abs()) / scale;
        let which = usize::from(f[0] == "inner") * 2 + usize::from(scale > 100.0);
        worst[which] = worst[which].max(off);
    }
    println!("outer thick, thin, inner thick, thin: {worst:?}");
    assert!(worst.iter().all(|w| *w < 0.02), "{worst:?}");
}

/// N unlike sprags cost no more than 1.5 N curves.
#[test]
fn sixty_sprags_cost_less_than_ninety_curves() {
    let mut clutch = clutch("huang2017-elastic");
    clutch.sprags.count = 60;
    let profile = clutch.profile().unwrap();
    let mut least = [f64::INFINITY; 2];
    for seed in 1..4 {
        let started = std::time::Instant::now();
        let curve = WedgeCurve::build(&clutch, &profile, 0.0).unwrap();
        let built = started.elapsed().as_secs_f64();
        let sharing = Sharing {
            seed,
            size_within_m: 5e-6,
            start: Standing::Caged,
            stiffness_n_per_m: Some(1e8),
            ..Sharing::default()
        };
        let started = std::time::Instant::now();
        let shared = at(&clutch, &sharing, &curve, 0.1 * curve.end_torque_nm());
        let solved = started.elapsed().as_secs_f64();
        println!("curve {:.1} ms, 60 sprags {:.1} ms, {} steps", 1e3 * built, 1e3 * solved, shared.steps);
        least = [least[0].min(built), least[1].min(solved)];
    }
    assert!(least[1] < 90.0 * least[0]);
}

/// What the command answers: figures that agree with one another, an exit code, refusals that name the key.
#[test]
fn the_answer_holds_together() {
    let path = format!("{}/designs/unlike-sprags.toml", env!("CARGO_MANIFEST_DIR"));
    let design = Design::read(path.as_ref()).unwrap();
    let answer = design.sharing(None).unwrap();
    let turned = answer.turned.as_ref().unwrap();
    assert_eq!(turned.len(), 12);
    for s in turned {
        let shares = s.shares();
        assert!((shares.iter().sum::<f64>() / shares.len() as f64 - 1.0).abs() < 1e-12);
        assert!((s.torque_nm / answer.torque_nm - 1.0).abs() < 1e-9);
    }
    // The row of the check is the worst of the turn.
    let worst = turned.iter().map(|s| s.worst(|l| l.hertz_pa()).1).fold(0.0, f64::max);
    let (_, rows, _) =
        sprag_design::margin::static_margins(&design, sprag_design::margin::Capacities::Wanted).unwrap();
    let row = rows.iter().find(|r| r.code() == "sprag-hertz-nominal").unwrap();
    assert_eq!(row.demand.value(), Some(worst));
    let at = row.torque_capacity_nm.unwrap();
    let clutch = sprag_design::sharing::Turn::new(
        &design.clutch,
        design.sharing.as_ref().unwrap(),
        &sprag_design::margin::load_state(&design).unwrap().curve,
    )
    .at(at)
    .unwrap()
    .iter()
    .map(|s| s.worst(|l| l.hertz_pa()).1)
    .fold(0.0, f64::max);
    assert!((clutch / row.allowable - 1.0).abs() < 1e-4);
    // Without the table, and with axes that meet, nothing of it is there.
    let mut plain = design.clone();
    plain.sharing = None;
    plain.clutch.races.eccentricity = None;
    assert!(
        sprag_design::margin::static_margins(&plain, sprag_design::margin::Capacities::Wanted)
            .unwrap()
            .1
            .iter()
            .all(|r| !r.code().starts_with("sprag-"))
    );
    let text = std::fs::read_to_string(&path).unwrap();
    for (wrong, key) in [
        ("sprags = [ { number = 13, size_um = 5.0 } ]", "sharing.sprags[0].number"),
        (
            "sprags = [ { number = 2, size_um = 5.0 }, { number = 2, gap_um = 5.0 } ]",
            "sharing.sprags[1].number",
        ),
        ("sprags = [ { number = 2, ahead_deg = 15.0 } ]", "sharing.sprags[0].ahead_deg"),
        ("sprags = []\nazimuth_within_deg = 15.0", "sharing.azimuth_within_deg"),
        // Outlines of neighbours touch long before the sprags change places.
        ("sprags = [ { number = 2, ahead_deg = 10.0 } ]", "sharing.sprags[0].ahead_deg"),
        (
            "sprags = [ { number = 2, ahead_deg = 4.0 }, { number = 3, ahead_deg = -4.0 } ]",
            "sharing.sprags[0].ahead_deg",
        ),
        ("sprags = []\nazimuth_within_deg = 6.0", "sharing.azimuth_within_deg"),
    ] {
        let from = text.find("sprags = [\n").unwrap();
        let until = text[from..].find("\n]").unwrap() + from + 2;
        let changed = format!("{}{wrong}{}", &text[..from], &text[until..]);
        let error = Design::parse(&changed, "unlike").unwrap_err();
        assert!(error.problems().iter().any(|p| p.key == key), "{error}");
    }
    // What is allowed can be typed: a hair within it is taken, neighbours do not touch there.
    let from = text.find("sprags = [\n").unwrap();
    let until = text[from..].find("\n]").unwrap() + from + 2;
    let with = |given: &str| Design::parse(&format!("{}{given}{}", &text[..from], &text[until..]), "unlike");
    let refused = with("sprags = []\nazimuth_within_deg = 14.0").unwrap_err();
    let allowed = &refused.problems()[0].allowed;
    let most: f64 = allowed.split_whitespace().nth(2).unwrap().parse().unwrap();
    assert!((1.0..6.0).contains(&most), "{allowed}");
    assert!(with(&format!("sprags = []\nazimuth_within_deg = {}", most - 1e-3)).is_ok());
    assert!(with("sprags = [ { number = 2, ahead_deg = 4.0 }, { number = 3, ahead_deg = 4.0 } ]").is_ok());
    // Beside a sprag that is missing there is more room.
    let alone = "sprags = [ { number = 2, ahead_deg = 10.0 }, { number = 3, missing = true } ]";
    assert!(with(alone).is_ok());
}

/// What cannot be shared is told with its reason, not as a failure of the method.
#[test]
fn one_sprag_on_a_free_race_and_a_torque_lost_in_rounding_have_their_words() {
    let text =
        std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/designs/unlike-sprags.toml")).unwrap();
    let (from, rest) = (text.find("[sharing]").unwrap(), text.find("[sharing]").unwrap() + 9);
    let until = text[rest..].find("\n[").map_or(text.len(), |at| rest + at);
    let missing: Vec<String> = (2..=12).map(|i| format!("{{ number = {i}, missing = true }}")).collect();
    let of = |bearing: &str| {
        let table = format!("[sharing]\n{bearing}\nsprags = [ {} ]\n", missing.join(", "));
        Design::parse(&format!("{}{table}{}", &text[..from], &text[until..]), "one").unwrap()
    };
    let free = of("bearing_stiffness_n_per_um = 0.0");
    for torque in [1e-3, 5.0, 90.0] {
        let said = free.sharing(Some(torque)).unwrap().verdict();
        assert!(
            said.contains("no sprag opposite keeps it in its place") && !said.contains("0 Nm is carried"),
            "{said}"
        );
    }
    let held = of("");
    assert!(held.sharing(Some(5.0)).unwrap().turned.is_ok());
    let whole = Design::parse(&text, "whole").unwrap();
    let said = whole.sharing(Some(1e-9)).unwrap().verdict();
    assert!(said.contains("rounding hides it"), "{said}");
}

/// What the verdict says of sprags that fail is what their table says, whatever ends it.
#[test]
fn the_words_of_losses_are_those_of_their_table() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/designs/unlike-sprags.toml");
    let mut design = Design::read(path.as_ref()).unwrap();
    design.sharing.as_mut().unwrap().friction_within = 0.0;
    let rows = |answer: &SharingAnswer<'_>| -> Vec<String> {
        let json = serde_json::to_value(answer.envelope(0.0).body).unwrap();
        json["losses"]
            .as_array()
            .unwrap()
            .iter()
            .map(|row| row["verdict"].as_str().unwrap().to_owned())
            .collect()
    };
    let whole = design.sharing(Some(40.0)).unwrap();
    let (held, last) = (whole.losses.len() - 1, whole.losses.last().unwrap());
    assert!(held > 2 && rows(&whole)[..held].iter().all(|v| v == "held") && rows(&whole)[held] == "NOT HELD");
    assert!(last.left.is_ok() && last.slips.is_none(), "{last:?}");
    let many = format!(
        "; {held} may fail, each time the most pressed one, and the others still hold; after one more"
    );
    let verdict = whole.verdict();
    assert!(verdict.contains(&format!("{many}, the others would be pressed beyond that")), "{verdict}");
    assert_eq!(whole.may_be_lost(), Some(held));

    // The same with other ends of the last row, after many, one and none.
    let end = NotShared::End(4, EndReason::OffProfile);
    for (left, slips, known, said) in [
        (Err(NotShared::NoBalance), None, false, "is not known: no balance of their forces was found"),
        (Err(end), None, true, "the others would not carry it: sprag 5 comes to its end first"),
        (last.left.clone(), Some(2), true, "sprag 3 would slip"),
    ] {
        for count in [held, 1, 0] {
            let mut answer = whole.clone();
            answer.losses.drain(count..held);
            let row = answer.losses.last_mut().unwrap();
            (row.left, row.slips) = (left.clone(), slips);
            let verdict = answer.verdict();
            let borne = match count {
                0 => String::new(),
                1 => "; if the most pressed one failed, the others would still hold; ".to_owned(),
                _ => format!("; {count} may fail, "),
            };
            assert!(verdict.contains(&borne) && verdict.contains(said), "{count}: {verdict}");
            assert_eq!(verdict.contains("would still hold"), count == 1, "{verdict}");
            assert_eq!(answer.may_be_lost(), known.then_some(count), "{verdict}");
            let rows = rows(&answer);
            assert!(rows[..count].iter().all(|v| v == "held") && rows[count] != "held", "{rows:?}");
        }
    }

    // Friction between what the whole clutch and what the others need: they slip long before they are pressed.
    let needs = |shared: &Shared| shared.worst(|l| l.required_friction()).1;
    let [before, after] =
        [needs(&whole.turned.as_ref().unwrap()[0]), needs(whole.losses[0].left.as_ref().unwrap())];
    assert!(after > 1.005 * before, "{before} {after}");
    design.clutch.friction.static_ = 0.5 * (before + after);
    let smooth = design.sharing(Some(40.0)).unwrap();
    assert_eq!((smooth.may_be_lost(), rows(&smooth)), (Some(0), vec!["slips".to_owned()]));
    let verdict = smooth.verdict();
    assert!(
        verdict.contains("if the most pressed one failed, sprag") && verdict.contains("would slip"),
        "{verdict}"
    );
}

/// A balance that Newton's method does not find at once is approached from smaller torques: that a sprag ends first is told as that.
#[test]
fn a_loss_after_which_a_sprag_ends_is_not_called_unknown() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/designs/lift-off-inner.toml");
    let table = [("sharing".to_owned(), "{ seed = 1, size_within_um = 3 }".to_owned())];
    let design = Design::read(path.as_ref()).unwrap().with(&table, "lift-off-inner.toml").unwrap();
    let answer = design.sharing(Some(300.0)).unwrap();
    let last = answer.losses.last().unwrap();
    assert!(matches!(last.left, Err(NotShared::End(_, EndReason::OffProfile))), "{last:?}");
    assert_eq!(answer.may_be_lost(), Some(answer.losses.len() - 1));
}
