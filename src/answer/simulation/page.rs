//! The HTML report of a simulation.

use super::stretch::Stretch;
use super::{HistoryRow, Ran, SimulationAnswer, facts, slip as slip_words, train};
use crate::answer::page::{draw, drawing, half, opened, pose_at_rest, pose_at_torque};
use crate::answer::{Answer, Provenance};
use crate::clutch::{Phrase, ScenarioKind};
use crate::report::{Cell, Curve, Dash, Page, Plot, Unit};
use crate::scenario::{Group, Prepared, Simulation, figures_of};
use crate::wedge::{Lengthwise, Side, along};

/// From here on ticks run into the title of the axis, which is then in the next larger unit.
const FOUR_DIGITS: f64 = 9000.0;
/// Friction is drawn up to this many times the static one: Vernay's outer contact, which holds whatever that takes, has
/// no bound where it is all but unloaded.
const DRAWN_FRICTION: f64 = 2.0;

/// The page.
pub(super) fn page(scene: &SimulationAnswer, provenance: &Provenance) -> Page {
    let title = format!("Simulation of {}", scene.scenario.name);
    let mut page = opened(&title, &scene.design, &provenance.command, |page| {
        page.verdict_in(scene.tone(), &scene.verdict_line());
    });
    page.paragraph(&described(scene));
    page.list(&scene.body.notes);
    let (first, all) = facts::first_and_all(facts::table(scene));
    page.long_table("", &first);
    if let Ok((prepared, simulation)) = &scene.outcome {
        if scene.method != "equilibrium" {
            histories(&mut page, scene, prepared, simulation);
        }
        page.list(slip_words::lines(simulation));
        if let Some(mut all) = all {
            // What slip does to its surfaces stands above in words.
            let said: Vec<&str> =
                figures_of(Group::Slip).iter().filter_map(|f| Some(f.line?.label)).collect();
            let is_said = |row: &[Cell]| match row.first() {
                Some(Cell::Text(name)) => said.iter().any(|label| name.starts_with(label)),
                _ => false,
            };
            all.rows.retain(|row| !is_said(row));
            page.folded("All figures of this scene but those of slip, with their errors", |page| {
                page.long_table("", &all);
            });
        }
        if let Some(table) = facts::beside_rolling(simulation).filter(|_| scene.method != "equilibrium") {
            page.heading("Against pure rolling").paragraph(
                    "The second column is a run of its own in which both contacts roll whatever friction that takes; \
                     below zero, the normal force is the tension that rolling would need.",
                );
            page.table("", &table);
        }
        poses(&mut page, scene, prepared);
    }
    scene.envelope(provenance.run_time_s).close_scene(&mut page, &scene.scenario.name);
    page
}

/// What the scenario does, in words.
fn described(scene: &Ran) -> String {
    let [torque, speed] = courses(scene);
    let piece = |phrase: Phrase| match phrase {
        Phrase::Words(words) => words.to_owned(),
        Phrase::Torque(nm) => Unit::NewtonMetre.show_plain(nm, 5),
        Phrase::Frequency(hz) => Unit::Hertz.show_plain(hz, 5),
        Phrase::Duration(s) => Unit::Second.show_plain(s, 5),
        Phrase::Speed(rad_s) => Unit::Rpm.show_plain(rad_s, 6),
        Phrase::TorqueCourse => torque.clone(),
        Phrase::SpeedCourse => speed.clone(),
        Phrase::Method => scene.method.to_owned(),
    };
    let mut what: String = scene.scenario.story().into_iter().map(piece).collect();
    if !scene.scenario.drivetrain.is_empty() {
        let names: Vec<&str> = scene.scenario.drivetrain.iter().map(|d| d.name.as_str()).collect();
        what.push_str(&format!(" Drivetrain: {}.", names.join(", ")));
    }
    match scene.scenario.overrides.as_slice() {
        [] => what,
        some => format!("{what} Overridden for this scenario: {}.", some.join(", ")),
    }
}

