//! The page.

use sprag_design::identify::{Tied, Use};
use sprag_design::report::plot::Dash;
use sprag_design::report::{Cell, Column, Curve, Page, PageHead, Plot, Table, Tone, Unit, significant};

use crate::rows::{LEFT_OUT, PITCH_MM, Row};
use crate::size::power_law;
use crate::study::{Case, Study, rms, worst};
use crate::wider::wider;

pub(crate) fn page(study: &Study) -> Page {
    let mut page = Page::new(PageHead {
        title: "A catalogue from its rules".into(),
        tool: env!("CARGO_PKG_NAME").into(),
        version: env!("CARGO_PKG_VERSION").into(),
        command: "cargo run --release --example catalogue".into(),
        design: format!("{}; GMN 9050, series FE 8000", study.series.name),
        design_hash: study.series.hash.clone(),
    });
    let [rms_printed, rms_gap] = [&study.printed, &study.gap].map(|case| {
        let off = case.judged();
        format!(
            "{} in the mean, {} at worst",
            Unit::Percent.show(rms(&off), 3),
            Unit::Percent.show(worst(&off), 3)
        )
    });
    page.verdict_in(
        if study.printed.holds() { Tone::Good } else { Tone::Soft },
        &format!(
            "The maker's rules and one profile, found from every third row, give the nominal torques of the other rows within {rms_printed}; \
             with the one rule set free that fails, the race gap, within {rms_gap}"
        ),
    );
    deviations(&mut page, study);
    page.paragraph(
        "The maker prints diameters, widths and nominal torques of 38 sizes and the rules by which he rates them: Hertz pressure \
         4200 MPa, race gap 8.46 mm (8.33 at rest), equivalent stress 750 MPa (100Cr6), each at nominal torque, on a solid shaft, \
         with an outer race of D/D_L = 1.4, races as wide as the element plus 3 mm, friction 0.11, windup below 3°. He prints \
         neither the sprag's profile nor the number of sprags. Here one profile is found from every third row; the torque \
         of every row is then the smallest at which one of his rules is reached. Law: elastic, with nothing fitted in it.",
    );
    conclusion(&mut page, study);
    page.heading("What was asked").table("", &asked(study));
    limits(&mut page, study);
    wider(&mut page, study);
    for case in [&study.printed, &study.gap] {
        page.apart(&format!("The profile that the fitted rows identify: {}", case.name), |page| {
            identified(page, case)
        });
        page.apart(&format!("Row by row: {}", case.name), |page| sizes(page, case));
    }
    page.apart("Rows left out", |page| left(page, study));
    page.apart("What the residuals say, gap set free", |page| residuals(page, study));
    omissions(&mut page);
    page.source("Series before the profile is known", &study.series.source);
    page.source("Series with the profile found, rules as printed", &study.printed.found.source);
    page.source("Series with the profile found, gap set free", &study.gap.found.source);
    page
}

/// Every reading against what was asked of it.
fn asked(study: &Study) -> Table {
    let mut table = Table::new(vec![
        Column::text("case", "Reading"),
        Column::text("found", "What came out"),
        Column::text("verdict", "Verdict"),
    ]);
    for case in study.cases() {
        for (i, (held, text)) in case.verdicts().into_iter().enumerate() {
            let name = if i == 0 { case.name } else { "" };
            let verdict = Cell::Verdict(held, if held { "held" } else { "NOT HELD" }.to_owned());
            table.row(vec![name.into(), text.into(), verdict]);
        }
    }
    table
}

