//! The tests that a name has to pass.

/// Ids of the tests of `landing_tilt`, in their order.
pub static GATES: [&str; 7] = ["touches", "held_out", "drops", "constant", "plausible", "enough", "spread"];

/// One of them.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Gate {
    /// Its name: of `landing_tilt` one of [`GATES`]; of `attitude_sensor` `pays`, `mirrored`, `constant`, `held_out` or `plausible`.
    pub id: &'static str,
    /// Whether it was passed.
    pub passed: bool,
    /// What was found, in a sentence.
    pub found: String,
}

impl Gate {
    /// `passed` or `failed`.
    pub fn word(&self) -> &'static str {
        if self.passed { "passed" } else { "failed" }
    }
}
