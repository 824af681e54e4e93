//! The paper's other claims: initial slip, more friction asked inside than outside, the spring that ends slip.

use std::error::Error;

use rayon::prelude::*;
use sprag_design::clutch::{Scenario, ScenarioKind};
use sprag_design::design::Design;
use sprag_design::dynamics::{Grip, Mode, Peaks, Place, RunSettings, Sample, rolling};
use sprag_design::report::plot::Curve;
use sprag_design::report::{Cell, Column, Page, Plot, Table, Unit, significant};
use sprag_design::scenario::{Settings, Simulation, prepare, simulate};

type Anyhow<T> = Result<T, Box<dyn Error + Send + Sync>>;

/// The scene of that name.
pub fn scene<'d>(design: &'d Design, name: &str) -> Anyhow<&'d Scenario> {
    design.scenario(name).ok_or_else(|| format!("no scene {name}").into())
}

/// What happens where the race reverses.
struct Reversal {
    drag_nm: f64,
    reversing_nm: f64,
    slip_s: Option<f64>,
    /// |T_bi|/N_bi asked for at the reversal if A is to stick at once while B goes on as it does, and N_bi there.
    asked: Option<[f64; 2]>,
    /// Whether B slips there.
    outer_slips: bool,
    run: Simulation,
}

fn reversal(base: &Scenario, reversing_nm: f64, drag_nm: f64) -> Anyhow<Reversal> {
    let mut scene = base.clone();
    scene.clutch.spring.drag_torque_nm = drag_nm;
    if let ScenarioKind::Engagement { reversing_torque_nm, .. } = &mut scene.kind {
        *reversing_torque_nm = reversing_nm;
    }
    let model = prepare(&scene)?.model;
    let run = simulate(&scene, &Settings { samples: 2, ..Settings::default() })?;
    let outer = run.engaged.and_then(|e| run.modes.iter().rev().find(|m| m.0 <= e.t_s)).map(|m| m.1.outer);
    let asked = run.engaged.map(|e| {
        let mode = Mode { place: e.place, inner: Grip::Stick, outer: outer.unwrap_or(Grip::Stick) };
        let f = model.forces(&mode, e.t_s, &e.state);
        [f.t_bi.abs() / f.n_bi, f.n_bi]
    });
    Ok(Reversal {
        drag_nm,
        reversing_nm,
        slip_s: run.initial_slip_s(),
        asked,
        outer_slips: outer != Some(Grip::Stick),
        run,
    })
}

const REVERSING_NM: [f64; 3] = [5.0, 20.0, 100.0];
const TABLE_1_NM: f64 = 0.0166;
/// Drag torques from 1e-4 Nm, six to the factor of 2, up to twice Table 1's.
const DRAGS: usize = 51;

