//! The frame dropped on level ground, feet first, level or tilted: what its payload feels.

use std::collections::BTreeMap;

use nalgebra::{Matrix3, Vector3};

use super::landing::{along_axis_g, falling, rising, touching};
use super::strength::{RodForce, ZoneState, rod_forces, zones};
use crate::mechanics::model::frame_model::FrameModel;
use crate::mechanics::model::model_error::ModelError;
use crate::mechanics::settings::MechanicsSettings;
use crate::mechanics::solve::dynamics::{DynamicsError, TimeIntegration};
use crate::mechanics::solve::memory::Energies;
use crate::mechanics::system::structure::State;
use crate::paper_logger::{BANDWIDTH_HZ, STEP_MS};
use crate::units::{Angle, GRAVITY_M_S2, GRAVITY_MM_MS2};

/// How a drop is computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Run {
    /// Time between the moments that are noted, ms.
    pub step_ms: f64,
    /// Steps of the computation between two of these.
    pub substeps: usize,
    /// Longest time, ms.
    pub longest_ms: f64,
    /// Longest time while the frame still comes down, ms: a heavy one takes longer, and before it turns back it has neither peak nor travel.
    pub longest_down_ms: f64,
    /// How long the feet have to be in the air for the contact to have ended, ms.
    pub off_ground_ms: f64,
    /// How far the frame is turned about X, then about Y, when it touches. Other than none needs the whole frame.
    pub tilt: [Angle; 2],
}

/// Energy out of nothing, part of that of the impact, from which on a drop is computed again in shorter steps: a choice.
const MOST_GAINED: f64 = 0.02;
/// A frame that takes long to turn back is followed for so much longer, ms: its payload swings, and may be lowest and hit hardest a little later.
const BEHIND_TURN_MS: f64 = 10.0;
/// How many times shorter these are: those of 0.025 ms followed drops that 0.1 ms lost.
const SHORTER: usize = 4;

impl Run {
    /// Of a frame that is turned when it touches: its feet come down one after the other, and peaks need shorter steps than those of a level drop.
    pub fn tilted(tilt: [Angle; 2]) -> Self {
        Self { tilt, substeps: 2, ..Self::default() }
    }

    fn shorter(self) -> Self {
        Self { substeps: SHORTER * self.substeps, ..self }
    }
}

impl Default for Run {
    fn default() -> Self {
        Self { step_ms: 0.1, substeps: 1, longest_ms: 40.0, longest_down_ms: 400.0, off_ground_ms: 1.0, tilt: [Angle::rad(0.0); 2] }
    }
}

/// Why there is no impact.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ImpactError {
    /// No model.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// The motion was lost.
    #[error(
        "from {height_m} m {error}, in steps of {step_ms} ms, too: the frame collapses further than the model follows; lower heights may be followed"
    )]
    Dynamics {
        /// Drop height, m.
        height_m: f64,
        /// Where.
        error: DynamicsError,
        /// The shortest steps that were tried, ms.
        step_ms: f64,
    },
    /// The method made energy out of nothing.
    #[error(
        "from {height_m} m the computed motion gains {percent:.0} % of energy, in steps of {step_ms} ms, too: its figures say nothing; lower heights may be followed"
    )]
    Gains {
        /// Drop height, m.
        height_m: f64,
        /// Energy that is in no account, % of that of the fall.
        percent: f64,
        /// The shortest steps that were tried, ms.
        step_ms: f64,
    },
}

/// A moment of the impact.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Moment {
    /// Since first touch, ms.
    pub t_ms: f64,
    /// The payload's way down, mm.
    pub down_mm: f64,
    /// Its speed upwards, m/s.
    pub up_m_s: f64,
    /// Its proper acceleration, g: 0 in free fall.
    pub proper_g: f64,
    /// Force of the ground on all feet, N.
    pub ground_n: f64,
}

