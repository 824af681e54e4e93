//! Slip under load and the blow when the clutch grips again: what brought helicopters down.
//!
//! In: a clutch, the torque it carries, what turns with both races, the friction while it slips. Out: [`Blow`] for each path of slip.
//! Absent: damping between the races; what makes it slip (oil, wear, dirt); shafts, which soften the blow (a `[[drivetrain]]`
//! scene has them); heat of the slip.
//! Equations: (13) and (15) by [`crate::element`], and the balance of energy below.
//!
//! The clutch carries C in equilibrium; from one instant on its contacts have the friction of the slip. The wedge throws the sprags
//! out, they fly until the spring has brought them back, and the torque drives the races apart. After a path of slip the friction is that
//! of the design again, and the clutch grips as soon as the sprags are back. The races are fastest against one another when
//! the clutch carries C once more; from there on that speed w goes into its windup. With J = J_i J_e/(J_i + J_e), J_i where the
//! outer race is held, and no loss
//!
//!   J w^2/2 = integral from W(C) to W_max of (C(W) - C) dW,
//!
//! which is [`Blow::by_energy_nm`]; slip while the load rises takes some of it.

mod float;

use crate::clutch::{Clutch, Friction};
use crate::dynamics::{Run, Stop};
use crate::element::{Beginning, Element, NoElement, Port, Settings, Torque};
use crate::follow::Follow;
use crate::wedge::{StaticPoint, WedgeCurve};
use float::Floating;
use std::cell::RefCell;
use std::f64::consts::TAU;

/// What is asked.
#[derive(Debug, Clone, PartialEq)]
pub struct SlipUnderLoad {
    /// Torque that the clutch carries and that goes on acting, N m.
    pub torque_nm: f64,
    /// Speed of both races before, rad/s.
    pub speed_rad_s: f64,
    /// What turns with the inner and the outer race, these included, kg m^2.
    pub inertia_kg_m2: [f64; 2],
    /// Whether the outer race keeps its speed whatever acts on it, as in a housing: its inertia means nothing then.
    pub outer_held: bool,
    /// Friction coefficient of both contacts while they slip.
    pub friction: f64,
    /// Paths of slip between the tracks at the inner track, m, each above 0, rising.
    pub paths_m: Vec<f64>,
}

impl SlipUnderLoad {
    /// Energy of this speed of the races against one another, J.
    pub fn energy_j(&self, speed_rad_s: f64) -> f64 {
        0.5 * self.reduced_kg_m2() * speed_rad_s * speed_rad_s
    }

    /// Inertia of the races against one another, kg m^2.
    pub fn reduced_kg_m2(&self) -> f64 {
        let [inner, outer] = self.inertia_kg_m2;
        if self.outer_held { inner } else { inner * outer / (inner + outer) }
    }
}

/// What follows after one path of slip.
#[derive(Debug, Clone, PartialEq)]
pub struct Blow {
    /// Path of slip after which the friction is back, m at the inner track.
    pub path_m: f64,
    /// When that was, s after the slip began.
    pub slip_s: f64,
    /// When the load was largest, s after the slip began; `None`: the clutch did not grip again.
    pub peak_s: Option<f64>,
    /// Path of the races against one another until they stood still against one another for the first time, m at the inner track;
    /// `None`: they never did.
    pub path_in_all_m: Option<f64>,
    /// Largest speed of the races against one another, rad/s.
    pub speed_rad_s: f64,
    /// Largest load thereafter; `None`: beyond the end of the curve, the sprags roll over or an arc ends.
    pub peak: Option<StaticPoint>,
    /// Largest torque by the balance of energy, nothing lost, N m, as if something gripped at that speed; `None`: beyond the end of
    /// the curve.
    pub by_energy_nm: Option<f64>,
    /// Why the run ended where it has not come to its end; [`Stop::FellAway`] also where the sprags float open for good.
    pub ended: Option<Stop>,
}

/// What a slip comes to.
#[derive(Debug, Clone, PartialEq)]
pub struct Blows {
    /// One for each path; once the sprags are thrown out of reach, of races that the torque drives apart with nothing between them.
    pub list: Vec<Blow>,
    /// Where it does not slip: |T|/N at the inner contact, which the friction is enough for.
    pub holds: Option<f64>,
    /// Friction that holds the torque: the larger of tan omega and tan nu.
    pub needs: f64,
    /// Why the sprags went no farther with the slip, and where.
    pub ended: Option<SlipEnd>,
}

