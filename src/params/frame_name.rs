//! What a frame may be called: its name is that of a folder in `out/`, and the beginning of others.

/// Longest name, letters: a folder's name has 255 bytes at the most, and words stand after a frame's in it.
const LONGEST: usize = 100;

/// What is wrong with a name; none of one that a frame may have.
pub fn fault(name: &str) -> Option<String> {
    let letters = name.chars().count();
    if letters > LONGEST {
        return Some(format!("the name {name:?} has {letters} letters, a frame's has at most {LONGEST}"));
    }
    let plain = !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || "-_.".contains(c)) && !name.starts_with('.');
    (!plain).then(|| format!("the name {name:?} cannot be a folder's name"))
}

/// What a name has to be.
pub fn rule() -> String {
    format!("use letters from a to z and A to Z, digits, '-', '_' and '.' only, at most {LONGEST} of them, and do not begin with '.'")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_names_are_those_of_folders_everywhere() {
        let longest = "a".repeat(LONGEST);
        for name in ["a", "light-2.v3_b", "7", longest.as_str()] {
            assert_eq!(fault(name), None, "{name}");
        }
        for name in ["", ".a", "..", "a b", "a/b", "a\\b", "é", "a\nb", "a:b"] {
            assert!(fault(name).is_some_and(|fault| fault.contains("cannot be a folder's name")), "{name:?}");
        }
        assert!(fault(&"a".repeat(LONGEST + 1)).is_some_and(|fault| fault.contains("has 101 letters, a frame's has at most 100")));
    }
}
