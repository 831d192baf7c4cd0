//! Keys of former versions, and what took their place.

/// Former key and what to write instead.
const RENAMED: [(&str, &str); 1] = [(
    "limits.wall_extrusions",
    "the thinnest wall is the printer's: write min_wall_nozzles = 2.14 below [override.printers.\"generic-0.4\"], with the name of your printer, \
     or leave it out",
)];

/// What took the place of a key that former versions knew.
pub(super) fn now(key: &str) -> Option<&'static str> {
    RENAMED.iter().find(|(former, _)| *former == key).map(|(_, now)| *now)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::parameters;

    #[test]
    fn analytic_no_former_key_is_a_key() {
        for (former, now) in RENAMED {
            assert!(parameters().all(|p| format!("{}.{}", p.table, p.key) != former), "{former} is in use again");
            assert!(!now.is_empty());
        }
    }
}
