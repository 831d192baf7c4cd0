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

    /// Its lowest and highest corner, mm.
    pub fn bounds_mm(&self) -> [[f64; 3]; 2] {
        [(self.middle - self.half).into(), (self.middle + self.half).into()]
    }

    /// The same with its faces moved out, mm.
    pub fn grown(&self, by_mm: f64) -> Self {
        Self { middle: self.middle, half: self.half.add_scalar(by_mm) }
    }

    /// Whether it and another along the same axes have a point in common.
    pub fn touches(&self, other: &Self) -> bool {
        let apart = (self.middle - other.middle).abs() - self.half - other.half;
        apart.max() <= 0.0
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

    /// Between which numbers of steps, within given ones, this box and another meet that moves on by the same step each time, by all
    /// planes that can part them; none where they never do.
    pub fn meeting(&self, other: &Self, pose: &Between, step: &Vector3<f64>, within: [f64; 2]) -> Option<[f64; 2]> {
        let between = pose.turn * other.middle + pose.shift - self.middle;
        let mine = self.half + pose.sizes * other.half;
        let its = other.half + pose.sizes.tr_mul(&self.half);
        let (turned, turned_step) = (pose.turn.tr_mul(&between), pose.turn.tr_mul(step));
        let faces = |found, i: usize| passing(passing(found, between[i], step[i], mine[i])?, turned[i], turned_step[i], its[i]);
        let found = (0..3).try_fold(within, faces)?;
        (0..9).try_fold(found, |found, pair| {
            let axis = Vector3::ith(pair / 3, 1.0).cross(&pose.turn.column(pair % 3));
            let reach = self.half.dot(&axis.abs()) + other.half.dot(&pose.turn.tr_mul(&axis).abs());
            if axis.norm_squared() > 1e-12 { passing(found, between.dot(&axis), step.dot(&axis), reach) } else { Some(found) }
        })
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

/// The numbers of steps, of those found, after which what starts at an offset is no farther from 0 than its reach.
fn passing([first, last]: [f64; 2], offset: f64, step: f64, reach: f64) -> Option<[f64; 2]> {
    if step.abs() < 1e-12 {
        return (offset.abs() <= reach).then_some([first, last]);
    }
    let ends = [(-reach - offset) / step, (reach - offset) / step];
    let found = [first.max(ends[0].min(ends[1])), last.min(ends[0].max(ends[1]))];
    (found[0] <= found[1]).then_some(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_a_box_passes_another_while_their_sides_overlap() {
        let b = OrientedBox::around([Point3::new(-1.0, -1.0, -1.0), Point3::new(1.0, 1.0, 1.0)].iter());
        let passing = |across: f64| b.meeting(&b, &Between::of(&Isometry3::translation(-10.0, across, 0.0)), &Vector3::x(), [0.0, 100.0]);
        assert_eq!(passing(1.5), Some([8.0, 12.0]));
        assert_eq!(passing(2.5), None);
        let turned = Isometry3::translation(-10.0, 0.0, 0.0) * Isometry3::rotation(Vector3::z() * std::f64::consts::FRAC_PI_4);
        let [first, last] = b.meeting(&b, &Between::of(&turned), &(Vector3::x() * 0.5), [0.0, 100.0]).expect("they meet");
        let reach = 1.0 + 2.0_f64.sqrt();
        assert!((first - (10.0 - reach) * 2.0).abs() < 1e-9 && (last - (10.0 + reach) * 2.0).abs() < 1e-9);
    }

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
