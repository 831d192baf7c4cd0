//! Small vibrations of the frame on held feet: frequencies, shapes, and how much mass each moves up and down.
//!
//! Subspace iteration (K.-J. Bathe, *Finite Element Procedures*, ch. 11) on the tangent at rest. The modulus is that at rest;
//! in an impact frequencies are higher by the root of what relaxation gives back.

use nalgebra::{DMatrix, SymmetricEigen};

use crate::mechanics::model::frame_model::FrameModel;
use crate::mechanics::model::model_error::ModelError;
use crate::mechanics::system::equation_system::{Sum, System};
use crate::mechanics::system::sparse::{NOWHERE, SparseError};
use crate::mechanics::system::structure::State;

/// Modes that are reported.
pub const REPORTED: usize = 8;

/// A mode.
#[derive(Clone, Debug, serde::Serialize)]
pub struct Mode {
    /// Frequency, Hz.
    pub frequency_hz: f64,
    /// Effective mass up and down over the mass that can move.
    pub share_up: f64,
    /// Displacements and spins of the unknowns, modal mass 1 g.
    #[serde(skip)]
    pub shape: Vec<f64>,
}

/// Modes of a frame.
pub struct Modes {
    /// The frame on held feet.
    pub system: System,
    /// The lowest, in order.
    pub modes: Vec<Mode>,
}

/// Vectors beyond those asked for.
const SPARE: usize = 8;
/// Most rounds.
const ROUNDS: usize = 40;
/// Change of a frequency's square at which it is settled.
const SETTLED: f64 = 1e-8;

impl Modes {
    /// The lowest modes.
    ///
    /// # Errors
    /// When something can move without resistance.
    pub fn new(model: &FrameModel, count: usize) -> Result<Self, ModelError> {
        let mut structure = model.system.structure.clone();
        for foot in std::mem::take(&mut structure.feet) {
            structure.nodes[foot.node].held[..3].fill(true);
        }
        let system = System::new(structure)?;
        let modes = lowest(&system, count)?;
        Ok(Self { system, modes })
    }

    /// The frame in a mode, its largest displacement so many mm.
    pub fn state(&self, mode: &Mode, largest_mm: f64) -> State {
        let unknowns = &self.system.unknowns;
        let nodes = 0..self.system.structure.nodes.len();
        let far = |node: usize| (0..3).map(|i| unknowns.of(node)[i]).filter(|u| *u != NOWHERE).map(|u| mode.shape[u].powi(2)).sum::<f64>();
        let largest = nodes.map(far).fold(0.0, f64::max).sqrt();
        let by: Vec<f64> = mode.shape.iter().map(|x| x * largest_mm / largest.max(1e-12)).collect();
        let mut state = self.system.rest();
        state.moved(unknowns, &by);
        state
    }
}

/// Numbers without pattern to start from, always the same.
fn start(size: usize, column: usize) -> Vec<f64> {
    let mut seed = 0x9E37_79B9_7F4A_7C15_u64.wrapping_mul(column as u64 + 1);
    let next = |_| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) as f64 / (1_u64 << 31) as f64 - 0.5
    };
    (0..size).map(next).collect()
}

fn lowest(system: &System, count: usize) -> Result<Vec<Mode>, SparseError> {
    let size = system.unknowns.size();
    let masses = system.masses();
    let (mut sum, mut work) = (Sum::default(), system.pattern.work());
    system.assemble(&system.rest(), &system.elastic(), &mut sum);
    system.pattern.factorise(&sum.tangent, &mut work)?;
    let width = (count + SPARE).min(size);
    let mut vectors: Vec<Vec<f64>> = (0..width).map(|column| start(size, column)).collect();
    let mut last = vec![0.0; width];
    for _ in 0..ROUNDS {
        let loads: Vec<Vec<f64>> = vectors.iter().map(|x| x.iter().zip(&masses).map(|(x, m)| x * m).collect()).collect();
        let solved: Vec<Vec<f64>> = loads
            .iter()
            .map(|load| {
                let mut x = load.clone();
                system.pattern.solve(&mut work, &mut x);
                x
            })
            .collect();
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let stiffness = DMatrix::from_fn(width, width, |i, j| dot(&solved[i], &loads[j]));
        let weighted: Vec<Vec<f64>> = solved.iter().map(|x| x.iter().zip(&masses).map(|(x, m)| x * m).collect()).collect();
        let mass = DMatrix::from_fn(width, width, |i, j| dot(&solved[i], &weighted[j]));
        let Some((squares, turn)) = reduced(&stiffness, &mass) else { return Err(SparseError::Singular) };
        vectors = (0..width)
            .map(|j| {
                let mut x = vec![0.0; size];
                for (i, solved) in solved.iter().enumerate() {
                    x.iter_mut().zip(solved).for_each(|(x, s)| *x += turn[(i, j)] * s);
                }
                x
            })
            .collect();
        let settled = squares.iter().zip(&last).take(count).all(|(new, old)| (new - old).abs() < SETTLED * new);
        last = squares;
        if settled {
            break;
        }
    }
    Ok((0..count.min(width)).map(|at| mode(system, &masses, last[at], &vectors[at])).collect())
}

