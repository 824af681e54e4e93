//! Sentences of a search: how it ended, what holds the optimum, what a value is in its unit.

use super::Story;
use crate::answer::check::margin_text;
use crate::design::Objective;
use crate::margin::{Left, Margin};
use crate::optimise::{Cause, NO_INFLUENCE, Optima, Price, PriceKind, Status, Variable};
use crate::report::{Unit, error_beside, significant};

/// Digits to which an objective is shown.
pub(crate) const SHOWN_DIGITS: usize = 5;

/// An objective that gains less than this share of itself is hardly moved.
const HARDLY: f64 = 0.01;

/// What a reader can do about an end, in the words of where it is read: a command names its flags here.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Hints {
    /// Behind "stopped at the evaluation limit".
    pub evaluation_limit: &'static str,
    /// What may find further optima.
    pub more_starts: &'static str,
    /// How a search was stopped from outside.
    pub stopped: &'static str,
    /// Behind "further variables", where these hardly move the objective: who names them.
    pub further_variables: &'static str,
    /// Behind what the answer carries, where its limits are used up to the last: how to keep some to spare.
    pub reserve: &'static str,
    /// Behind "cannot be built": how to see why.
    pub one_step_further: &'static str,
}

impl Default for Hints {
    fn default() -> Self {
        Self {
            evaluation_limit: "",
            more_starts: "search from more starts",
            stopped: "stopped",
            further_variables: "",
            reserve: "",
            one_step_further: "",
        }
    }
}

/// A value of an objective; `None` where a scene has no such margin, which the search counts as [`Left::Lost`].
pub(super) fn known(aim: Objective, value: f64) -> Option<f64> {
    (!aim.of_scenes() || value > Left::Lost.number()).then_some(value)
}

/// A value of an objective with its unit.
pub(crate) fn shown(aim: Objective, value: f64) -> String {
    match aim.unit() {
        _ if known(aim, value).is_none() => "none".to_owned(),
        "" => format!("{} %", significant(100.0 * value, SHOWN_DIGITS)),
        unit => format!("{} {unit}", significant(value, SHOWN_DIGITS)),
    }
}

/// The error of a value of an objective beside it: in the same unit, or that it is below the digits shown.
fn error_of(aim: Objective, value: f64, error: f64) -> String {
    let (unit, scale) = if aim.unit().is_empty() { ("%", 100.0) } else { (aim.unit(), 1.0) };
    error_beside(scale * value, SHOWN_DIGITS, scale * error, unit)
}

