//! Numbers as people and spreadsheets write them.

/// A finite number; a comma in it is a decimal one.
pub fn decimal(text: &str) -> Option<f64> {
    let value = text.parse::<f64>().or_else(|_| text.replacen(',', ".", 1).parse::<f64>());
    value.ok().filter(|value| value.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_a_comma_is_a_decimal_one() {
        assert_eq!(["12.5", "12,5", "-0,25e1", "7"].map(decimal), [Some(12.5), Some(12.5), Some(-2.5), Some(7.0)]);
        assert_eq!(["", "1,234,5", "windy", "nan", "inf"].map(decimal), [None; 5]);
    }
}
