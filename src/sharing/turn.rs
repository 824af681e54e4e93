//! A turn of the races: tracks that run out stand otherwise against unlike sprags every time.

use super::{Asked, NotShared, Shared, Unlike};
use crate::clutch::{Clutch, Sharing};
use crate::wedge::WedgeCurve;
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Places of the widest gap that are looked at in a turn, every 30 deg: a choice.
const PLACES: usize = 12;
/// Halvings that locate an end of the torque.
const HALVINGS: usize = 24;

/// An unlike clutch with its widest gap, or the first azimuth of an inner track out of round, at every place of a turn; one place where
/// neither is.
#[derive(Debug, Clone)]
pub struct Turn<'a> {
    /// The clutch as it engaged, and how far the widest gap has turned on since, rad. A clutch that turns against the offset
    /// engages at the first place and is turned on under load; otherwise it engages at each.
    pub places: Vec<(Unlike<'a>, f64)>,
}

impl<'a> Turn<'a> {
    /// The clutch whose curve at rest is `curve`.
    pub fn new(clutch: &Clutch, sharing: &Sharing, curve: &'a WedgeCurve) -> Self {
        let first = Unlike::new(clutch, sharing, curve, 0.0);
        let lobed = sharing.tracks.iter().any(|track| !track.outer);
        let count = if first.offset_m > 0.0 || lobed { PLACES } else { 1 };
        // Lobes pass the sprags: each place meets them at another part of a pitch.
        let step = if lobed { 1.0 + 1.0 / clutch.sprags.count as f64 } else { 1.0 };
        let turns_on = clutch.races.eccentricity.is_some_and(|e| e.turning);
        let place = |k: usize| {
            let phase = TAU * k as f64 / count as f64 * step;
            if turns_on || k == 0 {
                (first.clone(), phase)
            } else {
                (first.engaged_at(sharing.start, phase), 0.0)
            }
        };
        Self { places: (0..count).map(place).collect() }
    }

    /// The clutch at its first place.
    pub fn first(&self) -> &Unlike<'a> {
        &self.places[0].0
    }

    /// At `torque_nm`, place after place.
    ///
    /// # Errors
    /// The [`NotShared`] of the first place that does not carry it.
    pub fn at(&self, torque_nm: f64) -> Result<Vec<Shared>, NotShared> {
        self.each(torque_nm).into_iter().collect()
    }

    fn each(&self, torque_nm: f64) -> Vec<Result<Shared, NotShared>> {
        (0..self.places.len()).into_par_iter().map(|k| self.carrying(k, torque_nm)).collect()
    }

    /// At `torque_nm` at one place.
    fn carrying(&self, place: usize, torque_nm: f64) -> Result<Shared, NotShared> {
        let (clutch, turned) = &self.places[place];
        clutch.carrying(Asked::Torque(torque_nm), *turned)
    }

    /// Torque, N m, up to `beyond_nm` that is carried at every place, to 1e-7 of that, and what ends it; `None`: all of it. A place that
    /// carries a torque is taken to carry every smaller one: the end of one place is asked of the others.
    pub fn end(&self, beyond_nm: f64) -> Option<(f64, NotShared)> {
        let why = |(place, found): (usize, &Result<Shared, NotShared>)| Some((place, *found.as_ref().err()?));
        let (mut place, why) = self.each(beyond_nm).iter().enumerate().find_map(why)?;
        let fails = |place: usize, torque: f64| self.carrying(place, torque).is_err();
        let mut missed = beyond_nm;
        loop {
            let (mut held, mut beyond) = (0.0, beyond_nm);
            for _ in 0..HALVINGS {
                let torque = 0.5 * (held + beyond);
                *(if torque >= missed || fails(place, torque) { &mut beyond } else { &mut held }) = torque;
            }
            let others = (0..self.places.len()).into_par_iter().filter(|other| held > 0.0 && *other != place);
            match others.find_first(|other| fails(*other, held)) {
                Some(other) => (place, missed) = (other, held),
                None => return Some((held, self.at(beyond).err().unwrap_or(why))),
            }
        }
    }
}
