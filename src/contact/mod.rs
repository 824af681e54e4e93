//! Local contact of two parallel cylinders of finite length.
//!
//! In: radii, length, materials, normal force. Out: peak pressure, half width, approach and its exact
//! derivative, slice loads. Absent: deformation of the bodies as a whole, friction, and what the bodies
//! are. Equations: (1)-(4), the roller law, Hertz's line contact and the shear below it.

mod approach;
mod axial;
mod dense;
mod edge;
mod end_profile;
#[cfg(feature = "validation")]
pub mod half_space;
mod influence;
mod junction;
mod layer;
mod line;
mod shaped;
mod slice;
mod slice_ratio;
mod subsurface;
mod traction;

pub use approach::{
    Approach, CurvedApproach, DIN26281_COEFFICIENT, HertzBody, HertzLaw, LayerBody, RollerLaw, SliceLaw,
};
pub use axial::{AxialFit, ContactEnd, Flank};
pub use edge::{Edge, Peak};
pub use end_profile::{EndDrop, ProfileTable};
pub use influence::{influence_m_per_pa, weighted_influence_m_per_n};
pub use junction::step_peak_error;
pub use layer::{WaveShare, element_share, layer_share};
pub use line::{ContactError, LineContact};
pub use shaped::ShapedLaw;
pub use slice::{SliceCompliance, SliceContact, SliceSolution, SliceStatus};
pub use slice_ratio::SliceRatio;
pub use subsurface::{depth_of_largest_shear_m, largest_shear_below, shear_at_depth_pa};
pub use traction::{EdgeTension, edge_tension, tension_behind};
