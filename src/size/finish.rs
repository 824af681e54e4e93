//! From a width that holds to a whole design: profile's end, flanks, spring, scenes, and what comes of it.

use super::decider::Decider;
use super::proportions::{COUNTS, lengthen, longest_m, spring};
use super::purpose::{CREST_S, DRIVE_HZ, STOP, overrun};
use super::requirements::{NAMED, Requirements};
use crate::clutch::Clutch;
use crate::design::{BOX, Design, Draft, RESERVE, rpm};
use crate::margin::{
    Capacities, KEEP_CONTACT, LIFT_OFF, LoadState, Margin, load_margins, load_state_at, margins, overrun_at,
};
use crate::numeric::rounded;
use crate::profile::{Outline, Profile};
use crate::scenario::Settings;
use crate::wedge::Effort;
use std::f64::consts::TAU;

/// Margin that a first design keeps on every limit.
pub(super) const KEPT: f64 = RESERVE;

/// By how much one race of a first design may be warmer than the other without that the sprags lose their surface below peak torque, K: a
/// choice.
pub const WARMER_K: f64 = 30.0;

/// Largest drag of the spring in overrun over the nominal torque.
const DRAG: f64 = 0.02;

/// Lightest spring over that of the series, where sprags are to lift off: a choice; `designs/starter.toml` has 0.3.
const LIGHTEST: f64 = 0.25;

/// What the sprags drag in overrun.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drag {
    /// Of the whole clutch, N m; 0: the sprags are off the inner race.
    pub torque_nm: f64,
    /// Speed at which the races slide past one another, rad/s.
    pub sliding_rad_s: f64,
}

impl Drag {
    /// Heat that it makes, W.
    pub fn heat_w(&self) -> f64 {
        self.torque_nm * self.sliding_rad_s
    }
}

/// A design that holds, with what an engineer asks of it first.
#[derive(Debug, Clone, PartialEq)]
pub struct Made {
    /// The design.
    pub design: Design,
    /// Every margin with its scenarios.
    pub margins: Vec<Margin>,
    /// Its mass, kg.
    pub mass_kg: f64,
    /// In the overrun asked for, slow where none is; `None` where there is no first contact at that speed.
    pub drag: Option<Drag>,
}

impl Made {
    /// The required limit with the least margin.
    pub fn least(&self) -> Option<&Margin> {
        self.margins.iter().filter(|r| r.required).min_by(|a, b| a.margin().total_cmp(&b.margin()))
    }
}

fn read(draft: &Draft) -> Result<Design, Decider> {
    Design::parse(&draft.to_toml(), "sized.toml").map_err(|e| match e.problems().first() {
        Some(p) => Decider::Refused { key: p.key.clone(), allowed: p.allowed.clone() },
        None => Decider::words(e),
    })
}

/// A draft as a design with its load state, its curve built with `effort`.
pub(super) fn build(draft: &Draft, effort: Effort) -> Result<(Design, LoadState), Decider> {
    let design = read(draft)?;
    let state = load_state_at(&design, effort).map_err(Decider::words)?;
    Ok((design, state))
}

