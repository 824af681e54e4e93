//! Every limit that is held, once: code, key, name, unit, when, allowable, demand, rule of its margin, explanation.

use super::body::body_stress_pa;
use super::hoop::{Which, hoop_pa};
use super::lengthwise::{Reach, largest_pa};
use super::limits::{Limit, Of, When};
use super::load::LoadCase;
use super::row::Rule;
use super::sprag::grip;
use super::subsurface::{case_m, core_allowed, inner, outer, shear_below};
use crate::design::{Design, Limits};
use crate::wedge::{Side, StaticPoint};

const PRESSURE: Limit = Limit {
    code: "",
    key: Some("hertz_nominal_mpa"),
    name: |_| "",
    unit: "MPa",
    per_si: 1e-6,
    when: When::Nominal,
    rule: Rule::Ratio,
    explanation: "Largest pressure p_0 in the contact of one sprag with the race, by Hertz's line contact with the curvature \
                  that the contact law averages over the patch, the largest up to the torque: behind a junction to a far larger radius \
                  it falls while the torque rises. Of single sprags and off centre it is that at the torque. Larger radii of the \
                  arcs, longer or more sprags, or a larger wedge angle lower it.",
    formula: "p_0 = 2 N/(pi a l), a^2 = 4 N R/(pi l E*); 1/R = 1/r_i + 1/R_i inside, 1/r_e - 1/R_e outside; 1/E* = (1 - \
              nu_1^2)/E_1 + (1 - nu_2^2)/E_2",
    source: "Johnson, Contact Mechanics, (4.43) and (4.45)",
    pressed: false,
    ends_curve: false,
    of: Of::Room,
};

const UNLIKE_PRESSURE: Limit = Limit {
    explanation: "Largest pressure p_0 in a contact of any sprag where the table sharing sets them apart or the axes lie apart: sizes, gaps \
                               and places drawn or given, races that bend, run out and give way, over a turn of the races. Closer \
                               tolerances, more or softer sprags, stiffer races lower it.",
    formula: "p_0 of each sprag k with its own N_k and radii; sum of its torques = torque, forces on both races in balance",
    source: "this project: sprags one by one; Johnson (4.45)",
    of: Of::UnlikePressure,
    ..PRESSURE
};

const ALONG: Limit = Limit {
    key: Some("along_mpa"),
    when: When::Peak,
    explanation: "Largest pressure along a contact, by slices with end profile and tilt, in its middle half or in the quarters beside it: a \
                  profile that drops more unloads the ends and presses the middle. An end that still bears is sharp: its value \
                  is that of its last slice, and grows with contact.slices.",
    formula: "slices: [S_w]{q} = delta - gap, p_j = sqrt(q_j n E*/(pi R l)), R the one that p_0 = sqrt(N E*/(pi R l)) of the state has",
    source: "Huang 2017, (1)-(4), with end profile; Huang and others 2018 for the aim",
    of: Of::clutch(|_, l| l.along_pa, |c, p| largest_pa(c, p, Side::Inner, Reach::Middle)),
    ..PRESSURE
};

const HOOP: Limit = Limit {
    when: When::Peak,
    explanation: "Hoop stress of the race as a ring under the sprags' mean pressure (Lame), at its bore and track; a fit adds \
                  its own stress, and the larger magnitude, loaded or at rest, counts. A thicker race or a larger \
                  wedge angle lowers it.",
    formula: "p = n_s N/(2 pi R w); outer race p (R_ed^2 + R_e^2)/(R_ed^2 - R_e^2) at its track, inner race -2 p \
              R_i^2/(R_i^2 - R_id^2) at its bore; a rim that the design holds: Lame's ring with that rim unmoved",
    source: "Lame; Timoshenko, Strength of Materials II, art. 41",
    ..PRESSURE
};

