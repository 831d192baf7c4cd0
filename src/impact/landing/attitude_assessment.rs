//! The effect `attitude_sensor`, put to the tests that a named effect has to pass.

use nalgebra::{DMatrix, DVector};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::attitude_fit::{ANGLES, AttitudeFit, HeightReadings, NoLean};
use super::cosine::CosineSize;
use super::fitting::{LandingFit, LandingProblem};
use super::gate::Gate;
use super::observed::ObservedLandings;
use super::population::Population;
use super::sensor_attitude::{ATTITUDE_SENSOR, SensorAttitude};
use super::table::LandingTable;
use crate::figures::p_value;
use crate::impact::diagnose::{EffectEstimate, PRICE, RARE, UNSTEADY};
use crate::impact::fit::{NORMAL_97_5, inverse};

/// Sets of drops of which some are mirrored.
const MIRRORED: usize = 999;
/// No sensor is mounted with a larger lean by mistake, rad.
const MOST_RAD: f64 = 0.2;

/// How the sensor leans, and whether the drops support that it does.
#[derive(Clone, Debug)]
pub struct AttitudeAssessment {
    /// The angles; none where the lateral axes say too little.
    pub estimates: Vec<EffectEstimate>,
    /// Root mean square of the lateral readings, both axes together, g.
    pub lateral_g: f64,
    /// What the slopes' cosine takes off the mean waves, which every sensor that turns with the body shows.
    pub cosines: Vec<CosineSize>,
    /// The tests.
    pub gates: Vec<Gate>,
    attitude: SensorAttitude,
}

impl AttitudeAssessment {
    /// Of the drops of a problem, whose landings are in its tables, and of held-out ones; `None` where a landing is lost.
    pub fn of(
        problem: &LandingProblem,
        tables: &[LandingTable],
        fit: &LandingFit,
        held_out: Option<&ObservedLandings>,
        seed: u64,
    ) -> Option<Self> {
        let readings = |problem: &LandingProblem, height: usize, table: &LandingTable| {
            HeightReadings::of(&problem.observed.heights[height], &problem.left_by_drops(height, &Population::of(table, &fit.slopes)))
        };
        let fitted = problem.waves.chosen.iter().zip(tables).map(|(height, table)| readings(problem, *height, table));
        let fitted: Vec<HeightReadings> = fitted.collect::<Option<_>>()?;
        let unseen = held_out.map_or(Some(Vec::new()), |observed| {
            let other = LandingProblem { observed, ..problem.clone() };
            let one = |(at, height_m): (usize, f64)| {
                let table = LandingTable::of(&problem.body, &fit.legs, &fit.slopes, problem.model, &problem.waves.expected, height_m)?;
                readings(&other, at, &table)
            };
            observed.heights.iter().map(|height| height.height_m).enumerate().map(one).collect::<Option<_>>()
        })?;
        let all: Vec<&HeightReadings> = fitted.iter().collect();
        let found = AttitudeFit::of(&all);
        let none = NoLean::of(&all)?;
        let gates = vec![
            paid(none.chi_squared(|| false)),
            mirrored(&none, seed),
            constant(&fitted),
            unseen_heights(&fitted, &unseen, found.as_ref()),
            plausible(found.as_ref()),
        ];
        Some(Self {
            estimates: found.as_ref().map(estimates).unwrap_or_default(),
            lateral_g: lateral_g(problem.observed),
            cosines: CosineSize::of(problem, tables, fit)?,
            gates,
            attitude: found.map(|found| found.attitude).unwrap_or_default(),
        })
    }

    /// The lean, where every test was passed.
    pub fn named(&self) -> Option<SensorAttitude> {
        self.gates.iter().all(|gate| gate.passed).then_some(self.attitude)
    }

    /// Why it is named, or why not.
    pub fn reason(&self) -> String {
        let failed: Vec<String> =
            self.gates.iter().filter(|gate| !gate.passed).map(|gate| format!("the test `{}`: {}", gate.id, gate.found)).collect();
        if failed.is_empty() {
            let found: Vec<&str> = self.gates.iter().map(|gate| gate.found.as_str()).collect();
            return format!("{ATTITUDE_SENSOR} is named: {}", found.join("; "));
        }
        format!("{ATTITUDE_SENSOR} is not named by {}", failed.join("; by "))
    }
}

fn paid(chi_squared: f64) -> Gate {
    let price = PRICE * ANGLES as f64;
    Gate {
        id: "pays",
        passed: chi_squared > price,
        found: format!("a lean explains {chi_squared:.1} of the squares of single drops, {price:.0} is the price of its two angles"),
    }
}

