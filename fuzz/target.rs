// A target of cargo-fuzz: the reader of its name.

#[path = "../tests/program/readers.rs"]
mod readers;

libfuzzer_sys::fuzz_target!(init: readers::prepared(env!("CARGO_BIN_NAME")), |bytes: &[u8]| {
    (readers::by_name(env!("CARGO_BIN_NAME")).read)(bytes);
});
