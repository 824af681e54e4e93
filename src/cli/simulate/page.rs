//! The HTML report of a simulation.

use super::answer::Body;
use super::history::{Row, rows, word};
use super::{Scene, facts};
use crate::cli::Context;
use crate::cli::parts::{self, Answer};
use crate::design::ScenarioKind;
use crate::dynamics::Mode;
use crate::report::plot::Dash;
use crate::report::{Curve, Page, Plot, Span, Strip, Unit};
use crate::scenario::{Prepared, Simulation, place_profile};
use crate::wedge::{Lengthwise, Side, along};

const TIME: &str = "Time, ms";

/// The page.
pub(super) fn page(scene: &Scene, answer: &Answer<Body>, context: &Context) -> Page {
    let title = format!("Simulation of {}", scene.scenario.name);
    let mut page = parts::page(&title, answer.design, context);
    page.verdict(scene.held(), &scene.verdict_line());
    page.paragraph(&described(scene));
    page.list(&scene.notes);
    page.table("", &facts::table(scene));
    if let Ok((prepared, simulation)) = &scene.outcome {
        if scene.method != "equilibrium" {
            histories(&mut page, scene, prepared, simulation);
            if let Some(table) = facts::beside_rolling(simulation) {
                page.heading("Against pure rolling").paragraph(
                    "The second column is a run of its own in which both contacts roll whatever friction that takes; \
                     below zero, the normal force is the tension that rolling would need.",
                );
                page.table("", &table);
            }
        }
        draw(&mut page, scene, prepared);
    }
    answer.close(&mut page);
    page
}

/// What the scenario does, in words.
fn described(scene: &Scene) -> String {
    let nm = |t: f64| Unit::NewtonMetre.show_plain(t, 5);
    let overrides = match scene.scenario.overrides.as_slice() {
        [] => String::new(),
        some => format!(" Overridden for this scenario: {}.", some.join(", ")),
    };
    let what = match scene.scenario.kind {
        ScenarioKind::Static { torque_nm } => format!("{} held at rest.", nm(torque_nm)),
        ScenarioKind::TorsionalExcitation {
            preload_nm,
            amplitude_nm,
            frequency_hz,
            duration_s,
            speed_rad_s,
            ..
        } => {
            format!(
                "Preload {} on the inner race, {} at {} on the outer race, {} long, mean speed {}; method: {}.",
                nm(preload_nm),
                nm(amplitude_nm),
                Unit::Hertz.show_plain(frequency_hz, 5),
                Unit::Second.show_plain(duration_s, 5),
                Unit::Rpm.show_plain(speed_rad_s, 6),
                scene.method
            )
        }
        ScenarioKind::Engagement { free_run_rad_s, reversing_torque_nm, duration_s, .. } => format!(
            "The inner race runs free at {}, then {} reverses it onto an elastic stop; {} long, method: {}.",
            Unit::Rpm.show_plain(free_run_rad_s, 6),
            nm(reversing_torque_nm),
            Unit::Second.show_plain(duration_s, 5),
            scene.method
        ),
        ScenarioKind::Transient { duration_s, .. } => {
            let [torque, speed] = courses(scene);
            let start = match scene.scenario.kind {
                ScenarioKind::Transient { overrun_rad_s, .. } if overrun_rad_s > 0.0 => {
                    format!(", from an overrun at {}", Unit::Rpm.show_plain(overrun_rad_s, 6))
                }
                _ => String::new(),
            };
            let length = Unit::Second.show_plain(duration_s, 5);
            format!(
                "Torque on the inner race {torque}, mean speed {speed}{start}; {length} long, method: {}.",
                scene.method
            )
        }
        ScenarioKind::Overrun { speed_rad_s, overrun_rad_s } => format!(
            "Outer race at {}, the inner race ahead of it by {}.",
            Unit::Rpm.show_plain(speed_rad_s, 6),
            Unit::Rpm.show_plain(overrun_rad_s, 6)
        ),
    };
    what + &overrides
}

