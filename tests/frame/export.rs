//! What `build` writes for every preset, read back: STL by another reader, GLB by the glTF loader, manifest, bill and report.

use crate::common;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io::Cursor;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use assert_cmd::cargo::cargo_bin;
use flexframe::checks;
use flexframe::frame::assembly::{Design, mass};
use flexframe::params::{Frame, PartName, preset};
use gltf::Gltf;
use nalgebra::{Matrix4, Point3};
use rayon::prelude::*;
use serde_json::Value;

/// Rounding of the numbers in `manifest.json`.
const ROUNDED: f64 = 0.0006;

/// A preset's folder, as built.
struct Built {
    preset: &'static str,
    folder: PathBuf,
}

impl Built {
    fn read(&self, path: &str) -> Vec<u8> {
        fs::read(self.folder.join(path)).unwrap_or_else(|error| panic!("{}: {path}: {error}", self.preset))
    }

    fn text(&self, path: &str) -> String {
        String::from_utf8(self.read(path)).expect("UTF-8")
    }

    fn manifest(&self) -> Value {
        serde_json::from_str(&self.text("manifest.json")).expect("JSON")
    }
}

/// Every preset, built once for all tests; the first with its pictures.
fn built() -> &'static [Built] {
    static BUILT: OnceLock<Vec<Built>> = OnceLock::new();
    BUILT.get_or_init(|| {
        let out = Path::new(env!("CARGO_TARGET_TMPDIR")).join("export");
        let build = |preset: &'static str| {
            let mut command = Command::new(cargo_bin("flexframe"));
            command.args(["build", preset, "-q", "-o"]).arg(&out);
            let run = if preset == "cognifly" { command.output() } else { command.arg("--no-pictures").output() };
            assert!(run.expect("the program starts").status.success(), "{preset}");
            Built { preset, folder: out.join(preset) }
        };
        preset::names().collect::<Vec<_>>().into_par_iter().map(build).collect()
    })
}

fn list<'a>(value: &'a Value, key: &str) -> &'a [Value] {
    value[key].as_array().unwrap_or_else(|| panic!("{key} is no list"))
}

fn number(value: &Value, key: &str) -> f64 {
    value[key].as_f64().unwrap_or_else(|| panic!("{key} is no number"))
}

fn name<'a>(value: &'a Value, key: &str) -> &'a str {
    value[key].as_str().unwrap_or_else(|| panic!("{key} is no text"))
}

fn keys(value: &Value) -> BTreeSet<&str> {
    value.as_object().expect("a table").keys().map(String::as_str).collect()
}

/// The printed parts of a preset: none has an accessory plate.
fn parts() -> Vec<PartName> {
    PartName::ALL.into_iter().filter(|part| *part != PartName::AccessoryPlate).collect()
}

#[test]
fn analytic_the_manifest_has_its_keys_and_every_part() {
    for built in built() {
        let manifest = built.manifest();
        assert_eq!(manifest["schema_version"], 1);
        assert_eq!(name(&manifest, "frame"), built.preset);
        assert!(name(&manifest, "generator").starts_with("flexframe "));
        let listed = list(&manifest, "parts");
        assert_eq!(
            listed.iter().map(|part| name(part, "name")).collect::<Vec<_>>(),
            parts().into_iter().map(PartName::slug).collect::<Vec<_>>()
        );
        for part in listed {
            let expected = ["name", "quantity", "material", "volume_mm3", "design_volume_mm3", "mass_g", "bbox_mm", "triangles", "files"];
            assert_eq!(keys(part), BTreeSet::from(expected), "{}", built.preset);
        }
    }
}

