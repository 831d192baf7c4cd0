//! Records of synthetic drops, as a logger would have written them.

use rand::{Rng, RngExt, SeedableRng};
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

use super::fine_wave::{AFTER_S, FINE_S, at};
use super::synthetic_record::SyntheticRecord;
use super::{Hidden, Landings, Plan, ReferenceTrajectory};

/// Logged before first touch, s.
const BEFORE_S: f64 = 0.012;

/// All drops of a plan; the same plan gives the same drops.
pub fn records(plan: &Plan) -> Vec<SyntheticRecord> {
    let mut rng = Pcg64::seed_from_u64(plan.seed);
    let mut all = Vec::new();
    let varied = plan.scatter.stiffness > 0.0 || plan.scatter.damping > 0.0 || matches!(plan.hidden, Some(Hidden::Wear { .. }));
    let plain = ReferenceTrajectory::of(&plan.model, plan.hidden, 1.0, 1.0);
    for height_m in &plan.heights_m {
        let common = (!varied).then(|| wave(&plain, *height_m));
        for trial in 0..plan.drops {
            let own = common.is_none().then(|| one_frame(plan, trial, &mut rng));
            let shape = own.as_ref().unwrap_or(&plain);
            let fine = own.as_ref().map(|own| wave(own, *height_m));
            let Some(fine) = fine.as_ref().or(common.as_ref()) else { continue };
            let place = Place { height_m: *height_m, trial: name(*height_m, trial) };
            let axes = plan.landings.as_ref().map(|landings| landed(landings, shape, fine, *height_m, &mut rng));
            let (along, lateral) = match &axes {
                Some([x, y, z]) => (z, Some([&x[..], &y[..]])),
                None => (fine, None),
            };
            all.push(match &plan.stalls {
                Some(stalls) => stalls.record(plan, (shape, along, FINE_S), lateral, (*height_m, place.trial), &mut rng),
                None => record(plan, shape, along, lateral, place, &mut rng),
            });
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

/// What a record is called, and the height that it states.
struct Place {
    height_m: f64,
    trial: String,
}

/// What the body of a landing reads along x, y and its axis, g.
fn landed(landings: &Landings, trajectory: &ReferenceTrajectory, level: &[f64], height_m: f64, rng: &mut impl Rng) -> [Vec<f64>; 3] {
    let [mut x, mut y, z] = if landings.is_in_space() {
        landings.tilted(&trajectory.vertical(height_m), FINE_S, level.len(), rng)
    } else {
        [vec![0.0; level.len()], vec![0.0; level.len()], level.to_vec()]
    };
    if landings.ringing_g > 0.0 {
        let [along_x, along_y] = landings.ringing(FINE_S, level.len(), rng);
        x.iter_mut().zip(along_x).for_each(|(sum, ringing)| *sum += ringing);
        y.iter_mut().zip(along_y).for_each(|(sum, ringing)| *sum += ringing);
    }
    [x, y, z]
}

fn record(
    plan: &Plan,
    trajectory: &ReferenceTrajectory,
    fine: &[f64],
    lateral: Option<[&[f64]; 2]>,
    place: Place,
    rng: &mut impl Rng,
) -> SyntheticRecord {
    let Place { height_m, trial } = place;
    let step_s = 1.0 / plan.rate_hz;
    let before = (BEFORE_S / step_s).round() as usize;
    let count = before + (AFTER_S / step_s).floor() as usize;
    let phase: f64 = rng.random();
    let normal: f64 = StandardNormal.sample(rng);
    let tilt = plan.scatter.tilt_deg.to_radians() * normal;
    let kept = libm::exp(-step_s / plan.scatter.correlation_s);
    let mut factor: f64 = StandardNormal.sample(rng);
    let scatter = plan.scatter.share * plan.scatter.law.factor(plan.seed, height_m, rng);
    let sizes_g = plan.scatter.law.sizes_g(fine);
    let lean = plan.landings.filter(|landings| landings.sensor_lean_rad != [0.0; 2]).zip(lateral);
    let mut readings = Vec::with_capacity(count);
    let mut along_axis = Vec::with_capacity(count);
    for i in 0..count {
        let fresh: f64 = StandardNormal.sample(rng);
        let noise: f64 = StandardNormal.sample(rng);
        factor = kept * factor + (1.0 - kept * kept).sqrt() * fresh;
        let t_s = (i as f64 - before as f64 + phase) * step_s;
        let true_g = match &sizes_g {
            None => at(fine, t_s) * (1.0 + scatter * factor) * libm::cos(tilt),
            Some(sizes_g) => (at(fine, t_s) + scatter * factor * at(sizes_g, t_s)) * libm::cos(tilt),
        };
        along_axis.push(true_g);
        let read_g = lean.map_or(true_g, |(landings, [x, y])| landings.read_by_sensor([at(x, t_s), at(y, t_s), true_g])[2]);
        let limited = read_g.clamp(-trajectory.limit_g(), trajectory.limit_g()) + plan.noise_g * noise;
        readings.push((limited * plan.counts_per_g).round() / plan.counts_per_g);
    }
    let lateral_g = lateral.map(|axes| {
        [0, 1].map(|side| {
            let reading = |i: usize| {
                let noise: f64 = StandardNormal.sample(rng);
                let [x, y] = axes.map(|fine| at(fine, (i as f64 - before as f64 + phase) * step_s));
                let true_g = lean.map_or([x, y][side], |(landings, _)| landings.read_by_sensor([x, y, along_axis[i]])[side]);
                let limited = true_g.clamp(-trajectory.limit_g(), trajectory.limit_g()) + plan.noise_g * noise;
                (limited * plan.counts_per_g).round() / plan.counts_per_g
            };
            (0..count).map(reading).collect()
        })
    });
    let t_s = (0..count).map(|i| i as f64 * step_s).collect();
    SyntheticRecord { trial, height_m, t_s, accel_g: readings, lateral_g, stalled: false }
}

/// By the height in whole centimetres, or as it is stated where it is none: two heights of a plan have different names.
fn name(height_m: f64, trial: usize) -> String {
    let cm = height_m * 100.0;
    if (cm - cm.round()).abs() < 1e-6 { format!("{cm:03.0}cm-{trial:04}") } else { format!("{height_m}m-{trial:04}") }
}
