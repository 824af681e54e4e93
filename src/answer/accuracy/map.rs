//! The stability map in words, counts and plots.

use super::AccuracyStudy;
use crate::accuracy::{CaseEnd, Halved, Judged, PARAMETERS};
use crate::report::{Bar, Bars, Curve, Plot, Rows, Table, Tone, Unit};

/// Outcomes in the order in which they are listed.
const ORDER: [&str; 14] = [
    "sticks",
    "slips-overrunning",
    "slips-engaging",
    "disengages",
    "overloaded",
    "at-threshold",
    "not-carried",
    "no-curve",
    "event-limit",
    "step-limit",
    "undecided",
    "not-finite",
    "curve-end",
    "fell-away",
];

/// Cases by outcome, those without a case left out.
pub(super) fn by_outcome<'s>(study: &'s AccuracyStudy<'_>) -> Vec<(&'static str, Vec<&'s Judged>)> {
    let of = |name: &'static str| study.cases.iter().filter(move |c| c.outcomes[0].name() == name);
    ORDER.iter().map(|&name| (name, of(name).collect::<Vec<_>>())).filter(|(_, c)| !c.is_empty()).collect()
}

/// What the map says, in one sentence or two.
pub(super) fn summary(study: &AccuracyStudy<'_>) -> String {
    let count = |f: fn(&Judged) -> bool| study.cases.iter().filter(|c| f(c)).count();
    let halved = Halved::of(&study.cases);
    let ran = count(|c| c.outcomes[0].starts());
    let again = study.limit.most_steps_again.map_or(String::new(), |most_steps| {
        let [all, settled] = [count(|c| c.again), count(|c| c.again && c.outcomes[0].verdict().is_some())];
        format!(
            " Those that met these limits without a verdict, {all}, were run once more within {most_steps} steps and {} changes: \
             {settled} of them have one so.",
            most_steps / 2
        )
    });
    format!(
        "{} cases (seed {}), each run at a tolerance of {:.0e} and at half of it within {} steps and {} changes of mode \
         a run: {ran} start, of which {} end with a verdict, {} at a limit. {}; {} verdicts become at-threshold there, or were \
         it. {} answers hold a number that is not finite.{again} {}.",
        study.cases.len(),
        study.seed,
        study.limit.tolerance,
        study.limit.most_steps,
        study.limit.most_events,
        halved.verdicts,
        count(|c| c.outcomes[0].met_a_limit()),
        at_half(&halved),
        halved.at_threshold,
        count(|c| c.not_finite.is_some()),
        drives(study),
    )
}

/// What the map says of drives.
pub(super) fn drives(study: &AccuracyStudy<'_>) -> String {
    let [start, limit] = study.of_drives();
    format!(
        "{start} of the cases that start could be of a drive (races no lighter than their bare rings, springs that take no more than \
         a tenth of the torque at the end of the curve, an abutment on which the outer race swings no faster than it breathes \
         as a ring): {limit} of them at a limit"
    )
}

/// What half the tolerance does to the verdicts.
pub(super) fn at_half(h: &Halved) -> String {
    format!(
        "{} of {} verdicts change to another at half the tolerance; {} are lost there (to a limit of work, or undecided), {} \
         gained; {} have not reached the tolerance",
        h.changed, h.verdicts, h.lost, h.gained, h.not_reached
    )
}

/// Counts and worst work by outcome.
pub(super) fn counts(study: &AccuracyStudy<'_>) -> Table {
    let most = |cases: &[&Judged], f: fn(&Judged) -> u64| cases.iter().map(|c| f(c)).max().unwrap_or(0);
    Rows::of(by_outcome(study))
        .text("outcome", "Outcome", |(name, _)| *name)
        .number("cases", "Cases", Unit::One, 6, |(_, cases)| cases.len())
        .number("not_converged", "Tolerance not reached", Unit::One, 6, |(_, cases)| {
            cases.iter().filter(|c| !c.converged).count()
        })
        .number("most_events", "Most changes of mode", Unit::One, 6, |(_, cases)| most(cases, |c| c.events))
        .number("most_steps", "Most steps, both answers", Unit::One, 6, |(_, cases)| most(cases, |c| c.steps))
        .number("most_rhs_evaluations", "Most right-hand sides", Unit::One, 6, |(_, cases)| {
            most(cases, |c| c.rhs_evaluations)
        })
        .table()
}

