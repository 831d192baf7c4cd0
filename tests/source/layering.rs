//! Imports go one way, and what touches the outside stays where it belongs.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// The wings of `src`, in the order in which data flows through them: a wing imports only those before it.
const WINGS: [&str; 19] = [
    "units",
    "figures",
    "markdown",
    "memo",
    "paper_logger",
    "params",
    "solid",
    "frame",
    "printing",
    "mechanics",
    "checks",
    "export",
    "impact",
    "variant",
    "study",
    "schema",
    "report",
    "workspace",
    "cli",
];

/// Each layer, a wing or a room of one, and the layers that it may import: all of them stand before it.
const LAYERS: [(&str, &[&str]); 41] = [
    ("units", &[]),
    ("figures", &[]),
    ("markdown", &[]),
    ("memo", &[]),
    ("paper_logger", &[]),
    ("params", &["units", "figures"]),
    ("solid", &["units", "memo"]),
    ("frame/skeleton", &["units", "figures", "params"]),
    ("frame/parts", &["units", "params", "solid", "frame/skeleton"]),
    ("frame/assembly", &["units", "memo", "params", "solid", "frame/skeleton", "frame/parts"]),
    ("frame/fold", &["units", "figures", "memo", "params", "solid", "frame/skeleton", "frame/parts", "frame/assembly"]),
    ("frame/mounting", &["params", "solid", "frame/skeleton", "frame/parts", "frame/assembly", "frame/fold"]),
    ("printing/printability", &["units", "params", "solid", "frame/assembly"]),
    ("printing/print_time", &["params", "solid", "frame/assembly"]),
    ("printing/filament", &["params"]),
    ("printing/heat", &["params", "frame/assembly"]),
    ("printing/room", &["params", "frame/assembly"]),
    ("printing/plates", &["params", "frame/assembly", "printing/printability", "printing/print_time", "printing/room"]),
    ("printing/weighing", &["params", "frame/assembly"]),
    ("printing/coupon", &["units", "params", "solid", "frame/skeleton", "frame/assembly", "frame/fold", "printing/room"]),
    ("mechanics", &["units", "paper_logger", "params", "solid", "frame/skeleton", "frame/parts", "frame/assembly"]),
    (
        "checks",
        &[
            "units",
            "figures",
            "memo",
            "params",
            "solid",
            "frame/skeleton",
            "frame/parts",
            "frame/assembly",
            "frame/fold",
            "frame/mounting",
            "printing/printability",
            "printing/heat",
            "printing/room",
            "mechanics",
        ],
    ),
    ("checks/gate", &["markdown", "params", "frame/assembly", "checks"]),
    (
        "export",
        &[
            "units",
            "figures",
            "markdown",
            "params",
            "solid",
            "frame/skeleton",
            "frame/assembly",
            "frame/fold",
            "frame/mounting",
            "printing/filament",
            "printing/print_time",
            "printing/plates",
            "mechanics",
        ],
    ),
    ("impact/body", &["frame/assembly", "checks"]),
    ("impact/wide_registers", &[]),
    ("impact/effects", &["units", "params", "impact/body"]),
    ("impact/sim", &["units", "paper_logger", "impact/wide_registers", "impact/body", "impact/effects"]),
    ("impact/measured", &["units", "figures", "paper_logger"]),
    ("impact/fit", &["units", "impact/wide_registers", "impact/effects", "impact/sim", "impact/measured"]),
    ("impact/synthetic", &["units", "params", "impact/effects"]),
    (
        "impact/frame_fit",
        &["units", "paper_logger", "frame/assembly", "mechanics", "impact/body", "impact/effects", "impact/measured", "impact/fit"],
    ),
    ("impact/diagnose", &["units", "figures", "impact/effects", "impact/sim", "impact/measured", "impact/fit"]),
    (
        "impact/landing",
        &["units", "figures", "impact/wide_registers", "impact/effects", "impact/measured", "impact/fit", "impact/diagnose"],
    ),
    ("impact/request", &["figures", "impact/body", "impact/effects", "impact/measured", "impact/fit", "impact/diagnose", "impact/landing"]),
    (
        "variant",
        &[
            "figures",
            "memo",
            "params",
            "frame/skeleton",
            "frame/assembly",
            "mechanics",
            "checks",
            "impact/body",
            "impact/effects",
            "impact/sim",
        ],
    ),
    (
        "study",
        &[
            "memo",
            "params",
            "frame/assembly",
            "mechanics",
            "checks",
            "export",
            "impact/effects",
            "impact/sim",
            "impact/measured",
            "impact/fit",
            "impact/synthetic",
            "impact/diagnose",
            "impact/landing",
            "variant",
        ],
    ),
    ("schema", &["params", "mechanics", "impact/effects", "impact/synthetic", "study"]),
    (
        "report",
        &[
            "figures",
            "markdown",
            "paper_logger",
            "params",
            "solid",
            "frame/skeleton",
            "frame/assembly",
            "frame/fold",
            "frame/mounting",
            "printing/printability",
            "printing/filament",
            "printing/heat",
            "printing/plates",
            "printing/weighing",
            "printing/coupon",
            "mechanics",
            "checks",
            "export",
            "impact/body",
            "impact/effects",
            "impact/sim",
            "impact/measured",
            "impact/fit",
            "impact/frame_fit",
            "impact/diagnose",
            "impact/landing",
            "impact/request",
            "variant",
            "study",
        ],
    ),
    ("workspace", &["figures", "memo", "params", "frame/skeleton", "frame/assembly", "checks", "export", "variant", "report"]),
    (
        "cli",
        &[
            "units",
            "figures",
            "memo",
            "params",
            "frame/assembly",
            "frame/fold",
            "printing/filament",
            "printing/plates",
            "printing/weighing",
            "printing/coupon",
            "mechanics",
            "checks",
            "checks/gate",
            "export",
            "impact/body",
            "impact/effects",
            "impact/sim",
            "impact/measured",
            "impact/fit",
            "impact/synthetic",
            "impact/frame_fit",
            "impact/diagnose",
            "impact/request",
            "variant",
            "study",
            "schema",
            "report",
            "workspace",
        ],
    ),
];

