//! Overrun in the margin check: words, JSON, table.

use crate::answer::overrun::usual_speeds_rad_s;
use crate::design::{Design, Limits, rad_s};
use crate::dynamics::CageFacts;
use crate::file::inputs;
use crate::follow::Follow;
use crate::margin::{
    LIFT_OFF_TO_RAD_S, LoadState, OverrunCurve, OverrunPoint, lift_off_rad_s, lift_off_under, overrun_at,
    overrun_curve,
};
use crate::report::{Rows, Table, Unit};
use crate::wedge::NoCurve;
use serde::Serialize;

/// Speed of the tracks beyond which nobody runs such a clutch, m/s: a choice that ends the plots where the sprags
/// never lift off.
const FASTEST_M_S: f64 = 50.0;

/// Lift-off is drawn up to this multiple of the largest speed that the file names: a choice.
const FAR: f64 = 3.0;
/// What is drawn beyond the largest speed of interest, as a multiple of it.
const ROOM: f64 = 1.5;

/// How far a page draws overrun, rpm: the speeds that the file names, with room, and lift-off where it is not far away; else all.
pub(super) fn drawn_to_rpm(
    named: &[NamedOverrun],
    lift_off_rpm: Option<f64>,
    wanted_rpm: Option<f64>,
) -> f64 {
    let named = named.iter().flat_map(|n| [n.outer_rpm, n.inner_rpm]).map(f64::abs);
    let named = named.chain(wanted_rpm).fold(0.0, f64::max);
    let near = lift_off_rpm.filter(|off| *off <= FAR * named).unwrap_or(0.0);
    if named > 0.0 { ROOM * named.max(near) } else { f64::INFINITY }
}

/// How far the curve goes, rad/s: beyond lift-off and the speed up to which contact is wanted.
fn up_to_rad_s(limits: &Limits, lift_off_rad_s: Option<f64>, track_m: f64) -> f64 {
    let wanted = limits.keep_contact_to_rad_s.unwrap_or(0.0);
    let beyond = 1.25 * lift_off_rad_s.unwrap_or(0.0).max(wanted);
    if lift_off_rad_s.is_some() && beyond > 0.0 { beyond } else { beyond.max(FASTEST_M_S / track_m) }
}

impl Design {
    /// Overrun of the clutch in `state`, and the speed at which the sprags lift off, rad/s.
    ///
    /// # Errors
    /// [`NoCurve`] as [`overrun_curve`].
    pub(in crate::answer) fn overruns(
        &self,
        state: &LoadState,
        follow: &Follow,
    ) -> Result<(OverrunSection, Option<f64>), NoCurve> {
        let lift_off_rad_s = lift_off_rad_s(self, state, LIFT_OFF_TO_RAD_S);
        let up_to = up_to_rad_s(&self.limits, lift_off_rad_s, self.clutch.races.outer_radius_m);
        let named = named(self, state);
        let mut course = curve(self, state, up_to, lift_off_rad_s, follow)?;
        // What is drawn of a long curve is a curve of its own.
        let rpm = |rad_s: Option<f64>| rad_s.map(|w| Unit::Rpm.from_si(w));
        let drawn = rad_s(drawn_to_rpm(&named, rpm(lift_off_rad_s), rpm(self.limits.keep_contact_to_rad_s)));
        if drawn < 0.5 * up_to {
            let near = overrun_curve(self, state, drawn, follow)?;
            near.outer_race.into_iter().for_each(|point| insert(&mut course.outer_race, point));
            near.inner_race.into_iter().for_each(|point| insert(&mut course.inner_race, point));
        }
        let cage = CageSection::of(self, state);
        let more = lift_off_rad_s.and_then(|_| lift_off_under(self, state, MORE_DRAG, LIFT_OFF_TO_RAD_S));
        Ok((OverrunSection::new(&course, named, self, cage, rpm(more)), lift_off_rad_s))
    }
}

