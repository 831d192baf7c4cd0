//! Colours as other programs take them.

/// A linear share of a channel as sRGB has it (IEC 61966-2-1).
pub(super) fn curved(share: f32) -> f64 {
    let share = f64::from(share);
    if share <= 0.003_130_8 { 12.92 * share } else { 1.055 * libm::pow(share, 1.0 / 2.4) - 0.055 }
}
