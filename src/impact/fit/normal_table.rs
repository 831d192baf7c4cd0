//! Density and probability of the normal law from a table: a fit asks for them some ten million times.

use std::sync::LazyLock;

use super::normal_law::{normal_below, normal_density};

/// Places of the table a unit.
const PLACES: usize = 32;
/// Where it ends: density and probability of what lies beyond are below 6e-15, and count as zero.
const END: usize = 8;
/// The last place.
const LAST: usize = END * PLACES;

/// Density and probability at each place, and at one behind the last.
static TABLE: LazyLock<[[f64; 2]; LAST + 2]> = LazyLock::new(|| {
    let values = |place: usize| {
        let z = place as f64 / PLACES as f64;
        if place < LAST { [normal_density(z), normal_below(z)] } else { [0.0, 1.0] }
    };
    std::array::from_fn(values)
});

/// The normal law with mean 0 and variance 1. Between the table's places it is the cubic that has the values and slopes of both: within 1e-8.
#[derive(Clone, Copy)]
pub struct NormalTable(&'static [[f64; 2]; LAST + 2]);

impl NormalTable {
    /// Its table is made once.
    pub fn new() -> Self {
        Self(&TABLE)
    }

    /// Density at z, and probability of a number below it.
    #[inline(always)]
    pub fn at(self, z: f64) -> [f64; 2] {
        const WIDTH: f64 = 1.0 / PLACES as f64;
        let place = (z.abs() * PLACES as f64).min(LAST as f64);
        // The conversion to so few bits is the faster one.
        let left = (place as u32 as usize).min(LAST);
        let part = place - left as f64;
        let (left_z, right_z) = (left as f64 * WIDTH, (left + 1) as f64 * WIDTH);
        let ([left_density, left_below], [right_density, right_below]) = (self.0[left], self.0[left + 1]);
        let cubic = |left: f64, right: f64, left_slope: f64, right_slope: f64| {
            let rest = 1.0 - part;
            let straight = left + part * (right - left);
            straight + part * rest * (rest * (left_slope * WIDTH - (right - left)) - part * (right_slope * WIDTH - (right - left)))
        };
        let density = cubic(left_density, right_density, -left_z * left_density, -right_z * right_density);
        let below = cubic(left_below, right_below, left_density, right_density);
        [density, if z < 0.0 { 1.0 - below } else { below }]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_the_table_is_the_law() {
        let table = NormalTable::new();
        for step in -9000..9000 {
            let z = f64::from(step) * 1.013e-3;
            let [density, below] = table.at(z);
            assert!((density - normal_density(z)).abs() < 1e-8 && (below - normal_below(z)).abs() < 1e-8, "{z}: {density} {below}");
        }
        assert_eq!([-1e300, 1e300].map(|z| table.at(z)), [[0.0, 0.0], [0.0, 1.0]]);
    }
}
