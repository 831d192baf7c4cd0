//! What a state of the frame asks of its parts: energy, strain, forces in the rods against buckling.

use std::collections::BTreeMap;

use crate::frame::skeleton::RodRole;
use crate::mechanics::model::frame_model::{FrameModel, LINKS};
use crate::mechanics::system::structure::State;

/// A zone's share.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct ZoneState {
    /// Its name.
    pub zone: &'static str,
    /// Energy in it, all four modules together, mJ.
    pub energy_mj: f64,
    /// Its share of all the energy.
    pub share: f64,
    /// Largest strain of a fibre, stretch and bending together; none of springs and contacts, which have no fibres.
    pub strain: Option<f64>,
}

/// A rod's force.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct RodForce {
    /// Its name.
    pub rod: String,
    /// Its role.
    pub role: RodRole,
    /// Largest compression, N; negative when it is pulled everywhere.
    pub compression_n: f64,
    /// Force at which it buckles between its hinges, or its sockets where these do not fold, N: L. Euler, π² E I / l². The hinges turn
    /// freely here; their webs hold a little.
    pub buckling_n: f64,
}

impl RodForce {
    /// Compression over buckling force.
    pub fn utilisation(&self) -> f64 {
        self.compression_n / self.buckling_n
    }
}

/// Forces of a beam in its own frame, N, N mm.
fn own(model: &FrameModel, state: &State, beam: usize) -> crate::mechanics::element::matrices::Local {
    let beam = &model.system.structure.beams[beam];
    let local = beam.local(beam.nodes.map(|n| state.places[n]), beam.nodes.map(|n| &state.turns[n]));
    beam.stiffness * local
}

/// Energy and strain of every zone in a state, the most energy first; links are left out. `stored_mj` is the energy in each beam, then in each tie:
/// at rest that of their springs, in an impact that of their relaxing branches, too.
pub fn zones(model: &FrameModel, state: &State, stored_mj: &[f64]) -> Vec<ZoneState> {
    let copies = model.extent.copies();
    let mut of: BTreeMap<&'static str, (f64, Option<f64>)> = BTreeMap::new();
    for (at, tag) in model.tags.iter().enumerate().filter(|(_, tag)| tag.zone != LINKS) {
        let strain = (at < model.system.structure.beams.len()).then(|| strain(model, state, at));
        let entry = of.entry(tag.zone).or_default();
        entry.0 += stored_mj[at] * copies;
        entry.1 = entry.1.into_iter().chain(strain).reduce(f64::max);
    }
    let all: f64 = of.values().map(|zone| zone.0).sum();
    let mut zones: Vec<ZoneState> = of
        .into_iter()
        .map(|(zone, (energy_mj, strain))| ZoneState { zone, energy_mj, share: energy_mj / all.max(1e-12), strain })
        .collect();
    zones.sort_by(|a, b| b.energy_mj.total_cmp(&a.energy_mj).then(a.zone.cmp(b.zone)));
    zones
}

/// Largest strain of a beam's fibres: of its stretch, and of bending at its ends.
fn strain(model: &FrameModel, state: &State, beam: usize) -> f64 {
    let tag = &model.tags[beam];
    let force = own(model, state, beam);
    let [axial, about_y, about_z] = tag.rigidity;
    let bent = |y: f64, z: f64| y.abs() * tag.reach_mm[1] / about_y + z.abs() * tag.reach_mm[0] / about_z;
    force[0].abs() / axial + bent(force[2], force[3]).max(bent(force[5], force[6]))
}

/// The rod of each role that is nearest to buckling.
pub fn rod_forces(model: &FrameModel, state: &State) -> Vec<RodForce> {
    let of = |rod: &crate::mechanics::model::frame_model::RodLine| {
        let compression_n = rod.beams.iter().map(|beam| -own(model, state, *beam)[0]).fold(f64::NEG_INFINITY, f64::max);
        let length = rod.free_mm;
        let buckling_n = std::f64::consts::PI.powi(2) * rod.bending_n_mm2 / (length * length);
        RodForce { rod: rod.name.clone(), role: rod.role, compression_n, buckling_n }
    };
    let all: Vec<RodForce> = model.rods.iter().map(of).collect();
    let worst =
        |role: RodRole| all.iter().filter(|rod| rod.role == role).max_by(|a, b| a.utilisation().total_cmp(&b.utilisation())).cloned();
    RodRole::ALL.into_iter().filter_map(worst).collect()
}
