//! Terms left out whose cost grows with the load, at the largest torque of the limits, without one at a pressure: torsion of
//! the races, tension behind the patches, creep, a coefficient that is steel's; and the force at junctions.

use super::left_out::LeftOut;
use crate::clutch::Clutch;
use crate::contact::edge_tension;
use crate::margin::{TrackPatch, track_tension};
use crate::material::{Material, PlaneState};
use crate::report::Unit;
use crate::wedge::{StaticPoint, WedgeCurve, shift_left_out};
use std::f64::consts::PI;

/// Pressure at A at which the costs are named where no torque is asked for, Pa.
const PRESSURE_PA: f64 = 2e9;
/// The steel of the roller law's coefficient (Lundberg and Palmgren 1947; section 6 of the model).
const ROLLER_STEEL: Material =
    Material { youngs_modulus_pa: 206e9, poisson_ratio: 0.3, density_kg_m3: 7850.0 };
/// Difference of E* from which it is named; a choice, the scatter of E among steels.
const SAME_STEEL: f64 = 0.02;

/// A curve and its static state at which costs are named.
pub(super) type AtLoad = (WedgeCurve, StaticPoint);

/// What every answer about `clutch` leaves out of a loaded clutch; fewer terms where it has no curve. `at_load`: its curve and
/// the state at which the costs are named, [`loaded`].
pub(super) fn left_out_under_load(clutch: &Clutch, at_load: Option<&AtLoad>) -> Vec<LeftOut> {
    let mut list: Vec<LeftOut> = other_bodies(clutch).into_iter().collect();
    if let Some((curve, point)) = at_load {
        list.extend(shift(clutch, curve));
        list.extend([torsion(curve, point), tension(clutch, curve, point)]);
        list.extend(creep(clutch, curve, point));
    }
    list
}

/// The static state at `asked_nm`, else at [`PRESSURE_PA`]; at the end of a curve that ends below it.
pub(super) fn loaded(curve: &WedgeCurve, asked_nm: Option<f64>) -> Option<StaticPoint> {
    let contact = &curve.statics().elastic.inner_contact[curve.first_arc()];
    // p_0 goes with the root of N.
    let normal_n = (PRESSURE_PA / contact.peak_pressure_pa(1.0)).powi(2);
    let found = asked_nm.map_or_else(|| curve.at_normal(normal_n), |nm| curve.at_torque(nm));
    found.or_else(|| curve.at_torque(curve.end_torque_nm()))
}

pub(super) fn at(point: &StaticPoint) -> String {
    format!(
        "at {} ({} at the inner contact)",
        Unit::NewtonMetre.show(point.torque_nm, 3),
        Unit::Megapascal.show(point.hertz_inner_pa, 3)
    )
}

/// The force of a contact that straddles a junction, for a law that knows the radius.
fn shift(clutch: &Clutch, curve: &WedgeCurve) -> Option<LeftOut> {
    let law = clutch.contact.facts();
    let off = Some(shift_left_out(curve)).filter(|&off| off > 0.0 && law.knows_radius)?;
    Some(LeftOut::new(
        "shift of the force within a contact that straddles a junction",
        match law.whole_bodies {
            true => {
                "the force lies where a small step of curvature puts it; what is of second order in the step is left out"
            }
            false => {
                "approach and Hertz pressure take the mean curvature under the contact; the force stays at the contact \
                 point, whose passing from arc to arc keeps its jump of the tangent stiffness"
            }
        },
        &format!(
            "{} of tan omega at most, where a junction lies at the contact point (plane contact of these arcs), 0 elsewhere",
            Unit::Percent.show(off, 2)
        ),
    ))
}

fn torsion(curve: &WedgeCurve, point: &StaticPoint) -> LeftOut {
    let elastic = &curve.statics().elastic;
    let turns = [&elastic.inner_race, &elastic.outer_race].map(|race| race.twist_rad_per_nm());
    let whole_rad = point.torque_nm * turns.iter().flatten().sum::<f64>();
    let each = turns.map(|turn| {
        turn.map_or("the shaft's own, along its axis".to_owned(), |per_nm| {
            Unit::Degree.show(point.torque_nm * per_nm, 2)
        })
    });
    LeftOut::new(
        "torsion of the races between track and rim",
        "windup is the turn of track against track; bore and outside, where the torque leaves evenly, turn further by \
         T/(4 pi G w) |1/r1^2 - 1/r2^2| each",
        &format!(
            "{} of windup {}: inner race {}, outer race {}",
            Unit::Percent.show(whole_rad / point.windup_rad, 2),
            at(point),
            each[0],
            each[1]
        ),
    )
}

