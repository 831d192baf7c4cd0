//! No random numbers. truck depends on `rand`, and that on getrandom, of which it needs nothing here: every random number of
//! flexframe comes from a stated seed. The crate of this name would bring wasm-bindgen and all of JavaScript's types along.

use std::fmt;
use std::num::NonZeroU32;

/// There are none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Error;

impl Error {
    /// Codes from here on are an application's.
    pub const CUSTOM_START: u32 = (1 << 31) + (1 << 30);
    /// Codes from here on are the library's.
    pub const INTERNAL_START: u32 = 1 << 31;

    /// Its code.
    pub const fn code(self) -> NonZeroU32 {
        NonZeroU32::MIN
    }
}

impl From<NonZeroU32> for Error {
    fn from(_: NonZeroU32) -> Self {
        Self
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("there are no random numbers here")
    }
}

impl std::error::Error for Error {}

/// Fills nothing.
///
/// # Errors
/// Always.
pub fn getrandom(_: &mut [u8]) -> Result<(), Error> {
    Err(Error)
}
