//! Outline of the motor mount seen from above: a disc and two arms with concave waists between them.

use std::f64::consts::PI;

use nalgebra::{Point2, Vector3};

use super::place::{SINK_MM, along_y, plate, with_mirror};
use crate::solid::{Contour, Feature, Profile, Segment};
use crate::units::Angle;

/// The outline; all lengths from the middle.
pub struct Outline {
    /// Radius of the disc, mm.
    pub plate_mm: f64,
    /// Half of the narrowest width, mm.
    pub waist_mm: f64,
    /// Radius of the waist, mm.
    pub waist_round_mm: f64,
}

/// Section, in (z, x), of an arm whose upper edges are rounded.
pub fn arm_section(half_mm: f64, round_mm: f64, z_mm: [f64; 2]) -> Contour {
    Contour::rounded_polygon(&[
        ([z_mm[0], half_mm], 0.0),
        ([z_mm[0], -half_mm], 0.0),
        ([z_mm[1], -half_mm], round_mm),
        ([z_mm[1], half_mm], round_mm),
    ])
}

impl Outline {
    /// Centre of the waist's circle: it touches the disc, and is `waist_mm` from the middle line.
    fn waist_centre(&self) -> Point2<f64> {
        let x = self.waist_mm + self.waist_round_mm;
        let reach = self.plate_mm + self.waist_round_mm;
        Point2::new(x, libm::sqrt(reach * reach - x * x))
    }

    /// Angle, seen from the disc's middle, of the waist's centre, and so of where the two circles touch, rad.
    fn touch_rad(&self) -> f64 {
        let centre = self.waist_centre();
        libm::atan2(centre.y, centre.x)
    }

    /// What is round about the disc's axis, with a corner of its polygon wherever a waist touches it.
    fn around_disc(&self, section: Contour) -> Feature {
        let touch = self.touch_rad();
        Feature::revolve_with_corners(Profile::new(section), [touch, PI - touch, PI + touch, -touch].map(Angle::rad))
    }

    /// What is round about the waist's axis, with corners of its polygon where it touches the disc and where it touches the arm.
    fn around_waist(&self, section: Contour) -> Feature {
        let centre = self.waist_centre();
        let touches = [PI, PI + self.touch_rad()].map(Angle::rad);
        Feature::revolve_with_corners(Profile::new(section), touches).at(centre.x, centre.y, 0.0)
    }

    /// Solid with the upper rim rounded. Arms, blends and disc end at the same height, and go over into each other where they touch: between
    /// faces a hundredth apart the mesh would have strips.
    pub fn rounded(&self, round_mm: f64, z_mm: [f64; 2], length_mm: f64) -> Feature {
        let [low, high] = z_mm;
        let disc = [([0.0, low], 0.0), ([self.plate_mm, low], 0.0), ([self.plate_mm, high], round_mm), ([0.0, high], 0.0)];
        let disc = self.around_disc(Contour::rounded_polygon(&disc));
        let arm = along_y(arm_section(self.waist_mm, round_mm, z_mm), -length_mm, length_mm);
        let blend = four_times(plate(self.blend(0.0), low, high));
        let waist = self.around_waist(self.flared_waist(round_mm, z_mm));
        Feature::union([disc, Feature::union([blend, arm]).minus([four_times(waist)])])
    }

    /// Solid with square edges, ended where the waist is narrowest.
    pub fn plain(&self, low_mm: f64, high_mm: f64) -> Feature {
        let centre = self.waist_centre();
        let (above, half) = (high_mm + 1.0, self.waist_mm - 0.5 * SINK_MM);
        let upright = |r: f64, low: f64, high: f64| Contour::polygon(&[[0.0, low], [r, low], [r, high], [0.0, high]]);
        let disc = self.around_disc(upright(self.plate_mm, low_mm, above));
        let arm = Feature::cuboid_between([-half, -centre.y - 1.0, low_mm], [half, centre.y + 1.0, above]);
        let waist = self.around_waist(upright(self.waist_round_mm, low_mm - 1.0, above + 1.0));
        let blend = plate(self.blend(0.5), low_mm, above).minus([waist]);
        let (reach, end) = (self.plate_mm + 9.0, centre.y - 2.0 * SINK_MM);
        let ends = Feature::cuboid_between([-reach, -end, low_mm - 1.0], [reach, end, high_mm]);
        Feature::intersection([Feature::union([disc, arm, four_times(blend)]), ends])
    }

    /// Area between disc, arm and the waist's centre, for x > 0 and y > 0, longer by `beyond_mm`.
    fn blend(&self, beyond_mm: f64) -> Contour {
        let centre = self.waist_centre();
        let touch = centre.coords * (self.plate_mm / (self.plate_mm + self.waist_round_mm));
        let (y, inside) = (centre.y + beyond_mm, -0.3);
        let mut points: Vec<[f64; 2]> = vec![(touch * -0.2).into(), (touch * 1.001).into(), centre.coords.into()];
        if beyond_mm > 0.0 {
            points.push([centre.x, y]);
        }
        points.push([inside, y]);
        Contour::polygon(&points)
    }

    /// Half section of the waist's cutter: a cylinder that opens towards the rim.
    fn flared_waist(&self, round_mm: f64, z_mm: [f64; 2]) -> Contour {
        let (r, [low, high]) = (self.waist_round_mm, z_mm);
        let line = |x: f64, y: f64| Segment::Line { to: Point2::new(x, y) };
        let start = Point2::new(0.0, low - 1.0);
        let centre = Point2::new(r + round_mm, high - round_mm);
        let mut segments = vec![line(r, low - 1.0), line(r, high - round_mm)];
        if round_mm > 0.0 {
            segments.push(Segment::Arc { to: Point2::new(r + round_mm, high), centre, counter_clockwise: false });
        }
        segments.extend([line(r + round_mm, high + 1.0), line(0.0, high + 1.0), Segment::Line { to: start }]);
        Contour::Path { start, segments }
    }
}

/// The feature in all four quadrants.
fn four_times(feature: Feature) -> Feature {
    with_mirror(with_mirror(feature, Vector3::x()), Vector3::y())
}
