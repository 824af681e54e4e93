//! A life of loads: sums by hand, counting, chance, and what is refused.

use crate::program::*;
use sprag_design::answer::Answer;
use sprag_design::clutch::FatigueStrength;
use sprag_design::life::{INDENTING_PA, LifePlace};
use sprag_design::margin::{LIMITS, body_flanks_pa, load_state, margins, rings_pa};
use sprag_design::{Design, Settings};
use std::f64::consts::PI;

const FILE: &str = "designs/indexing-life.toml";

fn design(changes: &[(&str, &str)]) -> Design {
    let mut text = std::fs::read_to_string(FILE).unwrap();
    for (from, to) in changes {
        assert!(text.contains(from), "{from}");
        text = text.replace(from, to);
    }
    Design::parse(&text, FILE).unwrap_or_else(|error| panic!("{error}"))
}

const HISTORY: &str =
    "histories = [ { torque_history_csv = \"indexing-torque.csv\", times = 2e6 } ]   # a stroke\n";

const FIT: &str = "press_fit = { outer_interference_um = 25.0, housing_outside_radius_mm = 65.0 }   # H7/p6 or thereabouts\n";

fn of(life: &sprag_design::life::Life, place: LifePlace) -> f64 {
    life.used.iter().find(|u| u.place == place).unwrap().sum.unwrap()
}

#[test]
fn one_load_by_hand() {
    let design = design(&[(HISTORY, ""), (FIT, "")]);
    let answer = design.life().unwrap();
    let life = &answer.life;
    let state = load_state(&design).unwrap();
    let p = state.curve.at_torque(600.0).unwrap();
    let part = |pa: f64| (pa / 4.2e9).powf(20.0 / 3.0) / 1e6;
    let near = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-12, "{a} {b}");
    near(of(life, LifePlace::SpragInside), 2e3 * part(p.hertz_inner_pa));
    near(of(life, LifePlace::SpragOutside), 2e3 * part(p.hertz_outer_pa));
    // A place of the track is met as often as sprags' contacts, with their widths, cover it.
    let [load] = life.loads.as_slice() else { panic!("{:?}", life.loads) };
    let cover = 22.0 * (load.walk_m[0] + 2.0 * p.half_width_inner_m)
        / (2.0 * PI * design.clutch.races.inner_radius_m);
    assert!((load.passes[0] / cover - 1.0).abs() < 0.02, "{} {cover}", load.passes[0]);
    near(of(life, LifePlace::InnerTrack), 2e3 * load.passes[0] * part(p.hertz_inner_pa));
    // Rings: half the stress is amplitude, half mean; the inner one is pressed, and its mean takes nothing.
    let [inner, outer] = rings_pa(&design, &state, &p).map(|pa| 0.5 * pa);
    near(of(life, LifePlace::OuterRing), 2e3 * (outer / (1.0 - outer / 2.2e9) / 450e6).powi(9) / 1e7);
    near(of(life, LifePlace::InnerRing), 2e3 * (inner / 450e6).powi(9) / 1e7);
    near(life.indentation[0], (INDENTING_PA / p.hertz_inner_pa).powi(2));
    // The stress is that of check's row with bending.
    let rows = margins(&design, &[], &Settings::default()).unwrap();
    assert!(LIMITS.iter().any(|l| l.code == "hoop-outer-bending"));
    let row = rows.iter().find(|r| r.code() == "hoop-outer-bending").unwrap();
    near(row.demand_in_unit().unwrap() * 1e6, 2.0 * outer);
}

/// Below the case: Johnson's shear on the axis of the contact at that depth, a class of damage of its own beside pitting, which stays.
#[test]
fn the_core_below_the_case_by_hand() {
    let core = ("pitting = {", "core = { shear_mpa = 500.0, cycles = 1e7, exponent = 9.0 }\npitting = {");
    let case = ("[limits]", "[limits]\ncase_depth_mm = 0.7");
    let (plain, cased) = (design(&[(HISTORY, "")]), design(&[(HISTORY, ""), core, case]));
    let [before, after] = [&plain, &cased].map(|d| d.life().unwrap().life);
    let p = load_state(&cased).unwrap().curve.at_torque(600.0).unwrap();
    let length_m = cased.clutch.contact_length_m();
    let (z, a) = (0.7e-3, 2.0 * p.normal_outer_n / (PI * length_m * p.hertz_outer_pa));
    assert!(z > 0.79 * a);
    let shear = p.hertz_outer_pa / a * (z - z * z / a.hypot(z));
    let part = (shear / 500e6).powi(9) / 1e7;
    let near = |found: f64, want: f64| assert!((found / want - 1.0).abs() < 1e-3, "{found} {want}");
    near(of(&after, LifePlace::SpragCoreOutside), 2e3 * part);
    near(of(&after, LifePlace::OuterCore), 2e3 * after.loads[0].passes[1] * part);
    assert!(of(&after, LifePlace::SpragCoreInside) > of(&after, LifePlace::SpragCoreOutside));
    for used in &before.used {
        assert_eq!(Some(used), after.used.iter().find(|u| u.place == used.place));
    }
    assert_eq!(after.used.len(), before.used.len() + 4);
    let text = std::fs::read_to_string(FILE).unwrap().replace(core.0, core.1);
    let refused = Design::parse(&text, FILE).unwrap_err().to_string();
    assert!(refused.contains("limits.case_depth_mm"), "{refused}");
}

