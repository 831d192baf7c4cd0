//! The stages of a diagnosis, for progress messages.

/// What is being done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Aligning the drops at their triggers, and their trial covariance.
    TrialCovariance,
    /// Simulating data sets in which nothing is missing.
    Bootstrap,
    /// Trying sets of so many effects.
    Effects(usize),
    /// Judging the best set: heights, held-out drops, the next experiment.
    Acceptance,
}

impl Stage {
    /// How many there are, with at most so many effects.
    pub fn count(most_effects: usize) -> usize {
        3 + most_effects
    }

    /// Those that were done before.
    pub fn before(self, most_effects: usize) -> usize {
        match self {
            Self::TrialCovariance => 0,
            Self::Bootstrap => 1,
            Self::Effects(size) => 1 + size,
            Self::Acceptance => 2 + most_effects,
        }
    }

    /// In words.
    pub fn words(self) -> String {
        match self {
            Self::TrialCovariance => "trial covariance".into(),
            Self::Bootstrap => "bootstrap replicates".into(),
            Self::Effects(1) => "every effect alone".into(),
            Self::Effects(size) => format!("sets of {size} effects"),
            Self::Acceptance => "acceptance tests".into(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_stages_count_up() {
        for most in 1..=3 {
            let all =
                [Stage::TrialCovariance, Stage::Bootstrap].into_iter().chain((1..=most).map(Stage::Effects)).chain([Stage::Acceptance]);
            let places: Vec<usize> = all.map(|stage| stage.before(most)).collect();
            assert_eq!(places, (0..Stage::count(most)).collect::<Vec<_>>());
        }
    }
}
