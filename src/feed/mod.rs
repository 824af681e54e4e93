//! Strokes of an indexing drive: what each feeds, and from which frequency on it no longer does.
//!
//! In: a clutch, a stroke that swings one race to and fro, a brake and an inertia on the other. Out: [`Fed`] for a frequency.
//! Absent: shafts (a `[[drivetrain]]` scene has them); sprags one by one. Equations: (13) and (15) by [`crate::element`].
//!
//! The driving race turns by the stroke b and back as b (1 - cos 2 pi f t)/2. On the way out the clutch takes the fed race along
//! against the brake, on the way back it overruns. The brake is dry friction: the fed race stands until the clutch asks for more than
//! the brake's torque M, and stands again where its speed comes to nothing. Slow strokes feed b less the windup at M, from first
//! contact on. Faster ones wind the clutch farther up and let the fed race run on when the driving one slows down, where
//! J b (2 pi f)^2/2 exceeds M; sprags that come too late to their contacts feed less.

use crate::clutch::Clutch;
use crate::dynamics::{Run, Stop};
use crate::element::{Beginning, Element, NoElement, Port, Settings, Torque};
use crate::follow::Follow;
use crate::wedge::StaticPoint;
use std::f64::consts::TAU;

/// What is asked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Strokes {
    /// Angle that the driving race turns by and back, rad, above 0.
    pub stroke_rad: f64,
    /// Strokes a second, Hz, above 0.
    pub frequency_hz: f64,
    /// Torque of the brake on the fed race, N m, at least 0.
    pub brake_nm: f64,
    /// What turns with the fed race, this included, kg m^2.
    pub inertia_kg_m2: f64,
    /// Whether the inner race drives.
    pub inner_drives: bool,
}

impl Strokes {
    /// Strokes a second from which on the inertia asks for more than the brake where the driving race slows down, Hz.
    pub fn runs_on_from_hz(&self) -> f64 {
        (2.0 * self.brake_nm / (self.inertia_kg_m2 * self.stroke_rad)).sqrt() / TAU
    }

    /// Sense in which the driving race takes the other along.
    fn sense(&self) -> f64 {
        if self.inner_drives { -1.0 } else { 1.0 }
    }

    /// Driving and fed race.
    fn races(&self) -> [usize; 2] {
        if self.inner_drives { [0, 1] } else { [1, 0] }
    }

    /// Speed of the driving race, rad/s, forward.
    fn speed_rad_s(&self, t_s: f64) -> f64 {
        let omega = TAU * self.frequency_hz;
        0.5 * self.stroke_rad * omega * (omega * t_s).sin()
    }
}

/// What the strokes of one frequency feed.
#[derive(Debug, Clone, PartialEq)]
pub struct Fed {
    /// Strokes a second, Hz.
    pub frequency_hz: f64,
    /// What the last stroke fed, rad.
    pub feed_rad: f64,
    /// That less the stroke, rad.
    pub error_rad: f64,
    /// By what the last stroke differs from the one before, rad.
    pub unlike_rad: f64,
    /// How far the fed race went on once the driving one had turned back, rad.
    pub runs_on_rad: f64,
    /// Largest load of the last stroke; `None`: beyond the end of the curve.
    pub peak: Option<StaticPoint>,
    /// Time of the last stroke without contact at A, s.
    pub open_s: f64,
    /// Strokes that were followed.
    pub strokes: u32,
    /// Why they ended early, if they did.
    pub ended: Option<Stop>,
}

/// Advances in a period.
const ADVANCES: u32 = 512;
/// Halvings of an advance until the instant is met at which the brake lets go or holds.
const HALVINGS: u32 = 16;
/// Strokes at least and at most; they end where one is like the one before to [`ALIKE`] of the stroke.
const STROKES: [u32; 2] = [3, 12];
const ALIKE: f64 = 1e-6;
/// Share of the stroke below which a race that stands has moved by rounding only.
const ROUNDING: f64 = 1e-10;

/// The fed race on its brake.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Brake {
    Holds,
    /// The race turns in this sense, forward is 1.
    Slides(f64),
}

struct FeedRun<'a> {
    case: &'a Strokes,
    element: Element,
    brake: Brake,
    most_n: f64,
    open_s: f64,
}

