//! Error of the cheap contact laws against the half-space reference, over the time that they take.
//!
//! `cargo run --release --example contact_error_vs_time` writes reports/contact-error-vs-time.html (some 2 min).

use std::error::Error;
use std::f64::consts::PI;
use std::time::Instant;

use sprag_design::contact::half_space::{HalfSpaceLine, HalfSpaceLineSolution, HalfSpaceStatus};
use sprag_design::contact::{
    AxialFit, ContactError, EndDrop, LineContact, Peak, RollerLaw, SliceCompliance, SliceContact,
};
use sprag_design::material::{Material, PlaneState};
use sprag_design::report::plot::{Curve, Dash};
use sprag_design::report::{Column, Page, PageHead, Plot, Table, Tone, Unit, significant};

const LOADS_N: [f64; 7] = [1.0, 10.0, 100.0, 500.0, 2441.0, 8000.0, 20_000.0];
const SLICES: [usize; 5] = [10, 20, 40, 80, 160];
/// Rows of the reference: a multiple of every number of slices.
const ROWS: usize = 960;
const ACROSS: usize = 64;
const DESIGN_N: f64 = 2441.0;
const TILT_RAD: f64 = 5e-4;
const OUT: &str = "reports/contact-error-vs-time.html";

/// Approach, line load averaged over slices in units of the mean, peak pressure.
struct Answer {
    approach_m: f64,
    share: Vec<f64>,
    peak_pa: f64,
    seconds: f64,
}

/// Relative errors of one law in one contact under one load.
struct Error3 {
    approach: f64,
    load: f64,
    peak: f64,
    seconds: f64,
}

struct Law {
    name: String,
    family: &'static str,
    /// One per load.
    errors: Vec<Error3>,
}

struct Case {
    name: &'static str,
    fit: AxialFit,
}

/// The median of repeated runs.
fn timed<T>(mut run: impl FnMut() -> Result<T, ContactError>) -> Result<(T, f64), ContactError> {
    let mut times = Vec::new();
    let begun = Instant::now();
    loop {
        let start = Instant::now();
        let found = std::hint::black_box(run()?);
        times.push(start.elapsed().as_secs_f64());
        if times.len() >= 25 || begun.elapsed().as_secs_f64() > 0.05 {
            times.sort_by(f64::total_cmp);
            return Ok((found, times[times.len() / 2]));
        }
    }
}

/// Loads in units of the mean load.
fn share(load_n: &[f64]) -> Vec<f64> {
    let total: f64 = load_n.iter().sum();
    load_n.iter().map(|q| q * load_n.len() as f64 / total).collect()
}

/// Means of as many neighbours as make `count` of them.
fn gathered(fine: &[f64], count: usize) -> Vec<f64> {
    let each = fine.len() / count;
    fine.chunks_exact(each).map(|c| c.iter().sum::<f64>() / each as f64).collect()
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |m: f64, v| m.max(*v))
}

/// The reference for one load: fine rows for loads and approach; peaks on rows as wide as each number of slices,
/// because a sharp end has no other.
struct Reference {
    fine: HalfSpaceLineSolution,
    peaks_pa: Vec<(usize, f64)>,
    uncertainty: f64,
    seconds: f64,
}

fn reference(contact: LineContact, fit: &AxialFit, normal_n: f64) -> Result<Reference, ContactError> {
    let solve = |rows: usize| HalfSpaceLine::new(contact, ACROSS, rows).solve_along(normal_n, fit);
    let start = Instant::now();
    let fine = solve(ROWS)?;
    let seconds = start.elapsed().as_secs_f64();
    let half = solve(ROWS / 2)?;
    for found in [&fine, &half] {
        if !matches!(found.status, HalfSpaceStatus::Converged { .. }) {
            eprintln!("reference at {normal_n} N: {:?}", found.status);
        }
    }
    let peaks = SLICES.map(|n| solve(n).map(|found| (n, largest(&found.pressure_pa))));
    let uncertainty = (half.approach_m / fine.approach_m - 1.0)
        .abs()
        .max(distance(&share(&half.load_n), &gathered(&share(&fine.load_n), ROWS / 2)));
    Ok(Reference { fine, peaks_pa: peaks.into_iter().collect::<Result<_, _>>()?, uncertainty, seconds })
}

