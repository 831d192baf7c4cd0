//! A point of a node on the ground: it pushes, never pulls, and holds sideways by friction.
//!
//! Normal force N = k max(0, depth). Sideways it sticks to a place by a spring of the same stiffness until that pulls with
//! μ N, then the place is dragged along (Coulomb's law with elastic sticking, as in plasticity: J. C. Simo, T. J. R. Hughes,
//! *Computational Inelasticity*, ch. 2). The tangent leaves out that the limit changes with N, which would make it
//! unsymmetric; iterations take a little longer for it.

use nalgebra::{Matrix3, SMatrix, SVector, Vector3};

use super::rotation::skew;

/// A foot.
#[derive(Clone, Debug)]
pub struct Foot {
    /// Its node.
    pub node: usize,
    /// From the node to the point that touches, at rest, mm.
    pub arm: Vector3<f64>,
    /// Height of the ground, mm.
    pub ground_mm: f64,
    /// k, N/mm.
    pub stiffness_n_mm: f64,
    /// μ.
    pub friction: f64,
}

/// Where a foot sticks to the ground.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Grip {
    /// The place, mm; none in the air.
    pub place: Option<[f64; 2]>,
}

/// What the ground does.
#[derive(Clone, Debug)]
pub struct Contact {
    /// Force of the node on the ground, and its moment about the node: N, N mm.
    pub force: SVector<f64, 6>,
    /// Its tangent.
    pub tangent: SMatrix<f64, 6, 6>,
    /// Where it sticks after this.
    pub grip: Grip,
    /// Normal force, N.
    pub normal_n: f64,
    /// How far it slid, mm.
    pub slid_mm: f64,
}

impl Foot {
    /// Where it sticks when its node is at rest: there, when it touches.
    pub fn at_rest(&self, node: &Vector3<f64>) -> Grip {
        let at = node + self.arm;
        Grip { place: (at.z < self.ground_mm).then_some([at.x, at.y]) }
    }

    /// The ground's part at a place and turn of the node; `None` in the air.
    pub fn touch(&self, place: &Vector3<f64>, turn: &Matrix3<f64>, grip: &Grip) -> Option<Contact> {
        let arm = turn * self.arm;
        let at = place + arm;
        let depth = self.ground_mm - at.z;
        if depth <= 0.0 {
            return None;
        }
        let k = self.stiffness_n_mm;
        let normal_n = k * depth;
        let start = grip.place.unwrap_or([at.x, at.y]);
        let off = [at.x - start[0], at.y - start[1]];
        let (pull, limit) = (k * libm::hypot(off[0], off[1]), self.friction * normal_n);
        // What is left of the pull, and what is left of its stiffness across and along the slip.
        let share = if pull > limit { limit / pull } else { 1.0 };
        let side = [k * off[0] * share, k * off[1] * share];
        let kept = [at.x - off[0] * share, at.y - off[1] * share];
        // At first touch there is no place yet to be pulled back to.
        let held = if grip.place.is_some() { k * share } else { 0.0 };
        let mut stiff = Matrix3::from_diagonal(&Vector3::new(held, held, k));
        if pull > limit {
            let along = Vector3::new(off[0], off[1], 0.0) * (k / pull);
            stiff -= along * along.transpose() * (k * share);
        }
        let force = Vector3::new(side[0], side[1], -normal_n);
        let lever = skew(&arm);
        let mut tangent = SMatrix::<f64, 6, 6>::zeros();
        tangent.fixed_view_mut::<3, 3>(0, 0).copy_from(&stiff);
        tangent.fixed_view_mut::<3, 3>(0, 3).copy_from(&(-stiff * lever));
        tangent.fixed_view_mut::<3, 3>(3, 0).copy_from(&(lever * stiff));
        tangent.fixed_view_mut::<3, 3>(3, 3).copy_from(&(-lever * stiff * lever + skew(&force) * lever));
        let moment = arm.cross(&force);
        let force = SVector::<f64, 6>::from_column_slice(&[force.x, force.y, force.z, moment.x, moment.y, moment.z]);
        let slid_mm = libm::hypot(off[0], off[1]) * (1.0 - share);
        Some(Contact { force, tangent, grip: Grip { place: Some([at.x - (at.x - kept[0]), at.y - (at.y - kept[1])]) }, normal_n, slid_mm })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_a_foot_pushes_sticks_and_slides() {
        let foot = Foot { node: 0, arm: Vector3::new(0.0, 0.0, -2.0), ground_mm: 0.0, stiffness_n_mm: 100.0, friction: 0.5 };
        let one = Matrix3::identity();
        assert!(foot.touch(&Vector3::new(0.0, 0.0, 2.1), &one, &Grip::default()).is_none());
        let first = foot.touch(&Vector3::new(1.0, 0.0, 1.9), &one, &Grip::default()).expect("touches");
        assert!((first.normal_n - 10.0).abs() < 1e-12 && first.force[0] == 0.0 && (first.force[2] + 10.0).abs() < 1e-12);
        let held = foot.touch(&Vector3::new(1.04, 0.0, 1.9), &one, &first.grip).expect("touches");
        assert!((held.force[0] - 4.0).abs() < 1e-9 && held.slid_mm == 0.0 && (held.force[4] + 8.0).abs() < 1e-9);
        let slid = foot.touch(&Vector3::new(1.3, 0.0, 1.9), &one, &first.grip).expect("touches");
        assert!((slid.force[0] - 5.0).abs() < 1e-9, "{slid:?}");
        let kept = slid.grip.place.expect("sticks");
        assert!((kept[0] - 1.25).abs() < 1e-12 && (slid.slid_mm - 0.25).abs() < 1e-12);
    }

    #[test]
    fn analytic_the_tangent_is_the_forces_derivative_while_it_sticks() {
        let foot = Foot { node: 0, arm: Vector3::new(0.4, 0.3, -2.0), ground_mm: 0.0, stiffness_n_mm: 100.0, friction: 0.9 };
        let grip = Grip { place: Some([0.35, 0.31]) };
        let turn = super::super::rotation::exp(&Vector3::new(0.02, -0.03, 0.1));
        let at = |by: &SVector<f64, 6>| {
            let spin = by.fixed_rows::<3>(3).into_owned();
            let place = Vector3::new(0.0, 0.0, 1.8) + by.fixed_rows::<3>(0);
            foot.touch(&place, &(super::super::rotation::exp(&spin) * turn), &grip).expect("touches")
        };
        let tangent = at(&SVector::zeros()).tangent;
        for column in 0..6 {
            let step = SVector::<f64, 6>::from_fn(|i, _| if i == column { 1e-6 } else { 0.0 });
            let slope = (at(&step).force - at(&-step).force) / 2e-6;
            assert!((slope - tangent.column(column)).amax() < 1e-6 * tangent.amax(), "{column}");
        }
    }
}
