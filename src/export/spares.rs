//! How many more than needed to buy: one rule for each kind, in one record.

/// What is bought over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spares {
    /// One for every ten begun: small things fall and roll away.
    PerTen,
    /// As many again: they are what breaks first.
    Set,
    /// None.
    None,
}

/// A rule: of which kinds of the catalogue, what, and in words.
#[derive(Debug)]
pub struct SpareRule {
    /// Kinds of bought parts.
    pub kinds: &'static [&'static str],
    /// What is bought over.
    pub spares: Spares,
    /// What it says to a person.
    pub words: &'static str,
}

/// All of them; no other kind has spares. The numbers are a choice, not a statistic of losses.
pub const SPARE_RULES: [SpareRule; 3] = [
    SpareRule {
        kinds: &["screw", "other", "magnet"],
        spares: Spares::PerTen,
        words: "of screws, ties, dampers, nuts and magnets one for every ten begun",
    },
    SpareRule { kinds: &["propeller"], spares: Spares::Set, words: "of propellers a second set" },
    SpareRule {
        kinds: &["motor", "battery", "board", "camera", "sensor", "rod", "connector", "receiver", "buzzer", "gps", "fpv_camera"],
        spares: Spares::None,
        words: "of everything else none",
    },
];

/// How many of a kind to buy where some are needed.
pub fn with_spares(kind: &str, needed: u32) -> u32 {
    let rule = SPARE_RULES.iter().find(|rule| rule.kinds.contains(&kind));
    match rule.map_or(Spares::None, |rule| rule.spares) {
        Spares::PerTen => needed + needed.div_ceil(10),
        Spares::Set => 2 * needed,
        Spares::None => needed,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::roles::ROLES;

    #[test]
    fn analytic_one_of_ten_begun_and_a_set_of_propellers() {
        let screws = [0, 1, 4, 10, 11, 16, 20].map(|needed| with_spares("screw", needed));
        assert_eq!(screws, [0, 2, 5, 11, 13, 18, 22]);
        assert_eq!([with_spares("propeller", 4), with_spares("motor", 4), with_spares("supply", 1)], [8, 4, 1]);
    }

    #[test]
    fn analytic_every_kind_that_is_bought_has_one_rule() {
        for (role, _, kind) in ROLES {
            assert_eq!(SPARE_RULES.iter().filter(|rule| rule.kinds.contains(&kind)).count(), 1, "{role}");
        }
    }
}
