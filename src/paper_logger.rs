//! The logger of the paper's drops, which simulated readings are made like (arXiv 2103.04423 and its notebook; sensor: ADXL377).

/// Counts of the converter to one g along the axis: 27 tumbles in the notebook.
pub const COUNTS_PER_G: f64 = 8.877_004_38;
/// Largest reading, g: the end of the converter, rounded.
pub const RANGE_G: f64 = 230.0;
/// Bandwidth of the sensor, Hz, first order.
pub const BANDWIDTH_HZ: f64 = 500.0;
/// Time between its readings, ms.
pub const STEP_MS: f64 = 1.0;