/// Which rule fails, and what the data put in its place.
fn conclusion(page: &mut Page, study: &Study) {
    let (printed, gap, friction) = (&study.printed, &study.gap, &study.friction);
    let largest = printed.sizes.iter().max_by(|a, b| a.row.inner_mm.total_cmp(&b.row.inner_mm));
    let opening = largest.map_or(0.0, |s| s.opening_mm);
    let freed = |case: &Case| {
        let e = case.found.knowledge.estimates.last();
        e.map_or(String::new(), |e| {
            format!("{:.3} ± {}", e.value, e.half_width.map_or("–".to_owned(), |w| significant(w, 2)))
        })
    };
    let ratio = printed.found.sums.1 / gap.found.sums.1;
    let freedom = gap.found.knowledge.freedom as f64;
    page.heading("Which assumption fails");
    page.list([
        format!(
            "With every rule as printed no profile does better than rms {} and worst {}, even when it is fitted on every row: \
             pressure alone makes torque grow with some 1.8th power of the diameter, the gap alone with the 0.9th, and the catalogue \
             follows its 1.46th power without a bend where the one takes over from the other.",
            Unit::Percent.show(rms(&study.best.judged()), 3),
            Unit::Percent.show(worst(&study.best.judged()), 3)
        ),
        format!(
            "What fails is the gap of 8.46 mm on the large sizes: at the catalogue's torque a plain ring of D/D_L = 1.4 and width \
             W + 3 mm opens by {opening:.3} mm at 220 mm, not by 0.13, whatever the profile allows with tan ω below 0.11 on the smallest size (one \
             profile has a tan ω that falls with the diameter: the same offset of the strut on both races)."
        ),
        format!(
            "Set free on the same rows, the gap at nominal torque comes out at {} mm (95 %), and the sum of squares falls by a factor of \
             {ratio:.2} for one parameter more, F = {:.1} with 1 and {freedom:.0} degrees of freedom; with the untouched rows as above. The \
             interval is wide because few rows are held by the gap.",
            freed(gap),
            (ratio - 1.0) * freedom
        ),
        format!(
            "Set free instead, friction comes out at {:.3} or more: steeper struts than μ = 0.11 allows let the large sizes carry more within their gap. The rows do not decide between \
             the two; a maker who prints μ = 0.11 would not use it up at first contact.",
            friction.found.knowledge.estimates.last().map_or(f64::NAN, |e| e.value)
        ),
    ]);
}

fn deviations(page: &mut Page, study: &Study) {
    let figure = |case: &Case| {
        let mut plot = Plot::new("Inner track, mm", "Rules against catalogue, %");
        for (purpose, name) in [(Use::Fit, "fitted"), (Use::Check, "untouched")] {
            let each = case.sizes.iter().zip(&case.predicted).filter(|(_, p)| p.2 == purpose);
            let points = each.map(|(s, p)| [s.row.inner_mm, 100.0 * (p.0 / s.row.torque_nm - 1.0)]).collect();
            plot.curves.push(Curve { dots: true, dash: Dash::Dotted, ..Curve::new(name, points) });
        }
        plot.level(0.0, "0").sized(500.0, 320.0).to_figure()
    };
    page.figures(&[
        (figure(&study.printed), "Predicted torque over the catalogue's, less one: rules as printed."),
        (figure(&study.gap), "Gap at nominal torque set free."),
    ]);
    let mut torque = Plot::new("Inner track, mm", "Nominal torque per mm of sprag, Nm/mm");
    (torque.log_x, torque.log_y) = (true, true);
    let each = |value: &dyn Fn(usize) -> f64| -> Vec<[f64; 2]> {
        let sizes = study.gap.sizes.iter().enumerate().filter(|(_, s)| s.row.length_mm > 20.0);
        sizes.map(|(i, s)| [s.row.inner_mm, value(i) / s.row.length_mm]).collect()
    };
    let dots = |name: &str, points| Curve { dots: true, ..Curve::new(name, points) };
    torque.curves.push(dots("catalogue", each(&|i| study.gap.sizes[i].row.torque_nm)));
    torque.curves.push(dots("rules as printed", each(&|i| study.printed.predicted[i].0)));
    torque.curves.push(dots("gap set free", each(&|i| study.gap.predicted[i].0)));
    page.figure(&torque.to_figure(), "Sizes of 25 mm width.");
}

