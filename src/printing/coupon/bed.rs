//! The pieces of a coupon on the bed: those of a material behind each other, as far apart as their brims need, in the middle or where nothing is kept
//! clear.

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

impl<'a> Coupon<'a> {
    /// A plate for each material; none for one whose pieces do not lie on this bed together.
    pub fn plates(&'a self, printer: &Printer) -> Vec<CouponPlate<'a>> {
        let mut plates: Vec<CouponPlate> = Vec::new();
        for piece in &self.pieces {
            match plates.iter_mut().find(|plate| plate.material.name == piece.material.name) {
                Some(plate) => plate.placed.push((piece, Isometry3::identity())),
                None => plates.push(CouponPlate { material: piece.material, placed: vec![(piece, Isometry3::identity())] }),
            }
        }
        plates.into_iter().filter_map(|plate| plate.laid_out(printer)).collect()
    }
}

impl CouponPlate<'_> {
    fn laid_out(mut self, printer: &Printer) -> Option<Self> {
        let sizes: Vec<[f64; 3]> = self.placed.iter().map(|(piece, _)| piece.mesh.size_mm()).collect();
        let Room { gap_mm, edge_mm, .. } = Room::of(printer, self.material.material.brim_mm.unwrap_or(0.0));
        let wide = sizes.iter().map(|size| size[0]).fold(0.0, f64::max);
        let deep = sizes.iter().map(|size| size[1] + gap_mm).sum::<f64>() - gap_mm;
        let middle = middle_of_box([wide, deep], printer, edge_mm)?;
        let mut y_mm = middle[1] - 0.5 * deep;
        for ((piece, pose), size) in self.placed.iter_mut().zip(sizes) {
            let [low, high] = piece.mesh.bounds_mm();
            let x_mm = middle[0] - 0.5 * (low[0] + high[0]);
            *pose = Isometry3::from(Translation3::new(x_mm, y_mm - low[1], -low[2]));
            y_mm += size[1] + gap_mm;
        }
        Some(self)
    }
}
