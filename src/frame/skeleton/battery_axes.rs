//! The axes in which the battery and all that holds it are described: bracket, sleeve, lid, connector, magnets, flow sensor.
//!
//! Their y lies along the sleeve, and the battery is put in from -y. They are the frame's axes where the sleeve lies along the frame. Where it
//! lies across they are those turned by 90° about z: -y is the frame's right, +y its left.

use nalgebra::{Isometry3, Point3, UnitQuaternion, Vector3};

use crate::params::sleeve_direction::SleeveDirection;

/// Sides of the frame, counter-clockwise from the front.
const SIDES: [&str; 4] = ["front", "left", "rear", "right"];
/// Two sides that face each other, in a sentence: first those at the ends of a sleeve that lies along the frame.
const PAIRS: [&str; 2] = ["in front and at the rear", "left and right"];

/// The axes of the battery.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BatteryAxes {
    direction: SleeveDirection,
}

impl BatteryAxes {
    /// Of a sleeve that lies in a direction.
    pub fn new(direction: SleeveDirection) -> Self {
        Self { direction }
    }

    /// Whether the sleeve lies across the frame.
    pub fn are_turned(&self) -> bool {
        self.direction == SleeveDirection::Across
    }

    /// From these axes to the frame's. Nothing is multiplied along the frame, as that would take the sign off a zero.
    pub fn pose(&self, own: Isometry3<f64>) -> Isometry3<f64> {
        if !self.are_turned() {
            return own;
        }
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), std::f64::consts::FRAC_PI_2);
        Isometry3::from_parts(Vector3::from(self.vector(own.translation.vector.into())).into(), turn * own.rotation)
    }

    /// A direction or a place of these axes in the frame's.
    pub fn vector(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        if self.are_turned() { [-y, x, z] } else { [x, y, z] }
    }

    /// A place of these axes in the frame's.
    pub fn point(&self, own: Point3<f64>) -> Point3<f64> {
        self.vector(own.into()).into()
    }

    /// The box in these axes that is a box in the frame's: lowest and highest corner.
    pub fn box_of(&self, [low, high]: [[f64; 3]; 2]) -> [[f64; 3]; 2] {
        if self.are_turned() { [[low[1], -high[0], low[2]], [high[1], -low[0], high[2]]] } else { [low, high] }
    }

    /// Where the battery goes when it is taken out, in the frame's axes.
    pub fn way_out(&self) -> Vector3<f64> {
        self.vector([0.0, -1.0, 0.0]).into()
    }

    /// The side of the frame from which the battery is put in.
    pub fn open_side(&self) -> &'static str {
        self.side(2)
    }

    fn side(&self, at: usize) -> &'static str {
        SIDES[(at + usize::from(self.are_turned())) % SIDES.len()]
    }

    /// A text about the battery: the sides in it that stand between braces are those that they are with this sleeve.
    pub fn words(&self, text: &str) -> String {
        let [ends, beside] = if self.are_turned() { [PAIRS[1], PAIRS[0]] } else { PAIRS };
        let text = text.replace(&format!("{{{}}}", PAIRS[0]), ends).replace(&format!("{{{}}}", PAIRS[1]), beside);
        SIDES.iter().enumerate().fold(text, |text, (at, side)| text.replace(&format!("{{{side}}}"), self.side(at)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ACROSS: BatteryAxes = BatteryAxes { direction: SleeveDirection::Across };

    #[test]
    fn analytic_across_the_rear_is_the_right() {
        assert_eq!(ACROSS.way_out(), Vector3::x());
        assert_eq!(ACROSS.open_side(), "right");
        let said = ACROSS.words("{front} {left} {rear} {right}; {in front and at the rear}; {left and right}; rear");
        assert_eq!(said, "left rear right front; left and right; in front and at the rear; rear");
        let along = BatteryAxes::default();
        assert_eq!((along.way_out(), along.words("to the {rear}")), (-Vector3::y(), "to the rear".into()));
    }

    #[test]
    fn analytic_pose_point_and_box_are_of_one_turn() {
        let (low, high) = ([1.0, 2.0, 3.0], [4.0, 7.0, 5.0]);
        let corners = [low, high].map(|corner| ACROSS.vector(corner));
        let end = |pick: fn(f64, f64) -> f64| [0, 1, 2].map(|axis| pick(corners[0][axis], corners[1][axis]));
        assert_eq!(ACROSS.box_of([end(f64::min), end(f64::max)]), [low, high]);
        let posed = ACROSS.pose(Isometry3::translation(1.0, 2.0, 3.0)) * Point3::new(0.5, 0.0, 0.0);
        assert!((posed - ACROSS.point(Point3::new(1.5, 2.0, 3.0))).norm() < 1e-12, "{posed}");
    }
}
