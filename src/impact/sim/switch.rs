//! What ends a step: places where a force jumps or has a kink, located as roots.

use super::dormand_prince::Dense;
use super::root::root;
use super::system::{Phase, System};

/// Parts into which a step is cut to see a function that changes its sign twice.
const PARTS: u32 = 4;

/// A function whose sign matters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Switch {
    /// A kink at a compression, m.
    Compression(f64),
    /// A kink at a speed, m/s.
    Speed(f64),
    /// A foot touches.
    Foot {
        /// Which, from 0.
        foot: usize,
        /// At which compression, m.
        at_m: f64,
    },
    /// The frame leaves or meets the ground.
    Ground,
    /// The ground would begin or cease to pull.
    Push,
}

impl Switch {
    fn value(self, system: &System, phase: Phase, y: &[f64]) -> f64 {
        match self {
            Self::Compression(level) => y[0] - level,
            Self::Foot { at_m, .. } => y[0] - at_m,
            Self::Speed(level) => y[1] - level,
            Self::Ground => y[0],
            Self::Push => system.push(phase, y).sum_n,
        }
    }
}

/// The switches of a run, each with the side that it is on.
pub(super) struct Switches {
    all: Vec<(Switch, bool)>,
}

impl Switches {
    /// The switches at first touch: on the ground, on the way down.
    pub fn new(system: &System, phase: Phase, start: &[f64]) -> Self {
        let side = |switch: Switch| switch == Switch::Ground || switch.value(system, phase, start) >= 0.0;
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
                let value = switch.value(system, phase, &y);
                value != 0.0 && (value > 0.0) != *side
            });
            let located = turned.map(|(at, (switch, _))| (at, root(before, theta, |theta| switch.value(system, phase, &dense.at(theta)))));
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
