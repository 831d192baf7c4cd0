//! Why there is nothing to fit.

use super::left_out::LeftOut;
use super::waves::Unusable;
use crate::impact::effects::CATALOGUE;
use crate::impact::measured::{FreeFallOffset, Hint};

/// Why there is nothing to fit.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FitError {
    /// Drops of several frames.
    #[error("these are drops of {} frames: {}; a fit is of one, name its folders alone", .frames.len(), .frames.join(", "))]
    Frames {
        /// Their names.
        frames: Vec<String>,
    },
    /// Readings that are not what the model predicts.
    #[error(transparent)]
    Readings(#[from] Hint),
    /// Readings that gravity was taken off.
    #[error("{0}")]
    Gravity(FreeFallOffset),
    /// All left out.
    #[error(
        "none of the {count} drops can be fitted{}",
        if .symptoms.is_empty() { of_first(.first) } else { format!(": {}", .symptoms.join("; ")) }
    )]
    NoDrops {
        /// How many there were.
        count: usize,
        /// What the records show together.
        symptoms: Vec<String>,
        /// The first that was left out.
        first: Option<LeftOut>,
    },
    /// All left out, most of them because the sensor was at its end.
    #[error(
        "none of the {count} drops can be fitted: {saturated} are saturated. Measure with a sensor of a larger range, or from lower heights; --all fits saturated drops, which suits a model with sensor_saturation only"
    )]
    Saturated {
        /// How many drops there were.
        count: usize,
        /// How many of them have the flag.
        saturated: usize,
    },
    /// A magnitude of drops that have one axis.
    #[error("{one_axis} of the {count} drops have one axis only: give --channel axial, or the columns x, y and z")]
    OneAxis {
        /// How many have one axis only.
        one_axis: usize,
        /// How many there are.
        count: usize,
    },
    /// Mean waves need more.
    #[error(transparent)]
    Unusable(#[from] Unusable),
    /// A name that the model does not have.
    #[error("the model has no parameter `{key}`; it has {known}{}", of_effect(key))]
    NoParameter {
        /// The name.
        key: String,
        /// Those there are.
        known: String,
    },
    /// Fewer numbers than parameters.
    #[error("{numbers} numbers are compared, {free} parameters are free: leave some out with --free, or give drops from more heights")]
    TooFewNumbers {
        /// How many are compared.
        numbers: usize,
        /// How many are free.
        free: usize,
    },
    /// A trial covariance that cannot be inverted.
    #[error("the trial covariance is singular: give more drops a height")]
    Singular,
    /// The paper's objective compares samples before the peak.
    #[error(
        "no drop has a sample between its trigger and its peak: the paper's objective compares nothing; use --objective ml, or a faster logger"
    )]
    NothingBeforePeaks,
    /// A parameter that nothing depends on.
    #[error(
        "nothing that is compared depends on `{key}`: every value would be as good; leave it out with --free, or use other drops or --objective ml"
    )]
    NoInfluence {
        /// Its name.
        key: &'static str,
    },
    /// The simulation diverges at the starting values.
    #[error("the simulation diverges at the starting values: change k and c in the model file")]
    Diverges,
}

/// How a model gets a parameter that an effect of the catalogue has.
fn of_effect(key: &str) -> String {
    let of = CATALOGUE.into_iter().find(|spec| spec.parameters.iter().any(|parameter| parameter.key == key));
    of.map_or(String::new(), |spec| format!(". It is one of the effect {}: write its table [effects.{0}] into the model file", spec.id))
}

/// Why the first of drops was left out, where all were.
fn of_first(first: &Option<LeftOut>) -> String {
    let first = first.as_ref().map_or(String::new(), |LeftOut { trial, reason, .. }| format!("; the first is `{trial}`: {reason}"));
    format!("{first}; `flexframe measure` says why of each")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planted_a_parameter_of_an_effect_that_a_model_lacks_is_told_with_its_table() {
        let said = |key: &str| FitError::NoParameter { key: key.into(), known: "k, c".into() }.to_string();
        assert_eq!(
            said("k_m"),
            "the model has no parameter `k_m`; it has k, c. It is one of the effect maxwell_branch: write its table [effects.maxwell_branch] \
             into the model file"
        );
        assert_eq!(said("q"), "the model has no parameter `q`; it has k, c");
    }
}
