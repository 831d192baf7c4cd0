//! The pieces of a coupon, made.

use super::gauge;
use super::hinges::Hinges;
use crate::frame::assembly::compensated::drawn_in_below;
use crate::frame::skeleton::ClosureError;
use crate::params::Frame;
use crate::params::frame::NamedMaterial;
use crate::solid::gate::{self, GateError};
use crate::solid::{Feature, Mesh, MeshSolid};

/// A piece.
pub struct Piece<'a> {
    /// What its file is called.
    pub name: String,
    /// What it is printed of.
    pub material: &'a NamedMaterial,
    /// As printed, resting on z = 0, mm.
    pub mesh: Mesh,
}

/// The pieces of a frame's coupon.
pub struct Coupon<'a> {
    /// Row of bores, windows and tongues; bar with plug; hinges, the thinnest first; bosses.
    pub pieces: Vec<Piece<'a>>,
    /// What the hinges are.
    pub hinges: Hinges,
}

/// A piece that cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum CouponError {
    /// Its mesh is unsound.
    #[error("the coupon's {piece} cannot be made: {}", .error.meaning())]
    Unsound {
        /// Which.
        piece: String,
        /// Why.
        error: GateError,
    },
    /// Nothing says how far the hinges fold.
    #[error("the coupon's hinges fold as far as the frame's, and {error}; {}", .error.remedy())]
    Open {
        /// Why it does not close.
        error: ClosureError,
    },
}

impl<'a> Coupon<'a> {
    /// The coupon for the rods, bars, plugs and hinges of a frame.
    ///
    /// # Errors
    /// When a piece's mesh does not pass the export gate, or the frame does not close.
    pub fn new(frame: &'a Frame) -> Result<Self, CouponError> {
        // As the parts of this printer are drawn.
        let hole_mm = frame.printer.hole_undersize_mm.unwrap_or(0.0);
        let piece = |name: &str, material: &'a NamedMaterial, feature: &Feature| {
            let solid = MeshSolid::build(&feature.with_wider_bores(0.5 * hole_mm)).simplified();
            let drawn = match frame.printer.elephant_foot_mm {
                None | Some(0.0) => Ok(solid.mesh()),
                Some(_) => drawn_in_below(&solid, &frame.printer, frame.printer.layer_mm(&material.material)),
            };
            let passed = drawn.and_then(|mesh| gate::pass(&mesh).map(|_| mesh));
            match passed {
                Ok(mesh) => Ok(Piece { name: name.into(), material, mesh }),
                Err(error) => Err(CouponError::Unsound { piece: name.into(), error }),
            }
        };
        let hinges = Hinges::of(frame).map_err(|error| CouponError::Open { error })?;
        let hinge = |mm: f64| piece(&format!("hinge-{:02}", Hinges::number(mm)), &frame.flexible, &hinges.feature(mm));
        let mut pieces =
            vec![piece("gauge", &frame.flexible, &gauge::flexible(frame))?, piece("bar", &frame.flexible, &gauge::bar(frame))?];
        for thickness_mm in hinges.thicknesses_mm {
            pieces.push(hinge(thickness_mm)?);
        }
        pieces.push(piece("bosses", &frame.rigid, &gauge::rigid(frame))?);
        Ok(Self { pieces, hinges })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::FrameFile;
    use crate::params::catalogue::{Bed, Printer};
    use crate::units::Angle;

    /// Where a straight line along y, at a place and height, is outside the solid all the way back.
    fn is_open(mesh: &MeshSolid, x: f64, z: f64) -> bool {
        use nalgebra::Point3;
        mesh.first_hit(Point3::new(x, 3.7, z), Point3::new(x, 30.0, z)).is_none()
    }

    #[test]
    fn analytic_webs_are_as_thick_as_their_numbers_say_and_notches_close_at_the_fold() {
        use nalgebra::Point3;
        for preset in ["cognifly", "cognifly-mini", "cognifly-v8"] {
            let frame = Frame::resolve(&FrameFile::load(preset).expect("is a preset")).expect("resolves");
            let coupon = Coupon::new(&frame).expect("is made");
            let hinges = &coupon.hinges;
            for (piece, thickness_mm) in coupon.pieces[2..5].iter().zip(hinges.thicknesses_mm) {
                let solid = MeshSolid::from_mesh(&piece.mesh).expect("is closed");
                let height_mm = |x: f64| {
                    let hit = solid.first_hit(Point3::new(x, 0.003, 30.0), Point3::new(x, 0.003, -1.0));
                    hit.map_or(0.0, |hit| hit.at.z)
                };
                assert!((height_mm(0.001) - thickness_mm).abs() < 0.01, "{} {}", piece.name, height_mm(0.001));
                // Each face of the notch leans by half of the fold.
                let lean = Angle::deg(0.5 * hinges.fold_deg).tan();
                assert!((height_mm(0.8) - thickness_mm - 0.8 / lean).abs() < 0.01, "{} {}", piece.name, height_mm(0.8));
                assert_eq!(piece.name, format!("hinge-{:02.0}", 10.0 * thickness_mm));
            }
        }
    }

