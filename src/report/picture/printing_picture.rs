//! A part as it is printed, with what the rules of printing found marked: what hangs over air, walls and gaps that the
//! nozzle cannot follow, a first layer that does not hold. From above and from below, and in words.

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use rayon::prelude::*;

use super::lettering::Lettering;
use crate::checks::{ThinnestWall, Verdict, standing};
use crate::figures::decimals;
use crate::frame::assembly::{Design, Printed};
use crate::params::PartName;
use crate::printing::printability;
use crate::printing::printability::{Fault, Hanging, Process};
use crate::report::picture::image as picture;
use crate::report::picture::image::{Item, View};
use crate::solid::{Feature, Mesh, MeshSolid};

/// Width and height of one view, pixels.
const VIEW: [u32; 2] = [560, 420];
/// Height of a line of words, and of their letters, pixels.
const WORDS: [f64; 2] = [22.0, 15.0];
/// Most places that are described in words.
const MOST_TOLD: usize = 6;
/// Colour of the part.
const PART: [f32; 4] = [0.55, 0.56, 0.58, 1.0];
/// Colour of what is no place over air.
const BLUE: [f32; 4] = [0.05, 0.2, 0.85, 1.0];
/// A mark is this thick, mm, and its upper side this far inside the part.
const MARK_MM: [f64; 2] = [0.3, 0.05];
/// Radius of the ball around a thin spot, mm.
const SPOT_MM: f64 = 0.8;

/// What is drawn and said of a finding.
#[derive(Clone)]
struct Mark {
    meshes: Vec<Mesh>,
    colour: [f32; 4],
    legend: &'static str,
    words: String,
}

/// A picture of each part on which there is something to see, path and PNG bytes.
pub fn pictures(design: &Design) -> Vec<(String, Vec<u8>)> {
    design.printed.par_iter().filter_map(|part| Some((file_of(part.name), picture_of(design, part)?))).collect()
}

/// What a part's picture is called.
pub fn file_of(part: PartName) -> String {
    format!("printing_{part}.png")
}

fn picture_of(design: &Design, part: &Printed) -> Option<Vec<u8>> {
    let process = Process::of(&design.material_of(part.name).material, &design.frame.printer);
    let marks = [thin_spots(design, part), footing(design, part, &process), over_air(design, part, &process)].concat();
    (!marks.is_empty()).then(|| drawn(part, &marks))
}

/// Walls and gaps that are too narrow.
fn thin_spots(design: &Design, part: &Printed) -> Vec<Mark> {
    let walls = ThinnestWall::of(design, part);
    let broken = walls.iter().map(|wall| (wall, wall.finding())).filter(|(_, finding)| finding.verdict == Verdict::Violated);
    broken
        .filter_map(|(wall, finding)| {
            let [x, y, z] = wall.thinnest?.at_mm;
            let spot = MeshSolid::build(&Feature::sphere(SPOT_MM).at(x, y, z)).to_mesh();
            let legend = if wall.gap { "blue: too narrow a gap" } else { "blue: too thin a wall" };
            Some(Mark { meshes: vec![spot], colour: BLUE, legend, words: finding.message })
        })
        .collect()
}

/// The first layer, where the part does not stand on it as it should.
fn footing(design: &Design, part: &Printed, process: &Process) -> Vec<Mark> {
    let broken = standing(design, part).into_iter().filter(|finding| finding.verdict == Verdict::Violated);
    let layer = || part.printed().slice(0.5 * process.layer_mm).drawn_up(-MARK_MM[0], MARK_MM[1]).to_mesh();
    broken.map(|finding| Mark { meshes: vec![layer()], colour: BLUE, legend: "blue: the first layer", words: finding.message }).collect()
}