fn initial_slip(page: &mut Page, bench: &Design) -> Anyhow<()> {
    let base = scene(bench, "engagement")?;
    page.heading("Initial slip of about half a millisecond, with little effect on the torque");
    let mut drags: Vec<f64> = (0..DRAGS).map(|i| 1e-4 * (i as f64 / 6.0).exp2()).collect();
    drags.extend([0.001, TABLE_1_NM]);
    drags.sort_by(f64::total_cmp);
    let tasks: Vec<(f64, f64)> =
        REVERSING_NM.iter().flat_map(|c| drags.iter().map(move |d| (*c, *d))).collect();
    let found: Vec<Reversal> = tasks.par_iter().map(|&(c, d)| reversal(base, c, d)).collect::<Anyhow<_>>()?;
    let mut slip = Plot::new("drag torque of the spring, Nm", "initial slip, ms").sized(720.0, 340.0);
    let mut ratio = Plot::new("reversing torque over drag torque", "initial slip, ms").sized(720.0, 340.0);
    (slip.log_x, slip.log_y, ratio.log_x, ratio.log_y) = (true, true, true, true);
    for (reversing, rows) in REVERSING_NM.iter().zip(found.chunks(drags.len())) {
        let name = format!("{reversing} Nm reverse the race");
        let over =
            |x: fn(&Reversal) -> f64| rows.iter().map(|r| [x(r), 1e3 * r.slip_s.unwrap_or(0.0)]).collect();
        slip.curves.push(Curve::new(&name, over(|r| r.drag_nm)));
        ratio.curves.push(Curve::new(&name, over(|r| r.reversing_nm / r.drag_nm)));
    }
    let mut table = Table::new(vec![
        Column::number("reversing_nm", "Reversing torque", Unit::NewtonMetre, 3),
        Column::number("drag_nm", "Drag torque", Unit::NewtonMetre, 3),
        Column::number("n_n", "N at the reversal, a sprag", Unit::Newton, 3),
        Column::number("asked", "|T|/N asked there", Unit::One, 4),
        Column::text("outer", "Outer contact then"),
        Column::number("slip_ms", "Initial slip", Unit::Millisecond, 3),
        Column::number("time_ms", "All slip inside", Unit::Millisecond, 3),
        Column::number("slip_um", "Path of all slip inside", Unit::Micrometre, 3),
        Column::number("open_ms", "Lost contact, free run too", Unit::Millisecond, 3),
        Column::number("n_max", "Largest N", Unit::Newton, 5),
        Column::number("moved", "against Table 1's spring", Unit::Percent, 2),
    ]);
    let at = |c: f64, d: f64| found.iter().find(|r| r.reversing_nm == c && r.drag_nm == d);
    for (c, d) in [
        (5.0, TABLE_1_NM),
        (5.0, 0.001),
        (20.0, TABLE_1_NM),
        (20.0, 0.001),
        (100.0, TABLE_1_NM),
        (100.0, 0.001),
    ] {
        let (Some(r), Some(own)) = (at(c, d), at(c, TABLE_1_NM)) else { continue };
        table.row(vec![
            c.into(),
            d.into(),
            r.asked.map(|a| a[1]).into(),
            r.asked.map(|a| a[0]).into(),
            if r.outer_slips { "slips" } else { "sticks" }.into(),
            r.slip_s.into(),
            r.run.inner.time_s.into(),
            r.run.inner.distance_m.into(),
            r.run.contact_lost_s.into(),
            r.run.peaks.normal_max_n.into(),
            (r.run.peaks.normal_max_n / own.run.peaks.normal_max_n - 1.0).into(),
        ]);
    }
    page.paragraph(
        "The scene: free run of 300 rpm, reversal, elastic stop (values assumed, designs/huang2017-bench.toml). The instant \
         at which the race ceases to run ahead of the sprags is the reversal. From there on the sprags must keep up \
         with a race that is accelerated by C/(I_bi + I_1), and all that presses them on at first is the spring: N there \
         is some C_f/(n_s R_i mu). So slip grows with the ratio of reversing to drag torque, but the ratio alone does not \
         decide (second figure): the sprags swing in the free run, N at the reversal depends on the phase, so that slip may end \
         and come back as the spring grows stronger; and the lighter the spring, the less the sprags follow the outer race in the \
         free run, so that both contacts slip when the race reverses. Initial slip is the time of slip under load at the inner \
         contact, without that of lost contact, from the reversal to the first stick under which the load comes to a peak; a \
         stick from which it slips on while the load builds up does not end it. All slip is that of the whole scene: it is more \
         where the sprags slip again later, as where the race bounces off its stop and they let go, which moves the largest N \
         too.",
    );
    page.table("At the reversal", &table);
    page.figure(
        &slip.marker(TABLE_1_NM, "Table 1").level(0.5, "the paper's half millisecond").to_figure(),
        "Initial slip over the drag torque; no point: none.",
    );
    page.figure(&ratio.to_figure(), "The same over the ratio of the torques.");
    let onset: Vec<String> = REVERSING_NM
        .iter()
        .zip(found.chunks(drags.len()))
        .map(|(c, rows)| {
            let some = ranges(rows, |slip_s| slip_s > 0.0);
            let half = ranges(rows, |slip_s| (4e-4..=6e-4).contains(&slip_s));
            format!("{c} Nm: initial slip with drag torques of {some}; it lasts 0.4 to 0.6 ms with {half}")
        })
        .collect();
    let [first, last] =
        [drags.first(), drags.last()].map(|d| d.map_or(String::new(), |&d| significant(d, 3)));
    page.paragraph(&format!(
        "Of the {} drag torques tried, from {first} to {last} Nm, by the first and last of those next to one another:",
        drags.len()
    ));
    page.list(&onset);
    Ok(())
}

