//! What ends a step: a force that jumps or has a kink.

/// A function whose sign matters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Switch {
    /// A kink at a compression, m.
    Compression(f64),
    /// A kink at a speed, m/s.
    Speed(f64),
    /// A foot touches.
    Foot {
        /// Which, from 0.
        foot: usize,
        /// At which compression, m.
        at_m: f64,
    },
    /// The frame leaves or meets the ground.
    Ground,
    /// The ground would begin or cease to pull.
    Push,
}
