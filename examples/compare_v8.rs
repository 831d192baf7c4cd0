//! Writes `docs/comparison.md` and its pictures: the printed parts of the preset `cognifly-v8` beside the real ones.
//!
//! Run it as `FLEXFRAME_DATA=<folder> cargo run --release --example compare_v8`. The real parts' STL files carry no licence
//! and are not part of the repository: they are read from `cognifly_v8_stl` in that folder (default `../shared/data`), and only
//! what was measured on them, and what they look like, is written down.

#[allow(dead_code)] // The tests use the rest of it.
#[path = "../tests/frame/real/mod.rs"]
mod real;

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::path::Path;

use flexframe::frame::assembly::Printed;
use flexframe::params::PartName;
use flexframe::report::picture::image as picture;
use flexframe::report::picture::image::{Item, View};
use flexframe::solid::{Mesh, MeshSolid};
use nalgebra::{Isometry3, UnitQuaternion, Vector3};
use real::figures::{Dimension, RealPart};
use real::{figures, ours, scan};

/// Width and height of one view, pixels.
const VIEW: [u32; 2] = [320, 240];

/// Each of red, green and blue is rounded to so many steps above black, which keeps the files small.
const SHADES: u16 = 28;

/// Of joints and of rigid parts: linear red, green, blue, opacity.
const COLOURS: [[f32; 4]; 2] = [[0.73, 0.04, 0.04, 1.0], [0.33, 0.36, 0.40, 1.0]];

/// A part beside the real one.
struct Pair {
    real: RealPart,
    part: Printed,
    /// Both in the part's own axes.
    meshes: [Mesh; 2],
    overlap: f64,
}

impl Pair {
    fn new(real: RealPart) -> Self {
        let part = ours::printed(&real);
        let meshes = [real.mesh(), ours::exported(&part)];
        let solid = MeshSolid::from_mesh(&meshes[1]).expect("what is exported is closed");
        Self { overlap: scan::overlap(&solid, &real.solid()), real, part, meshes }
    }

    /// Edges of both boxes in the axes of the real file, mm.
    fn sizes_mm(&self) -> [[f64; 3]; 2] {
        let pose = self.real.pose().inverse();
        self.meshes.each_ref().map(|mesh| mesh.placed(&pose).size_mm())
    }

    fn volumes_mm3(&self) -> [f64; 2] {
        self.meshes.each_ref().map(Mesh::volume_mm3)
    }

    /// The real part on the left and ours on the right: as they lie on the print bed, and below that turned over.
    fn picture(&self) -> Vec<u8> {
        let colour = COLOURS[usize::from(!self.part.part.is_flexible())];
        let over = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI);
        let views = [UnitQuaternion::identity(), over].map(|turn| {
            self.meshes.each_ref().map(|mesh| {
                let lying = mesh.placed(&(turn * ours::on_bed(&self.part)));
                let item = Item { mesh: &lying, pose: Isometry3::identity(), colour };
                rgb(&picture::png(&[item], View::Perspective, VIEW[0], VIEW[1]))
            })
        });
        sheet(&views)
    }
}

fn main() -> std::io::Result<()> {
    let folder = scan::folder();
    if !folder.is_dir() {
        return Err(std::io::Error::other(format!("no folder {}: set FLEXFRAME_DATA", folder.display())));
    }
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
    std::fs::create_dir_all(docs.join("pictures/comparison"))?;
    let pairs: Vec<Pair> = figures::parts().into_iter().map(Pair::new).collect();
    for pair in &pairs {
        std::fs::write(docs.join(format!("pictures/comparison/{}.png", pair.real.name())), pair.picture())?;
    }
    std::fs::write(docs.join("comparison.md"), page(&pairs))
}

fn page(pairs: &[Pair]) -> String {
    let mut page = String::from(INTRODUCTION);
    page.push_str("| part | real box mm | ours mm | real volume mm³ | ours mm³ | difference | overlap |\n|---|---|---|---|---|---|---|\n");
    for pair in pairs {
        let (name, [real, ours], [theirs, own]) = (pair.real.name(), pair.sizes_mm(), pair.volumes_mm3());
        let size = |[x, y, z]: [f64; 3]| format!("{x:.2} x {y:.2} x {z:.2}");
        let off = 100.0 * (own / theirs - 1.0);
        let row = format!("{} | {} | {theirs:.1} | {own:.1} | {off:+.1} % | {:.3}", size(real), size(ours), pair.overlap);
        let _ = writeln!(page, "| [{name}](#{name}) | {row} |");
    }
    let dimensions = figures::dimensions();
    deviations(&mut page, &dimensions);
    for pair in pairs {
        let name = pair.real.name();
        let _ = write!(page, "\n## {name}\n\n![{name}: the real one on the left, ours on the right](pictures/comparison/{name}.png)\n");
        if pair.real.riser_mm == 0.0 {
            dimension_table(&mut page, pair, &dimensions[&pair.real.part]);
        }
    }
    page
}