/// A fit shifts the mean of a ring's stress, not its swing, and no load takes nothing.
#[test]
fn a_press_fit_is_there_before_the_load() {
    let with = |fit_um: &str, torque: &str| {
        let fit = format!("outer_interference_um = {fit_um}");
        let changes = [
            (HISTORY, ""),
            ("outer_interference_um = 25.0", fit.as_str()),
            ("{ torque_nm = 600.0", torque),
            // No share of the mean.
            ("ultimate_mpa = 2200.0", "ultimate_mpa = 1e9"),
        ];
        of(&design(&changes).life().unwrap().life, LifePlace::OuterRing)
    };
    let (slight, strong) = (with("10.0", "{ torque_nm = 600.0"), with("40.0", "{ torque_nm = 600.0"));
    // The fit closes the race gap a little, which is a per cent of force and a ninth power of that.
    assert!((strong / slight - 1.0).abs() < 0.1, "{slight} {strong}");
    assert!(with("40.0", "{ torque_nm = 0.01") < 1e-20 * slight);
    // What it leaves at rest is compression, which the load takes off first: less of the strength goes to the mean.
    let mean = |fit_um: &str| {
        let fit = format!("outer_interference_um = {fit_um}");
        let changes = [(HISTORY, ""), ("outer_interference_um = 25.0", fit.as_str())];
        of(&design(&changes).life().unwrap().life, LifePlace::OuterRing)
    };
    assert!(mean("40.0") < mean("10.0"));
}

#[test]
fn a_load_that_slips_in_the_mean_is_not_held() {
    let slips = design(&[("static = 0.11 ", "static = 0.07 "), ("kinetic = 0.085", "kinetic = 0.069")]);
    let answer = slips.life().unwrap();
    assert!(
        !answer.life.held() && answer.verdict().starts_with("NOT HELD: it slips at 600"),
        "{}",
        answer.verdict()
    );
    // A ring whose largest stress is its strength is broken by one load.
    let breaks = design(&[(HISTORY, ""), (FIT, ""), ("ultimate_mpa = 2200.0", "ultimate_mpa = 150.0")]);
    assert!(of(&breaks.life().unwrap().life, LifePlace::OuterRing) >= 2e3);
}

/// The verdict is that of everything that is known, and names what is not.
#[test]
fn the_verdict_tells_of_indentation_of_slips_and_of_what_is_not_known() {
    let said = |changes: &[(&str, &str)]| {
        let design = design(changes);
        let answer = design.life().unwrap();
        (answer.life.held(), answer.verdict(), serde_json::to_value(answer.envelope(0.0).body).unwrap())
    };
    let (held, verdict, body) = said(&[]);
    assert!(held && verdict.starts_with("HELD: pitting") && !verdict.contains("not known"), "{verdict}");
    assert_eq!(body["not_known"], serde_json::json!([]));
    // Strong enough for one of 1100 Nm, which presses the inner contact with more than 4000 MPa.
    let one = [
        ("{ torque_nm = 600.0, engagements = 2e3 }", "{ torque_nm = 1100.0, engagements = 1 }"),
        ("static = 0.11 ", "static = 0.20 "),
    ];
    let (held, verdict, body) = said(&one);
    assert!(
        !held && verdict.starts_with("NOT HELD: 1100 Nm indents a contact in its first engagement; "),
        "{verdict}"
    );
    assert!(!verdict.contains("decides"), "{verdict}");
    assert_eq!(body["indents"], true);
    // A thousand of them pit it too, which takes longer than the first.
    let thousand = ("{ torque_nm = 600.0, engagements = 2e3 }", "{ torque_nm = 1100.0, engagements = 1e6 }");
    let (_, verdict, body) = said(&[thousand, one[1]]);
    let used_up = |place: &serde_json::Value| place["lives"].as_f64().is_some_and(|lives| lives < 1.0);
    assert!(body["places"].as_array().unwrap().iter().any(used_up), "{body}");
    assert!(
        verdict.starts_with("NOT HELD: 1100 Nm indents a contact in its first engagement; "),
        "{verdict}"
    );
    let (held, verdict, _) = said(&[("slips_allowed = 600", "slips_allowed = 100")]);
    assert!(
        !held && verdict.starts_with("NOT HELD: 133 slips by chance are expected in the life, 100 are"),
        "{verdict}"
    );
    let text = std::fs::read_to_string(FILE).unwrap();
    let line = |key: &str| text.lines().find(|line| line.starts_with(key)).unwrap().to_owned();
    let (held, verdict, body) = said(&[(&line("rings"), ""), (&line("slips_allowed"), "")]);
    assert!(held && verdict.starts_with("HELD as far as is known: pitting of the sprags"), "{verdict}");
    assert!(
        verdict.contains("not known: fatigue of the races as rings") && verdict.contains("133 slips"),
        "{verdict}"
    );
    assert_eq!(body["not_known"], serde_json::json!(["fatigue-inner-ring", "fatigue-outer-ring"]));
    let (_, verdict, _) = said(&[(&line("rings"), ""), (&line("sprags = {"), ""), (&line("pitting"), "")]);
    assert!(verdict.starts_with("NOT KNOWN: no strength is given"), "{verdict}");
}