impl FeedRun<'_> {
    /// Angle of a race, rad, forward.
    fn angle_rad(&self, race: usize) -> f64 {
        self.case.sense() * self.element.motion().flanges[race].angle_rad
    }

    fn advance(&mut self, dt_s: f64) -> Result<Run, NoElement> {
        let (case, sense) = (self.case, self.case.sense());
        let driven = Port::Speed(sense * case.speed_rad_s(self.element.t_s() + dt_s));
        let fed = match self.brake {
            Brake::Holds => Port::Speed(0.0),
            Brake::Slides(way) => Port::Torque(Torque::constant(-sense * way * case.brake_nm)),
        };
        let ports = if case.inner_drives { [driven, fed] } else { [fed, driven] };
        self.element.advance(dt_s, ports).map_err(NoElement::Malformed)
    }

    /// What the brake does next where it can no longer do what it does.
    fn changed(&self) -> Option<Brake> {
        let flange = self.element.motion().flanges[self.case.races()[1]];
        // What the clutch asks of the fed race, forward, is what holds it turned round.
        let asked_nm = -self.case.sense() * flange.torque_nm;
        match self.brake {
            Brake::Holds if asked_nm.abs() > self.case.brake_nm => Some(Brake::Slides(asked_nm.signum())),
            Brake::Slides(way)
                if self.case.brake_nm > 0.0 && self.case.sense() * way * flange.speed_rad_s < 0.0 =>
            {
                Some(Brake::Holds)
            }
            _ => None,
        }
    }

    /// Go on until `until_s`.
    fn go(&mut self, until_s: f64, follow: &Follow) -> Result<Option<Stop>, NoElement> {
        let step_s = 1.0 / (self.case.frequency_hz * f64::from(ADVANCES));
        let shortest_s = step_s * 0.5_f64.powi(HALVINGS as i32);
        let mut dt_s = step_s;
        while until_s - self.element.t_s() > shortest_s {
            if follow.stopped() {
                return Ok(Some(Stop::Interrupted));
            }
            let before = self.element.save();
            let run = self.advance(dt_s.min(until_s - self.element.t_s()))?;
            let changed = self.changed();
            if changed.is_some() && dt_s > shortest_s {
                // Back, and on by half the step.
                self.element.restore(&before).map_err(NoElement::Malformed)?;
                dt_s *= 0.5;
                continue;
            }
            self.most_n = self.most_n.max(run.peaks.normal_max_n);
            self.open_s += run.open_s;
            if run.stop != Stop::Finished {
                return Ok(Some(run.stop));
            }
            if let Some(brake) = changed {
                self.brake = brake;
            }
            dt_s = (2.0 * dt_s).min(step_s);
        }
        Ok(None)
    }
}

/// What the strokes of `case` feed.
///
/// # Errors
/// [`NoElement`]: the clutch has no such start, or a number is none that is allowed.
pub fn fed(clutch: &Clutch, case: &Strokes, follow: &Follow) -> Result<Fed, NoElement> {
    let mut clutch = clutch.clone();
    let [driving, race] = case.races();
    *[&mut clutch.races.inner_inertia_kg_m2, &mut clutch.races.outer_inertia_kg_m2][race] =
        case.inertia_kg_m2;
    let element = Element::new(&clutch, &Beginning::default(), &Settings::default())?;
    let brake = if case.brake_nm > 0.0 { Brake::Holds } else { Brake::Slides(1.0) };
    let mut drive = FeedRun { case, element, brake, most_n: 0.0, open_s: 0.0 };
    let mut found = Fed {
        frequency_hz: case.frequency_hz,
        feed_rad: 0.0,
        error_rad: 0.0,
        unlike_rad: f64::INFINITY,
        runs_on_rad: 0.0,
        peak: None,
        open_s: 0.0,
        strokes: 0,
        ended: None,
    };
    let period_s = 1.0 / case.frequency_hz;
    while found.strokes < STROKES[1]
        && (found.strokes < STROKES[0] || found.unlike_rad > ALIKE * case.stroke_rad)
    {
        let [at_rad, from_rad] = [driving, race].map(|race| drive.angle_rad(race));
        (drive.most_n, drive.open_s) = (0.0, 0.0);
        let begun_s = f64::from(found.strokes) * period_s;
        let mut halves = [0.0; 2];
        for (half, angle_rad) in halves.iter_mut().enumerate() {
            found.ended = drive.go(begun_s + 0.5 * period_s * (half + 1) as f64, follow)?;
            if found.ended.is_some() {
                break;
            }
            *angle_rad = drive.angle_rad(race);
            if half == 0 {
                // The stroke as it was driven.
                found.error_rad = at_rad - drive.angle_rad(driving);
            }
        }
        if found.ended.is_some() {
            break;
        }
        let [there_rad, back_rad] = halves;
        let feed_rad = back_rad - from_rad;
        found.unlike_rad = if found.strokes == 0 { f64::INFINITY } else { (feed_rad - found.feed_rad).abs() };
        found.error_rad += feed_rad;
        let runs_on_rad = back_rad - there_rad;
        found.feed_rad = feed_rad;
        found.runs_on_rad = if runs_on_rad.abs() > ROUNDING * case.stroke_rad { runs_on_rad } else { 0.0 };
        found.peak = drive.element.model().curve.at_normal(drive.most_n);
        found.open_s = drive.open_s;
        found.strokes += 1;
    }
    Ok(found)
}