/// Overrun up to `up_to_rad_s`, lift-off among the speeds: there drag and force at A end.
///
/// # Errors
/// [`NoCurve`] as [`overrun_curve`].
fn curve(
    design: &Design,
    state: &LoadState,
    up_to_rad_s: f64,
    lift_off_rad_s: Option<f64>,
    follow: &Follow,
) -> Result<OverrunCurve, NoCurve> {
    let mut curve = overrun_curve(design, state, up_to_rad_s, follow)?;
    if let Some(speed) = lift_off_rad_s.filter(|&speed| speed > 0.0 && speed < up_to_rad_s) {
        let there = overrun_curve(design, state, speed, follow)?;
        let pairs = [(&mut curve.outer_race, there.outer_race), (&mut curve.inner_race, there.inner_race)];
        for (points, there) in pairs {
            // A curve that ends early does not reach lift-off.
            there
                .last()
                .filter(|p| p.speed_rad_s >= speed)
                .into_iter()
                .for_each(|last| insert(points, *last));
        }
    }
    // Usual speeds, slow ones among them, and those at which the file lets the inner race run, the outer one held.
    let named = design.scenarios.iter().filter_map(|s| s.kind.overrun_rad_s());
    let named = named.filter(|[_, outer]| *outer == 0.0).map(|[ahead, _]| ahead);
    for speed_rad_s in usual_speeds_rad_s().filter(|speed| *speed < up_to_rad_s).chain(named) {
        insert(&mut curve.inner_race, overrun_at(design, state, 0.0, speed_rad_s)?);
    }
    Ok(curve)
}

/// Whether the design names a speed of the outer race: in a limit or in a scene.
pub(in crate::answer) fn outer_turns(design: &Design) -> bool {
    let limits = &design.limits;
    // In a driven cage they are speeds of the inner one.
    let of_limits = [limits.keep_contact_to_rad_s, limits.lift_off_by_rad_s];
    let asked = of_limits.into_iter().flatten().filter(|_| !design.clutch.slides_outside());
    // An infinite mean speed stands for a history.
    asked.chain(design.scenarios.iter().map(|s| s.mean_speed_rad_s())).any(|speed| speed != 0.0)
}

/// The overruns that the design names, in limits and scenes: drag at each. None of a speed at which there is no first contact.
fn named(design: &Design, state: &LoadState) -> Vec<NamedOverrun> {
    let limits = &design.limits;
    let by_limit = [
        ("keep_contact_to_rpm", limits.keep_contact_to_rad_s),
        ("lift_off_by_rpm", limits.lift_off_by_rad_s),
    ];
    let by_limit = by_limit.into_iter().filter_map(|(key, speed)| {
        let speed = speed.filter(|speed| *speed > 0.0)?;
        Some((key.to_owned(), design.clutch.overrun_of_carrier(speed)))
    });
    let by_limit = by_limit.map(|(by, speeds)| (by, speeds, true, false));
    let by_scene = design
        .scenarios
        .iter()
        .filter_map(|s| Some((s.name.clone(), s.kind.overrun_rad_s()?, s.kind.is_overrun(), true)));
    let one = |(by, [ahead, outer], lasts, by_scene): (String, [f64; 2], bool, bool)| {
        let point = overrun_at(design, state, outer, ahead).ok()?;
        Some(NamedOverrun {
            by,
            outer_rpm: Unit::Rpm.from_si(outer),
            inner_rpm: Unit::Rpm.from_si(outer + ahead),
            drag_torque_nm: point.state.drag_torque_nm,
            growth_rate_per_s: point.swing.map(|s| s.growth_rate_per_s),
            swing_frequency_hz: point.swing.map(|s| s.frequency_hz),
            lifted_off: point.state.sliding_n <= 0.0,
            lasts,
            by_scene,
        })
    };
    by_limit.chain(by_scene).filter_map(one).collect()
}

/// A point among others, speeds ascending; none twice.
fn insert(points: &mut Vec<OverrunPoint>, point: OverrunPoint) {
    let at = points.partition_point(|p| p.speed_rad_s < point.speed_rad_s);
    if points.get(at).is_none_or(|p| p.speed_rad_s > point.speed_rad_s) {
        points.insert(at, point);
    }
}