#[test]
fn the_contacts_walk_as_far_as_races_and_sprags_roll() {
    // A leads B by beta; what both contacts walk on their races is the windup and what beta grows by.
    for file in [FILE, "designs/huang2017-multi-arc.toml", "designs/starter.toml"] {
        let design = Design::read(file.as_ref()).unwrap();
        let state = load_state(&design).unwrap();
        let service = Default::default();
        for share in [0.1, 0.4, 0.8] {
            let torque = share * state.curve.end_torque_nm();
            let load = sprag_design::life::effect(&design, &service, &state, torque, 1.0);
            let p = load.state.unwrap();
            let beta = |n: f64| state.curve.closure_at_normal(n).unwrap().1.beta.v;
            let races = &design.clutch.races;
            let walked = load.walk_m[0] / races.inner_radius_m + load.walk_m[1] / races.outer_radius_m;
            let want = p.windup_rad + beta(p.normal_inner_n) - state.curve.touch().beta.v;
            // Radii under load differ from those at rest by what yields.
            assert!((walked / want - 1.0).abs() < 0.01, "{file} {share}: {walked} {want}");
        }
    }
}

#[test]
fn loads_add_up_and_a_history_is_its_peaks() {
    let twice = design(&[
        (HISTORY, ""),
        (
            "loads = [ { torque_nm = 600.0, engagements = 2e3 } ]",
            "loads = [ { torque_nm = 600.0, engagements = 1.5e3 }, { torque_nm = 600.0, engagements = 5e2 } ]",
        ),
    ]);
    let once = design(&[(HISTORY, "")]);
    let (a, b) = (once.life().unwrap().life, twice.life().unwrap().life);
    for place in LifePlace::ALL.into_iter().filter(|place| !place.is_core()) {
        assert!((of(&a, place) / of(&b, place) - 1.0).abs() < 1e-12);
    }
    // The stroke peaks at 480 and 400 Nm, and at 280 Nm, above half of 480 too: three engagements each time; its swings bend the rings.
    let history =
        design(&[("loads = [ { torque_nm = 600.0, engagements = 2e3 } ]            # a jam\n", "")]);
    let life = history.life().unwrap().life;
    let loads: Vec<(f64, f64)> = life.loads.iter().map(|l| (l.torque_nm, l.engagements)).collect();
    assert_eq!(loads.iter().map(|l| l.1).collect::<Vec<_>>(), [2e6, 2e6, 2e6]);
    for ((class, _), peak) in loads.iter().zip([480.0, 400.0, 280.0]) {
        assert!(*class >= peak && *class < peak + 4.8 + 1e-9, "{class} {peak}");
    }
    let rings = life.used.iter().find(|u| u.place == LifePlace::OuterRing).unwrap();
    assert!(rings.cycles > 3e6 && rings.mostly_nm == 480.0, "{rings:?}");
    // Where the sprags always stand at the same places, a track bears what the sprag bears.
    let same = design(&[("friction_scatter = 0.10", "same_places = true\nfriction_scatter = 0.10")])
        .life()
        .unwrap()
        .life;
    assert_eq!(of(&same, LifePlace::InnerTrack), of(&same, LifePlace::SpragInside));
}

