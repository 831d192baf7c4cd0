//! The WebAssembly module is built from the same libraries as the program: other versions could give other bytes.

use std::collections::BTreeSet;
use std::path::Path;

/// Name and version of each package of a lock file.
fn packages(path: &str) -> BTreeSet<(String, String)> {
    let text = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).expect("the lock file is there");
    let lock: toml::Table = toml::from_str(&text).expect("is TOML");
    let text = |package: &toml::Value, key: &str| package[key].as_str().expect("a string").to_string();
    lock["package"].as_array().expect("a list").iter().map(|package| (text(package, "name"), text(package, "version"))).collect()
}

#[test]
fn analytic_the_engine_has_the_programs_libraries() {
    let program = packages("Cargo.lock");
    let engine = packages("studio/wasm/Cargo.lock");
    let foreign: Vec<_> = engine.difference(&program).filter(|(name, _)| name != "flexframe-engine").collect();
    assert!(engine.len() > 50 && foreign.is_empty(), "only the engine has {foreign:?}; `cargo update --precise` in studio/wasm");
}
