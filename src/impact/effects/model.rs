//! An impact model as meant: body, sensor and effects, every number within its bounds.

use std::sync::Arc;

use super::effect::{Arrangement, Effect, Spec, Stage};
use super::sensor::{Channel, Sensor};
use super::{Fall, FrameCurve, Softening, every, linear_damper, linear_spring};
use crate::impact::body::Body;

/// An effect with its values.
#[derive(Clone, Debug)]
pub struct Listed {
    /// The catalogue entry.
    pub spec: &'static Spec,
    /// Values in the units of the model file, in the order of the entry's parameters.
    pub values: Vec<f64>,
    /// Index of the chosen word, where the effect has a choice.
    pub word: usize,
}

impl Listed {
    /// The effect at work, or `None` when its values switch it off.
    pub fn effect(&self) -> Option<Box<dyn Effect>> {
        if self.spec.is_off(&self.values) {
            return None;
        }
        let mut si = [0.0; 4];
        for ((si, value), parameter) in si.iter_mut().zip(&self.values).zip(self.spec.parameters) {
            *si = value * parameter.si;
        }
        Some((self.spec.build)(&si[..self.values.len()], self.word))
    }
}

/// A model of the drop.
#[derive(Clone, Debug)]
pub struct Model {
    /// Its name.
    pub name: String,
    /// The body that falls.
    pub body: Body,
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
    pub fn base(body: Body, sensor: Sensor, stiffness_n_m: f64, damping_n_s_m: f64) -> Self {
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
        [("linear_spring", "k"), ("linear_damper", "c")].map(|(effect, key)| self.value(effect, key).unwrap_or(0.0))
    }

    /// The model with stiffness and damping of the base multiplied by factors.
    #[must_use]
    pub fn scaled(&self, factors: [f64; 2]) -> Self {
        let mut model = self.clone();
        for (effect, factor) in ["linear_spring", "linear_damper"].into_iter().zip(factors) {
            model.effects.iter_mut().filter(|listed| listed.spec.id == effect).for_each(|listed| listed.values[0] *= factor);
        }
        model
    }

    /// How fall, contact and sensor are arranged.
    pub fn arrangement(&self) -> Arrangement {
        let mut arrangement =
            Arrangement { fall: Fall::default(), tension_factor: 1.0, feet: None, softening: None, payload: None, sensor: self.sensor };
        let share = self.value("frame_force_curve", "share").filter(|share| *share > 0.0);
        arrangement.softening = share.zip(self.frame_curve.clone()).map(|(share, curve)| Softening { share, curve });
        for effect in self.effects.iter().filter(|listed| listed.spec.stage == Stage::Arrangement).filter_map(Listed::effect) {
            effect.arrange(&mut arrangement);
        }
        arrangement
    }
}

/// Place of an effect in the order of composition.
pub(super) fn order(spec: &Spec) -> usize {
    every().position(|known| known.id == spec.id).unwrap_or(usize::MAX)
}

impl Sensor {
    /// A sensor with its own gain of 1, on the frame.
    pub fn new(cutoff_hz: f64, order: usize, limit_g: f64, channel: Channel) -> Self {
        Self { cutoff_hz, order, gain: 1.0, limit_g, on_payload: false, channel }
    }
}
