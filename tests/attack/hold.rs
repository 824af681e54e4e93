//! What every run must hold, whatever was asked.

use super::case::{Case, FOREIGN};
use super::run::{Files, Program, Ran};
use serde_json::Value;
use std::path::Path;

/// Keys of JSON answers that may be null: figures that do not exist for a scene or a design. Another null is a number that
/// is none.
const MAY_BE_NULL: &[&str] = &[
    // Race spaces that `size` tried and that hold no clutch.
    "outside_mm",
    // Slow overruns that last too short to matter.
    "passing",
    "width_mm",
    "mass_g",
    "at_moved_s",
    // Of a design whose scenes do not turn.
    "at_speed",
    "bearing_stiffness_n_per_um",
    "best",
    "contact_lost_s",
    "contact_margin",
    "correlation",
    "decided_by",
    "deciding",
    "demand",
    "demand_after",
    "demand_before",
    "distance_mm",
    "energy_balance",
    "equilibrium",
    "error_estimates",
    "events",
    "expected",
    "extremes",
    "free_centroid",
    "growth_rate_per_s",
    "half_width_95",
    "heat",
    "hertz_least_mpa",
    "hertz_peak_mpa",
    "hertz_rated_mpa",
    "hertz_static_mpa",
    "inconsistent_choices",
    "influence",
    "journal",
    "k_secant_nm_per_rad",
    "k_tangent_nm_per_rad",
    "largest_share_coupled",
    "lift_off_more_drag_rpm",
    "lift_off_rpm",
    "lowest_torque_capacity",
    "net_mm",
    "nominal_torque_capacity",
    "normal",
    "normal_max_n",
    "normal_min_n",
    "not_done",
    "offset_rad",
    "peak_tan_demand",
    "peak_torque_capacity",
    "race_wear_um",
    "realised",
    "reason",
    "rejections",
    "relief",
    "required_static_friction",
    "required_static_friction_by",
    "residual_sigma",
    "rhs_evaluations",
    "robust",
    "run_out",
    "running",
    "scenario_margins",
    "searched_on",
    "sensitivities",
    "sigma",
    "slip_margin",
    "sprag_wear_um",
    "steps",
    "swing_frequency_hz",
    "t_end_s",
    "theta_inner_end_rad",
    "theta_outer_end_rad",
    "time_s",
    "tolerances",
    "torque_capacity_nm",
    "torque_nm",
    "unrounded",
    "verdict",
    "warning",
    "why_not",
    "windup",
    "windup_deg",
    "windup_local_only",
    "windup_rad",
    "worst",
    "written",
    "written_to",
    "zeno_closures",
    "end_torque_nm",
    "required_friction",
    "required_friction_at_rest",
    "used_worn",
];

/// What kind of fault it is: its words without figures.
pub fn kind(fault: &str) -> String {
    fault.split(':').next().unwrap_or(fault).to_owned()
}

/// What one run did wrong, judged by its exit code, its streams and its files.
pub fn faults(case: &Case, before: &Files, ran: &Ran, after: &Files) -> Vec<String> {
    let mut faults = Vec::new();
    ending(case, ran, &mut faults);
    if faults.is_empty() {
        streams(case, ran, &mut faults);
        if case.command() == "evaluate" {
            lines_of_evaluate(case, ran, &mut faults);
        } else if case.has("--json") {
            json(case, ran, &mut faults);
        }
        files(case, before, ran, after, &mut faults);
    }
    faults
}

fn ending(case: &Case, ran: &Ran, faults: &mut Vec<String>) {
    let last: String = ran.stderr.lines().rev().take(4).collect::<Vec<_>>().join(" | ");
    match (ran.code, ran.signal) {
        (Some(0..=3), _) => {}
        (Some(130), _) if case.interrupt.is_some() => {}
        // Ctrl-C before the program listens.
        (None, Some(2)) if case.interrupt.is_some() => {}
        (code, Some(24)) => faults.push(format!("more than 60 s of processor time: {code:?}, {last}")),
        (code, signal) => faults.push(format!("ends with code {code:?}, signal {signal:?}: {last}")),
    }
    if let Some(line) =
        ran.stderr.lines().find(|line| line.contains("panicked at") || line.contains("report this"))
    {
        faults.push(format!(
            "panics at {}: {line}",
            line.split("panicked at ").last().unwrap_or_default().trim_end_matches(':')
        ));
    }
}

