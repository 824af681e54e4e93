//! The figures of a simulation as people read them: a table with errors.

use super::train::of_drivetrain;
use super::{LIFT_OFF_SEARCH_RAD_S, Ran};
use crate::answer::check::{NONE_SUFFICES, OVERLOADED};
use crate::clutch::ScenarioKind;
use crate::margin::LIFT_OFF_ERROR;
use crate::report::{Cell, Column, Table, Unit, significant};
use crate::scenario::{
    Figure, Group, Prepared, Quantity, RollingDemand, Simulation, Verdict, figures_of, overrun_swing,
};

/// To what part figures read off the wedge curve are right: what its iterations stop at.
const EXACT: f64 = 1e-13;
/// The time of an extreme is shown to five digits; an error below this part of it is not.
const SHOWN: f64 = 1e-5;

/// Where the tolerance is not reached, a figure with an error above this part of it is shown as the span that it may lie in.
const SURE: f64 = 0.01;

struct FactRows {
    table: Table,
    /// Whether figures may be shown as spans.
    spans: bool,
}

impl FactRows {
    fn new(spans: bool) -> Self {
        let columns = vec![
            Column::text("quantity", "Quantity"),
            Column::number("value", "Value", Unit::One, 6),
            Column::number("error", "± error", Unit::One, 2),
        ];
        Self { table: Table::new(columns), spans }
    }

    fn add(&mut self, name: &str, value: f64, unit: Unit, error: Option<f64>) {
        // Differences of angles below the rounding of the angles themselves.
        let value = if unit == Unit::Radian && value.abs() < 1e-15 { 0.0 } else { value };
        let shown = match error.filter(|&e| self.spans && e > SURE * value.abs()) {
            Some(e) => Cell::Text(span(value, e, unit)),
            None => Cell::In(value, unit),
        };
        let error = error.map_or(Cell::Text(String::new()), |e| Cell::In(e, unit));
        self.table.row(vec![name.into(), shown, error]);
    }

    fn word(&mut self, name: &str, value: &str) {
        self.table.row(vec![name.into(), value.into(), Cell::Text(String::new())]);
    }

    fn count(&mut self, name: &str, value: u64) {
        self.table.row(vec![
            name.into(),
            Cell::Count(usize::try_from(value).unwrap_or(usize::MAX)),
            Cell::Text(String::new()),
        ]);
    }
}

/// What happened, with error estimates.
pub(super) fn table(scene: &Ran) -> Table {
    let unsure = |s: &Simulation| scene.method == "event" && s.error.is_some() && !s.tolerance_reached;
    let mut facts = FactRows::new(scene.simulation().is_some_and(unsure));
    match &scene.outcome {
        Err(why) => facts.word("no start", &why.to_string()),
        Ok((prepared, s)) if scene.method == "equilibrium" => equilibrium(&mut facts, scene, prepared, s),
        Ok((prepared, s)) => motion(&mut facts, scene, prepared, s),
    }
    facts.table
}

/// What a page shows before its curves: most of all it says what decides the verdict, and how hard the contacts are used.
const FIRST: [&str; 10] = [
    "slip margin",
    "contact margin",
    "static friction needed to stick",
    "largest |T|/N, inner",
    "smallest normal force, inner",
    "largest normal force, inner",
    "largest Hertz pressure",
    "net slip, inner contact",
    "slip time, inner contact",
    "time without contact",
];

/// The figures of [`FIRST`], and all of them where there are more than that.
pub(super) fn first_and_all(table: Table) -> (Table, Option<Table>) {
    if table.rows.len() <= FIRST.len() {
        return (table, None);
    }
    let name = |row: &[Cell]| match row.first() {
        Some(Cell::Text(name)) => name.clone(),
        _ => String::new(),
    };
    let is = |row: &[Cell], first: &str| {
        name(row).strip_prefix(first).is_some_and(|rest| rest.is_empty() || rest.starts_with(" ("))
    };
    let rows = FIRST.iter().filter_map(|first| table.rows.iter().find(|row| is(row, first)).cloned());
    let mut rows: Vec<Vec<Cell>> = rows.collect();
    // Of a state at rest the first are what it is about: torque, windup, forces.
    if rows.len() < FIRST.len() / 2 {
        rows = table.rows.iter().take(FIRST.len()).cloned().collect();
    }
    (Table { rows, ..table.clone() }, Some(table))
}

/// From `value` - `error` to `value` + `error`; what cannot be negative begins at 0.
fn span(value: f64, error: f64, unit: Unit) -> String {
    let signed = matches!(unit, Unit::Radian | Unit::Percent | Unit::Micrometre) || value < 0.0;
    let low = if signed { value - error } else { (value - error).max(0.0) };
    format!("{} to {}", unit.show(low, 3), unit.show(value + error, 3))
}

