//! Lubricants and what a film between two rubbing bodies does: thickness, shear, heat, wear.
//!
//! In: viscosities, radii, moduli, loads, speeds, SI (temperatures in C). Out: film thickness with its regime, shear
//! forces, load share of asperities, temperatures, wear depths; [`OILS`]. Absent: any clutch (`friction` puts its
//! contact A on a film, `scenario` asks for the heat balance), starvation, churning, roughness pattern. Equations:
//! Walther (ASTM D341), Gold's alpha, Moes' line contact, Couette and rolling shear, Nahme's reduction, Olver and
//! Spikes' share, Blok's flash, Archard's wear.

mod film;
mod flash;
mod heat;
mod oil;
mod shear;
mod viscosity;
mod wear;

pub use film::{Film, FilmContact, Fluid, Regime, film, squeeze_n_s_per_m, squeeze_out_s};
pub use flash::{Flash, flash_k, peclet, stays_s};
pub use heat::{
    Heat, Network, STEEL_CONDUCTIVITY, STEEL_DIFFUSIVITY_M2_S, STEEL_EFFUSIVITY, Temperatures, moving_strip,
    standing_strip,
};
pub use oil::{BaseOil, OILS, Oil, oil};
pub use shear::{Shear, asperity_share, nahme_factor, roelands, shear};
pub use viscosity::{OIL_CONDUCTIVITY, Walther};
pub use wear::{flat_depth_m, track_depth_m};
