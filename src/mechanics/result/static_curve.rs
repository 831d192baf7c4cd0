//! The centre pressed down on level ground: force over displacement, and what happens inside.
//!
//! Solved on a quarter of the frame between its planes of symmetry; forces and energies are those of the whole frame. A path
//! that breaks the symmetry is not seen here.

use super::strength::{RodForce, ZoneState, rod_forces, zones};
use crate::mechanics::model::frame_model::FrameModel;
use crate::mechanics::model::model_error::ModelError;
use crate::mechanics::solve::statics::{Balance, Command, Path, Precision, StaticsError};
use crate::mechanics::system::sparse::SparseError;

/// How far the centre is pressed down unless somebody says otherwise, mm.
pub const DOWN_MM: f64 = 34.0;
/// Farthest that it is ever pressed down, mm.
pub const MOST_DOWN_MM: f64 = 60.0;
/// Displacements at which the inside is reported, mm.
pub const INSIDE_MM: [f64; 2] = [1.0, 16.0];

/// Why there is no curve.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CurveError {
    /// No model.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// No equilibrium.
    #[error("no equilibrium was found with the centre pressed down by {down_mm:.3} mm")]
    Lost {
        /// How far.
        down_mm: f64,
    },
    /// The tangent is singular.
    #[error(transparent)]
    Sparse(#[from] SparseError),
}

/// A point of the curve.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct CurvePoint {
    /// The centre's way down, mm.
    pub displacement_mm: f64,
    /// Force on it, N.
    pub force_n: f64,
    /// Iterations it took.
    pub iterations: usize,
    /// Directions in which the frame would give way under a dead load.
    pub unstable: usize,
}

/// What a displacement does inside.
#[derive(Clone, Debug, PartialEq)]
pub struct Inside {
    /// The displacement, mm.
    pub displacement_mm: f64,
    /// Energy, mJ, and largest strain, zone by zone, the most energy first.
    pub zones: Vec<ZoneState>,
    /// The most loaded rod of each role.
    pub rods: Vec<RodForce>,
}

/// The curve.
#[derive(Clone, Debug)]
pub struct StaticCurve {
    /// Its points, from (0, 0).
    pub points: Vec<CurvePoint>,
    /// What the displacements do inside that were asked for.
    pub inside: Vec<Inside>,
    /// The state at the largest displacement, and the displacements of `inside`, for pictures.
    pub states: Vec<(f64, crate::mechanics::system::structure::State)>,
}

/// Displacement at which the initial stiffness is taken, mm.
const SMALL_MM: f64 = 0.05;

/// Displacements of the curve, mm: steps of a millimetre, of two beyond 20 mm, and at least four of them.
fn grid(to_mm: f64) -> Vec<f64> {
    let step_mm = f64::min(1.0, 0.25 * to_mm);
    let mut all = vec![SMALL_MM];
    let mut at = step_mm;
    while at < to_mm - 1e-9 {
        all.push(at);
        at += if at < 20.0 - 1e-9 { step_mm } else { 2.0 };
    }
    all.push(to_mm);
    all
}

impl StaticCurve {
    /// Presses a frame down to a displacement, mm; tells what happens inside at some of the displacements on the way.
    ///
    /// # Errors
    /// When no equilibrium is found.
    pub fn new(model: &FrameModel, to_mm: f64, inside_mm: &[f64]) -> Result<Self, CurveError> {
        let copies = model.extent.copies();
        let unknown = model.system.unknowns.of(model.hub)[2];
        let mut load = vec![0.0; model.system.unknowns.size()];
        load[unknown] = -1.0;
        let usual = Precision::default();
        let precision = Precision { absolute_n: model.link_factor * usual.absolute_n, ..usual };
        let mut path = Path::new(&model.system, Command { load, unknown }, model.system.rest(), precision);
        let mut curve = Self {
            points: vec![CurvePoint { displacement_mm: 0.0, force_n: 0.0, iterations: 0, unstable: 0 }],
            inside: Vec::new(),
            states: Vec::new(),
        };
        let mut wanted = grid(to_mm);
        wanted.extend(inside_mm.iter().copied().filter(|d| *d > SMALL_MM && *d < to_mm));
        wanted.sort_by(f64::total_cmp);
        wanted.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
        for displacement_mm in wanted {
            let Balance { load, state, iterations, unstable, .. } = match path.go(-displacement_mm) {
                Ok(balance) => balance,
                // The curve ends where the frame has snapped through in a way that this displacement does not command.
                Err(_) if curve.points.len() > 8 => break,
                Err(StaticsError::Sparse(error)) => return Err(error.into()),
                Err(StaticsError::Lost { displacement }) => return Err(CurveError::Lost { down_mm: -displacement }),
            };
            curve.points.push(CurvePoint { displacement_mm, force_n: load * copies, iterations: *iterations, unstable: *unstable });
            let last = (displacement_mm - to_mm).abs() < 1e-9;
            if last || inside_mm.iter().any(|d| (d - displacement_mm).abs() < 1e-9) {
                let (zones, rods) = (zones(model, state, &model.system.energies(state)), rod_forces(model, state));
                curve.inside.push(Inside { displacement_mm, zones, rods });
                curve.states.push((displacement_mm, state.clone()));
            }
        }
        Ok(curve)
    }

    /// Stiffness at rest, N/mm.
    pub fn initial_n_mm(&self) -> f64 {
        self.points.get(1).map_or(0.0, |point| point.force_n / point.displacement_mm)
    }

    /// Force at a displacement, N: by the cubic through the four points around it. `None` beyond the curve.
    pub fn force_n(&self, displacement_mm: f64) -> Option<f64> {
        let last = self.points.last()?;
        if !(0.0..=last.displacement_mm + 1e-9).contains(&displacement_mm) || self.points.len() < 4 {
            return None;
        }
        let after = self.points.iter().position(|p| p.displacement_mm >= displacement_mm - 1e-12)?;
        let first = after.saturating_sub(2).min(self.points.len() - 4);
        let four = &self.points[first..first + 4];
        let basis = |at: usize| -> f64 {
            let others = (0..4).filter(|other| *other != at);
            others.map(|o| (displacement_mm - four[o].displacement_mm) / (four[at].displacement_mm - four[o].displacement_mm)).product()
        };
        Some((0..4).map(|at| basis(at) * four[at].force_n).sum())
    }

    /// Secant stiffness, N/mm.
    pub fn secant_n_mm(&self, displacement_mm: f64) -> Option<f64> {
        self.force_n(displacement_mm).map(|force_n| force_n / displacement_mm)
    }

    /// The first displacement at which the force is largest, and that force; `None` when it still grows.
    pub fn limit(&self) -> Option<[f64; 2]> {
        let at = (1..self.points.len().saturating_sub(1))
            .find(|at| self.points[*at].force_n >= self.points[at - 1].force_n && self.points[*at].force_n > self.points[at + 1].force_n)?;
        let [a, b, c] = [at - 1, at, at + 1].map(|i| (self.points[i].displacement_mm, self.points[i].force_n));
        // The parabola through the three.
        let (s, t) = ((b.1 - a.1) / (b.0 - a.0), (c.1 - b.1) / (c.0 - b.0));
        let curvature = (t - s) / (c.0 - a.0);
        let x = 0.5 * (a.0 + b.0) - 0.5 * s / curvature;
        Some([x, a.1 + s * (x - a.0) + curvature * (x - a.0) * (x - b.0)])
    }
}
