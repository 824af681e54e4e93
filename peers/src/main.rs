//! Integrators of others on the clutch's own right-hand side: error of theta_bi over work, beside ours and the published.
//!
//! `cargo run --release --manifest-path peers/Cargo.toml` in the root of the sources writes reports/accuracy-peers.html
//! (some minutes to build: the peers bring their own linear algebra).

use std::cell::Cell;
use std::error::Error;
use std::path::Path;
use std::time::Instant;

use differential_equations::prelude::{ExplicitRungeKutta, IVP, ImplicitRungeKutta, ODE};
use diffsol::{NalgebraLU, NalgebraMat, OdeBuilder, OdeSolverMethod};
use sprag_design::Design;
use sprag_design::design::{Scenario, ScenarioKind};
use sprag_design::dynamics::{N_STATE, PublishedSettings, RunSettings, State, published, run};
use sprag_design::report::plot::{Curve, Dash};
use sprag_design::report::{Cell as Entry, Column, Page, PageHead, Plot, Table, Unit, significant};
use sprag_design::scenario::{Prepared, prepare};

const DESIGN: &str = "designs/huang2017-multi-arc.toml";
const OUT: &str = "reports/accuracy-peers.html";
const TOLERANCES: [f64; 6] = [1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-10];
const STEPS_S: [f64; 5] = [1e-4, 3e-5, 1e-5, 3e-6, 1e-6];
/// Error at which the methods are compared, rad.
const WANTED_RAD: f64 = 1e-6;
/// Increment of a directional difference, relative.
const NUDGE: f64 = 1e-7;

/// theta_bi at the end and right-hand sides; none where the method gave up.
type Answer = Option<(f64, u64)>;

struct Point {
    setting: f64,
    error_rad: Option<f64>,
    rhs: u64,
    seconds: f64,
}

struct Clutch<'a> {
    prepared: &'a Prepared,
    calls: Cell<u64>,
}

impl Clutch<'_> {
    fn slope(&self, t: f64, y: &State) -> State {
        self.calls.set(self.calls.get() + 1);
        // The peers know no right-hand side that fails.
        self.prepared.model.slope(&self.prepared.mode, t, y).unwrap_or([f64::NAN; N_STATE])
    }
}

impl ODE<f64, State> for Clutch<'_> {
    fn diff(&self, t: f64, y: &State, dydt: &mut State) {
        *dydt = self.slope(t, y);
    }
}

/// Absolute tolerances as the tool's own for a relative one: angles, rates, slip.
fn absolute(tolerance: f64) -> State {
    let (angle, rate, slip) = (1e-2 * tolerance, 10.0 * tolerance, 1e-3 * tolerance);
    [angle, angle, angle, angle, rate, rate, rate, rate, slip, slip]
}

fn ours(p: &Prepared, tolerance: f64, per_period: f64) -> Answer {
    let longest_step_s = p.period_s? / per_period;
    let settings = RunSettings {
        tolerance,
        duration_s: p.duration_s,
        longest_step_s,
        most_events: 0,
        most_steps: 5_000_000,
        samples: 0,
        rolling: false,
        interrupt: None,
    };
    let r = run(&p.model, p.state, p.mode, &settings);
    (r.t_s >= p.duration_s).then_some((r.state[2], r.counters.rhs_evaluations))
}

fn scheme(p: &Prepared, step_s: f64) -> Answer {
    let s = PublishedSettings { duration_s: p.duration_s, step_s, band_m_s: 1e-4, samples: 0 };
    let r = published(&p.model, p.state, &s, &mut |_| true);
    Some((r.state[2], r.counters.rhs_evaluations))
}

fn differential(p: &Prepared, tolerance: f64, implicit: bool) -> Answer {
    let clutch = Clutch { prepared: p, calls: Cell::new(0) };
    let ivp = IVP::ode(&clutch, 0.0, p.duration_s, p.state);
    let (first, atol) = (1e-6, absolute(tolerance));
    let solution = if implicit {
        let m = ImplicitRungeKutta::radau5().rtol(tolerance).atol(atol).h0(first).max_steps(1_000_000);
        ivp.method(m).solve().ok()?
    } else {
        let m = ExplicitRungeKutta::dop853().rtol(tolerance).atol(atol).h0(first).max_steps(1_000_000);
        ivp.method(m).solve().ok()?
    };
    let reached = solution.t.last().is_some_and(|t| (t / p.duration_s - 1.0).abs() < 1e-9);
    solution.y.last().filter(|_| reached).map(|y| (y[2], clutch.calls.get()))
}

