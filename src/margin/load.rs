//! Limits that follow from the static load state, first contact and overrun.

use super::capacity::axial_from_nm;
use super::held::held;
use super::overrun::overrun_moments;
use super::sprag::GRIP;
use super::{Margin, NoMargins, curve_at_rest, ratio};
use crate::design::{Design, Limits};
use crate::dynamics::alpha_max_rad;
use crate::profile::{Outline, Profile, clearance_m};
use crate::wedge::{EndReason, StaticPoint, WedgeCurve};

/// What the static limits are read from: the wedge without its energizing spring, which at such torques presses by parts in
/// ten thousand harder and lowers |T|/N.
#[derive(Debug, Clone)]
pub struct LoadState {
    /// Placed profile.
    pub profile: Profile,
    /// Closed outline; absent where the design names no flanks.
    pub outline: Option<Outline>,
    /// Curve at rest.
    pub curve: WedgeCurve,
    /// alpha_max of the spring, rad.
    pub alpha_max_rad: f64,
    /// tan omega at first contact.
    pub first_tan_omega: f64,
}

/// Build it.
///
/// # Errors
/// [`NoMargins`].
pub fn load_state(design: &Design) -> Result<LoadState, NoMargins> {
    let (profile, curve) = curve_at_rest(design)?;
    let flanks = design.clutch.sprags.flanks;
    let outline = flanks.map(|f| Outline::closed(&profile, &f)).transpose().map_err(NoMargins::Outline)?;
    let first_tan_omega = curve.touch().t_ratio;
    let alpha_max_rad = alpha_max_rad(&design.clutch, &curve);
    Ok(LoadState { profile, outline, curve, alpha_max_rad, first_tan_omega })
}

pub(super) fn rows(design: &Design, limits: &Limits, state: &LoadState) -> Vec<Margin> {
    let mut rows = Vec::new();
    let mut push = |code: &str, name: &str, demand: f64, allowable: f64, unit, margin: f64| {
        rows.push(Margin {
            code: code.into(),
            name: name.into(),
            demand,
            allowable,
            unit,
            margin,
            torque_capacity_nm: None,
            required: true,
            computed: true,
            overloaded: false,
        });
    };
    let curve = &state.curve;
    let end = curve.end_torque_nm();
    let (mut shown_only, mut not_reached) = (Vec::new(), Vec::new());
    for h in held(design, limits, state) {
        let Some(torque) = h.when.torque_nm(limits) else { continue };
        let p = at(curve, torque);
        let value = (h.demand)(&p);
        let (unit, per_si) = h.unit;
        let margin = beyond(ratio(value, h.allowed), torque, end);
        push(h.code, &said(&(h.name)(&p), torque, end), value * per_si, h.allowed * per_si, unit, margin);
        if !h.required {
            shown_only.push(h.code);
        }
        if end < torque {
            not_reached.push(h.code);
        }
    }
    if let Some(torque) = limits.peak_torque_nm {
        let p = at(curve, torque);
        let over = curve.roll_over_torque_nm();
        let name = said("peak torque against roll-over torque", torque, end);
        push("roll-over", &name, torque, over, "Nm", beyond(over / torque - 1.0, torque, end));
        let below = below(state, &p);
        for limit in &GRIP {
            let Some(mu) = (limit.allowed)(design, limits) else { continue };
            let need = limit.largest(design, limits, &p, &below);
            let name = said((limit.name)(limits), torque, end);
            push(limit.code, &name, need, mu, limit.unit.0, beyond(ratio(need, mu), torque, end));
        }
        if limits.axial_load_n.is_some_and(|n| n > 0.0) {
            let wanted = limits.nominal_torque_nm.unwrap_or(torque);
            let from = axial_from_nm(design, limits, state, torque);
            push(
                "axial-from",
                "torque from which on friction carries the axial load, against nominal torque",
                from.unwrap_or(torque.min(end)),
                wanted,
                "Nm",
                from.map_or(-1.0, |from| ratio(from, wanted)),
            );
            shown_only.push("axial-from");
        }
        if let Some(gap) = clearance_up_to_m(design, state, &p, &below) {
            // Clearance itself, relative to the sprag's height: smooth through contact.
            let height = design.clutch.races.outer_radius_m - design.clutch.races.inner_radius_m;
            push(
                "neighbours",
                &said("clearance between neighbouring sprags up to peak torque", torque, end),
                0.0,
                gap * 1e3,
                "mm",
                beyond(gap / height, torque, end),
            );
        }
        if end < torque {
            not_reached.extend(["roll-over", "grip-inner", "grip-outer", "neighbours"]);
        }
    }
    let kinetic = design.clutch.friction.kinetic;
    let first = state.first_tan_omega;
    push(
        "re-engagement",
        "tan omega at first contact against mu_c",
        first,
        kinetic,
        "1",
        ratio(first, kinetic),
    );
    if let Some(speed) = limits.keep_contact_to_rad_s {
        let (opening, closing) = overrun_moments(design, state, speed);
        push(
            "keep-contact",
            "centrifugal opening moment against spring moment at the keep-contact speed",
            opening * 1e3,
            closing * 1e3,
            "mNm",
            if closing > 0.0 { 1.0 - opening / closing } else { -1.0 },
        );
    }
    if let Some(speed) = limits.lift_off_by_rad_s {
        let (opening, closing) = overrun_moments(design, state, speed);
        push(
            "lift-off",
            "spring moment against centrifugal opening moment at the speed by which the sprags must be off",
            closing * 1e3,
            opening * 1e3,
            "mNm",
            if closing > 0.0 { opening / closing - 1.0 } else { 1.0 },
        );
    }
    for row in &mut rows {
        row.required = !shown_only.contains(&row.code.as_str());
        row.overloaded = not_reached.contains(&row.code.as_str());
    }
    rows
}

