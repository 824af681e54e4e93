//! What turns on either side of the clutch, integrated together with it.
//!
//! In: inertias with shafts, gears and torques. Out: torques on the races, the slope of the longer state, its start, its
//! small motions. Absent: files and names of scenes. Equations: below.
//!
//! Everything is turned to the shaft of the races: with i turns of an inertia for one turn of its race, its angle counts by
//! 1/i, its inertia and the stiffness, damping and drag of its shaft by i^2, torques on it by i. What is joined without a
//! shaft turns with what it is joined to. For each body b on a shaft, p what it is joined to, the state has the twist
//! u = theta_b - theta_p and its rate, which stay small where angles grow:
//!
//!   J_b theta_b'' = C_b - k_b u_b - c_b u_b' + sum over what is joined to b of (k u + c u') - d_b (Omega + theta_b') - J_b Omega'
//!
//! with angles from the integral of the mean speed Omega, as those of the races. Where the speed of a body is given, its
//! angle is the integral of that, and no state.

mod modes;
mod run;
mod start;
mod torque;
mod turned;

pub use modes::TrainMode;
pub use run::TrainRun;
pub(super) use run::integrate;
use torque::Torque;
use turned::Turned;

use super::model::N_STATE;
use crate::clutch::{DriveInertia, MOST_SHAFTS, Towards};
use crate::numeric::course::Course;

/// Races and bodies, driven ones too: at most one of these on a side.
const BODIES: usize = 2 + MOST_SHAFTS + 2;
/// Longest state of a drivetrain: twist (rad) and rate (rad/s) of every shaft.
pub(super) const MOST_MORE: usize = 2 * MOST_SHAFTS;

/// A drivetrain on the shaft of the races, ready to be integrated.
#[derive(Debug, Clone, PartialEq)]
pub struct Train {
    /// What turns with the races without a shaft: inertia, kg m^2, drag, N m s/rad.
    rigid: [Rigid; 2],
    /// All others, each after what it is joined to.
    bodies: Vec<Body>,
    acts: Vec<Act>,
    /// Names, and where each inertia of the list is.
    nodes: Vec<Node>,
    /// The integral of the mean speed where that is no constant.
    frame: Option<Turned>,
    /// Time at t = 0 since the start of the scene, s.
    since_s: f64,
    /// Torque that the clutch carries where the scene starts in engagement, N m.
    carried_nm: Option<f64>,
    /// Twists and their rates at t = 0 where it is no start of a scene.
    begins: Option<[f64; MOST_MORE]>,
}

impl Body {
    /// What its shaft passes on to what it is joined to, N m.
    #[inline]
    fn passes_nm(&self, twist_rad: f64, rate_rad_s: f64) -> f64 {
        self.stiffness_nm_per_rad * twist_rad + self.damping_nm_s_per_rad * rate_rad_s
    }
}

impl Act {
    /// Torque on its body where everything is at `at`, `frame_rad` being the integral of the mean speed, N m.
    #[inline]
    fn on_body_nm(&self, t: f64, at: &Place, frame_rad: f64) -> f64 {
        let turned = self.ratio * (at.angle[self.body] + frame_rad);
        self.ratio * self.torque.at(t, turned)
    }
}

/// What is fixed to a body.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
struct Rigid {
    inertia_kg_m2: f64,
    drag_nm_s_per_rad: f64,
}

/// What turns on a shaft, on the shaft of the races.
#[derive(Debug, Clone, PartialEq)]
struct Body {
    /// What it is joined to: 0 and 1 are the races, others follow.
    parent: usize,
    fixed: Rigid,
    stiffness_nm_per_rad: f64,
    damping_nm_s_per_rad: f64,
    motion: Motion,
}

#[derive(Debug, Clone, PartialEq)]
enum Motion {
    /// Twist and rate are numbers `2 k` and `2 k + 1` beyond the state of the clutch.
    Free(usize),
    /// Angle and speed, on the shaft of the races, and the angle at the start of the scene.
    Given(Turned, f64),
}

/// A torque with the body it acts on and the turns of its inertia for one of the race.
#[derive(Debug, Clone, PartialEq)]
struct Act {
    body: usize,
    ratio: f64,
    torque: Torque,
}

#[derive(Debug, Clone, PartialEq)]
struct Node {
    name: String,
    body: usize,
    ratio: f64,
    /// Stiffness and damping of its shaft by its own angle; none without one.
    shaft: Option<[f64; 2]>,
}