fn diffsol(p: &Prepared, tolerance: f64, implicit: bool) -> Answer {
    let clutch = Clutch { prepared: p, calls: Cell::new(0) };
    let full = |x: &[f64]| -> State { std::array::from_fn(|i| x[i]) };
    let problem = OdeBuilder::<NalgebraMat<f64>>::new()
        .rtol(tolerance)
        .atol(absolute(tolerance))
        .h0(1e-6)
        .rhs_implicit(
            |x, _p, t, y| y.copy_from_slice(&clutch.slope(t, &full(x))),
            |x, _p, t, v, y| {
                // Derivative along v by a difference, scaled to the state.
                let size = v.iter().fold(0.0_f64, |m, v| m.max(v.abs())).max(f64::MIN_POSITIVE);
                let h = NUDGE / size;
                let base = full(x);
                let moved: State = std::array::from_fn(|i| base[i] + h * v[i]);
                let (a, b) = (clutch.slope(t, &base), clutch.slope(t, &moved));
                for (y, (a, b)) in y.iter_mut().zip(a.iter().zip(&b)) {
                    *y = (b - a) / h;
                }
            },
        )
        .init(|_p, _t, y| y.copy_from_slice(&p.state), N_STATE)
        .build()
        .ok()?;
    let theta = if implicit {
        let mut solver = problem.bdf::<NalgebraLU<f64>>().ok()?;
        let (ys, _, _) = solver.solve(p.duration_s).ok()?;
        last(&ys)
    } else {
        let mut solver = problem.tsit45().ok()?;
        let (ys, _, _) = solver.solve(p.duration_s).ok()?;
        last(&ys)
    };
    theta.is_finite().then_some((theta, clutch.calls.get()))
}

/// theta_bi in the last column.
fn last(ys: &NalgebraMat<f64>) -> f64 {
    use diffsol::{DenseMatrix, Matrix, VectorCommon};
    let column = ys.column(ys.ncols() - 1).into_owned();
    column.inner()[2]
}

fn timed(reference: f64, setting: f64, go: impl Fn(f64) -> Answer) -> Point {
    let (mut times, begun) = (Vec::new(), Instant::now());
    loop {
        let start = Instant::now();
        let found = std::hint::black_box(go(setting));
        times.push(start.elapsed().as_secs_f64());
        if begun.elapsed().as_secs_f64() > 0.1 {
            times.sort_by(f64::total_cmp);
            let (error_rad, rhs) = match found {
                Some((theta, rhs)) => (Some((theta - reference).abs()), rhs),
                None => (None, 0),
            };
            return Point { setting, error_rad, rhs, seconds: times[times.len() / 2] };
        }
    }
}

