//! What viscoelastic elements remember from step to step, and the energies that they hold and lose.

use super::dynamics::TimeIntegration;
use crate::mechanics::element::bushing::Gap;
use crate::mechanics::element::matrices::Local;
use crate::mechanics::element::relaxation::Relaxation;
use crate::mechanics::system::structure::Bias;

/// Energies of the whole structure, mJ.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct Energies {
    /// Of motion.
    pub kinetic_mj: f64,
    /// In springs, relaxing ones included, and in the feet's skin.
    pub stored_mj: f64,
    /// Lost in relaxing branches.
    pub relaxed_mj: f64,
    /// Lost by sliding feet.
    pub friction_mj: f64,
    /// Given by gravity.
    pub gravity_mj: f64,
}

impl Energies {
    /// Those of so many such structures.
    #[must_use]
    pub fn times(self, count: f64) -> Self {
        Self {
            kinetic_mj: self.kinetic_mj * count,
            stored_mj: self.stored_mj * count,
            relaxed_mj: self.relaxed_mj * count,
            friction_mj: self.friction_mj * count,
            gravity_mj: self.gravity_mj * count,
        }
    }
}

impl TimeIntegration<'_> {
    /// What the branches bring into a step.
    pub(in crate::mechanics) fn bias(&self, dt: f64) -> Bias {
        let steps: Vec<[f64; 2]> = self.relaxation.branches.iter().map(|branch| Relaxation::step(branch, dt)).collect();
        let shares: Vec<f64> = self.relaxation.branches.iter().map(|branch| branch.share).collect();
        let structure = &self.system.structure;
        let mut bias = self.system.elastic();
        bias.scale = self.relaxation.scale(dt);
        for (at, beam) in structure.beams.iter().enumerate().filter(|(at, _)| structure.viscous[*at]) {
            let own = &self.beams[at];
            let sum: Local = (0..steps.len()).map(|b| (own[b + 1] * steps[b][0] - own[0] * steps[b][1]) * shares[b]).sum();
            bias.beams[at] = beam.stiffness * sum;
        }
        for (at, tie) in structure.ties.iter().enumerate().filter(|(at, _)| structure.viscous[structure.beams.len() + *at]) {
            let own = &self.ties[at];
            let sum: Gap = (0..steps.len()).map(|b| (own[b + 1] * steps[b][0] - own[0] * steps[b][1]) * shares[b]).sum();
            bias.ties[at] = tie.stiffness().component_mul(&sum);
        }
        bias
    }

    /// Branches stretch with the step and relax; what they lose is counted.
    pub(in crate::mechanics) fn relax(&mut self, dt: f64) {
        let structure = &self.system.structure;
        let branches = self.relaxation.branches.clone();
        for (at, beam) in structure.beams.iter().enumerate() {
            let local = beam.local(beam.nodes.map(|n| self.state.places[n]), beam.nodes.map(|n| &self.state.turns[n]));
            let by = local - self.beams[at][0];
            self.beams[at][0] = local;
            if structure.viscous[at] {
                for (branch, own) in branches.iter().zip(self.beams[at].iter_mut().skip(1)) {
                    let [kept, taken] = Relaxation::step(branch, dt);
                    let after = *own * kept + by * taken;
                    let (before_mj, after_mj) = (own.dot(&(beam.stiffness * *own)), after.dot(&(beam.stiffness * after)));
                    let work = 0.5 * (*own + after).dot(&(beam.stiffness * by));
                    self.lost_mj[at] += branch.share * (work - 0.5 * (after_mj - before_mj));
                    *own = after;
                }
            }
        }
        let first = structure.beams.len();
        for (at, tie) in structure.ties.iter().enumerate() {
            let local = tie.gap(tie.nodes.map(|n| self.state.places[n]), tie.nodes.map(|n| &self.state.turns[n]));
            let by = local - self.ties[at][0];
            self.ties[at][0] = local;
            if structure.viscous[first + at] {
                let k = tie.stiffness();
                for (branch, own) in branches.iter().zip(self.ties[at].iter_mut().skip(1)) {
                    let [kept, taken] = Relaxation::step(branch, dt);
                    let after = *own * kept + by * taken;
                    let (before_mj, after_mj) = (own.dot(&k.component_mul(own)), after.dot(&k.component_mul(&after)));
                    let work = 0.5 * (*own + after).dot(&k.component_mul(&by));
                    self.lost_mj[first + at] += branch.share * (work - 0.5 * (after_mj - before_mj));
                    *own = after;
                }
            }
        }
    }

    /// Energy stored in each beam, then each tie, mJ.
    pub fn stored(&self) -> Vec<f64> {
        let structure = &self.system.structure;
        let shares: Vec<f64> = self.relaxation.branches.iter().map(|branch| branch.share).collect();
        let lasting = |viscous: bool| if viscous { self.relaxation.lasting } else { 1.0 };
        let beams = structure.beams.iter().enumerate().map(|(at, beam)| {
            let of = |p: &Local| 0.5 * p.dot(&(beam.stiffness * p));
            let own = &self.beams[at];
            lasting(structure.viscous[at]) * of(&own[0]) + shares.iter().zip(&own[1..]).map(|(share, p)| share * of(p)).sum::<f64>()
        });
        let first = structure.beams.len();
        let ties = structure.ties.iter().enumerate().map(|(at, tie)| {
            let k = tie.stiffness();
            let of = |p: &Gap| 0.5 * p.dot(&k.component_mul(p));
            let own = &self.ties[at];
            lasting(structure.viscous[first + at]) * of(&own[0]) + shares.iter().zip(&own[1..]).map(|(share, p)| share * of(p)).sum::<f64>()
        });
        beams.chain(ties).collect()
    }

    /// All energies.
    pub fn energies(&self) -> Energies {
        let kinetic_mj = 0.5 * self.masses.iter().zip(&self.velocity).map(|(m, v)| m * v * v).sum::<f64>();
        let feet = self.system.structure.feet.iter().zip(&self.sum.contacts);
        let skin: f64 = feet
            .filter_map(|(foot, contact)| {
                let contact = contact.as_ref()?;
                let side = contact.force[0] * contact.force[0] + contact.force[1] * contact.force[1];
                Some(0.5 * (contact.normal_n * contact.normal_n + side) / foot.stiffness_n_mm)
            })
            .sum();
        Energies {
            kinetic_mj,
            stored_mj: self.stored().iter().sum::<f64>() + skin,
            relaxed_mj: self.lost_mj.iter().sum(),
            friction_mj: self.friction_mj,
            gravity_mj: self.gravity_mj,
        }
    }
}
