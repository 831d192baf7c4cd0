//! The knee's window: a slot for the fork's bar whose rims are rounded on both sides.

use nalgebra::Point2;

use super::outline::{Pen, along_x, upright};
use crate::solid::{Contour, Feature, Profile};
use crate::units::Angle;

/// The window.
#[derive(Clone, Debug, PartialEq)]
pub struct KneeWindow {
    /// From the knee's node to the window's centre, outward, mm.
    pub centre_mm: f64,
    /// Size along the frame's diagonal, mm.
    pub size_x_mm: f64,
    /// Height, mm.
    pub size_z_mm: f64,
    /// Rounding of its corners, mm.
    pub round_mm: f64,
    /// Radius of its rims, mm.
    pub flare_mm: f64,
}

/// How far round a rim has gone where it meets the knee's sides, degrees: short of a quarter turn, it crosses them at an angle.
const AT_SIDE_DEG: f64 = 75.0;

/// How far round its cutter goes, degrees: it grows by nine tenths of the rim's radius, and stays under the plate's face.
const CUTTER_END_DEG: f64 = 84.0;

/// What of a wall stays flat between its rounded corners, on each side of its middle, mm.
const LEAST_FLAT_MM: f64 = 0.05;

impl KneeWindow {
    /// Inner wall, mm from the node.
    pub fn back_mm(&self) -> f64 {
        self.centre_mm - 0.5 * self.size_x_mm
    }

    /// Outer wall, mm from the node.
    pub fn front_mm(&self) -> f64 {
        self.centre_mm + 0.5 * self.size_x_mm
    }

    /// Half of the height, mm.
    pub fn half_z_mm(&self) -> f64 {
        0.5 * self.size_z_mm
    }

    /// The slot with its rims, which end in the knee's sides at ± `half_width_mm`; it reaches `length_mm` to each side.
    pub fn cutter(&self, half_width_mm: f64, length_mm: f64) -> Feature {
        let rim = Rim::new(self.flare_mm.min(0.9 * half_width_mm), half_width_mm, length_mm);
        let round = self.round_mm.min(0.5 * self.size_x_mm.min(self.size_z_mm) - LEAST_FLAT_MM);
        let (up, back, front) = (self.half_z_mm() - round, self.back_mm() + round, self.front_mm() - round);
        let corner = Feature::revolve(Profile::new(rim.beside_axis(round))).turned_x(Angle::deg(-90.0));
        let corners = [(back, up), (back, -up), (front, up), (front, -up)].map(|(x, z)| corner.clone().at(x, 0.0, z));
        let [rib_and_plate, above_and_below] = [
            upright(Profile::new(rim.across([self.back_mm(), self.front_mm()])), [-up, up]),
            along_x(Profile::new(rim.along([-self.half_z_mm(), self.half_z_mm()])), [back, front]),
        ];
        Feature::union(corners.into_iter().chain([rib_and_plate, above_and_below]))
    }
}

/// How the window grows along y: rounded between its walls and the knee's sides.
struct Rim {
    radius_mm: f64,
    /// Where the rounding begins and ends, on each side, mm.
    begins_mm: f64,
    ends_mm: f64,
    /// What the window has grown by there, mm.
    grown_mm: f64,
    length_mm: f64,
}

impl Rim {
    fn new(radius_mm: f64, half_width_mm: f64, length_mm: f64) -> Self {
        let [at_side, end] = [AT_SIDE_DEG, CUTTER_END_DEG].map(Angle::deg);
        let begins_mm = half_width_mm - radius_mm * at_side.sin();
        Self { radius_mm, begins_mm, ends_mm: begins_mm + radius_mm * end.sin(), grown_mm: radius_mm * (1.0 - end.cos()), length_mm }
    }

    /// Draws one wall at a place across, from -y to y or back, growing outwards; `at` makes points of places across and along y.
    fn wall(&self, pen: &mut Pen, across_mm: f64, outwards: f64, at: &dyn Fn(f64, f64) -> Point2<f64>, counter_clockwise: bool) {
        let grown = across_mm + outwards * self.grown_mm;
        let centre = across_mm + outwards * self.radius_mm;
        let [from, to] = [-outwards, outwards];
        pen.line(at(grown, from * self.length_mm));
        pen.arc(at(centre, from * self.begins_mm), at(grown, from * self.ends_mm), at(across_mm, from * self.begins_mm), counter_clockwise);
        pen.arc(at(centre, to * self.begins_mm), at(across_mm, to * self.begins_mm), at(grown, to * self.ends_mm), counter_clockwise);
        pen.line(at(grown, to * self.length_mm));
    }

    /// Between two walls, in (across, y).
    fn across(&self, [low, high]: [f64; 2]) -> Contour {
        self.between([low, high], &Point2::new, false)
    }

    /// Between two walls, in (y, across).
    fn along(&self, [low, high]: [f64; 2]) -> Contour {
        self.between([low, high], &|across, y| Point2::new(y, across), true)
    }

    fn between(&self, [low, high]: [f64; 2], at: &dyn Fn(f64, f64) -> Point2<f64>, counter_clockwise: bool) -> Contour {
        let mut pen = Pen::new(at(low - self.grown_mm, -self.length_mm));
        self.wall(&mut pen, high, 1.0, at, counter_clockwise);
        self.wall(&mut pen, low, -1.0, at, counter_clockwise);
        pen.close()
    }

    /// From an axis along y out to a wall around it, in (across, y).
    fn beside_axis(&self, radius_mm: f64) -> Contour {
        let mut pen = Pen::new(Point2::new(0.0, -self.length_mm));
        self.wall(&mut pen, radius_mm, 1.0, &Point2::new, false);
        pen.line(Point2::new(0.0, self.length_mm));
        pen.close()
    }
}