/// Where ours differs on purpose.
fn deviations(page: &mut String, dimensions: &BTreeMap<PartName, Vec<Dimension>>) {
    page.push_str(
        "\n## Where they differ on purpose\n\n| part | dimension | stated or measured figure | ours | why |\n|---|---|---|---|---|\n",
    );
    for (part, dimension) in dimensions.iter().flat_map(|(part, all)| all.iter().map(move |dimension| (part, dimension))) {
        if let (Some(ours), Some(why)) = (dimension.ours, &dimension.why) {
            let _ = writeln!(page, "| {part} | {} | {} | {ours} | {why} |", dimension.name, dimension.figure);
        }
    }
}

fn dimension_table(page: &mut String, pair: &Pair, dimensions: &[Dimension]) {
    page.push_str("\n| dimension | figure | real STL | ours | ours - real |\n|---|---|---|---|---|\n");
    for dimension in dimensions {
        let [real, ours] = pair.meshes.each_ref().map(|mesh| dimension.by.measure(mesh).expect("the probe meets the part"));
        let (name, figure, unit) = (&dimension.name, dimension.figure, dimension.by.unit());
        let off = ours - real;
        // No minus before nothing.
        let off = if off.abs() < 5e-4 { 0.0 } else { off };
        let _ = writeln!(page, "| {name}, {unit} | {figure} | {real:.3} | {ours:.3} | {off:+.3} |");
    }
}

/// Red, green, blue bytes of one of the crate's pictures.
fn rgb(png_bytes: &[u8]) -> Vec<u8> {
    let mut reader = png::Decoder::new(std::io::Cursor::new(png_bytes)).read_info().expect("it is a PNG");
    let mut bytes = vec![0; reader.output_buffer_size().expect("it has a size")];
    reader.next_frame(&mut bytes).expect("it is whole");
    bytes
}

/// Rows of two views each as a PNG file with a palette.
fn sheet(rows: &[[Vec<u8>; 2]; 2]) -> Vec<u8> {
    let line = 3 * VIEW[0] as usize;
    let lines = rows.iter().flat_map(|[left, right]| left.chunks(line).zip(right.chunks(line)));
    let shade = |value: u8| ((u16::from(value) * SHADES + 127) / 255 * 255 / SHADES) as u8;
    let pixels: Vec<[u8; 3]> = lines.flat_map(|(l, r)| l.chunks(3).chain(r.chunks(3))).map(|p| [p[0], p[1], p[2]].map(shade)).collect();
    let colours: BTreeSet<[u8; 3]> = pixels.iter().copied().collect();
    let palette: Vec<[u8; 3]> = colours.into_iter().collect();
    let index = |pixel| palette.binary_search(pixel).ok().and_then(|i| u8::try_from(i).ok()).expect("one colour has few shades");
    let indices: Vec<u8> = pixels.iter().map(index).collect();
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 2 * VIEW[0], 2 * VIEW[1]);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_palette(palette.concat());
    encoder.set_compression(png::Compression::High);
    encoder.set_filter(png::Filter::NoFilter);
    let mut writer = encoder.write_header().expect("memory takes it");
    writer.write_image_data(&indices).expect("the size is right");
    writer.finish().expect("memory takes it");
    bytes
}

const INTRODUCTION: &str = "\
# The preset `cognifly-v8` and the real frame

This page is written by `examples/compare_v8.rs`. Run it again after a change to a part:

    FLEXFRAME_DATA=../shared/data cargo run --release --example compare_v8

The STL files of the real CogniFly, version 8, carry no licence. They are not part of this repository. The program reads them from
the folder that `FLEXFRAME_DATA` names, and only figures and renderings are stored here. The pictures show the real part on the left
and ours on the right: in the upper row in print orientation, in the lower row turned over.

The box gives the edges of the bounding box in the axes of the real file. The overlap is the volume of the intersection over that of the
union. For it, the two parts are superimposed by their known axes, without fitting. A fitted position could only increase it.
Functional dimensions are measured with the same probes (`tests/frame/real/probe.rs`) on both STL files. The column `figure` comes from
cylinder and plane fits on the real frame's STEP files. `tests/frame/measured_parts.rs`, `tests/frame/measured_overlap.rs` and
`tests/frame/measured_skeleton.rs` check these limits: boxes 1 mm, volumes 10 %, dimensions 0.05 mm, overlap at least 0.85.

";
