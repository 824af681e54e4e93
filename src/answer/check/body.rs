//! The margins as table and as JSON.

use super::overrun::OverrunSection;
use super::{at_speed, run_out, running};
use crate::answer::stiffness::CurveEnd;
use crate::margin::{Demand, Left, Margin, Rule, When, lowest_capacity};
use crate::report::{Cell, Rows, Table, Unit, greek, significant};
use crate::wedge::EndReason;
use serde::Serialize;

/// A demand that no friction meets, in words.
pub const NONE_SUFFICES: &str = "none suffices";
/// What stands for it where the scene's torque is to let the clutch go.
pub const LETS_GO: &str = "lets go";

/// What stands for a friction that there is none of.
pub fn no_friction(is_to_let_go: bool) -> &'static str {
    if is_to_let_go { LETS_GO } else { NONE_SUFFICES }
}

/// What stands for its margin.
const NONE: &str = "none";
/// A scene whose load goes beyond the end of the curve.
pub const OVERLOADED: &str = "overloaded";
/// What stands for the demand of a row whose torque lies beyond the end of the curve.
const NOT_REACHED: &str = "not reached";
/// What stands for the demand of a run that met its limit of work.
pub(super) const NOT_COMPUTED: &str = "not computed";
/// What stands for the demand of a force that works the other way.
const PRESSED_ON: &str = "pressed on";
/// What stands for the margin where nothing is demanded.
const NO_DEMAND: &str = "no demand";

/// One margin of the JSON.
#[derive(Debug, Clone, Serialize)]
pub struct CheckRow {
    /// Code for scripts, such as `hoop-inner`, `slip:high-6`.
    pub code: String,
    /// Name for people.
    pub name: String,
    /// Demand, in `unit`; `None` where no friction suffices, the scene is overloaded or the curve ends below the row's
    /// torque.
    pub demand: Option<f64>,
    /// Allowable, in `unit`; of slip the wanted slip margin.
    pub allowable: Option<f64>,
    /// Unit of demand and allowable; `1` of a pure number.
    pub unit: &'static str,
    /// Margin as a number; 0 or more is held. Of slip rows it is against the wanted slip margin: people read `slip_margin`.
    pub margin: f64,
    /// Torque at which the limit would be reached, N m, where it depends on torque.
    pub torque_capacity_nm: Option<f64>,
    /// Whether the limit is not reached before the curve ends: the capacity is then at least that much.
    pub capacity_beyond_end: bool,
    /// Whether it counts for the verdict; the others are shown only.
    pub required: bool,
    /// False where a run met its limit of work or the clutch does not engage: neither held nor broken.
    pub computed: bool,
    /// Why it was not computed.
    #[serde(skip)]
    pub not_computed: Option<&'static str>,
    /// Whether the row's scene or torque goes beyond the end of the curve.
    pub overloaded: bool,
    /// Whether the limit is held.
    pub held: bool,
    /// Of slip rows static over required friction, less 1; null elsewhere.
    pub slip_margin: Option<f64>,
}

/// The required limit with the least margin.
#[derive(Debug, Clone, Serialize)]
pub struct Deciding {
    /// Code of that limit.
    pub code: String,
    /// Name of that limit.
    pub name: String,
    /// Its margin as a number.
    pub margin: f64,
    /// The margin in words.
    #[serde(skip)]
    words: String,
}

/// The lowest torque at which a limit would be reached.
#[derive(Debug, Clone, Serialize)]
pub struct Capacity {
    /// Code of the limit that sets it.
    pub code: String,
    /// Name of that limit.
    pub name: String,
    /// That torque, N m.
    pub torque_capacity_nm: f64,
}

impl Capacity {
    /// The lowest of the required rows that `counts`, of a curve that ends at `end_torque_nm`, N m.
    fn lowest(rows: &[Margin], end_torque_nm: f64, counts: impl Fn(&Margin) -> bool) -> Option<Self> {
        // A limit that the curve never reaches sets nothing; the end of the curve does.
        let counts = |r: &Margin| counts(r) && !ends_first(r, end_torque_nm);
        lowest_capacity(rows, counts).map(|(r, torque_capacity_nm)| Self {
            code: r.code(),
            name: r.name.clone(),
            torque_capacity_nm,
        })
    }