/// A scenario that goes on for hours is a load from the least to the largest torque that the clutch carries in it, once a period.
#[test]
fn a_swing_is_an_engagement_in_each_period() {
    const LOADS: &str = "loads = [ { torque_nm = 600.0, engagements = 2e3 } ]            # a jam\n";
    let scene = "\n[[scenarios]]\nname = \"hum\"\nkind = \"torsional-excitation\"\npreload_nm = 300.0\namplitude_nm = 30.0\n\
                 frequency_hz = 20.0\nabutment_stiffness_nm_per_rad = 50.0\nduration_s = 0.1\n";
    let with = |loads: &str, scene: &str| {
        let text = std::fs::read_to_string(FILE).unwrap().replace(HISTORY, "").replace(LOADS, loads);
        Design::parse(&format!("{text}{scene}"), FILE)
    };
    let swings = with("swings = [ { scenario = \"hum\", hours = 50.0 } ]\n", scene).unwrap();
    let answer = swings.life().unwrap();
    let [swung] = answer.swung.as_slice() else { panic!("{:?}", answer.swung) };
    let [load] = answer.life.loads.as_slice() else { panic!("{:?}", answer.life.loads) };
    assert_eq!((load.torque_nm, load.engagements), (swung.load.torque_nm, 20.0 * 50.0 * 3600.0));
    // On a soft abutment the swing of the torque goes through the clutch, more or less of it by what the races do.
    let (low, high) = (swung.load.from_nm, swung.load.torque_nm);
    assert!(low > 200.0 && low < 299.0 && high > 301.0 && high < 400.0, "{low} {high}");
    assert!((0.5 * (low + high) - 300.0).abs() < 1.0, "{low} {high}");
    // The rings swing between both, so that they bear more than from nothing.
    let same = format!("loads = [ {{ torque_nm = {high:?}, engagements = {:?} }} ]\n", load.engagements);
    let from_nothing = with(&same, scene).unwrap();
    let from_nothing = from_nothing.life().unwrap();
    for place in LifePlace::ALL.into_iter().filter(|place| !place.is_core()) {
        let [swing, whole] = [&answer, &from_nothing].map(|a| of(&a.life, place));
        assert!(if place.is_contact() { swing == whole } else { swing < whole }, "{place:?} {swing} {whole}");
    }
    let text = |answer: &sprag_design::answer::life::LifeAnswer<'_>| answer.text(Default::default());
    assert!(!text(&answer).contains("Not counted: hum") && text(&from_nothing).contains("Not counted: hum"));
    // What does not swing is refused with what does, what does not roll on by name.
    let said = with("swings = [ { scenario = \"hum-\", hours = 1.0 } ]\n", scene).unwrap_err().to_string();
    assert!(said.contains("allowed: hum"), "{said}");
    let wild = scene.replace("amplitude_nm = 30.0", "amplitude_nm = 30000.0");
    let wild = with("swings = [ { scenario = \"hum\", hours = 1.0 } ]\n", &wild).unwrap();
    assert!(wild.life().unwrap_err().to_string().contains("hum does not roll on and on"));
}

/// The body of a sprag: the mean of both flanks is the strut force over the section, the largest compression that of check's row,
/// and a section that is moved across by d is bent by F d more. What the file does not bound or give is not known.
#[test]
fn the_body_of_a_sprag_swings_with_the_strut_force() {
    const STRENGTH: &str =
        "sprags = { amplitude_mpa = 400.0, cycles = 1e7, exponent = 8.0, ultimate_mpa = 2200.0 }";
    let with = |more: &[(&str, &str)]| design(&[&[(HISTORY, "")], more].concat());
    let drawn = with(&[]);
    assert!(std::fs::read_to_string(FILE).unwrap().contains(STRENGTH));
    let state = load_state(&drawn).unwrap();
    let p = state.curve.at_torque(600.0).unwrap();
    let [front, rear] = body_flanks_pa(&drawn, &state, &p).unwrap();
    let force = p.normal_inner_n.hypot(p.normal_inner_n * p.tan_omega);
    // As run, warm.
    let flanks = drawn.clutch.sprags.flanks.unwrap();
    let (width, length) = (flanks.rear_m + flanks.front_m, drawn.clutch.sprags.length_m);
    let near = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-9, "{a} {b}");
    near(0.5 * (front + rear), -force / (width * length));
    let rows = margins(&drawn, &[], &Settings::default()).unwrap();
    let row = rows.iter().find(|r| r.code() == "body-yield").unwrap();
    near(row.demand_in_unit().unwrap() * 1e6, -front.min(rear));
    let moved = with(&[("rear_mm = 2.95, front_mm = 2.30", "rear_mm = 2.85, front_mm = 2.40")]);
    let [front_there, rear_there] = body_flanks_pa(&moved, &state, &p).unwrap();
    let by = moved.clutch.sprags.flanks.unwrap().front_m - flanks.front_m;
    near((rear_there - front_there) - (rear - front), -12.0 * force * by / (width * width * length));
    // From nothing to that and back: half is amplitude; a pressed mean takes nothing.
    let strength = FatigueStrength { amplitude_pa: 400e6, cycles: 1e7, exponent: 8.0, ultimate_pa: 2.2e9 };
    let worst = strength.part(0.0, front).max(strength.part(0.0, rear));
    near(of(&drawn.life().unwrap().life, LifePlace::SpragBody), 2e3 * worst);
    let not_given = with(&[(STRENGTH, "")]);
    let not_given = not_given.life().unwrap();
    assert!(not_given.life.not_known().eq([LifePlace::SpragBody]));
    assert!(not_given.verdict().contains("add sprags = {"), "{}", not_given.verdict());
}

