//! Curves of one clutch at several mean speeds, each built once for all who ask.

use super::build::Effort;
use super::curve::{EndReason, WedgeCurve};
use std::sync::{Arc, Mutex, OnceLock};

/// Of a clutch whose curve at rest is known: its curves at speed, built by whoever asks first. Clones share them. What is answered
/// does not depend on who that was.
#[derive(Debug, Clone, Default)]
pub struct AtSpeeds {
    slots: Arc<Mutex<Vec<Slot>>>,
    /// Those of a clutch next to it.
    like: Option<Arc<Mutex<Vec<Slot>>>>,
}

#[derive(Debug)]
struct Slot {
    speed_rad_s: f64,
    effort: Effort,
    built: Arc<OnceLock<Option<WedgeCurve>>>,
}

impl AtSpeeds {
    /// Of a clutch next to the one whose these are.
    pub fn beside(&self) -> Self {
        Self { slots: Arc::default(), like: Some(self.slots.clone()) }
    }

    /// As [`WedgeCurve::build_reaching_at`] has it of the clutch that `known`, always the same, is of, whose elastic laws and bodies
    /// stand already; `None`: that is to be asked.
    pub fn of(
        &self,
        known: &WedgeCurve,
        speed_rad_s: f64,
        reach_nm: Option<f64>,
        effort: Effort,
    ) -> Option<WedgeCurve> {
        let like = self.like.as_ref().map(|like| slot(like, speed_rad_s, effort));
        let like = like.as_ref().and_then(|slot| slot.get()?.as_ref());
        let march = || known.marched(speed_rad_s, reach_nm, effort, like);
        let slot = slot(&self.slots, speed_rad_s, effort);
        let built = slot.get_or_init(march);
        let goes_so_far = |curve: &WedgeCurve| {
            curve.end().0 != EndReason::NotBuilt || reach_nm.is_some_and(|reach| curve.carries(reach))
        };
        match built {
            Some(curve) if goes_so_far(curve) => Some(curve.reaching(reach_nm)),
            // Whoever asked first needed less of it.
            Some(_) => march(),
            None => None,
        }
        .filter(WedgeCurve::is_trusted)
    }
}

fn slot(slots: &Mutex<Vec<Slot>>, speed_rad_s: f64, effort: Effort) -> Arc<OnceLock<Option<WedgeCurve>>> {
    let mut slots = slots.lock().unwrap_or_else(|e| e.into_inner());
    if let Some(slot) = slots.iter().find(|s| s.speed_rad_s == speed_rad_s && s.effort == effort) {
        return slot.built.clone();
    }
    let built = Arc::default();
    slots.push(Slot { speed_rad_s, effort, built: Arc::clone(&built) });
    built
}
