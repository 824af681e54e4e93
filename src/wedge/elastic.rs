//! What yields when a sprag is pressed between the races: every compliance of one design, ready to evaluate.

use super::axial::shaped;
use crate::clutch::{Clutch, ContactLaw, StressState};
use crate::contact::{
    Approach, ContactError, CurvedApproach, HertzBody, LayerBody, LineContact, SliceRatio, WaveShare,
    layer_share,
};
use crate::kinematics::Deformations;
use crate::material::{Material, PlaneState};
use crate::numeric::dual::Dual;
use crate::race::{Race, RaceError, body_compliance_m_per_n};

/// Why the laws of a clutch cannot be set up; a checked design never gives one.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NoElastic {
    /// A contact.
    #[error("the contact law cannot be set up: {0}")]
    Contact(ContactError),
    /// A race.
    #[error("a race cannot be set up: {0}")]
    Race(RaceError),
    /// A race too thin for what it is taken to be: a half-plane that ends in a ring. Its wall, m.
    #[error("a race with a wall of {:.4} mm between its track and its other face is too thin to be a ring \
             that bends",
        .wall_m * 1e3)]
    ThinRace {
        /// Wall, m.
        wall_m: f64,
    },
}

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
    /// Whether the contacts give along the tracks as well and roll on unstrained circumferences: law `elastic`.
    pub(super) gives_along: bool,
    /// Dundurs' beta at A and at B, positive where the race is softer than the sprag: 0 between like bodies, and where contacts do not
    /// give along the tracks.
    pub(super) unlike: [f64; 2],
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
        Self::with_layers(clutch, layer_share)
    }

    /// The same with layers in whose waves plane stress has the share `share`.
    pub(super) fn with_layers(clutch: &Clutch, share: WaveShare) -> Result<Self, NoElastic> {
        let (s, r, m) = (&clutch.sprags, &clutch.races, &clutch.materials);
        let near = match clutch.contact {
            ContactLaw::Elastic { state: StressState::PlaneStress } => PlaneState::Stress,
            _ => PlaneState::Strain,
        };
        let modulus = |race: &Material| near.contact_modulus_pa(&m.sprag, race);
        let (e_inner, e_outer) = (modulus(&m.inner_race), modulus(&m.outer_race));
        // Rings in plane strain follow Lame with E/(1-nu^2) and nu/(1-nu).
        let ring = |material: Material| match clutch.contact {
            ContactLaw::Elastic { state: StressState::PlaneStrain } => Material {
                youngs_modulus_pa: 1.0 / material.plane_strain_compliance(),
                poisson_ratio: PlaneState::Strain.transverse_ratio(material.poisson_ratio),
                ..material
            },
            _ => material,
        };
        let race = |inner: bool, material: Material| match inner {
            true => Race::inner(r.inner_bore_radius_m, r.inner_radius_m, r.width_m, material)
                .map(|race| race.with_rim(r.inner_rim)),
            false => Race::outer(r.outer_radius_m, r.outer_outside_radius_m, r.width_m, material)
                .map(|race| race.with_rim(r.outer_rim)),
        };
        let (inner_race, outer_race) = (race(true, ring(m.inner_race))?, race(false, ring(m.outer_race))?);
        let length_m = clutch.contact_length_m();
        let inner_contact = s
            .inner_arcs
            .iter()
            .map(|a| LineContact::external(a.radius_m, r.inner_radius_m, length_m, e_inner))
            .collect::<Result<Vec<_>, _>>()?;
        let outer_contact = LineContact::internal(s.outer_radius_m, r.outer_radius_m, length_m, e_outer)?;
        let half_height_m = 0.5 * (r.outer_radius_m - r.inner_radius_m);
        let half = [race(true, m.inner_race)?, race(false, m.outer_race)?];
        let law = |contact: &LineContact, side: &Race, wall_m: f64| -> Result<Approach, NoElastic> {
            Ok(match clutch.contact {
                ContactLaw::Elastic { state } => {
                    return elastic_law(contact, clutch, side, state, share);
                }
                ContactLaw::Roller { coefficient } => Approach::roller(contact, coefficient),
                ContactLaw::Slice { coefficient } => {
                    Approach::slice(contact, coefficient, SliceRatio::shared(clutch.axial.slices)?)
                }
                ContactLaw::Hertz => Approach::hertz(
                    contact,
                    [
                        HertzBody { material: m.sprag, depth_m: half_height_m },
                        HertzBody { material: *side.material(), depth_m: wall_m },
                    ],
                ),
                ContactLaw::Din26281 => Approach::din26281(contact),
            }?)
        };
        let inner_wall_m = r.inner_radius_m - r.inner_bore_radius_m;
        let outer_wall_m = r.outer_outside_radius_m - r.outer_radius_m;
        // What a race wider than the sprags does beyond (5) comes on top; the compression of the body is in it already.
        let own = clutch.contact.facts().whole_bodies;
        let band = |race: &Race| if own { race.band_compliance_m_per_n(s.count, length_m) } else { 0.0 };
        let body_width_m = if own { 0.0 } else { s.width_m };
        let straight = inner_contact.iter().map(|c| law(c, &half[0], inner_wall_m));
        let straight = straight.collect::<Result<Vec<_>, _>>()?;
        let outer = law(&outer_contact, &half[1], outer_wall_m)?;
        // Junctions share the factor of the first arc.
        let (inner, outer) = shaped(clutch, [&inner_contact[0], &outer_contact], straight, outer)?;
        Ok(Self {
            inner,
            outer,
            inner_contact,
            outer_contact,
            inner_race,
            outer_race,
            gives_along: own,
            unlike: [&m.inner_race, &m.outer_race]
                .map(|race| if own { near.dundurs_beta(race, &m.sprag) } else { 0.0 }),
            race_inner_m_per_n: inner_race.compliance_m_per_n(s.count) + band(&half[0]),
            race_outer_m_per_n: outer_race.compliance_m_per_n(s.count) + band(&half[1]),
            body_m_per_n: body_compliance_m_per_n(
                r.inner_radius_m,
                r.outer_radius_m,
                body_width_m,
                s.length_m,
                m.sprag.youngs_modulus_pa,
            ),
        })
    }

    /// The law at A on arc `arc` with the effective curvature `curvature_per_m` in place of the arc's; `None` for a
    /// law that does not know the radius.
    pub fn curved_inner(&self, arc: usize, normal_n: f64, curvature_per_m: f64) -> Option<CurvedApproach> {
        self.inner[arc].curved(normal_n, curvature_per_m)
    }

    /// delta_H at A with the radius of arc `arc` alone, m.
    pub fn pointwise_inner(&self, arc: usize, n_bi: Dual) -> Dual {
        law(&self.inner[arc], n_bi)
    }

    /// By how much the races part under the normal forces `n_bi` and `n_be` of each sprag, N: growth of both tracks in
    /// the mean, m, positive where the gap opens.
    pub fn gap_opening_m(&self, n_bi: f64, n_be: f64) -> f64 {
        self.race_inner_m_per_n * n_bi + self.race_outer_m_per_n * n_be
    }

    /// With laws that cost less ([`Approach::quickly`]).
    pub(super) fn quickly(self) -> Self {
        let inner = self.inner.into_iter().map(Approach::quickly).collect();
        Self { inner, outer: self.outer.quickly(), ..self }
    }

    /// With one more arc inside, that gives as the last does.
    pub(super) fn with_edge(mut self) -> Self {
        self.inner.extend(self.inner.last().cloned());
        self.inner_contact.extend(self.inner_contact.last().copied());
        self
    }

    /// Without growth of the rings and compression of the body.
    pub(super) fn local_only(self) -> Self {
        Self { race_inner_m_per_n: 0.0, race_outer_m_per_n: 0.0, body_m_per_n: 0.0, ..self }
    }

    /// Whether the contacts are shaped along the axis, and the law knows it.
    pub(super) fn is_shaped(&self) -> bool {
        matches!(self.outer, Approach::Shaped(_))
    }

    /// delta_H at B at `normal_n`, m, and its slope, m/N.
    pub(super) fn at_outer(&self, normal_n: f64) -> (f64, f64) {
        self.outer.at(normal_n)
    }

    /// Deformations at inner normal force `n_bi` and outer `n_be` (N), approaches `contact_inner` at A and `contact_outer` at B (m), at
    /// `speed` rad/s.
    pub(super) fn deformations(
        &self,
        n_bi: Dual,
        n_be: Dual,
        [contact_inner, contact_outer]: [Dual; 2],
        speed_rad_s: f64,
    ) -> Deformations {
        Deformations {
            race_inner: n_bi * self.race_inner_m_per_n,
            race_outer: n_be * self.race_outer_m_per_n,
            contact_inner,
            contact_outer,
            body: n_bi * self.body_m_per_n,
            bulk: Dual::constant(0.0),
            growth_m: self.outer_race.centrifugal_bore_growth_m(speed_rad_s),
        }
    }
}

