//! A line contact of finite length between half-spaces, or between bodies that end.

use super::conjugate::{ConjugateSettings, HalfSpaceStatus};
use super::influence::{HalfSpaceGrid, PatchSolution};
use crate::contact::axial::{AxialFit, ContactEnd, slice_middles_m};
use crate::contact::edge::{Edge, End, Peak, edges_and_peak};
use crate::contact::line::{ContactError, LineContact, positive};
use crate::material::Material;

/// Fidelity `reference`: the contact solved on a grid `across` x `along` cells.
///
/// Bodies are half-spaces that go on beyond the ends, so a sharp end is singular ([`Edge::Singular`]), unless
/// [`Self::with_free_ends`] corrects for the free faces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HalfSpaceLine {
    contact: LineContact,
    across: usize,
    along: usize,
    reach: f64,
    free: Option<[Material; 2]>,
    settings: ConjugateSettings,
}

/// What the reference finds.
///
/// # Conventions
/// y from the middle of the contact, rows of cells numbered along it; pressures and loads not negative.
#[derive(Debug, Clone, PartialEq)]
pub struct HalfSpaceLineSolution {
    /// Approach of the bodies, m, from the first touch of the rigid shapes.
    pub approach_m: f64,
    /// Middles of the rows, m.
    pub y_m: Vec<f64>,
    /// Force on each row, N.
    pub load_n: Vec<f64>,
    /// Peak pressure of each row, Pa: the largest of its cells.
    pub pressure_pa: Vec<f64>,
    /// Half width of the loaded cells of each row, m.
    pub half_width_m: Vec<f64>,
    /// Largest pressure and where.
    pub peak: Peak,
    /// The two ends, at -l/2 and +l/2.
    pub edges: [Edge; 2],
    /// Width of the patch solved on, m.
    pub patch_width_m: f64,
    /// How the iteration ended.
    pub status: HalfSpaceStatus,
}

/// Factor psi by which the load mirrored at a free end face softens a half-space into a quarter-space.
///
/// The mirrored load takes the shear stress off the end face (Hetenyi); raised to
/// psi = 1.29 - (0.08 - 0.5 nu)/(1 - nu) it stands for taking off the normal stress as well: Guilbault, *A fast
/// correction for elastic quarter-space applied to 3D modeling of edge contact problems*, J. Tribol. 133 (2011)
/// 031402. `poisson_ratio` in 0..0.5.
///
/// One factor for all loads cannot be exact: psi > 1 takes the pressure to 0 as cells at the face get narrower,
/// where two flush quarter-spaces have a finite one. Good for the line load some half widths in and for the
/// approach, not for the value in the last cells.
pub fn free_end_factor(poisson_ratio: f64) -> f64 {
    1.29 - (0.08 - 0.5 * poisson_ratio) / (1.0 - poisson_ratio)
}

impl HalfSpaceLine {
    /// `across` (even) cells over 1.8 Hertzian half widths each way, `along` rows over the length.
    pub fn new(contact: LineContact, across: usize, along: usize) -> Self {
        let settings = ConjugateSettings::default();
        Self { contact, across, along, reach: 1.8, free: None, settings }
    }

    /// The patch starts at `half_widths` each way (it is widened where the contact reaches its sides).
    pub fn reaching(self, half_widths: f64) -> Self {
        Self { reach: half_widths, ..self }
    }

    /// Free faces where a body of the [`AxialFit`] ends: its share of the compliance sees the mirrored load, times
    /// [`free_end_factor`]. A body that goes on beyond the contact stays a half-space.
    pub fn with_free_ends(self, materials: [Material; 2]) -> Self {
        Self { free: Some(materials), ..self }
    }

    /// Other limits for the iteration.
    pub fn with_settings(self, settings: ConjugateSettings) -> Self {
        Self { settings, ..self }
    }

    /// Square ends within a longer body, no tilt.
    pub fn solve(&self, normal_n: f64) -> Result<HalfSpaceLineSolution, ContactError> {
        self.solve_along(normal_n, &AxialFit::square(self.contact.length_m)?)
    }

