//! The equations of a structure: the sum of its elements' responses, their tangent, its masses.

use nalgebra::Matrix3;

use super::sparse::{NOWHERE, Pattern, SparseError};
use super::structure::{Bias, State, Structure, Unknowns};
use crate::mechanics::element::beam::Beam;
use crate::mechanics::element::bushing::{Bushing, Gap};
use crate::mechanics::element::foot::{Contact, Grip};
use crate::mechanics::element::matrices::Local;

/// A structure, ready to be solved.
pub struct System {
    /// The structure.
    pub structure: Structure,
    /// Its unknowns.
    pub unknowns: Unknowns,
    /// Pattern of its matrices.
    pub pattern: Pattern,
    /// Place of each element's 12 by 12, and each foot's 6 by 6, entries in the values.
    slots: Vec<Vec<usize>>,
    diagonal: Vec<usize>,
}

/// The sum of the elements' responses.
#[derive(Clone, Debug, Default)]
pub struct Sum {
    /// Force of the unknowns on the elements and the ground.
    pub force: Vec<f64>,
    /// Lower triangle of the tangent's symmetric part.
    pub tangent: Vec<f64>,
    /// Contacts of the feet.
    pub contacts: Vec<Option<Contact>>,
}

impl Sum {
    /// No force on so many unknowns, and no contact.
    fn restart(&mut self, unknowns: usize) {
        self.force.clear();
        self.force.resize(unknowns, 0.0);
        self.contacts.clear();
    }
}

impl System {
    /// Numbers the unknowns.
    ///
    /// # Errors
    /// When the pattern is refused.
    pub fn new(structure: Structure) -> Result<Self, SparseError> {
        let unknowns = Unknowns::new(&structure.nodes);
        let pair = |nodes: [usize; 2]| nodes.iter().flat_map(|node| unknowns.of(*node)).collect::<Vec<_>>();
        let mut groups: Vec<Vec<usize>> = structure.beams.iter().map(|beam| pair(beam.nodes)).collect();
        groups.extend(structure.ties.iter().map(|tie| pair(tie.nodes)));
        groups.extend(structure.feet.iter().map(|foot| unknowns.of(foot.node).to_vec()));
        let pattern = Pattern::new(unknowns.size(), &groups)?;
        let places = |group: &Vec<usize>| {
            let pairs = group.iter().flat_map(|row| group.iter().map(move |column| (*row, *column)));
            // Each pair stands for an entry of the lower triangle once: where both orders fall on it, each brings half.
            pairs.map(|(row, column)| pattern.place(row, column)).collect()
        };
        let slots = groups.iter().map(places).collect();
        let diagonal = (0..unknowns.size()).map(|at| pattern.place(at, at)).collect();
        Ok(Self { structure, unknowns, pattern, slots, diagonal })
    }

    /// Everything where it is at rest.
    pub fn rest(&self) -> State {
        let nodes = &self.structure.nodes;
        State {
            places: nodes.iter().map(|node| node.place).collect(),
            turns: vec![Matrix3::identity(); nodes.len()],
            grips: self.structure.feet.iter().map(|foot| foot.at_rest(&nodes[foot.node].place)).collect(),
        }
    }

    /// Elastic elements without memory.
    pub fn elastic(&self) -> Bias {
        Bias { scale: 1.0, beams: vec![Local::zeros(); self.structure.beams.len()], ties: vec![Gap::zeros(); self.structure.ties.len()] }
    }

    /// Force and tangent of a state.
    pub fn assemble(&self, state: &State, bias: &Bias, sum: &mut Sum) {
        sum.restart(self.unknowns.size());
        sum.tangent.clear();
        sum.tangent.resize(self.pattern.values(), 0.0);
        let body = &self.structure;
        for (at, beam) in body.beams.iter().enumerate() {
            let (places, turns) = state.ends(beam.nodes);
            let response = beam.response(places, turns, self.scale(at, bias), &bias.beams[at]);
            self.add(at, &beam.nodes, response.force.as_slice(), response.tangent.as_slice(), sum);
        }
        for (number, tie) in body.ties.iter().enumerate() {
            let at = body.beams.len() + number;
            let (places, turns) = state.ends(tie.nodes);
            let (_, force, tangent) = tie.response(places, turns, self.scale(at, bias), &bias.ties[number]);
            self.add(at, &tie.nodes, force.as_slice(), tangent.as_slice(), sum);
        }
        for (number, foot) in body.feet.iter().enumerate() {
            let contact = foot.touch(&state.places[foot.node], &state.turns[foot.node], &state.grips[number]);
            if let Some(contact) = &contact {
                let at = body.beams.len() + body.ties.len() + number;
                self.add(at, &[foot.node], contact.force.as_slice(), contact.tangent.as_slice(), sum);
            }
            sum.contacts.push(contact);
        }
    }

