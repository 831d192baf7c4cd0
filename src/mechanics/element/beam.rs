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

use nalgebra::{Matrix3, Vector3};

use super::corotation::CorotatedAxes;
use super::matrices::{Ends, Local, Matrix7, Tangent};

/// Stiffnesses of a beam's section: N, N mm².
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
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
    /// Stiffnesses of its section.
    pub rigidity: Rigidity,
    /// Stiffness in its own frame: N, mm, rad.
    pub stiffness: Matrix7,
}

/// The response of a beam: its force and tangent.
#[derive(Clone, Debug)]
pub struct ElementResponse {
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
        Some(Self { nodes, axes, length_mm, rigidity: *rigidity, stiffness: stiffness(rigidity, length_mm) })
    }

    /// Stretch and rotations for the places and turns of its nodes.
    pub fn local(&self, places: [Vector3<f64>; 2], turns: [&Matrix3<f64>; 2]) -> Local {
        let frame = CorotatedAxes::new(&self.axes, places, turns);
        frame.local(self.length_mm)
    }

    /// The force of [`Self::response`] alone.
    pub fn push(&self, places: [Vector3<f64>; 2], turns: [&Matrix3<f64>; 2], scale: f64, bias: &Local) -> Ends {
        let frame = CorotatedAxes::new(&self.axes, places, turns);
        let local = frame.local(self.length_mm);
        frame.force(&local, &(self.stiffness * local * scale + bias))
    }

    /// Force and tangent; the force in its own frame is `scale` times the elastic one and `bias` on top.
    pub fn response(&self, places: [Vector3<f64>; 2], turns: [&Matrix3<f64>; 2], scale: f64, bias: &Local) -> ElementResponse {
        let frame = CorotatedAxes::new(&self.axes, places, turns);
        let local = frame.local(self.length_mm);
        let stiffness = self.stiffness * scale;
        let own = stiffness * local + bias;
        let (force, tangent) = frame.spread(&local, &own, &stiffness);
        ElementResponse { local, force, tangent }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::element::rotation::exp;
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
        let response = beam.response(places, turns.each_ref(), 1.3, bias);
        let step = 1e-5;
        let column = |at: usize| {
            let [plus, minus] = [step, -step].map(|by| {
                let (mut p, mut t) = (places, turns);
                moved(&mut p, &mut t, at, by);
                beam.response(p, t.each_ref(), 1.3, bias).force
            });
            ((plus - minus) / (2.0 * step) - response.tangent.column(at)).amax()
        };
        (0..12).map(column).fold(0.0, f64::max) / response.tangent.amax()
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
        fn analytic_the_force_alone_is_that_beside_the_tangent(values in proptest::collection::vec(-1.0f64..1.0, 19)) {
            let v = |at: usize| Vector3::new(values[at], values[at + 1], values[at + 2]);
            let beam = Beam::new([0, 1], [Vector3::zeros(), Vector3::new(3.0, 1.0, -2.0)], Vector3::y(), &rigidity()).expect("is a beam");
            let (places, turns) = ([v(0), Vector3::new(3.0, 1.0, -2.0) + v(3)], [exp(&v(6)), exp(&v(9))]);
            let bias = Local::from_column_slice(&values[12..19]) * 50.0;
            let response = beam.response(places, turns.each_ref(), 1.3, &bias);
            let pushed = beam.push(places, turns.each_ref(), 1.3, &bias);
            prop_assert!((response.force - pushed).amax() < 1e-9 * response.force.amax());
        }

        #[test]
        fn analytic_a_moved_beam_feels_nothing_and_forces_balance(values in proptest::collection::vec(-1.0f64..1.0, 12)) {
            let v = |at: usize| Vector3::new(values[at], values[at + 1], values[at + 2]);
            let rest = [Vector3::zeros(), Vector3::new(3.0, 1.0, -2.0)];
            let beam = Beam::new([0, 1], rest, Vector3::y(), &rigidity()).expect("is a beam");
            let turn = exp(&(v(0) * 1.7));
            let places = rest.map(|p| turn * p + v(3));
            let still = beam.response(places, [&turn, &turn], 1.0, &Local::zeros());
            prop_assert!(still.force.amax() < 1e-9, "{}", still.force);
            let bent = beam.response(places, [&(exp(&(v(6) * 0.3)) * turn), &(exp(&(v(9) * 0.3)) * turn)], 1.0, &Local::zeros());
            let f = |at: usize| bent.force.fixed_rows::<3>(at).into_owned();
            prop_assert!((f(0) + f(6)).norm() < 1e-9);
            let moment = f(3) + f(9) + (places[1] - places[0]).cross(&f(6));
            prop_assert!(moment.norm() < 1e-8, "{moment}");
        }
    }
}