/// States looked at between no load and the peak, beside the peak itself: a choice; demands are smooth but at
/// junctions, which divide the curve into a few pieces.
const LOOKS: usize = 24;

/// States below `peak`, rising.
fn below(state: &LoadState, peak: &StaticPoint) -> Vec<StaticPoint> {
    let last_n = peak.normal_inner_n;
    (1..LOOKS).filter_map(|i| state.curve.at_normal(last_n * i as f64 / LOOKS as f64)).collect()
}

/// Clearance between neighbouring sprags in a static state, m; `None` without flanks.
pub(super) fn clearance_at_m(design: &Design, state: &LoadState, p: &StaticPoint) -> Option<f64> {
    let outline = state.outline.as_ref()?;
    let (oc_e, rotation) = match state.curve.closure_at_normal(p.normal_inner_n) {
        Some((_, c)) if p.normal_inner_n > 0.0 => (c.lengths.oc_e.v, c.rotation.v),
        _ => (state.profile.outer_centre_distance_m, 0.0),
    };
    Some(clearance_m(outline, oc_e, rotation, design.clutch.sprags.count))
}

/// The smallest from no load over the states `below` to `peak`.
fn clearance_up_to_m(
    design: &Design,
    state: &LoadState,
    peak: &StaticPoint,
    below: &[StaticPoint],
) -> Option<f64> {
    let all = [&StaticPoint::UNLOADED, peak].into_iter().chain(below);
    all.map(|p| clearance_at_m(design, state, p)).reduce(|a, b| Some(a?.min(b?)))?
}

/// Beyond the curve's end the rows of a torque continue as its shortfall, so that a search sees a slope.
pub(super) fn beyond(margin: f64, torque: f64, end: f64) -> f64 {
    if end >= torque { margin } else { margin.min(end / torque - 1.0) }
}

/// The name of a row, with word that its torque is not carried where the curve ends below it.
pub(super) fn said(name: &str, torque_nm: f64, end_nm: f64) -> String {
    match end_nm >= torque_nm {
        true => name.to_owned(),
        false => format!(
            "{name}: not carried, demand and clearance are those at the end of the curve, {end_nm:.4} Nm, the margin is at most \
             what the torque lacks"
        ),
    }
}

/// Static point at `torque`, or at the curve's end if that comes first.
fn at(curve: &WedgeCurve, torque: f64) -> StaticPoint {
    let last = curve.arc_end_n(curve.arc_count() - 1);
    curve.at_torque(torque).or_else(|| curve.at_normal(last)).unwrap_or(StaticPoint::UNLOADED)
}

/// Whether and where the curve ends below roll-over: for the capacity of the profile itself.
pub(super) fn profile_capacity(state: &LoadState) -> f64 {
    match state.curve.end().0 {
        EndReason::OffProfile => state.curve.end_torque_nm(),
        _ => state.curve.roll_over_torque_nm(),
    }
}
