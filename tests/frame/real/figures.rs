//! What is known of the real frame's parts: tables of figures under `tests/reference`.

use std::collections::BTreeMap;

use flexframe::params::PartName;
use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3};
use serde::Deserialize;

use super::probe::Probe;

/// A real part: what it measures, and how its file lies.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RealPart {
    /// Our part of the same purpose.
    pub part: PartName,
    /// Its file.
    pub file: String,
    /// The riser of our motor mount that corresponds, mm.
    #[serde(default)]
    pub riser_mm: f64,
    /// Bounding box in the file's axes, mm.
    pub size_mm: [f64; 3],
    /// Volume, mm³.
    pub volume_mm3: f64,
    /// Our part's axes, as directions in the file.
    axes: [[f64; 3]; 3],
    /// Where the file's origin lies in our part's axes, mm.
    at: [f64; 3],
}

impl RealPart {
    /// From the file's axes to our part's.
    pub fn pose(&self) -> Isometry3<f64> {
        let rows = self.axes.map(|axis| Vector3::from(axis).normalize().transpose());
        let turn = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(Matrix3::from_rows(&rows)));
        Isometry3::from_parts(Translation3::from(Vector3::from(self.at)), turn)
    }

    /// A name that no other entry has.
    pub fn name(&self) -> String {
        if self.riser_mm > 0.0 { format!("{}_taller", self.part) } else { self.part.to_string() }
    }
}

/// The real parts.
pub fn parts() -> Vec<RealPart> {
    #[derive(Deserialize)]
    struct Table {
        parts: Vec<RealPart>,
    }
    toml::from_str::<Table>(include_str!("../../reference/parts.toml")).expect("the table of parts is valid").parts
}

/// A functional dimension of a part.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Dimension {
    /// What it is.
    pub name: String,
    /// The figure measured on the real frame: mm, degrees or mm², as the probe measures.
    pub figure: f64,
    /// What ours is meant to be where that is not the figure …
    pub ours: Option<f64>,
    /// … and why.
    pub why: Option<String>,
    /// How it is measured.
    pub by: Probe,
}

impl Dimension {
    /// What our part must measure.
    pub fn nominal(&self) -> f64 {
        self.ours.unwrap_or(self.figure)
    }
}

/// Functional dimensions, part by part.
pub fn dimensions() -> BTreeMap<PartName, Vec<Dimension>> {
    toml::from_str(include_str!("../../reference/dimensions.toml")).expect("the table of dimensions is valid")
}
