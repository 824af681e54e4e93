//! The comparison as a page and as a table for programs.

use std::collections::BTreeMap;

use sprag_design::Design;
use sprag_design::report::plot::{Curve, Dash};
use sprag_design::report::{Cell, Column, Page, PageHead, Plot, Table, Unit, significant};

use crate::diffsol_peer::Kind;
use crate::study::{METHODS, Method, Point, Scene};

/// Error at which methods are compared, rad: the tool's default tolerance.
const WANTED_RAD: f64 = 1e-6;
/// Beside it.
const COARSE_RAD: f64 = 1e-4;
const FINE_RAD: f64 = 1e-8;
/// Six colours come round: the later ones differ in their dashes.
const PLOTTED: [Method; 8] = [
    Method::Ours,
    Method::Dop853,
    Method::Diffsol(Kind::Tsit45),
    Method::Radau5,
    Method::Diffsol(Kind::Bdf),
    Method::Diffsol(Kind::TrBdf2),
    Method::Diffsol(Kind::Esdirk34),
    Method::Published,
];
/// Smaller errors are drawn here: rounding.
const FLOOR_RAD: f64 = 1e-15;

/// Every point, one a line, under the line that says where it comes from.
pub fn csv(head: &PageHead, scenes: &[Scene]) -> Result<Vec<u8>, csv::Error> {
    let PageHead { tool, version, design_hash, command, .. } = head;
    let mut out = format!("# {tool} {version}; design {design_hash}; {command}\n").into_bytes();
    let mut writer = csv::Writer::from_writer(&mut out);
    writer.write_record([
        "scene",
        "method",
        "setting",
        "theta_inner_error_rad",
        "thread_s",
        "wall_s",
        "runs",
        "rhs_evaluations",
        "mode_changes",
        "failure",
    ])?;
    for scene in scenes {
        for p in &scene.points {
            let answer = p.found.as_ref().ok();
            let number = |v: Option<f64>| v.map_or(String::new(), |v| format!("{v:e}"));
            let count = |v: Option<u64>| v.map_or(String::new(), |v| v.to_string());
            let timed = answer.map(|_| p.seconds);
            writer.write_record([
                scene.name.clone(),
                p.method.name().to_owned(),
                format!("{:.0e}", p.setting),
                number(p.error_rad),
                number(timed),
                number(answer.map(|_| p.wall_s)),
                p.runs.to_string(),
                count(answer.map(|a| a.rhs)),
                count(answer.map(|a| a.changes)),
                p.found.as_ref().err().cloned().unwrap_or_default(),
            ])?;
        }
    }
    writer.flush()?;
    drop(writer);
    Ok(out)
}

/// The page.
pub fn page(head: PageHead, scenes: &[Scene], peers: &[String; 2], designs: &[Design]) -> Page {
    let mut page = Page::new(head);
    let (held, line) = verdict(scenes);
    page.verdict(held, &line);
    if let Some(first) = scenes.first() {
        page.figure(&plot(first, "Time, ms", time_ms), &format!("{}: error over time; lower left is better.", first.name));
    }
    page.paragraph(&format!(
        "Peers: {} and {}. Every method has the same right-hand side in each mode (Model::slope, which puts the rates of \
         a contact in stick in exactly), and the peers the same event functions (dynamics::events) and our rule for the \
         next mode (dynamics::next_mode), where they start anew. diffsol locates events by its own root finding. That of \
         differential-equations misplaces zeros of functions that are not straight, by 0.06 where y = t and 1.1 - y^3 falls \
         through zero (peers/tests/peers_alone.rs); with it most runs with slip come to no end, so its methods get our \
         bracketing on its dense output, and the row “its own root finder” shows the other. Error: theta_bi at the \
         end against our run at tolerance 1e-13. Time: median time of the one thread that runs, the settings of all methods in \
         turn in one process; median wall times stand beside it and in the table for programs, and hold what else a shared \
         machine did.",
        peers[0], peers[1],
    ));
    page.heading("Time at equal error");
    page.table(
        &format!(
            "Least time for an error of {WANTED_RAD:.0e} rad, as a multiple of ours, of the settings that hold it with all \
             finer ones; between two settings logarithms are interpolated. Below 1 the other is faster; \u{2264}: its coarsest setting is better than asked for."
        ),
        &ratios(scenes, WANTED_RAD),
    );
    page.table(&format!("The same for {COARSE_RAD:.0e} rad."), &ratios(scenes, COARSE_RAD));
    page.table(&format!("The same for {FINE_RAD:.0e} rad."), &ratios(scenes, FINE_RAD));
    page.heading("Who wins where, and why").list(winners(scenes)).list(WHY);
    page.heading("Do the peers find the same angle?");
    page.paragraph(
        "They share our right-hand side, event functions and rule, not our integrator, root finding, dense output or step \
         control. The tightest setting that each finished, and how far its theta_bi lies from our reference:",
    );
    page.table("", &cross_check(scenes));
    for scene in scenes {
        section(&mut page, scene);
    }
    page.heading("Omissions").list(OMISSIONS);
    for design in designs {
        page.source(&format!("Design file: {}", design.name), &design.source);
    }
    page
}

