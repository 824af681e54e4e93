//! From proportions to a width, a count and a file that holds its limits.

use std::fmt;

use super::decider::Decider;
use super::finish::{KEPT, Made, build, finish};
use super::proportions::{COUNTS, LENGTHS, OUTSIDES, THICKER, draft, lengthen, longest_m, spaces_m};
use super::requirements::{BadRequirement, Requirements};
use crate::design::Draft;
use crate::margin::{Capacities, KEEP_CONTACT, LIFT_OFF, When, load_margins};
use crate::numeric::rounded;
use crate::scenario::Settings;
use crate::wedge::Effort;
use rayon::prelude::*;

/// Thinnest race over the race space, where an outer diameter or the outer track is asked for: a choice.
const WALL: f64 = 0.25;

/// One race space as tried.
#[derive(Debug, Clone, PartialEq)]
pub struct Tried {
    /// Race space, m.
    pub space_m: f64,
    /// Sprags.
    pub count: usize,
    /// Length of the sprags, m: that needed, or the longest where none suffices.
    pub length_m: f64,
    /// Volume of the ring from bore to outside, m^3; 0 where it does not carry what is asked.
    pub volume_m3: f64,
    /// Nominal torque that it carries at that length with all limits kept, N m.
    pub carries_nm: f64,
    /// The limit with the least margin, or what else stands in the way.
    pub decided_by: Decider,
    /// Least outer diameter that its walls ask for, m.
    pub outside_m: f64,
    /// Whether it carries what is asked.
    pub held: bool,
    /// The design, where it does.
    pub made: Option<Made>,
}

/// A design that does what is asked.
#[derive(Debug, Clone, PartialEq)]
pub struct Sized {
    /// The design, with its margins, mass and drag.
    pub made: Made,
    /// Race spaces tried, the one taken among them.
    pub tried: Vec<Tried>,
    /// Index of the one taken: the smallest volume.
    pub taken: usize,
}

/// A clutch that does it beyond a size that was asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WouldDo {
    /// Its outer diameter, m, where it is that which is larger.
    pub outside_m: Option<f64>,
    /// Its width, m, where it is that which is larger.
    pub width_m: Option<f64>,
}

/// Why there is none.
#[derive(Debug, Clone, PartialEq)]
pub enum NoSize {
    /// The question.
    Requirements(BadRequirement),
    /// No race space does it.
    None {
        /// Those tried.
        tried: Vec<Tried>,
        /// What would do where a size that was asked for is left out.
        freed: Vec<WouldDo>,
    },
}

impl fmt::Display for NoSize {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Requirements(why) => write!(f, "{why}"),
            Self::None { tried, freed } => {
                let best = tried.iter().max_by(|a, b| a.carries_nm.total_cmp(&b.carries_nm));
                let nearest = best.filter(|b| b.carries_nm > 0.0);
                match nearest {
                    Some(b) => write!(
                        f,
                        "no clutch of this family does it; the nearest carries {} Nm with {} sprags of {:.1} mm in a race space of \
                         {:.2} mm, stopped by {}",
                        rounded(b.carries_nm, 4),
                        b.count,
                        b.length_m * 1e3,
                        b.space_m * 1e3,
                        b.decided_by
                    ),
                    None => write!(f, "no clutch of this family fits this bore:{}", first_reason(tried)),
                }?;
                let end = if nearest.is_some() { "; " } else { "\n" };
                match freed.as_slice() {
                    [] => Ok(()),
                    some => {
                        let each: Vec<String> = some.iter().map(WouldDo::to_string).collect();
                        write!(f, "{end}what would do: {}", each.join(", or "))
                    }
                }
            }
        }
    }
}

impl fmt::Display for WouldDo {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let more = [("outside", self.outside_m), ("width", self.width_m)];
        let each: Vec<String> = more
            .into_iter()
            .filter_map(|(key, m)| Some(format!("`{key}` {} mm", (m? * 1e4 - 1e-6).ceil() / 10.0)))
            .collect();
        f.write_str(&each.join(" with "))
    }
}