/// What an engagement takes for given: the paper publishes none of it for its Figure 8.
fn assumed(f: &mut FactRows, scene: &Ran) {
    let ScenarioKind::Engagement {
        free_run_rad_s,
        reversing_torque_nm,
        stop_stiffness_nm_per_rad,
        bench_inertia_kg_m2,
        ..
    } = scene.scenario.kind
    else {
        return;
    };
    f.add("input: free-run speed", free_run_rad_s, Unit::Rpm, None);
    f.add("input: reversing torque", reversing_torque_nm, Unit::NewtonMetre, None);
    f.add("input: stiffness of the stop", stop_stiffness_nm_per_rad, Unit::NewtonMetrePerRadian, None);
    f.add("input: inertia of the bench, kg m²", bench_inertia_kg_m2, Unit::One, None);
}

/// The unit in which people are shown a figure.
fn unit(quantity: Quantity) -> Unit {
    match quantity {
        Quantity::Angle => Unit::Radian,
        Quantity::Length => Unit::Micrometre,
        Quantity::Time => Unit::Millisecond,
        Quantity::Force => Unit::Newton,
        Quantity::Pressure => Unit::Megapascal,
        Quantity::Friction => Unit::One,
        Quantity::Margin | Quantity::ContactMargin => Unit::Percent,
        Quantity::Work => Unit::Joule,
        Quantity::Power => Unit::Watt,
        Quantity::Flux => Unit::WattPerSquareMillimetre,
        Quantity::Rise => Unit::Kelvin,
        Quantity::Depth => Unit::Micrometre,
    }
}

/// The figures of `group` that the simulation has.
fn figures(f: &mut FactRows, scene: &Ran, prepared: &Prepared, s: &Simulation, group: Group) {
    let exact = EXACT + prepared.model.curve.truncation();
    for figure in figures_of(group) {
        let (Some(line), Some(value)) = (figure.line, (figure.of)(s)) else { continue };
        let error = s.error.as_ref().map(|e| scene.error_of(figure, prepared, s, e));
        f.add(
            &format!("{}{}{}", line.label, counted(figure, s), when(figure, s, exact)),
            value,
            unit(figure.quantity),
            error,
        );
    }
}

fn motion(f: &mut FactRows, scene: &Ran, prepared: &Prepared, s: &Simulation) {
    figures(f, scene, prepared, s, Group::Motion);
    assumed(f, scene);
    for group in [Group::Reversal, Group::Slip, Group::Lost, Group::Peaks, Group::Pressures] {
        figures(f, scene, prepared, s, group);
    }
    // Read off the curve, not integrated.
    let mut pressure = |name: &str, pa: f64, normal_n: f64| {
        let exact = (EXACT + prepared.model.curve.truncation()) * pa;
        f.add(name, pa, Unit::Megapascal, Some(exact + pa * scene.shape_error(prepared, normal_n)));
    };
    pressure("Hertz pressure, static load", s.hertz_static_pa, s.static_normal_n);
    if let Some(rated) = scene.rated() {
        pressure("Hertz pressure, nominal torque", rated.hertz_inner_pa, rated.normal_inner_n);
    }
    demand(f, scene, s);
    if let Some(b) = s.energy {
        let balance = format!(
            "{} J through, {} J lost in friction, {:.1e} left over",
            significant(b.through_j, 5),
            significant(-b.friction_inner_j - b.friction_outer_j, 4),
            b.relative().abs()
        );
        f.word("energy balance", &balance);
    }
    for (i, mode) in of_drivetrain(prepared).iter().enumerate() {
        f.word(&format!("eigenfrequency {}, clutch engaged", i + 1), &mode.words());
    }
    f.count("changes between sticking, slipping and open", s.events);
    f.count("steps, all runs", s.steps);
    f.count("steps refused, all runs", s.rejections);
    f.count("right-hand sides, all runs", s.rhs_evaluations);
}

/// When; the run's first instant is 0, however it is rounded.
pub(super) fn at(t_s: f64) -> String {
    format!("at {}", Unit::Millisecond.show(if t_s < 1e-12 { 0.0 } else { t_s }, 5))
}

/// When a clutch that overran at first engaged, s.
fn engaged_s(s: &Simulation) -> Option<f64> {
    s.engaged.map(|e| e.t_s).filter(|t_s| *t_s > 0.0)
}

fn once_engaged(t_s: f64) -> String {
    format!(" (once engaged, from {})", Unit::Millisecond.show(t_s, 4))
}

