//! The carrier of the on-board computer: a flat frame on the hub's four tie holes. One profile, one extrusion.
//!
//! Frame of reference: the hub's axes, z = 0 at its lower face, which lies on the hub's top. The board is long along y.

use nalgebra::{Point2, UnitQuaternion, Vector2};

use super::outline::{Line, Pen};
use super::record::{Fold, MaterialClass, PrintedPart, Seat, Wall};
use crate::frame::skeleton::centre::Centre;
use crate::params::{Frame, PartName};
use crate::solid::{Contour, Feature, Profile};

/// The record of the part.
pub static PART: PrintedPart = PrintedPart {
    name: PartName::PiCarrier,
    feature: |frame, _, centre| feature(frame, centre),
    material: MaterialClass::Rigid,
    seat: Seat::Centre(Centre::carrier_pose),
    fold: Fold::Stands,
    print_turn,
    // Without a computer the ties that hold the bracket run over the hub.
    needed: |frame| frame.bought.contains_key("computer"),
    walls: &[Wall::anywhere(&["pi_carrier.carrier_pad_radius_mm", "hub.tie_ring_radius_mm", "pi_carrier.carrier_tie_hole_diameter_mm"])],
};

/// The carrier of a frame. An impossible one (see [`profile`]) is empty.
pub fn feature(frame: &Frame, centre: &Centre) -> Feature {
    profile(frame, centre).map_or_else(|| Feature::union([]), |profile| Feature::extrude(profile, frame.pi_carrier.carrier_thickness_mm))
}

/// Outline and holes in (x, y); `None` where the board's holes lie so that no bars reach them: inside the four
/// bars between the tie holes, or further out across than the tie rings.
pub fn profile(frame: &Frame, centre: &Centre) -> Option<Profile> {
    PiCarrier { frame, centre }.profile()
}

/// Printed as it lies.
pub fn print_turn() -> UnitQuaternion<f64> {
    UnitQuaternion::identity()
}

struct PiCarrier<'a> {
    frame: &'a Frame,
    centre: &'a Centre,
}

/// Radius of the circle that fits into the smallest window, mm.
const LEAST_WINDOW_MM: f64 = 0.3;

/// The lines and points of one quarter, in (along, across).
struct Quarter {
    /// Tie ring on the long axis, tie ring on the short axis, pad.
    front: Point2<f64>,
    side: Point2<f64>,
    pad: Point2<f64>,
    /// Direction of the strut from the front ring to the pad, and its middle line.
    strut_way: Vector2<f64>,
    strut: Line,
    /// Middle line of the bar between the rings, and of the rail from the pad to the bar.
    bar: Line,
    rail: Line,
}