fn identified(page: &mut Page, case: &Case) {
    let k = &case.found.knowledge;
    let mut table = Table::new(vec![
        Column::text("unknown", "Unknown"),
        Column::number("min", "From", Unit::One, 4),
        Column::number("max", "To", Unit::One, 4),
        Column::number("value", "Found", Unit::One, 5),
        Column::number("half_width_95", "± (95 %)", Unit::One, 3),
    ]);
    for (u, e) in case.found.unknowns.iter().zip(&k.estimates) {
        table.row(vec![
            u.name.as_str().into(),
            u.min.into(),
            u.max.into(),
            e.value.into(),
            e.half_width.into(),
        ]);
    }
    page.table("Each in the unit of its name.", &table);
    if let Some(matrix) = &k.correlation {
        let mut columns = vec![Column::text("unknown", "Correlation")];
        columns.extend(case.found.unknowns.iter().map(|u| Column::number(&u.name, &u.name, Unit::One, 3)));
        let mut table = Table::new(columns);
        for (u, row) in case.found.unknowns.iter().zip(matrix) {
            let mut cells: Vec<Cell> = vec![u.name.as_str().into()];
            cells.extend(row.iter().map(|c| Cell::Si(*c)));
            table.row(cells);
        }
        page.table("", &table);
    }
    let name = |i: usize| case.found.unknowns[i].name.as_str();
    let mut words: Vec<String> = k
        .tied
        .iter()
        .map(|tied| match tied {
            Tied::Strongly { first, second, correlation } => format!(
                "The torques hardly tell {} and {} apart: correlation {correlation:.3}. Any pair along that line rates the series \
                 alike; the profile is one that fits, not the maker's.",
                name(*first),
                name(*second)
            ),
            Tied::Blind { direction } => format!("The torques are blind in the direction {direction:.3?} (shares of the ranges)."),
        })
        .collect();
    words.push(format!(
        "Residual of the fit {} with {} degrees of freedom; sums of squares of the starts {}.",
        k.residual_sigma.map_or("–".to_owned(), |s| Unit::Percent.show(s, 3)),
        k.freedom,
        case.found.sums.0.iter().map(|s| significant(*s, 5)).collect::<Vec<_>>().join(", ")
    ));
    let ends = [case.sizes.first(), case.sizes.last()];
    for size in ends.into_iter().flatten() {
        words.push(match size.clearance(1.3 * size.row.torque_nm) {
            Some((gap, width)) => format!(
                "{}: the narrowest sprag that works up to 1.3 times the nominal torque is {width:.2} mm wide and keeps {gap:.2} mm \
                 from its neighbour ({} sprags).",
                size.row.name, size.design.clutch.sprags.count
            ),
            None => format!("{}: no outline closes around the arcs that 1.3 times the nominal torque needs.", size.row.name),
        });
    }
    page.list(words);
}

fn sizes(page: &mut Page, case: &Case) {
    let mut table = Table::new(vec![
        Column::text("designation", "Size"),
        Column::text("use", "Use"),
        Column::number("count", "Sprags", Unit::One, 3),
        Column::number("catalogue_nm", "Catalogue", Unit::NewtonMetre, 5),
        Column::number("model_nm", "Rules", Unit::NewtonMetre, 5),
        Column::number("off_percent", "Off", Unit::Percent, 3),
        Column::text("decided_by", "Decided by"),
        Column::number("tan_rest", "tan ω at rest", Unit::One, 3),
        Column::number("tan", "at nominal", Unit::One, 3),
        Column::number("hertz_inner_mpa", "p₀ at A", Unit::Megapascal, 4),
        Column::number("hertz_outer_mpa", "at B", Unit::Megapascal, 4),
        Column::number("opening_mm", "Gap opens, mm", Unit::One, 3),
        Column::number("equivalent_mpa", "Outer race, MPa", Unit::One, 3),
        Column::number("windup_deg", "Windup", Unit::Degree, 3),
    ]);
    for (size, (torque, code, purpose)) in case.sizes.iter().zip(&case.predicted) {
        let p = &size.point;
        table.row(vec![
            size.row.name.as_str().into(),
            if *purpose == Use::Fit { "fitted" } else { "untouched" }.into(),
            size.design.clutch.sprags.count.into(),
            size.row.torque_nm.into(),
            (*torque).into(),
            (torque / size.row.torque_nm - 1.0).into(),
            code.as_str().into(),
            size.state.first_tan_omega.into(),
            p.tan_omega.into(),
            p.hertz_inner_pa.into(),
            p.hertz_outer_pa.into(),
            size.opening_mm.into(),
            size.equivalent_outer_mpa.into(),
            p.windup_rad.into(),
        ]);
    }
    page.table(
        &format!("Row by row, {}; from \"at nominal\" on at the catalogue's torque.", case.name),
        &table,
    );
}