/// The drag torques of `rows` whose initial slip `counts`, Nm: first and last of those that follow one another.
fn ranges(rows: &[Reversal], counts: impl Fn(f64) -> bool) -> String {
    let both = |a: &Reversal, b: &Reversal| counts_in(a, &counts) == counts_in(b, &counts);
    let runs = rows.chunk_by(both).filter(|run| counts_in(&run[0], &counts));
    let said = runs.map(|run| match run {
        [one] => significant(one.drag_nm, 3),
        [first, .., last] => format!("{} to {}", significant(first.drag_nm, 3), significant(last.drag_nm, 3)),
        [] => String::new(),
    });
    let said: Vec<String> = said.collect();
    if said.is_empty() { "none".to_owned() } else { format!("{} Nm", said.join(", ")) }
}

fn counts_in(of: &Reversal, counts: impl Fn(f64) -> bool) -> bool {
    of.slip_s.is_some_and(counts)
}

/// Where the outer contact is asked for more than the inner: share of the samples, largest N_bi, largest |T_be|/N_be.
#[derive(Default)]
struct MoreOutside {
    share: f64,
    normal_n: f64,
    outer: f64,
}

fn more_outside(samples: &[Sample], counts: impl Fn(&Sample) -> bool) -> MoreOutside {
    let mut found = MoreOutside::default();
    for x in samples.iter().filter(|x| matches!(x.mode.place, Place::Arc(_)) && counts(x)) {
        let f = &x.forces;
        let (inner, outer) = (f.t_bi.abs() / f.n_bi, f.t_be.abs() / f.n_be);
        if f.n_bi > 0.0 && f.n_be > 0.0 && outer > inner {
            found.share += 1.0 / samples.len() as f64;
            found.normal_n = found.normal_n.max(f.n_bi);
            found.outer = found.outer.max(outer);
        }
    }
    found
}

const SAMPLES: usize = 30_001;

fn inner_above_outer(page: &mut Page, multi: &Design) -> Anyhow<()> {
    page.heading("The inner contact is always asked for more friction than the outer");
    let mut table = Table::new(vec![
        Column::text("scene", "Scene"),
        Column::text("run", "Run"),
        Column::number("inner", "Largest |T|/N inside", Unit::One, 4),
        Column::number("outer", "outside", Unit::One, 4),
        Column::number("least_n", "Smallest N", Unit::Newton, 3),
        Column::number("share", "Time with more outside", Unit::Percent, 2),
        Column::number("below_n", "only below N", Unit::Newton, 3),
        Column::number("at_most", "then outside at most", Unit::One, 3),
    ]);
    let mut row = |name: &str, run: &str, peaks: [f64; 3], m: &MoreOutside| {
        let some = |v: f64| if m.share > 0.0 { Cell::Si(v) } else { Cell::Empty };
        let [inner, outer, least] = peaks;
        table.row(vec![
            name.into(),
            run.into(),
            if least >= 0.0 { inner.into() } else { Cell::from("unbounded") },
            if least >= 0.0 { outer.into() } else { Cell::from("unbounded") },
            least.into(),
            m.share.into(),
            some(m.normal_n),
            some(m.outer),
        ]);
    };
    let names = [
        "high-6",
        "high-8",
        "high-10",
        "low-6",
        "low-8",
        "low-10",
        "low-8-mu082",
        "low-10-mu082",
        "rated-45",
    ];
    for name in names {
        let scene = scene(multi, name)?;
        let p = prepare(scene)?;
        let settings = RunSettings {
            tolerance: 1e-9,
            duration_s: p.duration_s,
            longest_step_s: 5e-4,
            most_steps: 200_000,
            samples: SAMPLES,
            rolling: true,
            ..RunSettings::default()
        };
        let rolled = rolling(&p.model, p.state, p.mode.place, &settings).run;
        let peaks = |p: &Peaks| [p.tan_inner, p.tan_outer, p.normal_min_n];
        row(name, "rolled", peaks(&rolled.peaks), &more_outside(&rolled.samples, |_| true));
        let s = simulate(scene, &Settings { samples: SAMPLES, ..Settings::default() })?;
        if s.inner.time_s > 0.0 {
            let both = |x: &Sample| x.mode.inner == Grip::Stick && x.mode.outer == Grip::Stick;
            // Of friction at its limit both peaks are mu_s; below 0 the contact would pull.
            let p = [s.peaks.tan_inner, s.peaks.tan_outer, s.peaks.normal_min_n];
            row(name, "real, both stick", p, &more_outside(&s.samples, both));
            row(name, "real, one slips", p, &more_outside(&s.samples, |x| !both(x)));
        }
    }
    page.paragraph(
        "At rest T_bi OA = T_be OB, so the inner contact is asked for OB/OA = 1.75 times as much tangential force, and N_be \
         is all but N_bi. In motion the sprag's inertia comes in: where N nears 0 both forces pass through 0, not at the \
         same instant, and between the two the outer one is larger. So the claim holds wherever the clutch carries \
         load, rolled or real, and fails at a few newtons, with both contacts sticking too.",
    );
    page.table("Where the outer contact is asked for more (30 001 samples of 10 us)", &table);
    Ok(())
}

