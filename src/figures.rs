//! Numbers as people read them: no minus before a zero, and two numbers that differ look different.

/// Most decimals of a number in a message.
const MOST_PLACES: usize = 6;

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_zero_has_no_sign() {
        assert_eq!([decimals(-0.001, 2), decimals(-0.0, 0), decimals(-0.006, 2), decimals(1.0, 1)], ["0.00", "0", "-0.01", "1.0"]);
    }

    #[test]
    fn analytic_numbers_that_differ_look_different() {
        assert_eq!(told_apart(0.8, 0.86, 2), ["0.80", "0.86"]);
        assert_eq!(told_apart(210.003, 210.0, 2), ["210.003", "210.000"]);
        assert_eq!(told_apart(4.0, 4.0, 2), ["4.00", "4.00"]);
        assert_eq!(told_apart(4.0 + 1e-12, 4.0, 2), ["4.00", "4.00"]);
    }
}
