//! What an identification says: tables and sentences.

use super::UnknownRow;
use crate::identify::{Doubt, FittedPoint, INSEPARABLE, Identified, Tied, Unknown, Use};
use crate::report::{Cell, Rows, Table, Unit, significant};

fn use_name(purpose: Use) -> &'static str {
    match purpose {
        Use::Fit => "fit",
        Use::Check => "check",
    }
}

/// The unknowns as found; each in the unit of its name.
pub(super) fn estimates(found: &Identified) -> Rows<UnknownRow<'_>> {
    Rows::of(found.unknowns.iter().zip(&found.before).zip(&found.knowledge.estimates).map(
        |((u, before), e)| {
            let range = u.max - u.min;
            let bound = if e.value - u.min < 1e-6 * range {
                Some("at its lower bound")
            } else if u.max - e.value < 1e-6 * range {
                Some("at its upper bound")
            } else {
                None
            };
            let doubt = e.doubt.map(|doubt| in_short(found, doubt));
            let note = bound.map(str::to_owned).into_iter().chain(doubt).collect::<Vec<_>>().join(", ");
            (u, before, e, note)
        },
    ))
    .text("name", "Unknown", |(u, _, _, _)| u.name.as_str())
    .number("min", "From", Unit::One, 6, |(u, _, _, _)| u.min)
    .number("max", "To", Unit::One, 6, |(u, _, _, _)| u.max)
    .number("before", "Before", Unit::One, 6, |(_, before, _, _)| **before)
    .number("value", "Found", Unit::One, 7, |(_, _, e, _)| e.value)
    .number("half_width_95", "± scatter", Unit::One, 3, |(_, _, e, _)| e.half_width)
    .number("half_width_95_by_law", "± law", Unit::One, 3, |(_, _, e, _)| e.by_law)
    .text("note", "Note", |(_, _, _, note)| note.clone())
    .json("sigma", |(_, _, e, _)| e.sigma)
    .json("determined", |(_, _, e, _)| e.doubt.is_none())
}

/// Every observation beside what the model says.
pub(super) fn residuals(found: &Identified) -> Rows<&FittedPoint> {
    Rows::of(&found.points)
        .text("label", "Row", |p| p.observation.label.as_str())
        .text("use", "Use", |p| use_name(p.observation.purpose))
        .text("quantity", "Quantity", |p| p.observation.kind.name())
        .number("torque_nm", "At torque", Unit::NewtonMetre, 5, |p| p.observation.torque_nm)
        .number("observed", "Observed", Unit::One, 6, |p| p.observation.value)
        .number("predicted", "Model", Unit::One, 6, |p| p.predicted.as_ref().ok().map(|s| s.value))
        .number("relative", "Off", Unit::One, 3, |p| p.relative())
        .shown_in(Unit::Percent)
        .text("decided_by", "Decided by", |p| match &p.predicted {
            Ok(prediction) => prediction.decided_by.clone().map_or(Cell::told("", Cell::Empty), Cell::from),
            Err(why) => Cell::told(&why.to_string(), Cell::Empty),
        })
        .hidden("why_not", Unit::One, |p| p.predicted.as_ref().err().map(ToString::to_string))
        .json("line", |p| p.observation.line)
}

/// Correlation of the unknowns.
pub(super) fn correlation(found: &Identified) -> Option<Table> {
    let matrix = found.knowledge.correlation.as_ref()?;
    let each = found.unknowns.iter().enumerate();
    let rows = Rows::of(found.unknowns.iter().zip(matrix)).text("unknown", "", |(u, _)| u.name.as_str());
    let name = |(_, u): &(usize, &Unknown)| (u.name.clone(), u.name.clone());
    Some(rows.each(each, name, Unit::One, 4, |(_, row), (j, _)| row.get(*j).copied()).table())
}

/// How far an unknown is not determined, in a few words.
pub(super) fn in_short(found: &Identified, doubt: Doubt) -> String {
    match doubt {
        Doubt::Inseparable(other) => format!("determined only together with {}", found.unknowns[other].name),
        Doubt::AtBound => "not determined: at a bound".to_owned(),
        _ => "not determined".to_owned(),
    }
}

/// Whether the data determine the unknowns, in one line.
pub(super) fn verdict(found: &Identified) -> String {
    let name = |j: usize| found.unknowns[j].name.as_str();
    let (mut not, mut together) = (Vec::new(), Vec::new());
    for (j, doubt) in found.knowledge.undetermined() {
        match doubt {
            Doubt::Inseparable(other) => {
                let pair = format!("{} and {}", name(j.min(other)), name(j.max(other)));
                if !together.contains(&pair) {
                    together.push(pair);
                }
            }
            _ => not.push(name(j)),
        }
    }
    let not = (!not.is_empty()).then(|| format!("the data do not determine {}", not.join(", ")));
    let together =
        (!together.is_empty()).then(|| format!("determined only together: {}", together.join("; ")));
    let parts: Vec<String> = not.into_iter().chain(together).collect();
    if !parts.is_empty() {
        return parts.join("; ");
    }
    let each = found.unknowns.iter().zip(&found.knowledge.estimates).map(|(u, e)| {
        let off = [(e.half_width, "by scatter"), (e.by_law, "by the contact law")];
        let off = off.into_iter().filter_map(|(off, by)| Some(format!(" ± {} {by}", significant(off?, 2))));
        format!("{} = {}{}", u.name, significant(e.value, 4), off.collect::<String>())
    });
    format!("every unknown is determined: {}", each.collect::<Vec<_>>().join("; "))
}