/// One speed of the JSON.
#[derive(Debug, Clone, Serialize)]
pub struct OverrunRow {
    /// Race that runs: `outer` or `inner`; the other stands.
    pub race: &'static str,
    /// Speed of that race, rev/min.
    pub speed_rpm: f64,
    /// Drag torque of the whole clutch, N m.
    pub drag_torque_nm: f64,
    /// Normal force of one sprag at the inner contact, N.
    pub normal_inner_n: f64,
    /// The same at the outer contact, N.
    pub normal_outer_n: f64,
    /// Coefficient of friction of the sliding contact at that speed: the inner one, in a driven cage the outer one.
    pub friction: f64,
    /// Growth of a small swing of the sprags about the equilibrium, 1/s; positive: the equilibrium does not stay; null where
    /// they are off or nothing slides.
    pub growth_rate_per_s: Option<f64>,
    /// Frequency of that swing, Hz.
    pub swing_frequency_hz: Option<f64>,
    /// Whether the sprags are off the race that they slide on.
    pub lifted_off: bool,
    /// Growth of the outer track by rotation, um.
    pub outer_race_growth_um: f64,
    /// Hoop stress of the outer race by rotation, MPa.
    pub rotation_hoop_outer_mpa: f64,
}

/// An overrun that the design names.
#[derive(Debug, Clone, Serialize)]
pub struct NamedOverrun {
    /// Key of the limit, or name of the scene.
    pub by: String,
    /// Speed of the outer race, rev/min.
    pub outer_rpm: f64,
    /// Speed of the inner race, rev/min.
    pub inner_rpm: f64,
    /// Drag of the whole clutch, N m.
    pub drag_torque_nm: f64,
    /// Growth of a small swing of the sprags, 1/s, as of [`OverrunRow`].
    pub growth_rate_per_s: Option<f64>,
    /// Frequency of that swing, Hz.
    pub swing_frequency_hz: Option<f64>,
    /// Whether the sprags are off the race that they slide on.
    pub lifted_off: bool,
    /// Whether it is steady; an engagement only begins so.
    #[serde(skip)]
    lasts: bool,
    /// Whether a scene names it, else a limit.
    #[serde(skip)]
    by_scene: bool,
}

impl NamedOverrun {
    fn words(&self) -> String {
        let drag = match self.lifted_off {
            true => "none (the sprags are off)".to_owned(),
            false => Unit::NewtonMetre.show(self.drag_torque_nm, 3),
        };
        format!("{drag} at {}", self.speeds())
    }

    /// Speeds, and who names them.
    fn speeds(&self) -> String {
        let speeds = match (self.outer_rpm, self.inner_rpm) {
            (outer, 0.0) => format!("{outer:.0} rpm of the outer race"),
            (0.0, inner) => format!("{inner:.0} rpm of the inner race"),
            (outer, inner) => format!("{outer:.0} rpm of the outer and {inner:.0} rpm of the inner race"),
        };
        format!("{speeds} ({})", self.by)
    }
}

/// Overruns that a line has room for.
const NAMED: usize = 4;

/// Sprags that a cage carries with the inner race.
#[derive(Debug, Clone, Serialize)]
pub struct CageSection {
    /// The race that they ride with, whose speed `lift_off_rpm` and the limits mean.
    pub rides_with: &'static str,
    /// Radius of the pivot, mm.
    pub pivot_radius_mm: f64,
    /// Azimuth of the pivot ahead of the centroid, deg; below 0 the centrifugal force lifts the sprags off the outer race.
    pub pivot_ahead_of_centroid_deg: f64,
    /// By which part lift-off comes later at most, where the inner race and not the cage took the sprags along while the drag was measured.
    pub lift_off_later_at_most: f64,
    /// How far the cage lets the pivot go outward, um, as the file says.
    pub clearance_um: f64,
    /// By which part lift-off comes later for each further micrometre of that clearance.
    pub lift_off_later_per_um: f64,
    /// Whether the sprags come back to the outer race at the speed of lift-off; else at a lower one.
    pub comes_back_there: bool,
    /// Whether the file names the centroid; else it follows from flanks.
    #[serde(skip)]
    centroid_named: bool,
}

impl CageSection {
    fn of(design: &Design, state: &LoadState) -> Option<Self> {
        let facts = CageFacts::of(&design.clutch, &state.curve, state.alpha_max_rad)?;
        Some(Self {
            rides_with: "inner",
            pivot_radius_mm: Unit::Millimetre.from_si(facts.pivot_radius_m),
            pivot_ahead_of_centroid_deg: Unit::Degree.from_si(facts.ahead_of_centroid_rad),
            lift_off_later_at_most: facts.lift_off_higher,
            clearance_um: Unit::Micrometre.from_si(design.clutch.cage?.clearance_m),
            lift_off_later_per_um: 1e-6 * facts.lift_off_higher_per_m,
            comes_back_there: facts.opens_softly,
            centroid_named: inputs(&design.source).iter().any(|i| i.path.starts_with("sprags.centroid")),
        })
    }

