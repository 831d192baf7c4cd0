//! The tests that a name has to pass.

/// One of them.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Gate {
    /// Its name: of `landing_tilt` `touches`, `held_out`, `drops`, `constant`, `plausible`, `enough` or `spread`; of `attitude_sensor` `pays`,
    /// `mirrored`, `constant`, `held_out` or `plausible`.
    pub id: &'static str,
    /// Whether it was passed.
    pub passed: bool,
    /// What was found, in a sentence.
    pub found: String,
}
