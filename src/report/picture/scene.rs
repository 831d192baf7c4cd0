//! The pictures of a frame: assembled, flat on the bed, and each part.

use std::ops::ControlFlow;

use nalgebra::{Isometry3, Point3, Vector3};
use rayon::prelude::*;

use super::labels::Labels;
use super::lettering::Lettering;
use super::plate_picture;
use crate::frame::assembly::wires::wires;
use crate::frame::assembly::{Body, Design, Printed};
use crate::frame::fold::Member;
use crate::frame::skeleton::MODULE_WORDS;
use crate::printing::plates::Plate;
use crate::report::picture::image as picture;
use crate::report::picture::image::{Bed, Item, View};
use crate::solid::Mesh;

/// Width and height of the pictures of the whole frame, pixels.
const FRAME_SIZE: [u32; 2] = [1024, 768];

/// Width and height of the picture of several plates, pixels.
const BEDS_SIZE: [u32; 2] = [1440, 720];

/// Width and height of the picture of one part, pixels.
const PART_SIZE: [u32; 2] = [480, 360];

/// Height of the letters, pixels.
const LETTERS: f64 = 22.0;

/// Room between parts in rows, mm.
const ROOM_MM: f64 = 4.0;

/// Between two beds, mm.
const BETWEEN_MM: f64 = 30.0;

/// Most beds beside each other.
const MOST_BESIDE: usize = 3;

/// How far off a corner there is room for its name, mm.
const OFF_CORNER_MM: f64 = 22.0;

/// Asked before each of several steps with its name and their number: whether it goes on.
pub type Begins<'a> = dyn Fn(&str, usize) -> ControlFlow<()> + Sync + 'a;

/// Every picture, path and PNG bytes; the parts lie on these plates.
pub fn pictures(design: &Design, plates: &[Plate]) -> Vec<(String, Vec<u8>)> {
    pictures_followed(design, plates, &|_, _| ControlFlow::Continue(())).unwrap_or_default()
}

/// The same, asking before each picture whether it goes on, with the picture's path and the number of all; none when it was ended.
pub fn pictures_followed(design: &Design, plates: &[Plate], begins: &Begins) -> Option<Vec<(String, Vec<u8>)>> {
    let jobs = jobs(design, plates);
    let draw = |job: &Job| {
        let path = job.path();
        let goes_on = begins(&path, jobs.len()).is_continue();
        goes_on.then(|| (path, job.kept(design)))
    };
    jobs.par_iter().map(draw).collect()
}

fn jobs<'a>(design: &'a Design, plates: &'a [Plate]) -> Vec<Job<'a>> {
    let mut jobs: Vec<Job> = [("front", View::Front), ("right", View::Right), ("top", View::Top), ("perspective", View::Perspective)]
        .into_iter()
        .map(|(name, view)| Job::Assembled(name, view))
        .collect();
    jobs.push(Job::Beds(plates));
    jobs.extend(design.printed.iter().map(Job::Part));
    jobs
}

