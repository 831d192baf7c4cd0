//! A solid of a STEP file.

use crate::export::format::{Made, SolidEntry};
use crate::figures::to_thousandth;
use crate::solid::Boundary;

/// A named solid with its look.
pub(super) struct Shaped {
    pub name: String,
    pub material: String,
    pub colour: [f32; 4],
    pub boundary: Boundary,
    pub made: Made,
    pub because: Option<String>,
    pub mesh_volume_mm3: f64,
}

impl Shaped {
    /// How many of its faces are facets of the mesh.
    pub fn facets(&self) -> usize {
        self.boundary.faces.iter().filter(|face| !face.is_exact).count()
    }

    /// Its entry in the manifest.
    pub fn entry(&self, file: &str) -> SolidEntry {
        SolidEntry {
            file: file.into(),
            name: self.name.clone(),
            made: self.made,
            because: self.because.clone(),
            faces: self.boundary.faces.len(),
            facets: self.facets(),
            pieces: self.boundary.pieces().len(),
            volume_mm3: to_thousandth(self.boundary.volume_mm3()),
            mesh_volume_mm3: to_thousandth(self.mesh_volume_mm3),
        }
    }
}