const BENDING: Limit = Limit {
    explanation: "Hoop stress of the race with the bending between the sprags, which press at single places: the mean of Lame \
                  and what a ring under evenly spaced forces bends. Shown only where the file limits the mean stress alone, as makers' \
                  allowed stresses do; its own key makes it count. More sprags or a thicker race lower it.",
    formula: "Lame's mean + sum over k of the ring's hoop stress under the wave cos(k n_s phi) of the sprags' forces",
    source: "Michell's ring; Timoshenko and Goodier, Theory of Elasticity",
    ..HOOP
};

const SHEAR: Limit = Limit {
    key: Some("case_shear_mpa"),
    when: When::Peak,
    explanation: "Largest shear stress below the contact, 0.300 p_0 at 0.786 half widths for Hertz's line contact: it starts \
                  pitting in the hardened case. What lowers the Hertz pressure lowers it.",
    formula: "tau = (p_0/a) (z - z^2/sqrt(a^2 + z^2)), largest at z = 0.786 a: 0.300 p_0",
    source: "Johnson, Contact Mechanics, (4.46)",
    of: Of::shear(|_, l| l.case_shear_pa, |c, p| shear_below(c, inner(p), 0.0)),
    ..PRESSURE
};

const CORE: Limit = Limit {
    key: Some("core_shear_mpa"),
    explanation: "Largest shear stress below the contact at the depth of the hardened case and deeper, where the soft core \
                  bears it (Hertz's line contact). A deeper case or a lower pressure lowers it.",
    formula: "tau = (p_0/a) (z - z^2/sqrt(a^2 + z^2)) at z = the depth of the case or, where that is deeper, 0.786 a",
    source: "Johnson, Contact Mechanics, (4.46)",
    of: Of::shear(core_allowed, |c, p| shear_below(c, inner(p), case_m(c))),
    ..SHEAR
};

const EQUIVALENT: Limit = Limit {
    explanation: "Equivalent stress (von Mises) of the race under the mean pressure of the sprags on its track, by Lame for a \
                  thick ring. A thicker race or a larger wedge angle lowers it.",
    formula: "sqrt(p^2 + p h + h^2) at the outer race's track, h its hoop stress with that of rotation at at_speed_rpm; 2 p R_i^2/(R_i^2 - R_id^2) at the \
              inner race's bore",
    source: "Lame and von Mises; Timoshenko, Strength of Materials II, art. 41",
    ..PRESSURE
};

const GAP: Limit = Limit {
    code: "gap-nominal",
    key: Some("gap_nominal_mm"),
    name: |_| "opening of the race gap, nominal torque",
    unit: "mm",
    per_si: 1e3,
    explanation: "What the gap between the tracks opens under load, by the growth of both races, against what the allowed gap \
                  leaves of it above the gap at rest. Thicker races or a larger wedge angle lower it.",
    formula: "N_A c_i + N_B c_e, c = n_s/(2 pi w E) ((R_o^2 + R_b^2)/(R_o^2 - R_b^2) + nu outside, - nu inside)",
    source: "Huang 2017, (5); Lame",
    of: Of::clutch(|d, l| allowed_opening_m(l.gap_nominal_m, d), gap_opening_m),
    ..PRESSURE
};

const GRIP: Limit = Limit {
    code: "grip-inner",
    key: None,
    name: |l| match l.axial_load_n {
        None => "largest static tan omega up to peak torque against mu_s",
        Some(_) => {
            "friction for torque and axial load at A, peak torque, or tan omega below it, against mu_s"
        }
    },
    unit: "1",
    per_si: 1.0,
    when: When::Peak,
    explanation: "Friction that a contact needs to hold its sprag, tangential over normal force, the largest up to peak torque, \
                  against the static coefficient mu_s. An axial load adds to the tangential force as a vector. A smaller wedge \
                  angle lowers it and raises the forces.",
    formula: "tan omega = OB sin beta/(OB cos beta - OA) at A, tan nu = T_B/N_B with T_B = T_A OA/OB at B; with an \
              axial load F_a sqrt(T^2 + (F_a/n_s)^2)/N",
    source: "Huang 2017, (10)",
    of: Of::sprag(static_friction, |d, l, p| grip(d, l, p)[0], Some(|p| p.tan_omega)),
    ..PRESSURE
};

