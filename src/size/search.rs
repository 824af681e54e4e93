//! From proportions to a width, a count and a file that holds its limits.

use std::fmt;

use super::ask::{Ask, BadAsk};
use super::proportions::{COUNTS, LENGTHS, SPACES_M, draft, lengthen, spring};
use crate::design::{Design, Draft};
use crate::margin::{KEEP_CONTACT, LoadState, Margin, load_margins, load_state, margins};
use crate::numeric::rounded;
use crate::profile::Outline;
use crate::scenario::Settings;

/// Margin that a first design keeps on every limit: a choice, so that rounding and the optimiser find room.
const KEPT: f64 = 0.02;

/// Largest drag of the spring in overrun over the nominal torque.
const DRAG: f64 = 0.02;

/// One race space as tried.
#[derive(Debug, Clone, PartialEq)]
pub struct Tried {
    /// Race space, m.
    pub space_m: f64,
    /// Sprags.
    pub count: usize,
    /// Length of the sprags, m: that needed, or the longest where none suffices.
    pub length_m: f64,
    /// Volume of the ring from bore to outside, m^3.
    pub volume_m3: f64,
    /// Nominal torque that it carries at that length with all limits kept, N m.
    pub carries_nm: f64,
    /// Code of the limit with the least margin; what else stands in the way otherwise.
    pub decided_by: String,
    /// Whether it carries what is asked.
    pub held: bool,
}

/// A design that does what is asked.
#[derive(Debug, Clone, PartialEq)]
pub struct Sized {
    /// The design.
    pub design: Design,
    /// Race spaces tried, the one taken among them.
    pub tried: Vec<Tried>,
    /// Index of the one taken: the smallest volume.
    pub taken: usize,
    /// Every margin of the design with its scenarios.
    pub margins: Vec<Margin>,
}

/// Why there is none.
#[derive(Debug, Clone, PartialEq)]
pub enum NoSize {
    /// The question.
    Ask(BadAsk),
    /// No race space does it.
    None {
        /// Those tried.
        tried: Vec<Tried>,
    },
}

impl fmt::Display for NoSize {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Ask(why) => write!(f, "{why}"),
            Self::None { tried } => {
                let best = tried.iter().max_by(|a, b| a.carries_nm.total_cmp(&b.carries_nm));
                match best.filter(|b| b.carries_nm > 0.0) {
                    Some(b) => write!(
                        f,
                        "no clutch of this family does it; the nearest carries {:.4} Nm with {} sprags of {:.1} mm in a race space of \
                         {:.2} mm, held up by {}",
                        b.carries_nm,
                        b.count,
                        b.length_m * 1e3,
                        b.space_m * 1e3,
                        b.decided_by
                    ),
                    None => write!(f, "no clutch of this family fits this bore: {}", first_reason(tried)),
                }
            }
        }
    }
}

fn first_reason(tried: &[Tried]) -> String {
    tried
        .iter()
        .map(|t| format!("{:.2} mm: {}", t.space_m * 1e3, t.decided_by))
        .collect::<Vec<_>>()
        .join("; ")
}

impl std::error::Error for NoSize {}

/// A draft as a design with its load state.
fn build(draft: &Draft) -> Result<(Design, LoadState), String> {
    let design = Design::parse(&draft.to_toml(), "sized.toml").map_err(|e| {
        e.problems().first().map_or_else(|| e.to_string(), |p| format!("{}: {}", p.key, p.allowed))
    })?;
    let state = load_state(&design).map_err(|e| e.to_string())?;
    Ok((design, state))
}

/// Least margin of the load state and its code; that of the sprags' grip and stress, not of the spring at speed.
fn least(draft: &Draft) -> Result<(f64, String), String> {
    let (design, state) = build(draft)?;
    let rows = load_margins(&design, &design.limits, false, &state);
    let rows = rows.iter().filter(|r| r.required && r.limit != &KEEP_CONTACT);
    let worst = rows.min_by(|a, b| a.margin().total_cmp(&b.margin()));
    Ok(worst.map_or((0.0, "no limit".to_owned()), |r| (r.margin(), r.code())))
}

/// Find a design for `ask`. Every race space of the family is tried; that of the smallest volume is taken.
///
/// # Errors
/// [`NoSize`].
pub fn size(ask: &Ask, settings: &Settings) -> Result<Sized, NoSize> {
    ask.check().map_err(NoSize::Ask)?;
    let mut tried = Vec::new();
    let mut held: Vec<(usize, Draft)> = Vec::new();
    for space_m in SPACES_M {
        let mut draft = draft(ask, space_m);
        if draft.count < COUNTS.0 || draft.count > COUNTS.1 {
            continue;
        }
        let one = width(&mut draft, space_m);
        if one.held {
            held.push((tried.len(), draft));
        }
        tried.push(one);
    }
    held.sort_by(|a, b| tried[a.0].volume_m3.total_cmp(&tried[b.0].volume_m3));
    for (taken, draft) in held {
        match finish(ask, draft, settings) {
            Ok((design, margins)) => return Ok(Sized { design, tried, taken, margins }),
            Err(why) => {
                let one = &mut tried[taken];
                (one.held, one.decided_by) = (false, why);
            }
        }
    }
    Err(NoSize::None { tried })
}

