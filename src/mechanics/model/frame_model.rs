//! The frame as a structure: parts as beams, rods, ties between them, a rigid centre, masses, feet.

use super::frame_builder::Builder;
use super::weights::weights;
use crate::frame::assembly::Design;
use crate::frame::assembly::mass::MassTable;
use crate::frame::skeleton::RodRole;
use crate::mechanics::parts::parts_plan::{PartModel, part_models};
use crate::mechanics::parts::plan::NoSection;
use crate::mechanics::parts::section::Elastic;
use crate::mechanics::settings::Settings;
use crate::mechanics::system::sparse::SparseError;
use crate::mechanics::system::system::System;
use crate::params::PartName;

/// How much of the frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// All four modules; the centre moves freely.
    Whole,
    /// The first module, between two planes of symmetry; the centre moves up and down. A quarter of force, mass and energy.
    Quarter,
}

impl Extent {
    /// How many of it make a frame.
    pub fn copies(self) -> f64 {
        match self {
            Self::Whole => 1.0,
            Self::Quarter => 4.0,
        }
    }
}

/// Why a frame has no mechanics.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ModelError {
    /// A part's mesh was not met.
    #[error("{part}: {error}")]
    Part {
        /// Which part.
        part: PartName,
        /// What was not met.
        error: NoSection,
    },
    /// The rods' material says nothing of its stiffness.
    #[error("the rods' material `{material}` does not say its tensile_modulus_mpa")]
    NoModulus {
        /// Which.
        material: String,
    },
    /// The structure cannot be solved.
    #[error(transparent)]
    Sparse(#[from] SparseError),
}

/// What a beam or tie is.
#[derive(Clone, Debug)]
pub struct Tag {
    /// Its zone: a part's, a rod's role, `plugs and sockets`.
    pub zone: &'static str,
    /// Farthest fibres, mm; zero for ties.
    pub reach_mm: [f64; 2],
    /// E A, E I about y and z; zero for ties.
    pub rigidity: [f64; 3],
}

/// A rod in the model.
#[derive(Clone, Debug)]
pub struct RodLine {
    /// Its name.
    pub name: String,
    /// Its role.
    pub role: RodRole,
    /// Its beams.
    pub beams: Vec<usize>,
    /// Free length between its sockets' mouths, mm.
    pub free_mm: f64,
    /// E I, N mm².
    pub bending_n_mm2: f64,
}

/// A body and the nodes that carry it.
#[derive(Clone, Debug)]
pub struct Skin {
    /// Index among the design's bodies.
    pub body: usize,
    /// Nodes of the structure.
    pub nodes: Vec<usize>,
}

/// The frame, ready to be solved.
pub struct FrameModel {
    /// The structure.
    pub system: System,
    /// What its beams, then its ties, are.
    pub tags: Vec<Tag>,
    /// The node of the rigid centre.
    pub hub: usize,
    /// Rods.
    pub rods: Vec<RodLine>,
    /// Nodes at the motors' centres.
    pub motors: Vec<usize>,
    /// Bodies and what carries them; bodies of the centre are carried by `hub`.
    pub skins: Vec<Skin>,
    /// How much of the frame it is.
    pub extent: Extent,
}

impl FrameModel {
    /// The model of a design.
    ///
    /// # Errors
    /// When a part's mesh is not met on one of its paths, or the rods' material has no modulus.
    pub fn new(design: &Design, masses: &MassTable, settings: &Settings, extent: Extent) -> Result<Self, ModelError> {
        let parts = part_models(design, settings)?;
        Self::of_parts(design, &parts, masses, settings, extent)
    }

    /// The same from parts that were cut before.
    ///
    /// # Errors
    /// When the rods' material has no modulus, or the structure cannot be solved.
    pub fn of_parts(
        design: &Design,
        parts: &[PartModel],
        masses: &MassTable,
        settings: &Settings,
        extent: Extent,
    ) -> Result<Self, ModelError> {
        let weights = weights(design, masses);
        let mut builder = Builder::new(design, settings, extent, weights);
        for part in parts {
            for (index, body) in design.bodies.iter().enumerate() {
                let here = extent == Extent::Whole || body.module == Some(0);
                if here && design.shape(body).kind == crate::frame::assembly::Kind::Printed(part.name) {
                    builder.add_part(part, index, &body.pose);
                }
            }
        }
        let rod_young = design.frame.rod_material.material.tensile_modulus_mpa;
        let young_mpa = rod_young.ok_or_else(|| ModelError::NoModulus { material: design.frame.rod_material.name.clone() })?;
        let material = Elastic { young_mpa, shear_mpa: settings.rod_shear_mpa.min(young_mpa / 2.6) };
        for rod in &design.skeleton.rods {
            builder.add_rod(rod, &material);
        }
        builder.tie_windows();
        builder.finish()
    }
}
