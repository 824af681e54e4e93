//! Sprags as they come out of the box: deviations drawn from a seed, or given by number.

use crate::clutch::Sharing;
use std::f64::consts::TAU;

/// One sprag.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OneSprag {
    /// Azimuth from sprag 0's even place, rad.
    pub azimuth_rad: f64,
    /// How much more it measures across its contacts than as drawn, m.
    pub size_m: f64,
    /// What it lacks to touch when torque begins, m.
    pub gap_m: f64,
    /// Static friction of its contacts.
    pub friction: f64,
    /// Stiffness of its spring over that as drawn.
    pub spring: f64,
    /// Whether it is not there.
    pub missing: bool,
}

/// The `count` sprags of a clutch with static friction `friction`: each evenly within the bounds of `sharing`, from its seed, then as it is
/// given. A bound does not change what is drawn within another.
pub fn drawn(sharing: &Sharing, count: usize, friction: f64) -> Vec<OneSprag> {
    let mut random = fastrand::Rng::with_seed(sharing.seed);
    let mut sprags: Vec<OneSprag> = (0..count)
        .map(|i| {
            let [size, gap, azimuth, rubs] = std::array::from_fn(|_| random.f64());
            let either_way = |share: f64, within: f64| (2.0 * share - 1.0) * within;
            OneSprag {
                azimuth_rad: TAU * i as f64 / count as f64 + either_way(azimuth, sharing.azimuth_within_rad),
                size_m: either_way(size, sharing.size_within_m),
                gap_m: gap * sharing.gap_up_to_m,
                friction: friction + either_way(rubs, sharing.friction_within),
                spring: 1.0,
                missing: false,
            }
        })
        .collect();
    for given in &sharing.given {
        let Some(sprag) = sprags.get_mut(given.index) else { continue };
        let even = TAU * given.index as f64 / count as f64;
        *sprag = OneSprag {
            azimuth_rad: given.azimuth_rad.map_or(sprag.azimuth_rad, |ahead| even + ahead),
            size_m: given.size_m.unwrap_or(sprag.size_m),
            gap_m: given.gap_m.unwrap_or(sprag.gap_m),
            friction: given.friction.unwrap_or(sprag.friction),
            spring: given.spring.unwrap_or(sprag.spring),
            missing: given.missing,
        };
    }
    sprags
}