/// What may stand in some layers only: the kernels, the file formats, the terminal, the disk.
const CONFINED: [(&str, &str); 45] = [
    ("manifold_rust", "solid"),
    ("truck_", "solid"),
    ("stl_io", "export"),
    ("gltf::", "export"),
    ("sha2", "memo export"),
    ("png::", "report"),
    ("plotters", "report"),
    ("miniz_oxide", "report"),
    ("pdf_writer", "report"),
    ("ab_glyph", "report"),
    ("miette", "params"),
    ("toml::", "params"),
    ("read_to_string", "params cli"),
    ("fs::read(", "impact/measured cli"),
    ("read_dir", "impact/measured cli"),
    ("csv::", "impact/measured export study report"),
    ("pulp::", "impact/wide_registers"),
    ("quick_junit", "checks/gate"),
    ("cobyla", "variant"),
    ("crunch::", "printing/plates"),
    ("quick_xml", "export"),
    ("zip::", "export"),
    ("indicatif", "cli"),
    ("glob::", "cli"),
    ("notify::", "cli"),
    ("Command::new", "cli"),
    ("amd::", "mechanics"),
    ("toml_edit", "params cli"),
    ("statrs", "printing/weighing mechanics impact/frame_fit impact/diagnose impact/landing"),
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
    ("postcard", "memo solid"),
    ("sobol_burley", "study"),
    ("parquet::", "study"),
];

/// What makes a file differ from run to run.
const NOWHERE: [&str; 6] = ["HashMap", "HashSet", "SystemTime", "rand::rng", "rand::random", "SysRng"];

/// A line of the sources.
struct Line<'a> {
    layer: &'a str,
    place: String,
    /// Modules from the root down to the file, its own last.
    module: Vec<&'a str>,
    /// Without its comment.
    code: &'a str,
}

/// The layer of a path below `src`: the longest that it begins with, or its first folder where there is none.
fn layer_of(path: &str) -> &str {
    let path = path.trim_end_matches(".rs");
    let within = |layer: &str| path.strip_prefix(layer).is_some_and(|rest| rest.is_empty() || rest.starts_with('/'));
    let known = LAYERS.iter().map(|(layer, _)| *layer).filter(|layer| within(layer)).max_by_key(|layer| layer.len());
    known.unwrap_or_else(|| path.split('/').next().unwrap_or(path))
}

fn lines<'a>(path: &'a str, text: &'a str) -> Vec<Line<'a>> {
    // A wing's own `mod.rs` names its rooms and imports nothing.
    let is_index = text.lines().all(|line| line.is_empty() || ["//", "mod ", "pub mod "].iter().any(|begin| line.starts_with(begin)));
    if matches!(path, "lib.rs" | "main.rs") || is_index {
        return Vec::new();
    }
    let layer = layer_of(path);
    let module: Vec<&str> = path.trim_end_matches(".rs").trim_end_matches("/mod").split('/').collect();
    let numbered = text.lines().enumerate();
    numbered
        .map(|(at, line)| Line {
            layer,
            place: format!("src/{path}:{}", at + 1),
            module: module.clone(),
            code: line.split("//").next().unwrap_or_default(),
        })
        .collect()
}

