//! The figures of a simulation as people read them: verdict in a sentence, table with errors.

use super::Scene;
use crate::design::ScenarioKind;
use crate::dynamics::{Stop, Swing};
use crate::margin::{LIFT_OFF_ERROR, lift_off_rad_s as lift_off, load_state};
use crate::report::{Cell, Column, Table, Unit, significant};
use crate::scenario::{ErrorEstimate, Prepared, Simulation, Verdict, overrun_swing};
use crate::wedge::{StaticPoint, straddling_error};

/// Lift-off is looked for up to this speed of the outer race, rad/s: 60 000 rev/min, a choice.
const LIFT_OFF_SEARCH_RAD_S: f64 = 2000.0 * std::f64::consts::PI;

impl Scene<'_> {
    /// The answer in one line.
    pub(super) fn verdict_line(&self) -> String {
        let name = &self.scenario.name;
        let Some(verdict) = self.verdict() else { return format!("{name}: no verdict") };
        let meaning = match &self.outcome {
            Err(why) => why.to_string(),
            Ok((prepared, s)) if s.verdict == Some(Verdict::Overloaded) => {
                let curve = &prepared.model.curve;
                let end = Unit::NewtonMetre.show(curve.end_torque_nm(), 4);
                let at = Unit::Second.show(s.t_s, 4);
                format!(
                    "the load goes beyond the end of the curve ({} at {end}) at {at}",
                    curve.end().0.name()
                )
            }
            Ok((prepared, s)) => meaning(s, &self.scenario.kind, overrun_swing(self.scenario, prepared)),
        };
        format!("{name}: {verdict}: {meaning}")
    }
}

fn meaning(s: &Simulation, kind: &ScenarioKind, swing: Option<Swing>) -> String {
    let margin = match s.demand.map(|d| (d.required_friction, d.slip_margin)) {
        Some((Some(needed), margin)) => {
            format!("slip margin {} (needs {})", Unit::Percent.show(margin, 3), Unit::One.show(needed, 4))
        }
        _ if s.demand.is_some_and(|d| d.gave_up.is_some()) => {
            "what friction would suffice is not known".to_owned()
        }
        Some((None, _)) if s.demand.is_some_and(|d| d.contact_margin < 0.0) => {
            "no friction would suffice to stick, the contact would open".to_owned()
        }
        Some((None, _)) => "no friction up to 1 would suffice to stick".to_owned(),
        None => String::new(),
    };
    let overruns = matches!(kind, ScenarioKind::Overrun { .. });
    match s.verdict {
        Some(Verdict::SlipsOverrunning | Verdict::Disengages) if overruns => {
            let drag = s.overrun.map_or(0.0, |o| o.drag_torque_nm);
            if s.verdict == Some(Verdict::Disengages) {
                "the sprags have lifted off the inner race".to_owned()
            } else {
                let stays = match swing.filter(Swing::grows) {
                    Some(_) => " in an equilibrium that does not stay: the swing of the sprags grows",
                    None => "",
                };
                format!("drag torque {}{stays}", Unit::NewtonMetre.show(drag, 4))
            }
        }
        Some(Verdict::Sticks) if s.demand.is_some_and(|d| d.slip_margin < 0.0) => {
            format!("slips by less than 1 um, which counts as sticking; {margin}")
        }
        Some(Verdict::Sticks) => margin,
        Some(Verdict::SlipsEngaging) if matches!(kind, ScenarioKind::Static { .. }) => margin,
        Some(Verdict::SlipsOverrunning | Verdict::SlipsEngaging) => format!("{}; {margin}", shifted(s)),
        Some(Verdict::Disengages) => {
            if s.peaks.normal_max_n <= 0.0 {
                return "the sprags touch without a force".to_owned();
            }
            let lost = Unit::Millisecond.show(s.contact_lost_s, 4);
            let at = Unit::Second.show(s.t_s, 4);
            match s.stop {
                Stop::CurveEnd => {
                    format!(
                        "contact lost for {lost}, and beyond the end of the curve when it closed, at {at}"
                    )
                }
                stop => format!("contact lost for {lost}, run {} at {at}", stop.name()),
            }
        }
        Some(Verdict::Overloaded) => "the load goes beyond the end of the curve".to_owned(),
        Some(Verdict::AtThreshold) | None => {
            "another verdict is nearer than the error estimate; a smaller tolerance or step decides"
                .to_owned()
        }
    }
}

