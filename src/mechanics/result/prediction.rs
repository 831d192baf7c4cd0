//! What a frame's own mechanics predict, in few numbers: one function for every command that compares frames.

use super::impact::{Impact, ImpactError, Run};
use super::static_curve::{CurveError, StaticCurve};
use super::strength::RodForce;
use super::underside::{self, Underside};
use crate::frame::assembly::Design;
use crate::frame::assembly::mass::MassTable;
use crate::mechanics::model::frame_model::{Extent, FrameModel};
use crate::mechanics::parts::parts_plan::part_models;
use crate::mechanics::settings::MechanicsSettings;

/// The numbers.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Prediction {
    /// Stiffness at rest, N/mm.
    pub initial_n_mm: f64,
    /// Secant stiffness at 8 mm, N/mm.
    pub secant_8_mm_n_mm: f64,
    /// Height of the design drop, m.
    pub drop_m: f64,
    /// Largest proper acceleration of the payload in it, g.
    pub payload_peak_g: f64,
    /// Largest way down of the payload, mm.
    pub travel_mm: f64,
    /// How far the centre's lowest corner has come down, mm, and its speed downwards, m/s, moment by moment.
    #[serde(skip)]
    pub descent: Vec<[f64; 2]>,
    /// The zone of the flexible material that is strained most at any moment, and its strain.
    pub strain: (&'static str, f64),
    /// The rod nearest to buckling.
    pub rod: Option<RodForce>,
    /// Factors between which stiffness lies: the band of the modulus. Between frames of one material it cancels.
    pub stiffness_band: [f64; 2],
    /// Modulus of the flexible material at rest, MPa.
    pub young_mpa: f64,
    /// What has to be said of the flexible material.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub doubt: Option<String>,
}

impl Prediction {
    /// How fast the lowest corner is when it has come down this far, m/s; none when it does not.
    pub fn speed_m_s(&self, down_mm: f64) -> Option<f64> {
        underside::passes(&self.descent, down_mm).map(|(_, speed_m_s)| speed_m_s)
    }
}

/// Why nothing can be predicted.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PredictionError {
    /// Statics.
    #[error(transparent)]
    Curve(#[from] CurveError),
    /// The drop.
    #[error(transparent)]
    Impact(#[from] ImpactError),
    /// The drop has no peak and no travel yet.
    #[error("dropped from {drop_m} m the frame still comes down after {after_ms:.0} ms")]
    StillComesDown {
        /// Height of the design drop, m.
        drop_m: f64,
        /// Where the computation ends, ms.
        after_ms: f64,
    },
    /// Nothing is known of the stiffness.
    #[error("pressed down by {at_mm} mm the frame gives way, and its stiffness is that at {STIFFNESS_MM} mm")]
    GivesWay {
        /// Where its curve ends, mm.
        at_mm: f64,
    },
}

impl PredictionError {
    /// Whether the frame is to blame, which gives way under its loads, and not what is said of it.
    pub fn gives_way(&self) -> bool {
        match self {
            Self::Curve(CurveError::Lost { .. } | CurveError::Sparse(_)) | Self::GivesWay { .. } | Self::StillComesDown { .. } => true,
            Self::Impact(error) => !matches!(error, ImpactError::Model(_)),
            Self::Curve(CurveError::Model(_)) => false,
        }
    }
}

/// Where the stiffness is taken, mm.
const STIFFNESS_MM: f64 = 8.0;

/// How far the frame is pressed for the stiffness, mm.
const PRESSED_MM: f64 = 10.0;

/// Predicts a design.
///
/// # Errors
/// When it has no model, no equilibrium, or its motion is lost.
pub fn predict(design: &Design, masses: &MassTable, settings: &MechanicsSettings) -> Result<Prediction, PredictionError> {
    let parts = part_models(design, settings).map_err(CurveError::from)?;
    let model = FrameModel::of_parts(design, &parts, masses, settings, Extent::Quarter).map_err(CurveError::from)?;
    let curve = StaticCurve::new(&model, PRESSED_MM, &[])?;
    let ends_mm = || curve.points.last().map_or(0.0, |point| point.displacement_mm);
    let secant_8_mm_n_mm = curve.secant_n_mm(STIFFNESS_MM).ok_or_else(|| PredictionError::GivesWay { at_mm: ends_mm() })?;
    let drop_m = settings.limits.drop_m;
    let impact = Impact::new(&model, settings, drop_m, &Run::default())?;
    if let Some(last) = impact.moments.last().filter(|_| !impact.has_turned_back()) {
        return Err(PredictionError::StillComesDown { drop_m, after_ms: last.t_ms });
    }
    let of_flexible = |zone: &str| model.tags.iter().any(|tag| tag.flexible && tag.zone == zone);
    let strained = impact.strains.iter().filter(|(zone, _)| of_flexible(zone)).max_by(|a, b| a.1.total_cmp(&b.1));
    Ok(Prediction {
        initial_n_mm: curve.initial_n_mm(),
        secant_8_mm_n_mm,
        drop_m,
        payload_peak_g: impact.peak()[0],
        travel_mm: impact.travel_mm(),
        descent: Underside::of(design, &model, 0.0).descent(&impact),
        strain: strained.copied().unwrap_or(("", 0.0)),
        rod: impact.rods.iter().max_by(|a, b| a.utilisation().total_cmp(&b.utilisation())).cloned(),
        stiffness_band: settings.young_band_mpa.map(|young| young / settings.young_mpa),
        young_mpa: settings.for_material(&design.frame.flexible.material).young_mpa,
        doubt: settings.doubt(&design.frame.flexible),
    })
}
