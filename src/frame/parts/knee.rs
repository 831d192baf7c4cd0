//! The knee: two struts meet on the frame's diagonal, and the fork's bar passes through its window.
//!
//! Frame: origin where the struts' axes cross, x outward along the diagonal, z up. Printed on its outer plate.

use nalgebra::{Point3, UnitQuaternion, Vector3};

pub use super::knee_window::KneeWindow;
use super::place::{along_x, half_space, placed, plate, turn, with_mirror};
use super::record::{Fold, MaterialClass, PrintedPart, Seat, Wall, always};
use crate::frame::skeleton::placement;
use crate::params::{Frame, PartName};
use crate::solid::{Contour, Feature, Profile};
use crate::units::Angle;

/// The record of the part.
pub static PART: PrintedPart = PrintedPart {
    name: PartName::Knee,
    feature: |frame, closure, _| Knee::from_frame(frame, closure.strut_tilt).feature(),
    material: MaterialClass::Flexible,
    seat: Seat::Modules(placement::knee),
    fold: Fold::Moves,
    print_turn: Knee::print_turn,
    needed: always,
    walls: &[Wall::anywhere(&["knee.knee_back_wall_mm", "knee.knee_side_wall_mm"])],
};

/// Reach of prisms that something else ends, mm.
const FAR_MM: f64 = 40.0;

/// How far beyond the place where the tube's back crosses the rib's the rib begins to round off, mm.
const PAST_CROSSING_MM: f64 = 0.05;

/// The outer plate.
#[derive(Clone, Debug, PartialEq)]
pub struct KneePlate {
    /// From the window's outer wall to the plate's face, mm.
    pub thickness_mm: f64,
    /// Width across, mm.
    pub width_mm: f64,
    /// Rounding of its corners, mm.
    pub round_mm: f64,
}

/// The knee.
#[derive(Clone, Debug, PartialEq)]
pub struct Knee {
    /// Bore of the strut sockets, mm.
    pub bore_mm: f64,
    /// Depth of the bores, mm.
    pub depth_mm: f64,
    /// From the node to the bores' bottoms, mm.
    pub bottom_mm: f64,
    /// Wall at the sides of a bore, mm.
    pub side_wall_mm: f64,
    /// Wall on the inner side of a bore, mm.
    pub back_wall_mm: f64,
    /// Angle of the struts against the vertical.
    pub strut_tilt: Angle,
    /// The window for the fork's bar.
    pub window: KneeWindow,
    /// Thickness of the rib on the inner side of the window, mm.
    pub rib_mm: f64,
    /// The outer plate.
    pub plate: KneePlate,
    /// Rounding of the inner edges and of the corner between tube and plate, mm.
    pub edge_round_mm: f64,
}

impl Knee {
    /// The part for a frame; `strut_tilt` is the strut's angle against the vertical.
    pub fn from_frame(frame: &Frame, strut_tilt: Angle) -> Self {
        let (knee, fork) = (&frame.knee, &frame.fork);
        Self {
            bore_mm: frame.grip_bore_mm(),
            depth_mm: knee.knee_socket_depth_mm,
            bottom_mm: knee.knee_node_to_bottom_mm,
            side_wall_mm: knee.knee_side_wall_mm,
            back_wall_mm: knee.knee_back_wall_mm,
            strut_tilt,
            window: KneeWindow {
                centre_mm: knee.knee_node_offset_mm + fork.fork_bar_offset_mm,
                size_x_mm: fork.fork_bar_depth_mm + knee.knee_window_clearance_depth_mm,
                size_z_mm: fork.fork_bar_height_mm + knee.knee_window_clearance_height_mm,
                round_mm: knee.knee_window_round_mm,
                flare_mm: knee.knee_window_flare_mm,
            },
            rib_mm: knee.knee_rib_mm,
            plate: KneePlate {
                thickness_mm: knee.knee_plate_thickness_mm,
                width_mm: knee.knee_plate_width_mm,
                round_mm: knee.knee_plate_round_mm,
            },
            edge_round_mm: knee.knee_edge_round_mm,
        }
    }