enum Job<'a> {
    Assembled(&'static str, View),
    Beds(&'a [Plate]),
    Part(&'a Printed),
}

impl Job<'_> {
    fn path(&self) -> String {
        match self {
            Self::Assembled(name, _) => format!("pictures/assembled_{name}.png"),
            Self::Beds(_) => "pictures/flat_on_bed.png".into(),
            Self::Part(part) => format!("pictures/part_{}.png", part.name),
        }
    }

    /// The picture, drawn anew only when something in it is another.
    fn kept(&self, design: &Design) -> Vec<u8> {
        let printed = |part: &Printed| (part.name, part.flat.key(), part.print_pose, colour(design, part));
        let (path, draw) = (self.path(), || self.draw(design));
        let kept = match self {
            Self::Assembled(_, view) => {
                let body = |body: &Body| (design.shape(body).solid.key(), body.pose, design.shape(body).colour);
                design.memo.get("picture", &path, &(view, design.bodies.iter().map(body).collect::<Vec<_>>(), wires(design)), draw)
            }
            Self::Beds(plates) => {
                let parts: Vec<_> = design.printed.iter().map(printed).collect();
                let items: Vec<_> = plates.iter().map(|plate| (plate.name(), &plate.items)).collect();
                let printer = &design.frame.printer;
                design.memo.get("picture", &path, &(parts, items, printer.bed, printer.size_mm), draw)
            }
            Self::Part(part) => design.memo.get("picture", &path, &printed(part), draw),
        };
        kept.to_vec()
    }

    fn draw(&self, design: &Design) -> Vec<u8> {
        let [width, height] = FRAME_SIZE;
        match self {
            Self::Assembled(_, view @ (View::Perspective | View::Top)) => with_corners(design, *view),
            Self::Assembled(_, view) => picture::png(&assembled(design, &laid(design)), *view, width, height),
            Self::Beds(plates) => on_beds(design, plates),
            Self::Part(part) => {
                let [width, height] = PART_SIZE;
                let item = Item { mesh: &part.mesh, pose: Isometry3::identity(), colour: colour(design, part) };
                picture::png(&[item], View::Perspective, width, height)
            }
        }
    }
}

fn colour(design: &Design, part: &Printed) -> [f32; 4] {
    design.material_of(part.name).material.colour
}

/// The wires of a design as they are drawn in every picture of the assembled frame.
pub(in crate::report) fn laid(design: &Design) -> Vec<(Mesh, [f32; 4])> {
    wires(design).iter().map(|wire| (wire.mesh(), wire.colour)).collect()
}

/// The bodies and wires of the assembled frame.
pub(in crate::report) fn assembled<'a>(design: &'a Design, laid: &'a [(Mesh, [f32; 4])]) -> Vec<Item<'a>> {
    let wires = laid.iter().map(|(mesh, colour)| Item { mesh, pose: Isometry3::identity(), colour: *colour });
    let item = |body: &Body| {
        let shape = &design.shapes[body.shape];
        Item { mesh: &shape.mesh, pose: body.pose, colour: shape.colour }
    };
    design.bodies.iter().map(item).chain(wires).collect()
}

/// The frame with the names of its four corners.
fn with_corners(design: &Design, view: View) -> Vec<u8> {
    let [width, height] = FRAME_SIZE;
    let corner = |module: usize| design.bodies.iter().find(|body| body.name == Member::Corner(true).body(module));
    // Off the corner, so that there is white for the words.
    let off = |body: &Body| {
        let at = Point3::from(body.pose.translation.vector);
        let outward = Vector3::new(at.x, at.y, 0.0);
        at + outward * (OFF_CORNER_MM / outward.norm().max(1e-9))
    };
    let corners: Vec<(&str, &Body)> =
        MODULE_WORDS.iter().enumerate().filter_map(|(module, words)| Some((*words, corner(module)?))).collect();
    let room: Vec<Point3<f64>> = corners.iter().map(|(_, body)| off(body)).collect();
    let (mut rgb, camera) = picture::seen(&assembled(design, &laid(design)), &[], &room, view, FRAME_SIZE);
    if let Some(mut labels) = Labels::on(&mut rgb, width) {
        for (words, body) in corners {
            let [x, y, _] = camera.project(&Point3::from(body.pose.translation.vector));
            labels.put(words, LETTERS, [x, y]);
        }
    }
    picture::encoded(&rgb, width, height)
}

/// Every plate as it is printed, each on a bed of its own, beside each other; without plates all parts in rows on no bed.
fn on_beds(design: &Design, plates: &[Plate]) -> Vec<u8> {
    let [width, height] = if plates.len() > 1 { BEDS_SIZE } else { FRAME_SIZE };
    if plates.is_empty() {
        return picture::png(&in_rows(design), View::Perspective, width, height);
    }
    let printer = &design.frame.printer;
    let columns = plates.len().min(MOST_BESIDE);
    let (mut items, mut beds) = (Vec::new(), Vec::new());
    for (at, plate) in plates.iter().enumerate() {
        let low_mm = [0, 1].map(|axis| [at % columns, at / columns][axis] as f64 * (printer.size_mm[axis] + BETWEEN_MM));
        let moved = Isometry3::translation(low_mm[0], low_mm[1], 0.0) * plate_picture::from_corner(printer);
        beds.push(Bed { low_mm, ..Bed::of(printer) });
        let printed = plate.items.iter().filter_map(|item| Some((item, design.part(item.part)?)));
        let colour = plate.material.material.colour;
        items.extend(printed.map(|(item, part)| Item { mesh: &part.mesh, pose: moved * item.pose(part), colour }));
    }
    let names: Vec<Point3<f64>> =
        beds.iter().map(|bed| Point3::new(bed.low_mm[0] + 0.5 * bed.size_mm[0], bed.low_mm[1] - 0.4 * BETWEEN_MM, 0.0)).collect();
    let (mut rgb, camera) = picture::seen(&items, &beds, &names, View::Perspective, [width, height]);
    if let Some(lettering) = Lettering::new() {
        for (plate, at) in plates.iter().zip(&names) {
            let [x, y, _] = camera.project(at);
            lettering.write(&mut rgb, width as usize, &plate.name().replace('_', " "), LETTERS, [x, y]);
        }
    }
    picture::encoded(&rgb, width, height)
}

/// All copies of all parts in rows, deepest first, in a square.
fn in_rows(design: &Design) -> Vec<Item<'_>> {
    let mut copies: Vec<&Printed> =
        design.printed.iter().flat_map(|part| std::iter::repeat_n(part, part.part.quantity() as usize)).collect();
    copies.sort_by(|a, b| b.mesh.size_mm()[1].total_cmp(&a.mesh.size_mm()[1]).then(a.name.cmp(&b.name)));
    let room = |part: &Printed| part.mesh.size_mm().map(|size| size + ROOM_MM);
    let wide = copies.iter().map(|part| room(part)[0] * room(part)[1]).sum::<f64>().sqrt();
    let (mut x, mut y, mut depth) = (0.0, 0.0, 0.0_f64);
    let mut items = Vec::new();
    for part in copies {
        let ([low, _], [across, along, _]) = (part.mesh.bounds_mm(), room(part));
        if x > 0.0 && x + across > wide {
            (x, y, depth) = (0.0, y + depth, 0.0);
        }
        items.push(Item { mesh: &part.mesh, pose: Isometry3::translation(x - low[0], y - low[1], 0.0), colour: colour(design, part) });
        x += across;
        depth = depth.max(along);
    }
    items
}
