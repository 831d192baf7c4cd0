//! The pictures of a frame: assembled, flat on the bed, and each part.

use nalgebra::Isometry3;
use rayon::prelude::*;

use crate::frame::assembly::{Body, Design, Printed};
use crate::report::picture::image as picture;
use crate::report::picture::image::{Bed, Item, View};

/// Width and height of the pictures of the whole frame, pixels.
const FRAME_SIZE: [u32; 2] = [1024, 768];

/// Width and height of the picture of one part, pixels.
const PART_SIZE: [u32; 2] = [480, 360];

/// Room between parts on the bed, mm.
const ROOM_MM: f64 = 4.0;

/// Every picture, path and PNG bytes.
pub fn pictures(design: &Design) -> Vec<(String, Vec<u8>)> {
    let mut jobs: Vec<Job> = [("front", View::Front), ("right", View::Right), ("top", View::Top), ("perspective", View::Perspective)]
        .into_iter()
        .map(|(name, view)| Job::Assembled(name, view))
        .collect();
    jobs.push(Job::Bed);
    jobs.extend(design.printed.iter().map(Job::Part));
    jobs.par_iter().map(|job| (job.path(), job.kept(design))).collect()
}

enum Job<'a> {
    Assembled(&'static str, View),
    Bed,
    Part(&'a Printed),
}

impl Job<'_> {
    fn path(&self) -> String {
        match self {
            Self::Assembled(name, _) => format!("pictures/assembled_{name}.png"),
            Self::Bed => "pictures/flat_on_bed.png".into(),
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
                design.memo.get("picture", &path, &(view, design.bodies.iter().map(body).collect::<Vec<_>>()), draw)
            }
            Self::Bed => {
                let parts: Vec<_> = design.printed.iter().map(printed).collect();
                design.memo.get("picture", &path, &(parts, design.frame.printer.size_mm), draw)
            }
            Self::Part(part) => design.memo.get("picture", &path, &printed(part), draw),
        };
        kept.to_vec()
    }

    fn draw(&self, design: &Design) -> Vec<u8> {
        let [width, height] = FRAME_SIZE;
        match self {
            Self::Assembled(_, view) => picture::png(&assembled(design), *view, width, height),
            Self::Bed => {
                let (items, bed) = on_bed(design);
                picture::png_on_bed(&items, &bed, View::Perspective, width, height)
            }
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

pub(in crate::report) fn assembled(design: &Design) -> Vec<Item<'_>> {
    let item = |body: &Body| {
        let shape = &design.shapes[body.shape];
        Item { mesh: &shape.mesh, pose: body.pose, colour: shape.colour }
    };
    design.bodies.iter().map(item).collect()
}

/// All copies of all parts in rows on the printer's bed, deepest first; rows that do not fit run over its far edge.
fn on_bed(design: &Design) -> (Vec<Item<'_>>, Bed) {
    let bed = Bed { size_mm: design.frame.printer.size_mm };
    let mut copies: Vec<&Printed> =
        design.printed.iter().flat_map(|part| std::iter::repeat_n(part, part.part.quantity() as usize)).collect();
    copies.sort_by(|a, b| b.mesh.size_mm()[1].total_cmp(&a.mesh.size_mm()[1]).then(a.name.cmp(&b.name)));
    let (mut x, mut y, mut depth) = (ROOM_MM, ROOM_MM, 0.0_f64);
    let mut items = Vec::new();
    for part in copies {
        let [low, high] = part.mesh.bounds_mm();
        let size = [high[0] - low[0], high[1] - low[1]];
        if x + size[0] + ROOM_MM > bed.size_mm[0] {
            (x, y, depth) = (ROOM_MM, y + depth + ROOM_MM, 0.0);
        }
        let pose = Isometry3::translation(x - low[0], y - low[1], 0.0);
        items.push(Item { mesh: &part.mesh, pose, colour: colour(design, part) });
        x += size[0] + ROOM_MM;
        depth = depth.max(size[1]);
    }
    (items, bed)
}
