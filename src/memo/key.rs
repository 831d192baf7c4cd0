//! What tells the inputs of a step from all others.

use std::fmt::{self, Debug, Write};

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

/// What tells this build of the program from another: a hash of its sources, the versions in its own lock file, the compiler and the target,
/// made by `build.rs`. Results that outlive the program are those of one build. A crate that takes other versions of libraries has to tell
/// its own results apart: the command line's cache does.
pub const PROGRAM: &str = env!("FLEXFRAME_BUILD");

/// A hash of a step and its inputs: the first 128 bits of SHA-256 over the step's name and what `Debug` writes of the inputs.
///
/// `Debug` writes every number so that it reads back as the same one. What does not show in it must not change a result: NaNs
/// of different bits are alike.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct Key([u8; 16]);

impl Key {
    /// Of a step with these inputs.
    pub fn of(step: &str, inputs: &impl Debug) -> Self {
        let mut text = Hashed(Sha256::new());
        // A hash takes every text.
        let _ = write!(text, "{step}\n{inputs:?}");
        Self::first(&text.0.finalize())
    }

    /// Of bytes.
    pub fn of_bytes<'a>(pieces: impl IntoIterator<Item = &'a [u8]>) -> Self {
        let mut hash = Sha256::new();
        pieces.into_iter().for_each(|piece| hash.update(piece));
        Self::first(&hash.finalize())
    }

    fn first(hash: &[u8]) -> Self {
        let mut bytes = [0; 16];
        bytes.copy_from_slice(&hash[..16]);
        Self(bytes)
    }
}

impl Debug for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|byte| write!(f, "{byte:02x}"))
    }
}

struct Hashed(Sha256);

impl Write for Hashed {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.0.update(text.as_bytes());
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_steps_and_inputs_that_differ_have_different_keys() {
        let one = Key::of("gap", &(1.0, "a"));
        assert_eq!(one, Key::of("gap", &(1.0, "a")));
        assert_ne!(one, Key::of("share", &(1.0, "a")));
        assert_ne!(one, Key::of("gap", &(f64::from_bits(1.0_f64.to_bits() + 1), "a")));
        assert_ne!(Key::of("gap", &0.0), Key::of("gap", &-0.0));
        // The first digits of the hash of the empty text are known.
        assert_eq!(format!("{:?}", Key::of_bytes([])), "e3b0c44298fc1c149afbf4c8996fb924");
    }
}
