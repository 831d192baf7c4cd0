//! Numbers of the command line: each option that takes one states its bounds here, and its refusal names them.

use std::time::Duration;

use clap::builder::ValueParser;

/// Longest time that is waited for, s: a year.
const LONGEST_S: f64 = 3.2e7;

/// Largest seed, that of a plan's `drops.seed`.
const MOST_SEED: u64 = 9_000_000_000_000_000;

/// A number to show, where bounds allow it.
const EXAMPLE: f64 = 0.5;

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

/// Parses none, or a count within its bounds, both ends included.
pub(super) fn none_or_count([min, max]: [u32; 2]) -> ValueParser {
    let parse = move |text: &str| match text.parse::<u32>() {
        Ok(count) if count == 0 || (min..=max).contains(&count) => Ok(count as usize),
        Ok(_) => Err(format!("{}; or 0 for none", out_of_bounds(&min, &max, ""))),
        Err(error) => Err(format!("{error}: give 0, or {min} to {max}")),
    };
    ValueParser::new(parse)
}

/// A seed of random numbers: what a number of TOML and JSON holds exactly.
pub(super) fn seed() -> clap::builder::RangedU64ValueParser<u64> {
    clap::value_parser!(u64).range(0..=MOST_SEED)
}

/// A time such as 90s, 10m or 2h; a plain number is seconds.
pub(super) fn duration(text: &str) -> Result<Duration, String> {
    let wrong = || format!("{text:?} is no time: give seconds, or a number with s, m or h, such as 10m");
    let units = [('s', 1.0), ('m', 60.0), ('h', 3600.0)];
    let ending = units.iter().find_map(|(letter, seconds)| Some((text.strip_suffix(*letter)?, *seconds)));
    let (number, unit) = ending.unwrap_or((text, 1.0));
    let seconds = number.trim().parse::<f64>().map_err(|_| wrong())? * unit;
    if (0.0..=LONGEST_S).contains(&seconds) { Ok(Duration::from_secs_f64(seconds)) } else { Err(wrong()) }
}

fn parser(min: f64, max: f64, unit: &'static str, good: impl Fn(f64) -> bool + Clone + Send + Sync + 'static) -> ValueParser {
    let parse = move |text: &str| match text.parse::<f64>() {
        Ok(value) if good(value) => Ok(value),
        Ok(_) => Err(out_of_bounds(&min, &max, unit)),
        Err(_) => Err(no_number(min, max, unit)),
    };
    ValueParser::new(parse)
}

/// Text that is no number; a unit behind it is the usual mistake.
fn no_number(min: f64, max: f64, unit: &str) -> String {
    let (in_unit, example) = (if unit.is_empty() { String::new() } else { format!(" in {unit}") }, EXAMPLE.clamp(min, max));
    format!("give a number{in_unit} from {min} to {max}, such as {example}")
}

fn out_of_bounds(min: &dyn std::fmt::Display, max: &dyn std::fmt::Display, unit: &str) -> String {
    format!("out of bounds: give {min} to {max}{}{unit}", if unit.is_empty() { "" } else { " " })
}
