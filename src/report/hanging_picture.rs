//! A part as it is printed, with what hangs over air marked: from above and from below, and in words.

use nalgebra::{Isometry3, UnitQuaternion, Vector3};
use rayon::prelude::*;

use super::lettering::Lettering;
use super::picture::{self, Item, View};
use crate::assembly::{Design, Printed};
use crate::figures::decimals;
use crate::printability::{self, Fault, Hanging, Process};
use crate::solid::Mesh;

/// Width and height of one view, pixels.
const VIEW: [u32; 2] = [560, 420];
/// Height of a line of words, and of their letters, pixels.
const WORDS: [f64; 2] = [22.0, 15.0];
/// Most places that are told in words.
const MOST_TOLD: usize = 6;
/// Colour of the part.
const PART: [f32; 4] = [0.55, 0.56, 0.58, 1.0];
/// A mark is this thick, mm, and its upper side this far inside the part.
const MARK_MM: [f64; 2] = [0.3, 0.05];

/// A picture of each part that has a place over air, path and PNG bytes.
pub fn pictures(design: &Design) -> Vec<(String, Vec<u8>)> {
    design.printed.par_iter().filter_map(|part| Some((format!("hanging_{}.png", part.name), picture_of(design, part)?))).collect()
}

fn picture_of(design: &Design, part: &Printed) -> Option<Vec<u8>> {
    let material = design.material_of(part.name);
    let process = Process::of(&material.material, &design.frame.printer);
    let mut places = printability::hanging(part, &process);
    // What breaks a rule first, then the largest.
    places.sort_by(|a, b| {
        let rank = |place: &Hanging| place.fault(&process).is_none();
        rank(a).cmp(&rank(b)).then(b.area_mm2.total_cmp(&a.area_mm2))
    });
    (!places.is_empty()).then(|| drawn(part, &places, &process))
}

/// Colour and name of what a place is.
fn look(fault: Option<Fault>) -> ([f32; 4], &'static str) {
    match fault {
        Some(Fault::Overhang) => ([0.85, 0.02, 0.02, 1.0], "red: overhang beyond its limit"),
        Some(Fault::Island) => ([0.65, 0.0, 0.65, 1.0], "purple: begins in the air"),
        Some(Fault::Bridge) => ([0.95, 0.35, 0.0, 1.0], "orange: bridge beyond its limit"),
        None => ([0.10, 0.55, 0.15, 1.0], "green: holds itself"),
    }
}

fn drawn(part: &Printed, places: &[Hanging], process: &Process) -> Vec<u8> {
    let marks: Vec<(Mesh, [f32; 4])> = places.iter().map(|place| (mark(place), look(place.fault(process)).0)).collect();
    let over = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI);
    let views = [UnitQuaternion::identity(), over].map(|turn| {
        let pose = Isometry3::from_parts(nalgebra::Translation3::identity(), turn);
        let body = Item { mesh: &part.mesh, pose, colour: PART };
        let items: Vec<Item> = marks.iter().map(|(mesh, colour)| Item { mesh, pose, colour: *colour }).chain([body]).collect();
        picture::pixels(&items, None, View::Perspective, VIEW)
    });
    let told = words(part, places, process);
    let [width, height] = [2 * VIEW[0], VIEW[1] + (WORDS[0] * told.len() as f64 + 8.0) as u32];
    let mut rgb = Vec::with_capacity((3 * width * height) as usize);
    let row = 3 * VIEW[0] as usize;
    for (left, right) in views[0].chunks_exact(row).zip(views[1].chunks_exact(row)) {
        rgb.extend_from_slice(left);
        rgb.extend_from_slice(right);
    }
    rgb.resize((3 * width * height) as usize, 255);
    if let Some(lettering) = Lettering::new() {
        for (at, line) in told.iter().enumerate() {
            let y = f64::from(VIEW[1]) + WORDS[0] * (at as f64 + 0.5);
            lettering.write(&mut rgb, width as usize, line, WORDS[1], [0.5 * f64::from(width), y]);
        }
    }
    picture::encoded(&rgb, width, height)
}

/// A slab under the place.
fn mark(place: &Hanging) -> Mesh {
    let bottom = place.heights_mm[0];
    place.plan.drawn_up(bottom - MARK_MM[0], bottom + MARK_MM[1]).to_mesh()
}

fn words(part: &Printed, places: &[Hanging], process: &Process) -> Vec<String> {
    let mut looks: Vec<&str> = places.iter().map(|place| look(place.fault(process)).1).collect();
    looks.dedup();
    let mut lines = vec![format!("{}, from above and from below; {}", part.name, looks.join(", "))];
    for place in places.iter().take(MOST_TOLD) {
        let [x, y] = place.plan.middle_mm().map(|mm| decimals(mm, 1));
        let size = if place.bridged { format!("spans {} mm", decimals(place.span_mm, 1)) } else { reach(place) };
        let (area, low) = (decimals(place.area_mm2, 1), decimals(place.heights_mm[0], 1));
        lines.push(format!("{area} mm\u{b2} at {x}, {y}, {low} mm high: {size}"));
    }
    if places.len() > MOST_TOLD {
        lines.push(format!("and {} more", places.len() - MOST_TOLD));
    }
    lines
}

fn reach(place: &Hanging) -> String {
    if place.island { "begins in the air".into() } else { format!("reaches out by {} mm", decimals(place.reach_mm, 1)) }
}
