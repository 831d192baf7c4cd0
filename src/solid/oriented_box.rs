//! Boxes along their own axes: what they keep apart need not be measured.

use nalgebra::{Isometry3, Matrix3, Point3, Vector3};

/// A box around something, along the axes that it was made in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrientedBox {
    middle: Vector3<f64>,
    half: Vector3<f64>,
}

/// The pose of one box's axes in another's, ready for many boxes.
pub struct Between {
    turn: Matrix3<f64>,
    sizes: Matrix3<f64>,
    shift: Vector3<f64>,
}

impl Between {
    /// Of a pose.
    pub fn of(pose: &Isometry3<f64>) -> Self {
        let turn = pose.rotation.to_rotation_matrix().into_inner();
        Self { turn, sizes: turn.abs(), shift: pose.translation.vector }
    }
}

impl OrientedBox {
    /// Around points, mm.
    pub fn around<'a>(points: impl Iterator<Item = &'a Point3<f64>>) -> Self {
        let none = (Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY));
        let (low, high) = points.fold(none, |(low, high), p| (low.inf(&p.coords), high.sup(&p.coords)));
        Self { middle: (low + high) * 0.5, half: (high - low) * 0.5 }
    }

    /// The axis along which it is longest.
    pub fn longest(&self) -> usize {
        self.half.imax()
    }

    /// Its longest side, mm.
    pub fn size_mm(&self) -> f64 {
        2.0 * self.half.max()
    }

    /// Its corners, mm.
    pub fn corners(&self) -> [Point3<f64>; 8] {
        [0, 1, 2, 3, 4, 5, 6, 7].map(|i| {
            let sign = |bit: i32| if i & bit == 0 { -1.0 } else { 1.0 };
            Point3::from(self.middle + self.half.component_mul(&Vector3::new(sign(1), sign(2), sign(4))))
        })
    }

    /// A distance that this box and another are at least apart, mm, by the planes along their faces; 0 or less when none of
    /// them parts the two (C. Ericson, Real-Time Collision Detection, 2005, section 4.4.1).
    pub fn apart_mm(&self, other: &Self, pose: &Between) -> f64 {
        let between = pose.turn * other.middle + pose.shift - self.middle;
        let along_mine = between.abs() - self.half - pose.sizes * other.half;
        let along_its = pose.turn.tr_mul(&between).abs() - other.half - pose.sizes.tr_mul(&self.half);
        along_mine.max().max(along_its.max())
    }

    /// The same by the planes along pairs of edges, too.
    pub fn apart_by_edges_mm(&self, other: &Self, pose: &Between) -> f64 {
        let between = pose.turn * other.middle + pose.shift - self.middle;
        let mut most = self.apart_mm(other, pose);
        for i in 0..3 {
            for j in 0..3 {
                let edge = pose.turn.column(j);
                let axis = Vector3::ith(i, 1.0).cross(&edge);
                let length = axis.norm();
                if length > 1e-6 {
                    let mine = self.half.dot(&axis.abs());
                    let its: f64 = (0..3).map(|k| other.half[k] * pose.turn.column(k).dot(&axis).abs()).sum();
                    most = most.max((between.dot(&axis).abs() - mine - its) / length);
                }
            }
        }
        most
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_crossed_rods_are_apart_by_their_gap() {
        let b = OrientedBox::around([Point3::new(-1.0, -1.0, 0.0), Point3::new(1.0, 1.0, 100.0)].iter());
        let crossed = |gap: f64, deg: f64| {
            let turned = Isometry3::rotation(Vector3::x() * deg.to_radians());
            Between::of(&(Isometry3::translation(2.0 + gap, 0.0, 50.0) * turned * Isometry3::translation(0.0, 0.0, -50.0)))
        };
        assert!((b.apart_mm(&b, &crossed(0.7, 90.0)) - 0.7).abs() < 1e-9);
        assert!(b.apart_mm(&b, &crossed(-0.7, 90.0)) < 0.0);
        assert!((b.apart_by_edges_mm(&b, &crossed(0.7, 40.0)) - 0.7).abs() < 1e-9);
        assert!(b.corners().iter().all(|c| c.z.abs() < 1e-9 || (c.z - 100.0).abs() < 1e-9));
    }
}
