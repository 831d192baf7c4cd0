//! The documentation says what the program does: the generated page, the examples, the figures, the links, the index pages.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use assert_cmd::cargo::cargo_bin;

fn flexframe(arguments: &[&str]) -> Output {
    Command::new(cargo_bin("flexframe")).args(arguments).output().expect("the program starts")
}

/// Every Markdown file below a folder.
fn pages_below(folder: &Path, pages: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("is there").path();
        if path.is_dir() {
            pages_below(&path, pages);
        } else if path.extension().is_some_and(|extension| extension == "md") {
            pages.push(path);
        }
    }
}

/// The pages kept in the repository, path and text.
fn pages() -> Vec<(PathBuf, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut paths = vec![root.join("README.md"), root.join("out/README.md"), root.join("benches/peers/README.md")];
    pages_below(&root.join("docs"), &mut paths);
    paths.sort();
    paths.into_iter().map(|path| (path.clone(), fs::read_to_string(&path).expect("UTF-8"))).collect()
}

#[test]
fn regress_parameters_page_is_what_the_program_prints() {
    let printed = String::from_utf8(flexframe(&["params", "--markdown"]).stdout).expect("UTF-8");
    let kept = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/parameters.md")).expect("is there");
    assert!(printed == kept, "docs/parameters.md is out of date: cargo run --release -- params --markdown > docs/parameters.md");
}

#[test]
fn regress_links_lead_somewhere() {
    let mut astray = Vec::new();
    for (path, text) in pages() {
        for link in text.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            let file = link.split('#').next().unwrap_or_default();
            let outside = link.starts_with("http");
            if !outside && !file.is_empty() && !path.parent().expect("a folder").join(file).exists() {
                astray.push(format!("{}: {link}", path.display()));
            }
        }
    }
    assert!(astray.is_empty(), "{astray:#?}");
}

#[test]
fn regress_index_pages_name_every_page() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for (index, folder, prefix) in [("README.md", "docs", "docs/"), ("docs/decisions/README.md", "docs/decisions", "")] {
        let text = fs::read_to_string(root.join(index)).expect("UTF-8");
        for entry in fs::read_dir(root.join(folder)).expect("a folder") {
            let name = entry.expect("is there").file_name().into_string().expect("UTF-8");
            let unnamed = name.ends_with(".md") && name != "README.md" && !text.contains(&format!("]({prefix}{name})"));
            assert!(!unnamed, "{index} does not name {name}");
        }
    }
}

#[test]
fn regress_frame_examples_keep_their_limits() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut examples = 0;
    for (path, text) in pages() {
        let blocks = text.split("```toml\n").skip(1).filter_map(|rest| rest.split("```").next());
        for block in blocks.filter(|block| block.contains("base = ")) {
            let file = folder.path().join(format!("example-{examples}.toml"));
            fs::write(&file, block).expect("can be written");
            let check = flexframe(&["check", "-q", file.to_str().expect("UTF-8")]);
            let said = String::from_utf8_lossy(&check.stderr).into_owned();
            assert_eq!(check.status.code(), Some(0), "{}:\n{block}\n{said}", path.display());
            examples += 1;
        }
    }
    assert!(examples > 3, "only {examples} examples were found");
}

#[test]
fn regress_readme_states_mass_and_size_of_each_preset() {
    let readme = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md")).expect("is there");
    for name in flexframe::params::preset::names() {
        let report: serde_json::Value = serde_json::from_slice(&flexframe(&["check", name, "--json"]).stdout).expect("JSON");
        let size = ["width", "depth", "height"].map(|axis| {
            let subject = format!("{axis} without propellers");
            let findings = report["frames"][0]["findings"].as_array().expect("a list");
            findings.iter().find(|f| f["subject"] == subject.as_str()).and_then(|f| f["value"].as_f64()).expect("is measured")
        });
        let mass = report["frames"][0]["masses"]["total_g"].as_f64().expect("a number");
        let row = format!("| `{name}` | {mass:.1} | {:.1} x {:.1} x {:.1} |", size[0], size[1], size[2]);
        assert!(readme.contains(&row), "README.md should state\n{row}");
    }
}