const WHY: [&str; 5] = [
    "The nearest to ours is differential-equations' dop853: the same formulas. It pays three right-hand sides a step for its \
     dense output, whether needed or not, and gives rates that follow from rolling a tolerance of their own; ours pays for looks \
     at events inside the step, at extremes of forces and at the windup. Where nothing slips that nearly balances. The row \
     “four looks a step” gives it our way of looking at events, though not at extremes, and costs it a tenth to a third there.",
    "Every ladder of tolerances begins at 1e-1, so that a method which is better than asked can also be worse. The longest step \
     of ours, a quarter of a period, kept so that no event or extreme is jumped over, costs up to a sixth of the time at \
     1e-4 rad and nothing at 1e-6: the row “steps of any length” is without it, and loses more in in-and-out by what it jumps \
     over.",
    "Where contacts slip and lift off, looking decides. An event function can dip below zero and rise again within one step; who \
     compares signs at the ends does not see it and takes a wrong branch. In high-10 that costs 1e-5 rad, at any tolerance, \
     until a step happens to end inside the dip (missed changes, below each scene). In engagement and in-and-out the peers miss \
     changes too, but short ones near N = 0 that move the angle by less than is asked for: dop853 is the faster in engagement \
     at 1e-4 rad because it sees one of thirteen. A time counts here only if every \
     tighter setting holds the error too. Near N = 0 a tighter setting may take less time, where steps of a coarser one \
     land beside first contact and change mode to and fro; then its time counts.",
    "Nothing in these scenes is stiff: implicit steps of order 2 to 5 pay for Jacobians and iterations. Where little accuracy is \
     asked for BDF may get by with fewer right-hand sides than ours (counts above), each dearer by more than that. \
     After an event BDF begins at order 1 again; near N = 0, where contact is made and lost every few microseconds, it also \
     flutters (changes of mode in the tables).",
    "What follows for ours: looks must cost no evaluations of their own, and a stage at which nobody looks needs the \
     accelerations alone.",
];

const OMISSIONS: [&str; 9] = [
    "Two crates, six methods. CVODE, LSODA and other libraries that are not Rust are not compared; nor are the other methods \
     of the two crates (Kvaerno, Verner, Adams and Gauss methods among them).",
    "Whole answers are not compared: the peers have no error estimate of theta_bi, no slip margin, no extremes. Ours looks for \
     extremes of forces and friction demand in every step even here; the peers do not, so its time is that of more work.",
    "Right-hand sides count evaluations of the equations of motion, those of Jacobians included. Event functions, which cost \
     about as much each, are counted for nobody.",
    "Ours keeps the windup of a sticking clutch to the rolling constraint after each step and remembers step lengths of kinds of \
     mode; the peers start anew after each event with their own choice of a first step, and integrate the constraint.",
    "Help given to the peers, without which they fail: an event function that is not positive right after a change (a contact \
     just released has v = 0) does not count for 1 ns, so that roots at the start of a piece need no direction; radau5 gets \
     its relative tolerance once per state, because one number is transformed as often as there are states; Jacobians are \
     differences with our increments, the base point evaluated once (ours takes differences too).",
    "Longest step: a quarter of a period (of a twenty-fifth of the duration) for ours and for differential-equations. diffsol \
     has no such setting; where its explicit step runs far beyond an event the right-hand side is no number, which it accepts \
     (“no number” below). That counts as failed.",
    "The published scheme runs with one band of zero velocity, 1e-4 m/s, down to steps of 1e-6 s; the report of the command \
     accuracy has more. It has no rule for the jump of rolling ratios at junctions, hence its floor in low-10.",
    "Scenes at a mean speed, other contact laws, damping, and stiff corners of the stability map are not compared: there \
     implicit methods would have their day.",
    "Building the model, which all need once, is not timed.",
];

/// The fastest at `wanted` (rad) apart from ours: who, and its time over ours.
fn best_peer(scene: &Scene, wanted: f64) -> Option<(Method, f64)> {
    let ours = scene.at_error(Method::Ours, wanted)?.seconds;
    let each = METHODS.into_iter().filter(|m| m.is_peer());
    let times = each.filter_map(|m| Some((m, scene.at_error(m, wanted)?.seconds / ours)));
    times.min_by(|a, b| a.1.total_cmp(&b.1))
}

