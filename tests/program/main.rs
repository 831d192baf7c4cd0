//! The program from outside: what it prints, writes and refuses, and what its documentation says.

mod cli;
mod commands;
mod determinism;
mod docs;
mod drop;
mod drops;
mod fuzz;
mod gate;
mod growth;
mod hostile;
mod json_keys;
mod kept;
mod measure;
mod mistaken_tables;
mod readers;
mod replay;
mod sinks;
mod studio;
mod study;
mod variant;
