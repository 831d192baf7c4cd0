//! A straight beam with shear, in space, for large rotations: corotational, with its full tangent.
//!
//! A frame follows the line between the beam's ends (r₁) and the mean of the ends' own second axes; what is left in that
//! frame are one stretch and six small rotations, on which linear Timoshenko beam theory works. Force and tangent follow by
//! differentiation without leaving out terms: J.-M. Battini, C. Pacoste, *Co-rotational beam elements with warping effects in
//! instability problems*, Comput. Methods Appl. Mech. Engrg. 191 (2002) 1755, without its warping. Shear after S. P.
//! Timoshenko: φ = 12 EI / (G A l²).
//!
//! Unknowns are displacements and *spins*, so the tangent is unsymmetric away from equilibrium and symmetric at it.
//!
//! *When it is wrong:* large strains, sections that change their shape, and elements so long that they bow much within.

use nalgebra::{Matrix3, SMatrix, SVector, Vector3};

use super::rotation::{inverse_tangent, log, moment_change, skew};

/// Stretch and rotations in the beam's own frame: u, then three rotations at each end (x along the beam).
pub type Local = SVector<f64, 7>;
/// Force or displacement of both ends: force, moment, force, moment.
pub type Ends = SVector<f64, 12>;
/// Their matrix.
pub type Tangent = SMatrix<f64, 12, 12>;
type Matrix7 = SMatrix<f64, 7, 7>;

/// Stiffnesses of a beam's section: N, N mm².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rigidity {
    /// E A.
    pub axial_n: f64,
    /// G A κ against shear along y and z.
    pub shear_n: [f64; 2],
    /// G J.
    pub torsion_n_mm2: f64,
    /// E I about y and z.
    pub bending_n_mm2: [f64; 2],
}

/// A beam.
#[derive(Clone, Debug)]
pub struct Beam {
    /// Its two nodes.
    pub nodes: [usize; 2],
    /// Its axes at rest as columns, x along it.
    pub axes: Matrix3<f64>,
    /// Its length at rest, mm.
    pub length_mm: f64,
    /// Stiffness in its own frame: N, mm, rad.
    pub stiffness: Matrix7,
}

/// What a beam feels at a moment.
#[derive(Clone, Debug)]
pub struct Felt {
    /// In its own frame.
    pub local: Local,
    /// Force of its nodes on it: N, N mm.
    pub force: Ends,
    /// Change of that force with displacements and spins of the nodes.
    pub tangent: Tangent,
}

impl Beam {
    /// A beam between two places; `aside` lies in the plane of its x and y.
    ///
    /// `None` when the places coincide, or `aside` lies along the beam.
    pub fn new(nodes: [usize; 2], places: [Vector3<f64>; 2], aside: Vector3<f64>, rigidity: &Rigidity) -> Option<Self> {
        let along = places[1] - places[0];
        let length_mm = along.norm();
        let x = along.try_normalize(1e-9)?;
        let z = x.cross(&aside).try_normalize(1e-9)?;
        let axes = Matrix3::from_columns(&[x, z.cross(&x), z]);
        Some(Self { nodes, axes, length_mm, stiffness: stiffness(rigidity, length_mm) })
    }

    /// Stretch and rotations for the places and turns of its nodes.
    pub fn local(&self, places: [Vector3<f64>; 2], turns: [&Matrix3<f64>; 2]) -> Local {
        let frame = Frame::new(self, places, turns);
        frame.local(self)
    }

    /// Force and tangent; the force in its own frame is `scale` times the elastic one and `bias` on top.
    pub fn feel(&self, places: [Vector3<f64>; 2], turns: [&Matrix3<f64>; 2], scale: f64, bias: &Local) -> Felt {
        let frame = Frame::new(self, places, turns);
        let local = frame.local(self);
        let stiffness = self.stiffness * scale;
        let own = stiffness * local + bias;
        let (force, tangent) = frame.spread(&local, &own, &stiffness);
        Felt { local, force, tangent }
    }
}

/// Linear Timoshenko beam in its own frame.
fn stiffness(r: &Rigidity, length: f64) -> Matrix7 {
    let mut k = Matrix7::zeros();
    k[(0, 0)] = r.axial_n / length;
    let twist = r.torsion_n_mm2 / length;
    (k[(1, 1)], k[(4, 4)], k[(1, 4)], k[(4, 1)]) = (twist, twist, -twist, -twist);
    // Bending about y is sheared along z and the other way round.
    for (axis, shear_n) in [(0, r.shear_n[1]), (1, r.shear_n[0])] {
        let bending = r.bending_n_mm2[axis];
        let phi = 12.0 * bending / (shear_n * length * length);
        let unit = bending / (length * (1.0 + phi));
        let (i, j) = (2 + axis, 5 + axis);
        (k[(i, i)], k[(j, j)]) = (unit * (4.0 + phi), unit * (4.0 + phi));
        (k[(i, j)], k[(j, i)]) = (unit * (2.0 - phi), unit * (2.0 - phi));
    }
    k
}

