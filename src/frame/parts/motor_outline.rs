//! Outline of the motor mount seen from above: a disc and two arms with concave waists between them.

use nalgebra::{Point2, Point3, Vector3};

use super::place::{SINK_MM, along_y, plate, with_mirror};
use crate::solid::{Contour, Feature, Profile, Segment};

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

    /// Solid with the upper rim rounded; the arms have half the width `arm_mm`.
    pub fn rounded(&self, arm_mm: f64, round_mm: f64, z_mm: [f64; 2], length_mm: f64) -> Feature {
        let [low, high] = z_mm;
        let disc = [([0.0, low], 0.0), ([self.plate_mm, low], 0.0), ([self.plate_mm, high], round_mm), ([0.0, high], 0.0)];
        let disc = Feature::revolve(Profile::new(Contour::rounded_polygon(&disc)));
        // Arms and blends end a little lower than the disc: their tops must not coincide.
        let arm = along_y(arm_section(arm_mm, round_mm, [low, high - 0.004]), -length_mm, length_mm);
        let blend = four_times(plate(self.blend(0.0), low, high - 0.008));
        let centre = self.waist_centre();
        let waist = Feature::revolve(Profile::new(self.flared_waist(round_mm, z_mm))).at(centre.x, centre.y, 0.0);
        Feature::union([disc, Feature::union([blend, arm]).minus([four_times(waist)])])
    }

    /// Solid with square edges, ended where the waist is narrowest.
    pub fn plain(&self, low_mm: f64, high_mm: f64) -> Feature {
        let centre = self.waist_centre();
        let (above, half) = (high_mm + 1.0, self.waist_mm - 0.5 * SINK_MM);
        let at = |z: f64| Point3::new(centre.x, centre.y, z);
        let disc = Feature::cylinder_between(Point3::new(0.0, 0.0, low_mm), Point3::new(0.0, 0.0, above), self.plate_mm);
        let arm = Feature::cuboid_between([-half, -centre.y - 1.0, low_mm], [half, centre.y + 1.0, above]);
        let blend = plate(self.blend(0.5), low_mm, above).minus([Feature::cylinder_between(
            at(low_mm - 1.0),
            at(above + 1.0),
            self.waist_round_mm,
        )]);
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
