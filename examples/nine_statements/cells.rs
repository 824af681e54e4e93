//! The nine scenes run: figures with their errors, histories.

use std::error::Error;

use rayon::prelude::*;
use sprag_design::design::Design;
use sprag_design::dynamics::{Grip, Place};
use sprag_design::report::plot::{Curve, Dash};
use sprag_design::report::{Cell, Column, Page, Plot, Table, significant};
use sprag_design::scenario::{Settings, Simulation, prepare, simulate};

use crate::claims::scene;
use crate::statement::{STATEMENTS, remark};

/// A scene that has been run.
pub struct Ran {
    pub run: Simulation,
    mu_static: f64,
    inner_radius_m: f64,
    /// (t, theta_bi, offset, N_bi): ms, mrad, mrad, N.
    history: Vec<[f64; 4]>,
}

const SAMPLES: usize = 1501;
pub const ROWS: [&str; 3] = ["3.34 Nm, μs = 0.12", "16.8 Nm, μs = 0.12", "16.8 Nm, μs = μc = 0.082"];
pub const AMPLITUDES: [&str; 3] = ["6 Nm", "8 Nm", "10 Nm"];

pub fn label(cell: usize) -> String {
    format!("{}, {}", ROWS[cell / 3], AMPLITUDES[cell % 3])
}

pub fn run_all(design: &Design) -> Result<Vec<Ran>, Box<dyn Error + Send + Sync>> {
    STATEMENTS
        .par_iter()
        .map(|statement| {
            let scene = scene(design, statement.scene)?;
            let curve = prepare(scene)?.model.curve;
            let run = simulate(scene, &Settings { samples: SAMPLES, ..Settings::default() })?;
            let phase = |y: &[f64]| y[2] - y[3] + curve.windup_rad(y[0]);
            let start = run.samples.first().map_or(0.0, |s| phase(&s.state));
            let history = run
                .samples
                .iter()
                .map(|s| [1e3 * s.t, 1e3 * s.state[2], 1e3 * (phase(&s.state) - start), s.forces.n_bi])
                .collect();
            let (mu_static, inner_radius_m) =
                (scene.clutch.friction.static_, scene.clutch.races.inner_radius_m);
            Ok(Ran { run, mu_static, inner_radius_m, history })
        })
        .collect()
}

/// Value and error, e.g. "−0.0072355 ± 1.8e-8".
fn with_error(value: f64, error: f64) -> Cell {
    // Rounding of sums of angles, 1e-12 mrad.
    let value = if value.abs() < 1e-9 { 0.0 } else { value };
    format!("{} ± {}", significant(value, 6), significant(error, 1)).into()
}

/// First and last instant of slip at A under load, ms.
fn slip_ms(s: &Simulation) -> String {
    let slips = |i: usize| matches!(s.modes[i].1.place, Place::Arc(_)) && s.modes[i].1.inner != Grip::Stick;
    let all: Vec<usize> = (0..s.modes.len()).filter(|i| slips(*i)).collect();
    match (all.first(), all.last()) {
        (Some(&a), Some(&b)) => {
            let end = s.modes.get(b + 1).map_or(s.t_s, |m| m.0);
            format!("{:.2} to {:.2}", 1e3 * s.modes[a].0, 1e3 * end)
        }
        _ => "never".to_owned(),
    }
}

fn direction(offset_rad: f64) -> &'static str {
    // Below 1e-9 rad, 0.01 nm at the race, is rounding.
    if offset_rad > 1e-9 {
        "overrunning"
    } else if offset_rad < -1e-9 {
        "engaging"
    } else {
        "none"
    }
}