    /// The contact of two bodies that lie as `fit` says, under `normal_n`; not positive: unloaded.
    pub fn solve_along(&self, normal_n: f64, fit: &AxialFit) -> Result<HalfSpaceLineSolution, ContactError> {
        let LineContact { effective_radius_m, length_m, contact_modulus_pa } = self.contact;
        if (length_m - fit.length_m()).abs() > 1e-9 * length_m {
            return Err(ContactError::Length { contact_m: length_m, overlap_m: fit.length_m() });
        }
        let cells = [self.across, self.along];
        let mirrors = self.mirrors(fit);
        let a = self.contact.half_width_m(if normal_n > 0.0 { normal_n } else { 1.0 });
        let mut patch_width_m = 2.0 * positive("reach", self.reach)? * positive("half width, m", a)?;
        let mut grid = HalfSpaceGrid::new([patch_width_m, length_m], cells, contact_modulus_pa, mirrors)?;
        if normal_n.is_nan() || normal_n <= 0.0 {
            let pressure_pa = vec![0.0; self.across / 2 * self.along];
            let none = PatchSolution { approach_m: 0.0, pressure_pa, status: HalfSpaceStatus::Unloaded };
            return Ok(self.along_rows(&grid, none, fit, patch_width_m));
        }
        let gap = |x: f64, y: f64| x * x / (2.0 * effective_radius_m) + fit.gap_m(y);
        let mut found =
            grid.solve(normal_n, gap, |x, _| (1.0 - (x / a).powi(2)).max(0.0).sqrt(), &self.settings)?;
        // a local load above the mean is wider: the outermost cells must stay free
        for _ in 0..20 {
            if !found.pressure_pa.iter().rev().take(self.along).any(|p| *p > 0.0) {
                break;
            }
            patch_width_m *= 1.5;
            grid = HalfSpaceGrid::new([patch_width_m, length_m], cells, contact_modulus_pa, mirrors)?;
            found = grid.solve(normal_n, gap, |_, _| 1.0, &self.settings)?;
        }
        Ok(self.along_rows(&grid, found, fit, patch_width_m))
    }

    fn mirrors(&self, fit: &AxialFit) -> [f64; 2] {
        let Some(materials) = self.free else { return [0.0; 2] };
        let whole: f64 = materials.iter().map(Material::plane_strain_compliance).sum();
        let share = materials.map(|m| m.plane_strain_compliance() / whole * free_end_factor(m.poisson_ratio));
        fit.ends().map(|end| match end {
            ContactEnd::One { body } => share[body],
            ContactEnd::Flush => share[0] + share[1],
        })
    }

    fn along_rows(
        &self,
        grid: &HalfSpaceGrid,
        found: PatchSolution,
        fit: &AxialFit,
        patch_width_m: f64,
    ) -> HalfSpaceLineSolution {
        let [dx, dy] = grid.cell_m();
        let rows = self.along;
        let sum = |j: usize, of: &dyn Fn(f64) -> f64| -> f64 {
            found.pressure_pa.iter().skip(j).step_by(rows).map(|p| of(*p)).sum()
        };
        let load_n: Vec<f64> = (0..rows).map(|j| 2.0 * dx * dy * sum(j, &|p| p)).collect();
        let half_width_m = (0..rows).map(|j| dx * sum(j, &|p| if p > 0.0 { 1.0 } else { 0.0 })).collect();
        let row_peak =
            |j: usize| found.pressure_pa.iter().skip(j).step_by(rows).fold(0.0, |m: f64, p| m.max(*p));
        let pressure_pa: Vec<f64> = (0..rows).map(row_peak).collect();
        let y_m = slice_middles_m(self.contact.length_m, rows);
        let (edges, peak) = edges_and_peak(&load_n, &pressure_pa, &y_m, dy, End::of(fit));
        HalfSpaceLineSolution {
            approach_m: found.approach_m,
            y_m,
            load_n,
            pressure_pa,
            half_width_m,
            peak,
            edges,
            patch_width_m,
            status: found.status,
        }
    }
}
