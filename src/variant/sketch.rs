//! A sketch: what a known frame says of a frame near it.
//!
//! Rods and bought parts are those of the other frame, and everything is where its skeleton puts it; printed parts are bent as in the known
//! frame. Size, masses, clearances, seats by the skeleton and the fold sequence are measured as of a design; what can only be asked of parts that
//! are bent as they are assembled is taken to be as it is in the known frame. A sketch of the known frame itself says what its design says. A
//! sketch takes a tenth of a design's time where only rods and motors change: no part is made.

use std::sync::Arc;

use super::measures::Evaluation;
use crate::checks::{Cost, Finding, Rule, check_by};
use crate::frame::assembly::{Design, DesignError};
use crate::frame::skeleton::Skeleton;
use crate::memo::Memo;
use crate::params::Frame;

/// What is known of a frame that was designed.
pub(super) struct Known {
    skeleton: Skeleton,
    /// What no sketch says.
    rest: Vec<Finding>,
}

impl Known {
    /// From a frame that was evaluated by these rules.
    pub fn of(evaluation: Evaluation, rules: &[&'static Rule]) -> Self {
        let Evaluation { design, masses, findings, .. } = evaluation;
        let sketched = check_by(rules, Cost::Sketch, &design, &masses);
        let rest = findings.into_iter().filter(|finding| !sketched.contains(finding)).collect();
        Self { skeleton: design.skeleton, rest }
    }

    /// A sketch of a frame.
    ///
    /// # Errors
    /// When it does not close, or a part cannot be made.
    pub fn sketch(&self, frame: Frame, rules: &[&'static Rule], memo: &Arc<Memo>) -> Result<Evaluation, DesignError> {
        let mut evaluation = Evaluation::by(rules, Cost::Sketch, Design::sketched(frame, &self.skeleton, memo)?);
        evaluation.findings.extend(self.rest.iter().cloned());
        Ok(evaluation)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::CATALOGUE;
    use crate::params::FrameFile;
    use crate::variant::{MEASURES, measure};

    fn frame(longer_mm: f64) -> Frame {
        let mut file = FrameFile::load("cognifly").expect("a preset");
        for (key, value) in [("rods.cage_rod_length_mm", 192.0), ("rods.arm_rod_length_mm", 82.0), ("rods.strut_rod_length_mm", 50.03)] {
            file.set_number(key, value + longer_mm);
        }
        Frame::resolve(&file).expect("is one")
    }

    fn sorted(evaluation: &Evaluation) -> Vec<String> {
        let mut found: Vec<String> = evaluation.findings.iter().map(|finding| format!("{finding:?}")).collect();
        found.sort();
        found
    }

    #[test]
    fn analytic_a_sketch_of_the_known_frame_says_what_its_design_says() {
        let memo = Arc::new(Memo::default());
        let quick = |longer_mm: f64| Evaluation::quick(frame(longer_mm), &memo).expect("is one");
        let known = Known::of(quick(0.0), &CATALOGUE);
        let sketch = |longer_mm: f64| known.sketch(frame(longer_mm), &CATALOGUE, &memo).expect("is one");
        let (same, design) = (sketch(0.0), quick(0.0));
        assert_eq!(sorted(&same), sorted(&design));
        for measure in &MEASURES {
            assert_eq!(measure.of(&same), measure.of(&design), "{}", measure.name);
        }
        // Of a frame near it no part is made, and what matters is nearly right.
        memo.made();
        let near = sketch(2.0);
        let made: Vec<&str> = memo.made().into_keys().map(|made| made.step).collect();
        assert!(made.contains(&"gap") && !made.iter().any(|step| ["flat part", "folded part", "mesh", "walls"].contains(step)), "{made:?}");
        let design = quick(2.0);
        for (name, within) in [("mass", 0.2), ("envelope.width", 0.01), ("envelope.height", 0.01), ("clearance.propeller", 0.1)] {
            let [a, b] = [&near, &design].map(|evaluation| measure(name).and_then(|measure| measure.of(evaluation)).expect("a figure"));
            assert!((a - b).abs() < within, "{name}: {a} {b}");
        }
    }
}