/// Profile's end, flanks, spring and scenes; then every margin.
pub(super) fn finish(wanted: &Requirements, mut draft: Draft, settings: &Settings) -> Result<Made, Decider> {
    const ROUNDS: usize = 6;
    // Steps of the length.
    const LONGER: f64 = 1.06;
    const HEAVIER: f64 = 1.18;
    let mut why = Decider::Nothing;
    for _ in 0..ROUNDS {
        let mut longer = LONGER;
        draft.flanks_m = None;
        draft.until_rad = 1.2;
        let (design, state) = build(&draft, Effort::Full)?;
        let [nominal, peak] = [(0, "nominal"), (1, "peak")].map(|(which, name)| {
            let ends = || Decider::Words(format!("the curve ends below {name} torque"));
            state.curve.at_torque(draft.torques_nm[which]).ok_or_else(ends)
        });
        let (peak, nominal) = (peak?, nominal?);
        // A sprag is no needle: at least a fifth of the race space to either side, where the arcs reach that far.
        let space = draft.races_m[2] - draft.races_m[1];
        let least_half = (0.2 * space).min(0.8 * draft.inner_radius_m);
        let expansion_per_k = draft.steel.expansion_per_k;
        let (until_rad, [rear, front]) = closed(&design.clutch, peak.contact_turn_rad, expansion_per_k)?;
        draft.until_rad = until_rad;
        draft.flanks_m = Some((rear.max(least_half), front.max(least_half)));
        let stiffness = nominal.k_secant_nm_per_rad;
        // The drive on the inner race swings against the clutch.
        let inertia = stiffness / (TAU * DRIVE_HZ).powi(2);
        draft.inner_inertia_kg_m2 = Some((
            inertia,
            format!(
                "guess: ring and drive; with the outer race held it would swing on the clutch at {DRIVE_HZ} Hz"
            ),
        ));
        draft.step_duration_s = CREST_S;
        draft.abutment_nm_per_rad = STOP * stiffness;
        draft.name = format!(
            "{}: bore {} mm, {} Nm",
            wanted.purpose.map_or("sized", |p| p.name),
            short(wanted.bore_m * 1e3),
            short(wanted.torque_nm)
        );
        draft.scenes = match wanted.purpose {
            Some(purpose) => purpose.scenes(wanted, stiffness, inertia),
            None => overrun(wanted).into_iter().collect(),
        };
        match sprung(&mut draft).and_then(|()| made(wanted, &mut draft, settings)) {
            Ok(done) => return Ok(done),
            Err(Decider::Refused { key, .. }) if key.starts_with("sprags.count") => {
                draft.count = (draft.count as f64 * 0.95).floor() as usize;
                why = Decider::Words("neighbouring sprags overlap".to_owned());
            }
            Err(row @ Decider::Row(..)) => why = row,
            // Longer sprags are heavier, and the spring's force stays.
            Err(off @ Decider::Spring(limit)) if limit == &LIFT_OFF => (why, longer) = (off, HEAVIER),
            Err(other) => return Err(other),
        }
        if draft.count < COUNTS.0 {
            break;
        }
        // Fewer sprags or dynamics ask for more width.
        let length_m = (longer * draft.length_m * 1e4).ceil() / 1e4;
        lengthen(&mut draft, length_m);
        let most = if wanted.width_m.is_some() { 1.0 } else { 1.2 };
        if draft.length_m > most * longest_m(wanted, space) {
            break;
        }
    }
    Err(why)
}

/// Turn at which the profile ends, and flanks, rear and front, m, for a contact that turns by `turn_rad` at peak torque. Of the turn a third,
/// and a little for small ones, is left; less where no flank would close all sprags of the box that the file gives the optimiser, but no
/// less than what an outer race warmer by [`WARMER_K`] takes: its gap is wider, and the sprags begin further on.
fn closed(clutch: &Clutch, turn_rad: f64, expansion_per_k: f64) -> Result<(f64, [f64; 2]), Decider> {
    const LEFT: [f64; 5] = [1.3, 1.25, 1.2, 1.15, 1.1];
    /// Of the box: all, else a part about the sprag.
    const SHARES: [f64; 4] = [1.0, 0.6, 0.3, 0.1];
    /// What flanks of the box keep of their window at either end.
    const WITHIN: f64 = 0.01;
    let ended = |until_rad: f64, radius: f64, distance: f64| {
        let mut clutch = clutch.clone();
        clutch.sprags.inner_arcs[0].until_rad = until_rad;
        clutch.sprags.inner_arcs[0].radius_m *= radius;
        clutch.sprags.centre_distance_m *= distance;
        clutch.profile()
    };
    let window = |until_rad: f64, share: f64| {
        let mut narrowed = [[0.0_f64, f64::INFINITY]; 2];
        for corner in 0..4 {
            let [radius, distance] =
                [BOX[0][corner % 2], BOX[1][corner / 2]].map(|x| 1.0 + share * (x - 1.0));
            let profile = ended(until_rad, radius, distance).ok()?;
            for (side, [need, reach]) in narrowed.iter_mut().zip(Outline::flank_window(&profile).ok()?) {
                *side = [side[0].max(need), side[1].min(reach)];
            }
        }
        let open = |[need, reach]: &[f64; 2]| need * (1.0 + WITHIN) < reach * (1.0 - WITHIN);
        narrowed.iter().all(open).then_some(narrowed)
    };
    let races = &clutch.races;
    let wider_m = expansion_per_k * WARMER_K * races.outer_radius_m;
    let wide =
        |profile: Profile| profile.reseated(0.0, 0.0, races.inner_radius_m, races.outer_radius_m + wider_m);
    let begins_rad = clutch.profile().and_then(wide).map_err(Decider::words)?.turn_rad;
    let least = (1.0 + KEPT) * turn_rad + begins_rad;
    let end = |left: f64| (left * turn_rad + 0.02).max(least);
    let at = |share: f64| LEFT.into_iter().find_map(|left| Some((end(left), window(end(left), share)?)));
    let found = SHARES.into_iter().find_map(at);
    if let Some((until_rad, window)) = found {
        let profile = ended(until_rad, 1.0, 1.0).map_err(Decider::words)?;
        let (rear, front) = Outline::narrowest_flanks(&profile).map_err(Decider::words)?;
        let within =
            |at: f64, [need, reach]: [f64; 2]| at.clamp(need * (1.0 + WITHIN), reach * (1.0 - WITHIN));
        return Ok((until_rad, [within(rear, window[0]), within(front, window[1])]));
    }
    let until_rad = end(LEFT[0]);
    let profile = ended(until_rad, 1.0, 1.0).map_err(Decider::words)?;
    let (rear, front) = Outline::narrowest_flanks(&profile).map_err(Decider::words)?;
    Ok((until_rad, [rear, front]))
}