/// Share of the load that lies in the wrong place: half the sum of |differences|.
fn distance(a: &[f64], b: &[f64]) -> f64 {
    0.5 * a.iter().zip(b).map(|(a, b)| (a - b).abs()).sum::<f64>() / a.len() as f64
}

/// Where the peak is at a sharp end it is compared at equal slice width, else with the finest.
fn errors(answer: &Answer, reference: &Reference) -> Error3 {
    let n = answer.share.len();
    let at = if matches!(reference.fine.peak, Peak::AtEnd { .. }) {
        n.max(SLICES[0]).min(SLICES[4])
    } else {
        ROWS
    };
    let finest = largest(&reference.fine.pressure_pa);
    let peak_pa = reference.peaks_pa.iter().find(|p| p.0 == at).map_or(finest, |p| p.1);
    // a single slice is compared as ten alike
    let (mine, theirs) = if n == 1 {
        (vec![answer.share[0]; SLICES[4]], gathered(&share(&reference.fine.load_n), SLICES[4]))
    } else {
        (answer.share.clone(), gathered(&share(&reference.fine.load_n), n))
    };
    Error3 {
        approach: (answer.approach_m / reference.fine.approach_m - 1.0).abs(),
        load: distance(&mine, &theirs),
        peak: (answer.peak_pa / peak_pa - 1.0).abs(),
        seconds: answer.seconds,
    }
}

fn hertz(contact: &LineContact, normal_n: f64) -> Result<Answer, ContactError> {
    let evaluate = || {
        let q = normal_n / contact.length_m;
        let a = contact.half_width_m(normal_n);
        // elliptical across, uniform along, in the middle of the length: what a hand calculation has
        let middle = q / (PI * contact.contact_modulus_pa) * (2.0 * (2.0 * contact.length_m / a).ln() + 1.0);
        Ok((middle, contact.peak_pressure_pa(normal_n)))
    };
    // far below the clock's step
    let (_, thousand) = timed(|| {
        for _ in 0..1000 {
            std::hint::black_box(evaluate()?);
        }
        Ok(())
    })?;
    let (approach_m, peak_pa) = evaluate()?;
    Ok(Answer { approach_m, share: vec![1.0], peak_pa, seconds: thousand / 1000.0 })
}

fn slices(law: SliceContact, fit: &AxialFit, normal_n: f64) -> Result<Answer, ContactError> {
    let (found, seconds) = timed(|| law.solve_along(normal_n, fit))?;
    let peak_pa = largest(&found.pressure_pa);
    Ok(Answer { approach_m: found.approach_m, share: share(&found.load_n), peak_pa, seconds })
}

fn grid(law: HalfSpaceLine, fit: &AxialFit, normal_n: f64) -> Result<Answer, ContactError> {
    let (found, seconds) = timed(|| law.solve_along(normal_n, fit))?;
    let peak_pa = largest(&found.pressure_pa);
    Ok(Answer { approach_m: found.approach_m, share: share(&found.load_n), peak_pa, seconds })
}

const PAPER: &str = "slices, roller law (1)-(4)";
const HALF_SPACE: &str = "slices on half-spaces";
const GRID: &str = "coarse half-space grid";

