//! How the contacts of a clutch are loaded along the axis.

use crate::clutch::{self, Clutch, ContactLaw};
#[cfg(feature = "validation")]
use crate::contact::half_space::{HalfSpaceLine, HalfSpaceStatus};
use crate::contact::{
    Approach, AxialFit, ContactError, Edge, EndDrop, Flank, LineContact, Peak, RollerLaw, ShapedLaw,
    SliceCompliance, SliceContact, SliceRatio, SliceStatus,
};
use crate::material::PlaneState;

/// Which contact of a sprag.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// A, on the inner race.
    Inner,
    /// B, on the outer race.
    Outer,
}

/// How load and pressure along a contact are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Lengthwise {
    /// By slices: the paper's (1)-(4) with the slice law, slices on half-spaces with the others.
    Slices,
    /// The half-space solved on a grid over the patch, two rows a slice; a thousand times the time.
    #[cfg(feature = "validation")]
    Reference,
    /// The same with free faces where a body ends: the quarter-space correction.
    #[cfg(feature = "validation")]
    FreeEnds,
}

/// Load and pressure along a contact.
#[derive(Debug, Clone, PartialEq)]
pub struct Along {
    /// Middles of the slices or rows from the middle of the contact, m.
    pub y_m: Vec<f64>,
    /// Force on each, N.
    pub load_n: Vec<f64>,
    /// Peak pressure of each, Pa.
    pub pressure_pa: Vec<f64>,
    /// The two ends, at -l/2 and +l/2.
    pub edges: [Edge; 2],
    /// Largest pressure and where.
    pub peak: Peak,
    /// Whether the solution settled.
    pub converged: bool,
}

/// Cells of the reference across the patch: approaches to 0.05 %, pressures in the middle to 0.1 %.
#[cfg(feature = "validation")]
const ACROSS: usize = 64;

/// Load and pressure along the contact `contact` of `clutch` at `side` under `normal_n` (N per sprag).
///
/// # Errors
/// [`ContactError`]; a checked design gives one only where slices cannot hold its end profile, or where the grid of
/// the reference would be too large.
pub fn along(
    clutch: &Clutch,
    contact: &LineContact,
    side: Side,
    normal_n: f64,
    how: Lengthwise,
) -> Result<Along, ContactError> {
    match how {
        Lengthwise::Slices => along_drawn(clutch, contact, contact, side, normal_n),
        #[cfg(feature = "validation")]
        Lengthwise::Reference | Lengthwise::FreeEnds => {
            let fit = fit(clutch, contact, side)?;
            let grid = HalfSpaceLine::new(fit.cut(contact), ACROSS, 2 * clutch.axial.slices);
            let m = &clutch.materials;
            let race = if side == Side::Inner { m.inner_race } else { m.outer_race };
            let free = how == Lengthwise::FreeEnds;
            let grid = if free { grid.with_free_ends([m.sprag, race]) } else { grid };
            let s = grid.solve_along(normal_n, &fit)?;
            Ok(Along {
                y_m: s.y_m,
                load_n: s.load_n,
                pressure_pa: s.pressure_pa,
                edges: s.edges,
                peak: s.peak,
                converged: matches!(s.status, HalfSpaceStatus::Converged { .. } | HalfSpaceStatus::Unloaded),
            })
        }
    }
}

/// The same by slices on `contact`, with the end profile that is made for `drawn`.
///
/// # Errors
/// As [`along`].
pub fn along_drawn(
    clutch: &Clutch,
    drawn: &LineContact,
    contact: &LineContact,
    side: Side,
    normal_n: f64,
) -> Result<Along, ContactError> {
    let fit = fit(clutch, drawn, side)?;
    let law =
        SliceContact::with_compliance(fit.cut(contact), compliance(clutch, contact)?, clutch.axial.slices)?;
    let s = law.solve_along(normal_n, &fit)?;
    Ok(Along {
        y_m: s.y_m,
        load_n: s.load_n,
        pressure_pa: s.pressure_pa,
        edges: s.edges,
        peak: s.peak,
        converged: !matches!(s.status, SliceStatus::NoConvergence { .. }),
    })
}

/// By how much (relative) slices under a rigid approach come nearer than the even load that the other laws spread along
/// a straight contact, at A under a Hertz pressure of 2 GPa: what leaving the slices out costs in approach. `None` for a
/// contact that is none.
pub fn even_load_error(clutch: &Clutch) -> Option<f64> {
    const PRESSURE_PA: f64 = 2e9;
    let m = &clutch.materials;
    let modulus = PlaneState::Strain.contact_modulus_pa(&m.sprag, &m.inner_race);
    let radius = clutch.sprags.inner_arcs.first()?.radius_m;
    let race = clutch.races.inner_radius_m;
    let contact = LineContact::external(radius, race, clutch.contact_length_m(), modulus).ok()?;
    // p_0 = sqrt(q E*/(pi R))
    let line_load = std::f64::consts::PI * contact.effective_radius_m * PRESSURE_PA.powi(2) / modulus;
    let half_width = contact.half_width_m(line_load * contact.length_m);
    let ratio = SliceRatio::shared(clutch.axial.slices).ok()?.at(half_width / contact.length_m).0;
    Some(1.0 - ratio)
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
    if clutch.axial.is_straight() || !clutch.contact.facts().knows_shape {
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
        clutch::EndProfile::Square => EndDrop::Square,
        clutch::EndProfile::Lundberg { design_load_n } => EndDrop::lundberg(&whole, *design_load_n)?,
        clutch::EndProfile::Crown { radius_m } => EndDrop::crown_radius(*radius_m, sprag_m)?,
        clutch::EndProfile::EndRelief { length_m, radius_m } => EndDrop::end_relief(*length_m, *radius_m)?,
        clutch::EndProfile::FujiwaraKawase { design_load_n, load_factor, crowned_ratio, end_drop_m } => {
            EndDrop::fujiwara_kawase(&whole, *design_load_n, *load_factor, *crowned_ratio, *end_drop_m)?
        }
        clutch::EndProfile::Table { points_m } => EndDrop::table(points_m.clone())?,
    };
    let tilt_rad = match side {
        Side::Inner => axial.tilt_rad,
        Side::Outer => -axial.tilt_rad,
    };
    let sprag = Flank { length_m: sprag_m, middle_m: axial.offset_m, profile };
    AxialFit::new([sprag, Flank::straight(clutch.races.width_m)], tilt_rad)
}
