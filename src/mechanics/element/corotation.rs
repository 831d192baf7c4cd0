//! The frame that follows a beam, and what its turning adds to force and tangent; see [`super::beam`].

use nalgebra::{Matrix3, SMatrix, Vector3};

use super::beam::{Beam, Ends, Local, Matrix7, Tangent};
use super::rotation::{inverse_tangent, log, moment_change, skew};

/// The frame that follows the beam.
pub(in crate::mechanics) struct Frame {
    axes: Matrix3<f64>,
    length: f64,
    /// Turns of the ends in the frame.
    ends: [Matrix3<f64>; 2],
    /// The ends' second axes in the frame, over the y of their mean: η₁₁, η₁₂, η₂₁, η₂₂ of the paper are their x and y.
    second: [Vector3<f64>; 2],
}

impl Frame {
    pub(in crate::mechanics) fn new(beam: &Beam, places: [Vector3<f64>; 2], turns: [&Matrix3<f64>; 2]) -> Self {
        let along = places[1] - places[0];
        let length = along.norm();
        let r1 = along / length;
        let own = [turns[0] * beam.axes, turns[1] * beam.axes];
        let q = [own[0].column(1).into_owned(), own[1].column(1).into_owned()];
        let mean = (q[0] + q[1]) * 0.5;
        let r3 = r1.cross(&mean).normalize();
        let axes = Matrix3::from_columns(&[r1, r3.cross(&r1), r3]);
        let back = axes.transpose();
        let [m, a, b] = [back * mean, back * q[0], back * q[1]];
        Self { axes, length, ends: own.map(|o| back * o), second: [a / m.y, b / m.y] }
    }

    pub(in crate::mechanics) fn local(&self, beam: &Beam) -> Local {
        let [a, b] = [log(&self.ends[0]), log(&self.ends[1])];
        Local::from_column_slice(&[self.length - beam.length_mm, a.x, a.y, a.z, b.x, b.y, b.z])
    }

    /// η of the paper: how far the mean of the second axes leans along the beam.
    fn eta(&self) -> f64 {
        0.5 * (self.second[0].x + self.second[1].x)
    }

    /// Spin of the frame per displacement and spin of the ends, in the frame: Gᵀ of the paper.
    fn spin(&self) -> SMatrix<f64, 3, 12> {
        let ([a, b], eta, l) = (self.second, self.eta(), self.length);
        let mut g = SMatrix::<f64, 3, 12>::zeros();
        (g[(0, 2)], g[(0, 3)], g[(0, 4)]) = (eta / l, 0.5 * a.y, -0.5 * a.x);
        (g[(0, 8)], g[(0, 9)], g[(0, 10)]) = (-eta / l, 0.5 * b.y, -0.5 * b.x);
        (g[(1, 2)], g[(1, 8)]) = (1.0 / l, -1.0 / l);
        (g[(2, 1)], g[(2, 7)]) = (-1.0 / l, 1.0 / l);
        g
    }

    /// From force in the frame to that at the ends.
    pub(in crate::mechanics) fn force(&self, local: &Local, own: &Local) -> Ends {
        let [a, b] = [1, 4].map(|at| {
            let (angle, moment) = (local.fixed_rows::<3>(at).into_owned(), own.fixed_rows::<3>(at).into_owned());
            inverse_tangent(&angle).transpose() * moment
        });
        let mut force = -(self.spin().transpose() * (a + b));
        force[0] -= own[0];
        force[6] += own[0];
        for i in 0..3 {
            force[3 + i] += a[i];
            force[9 + i] += b[i];
        }
        let mut turned = Ends::zeros();
        for i in 0..4 {
            turned.fixed_rows_mut::<3>(3 * i).copy_from(&(self.axes * force.fixed_rows::<3>(3 * i)));
        }
        turned
    }