/// What every law makes of a contact, and the worst uncertainty and time of the reference.
fn study(contact: LineContact, case: &Case) -> Result<(Vec<Law>, f64, f64), ContactError> {
    let roller = RollerLaw::new(&contact, 3.944e-5)?;
    let mut laws = vec![Law { name: "Hertz".into(), family: "Hertz", errors: Vec::new() }];
    for (family, _) in [(PAPER, 0), (HALF_SPACE, 1)] {
        laws.extend(SLICES.map(|n| Law { name: format!("{n}"), family, errors: Vec::new() }));
    }
    let grids = [(8, 10), (16, 20), (16, 40), (32, 80), (32, 160)];
    laws.extend(grids.map(|(x, n)| Law { name: format!("{x} x {n}"), family: GRID, errors: Vec::new() }));
    let (mut uncertainty, mut seconds) = (0.0f64, 0.0f64);
    for normal_n in LOADS_N {
        let wanted = reference(contact, &case.fit, normal_n)?;
        uncertainty = uncertainty.max(wanted.uncertainty);
        seconds = seconds.max(wanted.seconds);
        let mut answers = vec![hertz(&contact, normal_n)?];
        for compliance in [SliceCompliance::Roller(roller), SliceCompliance::HalfSpace] {
            for n in SLICES {
                let law = SliceContact::with_compliance(contact, compliance, n)?;
                answers.push(slices(law, &case.fit, normal_n)?);
            }
        }
        for (across, rows) in grids {
            answers.push(grid(HalfSpaceLine::new(contact, across, rows), &case.fit, normal_n)?);
        }
        for (law, answer) in laws.iter_mut().zip(&answers) {
            law.errors.push(errors(answer, &wanted));
        }
    }
    Ok((laws, uncertainty, seconds))
}

fn worst(law: &Law, of: impl Fn(&Error3) -> f64) -> f64 {
    law.errors.iter().map(of).fold(0.0, f64::max)
}

/// Median over the loads: one light, tilted load that no slice resolves does not hide the rest.
fn typical(law: &Law, of: impl Fn(&Error3) -> f64) -> f64 {
    let mut all: Vec<f64> = law.errors.iter().map(of).collect();
    all.sort_by(f64::total_cmp);
    all[all.len() / 2]
}

/// An error below this is as good as none, a choice: the contact's own tolerances are coarser.
const ENOUGH: f64 = 5e-3;

/// Fewest of a family whose median errors of line load and approach are at most twice the family's best, or
/// below [`ENOUGH`].
fn sweet_spot<'a>(laws: &'a [Law], family: &str) -> Option<&'a Law> {
    let of: Vec<&Law> = laws.iter().filter(|l| l.family == family).collect();
    let measures: [fn(&Error3) -> f64; 2] = [|e| e.load, |e| e.approach];
    let limits =
        measures.map(|m| (2.0 * of.iter().map(|l| typical(l, m)).fold(f64::INFINITY, f64::min)).max(ENOUGH));
    of.into_iter().find(|l| measures.iter().zip(&limits).all(|(m, limit)| typical(l, m) <= *limit))
}

fn curves(plot: Plot, laws: &[Law], of: impl Fn(&Error3) -> f64 + Copy) -> String {
    let mut plot = plot;
    plot.log_x = true;
    plot.log_y = true;
    for (family, dash) in
        [("Hertz", Dash::Solid), (PAPER, Dash::Dashed), (HALF_SPACE, Dash::Solid), (GRID, Dash::Dotted)]
    {
        let points = laws
            .iter()
            .filter(|l| l.family == family)
            .map(|l| [1e3 * typical(l, |e| e.seconds), 100.0 * typical(l, of)])
            .collect();
        plot.curves.push(Curve { name: family.into(), points, dash, dots: true, colour: None });
    }
    plot.to_figure()
}

fn line_load(laws: &[Law]) -> String {
    let plot = Plot::new("Time of a solution, ms", "Line load, % of the force misplaced").sized(720.0, 340.0);
    curves(plot, laws, |e| e.load)
}