/// The friction that both contacts need at A.
pub(super) static GRIP_INNER: Limit = GRIP;

/// Turn left on the profile.
pub static END_OF_PROFILE: Limit = Limit {
    code: "end-of-profile",
    name: |_| "contact turn on the profile, peak torque",
    unit: "rad",
    explanation: "How far the contact has turned on the sprag's inner arcs at peak torque, against where the last arc ends. A \
                  longer last arc or less windup leaves more.",
    formula: "turn of the sprag - (beta - beta_0) against until_rad of its last inner arc",
    source: "Huang 2017, figure 5",
    ends_curve: true,
    of: Of::sprag(
        |d, _| d.clutch.sprags.inner_arcs.last().map(|a| a.until_rad),
        |_, _, p| p.contact_turn_rad,
        None,
    ),
    ..GRIP
};

/// Contact in overrun.
pub static KEEP_CONTACT: Limit = Limit {
    code: "keep-contact",
    key: Some("keep_contact_to_rpm"),
    name: |_| "centrifugal opening moment against spring moment at the keep-contact speed",
    unit: "mNm",
    per_si: 1e3,
    when: When::Overrun,
    rule: Rule::Share,
    explanation: "Moment of the centrifugal force that lifts a sprag off the inner race in overrun, about its centroid, against \
                  that of the energizing spring, at the speed up to which contact is to be kept. A stiffer spring, or a \
                  centroid less far ahead of the sprag's outer centre, keeps contact. In a [cage] it lifts the sprag off the outer race, \
                  about the pivot, by the inner race's speed.",
    formula: "-h_e m_g OC_g Omega^2/cos gamma against K_r (alpha_max - alpha), both at first contact at that speed; in a cage \
              m_g OC_g OP sin(-pi) Omega^2",
    source: "Huang 2017, (13b), without load at A; in a cage this project",
    of: Of::KeepContact,
    ..GRIP
};

/// No contact in overrun.
pub static LIFT_OFF: Limit = Limit {
    code: "lift-off",
    key: Some("lift_off_by_rpm"),
    name: |_| "spring moment against centrifugal opening moment at the speed by which the sprags must be off",
    rule: Rule::Reserve,
    explanation: "Moment of the energizing spring against that of the centrifugal force, at the overrun speed by which the \
                      sprags are to have lifted off the inner race, in a [cage] off the outer one. A softer spring, or a centroid \
                      farther ahead of the sprag's outer centre, in a cage of the pivot, lifts off earlier.",
    formula: "K_r (alpha_max - alpha) against -h_e m_g OC_g Omega^2/cos gamma, both at first contact at that speed; in a cage \
              m_g OC_g OP sin(-pi) Omega^2",
    source: "Huang 2017, (13b), without load at A; in a cage this project",
    of: Of::LiftOff,
    ..KEEP_CONTACT
};

/// A film between sprag and inner race.
pub static FILM: Limit = Limit {
    code: "film",
    key: Some("film_lambda"),
    name: |_| "wanted ratio of film to roughness against that of the sliding inner contact",
    unit: "1",
    per_si: 1.0,
    when: When::Overrun,
    rule: Rule::Ratio,
    explanation: "Thickness of the oil film at the inner contact, in a [cage] the outer one, over the roughness of both surfaces, in overrun \
                  of the inner race at film_at_rpm: what is wanted against what there is. A thicker or cooler oil, smoother surfaces, longer sprags or a \
                  weaker spring raise it.",
    formula: "lambda = h/sqrt(Rq_sprag^2 + Rq_race^2), h = R U^(1/2) H(M, L), the film where the pressure is largest",
    source: "Moes' line contact (2000); see the command overrun",
    pressed: false,
    ends_curve: false,
    of: Of::Film,
};

