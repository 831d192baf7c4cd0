//! What happens in a run, located on the steps as it goes: turning points, the gap, the release, peaks.

use super::dormand_prince::Dense;
use super::root::{maximum, root};
use super::system::{ALL, Phase, System};
use crate::impact::effects::GRAVITY_M_S2;

/// Parts of a step that are looked at.
const PARTS: u32 = 8;

/// A state at its time, and what held there.
pub(super) type Moment = (f64, [f64; ALL], Phase);

/// What was found.
pub(super) struct Events<'a> {
    system: &'a System,
    /// Largest compression among the turning points.
    pub deepest: Option<Moment>,
    /// The gap is used up for the first time.
    pub gap: Option<Moment>,
    /// The ground ceases to push for the first time.
    pub release: Option<Moment>,
    /// Largest magnitude of x'', m/s².
    pub coordinate_m_s2: f64,
    /// Largest proper acceleration, m/s².
    pub proper_m_s2: f64,
    /// Largest reading, g.
    pub reading_g: f64,
}

impl<'a> Events<'a> {
    pub fn new(system: &'a System) -> Self {
        let none = f64::NEG_INFINITY;
        Self { system, deepest: None, gap: None, release: None, coordinate_m_s2: none, proper_m_s2: none, reading_g: none }
    }

    /// Looks at a step.
    pub fn look(&mut self, dense: &Dense<ALL>, phase: Phase) {
        let (gap_m, sensed) = (self.system.body.gap_m, self.system.sensed());
        let theta = |part: u32| f64::from(part) / f64::from(PARTS);
        let states: Vec<[f64; ALL]> = (0..=PARTS).map(|part| dense.at(theta(part))).collect();
        for part in 1..=PARTS {
            let (a, b) = (theta(part - 1), theta(part));
            let (left, right) = (&states[part as usize - 1], &states[part as usize]);
            if left[1] > 0.0 && right[1] <= 0.0 {
                let there = moment(dense, phase, root(a, b, |theta| dense.one(1, theta)));
                if self.deepest.is_none_or(|deepest| there.1[0] > deepest.1[0]) {
                    self.deepest = Some(there);
                }
            }
            if self.gap.is_none() && left[0] <= gap_m && right[0] > gap_m {
                self.gap = Some(moment(dense, phase, root(a, b, |theta| dense.one(0, theta) - gap_m)));
            }
            if self.release.is_none() && right[1] < 0.0 {
                self.look_for_release(dense, phase, [a, b], right);
            }
        }
        let system = self.system;
        let frame = |y: &[f64; ALL]| system.proper_m_s2(&system.push(phase, y), y)[0];
        rise(&mut self.proper_m_s2, dense, &states, frame);
        rise(&mut self.coordinate_m_s2, dense, &states, |y| (GRAVITY_M_S2 - frame(y)).abs());
        rise(&mut self.reading_g, dense, &states, |y| system.arrangement.sensor.reading_g(y[sensed]));
    }

    fn look_for_release(&mut self, dense: &Dense<ALL>, phase: Phase, [a, b]: [f64; 2], right: &[f64; ALL]) {
        let pushes = |y: &[f64; ALL]| self.system.push(phase, y).sum_n;
        let ceased = (pushes(right) < 0.0).then(|| root(a, b, |theta| pushes(&dense.at(theta))));
        let left = (right[0] < 0.0).then(|| root(a, b, |theta| dense.one(0, theta)));
        let first = [ceased, left].into_iter().flatten().min_by(f64::total_cmp);
        self.release = first.map(|theta| moment(dense, phase, theta));
    }
}

fn moment(dense: &Dense<ALL>, phase: Phase, theta: f64) -> Moment {
    (dense.time_s(theta), dense.at(theta), phase)
}

/// Raises a peak to what a function of the state reaches in a step.
fn rise(peak: &mut f64, dense: &Dense<ALL>, states: &[[f64; ALL]], f: impl Fn(&[f64; ALL]) -> f64) {
    let values: Vec<f64> = states.iter().map(&f).collect();
    for (part, value) in values.iter().enumerate() {
        if *value > *peak {
            let theta = |part: usize| part as f64 / f64::from(PARTS);
            let (left, right) = (part.saturating_sub(1), (part + 1).min(states.len() - 1));
            let (_, highest) = maximum(theta(left), theta(right), |theta| f(&dense.at(theta)));
            *peak = highest.max(*value);
        }
    }
}
