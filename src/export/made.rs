//! A design as it is made, placed and closed: what drawings, solids and tables are made of.

use super::part::{DrawnClutch, Part};
use crate::clutch::Clutch;
use crate::design::Design;
use crate::file::DesignError;
use crate::profile::{Outline, OutlineError, Profile, ProfileError};

/// A clutch before press fits, at the reference temperature, with its profile and, where flanks are known, its outline.
#[derive(Debug, Clone)]
pub struct MadeClutch {
    /// The clutch.
    pub clutch: Clutch,
    /// Its profile.
    pub profile: Profile,
    /// Its outline.
    pub outline: Option<Outline>,
}

/// Why a part of a design cannot be drawn.
#[derive(Debug, thiserror::Error)]
pub enum NoPart {
    /// The races as made are no clutch.
    #[error("{0}")]
    Refused(DesignError),
    /// The profile cannot be placed.
    #[error("the profile cannot be placed: {0}")]
    Profile(ProfileError),
    /// The outline does not close.
    #[error("the outline does not close: {0}")]
    Outline(OutlineError),
    /// No flanks close the outline.
    #[error("the outline of the sprag is open: found neither sprags.flanks nor a sprags.width_mm above 0; \
             give [sprags] flanks{}; or let optimize find them with flank_rear_mm and flank_front_mm among \
             its variables",
        for_example(*.narrowest_m))]
    Open {
        /// Widths of the narrowest flanks that would, rear and front, m.
        narrowest_m: Option<[f64; 2]>,
    },
}

fn for_example(narrowest_m: Option<[f64; 2]>) -> String {
    narrowest_m.map_or_else(String::new, |both| {
        let [rear, front] = both.map(|m| (m * 1e6).ceil() / 1e3);
        format!(", for example flanks = {{ rear_mm = {rear}, front_mm = {front} }}, the narrowest")
    })
}

impl Design {
    /// The clutch as made, ready to be drawn.
    ///
    /// # Errors
    /// [`NoPart`], but for an open outline, which [`MadeClutch::closed`] refuses.
    pub fn made_clutch(&self) -> Result<MadeClutch, NoPart> {
        let clutch = self.as_made().map_err(NoPart::Refused)?;
        let profile = clutch.profile().map_err(NoPart::Profile)?;
        let flanks = clutch.sprags.flanks;
        let outline = flanks.map(|flanks| Outline::closed(&profile, &flanks)).transpose();
        Ok(MadeClutch { outline: outline.map_err(NoPart::Outline)?, clutch, profile })
    }
}

impl MadeClutch {
    /// Refuse a part that cannot be drawn closed.
    ///
    /// # Errors
    /// [`NoPart::Open`].
    pub fn closed(&self, part: Part) -> Result<(), NoPart> {
        if self.outline.is_some() || !part.has_sprag() {
            return Ok(());
        }
        let narrowest = Outline::narrowest_flanks(&self.profile).ok();
        Err(NoPart::Open { narrowest_m: narrowest.map(|(rear, front)| [rear, front]) })
    }

    /// As the writers of files take it, with name and hash of its design.
    pub fn drawn<'a>(&'a self, design: &'a Design) -> DrawnClutch<'a> {
        DrawnClutch {
            name: &design.name,
            hash: &design.hash,
            clutch: &self.clutch,
            profile: &self.profile,
            outline: self.outline.as_ref(),
        }
    }
}