/// An impact.
#[derive(Clone, Debug)]
pub struct Impact {
    /// Drop height, m.
    pub height_m: f64,
    /// Speed at first touch, m/s.
    pub speed_m_s: f64,
    /// Moments, a step apart.
    pub moments: Vec<Moment>,
    /// Where the centre is at each moment, mm, and its turn since the frame was level.
    pub centre: Vec<(Vector3<f64>, Matrix3<f64>)>,
    /// When the feet left the ground, ms; `None` when they had not.
    pub contact_ms: Option<f64>,
    /// Speed of the whole frame's centre of mass upwards at the end over that at the start; `None` when the feet had not left the ground.
    pub restitution: Option<f64>,
    /// Energies when the payload was lowest, and at the end.
    pub energies: [Energies; 2],
    /// Lost in each zone, mJ, the most first.
    pub lost: Vec<(&'static str, f64)>,
    /// When the payload was lowest: what the parts bear.
    pub zones: Vec<ZoneState>,
    /// The largest strain of each zone over the whole impact.
    pub strains: Vec<(&'static str, f64)>,
    /// The same of the rods: the most loaded of each role over the whole impact.
    pub rods: Vec<RodForce>,
    /// States for pictures: when, ms, and where everything was.
    pub states: Vec<(f64, State)>,
    /// Energy that is in no account at the end, over the energy of the fall: of the method.
    pub unaccounted: f64,
}

impl Impact {
    /// Drops a frame from a height. A motion that is lost, or that gains energy, is computed again in shorter steps.
    ///
    /// # Errors
    /// When the motion is lost, or gains energy, in shorter steps, too.
    pub fn new(model: &FrameModel, settings: &MechanicsSettings, height_m: f64, run: &Run) -> Result<Self, ImpactError> {
        let gains = |impact: &Self| impact.unaccounted < -MOST_GAINED;
        if let Some(impact) = Self::computed(model, settings, height_m, run).ok().filter(|impact| !gains(impact)) {
            return Ok(impact);
        }
        let step_ms = run.step_ms / run.shorter().substeps as f64;
        match Self::computed(model, settings, height_m, &run.shorter()) {
            Ok(impact) if gains(&impact) => Err(ImpactError::Gains { height_m, percent: -100.0 * impact.unaccounted, step_ms }),
            shorter => shorter.map_err(|error| ImpactError::Dynamics { height_m, error, step_ms }),
        }
    }

    fn computed(model: &FrameModel, settings: &MechanicsSettings, height_m: f64, run: &Run) -> Result<Self, DynamicsError> {
        let speed_m_s = (2.0 * GRAVITY_M_S2 * height_m).sqrt();
        let touching = touching(&model.system, model.hub, run.tilt);
        let first = centre(model, &touching);
        let mut motion = TimeIntegration::new(&model.system, settings.relaxation(), touching, falling(model, speed_m_s), GRAVITY_MM_MS2);
        let start = motion.energies();
        let mut impact = Self::begun(height_m, speed_m_s, first, start);
        let mut left_ms = None;
        let mut turned_ms: Option<f64> = None;
        let is_coming_down = |turned_ms: Option<f64>, t_ms: f64| turned_ms.is_none_or(|at| t_ms - at < BEHIND_TURN_MS);
        while motion.t_ms < run.longest_ms - 1e-9 || (motion.t_ms < run.longest_down_ms - 1e-9 && is_coming_down(turned_ms, motion.t_ms)) {
            for _ in 0..run.substeps {
                motion.advance(run.step_ms / run.substeps as f64)?;
            }
            let ground_n = impact.watch(model, &motion);
            if turned_ms.is_none() && rising(model, &motion) > 0.0 && impact.has_turned_back() {
                turned_ms = Some(motion.t_ms);
            }
            left_ms = if ground_n > 0.0 { None } else { left_ms.or(Some(motion.t_ms)) };
            // Feet hop while the frame still comes down; that is no end.
            let is_off = left_ms.is_some_and(|at| motion.t_ms - at >= run.off_ground_ms - 1e-9);
            if is_off && rising(model, &motion) > 0.0 {
                impact.contact_ms = left_ms;
                break;
            }
        }
        Ok(impact.ended(model, &motion, start))
    }

    /// At first touch.
    fn begun(height_m: f64, speed_m_s: f64, centre: (Vector3<f64>, Matrix3<f64>), energies: Energies) -> Self {
        Self {
            height_m,
            speed_m_s,
            moments: vec![Moment { t_ms: 0.0, down_mm: 0.0, up_m_s: -speed_m_s, proper_g: 0.0, ground_n: 0.0 }],
            centre: vec![centre],
            contact_ms: None,
            restitution: None,
            energies: [energies; 2],
            lost: Vec::new(),
            zones: Vec::new(),
            strains: Vec::new(),
            rods: Vec::new(),
            states: Vec::new(),
            unaccounted: 0.0,
        }
    }

    /// Notes a step; what the ground pushes with, N.
    fn watch(&mut self, model: &FrameModel, motion: &TimeIntegration) -> f64 {
        let rest = self.centre[0].0.z;
        let down_mm = rest - motion.state.places[model.hub].z;
        let proper_g = along_axis_g(model, motion);
        let ground_n = motion.ground_n * model.extent.copies();
        let up_m_s = motion.velocity[model.system.unknowns.of(model.hub)[2]];
        let is_lowest = down_mm > self.travel_mm();
        self.moments.push(Moment { t_ms: motion.t_ms, down_mm, up_m_s, proper_g, ground_n });
        self.centre.push(centre(model, &motion.state));
        self.watch_rods(model, &motion.state);
        let zones = zones(model, &motion.state, &motion.stored());
        self.watch_strains(&zones);
        if self.moments.len() % 10 == 1 {
            self.states.push((motion.t_ms, motion.state.clone()));
        }
        if is_lowest {
            self.energies[0] = motion.energies();
            self.zones = zones;
        }
        ground_n
    }

    /// With the energies at the end, and all of them of the whole frame.
    fn ended(mut self, model: &FrameModel, motion: &TimeIntegration, start: Energies) -> Self {
        let end = motion.energies();
        self.energies[1] = end;
        self.restitution = self.contact_ms.map(|_| rising(model, motion) / self.speed_m_s);
        self.lost = lost(model, &motion.lost_mj);
        let held = end.kinetic_mj + end.stored_mj + end.relaxed_mj + end.friction_mj;
        self.unaccounted = (start.kinetic_mj + end.gravity_mj - held) / start.kinetic_mj;
        let copies = model.extent.copies();
        self.energies = self.energies.map(|energies| energies.times(copies));
        self
    }

    fn watch_strains(&mut self, zones: &[ZoneState]) {
        for (zone, strain) in zones.iter().filter_map(|zone| Some((zone.zone, zone.strain?))) {
            match self.strains.iter_mut().find(|(known, _)| *known == zone) {
                Some((_, most)) => *most = most.max(strain),
                None => self.strains.push((zone, strain)),
            }
        }
    }

    fn watch_rods(&mut self, model: &FrameModel, state: &State) {
        for rod in rod_forces(model, state) {
            match self.rods.iter_mut().find(|known| known.role == rod.role) {
                Some(known) if known.utilisation() >= rod.utilisation() => {}
                Some(known) => *known = rod,
                None => self.rods.push(rod),
            }
        }
    }

    /// Peak behind the sensor of the real drops, g.
    pub fn sensor_peak_g(&self) -> f64 {
        self.through(BANDWIDTH_HZ).into_iter().fold(0.0, f64::max)
    }

    /// Peak in the records of the real drops' logger, g: behind the sensor, one reading a millisecond. This is what a measured peak compares
    /// with; it holds for the steps of [`Run::default`].
    pub fn logged_peak_g(&self) -> f64 {
        sampled_peak_g(&self.through(BANDWIDTH_HZ), Run::default().step_ms, STEP_MS)
    }

    /// Largest proper acceleration of the payload, g, and when, ms.
    pub fn peak(&self) -> [f64; 2] {
        let peak = self.moments.iter().max_by(|a, b| a.proper_g.total_cmp(&b.proper_g));
        peak.map_or([0.0; 2], |moment| [moment.proper_g, moment.t_ms])
    }

    /// Largest way down of the payload, mm.
    pub fn travel_mm(&self) -> f64 {
        self.moments.iter().map(|moment| moment.down_mm).fold(0.0, f64::max)
    }

    /// Whether the payload has turned back: before, its peak and travel are not known. Its speed at the end says less, as it swings on what carries it.
    pub fn has_turned_back(&self) -> bool {
        self.contact_ms.is_some() || self.moments.last().is_some_and(|last| last.down_mm < self.travel_mm())
    }

    /// The proper acceleration behind a first-order low-pass, g, moment by moment.
    pub fn through(&self, cutoff_hz: f64) -> Vec<f64> {
        let mut last = 0.0;
        let mut before = 0.0;
        let mut passed = vec![0.0];
        for pair in self.moments.windows(2) {
            let x = std::f64::consts::TAU * cutoff_hz * 1e-3 * (pair[1].t_ms - pair[0].t_ms);
            // Exact for an input that runs straight from moment to moment.
            let (kept, now) = (libm::exp(-x), pair[1].proper_g);
            let slope = (now - before) / x;
            last = kept * last + (now - slope) - kept * (before - slope);
            before = now;
            passed.push(last);
        }
        passed
    }
}

/// Largest of readings `logged_ms` apart, g, in the mean over the phases of the logger's clock: what a peak is by its records.
/// Readings `step_ms` apart come in; a logger that is faster has their peak.
pub fn sampled_peak_g(reading_g: &[f64], step_ms: f64, logged_ms: f64) -> f64 {
    let each = ((logged_ms / step_ms).round() as usize).max(1);
    let of_phase = |phase: usize| reading_g.iter().skip(phase).step_by(each).copied().fold(f64::NEG_INFINITY, f64::max);
    (0..each).map(of_phase).sum::<f64>() / each as f64
}

/// Where the centre is, mm, and how it is turned.
fn centre(model: &FrameModel, state: &State) -> (Vector3<f64>, Matrix3<f64>) {
    (state.places[model.hub], state.turns[model.hub])
}

fn lost(model: &FrameModel, lost_mj: &[f64]) -> Vec<(&'static str, f64)> {
    let mut of: BTreeMap<&'static str, f64> = BTreeMap::new();
    for (tag, lost) in model.tags.iter().zip(lost_mj) {
        *of.entry(tag.zone).or_default() += lost * model.extent.copies();
    }
    let mut all: Vec<(&'static str, f64)> = of.into_iter().filter(|(_, lost)| *lost > 0.0).collect();
    all.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(b.0)));
    all
}
