//! A frame's own mechanics as an impact model of one coordinate: spring and damper of an impact, the frame's static curve,
//! and the mass that swings against the centre.

use std::sync::Arc;

use crate::frame::assembly::Design;
use crate::frame::assembly::mass::MassTable;
use crate::impact::body::DropBody;
use crate::impact::effects::{Channel, FRAME_FORCE_CURVE, FrameCurve, Model, PAYLOAD_MODE, Sensor};
use crate::mechanics::model::frame_model::FrameModel;
use crate::mechanics::model::model_error::ModelError;
use crate::mechanics::result::reduction::Reduction;
use crate::mechanics::result::static_curve::StaticCurve;
use crate::mechanics::settings::MechanicsSettings;
use crate::paper_logger::{BANDWIDTH_HZ, RANGE_G};

/// Displacement of the centre up to which the frame's static curve is computed, mm.
pub const CURVE_MM: f64 = 30.0;
/// Damping ratio of the mass that swings against the centre.
const RIDER_ZETA: f64 = 0.05;

/// Why a frame has no such model.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ReductionError {
    /// Its beam model fails.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// Its static curve is none that an impact model can have.
    #[error("the frame's static curve cannot be used: {0}")]
    Curve(String),
}

/// The model of one coordinate, from a quarter of the frame and its static curve.
///
/// # Errors
/// When the quarter has no modes, or the curve is refused.
pub fn reduced_model(
    design: &Design,
    masses: &MassTable,
    quarter: &FrameModel,
    curve: &StaticCurve,
    settings: &MechanicsSettings,
) -> Result<Model, ReductionError> {
    let body = DropBody::of(design, masses);
    let reduction = Reduction::of(quarter, curve, body.mass_kg, settings)?;
    let [x_mm, phi_mm] = [0, 1].map(|column| reduction.curve_mm.iter().map(|point| point[column]).collect::<Vec<f64>>());
    let frame_curve = FrameCurve::new(&x_mm, &phi_mm).map_err(ReductionError::Curve)?;
    let sensor = Sensor::new(BANDWIDTH_HZ, 1, RANGE_G, Channel::Axial);
    let mut model = Model::base(body, sensor, reduction.stiffness_n_mm * 1e3, reduction.damping_n_s_m);
    model.name = format!("{}-reduced", design.frame.name);
    model.frame_curve = Some(Arc::new(frame_curve));
    model = model.with(&FRAME_FORCE_CURVE, &[1.0], 0);
    if let Some([share, f_hz]) = reduction.rider {
        let [_, frequency, _] = PAYLOAD_MODE.parameters else { return Ok(model) };
        model = model.with(&PAYLOAD_MODE, &[share, f_hz.clamp(frequency.min, frequency.max), RIDER_ZETA], 0);
    }
    Ok(model)
}
