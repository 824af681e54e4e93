//! What an element shows to the outside.

use super::Element;
use crate::dynamics::{Grip, Place};

/// Motion of one race, absolute.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Flange {
    /// Angle, rad.
    pub angle_rad: f64,
    /// Speed, rad/s.
    pub speed_rad_s: f64,
    /// Acceleration, rad/s^2.
    pub acceleration_rad_s2: f64,
    /// Torque of the flange on the race, N m: as it was given, or what the given speed takes.
    pub torque_nm: f64,
}

/// One contact of a sprag.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Sign of the slip velocity, that of the race less that of the sprag; 0: it holds, or there is no contact.
    pub slips: i8,
    /// Normal force, N.
    pub normal_n: f64,
    /// Tangential force T_bi or T_be, N.
    pub tangential_n: f64,
}

impl Contact {
    /// |T|/N: the friction that is called on; 0 without a force.
    pub fn friction(&self) -> f64 {
        if self.normal_n > 0.0 { self.tangential_n.abs() / self.normal_n } else { 0.0 }
    }
}

/// Motion and forces at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Motion {
    /// Time, s.
    pub t_s: f64,
    /// Inner and outer race.
    pub flanges: [Flange; 2],
    /// A and B of each sprag.
    pub contacts: [Contact; 2],
    /// Whether A carries nothing because the sprag stands off the inner race.
    pub open: bool,
    /// alpha, rad.
    pub alpha_rad: f64,
}

impl Motion {
    /// Whether every number is one.
    pub(super) fn is_finite(&self) -> bool {
        let flanges = self
            .flanges
            .iter()
            .flat_map(|f| [f.angle_rad, f.speed_rad_s, f.acceleration_rad_s2, f.torque_nm]);
        let contacts = self.contacts.iter().flat_map(|c| [c.normal_n, c.tangential_n]);
        flanges.chain(contacts).all(f64::is_finite)
    }
}

impl Element {
    /// Motion and forces now, under the torques or accelerations at the end of the last advance, the torques of the balance
    /// at the beginning, or those [applied](Element::apply) since.
    pub fn motion(&self) -> Motion {
        let model = &self.model;
        let (y, mode) = (self.at.memory.state(), self.at.memory.mode());
        let p = model.point(mode.place, y[0]);
        let rates = model.rates(&mode, &p, y);
        let f = model.forces(&mode, 0.0, y);
        let torques_nm = model.flange_torques_nm(0.0, y, &p, &rates, &f);
        let speed_rad_s = model.curve.speed_rad_s();
        let flange = |i: usize| Flange {
            angle_rad: self.at.turned_rad[i] + speed_rad_s * self.at.elapsed_s + y[2 + i],
            speed_rad_s: speed_rad_s + rates[2 + i],
            acceleration_rad_s2: f.acceleration[2 + i],
            torque_nm: torques_nm[i],
        };
        let open = matches!(mode.place, Place::Open | Place::Carried);
        let slips = |grip: Grip, apart: bool| match grip {
            Grip::Slip(sign) if !apart => sign as i8,
            _ => 0,
        };
        let contact = |slips: i8, normal_n: f64, tangential_n: f64| Contact { slips, normal_n, tangential_n };
        Motion {
            t_s: self.at.t_s,
            flanges: [flange(0), flange(1)],
            contacts: [
                contact(slips(mode.inner, open), f.n_bi, f.t_bi),
                contact(slips(mode.outer, false), f.n_be, f.t_be),
            ],
            open,
            alpha_rad: y[0],
        }
    }
}
