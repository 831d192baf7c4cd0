//! What holds between two switches of a run.

/// What holds between two switches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Phase {
    /// Whether the frame has left the ground (x < 0).
    pub airborne: bool,
    /// How many feet have touched.
    pub touched: usize,
    /// Whether works are summed.
    pub works: bool,
}
