//! Filling plates: rectangles around the parts, packed by a library (docs/decisions/0030-plates.md).

use crunch::{Item as Rectangle, PackedItem, Rect, Rotation};
use rayon::prelude::*;

use super::plate::{Item, Plate, short};
use crate::frame::assembly::{Design, Printed};
use crate::params::PartName;
use crate::params::catalogue::Printer;
use crate::params::frame::NamedMaterial;
use crate::printing::printability;
use crate::printing::printability::Process;
use crate::printing::room::{Place, Room, alone, lies_clear};

/// Steps a millimetre in which the library counts.
const STEPS: f64 = 100.0;

/// The smallest rectangle that is tried, as a share of the bed's sides, and by how much one is smaller than the next, %.
const MOST_SHRUNK_PERCENT: u32 = 20;
const SHRINK_STEP_PERCENT: usize = 2;

/// How many of a part are wanted.
pub type Wanted = (PartName, usize);

/// A part that lies on no bed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{part}, {} x {} x {} mm as printed, has no room on the printer {printer}", .size_mm[0].round(), .size_mm[1].round(), .size_mm[2].round())]
pub struct NoRoom {
    /// The part.
    pub part: PartName,
    /// Its size, mm.
    pub size_mm: [f64; 3],
    /// The printer.
    pub printer: String,
}

/// All that the frame needs.
pub fn all(design: &Design) -> Vec<Wanted> {
    design.printed.iter().map(|part| (part.name, part.part.quantity() as usize)).collect()
}

/// As many plates as are needed, those of the flexible material first.
///
/// # Errors
/// [`NoRoom`] for a part that does not lie on the bed even alone.
pub fn arrange(design: &Design, wanted: &[Wanted]) -> Result<Vec<Plate>, NoRoom> {
    let (plates, no_room) = laid_out(design, wanted);
    no_room.into_iter().next().map_or(Ok(plates), Err)
}

/// The same without the parts that have no room: what can be printed of a frame on a small bed.
pub fn arrange_what_fits(design: &Design, wanted: &[Wanted]) -> Vec<Plate> {
    laid_out(design, wanted).0
}

/// What of the wanted parts lies on none of these plates.
pub fn without_room(plates: &[Plate], wanted: &[Wanted]) -> Vec<Wanted> {
    let laid = |name: PartName| plates.iter().flat_map(|plate| &plate.items).filter(|item| item.part == name).count();
    wanted.iter().map(|(name, count)| (*name, count.saturating_sub(laid(*name)))).filter(|(_, count)| *count > 0).collect()
}

/// Plates, and what lies on none.
fn laid_out(design: &Design, wanted: &[Wanted]) -> (Vec<Plate>, Vec<NoRoom>) {
    let (mut plates, mut no_room) = (Vec::new(), Vec::new());
    let supported = supported(design, wanted);
    for material in materials(design) {
        let parts: Vec<&Printed> = wanted
            .iter()
            .filter(|(name, _)| design.material_of(*name).name == material.name)
            .flat_map(|(name, count)| design.part(*name).into_iter().flat_map(|part| std::iter::repeat_n(part, *count)))
            .collect();
        // Two grades of one material have plates of one name.
        let before = plates.iter().filter(|plate: &&Plate| short(&plate.material.name) == short(&material.name)).count();
        for (at, mut items) in
            filled(&parts, &design.frame.printer, material.material.brim_mm.unwrap_or(0.0), &mut no_room).into_iter().enumerate()
        {
            items.sort_by(|a, b| a.part.cmp(&b.part).then(place(a).partial_cmp(&place(b)).unwrap_or(std::cmp::Ordering::Equal)));
            let supported = supported.iter().copied().filter(|name| items.iter().any(|item| item.part == *name)).collect();
            plates.push(Plate { material: material.clone(), number: before + at + 1, items, supported });
        }
    }
    (plates, no_room)
}