    /// Those of the limits that are held at nominal torque and at peak torque; what is reached first at peak torque before the curve ends
    /// counts for both, since a peak is no smaller than what it is the peak of.
    pub fn nominal_and_peak(rows: &[Margin], end_torque_nm: f64) -> [Option<Self>; 2] {
        let nominal = |r: &Margin| r.limit.when == When::Nominal;
        let own = Self::lowest(rows, end_torque_nm, nominal);
        let peak = Self::lowest(rows, end_torque_nm, |r| !nominal(r));
        let most_nm = own.as_ref().map_or(end_torque_nm, |c| c.torque_capacity_nm);
        let sooner = peak.clone().filter(|c| Self::asked_at_nominal(rows) && c.torque_capacity_nm < most_nm);
        [sooner.or(own), peak]
    }

    /// Whether any required row is held at nominal torque.
    pub fn asked_at_nominal(rows: &[Margin]) -> bool {
        rows.iter().any(|r| r.required && r.limit.when == When::Nominal)
    }
}

/// A remark where the clutch carries so much more than it is asked to that the torques may be in another unit.
pub fn far_more_than_asked(asked_nm: f64, carries_nm: f64) -> Option<String> {
    /// A choice: no reserve, but kNm taken for Nm.
    const FAR: f64 = 100.0;
    (asked_nm > 0.0 && carries_nm > FAR * asked_nm).then(|| {
        format!(
            "The clutch carries {} times the largest torque that the limits name: torques are in Nm",
            significant(carries_nm / asked_nm, 2)
        )
    })
}

/// What the margins were read from.
#[derive(Debug, Clone)]
pub(super) struct Source {
    /// Why the static curve ends.
    pub(super) end: EndReason,
    /// Torque at its end, N m.
    pub(super) end_torque_nm: f64,
    /// Largest torque at which a limit is held, N m; 0 without one.
    pub(super) asked_nm: f64,
    /// Overrun speed at which the sprags lift off, rad/s, if they do up to `searched_to_rad_s`.
    pub(super) lift_off_rad_s: Option<f64>,
    /// How far a lift-off was looked for, rad/s.
    pub(super) searched_to_rad_s: f64,
    /// What the file says that is to be asked about: what the names of its materials do not decide, limits that bear on nothing.
    pub(super) of_file: Vec<String>,
    /// Overrun against speed.
    pub(super) overrun: OverrunSection,
    /// What the rows without a scene leave out.
    pub(super) at_speed: Option<at_speed::AtSpeedSection>,
    /// Radii as made and as run, where they differ.
    pub(super) running: Option<running::RunningSection>,
    /// Load round the circumference, where the axes lie apart.
    pub(super) run_out: Option<run_out::RunOutSection>,
}

/// Keys of `check`.
#[derive(Debug, Clone, Serialize)]
pub struct CheckBody {
    /// One row for each limit.
    pub margins: Vec<CheckRow>,
    /// Whether every required limit is held.
    pub pass: bool,
    /// The required limit with the least margin.
    pub deciding: Option<Deciding>,
    /// The lowest torque at which a required limit would be reached.
    pub lowest_torque_capacity: Option<Capacity>,
    /// The lowest among the limits that are held at nominal torque.
    pub nominal_torque_capacity: Option<Capacity>,
    /// The lowest among the limits that are held at peak torque.
    pub peak_torque_capacity: Option<Capacity>,
    /// Where the static curve ends, which may be below the torques of the limits.
    pub end: CurveEnd,
    #[serde(skip)]
    asked_nm: f64,
    #[serde(skip)]
    asked_at_nominal: bool,
    #[serde(skip)]
    of_file: Vec<String>,
    /// Speed of the outer race at which the sprags lift off the inner one, rev/min, in a driven cage of the inner race at which they lift off
    /// the outer one; null: contact is kept up to `lift_off_searched_to_rpm`.
    pub lift_off_rpm: Option<f64>,
    /// How far a lift-off was looked for, rev/min.
    pub lift_off_searched_to_rpm: f64,
    /// Overrun against speed.
    pub overrun: OverrunSection,
    /// What the rows without a scene leave out, which are at rest; null: no scene carries torque while the races turn.
    pub at_speed: Option<at_speed::AtSpeedSection>,
    /// Radii as made and as run; null: the races run as made.
    pub running: Option<running::RunningSection>,
    /// Load round the circumference; null: the design names no eccentricity.
    pub run_out: Option<run_out::RunOutSection>,
    /// What is said of this design beside the rows, warnings first, then how the rows are to be read; a line each.
    pub notes: Vec<String>,
}