    /// What would let sprags lift off that speed presses on.
    pub(super) fn never_lifts(&self) -> Option<String> {
        (self.pivot_ahead_of_centroid_deg >= 0.0).then(|| {
            format!(
                ", for speed presses them on: they lift off where the centroid lies ahead of the pivot, by {}, or by a smaller \
                 cage.pivot.x_mm",
                match self.centroid_named {
                    true => "a larger sprags.centroid.x_mm",
                    false => "flanks of the sprags with more front_mm or less rear_mm",
                }
            )
        })
    }
}

/// `overrun` of the JSON.
#[derive(Debug, Clone, Serialize)]
pub struct OverrunSection {
    /// What the centrifugal force does to the sprags: `engaging`, `disengaging` or `neutral`.
    pub centrifugal: &'static str,
    /// What is otherwise where the design has a driven cage.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cage: Option<CageSection>,
    /// Azimuth of the outer contact arc's centre ahead of the centroid at first contact at rest, deg; positive: engaging at
    /// speed.
    pub gamma_deg: f64,
    /// Drag torque of the slowest overrun, without centrifugal force, N m.
    pub drag_torque_slow_nm: f64,
    /// Whether the design names a speed of the outer race, in a limit or a scene.
    pub outer_race_turns: bool,
    /// The overruns that the design names.
    pub named: Vec<NamedOverrun>,
    /// All speeds looked at: first the outer race runs, then the inner one.
    pub points: Vec<OverrunRow>,
    /// The speed of lift-off where the spring drags a tenth more, rev/min; null: no lift-off up to `lift_off_searched_to_rpm`.
    pub lift_off_more_drag_rpm: Option<f64>,
    /// The limit of lift-off, rev/min.
    #[serde(skip)]
    pub(super) lift_off_by_rpm: Option<f64>,
    /// Whether the sliding contact is on a film of oil.
    #[serde(skip)]
    pub on_film: bool,
    /// A warning where the equilibrium does not stay at a speed that the design names, or, where it names none, at any; null where it
    /// does. A note where only a limit names that speed and the swing takes longer than 1 s to grow tenfold.
    pub warning: Option<String>,
    /// A note where that is so at other speeds only, on the way through them.
    pub passing: Option<String>,
}

/// How much more the spring drags where it is told what that does to lift-off: a choice, what drag scatters by.
const MORE_DRAG: f64 = 1.1;

/// Time in which a swing must grow tenfold for a speed that is only passed to be spoken of, s: a choice, no clutch passes more slowly.
pub(in crate::answer) const PASSING_S: f64 = 1.0;

/// What passing through speeds at which a swing grows by `rate` at most (1/s), said to be `which`, means; `None` where it takes
/// longer than [`PASSING_S`] to grow tenfold.
pub(in crate::answer) fn passing_words(rate: f64, which: &str) -> Option<String> {
    let tenfold_s = std::f64::consts::LN_10 / rate;
    (tenfold_s <= PASSING_S).then(|| {
        format!(
            "Note: {which} a small swing of the sprags grows tenfold in {} or more: it matters where the clutch stays there that long, not \
             where it passes",
            Unit::Millisecond.show(tenfold_s, 2)
        )
    })
}

/// What an equilibrium does not say: the fastest growth of the swing at the steady overruns that the design names, or, where it
/// names none, among the speeds looked at.
fn warning(named: &[NamedOverrun], points: &[&OverrunRow], limits: &Limits, on_film: bool) -> Option<String> {
    let steady = || named.iter().filter(|n| n.lasts);
    let of_named = steady().map(|n| (n.growth_rate_per_s, n.swing_frequency_hz, n.speeds()));
    let of_points = points.iter().map(|p| {
        let at = format!(
            "{:.0} rpm of the {} race, where of the speeds looked at it grows fastest,",
            p.speed_rpm, p.race
        );
        (p.growth_rate_per_s, p.swing_frequency_hz, at)
    });
    let all: Vec<_> = if steady().next().is_some() { of_named.collect() } else { of_points.collect() };
    let grows =
        all.into_iter().filter_map(|(rate, hertz, at)| Some((rate?, hertz?, at))).filter(|g| g.0 > 0.0);
    let (rate, hertz, at) = grows.max_by(|a, b| a.0.total_cmp(&b.0))?;
    let tenfold_s = std::f64::consts::LN_10 / rate;
    let grows = format!("a small swing of the sprags grows tenfold in {}", Unit::Second.show(tenfold_s, 2));
    // A limit's speed is no state that a clutch stays in for long.
    let mut growing = steady().filter(|n| n.growth_rate_per_s.is_some_and(|rate| rate > 0.0)).peekable();
    let by_limit = growing.peek().is_some() && growing.all(|n| !n.by_scene);
    if by_limit && tenfold_s > PASSING_S {
        return Some(format!("Note: at {at} {grows}: harmless where the clutch does not stay there as long"));
    }
    Some(format!(
        "Warning: steady overrun does not stay: at {at} {grows}, at {}, as its friction falls with speed{}; {}",
        Unit::Hertz.show(hertz, 3),
        if limits.keep_contact_to_rad_s.is_some() {
            " (keep-contact is that of the equilibrium)"
        } else {
            ""
        },
        if on_film {
            "more film calms it: another lubrication.oil, or a lower lubrication.temperature_c"
        } else {
            "a film of oil calms it, [lubrication], or a friction.kinetic nearer to friction.static"
        },
    ))
}

