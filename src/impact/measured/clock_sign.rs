//! What in a record says that its logger's clock stalled.

use serde::Serialize;

/// A sign of a stalled clock. Times are as the logger stamped them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, thiserror::Error)]
#[serde(tag = "sign", rename_all = "snake_case")]
pub enum ClockSign {
    /// The fall does not last as long as that of other drops from the same height.
    #[error("the fall lasts {fall_ms:.0} ms, {usual_ms:.0} ms are usual from this height")]
    Fall {
        /// This fall.
        fall_ms: f64,
        /// Other falls.
        usual_ms: f64,
    },
    /// The fall does not last as long as the height says; there are too few others.
    #[error("the fall lasts {fall_ms:.0} ms, one from this height {height_ms:.0} ms")]
    FallOfHeight {
        /// This fall.
        fall_ms: f64,
        /// Of a fall in air from the stated height.
        height_ms: f64,
    },
    /// A reading in the impact is followed by free flight at once.
    #[error("{from_g:.0} g jump into free flight within one sample, {after_ms:.0} ms after the trigger")]
    Jump {
        /// The last reading, all axes, g.
        from_g: f64,
        /// When.
        after_ms: f64,
    },
    /// The impulse is not that of the other drops.
    #[error("the impulse is {over_v0:.2} v0, {usual:.2} v0 is usual")]
    Impulse {
        /// This one.
        over_v0: f64,
        /// Others.
        usual: f64,
    },
    /// Vibration in or behind the impact is slower than that of the other drops: time is stretched.
    #[error("vibration behind the impact is smoother than usual by {deviations:.1} standard deviations")]
    SmoothVibration {
        /// How far from the others.
        deviations: f64,
    },
    /// Noise of the quiet axes is correlated before the impact: samples follow each other faster than they are stamped.
    #[error("noise before the impact has a lag-1 autocorrelation of {correlation:.2}, {usual:.2} is usual")]
    SmoothNoise {
        /// Lag-1 autocorrelation.
        correlation: f64,
        /// Of the others.
        usual: f64,
    },
    /// The largest reading comes long after the trigger, as after a double hit.
    #[error("the peak comes {to_peak_ms:.0} ms after the trigger, which looks like a double hit")]
    LatePeak {
        /// When.
        to_peak_ms: f64,
    },
    /// The impact lies where the clock stalls in other records, too.
    #[error("the impact lies at sample {at:.0} of a period of {period:.1} samples, in which the clock stalls at the beginning")]
    Position {
        /// From the begin of the stall on, samples; negative just before it.
        at: f64,
        /// Samples.
        period: f64,
    },
    /// The stamps themselves: a gap, and samples that follow each other faster than usual behind it.
    #[error("the stamps have a gap of {gap_ms:.1} ms and {fast} faster samples behind it")]
    Stamps {
        /// Length of the gap.
        gap_ms: f64,
        /// Samples at less than three quarters of the usual step.
        fast: usize,
    },
}