/// The wanted parts that hang over air by more than their material prints.
fn supported(design: &Design, wanted: &[Wanted]) -> Vec<PartName> {
    let needs = |name: &PartName| {
        let process = Process::of(&design.material_of(*name).material, &design.frame.printer);
        let needs = |part: &Printed| {
            let inputs = (part.flat.key(), part.print_pose, process);
            *design.memo.get("support", name.slug(), &inputs, || printability::needs_support(design, part, &process))
        };
        design.part(*name).is_some_and(needs)
    };
    wanted.par_iter().map(|(name, _)| *name).filter(needs).collect()
}

fn place(item: &Item) -> [f64; 2] {
    [item.middle_mm[1], item.middle_mm[0]]
}

/// Materials of the frame, each once.
fn materials(design: &Design) -> Vec<&NamedMaterial> {
    let (flexible, rigid) = (&design.frame.flexible, &design.frame.rigid);
    if flexible.name == rigid.name { vec![flexible] } else { vec![flexible, rigid] }
}

/// Plates of parts of one material; what lies on no bed is added to `no_room`.
fn filled(parts: &[&Printed], printer: &Printer, brim_mm: f64, no_room: &mut Vec<NoRoom>) -> Vec<Vec<Item>> {
    let room = Room::of(printer, brim_mm);
    let low_enough = |at: &usize| parts[*at].mesh.size_mm()[2] <= printer.height_mm;
    let mut open: Vec<usize> = (0..parts.len()).collect();
    let mut plates = Vec::new();
    while let Some(&first) = open.first() {
        let low: Vec<usize> = open.iter().copied().filter(low_enough).collect();
        let clear = clear(&packed(parts, &low, &room), parts, &room, printer);
        open.retain(|at| clear.iter().all(|(taken, _)| taken != at));
        if !clear.is_empty() {
            plates.push(clear.into_iter().map(|(_, item)| item).collect());
            continue;
        }
        // None of those left lies in the room where nothing is kept clear; a bed is larger than the room.
        let part = parts[first];
        match alone(part, printer) {
            Some(Place { turned, middle_mm }) => plates.push(vec![Item { part: part.name, turned, middle_mm }]),
            None => no_room.push(NoRoom { part: part.name, size_mm: part.mesh.size_mm(), printer: printer.name.clone() }),
        }
        open.retain(|at| *at != first);
    }
    plates
}

/// What goes onto one plate: in the smallest rectangle of the room's proportions that takes as much as the whole room, as the middle of a
/// bed is flatter and warmer than its rim, and as the plate then lies on smaller beds, too.
fn packed(parts: &[&Printed], open: &[usize], room: &Room) -> Vec<PackedItem<usize>> {
    let mut best = most_into(parts, open, room);
    let chosen: Vec<usize> = best.iter().map(|item| item.data).collect();
    for percent in (MOST_SHRUNK_PERCENT..100).rev().step_by(SHRINK_STEP_PERCENT) {
        if let Some(smaller) = all_into(parts, &chosen, &room.shrunk(percent)) {
            best = smaller;
        }
    }
    best
}

/// All parts if they go into a rectangle together; else the largest, and of the others, from large to small, each that goes in beside them.
fn most_into(parts: &[&Printed], open: &[usize], room: &Room) -> Vec<PackedItem<usize>> {
    if let Some(all) = all_into(parts, open, room) {
        return all;
    }
    let area_mm2 = |at: &usize| {
        let [x, y, _] = parts[*at].mesh.size_mm();
        x * y
    };
    let mut from_large = open.to_vec();
    from_large.sort_by(|a, b| area_mm2(b).total_cmp(&area_mm2(a)).then(a.cmp(b)));
    let mut most = Vec::new();
    let mut chosen = Vec::new();
    for at in from_large {
        chosen.push(at);
        match all_into(parts, &chosen, room) {
            Some(packed) => most = packed,
            None => drop(chosen.pop()),
        }
    }
    most
}