    #[test]
    fn analytic_pieces_lie_on_the_bed_apart_from_each_other() {
        let frame = Frame::resolve(&FrameFile::load("cognifly").expect("is a preset")).expect("resolves");
        let coupon = Coupon::new(&frame).expect("is made");
        let mut printer = frame.printer.clone();
        for (bed, size_mm) in [(Bed::Rectangular, [180.0, 180.0]), (Bed::Round, [180.0, 180.0])] {
            (printer.bed, printer.size_mm) = (bed, size_mm);
            let plates = coupon.plates(&printer).plates;
            assert_eq!(plates.iter().map(|plate| plate.placed.len()).collect::<Vec<_>>(), [5, 1]);
            let reach_mm = |x: f64, y: f64| if bed == Bed::Round { libm::hypot(x, y) } else { (x - 90.0).abs().max((y - 90.0).abs()) };
            for plate in &plates {
                let mut behind_mm = f64::NEG_INFINITY;
                for (piece, pose) in &plate.placed {
                    let [low, high] = piece.mesh.bounds_mm().map(|corner| pose * nalgebra::Point3::from(corner));
                    assert!(low.y >= behind_mm && low.z.abs() < 1e-6, "{} {low}", piece.name);
                    assert!(reach_mm(low.x, low.y).max(reach_mm(high.x, high.y)) <= 90.0, "{} {low} {high}", piece.name);
                    behind_mm = high.y + 7.9;
                }
            }
        }
    }

    #[test]
    fn planted_pieces_on_a_small_bed_take_more_plates_and_those_without_room_are_named() {
        let frame = Frame::load("cognifly").expect("is a preset").0;
        let coupon = Coupon::new(&frame).expect("is made");
        let all: Vec<&str> = coupon.pieces.iter().map(|piece| piece.name.as_str()).collect();
        for (size_mm, plates, no_room) in
            [([180.0; 2], 2, vec![]), ([110.0, 40.0], 3, vec![]), ([60.0; 2], 2, vec!["gauge"]), ([8.0; 2], 0, all)]
        {
            let printer = Printer { size_mm, ..frame.printer.clone() };
            let laid = coupon.plates(&printer);
            assert_eq!(laid.no_room.iter().map(|piece| piece.name.as_str()).collect::<Vec<_>>(), no_room, "{size_mm:?}");
            assert_eq!(laid.plates.len(), plates, "{size_mm:?}");
            let mut placed: Vec<&str> = laid.plates.iter().flat_map(|plate| &plate.placed).map(|(piece, _)| piece.name.as_str()).collect();
            placed.extend(no_room);
            placed.sort_unstable();
            let mut wanted: Vec<&str> = coupon.pieces.iter().map(|piece| piece.name.as_str()).collect();
            wanted.sort_unstable();
            assert_eq!(placed, wanted, "{size_mm:?}");
            for (piece, pose) in laid.plates.iter().flat_map(|plate| &plate.placed) {
                let [low, high] = piece.mesh.bounds_mm().map(|corner| pose * nalgebra::Point3::from(corner));
                assert!((0..2).all(|axis| low[axis] >= 3.0 && high[axis] <= size_mm[axis] - 3.0), "{} {low} {high}", piece.name);
            }
        }
    }

