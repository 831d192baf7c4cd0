//! The pieces of a coupon on the bed: those of a material behind each other, as far apart as their brims need, in the middle or where nothing is kept
//! clear; on as many plates as they take.

use nalgebra::{Isometry3, Translation3};

use super::pieces::{Coupon, Piece};
use crate::params::catalogue::Printer;
use crate::params::frame::NamedMaterial;
use crate::printing::room::{Room, middle_of_box};

/// Pieces of one material in their places on the bed, in the printer's coordinates.
pub struct CouponPlate<'a> {
    /// What it is printed of.
    pub material: &'a NamedMaterial,
    /// Each piece with the way from its own axes to the bed's.
    pub placed: Vec<(&'a Piece<'a>, Isometry3<f64>)>,
}

/// The plates of a coupon, and the pieces that lie on none.
pub struct CouponPlates<'a> {
    /// As many of each material as it takes.
    pub plates: Vec<CouponPlate<'a>>,
    /// Pieces that are larger than the room on the bed.
    pub no_room: Vec<&'a Piece<'a>>,
}

impl<'a> Coupon<'a> {
    /// Its pieces on the bed of a printer.
    pub fn plates(&'a self, printer: &Printer) -> CouponPlates<'a> {
        let mut all = CouponPlates { plates: Vec::new(), no_room: Vec::new() };
        let mut open: Vec<&Piece> = self.pieces.iter().collect();
        while let Some(first) = open.first() {
            let material = first.material;
            let mut taken: Vec<&Piece> = Vec::new();
            for piece in open.iter().filter(|piece| piece.material.name == material.name) {
                taken.push(piece);
                if laid_out(&taken, printer).is_none() {
                    taken.pop();
                }
            }
            let is_taken = |piece: &Piece| taken.iter().any(|one| one.name == piece.name);
            match laid_out(&taken, printer).filter(|placed| !placed.is_empty()) {
                Some(placed) => {
                    open.retain(|piece| !is_taken(piece));
                    all.plates.push(CouponPlate { material, placed });
                }
                None => {
                    let (none, others) = open.into_iter().partition(|piece| piece.material.name == material.name);
                    all.no_room.extend::<Vec<&Piece>>(none);
                    open = others;
                }
            }
        }
        all
    }
}

/// Pieces of one material behind each other; nothing where they have no room together.
fn laid_out<'a>(pieces: &[&'a Piece<'a>], printer: &Printer) -> Option<Vec<(&'a Piece<'a>, Isometry3<f64>)>> {
    let sizes: Vec<[f64; 3]> = pieces.iter().map(|piece| piece.mesh.size_mm()).collect();
    let brim_mm = pieces.first().map_or(0.0, |piece| piece.material.material.brim_mm.unwrap_or(0.0));
    let Room { gap_mm, edge_mm, .. } = Room::of(printer, brim_mm);
    let wide = sizes.iter().map(|size| size[0]).fold(0.0, f64::max);
    let deep = sizes.iter().map(|size| size[1] + gap_mm).sum::<f64>() - gap_mm;
    let middle = middle_of_box([wide, deep], printer, edge_mm)?;
    let mut y_mm = middle[1] - 0.5 * deep;
    let placed = pieces.iter().zip(sizes).map(|(piece, size)| {
        let [low, high] = piece.mesh.bounds_mm();
        let x_mm = middle[0] - 0.5 * (low[0] + high[0]);
        let pose = Isometry3::from(Translation3::new(x_mm, y_mm - low[1], -low[2]));
        y_mm += size[1] + gap_mm;
        (*piece, pose)
    });
    Some(placed.collect())
}
