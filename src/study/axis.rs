//! What differs between the rows of a study.

use std::collections::BTreeSet;

use crate::params::parameter::Parameter;
use crate::variant::Vary;

/// Something that differs between the rows.
#[derive(Clone)]
pub enum Axis {
    /// A number between two bounds.
    Number(Vary),
    /// A number from a table.
    Listed(&'static Parameter),
    /// A number that is no parameter, or none, by its key.
    Stated(String),
    /// A name out of several.
    Name {
        /// The key with its table.
        key: String,
        /// The names.
        names: Vec<String>,
    },
}

/// What an axis is in a row.
#[derive(Clone, Debug, PartialEq)]
pub enum Input {
    /// A number.
    Number(f64),
    /// A name.
    Name(String),
    /// Nothing: the row has no such thing.
    None,
}

impl Input {
    /// As a field of a table.
    pub fn field(&self) -> String {
        match self {
            Self::Number(value) => value.to_string(),
            Self::Name(name) => name.clone(),
            Self::None => String::new(),
        }
    }
}

/// An axis whose key another one before it has.
pub(super) fn twice(axes: &[Axis]) -> Option<&Axis> {
    let mut keys = BTreeSet::new();
    axes.iter().find(|axis| !keys.insert(axis.key()))
}

impl Axis {
    /// Its key with its table.
    pub fn key(&self) -> String {
        match self {
            Self::Number(vary) => vary.key(),
            Self::Listed(parameter) => format!("{}.{}", parameter.table, parameter.key),
            Self::Stated(key) | Self::Name { key, .. } => key.clone(),
        }
    }

    /// Its unit; empty for names.
    pub fn unit(&self) -> &'static str {
        match self {
            Self::Number(vary) => vary.parameter.unit(),
            Self::Listed(parameter) => parameter.unit(),
            Self::Stated(_) | Self::Name { .. } => "",
        }
    }

    /// What it is at a share of the way from its first value to its last.
    pub(super) fn at(&self, share: f64) -> Input {
        match self {
            Self::Number(vary) => Input::Number(vary.at(share)),
            Self::Listed(parameter) => Input::Number(parameter.min + share * (parameter.max - parameter.min)),
            Self::Stated(_) => Input::None,
            Self::Name { names, .. } => Input::Name(names[((share * names.len() as f64) as usize).min(names.len() - 1)].clone()),
        }
    }
}