    #[test]
    fn planted_pieces_lie_where_the_printer_keeps_nothing_clear() {
        let mut frame = Frame::load("cognifly").expect("is a preset").0;
        frame.printer.size_mm = [250.0, 210.0];
        let coupon = Coupon::new(&frame).expect("is made");
        let keeping = |kept: [f64; 4]| Printer { kept_clear_mm: Some(vec![kept]), ..frame.printer.clone() };
        for kept in [[0.0, 0.0, 30.0, 30.0], [100.0, 80.0, 130.0, 120.0], [0.0, 0.0, 140.0, 210.0]] {
            let printer = keeping(kept);
            let plates = coupon.plates(&printer).plates;
            assert_eq!(plates.iter().map(|plate| plate.placed.len()).collect::<Vec<_>>(), [5, 1], "{kept:?}");
            for (piece, pose) in plates.iter().flat_map(|plate| &plate.placed) {
                let [low, high] = piece.mesh.bounds_mm().map(|corner| pose * nalgebra::Point3::from(corner));
                let is_clear = (0..2).any(|axis| high[axis] <= kept[axis] || low[axis] >= kept[axis + 2]);
                let is_on_bed = (0..2).all(|axis| low[axis] >= 3.0 && high[axis] <= printer.size_mm[axis] - 3.0);
                assert!(is_clear && is_on_bed, "{} at {low} to {high}, clear {kept:?}", piece.name);
            }
        }
        assert!(coupon.plates(&keeping([0.0, 0.0, 250.0, 210.0])).plates.is_empty());
    }

    #[test]
    fn regress_wide_brims_of_pieces_do_not_meet() {
        let mut frame = Frame::load("cognifly").expect("is a preset").0;
        for (brim_mm, gap_mm) in [(None, 8.0), (Some(3.0), 8.0), (Some(6.0), 12.0)] {
            frame.flexible.material.brim_mm = brim_mm;
            let coupon = Coupon::new(&frame).expect("is made");
            let plates = coupon.plates(&frame.printer).plates;
            let sides: Vec<[f64; 2]> = plates[0]
                .placed
                .iter()
                .map(|(piece, pose)| piece.mesh.bounds_mm().map(|corner| (pose * nalgebra::Point3::from(corner)).y))
                .collect();
            for pair in sides.windows(2) {
                assert!((pair[1][0] - pair[0][1] - gap_mm).abs() < 1e-6, "{brim_mm:?}: {sides:?}");
            }
        }
        // Brims that leave no room at the bed's edge.
        let mut printer = frame.printer.clone();
        let coupon = Coupon::new(&frame).expect("is made");
        let deep_mm = |gap_mm: f64| coupon.pieces[..5].iter().map(|piece| piece.mesh.size_mm()[1] + gap_mm).sum::<f64>() - gap_mm;
        for (more_mm, placed) in [(0.1, 5), (-0.1, 4)] {
            printer.size_mm = [200.0, deep_mm(12.0) + 18.0 + more_mm];
            let plates = coupon.plates(&printer).plates;
            let flexible = plates.iter().find(|plate| plate.material.name == frame.flexible.name);
            assert_eq!(flexible.map_or(0, |plate| plate.placed.len()), placed, "{more_mm}");
        }
    }

    /// As the parts are, which the clearances that are read are for.
    #[test]
    fn analytic_first_layers_are_drawn_in_as_those_of_parts() {
        let mut frame = Frame::load("cognifly").expect("is a preset").0;
        let width_mm = |frame: &Frame, z_mm: f64| {
            let coupon = Coupon::new(frame).expect("is made");
            let bar = coupon.pieces.iter().find(|piece| piece.name == "bar").expect("is one");
            let [low, high] = MeshSolid::from_mesh(&bar.mesh).expect("is closed").slice(z_mm).bounds_mm();
            high[0] - low[0]
        };
        // In the first layer and above it.
        let plain_mm = [0.1, 0.5].map(|z_mm| width_mm(&frame, z_mm));
        frame.printer.elephant_foot_mm = Some(0.2);
        let drawn_mm = [0.1, 0.5].map(|z_mm| width_mm(&frame, z_mm));
        let by_mm = [plain_mm[0] - drawn_mm[0], plain_mm[1] - drawn_mm[1]];
        assert!((by_mm[0] - 0.4).abs() < 0.01 && by_mm[1].abs() < 0.01, "{plain_mm:?} and {drawn_mm:?}");
    }

    #[test]
    fn analytic_bores_are_as_wide_as_their_numbers_say() {
        // A rod between two tenths, too.
        for (preset, rod_mm) in [("cognifly", 3.0), ("cognifly-mini", 3.0), ("cognifly-v8", 3.0), ("cognifly", 2.95)] {
            let mut file = FrameFile::load(preset).expect("is a preset");
            file.set_number("rods.rod_diameter_mm", rod_mm);
            let frame = Frame::resolve(&file).expect("resolves");
            let coupon = Coupon::new(&frame).expect("is made");
            let solid = MeshSolid::from_mesh(&coupon.pieces[0].mesh).expect("is closed");
            let mut x = 0.0;
            for number in gauge::bores_tenths(&frame) {
                let bore_mm = 0.1 * f64::from(number);
                let width = (bore_mm + 0.9).max(5.2);
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
