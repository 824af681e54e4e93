//! What the model leaves out, why, and what that costs: every answer says it.

use super::alike::{ECCENTRIC, UNEQUAL, left_out_of_alike};
use super::under_load::{AtLoad, left_out_under_load, loaded};
use crate::clutch::{Clutch, ContactLaw};
use crate::design::Design;
use crate::report::Unit;
use crate::wedge::{WedgeCurve, even_load_error, straddling_error};
use serde::Serialize;

/// One term left out.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LeftOut {
    /// The term.
    pub term: String,
    /// Why it is left out.
    pub why: String,
    /// What that costs, with its source; "not estimated" where nobody knows.
    pub cost: String,
}

impl LeftOut {
    /// An entry.
    pub fn new(term: &str, why: &str, cost: &str) -> Self {
        Self { term: term.to_owned(), why: why.to_owned(), cost: cost.to_owned() }
    }
}

/// What is left out of a cage that the inner race drives, whose springs press with `spring_nm` (N m) at most; `as_carried`: of sprags that
/// it carries.
pub fn left_out_of_driven_cage(spring_nm: f64, as_carried: &str) -> LeftOut {
    LeftOut::new(
        "what the driven cage does to the sprags",
        &format!(
            "its inertia is the inner race's; its pockets leave sprags under load their play, none to those that it carries{as_carried} the \
             spring reacts as on a free cage"
        ),
        &format!("at most {} of the clutch while A carries", Unit::NewtonMetre.show(spring_nm, 2)),
    )
}

/// What every answer about `design` leaves out, at the largest torque of its limits.
pub fn left_out_of(design: &Design) -> Vec<LeftOut> {
    left_out(&design.clutch, design.limits.largest_torque_nm())
}

/// What every answer leaves out: the paper's three standing assumptions, then the terms of the bodies and of
/// the contact law of `clutch`; what grows with the load is named at `asked_nm`, N m, of the whole clutch.
pub fn left_out(clutch: &Clutch, asked_nm: Option<f64>) -> Vec<LeftOut> {
    let at_load = at_load(clutch, asked_nm);
    let mut list = left_out_of_alike(clutch, at_load.as_ref()).to_vec();
    list.extend(left_out_of_bodies(clutch, at_load.as_ref()));
    list
}

/// The curve of `clutch` and the state at which costs are named.
fn at_load(clutch: &Clutch, asked_nm: Option<f64>) -> Option<AtLoad> {
    let curve = WedgeCurve::build(clutch, &clutch.profile().ok()?, 0.0).ok()?;
    let point = loaded(&curve, asked_nm)?;
    Some((curve, point))
}

/// The terms of the bodies and of the contact law.
fn left_out_of_bodies(clutch: &Clutch, at_load: Option<&AtLoad>) -> Vec<LeftOut> {
    let mut list = Vec::new();
    let law = clutch.contact.facts();
    if !law.whole_bodies {
        list.push(LeftOut::new(
            "bending of the rings between the sprags in windup",
            "growth is Lame's mean under evenly spread pressure, (5); hoop stress is given with bending beside the mean",
            "growth agrees with finite elements to 0.3 % (clutch of Table 1)",
        ));
    }
    list.extend(match (clutch.sprags.inner_arcs.len(), law.knows_radius) {
        (1, _) => Some(LeftOut::new(
            "junctions and the mean curvature under a contact",
            "one arc has one radius",
            "0: nothing is lost",
        )),
        // Named with the load at which it counts.
        (_, true) => None,
        (_, false) => Some(LeftOut::new(
            "curvature in the approach",
            "the law knows the radius not at all, or (slices) through the half width alone",
            "at junctions delta_H of a law that knows it changes by 0.1 % (clutch of Table 1)",
        )),
    });
    list.extend(spiral(clutch));
    list.extend(straddling(clutch));
    list.extend(lengthwise(clutch));
    if clutch.races.inner_bore_radius_m == 0.0 {
        list.push(LeftOut::new("bore of the inner race", "a solid shaft has none", "0: nothing is lost"));
    }
    if clutch.sprags.width_m > 0.0 && law.overlaps_body {
        list.push(LeftOut::new(
            "overlap of the contact law with the compression of the body, (6)",
            "both are added as the paper does, although a roller law seems to hold the bulk already",
            "windup 12-13 % too large (finite elements, clutch of Table 1); forces agree to 0.5-1.5 %",
        ));
    }
    if law.whole_bodies && clutch.sprags.flanks.is_none() {
        list.push(LeftOut::new(
            "outline of the sprag",
            "a design without flanks has none: the sprag is taken for a disc as high as the race space",
            "windup up to 2 % too small, tan omega 0.8 % too large (finite elements, sprags 0.4 as wide as high)",
        ));
    }
    list.extend(left_out_under_load(clutch, at_load));
    list
}