#[test]
fn analytic_every_file_is_in_the_manifest_with_its_hash() {
    use sha2::Digest;
    for built in built() {
        let manifest = built.manifest();
        let mut listed = BTreeSet::from(["manifest.json".to_string()]);
        for file in list(&manifest, "files") {
            let path = name(file, "path");
            let hash: String = sha2::Sha256::digest(built.read(path)).iter().map(|byte| format!("{byte:02x}")).collect();
            assert_eq!(hash, name(file, "sha256"), "{}: {path}", built.preset);
            listed.insert(path.to_string());
        }
        let mut present = BTreeSet::new();
        for folder in ["", "parts", "plates", "pictures"] {
            let Ok(entries) = fs::read_dir(built.folder.join(folder)) else { continue };
            let files = entries.map(|entry| entry.expect("can be read").path()).filter(|path| path.is_file());
            let below = |path: &Path| path.strip_prefix(&built.folder).expect("is below").to_string_lossy().replace('\\', "/");
            present.extend(files.map(|path| below(&path)));
        }
        assert_eq!(present, listed, "{}", built.preset);
        let stls = list(&manifest, "parts").iter().flat_map(|part| list(part, "files"));
        assert!(stls.into_iter().all(|stl| listed.contains(stl.as_str().expect("a path"))), "{}", built.preset);
    }
}

/// What another reader finds in an STL: triangles, volume, box; and that it is closed, with outward unit normals.
fn read_stl(what: &str, bytes: &[u8]) -> (usize, f64, [f64; 3]) {
    stl_io::read_stl(&mut Cursor::new(bytes)).and_then(|mesh| mesh.validate()).unwrap_or_else(|error| panic!("{what}: {error}"));
    let (mut count, mut volume) = (0, 0.0);
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    let mut cursor = Cursor::new(bytes);
    for facet in stl_io::create_stl_reader(&mut cursor).expect("an STL") {
        let facet = facet.expect("a facet");
        let point = |xyz: [f32; 3]| Point3::from(xyz.map(f64::from));
        let [a, b, c] = facet.vertices.map(|vertex| point(vertex.0));
        let (normal, stored) = ((b - a).cross(&(c - a)).normalize(), point(facet.normal.0).coords);
        assert!((stored - normal).norm() < 1e-5, "{what}: a normal is {stored:?}, the facet's is {normal:?}");
        volume += a.coords.dot(&b.coords.cross(&c.coords)) / 6.0;
        count += 1;
        for corner in [a, b, c] {
            for axis in 0..3 {
                (low[axis], high[axis]) = (low[axis].min(corner[axis]), high[axis].max(corner[axis]));
            }
        }
    }
    assert!(low[2].abs() < 1e-4, "{what}: lies {} mm above the bed", low[2]);
    (count, volume, [0, 1, 2].map(|axis| high[axis] - low[axis]))
}

#[test]
fn analytic_every_stl_reads_back_with_the_numbers_of_the_manifest() {
    let one = |built: &Built| {
        for part in list(&built.manifest(), "parts") {
            let what = format!("{}: {}", built.preset, name(part, "name"));
            let (count, volume, size) = read_stl(&what, &built.read(part["files"][0].as_str().expect("a path")));
            assert_eq!(count as u64, part["triangles"].as_u64().expect("a count"), "{what}");
            assert!((volume - number(part, "volume_mm3")).abs() < ROUNDED, "{what}: {volume}");
            for (size, stated) in size.iter().zip(list(part, "bbox_mm")) {
                assert!((size - stated.as_f64().expect("a number")).abs() < ROUNDED, "{what}: {size} {stated}");
            }
        }
    };
    built().par_iter().for_each(one);
}

#[test]
fn analytic_masses_are_volume_times_density_times_print_factor() {
    for built in built() {
        let frame = Frame::load(built.preset).expect("a preset is valid").0;
        for part in list(&built.manifest(), "parts") {
            let material = [&frame.flexible, &frame.rigid].into_iter().find(|m| m.name == name(part, "material")).expect("is known");
            let mass = number(part, "design_volume_mm3") / 1000.0 * material.material.density_g_cm3 * material.material.print_factor;
            assert!((mass - number(part, "mass_g")).abs() < ROUNDED, "{}: {part}", built.preset);
        }
    }
}