    /// The part in its frame.
    pub fn feature(&self) -> Feature {
        let (half, high) = (self.half_width_mm(), self.rib_end_mm() + 0.5);
        let front = self.front_mm();
        let core = Feature::cuboid_between([self.window.back_mm(), -half, -high], [front + 1.0, half, high]);
        let body = Feature::union([self.rib(), with_mirror(self.tube(), Vector3::z()), core, self.outer_plate()]);
        let mouth = half_space(Point3::from(self.strut() * self.mouth_mm()), -self.strut());
        let ends = [body, half_space(Point3::new(front, 0.0, 0.0), -Vector3::x()), mouth.clone(), mouth.mirrored(Vector3::z())];
        let bottom = Point3::from(self.strut() * self.bottom_mm);
        let bore = Feature::bore_between(bottom, bottom + self.strut() * (self.depth_mm + 10.0), 0.5 * self.bore_mm);
        let window = self.window.cutter(half, 2.0 * self.plate.width_mm);
        Feature::intersection(ends).minus([window, bore.clone(), bore.mirrored(Vector3::z())])
    }

    /// The turn that lays the outer plate on the bed.
    pub fn print_turn() -> UnitQuaternion<f64> {
        turn(-Vector3::z(), Vector3::y(), Vector3::x())
    }

    fn half_width_mm(&self) -> f64 {
        0.5 * self.bore_mm + self.side_wall_mm
    }

    fn mouth_mm(&self) -> f64 {
        self.bottom_mm + self.depth_mm
    }

    /// Outer face of the plate, mm.
    fn front_mm(&self) -> f64 {
        self.window.front_mm() + self.plate.thickness_mm
    }

    /// Direction of the upper strut.
    fn strut(&self) -> Vector3<f64> {
        Vector3::new(self.strut_tilt.sin(), 0.0, self.strut_tilt.cos())
    }

    fn edge_round_mm(&self) -> f64 {
        self.edge_round_mm.min(self.half_width_mm() - 0.05)
    }

    /// Face behind the bores, from the struts' axes, mm.
    fn back_mm(&self) -> f64 {
        0.5 * self.bore_mm + self.back_wall_mm
    }

    /// How high above the middle the rib begins to round off, mm: at the window's corners, or further out, where the tube's back comes forth
    /// from behind the rib's, but not where the tube is the wall behind its bore.
    fn rib_end_mm(&self) -> f64 {
        let (sin, cos) = (self.strut_tilt.sin(), self.strut_tilt.cos());
        let rib_back = self.window.back_mm() - self.rib_mm;
        let crossing = (rib_back * cos + self.back_mm()) / sin;
        let behind_bore = self.bottom_mm * cos + self.back_mm() * sin;
        self.window.half_z_mm().max(behind_bore.min(crossing + PAST_CROSSING_MM))
    }

    /// Two rounded pucks where the rib ends, and what lies between them.
    fn rib(&self) -> Feature {
        let half = self.half_width_mm();
        let round = self.edge_round_mm().min(self.rib_mm - 0.05);
        let corners = [([0.0, -half], 0.0), ([self.rib_mm, -half], round), ([self.rib_mm, half], round), ([0.0, half], 0.0)];
        let puck = Feature::revolve(Profile::new(Contour::rounded_polygon(&corners)));
        let puck = placed(puck, turn(Vector3::z(), Vector3::x(), Vector3::y()), Point3::origin());
        let at = |z: f64| puck.clone().at(self.window.back_mm(), 0.0, z);
        Feature::hull([at(self.rib_end_mm()), at(-self.rib_end_mm())])
    }

    /// The upper strut's socket: a prism along the strut with rounded inner edges; the other end is in the plate.
    fn tube(&self) -> Feature {
        let half = self.half_width_mm();
        let back = self.back_mm();
        let round = self.edge_round_mm();
        let section = [([half, FAR_MM], 0.0), ([-half, FAR_MM], 0.0), ([-half, -back], round), ([half, -back], round)];
        let prism = plate(Contour::rounded_polygon(&section), -5.0, self.mouth_mm() + 5.0);
        let outward = Vector3::new(self.strut_tilt.cos(), 0.0, -self.strut_tilt.sin());
        let prism = placed(prism, turn(-Vector3::y(), outward, self.strut()), Point3::origin());
        let above = Feature::cuboid_between([-60.0, -60.0, self.rib_end_mm()], [self.front_mm() + 1.0, 60.0, 60.0]);
        Feature::intersection([prism, above])
    }