/// The frame that follows the beam.
struct Frame {
    axes: Matrix3<f64>,
    length: f64,
    /// Turns of the ends in the frame.
    ends: [Matrix3<f64>; 2],
    /// The ends' second axes in the frame, over the y of their mean: η₁₁, η₁₂, η₂₁, η₂₂ of the paper are their x and y.
    second: [Vector3<f64>; 2],
}

impl Frame {
    fn new(beam: &Beam, places: [Vector3<f64>; 2], turns: [&Matrix3<f64>; 2]) -> Self {
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

    fn local(&self, beam: &Beam) -> Local {
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

    /// From force and stiffness in the frame to those at the ends.
    fn spread(&self, local: &Local, own: &Local, stiffness: &Matrix7) -> (Ends, Tangent) {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::rotation::exp;
    use proptest::prelude::*;

    fn rigidity() -> Rigidity {
        Rigidity { axial_n: 900.0, shear_n: [250.0, 300.0], torsion_n_mm2: 700.0, bending_n_mm2: [1100.0, 600.0] }
    }

    fn moved(places: &mut [Vector3<f64>; 2], turns: &mut [Matrix3<f64>; 2], at: usize, by: f64) {
        let step = Vector3::from_fn(|i, _| if i == at % 3 { by } else { 0.0 });
        let end = at / 6;
        if at % 6 < 3 { places[end] += step } else { turns[end] = exp(&step) * turns[end] }
    }

    /// Largest error of the tangent against central differences, relative to its largest entry.
    fn error(beam: &Beam, places: [Vector3<f64>; 2], turns: [Matrix3<f64>; 2], bias: &Local) -> f64 {
        let felt = beam.feel(places, turns.each_ref(), 1.3, bias);
        let step = 1e-5;
        let column = |at: usize| {
            let [plus, minus] = [step, -step].map(|by| {
                let (mut p, mut t) = (places, turns);
                moved(&mut p, &mut t, at, by);
                beam.feel(p, t.each_ref(), 1.3, bias).force
            });
            ((plus - minus) / (2.0 * step) - felt.tangent.column(at)).amax()
        };
        (0..12).map(column).fold(0.0, f64::max) / felt.tangent.amax()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]
        #[test]
        fn analytic_the_tangent_is_the_forces_derivative(values in proptest::collection::vec(-1.0f64..1.0, 22)) {
            let v = |at: usize| Vector3::new(values[at], values[at + 1], values[at + 2]);
            let places = [v(0), Vector3::new(3.0, 1.0, -2.0) + v(3)];
            let beam = Beam::new([0, 1], [Vector3::zeros(), Vector3::new(3.0, 1.0, -2.0)], Vector3::y(), &rigidity());
            let beam = beam.expect("is a beam");
            let whole = exp(&(v(6) * 1.5));
            let turns = [exp(&(v(9) * 0.5)) * whole, exp(&(v(12) * 0.5)) * whole];
            let places = places.map(|p| whole * p);
            let bias = Local::from_column_slice(&values[15..22]) * 50.0;
            let error = error(&beam, places, turns, &bias);
            prop_assert!(error < 1e-6, "{error}");
        }

        #[test]
        fn analytic_a_moved_beam_feels_nothing_and_forces_balance(values in proptest::collection::vec(-1.0f64..1.0, 12)) {
            let v = |at: usize| Vector3::new(values[at], values[at + 1], values[at + 2]);
            let rest = [Vector3::zeros(), Vector3::new(3.0, 1.0, -2.0)];
            let beam = Beam::new([0, 1], rest, Vector3::y(), &rigidity()).expect("is a beam");
            let turn = exp(&(v(0) * 1.7));
            let places = rest.map(|p| turn * p + v(3));
            let still = beam.feel(places, [&turn, &turn], 1.0, &Local::zeros());
            prop_assert!(still.force.amax() < 1e-9, "{}", still.force);
            let bent = beam.feel(places, [&(exp(&(v(6) * 0.3)) * turn), &(exp(&(v(9) * 0.3)) * turn)], 1.0, &Local::zeros());
            let f = |at: usize| bent.force.fixed_rows::<3>(at).into_owned();
            prop_assert!((f(0) + f(6)).norm() < 1e-9);
            let moment = f(3) + f(9) + (places[1] - places[0]).cross(&f(6));
            prop_assert!(moment.norm() < 1e-8, "{moment}");
        }
    }
}