/// A node of the scene, in the frame's metres.
struct Node {
    name: String,
    facts: Value,
    colour: [f32; 4],
    low: [f64; 3],
    high: [f64; 3],
}

/// Every body of a GLB; the loader has checked its form.
fn read_glb(bytes: &[u8]) -> (Value, Vec<Node>) {
    let file = Gltf::from_slice(bytes).expect("valid glTF");
    let buffer = file.blob.as_deref().expect("a binary chunk");
    let scene = file.default_scene().expect("a scene");
    let roots: Vec<_> = scene.nodes().collect();
    assert_eq!(roots.iter().map(|node| node.name()).collect::<Vec<_>>(), [Some("frame")]);
    let turn = matrix(&roots[0]);
    let json = |extras: &gltf::json::Extras| serde_json::from_str(extras.as_ref().expect("has extras").get()).expect("JSON");
    let read = |node: gltf::Node| {
        let mesh = node.mesh().expect("a mesh");
        let place = turn * matrix(&node);
        let (mut low, mut high, mut colour) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3], [0.0; 4]);
        for primitive in mesh.primitives() {
            colour = primitive.material().pbr_metallic_roughness().base_color_factor();
            let reader = primitive.reader(|_| Some(buffer));
            let positions: Vec<[f32; 3]> = reader.read_positions().expect("positions").collect();
            let corners: Vec<u32> = reader.read_indices().expect("indices").into_u32().collect();
            assert!(corners.len().is_multiple_of(3) && corners.iter().all(|corner| (*corner as usize) < positions.len()));
            for position in positions {
                let at = place.transform_point(&Point3::from(position.map(f64::from)));
                for axis in 0..3 {
                    (low[axis], high[axis]) = (low[axis].min(at[axis]), high[axis].max(at[axis]));
                }
            }
        }
        Node { name: node.name().expect("a name").into(), facts: json(node.extras()), colour, low, high }
    };
    let asset = json(&file.document.as_json().asset.extras);
    (asset, roots[0].children().map(read).collect())
}

fn matrix(node: &gltf::Node) -> Matrix4<f64> {
    Matrix4::from(node.transform().matrix().map(|column| column.map(f64::from)))
}

/// The colours that tell a material at a glance.
fn has_the_look(material: &str, [red, green, blue, _]: [f32; 4]) -> bool {
    match material {
        "tpu-95a" => red > 0.5 && green < 0.1 && blue < 0.1,
        "abs" => red.max(green).max(blue) < 0.1,
        "carbon" => red.max(green).max(blue) < 0.02,
        "bamboo" => red > green && green > blue,
        other => panic!("nothing is made of {other} here"),
    }
}

#[test]
fn analytic_every_glb_loads_with_a_node_a_part_and_its_facts() {
    for built in built() {
        let (asset, nodes) = read_glb(&built.read("frame.glb"));
        let manifest = built.manifest();
        assert_eq!(asset["frame"], built.preset);
        assert_eq!(asset["total_mass_g"], manifest["total_mass_g"]);
        assert_eq!(nodes.iter().map(|node| &node.name).collect::<BTreeSet<_>>().len(), nodes.len(), "names are unique");
        let parts = list(&manifest, "parts").iter().map(|part| (name(part, "name").to_string(), part, "printed"));
        let rods = list(&manifest, "rods").iter().map(|rod| (format!("{}_rod", name(rod, "name")), rod, "rod"));
        for (part, entry, kind) in parts.chain(rods) {
            let own: Vec<&Node> = nodes.iter().filter(|node| node.facts["part"] == part.as_str()).collect();
            assert_eq!(own.len() as u64, entry["quantity"].as_u64().expect("a count"), "{}: {part}", built.preset);
            for node in own {
                assert_eq!(node.facts["kind"], kind);
                assert_eq!(node.facts["quantity"], entry["quantity"], "{part}");
                assert_eq!(node.facts["mass_each_g"], entry["mass_g"], "{part}");
                assert_eq!(node.facts["material"], entry["material"], "{part}");
                assert!(has_the_look(name(entry, "material"), node.colour), "{part} looks like {:?}", node.colour);
            }
        }
        let bought: Vec<&Node> = nodes.iter().filter(|node| node.facts["kind"] == "bought").collect();
        assert!(bought.len() >= 8 + 7, "four motors, four propellers, and the centre");
        for node in bought {
            // A magnet in the lid is one of the magnets, four screws are one body.
            let part = name(&node.facts, "part");
            let of = list(&manifest, "bought").iter().filter(|entry| part.starts_with(name(entry, "role")));
            let entry = of.max_by_key(|entry| name(entry, "role").len()).expect("is bought");
            assert_eq!(node.facts["quantity"], entry["quantity"], "{part}");
            assert!((number(&node.facts, "mass_each_g") - number(entry, "mass_g")).abs() < 6e-4, "{part}");
        }
    }
}

