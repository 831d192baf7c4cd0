//! The predicted peak: the one place that says how a frame's body becomes a figure of a drop.

use crate::impact::body::DropBody;
use crate::impact::effects::Model;
use crate::impact::sim::{SolverOptions, System, simulate};

/// Model of the drop, one of those that come with the program.
const MODEL: &str = "paper-corrected";

/// Height of the drop, m.
const HEIGHT_M: f64 = 1.0;

/// What the figure is, and what it cannot see.
pub const PEAK_CAVEAT: &str = "peak: of a mass on a spring, by the model paper-corrected, from 1 m; it reacts to mass and gap only. \
                               The recommended prediction is design_drop.peak (--strength): by the geometry, within 10 % of measured medians";

/// Largest reading of the sensor in a drop from 1 m, g. Of the frame only mass and gap enter: spring and damper are those
/// fitted to the real frame, and wrong for one that is stiffer or softer. NaN when the model does not load, which one that
/// comes with the program does.
pub fn predicted_peak_g(body: &DropBody) -> f64 {
    let Ok(mut model) = Model::load(MODEL) else { return f64::NAN };
    model.body = body.clone();
    simulate(&System::new(&model), HEIGHT_M, &SolverOptions::REPORT).peak_sensor_g
}