    /// Plate seen from above as the bar of a T, with fillets towards the tube; its height ends at the mouths.
    fn outer_plate(&self) -> Feature {
        let face = self.window.front_mm() + self.window.flare_mm;
        let (front, half) = (self.front_mm() + 1.0, 0.5 * self.plate.width_mm);
        let stem = self.half_width_mm();
        let fillet = self.edge_round_mm().min(0.9 * (half - stem));
        let back = face - fillet - 20.0;
        let tee = Contour::rounded_polygon(&[
            ([front, half], 0.0),
            ([face, half], 0.0),
            ([face, stem], fillet),
            ([back, stem], 0.0),
            ([back, -stem], 0.0),
            ([face, -stem], fillet),
            ([face, -half], 0.0),
            ([front, -half], 0.0),
        ]);
        let top = (self.mouth_mm() - self.strut().x * face) / self.strut().z;
        let outline = Contour::rounded_rectangle([0.0, 0.0], [2.0 * half, 2.0 * top], self.plate.round_mm);
        Feature::intersection([plate(tee, -60.0, 60.0), along_x(outline, face - 0.85 * fillet, front)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::parts::measure::{ahead, assert_close, assert_like, hits, pin_mm, printed, v8};

    fn part() -> Knee {
        Knee::from_frame(&v8(), Angle::deg(25.0))
    }

    #[test]
    fn measured_knee_is_like_the_original() {
        let mesh = printed(&part().feature(), 1);
        assert_like(&mesh, [10.18, 12.0, 25.11], 1310.9, 0.03);
        for up in [1.0, -1.0] {
            let strut = Vector3::new(part().strut().x, 0.0, up * part().strut().z);
            let inside: [f64; 3] = (strut * 8.0).into();
            assert_close("bore", pin_mm(&mesh, inside, strut), 2.7);
            assert_close("bottom", ahead(&mesh, inside, -strut), 3.0);
            let beside: [f64; 3] = (strut * 8.0 + Vector3::y() * 2.0).into();
            assert_close("mouth", ahead(&mesh, beside, strut), 12.53 - 8.0);
        }
        let through = hits(&mesh, [-30.0, 0.001, 0.01], Vector3::x());
        let expected = [30.0 - 1.774, 30.0 + 1.426, 30.0 + 4.726, 30.0 + 8.406];
        for (found, nominal) in through.iter().zip(expected) {
            assert_close("rib, window, plate", *found, nominal);
        }
        assert_close("window up", ahead(&mesh, [3.076, 0.0, 0.01], Vector3::z()), 2.9);
        assert_close("rib's width", 2.0 * ahead(&mesh, [0.2, 0.0, 0.01], Vector3::y()), 6.1);
    }

    #[test]
    fn analytic_the_wall_behind_a_bore_is_as_thick_as_it_is_asked_for() {
        for wall_mm in [1.2, 1.48, 2.0, 2.5] {
            let knee = Knee { back_wall_mm: wall_mm, ..part() };
            let mesh = printed(&knee.feature(), 1);
            let inside: [f64; 3] = (knee.strut() * (knee.bottom_mm + 0.1) + Vector3::y() * 0.001).into();
            let inwards = Vector3::new(-knee.strut_tilt.cos(), 0.0, knee.strut_tilt.sin());
            let through = hits(&mesh, inside, inwards);
            assert_close("bore", through[0], 1.35);
            // Where it is thin, the rib's end may be thicker.
            assert!(through[1] > 1.35 + wall_mm - 0.005, "{wall_mm}: {through:?}");
        }
    }

    #[test]
    fn analytic_printed_it_stands_on_its_plate() {
        let mesh = printed(&part().feature(), 1);
        let turned = mesh.placed(&nalgebra::Isometry3::from_parts(nalgebra::Translation3::identity(), Knee::print_turn()));
        assert_close("plate below", turned.bounds_mm()[0][2], -8.406);
    }
}
