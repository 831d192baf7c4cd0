//! How the battery's sleeve lies: a word of a frame file.

/// How the battery's sleeve lies under the hub.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SleeveDirection {
    /// From front to rear: the battery is put in from the rear.
    #[default]
    Along,
    /// From left to right: the battery is put in from the right.
    Across,
}

impl SleeveDirection {
    /// The key of a frame file.
    pub const KEY: &'static str = "sleeve.sleeve_direction";
    /// The words that it may be.
    pub const WORDS: [&'static str; 2] = ["along", "across"];
    /// What the key chooses.
    pub const DOC: &'static str = "How the battery's sleeve lies: `along` the frame, the battery put in from the rear, or `across`, the battery put in from the right.";

    /// The word of it.
    pub fn word(self) -> &'static str {
        let [along, across] = Self::WORDS;
        match self {
            Self::Along => along,
            Self::Across => across,
        }
    }

    /// What a word means; none of another word.
    pub fn of_word(word: &str) -> Option<Self> {
        [Self::Along, Self::Across].into_iter().find(|direction| direction.word() == word)
    }
}