fn law(approach: &Approach, n: Dual) -> Dual {
    let (value, slope) = approach.at(n.v);
    n.chain(value, slope)
}

/// The elastic law at one contact: half the sprag as a disc, the ring with its harmonics, each plane strain near
/// the contact and plane stress beyond a depth of the order of its length.
///
/// Sprag: a disc of diameter h under opposite loads, h the sprag's height, has between rim and centre
/// delta = 2q/(pi E') [ln(2h/a) - 1/2] (Johnson, *Contact Mechanics*, (5.57)), which in terms of a depth d with
/// ln(2d/a) - t/2 is d = h exp(t/2 - 1/2); it is a shaft between two contacts. What the sprag's own outline gives beyond that is
/// [`super::bulk`]'s. Ring: [`Race::effective_depth_m`], [`Race::transition_m`].
fn elastic_law(
    contact: &LineContact,
    clutch: &Clutch,
    race: &Race,
    state: StressState,
    share: WaveShare,
) -> Result<Approach, NoElastic> {
    let sprag = clutch.materials.sprag;
    let height_m = clutch.races.outer_radius_m - clutch.races.inner_radius_m;
    let (far, transitions) = match state {
        StressState::PlaneStrain => (PlaneState::Strain, [f64::INFINITY; 2]),
        StressState::PlaneStress => (PlaneState::Stress, [0.0; 2]),
        StressState::Layer => {
            let length_m = clutch.sprags.length_m;
            let disc = Race::inner(0.0, 0.5 * height_m, length_m, sprag)?;
            let transitions = [
                disc.transition_m(2, length_m, share),
                race.transition_m(clutch.sprags.count, length_m, share),
            ];
            (PlaneState::Stress, transitions)
        }
    };
    let disc_depth_m = height_m * (0.5 * far.transverse_ratio(sprag.poisson_ratio) - 0.5).exp();
    let ring_depth_m = race.effective_depth_m(clutch.sprags.count, far);
    if !ring_depth_m.is_finite() {
        return Err(NoElastic::ThinRace { wall_m: race.wall_m() });
    }
    Ok(Approach::layered(
        contact,
        [
            LayerBody { material: sprag, depth_m: disc_depth_m, transition_m: transitions[0] },
            LayerBody { material: *race.material(), depth_m: ring_depth_m, transition_m: transitions[1] },
        ],
    )?)
}
