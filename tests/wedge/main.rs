//! What one sprag between its races does: contacts, profiles, the curve, limits that read it, beyond its end.

#[path = "../common/mod.rs"]
mod common;

mod axial;
mod capacity;
mod elastic_law;
mod first_contact;
mod gap;
mod half_space;
mod junctions;
mod lengthwise;
mod patch_contact;
mod roll_over;
mod slice_cost;
mod slice_extremes;
mod slice_half_space;
mod slice_qp;
mod slice_shaped;
mod spiral;
mod statics;