type Series = (&'static str, Vec<Point>);

fn compare(p: &Prepared) -> Option<(f64, Vec<Series>)> {
    let reference = ours(p, 1e-13, 40.0)?.0;
    let all = |values: &[f64], go: &dyn Fn(f64) -> Answer| -> Vec<Point> {
        values.iter().map(|&s| timed(reference, s, go)).collect()
    };
    let series = vec![
        ("ours", all(&TOLERANCES, &|t| ours(p, t, 8.0))),
        ("diffsol tsit45", all(&TOLERANCES, &|t| diffsol(p, t, false))),
        ("diffsol BDF", all(&TOLERANCES, &|t| diffsol(p, t, true))),
        ("differential-equations dop853", all(&TOLERANCES, &|t| differential(p, t, false))),
        ("differential-equations radau5", all(&TOLERANCES, &|t| differential(p, t, true))),
        ("published", all(&STEPS_S, &|h| scheme(p, h))),
    ];
    Some((reference, series))
}

/// Cheapest setting below the wanted error from which every finer one stays below it too.
fn cheapest(points: &[Point]) -> Option<&Point> {
    let good = |p: &Point| p.error_rad.is_some_and(|e| e <= WANTED_RAD);
    let from = points.iter().rposition(|p| !good(p)).map_or(0, |i| i + 1);
    points[from..].iter().min_by(|a, b| a.seconds.total_cmp(&b.seconds))
}

fn sentence(series: &[Series]) -> String {
    let each = series.iter().map(|(name, points)| match cheapest(points) {
        Some(p) => format!("{name} {} ms, {} right-hand sides", significant(1e3 * p.seconds, 3), p.rhs),
        None => format!("{name} never"),
    });
    format!("Below {WANTED_RAD:.0e} rad: {}.", each.collect::<Vec<_>>().join("; "))
}

fn plot(series: &[Series], title: &str, x: impl Fn(&Point) -> f64) -> String {
    let mut plot = Plot::new(title, "Error of theta_bi, rad").level(WANTED_RAD, "wanted").sized(500.0, 320.0);
    (plot.log_x, plot.log_y) = (true, true);
    for (name, points) in series {
        let at = |p: &Point| [x(p), p.error_rad.map_or(f64::NAN, |e| e.max(1e-15))];
        let dash = if *name == "published" { Dash::Dotted } else { Dash::Solid };
        let points = points.iter().map(at).collect();
        plot.curves.push(Curve { dash, dots: true, ..Curve::new(name, points) });
    }
    plot.to_svg()
}

fn table(series: &[Series]) -> Table {
    let mut table = Table::new(vec![
        Column::text("method", "Method"),
        Column::text("setting", "Tolerance or step, s"),
        Column::number("theta_inner_error_rad", "Error", Unit::Radian, 2),
        Column::number("rhs_evaluations", "Right-hand sides", Unit::One, 6),
        Column::number("run_time_ms", "Time", Unit::Millisecond, 3),
    ]);
    for (name, points) in series {
        for p in points {
            let rhs = Entry::Count(usize::try_from(p.rhs).unwrap_or(usize::MAX));
            let setting = format!("{:.0e}", p.setting);
            table.row(vec![(*name).into(), setting.into(), p.error_rad.into(), rhs, p.seconds.into()]);
        }
    }
    table
}

const OMISSIONS: [&str; 6] = [
    "Only scenes without a change of mode: there all methods have the same smooth right-hand side, and nobody's way of \
     finding events decides. Slip, lift-off and the passing from arc to arc are therefore not compared with peers.",
    "Ours looks for events and extremes in every step all the same, keeps the windup to the rolling constraint, and never \
     steps farther than an eighth of the excitation's period; the peers do none of this.",
    "Absolute tolerances follow the relative one in the same way for all (1e-2 of it for angles, 10 for rates, 1e-3 for slip).",
    "The peers take their Jacobians by differences, as ours does where it needs one.",
    "Times are medians on one thread of a machine that others use too.",
    "The published scheme runs with a band of 1e-4 m/s; other bands are in the report of the command accuracy.",
];

fn scenes(design: &Design) -> Vec<(String, Scenario)> {
    let Some(base) = design.scenario("high-6") else { return Vec::new() };
    let stiffer = |k: f64| {
        let mut s = base.clone();
        if let ScenarioKind::TorsionalExcitation { abutment_stiffness_nm_per_rad, .. } = &mut s.kind {
            *abutment_stiffness_nm_per_rad = k;
        }
        s
    };
    vec![
        ("high-6".to_owned(), base.clone()),
        ("high-6 with an abutment of 1e6 Nm/rad".to_owned(), stiffer(1e6)),
        ("high-6 with an abutment of 1e8 Nm/rad".to_owned(), stiffer(1e8)),
    ]
}

fn main() -> Result<(), Box<dyn Error>> {
    let design = Design::read(Path::new(DESIGN))?;
    let mut page = Page::new(PageHead {
        title: "Accuracy beside other integrators".into(),
        tool: "sprag-design".into(),
        version: env!("CARGO_PKG_VERSION").into(),
        command: "cargo run --release --manifest-path peers/Cargo.toml".into(),
        design: design.name.clone(),
        design_hash: design.hash.clone(),
    });
    let (mut won, mut count) = (0, 0);
    let mut sections = Vec::new();
    for (name, scenario) in scenes(&design) {
        let prepared = prepare(&scenario)?;
        let Some((reference, series)) = compare(&prepared) else {
            sections.push((name, None));
            continue;
        };
        count += 1;
        let time = |s: &Series| cheapest(&s.1).map_or(f64::INFINITY, |p| p.seconds);
        won += usize::from(series[1..].iter().all(|s| time(&series[0]) < time(s)));
        println!("{name}: {}", sentence(&series));
        sections.push((name, Some((reference, series))));
    }
    page.verdict(won == count, &format!("Ours is the cheapest below {WANTED_RAD:.0e} rad in {won} of {count} scenes"));
    for (name, found) in &sections {
        page.heading(name);
        let Some((reference, series)) = found else {
            page.paragraph("Changes its mode: not compared.");
            continue;
        };
        page.paragraph(&sentence(series));
        page.paragraph(&format!("Reference: theta_bi {reference:.12} rad, by ours at 1e-13."));
        page.figures(&[
            (plot(series, "Right-hand sides", |p| p.rhs as f64), "Error over right-hand sides."),
            (plot(series, "Time, ms", |p| 1e3 * p.seconds), "Error over time."),
        ]);
        page.table("", &table(series));
    }
    page.heading("Omissions").list(OMISSIONS);
    page.source("Design file", &design.source);
    std::fs::write(OUT, page.to_html())?;
    Ok(())
}
