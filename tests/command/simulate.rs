//! `simulate` from outside, on the paper's clutch: verdicts, figures, keys, files, exit codes.

use serde_json::Value;
use sprag_design::answer::simulation::SimulationSettings;
use sprag_design::answer::{Answer, Provenance};
use sprag_design::{Design, Scenario};
use std::path::PathBuf;
use std::process::{Command, Output};
use std::sync::LazyLock;

const DESIGN: &str = "designs/huang2017-multi-arc.toml";

fn simulate(file: &str, scenario: &str, more: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_sprag-design"));
    command.env("NO_COLOR", "1").args(["simulate", file, "--scenario", scenario]).args(more).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

fn json(file: &str, scenario: &str, more: &[&str]) -> Value {
    let output = simulate(file, scenario, &[&["--json"], more].concat());
    assert_eq!(output.status.code(), Some(0), "{scenario}: {}", text(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

fn number(value: &Value, key: &str) -> f64 {
    value[key].as_f64().unwrap_or_else(|| panic!("{key} in {value}"))
}

/// The design with further text at its end, in a file of its own that is removed at the end.
struct Changed(PathBuf);

impl Changed {
    fn new(name: &str, tail: &str) -> Self {
        let path = std::env::temp_dir().join(format!("sprag-simulate-{name}-{}.toml", std::process::id()));
        std::fs::write(&path, std::fs::read_to_string(DESIGN).unwrap() + tail).unwrap();
        Self(path)
    }
    fn path(&self) -> &str {
        self.0.to_str().unwrap()
    }
}

impl Drop for Changed {
    fn drop(&mut self) {
        let _ = std::fs::remove_file(&self.0);
    }
}

// The paper's nine statements, section 4.1: no slip, offset to overrunning, offset to engaging. theta_bi at the
// end from an independent script (Python, constraint-based), with the tolerance to which it is known.
#[test]
fn the_paper_s_nine_statements_come_out() {
    let known = |theta: f64, within: f64| Some((theta, within));
    for (scenario, verdict, theta) in [
        ("high-6", "sticks", known(-0.010152, 1e-4)),
        ("high-8", "slips-overrunning", known(-0.010367, 1e-3)),
        ("high-10", "slips-overrunning", known(-0.0072356, 1e-3)),
        ("low-6", "sticks", None),
        ("low-8", "sticks", None),
        ("low-10", "sticks", None),
        ("low-6-mu082", "sticks", None),
        ("low-8-mu082", "slips-engaging", None),
        ("low-10-mu082", "slips-engaging", None),
    ] {
        let answer = json(DESIGN, scenario, &[]);
        assert_eq!(answer["verdict"], verdict, "{scenario}");
        assert_eq!(answer["stop"], "finished");
        let offset = number(&answer, "offset_rad");
        match verdict {
            "slips-overrunning" => assert!(offset > 1e-4, "{offset}"),
            "slips-engaging" => assert!(offset < -1e-5, "{offset}"),
            _ => assert!(offset.abs() < 1e-12, "{offset}"),
        }
        if let Some((theta, within)) = theta {
            let found = number(&answer, "theta_inner_end_rad");
            assert!((found / theta - 1.0).abs() < within, "{scenario}: {found} against {theta}");
        }
        assert!(number(&answer, "error_estimate") < 1e-6);
        assert_eq!(answer["tolerance_reached"], true);
    }
}

#[test]
fn the_promised_keys_are_there_and_consistent() {
    let a = json(DESIGN, "high-10", &[]);
    for key in ["tool", "version", "design", "design_hash", "verdict", "stop", "method", "scenario"] {
        assert!(a[key].as_str().is_some_and(|s| !s.is_empty()), "{key}");
    }
    for key in [
        "run_time_s",
        "theta_inner_end_rad",
        "theta_outer_end_rad",
        "offset_rad",
        "contact_lost_s",
        "peak_tan_demand",
        "contact_margin",
        "normal_min_n",
        "normal_max_n",
        "hertz_peak_mpa",
        "events",
        "steps",
        "rhs_evaluations",
    ] {
        assert!(a[key].is_number(), "{key}: {}", a[key]);
    }
    // Rolling would open the contact: no friction suffices.
    assert!(a.get("slip_margin").is_some_and(|margin| margin.is_null()));
    for key in
        ["theta_inner_rad", "theta_outer_rad", "offset_rad", "net_slip_mm", "normal_min_n", "slip_margin"]
    {
        assert!(a["error_estimates"][key].is_number(), "{key}");
    }
    assert_eq!(a["error_estimate"], a["error_estimates"]["theta_inner_rad"]);
    for key in ["tan_inner", "tan_outer", "normal_min_n", "normal_max_n", "normal_outer_max_n"] {
        let extreme = &a["extremes"][key];
        assert!(number(extreme, "at_moved_s") >= 0.0 && number(extreme, "at_s") > 0.0, "{key}");
        assert!(number(&a["error_estimates"], key) <= 1e-6 * number(extreme, "value").max(1000.0), "{key}");
    }
    let larger =
        number(&a["extremes"]["tan_inner"], "value").max(number(&a["extremes"]["tan_outer"], "value"));
    assert_eq!(number(&a, "peak_tan_demand"), larger);
    assert_eq!(a["required_static_friction_by"], "bisection");
    let inner = &a["slip"]["inner"];
    // Slip at 10 Nm lasts 2.77 ms with the time in which the contact is open.
    let slipping = number(inner, "time_s") + number(&a, "contact_lost_s");
    assert!((slipping - 2.77e-3).abs() < 1e-5, "{slipping}");
    assert!(number(inner, "distance_mm") >= number(inner, "net_mm"));
    assert!(a["required_static_friction"].is_null(), "contact opens: no friction suffices");
    assert_eq!(number(&a, "normal_min_n"), 0.0);
    let left_out = a["left_out"].as_array().unwrap();
    for word in
        ["wedge one after another", "unequal sharing", "eccentric", "contact damping", "radial inertia"]
    {
        let entry = left_out.iter().find(|e| e["term"].as_str().unwrap().contains(word));
        assert!(entry.is_some_and(|e| !e["cost"].as_str().unwrap().is_empty()), "{word}");
    }
    let stuck = json(DESIGN, "low-6-mu082", &[]);
    let needed = number(&stuck, "required_static_friction");
    assert_eq!(stuck["required_static_friction_by"], "rolling");
    // The paper's 0.082 lies between the demands at 6 and at 10 Nm.
    assert!((needed - 0.0818).abs() < 1e-4 && needed < 0.082, "{needed}");
    assert!((number(&stuck, "slip_margin") - (0.082 / needed - 1.0)).abs() < 1e-12);
}

#[test]
fn files_hold_the_history_and_a_page() {
    let base = std::env::temp_dir().join(format!("sprag-simulate-files-{}", std::process::id()));
    let (csv, html) = (base.with_extension("csv"), base.with_extension("html"));
    let output =
        simulate(DESIGN, "high-10", &["--csv", csv.to_str().unwrap(), "--report", html.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert!(text(&output.stdout).starts_with("high-10: slips-overrunning"));
    let mut reader = csv::Reader::from_path(&csv).unwrap();
    let header = reader.headers().unwrap().clone();
    let column = |name: &str| header.iter().position(|h| h == name).unwrap_or_else(|| panic!("{name}"));
    let [time, n, mode, theta, slip] =
        ["time_s", "normal_inner_n", "mode_inner", "theta_inner_rad", "slip_inner_mm"].map(column);
    let [t, tan] = ["tangential_inner_n", "tan_inner"].map(column);
    for name in ["alpha_rad", "tan_outer", "slip_velocity_inner_m_per_s", "hertz_inner_mpa", "torque_nm"] {
        column(name);
    }
    let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    let value = |row: &csv::StringRecord, i: usize| row[i].parse::<f64>().unwrap();
    assert_eq!(rows.len(), 1200);
    assert!(rows.windows(2).all(|w| value(&w[0], time) < value(&w[1], time)));
    assert!(rows.iter().all(|r| value(r, n) >= 0.0));
    // |T|/N beside T, whose sign turns where the inner race runs ahead.
    let closed = rows.iter().filter(|r| !r[tan].is_empty());
    assert!(closed.clone().all(|r| (value(r, tan) * value(r, n) - value(r, t).abs()).abs() < 1e-6));
    assert!(closed.filter(|r| &r[mode] == "slip+").all(|r| value(r, t) < 0.0));
    assert!(["stick", "slip+", "open"].iter().all(|m| rows.iter().any(|r| &r[mode] == *m)));
    let answer = json(DESIGN, "high-10", &[]);
    let last = rows.last().unwrap();
    assert!((value(last, time) - 0.3).abs() < 1e-12);
    assert!((value(last, theta) - number(&answer, "theta_inner_end_rad")).abs() < 1e-12);
    assert!((value(last, slip) - number(&answer["slip"]["inner"], "net_mm")).abs() < 1e-12);
    let page = std::fs::read_to_string(&html).unwrap();
    assert!(page.matches("<svg").count() >= 8 && page.contains("id=\"results\"") && !page.contains("NaN"));
    assert!(page.contains(">T/N<") && page.contains("±μ static") && page.contains("Net slip, µm"));
    assert!(!page.contains("Angular speed"), "a swing has its angles");
    let _ = (std::fs::remove_file(csv), std::fs::remove_file(html));
}

/// Answer and page of a scene of the bench.
fn with_page(scenario: &str) -> (Value, String) {
    let html = format!("sprag-simulate-{scenario}-{}.html", std::process::id());
    let html = std::env::temp_dir().join(html);
    let answer = json(BENCH, scenario, &["--report", html.to_str().unwrap()]);
    let page = std::fs::read_to_string(&html).unwrap();
    std::fs::remove_file(html).unwrap();
    (answer, page)
}

static ENGAGEMENT: LazyLock<(Value, String)> = LazyLock::new(|| with_page("engagement"));
static SPEED_RAMP: LazyLock<(Value, String)> = LazyLock::new(|| with_page("speed-ramp"));

#[test]
fn pages_say_what_they_do_not_draw_and_keep_short_ticks() {
    for (scenario, words) in [
        (
            "engagement",
            &["Angular speed, rpm", "Angle, mrad", "Neither contact has slipped since the clutch engaged at"]
                [..],
        ),
        (
            "engagement-without-spring",
            &["Angle, rad", "The inner contact is open throughout", "does not engage"],
        ),
        ("speed-ramp", &["relative to the mean speed", "Net slip, mm", "largest at 0 ms"]),
        ("high-10-vernay", &["Beyond ±0.240 nothing is drawn"]),
    ] {
        let page = match scenario {
            "engagement" => &ENGAGEMENT.1,
            "speed-ramp" => &SPEED_RAMP.1,
            other => &with_page(other).1,
        };
        for word in words {
            assert!(page.contains(word), "{scenario}: {word}");
        }
        assert!(!page.contains("NaN"), "{scenario}");
    }
}

#[test]
fn a_question_that_makes_no_sense_is_code_2_and_says_what_would() {
    for (scenario, more, words) in [
        ("high-9", &[][..], &["high-8", "low-10-mu082"][..]),
        ("high-6", &["--tolerance", "1e-14"], &["1e-13 to 1e-3"]),
        ("high-6", &["--tolerance", "0.01"], &["1e-13 to 1e-3"]),
        ("high-6", &["--tolerance", "1e-8", "--method", "published"], &["--step"]),
        ("high-6", &["--band", "1e-4"], &["--method published"]),
        ("high-6", &["--method", "published", "--step", "1"], &["0.3 s"]),
        ("high-6", &["--method", "published", "--step", "1e-12"], &["1e-9 s or more"]),
        ("high-6", &["--step", "1e-12"], &["1e-9 s or more"]),
    ] {
        let output = simulate(DESIGN, scenario, more);
        assert_eq!(output.status.code(), Some(2), "{scenario} {more:?}");
        // miette wraps lines, at blanks or inside a name.
        let said = text(&output.stderr).replace(['\n', ' ', '│'], "");
        for word in words {
            assert!(said.contains(&word.replace(' ', "")), "{word} in {said}");
        }
        assert!(output.stdout.is_empty());
    }
}

#[test]
fn the_published_scheme_says_that_it_does_not_converge() {
    let quiet = json(DESIGN, "high-6", &["--method", "published"]);
    assert!(number(&quiet, "error_estimate") < 1e-5 && quiet["notes"].as_array().unwrap().is_empty());
    assert_eq!(quiet["method"], "published");
    let event = number(&json(DESIGN, "high-6", &[]), "theta_inner_end_rad");
    assert!((number(&quiet, "theta_inner_end_rad") - event).abs() < 1e-5);
    let wild = json(DESIGN, "high-10", &["--method", "published"]);
    assert!(wild["notes"][0].as_str().unwrap().contains("not converged"), "{}", wild["notes"]);
    assert!(number(&wild, "error_estimate") > 1e-4);
    assert_eq!(wild["verdict"], "at-threshold");
}

#[test]
fn a_smaller_step_or_tolerance_changes_nothing_that_was_promised() {
    let base = json(DESIGN, "high-10", &[]);
    for more in [&["--tolerance", "1e-10"][..], &["--step", "2e-5"]] {
        let other = json(DESIGN, "high-10", more);
        let moved = number(&other, "theta_inner_end_rad") - number(&base, "theta_inner_end_rad");
        assert!(moved.abs() < 1e-8, "{more:?}: {moved}");
        assert!(number(&other, "rhs_evaluations") > number(&base, "rhs_evaluations"));
    }
}

#[test]
fn a_preload_beyond_the_clutch_is_a_result() {
    let design =
        Changed::new("beyond", "\n[[scenarios]]\nname = \"beyond\"\nkind = \"static\"\ntorque_nm = 5000.0\n");
    // The table after [optimize] is a scenario like the others.
    let answer = json(design.path(), "beyond", &[]);
    assert_eq!((&answer["verdict"], &answer["stop"]), (&"overloaded".into(), &"no-start".into()));
    assert!(answer["reason"].as_str().unwrap().contains("5000 Nm"));
    assert!(answer["slip_margin"].is_null());
}

#[test]
fn equilibria_overrun_and_engagement_are_answered() {
    let design = Changed::new(
        "kinds",
        "\n[[scenarios]]\nname = \"hold\"\nkind = \"static\"\ntorque_nm = 16.8\n\
         \n[[scenarios]]\nname = \"run\"\nkind = \"overrun\"\nspeed_rpm = 0.0\noverrun_rpm = 100.0\n\
         friction = { static = 0.1, kinetic = 0.1 }\n\
         \n[[scenarios]]\nname = \"fast\"\nkind = \"overrun\"\nspeed_rpm = 8000.0\noverrun_rpm = 100.0\n\
         \n[[scenarios]]\nname = \"engage\"\nkind = \"engagement\"\nfree_run_rpm = 50.0\nreversing_torque_nm = 5.0\n\
         stop_stiffness_nm_per_rad = 1000.0\nbench_inertia_kg_m2 = 1.97e-4\nduration_s = 0.05\n",
    );
    let hold = json(design.path(), "hold", &[]);
    assert_eq!((&hold["verdict"], &hold["method"]), (&"sticks".into(), &"equilibrium".into()));
    // tan omega at 16.8 Nm, static_multi_arc.csv.
    assert!((number(&hold, "required_static_friction") - 0.0809).abs() < 1e-3);
    let row = &hold["equilibrium"];
    assert!(number(row, "relative_error") < 1e-11, "{row}");
    assert!((number(row, "torque_nm") - 16.8).abs() < 1e-12 && number(row, "windup_rad") > 0.0, "{row}");
    let run = json(design.path(), "run", &[]);
    assert_eq!(run["verdict"], "slips-overrunning");
    // The drag torque from which alpha_max was found comes back at mu = 0.1.
    assert!((number(&run, "drag_torque_nm") - 0.0166).abs() < 2e-5, "{}", run["drag_torque_nm"]);
    // mu N OA at each of the sprags is the drag torque.
    let row = &run["equilibrium"];
    assert!(number(row, "relative_error") < 1e-11 && number(row, "tan_inner") == 0.1, "{row}");
    assert_eq!(row["torque_nm"], run["drag_torque_nm"]);
    let lift_off = number(&run, "lift_off_rpm");
    assert!((4500.0..5500.0).contains(&lift_off), "{lift_off}");
    let fast = json(design.path(), "fast", &[]);
    assert_eq!((&fast["verdict"], number(&fast, "drag_torque_nm")), (&"disengages".into(), 0.0));
    let engage = json(design.path(), "engage", &[]);
    let said = text(&simulate(design.path(), "engage", &["--quiet"]).stdout);
    for row in [
        "slip time, inner contact (once engaged, from ",
        "contact margin (rolling once engaged)",
        "(overrun and all)",
    ] {
        assert!(said.contains(row), "{row}: {said}");
    }
    // The free run before the reversal is no slip of the engagement (the paper: at most half a millisecond).
    assert_eq!(engage["verdict"], "sticks");
    assert!(number(&engage, "initial_slip_s") < 0.5e-3);
    assert!(number(&engage["slip"]["inner"], "distance_mm") < 1e-6);
}

const BENCH: &str = "designs/huang2017-bench.toml";

#[test]
fn transients_name_their_courses_and_what_one_wedge_curve_costs() {
    let step = json(BENCH, "step-up", &[]);
    assert_eq!((&step["kind"], &step["verdict"]), (&"transient".into(), &"sticks".into()));
    let ramp = &SPEED_RAMP.0;
    assert_eq!(ramp["verdict"], "disengages");
    let growth =
        ramp["left_out"].as_array().unwrap().iter().find(|e| e["term"].as_str().unwrap().contains("growth"));
    let cost = growth.unwrap()["cost"].as_str().unwrap();
    assert!(cost.contains("of sprag rotation at first contact"), "{cost}");
    let engage = &ENGAGEMENT.0;
    assert_eq!(engage["assumptions"].as_array().unwrap().len(), 3);
}

#[test]
fn dynamic_static_and_rated_pressure_stand_side_by_side() {
    let low = json(DESIGN, "low-10", &[]);
    let [least, still, most, rated] =
        ["hertz_least_mpa", "hertz_static_mpa", "hertz_peak_mpa", "hertz_rated_mpa"].map(|k| number(&low, k));
    // 4.1.2: the dynamic stress fluctuates around that of the preload, within the order of the rated one.
    assert!(least < still && still < most && most < rated, "{least} {still} {most} {rated}");
    assert!((still - 0.5 * (least + most)).abs() < 0.1 * still);
    assert!(most > 0.1 * rated);
}

#[test]
fn what_is_left_out_is_said_and_full_runs_everything() {
    let terms = |answer: &serde_json::Value| -> Vec<String> {
        let list = answer["left_out"].as_array().unwrap().iter();
        list.map(|e| e["term"].as_str().unwrap().to_owned()).collect()
    };
    let (reduced, full) = (json(DESIGN, "high-6", &[]), json(DESIGN, "high-6", &["--full"]));
    for term in
        ["friction law (12) in slip", "arcs that are never touched", "centrifugal growth of the races"]
    {
        assert!(terms(&reduced).iter().any(|t| t == term), "{term}");
        assert!(terms(&full).iter().all(|t| t != term), "{term}");
    }
    assert!(reduced["kept"][0]["term"].as_str().unwrap().contains("inertia of the sprags"));
    assert_eq!(reduced["theta_inner_end_rad"], full["theta_inner_end_rad"]);
    assert!(number(&reduced, "rhs_evaluations") < 0.6 * number(&full, "rhs_evaluations"));
}

#[test]
fn a_result_that_depends_on_contact_damping_says_so() {
    let cases = [
        (DESIGN, "high-10", "with contact damping of 0.2"),
        // Slips without opening; opens and falls away before the end.
        (DESIGN, "low-10-mu082", "with contact damping of 0.2"),
        (BENCH, "high-10-without-spring", "with contact damping of 0.2"),
        (BENCH, "high-10-damped", "without"),
    ];
    for (file, scenario, words) in cases {
        let notes = json(file, scenario, &[])["notes"].clone();
        assert!(notes[0].as_str().unwrap().contains(words), "{notes}");
    }
    // Where both contacts roll it only takes from the swing: no note, but what it does is said where it is left out.
    let sticks = json(DESIGN, "low-10", &[]);
    assert!(sticks["notes"].as_array().unwrap().is_empty());
    let list = sticks["left_out"].as_array().unwrap();
    let damping = list.iter().find(|l| l["term"] == "contact damping").unwrap();
    assert!(damping["cost"].as_str().unwrap().ends_with("elsewhere, the same verdict"), "{damping}");
}

#[test]
fn the_sentence_of_a_verdict_goes_its_way() {
    // The race has gone towards overrunning, by slip outside and without contact; the inner contact slipped the other way.
    let said = text(&simulate(BENCH, "engagement-weak-spring", &[]).stdout);
    let line = said.lines().next().unwrap();
    assert!(
        line.contains("slips-engaging") && line.contains("towards engaging, yet the inner race"),
        "{line}"
    );
}

/// A torque that turns round is overrun, and no friction is asked to hold it: painted as held where the clutch carries what comes before, as
/// broken where it slips there. What a drivetrain makes of it is the drive's.
#[test]
fn a_torque_that_turns_round_is_judged_by_what_it_carries_before() {
    let painted = |file: &str, scene: &str, change: &dyn Fn(&mut Scenario)| {
        let mut design = Design::read(file.as_ref()).unwrap();
        change(design.scenarios.iter_mut().find(|s| s.name == scene).unwrap());
        let settings = SimulationSettings::default();
        let answer = sprag_design::answer::simulation::simulate(&design, scene, &settings).unwrap();
        let page = answer.page(&Provenance::default()).to_html();
        let class = ["held", "broken", "mixed", "said"];
        let class = class.into_iter().find(|class| page.contains(&format!("class=\"verdict {class}\"")));
        assert_eq!(answer.held(), class == Some("held"));
        (class.unwrap(), answer.verdict())
    };
    let turned = |friction: f64| {
        move |scene: &mut Scenario| {
            scene.torque_history =
                Some(vec![[0.0, 0.0], [0.02, 16.8], [0.025, 16.8], [0.03, -5.0], [0.1, -5.0]]);
            (scene.clutch.friction.static_, scene.clutch.friction.kinetic) = (friction, friction);
        }
    };
    let bench = "designs/huang2017-bench.toml";
    let (class, verdict) = painted(bench, "in-and-out", &turned(0.12));
    assert_eq!(class, "held", "{verdict}");
    assert!(
        verdict.contains("as its torque has it") && verdict.ends_with("under load it does not slip"),
        "{verdict}"
    );
    let (class, verdict) = painted(bench, "in-and-out", &turned(0.081));
    assert_eq!(class, "broken", "{verdict}");
    assert!(
        verdict.contains("under load it slips by 26.") && !verdict.contains("would suffice"),
        "{verdict}"
    );
    // The torque falls and stays positive: it is to hold.
    let (class, verdict) = painted(bench, "step-down", &|_| ());
    assert!(class == "broken" && verdict.contains("would suffice"), "{class}: {verdict}");
    let (class, verdict) = painted("designs/starter-engine.toml", "fires", &|_| ());
    assert!(class == "said" && verdict.ends_with("under load it does not slip"), "{class}: {verdict}");
}

#[test]
fn slices_show_the_pressure_along_the_length() {
    let csv = std::env::temp_dir().join(format!("sprag-slices-{}.csv", std::process::id()));
    let html = csv.with_extension("html");
    json(BENCH, "high-6-slices", &["--csv", csv.to_str().unwrap(), "--report", html.to_str().unwrap()]);
    let mut reader = csv::Reader::from_path(&csv).unwrap();
    let at = |name: &str, h: &csv::StringRecord| h.iter().position(|c| c == name).unwrap();
    let header = reader.headers().unwrap().clone();
    let (p0, end) = (at("hertz_inner_mpa", &header), at("slice_peak_inner_mpa", &header));
    let mut rows = 0;
    for record in reader.records().map(Result::unwrap) {
        let value = |i: usize| record[i].parse::<f64>().unwrap();
        // A square end of 60 slices bears a third more than Hertz's mean, at every load.
        assert!((1.2..1.5).contains(&(value(end) / value(p0))), "{record:?}");
        rows += 1;
    }
    assert_eq!(rows, 1200);
    let page = std::fs::read_to_string(&html).unwrap();
    assert!(page.contains("Pressure along the sprag by 60 slices"));
    let _ = (std::fs::remove_file(csv), std::fs::remove_file(html));
}

#[test]
fn what_never_varies_has_no_time_and_refused_numbers_are_plain() {
    let tail = "\n[[scenarios]]\nname = \"steady-pull\"\nkind = \"transient\"\npreload_nm = 20.0\ntorque_step_nm = 0.0\n\
                step_time_s = 0.01\nabutment_stiffness_nm_per_rad = 5000.0\nduration_s = 0.02\n";
    let steady = Changed::new("steady", tail);
    let said = text(&simulate(steady.path(), "steady-pull", &[]).stdout);
    for row in ["smallest normal force, inner", "largest normal force, inner", "largest |T|/N, inner"] {
        assert!(said.contains(&format!("{row} (throughout)")), "{said}");
    }
    let swings = text(&simulate(DESIGN, "high-6", &[]).stdout);
    assert!(
        swings.contains("largest normal force, inner (at ") && !swings.contains("throughout"),
        "{swings}"
    );
    for (flags, word) in
        [(["--window", "5:6"], "--window 5:6: allowed"), (["--band", "6"], "--band 6: allowed")]
    {
        let said = text(&simulate(DESIGN, "high-6", &flags).stderr);
        assert!(said.contains(word), "{said}");
    }
}

/// Why the scene leaves out what its term starts with; `None` where it does not.
fn left_out(answer: &Value, term: &str) -> Option<String> {
    let list = answer["left_out"].as_array().unwrap_or_else(|| panic!("left_out in {answer}"));
    let found = list.iter().find(|entry| entry["term"].as_str().unwrap().starts_with(term))?;
    Some(found["why"].as_str().unwrap().to_owned())
}

#[test]
fn what_is_left_out_of_a_film_is_what_the_scene_leaves_out() {
    let oil = "designs/lubricated.toml";
    let overrun = json(oil, "overrun", &[]);
    assert_eq!(left_out(&overrun, "lubricant film"), None);
    assert!(left_out(&overrun, "time that a film takes").unwrap().contains("of the film"));
    let file = std::fs::read_to_string(oil).unwrap();
    let oiled = &file[file.find("[lubrication]").unwrap()..file.find("[[scenarios]]").unwrap()];
    let oiled = Changed::new("oiled", oiled);
    let wedged = json(oiled.path(), "high-6", &[]);
    assert!(left_out(&wedged, "lubricant film").unwrap().contains("[lubrication] acts in steady overrun"));
    assert!(!left_out(&json(DESIGN, "high-6", &[]), "lubricant film").unwrap().contains("[lubrication]"));
}

#[test]
fn an_impact_gives_back_what_the_damping_of_the_contacts_leaves() {
    let why = |set: &[&str]| left_out(&json(DESIGN, "high-6", set), "waves in the bodies").unwrap();
    assert!(why(&[]).contains("gives an impact back whole"));
    // e = 1 - 2 c v / 3 at 0.1 m/s and 0.3 s/m: 98 %.
    let damped = why(&["--set", "contact.hunt_crossley_s_per_m=0.3"]);
    assert!(damped.contains("rebound of 98 %"), "{damped}");
}