/// Squares of circular frequencies in order, and the vectors, of a small pair of matrices.
fn reduced(stiffness: &DMatrix<f64>, mass: &DMatrix<f64>) -> Option<(Vec<f64>, DMatrix<f64>)> {
    let lower = ((mass + mass.transpose()) * 0.5).cholesky()?.l();
    let inverse = lower.clone().try_inverse()?;
    let standard = &inverse * (stiffness + stiffness.transpose()) * 0.5 * inverse.transpose();
    let eigen = SymmetricEigen::new(standard);
    let mut order: Vec<usize> = (0..eigen.eigenvalues.len()).collect();
    order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
    let vectors = inverse.transpose() * DMatrix::from_fn(order.len(), order.len(), |i, j| eigen.eigenvectors[(i, order[j])]);
    Some((order.iter().map(|at| eigen.eigenvalues[*at]).collect(), vectors))
}

fn mode(system: &System, masses: &[f64], square: f64, shape: &[f64]) -> Mode {
    let (mut all, mut part, mut modal) = (0.0, 0.0, 0.0);
    for node in 0..system.structure.nodes.len() {
        let z = system.unknowns.of(node)[2];
        if z != NOWHERE {
            all += masses[z];
            part += masses[z] * shape[z];
        }
    }
    for (x, m) in shape.iter().zip(masses) {
        modal += m * x * x;
    }
    // 1/ms to Hz.
    let frequency_hz = square.max(0.0).sqrt() / std::f64::consts::TAU * 1e3;
    let scale = 1.0 / modal.sqrt();
    Mode { frequency_hz, share_up: part * part / (modal * all), shape: shape.iter().map(|x| x * scale).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::element::beam::{Beam, Rigidity};
    use crate::mechanics::system::structure::{Node, Structure};
    use nalgebra::Vector3;

    /// Slender cantilever: ω = (β L)² √(EI / (ρA L⁴)), β L = 1.875104, 4.694091, 7.854757.
    #[test]
    fn analytic_a_cantilever_vibrates_as_euler_and_bernoulli_say_and_refinement_helps() {
        let (length, bending, line) = (100.0, [2e5, 6e5], 0.02);
        let frequencies = |elements: usize| {
            let rigidity = Rigidity { axial_n: 1e7, shear_n: [1e9; 2], torsion_n_mm2: 1e9, bending_n_mm2: bending };
            let point = |at: usize| Vector3::new(length * at as f64 / elements as f64, 0.0, 0.0);
            let mut nodes: Vec<Node> = (0..=elements).map(|at| Node::at(point(at))).collect();
            nodes[0].held = [true; 6];
            for (at, node) in nodes.iter_mut().enumerate() {
                node.mass_g = line * length / elements as f64 * if at == elements { 0.5 } else { 1.0 };
                node.inertia_g_mm2 = [1e-3; 3];
            }
            let beam = |at: usize| Beam::new([at - 1, at], [point(at - 1), point(at)], Vector3::y(), &rigidity).expect("has a length");
            let beams: Vec<Beam> = (1..=elements).map(beam).collect();
            let structure = Structure { nodes, viscous: vec![false; beams.len()], beams, ..Structure::default() };
            lowest(&System::new(structure).expect("is a system"), 4).expect("is held").iter().map(|m| m.frequency_hz).collect::<Vec<_>>()
        };
        let exact = |root: f64, bending: f64| root * root * (bending / (line * length.powi(4))).sqrt() / std::f64::consts::TAU * 1e3;
        let wanted = [exact(1.875104, 2e5), exact(1.875104, 6e5), exact(4.694091, 2e5), exact(4.694091, 6e5)];
        let error = |elements: usize| frequencies(elements).iter().zip(wanted).map(|(f, w)| (f / w - 1.0).abs()).fold(0.0, f64::max);
        let [coarse, fine] = [error(10), error(40)];
        assert!(fine < 1.5e-3 && fine < 0.1 * coarse, "{coarse} {fine} {:?} {wanted:?}", frequencies(40));
    }
}