fn first_reason(tried: &[Tried]) -> String {
    let why = |t: &Tried| {
        match &t.decided_by {
        Decider::Count => format!("room for {} sprags, the family has {} to {}", t.count, COUNTS.0, COUNTS.1),
        Decider::Width => {
            format!("sprags as long as the race space are wider than `width` leaves ({} sprags)", t.count)
        }
        Decider::Bore => "the inner race would be too thin about the bore".to_owned(),
        Decider::Outside => format!(
            "the outer race would be too thin within `outside`; from {:.1} mm on it would not",
            (t.outside_m * 1e4).ceil() / 10.0
        ),
        Decider::Flanks => "no flanks (the sides of the body between the profiles) fit".to_owned(),
        one if one.limit() == Some(&LIFT_OFF) => "neither a softer spring nor a heavier front side (flank) of the body lets the sprags off by that speed".to_owned(),
        one if one.limit() == Some(&KEEP_CONTACT) => {
            "a spring that holds the sprags against their centrifugal moment drags too much".to_owned()
        }
        other => other.to_string(),
    }
    };
    tried.iter().map(|t| format!("\n  race space {:.2} mm: {}", t.space_m * 1e3, why(t))).collect()
}

impl std::error::Error for NoSize {}

/// Least margin of the load state and its code; that of the sprags' grip and stress, not of the spring at speed. By a quick curve:
/// what is taken is built anew in full.
fn least(draft: &Draft) -> Result<(f64, Decider), Decider> {
    let (design, state) = build(draft, Effort::Sketch)?;
    let rows = load_margins(&design, &design.limits, Capacities::LeftOut, &state);
    let rows = rows.iter().filter(|r| r.required && r.limit.when != When::Overrun);
    let worst = rows.min_by(|a, b| a.margin().total_cmp(&b.margin()));
    Ok(worst.map_or((0.0, Decider::Nothing), |r| (r.margin(), Decider::row(r))))
}

/// Find a design for `wanted`. Every race space of the family is tried, with outer races as thick as the maker's and thinner; that of
/// the smallest volume is taken.
///
/// # Errors
/// [`NoSize`].
pub fn size(wanted: &Requirements, settings: &Settings) -> Result<Sized, NoSize> {
    wanted.check().map_err(NoSize::Requirements)?;
    found(wanted, settings).map_err(|tried| NoSize::None { tried, freed: freed(wanted, settings) })
}

/// The smallest of every race space, or those tried.
fn found(wanted: &Requirements, settings: &Settings) -> Result<Sized, Vec<Tried>> {
    let tried: Vec<Tried> =
        spaces_m(wanted).into_par_iter().filter_map(|space_m| smallest(wanted, space_m, settings)).collect();
    let made = tried.iter().enumerate().filter_map(|(i, t)| Some((i, t.volume_m3, t.made.clone()?)));
    match made.min_by(|a, b| a.1.total_cmp(&b.1)) {
        Some((taken, _, made)) => Ok(Sized { made, tried, taken }),
        None => Err(tried),
    }
}

/// What does it without each of the sizes that were asked for, and, where neither alone is enough, without both.
fn freed(wanted: &Requirements, settings: &Settings) -> Vec<WouldDo> {
    let without = |outside: bool, width: bool| {
        let free = Requirements {
            outside_m: wanted.outside_m.filter(|_| !outside),
            width_m: wanted.width_m.filter(|_| !width),
            ..*wanted
        };
        let sizes_m = |asked: &Requirements| {
            let races = found(asked, settings).ok()?.made.design.clutch.races;
            Some([2.0 * races.outer_outside_radius_m, races.width_m])
        };
        let found_m = sizes_m(&free)?;
        // That of the smallest volume need not be the smallest.
        let within_m = |of: usize, most_m: f64| {
            let mut asked = free;
            *[&mut asked.outside_m, &mut asked.width_m][of] = Some(most_m);
            Some(sizes_m(&asked)?[of])
        };
        let [outside_m, width_m] = [wanted.outside_m, wanted.width_m];
        let [outside_m, width_m] = [(0, outside_m), (1, width_m)].map(|(of, too_little_m)| {
            let (too_little_m, enough_m) = (too_little_m?, found_m[of]);
            let one = outside != width;
            let least_m = || closed_in(too_little_m, enough_m, |most_m| within_m(of, most_m));
            (enough_m > too_little_m).then(|| if one { least_m() } else { enough_m })
        });
        Some(WouldDo { outside_m, width_m })
    };
    let asked = [wanted.outside_m.is_some(), wanted.width_m.is_some()];
    let one = [(true, false), (false, true)].into_iter().zip(asked).filter(|(_, asked)| *asked);
    let one: Vec<WouldDo> = one.filter_map(|((outside, width), _)| without(outside, width)).collect();
    match one.is_empty() && asked == [true, true] {
        true => without(true, true).into_iter().collect(),
        false => one,
    }
}

