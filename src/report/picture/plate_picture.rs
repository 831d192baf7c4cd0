//! A plate as it lies on the bed.

use nalgebra::{Isometry3, Translation3};

use crate::frame::assembly::Design;
use crate::params::catalogue::{self, Printer};
use crate::printing::plates::Plate;
use crate::report::picture::image as picture;
use crate::report::picture::image::{Bed, Item, View};

/// The picture as the bytes of a PNG file; size in pixels.
pub fn png(design: &Design, plate: &Plate, size: [u32; 2]) -> Vec<u8> {
    let (printer, colour) = (&design.frame.printer, plate.material.material.colour);
    let parts: Vec<_> = design.printed.iter().map(|part| (part.name, part.flat.key(), part.print_pose)).collect();
    let inputs = (parts, &plate.items, printer.bed, printer.size_mm, colour, size);
    design.memo.get("picture", &plate.name(), &inputs, || drawn(design, plate, size)).to_vec()
}

/// From a printer's coordinates to those of a picture: its bed begins at its corner, a round one's coordinates in its middle.
pub fn from_corner(printer: &Printer) -> Isometry3<f64> {
    let shift = match printer.bed {
        catalogue::Bed::Rectangular => [0.0; 2],
        catalogue::Bed::Round => printer.size_mm.map(|size| 0.5 * size),
    };
    Isometry3::from(Translation3::new(shift[0], shift[1], 0.0))
}

fn drawn(design: &Design, plate: &Plate, [width, height]: [u32; 2]) -> Vec<u8> {
    let printer = &design.frame.printer;
    let moved = from_corner(printer);
    let colour = plate.material.material.colour;
    let item = |item: &crate::printing::plates::Item| {
        let part = design.part(item.part)?;
        Some(Item { mesh: &part.mesh, pose: moved * item.pose(part), colour })
    };
    let items: Vec<Item> = plate.items.iter().filter_map(item).collect();
    picture::png_on_bed(&items, &Bed::of(printer), View::Perspective, width, height)
}
