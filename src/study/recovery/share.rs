//! A share of several, with the interval in which the true one lies.

use crate::impact::fit::NORMAL_97_5;

/// Some of several.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Share {
    /// How many are.
    pub good: usize,
    /// Of how many.
    pub all: usize,
}

impl Share {
    /// Of cases; none of no case.
    pub(super) fn of(cases: Vec<bool>) -> Option<Self> {
        (!cases.is_empty()).then(|| Self { good: cases.iter().filter(|good| **good).count(), all: cases.len() })
    }

    /// The share, 0 to 1.
    pub fn share(&self) -> f64 {
        self.good as f64 / self.all as f64
    }

    /// Its 95 % interval for independent cases (E. B. Wilson, J. Am. Stat. Assoc. 22, 1927, 209).
    pub fn interval(&self) -> [f64; 2] {
        let (count, square) = (self.all as f64, NORMAL_97_5 * NORMAL_97_5);
        let middle = (self.share() + square / (2.0 * count)) / (1.0 + square / count);
        let half =
            NORMAL_97_5 / (1.0 + square / count) * (self.share() * (1.0 - self.share()) / count + square / (4.0 * count * count)).sqrt();
        [(middle - half).max(0.0), (middle + half).min(1.0)]
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        /// The end of the interval is where the share that is seen lies Z standard deviations off: the interval's own definition.
        #[test]
        fn analytic_the_ends_of_the_interval_solve_its_equation(all in 1_usize..2000, part in 0.0_f64..1.0) {
            let share = Share { good: (all as f64 * part) as usize, all };
            let [least, most] = share.interval();
            prop_assert!(least <= share.share() + 1e-12 && share.share() <= most + 1e-12);
            for end in [least, most].into_iter().filter(|end| *end > 1e-9 && *end < 1.0 - 1e-9) {
                let off = (share.share() - end).abs() / (end * (1.0 - end) / all as f64).sqrt();
                prop_assert!((off - NORMAL_97_5).abs() < 1e-6, "{off}");
            }
        }
    }
}