/// A spring that holds the sprags to the race up to the one speed, and a front flank and a spring that let them off by the
/// other.
fn sprung(draft: &mut Draft) -> Result<(), Decider> {
    const ROUNDS: usize = 40;
    let slow_n = normal_n(draft);
    for _ in 0..ROUNDS {
        let (design, state) =
            build(draft, Effort::Full).map_err(|why| match (&why, draft.contact_rad_s[1]) {
                // A front flank farther out than the arcs reach.
                (Decider::Refused { key, .. }, Some(_)) if key.starts_with("sprags.flanks") => {
                    Decider::Spring(&LIFT_OFF)
                }
                (Decider::Refused { key, .. }, None) if key.starts_with("sprags.flanks") => Decider::Flanks,
                _ => why,
            })?;
        let rows = load_margins(&design, &design.limits, Capacities::LeftOut, &state);
        let short = |limit| rows.iter().find(|r| r.limit == limit && r.margin() < KEPT);
        // The closing moment is in proportion to the spring's force, but for what growth takes from its angle.
        if let Some(off) = short(&LIFT_OFF) {
            let closing = off.demand_in_unit().unwrap_or(0.0);
            let factor = off.allowable_in_unit() / (1.1 * closing);
            if off.allowable > 0.0 && factor * normal_n(draft) >= LIGHTEST * slow_n {
                spring(draft, factor * normal_n(draft));
            } else if let Some((_, front)) = &mut draft.flanks_m {
                // A centroid farther ahead.
                *front *= 1.04;
                spring(draft, LIGHTEST * slow_n);
            }
        } else if let Some(keep) = short(&KEEP_CONTACT) {
            let opening = keep.demand_in_unit().filter(|_| keep.allowable > 0.0);
            let factor = opening.map_or(4.0, |opening| 1.1 * opening / keep.allowable_in_unit());
            spring(draft, normal_n(draft) * factor.max(1.1));
        } else {
            return Ok(());
        }
        // A spring that holds the sprags against their centrifugal moment would drag too much.
        if draft.drag_nm > DRAG * draft.torques_nm[0] {
            return Err(Decider::Spring(&KEEP_CONTACT));
        }
    }
    Err(Decider::Spring(if draft.contact_rad_s[1].is_some() { &LIFT_OFF } else { &KEEP_CONTACT }))
}

/// Normal force of the spring on a sprag in slow overrun, N: see [`spring`].
fn normal_n(draft: &Draft) -> f64 {
    10.0 * draft.drag_nm / (draft.count as f64 * draft.races_m[1])
}