/// Groups of limits, each with a name for people.
const GROUPS: [(&str, &[&str]); 4] = [
    ("Hertz pressure 4200 MPa", &["hertz-nominal-inner", "hertz-nominal-outer"]),
    ("race gap 8.46 mm", &["gap-nominal"]),
    ("windup 3°", &["windup-nominal"]),
    ("equivalent stress 750 MPa", &["equivalent-inner", "equivalent-outer"]),
];

/// What each rule alone would give, with the profile of the rules as printed.
fn limits(page: &mut Page, study: &Study) {
    let case = &study.printed;
    page.heading("Which limit decides: each rule as printed alone");
    let mut table = Table::new(vec![
        Column::text("rule", "Rule alone"),
        Column::number("sizes", "Sizes that reach it", Unit::One, 3),
        Column::number("exponent_d", "grows as d^", Unit::One, 3),
        Column::number("rms_scaled", "rms with its best level", Unit::Percent, 3),
    ]);
    let mut plot = Plot::new("Inner track, mm", "Torque over the catalogue's");
    plot.log_x = true;
    for (name, codes) in GROUPS {
        let reached: Vec<(f64, f64, f64, f64)> = case
            .sizes
            .iter()
            .map(|s| (s, s.capacity(codes)))
            .filter(|(s, t)| *t < 0.999 * s.state.curve.end_torque_nm())
            .map(|(s, t)| (s.row.inner_mm, s.row.length_mm, t, t / s.row.torque_nm))
            .collect();
        if reached.len() < 6 {
            table.row(vec![name.into(), reached.len().into(), Cell::Empty, Cell::Empty]);
            continue;
        }
        let law: Vec<(f64, f64, f64)> = reached.iter().map(|r| (r.0, r.1, r.2)).collect();
        let mean = (reached.iter().map(|r| r.3.ln()).sum::<f64>() / reached.len() as f64).exp();
        let off: Vec<f64> = reached.iter().map(|r| r.3 / mean - 1.0).collect();
        table.row(vec![name.into(), reached.len().into(), power_law(&law).0.into(), rms(&off).into()]);
        let points = reached.iter().filter(|r| r.1 > 20.0).map(|r| [r.0, r.3]).collect();
        plot.curves.push(Curve { dots: true, ..Curve::new(name, points) });
    }
    let [model, catalogue] = case.exponents();
    let count = case.sizes.len();
    table.row(vec![
        "the smallest of all".into(),
        count.into(),
        model.0.into(),
        rms(&case.off(|_, _| true)).into(),
    ]);
    table.row(vec!["catalogue".into(), count.into(), catalogue.0.into(), catalogue.2.into()]);
    page.figure(
        &plot.level(1.0, "catalogue").to_figure(),
        "Sizes of 25 mm width: the lowest curve rates the size.",
    );
    page.table(
        "Exponent of a power law in d and sprag width through the sizes that reach the rule. Last line: the scatter of the catalogue \
         about its own power law, which no smooth rule can better by much.",
        &table,
    );
}

