//! What a step is done with.

/// A tool, or what is used up, that a step of the instructions names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tool {
    /// Bare hands.
    Hands,
    /// What turns a screw.
    Screwdriver,
    /// A screwdriver, or hands where the part is pressed on.
    ScrewdriverOrHands,
    /// A spanner for small nuts, or pliers.
    Spanner,
    /// Varnish that keeps a nut from turning.
    Varnish,
    /// Side cutters.
    SideCutter,
    /// A soldering iron.
    SolderingIron,
    /// Solder.
    Solder,
    /// Heat shrink tube.
    ShrinkTube,
    /// Glue that takes the rigid parts' plastic.
    Glue,
    /// Adhesive tape.
    Tape,
    /// Thin tape with two adhesive sides.
    DoubleSidedTape,
    /// Tape of foam with two adhesive sides.
    FoamTape,
    /// A cable tie that is narrower than those of the bracket.
    SmallTie,
}

impl Tool {
    /// In the instructions.
    pub fn words(self) -> &'static str {
        match self {
            Self::Hands => "hands",
            Self::Screwdriver => "screwdriver or hex key",
            Self::ScrewdriverOrHands => "screwdriver or hands",
            Self::Spanner => "small spanner or pliers",
            Self::Varnish => "nail varnish",
            Self::SideCutter => "side cutter",
            Self::SolderingIron => "soldering iron",
            Self::Solder => "solder",
            Self::ShrinkTube => "shrink tube",
            Self::Glue => "glue for rigid plastics",
            Self::Tape => "tape",
            Self::DoubleSidedTape => "double-sided tape",
            Self::FoamTape => "foam tape",
            Self::SmallTie => "small tie",
        }
    }
}
