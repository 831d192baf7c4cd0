//! Imports go one way, and what touches the outside stays where it belongs.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Each layer and those that it may import; a layer stands below every layer that names it.
const LAYERS: [(&str, &[&str]); 27] = [
    ("units", &[]),
    ("figures", &[]),
    ("params", &["figures"]),
    ("skeleton", &["units", "figures", "params"]),
    ("solid", &["units"]),
    ("parts", &["units", "params", "solid"]),
    ("assembly", &["units", "params", "skeleton", "solid", "parts"]),
    ("mechanics", &["units", "params", "skeleton", "solid", "parts", "assembly"]),
    ("printability", &["units", "params", "solid", "assembly"]),
    ("checks", &["units", "figures", "params", "skeleton", "solid", "assembly", "mechanics", "printability"]),
    ("plates", &["params", "assembly", "printability"]),
    ("export", &["units", "params", "skeleton", "solid", "assembly", "mechanics", "plates"]),
    ("weighing", &["units", "params", "assembly"]),
    ("coupon", &["units", "params", "solid"]),
    ("gate", &["params", "assembly", "checks"]),
    ("body", &["assembly", "checks"]),
    ("effects", &["params", "body"]),
    ("sim", &["body", "effects"]),
    ("measured", &[]),
    ("fit", &["effects", "sim", "measured"]),
    ("impact_fit", &["mechanics", "measured", "fit"]),
    ("diagnose", &["effects", "sim", "fit"]),
    ("plant", &["params", "effects"]),
    ("variant", &["figures", "params", "skeleton", "assembly", "mechanics", "checks", "body", "effects", "sim"]),
    ("schema", &["params", "effects", "plant"]),
    (
        "report",
        &[
            "figures",
            "params",
            "skeleton",
            "solid",
            "assembly",
            "checks",
            "printability",
            "plates",
            "export",
            "body",
            "effects",
            "sim",
            "measured",
            "fit",
            "diagnose",
            "variant",
            "mechanics",
            "impact_fit",
            "weighing",
            "coupon",
        ],
    ),
    (
        "cli",
        &[
            "units",
            "figures",
            "gate",
            "schema",
            "variant",
            "params",
            "assembly",
            "checks",
            "plates",
            "export",
            "body",
            "effects",
            "sim",
            "measured",
            "fit",
            "diagnose",
            "plant",
            "report",
            "mechanics",
            "impact_fit",
            "weighing",
            "coupon",
        ],
    ),
];

/// What may stand in some layers only: the kernels, the file formats, the terminal, the disk.
const CONFINED: [(&str, &str); 41] = [
    ("manifold_rust", "solid"),
    ("truck_", "solid"),
    ("stl_io", "export"),
    ("gltf::", "export"),
    ("sha2", "export"),
    ("png::", "report"),
    ("plotters", "report"),
    ("miniz_oxide", "report"),
    ("pdf_writer", "report"),
    ("ab_glyph", "report"),
    ("miette", "params"),
    ("toml::", "params"),
    ("read_to_string", "params"),
    ("fs::read(", "measured"),
    ("read_dir", "measured"),
    ("csv::", "measured"),
    ("quick_junit", "gate"),
    ("cobyla", "variant"),
    ("crunch::", "plates"),
    ("quick_xml", "export"),
    ("zip::", "export"),
    ("indicatif", "cli"),
    ("glob::", "cli"),
    ("notify::", "cli"),
    ("Command::new", "cli"),
    ("amd::", "mechanics"),
    ("toml_edit", "cli"),
    ("statrs", "weighing mechanics impact_fit"),
    ("clap", "cli"),
    ("println!", "cli"),
    ("print!", "cli"),
    ("dbg!", "cli"),
    ("stdout()", "cli"),
    ("stderr()", "cli"),
    ("fs::write", "cli"),
    ("File::create", "cli"),
    ("OpenOptions", "cli"),
    ("create_dir", "cli"),
    ("fs::rename", "cli"),
    ("fs::remove", "cli"),
    ("process::exit", "cli"),
];

/// What makes a file differ from run to run.
const NOWHERE: [&str; 6] = ["HashMap", "HashSet", "SystemTime", "rand::rng", "rand::random", "SysRng"];

/// A line of the sources.
struct Line<'a> {
    layer: &'a str,
    place: String,
    /// Modules from the root down to the file.
    depth: usize,
    /// Without its comment.
    code: &'a str,
}

/// The layer of a path below `src`; `None` for the two roots.
fn layer_of(path: &str) -> Option<&str> {
    let layer = path.split('/').next().unwrap_or(path).trim_end_matches(".rs");
    (layer != "lib" && layer != "main").then_some(layer)
}

fn lines<'a>(path: &'a str, text: &'a str) -> Vec<Line<'a>> {
    let Some(layer) = layer_of(path) else { return Vec::new() };
    let numbered = text.lines().enumerate();
    let depth = path.trim_end_matches("/mod.rs").split('/').count();
    numbered
        .map(|(at, line)| Line { layer, place: format!("src/{path}:{}", at + 1), depth, code: line.split("//").next().unwrap_or_default() })
        .collect()
}