/// What hangs: what breaks a rule first, then the largest.
fn over_air(design: &Design, part: &Printed, process: &Process) -> Vec<Mark> {
    let found = printability::hanging(design, part, process);
    let mut places: Vec<&Hanging> = found.iter().collect();
    places.sort_by(|a, b| {
        let rank = |place: &Hanging| place.fault(process).is_none();
        rank(a).cmp(&rank(b)).then(b.area_mm2.total_cmp(&a.area_mm2))
    });
    places
        .iter()
        .map(|place| {
            let (colour, legend) = look(place.fault(process));
            Mark { meshes: terraces(place), colour, legend, words: described(place) }
        })
        .collect()
}

/// Colour and name of what a place is.
fn look(fault: Option<Fault>) -> ([f32; 4], &'static str) {
    match fault {
        Some(Fault::Overhang) => ([0.85, 0.02, 0.02, 1.0], "red: overhang beyond its limit"),
        Some(Fault::Island) => ([0.65, 0.0, 0.65, 1.0], "purple: begins in the air"),
        Some(Fault::Bridge) => ([0.95, 0.35, 0.0, 1.0], "orange: bridge beyond its limit"),
        None => ([0.10, 0.55, 0.15, 1.0], "green: self-supporting"),
    }
}

/// A slab under the unsupported regions of each layer.
fn terraces(place: &Hanging) -> Vec<Mesh> {
    place.layers.iter().map(|(bottom_mm, piece)| piece.drawn_up(bottom_mm - MARK_MM[0], bottom_mm + MARK_MM[1]).to_mesh()).collect()
}

fn described(place: &Hanging) -> String {
    let [x, y] = place.plan.middle_mm().map(|mm| decimals(mm, 1));
    let size = if place.bridged {
        format!("spans {} mm", decimals(place.span_mm, 1))
    } else if place.island {
        "begins in the air".into()
    } else {
        format!("reaches out by {} mm", decimals(place.reach_mm, 1))
    };
    let [low, high] = place.heights_mm.map(|mm| decimals(mm, 1));
    format!("{} mm\u{b2} at {x}, {y}, {low} to {high} mm high: {size}", decimals(place.area_mm2, 1))
}

fn drawn(part: &Printed, marks: &[Mark]) -> Vec<u8> {
    let over = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI);
    let views = [UnitQuaternion::identity(), over].map(|turn| {
        let pose = Isometry3::from_parts(Translation3::identity(), turn);
        let body = Item { mesh: &part.mesh, pose, colour: PART };
        let marked = marks.iter().flat_map(|mark| mark.meshes.iter().map(move |mesh| Item { mesh, pose, colour: mark.colour }));
        let items: Vec<Item> = marked.chain([body]).collect();
        picture::pixels(&items, &[], View::Perspective, VIEW)
    });
    let lines = words(part, marks);
    let [width, height] = [2 * VIEW[0], VIEW[1] + (WORDS[0] * lines.len() as f64 + 8.0) as u32];
    let mut rgb = Vec::with_capacity((3 * width * height) as usize);
    let row = 3 * VIEW[0] as usize;
    for (left, right) in views[0].chunks_exact(row).zip(views[1].chunks_exact(row)) {
        rgb.extend_from_slice(left);
        rgb.extend_from_slice(right);
    }
    rgb.resize((3 * width * height) as usize, 255);
    if let Some(lettering) = Lettering::new() {
        for (at, line) in lines.iter().enumerate() {
            let y = f64::from(VIEW[1]) + WORDS[0] * (at as f64 + 0.5);
            lettering.write(&mut rgb, width as usize, line, WORDS[1], [0.5 * f64::from(width), y]);
        }
    }
    picture::encoded(&rgb, width, height)
}

fn words(part: &Printed, marks: &[Mark]) -> Vec<String> {
    let mut legends: Vec<&str> = Vec::new();
    for mark in marks {
        if !legends.contains(&mark.legend) {
            legends.push(mark.legend);
        }
    }
    let mut lines = vec![format!("{}, from above and from below; {}", part.name, legends.join(", "))];
    lines.extend(marks.iter().take(MOST_TOLD).map(|mark| mark.words.clone()));
    if marks.len() > MOST_TOLD {
        lines.push(format!("and {} more", marks.len() - MOST_TOLD));
    }
    lines
}
