//! Drop heights that are simulated.

/// Heights that are allowed, m.
pub const HEIGHTS_M: [f64; 2] = [0.01, 100.0];
/// How many at once.
const MOST_HEIGHTS: usize = 100;

/// Why drop heights are refused.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum HeightError {
    /// Too many.
    #[error("--height takes at most {MOST_HEIGHTS} heights")]
    TooMany,
    /// One that no drop has.
    #[error("--height {height_m} is out of bounds: give {} to {} m", HEIGHTS_M[0], HEIGHTS_M[1])]
    OutOfBounds {
        /// The height, m.
        height_m: f64,
    },
}

/// Whether drops from these heights, m, may be simulated.
///
/// # Errors
/// When there are too many, or one is out of bounds.
pub fn check_heights(heights_m: &[f64]) -> Result<(), HeightError> {
    let [min, max] = HEIGHTS_M;
    if heights_m.len() > MOST_HEIGHTS {
        return Err(HeightError::TooMany);
    }
    match heights_m.iter().find(|height_m| !(min..=max).contains(*height_m)) {
        Some(height_m) => Err(HeightError::OutOfBounds { height_m: *height_m }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_bounds_belong_to_what_is_allowed() {
        assert_eq!(check_heights(&[0.01, 1.0, 100.0]), Ok(()));
        assert_eq!(check_heights(&[1.0; 101]), Err(HeightError::TooMany));
        assert!(check_heights(&[f64::NAN]).is_err());
        let low = check_heights(&[1.0, 0.009]).expect_err("is refused").to_string();
        assert_eq!(low, "--height 0.009 is out of bounds: give 0.01 to 100 m");
    }
}
