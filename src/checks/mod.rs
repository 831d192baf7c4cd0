//! The rules that a frame is held to.
