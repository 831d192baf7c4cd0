//! What a step is done with, of the fold and of the mounts.

/// A tool, or what is used up, that a step of the instructions names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tool {
    /// Bare hands.
    Hands,
    /// What turns a screw.
    Screwdriver,
    /// A screwdriver, or hands where the part is pressed on.
    ScrewdriverOrHands,
    /// What turns a screw below a motor, beside the leg.
    ThinScrewdriver,
    /// What pulls the fork through its window.
    ThinPliers,
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
    /// One of the ties of the bracket.
    OneTie,
    /// Two of them.
    TwoTies,
    /// Washers of the small screws.
    Washers,
    /// A pen that marks plastic and metal.
    Pen,
    /// What measures a rod.
    Ruler,
    /// Glue for a rod that is loose in its bore.
    RodGlue,
    /// What keeps a motor mount in its place on the arms.
    MountGlue,
    /// A meter of voltage and resistance.
    Multimeter,
}

impl Tool {
    /// In the instructions.
    pub fn words(self) -> &'static str {
        match self {
            Self::Hands => "hands",
            Self::Screwdriver => "screwdriver or hex key",
            Self::ScrewdriverOrHands => "screwdriver or hands",
            Self::ThinScrewdriver => "thin screwdriver or hex key",
            Self::ThinPliers => "thin pliers",
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
            Self::OneTie => "one of the ties",
            Self::TwoTies => "two of the ties",
            Self::Washers => "washers",
            Self::Pen => "pen for plastics",
            Self::Ruler => "ruler or caliper",
            Self::RodGlue => "cyanoacrylate for a loose rod",
            Self::MountGlue => "cyanoacrylate or tape",
            Self::Multimeter => "multimeter",
        }
    }

    /// In a list of what to have at hand; none of hands, and of what is used up.
    pub fn lasting(self) -> Option<&'static str> {
        match self {
            Self::Screwdriver | Self::ScrewdriverOrHands => Some(Self::Screwdriver.words()),
            Self::ThinScrewdriver
            | Self::ThinPliers
            | Self::Spanner
            | Self::SideCutter
            | Self::SolderingIron
            | Self::Pen
            | Self::Ruler
            | Self::Multimeter => Some(self.words()),
            Self::Hands
            | Self::Varnish
            | Self::Solder
            | Self::ShrinkTube
            | Self::Glue
            | Self::Tape
            | Self::DoubleSidedTape
            | Self::FoamTape
            | Self::SmallTie
            | Self::OneTie
            | Self::TwoTies
            | Self::Washers
            | Self::RodGlue
            | Self::MountGlue => None,
        }
    }
}

/// Tools in a row, as a step names them; hands where it takes none.
pub fn in_words(tools: &[Tool]) -> String {
    let tools = if tools.is_empty() { &[Tool::Hands] } else { tools };
    tools.iter().map(|tool| tool.words()).collect::<Vec<_>>().join(", ")
}