    /// From force and stiffness in the frame to those at the ends.
    pub(in crate::mechanics) fn spread(&self, local: &Local, own: &Local, stiffness: &Matrix7) -> (Ends, Tangent) {
        let spin = self.spin();
        let angles = [1, 4].map(|at| local.fixed_rows::<3>(at).into_owned());
        let moments = [1, 4].map(|at| own.fixed_rows::<3>(at).into_owned());
        // In spins of the ends within the frame instead of rotation vectors.
        let mut change = Matrix7::identity();
        let mut geometric = Matrix7::zeros();
        for (end, at) in [1, 4].into_iter().enumerate() {
            change.fixed_view_mut::<3, 3>(at, at).copy_from(&inverse_tangent(&angles[end]));
            geometric.fixed_view_mut::<3, 3>(at, at).copy_from(&moment_change(&angles[end], &moments[end]));
        }
        let force_a = change.transpose() * own;
        let stiffness_a = change.transpose() * stiffness * change + geometric;
        // In displacements and spins of the ends, all in the frame's axes.
        let mut b = SMatrix::<f64, 7, 12>::zeros();
        (b[(0, 0)], b[(0, 6)]) = (-1.0, 1.0);
        for (row, column) in [(1, 3), (4, 9)] {
            b.fixed_view_mut::<3, 12>(row, 0).copy_from(&-spin);
            for i in 0..3 {
                b[(row + i, column + i)] += 1.0;
            }
        }
        let force = b.transpose() * force_a;
        let mut k = b.transpose() * stiffness_a * b;
        self.add_turning(&mut k, &force_a, &force, &spin);
        self.add_leaning(&mut k, force_a[1] + force_a[4], &b);
        self.turned(force, k)
    }

    /// What the turning of the frame adds to the tangent, in the frame's axes: K_m of the paper.
    fn add_turning(&self, k: &mut Tangent, force_a: &Local, force: &Ends, spin: &SMatrix<f64, 3, 12>) {
        let l = self.length;
        let axial = force_a[0] / l;
        for i in [1, 2] {
            for (row, column, sign) in [(i, i, 1.0), (i + 6, i + 6, 1.0), (i, i + 6, -1.0), (i + 6, i, -1.0)] {
                k[(row, column)] += sign * axial;
            }
        }
        // The moments' part of the nodal force turns with the frame; the axial force's own part is the one above.
        let mut moved = *force;
        (moved[0], moved[6]) = (force[0] + force_a[0], force[6] - force_a[0]);
        for block in 0..4 {
            let part = moved.fixed_rows::<3>(3 * block).into_owned();
            let turned = skew(&part) * spin;
            let mut rows = k.fixed_rows_mut::<3>(3 * block);
            rows -= turned;
        }
        let eta = self.eta();
        let sum = [1, 2, 3].map(|i| force_a[i] + force_a[i + 3]);
        let a = Vector3::new(0.0, (eta * sum[0] + sum[1]) / l, sum[2] / l);
        let column = spin.transpose() * a;
        for i in 0..12 {
            // Stretch is displacement 6 minus displacement 0.
            k[(i, 0)] -= column[i];
            k[(i, 6)] += column[i];
        }
    }

    /// What the leaning of the second axes adds: the twisting moments of both ends cancel but for second order, which the
    /// paper leaves out.
    fn add_leaning(&self, k: &mut Tangent, twist: f64, b: &SMatrix<f64, 7, 12>) {
        let eta = self.eta();
        let change = [0, 1].map(|end| -skew(&self.second[end]) * b.fixed_rows::<3>(1 + 3 * end));
        let scale = (change[0].row(1) + change[1].row(1)) * 0.5;
        let lean = (change[0].row(0) + change[1].row(0)) * 0.5 - scale * eta;
        let of = |end: usize, axis: usize| change[end].row(axis) - scale * self.second[end][axis];
        let rows = [
            (2, lean * (-1.0 / self.length)),
            (8, lean * (1.0 / self.length)),
            (3, of(0, 1) * -0.5),
            (4, of(0, 0) * 0.5),
            (9, of(1, 1) * -0.5),
            (10, of(1, 0) * 0.5),
        ];
        for (row, values) in rows {
            let mut into = k.row_mut(row);
            into += values * twist;
        }
    }

    /// From the frame's axes to those of space.
    fn turned(&self, force: Ends, k: Tangent) -> (Ends, Tangent) {
        let (mut f, mut t) = (Ends::zeros(), Tangent::zeros());
        let back = self.axes.transpose();
        for i in 0..4 {
            f.fixed_rows_mut::<3>(3 * i).copy_from(&(self.axes * force.fixed_rows::<3>(3 * i)));
            for j in 0..4 {
                let block = self.axes * k.fixed_view::<3, 3>(3 * i, 3 * j) * back;
                t.fixed_view_mut::<3, 3>(3 * i, 3 * j).copy_from(&block);
            }
        }
        (f, t)
    }
}
