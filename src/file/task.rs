//! What `check` and `optimize` shall do with a design.
//!
//! In: `[check]` and `[optimize]`, the names of the scenarios. Out: names that exist, [`Optimize`]. Absent:
//! margins and searches. Equations: none.

use super::design_file::DesignFile;
use super::findings::Findings;
use super::scenarios::KindFile;
use super::task_file::{OptimizeFile, VariableFile};
use super::variables::{is_whole, variable_names, variable_path};
use super::{check, shape};
use crate::design::Objective;
use crate::design::{Limits, Link, Optimize, OptimizeVariable};

/// Widest range of a variable that takes whole numbers: a choice, one continuous search for each of them.
const MOST_WHOLE: f64 = 40.0;

/// `[check]` scenarios, each existing and named once.
pub(super) fn check_scenarios(file: &DesignFile, out: &mut Findings) -> Vec<String> {
    named_scenarios("check.scenarios", &file.check.scenarios, file, out);
    file.check.scenarios.clone()
}

/// The optimiser's task.
pub(super) fn optimize(file: &DesignFile, task: &OptimizeFile, base: Limits, out: &mut Findings) -> Optimize {
    named_scenarios("optimize.scenarios", &task.scenarios, file, out);
    for (i, name) in task.scenarios.iter().enumerate() {
        if file.scenarios.iter().any(|s| s.name == *name && s.kind == KindFile::Overrun) {
            out.refuse(
                &[&format!("optimize.scenarios[{i}]")],
                "scenarios in which the clutch carries torque".to_owned(),
                "remove it: an overrunning clutch slips by intent and has no slip margin; \
                 limits.keep_contact_to_rpm holds its contact"
                    .to_owned(),
            );
        }
    }
    let mut given = Vec::with_capacity(task.variables.len());
    for (i, variable) in task.variables.iter().enumerate() {
        let path = format!("optimize.variables[{i}]");
        if let Some(first) = task.variables.iter().take(i).position(|v| v.name == variable.name) {
            let (name, other) = (format!("{path}.name"), format!("optimize.variables[{first}].name"));
            out.refuse(&[&name, &other], "each variable once".to_owned(), "remove one of the two".to_owned());
        }
        let value = check_variable(variable, &path, file, out);
        given.push((value, check_links(task, i, value, file, out)));
    }
    let limits = out.within("optimize", |out| check::limits(&task.limits, base, out));
    objective(task, &limits, out);
    Optimize {
        objective: task.objective,
        target: task.target.iter().map(|[torque, windup]| [*torque, windup.to_radians()]).collect(),
        scenarios: task.scenarios.clone(),
        variables: task
            .variables
            .iter()
            .zip(given)
            .map(|(v, (given, links))| OptimizeVariable {
                name: v.name.clone(),
                min: v.min,
                max: v.max,
                given,
                // Bounds bind the search alone: a refused file may have them the wrong way round.
                start: given.max(v.min).min(v.max),
                whole: is_whole(&v.name, file.sprags.inner_arcs.len()),
                links,
            })
            .collect(),
        limits,
        step_mm: task.step_mm,
        reserve: task.reserve,
        seed: task.seed,
    }
}

/// What an objective needs beside the scenarios.
fn objective(task: &OptimizeFile, limits: &Limits, out: &mut Findings) {
    let key = "optimize.objective";
    let wanted = task.objective;
    match wanted {
        _ if wanted.of_scenes() && task.scenarios.is_empty() => out.refuse(
            &["optimize.scenarios", key],
            format!("at least one scenario, over which {wanted} is taken"),
            "name scenarios of this file, or another objective".to_owned(),
        ),
        Objective::TorqueCapacity | Objective::PeakPressure if limits.peak_torque_nm.is_none() => out.refuse(
            &[key],
            format!("{wanted} with a peak torque, at which the limits are held"),
            "add peak_torque_nm to [limits]".to_owned(),
        ),
        Objective::Windup if limits.nominal_torque_nm.is_none() => out.refuse(
            &[key],
            "windup with a nominal torque, at which it is taken".to_owned(),
            "add nominal_torque_nm to [limits]".to_owned(),
        ),
        Objective::StiffnessCurve if task.target.is_empty() => out.refuse(
            &[key],
            "stiffness-curve with a target".to_owned(),
            "add target = [[torque in N m, windup in deg], ...] to [optimize]".to_owned(),
        ),
        Objective::StiffnessCurve => {
            for (i, row) in task.target.iter().enumerate() {
                if !row.iter().all(|v| (1e-6..1e6).contains(v)) {
                    out.refuse(
                        &[&format!("optimize.target[{i}]")],
                        "a torque and a windup, both above 0".to_owned(),
                        "give [torque in N m, windup in deg]".to_owned(),
                    );
                }
            }
        }
        _ if !task.target.is_empty() => out.refuse(
            &["optimize.target"],
            "a target for objective = \"stiffness-curve\" only".to_owned(),
            "remove target, or name that objective".to_owned(),
        ),
        _ => {}
    }
}