fn section(page: &mut Page, case: &Case, found: &(Vec<Law>, f64, f64)) {
    let (laws, uncertainty, seconds) = found;
    page.heading(case.name);
    page.paragraph(&format!(
        "Reference: {ACROSS} x {ROWS} cells, at most {seconds:.1} s a solution; halving its rows moves approach and \
         line load by at most {:.2} % (the worst load).",
        100.0 * uncertainty
    ));
    let plot = |title: &str| Plot::new("Time of a solution, ms", title).sized(500.0, 320.0);
    let figures = [
        (curves(plot("Line load, % of the force misplaced"), laws, |e| e.load), "Line load"),
        (curves(plot("Approach, % off"), laws, |e| e.approach), "Approach"),
        (curves(plot("Peak pressure, % off"), laws, |e| e.peak), "Peak pressure"),
    ];
    page.figures(&figures);
    let mut table = Table::new(vec![
        Column::text("law", "Law"),
        Column::text("size", "Slices or cells"),
        Column::number("time_ms", "Time", Unit::Millisecond, 2),
        Column::number("load_percent", "Line load, median", Unit::Percent, 2),
        Column::number("load_worst_percent", "worst", Unit::Percent, 2),
        Column::number("approach_percent", "Approach, median", Unit::Percent, 2),
        Column::number("approach_worst_percent", "worst", Unit::Percent, 2),
        Column::number("peak_percent", "Peak, median", Unit::Percent, 2),
        Column::number("peak_worst_percent", "worst", Unit::Percent, 2),
    ]);
    for law in laws {
        table.row(vec![
            law.family.into(),
            law.name.as_str().into(),
            typical(law, |e| e.seconds).into(),
            typical(law, |e| e.load).into(),
            worst(law, |e| e.load).into(),
            typical(law, |e| e.approach).into(),
            worst(law, |e| e.approach).into(),
            typical(law, |e| e.peak).into(),
            worst(law, |e| e.peak).into(),
        ]);
    }
    page.table("Median and worst over the loads", &table);
    let mut by_load = Table::new(vec![Column::text("law", "Law"), Column::text("size", "Slices or cells")]);
    by_load.columns.extend(LOADS_N.map(|n| {
        let name = format!("{n} N");
        Column::number(&format!("load_percent_at_{n}_n"), &name, Unit::Percent, 2)
    }));
    for law in laws {
        let mut row = vec![law.family.into(), law.name.as_str().into()];
        row.extend(law.errors.iter().map(|e| e.load.into()));
        by_load.row(row);
    }
    page.apart("Share of the force misplaced, by load", |page| {
        page.table("", &by_load);
    });
}

/// The sweet spot of each kind of law.
fn sweet_spots(case: &Case, laws: &[Law]) -> String {
    let spot = |family: &str| {
        sweet_spot(laws, family).map_or(String::new(), |spot| {
            format!(
                "{family}: {} ({} ms; line load {} %, approach {} %, peak {} % off)",
                spot.name,
                significant(1e3 * typical(spot, |e| e.seconds), 2),
                significant(100.0 * typical(spot, |e| e.load), 2),
                significant(100.0 * typical(spot, |e| e.approach), 2),
                significant(100.0 * typical(spot, |e| e.peak), 2),
            )
        })
    };
    format!("{}. {}; {}; {}.", case.name, spot(PAPER), spot(HALF_SPACE), spot(GRID))
}

