//! What tells one frame from another, to the last bit.

use sha2::{Digest, Sha256};

use crate::params::Frame;

/// What tells this build of the program from another: a hash of its sources, its libraries' versions, the compiler and
/// the target, made by `build.rs`.
const PROGRAM: &str = env!("FLEXFRAME_BUILD");

/// SHA-256, in hexadecimal digits, of everything that the findings of a frame depend on: every value of the frame as meant,
/// and the program. Numbers are written so that no two are alike.
pub fn of(frame: &Frame) -> String {
    of_text(&format!("{PROGRAM}\n{frame:?}"))
}

/// SHA-256 of a text, in hexadecimal digits.
pub fn of_text(text: &str) -> String {
    Sha256::digest(text.as_bytes()).iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_any_bit_of_a_frame_shows() {
        let (frame, _) = Frame::load("cognifly").expect("a preset");
        let mut other = frame.clone();
        assert_eq!(of(&frame), of(&other));
        other.rods.arm_rod_length_mm = f64::from_bits(other.rods.arm_rod_length_mm.to_bits() + 1);
        assert_ne!(of(&frame), of(&other));
        let (pla, _) = Frame::load("cognifly-mini").expect("a preset");
        assert_ne!(of(&frame), of(&pla));
        assert_eq!(of_text("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    }
}
