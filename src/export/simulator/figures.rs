//! Numbers in the files of simulators.

/// To nine significant digits, never minus zero: within five parts in a thousand million, which no mass or place is known to.
pub(super) fn rounded(value: f64) -> f64 {
    format!("{value:.8e}").parse::<f64>().unwrap_or(value) + 0.0
}

/// A number as text, without an exponent.
pub(super) fn number(value: f64) -> String {
    rounded(value).to_string()
}

/// Numbers with spaces between them.
pub(super) fn numbers(values: impl IntoIterator<Item = f64>) -> String {
    values.into_iter().map(number).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn analytic_a_number_reads_back_within_five_parts_in_a_thousand_million(value in -1e6..1e6_f64) {
            let read: f64 = number(value).parse().expect("a number");
            prop_assert!((read - value).abs() <= 5.001e-9 * value.abs());
            prop_assert!(number(value) != "-0");
        }
    }

    #[test]
    fn analytic_lists_have_spaces() {
        assert_eq!(numbers([0.5, -0.0, 1e-7]), "0.5 0 0.0000001");
    }
}