/// Why the data do not determine the unknown `j`; a blind direction and too few observations have sentences of their own.
fn doubt_sentence(found: &Identified, j: usize, doubt: Doubt) -> Option<String> {
    let (u, e) = (&found.unknowns[j], &found.knowledge.estimates[j]);
    let interval = format!(
        "{} = {} +- {}",
        u.name,
        significant(e.value, 4),
        significant(e.half_width.unwrap_or(f64::INFINITY), 3)
    );
    Some(match doubt {
        Doubt::NoInterval => return None,
        Doubt::AtBound => format!(
            "{} ends at a bound of {} to {}: the best value may lie beyond; widen the bounds, or the model does not fit these data",
            u.name, u.min, u.max
        ),
        Doubt::WiderThanBounds => format!(
            "{interval} says no more than its bounds {} to {} did: add data that feel it, or leave it out of the unknowns",
            u.min, u.max
        ),
        Doubt::WiderThanValue => format!(
            "{interval} is uncertain by more than half its value: add data that feel it, or leave it out of the unknowns"
        ),
        Doubt::Inseparable(other) => format!(
            "{interval} holds only if the model is exact: with {} it forms one unknown; fix one of the two",
            found.unknowns[other].name
        ),
    })
}

/// What is said of the unknown `j`, which the data do not feel where it ended.
fn silent(found: &Identified, j: usize) -> String {
    let (u, before, value) = (&found.unknowns[j], found.before[j], found.knowledge.estimates[j].value);
    let beyond = if !(u.min..=u.max).contains(&before) || value == before {
        String::new()
    } else {
        let side = if value > before { "below" } else { "above" };
        format!("; {side} {} they are met less well, and nothing is to spare there", significant(value, 4))
    };
    format!("the data say nothing of {}{beyond}", u.name)
}

/// Root of chi^2 over the degrees of freedom from which on standard errors are doubted: a choice, far beyond chance for ten rows.
const TOO_MUCH: f64 = 2.0;

/// How good it is and what cannot be told apart.
pub(super) fn sentences(found: &Identified) -> Vec<String> {
    let k = &found.knowledge;
    let mut out = Vec::new();
    for (purpose, words) in [(Use::Fit, "fitted"), (Use::Check, "held back")] {
        let offs: Vec<f64> = found
            .points
            .iter()
            .filter(|p| p.observation.purpose == purpose)
            .filter_map(FittedPoint::relative)
            .collect();
        if offs.is_empty() {
            continue;
        }
        let rms = (offs.iter().map(|o| o * o).sum::<f64>() / offs.len() as f64).sqrt();
        let worst = offs.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
        out.push(format!(
            "{} observations {words}: rms {}, worst {}",
            offs.len(),
            Unit::Percent.show(rms, 3),
            Unit::Percent.show(worst, 3)
        ));
    }
    out.push(format!(
        "{}; {} evaluations, sums of squares of the starts {}",
        if found.converged { "converged" } else { "NOT converged: more --evaluations" },
        found.evaluations,
        found.sums.0.iter().map(|s| significant(*s, 5)).collect::<Vec<_>>().join(", ")
    ));
    let given =
        found.points.iter().all(|p| p.observation.sigma.is_some() || p.observation.purpose == Use::Check);
    if let Some(times) = k.residual_sigma.filter(|times| given && *times > TOO_MUCH) {
        out.push(format!(
            "the residuals are {} times the standard errors given: these are too small, or the model does not fit",
            significant(times, 3)
        ));
    }
    // Unknowns without influence have a sentence of their own.
    let felt = found.unknowns.len() - k.without_influence().len();
    if k.freedom == 0 && felt > 0 {
        out.push(format!(
            "as many unknowns as observations, or more: no confidence can be stated ({felt} unknown{})",
            if felt == 1 { "" } else { "s" }
        ));
    }
    out.extend(k.undetermined().filter_map(|(j, doubt)| doubt_sentence(found, j, doubt)));
    if k.estimates.iter().any(|e| e.by_law.is_some()) {
        out.push(
            "± at 95 %; scatter: of these data, were the model exact; law: what the contact law's own error beside finite \
             elements, smooth over torque, moves the value by"
                .to_owned(),
        );
    }
    if let Some(apart) = &found.apart {
        let (a, b) = apart.pair;
        out.push(format!(
            "to tell {} and {} apart, measure {} at the same torques as well: their correlation falls to {:.2}",
            found.unknowns[a].name,
            found.unknowns[b].name,
            apart.quantity.name(),
            apart.correlation
        ));
    }
    let name = |i: usize| found.unknowns[i].name.as_str();
    for tied in &k.tied {
        out.push(match tied {
            Tied::Strongly { first, second, correlation } => {
                let (a, b) = (name(*first), name(*second));
                match correlation.abs() > INSEPARABLE {
                    true => format!(
                        "the data hardly tell {a} and {b} apart: correlation {correlation:.4}; only a combination of them is well \
                         known"
                    ),
                    false => format!(
                        "{a} and {b} go together: correlation {correlation:.4}; a combination of them is known better than either"
                    ),
                }
            }
            Tied::Blind { direction } => {
                let moved: Vec<usize> = (0..direction.len()).filter(|&j| direction[j].abs() > 0.01).collect();
                let by = |&j: &usize| {
                    let u = &found.unknowns[j];
                    format!("{} by {}", u.name, significant(direction[j] * (u.max - u.min), 3))
                };
                match moved.as_slice() {
                    [one] => silent(found, *one),
                    _ => format!(
                        "the data cannot tell these apart: moving {} together changes no observation",
                        moved.iter().map(by).collect::<Vec<_>>().join(", ")
                    ),
                }
            }
        });
    }
    out
}
