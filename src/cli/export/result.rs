//! A result of `ccx` as rows of `stiffness`, beside those of the design's own contact law.

use crate::cli::Context;
use crate::cli::exit::{Exit, Failure};
use crate::cli::left_out::LeftOut;
use crate::cli::parts::{self, Answer};
use crate::design::{Design, MOST_RESULT, read_text};
use crate::export::calculix::{Facts, Row, at_torque, read};
use crate::report::{Cell, Column, Table, Unit};
use crate::wedge::{StaticPoint, WedgeCurve};
use serde::Serialize;
use std::path::Path;
use std::time::Instant;

#[derive(Debug, Serialize)]
struct Body {
    source: &'static str,
    variant: String,
    mesh_mm: f64,
    points: Vec<Point>,
}

#[derive(Debug, Serialize)]
struct Point {
    torque_nm: f64,
    normal_inner_n: f64,
    normal_outer_n: f64,
    tan_omega: f64,
    tan_nu: f64,
    windup_deg: f64,
    k_secant_nm_per_rad: f64,
    hertz_inner_mpa: Option<f64>,
    law_windup_deg: Option<f64>,
    law_normal_inner_n: Option<f64>,
}

pub(super) fn run(design: &Design, dat: &Path, torques: &[f64], context: &Context) -> Result<Exit, Failure> {
    let deck = dat.with_extension("inp");
    let text = |path: &Path, what: &str| {
        read_text(path, MOST_RESULT)
            .map_err(|e| Failure::malformed(format!("{}: {what}: {e}", path.display())))
    };
    let dat_text = text(dat, "the result to be read")?;
    let deck_text = text(&deck, "the deck of that result, looked for beside it")?;
    let started = Instant::now();
    let facts = Facts::parse(&deck_text).map_err(|key| {
        Failure::malformed(format!("{}: no deck of this tool, or its head lacks {key}", deck.display()))
    })?;
    if facts.hash != design.hash {
        return Err(Failure::malformed(format!(
            "{}: the deck was made from another design file (hash {}, this one {})",
            deck.display(),
            facts.hash,
            design.hash
        )));
    }
    let all = read(&facts, &dat_text).map_err(|e| Failure::malformed(format!("{}: {e}", dat.display())))?;
    let rows: Vec<Row> = if torques.is_empty() {
        all.clone()
    } else {
        torques.iter().filter_map(|t| at_torque(&all, *t)).collect()
    };
    for torque in torques.iter().filter(|t| !rows.iter().any(|r| r.torque_nm == **t)) {
        let (low, high) = (all.first().map_or(0.0, |r| r.torque_nm), all.last().map_or(0.0, |r| r.torque_nm));
        context.message(&format!("{torque} Nm lies outside the result, {low:.4} to {high:.4} Nm"));
    }
    if rows.is_empty() {
        return Err(Failure::malformed("the result holds none of the torques asked for"));
    }
    let curve = design.clutch.profile().ok().and_then(|p| WedgeCurve::build(&design.clutch, &p, 0.0).ok());
    let law: Vec<Option<StaticPoint>> =
        rows.iter().map(|r| curve.as_ref().and_then(|c| c.at_torque(r.torque_nm))).collect();
    let run_time_s = started.elapsed().as_secs_f64();

    let people = table(&rows, &law);
    context.outputs.write_csv(&people);
    let answer = Answer {
        design,
        run_time_s,
        left_out: left_out(&facts),
        error_estimate: None,
        body: body(&facts, &rows, &law),
    };
    context.outputs.write_report(|| {
        let mut page = parts::page("Finite elements", design, context);
        page.heading("CalculiX beside the design's contact law").table("", &people);
        answer.close(&mut page);
        page
    });
    answer.print(context)?;
    context.answer(&people.to_text(context.screen))?;
    Ok(Exit::Held)
}

fn body(facts: &Facts, rows: &[Row], law: &[Option<StaticPoint>]) -> Body {
    let points = rows
        .iter()
        .zip(law)
        .map(|(r, l)| Point {
            torque_nm: r.torque_nm,
            normal_inner_n: r.normal_inner_n,
            normal_outer_n: r.normal_outer_n,
            tan_omega: r.tan_omega,
            tan_nu: r.tan_nu,
            windup_deg: r.windup_rad.to_degrees(),
            k_secant_nm_per_rad: r.torque_nm / r.windup_rad,
            hertz_inner_mpa: r.pressure_inner_pa.map(|p| 1e-6 * p),
            law_windup_deg: l.map(|l| l.windup_rad.to_degrees()),
            law_normal_inner_n: l.map(|l| l.normal_inner_n),
        })
        .collect();
    Body { source: "calculix", variant: facts.variant.clone(), mesh_mm: facts.mesh_mm, points }
}

fn table(rows: &[Row], law: &[Option<StaticPoint>]) -> Table {
    let mut table = Table::new(vec![
        Column::number("torque_nm", "Torque", Unit::NewtonMetre, 5),
        Column::number("normal_inner_n", "N inner", Unit::Newton, 5),
        Column::number("windup_deg", "Windup", Unit::Degree, 5),
        Column::number("hertz_inner_mpa", "Pressure inner", Unit::Megapascal, 4),
        Column::number("tan_omega", "tan ω", Unit::One, 4),
        Column::number("k_secant_nm_per_rad", "Secant", Unit::NewtonMetrePerRadian, 4),
        Column::number("law_normal_inner_n", "N, law", Unit::Newton, 5),
        Column::number("law_windup_deg", "Windup, law", Unit::Degree, 5),
        Column::number("law_over_fe_percent", "Law over FE", Unit::Percent, 3),
    ]);
    for (r, l) in rows.iter().zip(law) {
        table.row(vec![
            r.torque_nm.into(),
            r.normal_inner_n.into(),
            r.windup_rad.into(),
            r.pressure_inner_pa.into(),
            r.tan_omega.into(),
            (r.torque_nm / r.windup_rad).into(),
            l.map(|l| l.normal_inner_n).into(),
            l.map(|l| l.windup_rad).into(),
            l.map_or(Cell::Empty, |l| (l.windup_rad / r.windup_rad - 1.0).into()),
        ]);
    }
    table
}

fn left_out(facts: &Facts) -> Vec<LeftOut> {
    let mut list = vec![
        LeftOut::new(
            "slip and the design's friction",
            "the deck sticks but for a narrow rim of each patch: its friction is its own",
            "none while the clutch sticks",
        ),
        LeftOut::new(
            "separation of windup and shear of the rings",
            "windup is the turn of the outside against the bore, the library's that of rigid races",
            "0.1 % for the clutch of Table 1",
        ),
    ];
    if facts.variant != "solid" {
        list.push(LeftOut::new(
            "width of the races",
            "a plane deck has races as long as the sprag",
            "windup 25 % smaller with races twice as wide (finite elements, clutch of Table 1)",
        ));
    }
    list
}
