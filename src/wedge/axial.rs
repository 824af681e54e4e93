//! How the contacts of a clutch are loaded along the axis.

use crate::contact::{
    Approach, AxialFit, ContactError, EndProfile, Flank, LineContact, RollerLaw, ShapedLaw, SliceCompliance,
    SliceContact, SliceSolution,
};
use crate::design::{self, Clutch, ContactLaw};

/// Which contact of a sprag.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// A, on the inner race.
    Inner,
    /// B, on the outer race.
    Outer,
}

/// Load and pressure along the contact `contact` of `clutch` at `side` under `normal_n` (N per sprag), by slices:
/// the paper's (1)-(4) with the slice law, slices on half-spaces with the others.
///
/// # Errors
/// [`ContactError`]; a checked design gives one only where slices cannot hold its end profile.
pub fn along(
    clutch: &Clutch,
    contact: &LineContact,
    side: Side,
    normal_n: f64,
) -> Result<SliceSolution, ContactError> {
    let fit = fit(clutch, contact, side)?;
    let slices =
        SliceContact::with_compliance(fit.cut(contact), compliance(clutch, contact)?, clutch.axial.slices)?;
    slices.solve_along(normal_n, &fit)
}

/// Whether a design asks for the pressure along its contacts: by the slice law, an end profile or a tilt.
pub fn asks_for_slices(clutch: &Clutch) -> bool {
    matches!(clutch.contact, ContactLaw::Slice { .. }) || !clutch.axial.is_straight()
}

/// The laws `inner` (one per arc) and `outer` of a clutch, shaped along the axis where the design and the law know a
/// shape; as they are otherwise. All arcs share one factor, that of the first: it is continuous across junctions, and
/// the radius enters it only through the logarithm of a width.
pub(super) fn shaped(
    clutch: &Clutch,
    contacts: [&LineContact; 2],
    inner: Vec<Approach>,
    outer: Approach,
) -> Result<(Vec<Approach>, Approach), ContactError> {
    if clutch.axial.is_straight() || !knows_shape(&clutch.contact) {
        return Ok((inner, outer));
    }
    let [a, b] = contacts;
    let shape = |base: &Approach, contact: &LineContact, side| {
        let fit = fit(clutch, contact, side)?;
        ShapedLaw::new(
            base.clone(),
            &fit.cut(contact),
            compliance(clutch, contact)?,
            clutch.axial.slices,
            &fit,
        )
    };
    let Some(first) = inner.first() else { return Ok((inner, outer)) };
    let of_first = shape(first, a, Side::Inner)?;
    let inner = inner.into_iter().map(|base| Approach::Shaped(of_first.on(base))).collect();
    let outer = Approach::Shaped(shape(&outer, b, Side::Outer)?);
    Ok((inner, outer))
}

/// Whether the approach of a law follows end profile and tilt; the roller laws spread the load evenly.
pub fn knows_shape(law: &ContactLaw) -> bool {
    !matches!(law, ContactLaw::Roller { .. } | ContactLaw::Din26281)
}

fn compliance(clutch: &Clutch, contact: &LineContact) -> Result<SliceCompliance, ContactError> {
    Ok(match clutch.contact {
        ContactLaw::Slice { coefficient } => SliceCompliance::Roller(RollerLaw::new(contact, coefficient)?),
        _ => SliceCompliance::HalfSpace,
    })
}

/// Sprag and race side by side; a tilted sprag opens A on one side and B on the other.
fn fit(clutch: &Clutch, contact: &LineContact, side: Side) -> Result<AxialFit, ContactError> {
    let axial = &clutch.axial;
    let sprag_m = clutch.sprags.length_m;
    // A profile is made for a load on the whole sprag.
    let whole = LineContact { length_m: sprag_m, ..*contact };
    let profile = match &axial.end_profile {
        design::EndProfile::Square => EndProfile::Square,
        design::EndProfile::Lundberg { design_load_n } => EndProfile::lundberg(&whole, *design_load_n)?,
        design::EndProfile::Crown { radius_m } => EndProfile::crown_radius(*radius_m, sprag_m)?,
        design::EndProfile::EndRelief { length_m, radius_m } => EndProfile::end_relief(*length_m, *radius_m)?,
        design::EndProfile::FujiwaraKawase { design_load_n, load_factor, crowned_ratio, end_drop_m } => {
            EndProfile::fujiwara_kawase(&whole, *design_load_n, *load_factor, *crowned_ratio, *end_drop_m)?
        }
        design::EndProfile::Table { points_m } => EndProfile::table(points_m.clone())?,
    };
    let tilt_rad = match side {
        Side::Inner => axial.tilt_rad,
        Side::Outer => -axial.tilt_rad,
    };
    let sprag = Flank { length_m: sprag_m, middle_m: axial.offset_m, profile };
    AxialFit::new([sprag, Flank::straight(clutch.races.width_m)], tilt_rad)
}