/// Course of the torque and of the mean speed of a transient, in words.
fn courses(scene: &Scene) -> [String; 2] {
    let ScenarioKind::Transient { preload_nm, torque_step_nm, step_time_s, speed_rad_s, .. } =
        scene.scenario.kind
    else {
        return [String::new(), String::new()];
    };
    let nm = |t: f64| Unit::NewtonMetre.show_plain(t, 5);
    let span = |rows: &[[f64; 2]], unit: Unit| {
        let fold = |f: fn(f64, f64) -> f64, from: f64| rows.iter().map(|r| r[1]).fold(from, f);
        let (low, high) = (fold(f64::min, f64::INFINITY), fold(f64::max, f64::NEG_INFINITY));
        format!(
            "from a file, {} rows, {} to {}",
            rows.len(),
            unit.show_plain(low, 5),
            unit.show_plain(high, 5)
        )
    };
    let torque = match &scene.scenario.torque_history {
        Some(rows) => span(rows, Unit::NewtonMetre),
        None if torque_step_nm == 0.0 => nm(preload_nm),
        None => format!(
            "{}, from {} on {}",
            nm(preload_nm),
            Unit::Second.show_plain(step_time_s, 5),
            nm(preload_nm + torque_step_nm)
        ),
    };
    let speed = match &scene.scenario.speed_history {
        Some(rows) => span(rows, Unit::Rpm),
        None => Unit::Rpm.show_plain(speed_rad_s, 6),
    };
    [torque, speed]
}

fn histories(page: &mut Page, scene: &Scene, prepared: &Prepared, s: &Simulation) {
    let rows = rows(scene);
    let curve = |value: &dyn Fn(&Row) -> f64| -> Vec<[f64; 2]> {
        rows.iter().map(|r| [r.sample.t * 1e3, value(r)]).collect()
    };
    let plot = |y: &str| Plot::new(TIME, y).sized(720.0, 300.0);
    let [tan_at, _, least_at, ..] = s.peaks.at_s.map(|t| t * 1e3);
    page.heading("Histories");
    let angles = plot("Angle, mrad")
        .curve("inner race", curve(&|r| r.sample.state[2] * 1e3))
        .curve("outer race", curve(&|r| r.sample.state[3] * 1e3));
    page.figure(&angles.to_svg(), "Angles of the races; rolling would keep their distance at the windup.");
    // At rest both forces differ by parts in a thousand: the second is dashed so that the first is seen.
    let mut normal = plot("Normal force per sprag, N")
        .curve("inner contact", curve(&|r| r.sample.forces.n_bi))
        .marker(least_at, "smallest");
    let outer = Curve::new("outer contact", curve(&|r| r.sample.forces.n_be));
    normal.curves.push(Curve { dash: Dash::Dashed, ..outer });
    page.figure(&normal.to_svg(), &format!("Normal forces; the smallest {}.", phase(scene, s.peaks.at_s[2])));
    let friction = &prepared.model.friction;
    let mut tan = plot("|T|/N")
        .curve("inner contact", curve(&|r| r.tan[0].unwrap_or(f64::NAN)))
        .curve("outer contact", curve(&|r| r.tan[1].unwrap_or(f64::NAN)))
        .marker(tan_at, "largest")
        .level(friction.static_, "μ static");
    if friction.kinetic < friction.static_ {
        tan = tan.level(friction.kinetic, "μ kinetic");
    }
    let caption = format!(
        "Friction demanded, with gaps where the contact is open; the largest at the inner contact {}.",
        phase(scene, s.peaks.at_s[0])
    );
    page.figure(&tan.to_svg(), &caption);
    page.figure(&strip(s).to_svg(), "What each contact does, from the located changes of mode.");
    let base = s.engaged.map_or([0.0; 2], |e| [e.state[8], e.state[9]]);
    let slip = plot("Net slip, µm")
        .curve("inner contact", curve(&|r| (r.sample.state[8] - base[0]) * 1e6))
        .curve("outer contact", curve(&|r| (r.sample.state[9] - base[1]) * 1e6));
    page.figure(
        &slip.to_svg(),
        "Signed slip distance since the clutch engaged; at the inner contact + is towards overrunning.",
    );
    pressures(page, scene, prepared, s, &rows);
    let torque = plot("Torque of the clutch, Nm").curve("", curve(&|r| r.torque_nm));
    page.figure(&torque.to_svg(), "Torque on the inner race, positive in the sense that the clutch carries.");
}

