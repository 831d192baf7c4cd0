//! Numbers as people read them: no minus before a zero, and two numbers that differ look different.

/// Most decimals of a number in a message.
const MOST_PLACES: usize = 6;

/// Significant digits of an estimated parameter.
pub const PARAMETER_DIGITS: usize = 4;
/// Numbers below this power of ten are written with it.
const LEAST_MAGNITUDE: i32 = -3;

/// A number with some decimals; `0.00`, never `-0.00`.
pub fn decimals(value: f64, places: usize) -> String {
    let text = format!("{value:.places$}");
    match text.strip_prefix('-') {
        Some(rest) if rest.chars().all(|digit| matches!(digit, '0' | '.')) => rest.into(),
        _ => text,
    }
}

/// A number and the limit that it is compared with, with the decimals asked for, or with as many more as tell them apart.
pub fn told_apart(value: f64, limit: f64, places: usize) -> [String; 2] {
    let written = |places: usize| [decimals(value, places), decimals(limit, places)];
    let apart = (places..=MOST_PLACES.max(places)).map(written).find(|[value, limit]| value != limit);
    apart.unwrap_or_else(|| written(places))
}

/// To a thousandth, so that the last bits of a sum do not reach a file.
pub fn to_thousandth(value: f64) -> f64 {
    (value * 1000.0).round() / 1000.0
}

/// A number with so many significant digits, those before the point all written; below a thousandth with a power of ten.
pub fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 || !value.is_finite() {
        return decimals(value, 0);
    }
    let magnitude = libm::floor(libm::log10(value.abs())) as i32;
    if magnitude < LEAST_MAGNITUDE {
        return format!("{value:.*e}", digits.saturating_sub(1));
    }
    decimals(value, usize::try_from(digits as i32 - 1 - magnitude).unwrap_or(0))
}

/// A p-value with up to three significant digits: with three decimals, ten of a thousand replicates would be 0.010, the bound that they
/// are below.
pub fn p_value(p: f64) -> String {
    let text = significant(p, 3);
    if text.contains('.') && !text.contains('e') { text.trim_end_matches('0').trim_end_matches('.').into() } else { text }
}

/// A number in hundredths, or a dash for one that could not be computed.
pub fn hundredths(value: f64) -> String {
    if value.is_finite() { format!("{value:.2}") } else { "-".into() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_zero_has_no_sign() {
        assert_eq!([decimals(-0.001, 2), decimals(-0.0, 0), decimals(-0.006, 2), decimals(1.0, 1)], ["0.00", "0", "-0.01", "1.0"]);
    }

    #[test]
    fn analytic_p_values_do_not_reach_a_bound_that_they_are_below() {
        assert_eq!([0.5, 0.0499, 0.0099, 0.001, 0.0, 1.0, 1.2e-7].map(p_value), ["0.5", "0.0499", "0.0099", "0.001", "0", "1", "1.20e-7"]);
    }

    #[test]
    fn analytic_numbers_that_differ_look_different() {
        assert_eq!(told_apart(0.8, 0.86, 2), ["0.80", "0.86"]);
        assert_eq!(told_apart(210.003, 210.0, 2), ["210.003", "210.000"]);
        assert_eq!(told_apart(4.0, 4.0, 2), ["4.00", "4.00"]);
        assert_eq!(told_apart(4.0 + 1e-12, 4.0, 2), ["4.00", "4.00"]);
    }

    #[test]
    fn analytic_significant_digits_are_the_first_ones() {
        let written = [20_312.62, 47.309_52, 0.336_6, 1.0, -0.002_3].map(|value| significant(value, 4));
        assert_eq!(written, ["20313", "47.31", "0.3366", "1.000", "-0.002300"]);
        assert_eq!([7.588e-4, -8.05e-7].map(|value| significant(value, 3)), ["7.59e-4", "-8.05e-7"]);
        assert_eq!([0.0, -0.0, f64::INFINITY].map(|value| significant(value, 4)), ["0", "0", "inf"]);
    }
}