/// Drops mirrored at random are those of a sensor without a lean.
fn mirrored(none: &NoLean, seed: u64) -> Gate {
    let found = none.chi_squared(|| false);
    let mut rng = Pcg64::seed_from_u64(seed);
    let as_far = (0..MIRRORED).filter(|_| none.chi_squared(|| rng.random_bool(0.5)) >= found).count();
    let p = (as_far + 1) as f64 / (MIRRORED + 1) as f64;
    Gate { id: "mirrored", passed: p <= RARE, found: format!("drops mirrored at random show as much of a lean with p = {}", p_value(p)) }
}

/// One lean for all heights: how far those of single heights lie from their mean.
fn constant(heights: &[HeightReadings]) -> Gate {
    let gate = |passed: bool, found: String| Gate { id: "constant", passed, found };
    if heights.len() < 2 {
        return gate(true, "only one height was fitted".into());
    }
    let each: Option<Vec<(DVector<f64>, DMatrix<f64>)>> = heights
        .iter()
        .map(|height| {
            let fit = AttitudeFit::of(&[height])?;
            Some((fit.angles_rad(), inverse(&fit.covariance)?))
        })
        .collect();
    let p = each.and_then(|each| {
        let precision = each.iter().fold(DMatrix::zeros(ANGLES, ANGLES), |sum, (_, precision)| sum + precision);
        let weighed = each.iter().fold(DVector::zeros(ANGLES), |sum, (angles, precision)| sum + precision * angles);
        let mean = inverse(&precision)? * weighed;
        let squared = |(angles, precision): &(DVector<f64>, DMatrix<f64>)| (angles - &mean).dot(&(precision * (angles - &mean)));
        let sum: f64 = each.iter().map(squared).sum();
        Some(ChiSquared::new((ANGLES * (each.len() - 1)) as f64).ok()?.sf(sum))
    });
    p.map_or_else(
        || gate(false, "a height alone does not determine the lean".into()),
        |p| gate(p >= UNSTEADY, format!("one lean fits all heights (p = {p:.1e})")),
    )
}

/// What varies of drops from heights that took no part: those held out, and each fitted one by the lean of the others.
fn unseen_heights(fitted: &[HeightReadings], unseen: &[HeightReadings], found: Option<&AttitudeFit>) -> Gate {
    let gate = |passed: bool, found: String| Gate { id: "held_out", passed, found };
    let change = |height: &HeightReadings, fit: Option<&AttitudeFit>| {
        let [before, after] = [SensorAttitude::default(), fit?.attitude].map(|attitude| height.variance_g2(&attitude));
        Some(libm::log(after? / before?))
    };
    let others = |at: usize| {
        let others = fitted.iter().enumerate().filter(|(other, _)| *other != at);
        AttitudeFit::of(&others.map(|(_, height)| height).collect::<Vec<_>>())
    };
    let by_others = (0..fitted.len()).filter(|_| fitted.len() > 1).map(|at| change(&fitted[at], others(at).as_ref()));
    let changes: Option<Vec<f64>> = unseen.iter().map(|height| change(height, found)).chain(by_others).collect();
    match changes {
        None => gate(false, "the lateral axes of some heights do not determine a lean".into()),
        Some(changes) if changes.is_empty() => gate(true, "no other height was measured".into()),
        Some(changes) => {
            let kept = libm::exp(changes.iter().sum::<f64>() / changes.len() as f64);
            let found =
                format!("turned back by the lean of other heights, drops keep {:.1} % of the variance that touches leave", 1e2 * kept);
            gate(kept < 1.0, found)
        }
    }
}

fn plausible(found: Option<&AttitudeFit>) -> Gate {
    let gate = |passed: bool, found: String| Gate { id: "plausible", passed, found };
    match found.map(|found| found.attitude.lean_rad()) {
        None => gate(false, "the lateral axes do not determine a lean".into()),
        Some(lean_rad) => gate(lean_rad <= MOST_RAD, format!("the lean is {lean_rad:.3} rad, at most {MOST_RAD} are believed")),
    }
}

fn estimates(found: &AttitudeFit) -> Vec<EffectEstimate> {
    let one = |(at, key): (usize, &'static str)| {
        let (value, half) = (found.angles_rad()[at], NORMAL_97_5 * found.covariance[(at, at)].max(0.0).sqrt());
        EffectEstimate { effect: ATTITUDE_SENSOR, key, unit: "rad", value, ci95: [value - half, value + half], at_bound: false }
    };
    ["lean_x_rad", "lean_y_rad"].into_iter().enumerate().map(one).collect()
}

fn lateral_g(observed: &ObservedLandings) -> f64 {
    let drops = || observed.heights.iter().flat_map(|height| &height.drops);
    let sum: f64 = drops().flat_map(|drop| drop.axes[..2].iter().flatten()).map(|reading| reading * reading).sum();
    let count: usize = drops().map(|drop| drop.axes[2].len()).sum();
    (sum / count.max(1) as f64).sqrt()
}