/// Course of the torque and of the mean speed of a transient, in words.
fn courses(scene: &Ran) -> [String; 2] {
    let ScenarioKind::Transient { preload_nm, torque_step_nm, step_time_s, speed_rad_s, .. } =
        scene.scenario.kind
    else {
        return [String::new(), String::new()];
    };
    let nm = |t: f64| Unit::NewtonMetre.show_plain(t, 5);
    let span = |rows: &[[f64; 2]], unit: Unit| {
        let fold = |f: fn(f64, f64) -> f64, from: f64| rows.iter().map(|r| r[1]).fold(from, f);
        let (low, high) = (fold(f64::min, f64::INFINITY), fold(f64::max, f64::NEG_INFINITY));
        format!("over time, {} rows, {} to {}", rows.len(), unit.show_plain(low, 5), unit.show_plain(high, 5))
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

fn histories(page: &mut Page, scene: &Ran, prepared: &Prepared, s: &Simulation) {
    let rows = scene.rows();
    let whole = Stretch::whole(s);
    let plot = |y_title: &str| whole.plot(y_title);
    let curve = |value: &dyn Fn(&HistoryRow) -> f64| whole.points(&rows, value);
    let least_at = whole.at(s.peaks.at_s[2]);
    page.heading("Histories");
    // The cause first.
    let mut figures = vec![(
        half(torque(&whole, prepared, &rows)),
        "Torque from outside, on both races together, and what the clutch carries, positive in the sense in which it does; the rest \
         speeds the races up."
            .to_owned(),
    )];
    figures.extend(friction(scene, prepared, s, &rows, &whole));
    // At rest both forces differ by parts in a thousand: the second is dashed so that the first is seen.
    let mut normal = plot("Normal force per sprag, N")
        .curve("inner contact", curve(&|r| r.sample.forces.n_bi))
        .marker(least_at, "smallest");
    let outer = Curve::new("outer contact", curve(&|r| r.sample.forces.n_be));
    normal.curves.push(Curve { dash: Dash::Dashed, ..outer });
    figures.push((half(normal), format!("Normal forces; the smallest {}.", phase(scene, s.peaks.at_s[2]))));
    figures.extend(slip(s, &rows, &whole));
    let turning = if rows.iter().any(|r| r.acting[1] != 0.0) { ", relative to the mean speed" } else { "" };
    let largest_rad = largest(&rows, &|r| r.sample.state[2].abs().max(r.sample.state[3].abs()));
    let (unit, per_rad) = if largest_rad < FOUR_DIGITS * 1e-3 { ("mrad", 1e3) } else { ("rad", 1.0) };
    let angles = plot(&format!("Angle, {unit}"))
        .curve("inner race", curve(&|r| r.sample.state[2] * per_rad))
        .curve("outer race", curve(&|r| r.sample.state[3] * per_rad));
    let caption = format!("Angles of the races{turning}; rolling would keep their distance at the windup.");
    figures.push((half(angles), caption));
    // Under a torsional excitation the speeds only repeat what the angles show.
    if scene.scenario.kind.frequency_hz().is_none() {
        let rpm = |rad_s: f64| Unit::Rpm.from_si(rad_s);
        let speeds = plot("Angular speed, rpm")
            .curve("inner race", curve(&|r| rpm(r.rates[2])))
            .curve("outer race", curve(&|r| rpm(r.rates[3])));
        let caption =
            format!("Angular speeds of the races{turning}; + is the sense in which the inner race overruns.");
        figures.push((half(speeds), caption));
    }
    figures.push(pressures(scene, s, &rows, &whole));
    figures.extend(along_length(scene, prepared, s));
    figures.extend(train::figures(scene, &whole));
    let shown: Vec<(String, &str)> =
        figures.iter().map(|(svg, caption)| (svg.clone(), caption.as_str())).collect();
    let (first, others) = shown.split_at(2);
    page.figures(first);
    event(page, prepared, s, &rows);
    page.figures(others);
    if let Some(why) = no_friction(&rows) {
        page.paragraph(why);
    }
    if largest_slip_m(s, &rows) == 0.0 {
        page.paragraph(&format!("Neither contact has slipped since {}.", engaged(s)));
    }
    page.figure(&whole.strip(s).to_figure(), "What each contact does; each change is located in time.");
}

/// Torque from outside and in the clutch; what swings acts on the outer race.
fn torque(stretch: &Stretch, prepared: &Prepared, rows: &[HistoryRow]) -> Plot {
    let loads = &prepared.model.loads;
    let outside = |r: &HistoryRow| r.acting[0] + loads.amplitude_nm * (loads.omega_rad_s * r.sample.t).sin();
    let cause = Curve::new("from outside", stretch.points(rows, &outside)).coloured(5);
    let mut torque =
        stretch.plot("Torque, Nm").curve("in the clutch", stretch.points(rows, &|r| r.torque_nm));
    torque.curves.push(Curve { dash: Dash::Dashed, ..cause });
    torque
}

/// The first event enlarged: torque, friction over normal force, what the contacts do.
fn event(page: &mut Page, prepared: &Prepared, s: &Simulation, rows: &[HistoryRow]) {
    let Some((stretch, what, at_s)) = Stretch::first_event(s, rows) else { return };
    let caption = format!("The first event enlarged: {what} {}.", facts::at(at_s));
    page.figures(&[
        (half(torque(&stretch, prepared, rows).marker(0.0, what)), caption.as_str()),
        (half(ratios(&stretch, prepared, rows).marker(0.0, what)), "Friction over normal force meanwhile."),
    ]);
    page.figure(&stretch.strip(s).to_figure(), "What each contact does meanwhile.");
}

/// Friction over normal force with its sign, where that is worth drawing.
fn ratios(stretch: &Stretch, prepared: &Prepared, rows: &[HistoryRow]) -> Plot {
    let law = &prepared.model.friction;
    let most = DRAWN_FRICTION * law.static_;
    let drawn = |q: Option<f64>| q.filter(|q| q.abs() <= most).unwrap_or(f64::NAN);
    let mut plot = stretch.plot("T/N");
    // The outer contact first: where it trembles it would hide the inner one.
    plot.curves = vec![
        Curve::new("outer contact", stretch.points(rows, &|r| drawn(r.tan[1]))).coloured(1),
        Curve::new("inner contact", stretch.points(rows, &|r| drawn(r.tan[0]))).coloured(0),
        stretch.levels("±μ static", &[law.static_, -law.static_]),
    ];
    plot
}

/// Points that are drawn one by one.
const DRAWN: usize = 2400;
/// Columns into which more of them are put: about as many as a plot has on a screen.
const COLUMNS: f64 = 600.0;

/// Of many points those that are seen: in each column the first, the lowest, the highest and the last, and a gap where the
/// column has one.
pub(super) fn envelope(points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    let (Some(first), Some(last)) = (points.first().copied(), points.last().copied()) else { return points };
    if points.len() <= DRAWN {
        return points;
    }
    let column = |p: &[f64; 2]| (COLUMNS * (p[0] - first[0]) / (last[0] - first[0])) as usize;
    let seen = |all: &[[f64; 2]]| {
        let there: Vec<[f64; 2]> = all.iter().copied().filter(|p| p[1].is_finite()).collect();
        let by_height = |a: &&[f64; 2], b: &&[f64; 2]| a[1].total_cmp(&b[1]);
        let marks =
            [there.first(), there.iter().min_by(by_height), there.iter().max_by(by_height), there.last()];
        let mut kept: Vec<[f64; 2]> = marks.into_iter().flatten().copied().collect();
        kept.sort_by(|a, b| a[0].total_cmp(&b[0]));
        kept.dedup();
        if there.len() < all.len() {
            kept.extend(all.last().map(|p| [p[0], f64::NAN]));
        }
        kept
    };
    points.chunk_by(|a, b| column(a) == column(b)).flat_map(seen).collect()
}

fn largest(rows: &[HistoryRow], value: &dyn Fn(&HistoryRow) -> f64) -> f64 {
    rows.iter().map(value).fold(0.0, f64::max)
}

/// Why no friction over normal force is drawn, where that is so.
fn no_friction(rows: &[HistoryRow]) -> Option<&'static str> {
    let open = rows.iter().flat_map(|r| r.tan).flatten().next().is_none();
    open.then_some("The inner contact is open throughout: there is no friction over normal force to draw.")
}

/// Friction over normal force with its sign (the paper's Figure 9c).
fn friction(
    scene: &Ran,
    prepared: &Prepared,
    s: &Simulation,
    rows: &[HistoryRow],
    whole: &Stretch,
) -> Option<(String, String)> {
    if no_friction(rows).is_some() {
        return None;
    }
    let mut found = rows.iter().flat_map(|r| r.tan).flatten();
    let law = &prepared.model.friction;
    let number = |mu: f64| Unit::One.show(mu, 3);
    let most = DRAWN_FRICTION * law.static_;
    let plot = ratios(whole, prepared, rows).marker(whole.at(s.peaks.at_s[0]), "largest");
    let slipping = if law.kinetic < law.static_ {
        format!("±μ(v), from {} at rest down to {}", number(law.static_), number(law.kinetic))
    } else {
        format!("±{}", number(law.static_))
    };
    let cut = if found.any(|q| q.abs() > most) {
        format!(" Beyond ±{} nothing is drawn.", number(most))
    } else {
        String::new()
    };
    let caption = format!(
        "Friction T over normal force N, positive in the sense in which the clutch carries, with gaps where the inner \
         contact is open; a contact that slips is at {slipping}. |T|/N at the inner contact is largest {}.{cut}",
        phase(scene, s.peaks.at_s[0])
    );
    Some((half(plot), caption))
}

/// Slip of both contacts since the clutch engaged, m: the overrun before would hide it.
fn slipped(s: &Simulation, r: &HistoryRow) -> [f64; 2] {
    let (from_s, base) = s.engaged.map_or((0.0, [0.0; 2]), |e| (e.t_s, [e.inner.net_m, e.outer.net_m]));
    let slip = r.sample.slip_m;
    if r.sample.t < from_s { [0.0; 2] } else { [slip[0] - base[0], slip[1] - base[1]] }
}

fn largest_slip_m(s: &Simulation, rows: &[HistoryRow]) -> f64 {
    largest(rows, &|r| slipped(s, r).map(f64::abs).into_iter().fold(0.0, f64::max))
}

/// From when on slip is counted, in words.
fn engaged(s: &Simulation) -> String {
    match s.engaged {
        Some(e) if e.t_s > 0.0 => format!("the clutch engaged {}", facts::at(e.t_s)),
        Some(_) => "the clutch engaged".to_owned(),
        None => "the start, as the clutch does not engage".to_owned(),
    }
}

/// Slip since the clutch engaged, where there is any.
fn slip(s: &Simulation, rows: &[HistoryRow], whole: &Stretch) -> Option<(String, String)> {
    let largest_m = largest_slip_m(s, rows);
    if largest_m == 0.0 {
        return None;
    }
    let (unit, per_m) = if largest_m < FOUR_DIGITS * 1e-6 { ("µm", 1e6) } else { ("mm", 1e3) };
    let plot = whole
        .plot(&format!("Net slip, {unit}"))
        .curve("inner contact", whole.points(rows, &|r| slipped(s, r)[0] * per_m))
        .curve("outer contact", whole.points(rows, &|r| slipped(s, r)[1] * per_m));
    let caption =
        format!("Signed slip distance since {}; at the inner contact + is towards overrunning.", engaged(s));
    Some((half(plot), caption))
}

/// Contact pressure over time (the paper's Figures 9 and 10).
fn pressures(scene: &Ran, s: &Simulation, rows: &[HistoryRow], whole: &Stretch) -> (String, String) {
    let mega = |value: &dyn Fn(&HistoryRow) -> f64| whole.points(rows, &|r| value(r) / 1e6);
    let mut plot = whole
        .plot("Contact pressure, MPa")
        .curve("inner contact", mega(&|r| r.hertz_pa[0]))
        .curve("outer contact", mega(&|r| r.hertz_pa[1]));
    if rows.iter().any(|r| r.slice_pa.is_some()) {
        plot = plot.curve("inner contact, end slice", mega(&|r| r.slice_pa.map_or(f64::NAN, |p| p[0])));
    }
    plot.curves.push(whole.levels("static load", &[s.hertz_static_pa / 1e6]));
    let rated = match scene.rated().map(|p| p.hertz_inner_pa) {
        Some(p) => {
            let share = Unit::Percent.show(s.hertz_peak_pa / p, 3);
            format!(
                " At nominal torque it is {}: the largest here is {share} of that.",
                Unit::Megapascal.show(p, 4)
            )
        }
        None => String::new(),
    };
    (half(plot), format!("Hertz pressure p₀ at both contacts beside that of the static load.{rated}"))
}

/// Pressure along the length of the sprag, with slices.
fn along_length(scene: &Ran, prepared: &Prepared, s: &Simulation) -> Option<(String, String)> {
    let curve = &prepared.model.curve;
    let elastic = &curve.statics().elastic;
    let clutch = &scene.design.clutch;
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
    let slices = curves.first().map(|c| c.1.len())?;
    let mut plot = Plot::new("Place along the sprag, mm", "Pressure at the inner contact, MPa");
    for (name, points) in curves {
        plot = plot.curve(name, points);
    }
    let caption =
        format!("Pressure along the sprag by {slices} slices; at a square end it grows with their number.");
    Some((half(plot), caption))
}

/// When, and where in the excitation's period.
fn phase(scene: &Ran, t_s: f64) -> String {
    let when = facts::at(t_s);
    match scene.scenario.kind.frequency_hz() {
        Some(frequency_hz) => {
            format!("{when}, {:.0}° after the excitation's zero", 360.0 * (t_s * frequency_hz).fract())
        }
        None => when,
    }
}

/// The sprag where the scenario starts, over first contact.
fn poses(page: &mut Page, scene: &Ran, prepared: &Prepared) {
    let Ok(profile) = scene.design.clutch.profile() else { return };
    let rest = pose_at_rest("first contact", &scene.design, &profile);
    let loaded =
        scene.scenario.held_torque_nm().and_then(|t| pose_at_torque(&rest, &prepared.model.curve, t));
    let poses = loaded.into_iter().chain([rest]).collect();
    draw(page, &drawing(&scene.design, poses));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_points_keep_their_peaks_and_gaps_and_few_are_left_alone() {
        let swing = |i: usize| [i as f64, if i == 70_001 { 9.0 } else { (i as f64).sin() }];
        let few: Vec<[f64; 2]> = (0..1200).map(swing).collect();
        assert_eq!(envelope(few.clone()), few);
        let mut many: Vec<[f64; 2]> = (0..144_000).map(swing).collect();
        many[100_000][1] = f64::NAN;
        let drawn = envelope(many.clone());
        assert!(drawn.len() < 2500, "{}", drawn.len());
        assert!(drawn.contains(&[70_001.0, 9.0]) && drawn.iter().any(|p| p[1].is_nan()));
        assert_eq!((drawn[0], drawn[drawn.len() - 1]), (many[0], many[143_999]));
        // Every column reaches from the lowest to the highest.
        for part in drawn.chunk_by(|a, b| (a[0] / 2400.0) as usize == (b[0] / 2400.0) as usize) {
            let highest = part.iter().map(|p| p[1]).fold(f64::NEG_INFINITY, f64::max);
            assert!(highest > 0.999, "{highest}");
        }
    }
}