fn verdict(scenes: &[Scene]) -> (bool, String) {
    let best: Vec<Option<(Method, f64)>> = scenes.iter().map(|s| best_peer(s, WANTED_RAD)).collect();
    let ours = scenes.iter().all(|s| s.at_error(Method::Ours, WANTED_RAD).is_some());
    let won = best.iter().filter(|b| b.is_none_or(|b| b.1 > 1.0)).count();
    let names: Vec<String> = scenes
        .iter()
        .zip(&best)
        .filter_map(|(s, b)| {
            let (peer, ratio) = b.filter(|b| b.1 <= 1.0)?;
            Some(format!("{} ({}, {} of our time)", s.name, peer.name(), significant(ratio, 2)))
        })
        .collect();
    let line = format!(
        "At an error of {WANTED_RAD:.0e} rad ours is the fastest in {won} of {} scenes",
        scenes.len()
    );
    let line = if names.is_empty() { line } else { format!("{line}; a peer wins in {}", names.join(", ")) };
    (ours && won == scenes.len(), line)
}

fn ratios(scenes: &[Scene], wanted: f64) -> Table {
    let mut columns = vec![Column::text("method", "Method")];
    columns.extend(scenes.iter().map(|s| Column::text(&s.name, &s.name)));
    let mut table = Table::new(columns);
    for method in METHODS {
        let mut row: Vec<Cell> = vec![method.name().into()];
        for scene in scenes {
            let (ours, found) = (scene.at_error(Method::Ours, wanted), scene.at_error(method, wanted));
            row.push(match (ours, found) {
                (_, None) => Cell::Text(match least_error(scene, method) {
                    Some(e) => format!("never: {e:.0e} rad at best"),
                    None => "fails".to_owned(),
                }),
                (_, Some(f)) if method == Method::Ours => {
                    let most = if f.better { "\u{2264} " } else { "" };
                    Cell::Text(format!("{most}{} ms", significant(1e3 * f.seconds, 3)))
                }
                (Some(o), Some(f)) => {
                    let most = if f.better { "\u{2264} " } else { "" };
                    Cell::Text(format!(
                        "{most}{} ({}\u{a0}ms)",
                        significant(f.seconds / o.seconds, 2),
                        significant(1e3 * f.seconds, 3)
                    ))
                }
                (None, Some(f)) => Cell::Text(format!("{} ms", significant(1e3 * f.seconds, 3))),
            });
        }
        table.row(row);
    }
    table
}

fn least_error(scene: &Scene, method: Method) -> Option<f64> {
    scene.of(method).filter_map(|p| p.error_rad).min_by(f64::total_cmp)
}

fn winners(scenes: &[Scene]) -> Vec<String> {
    let line = |scene: &Scene| {
        let each = [COARSE_RAD, WANTED_RAD, FINE_RAD].map(|wanted| match best_peer(scene, wanted) {
            Some((peer, ratio)) => {
                let (ours, theirs) = (scene.at_error(Method::Ours, wanted), scene.at_error(peer, wanted));
                let work = match (ours, theirs) {
                    (Some(o), Some(t)) => format!(
                        "; {} times the right-hand sides, {} against {} \u{b5}s each",
                        significant(t.rhs / o.rhs, 2),
                        significant(1e6 * t.seconds / t.rhs, 2),
                        significant(1e6 * o.seconds / o.rhs, 2)
                    ),
                    _ => String::new(),
                };
                let ratio_text = significant(ratio, 2);
                if ratio > 1.0 {
                    format!("at {wanted:.0e} rad ours ({}: {ratio_text} of our time{work})", peer.name())
                } else {
                    format!("at {wanted:.0e} rad {} ({ratio_text} of our time{work})", peer.name())
                }
            }
            None if scene.at_error(Method::Ours, wanted).is_some() => {
                format!("at {wanted:.0e} rad ours; no peer comes to it")
            }
            None => format!("at {wanted:.0e} rad nobody"),
        });
        format!("{}: {}.", scene.name, each.join("; "))
    };
    scenes.iter().map(line).collect()
}

fn cross_check(scenes: &[Scene]) -> Table {
    let mut columns = vec![Column::text("method", "Method")];
    columns.extend(scenes.iter().map(|s| Column::text(&s.name, &s.name)));
    let mut table = Table::new(columns);
    let mut own: Vec<Cell> = vec!["our reference, at ten times its tolerance and twice its steps".into()];
    own.extend(scenes.iter().map(|s| Cell::Text(format!("{:.1e} rad", s.reference_error_rad))));
    table.row(own);
    for method in METHODS.into_iter().filter(|m| *m != Method::Ours) {
        let mut row: Vec<Cell> = vec![method.name().into()];
        row.extend(scenes.iter().map(|s| match s.tightest(method) {
            Some((p, e)) => Cell::Text(format!("{e:.1e} rad at {:.0e}", p.setting)),
            None => "fails".into(),
        }));
        table.row(row);
    }
    table
}

