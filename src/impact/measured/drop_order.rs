//! The order in which drops were made, as their names tell it.

use std::cmp::Ordering;

/// Puts drops in the order of their files' names, and those of one file in the order of their trials where all of these are numbers; `of` gives
/// the names of file and trial. Numbers within names count as numbers: `acc_b-2` comes before `acc_b-10`. So the order does not depend on that in
/// which files are given.
///
/// *When it is wrong:* where files were named otherwise than one after the other.
pub(super) fn in_order<T>(drops: &mut [T], of: impl Fn(&T) -> [&str; 2]) {
    let numbered = drops.iter().all(|drop| number(of(drop)[1]).is_some());
    drops.sort_by(|a, b| {
        let ([a_file, a_trial], [b_file, b_trial]) = (of(a), of(b));
        let trials = if numbered { number(a_trial).partial_cmp(&number(b_trial)).unwrap_or(Ordering::Equal) } else { Ordering::Equal };
        by_number(a_file, b_file).then(trials)
    });
}

fn number(trial: &str) -> Option<f64> {
    trial.trim().parse().ok().filter(|number: &f64| number.is_finite())
}

/// Compares names, runs of digits by their value.
fn by_number(a: &str, b: &str) -> Ordering {
    let (mut a_rest, mut b_rest) = (a, b);
    while let (Some(a_next), Some(b_next)) = (a_rest.chars().next(), b_rest.chars().next()) {
        let (a_digits, b_digits) = (digits(a_rest), digits(b_rest));
        let (order, lengths) = if a_digits.is_empty() || b_digits.is_empty() {
            (a_next.cmp(&b_next), [a_next.len_utf8(), b_next.len_utf8()])
        } else {
            let [a_value, b_value] = [a_digits, b_digits].map(|digits| digits.trim_start_matches('0'));
            (a_value.len().cmp(&b_value.len()).then(a_value.cmp(b_value)), [a_digits.len(), b_digits.len()])
        };
        if order != Ordering::Equal {
            return order;
        }
        (a_rest, b_rest) = (&a_rest[lengths[0]..], &b_rest[lengths[1]..]);
    }
    a_rest.len().cmp(&b_rest.len()).then(a.cmp(b))
}

/// The digits that a text begins with.
fn digits(text: &str) -> &str {
    let end = text.find(|letter: char| !letter.is_ascii_digit()).unwrap_or(text.len());
    &text[..end]
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn analytic_numbers_in_names_count_as_numbers() {
        let mut names = ["b-10.bin", "b-9.bin", "a/2.csv", "b-010.bin", "b-1.bin", "a/10.csv", "a", "", "b-1", "µ2", "µ10"];
        names.sort_by(|a, b| by_number(a, b));
        assert_eq!(names, ["", "a", "a/2.csv", "a/10.csv", "b-1", "b-1.bin", "b-9.bin", "b-010.bin", "b-10.bin", "µ2", "µ10"]);
    }

    proptest! {
        #[test]
        fn analytic_the_order_of_names_is_total(names in prop::collection::vec("[a0-9µ]{0,6}", 3)) {
            let [a, b, c] = [&names[0], &names[1], &names[2]];
            prop_assert_eq!(by_number(a, b), by_number(b, a).reverse());
            prop_assert_eq!(by_number(a, b) == Ordering::Equal, a == b);
            if by_number(a, b) != Ordering::Greater && by_number(b, c) != Ordering::Greater {
                prop_assert_ne!(by_number(a, c), Ordering::Greater);
            }
        }
    }
}