/// Rows left out, and the weights.
fn left(page: &mut Page, study: &Study) {
    page.list(LEFT_OUT.iter().map(|(name, why)| format!("{name}: {why}.")));
    let used = |r: &&Row| r.left_out().is_none();
    let each: Vec<f64> = study.all.iter().filter(used).map(Row::weight_each_g).collect();
    let mean = each.iter().sum::<f64>() / each.len() as f64;
    let spread: Vec<f64> = each.iter().map(|w| w / mean - 1.0).collect();
    let outlier =
        study.all.iter().find(|r| r.name == LEFT_OUT[1].0).map_or(0.0, |r| r.weight_each_g() / mean - 1.0);
    page.paragraph(&format!(
        "Weights: with a pitch of {PITCH_MM} mm at mid-gap a sprag with its share of the cage weighs {mean:.3} g per mm of width in every \
         size within {} rms, {} at worst; FE 8103 Z 19 would be {} off.",
        Unit::Percent.show(rms(&spread), 2),
        Unit::Percent.show(worst(&spread), 2),
        Unit::Percent.show(outlier, 2)
    ));
}

fn residuals(page: &mut Page, study: &Study) {
    let group = |keep: &dyn Fn(&Row) -> bool| -> String {
        let off = study.gap.off(|r, _| keep(r));
        format!("{} ({} rows)", Unit::Percent.show(off.iter().sum::<f64>() / off.len() as f64, 2), off.len())
    };
    let between = |from: f64, to: f64, l: f64| {
        group(&move |r: &Row| r.inner_mm > from && r.inner_mm < to && r.length_mm == l)
    };
    let of =
        |names: &'static [&'static str]| group(&move |r: &Row| names.iter().any(|m| r.name.starts_with(m)));
    page.list([
        format!(
            "Below 56 mm the mean deviation by sprag width is {} at 13 mm, {} at 16 mm and {} at 22 mm; from 60 to 104 mm {}, {} and {}. \
             The small sizes lose a constant 3 mm or so of carrying length that the large ones do not: torques of 609 and 801 Nm on 13 \
             and 16 mm stand as 9.5 to 12.5, not as 13 to 16. The maker says elsewhere that the sprags of a Z spring have a notch on \
             their outer surface; the rules do not mention it, and it is not put in here.",
            between(0.0, 56.0, 13.0),
            between(0.0, 56.0, 16.0),
            between(0.0, 56.0, 22.0),
            between(56.0, 104.0, 13.0),
            between(56.0, 104.0, 16.0),
            between(56.0, 104.0, 22.0)
        ),
        format!(
            "Sizes on whole millimetres (60, 80, 100) lie at {} in the mean, those between them on old inch sizes at {}: at the same \
             rules the newer ones are rated lower, or have fewer sprags than a pitch of 8.0 mm gives.",
            of(&["FE 8060", "FE 8080", "FE 8100"]),
            of(&["FE 8072", "FE 8079", "FE 8083", "FE 8103"])
        ),
        format!("The largest size, 220 mm, lies at {}.", of(&["FE 8220"])),
    ]);
}

fn omissions(page: &mut Page) {
    page.heading("Omissions");
    page.list([
        "The maker's own algorithm is unknown: that the nominal torque is the smallest at which a published rule is reached is the \
         reading tested here. Where in the race he takes the equivalent stress is not printed; von Mises under the mean pressure \
         never decides.",
        "One inner arc. The maker's sprags have compound circles; a second arc would be two more unknowns, and the sizes work at much \
         the same rise of the profile, so that no second arc can tell large sizes from middle ones.",
        "Bending of the rings between the sprags is in the windup (law elastic) but not in gap opening and equivalent stress.",
        "Sprag counts are rounded to whole sprags at a pitch of 8.0 mm; the maker may leave out one for the cage's joint.",
        "Intervals are those of the linear theory at the solution; the smallest of several rules has kinks there.",
        "Races with keyways, bores or press fits, temperature and tolerances: the rules rate a solid shaft and a plain ring.",
    ]);
}
