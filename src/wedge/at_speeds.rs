//! Curves of one clutch at several mean speeds, each built once for all who ask.

use super::build::Effort;
use super::closure::Statics;
use super::curve::{EndReason, WedgeCurve};
use crate::clutch::Clutch;
use std::sync::{Arc, Mutex, MutexGuard};

/// Of a clutch whose curve at rest is known: its curves at speed, built by whoever asks first. Clones share them. What is answered
/// does not depend on who that was.
#[derive(Debug, Clone, Default)]
pub struct AtSpeeds {
    slots: Slots,
    /// Those of a clutch next to it.
    like: Option<Slots>,
    /// Whether they are for differences between clutches.
    for_slopes: bool,
}

type Slots = Arc<Mutex<Vec<Slot>>>;

/// Of what was asked for the curve that goes farthest.
type Built = Arc<Mutex<Option<Arc<WedgeCurve>>>>;

#[derive(Debug)]
struct Slot {
    speed_rad_s: f64,
    effort: Effort,
    built: Built,
}

/// A curve at speed that is asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AtSpeed {
    /// Mean speed, rad/s.
    pub speed_rad_s: f64,
    /// Torque beyond which no further arc of it is read, N m; `None`: all of it is.
    pub reach_nm: Option<f64>,
}

impl AtSpeed {
    /// Those of `asked` that reach farthest, one at each speed.
    pub fn farthest(asked: impl Iterator<Item = Self>) -> Vec<Self> {
        let mut found: Vec<Self> = Vec::new();
        for one in asked {
            match found.iter_mut().find(|f| f.speed_rad_s == one.speed_rad_s) {
                Some(known) => {
                    known.reach_nm = known.reach_nm.zip(one.reach_nm).map(|(a, b)| a.max(b));
                }
                None => found.push(one),
            }
        }
        found
    }
}

/// Largest truncation of a quick curve whose slopes by the numbers of the clutch are good to 1e-5.
const TRUSTED_FOR_SLOPES: f64 = 1e-6;

impl AtSpeeds {
    /// The same for differences between this clutch and those next to it, in which what a quick curve leaves out all but cancels.
    pub fn for_slopes(&self) -> Self {
        Self { for_slopes: true, ..self.clone() }
    }

    /// For the same, of a clutch next to the one whose these are, once that needs no more of them.
    pub fn beside(&self) -> Self {
        Self { slots: Arc::default(), like: Some(self.slots.clone()), for_slopes: true }
    }

    /// As [`WedgeCurve::build_reaching_at`] has it of `clutch`, always the same, whose elastic laws and bodies are `statics`; `None`: that is
    /// to be asked.
    pub fn of(&self, statics: &Statics, clutch: &Clutch, asked: AtSpeed) -> Option<WedgeCurve> {
        let (AtSpeed { speed_rad_s, reach_nm }, effort) = (asked, statics.effort);
        let like = |effort: Effort| {
            self.like.as_ref().and_then(|slots| held(&slot(slots, speed_rad_s, effort)).clone())
        };
        let own = || {
            let march =
                || WedgeCurve::march(statics.clone(), speed_rad_s, reach_nm, like(effort).as_deref()).ok();
            kept(&slot(&self.slots, speed_rad_s, effort), reach_nm, march)
        };
        let full = || {
            let like = like(Effort::Full);
            let build = || {
                let full = Statics::at_effort(clutch, &statics.profile, Effort::Full).ok()?;
                WedgeCurve::march(full, speed_rad_s, reach_nm, like.as_deref()).ok()
            };
            kept(&slot(&self.slots, speed_rad_s, Effort::Full), reach_nm, build)
        };
        let trusted = if self.for_slopes { TRUSTED_FOR_SLOPES } else { effort.trusted() };
        let does = |quick: &WedgeCurve| quick.leaves_out_less_than(trusted, reach_nm);
        match like(effort) {
            Some(like) if does(&like) => own(),
            Some(_) => full(),
            None => {
                let own = own()?;
                if does(&own) { Some(own) } else { full() }
            }
        }
    }
}

/// What `built` has up to `reach_nm` (N m); `build` where that is not enough.
fn kept(
    built: &Built,
    reach_nm: Option<f64>,
    build: impl FnOnce() -> Option<WedgeCurve>,
) -> Option<WedgeCurve> {
    let goes_so_far = |curve: &Arc<WedgeCurve>| {
        curve.end().0 != EndReason::NotBuilt || reach_nm.is_some_and(|reach| curve.carries(reach))
    };
    let mut built = held(built);
    if !built.as_ref().is_some_and(goes_so_far) {
        *built = Some(Arc::new(build()?));
    }
    built.as_ref().map(|curve| curve.reaching(reach_nm))
}

fn slot(slots: &Slots, speed_rad_s: f64, effort: Effort) -> Built {
    let mut slots = held(slots);
    if let Some(slot) = slots.iter().find(|s| s.speed_rad_s == speed_rad_s && s.effort == effort) {
        return slot.built.clone();
    }
    let built = Built::default();
    slots.push(Slot { speed_rad_s, effort, built: built.clone() });
    built
}

fn held<T>(of: &Mutex<T>) -> MutexGuard<'_, T> {
    of.lock().unwrap_or_else(|e| e.into_inner())
}