/// Contact pressure over time (the paper's Figures 9 and 10) and, with slices, along the length.
fn pressures(page: &mut Page, scene: &Scene, prepared: &Prepared, s: &Simulation, rows: &[Row]) {
    let mega = |value: &dyn Fn(&Row) -> f64| -> Vec<[f64; 2]> {
        rows.iter().map(|r| [r.sample.t * 1e3, value(r) / 1e6]).collect()
    };
    let mut plot = Plot::new(TIME, "Contact pressure, MPa")
        .sized(720.0, 300.0)
        .curve("inner contact", mega(&|r| r.hertz_pa[0]))
        .curve("outer contact", mega(&|r| r.hertz_pa[1]))
        .level(s.hertz_static_pa / 1e6, "static load");
    if rows.iter().any(|r| r.slice_pa.is_some()) {
        plot = plot.curve("inner contact, end slice", mega(&|r| r.slice_pa.map_or(f64::NAN, |p| p[0])));
    }
    let rated = match facts::rated_pa(scene) {
        Some(p) => {
            let share = Unit::Percent.show(s.hertz_peak_pa / p, 3);
            format!(
                " At nominal torque it is {}: the largest here is {share} of that.",
                Unit::Megapascal.show(p, 4)
            )
        }
        None => String::new(),
    };
    page.figure(
        &plot.to_svg(),
        &format!("Hertz pressure p0 at both contacts beside that of the static load.{rated}"),
    );
    let curve = &prepared.model.curve;
    let elastic = &curve.statics().elastic;
    let clutch = &scene.own.clutch;
    let over_length = |n: f64| -> Option<Vec<[f64; 2]>> {
        let arc = curve.first_arc() + curve.arc_at(curve.alpha_at_normal(n)?);
        let found =
            along(clutch, elastic.inner_contact.get(arc)?, Side::Inner, n, Lengthwise::Slices).ok()?;
        Some(found.y_m.iter().zip(&found.pressure_pa).map(|(y, p)| [y * 1e3, p / 1e6]).collect())
    };
    let loads = [
        ("largest load", s.peaks.normal_max_n),
        ("static load", s.static_normal_n),
        ("smallest load", s.peaks.normal_min_n),
    ];
    let curves: Vec<_> = loads
        .into_iter()
        .filter(|l| l.1 > 0.0)
        .filter_map(|(name, n)| Some((name, over_length(n)?)))
        .collect();
    let Some(slices) = curves.first().map(|c| c.1.len()) else { return };
    let mut plot = Plot::new("Along the sprag, mm", "Contact pressure, inner, MPa").sized(720.0, 300.0);
    for (name, points) in curves {
        plot = plot.curve(name, points);
    }
    let caption =
        format!("Pressure along the sprag by {slices} slices; at a square end it grows with their number.");
    page.figure(&plot.to_svg(), &caption);
}

/// When, and where in the excitation's period.
fn phase(scene: &Scene, t_s: f64) -> String {
    let when = format!("at {}", Unit::Millisecond.show(t_s, 5));
    match scene.scenario.kind {
        ScenarioKind::TorsionalExcitation { frequency_hz, .. } => {
            format!("{when}, {:.0}° after the excitation's zero", 360.0 * (t_s * frequency_hz).fract())
        }
        _ => when,
    }
}

fn strip(s: &Simulation) -> Strip {
    let words = ["stick", "slip+", "slip-", "open"];
    let spans = |inner: bool| -> Vec<Span> {
        let ends = s.modes.iter().skip(1).map(|m| m.0).chain([s.t_s]);
        let state = |mode: &Mode| words.iter().position(|w| *w == word(mode, inner)).unwrap_or(0);
        let span = |((from, mode), until): (&(f64, Mode), f64)| Span {
            from: from * 1e3,
            until: until * 1e3,
            state: state(mode),
        };
        s.modes.iter().zip(ends).map(span).collect()
    };
    Strip {
        title: TIME.to_owned(),
        range: [0.0, s.t_s * 1e3],
        states: ["sticks", "slips, race ahead", "slips, race behind", "open"].map(str::to_owned).to_vec(),
        rows: vec![("inner".to_owned(), spans(true)), ("outer".to_owned(), spans(false))],
    }
}

/// The sprag where the scenario starts, over first contact.
fn draw(page: &mut Page, scene: &Scene, prepared: &Prepared) {
    let Ok(profile) = place_profile(&scene.own.clutch) else { return };
    let rest = parts::pose_at_rest("first contact", &scene.own, &profile);
    let loaded = scene.drawn_torque_nm().and_then(|t| parts::pose_at_torque(&rest, &prepared.model.curve, t));
    let poses = loaded.into_iter().chain([rest]).collect();
    parts::draw(page, &parts::drawing(&scene.own, poses));
}
