//! The bell curve exp(-x²/2) from a table: a diagnosis asks for it some hundred million times, so it is straight between its
//! places; [`crate::impact::fit`] has the normal law itself by cubics, as difference quotients go through it.

use std::sync::LazyLock;

/// Places of the table a unit.
const PLACES: usize = 512;
/// Where it ends: what lies beyond is below 1.3e-14, and counts as zero.
const END: usize = 8;

/// The last place, and one behind it.
const LAST: usize = END * PLACES;

static TABLE: LazyLock<[f64; LAST + 2]> = LazyLock::new(|| {
    let value = |place: usize| {
        let x = place as f64 / PLACES as f64;
        if place < LAST { libm::exp(-0.5 * x * x) } else { 0.0 }
    };
    std::array::from_fn(value)
});

/// The curve, between the table's places straight: within 5e-7.
#[derive(Clone, Copy)]
pub struct Bell(&'static [f64; LAST + 2]);

impl Bell {
    /// Its table is made once.
    pub fn new() -> Self {
        Self(&TABLE)
    }

    /// Its value.
    #[inline(always)]
    pub fn at(self, x: f64) -> f64 {
        let place = (x.abs() * PLACES as f64).min(LAST as f64);
        // The conversion to so few bits is the faster one.
        let left = (place as u32 as usize).min(LAST);
        self.0[left] + (place - left as f64) * (self.0[left + 1] - self.0[left])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_the_table_is_the_curve() {
        let bell = Bell::new();
        for step in -9000..9000 {
            let x = f64::from(step) * 1.013e-3;
            assert!((bell.at(x) - libm::exp(-0.5 * x * x)).abs() < 5e-7, "{x}");
        }
        assert_eq!([0.0, 8.0, 1e300].map(|x| bell.at(x)), [1.0, 0.0, 0.0]);
    }
}