/// Time of one solution over the number of slices, up to the most allowed.
fn cost(page: &mut Page, contact: LineContact, cases: &[Case]) -> Result<(), ContactError> {
    const COUNTS: [usize; 10] = [1, 10, 20, 60, 160, 320, 500, 1000, 1500, 2000];
    let roller = RollerLaw::new(&contact, 3.944e-5)?;
    let mut plot = Plot::new("Slices", "Time of a solution, ms").sized(720.0, 340.0);
    (plot.log_x, plot.log_y) = (true, true);
    let mut table = Table::new(vec![Column::number("slices", "Slices", Unit::One, 4)]);
    let mut times = Vec::new();
    for case in cases {
        let mut column = Vec::new();
        for n in COUNTS {
            let law = SliceContact::new(contact, roller, n)?;
            column.push(timed(|| law.solve_along(DESIGN_N, &case.fit))?.1);
        }
        let points = COUNTS.iter().zip(&column).map(|(n, t)| [*n as f64, 1e3 * t]).collect();
        plot = plot.curve(case.name, points);
        table.columns.push(Column::number(case.name, case.name, Unit::Millisecond, 3));
        times.push(column);
    }
    for (i, n) in COUNTS.iter().enumerate() {
        let mut row = vec![(*n).into()];
        row.extend(times.iter().map(|column| column[i].into()));
        table.row(row);
    }
    page.heading("Cost of a solution");
    page.paragraph(
        "At 2441 N. Closed slices that lie side by side are a symmetric Toeplitz system, solved in some 6 n^2 operations; \
         each round of the search for the closed ones is one such system. A whole wedge curve needs no solution with \
         straight contacts (one table of ratios per number of slices and process), some 58 a contact with an end profile \
         or a tilt.",
    );
    page.figure(&plot.to_figure(), "Time over the number of slices; a slope of 2 is n^2.");
    page.table("The same", &table);
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    let steel = Material { youngs_modulus_pa: 206e9, poisson_ratio: 0.3, density_kg_m3: 7850.0 };
    let contact = LineContact {
        effective_radius_m: 2.9519e-3,
        length_m: 6e-3,
        contact_modulus_pa: PlaneState::Strain.contact_modulus_pa(&steel, &steel),
    };
    let shaped = |profile, tilt| AxialFit::shaped(contact.length_m, profile, tilt);
    let lundberg = EndDrop::lundberg(&contact, DESIGN_N)?;
    let cases = [
        Case { name: "Square ends", fit: shaped(EndDrop::Square, 0.0)? },
        Case { name: "Lundberg profile for 2441 N", fit: shaped(lundberg, 0.0)? },
        Case { name: "Square ends, tilt 0.5 mrad", fit: shaped(EndDrop::Square, TILT_RAD)? },
    ];
    let mut page = Page::new(PageHead {
        title: "Contact: error against time".into(),
        tool: env!("CARGO_PKG_NAME").into(),
        version: env!("CARGO_PKG_VERSION").into(),
        command: "cargo run --release --example contact_error_vs_time".into(),
        design: "Steel on steel, R = 2.952 mm, l = 6 mm (inner contact of the Huang clutch)".into(),
        design_hash: "no design file".into(),
    });
    let mut found = Vec::new();
    for case in &cases {
        found.push(study(contact, case)?);
        eprintln!("{}", case.name);
    }
    let spots: Vec<String> = cases.iter().zip(&found).map(|(case, found)| sweet_spots(case, &found.0)).collect();
    if let (Some(spot), Some(first)) = (spots.first(), found.first()) {
        page.verdict_in(Tone::Plain, &format!("How many slices are enough, and what they leave: {spot}"));
        page.figure(
            &line_load(&first.0),
            "Load along the contact, square ends: median error over the loads against the time of a solution; lower left is better.",
        );
    }
    page.paragraph(
        "Every law solves the same contacts at 1, 10, 100, 500, 2441, 8000 and 20 000 N a sprag. Line load: half \
         the sum of the differences of load per slice, as a share of the force, the reference averaged over the same \
         slices. Approach: against the half-space's, from the first touch. Peak: largest pressure along the length; at \
         square ends the reference is solved on rows as wide as the slices, because a sharp end has no pressure of its \
         own (Hertz: rows of 0.6 mm, the kindest). Plots show medians over the loads.",
    );
    page.paragraph(
        "The roller law's approach is another quantity than a half-space's (it is a bearing's, fitted), so its \
         distance stays whatever the number of slices; slices on half-spaces have no such scale.",
    );
    cases.iter().zip(&found).for_each(|(case, found)| section(&mut page, case, found));
    cost(&mut page, contact, &cases)?;
    page.heading("Sweet spot");
    page.paragraph(
        "Fewest slices or cells of each kind whose median errors of line load and approach are at most twice the best \
         of the kind, or below 0.5 %. More slices do not help: what is left is one half width for all and a pressure \
         uniform across. An edge pressure is not a matter for slices at all; a coarse grid has it to about 1 % in less \
         than a millisecond.",
    );
    page.list(&spots);
    std::fs::write(OUT, page.to_html())?;
    println!("{OUT}");
    Ok(())
}
