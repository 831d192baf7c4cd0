//! The four modules: one, turned about the vertical and, in a frame that is longer than wide, moved apart along y.

use nalgebra::{Isometry3, Point3, Rotation3, UnitQuaternion, Vector3};

use crate::params::groups::RodParameters;

/// The four modules, counter-clockwise from front right.
pub const MODULE_NAMES: [&str; 4] = ["FR", "FL", "BL", "BR"];

/// The same in words.
pub const MODULE_WORDS: [&str; 4] = ["front right", "front left", "rear left", "rear right"];

/// A module's turn from the first one.
pub fn module_turn(module: usize) -> UnitQuaternion<f64> {
    UnitQuaternion::from_axis_angle(&Vector3::z_axis(), angle(module))
}

/// The same as a matrix.
pub(super) fn turn_matrix(module: usize) -> Rotation3<f64> {
    Rotation3::from_axis_angle(&Vector3::z_axis(), angle(module))
}

fn angle(module: usize) -> f64 {
    std::f64::consts::FRAC_PI_2 * module as f64
}

/// Where the modules stand. A module's axes are those in which the first one lies along the diagonal of x and y, with the hub's
/// bores as in a square frame; in a square frame they are the frame's, turned.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ModulePlaces {
    /// How far the front modules stand in front of a square frame's, and the rear ones behind it, mm; 0 in a square frame.
    pub forward_mm: f64,
}

impl ModulePlaces {
    /// Of rods: the sides of a ring are longer than its front by what the modules stand apart.
    pub fn of(rods: &RodParameters) -> Self {
        let [front_mm, side_mm] = [rods.cage_rod_length_mm, rods.cage_rod_length_mm * rods.cage_side_ratio];
        Self { forward_mm: (0.5 * (side_mm - front_mm)).max(0.0) }
    }

    /// Whether the frame is longer than wide.
    pub fn are_apart(&self) -> bool {
        self.forward_mm > 0.0
    }

    /// Whether a module carries the rods of its side: modules alternate, and those in front right and rear left carry the ones across.
    pub fn carries_side_rods(module: usize) -> bool {
        module % 2 == 1
    }

    /// Modules of which every other one is a mirror image or a turn: what holds for them holds for all.
    pub fn representatives(&self) -> &'static [usize] {
        if self.are_apart() { &[0, 1] } else { &[0] }
    }

    /// From the first module's axes to where a module has it in the frame's.
    pub fn pose(&self, module: usize, in_first: &Isometry3<f64>) -> Isometry3<f64> {
        let mut pose = module_turn(module) * in_first;
        pose.translation.vector = self.moved(module, pose.translation.vector);
        pose
    }

    /// The same of a point.
    pub fn point(&self, module: usize, in_first: Point3<f64>) -> Point3<f64> {
        Point3::from(self.moved(module, (turn_matrix(module) * in_first).coords))
    }

    /// From the frame's axes to the first module's: the inverse of [`Self::pose`] for the first module.
    pub fn in_first(&self, mut pose: Isometry3<f64>) -> Isometry3<f64> {
        if self.are_apart() {
            pose.translation.vector.y -= self.forward_mm;
        }
        pose
    }

    /// What a module has in a square frame, moved to where it is. Nothing is added in a square frame, as adding 0 would take the sign off
    /// a zero.
    pub(super) fn moved(&self, module: usize, mut at: Vector3<f64>) -> Vector3<f64> {
        if self.are_apart() {
            at.y += if MODULE_NAMES[module % MODULE_NAMES.len()].starts_with('F') { self.forward_mm } else { -self.forward_mm };
        }
        at
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_modules_of_a_long_frame_are_mirror_images() {
        let places = ModulePlaces { forward_mm: 13.0 };
        let [front_right, front_left, rear_left, rear_right] =
            [0, 1, 2, 3].map(|module| places.point(module, Point3::new(40.0, 40.0, 7.0)));
        let near = |a: Point3<f64>, b: [f64; 3]| (a - Point3::from(b)).norm() < 1e-12;
        assert!(near(front_right, [40.0, 53.0, 7.0]) && near(front_left, [-40.0, 53.0, 7.0]), "{front_right} {front_left}");
        assert!(near(rear_left, [-40.0, -53.0, 7.0]) && near(rear_right, [40.0, -53.0, 7.0]), "{rear_left} {rear_right}");
    }

    #[test]
    fn analytic_a_square_frame_keeps_the_bits_of_its_turns() {
        let pose = Isometry3::translation(-0.0, 3.0, -0.0);
        for module in 0..4 {
            let [is, was] = [ModulePlaces::default().pose(module, &pose), module_turn(module) * pose];
            assert_eq!(is.translation.vector.map(f64::to_bits), was.translation.vector.map(f64::to_bits));
        }
    }
}