/// Which way the inner contact has slipped and the inner race gone: with slip at the outer contact and what turns without
/// contact the race may have gone the other way.
fn shifted(s: &Simulation) -> String {
    let way = |towards: f64| if towards > 0.0 { "overrunning" } else { "engaging" };
    let offset = Unit::Milliradian.show(s.offset_rad.abs(), 4);
    let (slip, race) = (way(s.inner.net_m), way(s.offset_rad));
    if slip == race {
        return format!("slip has shifted the inner race by {offset} towards {race}");
    }
    let net = Unit::Micrometre.show(s.inner.net_m.abs(), 4);
    let by = if s.contact_lost_s > 0.0 { " and while contact was lost" } else { "" };
    format!(
        "the inner contact has slipped by {net} towards {slip}, yet the inner race has gone {offset} towards {race}, by slip \
         at the outer contact{by}"
    )
}

/// Speed of the outer race at which the sprags lift off the inner one, rad/s, for an overrun; `None` where they
/// stay on up to 60 000 rev/min, or in another scenario.
pub(super) fn lift_off_rad_s(scene: &Scene) -> Option<f64> {
    if !matches!(scene.scenario.kind, ScenarioKind::Overrun { .. }) {
        return None;
    }
    let state = load_state(&scene.own).ok()?;
    lift_off(&scene.own, &state, LIFT_OFF_SEARCH_RAD_S)
}

/// To what part figures read off the wedge curve are right: what its iterations stop at.
const EXACT: f64 = 1e-13;
/// The time of an extreme is shown to five digits; an error below this part of it is not.
const TOLD: f64 = 1e-5;

/// Where the tolerance is not reached, a figure with an error above this part of it is shown as the span that it may lie in.
const SURE: f64 = 0.01;

struct Facts {
    table: Table,
    /// Whether figures may be shown as spans.
    spans: bool,
}