/// Friction that a scenario needs.
pub static SLIP: Limit = Limit {
    code: "slip",
    key: Some("slip_margin"),
    name: |_| "friction that {scene} needs to stick; its slip margin is mu_s over it, less 1",
    when: When::Scene,
    rule: Rule::Slip,
    explanation: "Static friction from which on the scenario sticks throughout, by a run that rolls without slip, or by \
                  bisection where that run unloads the contact. Its slip margin mu_s/mu_required - 1 is compared with the wanted \
                  one, limits.slip_margin. A smaller wedge angle, more preload or more damping raises it.",
    formula: "the largest |T|/N of both contacts while the scenario rolls; margin mu_s/mu_required - 1",
    source: "Huang 2017, (11) to (15), rolling",
    of: Of::Slip,
    ..GRIP
};

/// Normal force in a scenario.
pub static CONTACT: Limit = Limit {
    code: "contact",
    key: None,
    name: |_| "smallest normal force in {scene} over the static one",
    rule: Rule::Itself,
    explanation: "Smallest normal force of the inner contact while the scenario rolls, over a steady one (of an excitation under its mean torque, of a \
                  transient under its largest); below zero the \
                  contact would have to pull, and opens. More preload or a stiffer spring keeps it closed.",
    formula: "least N_A(t) while the scenario rolls/N_A of the static state",
    source: "Huang 2017, (13) to (15), rolling",
    of: Of::Contact,
    ..SLIP
};

const ROOM: Limit = Limit {
    name: |_| "half width left until the flank no longer closes the profile, over the half width",
    when: When::Outline,
    rule: Rule::Difference,
    explanation: "What a flank of the sprag may still move until outline and arcs no longer meet, over its half width, less a \
                  fixed room where flanks are variables. A flank farther out, or arcs that end earlier, leave more. Asked only in a \
                  search, of a design with flanks.",
    formula: "half width of the flank less what outline and arcs need to meet, over that half width",
    source: "geometry of the outline",
    of: Of::Room,
    ..GRIP
};

