//! Which parameters of a model a fit may change, and on which scale.

use crate::impact::effects::{Model, SENSOR_SATURATION, Scale, Spec};

/// A parameter that is free.
#[derive(Clone, Copy, Debug)]
pub struct Free {
    /// Its effect.
    pub spec: &'static Spec,
    /// Which of the effect's parameters.
    pub at: usize,
}

/// Smallest value of a logarithmic parameter whose bounds begin at zero, over its largest.
const LEAST: f64 = 1e-4;
/// Change of a logarithm for a difference quotient.
const LOG_STEP: f64 = 5e-3;

impl Free {
    /// A parameter of an effect.
    pub fn new(spec: &'static Spec, at: usize) -> Self {
        Self { spec, at }
    }

    /// Its key.
    pub fn key(&self) -> &'static str {
        self.spec.parameters[self.at].key
    }

    /// From the file's unit to the fit's scale.
    pub fn inward(&self, value: f64) -> f64 {
        if self.is_logarithmic() { libm::log(value.max(self.least())) } else { value }
    }

    /// From the fit's scale to the file's unit.
    pub fn outward(&self, scaled: f64) -> f64 {
        let parameter = &self.spec.parameters[self.at];
        let value = if self.is_logarithmic() { libm::exp(scaled) } else { scaled };
        value.clamp(parameter.min, parameter.max)
    }

    /// Bounds on the fit's scale.
    pub fn bounds(&self) -> [f64; 2] {
        let parameter = &self.spec.parameters[self.at];
        if self.is_logarithmic() { [libm::log(self.least()), libm::log(parameter.max)] } else { [parameter.min, parameter.max] }
    }

    /// Change for a difference quotient.
    pub fn step(&self) -> f64 {
        let parameter = &self.spec.parameters[self.at];
        match parameter.scale {
            Scale::Logarithmic => LOG_STEP,
            Scale::LinearStep(step) => step,
            Scale::Linear | Scale::Fraction => 1e-3 * (parameter.max - parameter.min),
        }
    }

    /// Whether an estimate may end at the bound where it lies: the ends of a share are physical limits, none of something is its natural end (no damping
    /// where that has a default, a payload without mass that still carries the sensor).
    pub fn may_end_at(&self, scaled: f64) -> bool {
        let parameter = &self.spec.parameters[self.at];
        let is_lower = scaled - self.bounds()[0] < self.step();
        // The floor of a logarithm is no nothing.
        let is_zero = self.outward(self.bounds()[0]) == parameter.min;
        let is_none = (parameter.default.is_some() && parameter.min == 0.0) || parameter.off == Some(parameter.min);
        parameter.scale == Scale::Fraction || (is_none && is_zero && is_lower)
    }

    /// How far what has a default may be from it before anything is measured, as a standard deviation on the fit's scale: a choice, a factor of three,
    /// or three tenths of the range.
    pub fn default_spread(&self) -> f64 {
        let parameter = &self.spec.parameters[self.at];
        if self.is_logarithmic() { libm::log(3.0) } else { 0.3 * (parameter.max - parameter.min) }
    }

    /// Whether a model has another value than what it is without a fit.
    fn is_off_its_default(&self, model: &Model) -> bool {
        let default = self.spec.parameters[self.at].default;
        default.zip(model.value(self.spec.id, self.key())).is_some_and(|(default, value)| default != value)
    }

    fn is_logarithmic(&self) -> bool {
        self.spec.parameters[self.at].scale == Scale::Logarithmic
    }

    fn least(&self) -> f64 {
        let parameter = &self.spec.parameters[self.at];
        if parameter.min > 0.0 { parameter.min } else { LEAST * parameter.max }
    }
}

/// A model with free parameters.
#[derive(Clone, Debug)]
pub struct Layout {
    /// What stays.
    pub model: Model,
    /// What may change, in order.
    pub free: Vec<Free>,
}

impl Layout {
    /// Frees spring, damper and everything on top of them that has no default.
    pub fn of(model: Model) -> Self {
        let mut free = Vec::new();
        for listed in &model.effects {
            let parameters = listed.spec.parameters.iter().enumerate();
            free.extend(parameters.filter(|(_, parameter)| parameter.default.is_none()).map(|(at, _)| Free::new(listed.spec, at)));
        }
        Self { model, free }
    }

    /// The same with what has a default and not its value: a fit has found it in a smaller set, or a start asks for it. It is a parameter of this
    /// set as of that one.
    pub fn of_set(model: Model) -> Self {
        let Self { model, free: mut all } = Self::whole(model);
        all.retain(|free| free.spec.parameters[free.at].default.is_none() || free.is_off_its_default(&model));
        Self { model, free: all }
    }

    /// Frees everything, defaults too.
    pub fn whole(model: Model) -> Self {
        let every = |listed: &crate::impact::effects::Listed| {
            let spec = listed.spec;
            (0..spec.parameters.len()).map(move |at| Free::new(spec, at))
        };
        let free = model.effects.iter().flat_map(every).collect();
        Self { model, free }
    }

    /// Frees what is named alone; `None` when a name is not a parameter of the model.
    pub fn named(model: Model, keys: &[&str]) -> Option<Self> {
        let find = |key: &&str| {
            let of = |spec: &'static Spec| spec.parameters.iter().position(|parameter| parameter.key == *key).map(|at| Free::new(spec, at));
            model.effects.iter().find_map(|listed| of(listed.spec))
        };
        let free = keys.iter().map(find).collect::<Option<Vec<Free>>>()?;
        Some(Self { model, free })
    }

    /// With the limit of the sensor at a level at which readings are seen to pile up, instead of free.
    #[must_use]
    pub fn with_seen_limit(mut self, level_g: f64) -> Self {
        let id = SENSOR_SATURATION.id;
        self.free.retain(|free| free.spec.id != id);
        for listed in self.model.effects.iter_mut().filter(|listed| listed.spec.id == id) {
            listed.values = vec![level_g];
        }
        self
    }

    /// The free parameters' values on the fit's scale.
    pub fn values(&self) -> Vec<f64> {
        self.free.iter().map(|free| free.inward(self.model.value(free.spec.id, free.key()).unwrap_or(0.0))).collect()
    }

    /// The model with other values.
    pub fn model_at(&self, scaled: &[f64]) -> Model {
        let mut model = self.model.clone();
        for (free, scaled) in self.free.iter().zip(scaled) {
            if let Some(listed) = model.effects.iter_mut().find(|listed| listed.spec.id == free.spec.id) {
                listed.values[free.at] = free.outward(*scaled);
            }
        }
        model
    }

    /// Bounds on the fit's scale.
    pub fn bounds(&self) -> Vec<[f64; 2]> {
        self.free.iter().map(Free::bounds).collect()
    }

    /// Changes for difference quotients.
    pub fn steps(&self) -> Vec<f64> {
        self.free.iter().map(Free::step).collect()
    }
}