fn figures(ran: &[Ran]) -> Table {
    let mut table = Table::new(vec![Column::text("quantity", "Quantity")]);
    table.columns.extend(AMPLITUDES.map(|a| Column::text(a, a)));
    type Figure = fn(&Ran) -> Cell;
    let rows: [(&str, Figure); 15] = [
        ("verdict", |r| r.run.verdict.map_or(r.run.stop.name(), |v| v.name()).into()),
        ("inner race at the end, rad", |r| with_error(r.run.theta_inner_rad, e(r).theta_inner_rad)),
        ("offset (+ overrunning), mrad", |r| with_error(1e3 * r.run.offset_rad, 1e3 * e(r).offset_rad)),
        ("offset at the inner race, µm", |r| {
            let um = 1e6 * r.inner_radius_m;
            with_error(um * r.run.offset_rad, um * e(r).offset_rad)
        }),
        ("direction of the offset", |r| direction(r.run.offset_rad).into()),
        ("net slip inside, µm", |r| with_error(1e6 * r.run.inner.net_m, 1e6 * e(r).net_slip_m)),
        ("net slip outside, µm", |r| with_error(1e6 * r.run.outer.net_m, 1e6 * e(r).net_slip_outer_m)),
        ("slip path inside, µm", |r| {
            with_error(1e6 * r.run.inner.distance_m, 1e6 * e(r).slip_distance_inner_m)
        }),
        ("slip path outside, µm", |r| {
            with_error(1e6 * r.run.outer.distance_m, 1e6 * e(r).slip_distance_outer_m)
        }),
        ("time in slip inside, ms", |r| with_error(1e3 * r.run.inner.time_s, 1e3 * e(r).slip_time_inner_s)),
        ("slips inside between, ms", |r| slip_ms(&r.run).into()),
        ("smallest N, N", |r| with_error(r.run.peaks.normal_min_n, e(r).normal_min_n)),
        ("time open, ms", |r| with_error(1e3 * r.run.contact_lost_s, 1e3 * e(r).contact_lost_s)),
        ("largest |T|/N inside", |r| with_error(r.run.peaks.tan_inner, e(r).tan_inner)),
        ("static friction needed to stick", |r| match r.run.demand.and_then(|d| d.required_friction) {
            Some(mu) => with_error(mu, e(r).required_friction),
            None => "none suffices: opens".into(),
        }),
    ];
    for (name, of) in rows {
        let mut row = vec![name.into()];
        row.extend(ran.iter().map(of));
        table.row(row);
    }
    table
}

fn e(ran: &Ran) -> sprag_design::scenario::ErrorEstimate {
    ran.run.error.unwrap_or_default()
}

fn plot(ran: &[Ran], what: usize, title: &str, size: [f64; 2], until_ms: f64) -> String {
    let mut plot = Plot::new("Time, ms", title).sized(size[0], size[1]);
    for ((r, name), dash) in ran.iter().zip(AMPLITUDES).zip([Dash::Solid, Dash::Dashed, Dash::Solid]) {
        let points = r.history.iter().filter(|h| h[0] <= until_ms).map(|h| [h[0], h[what]]).collect();
        plot.curves.push(Curve { name: name.into(), points, dash, dots: false, colour: None });
    }
    plot.to_figure()
}

/// Statements, figures and histories.
pub fn write(page: &mut Page, ran: &[Ran]) {
    let held = STATEMENTS.iter().zip(ran).filter(|(s, r)| s.agrees(r.run.verdict)).count();
    let remarks: Vec<String> = (0..9)
        .filter_map(|i| remark(&ran[i].run, ran[i].mu_static).map(|r| format!("{}: {r}", label(i))))
        .collect();
    page.verdict(held == 9, &format!("{held} of 9 statements hold. {}.", remarks.join(". ")));
    let half = [500.0, 320.0];
    page.figures(&[
        (
            plot(&ran[..3], 2, "Offset, mrad", half, 300.0),
            "What the inner race has slipped, θbi − θbe + windup, 3.34 Nm: + overrunning.",
        ),
        (plot(&ran[6..], 2, "Offset, mrad", half, 300.0), "The same, 16.8 Nm at 0.082: − engaging."),
    ]);
    page.heading("The nine statements");
    let mut table = Table::new(vec![
        Column::text("cell", "Preload, friction, amplitude"),
        Column::text("paper", "The paper (4.1.1, 4.1.2)"),
        Column::text("verdict", "Verdict"),
        Column::text("holds", "Holds"),
        Column::text("remark", "Remark"),
    ]);
    for (i, (s, r)) in STATEMENTS.iter().zip(ran).enumerate() {
        let holds = s.agrees(r.run.verdict);
        table.row(vec![
            label(i).into(),
            s.words.into(),
            r.run.verdict.map_or(r.run.stop.name(), |v| v.name()).into(),
            Cell::Verdict(holds, if holds { "yes" } else { "no" }.to_owned()),
            remark(&r.run, r.mu_static).map_or(Cell::Empty, Cell::Text),
        ]);
    }
    page.table("", &table);
    for (row, three) in ROWS.iter().zip(ran.chunks(3)) {
        page.table(row, &figures(three));
    }
    page.paragraph(
        "± is the difference to a run at ten times the tolerance. Slip counts from 1 µm net at the inner contact. Where the \
         contact opens, no friction would make it roll; the smallest N of a run that slips is that of the slipping run.",
    );
    page.heading("Histories");
    for (row, three) in ROWS.iter().zip(ran.chunks(3)) {
        let caption = format!("Rotation of the inner race, {row}.");
        page.figure(&plot(three, 1, "Rotation θbi, mrad", [1040.0, 300.0], 300.0), &caption);
    }
    page.figure(
        &plot(&ran[..3], 3, "Normal force of one sprag, N", [1040.0, 300.0], 100.0),
        "Normal force of one sprag at the inner race, 3.34 Nm, first 100 ms: at 8 and 10 Nm it touches 0.",
    );
}