impl Facts {
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
pub(super) fn table(scene: &Scene) -> Table {
    let unsure = |s: &Simulation| scene.method == "event" && s.error.is_some() && !s.tolerance_reached;
    let mut facts = Facts::new(scene.simulation().is_some_and(unsure));
    match &scene.outcome {
        Err(why) => facts.word("no start", &why.to_string()),
        Ok((prepared, s)) if scene.method == "equilibrium" => equilibrium(&mut facts, scene, prepared, s),
        Ok((prepared, s)) => motion(&mut facts, scene, prepared, s),
    }
    facts.table
}

/// From `value` - `error` to `value` + `error`; what cannot be negative begins at 0.
fn span(value: f64, error: f64, unit: Unit) -> String {
    let signed = matches!(unit, Unit::Radian | Unit::Percent | Unit::Micrometre) || value < 0.0;
    let low = if signed { value - error } else { (value - error).max(0.0) };
    format!("{} to {}", unit.show(low, 3), unit.show(value + error, 3))
}

/// The static state at the nominal torque of `[limits]`: with its pressure at A the paper's 4.1.2 compares.
pub(super) fn rated(scene: &Scene) -> Option<StaticPoint> {
    // The scene's own curve may end where the scene has no use for it.
    let state = load_state(&scene.own).ok()?;
    state.curve.at_torque(scene.own.limits.nominal_torque_nm?)
}

/// By what part the pressure's shape makes a Hertz pressure at `normal_n` (N) uncertain: 0 but where a junction lies under
/// the inner contact.
pub(super) fn shape_error(scene: &Scene, prepared: &Prepared, normal_n: f64) -> f64 {
    let at = (normal_n > 0.0).then(|| prepared.model.curve.at_normal(normal_n)).flatten();
    if at.is_some_and(|p| p.straddles_junction) { straddling_error(&scene.own.clutch) } else { 0.0 }
}

/// What an engagement takes for given: the paper publishes none of it for its Figure 8.
fn assumed(f: &mut Facts, scene: &Scene) {
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

fn motion(f: &mut Facts, scene: &Scene, prepared: &Prepared, s: &Simulation) {
    let e = s.error;
    f.add("inner race at the end", s.theta_inner_rad, Unit::Radian, e.map(|e| e.theta_inner_rad));
    f.add("outer race at the end", s.theta_outer_rad, Unit::Radian, e.map(|e| e.theta_outer_rad));
    f.add("offset (+ overrunning)", s.offset_rad, Unit::Radian, e.map(|e| e.offset_rad));
    f.add("net slip, inner contact", s.inner.net_m, Unit::Micrometre, e.map(|e| e.net_slip_m));
    for (name, record, i) in [("inner contact", &s.inner, 0), ("outer contact", &s.outer, 1)] {
        f.add(
            &format!("slip path, {name}"),
            record.distance_m,
            Unit::Micrometre,
            e.map(|e| e.slip_distance_m[i]),
        );
        f.add(&format!("slip time, {name}"), record.time_s, Unit::Millisecond, e.map(|e| e.slip_time_s[i]));
    }
    assumed(f, scene);
    if let Some(initial) = s.initial_slip_s() {
        f.add("initial slip after the reversal", initial, Unit::Millisecond, e.map(|e| e.initial_slip_s));
    }
    f.add("time without contact", s.contact_lost_s, Unit::Millisecond, e.map(|e| e.contact_lost_s));
    peaks(f, s);
    let mut pressure = |name: &str, pa: f64, normal_n: f64, error: Option<f64>| {
        f.add(name, pa, Unit::Megapascal, error.map(|e| e + pa * shape_error(scene, prepared, normal_n)));
    };
    let exact = |value: f64| Some((EXACT + prepared.model.curve.truncation()) * value);
    let (p, rated) = (&s.peaks, rated(scene));
    pressure("largest Hertz pressure", s.hertz_peak_pa, p.normal_max_n, e.map(|e| e.hertz_peak_pa));
    pressure("smallest Hertz pressure, inner", s.hertz_least_pa, p.normal_min_n, e.map(|e| e.hertz_least_pa));
    pressure("Hertz pressure, static load", s.hertz_static_pa, s.static_normal_n, exact(s.hertz_static_pa));
    if let Some(rated) = rated {
        let pa = rated.hertz_inner_pa;
        pressure("Hertz pressure, nominal torque", pa, rated.normal_inner_n, exact(pa));
    }
    demand(f, s);
    if let Some(b) = s.energy {
        let balance = format!(
            "{} J through, {} J lost in friction, {:.1e} left over",
            significant(b.through_j, 5),
            significant(-b.friction_inner_j - b.friction_outer_j, 4),
            b.relative().abs()
        );
        f.word("energy balance", &balance);
    }
    f.count("changes of mode", s.events);
    f.count("steps, all runs", s.steps);
    f.count("steps refused, all runs", s.rejections);
    f.count("right-hand sides, all runs", s.rhs_evaluations);
}

/// When; the run's first instant is 0, however it is rounded.
pub(super) fn at(t_s: f64) -> String {
    format!("at {}", Unit::Millisecond.show(if t_s < 1e-12 { 0.0 } else { t_s }, 5))
}

fn peaks(f: &mut Facts, s: &Simulation) {
    let (p, e) = (&s.peaks, s.error);
    let mut add = |i: usize, name: &str, value: f64, unit: Unit, error: fn(&ErrorEstimate) -> f64| {
        let at = at(p.at_s[i]);
        let off = e.map_or(0.0, |e| e.extremes_at_s[i]);
        let off = if off > TOLD * p.at_s[i] {
            format!(" ± {}", Unit::Millisecond.show(off, 2))
        } else {
            String::new()
        };
        f.add(&format!("{name} ({at}{off})"), value, unit, e.as_ref().map(error));
    };
    add(2, "smallest normal force, inner", p.normal_min_n, Unit::Newton, |e| e.normal_min_n);
    add(3, "largest normal force, inner", p.normal_max_n, Unit::Newton, |e| e.normal_max_n);
    add(0, "largest |T|/N, inner", p.tan_inner, Unit::One, |e| e.tan_demand[0]);
    add(1, "largest |T|/N, outer", p.tan_outer, Unit::One, |e| e.tan_demand[1]);
}

fn demand(f: &mut Facts, s: &Simulation) {
    let Some(d) = s.demand else { return };
    if let Some(stop) = d.gave_up {
        return f.word("static friction needed to stick", &format!("not computed: {}", stop.name()));
    }
    // An equilibrium has one relative error for all.
    let exact = |value: f64| s.equilibrium_error.map(|e| e * value.abs());
    match d.required_friction {
        Some(needed) if d.by_bisection => {
            f.add(
                "static friction needed to stick (bisected: rolling unloads the contact)",
                needed,
                Unit::One,
                s.error.map(|e| e.required_friction),
            );
        }
        Some(needed) => {
            let error = s.error.map(|e| e.required_friction).or(exact(needed));
            f.add("static friction needed to stick", needed, Unit::One, error)
        }
        None if d.overloaded => {
            f.word("static friction needed to stick", "overloaded: rolling goes beyond the end of the curve")
        }
        None => f.word("static friction needed to stick", "none suffices"),
    }
    let slip_error = s.error.map(|e| e.slip_margin).or(exact(d.slip_margin + 1.0));
    f.add("slip margin", d.slip_margin, Unit::Percent, slip_error);
    let contact_error = s.error.map(|e| e.contact_margin).or(exact(d.contact_margin));
    if d.finished {
        f.add("contact margin", d.contact_margin, Unit::Percent, contact_error);
    } else if d.contact_margin < 0.0 {
        let most = Unit::Percent.show(d.contact_margin, 4);
        f.word("contact margin", &format!("at most {most}: rolling does not come to the end"));
    } else {
        f.word("contact margin", "not known: rolling does not come to the end");
    }
}

fn equilibrium(f: &mut Facts, scene: &Scene, prepared: &Prepared, s: &Simulation) {
    let mut add = |name: &str, value: f64, unit: Unit| {
        f.add(name, value, unit, s.equilibrium_error.map(|e| e * value.abs()));
    };
    add("sprag rotation alpha", prepared.state[0], Unit::Degree);
    if let Some(o) = s.overrun {
        add("drag torque", o.drag_torque_nm, Unit::NewtonMetre);
        add("normal force, inner", o.normal_inner_n, Unit::Newton);
        add("normal force, outer", o.normal_outer_n, Unit::Newton);
        add("|T|/N, inner (sliding friction)", o.tan_inner, Unit::One);
        add("|T|/N, outer (must hold)", o.tan_outer, Unit::One);
        if let Some(swing) = overrun_swing(scene.scenario, prepared) {
            f.add(
                "growth rate of the sprags' swing (+ grows)",
                swing.growth_rate_per_s,
                Unit::PerSecond,
                None,
            );
            f.add("frequency of that swing", swing.frequency_hz, Unit::Hertz, None);
            f.add("normal force, inner, about which it swings", swing.normal_inner_n, Unit::Newton, None);
        }
        let error = Some(LIFT_OFF_ERROR * LIFT_OFF_SEARCH_RAD_S);
        match lift_off_rad_s(scene) {
            Some(speed) => f.add("lift-off at an outer race speed of", speed, Unit::Rpm, error),
            None => f.word("lift-off at an outer race speed of", "none up to 60 000 rpm"),
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
    let shape = shape_error(scene, prepared, row.normal_inner_n);
    let error_pa = s.equilibrium_error.map(|e| (e + shape) * s.hertz_peak_pa);
    f.add("largest Hertz pressure", s.hertz_peak_pa, Unit::Megapascal, error_pa);
    demand(f, s);
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
