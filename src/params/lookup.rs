//! A parameter by what a person types for it.

use super::frame::catalogue as parameters;
use super::parameter::Parameter;
use super::refusal::nearest;

/// Endings that may be left out, longest first.
const ENDINGS: [&str; 4] = ["_length_mm", "_mm", "_deg", "_g"];
/// How many of the parameters that a beginning may mean are named.
const NAMED: usize = 6;

/// No parameter, or several, have a key like that.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LookupError {
    /// None.
    #[error("there is no parameter `{key}`{}; `flexframe params` lists them", meant(.nearest.as_deref()))]
    Unknown {
        /// What was typed.
        key: String,
        /// The key that looks most like it.
        nearest: Option<String>,
    },
    /// Several begin like that.
    #[error("`{key}` may be any of {}", .several.join(", "))]
    Ambiguous {
        /// What was typed.
        key: String,
        /// Some of the keys.
        several: Vec<String>,
    },
}

fn meant(nearest: Option<&str>) -> String {
    nearest.map_or(String::new(), |near| format!(", did you mean `{near}`?"))
}

/// A parameter by its key, with or without its table; its unit, as `_mm` or `_deg`, and `_length` before it may be left out,
/// and a beginning is enough where only one key has it.
///
/// # Errors
/// When there is none, or more than one.
pub fn lookup(key: &str) -> Result<&'static Parameter, LookupError> {
    found(key).map_err(|begun| match begun[..] {
        [] => LookupError::Unknown { key: key.into(), nearest: meant_by(bare(key)).map(String::from) },
        _ => {
            let several = begun.iter().take(NAMED).map(|p| format!("`{}`", p.key)).collect();
            LookupError::Ambiguous { key: key.into(), several }
        }
    })
}

/// The same where a key may also be something else: nothing is said of what it was meant to be, which takes longer than to look it up.
pub fn known(key: &str) -> Option<&'static Parameter> {
    found(key).ok()
}

/// A key without its table.
fn bare(key: &str) -> &str {
    key.rsplit('.').next().unwrap_or(key)
}

/// The parameter of a key, or those whose keys begin like it where that is not one.
fn found(key: &str) -> Result<&'static Parameter, Vec<&'static Parameter>> {
    let bare = bare(key);
    let table = key.rsplit_once('.').map(|(table, _)| table);
    let within = |p: &&Parameter| table.is_none_or(|table| table == p.table);
    let whole = |p: &&Parameter| within(p) && p.key == bare;
    let short = |p: &&Parameter| within(p) && p.key.strip_prefix(bare).is_some_and(|ending| ENDINGS.contains(&ending));
    for fits in [&whole as &dyn Fn(&&Parameter) -> bool, &short] {
        if let Some(found) = parameters().find(|p| fits(p)) {
            return Ok(found);
        }
    }
    let begun: Vec<&'static Parameter> = parameters().filter(|p| within(p) && !bare.is_empty() && p.key.starts_with(bare)).collect();
    if let [only] = begun[..] { Ok(only) } else { Err(begun) }
}

/// The key that looks most like what was typed, with its ending or without.
fn meant_by(typed: &str) -> Option<&'static str> {
    let stems = || parameters().filter_map(|p| ENDINGS.iter().find_map(|ending| p.key.strip_suffix(ending)).map(|stem| (stem, p.key)));
    let near = nearest(typed, parameters().map(|p| p.key).chain(stems().map(|(stem, _)| stem))).into_iter().next()?;
    let whole = parameters().map(|p| p.key).find(|key| *key == near);
    whole.or_else(|| stems().find(|(stem, _)| *stem == near).map(|(_, key)| key))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_keys_are_found_by_what_is_typed() {
        let key = |typed: &str| lookup(typed).map(|parameter| parameter.key);
        for typed in ["rods.arm_rod_length_mm", "arm_rod_length_mm", "arm_rod", "arm_rod_l"] {
            assert_eq!(key(typed), Ok("arm_rod_length_mm"), "{typed}");
        }
        assert!(matches!(key("rods.nozzle"), Err(LookupError::Unknown { .. })));
        assert!(key("arm_rod_lenght_mm").expect_err("is none").to_string().contains("did you mean `arm_rod_length_mm`?"));
        assert!(key("arm_rodd").expect_err("is none").to_string().contains("did you mean `arm_rod_length_mm`?"));
        assert!(matches!(key("sleeve_"), Err(LookupError::Ambiguous { .. })));
    }
}
