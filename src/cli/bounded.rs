//! Numbers of the command line: each option that takes one states its bounds here, and its refusal names them.

use clap::builder::ValueParser;

/// A number from a least to a most one; the unit is for the message.
pub(super) fn number([min, max]: [f64; 2], unit: &'static str) -> ValueParser {
    parser(min, max, unit, move |value: f64| (min..=max).contains(&value))
}

/// A number of either sign whose magnitude is from a least to a most one: what is divided by.
pub(super) fn magnitude([min, max]: [f64; 2], unit: &'static str) -> ValueParser {
    parser(min, max, unit, move |value: f64| (min..=max).contains(&value.abs()))
}

/// A count from a least to a most one.
pub(super) fn count([min, max]: [u32; 2]) -> ValueParser {
    let parse = move |text: &str| match text.parse::<u32>() {
        Ok(count) if (min..=max).contains(&count) => Ok(count as usize),
        Ok(_) => Err(out_of_bounds(&min, &max, "")),
        Err(error) => Err(format!("{error}: give {min} to {max}")),
    };
    ValueParser::new(parse)
}

fn parser(min: f64, max: f64, unit: &'static str, good: impl Fn(f64) -> bool + Clone + Send + Sync + 'static) -> ValueParser {
    let parse = move |text: &str| match text.parse::<f64>() {
        Ok(value) if good(value) => Ok(value),
        Ok(_) => Err(out_of_bounds(&min, &max, unit)),
        Err(error) => Err(format!("{error}: give {min} to {max}{}{unit}", if unit.is_empty() { "" } else { " " })),
    };
    ValueParser::new(parse)
}

fn out_of_bounds(min: &dyn std::fmt::Display, max: &dyn std::fmt::Display, unit: &str) -> String {
    format!("out of bounds: give {min} to {max}{}{unit}", if unit.is_empty() { "" } else { " " })
}