/// The layers that a line of code names: `crate::x`, `crate::{x, y::z}`, and `super::x` where x is a layer.
fn imported<'a>(line: &Line<'a>) -> Vec<&'a str> {
    let Line { code, depth, .. } = line;
    let name = |text: &'_ str| text.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(text.len());
    let mut found = Vec::new();
    for (root, _) in code.match_indices("crate::") {
        let rest = &code[root + "crate::".len()..];
        match rest.strip_prefix('{') {
            Some(list) => found.extend(list.trim_end_matches([';', '}']).split(',').map(|entry| {
                let entry = entry.trim();
                &entry[..name(entry)]
            })),
            None => found.push(&rest[..name(rest)]),
        }
    }
    // Modules above the file are those of its own layer until as many `super::` stand in a row as the file lies deep.
    for (at, _) in code.match_indices("super::") {
        let rest = &code[at + "super::".len()..];
        let above = code[..at].len() - code[..at].trim_end_matches("super::").len();
        let reached = above / "super::".len() + 1 >= *depth;
        found.extend(LAYERS.iter().map(|(layer, _)| *layer).filter(|layer| reached && &rest[..name(rest)] == *layer));
    }
    found
}

/// What is wrong with a line, in words.
fn faults(line: &Line) -> Vec<String> {
    let Line { layer, place, code, .. } = line;
    let Some((_, allowed)) = LAYERS.iter().find(|(name, _)| name == layer) else {
        return vec![format!("{place}: `{layer}` is no layer: add it to tests/layering.rs")];
    };
    let mut faults = Vec::new();
    for name in imported(line).into_iter().filter(|name| name != layer && !allowed.contains(name)) {
        faults.push(format!("{place}: {layer} may not import {name}"));
    }
    for (word, home) in CONFINED.iter().filter(|(word, home)| code.contains(word) && home.split(' ').all(|home| home != *layer)) {
        faults.push(format!("{place}: `{word}` belongs to {home}, this is {layer}"));
    }
    faults.extend(NOWHERE.iter().filter(|word| code.contains(**word)).map(|word| format!("{place}: `{word}` changes from run to run")));
    faults
}

/// Every source file, by its path below `src`.
fn sources() -> BTreeMap<String, String> {
    fn walk(folder: &Path, found: &mut Vec<PathBuf>) {
        for entry in fs::read_dir(folder).expect("src can be read") {
            let path = entry.expect("src can be read").path();
            if path.is_dir() {
                walk(&path, found);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                found.push(path);
            }
        }
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut paths = Vec::new();
    walk(&root, &mut paths);
    let named = |path: PathBuf| {
        let below = path.strip_prefix(&root).expect("is below src").to_string_lossy().replace('\\', "/");
        (below, fs::read_to_string(&path).expect("is text"))
    };
    paths.into_iter().map(named).collect()
}

#[test]
fn analytic_no_line_imports_upwards() {
    let sources = sources();
    assert!(sources.len() > 60, "only {} files were found", sources.len());
    let faults: Vec<String> = sources.iter().flat_map(|(path, text)| lines(path, text)).flat_map(|line| faults(&line)).collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn analytic_the_order_has_no_circle() {
    for (at, (layer, allowed)) in LAYERS.iter().enumerate() {
        for below in *allowed {
            let place = LAYERS.iter().position(|(name, _)| name == below);
            assert!(place.is_some_and(|place| place < at), "{layer} imports {below}, which does not stand before it");
        }
    }
}

#[test]
fn analytic_every_permission_is_used() {
    let sources = sources();
    let used: Vec<(&str, &str)> = sources
        .iter()
        .flat_map(|(path, text)| lines(path, text))
        .flat_map(|line| imported(&line).into_iter().map(move |name| (line.layer, name)))
        .collect();
    let permissions = LAYERS.iter().flat_map(|(layer, allowed)| allowed.iter().map(|below| (*layer, *below)));
    let idle: Vec<_> = permissions.filter(|permission| !used.contains(permission)).collect();
    assert!(idle.is_empty(), "strike the permissions that nothing needs: {idle:?}");
}

#[test]
fn planted_upward_and_outside_lines_are_found() {
    let found = |path: &str, code: &str| lines(path, code).iter().flat_map(faults).count();
    for (path, code) in [
        ("params/frame.rs", "use crate::skeleton::Skeleton;"),
        ("units.rs", "    let a = crate::params::frame::value();"),
        ("solid/mesh.rs", "use crate::{units::Angle, parts::Hub};"),
        ("skeleton/graph.rs", "use super::super::assembly::Design;"),
        ("export/stl.rs", "use crate::cli::output;"),
        ("checks/wall.rs", "use manifold_rust::manifold::Manifold;"),
        ("parts/hub.rs", "    println!(\"hub\");"),
        ("sim/system.rs", "use crate::assembly::Design;"),
        ("effects/model.rs", "use crate::sim::System;"),
        ("report/picture.rs", "std::fs::write(path, bytes)?;"),
        ("assembly/mass.rs", "use std::collections::HashMap;"),
        ("helpers/more.rs", "use crate::units::Angle;"),
    ] {
        assert_eq!(found(path, code), 1, "{path}: {code}");
    }
    assert_eq!(found("assembly/design.rs", "use super::body::Body;"), 0);
    assert_eq!(found("report/scene.rs", "use crate::assembly::Design; // not crate::cli"), 0);
    assert_eq!(found("cli/terminal.rs", "println!(\"data\");"), 0);
}