/// The variable's value in the file, which may lie outside the bounds; 0 where something was refused.
fn check_variable(v: &VariableFile, path: &str, file: &DesignFile, out: &mut Findings) -> f64 {
    let (name_key, min_key, max_key) = (format!("{path}.name"), format!("{path}.min"), format!("{path}.max"));
    let arcs = file.sprags.inner_arcs.len();
    let Some(target) = variable_path(&v.name, arcs) else {
        out.refuse(
            &[&name_key],
            format!("for {arcs} inner arcs: {}", variable_names(arcs).join(", ")),
            match shape::paths_that_end_in(&v.name).as_slice() {
                [] => {
                    "name one of these variables, or any number of the clutch by its dotted path".to_owned()
                }
                paths => format!("name one of these variables; did you mean {}?", paths.join(" or ")),
            },
        );
        return 0.0;
    };
    for (key, bound) in [(&min_key, v.min), (&max_key, v.max)] {
        if let Some(allowed) = shape::out_of_range(&target, bound) {
            out.refuse(&[key], allowed, format!("give a bound that {target} may take"));
        }
    }
    let whole = is_whole(&v.name, arcs);
    if whole && (v.min != v.min.round() || v.max != v.max.round() || v.max - v.min > MOST_WHOLE) {
        out.refuse(
            &[&min_key, &max_key],
            format!("whole numbers at most {MOST_WHOLE} apart: each is searched by itself"),
            "give whole numbers".to_owned(),
        );
        return 0.0;
    }
    if v.min >= v.max {
        out.refuse(&[&min_key, &max_key], "less than max".to_owned(), "give min < max".to_owned());
        return 0.0;
    }
    let given = out.number(&target);
    if given.is_none() {
        out.refuse(
            &[&name_key],
            format!("a variable whose key is in the file; {target} is not"),
            format!("add {target} = ..., the value from which the search starts, or remove the variable"),
        );
    }
    given.unwrap_or(0.0)
}

/// What goes with variable `i`, whose value in the file is `given`: numbers of the clutch that nothing else moves.
fn check_links(
    task: &OptimizeFile,
    i: usize,
    given: f64,
    file: &DesignFile,
    out: &mut Findings,
) -> Vec<Link> {
    let v = &task.variables[i];
    let arcs = file.sprags.inner_arcs.len();
    let mut links = Vec::new();
    for (list, names) in [("moves", &v.moves), ("scales", &v.scales)] {
        for (k, name) in names.iter().enumerate() {
            let number = |path: &str| out.number(path);
            match link(task, v, list == "scales", name, given, arcs, &number) {
                Ok(link) => links.push(link),
                Err((allowed, help)) => {
                    let key = format!("optimize.variables[{i}].{list}[{k}]");
                    out.refuse(&[&key], allowed.to_owned(), help);
                }
            }
        }
    }
    links
}

/// The number `name` as it goes with `v`: in proportion, or by the same amount; else what is allowed, and what to do. `number`
/// reads the file.
fn link(
    task: &OptimizeFile,
    v: &VariableFile,
    in_proportion: bool,
    name: &str,
    given: f64,
    arcs: usize,
    number: &dyn Fn(&str) -> Option<f64>,
) -> Result<Link, (&'static str, String)> {
    let path = variable_path(name, arcs).filter(|p| !is_whole(p, arcs)).ok_or_else(|| {
        let help = format!("name a variable or a path such as races.width_mm; `{name}` is none");
        ("a number of the clutch, not a whole one", help)
    })?;
    let is_it = |other: &&String| variable_path(other, arcs).as_deref() == Some(path.as_str());
    let linked = task.variables.iter().flat_map(|v| v.moves.iter().chain(&v.scales)).filter(is_it).count();
    if task.variables.iter().any(|v| is_it(&&v.name)) || linked > 1 {
        let help = format!("{path} is a variable itself or goes with another one: name it once");
        return Err(("a number that one thing moves", help));
    }
    if is_whole(&v.name, arcs) || (in_proportion && given == 0.0) {
        return Err((
            "what can be followed: a variable that takes any number, not 0 where others are in proportion to it",
            format!("remove {path}, or make it a variable of its own"),
        ));
    }
    let Some(value) = number(&path) else {
        return Err(("a number that is in the file", format!("add {path} = ... to the file")));
    };
    let (by, times) = if in_proportion { (0.0, value / given) } else { (value - given, 1.0) };
    Ok(Link { path, by, times, step: None })
}

fn named_scenarios(key: &str, names: &[String], file: &DesignFile, out: &mut Findings) {
    for (i, name) in names.iter().enumerate() {
        let entry = format!("{key}[{i}]");
        if !file.scenarios.iter().any(|s| s.name == *name) {
            let known: Vec<&str> = file.scenarios.iter().map(|s| s.name.as_str()).collect();
            let allowed = match known.as_slice() {
                [] => "none, because the file has no scenarios".to_owned(),
                _ => known.join(", "),
            };
            out.refuse(
                &[&entry],
                allowed,
                "name a scenario of this file, or add one of this name".to_owned(),
            );
        } else if names.iter().take(i).any(|n| n == name) {
            out.refuse(&[&entry], "each scenario once".to_owned(), "remove the second".to_owned());
        }
    }
}