fn spring(page: &mut Page, bench: &Design) -> Anyhow<()> {
    page.heading("The spring ends the slip");
    let mut table = Table::new(vec![
        Column::text("scene", "Scene"),
        Column::text("verdict", "Verdict"),
        Column::text("end", "Run ends"),
        Column::number("t_ms", "at", Unit::Millisecond, 4),
        Column::number("n", "Largest N", Unit::Newton, 4),
        Column::number("first_ms", "Opens first at", Unit::Millisecond, 4),
        Column::number("last_ms", "for good at", Unit::Millisecond, 4),
        Column::number("lost_ms", "Time without contact", Unit::Millisecond, 4),
        Column::number("theta", "Inner race at the end", Unit::Radian, 4),
    ]);
    for (name, with) in [
        ("high-10-without-spring", true),
        ("high-10-without-spring", false),
        ("engagement", true),
        ("engagement-without-spring", false),
    ] {
        let mut scene = scene(bench, name)?.clone();
        if with {
            scene.clutch.spring = bench.clutch.spring;
        }
        let s = simulate(&scene, &Settings { samples: 2, ..Settings::default() })?;
        let open = |m: &&(f64, Mode)| m.1.place == Place::Open;
        let last = s.modes.last().filter(open).map(|_| {
            // The first of the open modes at the end.
            s.modes.iter().rev().take_while(open).last().map_or(0.0, |m| m.0)
        });
        let label = if with { "with Table 1's spring" } else { "without" };
        let kind = if name.starts_with("high") { "3.34 Nm, 10 Nm" } else { "engagement" };
        table.row(vec![
            format!("{kind}, {label}").into(),
            s.verdict.map_or(s.stop.name(), |v| v.name()).into(),
            s.stop.name().into(),
            s.t_s.into(),
            s.peaks.normal_max_n.into(),
            s.modes.iter().find(open).map(|m| m.0).into(),
            last.into(),
            s.contact_lost_s.into(),
            s.theta_inner_rad.into(),
        ]);
    }
    page.table("", &table);
    page.paragraph(
        "Without the spring nothing turns an open sprag back: it goes on as it left until it is out of reach (fell-away). In \
         the engagement the sprags only touch, N = 0, and the race turns back through them: its net slip is all its way.",
    );
    Ok(())
}

/// All three.
pub fn write(page: &mut Page, multi: &Design, bench: &Design) -> Anyhow<()> {
    initial_slip(page, bench)?;
    inner_above_outer(page, multi)?;
    spring(page, bench)
}
