//! Pictures of meshes: camera, rasteriser, and the scenes that are drawn.

pub(in crate::report) mod arrow;
mod blades;
pub(in crate::report) mod camera;
pub mod deformed_scene;
pub mod fold_scene;
pub mod image;
pub(in crate::report) mod labels;
pub mod landing_picture;
pub(in crate::report) mod lettering;
pub mod mount_scene;
pub mod plate_picture;
pub mod printing_picture;
pub mod propeller_scene;
pub(in crate::report) mod raster;
pub mod scene;
pub mod side_by_side;
pub mod sub_assembly_scene;
pub(in crate::report) mod surface;
mod visible;
