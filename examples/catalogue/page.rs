//! The page.

use sprag_design::identify::{Tied, Use};
use sprag_design::report::plot::Dash;
use sprag_design::report::{Cell, Column, Curve, Page, PageHead, Plot, Table, Unit, significant};

use crate::rows::{LEFT_OUT, PITCH_MM};
use crate::size::power_law;
use crate::{Study, WANTED, rms, worst};

/// What was asked, with what came out.
pub fn verdicts(study: &Study) -> Vec<(bool, String)> {
    let off = study.off(|p| p == Use::Check);
    let [model, catalogue] = study.exponents();
    let (tan, windup) = study.extremes();
    let mu = study.series.clutch.friction.static_;
    let fitted = study.off(|p| p == Use::Fit).len();
    let percent = |x: f64| Unit::Percent.show(x, 3);
    vec![
        (
            3 * fitted <= off.len() + fitted,
            format!("one profile, fitted on {fitted} of {} rows", off.len() + fitted),
        ),
        (
            rms(&off) <= WANTED.rms && worst(&off) <= WANTED.worst,
            format!(
                "{} untouched rows: rms {} (wanted {}), worst {} (wanted {})",
                off.len(),
                percent(rms(&off)),
                percent(WANTED.rms),
                percent(worst(&off)),
                percent(WANTED.worst)
            ),
        ),
        (
            (model.0 - catalogue.0).abs() <= WANTED.exponent,
            format!(
                "torque grows as d^{:.3}, the catalogue's as d^{:.3} (wanted within {})",
                model.0, catalogue.0, WANTED.exponent
            ),
        ),
        (tan < mu, format!("largest tan ω of any size, first contact to nominal torque: {tan:.4}, below μ = {mu}")),
        (
            windup < WANTED.windup_deg,
            format!("largest windup at nominal torque: {windup:.2}° (wanted below {}°)", WANTED.windup_deg),
        ),
    ]
}

pub fn page(study: &Study) -> Page {
    let mut page = Page::new(PageHead {
        title: "A catalogue from its rules".into(),
        tool: env!("CARGO_PKG_NAME").into(),
        version: env!("CARGO_PKG_VERSION").into(),
        command: "cargo run --release --example catalogue".into(),
        design: format!("{}; GMN 9050, series FE 8000", study.series.name),
        design_hash: study.series.hash.clone(),
    });
    let verdicts = verdicts(study);
    for (held, text) in &verdicts {
        page.verdict(*held, text);
    }
    page.paragraph(
        "The maker prints diameters, widths and nominal torques of 38 sizes and the rules by which he rates them: Hertz pressure \
         4200 MPa, race gap 8.46 mm (8.33 at rest), equivalent stress 750 MPa (100Cr6), each at nominal torque, on a solid shaft, \
         with an outer race of D/D_L = 1.4, races as wide as the element plus 3 mm, friction 0.11, windup below 3°. He prints \
         neither the sprag's profile nor the number of sprags. Here one profile is found from every third row; the torque \
         of every row is then the smallest at which one of his rules is reached. Law: elastic, with nothing fitted in it.",
    );
    identified(&mut page, study);
    sizes(&mut page, study);
    limits(&mut page, study);
    left(&mut page, study);
    omissions(&mut page);
    page.source("Series before the profile is known", &study.series.source);
    page.source("Series with the profile found", &study.found.source);
    page
}

fn identified(page: &mut Page, study: &Study) {
    let k = &study.found.knowledge;
    page.heading("The profile that the fitted rows identify");
    let mut table = Table::new(vec![
        Column::text("unknown", "Unknown"),
        Column::number("min", "From", Unit::One, 4),
        Column::number("max", "To", Unit::One, 4),
        Column::number("value", "Found", Unit::One, 5),
        Column::number("half_width_95", "± (95 %)", Unit::One, 3),
    ]);
    for (u, e) in study.found.unknowns.iter().zip(&k.estimates) {
        table.row(vec![u.name.as_str().into(), u.min.into(), u.max.into(), e.value.into(), e.half_width.into()]);
    }
    page.table("Millimetres.", &table);
    let name = |i: usize| study.found.unknowns[i].name.as_str();
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
        "Residual of the fit {} with {} degrees of freedom; sums of squares of the four starts {}.",
        k.residual_sigma.map_or("–".to_owned(), |s| Unit::Percent.show(s, 3)),
        k.freedom,
        study.found.sums.0.iter().map(|s| significant(*s, 5)).collect::<Vec<_>>().join(", ")
    ));
    let ends = [study.sizes.first(), study.sizes.last()];
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