impl CheckBody {
    pub(super) fn new(rows: &[Margin], source: Source) -> Self {
        let rpm = |rad_s| Unit::Rpm.from_si(rad_s);
        let required = || rows.iter().filter(|r| r.required);
        let [nominal, peak] = Capacity::nominal_and_peak(rows, source.end_torque_nm);
        Self {
            margins: rows.iter().map(|r| CheckRow::of(r, source.end_torque_nm)).collect(),
            pass: required().all(Margin::held),
            deciding: required().min_by(nearest_first).map(|r| Deciding {
                code: r.code(),
                name: r.full_name(),
                margin: r.margin(),
                words: margin_words(r),
            }),
            lowest_torque_capacity: Capacity::lowest(rows, source.end_torque_nm, |_| true),
            nominal_torque_capacity: nominal,
            peak_torque_capacity: peak,
            end: CurveEnd { reason: source.end.name(), torque_nm: source.end_torque_nm, beyond: None },
            asked_nm: source.asked_nm,
            asked_at_nominal: Capacity::asked_at_nominal(rows),
            of_file: source.of_file,
            lift_off_rpm: source.lift_off_rad_s.map(rpm),
            lift_off_searched_to_rpm: rpm(source.searched_to_rad_s),
            overrun: source.overrun,
            at_speed: source.at_speed,
            running: source.running,
            run_out: source.run_out,
            notes: Vec::new(),
        }
    }

    /// Code and torque, N m, of the limits that set the nominal and the peak capacity.
    pub fn capacities(&self) -> Vec<(String, f64)> {
        let both = [&self.nominal_torque_capacity, &self.peak_torque_capacity].into_iter().flatten();
        both.map(|c| (c.code.clone(), c.torque_capacity_nm)).collect()
    }

    /// Whether every required limit is held; `None` where that is not known, because a run met its limit of work.
    pub fn held(&self) -> Option<bool> {
        let unknown = self.margins.iter().any(|r| r.required && !r.computed);
        (self.pass || !unknown).then_some(self.pass)
    }

    /// Codes of the rows that are shown only and would not hold.
    pub fn shown_broken(&self) -> Vec<&str> {
        let broken = self.margins.iter().filter(|r| !r.required && r.computed && !r.held);
        broken.map(|r| r.code.as_str()).collect()
    }

    /// The same in words, behind a banner that says that all is held.
    fn but_shown(&self) -> String {
        /// Codes that a line has room for.
        const NAMED: usize = 4;
        let codes = self.shown_broken();
        let named = codes.iter().take(NAMED).copied().collect::<Vec<_>>().join(", ");
        match codes.len() {
            0 => String::new(),
            n if n > NAMED => {
                format!("; beside them, for information only, would not hold: {named} and {} more", n - NAMED)
            }
            _ => format!("; beside them, for information only, would not hold: {named}"),
        }
    }

