//! The normal law with mean 0 and variance 1.

/// The quantile at 97.5 %: so many standard deviations on both sides of its mean hold 95 % of a normal law.
pub const NORMAL_97_5: f64 = 1.959_963_984_540_054;

/// Probability density.
pub fn normal_density(z: f64) -> f64 {
    libm::exp(-0.5 * z * z) / (2.0 * std::f64::consts::PI).sqrt()
}

/// Probability of a number below z.
pub fn normal_below(z: f64) -> f64 {
    0.5 * libm::erfc(-z / std::f64::consts::SQRT_2)
}