impl PiCarrier<'_> {
    fn quarter(&self) -> Quarter {
        let (front, side) = (Point2::new(self.centre.tie_front_mm, 0.0), Point2::new(0.0, self.centre.tie_side_mm));
        let pad = Point2::new(0.5 * self.frame.pi_carrier.pi_pattern_along_mm, 0.5 * self.frame.pi_carrier.pi_pattern_across_mm);
        let strut_way = (pad - front).normalize();
        let right = Vector2::new(strut_way.y, -strut_way.x);
        // Across the bar, outward; at 45° in a square frame.
        let diagonal = Vector2::new(1.0, front.x / side.y).normalize();
        Quarter {
            front,
            side,
            pad,
            strut_way,
            strut: Line { normal: right, offset: right.dot(&front.coords) },
            bar: Line { normal: diagonal, offset: diagonal.dot(&front.coords) },
            rail: Line { normal: Vector2::y(), offset: pad.y },
        }
    }

    /// Outline and holes in (x, y).
    fn profile(&self) -> Option<Profile> {
        let quarter = self.quarter();
        let mut profile = Profile::new(self.outer(&quarter)?).with_hole(self.middle(&quarter)?);
        for (a, b) in [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)] {
            profile.holes.extend(self.window(&quarter)?.map(|corners| self.triangle(&corners, a, b)));
            profile.holes.push(Contour::bore([b * quarter.pad.y, a * quarter.pad.x], 0.5 * self.frame.pi_carrier.pi_hole_diameter_mm));
        }
        let (before, beside) = (quarter.front.x, quarter.side.y);
        let ties = [[beside, 0.0], [0.0, before], [-beside, 0.0], [0.0, -before]];
        Some(profile.with_holes(ties.map(|at| Contour::bore(at, 0.5 * self.frame.pi_carrier.carrier_tie_hole_diameter_mm))))
    }

    /// The outline, quarter by quarter; mirrored quarters are drawn backwards.
    fn outer(&self, q: &Quarter) -> Option<Contour> {
        let steps = self.outer_steps(q)?;
        let first = q.front + Vector2::new(self.frame.hub.tie_ring_radius_mm, 0.0);
        let mut pen = Pen::new(seen(first, 1.0, 1.0));
        for (a, b) in [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)] {
            // (along, across) -> (y, x) is a reflection, so a positive quarter turns the other way round.
            let forward = a * b > 0.0;
            let ordered: Vec<_> = if forward { steps.clone() } else { steps.iter().rev().cloned().collect() };
            for step in ordered {
                match step {
                    Step::Corner(p) => {
                        pen.line(seen(p, a, b));
                    }
                    Step::Arc { centre, from, to, left } => {
                        let (from, to) = if forward { (from, to) } else { (to, from) };
                        pen.arc(seen(centre, a, b), seen(from, a, b), seen(to, a, b), !left);
                    }
                }
            }
        }
        Some(pen.close())
    }

    /// One quarter of the outline from the long axis to the short one.
    fn outer_steps(&self, q: &Quarter) -> Option<Vec<Step>> {
        let (ring, pad, w, f) = (
            self.frame.hub.tie_ring_radius_mm,
            self.frame.pi_carrier.carrier_pad_radius_mm,
            0.5 * self.frame.pi_carrier.carrier_strut_width_mm,
            self.frame.pi_carrier.carrier_fillet_mm,
        );
        let reach = ((ring + f).powi(2) - (w + f).powi(2)).max(0.0).sqrt();
        let fillet = q.front + q.strut_way * reach + q.strut.normal * (w + f);
        let leave = q.front + (fillet - q.front) * (ring / (ring + f));
        let [enter_pad, _] = q.strut.shifted(w).cross(q.pad, pad)?;
        let [_, leave_pad] = q.rail.shifted(w).cross(q.pad, pad)?;
        let edge = q.bar.shifted(0.5 * self.frame.pi_carrier.carrier_bar_width_mm);
        let [_, on_ring] = edge.cross(q.side, ring)?;
        let on_ring = if on_ring.x > 0.0 { on_ring } else { edge.cross(q.side, ring)?[0] };
        let inner = q.rail.shifted(w).meet(edge)?;
        let top = q.side + Vector2::new(0.0, ring);
        let rise = q.pad.y + w - q.side.y;
        if leave.y < 0.2
            || rise.abs() > ring - 0.3 && rise > 0.0
            || q.pad.x + q.pad.y * q.front.x / q.side.y < q.front.x + self.frame.pi_carrier.carrier_bar_width_mm + pad
        {
            return None;
        }
        let mut steps = vec![
            Step::Arc { centre: q.front, from: q.front + Vector2::new(ring, 0.0), to: leave, left: true },
            Step::Arc { centre: fillet, from: leave, to: fillet - q.strut.normal * f, left: false },
            Step::Arc { centre: q.pad, from: enter_pad, to: leave_pad, left: true },
        ];
        if (inner - q.side).norm() > ring + 0.2 && inner.x > on_ring.x {
            steps.push(Step::Corner(inner));
            steps.push(Step::Arc { centre: q.side, from: on_ring, to: top, left: true });
        } else {
            let from = Point2::new((ring * ring - rise * rise).max(0.0).sqrt(), q.pad.y + w);
            steps.push(Step::Arc { centre: q.side, from, to: top, left: true });
        }
        Some(steps)
    }

    /// The corners of the window between rail, bar and strut, the rounded one last; no window where there is no room for one.
    fn window(&self, q: &Quarter) -> Option<Option<[Point2<f64>; 3]>> {
        let (strut, rail) = (
            q.strut.shifted(-0.5 * self.frame.pi_carrier.carrier_strut_width_mm),
            q.rail.shifted(-0.5 * self.frame.pi_carrier.carrier_strut_width_mm),
        );
        let bar = q.bar.shifted(0.5 * self.frame.pi_carrier.carrier_bar_width_mm);
        let corners = [strut.meet(rail)?, rail.meet(bar)?, strut.meet(bar)?];
        let [pad, ring, tip] = corners;
        let [one, two] = [pad - tip, ring - tip];
        let twice_area_mm2 = one.perp(&two);
        let around_mm = one.norm() + two.norm() + (pad - ring).norm();
        let fillet_mm = self.frame.pi_carrier.carrier_fillet_mm / libm::tan(0.5 * one.angle(&two)).max(1e-9);
        let has_room = twice_area_mm2 > LEAST_WINDOW_MM * around_mm && fillet_mm < one.norm().min(two.norm());
        Some(has_room.then_some(corners))
    }

    /// The window in one of the quarters.
    fn triangle(&self, corners: &[Point2<f64>; 3], a: f64, b: f64) -> Contour {
        let radii = [0.0, 0.0, self.frame.pi_carrier.carrier_fillet_mm];
        let corner = |(p, r): (&Point2<f64>, f64)| {
            let p = seen(*p, a, b);
            ([p.x, p.y], r)
        };
        Contour::rounded_polygon(&corners.iter().zip(radii).map(corner).collect::<Vec<_>>())
    }

    /// The window inside the four bars; the tie rings bulge into it.
    fn middle(&self, q: &Quarter) -> Option<Contour> {
        let inner = q.bar.shifted(-0.5 * self.frame.pi_carrier.carrier_bar_width_mm);
        let ring = self.frame.hub.tie_ring_radius_mm;
        let ([a, b], [c, d]) = (inner.cross(q.front, ring)?, inner.cross(q.side, ring)?);
        let (front, side) = (if a.y > b.y { a } else { b }, if c.x > d.x { c } else { d });
        let mut pen = Pen::new(seen(side, -1.0, 1.0));
        for end in [1.0, -1.0] {
            pen.arc(seen(q.side, end, end), seen(side, -end, end), seen(side, end, end), false);
            // In a long frame two bars may meet before they reach the ring.
            if front.y > 0.0 {
                pen.arc(seen(q.front, end, end), seen(front, end, end), seen(front, end, -end), false);
            } else {
                pen.line(seen(Point2::new(inner.offset / inner.normal.x, 0.0), end, end));
            }
        }
        Some(pen.close())
    }
}

