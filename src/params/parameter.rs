//! What a parameter is: key, bounds, meaning, and what it drives.

use super::part_name::PartName;

/// One number of a frame file.
#[derive(Debug, Clone, Copy)]
pub struct Parameter {
    /// Table of the frame file.
    pub table: &'static str,
    /// What the table is about.
    pub table_doc: &'static str,
    /// Key in the table; its ending is the unit.
    pub key: &'static str,
    /// Lowest value allowed.
    pub min: f64,
    /// Highest value allowed.
    pub max: f64,
    /// What it is.
    pub doc: &'static str,
    /// Printed parts whose shape as printed follows it; how they fold and where they sit does not count.
    pub drives: &'static [PartName],
}

impl Parameter {
    /// What a frame file has to give, for a message.
    pub fn expected(&self) -> String {
        if self.unit().is_empty() { "a number".into() } else { format!("a number in {}", self.unit()) }
    }

    /// The unit that the key ends in; empty for a plain number.
    pub fn unit(&self) -> &'static str {
        match self.key.rsplit('_').next() {
            Some("mm") => "mm",
            Some("deg") => "°",
            Some("g") => "g",
            _ => "",
        }
    }
}

/// A group of parameters: a struct of numbers, its catalogue, and how it is filled from a frame file.
macro_rules! parameters {
    (
        $(#[doc = $group_doc:literal])+
        pub struct $group:ident in $table:literal {
            $( $(#[doc = $doc:literal])+ $key:ident: $min:literal..=$max:literal => [$($part:ident),*], )+
        }
    ) => {
        $(#[doc = $group_doc])+
        #[derive(Clone, Debug, PartialEq)]
        pub struct $group {
            $( $(#[doc = $doc])+ pub $key: f64, )+
        }

        impl $group {
            const DOC: &'static str = concat!($($group_doc),+);

            /// What a frame file may say here.
            pub const CATALOGUE: &'static [$crate::params::parameter::Parameter] = &[$(
                $crate::params::parameter::Parameter {
                    table: $table,
                    table_doc: Self::DOC,
                    key: stringify!($key),
                    min: $min,
                    max: $max,
                    doc: concat!($($doc),+),
                    drives: &[$(PartName::$part),*],
                },
            )+];

            /// One of this group's numbers.
            pub(super) fn value(&self, key: &str) -> Option<f64> {
                match key {
                    $( stringify!($key) => Some(self.$key), )+
                    _ => None,
                }
            }

            /// Takes this group's numbers by key.
            pub(super) fn read<E>(mut number: impl FnMut(&$crate::params::parameter::Parameter) -> Result<f64, E>) -> Result<Self, E> {
                let mut rows = Self::CATALOGUE.iter();
                Ok(Self { $( $key: number(rows.next().unwrap_or(&Self::CATALOGUE[0]))?, )+ })
            }
        }
    };
}
pub(super) use parameters;