/// How near the size that would do is to the least one, as a part of it.
const NEAR: f64 = 0.01;

/// About the least size between one that is too little and one that is enough, m; `within`: that of a clutch within such a size.
fn closed_in(mut too_little_m: f64, mut enough_m: f64, within: impl Fn(f64) -> Option<f64>) -> f64 {
    while enough_m - too_little_m > NEAR * enough_m {
        let middle_m = 0.5 * (too_little_m + enough_m);
        match within(middle_m) {
            Some(m) => enough_m = m.min(middle_m),
            None => too_little_m = middle_m,
        }
    }
    enough_m
}

/// The smallest ring of this race space; where none does it, the one that carries most.
fn smallest(wanted: &Requirements, space_m: f64, settings: &Settings) -> Option<Tried> {
    let mut best: Option<Tried> = None;
    // Tracks that are asked for leave one inner wall.
    let given = wanted.inner_track_m.or(wanted.outer_track_m).is_some();
    let inner_walls = THICKER.into_iter().take(if given { 1 } else { THICKER.len() });
    for walls in inner_walls.flat_map(|wall| OUTSIDES.map(|outside| [wall, outside])) {
        let mut draft = draft(wanted, space_m, walls);
        let mut one = width(wanted, &mut draft, space_m);
        // Scenes ask for more width, never for less.
        let smaller = |than: &Tried| !than.held || volume_m3(draft.races_m, draft.width_m) < than.volume_m3;
        if one.held && best.as_ref().is_none_or(smaller) {
            match finish(wanted, draft, settings) {
                Ok(made) => one.take(made),
                Err(why) => (one.held, one.decided_by) = (false, why),
            }
        } else if one.held {
            continue;
        }
        let better = |than: &Tried| match (one.held, than.held) {
            (true, true) => one.volume_m3 < than.volume_m3,
            (false, false) => one.carries_nm > than.carries_nm,
            (held, _) => held,
        };
        if best.as_ref().is_none_or(better) {
            best = Some(one);
        }
    }
    best
}

/// Of the ring from bore to outside, m^3.
fn volume_m3([bore, .., outside]: [f64; 4], width_m: f64) -> f64 {
    std::f64::consts::PI * (outside * outside - bore * bore) * width_m
}

impl Tried {
    /// What came of it: the count and length that neighbours and scenes asked for.
    fn take(&mut self, made: Made) {
        let (s, r) = (&made.design.clutch.sprags, &made.design.clutch.races);
        (self.count, self.length_m) = (s.count, s.length_m);
        let radii_m = [r.inner_bore_radius_m, r.inner_radius_m, r.outer_radius_m, r.outer_outside_radius_m];
        self.volume_m3 = volume_m3(radii_m, r.width_m);
        if let Some(least) = made.least() {
            self.decided_by = Decider::row(least);
        }
        self.made = Some(made);
    }
}

/// Shortest sprags that keep every limit, put into `draft`.
fn width(wanted: &Requirements, draft: &mut Draft, space_m: f64) -> Tried {
    let (low, high) = (LENGTHS.0 * space_m, longest_m(wanted, space_m));
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
        decided_by: Decider::Nothing,
        outside_m: 2.0 * (draft.races_m[2] + WALL * space_m),
        held: false,
        made: None,
    };
    let wall = draft.races_m[3] - draft.races_m[2];
    let inner_wall = draft.races_m[1] - draft.races_m[0];
    let in_the_way = [
        (Decider::Count, !(COUNTS.0..=COUNTS.1).contains(&draft.count)),
        (Decider::Width, high < low),
        (Decider::Bore, wanted.inner_track_m.is_none() && inner_wall < WALL * space_m),
        (Decider::Outside, wall < WALL * space_m),
    ];
    if let Some((what, _)) = in_the_way.into_iter().find(|(_, bars)| *bars) {
        one.decided_by = what;
        return one;
    }
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
    lengthen(draft, ((long / step - 1e-6).ceil() * step).min(high));
    one.length_m = draft.length_m;
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