#[test]
fn goodman_at_its_limits() {
    let ring = FatigueStrength { amplitude_pa: 300e6, cycles: 1e7, exponent: 8.0, ultimate_pa: 2e9 };
    assert_eq!(ring.part(-300e6, 300e6), 1e-7);
    assert_eq!(ring.part(2e9, 2.1e9), 1.0);
    assert!(ring.part(0.0, 600e6) > ring.part(-600e6, 0.0));
    assert_eq!(ring.part(-600e6, 0.0), 1e-7);
}

#[test]
fn chance_rises_with_scatter_and_torque_beyond_the_end_is_lost() {
    let of = |friction: &str, torque: &str| {
        let changed = design(&[
            ("friction_scatter = 0.10", &format!("friction_scatter = {friction}")),
            ("torque_scatter = 0.05", &format!("torque_scatter = {torque}")),
        ]);
        changed.life().unwrap().life
    };
    let slips = |f: &str, t: &str| of(f, t).slips.unwrap();
    assert!(slips("0.05", "0.0") < slips("0.10", "0.0") && slips("0.10", "0.0") < slips("0.20", "0.0"));
    assert_eq!(of("0.0", "0.0").slips, None);
    let lost = design(&[("torque_nm = 600.0, engagements", "torque_nm = 60000.0, engagements")]);
    let answer = lost.life().unwrap();
    assert!(!answer.life.held() && answer.verdict().starts_with("NOT HELD: the clutch does not carry 6"));
    assert!(answer.life.loads[0].slip.unwrap() > 1.0 - 1e-12);
}

#[test]
fn the_command_answers_and_refuses() {
    let out = run(&["life", FILE, "--json"]);
    let told = json(&out);
    assert_eq!(told["held"], out.status.code() == Some(0));
    assert_eq!(told["places"].as_array().unwrap().len(), 7);
    assert!(told["expected_slips"].as_f64().unwrap() >= 0.0);
    let out = run(&["life", "designs/starter.toml"]);
    assert_eq!(out.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&out.stderr).contains("[life]"));
    let refused = |change: (&str, &str), says: &str| {
        let text = std::fs::read_to_string(FILE).unwrap();
        assert!(text.contains(change.0));
        let error = Design::parse(&text.replace(change.0, change.1), FILE).unwrap_err().to_string();
        let all: String = Design::parse(&text.replace(change.0, change.1), FILE)
            .unwrap_err()
            .problems()
            .iter()
            .map(|p| format!("{} {} {} {}\n", p.key, p.found, p.allowed, p.help))
            .collect();
        assert!(all.contains(says), "{error}\n{all}");
    };
    refused(("engagements = 2e3", "engagements = -1"), "above 0");
    refused(("engagements = 2e3", "engagement = 2e3"), "engagements");
    refused(("\"indexing-torque.csv\"", "\"nowhere.csv\""), "no such file");
    refused(("\"indexing-torque.csv\"", "\"speed-ramp.csv\""), "time_s,torque_nm");
    refused(("friction_scatter = 0.10", "friction_scatter = 1.5"), "1");
    refused(("friction_scatter = 0.10", "friction_scatter = 0.0"), "where the torque scatters");
    let text = std::fs::read_to_string(FILE).unwrap();
    let cut = text.find("loads = ").unwrap();
    let error = Design::parse(&text[..cut], FILE).unwrap_err();
    assert!(error.problems().iter().any(|p| p.key == "life"), "{error}");
}
