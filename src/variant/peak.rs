//! The predicted peak: the one place that says how a frame's body becomes a figure of a drop.

use crate::impact::body::DropBody;
use crate::impact::effects::Model;
use crate::impact::sim::{SolverOptions, System, ValidityWarning, simulate};

/// Model of the drop, one of those that come with the program.
const MODEL: &str = "paper-corrected";

/// Height of the drop, m.
const HEIGHT_M: f64 = 1.0;

/// What the figure is, and what it cannot see.
pub const PEAK_CAVEAT: &str = "peak: of a mass on a spring, by the model paper-corrected, from 1 m; it reacts to mass and gap only, and \
                               leaves out an impact on the ground, of which peak.strike is the speed. \
                               The recommended prediction is design_drop.peak (--strength), by the geometry: of the payload itself, above what a \
                               logger records. As logged (drop --model frame) it is within 10 % of the medians measured on the real frame";

/// What a drop from 1 m is predicted to be.
pub struct PredictedPeak {
    /// Largest reading of the sensor, g. Of the frame only mass and gap enter: spring and damper are those fitted to the real frame, and
    /// wrong for one that is stiffer or softer. NaN when the model does not load, which one that comes with the program does.
    pub peak_g: f64,
    /// How fast the lowest body hits the ground, m/s, 0 where it does not: an impact that the peak leaves out.
    pub strike_m_s: f64,
}

/// The drop of a body.
pub fn predicted_peak(body: &DropBody) -> PredictedPeak {
    let Ok(mut model) = Model::load(MODEL) else { return PredictedPeak { peak_g: f64::NAN, strike_m_s: 0.0 } };
    model.body = body.clone();
    let trace = simulate(&System::new(&model), HEIGHT_M, &SolverOptions::REPORT);
    let strike_m_s = trace.warnings.iter().find_map(|warning| match warning {
        ValidityWarning::PastGap { speed_m_s, .. } => Some(*speed_m_s),
        _ => None,
    });
    PredictedPeak { peak_g: trace.peaks.map_or(f64::NAN, |peaks| peaks.sensor_g), strike_m_s: strike_m_s.unwrap_or(0.0) }
}