/// The layers that a line of code names: `crate::x::y`, `crate::{x, y::z}`, and `super::x` where that leaves the layer.
fn imported(line: &Line) -> Vec<&'static str> {
    let end = |text: &str| text.find(|c: char| !c.is_alphanumeric() && c != '_' && c != ':').unwrap_or(text.len());
    let mut paths = Vec::new();
    for (root, _) in line.code.match_indices("crate::") {
        let rest = &line.code[root + "crate::".len()..];
        match rest.strip_prefix('{') {
            Some(list) => paths.extend(list.trim_end_matches([';', '}']).split(',').map(|entry| entry.trim().to_string())),
            None => paths.push(rest.to_string()),
        }
    }
    for (at, _) in line.code.match_indices("super::") {
        let rest = &line.code[at + "super::".len()..];
        let above = (line.code[..at].len() - line.code[..at].trim_end_matches("super::").len()) / "super::".len() + 1;
        if !rest.starts_with("super::") && above <= line.module.len() {
            let root = line.module[..line.module.len() - above].join("::");
            paths.push(if root.is_empty() { rest.to_string() } else { format!("{root}::{rest}") });
        }
    }
    let layer = |path: &String| {
        let path = path[..end(path)].replace("::", "/");
        LAYERS.iter().map(|(layer, _)| *layer).find(|layer| *layer == layer_of(&path))
    };
    paths.iter().filter_map(layer).collect()
}

/// The wing of a layer.
fn wing(layer: &str) -> &str {
    layer.split('/').next().unwrap_or(layer)
}

/// What is wrong with a line, in words.
fn faults(line: &Line) -> Vec<String> {
    let Line { layer, place, code, .. } = line;
    let Some((_, allowed)) = LAYERS.iter().find(|(name, _)| name == layer) else {
        return vec![format!("{place}: `{layer}` is no layer: add it to tests/source/layering.rs")];
    };
    let mut faults = Vec::new();
    for name in imported(line).into_iter().filter(|name| name != layer && !allowed.contains(name)) {
        faults.push(format!("{place}: {layer} may not import {name}"));
    }
    let elsewhere = |home: &str| home.split(' ').all(|home| home != *layer && home != wing(layer));
    for (word, home) in CONFINED.iter().filter(|(word, home)| code.contains(word) && elsewhere(home)) {
        faults.push(format!("{place}: `{word}` belongs to {home}, this is {layer}"));
    }
    faults.extend(NOWHERE.iter().filter(|word| code.contains(**word)).map(|word| format!("{place}: `{word}` changes from run to run")));
    faults
}

/// Every source file, by its path below `src`.
pub fn sources() -> BTreeMap<String, String> {
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
fn analytic_the_wings_stand_in_the_order_of_the_data_flow() {
    let mut met: Vec<&str> = LAYERS.iter().map(|(layer, _)| wing(layer)).collect();
    met.dedup();
    assert_eq!(met, WINGS);
    let folders =
        sources().into_keys().map(|path| wing(path.trim_end_matches(".rs")).to_string()).filter(|wing| wing != "lib" && wing != "main");
    let unknown: Vec<String> = folders.filter(|wing| !WINGS.contains(&wing.as_str())).collect();
    assert!(unknown.is_empty(), "no wing: {unknown:?}");
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
        ("params/frame.rs", "use crate::frame::skeleton::Skeleton;"),
        ("units.rs", "    let a = crate::params::frame::value();"),
        ("solid/mesh.rs", "use crate::{units::Angle, frame::parts::Hub};"),
        ("frame/skeleton/graph.rs", "use super::super::assembly::Design;"),
        ("export/stl.rs", "use crate::cli::output;"),
        ("checks/wall.rs", "use manifold_rust::manifold::Manifold;"),
        ("frame/parts/hub.rs", "    println!(\"hub\");"),
        ("impact/sim/system.rs", "use crate::frame::assembly::Design;"),
        ("impact/effects/model.rs", "use crate::impact::sim::System;"),
        ("report/picture.rs", "std::fs::write(path, bytes)?;"),
        ("frame/assembly/mass.rs", "use std::collections::HashMap;"),
        ("helpers/more.rs", "use crate::units::Angle;"),
    ] {
        assert_eq!(found(path, code), 1, "{path}: {code}");
    }
    assert_eq!(found("frame/assembly/design.rs", "use super::body::Body;"), 0);
    assert_eq!(found("report/scene.rs", "use crate::frame::assembly::Design; // not crate::cli"), 0);
    assert_eq!(found("cli/terminal.rs", "println!(\"data\");"), 0);
}
