//! The pieces of a coupon, made.

use super::gauge;
use crate::params::Frame;
use crate::params::frame::NamedMaterial;
use crate::solid::gate::{self, GateError};
use crate::solid::{Feature, Mesh, MeshSolid};

/// A piece.
pub struct Piece<'a> {
    /// What its file is called.
    pub name: &'static str,
    /// What it is printed of.
    pub material: &'a NamedMaterial,
    /// As printed, resting on z = 0, mm.
    pub mesh: Mesh,
}

/// The pieces of a frame's coupon.
pub struct Coupon<'a> {
    /// Row of bores, windows and tongues; bar with plug; bosses.
    pub pieces: [Piece<'a>; 3],
}

/// A piece that cannot be made.
#[derive(Debug, thiserror::Error)]
#[error("the coupon's {piece} cannot be made: {}", .error.meaning())]
pub struct CouponError {
    /// Which.
    piece: &'static str,
    /// Why.
    error: GateError,
}

impl<'a> Coupon<'a> {
    /// The coupon for the rods, bars, plugs and hinges of a frame.
    ///
    /// # Errors
    /// When a piece's mesh does not pass the export gate.
    pub fn new(frame: &'a Frame) -> Result<Self, CouponError> {
        // As the parts of this printer are drawn.
        let wider_mm = 0.5 * frame.printer.hole_undersize_mm.unwrap_or(0.0);
        let piece = |name: &'static str, material: &'a NamedMaterial, feature: &Feature| {
            let mesh = MeshSolid::build(&feature.with_wider_bores(wider_mm)).simplified().mesh();
            gate::pass(&mesh).map(|_| Piece { name, material, mesh }).map_err(|error| CouponError { piece: name, error })
        };
        Ok(Self {
            pieces: [
                piece("gauge", &frame.flexible, &gauge::flexible(frame))?,
                piece("bar", &frame.flexible, &gauge::bar(frame))?,
                piece("bosses", &frame.rigid, &gauge::rigid(frame))?,
            ],
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::FrameFile;

    /// Where a straight line along y, at a place and height, is outside the solid all the way back.
    fn is_open(mesh: &MeshSolid, x: f64, z: f64) -> bool {
        use nalgebra::Point3;
        mesh.first_hit(Point3::new(x, 3.7, z), Point3::new(x, 30.0, z)).is_none()
    }

    #[test]
    fn analytic_bores_are_as_wide_as_their_numbers_say() {
        for preset in ["cognifly", "cognifly-mini", "cognifly-v8"] {
            let file = FrameFile::load(preset).expect("is a preset");
            let frame = Frame::resolve(&file).expect("resolves");
            let coupon = Coupon::new(&frame).expect("is made");
            let solid = MeshSolid::from_mesh(&coupon.pieces[0].mesh).expect("is closed");
            let rod_mm = frame.rods.rod_diameter_mm;
            let mut x = 0.0;
            for tenths in gauge::BORES_TENTHS {
                let bore_mm = rod_mm + 0.1 * f64::from(tenths);
                let width = (bore_mm + 0.9).max(4.2);
                let (middle, axis) = (x + 0.5 * width, 0.5 * bore_mm + 0.9);
                for side in [-1.0, 1.0] {
                    assert!(is_open(&solid, middle + side * (0.5 * bore_mm - 0.005), axis), "{preset} {bore_mm}");
                    assert!(!is_open(&solid, middle + side * (0.5 * bore_mm + 0.02), axis), "{preset} {bore_mm}");
                }
                x += width;
            }
            for piece in &coupon.pieces {
                let [low, high] = piece.mesh.bounds_mm();
                assert!(low[2].abs() < 1e-6 && high[0] - low[0] < 100.0 && high[2] < 12.0, "{} {low:?} {high:?}", piece.name);
            }
        }
    }
}