fn sizes(page: &mut Page, study: &Study) {
    page.heading("Row by row");
    let mut table = Table::new(vec![
        Column::text("designation", "Size"),
        Column::text("use", "Use"),
        Column::number("count", "Sprags", Unit::One, 3),
        Column::number("catalogue_nm", "Catalogue", Unit::NewtonMetre, 5),
        Column::number("model_nm", "Rules", Unit::NewtonMetre, 5),
        Column::number("off_percent", "Off", Unit::Percent, 3),
        Column::text("decided_by", "Decided by"),
        Column::number("tan_rest", "tan ω at rest", Unit::One, 3),
        Column::number("tan", "nominal", Unit::One, 3),
        Column::number("hertz_inner_mpa", "p₀ at A", Unit::Megapascal, 4),
        Column::number("hertz_outer_mpa", "at B", Unit::Megapascal, 4),
        Column::number("opening_mm", "Gap opens, mm", Unit::One, 3),
        Column::number("equivalent_mpa", "Outer race, MPa", Unit::One, 3),
        Column::number("windup_deg", "Windup", Unit::Degree, 3),
    ]);
    for (size, (torque, code, purpose)) in study.sizes.iter().zip(&study.predicted) {
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
    let mut off = Plot::new("Inner track, mm", "Rules against catalogue, %");
    for (purpose, name) in [(Use::Fit, "fitted"), (Use::Check, "untouched")] {
        let each = study.sizes.iter().zip(&study.predicted).filter(|(_, p)| p.2 == purpose);
        let points = each.map(|(s, p)| [s.row.inner_mm, 100.0 * (p.0 / s.row.torque_nm - 1.0)]).collect();
        off.curves.push(Curve { dots: true, dash: Dash::Dotted, ..Curve::new(name, points) });
    }
    page.figure(&off.level(0.0, "0").to_svg(), "Predicted nominal torque over the catalogue's, less one.");
    page.table("State of each size at the catalogue's torque; the last row of a rule is the torque at which it is reached.", &table);
}

/// Groups of limits, each with a name for people.
const GROUPS: [(&str, &[&str]); 4] = [
    ("Hertz pressure 4200 MPa", &["hertz-nominal-inner", "hertz-nominal-outer"]),
    ("race gap 8.46 mm", &["gap-nominal"]),
    ("windup 3°", &["windup-nominal"]),
    ("equivalent stress 750 MPa", &["equivalent-inner", "equivalent-outer"]),
];

/// What each rule alone would give.
fn limits(page: &mut Page, study: &Study) {
    page.heading("Which limit decides: torque for each alone");
    let mut table = Table::new(vec![
        Column::text("rule", "Rule alone"),
        Column::number("exponent_d", "grows as d^", Unit::One, 3),
        Column::number("rms_scaled", "rms with its best level", Unit::Percent, 3),
    ]);
    let mut plot = Plot::new("Inner track, mm", "Torque over the catalogue's");
    plot.log_x = true;
    for (name, codes) in GROUPS {
        let torque: Vec<f64> = study.sizes.iter().map(|s| s.capacity(codes)).collect();
        let reached: Vec<(f64, f64, f64, f64)> = study
            .sizes
            .iter()
            .zip(&torque)
            .filter(|(s, t)| **t < 0.999 * s.state.curve.end_torque_nm())
            .map(|(s, t)| (s.row.inner_mm, s.row.length_mm, *t, t / s.row.torque_nm))
            .collect();
        if reached.len() < 6 {
            table.row(vec![name.into(), Cell::Text("not reached".into()), Cell::Empty]);
            continue;
        }
        let law: Vec<(f64, f64, f64)> = reached.iter().map(|r| (r.0, r.1, r.2)).collect();
        let mean = (reached.iter().map(|r| r.3.ln()).sum::<f64>() / reached.len() as f64).exp();
        let off: Vec<f64> = reached.iter().map(|r| r.3 / mean - 1.0).collect();
        table.row(vec![name.into(), power_law(&law).0.into(), rms(&off).into()]);
        let points = reached.iter().filter(|r| r.1 > 20.0).map(|r| [r.0, r.3]).collect();
        plot.curves.push(Curve { dots: true, ..Curve::new(name, points) });
    }
    let [model, catalogue] = study.exponents();
    table.row(vec!["all rules, the smallest".into(), model.0.into(), rms(&study.off(|_| true)).into()]);
    table.row(vec!["catalogue".into(), catalogue.0.into(), catalogue.2.into()]);
    page.figure(&plot.level(1.0, "catalogue").to_svg(), "Sizes of 25 mm width: the lowest curve rates the size.");
    page.table(
        "Exponent of a power law in d and sprag width through the sizes in which the rule is reached. In the last line the scatter of \
         the catalogue about its own power law: no smooth rule comes nearer.",
        &table,
    );
}

/// Rows left out, weights, what the residuals say.
fn left(page: &mut Page, study: &Study) {
    page.heading("Rows left out");
    page.list(LEFT_OUT.iter().map(|(name, why)| format!("{name}: {why}.")));
    let used = |r: &&crate::rows::Row| r.left_out().is_none();
    let each: Vec<f64> = study.all.iter().filter(used).map(crate::rows::Row::weight_each_g).collect();
    let mean = each.iter().sum::<f64>() / each.len() as f64;
    let spread: Vec<f64> = each.iter().map(|w| w / mean - 1.0).collect();
    let outlier = study.all.iter().find(|r| r.name == LEFT_OUT[1].0).map_or(0.0, |r| r.weight_each_g() / mean - 1.0);
    page.paragraph(&format!(
        "Weights: with a pitch of {PITCH_MM} mm at mid-gap a sprag with its share of the cage weighs {mean:.3} g per mm of width in every \
         size within {} rms, {} at worst; FE 8103 Z 19 would be {} off.",
        Unit::Percent.show(rms(&spread), 2),
        Unit::Percent.show(worst(&spread), 2),
        Unit::Percent.show(outlier, 2)
    ));
    page.heading("What the residuals say");
    let group = |keep: &dyn Fn(&crate::rows::Row) -> bool| -> String {
        let each = study.sizes.iter().zip(&study.predicted).filter(|(s, _)| keep(&s.row));
        let off: Vec<f64> = each.map(|(s, p)| p.0 / s.row.torque_nm - 1.0).collect();
        format!("{} ({} rows)", Unit::Percent.show(off.iter().sum::<f64>() / off.len() as f64, 2), off.len())
    };
    let small = |l: f64| group(&move |r: &crate::rows::Row| r.inner_mm < 56.0 && r.length_mm == l);
    let middle = |l: f64| group(&move |r: &crate::rows::Row| r.inner_mm > 56.0 && r.inner_mm < 104.0 && r.length_mm == l);
    let metric = group(&|r| ["FE 8060", "FE 8080", "FE 8100"].iter().any(|m| r.name.starts_with(m)));
    let inch = group(&|r| ["FE 8072", "FE 8079", "FE 8083", "FE 8103"].iter().any(|m| r.name.starts_with(m)));
    page.list([
        format!(
            "Below 56 mm the mean deviation by sprag width is {} at 13 mm, {} at 16 mm and {} at 22 mm; from 60 to 104 mm {}, {} and {}. The small sizes \
             lose a constant 3 mm or so of carrying length that the large ones do not: torques of 609 and 801 Nm on 13 and 16 mm \
             stand as 9.5 to 12.5, not as 13 to 16. The maker says that the sprags of a Z spring have a notch on their outer surface; the rules \
             do not mention it, and it is not put in here.",
            small(13.0), small(16.0), small(22.0), middle(13.0), middle(16.0), middle(22.0)
        ),
        format!(
            "Sizes on whole millimetres between 60 and 100 (60, 80, 100) lie at {metric} in the mean, those between them on old inch \
             sizes at {inch}: at the same rules the newer ones are rated lower, or have fewer sprags than a pitch of 8.0 mm gives."
        ),
        format!(
            "The largest size, 220 mm, lies at {}: the rule on the gap alone grows with the first power of the diameter, and the \
             catalogue's torques go on growing as d^1.4 beyond it. A real outer race that is stiffer than D/D_L = 1.4 and W + 3 mm would do that.",
            group(&|r| r.inner_mm > 200.0)
        ),
    ]);
}

fn omissions(page: &mut Page) {
    page.heading("Omissions");
    page.list([
        "The maker's own algorithm is unknown: that the nominal torque is the smallest at which a published rule is reached is the \
         reading tested here. Where in the race he takes the equivalent stress is not printed; von Mises under the mean pressure \
         never decides.",
        "One inner arc. The maker's sprags have compound circles; a second arc would be two more unknowns that these rows do not see.",
        "Bending of the rings between the sprags is in the windup (law elastic) but not in gap opening and equivalent stress.",
        "Sprag counts are rounded to whole sprags at a pitch of 8.0 mm; the maker may leave out one for the cage's joint.",
        "Races with keyways, bores or press fits, temperature and tolerances: the rules rate a solid shaft and a plain ring.",
    ]);
}
