//! From a design to its model.

use super::frame_builder::Builder;
use super::frame_model::{Extent, FrameModel};
use super::model_error::ModelError;
use super::weights::weights;
use crate::frame::assembly::mass::MassTable;
use crate::frame::assembly::{BodyKind, Design};
use crate::mechanics::parts::parts_plan::{PartModel, part_models};
use crate::mechanics::parts::section::Elastic;
use crate::mechanics::settings::MechanicsSettings;

impl FrameModel {
    /// The model of a design.
    ///
    /// # Errors
    /// When a part's mesh is not met on one of its paths, or the rods' material has no modulus.
    pub fn new(design: &Design, masses: &MassTable, settings: &MechanicsSettings, extent: Extent) -> Result<Self, ModelError> {
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
        settings: &MechanicsSettings,
        extent: Extent,
    ) -> Result<Self, ModelError> {
        let settings = &settings.for_material(&design.frame.flexible.material);
        let weights = weights(design, masses);
        let mut builder = Builder::new(design, settings, extent, weights);
        for part in parts {
            for (index, body) in design.bodies.iter().enumerate() {
                let here = extent == Extent::Whole || body.module == Some(0);
                if here && design.shape(body).kind == BodyKind::Printed(part.name) {
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
