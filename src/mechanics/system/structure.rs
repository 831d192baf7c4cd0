//! Nodes, beams, ties and feet, and the sum of their responses.
//!
//! Millimetre, newton, gram, millisecond, which go together: 1 g mm/ms² = 1 N, stresses in MPa, energies in mJ.

use nalgebra::{Matrix3, Vector3};

use super::sparse::NOWHERE;
use crate::mechanics::element::beam::Beam;
use crate::mechanics::element::bushing::{Bushing, Gap};
use crate::mechanics::element::foot::{Foot, Grip};
use crate::mechanics::element::matrices::Local;
use crate::mechanics::element::rotation::exp;

/// A node at rest.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// Where, mm.
    pub place: Vector3<f64>,
    /// Which displacements and spins are held: x, y, z of each.
    pub held: [bool; 6],
    /// Mass, g.
    pub mass_g: f64,
    /// Moments of inertia about its axes, g mm².
    pub inertia_g_mm2: [f64; 3],
}

impl Node {
    /// A free node without mass.
    pub fn at(place: Vector3<f64>) -> Self {
        Self { place, held: [false; 6], mass_g: 0.0, inertia_g_mm2: [0.0; 3] }
    }
}

/// A body of elastic elements.
#[derive(Clone, Debug, Default)]
pub struct Structure {
    /// Nodes.
    pub nodes: Vec<Node>,
    /// Beams.
    pub beams: Vec<Beam>,
    /// Ties.
    pub ties: Vec<Bushing>,
    /// Feet.
    pub feet: Vec<Foot>,
    /// Which beams and ties, in this order, are viscoelastic.
    pub viscous: Vec<bool>,
}

/// Where the nodes are.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// Places, mm.
    pub places: Vec<Vector3<f64>>,
    /// Turns since rest.
    pub turns: Vec<Matrix3<f64>>,
    /// Where the feet stick.
    pub grips: Vec<Grip>,
}

impl State {
    /// Places and turns of an element's two nodes.
    pub fn ends(&self, nodes: [usize; 2]) -> ([Vector3<f64>; 2], [&Matrix3<f64>; 2]) {
        (nodes.map(|node| self.places[node]), nodes.map(|node| &self.turns[node]))
    }

    /// Moves free unknowns by displacements and spins.
    pub fn moved(&mut self, map: &Unknowns, by: &[f64]) {
        for node in 0..self.places.len() {
            let of = map.of(node);
            let value = |at: usize| if of[at] == NOWHERE { 0.0 } else { by[of[at]] };
            self.places[node] += Vector3::new(value(0), value(1), value(2));
            let spin = Vector3::new(value(3), value(4), value(5));
            if spin != Vector3::zeros() {
                self.turns[node] = exp(&spin) * self.turns[node];
            }
        }
    }
}

/// What viscoelastic elements remember, for the forces of one step.
#[derive(Clone, Debug)]
pub struct Bias {
    /// Factor on the elastic force of viscous elements.
    pub scale: f64,
    /// Force on top, beams then ties.
    pub beams: Vec<Local>,
    /// The same of the ties.
    pub ties: Vec<Gap>,
}

/// Which unknown each displacement and spin is.
#[derive(Clone, Debug)]
pub struct Unknowns {
    of_nodes: Vec<[usize; 6]>,
    size: usize,
}

impl Unknowns {
    pub(in crate::mechanics) fn new(nodes: &[Node]) -> Self {
        let mut size = 0;
        let mut number = |held: bool| {
            if held {
                return NOWHERE;
            }
            size += 1;
            size - 1
        };
        let of_nodes = nodes.iter().map(|node| node.held.map(&mut number)).collect();
        Self { of_nodes, size }
    }

    /// Those of a node.
    pub fn of(&self, node: usize) -> [usize; 6] {
        self.of_nodes[node]
    }

    /// How many.
    pub fn size(&self) -> usize {
        self.size
    }
}