/// How an inertia on a shaft moves, by its own angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NodeMotion {
    /// What it has turned since the start of the scene, its own mean speed included, rad. What it had at the start counts
    /// from the race's angle and the twist of the shafts between.
    pub angle_rad: f64,
    /// rad/s.
    pub speed_rad_s: f64,
    /// What its shaft passes on towards the clutch, N m.
    pub shaft_nm: f64,
}

/// Angles (rad), rates (rad/s), twists and their rates of all bodies, angles from the integral of the mean speed.
struct Place {
    angle: [f64; BODIES],
    rate: [f64; BODIES],
    twist: [f64; BODIES],
    twist_rate: [f64; BODIES],
}

impl Train {
    /// Of a checked list: each entry after what it is joined to, ratios other than 0. `None` where the list holds more shafts
    /// than [`MOST_SHAFTS`], or breaks those rules.
    pub fn new(list: &[DriveInertia]) -> Option<Self> {
        let mut train = Self {
            rigid: [Rigid::default(); 2],
            bodies: Vec::new(),
            acts: Vec::new(),
            nodes: Vec::new(),
            frame: None,
            since_s: 0.0,
            carried_nm: None,
            begins: None,
        };
        let (mut free, mut given) = (0, 0);
        for one in list {
            let (parent, of_parent) = match one.to {
                Towards::InnerRace => (0, 1.0),
                Towards::OuterRace => (1, 1.0),
                Towards::Inertia(i) => train.nodes.get(i).map(|n| (n.body, n.ratio))?,
            };
            let ratio = one.ratio * of_parent;
            let squared = ratio * ratio;
            let body = match one.shaft {
                None => parent,
                Some(shaft) => {
                    let motion = match torque::speed(&one.speed) {
                        Some(_) => {
                            given += 1;
                            let points = one.speed.iter().flatten().map(|[t, v]| [*t, v / ratio]).collect();
                            Motion::Given(Turned::new(points)?, 0.0)
                        }
                        None => {
                            free += 1;
                            Motion::Free(free - 1)
                        }
                    };
                    train.bodies.push(Body {
                        parent,
                        fixed: Rigid::default(),
                        stiffness_nm_per_rad: squared * shaft.stiffness_nm_per_rad,
                        damping_nm_s_per_rad: squared * shaft.damping_nm_s_per_rad,
                        motion,
                    });
                    1 + train.bodies.len()
                }
            };
            let fixed = match body.checked_sub(2) {
                None => &mut train.rigid[body],
                Some(b) => &mut train.bodies[b].fixed,
            };
            fixed.inertia_kg_m2 += squared * one.inertia_kg_m2;
            fixed.drag_nm_s_per_rad += squared * one.drag_nm_s_per_rad;
            for torque in &one.torques {
                train.acts.push(Act { body, ratio, torque: Torque::new(torque)? });
            }
            let shaft = one.shaft.map(|s| [s.stiffness_nm_per_rad, s.damping_nm_s_per_rad]);
            train.nodes.push(Node { name: one.name.clone(), body, ratio, shaft });
        }
        let sound = train.nodes.iter().all(|n| n.ratio != 0.0 && n.ratio.is_finite());
        (sound && free <= MOST_SHAFTS && given <= 2).then_some(train)
    }

    /// The mean speed over time (s, rad/s) where it is no constant.
    pub fn in_frame(self, speed: Option<Vec<[f64; 2]>>) -> Self {
        Self { frame: torque::speed(&speed), ..self }
    }

    /// Whether the speed of `body` is given.
    fn is_given(&self, body: usize) -> bool {
        body >= 2 && matches!(self.bodies[body - 2].motion, Motion::Given(..))
    }

    /// Shafts that are integrated.
    pub(super) fn free(&self) -> usize {
        self.bodies.iter().filter(|b| matches!(b.motion, Motion::Free(_))).count()
    }

    /// All that has knots.
    pub(super) fn courses(&self) -> impl Iterator<Item = &Course> {
        let of_bodies = self.bodies.iter().filter_map(|b| match &b.motion {
            Motion::Given(turned, _) => Some(turned.course()),
            Motion::Free(_) => None,
        });
        self.acts.iter().filter_map(|a| a.torque.course()).chain(of_bodies)
    }

    /// Whether what acts on it does not depend on time or on the angles of its inertias.
    pub fn acts_alike(&self) -> bool {
        self.frame.is_none()
            && self.acts.iter().all(|act| matches!(act.torque, Torque::Constant(_)))
            && (2..2 + self.bodies.len()).all(|body| !self.is_given(body))
    }