/// Where a slip came to an end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlipEnd {
    /// Why.
    pub stop: Stop,
    /// When, s after the slip began.
    pub at_s: f64,
    /// Path until then, m at the inner track.
    pub path_m: f64,
    /// Speed of the races against one another, rad/s.
    pub speed_rad_s: f64,
    /// Speed of the outer race, with which the sprags turn, rad/s.
    pub outer_rad_s: f64,
}

/// Halvings of an advance until the path is met.
const HALVINGS: usize = 24;
/// Advances in a period of the races on the clutch.
const ADVANCES: f64 = 64.0;
/// Periods that are waited for a slip to begin.
const PERIODS: f64 = 3.0;
/// Advances at most until the clutch has gripped.
const MOST: usize = 200_000;

/// Panels of the integrals below.
const PANELS: u32 = 4096;

/// Torques at the ends of a part of the windup, N m, and the work that goes into it beside that of the torque that acts, J.
type Panel = ([f64; 2], f64);

/// The windup from a torque that acts to the end of the curve in panels, computed as far as they are asked for.
struct Windup<'a> {
    torque_nm: f64,
    known: Vec<Panel>,
    more: Box<dyn Iterator<Item = Panel> + 'a>,
}

impl<'a> Windup<'a> {
    /// `None`: the curve does not carry `torque_nm`.
    fn new(curve: &'a WedgeCurve, torque_nm: f64) -> Option<Self> {
        let end_nm = curve.end_torque_nm() * (1.0 - 1e-12);
        let mut before = [torque_nm, curve.at_torque(torque_nm)?.windup_rad];
        let more = (1..=PANELS).map_while(move |k| {
            let here_nm = torque_nm + (end_nm - torque_nm) * f64::from(k) / f64::from(PANELS);
            let windup_rad = curve.at_torque(here_nm)?.windup_rad;
            let work_j = (0.5 * (before[0] + here_nm) - torque_nm) * (windup_rad - before[1]);
            let ends = [before[0], here_nm];
            before = [here_nm, windup_rad];
            Some((ends, work_j))
        });
        Some(Self { torque_nm, known: Vec::new(), more: Box::new(more) })
    }

    fn panel(&mut self, k: usize) -> Option<Panel> {
        if k == self.known.len() {
            self.known.extend(self.more.next());
        }
        self.known.get(k).copied()
    }

    fn by_energy_nm(&mut self, energy_j: f64) -> Option<f64> {
        let mut left_j = energy_j;
        let mut k = 0;
        while let Some(([from_nm, until_nm], work_j)) = self.panel(k) {
            if work_j >= left_j {
                // Work rises with the square of the torque where the panel begins at the torque that acts.
                let [from, until] = [from_nm, until_nm].map(|nm| nm - self.torque_nm);
                let square = from * from + (until * until - from * from) * left_j / work_j;
                return Some(self.torque_nm + square.sqrt());
            }
            left_j -= work_j;
            k += 1;
        }
        None
    }

    fn taken_up_j(&mut self, until_nm: f64) -> f64 {
        let mut taken_j = 0.0;
        let mut k = 0;
        while let Some((ends, work_j)) = self.panel(k) {
            if ends[1] >= until_nm {
                let [from, to, until] = [ends[0], ends[1], until_nm].map(|nm| nm - self.torque_nm);
                return taken_j + work_j * (until * until - from * from) / (to * to - from * from);
            }
            taken_j += work_j;
            k += 1;
        }
        taken_j
    }
}

/// Torque up to which `energy_j` winds the clutch up from `torque_nm` on, that torque doing its part; `None`: not on the curve.
pub fn by_energy_nm(curve: &WedgeCurve, torque_nm: f64, energy_j: f64) -> Option<f64> {
    Windup::new(curve, torque_nm)?.by_energy_nm(energy_j)
}

/// Energy that winds the clutch up from `torque_nm` to `until_nm`, at most to the end of its curve, J: [`by_energy_nm`] turned round.
pub fn taken_up_j(curve: &WedgeCurve, torque_nm: f64, until_nm: f64) -> Option<f64> {
    Some(Windup::new(curve, torque_nm)?.taken_up_j(until_nm))
}

/// [`taken_up_j`] of two torques.
pub fn both_taken_up_j(curve: &WedgeCurve, torque_nm: f64, until_nm: [f64; 2]) -> Option<[f64; 2]> {
    let mut windup = Windup::new(curve, torque_nm)?;
    Some(until_nm.map(|nm| windup.taken_up_j(nm)))
}