/// Of a scene that begins in overrun: over which part of it a figure counts, where its label names no instant.
fn counted(figure: &Figure, s: &Simulation) -> String {
    let Some((line, t_s)) = figure.line.zip(engaged_s(s)) else { return String::new() };
    match line.group {
        Group::Motion if figure.key.contains("slip") => once_engaged(t_s),
        Group::Slip => once_engaged(t_s),
        Group::Lost => " (overrun and all)".to_owned(),
        Group::Demand if figure.quantity != Quantity::Friction => " (rolling once engaged)".to_owned(),
        _ => String::new(),
    }
}

/// Of an extreme: when it was reached first, and by how much that moved between the runs; `exact` is the relative error of a force
/// read off the curve.
fn when(figure: &Figure, s: &Simulation, exact: f64) -> String {
    let Some(i) = figure.peak else { return String::new() };
    if is_steady(i, s, exact) {
        return " (throughout)".to_owned();
    }
    let at_s = s.peaks.at_s[i];
    let off = s.error.map_or(0.0, |e| e.extremes_at_s[i]);
    let off =
        if off > SHOWN * at_s { format!(" ± {}", Unit::Millisecond.show(off, 2)) } else { String::new() };
    let overrunning = if engaged_s(s).is_some_and(|t_s| at_s < t_s) { ", overrunning" } else { "" };
    format!(" ({}{off}{overrunning})", at(at_s))
}

/// Whether an extreme stays within its error over the whole run.
fn is_steady(i: usize, s: &Simulation, exact: f64) -> bool {
    let (p, e) = (&s.peaks, s.error);
    let of_force = e.map_or(0.0, |e| e.normal_min_n + e.normal_max_n) + exact * p.normal_max_n;
    let force_is_steady = p.normal_max_n - p.normal_min_n <= of_force;
    let of_demand = [p.tan_inner, p.tan_outer].map(|most| exact * most);
    let [inner, outer] = e.map_or([0.0; 2], |e| [e.tan_inner, e.tan_outer]);
    match i {
        0 => force_is_steady && demand_is_steady(s, p.tan_inner, inner + of_demand[0], true),
        1 => force_is_steady && demand_is_steady(s, p.tan_outer, outer + of_demand[1], false),
        _ => force_is_steady,
    }
}

/// Whether |T|/N at A and at B stays within `error` of its largest value `most` over the whole run; not where the history
/// shows a part of it.
fn demand_is_steady(s: &Simulation, most: f64, error: f64, at_inner: bool) -> bool {
    let whole = s.samples.first().zip(s.samples.last());
    let whole = whole.is_some_and(|(a, b)| a.t <= 0.0 && b.t >= s.t_s * (1.0 - EXACT));
    whole
        && s.samples.iter().all(|sample| {
            let f = &sample.forces;
            let (t, n) = if at_inner { (f.t_bi, f.n_bi) } else { (f.t_be, f.n_be) };
            n > 0.0 && most - t.abs() / n <= error
        })
}

fn demand(f: &mut FactRows, scene: &Ran, s: &Simulation) {
    let Some(d) = s.demand else { return };
    for figure in figures_of(Group::Demand) {
        let Some(label) = figure.line.map(|l| l.label) else { continue };
        if let Some(stop) = d.gave_up {
            return f.word(label, &format!("not computed: {}", stop.name()));
        }
        let label = &format!("{label}{}", counted(figure, s));
        if let Some(words) = instead(figure.quantity, &d) {
            let is_to_let_go = words == NONE_SUFFICES
                && matches!(s.verdict, Some(Verdict::SlipsOverrunning | Verdict::Disengages))
                && scene.scenario.lets_go() == Some(true);
            f.word(label, if is_to_let_go { "none: it is to let go" } else { &words });
            continue;
        }
        let Some(value) = (figure.of)(s) else { continue };
        // An equilibrium has one relative error for all; that of the slip margin is of mu_s over the demand.
        let of = value + if figure.quantity == Quantity::Margin { 1.0 } else { 0.0 };
        let error = s.error.as_ref().map(figure.error).or(s.equilibrium_error.map(|e| e * of.abs()));
        let by = match figure.quantity {
            Quantity::Friction if d.by_bisection => " (bisected: rolling unloads the contact)",
            _ => "",
        };
        f.add(&format!("{label}{by}"), value, unit(figure.quantity), error);
    }
}

/// What stands in place of a number that pure rolling did not give.
fn instead(quantity: Quantity, d: &RollingDemand) -> Option<String> {
    match quantity {
        Quantity::Friction if d.required_friction.is_some() => None,
        Quantity::Friction if d.overloaded => {
            Some("overloaded: rolling goes beyond the end of the curve".to_owned())
        }
        Quantity::Friction => Some(NONE_SUFFICES.to_owned()),
        Quantity::Margin if d.required_friction.is_some() => None,
        Quantity::Margin if d.overloaded => Some(OVERLOADED.to_owned()),
        Quantity::Margin => Some(NONE_SUFFICES.to_owned()),
        Quantity::ContactMargin if d.finished => None,
        Quantity::ContactMargin if d.contact_margin < 0.0 => {
            let most = Unit::Percent.show(d.contact_margin, 4);
            Some(format!("at most {most}: rolling does not come to the end"))
        }
        Quantity::ContactMargin => Some("not known: rolling does not come to the end".to_owned()),
        _ => None,
    }
}