/// All of them, in the order of the rows.
pub static LIMITS: &[&Limit] = &[
    &Limit {
        code: "hertz-nominal-inner",
        pressed: true,
        name: |_| "Hertz pressure, inner contact, nominal torque",
        of: Of::sprag(|_, l| l.hertz_nominal_pa, |_, _, p| p.hertz_inner_pa, None),
        ..PRESSURE
    },
    &Limit {
        code: "hertz-nominal-outer",
        name: |_| "Hertz pressure, outer contact, nominal torque",
        of: Of::sprag(|_, l| l.hertz_nominal_pa, |_, _, p| p.hertz_outer_pa, None),
        ..PRESSURE
    },
    &GAP,
    &Limit {
        code: "windup-nominal",
        key: Some("windup_nominal_deg"),
        name: |_| "windup, nominal torque",
        unit: "deg",
        per_si: 180.0 / std::f64::consts::PI,
        explanation: "Turn of the races against each other from first contact to nominal torque, by the curve of the wedge. \
                      Stiffer races, more sprags or a larger wedge angle lower it.",
        formula: "windup = sum of dtheta_e - dtheta_i of the sprag rolling on both tracks while N rises",
        source: "Huang 2017, (A.3) and (A.4), corrected",
        of: Of::clutch(|_, l| l.windup_nominal_rad, |_, p| p.windup_rad),
        ..GAP
    },
    &Limit {
        code: "equivalent-inner",
        key: Some("equivalent_inner_mpa"),
        name: |_| "equivalent stress of the inner race, nominal torque",
        of: Of::clutch(
            |_, l| l.equivalent_inner_pa,
            |c, p| c.elastic().inner_race.equivalent_pa(c.count(), p.normal_inner_n),
        ),
        ..EQUIVALENT
    },
    &Limit {
        code: "equivalent-outer",
        key: Some("equivalent_outer_mpa"),
        name: |_| "equivalent stress of the outer race, nominal torque",
        of: Of::clutch(
            |_, l| l.equivalent_outer_pa,
            |c, p| {
                let speed = c.state.curve.speed_rad_s();
                c.elastic().outer_race.turning_equivalent_pa(c.count(), p.normal_outer_n, speed)
            },
        ),
        ..EQUIVALENT
    },
    &Limit {
        code: "gap-peak",
        key: Some("gap_peak_mm"),
        name: |_| "opening of the race gap, peak torque",
        when: When::Peak,
        of: Of::clutch(|d, l| allowed_opening_m(l.gap_peak_m, d), gap_opening_m),
        ..GAP
    },
    &Limit {
        code: "hertz-peak-inner",
        pressed: true,
        key: Some("hertz_peak_mpa"),
        name: |_| "Hertz pressure, inner contact, peak torque",
        when: When::Peak,
        of: Of::sprag(|_, l| l.hertz_peak_pa, |_, _, p| p.hertz_inner_pa, None),
        ..PRESSURE
    },
    &Limit {
        code: "hertz-peak-outer",
        key: Some("hertz_peak_mpa"),
        name: |_| "Hertz pressure, outer contact, peak torque",
        when: When::Peak,
        of: Of::sprag(|_, l| l.hertz_peak_pa, |_, _, p| p.hertz_outer_pa, None),
        ..PRESSURE
    },
    &Limit {
        code: "hoop-inner",
        key: Some("hoop_inner_mpa"),
        name: |_| "mean hoop stress, inner race, peak torque (magnitude)",
        of: Of::clutch(|_, l| l.hoop_inner_pa, |c, p| hoop_pa(c, p, Which::Inner, false)),
        ..HOOP
    },
    &Limit {
        code: "hoop-outer",
        key: Some("hoop_outer_mpa"),
        name: |_| "mean hoop stress, outer race, peak torque",
        of: Of::clutch(|_, l| l.hoop_outer_pa, |c, p| hoop_pa(c, p, Which::Outer, false)),
        ..HOOP
    },
    &Limit {
        code: "hoop-inner-bending",
        key: Some("hoop_inner_bending_mpa"),
        name: |_| "hoop stress with ring bending, inner race, peak torque (magnitude)",
        of: Of::beside(
            |l| l.hoop_inner_pa,
            |_, l| l.hoop_inner_bending_pa,
            |c, p| hoop_pa(c, p, Which::Inner, true),
        ),
        ..BENDING
    },
    &Limit {
        code: "hoop-outer-bending",
        key: Some("hoop_outer_bending_mpa"),
        name: |_| "hoop stress with ring bending, outer race, peak torque",
        of: Of::beside(
            |l| l.hoop_outer_pa,
            |_, l| l.hoop_outer_bending_pa,
            |c, p| hoop_pa(c, p, Which::Outer, true),
        ),
        ..BENDING
    },
    &Limit {
        code: "along-middle-inner",
        pressed: true,
        name: |_| "pressure along the inner contact, its middle half, peak torque",
        ..ALONG
    },
    &Limit {
        code: "along-ends-inner",
        pressed: true,
        name: |_| "pressure along the inner contact, towards its ends, peak torque",
        of: Of::clutch(|_, l| l.along_pa, |c, p| largest_pa(c, p, Side::Inner, Reach::Ends)),
        ..ALONG
    },
    &Limit {
        code: "along-middle-outer",
        name: |_| "pressure along the outer contact, its middle half, peak torque",
        of: Of::clutch(|_, l| l.along_pa, |c, p| largest_pa(c, p, Side::Outer, Reach::Middle)),
        ..ALONG
    },
    &Limit {
        code: "along-ends-outer",
        name: |_| "pressure along the outer contact, towards its ends, peak torque",
        of: Of::clutch(|_, l| l.along_pa, |c, p| largest_pa(c, p, Side::Outer, Reach::Ends)),
        ..ALONG
    },
    &Limit {
        code: "body-yield",
        key: Some("body_yield_mpa"),
        name: |_| "compression of the sprag's body half way between the contacts, peak torque",
        explanation: "Largest compression in the narrowest section of the sprag, strut force over the section and its bending \
                      where the strut has moved off the middle (Roark 12.4). Wider flanks or a longer sprag lower it.",
        formula: "sigma = F/(b l) (1 + 6 e/b), F = N_A/cos omega, b the width flank to flank, e the strut's distance from \
                  the middle",
        source: "Roark's Formulas for Stress and Strain, 7th ed., 12.4",
        of: Of::clutch(|_, l| l.body_yield_pa, |c, p| body_stress_pa(c.design, c.state, p)),
        ..HOOP
    },
    &Limit {
        code: "subsurface-inner",
        pressed: true,
        name: |_| "largest shear below the inner contact, peak torque",
        ..SHEAR
    },
    &Limit {
        code: "subsurface-outer",
        name: |_| "largest shear below the outer contact, peak torque",
        of: Of::shear(|_, l| l.case_shear_pa, |c, p| shear_below(c, outer(p), 0.0)),
        ..SHEAR
    },
    &Limit {
        code: "subsurface-core-inner",
        pressed: true,
        name: |_| "largest shear beneath the case at the inner contact, peak torque",
        ..CORE
    },
    &Limit {
        code: "subsurface-core-outer",
        name: |_| "largest shear beneath the case at the outer contact, peak torque",
        of: Of::shear(core_allowed, |c, p| shear_below(c, outer(p), case_m(c))),
        ..CORE
    },
    &END_OF_PROFILE,
    &Limit {
        code: "roll-over",
        name: |_| "peak torque against roll-over torque",
        unit: "Nm",
        explanation: "Peak torque against that at which the strut stands upright and the sprag rolls over. Where the profile \
                      ends sooner, its last arc is taken to go on: end-of-profile holds that end. More height of the sprag \
                      against the gap, or stiffer races, raise it.",
        formula: "largest torque of the curve, dC/dN_A = 0, or the last at which the sprag still spans the gap",
        source: "Huang 2017, (10)",
        ends_curve: true,
        of: Of::RollOver,
        ..GRIP
    },
    &GRIP_INNER,
    &Limit {
        code: "grip-outer",
        name: |l| match l.axial_load_n {
            None => "largest static tan nu up to peak torque against mu_s",
            Some(_) => {
                "friction for torque and axial load at B, peak torque, or tan nu below it, against mu_s"
            }
        },
        of: Of::sprag(static_friction, |d, l, p| grip(d, l, p)[1], Some(|p| p.tan_nu)),
        ..GRIP
    },
    &Limit {
        code: "axial-from",
        key: Some("axial_load_n"),
        name: |_| "torque from which on friction carries the axial load, against nominal torque",
        unit: "Nm",
        rule: Rule::Onset,
        explanation: "Torque from which on, up to peak torque, the friction of both contacts carries the axial load as well: \
                      below it the normal forces are too small. More friction or a smaller wedge angle lowers it. Shown only.",
        formula: "sqrt(T^2 + (F_a/n_s)^2) = mu_s N at the worse contact",
        source: "Coulomb, with the axial load as a vector",
        of: Of::AxialFrom,
        ..GRIP
    },
    &Limit {
        code: "neighbours",
        name: |_| "clearance between neighbouring sprags up to peak torque",
        unit: "mm",
        per_si: 1e3,
        rule: Rule::Clearance,
        explanation: "Smallest distance between the outlines of neighbouring sprags from no load up to peak torque; they must not \
                      touch, so the demand is 0, and the margin is that distance over the race gap. Fewer or \
                      narrower sprags leave more.",
        formula: "least distance between two outlines 360 deg/n_s apart, over R_e - R_i",
        source: "geometry of the outline",
        of: Of::Neighbours,
        ..GRIP
    },
    &Limit {
        code: "re-engagement",
        name: |_| "tan omega at first contact against mu_c",
        when: When::FirstContact,
        explanation: "Friction that the inner contact needs when it begins to carry, tan omega at first contact, against the \
                      kinetic coefficient mu_c, which is all that a sliding contact has. A smaller wedge angle at first \
                      contact lowers it.",
        formula: "tan omega as N goes to 0",
        source: "Huang 2017, (10); a sliding contact has mu_c",
        of: Of::ReEngagement,
        ..GRIP
    },
    &KEEP_CONTACT,
    &LIFT_OFF,
    &FILM,
    &SLIP,
    &CONTACT,
    &Limit {
        code: "hertz",
        key: Some("hertz_peak_mpa"),
        name: |_| "largest Hertz pressure, inner contact, in {scene} if it rolls throughout",
        when: When::Scene,
        of: Of::ScenePressure,
        ..PRESSURE
    },
    &Limit {
        code: "run-out-end",
        name: |_| "peak torque against that at which the first sprag off centre comes to its end",
        unit: "Nm",
        explanation: "Peak torque against that at which the first sprag of a clutch off centre rolls over or leaves its \
                      profile. Less eccentricity raises it.",
        formula: "least end of the curves of all sprags, each with its own gap R_e - R_i - offset cos phi",
        source: "this project: one curve per sprag off centre",
        ends_curve: true,
        of: Of::RunOutEnd,
        ..GRIP
    },
    &Limit {
        code: "run-out-share",
        name: |_| "largest normal force of a sprag over the mean, against that of the Hertz limit (p_0^2 ~ N)",
        when: When::Nominal,
        explanation: "Largest normal force of a sprag of a clutch off centre over the mean of all, against that with which its \
                      pressure would meet the Hertz limit (p_0^2 ~ N). Less eccentricity lowers it. Shown only.",
        formula: "largest N_k/mean of N_k against (p_allowed/p_0)^2",
        source: "this project: one curve per sprag off centre; Hertz",
        of: Of::RunOutShare,
        ..GRIP
    },
    &Limit {
        code: "sprag-hertz-nominal",
        name: |_| "largest Hertz pressure of unlike sprags, nominal torque",
        ..UNLIKE_PRESSURE
    },
    &Limit {
        code: "sprag-hertz-peak",
        key: Some("hertz_peak_mpa"),
        name: |_| "largest Hertz pressure of unlike sprags, peak torque",
        when: When::Peak,
        ..UNLIKE_PRESSURE
    },
    &Limit {
        code: "sprag-grip",
        key: None,
        name: |_| "largest share of its static friction that one of unlike sprags needs, peak torque",
        unit: "1",
        per_si: 1.0,
        when: When::Peak,
        explanation: "Friction that a sprag needs, tangential over normal force at its worse contact, over the static friction that it \
                      has, the largest of all sprags one by one; one that does not hold even at its touch carries nothing and \
                      is not counted. A smaller wedge angle, or less spread of friction and size, lowers it.",
        formula: "largest over the sprags of |T_k|/(N_k mu_s,k)",
        source: "this project: sprags one by one; Coulomb",
        of: Of::UnlikeFriction,
        ..PRESSURE
    },
    &Limit { code: "flank-rear-inside", ..ROOM },
    &Limit { code: "flank-rear-outside", ..ROOM },
    &Limit { code: "flank-front-inside", ..ROOM },
    &Limit { code: "flank-front-outside", ..ROOM },
];

/// What an allowed gap leaves above the gap at rest, m.
pub fn allowed_opening_m(gap_m: Option<f64>, design: &Design) -> Option<f64> {
    let r = &design.clutch.races;
    gap_m.map(|gap| gap - (r.outer_radius_m - r.inner_radius_m))
}

fn gap_opening_m(case: &LoadCase, p: &StaticPoint) -> f64 {
    let spun_m = case.elastic().outer_race.centrifugal_bore_growth_m(case.state.curve.speed_rad_s());
    case.elastic().gap_opening_m(p.normal_inner_n, p.normal_outer_n) + spun_m
}

fn static_friction(design: &Design, _: &Limits) -> Option<f64> {
    Some(design.clutch.friction.static_)
}