/// How far a slip comes.
enum Slipped {
    There,
    /// Not at all: |T|/N.
    Holds(f64),
    Ended(Stop),
}

/// A clutch between two inertias under equal torques.
struct Drive<'a> {
    case: &'a SlipUnderLoad,
    radius_m: f64,
    /// Angle of the races against one another at the start, rad.
    begun_rad: f64,
    dt_s: f64,
    /// The windup of the clutch that grips; `None`: the torque by energy is not asked for.
    windup: RefCell<Option<Windup<'a>>>,
    floating: Floating<'a>,
    follow: &'a Follow,
}

impl Drive<'_> {
    /// Path (m at the inner track) and speed (rad/s) of the races against one another, in the sense of the torque.
    fn apart(&self, element: &Element) -> (f64, f64) {
        let [inner, outer] = element.motion().flanges;
        let path_m = (outer.angle_rad - inner.angle_rad - self.begun_rad) * self.radius_m;
        (path_m, outer.speed_rad_s - inner.speed_rad_s)
    }

    fn advance(&self, element: &mut Element, dt_s: f64) -> Result<Run, NoElement> {
        let torque_nm = self.case.torque_nm;
        let torque = |nm: f64| Port::Torque(Torque::constant(nm));
        let outer = if self.case.outer_held { Port::Acceleration(0.0) } else { torque(torque_nm) };
        element.advance(dt_s, [torque(-torque_nm), outer]).map_err(NoElement::Malformed)
    }

    /// Let it slip on until it has come to `path_m`.
    fn slip_to(&self, slips: &mut Element, path_m: f64) -> Result<Slipped, NoElement> {
        let (mut dt_s, mut halved) = (self.dt_s, 0);
        for _ in 0..MOST {
            if self.follow.stopped() {
                return Ok(Slipped::Ended(Stop::Interrupted));
            }
            let before = slips.save();
            let run = self.advance(slips, dt_s)?;
            if self.apart(slips).0 <= path_m {
                let slid = slips.slips().iter().any(|s| s.time_s > 0.0) || slips.motion().open;
                if run.stop != Stop::Finished {
                    return Ok(Slipped::Ended(run.stop));
                }
                if !slid && slips.t_s() > PERIODS * ADVANCES * self.dt_s {
                    return Ok(Slipped::Holds(run.peaks.tan_inner));
                }
                continue;
            }
            if halved == HALVINGS {
                return Ok(Slipped::There);
            }
            // Back, and on by half the step.
            slips.restore(&before).map_err(NoElement::Malformed)?;
            (dt_s, halved) = (0.5 * dt_s, halved + 1);
        }
        Ok(Slipped::Ended(Stop::StepLimit))
    }

    /// Grip again as `held` does, from where `slips` stands.
    fn grip(&self, slips: &Element, held: &Element, path_m: f64) -> Result<Blow, NoElement> {
        let mut grips = slips.moved_to(held.clone())?;
        let slip_s = grips.t_s();
        let (mut most_n, mut peak_s, mut ended) = (0.0, slip_s, None);
        let (_, mut speed_rad_s) = self.apart(&grips);
        let mut wound = false;
        for _ in 0..MOST {
            if self.follow.stopped() {
                ended = Some(Stop::Interrupted);
                break;
            }
            let before_s = grips.t_s();
            let run = self.advance(&mut grips, self.dt_s)?;
            if run.peaks.normal_max_n > most_n {
                (most_n, peak_s) = (run.peaks.normal_max_n, before_s + run.peaks.at_s[3]);
            }
            let (_, speed) = self.apart(&grips);
            speed_rad_s = speed_rad_s.max(speed);
            if run.stop != Stop::Finished {
                ended = Some(run.stop);
                break;
            }
            // Wound up and on its way back.
            if speed < 0.0 {
                wound = true;
                break;
            }
            if self.floating.for_good(&grips) {
                ended = Some(Stop::FellAway);
                break;
            }
        }
        if !wound && ended.is_none() {
            ended = Some(Stop::StepLimit);
        }
        let curve = &grips.model().curve;
        let known = matches!(ended, None | Some(Stop::CurveEnd | Stop::FellAway));
        Ok(Blow {
            path_m,
            slip_s,
            peak_s: Some(peak_s),
            path_in_all_m: Some(self.apart(&grips).0).filter(|_| wound),
            speed_rad_s,
            peak: curve.at_normal(most_n).filter(|_| ended.is_none()),
            by_energy_nm: if known { self.by_energy_nm(speed_rad_s) } else { None },
            ended,
        })
    }

    /// Largest torque that the energy of this speed of the races against one another comes to.
    fn by_energy_nm(&self, speed_rad_s: f64) -> Option<f64> {
        self.windup.borrow_mut().as_mut()?.by_energy_nm(self.case.energy_j(speed_rad_s))
    }

    /// `path_m` with nothing between the races from `end` on: the torque alone drives them apart.
    fn free(&self, end: &SlipEnd, path_m: f64) -> Blow {
        let acceleration = self.case.torque_nm / self.case.reduced_kg_m2();
        let path_rad = (path_m - end.path_m).max(0.0) / self.radius_m;
        let speed_rad_s = (end.speed_rad_s.powi(2) + 2.0 * acceleration * path_rad).sqrt();
        Blow {
            path_m,
            slip_s: end.at_s + (speed_rad_s - end.speed_rad_s) / acceleration,
            peak_s: None,
            path_in_all_m: None,
            speed_rad_s,
            peak: None,
            by_energy_nm: self.by_energy_nm(speed_rad_s),
            ended: Some(end.stop),
        }
    }
}

