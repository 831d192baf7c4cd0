//! A design as bytes: one file a format, value in, bytes out; nothing here opens a file.

pub mod bent_glb;
pub mod bill;
pub mod bill_page;
pub mod bom;
mod colour;
pub mod cutting;
pub mod fingerprint;
pub mod fold_glb;
pub mod fold_json;
mod fold_skin;
pub mod glb;
pub mod manifest;
pub mod step;
pub mod stl;
pub mod three_mf;