fn streams(case: &Case, ran: &Ran, faults: &mut Vec<String>) {
    let json = case.has("--json") || case.command() == "evaluate";
    for (name, text) in [("standard error", &ran.stderr), ("standard output", &ran.stdout)] {
        if let Some(c) = text.chars().find(|c| c.is_control() && *c != '\n' && *c != '\t') {
            faults.push(format!("a control character on {name}: {c:?}"));
        }
    }
    if !json && let Some(line) = ran.stdout.lines().find(|line| has_no_number(line)) {
        faults.push(format!("a number that is none on standard output: {line}"));
    }
    if ran.code == Some(2) {
        if ran.stderr.trim().is_empty() && case.command() != "evaluate" {
            faults.push("refused without a word".into());
        }
        // Frames break long lines; a name is looked for without them.
        let said: String = ran.stderr.chars().filter(|c| !c.is_whitespace() && *c != '│').collect();
        let read =
            case.files.iter().map(|(name, _)| name.as_str()).chain(case.args.get(1).map(String::as_str));
        let mut names = read.chain(["j.csv"]);
        if case.plain_flags && !names.any(|name| said.contains(name)) {
            faults.push(format!("a refusal names no file: {}", ran.stderr));
        }
    } else if ran.code == Some(3) && ran.stderr.trim().is_empty() && ran.stdout.trim().is_empty() {
        faults.push("fails without a word".into());
    }
}

/// Whether a line shows what a number becomes where it is none.
fn has_no_number(line: &str) -> bool {
    let word = |w: &str| matches!(w.trim_start_matches(['-', '−', '+']), "NaN" | "inf" | "∞");
    line.split(|c: char| c.is_whitespace() || ",;()|".contains(c)).any(word)
}

fn json(case: &Case, ran: &Ran, faults: &mut Vec<String>) {
    // An option that is none is refused in words alone.
    if (ran.code == Some(2) && !case.plain_flags || case.interrupt.is_some()) && ran.stdout.is_empty() {
        return;
    }
    let value = match serde_json::from_str::<Value>(&ran.stdout) {
        Ok(value) if value.is_object() && ran.stdout.trim_end().lines().count() == 1 => value,
        Ok(_) => return faults.push("standard output is not one JSON object".into()),
        Err(e) => {
            let code = ran.code.unwrap_or(-1);
            return faults.push(format!(
                "no JSON with exit code {code}: {e}; {} {}",
                head(&ran.stdout),
                head(&ran.stderr)
            ));
        }
    };
    if ran.code == Some(2) {
        // Only why it is refused; a place that a file has not is null there.
        if value.get("error").is_none() {
            faults.push(format!("refused, yet answered: {}", head(&ran.stdout)));
        }
        return;
    }
    nulls("", &value, faults);
    match case.command() {
        "check" => check(&value, ran, faults),
        "simulate" => simulate(&value, ran, faults),
        _ => {}
    }
}

/// Nulls where a number is promised.
fn nulls(key: &str, value: &Value, faults: &mut Vec<String>) {
    match value {
        Value::Null if !MAY_BE_NULL.contains(&key) => faults.push(format!("null for {key}")),
        Value::Array(list) => list.iter().for_each(|v| nulls(&format!("{key}[]"), v, faults)),
        Value::Object(map) => map.iter().for_each(|(k, v)| nulls(k, v, faults)),
        _ => {}
    }
}

fn check(value: &Value, ran: &Ran, faults: &mut Vec<String>) {
    let Some(rows) = value["margins"].as_array() else { return };
    let mut all = true;
    for row in rows {
        let (margin, held) = (row["margin"].as_f64(), row["held"].as_bool());
        if row["computed"] == true
            && margin.is_some_and(|m| m.abs() > 1e-9)
            && held != margin.map(|m| m >= 0.0)
        {
            faults.push(format!("held and margin differ: {row}"));
        }
        all &= held == Some(true) || row["required"] != true;
    }
    let pass = value["pass"].as_bool();
    if pass != Some(all) || (ran.code == Some(0)) != all {
        faults.push(format!(
            "verdict, rows and exit code differ: pass {pass:?}, rows {all}, code {:?}",
            ran.code
        ));
    }
}

