//! A design as bytes: one file a format, value in, bytes out; nothing here opens a file.
//!
//! A format of a frame's folder is one [`Format`] beside its code, and an entry of the [`CATALOGUE`].

pub mod bill;
pub mod bill_page;
pub mod bom;
mod colour;
pub mod cutting;
pub mod deformed_glb;
pub mod fold_glb;
pub mod fold_json;
mod fold_skin;
mod format;
pub mod glb;
pub mod manifest;
mod mount_motion;
pub mod search_words;
pub mod simulator;
pub mod spares;
pub mod step;
pub mod stl;
pub mod supplies;
pub mod table;
pub mod three_mf;

pub use format::{ExportError, Exported, File, Format, Made, SolidEntry};

/// Every format of a frame's folder, in the order in which the manifest lists their files.
pub const CATALOGUE: [&Format; 5] = [&stl::FORMAT, &glb::FORMAT, &bom::FORMAT, &three_mf::FORMAT, &step::FORMAT];
