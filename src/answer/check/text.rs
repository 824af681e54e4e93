//! The margin check as text, and the sentences that its page has too.

use super::{CheckAnswer, CheckBody, LETS_GO, NONE_SUFFICES, OVERLOADED, people_table};
use crate::answer::alike::ends_where_axes_part;
use crate::answer::simulation::unfelt;
use crate::design::Design;
use crate::life::INDENTING_PA;
use crate::margin::{Demand, Margin};
use crate::report::{Screen, Unit, greek, significant};

/// What a capacity in a table of margins means.
pub(crate) const REACHED_AT: &str =
    "Reached at: torque at which the limit would be reached; >: not before the curve ends";
/// What the margin of a slip row is.
const SLIP_MARGIN: &str = "Slip rows: demand is the static friction μ that the scene requires; margin the slip margin, \
    static over required friction less 1, held from the wanted one up";

/// What a row that is not required is.
const SHOWN_ONLY: &str = "Shown: for information alone, without a say in the verdict; `explain` with the limit's name \
    says which key makes it count";

/// What text and JSON say beside the table.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Notes {
    /// Of this design, a line each, warnings first.
    pub(super) of_design: Vec<String>,
    /// How the table is to be read, a line each: of any design much the same.
    pub(super) reading: Vec<String>,
}

impl Notes {
    pub(super) fn of(design: &Design, rows: &[Margin], body: &CheckBody) -> Self {
        let dent = dent(rows);
        let all = body.other_remarks().into_iter().chain(asides(design, rows)).chain(dent);
        let mut of_design: Vec<String> = all.map(|line| greek(&line)).collect();
        let lets_go: Vec<&str> =
            rows.iter().filter(|r| r.demand == Demand::LetsGo).filter_map(|r| r.scene.as_deref()).collect();
        if !lets_go.is_empty() {
            of_design.push(format!(
                "{LETS_GO}: in {} the torque does not keep the clutch engaged, and it overruns, whatever the friction",
                lets_go.join(", ")
            ));
        }
        if rows.iter().any(|r| r.demand == Demand::NoneSuffices) {
            of_design.push(format!("{NONE_SUFFICES}: contact would open, whatever the friction"));
        }
        if rows.iter().any(|r| r.overloaded() && r.demand.value().is_none()) {
            of_design.push(format!(
                "{OVERLOADED}: the scene's load goes beyond the end of the curve, where the sprag rolls over or leaves its profile"
            ));
        }
        // Those alike keep their order.
        of_design.sort_by_key(|line| match line.split([':', ' ']).next() {
            Some("Warning") => 0,
            Some("Note") => 2,
            _ => 1,
        });
        let reading = [
            Some(REACHED_AT).filter(|_| rows.iter().any(|r| r.torque_capacity_nm.is_some())),
            Some(SLIP_MARGIN).filter(|_| rows.iter().any(Margin::is_slip)),
            Some(SHOWN_ONLY).filter(|_| rows.iter().any(|r| !r.required)),
        ];
        let reading = reading.into_iter().flatten().map(str::to_owned);
        let reading = reading.chain(two_allowables(rows)).chain(no_row_of_overrun(design)).collect();
        Self { of_design, reading }
    }

    /// All of them.
    pub(super) fn all(&self) -> Vec<String> {
        self.of_design.iter().chain(&self.reading).cloned().collect()
    }
}

/// The answer on a terminal: the table, the verdict, what this design is to be told; `reading`: how the table is to be read, too.
pub(super) fn text(check: &CheckAnswer, screen: Screen, reading: bool) -> String {
    let (design, body) = (&check.design, &check.body);
    let table = people_table(&check.rows, check.state.curve.end_torque_nm()).to_text(screen);
    let notes = &check.notes;
    let left = match notes.reading.len() {
        0 => None,
        1 => Some("How to read the table, a note: --notes or --json".to_owned()),
        many => Some(format!("How to read the table, {many} notes: --notes or --json")),
    };
    let lines = [body.verdict(), size_line(design)]
        .into_iter()
        .chain(body.capacity_lines())
        .chain(notes.of_design.clone());
    let lines: Vec<String> = match reading {
        true => lines.chain(notes.reading.clone()).collect(),
        false => lines.chain(left).collect(),
    };
    format!("{}  {}\n\n{table}\n{}\n", design.name, design.short_hash(), lines.join("\n"))
}