fn simulate(value: &Value, ran: &Ran, faults: &mut Vec<String>) {
    let Some(scene) = value.get("verdict") else { return };
    if scene.is_null() {
        if value["reason"].is_null() {
            faults.push(format!("neither verdict nor reason: stop {}", value["stop"]));
        }
        if ran.code == Some(0) {
            faults.push("exit code 0 without a verdict".into());
        }
        return;
    }
    for key in ["t_end_s", "contact_lost_s", "normal_min_n", "normal_max_n", "offset_rad"] {
        if value[key].is_null() && value["kind"] != "static" {
            faults.push(format!("verdict {scene}, yet null for {key}"));
        }
    }
    for slip in ["inner", "outer"].map(|contact| &value["slip"][contact]) {
        let slips = slip["time_s"].as_f64().is_some_and(|t| t > 0.0);
        if value["method"] == "event" && slips == slip["heat"].is_null() {
            faults.push(format!("slip and its heat differ: {slip}"));
        }
    }
}

/// One answer for each line that asks something.
fn lines_of_evaluate(case: &Case, ran: &Ran, faults: &mut Vec<String>) {
    let asked = case.input.split(|b| *b == b'\n').filter(|line| !line.trim_ascii().is_empty()).count();
    let mut answers = 0;
    let mut malformed = false;
    for line in ran.stdout.lines() {
        match serde_json::from_str::<Value>(line) {
            Ok(value) if value.is_object() => {
                nulls("", &value, faults);
                malformed |= value.get("malformed").is_some();
                answers += 1;
            }
            _ => faults.push(format!("no JSON line: {line}")),
        }
    }
    let refused = ran.code == Some(2) && !ran.stderr.is_empty() || case.interrupt.is_some();
    if !refused
        && ran.code != Some(3)
        && (answers != asked + usize::from(case.has("--describe")) || malformed != (ran.code == Some(2)))
    {
        faults.push(format!("{answers} answers to {asked} lines, code {:?}", ran.code));
    }
}

/// Length of the whole lines of a file.
fn whole(bytes: &[u8]) -> usize {
    bytes.iter().rposition(|b| *b == b'\n').map_or(0, |at| at + 1)
}

/// What was there before is there still; what is new is asked for and whole.
fn files(case: &Case, before: &Files, ran: &Ran, after: &Files, faults: &mut Vec<String>) {
    // A mutation may have changed the name that a flag gives.
    let written = |name: &str| {
        case.outputs.iter().any(|output| name.starts_with(output.as_str()))
            || case.args.iter().any(|arg| arg == name)
    };
    for (name, old) in &before.0 {
        match after.0.get(name) {
            None => faults.push(format!("{name} is gone: code {:?}", ran.code)),
            Some(new) if new == old => {}
            Some(_) if ran.code == Some(2) => {
                faults.push(format!("{name} changed by a refused command: {}", head(&ran.stderr)))
            }
            Some(_) if name == FOREIGN.0 => faults.push("a foreign file was overwritten: letter.txt".into()),
            Some(new) if name == "j.csv" => {
                // A journal only grows; a last line cut short may go.
                if !new.starts_with(&old[..whole(old)]) {
                    faults.push("the journal lost rows: j.csv".into());
                }
            }
            Some(_) if written(name) => {}
            Some(_) => faults.push(format!("an input was changed: {name}")),
        }
    }
    for (name, bytes) in &after.0 {
        if before.0.get(name) == Some(bytes) {
            continue;
        }
        let file = name.rsplit('/').next().unwrap_or(name);
        // The search writes beside the design file where no other place is named.
        let new = !before.0.contains_key(name);
        if new
            && (file.starts_with('.')
                || file.ends_with(".tmp")
                || !(written(name) || name.starts_with("design-optimized")))
        {
            faults.push(format!("left behind: {name}"));
        }
        let text = String::from_utf8_lossy(bytes);
        // What a journal held before stays as it is, spoilt rows too: only what was written behind it is judged.
        let kept =
            before.0.get(name).filter(|_| name == "j.csv").map_or(0, |old| whole(old).min(bytes.len()));
        if bytes[kept..].iter().any(|b| *b == 0x1b || *b == 0) {
            faults.push(format!("a raw control character in a file: {name}"));
        }
        if name.ends_with(".html") {
            if !text.trim_end().ends_with("</html>") {
                faults.push(format!("a page is not whole: {name}"));
            }
            if text.contains("NaN") || text.contains(">inf") {
                faults.push(format!("a number that is none in a page: {name}"));
            }
        } else if name.ends_with(".csv") && name != "j.csv" {
            table(name, bytes, faults);
        }
    }
}