/// A kind of cases: key of its list in the results, words, which they are.
type Kind = (&'static str, &'static str, fn(&Judged) -> bool);

/// Kinds that a reader must see.
pub(super) const REMARKABLE: [Kind; 4] = [
    ("verdict_changes", "Verdict is another at half the tolerance", |c| c.verdict_changes),
    ("lost_or_gained", "Verdict is lost or gained at half the tolerance", |c| {
        let [a, b] = c.verdicts();
        a.is_some() != b.is_some()
    }),
    ("not_finite", "A number is not finite", |c| c.not_finite.is_some()),
    ("limits", "A limit of work is met at either tolerance", |c| c.outcomes.iter().any(|o| o.met_a_limit())),
];

/// How many there are of each kind.
pub(super) fn remarkable(study: &AccuracyStudy<'_>) -> Table {
    Rows::of(REMARKABLE)
        .text("what", "Cases to look at", |(_, words, _)| *words)
        .number("cases", "Cases", Unit::One, 6, |(.., is)| study.cases.iter().filter(|c| is(c)).count())
        .text("key", "List in --json", |(key, ..)| format!("stability_map.{key}"))
        .table()
}

/// How many cases ended in each way.
pub(super) fn bars(study: &AccuracyStudy<'_>) -> Bars {
    let all = by_outcome(study);
    let most = all.iter().map(|(_, c)| c.len()).max().unwrap_or(1);
    let tone = |c: &Judged| match c.outcomes[0] {
        CaseEnd::Verdict(_) => Tone::Plain,
        o if o.met_a_limit() => Tone::Bad,
        _ => Tone::Soft,
    };
    let bar = |(name, cases): &(&str, Vec<&Judged>)| Bar {
        label: (*name).to_owned(),
        value: cases.len() as f64,
        text: cases.len().to_string(),
        tone: cases.first().map_or(Tone::Soft, |c| tone(c)),
    };
    Bars {
        title: "Cases by outcome".to_owned(),
        bars: all.iter().map(bar).collect(),
        marks: Vec::new(),
        range: (0.0, most as f64),
    }
}

/// Outcomes over two parameters, by their keys; a value of zero is drawn at the axis' smallest.
pub(super) fn scatter(study: &AccuracyStudy<'_>, x: usize, y: usize, titles: [&str; 2]) -> Plot {
    let mut plot = Plot::new(titles[0], titles[1]).sized(720.0, 400.0);
    (plot.log_x, plot.log_y) = (true, true);
    let at = |c: &Judged, i: usize| c.case.values[i].max(PARAMETERS[i].low);
    for (name, cases) in by_outcome(study) {
        // A gap after each point: dots without a line.
        let dots = cases.iter().flat_map(|c| [[at(c, x), at(c, y)], [f64::NAN; 2]]).collect();
        plot.curves.push(Curve::new(name, dots));
    }
    plot
}

/// Work of each case over its number of mode changes.
pub(super) fn work(study: &AccuracyStudy<'_>) -> Plot {
    let mut plot =
        Plot::new("Changes of mode, one more", "Right-hand sides, both answers").sized(720.0, 400.0);
    (plot.log_x, plot.log_y) = (true, true);
    for (name, cases) in by_outcome(study) {
        let point = |c: &&Judged| [[c.events as f64 + 1.0, c.rhs_evaluations as f64], [f64::NAN; 2]];
        let dots: Vec<[f64; 2]> = cases.iter().filter(|c| c.rhs_evaluations > 0).flat_map(point).collect();
        if !dots.is_empty() {
            plot.curves.push(Curve::new(name, dots));
        }
    }
    plot
}
