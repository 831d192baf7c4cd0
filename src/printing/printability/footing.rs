//! What a part stands on while it is printed.

use nalgebra::Point2;

use super::process::Process;
use crate::frame::assembly::Printed;
use crate::solid::{Mesh, MeshSolid, Region};
use crate::units::Angle;

/// What is narrower than this share of a line is in no slice: chosen. PrusaSlicer leaves a wall of 0.20 mm out of the first layer with lines of
/// 0.45 mm, and lays one of 0.45 mm.
const NARROWEST: f64 = 0.5;

/// The first layer and how the part stands on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Footing {
    /// Area of the first layer, mm², without what is narrower than half of a line, as a slicer leaves that out, and without the brim: that is one
    /// layer high, and does not hold what is narrow above it.
    pub contact_mm2: f64,
    /// Tilt at which the centre of mass leaves the smallest convex figure around the first layer, its brim and the support; negative when it is not over it.
    pub tip: Angle,
    /// Height over the smallest width of that figure.
    pub slender: f64,
}

impl Footing {
    /// That of a part, and of the support under some places in plan.
    pub fn of(part: &Printed, process: &Process, supported: &[&Region]) -> Self {
        Self::measured(&part.printed(), &part.mesh, process, supported)
    }

    pub(super) fn measured(solid: &MeshSolid, mesh: &Mesh, process: &Process, supported: &[&Region]) -> Self {
        let contact = wide_enough(&solid.slice(0.5 * process.layer_mm), NARROWEST * process.line_mm);
        let base = supported.iter().fold(contact.hull().grown(process.brim_mm), |base, place| base.union(place));
        let hull: Vec<Point2<f64>> = base.hull().contours().concat().into_iter().map(Point2::from).collect();
        let (centre, _) = mesh.moments();
        let edges: Vec<(Point2<f64>, Point2<f64>)> =
            (0..hull.len()).map(|i| (hull[i], hull[(i + 1) % hull.len()])).filter(|(a, b)| (b - a).norm() > 1e-6).collect();
        // A convex figure, counter-clockwise: what is inside lies to the left of every edge.
        let left = |(a, b): &(Point2<f64>, Point2<f64>), p: Point2<f64>| (b - a).perp(&(p - a)) / (b - a).norm();
        let inside = edges.iter().map(|edge| left(edge, centre.xy())).fold(f64::INFINITY, f64::min);
        let across = |edge| hull.iter().map(|p| left(edge, *p)).fold(0.0, f64::max);
        let width = edges.iter().map(across).fold(f64::INFINITY, f64::min);
        let inside = if inside.is_finite() { inside } else { -1.0 };
        let tip = Angle::rad(libm::atan2(inside, centre.z));
        Self { contact_mm2: contact.area_mm2(), tip, slender: mesh.bounds_mm()[1][2] / width }
    }
}

/// What of a figure is at least so wide; corners of a right angle and blunter ones stay whole.
fn wide_enough(figure: &Region, width_mm: f64) -> Region {
    figure.grown(-0.5 * width_mm).grown(0.75 * width_mm).intersection(figure)
}
