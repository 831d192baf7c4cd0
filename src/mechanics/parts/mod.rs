//! Printed parts as beams: sections cut from their meshes along their load paths.

pub(in crate::mechanics) mod corner_plan;
pub(in crate::mechanics) mod joint_plans;
pub mod parts_plan;
pub mod plan;
pub mod section;
pub mod warping;
