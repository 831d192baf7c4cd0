//! Records of synthetic drops, as a logger would have written them.

use rand::{Rng, RngExt, SeedableRng};
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

use super::{Hidden, Plan, ReferenceTrajectory};

/// Time between the points of a wave, s.
const FINE_S: f64 = 5e-5;
/// Logged before first touch, s.
const BEFORE_S: f64 = 0.012;
/// Logged from first touch on, s.
const AFTER_S: f64 = 0.040;

/// One synthetic drop.
#[derive(Clone, Debug, PartialEq)]
pub struct SyntheticRecord {
    /// Its name.
    pub trial: String,
    /// Stated height, m.
    pub height_m: f64,
    /// Sample times from the record's begin, s.
    pub t_s: Vec<f64>,
    /// Readings along the axis, g.
    pub accel_g: Vec<f64>,
}

/// Drops as a table that `measure` and `diagnose` read.
pub fn table(records: &[SyntheticRecord]) -> String {
    let mut table = String::from("trial,height_m,t_s,accel_g\n");
    for record in records {
        for (t_s, accel_g) in record.t_s.iter().zip(&record.accel_g) {
            table += &format!("{},{},{t_s:.6},{accel_g:.5}\n", record.trial, record.height_m);
        }
    }
    table
}

/// All drops of a plan; the same plan gives the same drops.
pub fn records(plan: &Plan) -> Vec<SyntheticRecord> {
    let mut rng = Pcg64::seed_from_u64(plan.seed);
    let mut all = Vec::new();
    let varied = plan.scatter.stiffness > 0.0 || plan.scatter.damping > 0.0 || matches!(plan.hidden, Some(Hidden::Wear { .. }));
    for height_m in &plan.heights_m {
        let common = (!varied).then(|| wave(&ReferenceTrajectory::of(&plan.model, plan.hidden, 1.0, 1.0), *height_m));
        for trial in 0..plan.drops {
            let own = common.is_none().then(|| wave(&one_frame(plan, trial, &mut rng), *height_m));
            let shape = ReferenceTrajectory::of(&plan.model, plan.hidden, 1.0, 1.0);
            let Some(fine) = own.as_ref().or(common.as_ref()) else { continue };
            all.push(record(plan, &shape, fine, *height_m, trial, &mut rng));
        }
    }
    all
}

fn wave(trajectory: &ReferenceTrajectory, height_m: f64) -> Vec<f64> {
    trajectory.wave_g(height_m, FINE_S, (AFTER_S / FINE_S) as usize + 2)
}

/// This drop's frame: a little stiffer or softer than the last, worn by the drops before.
fn one_frame(plan: &Plan, trial: usize, rng: &mut impl Rng) -> ReferenceTrajectory {
    let mut normal = || -> f64 { StandardNormal.sample(rng) };
    let mut stiffness = (1.0 + plan.scatter.stiffness * normal()).max(0.1);
    let damping = (1.0 + plan.scatter.damping * normal()).max(0.1);
    if let Some(Hidden::Wear { loss }) = plan.hidden {
        stiffness *= 1.0 + loss * (0.5 - trial as f64 / (plan.drops - 1).max(1) as f64);
    }
    ReferenceTrajectory::of(&plan.model, plan.hidden, stiffness, damping)
}

fn record(plan: &Plan, trajectory: &ReferenceTrajectory, fine: &[f64], height_m: f64, trial: usize, rng: &mut impl Rng) -> SyntheticRecord {
    let step_s = 1.0 / plan.rate_hz;
    let before = (BEFORE_S / step_s).round() as usize;
    let count = before + (AFTER_S / step_s).floor() as usize;
    let phase: f64 = rng.random();
    let lean: f64 = StandardNormal.sample(rng);
    let tilt = plan.scatter.tilt_deg.to_radians() * lean;
    let kept = libm::exp(-step_s / plan.scatter.correlation_s);
    let mut factor: f64 = StandardNormal.sample(rng);
    let mut readings = Vec::with_capacity(count);
    for i in 0..count {
        let fresh: f64 = StandardNormal.sample(rng);
        let noise: f64 = StandardNormal.sample(rng);
        factor = kept * factor + (1.0 - kept * kept).sqrt() * fresh;
        let t_s = (i as f64 - before as f64 + phase) * step_s;
        let true_g = at(fine, t_s) * (1.0 + plan.scatter.share * factor) * libm::cos(tilt);
        let limited = true_g.clamp(-trajectory.limit_g(), trajectory.limit_g()) + plan.noise_g * noise;
        readings.push((limited * plan.counts_per_g).round() / plan.counts_per_g);
    }
    let t_s = (0..count).map(|i| i as f64 * step_s).collect();
    SyntheticRecord { trial: format!("{:03.0}cm-{trial:04}", height_m * 100.0), height_m, t_s, accel_g: readings }
}

/// The wave between its points.
fn at(fine: &[f64], t_s: f64) -> f64 {
    if t_s <= 0.0 {
        return 0.0;
    }
    let place = t_s / FINE_S;
    let left = (place.floor() as usize).min(fine.len() - 2);
    fine[left] + (place - left as f64) * (fine[left + 1] - fine[left])
}