fn tension(clutch: &Clutch, curve: &WedgeCurve, point: &StaticPoint) -> LeftOut {
    let mu = clutch.friction.static_;
    let elastic = &curve.statics().elastic;
    let places = [
        ("inner", &elastic.inner_race, point.normal_inner_n, point.hertz_inner_pa, point.tan_omega),
        ("outer", &elastic.outer_race, point.normal_outer_n, point.hertz_outer_pa, point.tan_nu),
    ];
    let words = places.map(|(track, race, normal_n, peak_pa, tan)| {
        let tension = edge_tension(peak_pa, tan, mu);
        let half_width_m = 2.0 * normal_n / (PI * clutch.contact_length_m() * peak_pa);
        let count = clutch.sprags.count;
        let patch = TrackPatch { count, normal_n, tan, half_width_m, peak_pa, friction: mu };
        let most = track_tension(race, &patch, |t| t.standing_pa.max(t.rolling_pa));
        format!(
            "{track} track: traction alone {} (no rolling) to {} (steady rolling); ring and traction together {} or less, {} behind a \
             patch's middle; the ring alone {} between patches",
            Unit::Megapascal.show(tension.standing_pa, 3),
            Unit::Megapascal.show(tension.rolling_pa, 3),
            Unit::Megapascal.show(most.largest_pa, 3),
            Unit::Millimetre.show(most.behind_m, 2),
            Unit::Megapascal.show(race.hoop_between_pa(count, normal_n), 3),
        )
    });
    LeftOut::new(
        "tension of the traction behind the patches",
        "hoop stress is the ring's own; the tangential force adds tension at the trailing edge of a patch",
        &format!("{}, static friction {mu}: {}", at(point), words.join("; ")),
    )
}

/// Loss of a law whose contacts creep.
fn creep(clutch: &Clutch, curve: &WedgeCurve, point: &StaticPoint) -> Option<LeftOut> {
    let loss = curve.creep_loss(point.normal_inner_n)?;
    let r = &clutch.races;
    let inertia = 1.0 / (1.0 / r.inner_inertia_kg_m2 + 1.0 / r.outer_inertia_kg_m2);
    let viscous = 0.5 * r.viscous_damping_nm_s_per_rad / (point.k_tangent_nm_per_rad * inertia).sqrt();
    Some(LeftOut::new(
        "loss by creep of the rolling contacts",
        "the curve is that of a rising load; a falling one creeps on, while scenes go both ways on the curve",
        &format!(
            "{} of the work of a rise and a fall {}: damping ratio {:.1e} (viscous damping of the races {:.1e}); windup \
             {} more back at no load",
            Unit::Percent.show(2.0 * loss.lost_j / loss.work_j, 2),
            at(point),
            loss.damping_ratio(),
            viscous,
            Unit::Degree.show(loss.lead_rad, 2)
        ),
    ))
}

/// A coefficient of the roller law on bodies that are not of its steel.
fn other_bodies(clutch: &Clutch) -> Option<LeftOut> {
    let law = clutch.contact.facts();
    let m = &clutch.materials;
    let steel = PlaneState::Strain.contact_modulus_pa(&ROLLER_STEEL, &ROLLER_STEEL);
    let softer = [m.inner_race, m.outer_race]
        .map(|race| steel / PlaneState::Strain.contact_modulus_pa(&m.sprag, &race));
    if !law.overlaps_body || softer.iter().all(|ratio| (ratio - 1.0).abs() < SAME_STEEL) {
        return None;
    }
    // delta goes with E*^-0.9.
    let share = softer.map(|ratio| Unit::Percent.show(ratio.powf(0.9) - 1.0, 2));
    Some(LeftOut::new(
        "elastic constants in the approach",
        "the coefficient of the roller and slice laws is that of steel on steel, whatever the bodies; Lundberg and \
         Palmgren's approach goes with E*^-0.9",
        &format!("approach at the inner contact to be raised by {}, at the outer by {}", share[0], share[1]),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answer::left_out::left_out;
    use crate::clutch::ContactLaw;
    use crate::design::Design;

    #[test]
    fn a_solid_shaft_of_another_steel_is_named_with_its_figures() {
        let text = include_str!("../../tests/reference/soft_shaft.toml");
        let mut clutch = Design::parse(text, "soft").unwrap().clutch;
        let list = left_out(&clutch, None);
        let cost = |word: &str, list: &[LeftOut]| {
            list.iter().find(|t| t.term.contains(word)).map(|t| t.cost.clone())
        };
        assert!(cost("torsion", &list).unwrap().contains("the shaft's own"));
        assert!(cost("tension", &list).unwrap().contains("static friction"));
        assert!(cost("creep", &list).unwrap().contains("damping ratio"));
        // The law elastic has no coefficient.
        assert_eq!(cost("elastic constants", &list), None);
        clutch.contact = ContactLaw::Roller { coefficient: 3.84e-5 };
        let list = left_out(&clutch, None);
        assert!(cost("elastic constants", &list).is_some() && cost("creep", &list).is_none());
    }

    #[test]
    fn torsion_of_table_1_is_the_tenth_of_a_percent_of_finite_elements() {
        let text = include_str!("../../designs/huang2017-single-arc.toml");
        let clutch = Design::parse(text, "single").unwrap().clutch;
        let curve = WedgeCurve::build(&clutch, &clutch.profile().unwrap(), 0.0).unwrap();
        let point = curve.at_torque(16.8).unwrap();
        let elastic = &curve.statics().elastic;
        let turn: f64 =
            [&elastic.inner_race, &elastic.outer_race].iter().filter_map(|r| r.twist_rad_per_nm()).sum();
        let share = 16.8 * turn / point.windup_rad;
        assert!((0.0005..0.002).contains(&share), "{share}");
    }
}