/// Parts in a rectangle; `None` where not all of them go in.
fn all_into(parts: &[&Printed], open: &[usize], room: &Room) -> Option<Vec<PackedItem<usize>>> {
    let [width, depth] = room.size_mm.map(|size| ((size + room.gap_mm) * STEPS).floor() as usize);
    let boxes: Vec<Rectangle<usize>> = open
        .iter()
        .map(|at| (*at, parts[*at].mesh.size_mm()))
        .map(|(at, [x, y, _])| Rectangle::new(at, steps(x, room), steps(y, room), Rotation::Allowed))
        .collect();
    let each_fits = boxes.iter().all(|one| (one.w <= width && one.h <= depth) || (one.h <= width && one.w <= depth));
    each_fits.then(|| crunch::pack(Rect::new(0, 0, width, depth), boxes).ok()).flatten()
}

/// A part's side with the gap behind it.
fn steps(side_mm: f64, room: &Room) -> usize {
    ((side_mm + room.gap_mm) * STEPS).ceil() as usize
}

/// What was packed, by the place among the parts, in the middle of the bed, or mirrored or at an edge if then less of it lies where the printer is
/// kept clear; without what does.
fn clear(packed: &[PackedItem<usize>], parts: &[&Printed], room: &Room, printer: &Printer) -> Vec<(usize, Item)> {
    let items: Vec<Item> = packed.iter().map(|item| placed(item, parts[item.data], room)).collect();
    let [low, high] = bounds_mm(&items, parts, packed);
    let middle = [0, 1].map(|axis| 0.5 * (low[axis] + high[axis]));
    let free = [0, 1].map(|axis| (room.size_mm[axis] - (high[axis] - low[axis])).max(0.0));
    let moved = |shares: [f64; 2], signs: [f64; 2]| -> Vec<(usize, Item)> {
        let to = room.middle_mm();
        let places = packed.iter().zip(&items).map(|(packed, item)| {
            let middle_mm = [0, 1].map(|axis| to[axis] + shares[axis] * free[axis] + signs[axis] * (item.middle_mm[axis] - middle[axis]));
            (packed.data, Item { middle_mm, ..*item })
        });
        places
            .filter(|(at, item)| lies_clear(&Place { turned: item.turned, middle_mm: item.middle_mm }, parts[*at], printer, room.edge_mm))
            .collect()
    };
    let pairs = |of: &'static [f64]| of.iter().flat_map(move |y| of.iter().map(move |x| [*x, *y]));
    let ways = pairs(&[0.0, -0.5, 0.5]).flat_map(|shares| pairs(&[1.0, -1.0]).map(move |signs| moved(shares, signs)));
    ways.min_by_key(|clear| packed.len() - clear.len()).unwrap_or_default()
}

fn placed(item: &PackedItem<usize>, part: &Printed, room: &Room) -> Item {
    let [x, y, _] = part.mesh.size_mm();
    let turned = item.rect.w != steps(x, room);
    let side = if turned { [y, x] } else { [x, y] };
    let corner = [item.rect.x, item.rect.y].map(|at| at as f64 / STEPS);
    Item { part: part.name, turned, middle_mm: [0, 1].map(|axis| room.low_mm[axis] + corner[axis] + 0.5 * side[axis]) }
}

/// Least and greatest coordinates of what was packed, mm.
fn bounds_mm(items: &[Item], parts: &[&Printed], packed: &[PackedItem<usize>]) -> [[f64; 2]; 2] {
    let mut bounds = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    for (item, packed) in items.iter().zip(packed) {
        let [x, y, _] = parts[packed.data].mesh.size_mm();
        let side = if item.turned { [y, x] } else { [x, y] };
        for axis in 0..2 {
            bounds[0][axis] = bounds[0][axis].min(item.middle_mm[axis] - 0.5 * side[axis]);
            bounds[1][axis] = bounds[1][axis].max(item.middle_mm[axis] + 0.5 * side[axis]);
        }
    }
    bounds
}
