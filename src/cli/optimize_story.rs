//! What `optimize` found beside the optimum: sentences, tables and JSON of its parts.

use super::optimize_relief::relief_parts;
use crate::design::Objective;
use crate::optimise::{
    Alone, Branch, Front, Loosened, Optima, Price, PriceKind, Realised, Relief, Robust, RobustSearch, Search,
    Start, Status,
};
use crate::report::{Cell, Column, Plot, Table, Unit, significant};

/// Everything that was asked of one search.
pub struct Story {
    /// The search.
    pub found: Search,
    /// Flanks for a centroid that was free.
    pub realised: Option<Realised>,
    /// What would free an infeasible problem.
    pub relief: Option<Relief>,
    /// Single numbers let go in an infeasible problem, the variables with them.
    pub loosened: Vec<Loosened>,
    /// What the limits that do not hold come to one by one.
    pub alone: Vec<Alone>,
    /// Front.
    pub front: Option<Front>,
    /// The optimum as it may be made.
    pub made: Option<Robust>,
    /// The optimum that holds at every corner.
    pub robust: Option<RobustSearch>,
    /// Whether a robust design was asked for.
    pub wants_robust: bool,
    /// What was asked and could not be done.
    pub why: Vec<String>,
}

/// Middle of the name of the design with flanks for a centroid that was free.
pub const REALISED: &str = "realised";
/// Middle of the name of the robust design.
pub const ROBUST: &str = "robust";
/// Middle of the name of the nearest design where none is feasible.
pub const NEAREST: &str = "nearest";

/// Digits to which an objective is shown.
pub const SHOWN_DIGITS: usize = 5;

/// A value of an objective with its unit.
pub fn shown(aim: Objective, value: f64) -> String {
    match aim.unit() {
        "" => significant(value, SHOWN_DIGITS),
        unit => format!("{} {unit}", significant(value, SHOWN_DIGITS)),
    }
}

/// A gain of an objective, more being better, as it is spoken of.
fn gain(aim: Objective, gain: f64) -> String {
    match aim {
        Objective::SlipMargin => format!("{} % slip margin", significant(100.0 * gain, 2)),
        Objective::TorqueCapacity => format!("{} Nm of torque capacity", significant(gain, 2)),
        Objective::PeakPressure => format!("{} MPa less pressure", significant(gain, 2)),
        Objective::Windup => format!("{} deg less windup", significant(gain, 2)),
        Objective::StiffnessCurve => {
            format!("{} % less departure from the target", significant(100.0 * gain, 2))
        }
    }
}

