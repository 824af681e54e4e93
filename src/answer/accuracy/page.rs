//! The comparison and the map as a page.

use super::verdict::{WANTED_RAD, cheapest, gains_over_published, name, sentence};
use super::{AccuracyStudy, map, tables};
use crate::accuracy::{Halved, Judged, PARAMETERS, Precision, Scheme, WorkPoint};
use crate::answer::page::{begun, half};
use crate::answer::{Answer, Provenance};
use crate::report::plot::Dash;
use crate::report::{Curve, Page, Plot, Rows, Table, Unit, significant};

/// Smaller errors are drawn here: rounding.
const FLOOR_RAD: f64 = 1e-15;

/// The page.
pub(super) fn page(study: &AccuracyStudy<'_>, provenance: &Provenance) -> Page {
    let mut page = begun("Accuracy", study.design, &provenance.command);
    let (held, line) = verdict(study);
    page.verdict(held, &line);
    if let Some(first) = study.scenes.first() {
        let time = plot(first, "Time, ms", |p| 1e3 * p.seconds);
        page.figure(
            &time.to_figure(),
            &format!("Error of the angle of the inner race over the time of a run, scene {}: lower left is better.", first.scene),
        );
    }
    for scene in &study.scenes {
        page.heading(&scene.scene).paragraph(&sentence(scene));
        let rhs = plot(scene, "Right-hand sides", |p| p.rhs_evaluations as f64);
        let time = plot(scene, "Time, ms", |p| 1e3 * p.seconds);
        page.figures(&[
            (half(rhs), "Error of θ_bi over right-hand sides."),
            (half(time), "The same over time (median; one thread of a machine that others use too)."),
        ]);
        page.apart(&format!("Reference and settings of {}", scene.scene), |page| {
            page.paragraph(&reference(scene)).table("", &tables::scene(scene));
        });
    }
    page.list(study.without_start.iter().map(|(name, why)| format!("{name}: {why}")));
    if !study.cases.is_empty() {
        stability(&mut page, study);
    }
    page.heading("Omissions").list(OMISSIONS);
    study.envelope(provenance.run_time_s).close(&mut page);
    page
}

const OMISSIONS: [&str; 8] = [
    "Integrators of others are not compared here but in reports/accuracy-peers.html, on the same right-hand sides and events.",
    "One quantity decides: θ_bi at the end, beside it the slip margin. Slip distances, peaks and times of contact loss \
     have error estimates of their own in simulate, which --tolerance holds below its value; they are not plotted.",
    "Errors are differences to the event method itself at steps of 1e-13. That the equations are those meant is shown \
     elsewhere: an independent script, energy balances and the paper's statements, in the tests.",
    "The published scheme has no slip margin (that takes a second, purely rolling run) and no error estimate. A whole answer \
     of the event method is at least three runs at step tolerances tenfold apart, each with a pure-rolling run beside it \
     unless friction suffices, where that is itself the run (planned model), and with bisection runs where rolling unloads \
     the contact; so the published scheme is to be compared with “one run”.",
    "The published scheme is run with a band of its own choice: the paper gives none. Steps below the smallest one asked for \
     are left out for their run time.",
    "Engagements, transients and steady overruns are not compared: the published scheme is written for torsional excitation.",
    "Building the model (the wedge curve) is timed apart: all methods need it once. All read the same curve and the same \
     accelerations; the published scheme takes four evaluations a step.",
    "The slice contact, which makes the right-hand side no dearer (its table is built before the run), is not varied.",
];

