//! Drop heights as they are stated.

/// Heights are told apart to this, 1/m: a micrometre.
const STEPS_PER_M: f64 = 1e6;

/// The number in metres that a height is written as, m: 70 cm and 0.7 m are one height, whatever their binary fractions.
pub fn stated_m(height_m: f64) -> f64 {
    (height_m * STEPS_PER_M).round() / STEPS_PER_M
}

/// Whether two heights are one.
pub fn is_same_m(a_m: f64, b_m: f64) -> bool {
    stated_m(a_m) == stated_m(b_m)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_centimetres_and_metres_are_one_height() {
        for cm in 1..10_000 {
            let typed: f64 = format!("{}.{:02}", cm / 100, cm % 100).parse().expect("a number");
            assert_eq!(stated_m(1e-2 * f64::from(cm)).to_bits(), typed.to_bits(), "{cm} cm");
        }
        assert!(is_same_m(0.7, 0.700_000_000_1) && !is_same_m(0.7, 0.700_01));
    }
}
