//! A parameter of an effect: its key, unit, bounds and scale.

/// A parameter of an effect, in the unit of model files and results.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// Key in a model file.
    pub key: &'static str,
    /// Unit of its value there.
    pub unit: &'static str,
    /// One such unit in SI.
    pub si: f64,
    /// Least.
    pub min: f64,
    /// Most.
    pub max: f64,
    /// The value that switches the effect off; `None` where it does not depend on this parameter.
    pub off: Option<f64>,
    /// Value when a model file leaves it out, and what a fit keeps unless asked to free it; `None`: it must be stated.
    pub default: Option<f64>,
    /// The scale on which a fit moves it.
    pub scale: Scale,
    /// What it is.
    pub doc: &'static str,
}

/// The scale on which a fit moves a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scale {
    /// The value itself; difference quotients step by a thousandth of its bounds.
    Linear,
    /// The value itself; difference quotients step by this much, in its unit.
    LinearStep(f64),
    /// The value itself, between two physical limits: an estimate at a bound is a result, not a sign that the fit failed.
    Fraction,
    /// Its logarithm: a ratio describes it better than a difference.
    Logarithmic,
}

/// A choice between words.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice {
    /// Key in a model file.
    pub key: &'static str,
    /// The words; the first is the default.
    pub words: &'static [&'static str],
}