/// The finished draft with every margin, all held; what it says of itself is what came of it.
fn made(wanted: &Requirements, draft: &mut Draft, settings: &Settings) -> Result<Made, Decider> {
    let (design, state) = build(draft, Effort::Full)?;
    let rows = margins(&design, &design.check_scenarios, settings).map_err(Decider::words)?;
    if let Some(row) = rows.iter().filter(|r| r.required).find(|r| !r.held()) {
        return Err(Decider::row(row));
    }
    let sliding_rad_s = wanted.sliding_rad_s();
    // Where no overrun is asked for: a slow one.
    let outer_rad_s = if sliding_rad_s > 0.0 { wanted.overrun_rad_s[1] } else { 0.0 };
    let drag = overrun_at(&design, &state, outer_rad_s, sliding_rad_s).ok();
    let mut made = Made {
        mass_kg: design.clutch.mass_kg(),
        drag: drag.map(|p| Drag { torque_nm: p.state.drag_torque_nm, sliding_rad_s }),
        design,
        margins: rows,
    };
    draft.why = why_lines(wanted, draft, made.least());
    // The same numbers under other comments.
    made.design = read(draft)?;
    Ok(made)
}

/// How a first design's comment begins that is true no longer once it has been optimised.
pub const NOT_OPTIMISED: &str = "Nothing in it is optimised";

/// For names and comments.
fn short(value: f64) -> f64 {
    rounded(value, 7)
}

fn why_lines(wanted: &Requirements, draft: &Draft, least: Option<&Margin>) -> Vec<String> {
    let rpm = |rad_s: f64| short(rpm(rad_s));
    let mut asked = vec![
        format!("a bore of {} mm", short(wanted.bore_m * 1e3)),
        format!("{} Nm nominal, {} Nm peak", short(wanted.torque_nm), short(wanted.peak_nm)),
        format!("friction {}", short(wanted.friction)),
    ];
    asked.extend(wanted.inner_track_m.map(|m| format!("an inner track of {} mm", short(m * 1e3))));
    asked.extend(wanted.outer_track_m.map(|m| format!("an outer track of {} mm", short(m * 1e3))));
    asked.extend(wanted.outside_m.map(|m| format!("at most {} mm outside", short(m * 1e3))));
    asked.extend(wanted.width_m.map(|m| format!("at most {} mm wide", short(m * 1e3))));
    let by_purpose = |from: &str| if from == NAMED { String::new() } else { format!(" ({from})") };
    let [kept, off] = wanted.contact_from.map(by_purpose);
    asked.extend(
        wanted
            .keep_contact_rad_s
            .filter(|&w| w > 0.0)
            .map(|w| format!("contact kept up to {} rpm{kept}", rpm(w))),
    );
    let of_inner = if wanted.carried { " of the inner race, in a cage that it drives" } else { "" };
    asked.extend(wanted.lift_off_rad_s.map(|w| format!("lifted off by {} rpm{of_inner}{off}", rpm(w))));
    let space_mm = short((draft.races_m[2] - draft.races_m[1]) * 1e3);
    let left = least.map_or_else(String::new, |r| {
        format!(" (least margin {} %, {})", rounded(100.0 * r.margin(), 3), r.code())
    });
    let command = if wanted.purpose.is_some() { "new" } else { "size" };
    let mut lines = vec![
        format!("Written by sprag-design {command} {}", env!("CARGO_PKG_VERSION")),
        format!("Why this file exists: a first design for {}.", asked.join(", ")),
        format!(
            "Race space {space_mm} mm in the proportions of a maker's 8.33 mm series, as wide as its limits ask."
        ),
        format!("{NOT_OPTIMISED}{left}: check, then optimize."),
        format!(
            "Profile and flanks leave room for races of which one is {WARMER_K} K warmer than the other (choice): overrun tells how warm they get."
        ),
    ];
    if let Some(purpose) = wanted.purpose {
        lines.push(format!("For: {}, {}.", purpose.name, purpose.words));
    }
    if let Some(count) = wanted.engagements {
        lines.push(format!(
            "Engagements wanted: {count}, at nominal torque: see [life]. Its size does not follow from them; the command life tells what \
             they do to it."
        ));
    }
    lines
}
