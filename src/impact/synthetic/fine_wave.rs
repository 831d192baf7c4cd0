//! A wave from first touch on, between the samples of any logger.

/// Time between the points of a wave, s.
pub const FINE_S: f64 = 5e-5;
/// Logged from first touch on, s.
pub const AFTER_S: f64 = 0.040;

/// The wave between its points.
pub fn at(fine: &[f64], t_s: f64) -> f64 {
    if t_s <= 0.0 {
        return 0.0;
    }
    let place = t_s / FINE_S;
    let left = (place.floor() as usize).min(fine.len() - 2);
    fine[left] + (place - left as f64) * (fine[left + 1] - fine[left])
}
