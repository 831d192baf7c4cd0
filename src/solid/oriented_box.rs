//! Boxes along their own axes: what they keep apart need not be measured.

use nalgebra::{Isometry3, Point3, Vector3};

/// A box around something, along the axes that it was made in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrientedBox {
    middle: Point3<f64>,
    half: Vector3<f64>,
}

impl OrientedBox {
    /// Around points, mm.
    pub fn around<'a>(points: impl Iterator<Item = &'a Point3<f64>>) -> Self {
        let none = (Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY));
        let (low, high) = points.fold(none, |(low, high), p| (low.inf(&p.coords), high.sup(&p.coords)));
        Self { middle: Point3::from((low + high) * 0.5), half: (high - low) * 0.5 }
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
            self.middle + self.half.component_mul(&Vector3::new(sign(1), sign(2), sign(4)))
        })
    }

    /// A distance that this box and another, in a pose relative to this one's axes, are at least apart, mm; 0 or less when
    /// no plane along their faces or edges parts them (C. Ericson, Real-Time Collision Detection, 2005, section 4.4.1).
    pub fn apart_mm(&self, other: &Self, pose: &Isometry3<f64>) -> f64 {
        let turn = pose.rotation.to_rotation_matrix();
        let theirs = [0, 1, 2].map(|i| turn.matrix().column(i).into_owned());
        let ours = [Vector3::x(), Vector3::y(), Vector3::z()];
        let between = pose * other.middle - self.middle;
        let along = |axis: &Vector3<f64>| {
            let mine: f64 = (0..3).map(|i| self.half[i] * axis[i].abs()).sum();
            let its: f64 = (0..3).map(|i| other.half[i] * theirs[i].dot(axis).abs()).sum();
            between.dot(axis).abs() - mine - its
        };
        let crossed = ours.iter().flat_map(|a| theirs.iter().filter_map(|b| a.cross(b).try_normalize(1e-6)));
        ours.iter().chain(&theirs).copied().chain(crossed).map(|axis| along(&axis)).fold(f64::NEG_INFINITY, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_crossed_rods_are_apart_by_their_gap() {
        let b = OrientedBox::around([Point3::new(-1.0, -1.0, 0.0), Point3::new(1.0, 1.0, 100.0)].iter());
        let crossed = |gap: f64| {
            Isometry3::new(Vector3::new(0.0, 50.0, 50.0), Vector3::x() * std::f64::consts::FRAC_PI_2)
                * Isometry3::translation(2.0 + gap, 0.0, 0.0)
        };
        assert!((b.apart_mm(&b, &crossed(0.7)) - 0.7).abs() < 1e-9);
        assert!(b.apart_mm(&b, &crossed(-0.7)) < 0.0);
        assert!(b.corners().iter().all(|c| c.z.abs() < 1e-9 || (c.z - 100.0).abs() < 1e-9));
    }
}
