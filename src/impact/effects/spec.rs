//! The single record of an effect: everything that the rest of the program knows of it.

use std::sync::Arc;

use super::effect::Effect;
use super::frame_curve::FrameCurve;
use super::generator::Generator;
use super::parameter::{Choice, Parameter};

/// Where an effect acts in the order of composition.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// A force in the sum.
    Force,
    /// A force on top, after the tension factor; never pulls.
    Stop,
    /// Changes how fall, contact or sensor act.
    Arrangement,
}

/// Which models may have an effect.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Availability {
    /// Every model has it: spring and damper of the base.
    Base,
    /// Any model may have it on top of the base.
    Any,
    /// A model may have it when it knows a frame's static curve.
    WithFrameCurve,
}

/// What an effect is built from.
#[derive(Clone, Copy, Debug)]
pub struct Inputs<'a> {
    /// Values in SI, in the order of the parameters.
    pub values: &'a [f64],
    /// Index of the chosen word.
    pub word: usize,
    /// The frame's static curve, where the model knows one.
    pub frame_curve: Option<&'a Arc<FrameCurve>>,
}

/// What is known of a model before an effect is fitted on top of it.
#[derive(Clone, Copy, Debug)]
pub struct StartContext {
    /// Cutoff of the sensor, Hz.
    pub cutoff_hz: f64,
    /// Share and frequency, Hz, of the payload mode that is equivalent to a frame's own modes.
    pub frame_mode: Option<[f64; 2]>,
}

/// An effect's record in the catalogue. A new effect is a file with one such record and a line in the catalogue.
#[derive(Debug)]
pub struct Spec {
    /// Its id in model files and results.
    pub id: &'static str,
    /// Its name in words.
    pub title: &'static str,
    /// Where it acts.
    pub stage: Stage,
    /// Which models may have it.
    pub availability: Availability,
    /// Its parameters, in the order of the values that `build` takes.
    pub parameters: &'static [Parameter],
    /// A choice that is no number.
    pub choice: Option<Choice>,
    /// Names of the states that it adds to those of the body; they begin at zero.
    pub states: &'static [&'static str],
    /// Values, in the units of model files, from which a fit begins: dense enough that it finds its way from the nearest.
    pub starts: fn(&StartContext) -> Vec<Vec<f64>>,
    /// Makes the effect.
    pub build: fn(&Inputs) -> Box<dyn Effect>,
    /// How the generator of synthetic drops acts for it, written independently of `build`.
    pub generator: Generator,
}

impl Spec {
    /// Whether values in the file's units switch the effect off.
    pub fn is_off(&self, values: &[f64]) -> bool {
        self.parameters.iter().zip(values).any(|(parameter, value)| parameter.off == Some(*value))
    }

    /// Whether it belongs to the base model.
    pub fn is_base(&self) -> bool {
        self.availability == Availability::Base
    }

    /// Whether it takes the points of a frame's static curve from the model file.
    pub fn takes_frame_curve(&self) -> bool {
        self.availability == Availability::WithFrameCurve
    }
}

impl PartialEq for Spec {
    fn eq(&self, other: &Self) -> bool {
        self.id == other.id
    }
}

/// Starts of an effect with one parameter.
pub(super) fn singles(values: &[f64]) -> Vec<Vec<f64>> {
    values.iter().map(|value| vec![*value]).collect()
}

/// Starts at every product of the values of a first and a second parameter; the rest is the same for all.
pub(super) fn products(first: &[f64], second: &[f64], rest: &[f64]) -> Vec<Vec<f64>> {
    first.iter().flat_map(|a| second.iter().map(move |b| [&[*a, *b], rest].concat())).collect()
}