#[test]
fn analytic_the_glb_is_in_metres_and_y_is_up() {
    let one = |built: &Built| {
        let design = Design::with(Frame::load(built.preset).expect("a preset is valid").0, common::memo()).expect("can be made");
        let findings = checks::check(&design, &mass::table(&design));
        let (_, nodes) = read_glb(&built.read("frame.glb"));
        for (subject, axis) in [("width", 0), ("height", 1), ("depth", 2)] {
            let stated = findings.iter().find(|f| f.subject == format!("{subject} without propellers")).expect("is measured").value;
            let still = || nodes.iter().filter(|node| node.facts["part"] != "propeller");
            let low = still().map(|node| node.low[axis]).fold(f64::INFINITY, f64::min);
            let high = still().map(|node| node.high[axis]).fold(f64::NEG_INFINITY, f64::max);
            let found = 1000.0 * (high - low);
            assert!((found - stated).abs() < 0.01, "{}: {subject} {found} {stated}", built.preset);
        }
        // A glTF's front faces Z, and its right side -X; motor 2 of the usual order is that of the front right.
        let middle = |name: &str, axis: usize| {
            let node = nodes.iter().find(|node| node.name == name).unwrap_or_else(|| panic!("{name} of {}", built.preset));
            0.5 * (node.low[axis] + node.high[axis])
        };
        let front = design.bodies.iter().max_by(|a, b| a.pose.translation.y.total_cmp(&b.pose.translation.y)).expect("has bodies");
        let right = design.bodies.iter().max_by(|a, b| a.pose.translation.x.total_cmp(&b.pose.translation.x)).expect("has bodies");
        assert!(middle(&front.name, 2) > 0.02 && middle(&right.name, 0) < -0.02, "{} {}", front.name, right.name);
    };
    built().par_iter().for_each(one);
}

/// The fields of a line of CSV.
fn fields(line: &str) -> Vec<String> {
    let mut fields = vec![String::new()];
    let mut quoted = false;
    for c in line.chars() {
        match c {
            '"' => quoted = !quoted,
            ',' if !quoted => fields.push(String::new()),
            c => fields.last_mut().expect("is never empty").push(c),
        }
    }
    fields
}