/// Shortest sprags that keep every limit, put into `draft`.
fn width(draft: &mut Draft, space_m: f64) -> Tried {
    let (low, high) = (LENGTHS.0 * space_m, LENGTHS.1 * space_m);
    let at = |draft: &Draft, length_m: f64| {
        let mut longer = draft.clone();
        lengthen(&mut longer, length_m);
        least(&longer)
    };
    let mut one = Tried {
        space_m,
        count: draft.count,
        length_m: high,
        volume_m3: 0.0,
        carries_nm: 0.0,
        decided_by: String::new(),
        held: false,
    };
    match at(draft, high) {
        Err(why) => {
            one.decided_by = why;
            return one;
        }
        Ok((margin, code)) if margin < KEPT => {
            lengthen(draft, high);
            one.carries_nm = carries(draft);
            one.decided_by = code;
            return one;
        }
        Ok((_, code)) => one.decided_by = code,
    }
    let (mut short, mut long) = (low, high);
    if at(draft, low).is_ok_and(|(margin, _)| margin >= KEPT) {
        long = low;
    }
    while long - short > 1e-2 * space_m {
        let middle = 0.5 * (short + long);
        match at(draft, middle) {
            Ok((margin, code)) if margin >= KEPT => (long, one.decided_by) = (middle, code),
            _ => short = middle,
        }
    }
    // Up to the next half millimetre, or tenth for small sprags.
    let step = if space_m >= 4e-3 { 0.5e-3 } else { 0.1e-3 };
    lengthen(draft, (long / step - 1e-6).ceil() * step);
    let [bore, _, _, outside] = draft.races_m;
    one.length_m = draft.length_m;
    one.volume_m3 = std::f64::consts::PI * (outside * outside - bore * bore) * draft.width_m;
    one.carries_nm = draft.torques_nm[0];
    one.held = true;
    one
}

/// Largest nominal torque at which the draft as it is keeps its limits, N m: margins fall as the torque rises.
fn carries(draft: &Draft) -> f64 {
    let safety = draft.torques_nm[1] / draft.torques_nm[0];
    let holds = |torque: f64| {
        let mut other = draft.clone();
        other.torques_nm = [torque, safety * torque];
        other.abutment_nm_per_rad = 10.0 * torque;
        least(&other).is_ok_and(|(margin, _)| margin >= KEPT)
    };
    let (mut a, mut b) = (0.0, draft.torques_nm[0]);
    let mut torque = b;
    // Down by halves until it holds, then between.
    for _ in 0..40 {
        torque *= 0.5;
        if holds(torque) {
            a = torque;
            break;
        }
        b = torque;
    }
    if a == 0.0 {
        return 0.0;
    }
    while b - a > 1e-3 * b {
        let middle = 0.5 * (a + b);
        if holds(middle) { a = middle } else { b = middle }
    }
    a
}

