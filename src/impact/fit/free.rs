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

    /// Whether its bounds are physical limits, at which an estimate may lie.
    pub fn has_physical_bounds(&self) -> bool {
        self.spec.parameters[self.at].scale == Scale::Fraction
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
