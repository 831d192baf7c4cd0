//! The quantile of a normal law of which 95 % intervals are made.

/// The quantile at 97.5 %: so many standard deviations on both sides of its mean hold 95 % of a normal law.
pub const NORMAL_97_5: f64 = 1.959_963_984_540_054;