/// Where a swing grows at speeds that the clutch only passes.
fn passing(points: &[&OverrunRow]) -> Option<String> {
    let rate = |p: &OverrunRow| p.growth_rate_per_s.unwrap_or(0.0);
    let fast = || points.iter().filter(|p| rate(p) * PASSING_S >= std::f64::consts::LN_10);
    let most = fast().map(|p| rate(p)).fold(0.0, f64::max);
    let up_to = |race: &str| fast().filter(|p| p.race == race).map(|p| p.speed_rpm).reduce(f64::max);
    let races = ["inner", "outer"].into_iter().filter_map(|race| Some((race, up_to(race)?)));
    let words: Vec<String> = races.map(|(race, rpm)| format!("{rpm:.0} rpm of the {race} race")).collect();
    if words.is_empty() { None } else { passing_words(most, &format!("up to {}", words.join(" or "))) }
}

impl OverrunSection {
    pub(super) fn new(
        curve: &OverrunCurve,
        named: Vec<NamedOverrun>,
        design: &Design,
        cage: Option<CageSection>,
        lift_off_more_drag_rpm: Option<f64>,
    ) -> Self {
        let limits = &design.limits;
        let row = |race: &'static str, p: &OverrunPoint| OverrunRow {
            race,
            speed_rpm: Unit::Rpm.from_si(p.speed_rad_s),
            drag_torque_nm: p.state.drag_torque_nm,
            normal_inner_n: p.state.normal_inner_n,
            normal_outer_n: p.state.normal_outer_n,
            friction: p.friction,
            growth_rate_per_s: p.swing.map(|s| s.growth_rate_per_s),
            swing_frequency_hz: p.swing.map(|s| s.frequency_hz),
            lifted_off: p.state.sliding_n <= 0.0,
            outer_race_growth_um: Unit::Micrometre.from_si(p.growth_m),
            rotation_hoop_outer_mpa: Unit::Megapascal.from_si(p.rotation_hoop_pa),
        };
        let outer = curve.outer_race.iter().map(|p| row("outer", p));
        let points: Vec<OverrunRow> = outer.chain(curve.inner_race.iter().map(|p| row("inner", p))).collect();
        let wanted_rpm = limits.keep_contact_to_rad_s.map(|w| Unit::Rpm.from_si(w));
        let turns = outer_turns(design);
        let within =
            |p: &&OverrunRow| p.race == "inner" || turns && wanted_rpm.is_none_or(|rpm| p.speed_rpm <= rpm);
        let looked_at: Vec<&OverrunRow> = points.iter().filter(within).collect();
        let on_film = curve.inner_race.iter().any(|p| p.lubricated.is_some());
        let warning = warning(&named, &looked_at, limits, on_film);
        Self {
            centrifugal: match cage.as_ref().map_or(curve.gamma_rad, |c| c.pivot_ahead_of_centroid_deg) {
                g if g > 0.0 => "engaging",
                g if g < 0.0 => "disengaging",
                _ => "neutral",
            },
            gamma_deg: Unit::Degree.from_si(curve.gamma_rad),
            drag_torque_slow_nm: curve.inner_race.first().map_or(0.0, |p| p.state.drag_torque_nm),
            lift_off_more_drag_rpm,
            lift_off_by_rpm: limits.lift_off_by_rad_s.map(|w| Unit::Rpm.from_si(w)),
            on_film,
            cage,
            passing: if warning.is_none() { passing(&looked_at) } else { None },
            warning,
            outer_race_turns: turns,
            named,
            points,
        }
    }

    /// Drag, and whether the equilibrium stays, a line each.
    pub fn remarks(&self) -> impl Iterator<Item = String> {
        [Some(self.remark()), self.warning.clone(), self.passing.clone()].into_iter().flatten()
    }

    /// Drag in one line, at the speeds that the design names; lift-off has its own.
    pub fn remark(&self) -> String {
        let slow = Unit::NewtonMetre.show(self.drag_torque_slow_nm, 3);
        let mut named: Vec<String> =
            self.named.iter().take(NAMED).map(|at| format!("; {}", at.words())).collect();
        if self.named.len() > NAMED {
            named.push(format!("; {} more: --json", self.named.len() - NAMED));
        }
        let film = if self.on_film { " on a film of oil (`overrun` says more)" } else { "" };
        if let Some(cage) = &self.cage {
            return format!(
                "Overrun{film}: drag {slow} when slow{}; the cage carries the sprags with the inner race, they slide on the outer one, and \
                 the centrifugal force is {} (the pivot lies {:.3} deg {} the centroid)",
                named.concat(),
                self.centrifugal,
                cage.pivot_ahead_of_centroid_deg.abs(),
                if cage.pivot_ahead_of_centroid_deg < 0.0 { "behind" } else { "ahead of" },
            );
        }
        format!(
            "Overrun{film}: drag {slow} when slow{}; {} {} (gamma {:.3} deg: the centroid lies {} the sprag's outer centre)",
            named.concat(),
            match self.outer_race_turns {
                true => "the centrifugal force is",
                false => "if the outer race turned, the centrifugal force would be",
            },
            self.centrifugal,
            self.gamma_deg,
            match self.gamma_deg {
                g if g > 0.0 => "behind",
                g if g < 0.0 => "ahead of",
                _ => "over",
            }
        )
    }

    /// For people: as [`Self::table`], without rows that show what those on both sides of them do.
    pub(super) fn short_table(&self) -> Table {
        const SPEED: usize = 1;
        let all = self.table();
        let shown: Vec<Vec<String>> = all
            .rows
            .iter()
            .map(|row| {
                let cells = row.iter().zip(&all.columns).enumerate().filter(|(k, _)| *k != SPEED);
                cells.map(|(_, (cell, column))| cell.shown(column)).collect()
            })
            .collect();
        let like = |a: usize, b: usize| shown.get(a).is_some_and(|row| Some(row) == shown.get(b));
        let between = |k: usize| k > 0 && like(k - 1, k) && like(k + 1, k);
        let rows = all.rows.iter().enumerate().filter(|(k, _)| !between(*k)).map(|(_, row)| row.clone());
        Table { rows: rows.collect(), ..all }
    }

    /// All speeds, for `--overrun-csv`.
    pub fn table(&self) -> Table {
        Rows::of(&self.points)
            .text("race", "Race that runs", |p| p.race)
            .number("speed_rpm", "Speed, rpm", Unit::One, 5, |p| p.speed_rpm)
            .number("drag_torque_nm", "Drag torque", Unit::NewtonMetre, 4, |p| p.drag_torque_nm)
            .number("normal_inner_n", "Normal force at A", Unit::Newton, 4, |p| p.normal_inner_n)
            .number("normal_outer_n", "Normal force at B", Unit::Newton, 4, |p| p.normal_outer_n)
            .number(
                "friction",
                if self.cage.is_some() { "Friction at B" } else { "Friction at A" },
                Unit::One,
                4,
                |p| p.friction,
            )
            .number("growth_rate_per_s", "Growth of the swing, 1/s", Unit::One, 4, |p| p.growth_rate_per_s)
            .number("swing_frequency_hz", "Swing, Hz", Unit::One, 4, |p| p.swing_frequency_hz)
            .number("outer_race_growth_um", "Growth of the outer track, µm", Unit::One, 4, |p| {
                p.outer_race_growth_um
            })
            .number("rotation_hoop_outer_mpa", "Hoop by rotation, outer race, MPa", Unit::One, 4, |p| {
                p.rotation_hoop_outer_mpa
            })
            .table()
    }
}