fn section(page: &mut Page, scene: &Scene) {
    page.heading(&scene.name);
    page.paragraph(&format!(
        "{}. Reference: theta_bi {:.12} rad after {} changes of mode.",
        scene.what, scene.reference_rad, scene.changes
    ));
    let time = plot(scene, "Time, ms", time_ms);
    let rhs = plot(scene, "Right-hand sides", |p| p.found.as_ref().map_or(f64::NAN, |a| a.rhs as f64));
    page.figures(&[(time, "Error over time."), (rhs, "Error over right-hand sides.")]);
    page.table("", &table(scene));
    let missed = missed(scene);
    if !missed.is_empty() {
        page.paragraph(&format!(
            "Missed or spurious changes of mode: tolerances of 1e-6 and below at which the count is not {} and the error is \
             above {WANTED_RAD:.0e} rad:",
            scene.changes
        ))
        .list(missed);
    }
    let failures = failures(scene);
    if failures.is_empty() {
        page.paragraph("Nothing failed.");
    } else {
        page.paragraph("Failures, with the settings at which they occurred:").list(failures);
    }
}

fn missed(scene: &Scene) -> Vec<String> {
    let wrong = |p: &&Point| {
        let other = p.found.as_ref().is_ok_and(|a| a.changes != scene.changes);
        other
            && p.setting <= 1e-6
            && p.error_rad.is_some_and(|e| e > WANTED_RAD)
            && p.method != Method::Published
    };
    let line = |method: Method| {
        let at: Vec<String> = scene
            .of(method)
            .filter(wrong)
            .map(|p| {
                let changes = p.found.as_ref().map_or(0, |a| a.changes);
                format!("{:.0e} ({changes} changes, {:.1e} rad)", p.setting, p.error_rad.unwrap_or(f64::NAN))
            })
            .collect();
        (!at.is_empty()).then(|| format!("{}: {}", method.name(), at.join("; ")))
    };
    METHODS.into_iter().filter_map(line).collect()
}

/// Alike but for the place and the setting: once.
fn failures(scene: &Scene) -> Vec<String> {
    let mut found: BTreeMap<(String, String), Vec<String>> = BTreeMap::new();
    for p in &scene.points {
        if let Err(why) = &p.found {
            let kind = why.split(" at ").next().unwrap_or(why).split(", in a piece").next().unwrap_or(why);
            let key = (p.method.name().to_owned(), kind.to_owned());
            let place = why.strip_prefix(kind).unwrap_or("").trim_start_matches([',', ' ']);
            found.entry(key).or_default().push(format!("{:.0e} ({place})", p.setting));
        }
    }
    found.into_iter().map(|((who, why), at)| format!("{who}: {why}: {}", at.join("; "))).collect()
}

/// For an axis, ms.
fn time_ms(p: &Point) -> f64 {
    1e3 * p.seconds
}

fn plot(scene: &Scene, x_title: &str, x: impl Fn(&Point) -> f64) -> String {
    let mut plot =
        Plot::new(x_title, "Error of θbi, rad").sized(720.0, 400.0).level(WANTED_RAD, "compared");
    (plot.log_x, plot.log_y) = (true, true);
    for method in PLOTTED {
        let at = |p: &Point| [x(p), p.error_rad.map_or(f64::NAN, |e| e.max(FLOOR_RAD))];
        let dash = match method {
            Method::Ours | Method::Dop853 | Method::Diffsol(Kind::Tsit45) => Dash::Solid,
            Method::Published | Method::OursLong => Dash::Dotted,
            _ => Dash::Dashed,
        };
        let points = scene.of(method).map(at).collect();
        plot.curves.push(Curve { dash, dots: true, ..Curve::new(method.name(), points) });
    }
    plot.to_figure()
}

fn table(scene: &Scene) -> Table {
    let mut table = Table::new(vec![
        Column::text("method", "Method"),
        Column::text("setting", "Tolerance, or step in s"),
        Column::number("theta_inner_error_rad", "Error", Unit::Radian, 2),
        Column::number("thread_s", "Time", Unit::Millisecond, 3),
        Column::number("wall_s", "Wall time", Unit::Millisecond, 3),
        Column::text("rhs_evaluations", "Right-hand sides"),
        Column::text("mode_changes", "Changes of mode"),
    ]);
    for p in &scene.points {
        let Ok(answer) = &p.found else { continue };
        table.row(vec![
            p.method.name().into(),
            format!("{:.0e}", p.setting).as_str().into(),
            p.error_rad.map_or(Cell::Empty, Cell::Si),
            Cell::Si(p.seconds),
            Cell::Si(p.wall_s),
            answer.rhs.to_string().as_str().into(),
            answer.changes.to_string().as_str().into(),
        ]);
    }
    table
}