    /// The answer in one line.
    pub fn verdict(&self) -> String {
        let required: Vec<&CheckRow> = self.margins.iter().filter(|r| r.required).collect();
        let broken = required.iter().filter(|r| !r.held).count();
        let unknown = required.iter().filter(|r| !r.computed).count();
        let why = required.iter().find_map(|r| Some((r.code.as_str(), r.not_computed?)));
        match &self.deciding {
            None => format!("HELD: the design names no limit that could be broken{}", self.but_shown()),
            Some(d) if self.pass => format!(
                "HELD: all {} required limits; {} decides, {}{}",
                required.len(),
                d.code,
                d.words,
                self.but_shown()
            ),
            Some(_) if unknown > 0 => format!(
                "NOT COMPUTED: {unknown} of {} required rows{}; {} others not held",
                required.len(),
                why.map_or(String::new(), |(code, why)| format!(", {code}: {why} (`simulate` tells more)")),
                broken - unknown
            ),
            // Where the curve ends first, every limit of that torque is as far away as the torque.
            Some(d)
                if self.end.torque_nm < self.asked_nm
                    && d.margin <= self.end.torque_nm / self.asked_nm - 1.0 =>
            {
                let nm = |torque_nm| Unit::NewtonMetre.show(torque_nm, 4);
                let carried = self.peak_torque_capacity.as_ref().map_or(String::new(), |c| {
                    format!(", {} carried ({})", nm(c.torque_capacity_nm), c.code)
                });
                format!(
                    "NOT HELD: {} asked{carried}; the curve ends at {} ({}); {broken} of {} required limits are not held",
                    Unit::NewtonMetre.show_plain(self.asked_nm, 4),
                    nm(self.end.torque_nm),
                    self.end.reason,
                    required.len()
                )
            }
            Some(d) => format!(
                "NOT HELD: {broken} of {} required limits; {} decides, {}",
                required.len(),
                d.code,
                d.words
            ),
        }
    }

    /// What the tables do not say, a line each.
    pub fn remarks(&self) -> Vec<String> {
        self.capacity_lines().into_iter().chain(self.other_remarks()).collect()
    }

    /// Torque capacities, a line each.
    pub fn capacity_lines(&self) -> Vec<String> {
        let capacities = [("nominal", &self.nominal_torque_capacity), ("peak", &self.peak_torque_capacity)];
        let line = |(kind, capacity): (&str, &Option<Capacity>)| {
            let Some(c) = capacity else {
                let end = Unit::NewtonMetre.show(self.end.torque_nm, 4);
                let unreached = || {
                    format!(
                        "Torque capacity, {kind}: none of its limits is reached before the curve ends, at {end}"
                    )
                };
                return (kind == "nominal" && self.asked_at_nominal).then(unreached);
            };
            let torque = Unit::NewtonMetre.show(c.torque_capacity_nm, 4);
            Some(greek(&format!("Torque capacity, {kind}: {torque}, set by {} ({})", c.code, c.name)))
        };
        capacities.into_iter().filter_map(line).collect()
    }

    /// An early end of the curve, lift-off, radii as run, races off centre, what the file is to be asked about, a line each.
    pub fn other_remarks(&self) -> Vec<String> {
        let early = (self.end.torque_nm < self.asked_nm).then(|| {
            format!(
                "The curve ends ({}) at {}, below the {} asked: limits beyond are not reached, which counts as not held, \
                 whatever they would allow; a number there is a margin that is broken before (in JSON and CSV at most \
                 what the torque lacks, end/torque − 1)",
                self.end.reason,
                Unit::NewtonMetre.show(self.end.torque_nm, 4),
                Unit::NewtonMetre.show_plain(self.asked_nm, 4)
            )
        });
        let carried = self.lowest_torque_capacity.as_ref().map_or(0.0, |c| c.torque_capacity_nm);
        let far = far_more_than_asked(self.asked_nm, carried);
        let running = self.running.iter().flat_map(running::RunningSection::remarks);
        let run_out = self.run_out.iter().flat_map(run_out::RunOutSection::remarks);
        let lift_off = self.overrun.lift_off_remark(self.lift_off_rpm, self.lift_off_searched_to_rpm);
        let beyond = self.overrun.beyond_lift_off(self.lift_off_rpm);
        let overrun = [lift_off].into_iter().chain(beyond).chain(self.overrun.remarks());
        let at_speed = self.at_speed.iter().filter_map(at_speed::AtSpeedSection::warning);
        let all = early
            .into_iter()
            .chain(far)
            .chain(at_speed)
            .chain(overrun)
            .chain(running)
            .chain(run_out)
            .chain(self.of_file.iter().cloned());
        all.map(|line| greek(&line)).collect()
    }
}

