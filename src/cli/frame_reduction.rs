//! A frame's own mechanics as an impact model of one coordinate.

use super::session::Failure;
use super::stiffness::refused;
use crate::frame::assembly::Design;
use crate::frame::assembly::mass::MassTable;
use crate::impact::body::Body;
use crate::impact::effects::{Channel, FrameCurve, Model, Sensor, by_id};
use crate::mechanics::model::frame_model::FrameModel;
use crate::mechanics::result::impact::LOGGER_HZ;
use crate::mechanics::result::reduction::Reduction;
use crate::mechanics::result::static_curve::StaticCurve;
use crate::mechanics::settings::MechanicsSettings;
use std::sync::Arc;

/// How far the frame is pressed for its curve, mm.
pub(super) const PRESSED_MM: f64 = 30.0;
/// Full scale of the logger in the measured drops, g.
const LIMIT_G: f64 = 230.0;

/// The model: spring and damper of an impact, the frame's curve, and what rides on the centre.
pub(super) fn model(
    design: &Design,
    masses: &MassTable,
    quarter: &FrameModel,
    curve: &StaticCurve,
    settings: &MechanicsSettings,
) -> Result<Model, Failure> {
    let reduction = Reduction::of(quarter, curve, settings).map_err(refused)?;
    let [x_mm, phi_mm] = [0, 1].map(|column| reduction.curve_mm.iter().map(|point| point[column]).collect::<Vec<f64>>());
    let frame_curve = FrameCurve::new(&x_mm, &phi_mm).map_err(refused)?;
    let sensor = Sensor::new(LOGGER_HZ, 1, LIMIT_G, Channel::Axial);
    let mut model = Model::base(Body::of(design, masses), sensor, reduction.stiffness_n_mm * 1e3, reduction.damping_n_s_m);
    model.name = format!("{}-reduced", design.frame.name);
    model.frame_curve = Some(Arc::new(frame_curve));
    let with = |model: Model, id: &str, values: &[f64]| by_id(id).map_or(model.clone(), |spec| model.with(spec, values, 0));
    model = with(model, "frame_force_curve", &[1.0]);
    if let Some([share, f_hz]) = reduction.rider {
        model = with(model, "payload_mode", &[share, f_hz.clamp(40.0, 450.0), 0.05]);
    }
    Ok(model)
}