    /// The same with time counted from `t` (s) on; it begins at the start of the scene unless [`Self::begin_at`] says otherwise.
    pub(super) fn from(&self, t: f64) -> Self {
        let mut later = self.clone();
        later.since_s += t;
        later.frame = self.frame.as_ref().map(|f| f.from(t));
        for act in &mut later.acts {
            act.torque = act.torque.from(t);
        }
        for body in &mut later.bodies {
            if let Motion::Given(turned, _) = &mut body.motion {
                *turned = turned.from(t);
            }
        }
        later
    }

    /// Begin where another run of it was.
    pub fn begin_at(&mut self, run: &TrainRun) {
        self.begins = run.engaged.or(self.begins);
        for (body, stood) in self.bodies.iter_mut().zip(&run.train.bodies) {
            if let (Motion::Given(_, at_start), Motion::Given(_, of_run)) = (&mut body.motion, &stood.motion)
            {
                *at_start = *of_run;
            }
        }
    }

    /// The integral of the mean speed since the start of the scene, rad, `speed` (rad/s) being that at `t` (s).
    fn frame_rad(&self, t: f64, speed: f64) -> f64 {
        self.frame.as_ref().map_or(speed * (t + self.since_s), |f| f.angle_rad(t))
    }

    /// Where everything is. `speed`: the mean one.
    #[inline]
    fn place(&self, t: f64, y: &[f64], speed: f64) -> Place {
        let zero = [0.0; BODIES];
        let mut at = Place { angle: zero, rate: zero, twist: zero, twist_rate: zero };
        (at.angle[0], at.angle[1], at.rate[0], at.rate[1]) = (y[2], y[3], y[6], y[7]);
        for (b, body) in (2..).zip(&self.bodies) {
            let (angle, rate) = (at.angle[body.parent], at.rate[body.parent]);
            (at.twist[b], at.twist_rate[b]) = match &body.motion {
                Motion::Free(k) => (y[N_STATE + 2 * k], y[N_STATE + 2 * k + 1]),
                Motion::Given(turned, at_start) => (
                    at_start + turned.angle_rad(t) - self.frame_rad(t, speed) - angle,
                    turned.speed(t).0 - speed - rate,
                ),
            };
            (at.angle[b], at.rate[b]) = (angle + at.twist[b], rate + at.twist_rate[b]);
        }
        at
    }

    /// Torques on the bodies `from` to below `until`, those of dOmega/dt left out, N m.
    #[inline]
    fn torques(&self, t: f64, at: &Place, speed: f64, from: usize, until: usize) -> [f64; BODIES] {
        let mut sum = [0.0; BODIES];
        let mut add = |body: usize, torque: f64| {
            if (from..until).contains(&body) {
                sum[body] += torque;
            }
        };
        for (b, body) in (2..).zip(&self.bodies) {
            let shaft = body.passes_nm(at.twist[b], at.twist_rate[b]);
            add(b, -shaft);
            add(body.parent, shaft);
            add(b, -body.fixed.drag_nm_s_per_rad * (speed + at.rate[b]));
        }
        for (race, fixed) in self.rigid.iter().enumerate() {
            add(race, -fixed.drag_nm_s_per_rad * (speed + at.rate[race]));
        }
        if self.acts.iter().any(|act| (from..until).contains(&act.body)) {
            let frame = self.frame_rad(t, speed);
            for act in self.acts.iter().filter(|act| (from..until).contains(&act.body)) {
                sum[act.body] += act.on_body_nm(t, at, frame);
            }
        }
        sum
    }

    /// Torques on the inner and the outer race, N m.
    pub(super) fn on_races_nm(&self, t: f64, y: &[f64], speed: f64) -> [f64; 2] {
        let sum = self.torques(t, &self.place(t, y, speed), speed, 0, 2);
        [sum[0], sum[1]]
    }

    /// Rates of twists and of their rates behind the state of the clutch in `out`. `races`: accelerations of the races, rad/s^2.
    pub(super) fn slope(
        &self,
        t: f64,
        y: &[f64],
        (speed, spin): (f64, f64),
        races: [f64; 2],
        out: &mut [f64],
    ) {
        let at = self.place(t, y, speed);
        let sum = self.torques(t, &at, speed, 2, BODIES);
        let mut acceleration = [0.0; BODIES];
        (acceleration[0], acceleration[1]) = (races[0], races[1]);
        for (b, body) in (2..).zip(&self.bodies) {
            match &body.motion {
                Motion::Free(k) => {
                    acceleration[b] = sum[b] / body.fixed.inertia_kg_m2 - spin;
                    out[N_STATE + 2 * k] = at.twist_rate[b];
                    out[N_STATE + 2 * k + 1] = acceleration[b] - acceleration[body.parent];
                }
                Motion::Given(turned, _) => acceleration[b] = turned.speed(t).1 - spin,
            }
        }
    }

