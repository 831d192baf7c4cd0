//! The documentation says what the program does: the generated page, the examples, the figures, the links, the index pages.

use std::collections::BTreeSet;
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

/// The examples of frames in a page: its blocks of TOML that have a base.
fn frame_examples(text: &str) -> impl Iterator<Item = &str> {
    text.split("```toml\n").skip(1).filter_map(|rest| rest.split("```").next()).filter(|block| block.contains("base = "))
}

/// What `check` computes of one frame, with its masses.
fn checked(arguments: &[&str]) -> serde_json::Value {
    let report: serde_json::Value =
        serde_json::from_slice(&flexframe(&[&["check", "--json"][..], arguments].concat()).stdout).expect("JSON");
    report["frames"][0].clone()
}

fn number(value: &serde_json::Value) -> f64 {
    value.as_f64().expect("a number")
}

/// The mass of all lines of one kind, g.
fn mass_of_kind(frame: &serde_json::Value, kind: &str) -> f64 {
    let lines = frame["masses"]["lines"].as_array().expect("a list");
    lines.iter().filter(|line| line["kind"] == kind).map(|line| number(&line["total_g"])).sum()
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
        for block in frame_examples(&text) {
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
        let frame = checked(&[name]);
        let size = ["width", "depth", "height"].map(|axis| {
            let subject = format!("{axis} without propellers");
            let findings = frame["findings"].as_array().expect("a list");
            findings.iter().find(|f| f["subject"] == subject.as_str()).and_then(|f| f["value"].as_f64()).expect("is measured")
        });
        let mass = number(&frame["masses"]["total_g"]);
        let row = format!("| `{name}` | {mass:.1} | {:.1} x {:.1} x {:.1} |", size[0], size[1], size[2]);
        assert!(readme.contains(&row), "README.md should state\n{row}");
    }
}

/// The default frame's tensor of inertia about the centre of mass, as rows of a table, g mm² in groups of three digits.
fn inertia_rows(frame: &serde_json::Value) -> String {
    let grouped = |value: &serde_json::Value| {
        let digits = format!("{:.0}", number(value).abs());
        let groups: Vec<&[u8]> = digits.as_bytes().rchunks(3).rev().collect();
        let text = groups.iter().map(|group| String::from_utf8_lossy(group).into_owned()).collect::<Vec<_>>().join(" ");
        if number(value) <= -0.5 { format!("-{text}") } else { text }
    };
    let row = |axis: usize| {
        let of = &frame["masses"]["inertia_g_mm2"][axis];
        format!("| {} | {} | {} | {} |", ["X", "Y", "Z"][axis], grouped(&of[0]), grouped(&of[1]), grouped(&of[2]))
    };
    [0, 1, 2].map(row).join(" ")
}

/// The table of libraries in the page on the architecture has those that `Cargo.toml` asks for, and no others.
#[test]
fn regress_the_page_on_the_architecture_names_every_library() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let text = |name: &str| fs::read_to_string(root.join(name)).expect("UTF-8");
    let manifest: toml::Table = text("Cargo.toml").parse().expect("TOML");
    let names = |table: &toml::Value| table.as_table().expect("a table").keys().cloned().collect::<Vec<_>>();
    let targets = manifest["target"].as_table().expect("a table").values().flat_map(|target| names(&target["dependencies"]));
    let asked: BTreeSet<String> = names(&manifest["dependencies"]).into_iter().chain(targets).collect();
    let page = text("docs/architecture.md");
    let (_, table) = page.split_once("## Dependencies").expect("is there");
    let rows = table.split("\n## ").next().expect("a section").lines().filter_map(|line| line.strip_prefix("| ")?.split(" | ").next());
    let stated = rows.flat_map(|row| row.split(", ")).map(|name| name.split(' ').next().unwrap_or_default().to_string());
    let stated: BTreeSet<String> = stated.filter(|name| name != "crate").collect();
    assert_eq!(stated, asked);
}

/// Every file of tests has a line in the page on testing.
#[test]
fn regress_the_page_on_testing_names_every_file_of_tests() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let page = fs::read_to_string(root.join("docs/testing.md")).expect("UTF-8");
    for folder in ["frame", "impact", "program", "source"] {
        for entry in fs::read_dir(root.join("tests").join(folder)).expect("is there") {
            let name = entry.expect("can be read").file_name().into_string().expect("UTF-8");
            let stated = page.contains(&format!("`tests/{folder}/{name}`"));
            assert!(stated || name == "main.rs" || !name.ends_with(".rs"), "docs/testing.md should name tests/{folder}/{name}");
        }
    }
}

#[test]
fn regress_texts_state_the_masses_of_their_frames() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let page = |name: &str| fs::read_to_string(root.join(name)).expect("UTF-8");
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("frame.toml");
    let total_g = |text: &str| {
        fs::write(&file, text).expect("can be written");
        number(&checked(&[file.to_str().expect("UTF-8")])["masses"]["total_g"])
    };
    let light = total_g(frame_examples(&page("README.md")).next().expect("light.toml"));
    let long_x = page("examples/frames/long-x.toml");
    let along = total_g(&long_x);
    let across = total_g(&format!("{long_x}\n[sleeve]\nsleeve_direction = \"across\"\n"));
    let [default, v8, pla] = [&["cognifly"][..], &["cognifly-v8"], &["cognifly", "--rigid", "pla"]].map(checked);
    let [total, of_pla] = [&default, &pla].map(|frame| number(&frame["masses"]["total_g"]));
    let of_parts = |frame: &serde_json::Value| {
        let [printed, rods] = ["printed", "rod"].map(|kind| mass_of_kind(frame, kind));
        format!("{printed:.1}, {rods:.1}, {:.1} g", number(&frame["masses"]["total_g"]))
    };
    for (name, sentence) in [
        ("README.md", format!("`flexframe check light.toml` reports {light:.1} g,")),
        ("README.md", format!("{:.1} g of the default's {total:.1} g are estimates", number(&default["masses"]["estimated_g"]))),
        ("docs/frame-files.md", format!("along: {across:.1} g instead of {along:.1} g in `examples/frames/long-x.toml`")),
        ("docs/differences.md", format!("| printed parts, rods, total | {} | {} |", of_parts(&v8), of_parts(&default))),
        ("docs/printing.md", format!("rigid parts of pla at 210 °C ({:+.1} g,", of_pla - total)),
        ("docs/physics.md", format!("they weigh {:.2} g now", mass_of_kind(&v8, "printed"))),
        ("docs/physics.md", inertia_rows(&default)),
    ] {
        let text = page(name).split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(text.contains(&sentence), "{name} should state\n{sentence}");
    }
}

/// The rows of the table of masses in `docs/physics.md`, whose last column is what `cognifly-v8` weighs. One row has both connectors.
#[test]
fn regress_physics_states_the_masses_of_the_parts_of_v8() {
    let page = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/physics.md")).expect("UTF-8");
    let v8 = checked(&["cognifly-v8"]);
    let lines = v8["masses"]["lines"].as_array().expect("a list");
    for line in lines.iter().filter(|line| line["kind"] == "printed") {
        let name = line["name"].as_str().expect("a name").replace('_', " ");
        let row = format!("| {name} | {} |", line["quantity"]);
        let mass = format!(" {:.2} |", number(&line["total_g"]));
        let stated = page.lines().any(|text| text.to_lowercase().starts_with(&row) && text.ends_with(&mass));
        assert!(stated || name.starts_with("camera connector"), "docs/physics.md should state\n{row} … |{mass}");
    }
}