/// What pages say beside the rows.
pub(super) fn beside_the_rows(design: &Design, rows: &[Margin]) -> Vec<String> {
    let more = two_allowables(rows).into_iter().chain(dent(rows)).chain(no_row_of_overrun(design));
    more.chain(asides(design, rows)).collect()
}

/// Why one contact has two allowed pressures, where it has.
fn two_allowables(rows: &[Margin]) -> Option<String> {
    let of = |key: &str| rows.iter().find(|r| r.limit.key == Some(key)).and_then(Margin::shown_allowable);
    let (nominal, peak) = of("hertz_nominal_mpa").zip(of("hertz_peak_mpa"))?;
    let [nominal, peak] = [nominal, peak].map(|mpa| significant(mpa, 4));
    (nominal != peak).then(|| {
        format!(
            "Hertz pressure, two allowables: {nominal} MPa (hertz_nominal_mpa) up to nominal torque, which comes again \
             and again; {peak} MPa (hertz_peak_mpa) up to peak torque and in scenes, which come seldom"
        )
    })
}

/// The largest pressure that is held and leaves a dent.
fn dent(rows: &[Margin]) -> Option<String> {
    let held = rows
        .iter()
        .filter(|r| r.required && r.held() && r.limit.key.is_some_and(|key| key.starts_with("hertz_")));
    let largest = held.filter_map(|r| Some((r, r.demand.value()?))).max_by(|a, b| a.1.total_cmp(&b.1));
    largest.filter(|(_, pa)| *pa > INDENTING_PA).map(|(row, pa)| {
        format!(
            "{} of {} is held, and leaves a permanent dent of more than 1e-4 of the diameter (from {} on: ISO 76, line contacts, 58 HRC or \
             more), which the command life counts as indentation",
            row.code(),
            Unit::Megapascal.show(pa, 4),
            Unit::Megapascal.show(INDENTING_PA, 4)
        )
    })
}

/// Outside, width and mass in one line.
pub(in crate::answer) fn size_line(design: &Design) -> String {
    let races = &design.clutch.races;
    format!(
        "⌀ {} outside, {} wide, {}",
        Unit::Millimetre.show_plain(2.0 * races.outer_outside_radius_m, 4),
        Unit::Millimetre.show_plain(races.width_m, 4),
        Unit::Gram.show_plain(design.clutch.mass_kg(), 4)
    )
}

/// Largest static friction of lubricated steel on steel that catalogues reckon a clutch with, and a third more: a choice.
const MOST_FRICTION: f64 = 0.2;

/// A warning where a clutch is reckoned with more friction than its oil leaves.
pub(in crate::answer) fn much_friction(design: &Design) -> Option<String> {
    let mu = design.clutch.friction.static_;
    (mu > MOST_FRICTION).then(|| {
        format!(
            "Warning: a friction of {mu} is that of dry steel at best; lubricated sprags are reckoned with 0.05 to 0.15, and a clutch made \
             for more slips"
        )
    })
}

/// Why a film that is asked for has no row.
fn no_film_row(design: &Design, rows: &[Margin]) -> Option<String> {
    let limits = &design.limits;
    let (_, speed) = (limits.film_lambda?, limits.film_at_rad_s?);
    let lubricated = design.clutch.lubrication.is_some();
    (lubricated && !rows.iter().any(|r| r.limit.key == Some("film_lambda"))).then(|| {
        format!(
            "No row for film_lambda: at {} of the inner race the sprags are off the race that they slide on, and need no film",
            Unit::Rpm.show(speed, 4)
        )
    })
}

