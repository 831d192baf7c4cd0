//! The rigid centre's bodies above the ground: which of them hits it in an impact, and when.
//!
//! The centre moves as one body, with battery and boards. *When it is wrong:* what is soft of it, and what hangs out of it, is as stiff as the rest;
//! the impact goes on as if the ground were not there.

use nalgebra::{Matrix3, Vector3};

use super::impact::Impact;
use crate::frame::assembly::Design;
use crate::mechanics::model::frame_model::FrameModel;
use crate::solid::MeshSolid;

/// The corners of the centre's bodies that can be lowest, and the ground.
#[derive(Clone, Debug)]
pub struct Underside {
    /// From the centre's node at rest, mm, in the frame's axes.
    corners: Vec<Vector3<f64>>,
    /// Height of the ground in the frame's axes, mm.
    ground_mm: f64,
    /// From the ground up to the lowest corner when the frame stands level, mm.
    pub gap_mm: f64,
}

/// When the centre first reaches the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reached {
    /// Since first touch, ms.
    pub at_ms: f64,
    /// Speed downwards of the corner that reaches it, m/s.
    pub speed_m_s: f64,
}

/// Where a descent passes a way down, mm: between which moments, as a number of theirs with a fraction, and how fast, m/s. One that begins there or beyond
/// passes it at once.
pub(super) fn passes(descent: &[[f64; 2]], down_mm: f64) -> Option<(f64, f64)> {
    if let Some([_, speed]) = descent.first().filter(|[way_mm, _]| *way_mm >= down_mm) {
        return Some((0.0, *speed));
    }
    let at = descent.windows(2).position(|pair| pair[0][0] < down_mm && pair[1][0] >= down_mm)?;
    let [[before_mm, before], [behind_mm, behind]] = [descent[at], descent[at + 1]];
    let share = (down_mm - before_mm) / (behind_mm - before_mm);
    Some((at as f64 + share, before + share * (behind - before)))
}

impl Underside {
    /// Of a design whose lowest body is `gap_mm` above the ground when it stands level.
    pub fn of(design: &Design, model: &FrameModel, gap_mm: f64) -> Self {
        let hub = model.system.rest().places[model.hub];
        let centre = design.bodies.iter().filter(|body| body.module.is_none());
        let all: Vec<_> =
            centre.flat_map(|body| design.shape(body).mesh.placed(&body.pose).vertices).map(|v| v.map(f64::from).into()).collect();
        // Only corners of the hull can be lowest, however it is turned.
        let hull = MeshSolid::hull_of(&all).mesh().vertices;
        let corners: Vec<Vector3<f64>> = hull.into_iter().map(|v| Vector3::from(v.map(f64::from)) - hub).collect();
        let lowest_mm = corners.iter().map(|corner| corner.z).fold(f64::INFINITY, f64::min);
        Self { corners, ground_mm: hub.z + lowest_mm - gap_mm, gap_mm }
    }

    /// Height above the ground of the lowest corner, mm, the centre being at a place and turned; negative below the ground.
    pub fn height_mm(&self, (place, turn): &(Vector3<f64>, Matrix3<f64>)) -> f64 {
        let below = turn.row(2);
        place.z - self.ground_mm + self.corners.iter().map(|corner| (below * corner).x).fold(f64::INFINITY, f64::min)
    }

    /// When the centre first reaches the ground in an impact; `None` where it does not. One that hangs lower than the feet, or is turned so far that
    /// it comes first, reaches it with them.
    pub fn reached(&self, impact: &Impact) -> Option<Reached> {
        let (at, speed_m_s) = passes(&self.descent(impact), self.height_mm(impact.centre.first()?))?;
        let [before, behind] = [at.floor(), at.ceil()].map(|at| impact.moments[at as usize].t_ms);
        Some(Reached { at_ms: before + (at - at.floor()) * (behind - before), speed_m_s })
    }

    /// How far the lowest corner has come down since first touch, mm, and its speed downwards, m/s, through an impact.
    pub fn descent(&self, impact: &Impact) -> Vec<[f64; 2]> {
        let heights_mm: Vec<f64> = impact.centre.iter().map(|centre| self.height_mm(centre)).collect();
        let t_ms: Vec<f64> = impact.moments.iter().map(|moment| moment.t_ms).collect();
        let last = heights_mm.len().min(t_ms.len()).saturating_sub(1);
        // mm/ms are m/s.
        let speed_m_s = |at: usize| match (at.saturating_sub(1), (at + 1).min(last)) {
            _ if at == 0 => impact.speed_m_s,
            (before, after) => (heights_mm[before] - heights_mm[after]) / (t_ms[after] - t_ms[before]),
        };
        (0..=last).map(|at| [heights_mm[0] - heights_mm[at], speed_m_s(at)]).collect()
    }

    /// The least height above the ground in an impact, mm.
    pub fn least_mm(&self, impact: &Impact) -> f64 {
        impact.centre.iter().map(|centre| self.height_mm(centre)).fold(f64::INFINITY, f64::min)
    }
}
