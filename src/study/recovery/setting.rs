//! What a study of hidden effects looks at.

use super::truth::Truth;
use crate::impact::effects::{Model, Spec};
use crate::impact::synthetic::ScatterLaw;
use crate::study::axis::{Axis, Input};

/// A row: which drops are made and diagnosed.
#[derive(Clone, Debug)]
pub struct Case {
    /// Level of noise, 1 to 3.
    pub level: usize,
    /// How readings scatter.
    pub law: ScatterLaw,
    /// What is hidden.
    pub truth: Truth,
    /// Noncentrality of each effect at level 2, where effects of the catalogue are hidden.
    pub strength: Option<f64>,
    /// Of all that is random.
    pub seed: u64,
}

/// Drops with something hidden in them, diagnosed.
pub struct Recovery {
    /// The model that is diagnosed.
    pub base: Model,
    /// The rows.
    pub cases: Vec<Case>,
    /// The effects that may be hidden, for the ceiling.
    pub effects: Vec<&'static Spec>,
    /// The strengths that they may have, for the ceiling.
    pub strengths: Vec<f64>,
    /// Most effects that a diagnosis tries on top of the base.
    pub most_effects: usize,
    /// By how much more than mean waves tell the ideal observer of the ceiling knows; a factor of noncentralities.
    pub ceiling_gain: f64,
}

impl Recovery {
    /// The rows as a table: the axes, and what they are in each row.
    pub(in crate::study) fn rows(&self) -> (Vec<Axis>, Vec<Vec<Input>>) {
        let mut truths: Vec<String> = Vec::new();
        for name in self.cases.iter().map(|case| case.truth.name()) {
            if !truths.contains(&name) {
                truths.push(name);
            }
        }
        let is_used = |name: &&str| self.cases.iter().any(|case| case.law.name() == *name);
        let laws = ScatterLaw::NAMES.into_iter().filter(is_used).map(String::from).collect();
        let axes = vec![
            Axis::Stated("level".into()),
            Axis::Name { key: "law".into(), names: laws },
            Axis::Name { key: "truth".into(), names: truths },
            Axis::Stated("strength".into()),
            Axis::Stated("seed".into()),
        ];
        (axes, self.cases.iter().map(Case::inputs).collect())
    }
}

impl Case {
    fn inputs(&self) -> Vec<Input> {
        vec![
            Input::Number(self.level as f64),
            Input::Name(self.law.name().into()),
            Input::Name(self.truth.name()),
            self.strength.map_or(Input::None, Input::Number),
            Input::Number(self.seed as f64),
        ]
    }
}