/// Where the rows at a torque hold where the design names its own speed, and which fail there.
fn turning(design: &Design, rows: &[Margin]) -> Option<String> {
    let speed = Unit::Rpm.show(design.limits.at_speed_rad_s?, 4);
    let fails = |row: &&Margin| row.required && row.turns() && !row.held();
    let codes: Vec<String> = rows.iter().filter(fails).map(Margin::code).collect();
    let ends = rows.iter().filter(fails).find(|row| row.overloaded()).and_then(|row| row.end_torque_nm);
    let ends = ends
        .map_or(String::new(), |nm| format!(", where the curve ends at {}", Unit::NewtonMetre.show(nm, 4)));
    // Round the circumference, and sprags one by one.
    let still = |row: &Margin| row.off_centre || row.limit.code.starts_with("sprag-");
    let rest = if rows.iter().any(still) { "; run-out-… and sprag-… at rest alone" } else { "" };
    Some(match codes.as_slice() {
        [] => format!(
            "Rows at nominal and peak torque: at rest or at {speed} (at_speed_rpm), whichever is worse{rest}"
        ),
        codes => format!("Warning: at {speed} (at_speed_rpm){ends}, not held: {}{rest}", codes.join(", ")),
    })
}

/// Why steady overruns have no rows of their scenes.
fn no_row_of_overrun(design: &Design) -> Option<String> {
    let steady = design.scenarios.iter().filter(|s| s.kind.is_overrun());
    let names: Vec<&str> = steady.map(|s| s.name.as_str()).collect();
    (!names.is_empty()).then(|| {
        format!(
            "No slip or contact row for {}: in steady overrun the {} contact slides and nothing is to stick; limits \
             keep_contact_to_rpm and lift_off_by_rpm hold it",
            names.join(", "),
            if design.clutch.slides_outside() { "outer" } else { "inner" }
        )
    })
}

/// Races whose stress with bending may be more than its mean may be: limits of two steels.
fn laxer_with_bending(design: &Design) -> impl Iterator<Item = String> {
    let l = &design.limits;
    let inner = ("inner", l.hoop_inner_pa, l.hoop_inner_bending_pa);
    let outer = ("outer", l.hoop_outer_pa, l.hoop_outer_bending_pa);
    [inner, outer].into_iter().filter_map(|(race, mean, bending)| {
        let (mean, bending) = mean.zip(bending).filter(|(mean, bending)| bending > mean)?;
        let [mean, bending] = [mean, bending].map(|pa| Unit::Megapascal.show(pa, 4));
        Some(format!(
            "Note: hoop_{race}_bending_mpa allows {bending}, hoop_{race}_mpa, without the bending, {mean}: is one of them another steel's?"
        ))
    })
}

/// That what the design gives as tolerances is in none of the rows.
fn tolerances_apart(design: &Design) -> Option<String> {
    let given = design.tolerances.is_some();
    given.then(|| {
        "Note: these figures are of the sizes as drawn; [tolerances] enter by `--robust` of `optimize` and `evaluate`".to_owned()
    })
}

/// What the rows do not say: a friction beyond any known, a film that needs no row, axes that part, tolerances, steps and histories that
/// come after the end of their scene.
fn asides(design: &Design, rows: &[Margin]) -> Vec<String> {
    let held = design.scenarios.iter().filter(|s| rows.iter().any(|r| r.scene.as_ref() == Some(&s.name)));
    let unfelt =
        held.flat_map(|s| unfelt::notes(s).into_iter().map(|note| format!("Note on {}: {note}", s.name)));
    much_friction(design)
        .into_iter()
        .chain(turning(design, rows))
        .chain(no_film_row(design, rows))
        .chain(ends_where_axes_part(design))
        .chain(tolerances_apart(design))
        .chain(laxer_with_bending(design))
        .chain(unfelt)
        .collect()
}