fn equilibrium(f: &mut FactRows, scene: &Ran, prepared: &Prepared, s: &Simulation) {
    let mut add = |name: &str, value: f64, unit: Unit| {
        f.add(name, value, unit, s.equilibrium_error.map(|e| e * value.abs()));
    };
    add("sprag rotation alpha", prepared.state[0], Unit::Degree);
    if let Some(o) = s.overrun {
        add("drag torque", o.drag_torque_nm, Unit::NewtonMetre);
        add("normal force, inner", o.normal_inner_n, Unit::Newton);
        add("normal force, outer", o.normal_outer_n, Unit::Newton);
        let carried = scene.scenario.clutch.slides_outside();
        if carried {
            add("|T|/N, outer (sliding friction)", o.tan_outer, Unit::One);
        } else {
            add("|T|/N, inner (sliding friction)", o.tan_inner, Unit::One);
            add("|T|/N, outer (must hold)", o.tan_outer, Unit::One);
        }
        if let Some(swing) = overrun_swing(&scene.scenario, prepared) {
            f.add(
                "growth rate of the sprags' swing (+ grows)",
                swing.growth_rate_per_s,
                Unit::PerSecond,
                None,
            );
            f.add("frequency of that swing", swing.frequency_hz, Unit::Hertz, None);
            let name = if carried { "normal force, outer" } else { "normal force, inner" };
            f.add(&format!("{name}, about which it swings"), swing.normal_inner_n, Unit::Newton, None);
        }
        let error = Some(LIFT_OFF_ERROR * LIFT_OFF_SEARCH_RAD_S);
        let name = format!("lift-off at an {} race speed of", if carried { "inner" } else { "outer" });
        match scene.lift_off_rad_s() {
            Some(speed) => f.add(&name, speed, Unit::Rpm, error),
            None => f.word(&name, "none up to 60 000 rpm"),
        }
        return;
    }
    let Some(row) = prepared.at_rest() else { return };
    add("torque", row.torque_nm, Unit::NewtonMetre);
    add("windup", row.windup_rad, Unit::Degree);
    add("normal force, inner", row.normal_inner_n, Unit::Newton);
    add("normal force, outer", row.normal_outer_n, Unit::Newton);
    add("|T|/N, inner", row.tan_omega, Unit::One);
    add("|T|/N, outer", row.tan_nu, Unit::One);
    add("secant stiffness", row.k_secant_nm_per_rad, Unit::NewtonMetrePerRadian);
    add("tangent stiffness", row.k_tangent_nm_per_rad, Unit::NewtonMetrePerRadian);
    let shape = scene.shape_error(prepared, row.normal_inner_n);
    let error_pa = s.equilibrium_error.map(|e| (e + shape) * s.hertz_peak_pa);
    f.add("largest Hertz pressure", s.hertz_peak_pa, Unit::Megapascal, error_pa);
    demand(f, scene, s);
}

/// The run beside what pure rolling would need, for a scene that is integrated.
pub(super) fn beside_rolling(s: &Simulation) -> Option<Table> {
    let d = s.demand?;
    let mut table = Table::new(vec![
        Column::text("quantity", "Quantity"),
        Column::number("run", "This run", Unit::One, 6),
        Column::number("rolling", "Pure rolling would need", Unit::One, 6),
        Column::number("margin", "Margin", Unit::Percent, 3),
    ]);
    let newton = |n: f64| Cell::In(n, Unit::Newton);
    table.row(vec![
        "largest |T|/N, either contact".into(),
        Cell::In(s.peaks.tan_inner.max(s.peaks.tan_outer), Unit::One),
        d.required_friction.map_or("no friction suffices".into(), |r| Cell::In(r, Unit::One)),
        d.slip_margin.into(),
    ]);
    table.row(vec![
        "smallest normal force, inner".into(),
        newton(s.peaks.normal_min_n),
        newton(d.contact_margin * s.static_normal_n),
        d.contact_margin.into(),
    ]);
    for (name, i, own) in [
        ("largest normal force, inner", 0, s.peaks.normal_max_n),
        ("largest normal force, outer", 1, s.peaks.normal_outer_max_n),
    ] {
        let rolling = d.normal_max_n.get(i).copied().unwrap_or(0.0);
        table.row(vec![name.into(), newton(own), newton(rolling), Cell::Empty]);
    }
    Some(table)
}