/// A step of the outline in (along, across); `left` arcs turn counter-clockwise there.
#[derive(Clone)]
enum Step {
    Corner(Point2<f64>),
    Arc { centre: Point2<f64>, from: Point2<f64>, to: Point2<f64>, left: bool },
}

/// From (along, across) to (x, y), mirrored into one of the quarters.
fn seen(p: Point2<f64>, along: f64, across: f64) -> Point2<f64> {
    Point2::new(across * p.y, along * p.x)
}

#[cfg(test)]
mod tests {
    use super::super::gauges::{Gauged, v8};
    use super::*;
    use crate::solid::Brep;

    #[test]
    fn measured_carrier_is_like_the_real_one() {
        let (frame, centre) = v8();
        let carrier = Gauged::new(&feature(&frame, &centre));
        carrier.like_the_real_one([57.824, 63.0, 2.0], 1651.2, 2.0, 13);
        for (x, y) in [(11.5, 29.0), (-11.5, 29.0), (-11.5, -29.0), (11.5, -29.0)] {
            carrier.hole([x, y, -1.0], [x, y, 3.0], 2.75);
        }
        for (x, y) in [(25.41, 0.0), (0.0, 25.41), (-25.41, 0.0), (0.0, -25.41)] {
            carrier.hole([x, y, -1.0], [x, y, 3.0], 4.0);
        }
    }

    #[test]
    fn analytic_carrier_is_exact_in_the_other_kernel_too() {
        let (frame, centre) = v8();
        let exact = profile(&frame, &centre).map(|p| p.area_mm2() * 2.0).expect("the board fits");
        let brep = Brep::build(&feature(&frame, &centre)).expect("one extrusion");
        let mesh = Gauged::new(&feature(&frame, &centre)).0.volume_mm3();
        assert!(brep.is_closed());
        assert!((brep.volume_mm3() / exact - 1.0).abs() < 1e-3, "{} {exact}", brep.volume_mm3());
        assert!((mesh / exact - 1.0).abs() < 2e-3, "{mesh} {exact}");
    }

    #[test]
    fn analytic_wide_board_fits_and_a_small_one_is_declined() {
        let (mut frame, centre) = v8();
        frame.pi_carrier.pi_pattern_across_mm = 49.0;
        assert!(Brep::build(&feature(&frame, &centre)).is_some());
        let mesh = Gauged::new(&feature(&frame, &centre)).0.to_mesh();
        assert_eq!(crate::solid::gate::pass(&mesh).map(|seen| seen.euler), Ok(-24));
        (frame.pi_carrier.pi_pattern_across_mm, frame.pi_carrier.pi_pattern_along_mm) = (20.0, 20.0);
        assert_eq!(profile(&frame, &centre), None);
    }
}
