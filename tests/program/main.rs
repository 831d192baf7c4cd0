//! The program from outside: what it prints, writes and refuses, and what its documentation says.

mod cli;
mod commands;
mod determinism;
mod docs;
mod drop;
mod drops;
mod fuzz;
mod gate;
mod hostile;
mod kept;
mod measure;
mod sinks;
mod study;
mod variant;