/// The blow after each path of slip.
///
/// # Errors
/// [`NoElement`]: the clutch has no such start.
pub fn blows(clutch: &Clutch, case: &SlipUnderLoad, follow: &Follow) -> Result<Blows, NoElement> {
    blows_with(clutch, case, true, follow)
}

/// The same, [`Blow::by_energy_nm`] only where it is asked for: that is the dearest of it.
pub(crate) fn blows_with(
    clutch: &Clutch,
    case: &SlipUnderLoad,
    by_energy: bool,
    follow: &Follow,
) -> Result<Blows, NoElement> {
    let mut held = clutch.clone();
    [held.races.inner_inertia_kg_m2, held.races.outer_inertia_kg_m2] = case.inertia_kg_m2;
    // A damper between the races would take from the blow what nobody has measured.
    held.races.viscous_damping_nm_s_per_rad = 0.0;
    let friction = Friction { static_: case.friction, kinetic: case.friction, ..held.friction };
    let slippery = Clutch { friction, ..held.clone() };
    let (torque_nm, speed_rad_s) = (case.torque_nm, case.speed_rad_s);
    let beginning = Beginning { torque_nm, speed_rad_s, ..Beginning::default() };
    let settings = Settings { tolerance: 1e-9, ..Settings::default() };
    let rests = Element::new(&held, &beginning, &settings)?;
    let at_torque = rests.model().curve.at_torque(torque_nm);
    let stiffness = at_torque.map_or(1.0, |p| p.k_tangent_nm_per_rad);
    let needs = at_torque.map_or(f64::INFINITY, |p| p.required_friction());
    let dt_s = TAU * (case.reduced_kg_m2() / stiffness).sqrt() / ADVANCES;
    let windup = by_energy.then(|| Windup::new(&rests.model().curve, torque_nm)).flatten();
    let windup = RefCell::new(windup);
    let radius_m = clutch.races.inner_radius_m;
    let floating = Floating { clutch: &held, torque_nm, outer_held: case.outer_held };
    let mut drive = Drive { case, radius_m, begun_rad: 0.0, dt_s, windup, floating, follow };
    drive.begun_rad = drive.apart(&rests).0 / drive.radius_m;
    let mut slips = rests.exchanged(&slippery)?;
    // Made once: each path goes on from where the slip stands then.
    let grips = slips.exchanged(&held)?;
    let mut found = Blows { list: Vec::with_capacity(case.paths_m.len()), holds: None, needs, ended: None };
    for &path_m in &case.paths_m {
        if let Some(end) = found.ended {
            found.list.push(drive.free(&end, path_m));
            continue;
        }
        match drive.slip_to(&mut slips, path_m)? {
            Slipped::There => found.list.push(drive.grip(&slips, &grips, path_m)?),
            Slipped::Holds(needed) => return Ok(Blows { holds: Some(needed), ..found }),
            Slipped::Ended(stop) => {
                let (fled_m, speed_rad_s) = drive.apart(&slips);
                let outer_rad_s = slips.motion().flanges[1].speed_rad_s;
                let end = SlipEnd { stop, at_s: slips.t_s(), path_m: fled_m, speed_rad_s, outer_rad_s };
                found.ended = Some(end);
                if stop != Stop::FellAway {
                    return Ok(found);
                }
                found.list.push(drive.free(&end, path_m));
            }
        }
    }
    Ok(found)
}