    /// Kinetic energy in the frame of the mean speed, and that of the shafts, J; races and what turns with them left out.
    pub(super) fn energies_j(&self, t: f64, y: &[f64], speed: f64) -> [f64; 2] {
        let at = self.place(t, y, speed);
        let mut sum = [0.0; 2];
        for (b, body) in (2..).zip(&self.bodies) {
            if matches!(body.motion, Motion::Free(_)) {
                sum[0] += 0.5 * body.fixed.inertia_kg_m2 * at.rate[b].powi(2);
            }
            sum[1] += 0.5 * body.stiffness_nm_per_rad * at.twist[b].powi(2);
        }
        sum
    }

    /// Powers that go in by torques and given speeds on the side of the inner and of the outer race, by shafts and drags, and
    /// by the frame, W.
    pub(super) fn powers_w(&self, t: f64, y: &[f64], (speed, spin): (f64, f64)) -> [f64; 4] {
        let at = self.place(t, y, speed);
        let side = self.sides();
        let frame = self.frame_rad(t, speed);
        let mut power = [0.0; 4];
        for act in &self.acts {
            if !self.is_given(act.body) {
                power[side[act.body]] += act.on_body_nm(t, &at, frame) * at.rate[act.body];
            }
        }
        for (race, fixed) in self.rigid.iter().enumerate() {
            power[2] -= fixed.drag_nm_s_per_rad * (speed + at.rate[race]) * at.rate[race];
        }
        for (b, body) in (2..).zip(&self.bodies) {
            let damping = body.damping_nm_s_per_rad * at.twist_rate[b];
            power[2] -= damping * at.twist_rate[b];
            match body.motion {
                Motion::Free(_) => {
                    power[2] -= body.fixed.drag_nm_s_per_rad * (speed + at.rate[b]) * at.rate[b];
                    power[3] -= body.fixed.inertia_kg_m2 * spin * at.rate[b];
                }
                Motion::Given(..) => {
                    power[side[b]] += (body.stiffness_nm_per_rad * at.twist[b] + damping) * at.rate[b];
                }
            }
        }
        power
    }

    /// On which side each body is: 0 inner, 1 outer.
    fn sides(&self) -> [usize; BODIES] {
        let mut side = [0; BODIES];
        side[1] = 1;
        for (b, body) in (2..).zip(&self.bodies) {
            side[b] = side[body.parent];
        }
        side
    }

    /// Names of the inertias on shafts, in the order of [`Self::motions`].
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.nodes.iter().filter(|n| n.shaft.is_some()).map(|n| n.name.as_str())
    }

    /// How they move at `t` (s) in the state `y` of the clutch and `more` of the drivetrain, at the mean speed `speed` (rad/s).
    pub fn motions(&self, t: f64, y: &super::State, more: &[f64; MOST_MORE], speed: f64) -> Vec<NodeMotion> {
        let mut whole = [0.0; N_STATE + MOST_MORE];
        whole[..N_STATE].copy_from_slice(y);
        whole[N_STATE..].copy_from_slice(more);
        let (at, frame) = (self.place(t, &whole, speed), self.frame_rad(t, speed));
        let of = |node: &Node| {
            let [stiffness, damping] = node.shaft?;
            let b = node.body;
            Some(NodeMotion {
                angle_rad: node.ratio * (at.angle[b] + frame),
                speed_rad_s: node.ratio * (at.rate[b] + speed),
                shaft_nm: node.ratio * (stiffness * at.twist[b] + damping * at.twist_rate[b]),
            })
        };
        self.nodes.iter().filter_map(of).collect()
    }
}

/// `clutch` with `more` repeated behind it, for twists and their rates.
pub(super) fn beside<const N: usize>(clutch: [f64; N_STATE], more: [f64; 2]) -> [f64; N] {
    std::array::from_fn(|i| if i < N_STATE { clutch[i] } else { more[(i - N_STATE) % 2] })
}

/// Largest amplitude of a twist (rad) in the part of a slope that is as fast as `rate` (rad/s).
pub(super) fn most<const N: usize>(part: &[f64; N], rate: f64) -> f64 {
    let twist = |both: &[f64]| (both[0] / rate).hypot(both[1] / (rate * rate));
    part[N_STATE..].chunks_exact(2).map(twist).fold(0.0, f64::max)
}
