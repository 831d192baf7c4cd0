//! The switches of a run: where one turns within a step, located as a root.

use super::dormand_prince::Dense;
use super::phase::Phase;
use super::root::root;
use super::switch::Switch;
use super::system::System;

/// Parts into which a step is cut to see a function that changes its sign twice.
const PARTS: u32 = 4;

/// The switches of a run, each with the side that it is on.
pub(super) struct Switches {
    all: Vec<(Switch, bool)>,
}

impl Switches {
    /// The switches at first touch: on the ground, on the way down.
    pub fn new(system: &System, phase: Phase, start: &[f64]) -> Self {
        let side = |switch: Switch| switch == Switch::Ground || value(switch, system, phase, start) >= 0.0;
        Self { all: system.switches().into_iter().map(|switch| (switch, side(switch))).collect() }
    }

    /// The first switch that turns within a step, and where.
    pub fn first<const N: usize>(&self, system: &System, phase: Phase, dense: &Dense<N>) -> Option<(usize, f64)> {
        if self.all.is_empty() {
            return None;
        }
        let mut before = 0.0;
        for part in 1..=PARTS {
            let theta = f64::from(part) / f64::from(PARTS);
            let y = dense.at(theta);
            let turned = self.all.iter().enumerate().filter(|(_, (switch, side))| {
                let here = value(*switch, system, phase, &y);
                here != 0.0 && (here > 0.0) != *side
            });
            let located =
                turned.map(|(at, (switch, _))| (at, root(before, theta, |theta| value(*switch, system, phase, &dense.at(theta)))));
            if let Some(first) = located.min_by(|a, b| a.1.total_cmp(&b.1)) {
                return Some(first);
            }
            before = theta;
        }
        None
    }

    /// Turns a switch and says what holds from there.
    pub fn turn(&mut self, at: usize, phase: Phase) -> Phase {
        let (switch, side) = &mut self.all[at];
        *side = !*side;
        match switch {
            Switch::Ground => Phase { airborne: !*side, ..phase },
            Switch::Foot { foot, .. } if *side => Phase { touched: phase.touched.max(*foot + 1), ..phase },
            _ => phase,
        }
    }
}

/// The function whose sign a switch watches.
fn value(switch: Switch, system: &System, phase: Phase, y: &[f64]) -> f64 {
    match switch {
        Switch::Compression(level) => y[0] - level,
        Switch::Foot { at_m, .. } => y[0] - at_m,
        Switch::Speed(level) => y[1] - level,
        Switch::Ground => y[0],
        Switch::Push => system.push(phase, y).sum_n,
    }
}