impl CheckRow {
    /// Of a limit on a clutch whose curve ends at `end_torque_nm`, N m.
    pub fn of(r: &Margin, end_torque_nm: f64) -> Self {
        Self {
            code: r.code(),
            name: r.full_name(),
            demand: r.demand_in_unit().filter(|_| !r.overloaded()),
            allowable: r.shown_allowable(),
            unit: r.limit.unit,
            margin: r.margin(),
            torque_capacity_nm: r.torque_capacity_nm,
            capacity_beyond_end: ends_first(r, end_torque_nm),
            required: r.required,
            computed: r.computed(),
            not_computed: match r.demand {
                Demand::NotComputed(why) => Some(why),
                _ => None,
            },
            overloaded: r.overloaded(),
            held: r.held(),
            slip_margin: r.slip_margin(),
        }
    }
}

/// The table for people: codes, not sentences, so that it fits a terminal. A limit that is not reached before the
/// curve ends, at `end_torque_nm`, has a capacity beyond it.
pub fn people_table(rows: &[Margin], end_torque_nm: f64) -> Table {
    Rows::of(rows)
        .text("code", "Limit", |r| r.code())
        .number("demand", "Demand", Unit::One, 4, |r| demand_cell(r))
        .number("allowable", "Allowable", Unit::One, 4, |r| allowable_cell(r))
        .text("unit", "Unit", |r| unit_cell(r))
        // What is not reached says so once, under demand.
        .number("margin", "Margin", Unit::Percent, 3, |r| {
            if r.is_not_reached() { Cell::Empty } else { margin_cell(r) }
        })
        .number("torque_capacity_nm", "Reached at", Unit::NewtonMetre, 4, |r| {
            r.torque_capacity_nm.map_or(Cell::Empty, |c| capacity_cell(r, c, end_torque_nm))
        })
        .text("verdict", "Verdict", |r| verdict(r))
        .table()
}

/// Whether the row's figure is what is left, and is to lie above 0: its demand is 0, and the figure its allowable.
fn is_what_is_left(r: &Margin) -> bool {
    let none_asked = r.demand == Demand::Value(0.0) || (r.overloaded() && r.limit.rule == Rule::Clearance);
    matches!(r.limit.rule, Rule::Itself | Rule::Clearance) && none_asked
}

/// The demand as people read it; of what is left that.
pub fn demand_cell(r: &Margin) -> Cell {
    match r.demand {
        Demand::Value(_) if is_what_is_left(r) => r.shown_allowable().into(),
        // What would lift the sprags off presses them on.
        Demand::Value(demand) if r.limit.rule == Rule::Share && demand < 0.0 => PRESSED_ON.into(),
        Demand::Value(_) | Demand::MoreThan(_) => r.demand_in_unit().into(),
        // Friction has no demand at all then, a torque one at the end of the curve.
        Demand::Overloaded { at_end: Some(_), .. } => NOT_REACHED.into(),
        Demand::Overloaded { at_end: None, .. } => OVERLOADED.into(),
        Demand::NoneSuffices | Demand::LetsGo => no_friction(r.demand == Demand::LetsGo).into(),
        Demand::NotComputed(_) | Demand::Unknown => NOT_COMPUTED.into(),
    }
}

/// The allowable as people read it; of slip the margin that is wanted.
pub fn allowable_cell(r: &Margin) -> Cell {
    match (r.is_slip(), is_what_is_left(r)) {
        (true, _) => wanted_text(r).into(),
        (_, true) => "above 0".into(),
        _ => r.shown_allowable().into(),
    }
}

/// The unit of demand and allowable as people read it; of slip that of the demand, the wanted margin has its own.
pub fn unit_cell(r: &Margin) -> Cell {
    match r.limit.unit {
        "1" if r.is_slip() || r.limit.is_grip() => "μ".into(),
        "1" if r.is_contact() => "N/N₀".into(),
        "1" => "".into(),
        unit => unit.into(),
    }
}

/// What stands in place of a margin that is no number: no friction suffices, which the demand says, its scene lies
/// beyond the end of the curve, its torque does and nothing breaks it before, or a run met its limit of work.
pub fn in_place_of_margin(r: &Margin) -> Option<&'static str> {
    match r.demand {
        Demand::NoneSuffices | Demand::LetsGo => Some(NONE),
        Demand::Overloaded { .. } if r.left() == Left::Lost => Some(OVERLOADED),
        _ if r.is_not_reached() => Some(NOT_REACHED),
        Demand::NotComputed(_) => Some(NOT_COMPUTED),
        _ => None,
    }
}

