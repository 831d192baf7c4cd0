//! How a search ended.

/// How a search ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ended {
    /// No step of any size is better.
    Converged,
    /// As many frames were looked at as were allowed.
    Spent,
    /// Somebody ended it: a budget of time, or a person.
    Stopped,
}

impl Ended {
    /// How it ended, before the count of frames.
    pub fn words(self) -> &'static str {
        match self {
            Self::Converged => "found no better step after",
            Self::Spent => "gave up after",
            Self::Stopped => "was ended after",
        }
    }
}