/// Profile's end, flanks, spring and torque step; then every margin with the scenarios.
fn finish(ask: &Ask, mut draft: Draft, settings: &Settings) -> Result<(Design, Vec<Margin>), String> {
    const ROUNDS: usize = 6;
    let mut why = String::new();
    for _ in 0..ROUNDS {
        draft.flanks_m = None;
        draft.until_rad = 1.2;
        let (design, state) = build(&draft)?;
        let peak = state.curve.at_torque(draft.torques_nm[1]).ok_or("the curve ends below peak torque")?;
        let nominal =
            state.curve.at_torque(draft.torques_nm[0]).ok_or("the curve ends below nominal torque")?;
        // A third of the turn, and a little for small ones, is left at peak torque.
        draft.until_rad = 1.3 * peak.contact_turn_rad + 0.02;
        let mut ended = design.clutch.clone();
        ended.sprags.inner_arcs[0].until_rad = draft.until_rad;
        let profile = ended.profile().map_err(|e| e.to_string())?;
        let (rear, front) = Outline::narrowest_flanks(&profile).map_err(|e| e.to_string())?;
        // A sprag is no needle: at least a fifth of the race space to either side, where the arcs reach that far.
        let space = draft.races_m[2] - draft.races_m[1];
        let least_half = (0.2 * space).min(0.8 * draft.inner_radius_m);
        draft.flanks_m = Some((rear.max(least_half), front.max(least_half)));
        let stiffness = nominal.k_secant_nm_per_rad;
        let [inner, outer] = draft.inertias_kg_m2;
        let natural_hz = (stiffness / inner.min(outer)).sqrt() / std::f64::consts::TAU;
        draft.step_duration_s = (20.0 / natural_hz).max(0.02);
        draft.abutment_nm_per_rad = 10.0 * stiffness;
        draft.name = format!("sized: bore {} mm, {} Nm", short(ask.bore_m * 1e3), short(ask.torque_nm));
        draft.why = why_lines(ask, &draft);
        match built(&mut draft).and_then(|design| checked(&design, settings).map(|rows| (design, rows))) {
            Ok(done) => return Ok(done),
            Err(Obstacle::Neighbours) => {
                draft.count = (draft.count as f64 * 0.95).floor() as usize;
                why = "neighbouring sprags overlap".to_owned();
            }
            Err(Obstacle::Margin(code)) => why = code,
            Err(Obstacle::Other(other)) => return Err(other),
        }
        if draft.count < COUNTS.0 {
            break;
        }
        // Fewer sprags or dynamics ask for more width.
        lengthen_by(&mut draft, 1.06);
        if draft.length_m > 1.2 * LENGTHS.1 * space {
            break;
        }
    }
    Err(why)
}

fn lengthen_by(draft: &mut Draft, factor: f64) {
    let length_m = (factor * draft.length_m * 1e4).ceil() / 1e4;
    lengthen(draft, length_m);
}

/// What stands in the way of a draft that its width should carry.
enum Obstacle {
    Neighbours,
    Margin(String),
    Other(String),
}

/// The finished draft as a design, its spring strong enough for the speed.
fn built(draft: &mut Draft) -> Result<Design, Obstacle> {
    for _ in 0..3 {
        let (design, state) = build(draft).map_err(|why| {
            if why.starts_with("sprags.count") { Obstacle::Neighbours } else { Obstacle::Other(why) }
        })?;
        let rows = load_margins(&design, &design.limits, false, &state);
        let Some(keep) = rows.iter().find(|r| r.limit == &KEEP_CONTACT && r.margin() < KEPT) else {
            return Ok(design);
        };
        // The closing moment is in proportion to the spring's force, but for what growth takes from its angle.
        let normal_n = 10.0 * draft.drag_nm / (draft.count as f64 * draft.races_m[1]);
        let opening = keep.demand_in_unit().filter(|_| keep.allowable > 0.0);
        let factor = opening.map_or(4.0, |opening| 1.1 * opening / keep.allowable_in_unit());
        spring(draft, normal_n * factor.max(1.1));
        if draft.drag_nm > DRAG * draft.torques_nm[0] {
            return Err(Obstacle::Other(format!(
                "keep-contact: a spring that holds the sprags against their centrifugal moment would drag with {:.3} Nm, above {DRAG} \
                 of the nominal torque",
                draft.drag_nm
            )));
        }
    }
    Err(Obstacle::Other("keep-contact: no spring was found".to_owned()))
}

/// Every margin with the scenarios named in the file, all held.
fn checked(design: &Design, settings: &Settings) -> Result<Vec<Margin>, Obstacle> {
    let rows =
        margins(design, &design.check_scenarios, settings).map_err(|e| Obstacle::Other(e.to_string()))?;
    match rows.iter().filter(|r| r.required).find(|r| !r.held()) {
        Some(row) => Err(Obstacle::Margin(row.code())),
        None => Ok(rows),
    }
}

/// For names and comments.
fn short(value: f64) -> f64 {
    rounded(value, 7)
}

fn why_lines(ask: &Ask, draft: &Draft) -> Vec<String> {
    let rpm = ask.speed_rad_s * 30.0 / std::f64::consts::PI;
    vec![
        format!("Written by sprag-design size {}", env!("CARGO_PKG_VERSION")),
        format!(
            "Why this file exists: a first design for a bore of {} mm, {} Nm nominal, safety {}, friction {}{}.",
            short(ask.bore_m * 1e3),
            short(ask.torque_nm),
            short(ask.safety),
            short(ask.friction),
            if rpm > 0.0 { format!(", contact kept up to {} rpm", short(rpm)) } else { String::new() }
        ),
        format!(
            "Race space {} mm, the width and the count that its limits ask for with {} % left, proportions of a maker's",
            short((draft.races_m[2] - draft.races_m[1]) * 1e3),
            100.0 * KEPT
        ),
        "8.33 mm series. Nothing in it is optimised: check, then optimize.".to_owned(),
    ]
}