/// About one percent of a value, as 1, 2 or 5 times a power of ten.
fn round_step(value: f64) -> f64 {
    let wanted = 0.01 * value.abs().max(1e-9);
    let power = 10_f64.powf(wanted.log10().floor());
    let digit = [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .min_by(|a, b| (a * power - wanted).abs().total_cmp(&(b * power - wanted).abs()));
    digit.unwrap_or(1.0) * power
}

/// "raising the allowable of hoop-inner by 10 MPa would buy 0.8 % slip margin".
pub fn sentence(aim: Objective, price: &Price) -> String {
    let step = round_step(price.value);
    let bought = gain(aim, price.gain_per_unit * step);
    let unit = if price.unit == "1" { "" } else { &price.unit };
    let by = format!("{} {unit}", significant(step, 1)).trim_end().to_owned();
    match price.kind {
        PriceKind::Limit => format!("raising the allowable of {} by {by} would buy {bought}", price.of),
        PriceKind::Margin => format!("asking {by} less of {} would buy {bought}", price.of),
        PriceKind::Lower => format!("lowering the lower bound of {} by {by} would buy {bought}", price.of),
        PriceKind::Upper => format!("raising the upper bound of {} by {by} would buy {bought}", price.of),
    }
}

fn start_table(starts: &[Start]) -> Table {
    let mut table = Table::new(vec![
        Column::text("start", "Start"),
        Column::text("ended", "Ended"),
        Column::number("least_margin", "Least scaled objective", Unit::One, 6),
        Column::number("violation", "Worst violation", Unit::One, 3),
        Column::number("evaluations", "Evaluations", Unit::One, 6),
    ]);
    for s in starts {
        let ended = s.ended.as_ref().map_or_else(|why| why.clone(), |e| e.name().to_owned());
        table.row(vec![
            s.from.as_str().into(),
            ended.as_str().into(),
            finite(s.least_margin),
            finite(s.violation),
            s.evaluations.into(),
        ]);
    }
    table
}

/// What the ends of the climbs say of optima that none has met.
fn optima_line(optima: &Optima) -> String {
    let Optima { climbs, seen } = *optima;
    if climbs == 0 {
        return "No climb converged within the limits".into();
    }
    let met = format!(
        "{climbs} climbs converged within the limits, to {seen} {}",
        if seen == 1 { "optimum" } else { "optima" }
    );
    match optima.expected() {
        Some(e) if optima.enough() => {
            format!(
                "{met}: others are not to be expected ({} in all; Boender and Rinnooy Kan 1987)",
                significant(e, 2)
            )
        }
        Some(e) => format!(
            "{met}: {} in all are to be expected (Boender and Rinnooy Kan 1987), try more --starts",
            significant(e, 2)
        ),
        None => format!("{met}: too few to tell whether there are others, try more --starts"),
    }
}

fn finite(v: f64) -> Cell {
    if v.is_finite() { v.into() } else { Cell::Empty }
}

fn branch_table(branches: &[Branch]) -> Table {
    let mut table = Table::new(vec![
        Column::text("values", "Whole numbers"),
        Column::text("ended", "Ended"),
        Column::number("least_margin", "Least scaled objective", Unit::One, 6),
        Column::number("violation", "Worst violation", Unit::One, 3),
        Column::number("evaluations", "Evaluations", Unit::One, 6),
    ]);
    for b in branches {
        let values: Vec<String> = b.values.iter().map(|(n, v)| format!("{n} = {v}")).collect();
        let ended = b.ended.as_ref().map_or_else(|why| why.clone(), |e| e.name().to_owned());
        table.row(vec![
            values.join(", ").as_str().into(),
            ended.as_str().into(),
            finite(b.least_margin),
            finite(b.violation),
            b.evaluations.into(),
        ]);
    }
    table
}

fn spread_table(made: &Robust) -> Table {
    let mut table = Table::new(vec![
        Column::text("code", "Margin"),
        Column::number("nominal", "As drawn", Unit::One, 4),
        Column::number("worst", "Worst corner", Unit::One, 4),
        Column::number("p01", "1 %", Unit::One, 4),
        Column::number("p05", "5 %", Unit::One, 4),
        Column::number("p50", "50 %", Unit::One, 4),
        Column::text("worst_at", "Worst at"),
    ]);
    for s in &made.spreads {
        let [p01, p05, p50] = s.percentiles;
        table.row(vec![
            s.code.as_str().into(),
            s.nominal.into(),
            s.worst.into(),
            p01.into(),
            p05.into(),
            p50.into(),
            s.worst_at.as_str().into(),
        ]);
    }
    table
}

fn front_table(front: &Front) -> Table {
    let mut columns: Vec<Column> = front
        .aims
        .iter()
        .map(|a| {
            let unit = if a.unit().is_empty() { String::new() } else { format!(", {}", a.unit()) };
            Column::number(a.name(), &format!("{}{unit}", a.words()), Unit::One, 5)
        })
        .collect();
    columns.extend(front.variables.iter().map(|v| Column::number(v, v, Unit::One, 5)));
    columns.push(Column::text("end", "End of the front"));
    let mut table = Table::new(columns);
    for p in &front.points {
        let mut row: Vec<Cell> = p.values.iter().chain(&p.x).map(|v| (*v).into()).collect();
        row.push(p.anchor.map_or("", Objective::words).into());
        table.row(row);
    }
    table
}

/// One part of an answer: heading, sentences, tables with captions, plots with captions.
#[derive(Default)]
pub struct Part {
    /// Heading.
    pub heading: &'static str,
    /// Sentences.
    pub lines: Vec<String>,
    /// Tables.
    pub tables: Vec<(&'static str, Table)>,
    /// Plots as SVG.
    pub plots: Vec<(String, &'static str)>,
}

impl Story {
    /// Parts of the text and of the page, in order.
    pub fn parts(&self) -> Vec<Part> {
        let found = &self.found;
        let aim = found.aim;
        let mut parts = Vec::new();
        if found.starts.len() > 1 {
            let tables = vec![("Climbs, each from its own start", start_table(&found.starts))];
            let lines = vec![optima_line(&found.optima)];
            parts.push(Part { heading: "Starts", lines, tables, ..Part::default() });
        }
        if found.branches.len() > 1 {
            let tables =
                vec![("Each whole number with a continuous search inside", branch_table(&found.branches))];
            parts.push(Part { heading: "Whole numbers", tables, ..Part::default() });
        }
        if !found.prices.is_empty() {
            let lines = found.prices.iter().map(|p| sentence(aim, p)).collect();
            parts.push(Part { heading: "What holds the optimum", lines, ..Part::default() });
        }
        parts.extend(self.relief.iter().flat_map(|relief| relief_parts(self, relief)));
        if let Some(realised) = &self.realised {
            parts.push(Part { heading: "Centroid", lines: realised_lines(aim, realised), ..Part::default() });
        }
        parts.extend(self.front.as_ref().map(front_part));
        parts.extend(self.made.as_ref().map(|made| self.made_part(made)));
        if !self.why.is_empty() {
            parts.push(Part { heading: "Not done", lines: self.why.clone(), ..Part::default() });
        }
        parts
    }

    fn made_part(&self, made: &Robust) -> Part {
        let aim = self.found.aim;
        let (drawn, worst, [p01, p05, p50]) = made.objective;
        let mut lines = vec![format!(
            "{}: {} at the nominal values, {} at the worst of {} corners; 1 %, 5 %, 50 % of {} draws (seed {}) lie below {}, {}, {}; \
             every limit holds in {} of them",
            aim.words(),
            shown(aim, drawn),
            shown(aim, worst),
            made.corners,
            made.draws.0,
            made.seed,
            shown(aim, p01),
            shown(aim, p05),
            shown(aim, p50),
            Unit::Percent.show(made.yield_share, 3)
        )];
        if !made.not_held.is_empty() {
            lines.push(format!("the optimum is not held within the tolerances: {}", places(made)));
        }
        if !made.impossible.is_empty() {
            lines.push(format!("cannot be put together at: {}", made.impossible.join("; ")));
        }
        let mut tables = vec![("Margins of the optimum within the tolerances", spread_table(made))];
        if let Some(robust) = &self.robust {
            lines.push(format!(
                "robust design: {} at the nominal values instead of {}, and {} at the worst corner instead of {}: it gives up {} to \
                 {} ({}, {} corners as limits)",
                shown(aim, robust.made.objective.0),
                shown(aim, drawn),
                shown(aim, robust.made.objective.1),
                shown(aim, worst),
                gain(aim, (drawn - robust.made.objective.0) * aim.sense()),
                if robust.made.held() { "hold every limit at every corner" } else { "come as near as it can" },
                self.robust_status(robust).name(),
                robust.held_at.len()
            ));
            if !robust.made.not_held.is_empty() {
                lines.push(format!(
                    "no design was found that holds every limit at every corner; of this one is not held: {}",
                    places(&robust.made)
                ));
            }
            tables.push(("Margins of the robust design", spread_table(&robust.made)));
        }
        Part { heading: "Within the tolerances", lines, tables, ..Part::default() }
    }

    /// How the search at the corners ended; where there was nothing to do, that of the optimum.
    pub fn robust_status<'s>(&'s self, robust: &'s RobustSearch) -> &'s Status {
        if robust.rounds == 0 { &self.found.outcome.status } else { &robust.status }
    }

    /// Further design files: ending, what it is, text.
    pub fn other_files(&self) -> Vec<(&'static str, &'static str, &str)> {
        let mut files = Vec::new();
        if let Some(realised) = &self.realised {
            let best = realised.search.as_ref().filter(|s| s.feasible());
            let text = best.map_or(&realised.file, |s| &s.file);
            let what = if best.is_some() {
                "flanks searched in place of the centroid"
            } else {
                "flanks nearest to the wanted centroid"
            };
            files.push((REALISED, what, text.as_str()));
        }
        if let Some(robust) = &self.robust {
            let what = match robust.made.held() {
                true => "held at every corner of [tolerances]",
                false => "as near as was found to holding every corner of [tolerances], not held at all",
            };
            files.push((ROBUST, what, robust.file.as_str()));
        }
        files
    }
}

/// Limits that are not held, each with its worst corner.
fn places(made: &Robust) -> String {
    let place = |(code, corner): &(String, String)| format!("{code} (worst at {corner})");
    made.not_held.iter().map(place).collect::<Vec<_>>().join(", ")
}

/// Captions of a front's plots.
const TWO: &str = "Front: no design within the limits is better in both.";
/// See [`TWO`].
const THREE: &str =
    "Points of the front seen along the third objective, joined in the order of the first axis.";

fn front_part(front: &Front) -> Part {
    let label = |a: &Objective| {
        let unit = if a.unit().is_empty() { "1" } else { a.unit() };
        format!("{} ({unit})", a.words())
    };
    let mut plots = Vec::new();
    for (i, j) in [(0, 1), (0, 2), (1, 2)] {
        if j < front.aims.len() {
            let mut points: Vec<[f64; 2]> = front.points.iter().map(|p| [p.values[i], p.values[j]]).collect();
            points.sort_by(|a, b| a[0].total_cmp(&b[0]));
            let plot = Plot::new(&label(&front.aims[i]), &label(&front.aims[j])).curve("front", points);
            plots.push((plot.to_svg(), if front.aims.len() == 2 { TWO } else { THREE }));
        }
    }
    let lines = vec![format!(
        "{} points in {} evaluations; {} climbs ended at a point that another beats or that is not feasible",
        front.points.len(),
        front.evaluations,
        front.beaten
    )];
    Part { heading: "Front", lines, tables: vec![("Points of the front", front_table(front))], plots }
}

fn realised_lines(aim: Objective, r: &Realised) -> Vec<String> {
    let n = &r.nearest;
    let f = &n.flanks;
    let mm = |m: f64| significant(m * 1e3, 5);
    let at = |p: [f64; 2]| format!("({}, {}) mm", mm(p[0]), mm(p[1]));
    let held = r.looked.rows.iter().filter(|m| !m.held()).map(|m| m.code()).collect::<Vec<_>>();
    let limits = if held.is_empty() {
        "every limit held".to_owned()
    } else {
        format!("not held: {}", held.join(", "))
    };
    let flanks = format!(
        "flanks {} mm at the rear, {} mm in front, leaning {} and {} rad",
        mm(f.rear_m),
        mm(f.front_m),
        significant(f.rear_tilt_rad, 4),
        significant(f.front_tilt_rad, 4)
    );
    let weight = format!(
        "{} g instead of {} g, {} kg m2 instead of {}",
        significant(n.mass.mass_kg * 1e3, 4),
        significant(n.given.0 * 1e3, 4),
        significant(n.mass.inertia_kg_m2, 4),
        significant(n.given.1, 4)
    );
    let mut lines = vec![format!(
        "the optimum above has no flanks yet that give it: its centroid {} was free, its mass given",
        at(n.wanted_m)
    )];
    lines.push(if n.reached() {
        format!("realised by {flanks}; the sprag weighs {weight}; {} there {}, {limits}", aim.words(), shown(aim, r.objective))
    } else {
        format!(
            "no two straight flanks realise it; the nearest is {}, {} mm off, by {flanks}; the sprag weighs {weight}; {} there \
             {}, {limits}",
            at(n.mass.centroid_m),
            mm(n.distance_m),
            aim.words(),
            shown(aim, r.objective)
        )
    });
    if let Some(s) = &r.search {
        let ended = s.outcome.status.name();
        let values: Vec<String> =
            s.variables.iter().map(|v| format!("{} {}", v.name, significant(v.best, 5))).collect();
        let verdict = if s.feasible() { "every limit held" } else { "not every limit held" };
        lines.push(format!(
            "searched on with the flanks in place of the centroid: {} {}, {verdict}, {ended} after {} evaluations: {}",
            aim.words(),
            shown(aim, s.objective.1),
            s.evaluations,
            values.join(", ")
        ));
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_price_is_a_sentence() {
        let price = Price {
            of: "hertz-peak-inner".into(),
            kind: PriceKind::Limit,
            unit: "MPa".into(),
            gain_per_unit: 8e-5,
            value: 4600.0,
        };
        let said = sentence(Objective::SlipMargin, &price);
        assert_eq!(said, "raising the allowable of hertz-peak-inner by 50 MPa would buy 0.40 % slip margin");
    }
}
