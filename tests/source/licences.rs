//! Every library may be used and passed on by whoever takes this program under MIT or Apache 2.0.
//!
//! Known weaknesses (RustSec) are not looked up: their list has to be fetched, and a test must not depend on what was published
//! since. `cargo audit` does it where there is a network.

use std::process::Command;

/// Licences that ask for no more than to be passed on with the text.
const ALLOWED: [&str; 11] = [
    "MIT",
    "Apache-2.0",
    "Apache-2.0 WITH LLVM-exception",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "BSL-1.0",
    "CC0-1.0",
    "ISC",
    "Unicode-3.0",
    "Unlicense",
    "Zlib",
];

/// Licences of single packages: name, licence, why it may be.
const EXCEPTIONS: [(&str, &str, &str); 2] = [
    ("epaint_default_fonts", "Ubuntu-font-1.0", "the typeface's own licence, which lets it be embedded"),
    ("epaint_default_fonts", "OFL-1.1", "the typeface's own licence, which lets it be embedded"),
];

/// Packages that state a file instead of a name, and words of that file.
const FILES: [(&str, &str, &str); 1] = [("cobyla", "LICENSE.md", "Permission is hereby granted, free of charge")];

/// Whether an SPDX expression of names, OR, AND and brackets is satisfied.
fn satisfied(expression: &str, allowed: &dyn Fn(&str) -> bool) -> bool {
    let text = expression.replace('/', " OR ");
    // OR binds less than AND; brackets are taken out from the inside.
    if let Some(close) = text.find(')') {
        let open = text[..close].rfind('(').expect("brackets come in pairs");
        let inner = if satisfied(&text[open + 1..close], allowed) { "MIT" } else { "none" };
        return satisfied(&format!("{}{inner}{}", &text[..open], &text[close + 1..]), allowed);
    }
    text.split(" OR ").any(|all| all.split(" AND ").all(|name| allowed(name.trim())))
}

#[test]
fn analytic_every_library_may_be_passed_on() {
    let metadata = Command::new(env!("CARGO"))
        .args(["metadata", "--format-version", "1", "--locked", "--offline", "--filter-platform", "x86_64-unknown-linux-gnu"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .expect("cargo starts");
    assert!(metadata.status.success(), "{}", String::from_utf8_lossy(&metadata.stderr));
    let metadata: serde_json::Value = serde_json::from_slice(&metadata.stdout).expect("JSON");
    let packages = metadata["packages"].as_array().expect("a list");
    assert!(packages.len() > 200, "only {} packages", packages.len());
    let mut wrong = Vec::new();
    for package in packages {
        let name = package["name"].as_str().expect("a name");
        let allowed =
            |licence: &str| ALLOWED.contains(&licence) || EXCEPTIONS.iter().any(|(of, known, _)| (*of, *known) == (name, licence));
        let good = match (package["license"].as_str(), package["license_file"].as_str()) {
            (Some(expression), _) => satisfied(expression, &allowed),
            (None, Some(file)) => FILES.iter().any(|(of, known, words)| {
                let folder = std::path::Path::new(package["manifest_path"].as_str().expect("a path")).parent().expect("has one");
                (*of, *known) == (name, file) && std::fs::read_to_string(folder.join(file)).is_ok_and(|text| text.contains(words))
            }),
            (None, None) => false,
        };
        if !good {
            wrong.push(format!("{name}: {}", package["license"]));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn planted_expressions() {
    let allowed = |name: &str| ALLOWED.contains(&name);
    for good in ["MIT", "MIT OR GPL-3.0", "GPL-2.0/MIT", "MIT AND (GPL-3.0 OR ISC)", "(MIT OR Apache-2.0) AND Unicode-3.0"] {
        assert!(satisfied(good, &allowed), "{good}");
    }
    for bad in ["GPL-3.0", "MIT AND GPL-3.0", "(GPL-3.0 OR LGPL-3.0) AND MIT", ""] {
        assert!(!satisfied(bad, &allowed), "{bad}");
    }
}
