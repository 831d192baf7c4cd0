//! An elastic tie between two bodies: a rod's slice in its socket, a plug's in the hub, a bar in its window.
//!
//! It resists any displacement of a point of the second node against one of the first, and any turn, alike in all
//! directions: energy ½ k d² + ½ κ φ², with φ the rotation vector from the first node's turn to the second's.

use nalgebra::{Matrix3, Vector3};

use super::matrices::{Ends, Tangent};
use super::rotation::{inverse_tangent, log, moment_change, skew};

/// The tie.
#[derive(Clone, Debug)]
pub struct Bushing {
    /// Its two nodes.
    pub nodes: [usize; 2],
    /// From each node to the tied point, at rest, mm.
    pub arms: [Vector3<f64>; 2],
    /// k, N/mm.
    pub stiffness_n_mm: f64,
    /// κ, N mm.
    pub turning_n_mm: f64,
}

/// Displacement and turn of the second point against the first.
pub type Gap = nalgebra::SVector<f64, 6>;

impl Bushing {
    /// Displacement in space and turn in the first node's axes.
    pub fn gap(&self, places: [Vector3<f64>; 2], turns: [&Matrix3<f64>; 2]) -> Gap {
        let d = places[1] + turns[1] * self.arms[1] - places[0] - turns[0] * self.arms[0];
        let back = turns[0].transpose();
        let (d, phi) = (back * d, log(&(back * turns[1])));
        Gap::from_column_slice(&[d.x, d.y, d.z, phi.x, phi.y, phi.z])
    }

    /// Displacement energy and turning energy stiffnesses as one diagonal.
    pub fn stiffness(&self) -> Gap {
        let (k, t) = (self.stiffness_n_mm, self.turning_n_mm);
        Gap::from_column_slice(&[k, k, k, t, t, t])
    }

    /// Force of the nodes on it, and its tangent; in the first node's axes the force is `scale` times the elastic one and
    /// `bias` on top.
    pub fn response(&self, places: [Vector3<f64>; 2], turns: [&Matrix3<f64>; 2], scale: f64, bias: &Gap) -> (Gap, Ends, Tangent) {
        let gap = self.gap(places, turns);
        let own = self.stiffness().component_mul(&gap) * scale + bias;
        let turn = turns[0];
        let (force, moment) = (turn * own.fixed_rows::<3>(0), own.fixed_rows::<3>(3).into_owned());
        let phi = gap.fixed_rows::<3>(3).into_owned();
        // The tied point of the second node, seen from both nodes: the force acts there on either.
        let arm = turns[1] * self.arms[1];
        let reach = places[1] + arm - places[0];
        let inverse = inverse_tangent(&phi);
        // Spin of the second against the first, first in space: R₀ (T⁻ᵀ m).
        let couple = turn * (inverse.transpose() * moment);
        let mut f = Ends::zeros();
        let [a, b, c, d] = [-force, -reach.cross(&force) - couple, force, arm.cross(&force) + couple];
        for (at, part) in [a, b, c, d].iter().enumerate() {
            f.fixed_rows_mut::<3>(3 * at).copy_from(part);
        }
        (gap, f, self.tangent(turn, [reach, arm], [force, couple], &moment, &phi, scale))
    }

    fn tangent(
        &self,
        turn: &Matrix3<f64>,
        [reach, arm]: [Vector3<f64>; 2],
        [force, couple]: [Vector3<f64>; 2],
        moment: &Vector3<f64>,
        phi: &Vector3<f64>,
        scale: f64,
    ) -> Tangent {
        let (one, k) = (Matrix3::identity(), self.stiffness_n_mm * scale);
        let (sr, sa, sf) = (skew(&reach), skew(&arm), skew(&force));
        // Change of the force: k (δd in space, without the first node's spin) and its turning with the first node.
        let df = [one * -k, sr * k - sf, one * k, sa * -k];
        let inverse = inverse_tangent(phi);
        let bend = inverse.transpose() * inverse * (self.turning_n_mm * scale) + moment_change(phi, moment);
        let relative = turn * bend * turn.transpose();
        let dm = [Matrix3::zeros(), -relative - skew(&couple), Matrix3::zeros(), relative];
        // reach changes with both places and the second spin; arm with the second spin.
        let dreach = [-one, Matrix3::zeros(), one, -sa];
        let mut t = Tangent::zeros();
        for column in 0..4 {
            let darm = if column == 3 { -sa } else { Matrix3::zeros() };
            let rows =
                [-df[column], sf * dreach[column] - sr * df[column] - dm[column], df[column], -sf * darm + sa * df[column] + dm[column]];
            for (row, block) in rows.iter().enumerate() {
                t.fixed_view_mut::<3, 3>(3 * row, 3 * column).copy_from(block);
            }
        }
        t
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::element::rotation::exp;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]
        #[test]
        fn analytic_the_tangent_is_the_forces_derivative(values in proptest::collection::vec(-1.0f64..1.0, 24)) {
            let v = |at: usize| Vector3::new(values[at], values[at + 1], values[at + 2]);
            let bushing = Bushing { nodes: [0, 1], arms: [v(0), v(3)], stiffness_n_mm: 80.0, turning_n_mm: 30.0 };
            let places = [v(6), v(9)];
            let whole = exp(&(v(12) * 1.5));
            let turns = [whole, exp(&(v(15) * 0.8)) * whole];
            let bias = Gap::from_column_slice(&values[18..24]) * 20.0;
            let (_, _, tangent) = bushing.response(places, turns.each_ref(), 1.2, &bias);
            let step = 1e-6;
            for at in 0..12 {
                let [plus, minus] = [step, -step].map(|by| {
                    let (mut p, mut t) = (places, turns);
                    let by = Vector3::from_fn(|i, _| if i == at % 3 { by } else { 0.0 });
                    if at % 6 < 3 { p[at / 6] += by } else { t[at / 6] = exp(&by) * t[at / 6] }
                    bushing.response(p, t.each_ref(), 1.2, &bias).1
                });
                let error = ((plus - minus) / (2.0 * step) - tangent.column(at)).amax() / tangent.amax();
                prop_assert!(error < 1e-6, "{at}: {error}");
            }
        }
    }
}
