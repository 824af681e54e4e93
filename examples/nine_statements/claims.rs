//! The paper's other claims: initial slip, more friction asked inside than outside, the spring that ends slip.

use std::error::Error;

use rayon::prelude::*;
use sprag_design::design::{Design, Scenario, ScenarioKind};
use sprag_design::dynamics::{Grip, Mode, Place, RunSettings, Sample, rolling};
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
    /// |T_bi|/N_bi asked for at the reversal if A is to stick at once, and N_bi there.
    asked: Option<[f64; 2]>,
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
    let asked = run.engaged.map(|e| {
        let mode = Mode { place: e.place, inner: Grip::Stick, outer: Grip::Stick };
        let f = model.forces(&mode, e.t_s, &e.state);
        [f.t_bi.abs() / f.n_bi, f.n_bi]
    });
    Ok(Reversal { drag_nm, reversing_nm, slip_s: run.initial_slip_s(), asked, run })
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
    let found: Vec<Reversal> =
        tasks.par_iter().map(|&(c, d)| reversal(base, c, d)).collect::<Anyhow<_>>()?;
    let mut slip = Plot::new("drag torque of the spring, Nm", "initial slip, ms").sized(720.0, 340.0);
    let mut asked = Plot::new("reversing torque over drag torque", "|T|/N asked at the reversal").sized(720.0, 340.0);
    (slip.log_x, asked.log_x, asked.log_y) = (true, true, true);
    for (reversing, rows) in REVERSING_NM.iter().zip(found.chunks(drags.len())) {
        let name = format!("{reversing} Nm reverse the race");
        let points = rows.iter().map(|r| [r.drag_nm, r.slip_s.map_or(f64::NAN, |s| 1e3 * s)]).collect();
        slip.curves.push(Curve::new(&name, points));
        let points = rows.iter().map(|r| [reversing / r.drag_nm, r.asked.map_or(f64::NAN, |a| a[0])]).collect();
        asked.curves.push(Curve::new(&name, points));
    }
    let mut table = Table::new(vec![
        Column::number("reversing_nm", "Reversing torque", Unit::NewtonMetre, 3),
        Column::number("drag_nm", "Drag torque", Unit::NewtonMetre, 3),
        Column::number("n_n", "N at the reversal, a sprag", Unit::Newton, 3),
        Column::number("asked", "|T|/N asked there", Unit::One, 4),
        Column::number("slip_ms", "Initial slip", Unit::Millisecond, 3),
        Column::number("slip_um", "Slip path inside", Unit::Micrometre, 3),
        Column::number("n_max", "Largest N", Unit::Newton, 5),
        Column::number("moved", "against Table 1's spring", Unit::Percent, 2),
    ]);
    let at = |c: f64, d: f64| found.iter().find(|r| r.reversing_nm == c && r.drag_nm == d);
    for (c, d) in [(5.0, TABLE_1_NM), (5.0, 0.001), (20.0, TABLE_1_NM), (20.0, 0.001), (100.0, TABLE_1_NM), (100.0, 0.001)] {
        let (Some(r), Some(own)) = (at(c, d), at(c, TABLE_1_NM)) else { continue };
        table.row(vec![
            c.into(),
            d.into(),
            r.asked.map(|a| a[1]).into(),
            r.asked.map(|a| a[0]).into(),
            r.slip_s.into(),
            r.run.inner.distance_m.into(),
            r.run.peaks.normal_max_n.into(),
            (r.run.peaks.normal_max_n / own.run.peaks.normal_max_n - 1.0).into(),
        ]);
    }
    page.paragraph(
        "The scene: free run of 300 rpm, reversal, elastic stop (values assumed, designs/huang2017-bench.toml). When the race \
         stands still against the sprags for an instant, sticking from there on takes the sprags along with the race's \
         acceleration, C/(I_bi + I_1): a tangential force that grows with the reversing torque. What presses them on is \
         the spring alone: N grows with its drag torque. Slip begins where the ratio of both exceeds mu_s.",
    );
    page.table("At the reversal", &table);
    page.figure(
        &slip.marker(TABLE_1_NM, "Table 1").level(0.5, "the paper's half millisecond").to_svg(),
        "Initial slip over the drag torque of the spring.",
    );
    page.figure(
        &asked.level(base.clutch.friction.static_, "mu_s").to_svg(),
        "Friction asked for at the reversal if the inner contact is to stick at once: left of where it crosses mu_s, no slip.",
    );
    // Onset by the sweep: the largest drag torque that still slips.
    let onset: Vec<String> = REVERSING_NM
        .iter()
        .map(|c| {
            let slips = |r: &&Reversal| r.reversing_nm == *c && r.slip_s.is_some_and(|s| s > 0.0);
            let last = found.iter().filter(slips).map(|r| r.drag_nm).fold(0.0, f64::max);
            let within = found.iter().filter(slips).filter_map(|r| r.slip_s).fold(0.0, f64::max);
            format!(
                "{c} Nm: slips up to a drag torque of {} Nm, a ratio of {:.0}; at most for {} ms",
                significant(last, 2),
                c / last,
                significant(1e3 * within, 2)
            )
        })
        .collect();
    page.list(&onset);
    Ok(())
}

