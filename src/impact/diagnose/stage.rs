//! How far a diagnosis is, for whoever waits for it.

/// What is being done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Laying drops upon each other, and how they scatter.
    Scatter,
    /// Simulating data sets in which nothing is missing.
    Nulls,
    /// Trying sets of so many effects.
    Effects(usize),
    /// Judging the best set: heights, held-out drops, the next experiment.
    Gates,
}

impl Stage {
    /// How many there are, with at most so many effects.
    pub fn count(most_effects: usize) -> usize {
        3 + most_effects
    }

    /// Those that were done before.
    pub fn before(self, most_effects: usize) -> usize {
        match self {
            Self::Scatter => 0,
            Self::Nulls => 1,
            Self::Effects(size) => 1 + size,
            Self::Gates => 2 + most_effects,
        }
    }

    /// In words.
    pub fn words(self) -> String {
        match self {
            Self::Scatter => "how drops scatter".into(),
            Self::Nulls => "what chance can do".into(),
            Self::Effects(1) => "every effect alone".into(),
            Self::Effects(size) => format!("sets of {size} effects"),
            Self::Gates => "gates before a name".into(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_stages_count_up() {
        for most in 1..=3 {
            let all = [Stage::Scatter, Stage::Nulls].into_iter().chain((1..=most).map(Stage::Effects)).chain([Stage::Gates]);
            let places: Vec<usize> = all.map(|stage| stage.before(most)).collect();
            assert_eq!(places, (0..Stage::count(most)).collect::<Vec<_>>());
        }
    }
}