/// The margin as people read it, for a column in percent; of slip the slip margin.
pub fn margin_cell(r: &Margin) -> Cell {
    match in_place_of_margin(r) {
        Some(words) => words.into(),
        None => r.shown_margin().map_or(NO_DEMAND.into(), Cell::from),
    }
}

fn capacity_cell(r: &Margin, capacity_nm: f64, end_torque_nm: f64) -> Cell {
    if is_beyond(r, capacity_nm, end_torque_nm) {
        format!("> {}", significant(r.end_torque_nm.unwrap_or(end_torque_nm), 4)).into()
    } else {
        capacity_nm.into()
    }
}

/// Whether the limit is not reached before the curve ends; the one of the two that is the end itself is.
pub fn is_beyond(r: &Margin, capacity_nm: f64, end_torque_nm: f64) -> bool {
    let ends = r.limit.ends_curve && !r.off_centre;
    let share = if ends { 1.0 + 1e-9 } else { 1.0 - 1e-9 };
    capacity_nm >= r.end_torque_nm.unwrap_or(end_torque_nm) * share
}

/// Whether the limit has a capacity, and that lies at the end of the curve or beyond.
pub fn ends_first(r: &Margin, end_torque_nm: f64) -> bool {
    r.torque_capacity_nm.is_some_and(|c| is_beyond(r, c, end_torque_nm))
}

/// The least margin first; of equal ones that which is reached at the lowest torque.
fn nearest_first(a: &&Margin, b: &&Margin) -> std::cmp::Ordering {
    let reached = |r: &Margin| r.torque_capacity_nm.unwrap_or(f64::INFINITY);
    a.margin().total_cmp(&b.margin()).then(reached(a).total_cmp(&reached(b)))
}

fn verdict(r: &Margin) -> Cell {
    match (r.required, r.held()) {
        (true, _) if !r.computed() => Cell::Verdict(false, "NOT COMPUTED".into()),
        (false, _) if !r.computed() => "shown, not computed".into(),
        (true, true) => Cell::Verdict(true, "held".into()),
        (true, false) => Cell::Verdict(false, "NOT HELD".into()),
        (false, true) => "shown".into(),
        (false, false) => "shown, broken".into(),
    }
}

/// The table for programs: every number in full, nothing but numbers in number columns.
pub fn csv_table(rows: &[CheckRow]) -> Table {
    Rows::of(rows)
        .text("code", "Code", |r| r.code.as_str())
        .text("name", "Limit", |r| r.name.as_str())
        .number("demand", "Demand", Unit::One, 5, |r| r.demand)
        .number("allowable", "Allowable", Unit::One, 5, |r| r.allowable)
        .text("unit", "Unit", |r| r.unit)
        .number("margin", "Margin", Unit::One, 5, |r| r.margin)
        .number("torque_capacity_nm", "Torque capacity", Unit::NewtonMetre, 5, |r| r.torque_capacity_nm)
        .text("required", "Required", |r| r.required)
        .text("held", "Held", |r| r.held)
        .text("capacity_beyond_end", "Capacity beyond the end of the curve", |r| r.capacity_beyond_end)
        .number("slip_margin", "Slip margin", Unit::One, 5, |r| r.slip_margin)
        .table()
}

/// A margin in percent, or the words in its place; a limit that nothing demands has none.
pub fn margin_text(row: &Margin) -> String {
    match in_place_of_margin(row) {
        Some(words) => words.to_owned(),
        None => row.shown_margin().map_or(NO_DEMAND.to_owned(), |margin| Unit::Percent.show(margin, 3)),
    }
}

/// The same with the word margin before it, of slip with what is wanted.
pub fn margin_words(row: &Margin) -> String {
    let is_number = in_place_of_margin(row).is_none();
    match row.is_slip() {
        true if is_number => format!("slip margin {}, {}", margin_text(row), wanted_text(row)),
        true => format!("slip margin: {}, {}", margin_text(row), wanted_text(row)),
        false if is_number => format!("margin {}", margin_text(row)),
        false => format!("margin: {}", margin_text(row)),
    }
}

/// The slip margin that is wanted of a row.
fn wanted_text(row: &Margin) -> String {
    format!("{} wanted", Unit::Percent.show(row.reference, 3))
}
