//! An impact model as meant: body, sensor and effects, every number within its bounds.

use std::sync::Arc;

use super::arrangement::Arrangement;
use super::catalogue::CATALOGUE;
use super::effect::Effect;
use super::frame_curve::FrameCurve;
use super::sensor::{Channel, Sensor};
use super::spec::{Availability, Inputs, Spec, Stage, StartContext};
use super::{linear_damper, linear_spring};
use crate::impact::body::DropBody;

/// An effect with its values.
#[derive(Clone, Debug)]
pub struct Listed {
    /// Its record.
    pub spec: &'static Spec,
    /// Values in the units of the model file, in the order of its parameters.
    pub values: Vec<f64>,
    /// Index of the chosen word, where the effect has a choice.
    pub word: usize,
}

impl Listed {
    /// The effect at work, or `None` when its values switch it off.
    fn effect(&self, frame_curve: Option<&Arc<FrameCurve>>) -> Option<Box<dyn Effect>> {
        if self.spec.is_off(&self.values) {
            return None;
        }
        let values: Vec<f64> = self.values.iter().zip(self.spec.parameters).map(|(value, parameter)| value * parameter.si).collect();
        Some((self.spec.build)(&Inputs { values: &values, word: self.word, frame_curve }))
    }
}

/// A model of the drop.
#[derive(Clone, Debug)]
pub struct Model {
    /// Its name.
    pub name: String,
    /// The body that falls.
    pub body: DropBody,
    /// The sensor that rides on it.
    pub sensor: Sensor,
    /// Spring and damper first, then what comes on top in the order of the catalogue.
    pub effects: Vec<Listed>,
    /// The frame's static curve, where one is known; it acts by `frame_force_curve`.
    pub frame_curve: Option<Arc<FrameCurve>>,
    /// Share and frequency, Hz, of a payload mode that a frame's own modes stand for, where they are known: where a fit may begin.
    pub frame_mode: Option<[f64; 2]>,
}

impl Model {
    /// A linear spring and a linear damper.
    pub fn base(body: DropBody, sensor: Sensor, stiffness_n_m: f64, damping_n_s_m: f64) -> Self {
        let effects = vec![
            Listed { spec: &linear_spring::SPEC, values: vec![stiffness_n_m], word: 0 },
            Listed { spec: &linear_damper::SPEC, values: vec![damping_n_s_m], word: 0 },
        ];
        Self { name: "base".into(), body, sensor, effects, frame_curve: None, frame_mode: None }
    }

    /// The same with an effect on top; one that is listed already is replaced.
    #[must_use]
    pub fn with(mut self, spec: &'static Spec, values: &[f64], word: usize) -> Self {
        self.effects.retain(|listed| listed.spec.id != spec.id);
        self.effects.push(Listed { spec, values: values.to_vec(), word });
        self.effects.sort_by_key(|listed| order(listed.spec));
        self
    }

    /// A parameter's value in the unit of the model file.
    pub fn value(&self, effect: &str, key: &str) -> Option<f64> {
        let listed = self.effects.iter().find(|listed| listed.spec.id == effect)?;
        let at = listed.spec.parameters.iter().position(|parameter| parameter.key == key)?;
        listed.values.get(at).copied()
    }

    /// Stiffness, N/m, and damping, N s/m, of the base.
    pub fn stiffness_and_damping(&self) -> [f64; 2] {
        [&linear_spring::SPEC, &linear_damper::SPEC].map(|base| self.value(base.id, base.parameters[0].key).unwrap_or(0.0))
    }

    /// The model with stiffness and damping of the base multiplied by factors.
    #[must_use]
    pub fn scaled(&self, factors: [f64; 2]) -> Self {
        let mut model = self.clone();
        for (base, factor) in [&linear_spring::SPEC, &linear_damper::SPEC].into_iter().zip(factors) {
            model.effects.iter_mut().filter(|listed| listed.spec == base).for_each(|listed| listed.values[0] *= factor);
        }
        model
    }

    /// The effects on top of the base that its values do not switch off, at work.
    pub fn acting(&self) -> impl Iterator<Item = (&'static Spec, Box<dyn Effect>)> {
        let on_top = self.effects.iter().filter(|listed| !listed.spec.is_base());
        on_top.filter_map(|listed| Some((listed.spec, listed.effect(self.frame_curve.as_ref())?)))
    }

    /// How fall, contact and sensor are arranged.
    pub fn arrangement(&self) -> Arrangement {
        let mut arrangement = Arrangement::plain(self.sensor);
        for (_, effect) in self.acting().filter(|(spec, _)| spec.stage == Stage::Arrangement) {
            effect.arrange(&mut arrangement);
        }
        arrangement
    }

    /// Whether an effect of the model limits the readings.
    pub fn limits_readings(&self) -> bool {
        let unlimited = Self { sensor: Sensor { limit_g: f64::INFINITY, ..self.sensor }, ..self.clone() };
        unlimited.arrangement().sensor.limit_g.is_finite()
    }

    /// What the starts of fits depend on.
    pub fn known(&self) -> StartContext {
        StartContext { cutoff_hz: self.sensor.cutoff_hz, frame_mode: self.frame_mode }
    }
}

/// The effects of a list that a model may have on top of its base.
pub fn candidates(catalogue: &[&'static Spec], model: &Model) -> Vec<&'static Spec> {
    let available = |spec: &&&'static Spec| match spec.availability {
        Availability::Base => false,
        Availability::Any => true,
        Availability::WithFrameCurve => model.frame_curve.is_some(),
    };
    catalogue.iter().filter(available).copied().collect()
}

/// Position of an effect in the order of composition; effects from outside the catalogue come last.
pub(super) fn order(spec: &Spec) -> usize {
    CATALOGUE.iter().position(|known| *known == spec).unwrap_or(CATALOGUE.len())
}

impl Sensor {
    /// A sensor with its own gain of 1, on the frame.
    pub fn new(cutoff_hz: f64, order: usize, limit_g: f64, channel: Channel) -> Self {
        Self { cutoff_hz, order, gain: 1.0, limit_g, on_payload: false, channel }
    }
}