pub(super) fn verdict(study: &AccuracyStudy<'_>) -> (bool, String) {
    let wins = |s: &&Precision| {
        let ours = s.methods.iter().find(|m| m.0 == Scheme::OneRun).and_then(|m| cheapest(&m.1));
        let theirs = s.methods.iter().filter(|m| m.0.band_m_s().is_some()).filter_map(|m| cheapest(&m.1));
        let least = theirs.map(|p| p.seconds).fold(f64::INFINITY, f64::min);
        ours.is_some_and(|p| p.seconds < least)
    };
    let won = study.scenes.iter().filter(wins).count();
    let changed = study.cases.iter().filter(|c| c.verdict_changes || c.not_finite.is_some()).count();
    let least = study.scenes.iter().filter_map(gains_over_published).fold(f64::INFINITY, |l, g| l.min(g[0]));
    let gain = if least.is_finite() {
        // Rounded down: it is said to be a least.
        let least = significant((10.0 * least).floor() / 10.0, 3);
        format!("; one run is at least {least} times as fast as the published one at 1e-5 s")
    } else {
        String::new()
    };
    let map = if study.cases.is_empty() {
        String::new()
    } else {
        let count = |f: fn(&Judged) -> bool| study.cases.iter().filter(|c| f(c)).count();
        let [of_drives, at_a_limit] = study.of_drives();
        format!(
            "; in the map of {} cases {}; {} hold a number that is not finite, {} end without a verdict at their limit of work, \
             {} of the {} that could be of a drive",
            study.cases.len(),
            map::at_half(&Halved::of(&study.cases)),
            count(|c| c.not_finite.is_some()),
            count(|c| c.outcomes[0].met_a_limit()),
            at_a_limit,
            of_drives,
        )
    };
    let line = format!(
        "The event method is the cheapest below {WANTED_RAD:.0e} rad in {won} of {} scenes{gain}{map}",
        study.scenes.len()
    );
    (won == study.scenes.len() && changed == 0, line)
}

fn reference(s: &Precision) -> String {
    let [theta, margin] = s.reference_error;
    let without = if s.left_out.is_empty() { "nothing".to_owned() } else { s.left_out.join(", ") };
    format!(
        "Reference: θ_bi {:.12} rad, slip margin {}, {} changes of mode; at ten times its tolerance and twice its \
         longest step it moves by {theta:.1e} rad and {margin:.1e}. The planned model leaves out: {without}. It is built in \
         {} ms, the full one in {} ms.",
        s.theta_inner_rad,
        s.slip_margin.map_or("none".to_owned(), |m| significant(m, 9)),
        s.events,
        significant(1e3 * s.prepare_s[1], 3),
        significant(1e3 * s.prepare_s[0], 3),
    )
}

fn plot(scene: &Precision, x_title: &str, x: impl Fn(&WorkPoint) -> f64) -> Plot {
    let mut plot = Plot::new(x_title, "Error of θ_bi, rad");
    (plot.log_x, plot.log_y) = (true, true);
    for (method, points) in &scene.methods {
        let at = |p: &WorkPoint| [x(p), p.theta_error_rad.map_or(f64::NAN, |e| e.max(FLOOR_RAD))];
        let dash = match method {
            Scheme::OneRun | Scheme::Reduced => Dash::Solid,
            Scheme::Full => Dash::Dashed,
            Scheme::Published(_) => Dash::Dotted,
        };
        plot.curves.push(Curve {
            dash,
            dots: true,
            ..Curve::new(&name(*method), points.iter().map(at).collect())
        });
    }
    plot.level(WANTED_RAD, "wanted")
}

fn stability(page: &mut Page, study: &AccuracyStudy<'_>) {
    page.heading("Stability map").paragraph(&map::summary(study));
    page.table("The box: each value at either end or evenly in its logarithm between; every fourth case is a corner of the \
                whole box. Ten periods, at most 0.1 s.", &axes());
    page.figure(
        &map::bars(study).to_figure(),
        "Cases by outcome; not carried: the preload exceeds what the clutch holds.",
    );
    page.table("", &map::counts(study));
    page.figure(
        &map::scatter(study, 5, 4, ["Frequency, Hz", "Amplitude, Nm"]).to_figure(),
        "Outcome over frequency and amplitude; an amplitude of zero stands at 0.1 Nm.",
    );
    page.figure(
        &map::scatter(study, 0, 3, ["Static friction", "Preload, Nm"]).to_figure(),
        "Outcome over static friction and preload; a preload of zero stands at 0.1 Nm.",
    );
    page.figure(&map::work(study).to_figure(), "Work over changes of mode.");
    page.table("The cases themselves are in the results of this page too.", &map::remarkable(study));
}

fn axes() -> Table {
    Rows::of(&PARAMETERS)
        .text("parameter", "Parameter, SI", |p| p.key)
        .number("from", "From", Unit::One, 4, |p| p.low)
        .number("to", "To", Unit::One, 4, |p| p.high)
        .text("zero", "Zero too", |p| if p.zero { "yes" } else { "no" })
        .table()
}
