//! What yields when a sprag is pressed between the races: every compliance of one design, ready to evaluate.

use std::sync::Arc;

use crate::contact::{Approach, ContactError, HertzBody, LineContact, SliceRatio};
use crate::design::{Clutch, ContactLaw};
use crate::kinematics::Deformations;
use crate::material::{Material, contact_modulus_pa};
use crate::numeric::dual::Dual;
use crate::race::{Race, RaceError, body_compliance_m_per_n};

/// Why the laws of a clutch cannot be set up; a checked design never gives one.
#[derive(Debug, Clone, PartialEq)]
pub enum NoElastic {
    /// A contact.
    Contact(ContactError),
    /// A race.
    Race(RaceError),
}

impl std::fmt::Display for NoElastic {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Contact(why) => write!(f, "the contact law cannot be set up: {why}"),
            Self::Race(why) => write!(f, "a race cannot be set up: {why}"),
        }
    }
}

impl std::error::Error for NoElastic {}

impl From<ContactError> for NoElastic {
    fn from(e: ContactError) -> Self {
        Self::Contact(e)
    }
}
impl From<RaceError> for NoElastic {
    fn from(e: RaceError) -> Self {
        Self::Race(e)
    }
}

/// Compliances of one clutch. Race growths are per normal force of one sprag, all sprags loaded alike.
#[derive(Debug, Clone)]
pub struct Elastic {
    /// Local law at A, one per inner arc.
    inner: Vec<Approach>,
    /// Local law at B.
    outer: Approach,
    /// Hertz pressure at A, one per arc.
    pub inner_contact: Vec<LineContact>,
    /// Hertz pressure at B.
    pub outer_contact: LineContact,
    /// Inner race.
    pub inner_race: Race,
    /// Outer race.
    pub outer_race: Race,
    race_inner_m_per_n: f64,
    race_outer_m_per_n: f64,
    body_m_per_n: f64,
}

impl Elastic {
    /// Assemble the laws that the design names.
    ///
    /// The logarithmic law counts the compression of the sprag down to half its height and of a race down to
    /// its wall (a solid shaft: its radius); the rings' mean growth is (5), on top.
    pub fn new(clutch: &Clutch) -> Result<Self, NoElastic> {
        let (s, r, m) = (&clutch.sprags, &clutch.races, &clutch.materials);
        let e_inner = contact_modulus_pa(&m.sprag, &m.inner_race);
        let e_outer = contact_modulus_pa(&m.sprag, &m.outer_race);
        let inner_contact = s
            .inner_arcs
            .iter()
            .map(|a| LineContact::external(a.radius_m, r.inner_radius_m, s.length_m, e_inner))
            .collect::<Result<Vec<_>, _>>()?;
        let outer_contact = LineContact::internal(s.outer_radius_m, r.outer_radius_m, s.length_m, e_outer)?;
        let ratio = match clutch.contact {
            ContactLaw::Slice { slices, .. } => Some(Arc::new(SliceRatio::new(slices)?)),
            _ => None,
        };
        let half_height_m = 0.5 * (r.outer_radius_m - r.inner_radius_m);
        let law = |contact: &LineContact, race: Material, wall_m: f64| match (clutch.contact, &ratio) {
            (ContactLaw::Roller { coefficient }, _) => Approach::roller(contact, coefficient),
            (ContactLaw::Slice { coefficient, .. }, Some(ratio)) => {
                Approach::slice(contact, coefficient, ratio.clone())
            }
            (ContactLaw::Hertz, _) => Approach::hertz(
                contact,
                [
                    HertzBody { material: m.sprag, depth_m: half_height_m },
                    HertzBody { material: race, depth_m: wall_m },
                ],
            ),
            _ => Approach::din26281(contact),
        };
        let inner_wall_m = r.inner_radius_m - r.inner_bore_radius_m;
        let outer_wall_m = r.outer_outside_radius_m - r.outer_radius_m;
        let inner_race = Race::inner(r.inner_bore_radius_m, r.inner_radius_m, r.width_m, m.inner_race)?;
        let outer_race = Race::outer(r.outer_radius_m, r.outer_outside_radius_m, r.width_m, m.outer_race)?;
        Ok(Self {
            inner: inner_contact
                .iter()
                .map(|c| law(c, m.inner_race, inner_wall_m))
                .collect::<Result<Vec<_>, _>>()?,
            outer: law(&outer_contact, m.outer_race, outer_wall_m)?,
            inner_contact,
            outer_contact,
            inner_race,
            outer_race,
            race_inner_m_per_n: inner_race.compliance_m_per_n(s.count),
            race_outer_m_per_n: outer_race.compliance_m_per_n(s.count),
            body_m_per_n: body_compliance_m_per_n(
                r.inner_radius_m,
                r.outer_radius_m,
                s.width_m,
                s.length_m,
                m.sprag.youngs_modulus_pa,
            ),
        })
    }

    /// Deformations at inner normal force `n_bi` and outer `n_be` (N) on arc `arc` at `speed` rad/s.
    pub fn deformations(&self, arc: usize, n_bi: Dual, n_be: Dual, speed_rad_s: f64) -> Deformations {
        let law = |approach: &Approach, n: Dual| {
            n.chain(approach.approach_m(n.v), approach.compliance_m_per_n(n.v))
        };
        Deformations {
            race_inner: n_bi * self.race_inner_m_per_n,
            race_outer: n_be * self.race_outer_m_per_n,
            contact_inner: law(&self.inner[arc], n_bi),
            contact_outer: law(&self.outer, n_be),
            body: n_bi * self.body_m_per_n,
            growth_m: self.outer_race.centrifugal_bore_growth_m(speed_rad_s),
        }
    }
}