/// Least ratio of the friction asked inside to that outside, with N_bi and time there, over samples under load.
fn least_ratio<'s>(samples: impl Iterator<Item = &'s Sample>) -> [f64; 3] {
    let mut least = [f64::INFINITY, 0.0, 0.0];
    for x in samples.filter(|x| matches!(x.mode.place, Place::Arc(_)) && x.forces.n_bi > 0.0 && x.forces.n_be > 0.0) {
        let f = &x.forces;
        let ratio = (f.t_bi.abs() / f.n_bi) / (f.t_be.abs() / f.n_be);
        if ratio < least[0] {
            least = [ratio, f.n_bi, x.t];
        }
    }
    least
}

const SAMPLES: usize = 6001;

fn inner_above_outer(page: &mut Page, multi: &Design) -> Anyhow<()> {
    page.heading("The inner contact is always asked for more friction than the outer");
    let mut table = Table::new(vec![
        Column::text("scene", "Scene"),
        Column::number("rolled", "Rolled: least inner/outer", Unit::One, 4),
        Column::number("rolled_n", "at N", Unit::Newton, 3),
        Column::number("stuck", "Both stick: least", Unit::One, 4),
        Column::number("stuck_n", "at N", Unit::Newton, 3),
        Column::number("other", "One slips: least", Unit::One, 4),
        Column::number("other_n", "at N", Unit::Newton, 3),
        Column::number("more", "Time with more outside, one slips", Unit::Percent, 2),
    ]);
    let names = ["high-6", "high-8", "high-10", "low-6", "low-10", "low-6-mu082", "low-8-mu082", "low-10-mu082", "rated-45"];
    for name in names {
        let scene = scene(multi, name)?;
        let p = prepare(scene)?;
        let settings = RunSettings {
            tolerance: 1e-9,
            duration_s: p.duration_s,
            longest_step_s: 5e-4,
            most_events: 100_000,
            most_steps: 200_000,
            samples: SAMPLES,
            rolling: true,
            interrupt: None,
        };
        let rolled = least_ratio(rolling(&p.model, p.state, p.mode.place, &settings).run.samples.iter());
        let s = simulate(scene, &Settings { samples: SAMPLES, ..Settings::default() })?;
        let both = |x: &&Sample| x.mode.inner == Grip::Stick && x.mode.outer == Grip::Stick;
        let stuck = least_ratio(s.samples.iter().filter(both));
        let other = least_ratio(s.samples.iter().filter(|x| !both(x)));
        let more = s.samples.iter().filter(|x| !both(x) && least_ratio(std::iter::once(*x))[0] < 1.0).count();
        let slipped = other[0].is_finite();
        let some = |v: f64| if slipped { Cell::Si(v) } else { Cell::Empty };
        table.row(vec![
            name.into(),
            rolled[0].into(),
            rolled[1].into(),
            stuck[0].into(),
            stuck[1].into(),
            some(other[0]),
            some(other[1]),
            some(more as f64 / s.samples.len() as f64),
        ]);
    }
    page.paragraph(
        "At rest T_bi OA = T_be OB, so the inner contact is asked for OB/OA = 1.75 times as much tangential force, and N_be \
         is all but N_bi. In motion the sprag's inertia adds to it, which matters only as N nears 0. Where the friction \
         is mobilised |T|/N is no demand but the friction law.",
    );
    page.table("|T_bi|/N_bi over |T_be|/N_be, smallest over 6001 samples", &table);
    Ok(())
}

fn spring(page: &mut Page, bench: &Design) -> Anyhow<()> {
    page.heading("The spring ends the slip");
    let mut table = Table::new(vec![
        Column::text("scene", "Scene"),
        Column::number("time_s", "Time simulated", Unit::Second, 2),
        Column::text("verdict", "Verdict"),
        Column::number("first_ms", "Opens first at", Unit::Millisecond, 4),
        Column::number("last_ms", "for good at", Unit::Millisecond, 4),
        Column::number("lost_ms", "Time without contact", Unit::Millisecond, 4),
        Column::number("theta", "Inner race at the end", Unit::Radian, 4),
    ]);
    for (name, with, time_s) in [
        ("high-10-without-spring", true, 0.3),
        ("high-10-without-spring", false, 0.3),
        ("high-10-without-spring", false, 3.0),
        ("engagement", true, 0.3),
        ("engagement-without-spring", false, 0.3),
    ] {
        let mut scene = scene(bench, name)?.clone();
        if with {
            scene.clutch.spring = bench.clutch.spring;
        }
        if let ScenarioKind::TorsionalExcitation { duration_s, .. } = &mut scene.kind {
            *duration_s = time_s;
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
            time_s.into(),
            s.verdict.map_or(s.stop.name(), |v| v.name()).into(),
            s.modes.iter().find(open).map(|m| m.0).into(),
            last.into(),
            s.contact_lost_s.into(),
            s.theta_inner_rad.into(),
        ]);
    }
    page.table("", &table);
    page.paragraph(
        "Without the spring nothing turns an open sprag back: it keeps the rotation with which it left, and neither race \
         touches it again.",
    );
    Ok(())
}

/// All three.
pub fn write(page: &mut Page, multi: &Design, bench: &Design) -> Anyhow<()> {
    initial_slip(page, bench)?;
    inner_above_outer(page, multi)?;
    spring(page, bench)
}