fn table(name: &str, bytes: &[u8], faults: &mut Vec<String>) {
    for row in csv::Reader::from_reader(bytes).into_records() {
        match row {
            Err(e) => return faults.push(format!("a table does not parse: {name}, {e}")),
            Ok(row) => {
                if let Some(cell) = row.iter().find(|cell| has_no_number(cell)) {
                    return faults
                        .push(format!("a number that is none in a table: {name}, {cell} in {row:?}"));
                }
            }
        }
    }
}

/// Designs that were written and that `check` refuses.
pub fn unreadable(
    program: &Program,
    case: &Case,
    before: &Files,
    after: &Files,
    folder: &Path,
) -> Vec<String> {
    let design = |name: &str| name.ends_with(".toml") && before.0.get(name) != after.0.get(name);
    let written: Vec<&String> = after.0.keys().filter(|name| design(name)).collect();
    written
        .into_iter()
        .filter_map(|name| {
            let ran = program.run(folder, &["check".into(), name.clone(), "-q".into()], &[], None);
            // A check that its limit of processor time ends has refused nothing.
            let refused = ran.code == Some(2);
            refused.then(|| {
                format!("{} writes a design that check refuses: {name}, {}", case.command(), ran.stderr)
            })
        })
        .collect()
}

/// What two runs of one command, with one thread and with two, did differently.
pub fn differences(once: &Ran, files: &Files, twice: &Ran, others: &Files) -> Vec<String> {
    let mut faults = Vec::new();
    if once.code != twice.code {
        faults.push(format!(
            "another exit code the second time: {:?}, {:?} {}",
            once.code,
            twice.code,
            head(&twice.stderr)
        ));
        return faults;
    }
    for (name, a, b) in
        [("standard output", &once.stdout, &twice.stdout), ("standard error", &once.stderr, &twice.stderr)]
    {
        let (a, b) = (timeless(a), timeless(b));
        if a != b {
            faults.push(format!("{name} differs the second time: {}", difference(&a, &b)));
        }
    }
    if !files.0.keys().eq(others.0.keys()) {
        faults.push("other files the second time".into());
    }
    for (name, bytes) in &files.0 {
        let Some(other) = others.0.get(name) else { continue };
        let (mut a, mut b) =
            (timeless(&String::from_utf8_lossy(bytes)), timeless(&String::from_utf8_lossy(other)));
        // Rows of a journal stand in the order in which evaluations ended.
        if name.contains("journal") || name == "j.csv" {
            (a, b) = (sorted(&a), sorted(&b));
        }
        if a != b {
            faults.push(format!("{name} differs the second time: {}", difference(&a, &b)));
        }
    }
    faults
}

/// A text without what may differ: run time and number of threads.
fn timeless(text: &str) -> String {
    let text = text.replace("--threads 2", "--threads 1");
    match text.split_once("\"run_time_s\":") {
        Some((head, tail)) => format!("{head}{}", tail.trim_start_matches(|c: char| c != ',')),
        None => text,
    }
}

fn sorted(text: &str) -> String {
    let mut lines: Vec<&str> = text.lines().collect();
    lines.sort_unstable();
    lines.join("\n")
}

/// Where two texts part.
fn difference(a: &str, b: &str) -> String {
    let at = a.chars().zip(b.chars()).take_while(|(a, b)| a == b).count();
    let from = |text: &str| text.chars().skip(at.saturating_sub(40)).take(100).collect::<String>();
    format!("{:?} and {:?}", from(a), from(b))
}

fn head(text: &str) -> String {
    text.chars().take(300).collect::<String>().replace('\n', " ")
}