#[test]
fn analytic_the_bill_cuts_every_rod_once_and_wastes_nothing_unsaid() {
    /// Width of a saw cut, mm.
    const KERF_MM: f64 = 1.0;
    for built in built() {
        let (bill, manifest) = (built.text("bom.csv"), built.manifest());
        let rows: Vec<Vec<String>> = bill.lines().skip(1).map(fields).collect();
        assert!(rows.iter().all(|row| row.len() == 22), "{}", built.preset);
        let mut cut: BTreeMap<String, Vec<f64>> = BTreeMap::new();
        for row in rows.iter().filter(|row| row[0] == "stock") {
            let (cuts, rest) = row[16].strip_prefix("cut: ").and_then(|how| how.split_once("; rest ")).expect("says how to cut");
            let pieces: Vec<(&str, f64)> =
                cuts.split(" + ").filter_map(|cut| cut.split_once(' ')).map(|(role, mm)| (role, mm.parse().expect("mm"))).collect();
            let used: f64 = pieces.iter().map(|(_, mm)| mm + KERF_MM).sum();
            let (stock, rest): (f64, f64) = (row[4].parse().expect("mm"), rest.parse().expect("mm"));
            // Lengths are printed to a tenth; a last piece that ends where the stock ends has no cut behind it.
            let printed = 0.05 * pieces.len() as f64 + 0.1;
            assert!(used - KERF_MM <= stock + printed, "{}: {row:?}", built.preset);
            assert!((rest - (stock - used).max(0.0)).abs() < printed, "{}: {row:?}", built.preset);
            for (role, mm) in pieces {
                cut.entry(role.to_string()).or_default().push(mm);
            }
        }
        assert_eq!(cut.len(), list(&manifest, "rods").len(), "{}", built.preset);
        for rod in list(&manifest, "rods") {
            let pieces = &cut[name(rod, "name")];
            assert_eq!(pieces.len() as u64, rod["quantity"].as_u64().expect("a count"), "{}: {rod}", built.preset);
            let [sawn, whole] = ["sawn_mm", "length_mm"].map(|key| number(rod, key));
            assert!(pieces.iter().all(|mm| (mm - sawn).abs() < 1e-9), "{}: {rod} {pieces:?}", built.preset);
            assert!((2.0 * sawn).fract() == 0.0 && (0.0..0.5).contains(&(whole - sawn)), "{}: {rod}", built.preset);
        }
        let total: f64 = rows.iter().filter_map(|row| row[6].parse::<f64>().ok()).sum();
        assert!((total - number(&manifest, "total_mass_g")).abs() < ROUNDED * rows.len() as f64, "{}: {total}", built.preset);
    }
}

#[test]
fn analytic_the_report_links_to_files_that_are_there() {
    for built in built() {
        let report = built.text("report.md");
        // What to do next comes first, with the plates that are there.
        let next = report.find("## What to do next").expect("begins with it");
        assert!(report.find("## ").is_some_and(|first| first == next), "{}", built.preset);
        let plates = list(&built.manifest(), "files").iter().filter(|file| name(file, "path").ends_with(".3mf")).count();
        assert!(plates > 0 && report[next..].lines().take(12).any(|line| line.matches(".3mf)").count() == plates), "{}", built.preset);
        for step in ["print 31 parts", "cut 28 rods from", "buy ", "put it together and fold it, "] {
            assert!(report[next..].lines().take(10).any(|line| line.contains(step)), "{}: {step}", built.preset);
        }
        // Rods are there before a coupon needs a piece of one, and before they are cut.
        let order = ["buy ", "try the printer", "print 31 parts", "cut 28 rods from", "put it together and fold it, "];
        let places = order.map(|step| report[next..].find(step).expect("is a step"));
        assert!(places.is_sorted(), "{}: {places:?}", built.preset);
        let links: Vec<&str> = report.split("](").skip(1).filter_map(|rest| rest.split(')').next()).collect();
        assert!(links.iter().filter(|link| link.ends_with(".stl")).count() == parts().len());
        let pictures: Vec<&&str> = links.iter().filter(|link| link.ends_with(".png")).collect();
        assert_eq!(pictures.len(), if built.preset == "cognifly" { 5 + parts().len() } else { 0 });
        assert!(pictures.iter().all(|link| built.read(link).starts_with(b"\x89PNG\r\n\x1a\n")));
        assert!(links.iter().all(|link| built.folder.join(link).is_file()), "{}: {links:?}", built.preset);
    }
}