/// A gain of an objective, more being better, as it is spoken of.
pub(super) fn gain(aim: Objective, gain: f64) -> String {
    match aim.unit() {
        "" => format!("{} % {}", significant(100.0 * gain, 2), aim.gain()),
        unit => format!("{} {unit} {}", significant(gain, 2), aim.gain()),
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
pub(super) fn price_sentence(aim: Objective, price: &Price) -> String {
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

/// What the ends of the climbs say of optima that none has met.
pub(super) fn optima_line(optima: &Optima, hints: &Hints) -> String {
    let Optima { climbs, seen } = *optima;
    if climbs == 0 {
        return "No climb converged within the limits".into();
    }
    let met = format!(
        "{climbs} climbs converged within the limits, to {seen} {}",
        if seen == 1 { "optimum" } else { "optima" }
    );
    let more = hints.more_starts;
    match optima.expected() {
        Some(e) if optima.enough() => {
            format!(
                "{met}; an estimate (Boender and Rinnooy Kan 1987) has {} in all: there are hardly others",
                significant(e, 2)
            )
        }
        Some(e) => format!(
            "{met}; an estimate (Boender and Rinnooy Kan 1987) has {} in all: for others {more}",
            significant(e, 2)
        ),
        None => format!("{met}: too few to tell whether there are others, {more}"),
    }
}

impl Story {
    /// How it ended, in one sentence.
    pub fn verdict(&self, hints: &Hints) -> String {
        let found = &self.found;
        let (before, after) = self.objective();
        let why = match self.status() {
            Status::Converged => "converged".to_owned(),
            Status::Infeasible { least_violation, fighting } => {
                let names: Vec<&str> = fighting
                    .iter()
                    .filter_map(|&i| self.last().names.limits.get(i))
                    .map(String::as_str)
                    .collect();
                if let Some(sentence) = self.out_of_reach() {
                    return sentence;
                }
                return format!(
                    "infeasible: no design was found within the bounds that holds every limit; the least violation is \
                     {} (by so much the worst margin of the nearest design is too small), stopped by {}",
                    Unit::Percent.show(*least_violation, 2),
                    names.join(" against ")
                );
            }
            Status::EvaluationLimit => {
                format!("its climb stopped at the evaluation limit{}", hints.evaluation_limit)
            }
            Status::Interrupted => hints.stopped.to_owned(),
            Status::Stalled(cause) => {
                let hint = if *cause == Cause::FailingRegion { hints.one_step_further } else { "" };
                format!("stalled: {}{hint}", cause.words())
            }
        };
        // A limit of 3 beside 122 evaluations is no contradiction.
        let counted = match self.status() {
            Status::EvaluationLimit => " in all, those before and after the climbs too",
            _ => "",
        };
        if self.feasible() {
            let reserve = found.problem.reserve();
            format!(
                "{} {} -> {} ({}), every limit held{}{}; {why} after {} evaluations and {} derivatives{counted}{}{}{}",
                found.aim.words(),
                shown(found.aim, before),
                shown(found.aim, after),
                error_of(found.aim, after, self.objective_error()),
                match (reserve > 0.0, self.margins().len() > self.as_searched().len()) {
                    (false, _) => String::new(),
                    (true, false) => format!(" with {} % to spare", significant(100.0 * reserve, 2)),
                    (true, true) => format!(
                        " with {} % to spare, those of sprags off centre and unlike ones as `check` asks",
                        significant(100.0 * reserve, 2)
                    ),
                },
                self.start_not_held(),
                self.evaluations(),
                self.derivatives(),
                match (self.on_grid().and(self.stepped.as_ref()), self.steps_missed_mm) {
                    (Some(s), _) => format!("; lengths in steps of {} mm", s.step_mm),
                    (None, Some(step_mm)) => format!("; lengths NOT yet in steps of {step_mm} mm"),
                    (None, None) => String::new(),
                },
                if self.makeable() {
                    ""
                } else {
                    "; NO FLANKS are known that give its centroid, so it cannot be made"
                },
                self.not_robust().map_or(String::new(), |why| format!("; {why}"))
            )
        } else {
            format!(
                "no feasible design found: {why} after {} evaluations and {} derivatives{counted}; not held: {}{}{}",
                self.evaluations(),
                self.derivatives(),
                self.not_held().join(", "),
                self.worst(),
                self.besides_search()
            )
        }
    }

    /// The limits that the design searched from does not hold, in words behind a design that holds all.
    fn start_not_held(&self) -> String {
        let broken: Vec<String> =
            self.found.start.iter().filter(|m| !self.held(m)).map(Margin::code).collect();
        match broken.len() {
            0 => String::new(),
            n => format!(
                " (the start did not hold {n} {}{}: {})",
                if n == 1 { "limit" } else { "limits" },
                if self.found.problem.reserve() > 0.0 { " with the reserve" } else { "" },
                broken.join(", ")
            ),
        }
    }

    /// The worst margin of a design that does not hold all, the nearest one found.
    fn worst(&self) -> String {
        let rows = self.margins().iter().filter(|m| !self.held(m));
        rows.min_by(|a, b| a.margin().total_cmp(&b.margin())).map_or(String::new(), |m| {
            format!("; worst margin of this nearest design: {}, {}", margin_text(m), m.code())
        })
    }

    /// That what is not held was not searched for, where that is so.
    fn besides_search(&self) -> &'static str {
        let searched = self.margins().len().min(self.as_searched().len());
        match self.margins()[..searched].iter().all(|m| self.held(m)) {
            true => {
                "; a search holds the limits of sprags alike and centred, those off centre and unlike ones are looked at in its end: more \
                 reserve leaves them more"
            }
            false => "",
        }
    }

    /// What to say where the best slip margin is less than the wanted one and nothing else is broken.
    fn out_of_reach(&self) -> Option<String> {
        let found = &self.found;
        let wanted = found.problem.limits().slip_margin?;
        (found.aim == Objective::SlipMargin
            && self.margins().iter().filter(|m| !self.held(m)).all(Margin::is_slip))
        .then(|| {
            format!(
                "infeasible: the largest {} found is {}, and slip_margin asks for {}; it is held down by {}",
                found.aim.words(),
                shown(found.aim, self.objective().1),
                significant(wanted, 4),
                self.active().join(", ")
            )
        })
    }

    /// What holds the optimum where it is: objectives, limits, bounds.
    pub fn active(&self) -> Vec<String> {
        let a = &self.made().outcome.active;
        let n = &self.made().names;
        let free = &self.made().searched;
        let objectives = a.objectives.iter().filter_map(|&i| n.objectives.get(i)).cloned();
        let limits = a.limits.iter().filter_map(|&i| n.limits.get(i)).cloned();
        let lower = a.lower.iter().filter_map(|&i| free.get(i)).map(|s| format!("{s} at its lower bound"));
        let upper = a.upper.iter().filter_map(|&i| free.get(i)).map(|s| format!("{s} at its upper bound"));
        objectives.chain(limits).chain(lower).chain(upper).collect()
    }

    /// Variables whose value in the file lies outside their bounds, numbers that went with one, and an objective that none of them
    /// changes, or hardly so, a sentence each.
    pub fn notes_on_variables(&self, hints: &Hints) -> Vec<String> {
        let line = |v: &Variable| {
            v.outside().map(|outside| {
                format!("{outside}: the search started from {}, and Before is there.", v.start)
            })
        };
        let mut lines: Vec<String> = self.found.variables.iter().filter_map(line).collect();
        lines.extend(self.linked());
        let felt = |slopes: &Vec<f64>| slopes.iter().any(|s| s.abs() >= NO_INFLUENCE);
        // Margins of scenes are level where no friction suffices.
        if !self.found.aim.of_scenes() && !self.found.influence.objectives.iter().any(felt) {
            lines.push(format!(
                "No variable changes the {} at the start: if that is no accident, name one that does, or let one take further \
                 numbers along (its keys moves and scales).",
                self.found.aim.words()
            ));
        } else {
            lines.extend(self.hardly_moved(hints));
        }
        lines
    }

    /// What to say where the optimum of a start that held everything is better by less than [`HARDLY`]; of the slip margin, which
    /// the first variables of a design are chosen for, nothing.
    fn hardly_moved(&self, hints: &Hints) -> Option<String> {
        let aim = self.found.aim;
        let (before, after) = self.objective();
        let gained = (after - before) * aim.sense() / before.abs();
        let is_told = aim != Objective::SlipMargin && self.feasible() && self.found.start_feasible();
        (is_told && (0.0..HARDLY).contains(&gained)).then(|| {
            format!(
                "Within their bounds and the limits these variables hardly move the {}, by {}: for more, name further variables{}.",
                aim.words(),
                Unit::Percent.show(gained, 2),
                hints.further_variables
            )
        })
    }

    /// What went with a variable, a line each.
    fn linked(&self) -> impl Iterator<Item = String> {
        let as_searched = self.found.problem.links();
        let links = self.on_grid().map_or(as_searched, |on_grid| &on_grid.links);
        links.iter().zip(as_searched).filter_map(|((name, link), (_, exact))| {
            let variable = self.made().variables.iter().find(|v| v.name == *name)?;
            Some(format!(
                "{} goes with {name}: {} -> {}",
                link.path,
                significant(exact.value(variable.given), 6),
                significant(link.value(self.value(variable)), 6)
            ))
        })
    }

    /// What the optimum gained or lost when it was looked at with everything.
    pub fn in_full(&self) -> String {
        let changes = self.margins().iter().zip(self.as_searched());
        let most = changes
            .map(|(a, b)| ((a.margin() - b.margin()).abs(), a.code()))
            .max_by(|a, b| a.0.total_cmp(&b.0));
        match most {
            Some((change, code)) => format!(
                "Looked at in full, at a true error of 1e-7 or less: no margin moves by more than {change:.0e} ({code})."
            ),
            None => String::new(),
        }
    }
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
        let sentence = price_sentence(Objective::SlipMargin, &price);
        assert_eq!(
            sentence,
            "raising the allowable of hertz-peak-inner by 50 MPa would buy 0.40 % slip margin"
        );
    }
}