    /// Force of a state alone; the tangent stays as it was.
    pub fn push(&self, state: &State, bias: &Bias, sum: &mut Sum) {
        sum.restart(self.unknowns.size());
        let body = &self.structure;
        for (at, beam) in body.beams.iter().enumerate() {
            let (places, turns) = state.ends(beam.nodes);
            self.add_force(&beam.nodes, beam.push(places, turns, self.scale(at, bias), &bias.beams[at]).as_slice(), sum);
        }
        for (number, tie) in body.ties.iter().enumerate() {
            let (places, turns) = state.ends(tie.nodes);
            let (_, force, _) = tie.response(places, turns, self.scale(body.beams.len() + number, bias), &bias.ties[number]);
            self.add_force(&tie.nodes, force.as_slice(), sum);
        }
        for (foot, grip) in body.feet.iter().zip(&state.grips) {
            let contact = foot.touch(&state.places[foot.node], &state.turns[foot.node], grip);
            if let Some(contact) = &contact {
                self.add_force(&[foot.node], contact.force.as_slice(), sum);
            }
            sum.contacts.push(contact);
        }
    }

    /// Factor on an element's elastic force; ties count after the beams.
    fn scale(&self, element: usize, bias: &Bias) -> f64 {
        if self.structure.viscous[element] { bias.scale } else { 1.0 }
    }

    fn add_force(&self, nodes: &[usize], force: &[f64], sum: &mut Sum) {
        for (block, node) in nodes.iter().enumerate() {
            for (at, unknown) in self.unknowns.of(*node).into_iter().enumerate() {
                if unknown != NOWHERE {
                    sum.force[unknown] += force[6 * block + at];
                }
            }
        }
    }

    fn add(&self, element: usize, nodes: &[usize], force: &[f64], tangent: &[f64], sum: &mut Sum) {
        self.add_force(nodes, force, sum);
        let size = force.len();
        let slots = &self.slots[element];
        for row in 0..size {
            let diagonal = slots[row * size + row];
            if diagonal != NOWHERE {
                sum.tangent[diagonal] += tangent[row * size + row];
            }
            for column in 0..row {
                let slot = slots[row * size + column];
                if slot != NOWHERE {
                    sum.tangent[slot] += 0.5 * (tangent[row * size + column] + tangent[column * size + row]);
                }
            }
        }
    }

    /// Adds to the diagonal of a matrix.
    pub fn add_diagonal(&self, values: &mut [f64], factor: f64, diagonal: &[f64]) {
        for (slot, value) in self.diagonal.iter().zip(diagonal) {
            values[*slot] += factor * value;
        }
    }

    /// Masses and moments of inertia of the unknowns.
    pub fn masses(&self) -> Vec<f64> {
        let mut masses = vec![0.0; self.unknowns.size()];
        for (node, own) in self.structure.nodes.iter().enumerate() {
            let values = [own.mass_g, own.mass_g, own.mass_g, own.inertia_g_mm2[0], own.inertia_g_mm2[1], own.inertia_g_mm2[2]];
            for (unknown, value) in self.unknowns.of(node).into_iter().zip(values).filter(|(unknown, _)| *unknown != NOWHERE) {
                masses[unknown] = value;
            }
        }
        masses
    }

    /// The contacts' places become those at which the feet stick.
    pub fn settle(&self, state: &mut State, sum: &Sum) {
        for (grip, contact) in state.grips.iter_mut().zip(&sum.contacts) {
            *grip = contact.as_ref().map_or(Grip::default(), |contact| contact.grip);
        }
    }

    /// Energy held by each beam, then each tie, when elastic, mJ.
    pub fn energies(&self, state: &State) -> Vec<f64> {
        let body = &self.structure;
        let of_beam = |beam: &Beam| {
            let (places, turns) = state.ends(beam.nodes);
            let local = beam.local(places, turns);
            0.5 * local.dot(&(beam.stiffness * local))
        };
        let of_tie = |tie: &Bushing| {
            let (places, turns) = state.ends(tie.nodes);
            let gap = tie.gap(places, turns);
            0.5 * gap.dot(&tie.stiffness().component_mul(&gap))
        };
        body.beams.iter().map(of_beam).chain(body.ties.iter().map(of_tie)).collect()
    }
}