/// The same where every sprag was looked at in its own gap: `instead` of the two assumptions that this lifts.
pub fn off_centre(list: Vec<LeftOut>, instead: &[LeftOut]) -> Vec<LeftOut> {
    let lifted = [UNEQUAL, ECCENTRIC];
    let kept = list.into_iter().filter(|e| !lifted.contains(&e.term.as_str()));
    kept.chain(instead.iter().cloned()).collect()
}

/// What an answer about `design` leaves out that looked at every sprag by itself: `instead` of all three assumptions of the paper.
pub fn one_by_one(design: &Design, instead: Vec<LeftOut>) -> Vec<LeftOut> {
    let at_load = at_load(&design.clutch, design.limits.largest_torque_nm());
    let mut list = left_out_of_bodies(&design.clutch, at_load.as_ref());
    list.extend(instead);
    list
}

/// What arcs leave out of a spiral.
fn spiral(clutch: &Clutch) -> Option<LeftOut> {
    let spiral = clutch.sprags.spiral?;
    let off = spiral.deviation();
    let tan = spiral.tan_omega_off(&clutch.profile().ok()?)?;
    Some(LeftOut::new(
        "spiral of the inner profile",
        &format!(
            "{} tangent arcs stand for it, of which each pair begins and ends on it",
            spiral.arc_count()
        ),
        &format!(
            "{} in position, tan omega {} of itself, radii {} and peak pressures half of that, at most",
            Unit::Micrometre.show(off.position_m, 6),
            Unit::Percent.show(tan, 4),
            Unit::Percent.show(off.radius, 3)
        ),
    ))
}

/// What the peak pressure leaves out at junctions.
fn straddling(clutch: &Clutch) -> Option<LeftOut> {
    let error = Some(straddling_error(clutch)).filter(|&e| e > 0.0)?;
    Some(LeftOut::new(
        "shape of the pressure in a contact that straddles a junction",
        "the peak is that of one arc with the mean curvature under the contact",
        &format!(
            "inner Hertz pressure off by {} at most while a junction lies under the contact (plane contact of these arcs), 0 \
             elsewhere",
            Unit::Percent.show(error, 2)
        ),
    ))
}

/// What is left out along the axis.
fn lengthwise(clutch: &Clutch) -> Option<LeftOut> {
    let slices = matches!(clutch.contact, ContactLaw::Slice { .. });
    match (clutch.axial.is_straight(), clutch.contact.facts().knows_shape) {
        (true, _) if slices => None,
        (true, _) => Some(LeftOut::new(
            "slices",
            "no tilt, no end profile: the contact law spreads the load evenly along the sprag",
            &format!(
                "approach: slices come {} nearer (inner contact at 2 GPa); edge pressure: not computed, --pressure of \
                 `stiffness` asks for it",
                even_load_error(clutch).map_or("not estimated".to_owned(), |e| Unit::Percent.show(e, 2))
            ),
        )),
        (false, true) => None,
        (false, false) => Some(LeftOut::new(
            "tilt and end profile of the sprags in the approach",
            "the roller laws spread the load evenly; the pressure along the contact knows the shape",
            "`stiffness --contact slice` has the approach with it",
        )),
    }
}

/// What curves at rest leave out beside that.
pub fn at_rest() -> LeftOut {
    LeftOut::new(
        "growth of the outer race at speed, (7), and the centrifugal force of the sprags",
        "these curves are at rest",
        "0 at rest; scenarios with a speed have both",
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::Design;

    #[test]
    fn the_standing_assumptions_come_first_and_slices_only_without_slices() {
        let text = include_str!("../../designs/huang2017-multi-arc.toml");
        let mut clutch = Design::parse(text, "multi-arc").unwrap().clutch;
        let list = left_out(&clutch, None);
        for (entry, word) in list.iter().zip(["simultaneously", "same force", "concentric"]) {
            assert!(entry.why.contains(word), "{entry:?}");
        }
        assert!(list.iter().all(|e| !e.cost.is_empty()) && list.iter().any(|e| e.term == "slices"));
        clutch.contact = ContactLaw::Slice { coefficient: 3.944e-5 };
        assert!(left_out(&clutch, None).iter().all(|e| e.term != "slices"));
        // Of Table 1's clutch slices are some 2 % nearer.
        let cost = crate::wedge::even_load_error(&clutch).unwrap();
        assert!((0.015..0.026).contains(&cost), "{cost}");
    }
}
