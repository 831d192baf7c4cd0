//! The command line as a whole.

use std::any::TypeId;

use clap::error::ErrorKind;
use clap::{Command, CommandFactory};

use super::Arguments;

/// Each option with a value: its command's way from the root, its name, the type of its value.
fn options(command: &Command, way: &[String]) -> Vec<(Vec<String>, String, TypeId)> {
    let types = [TypeId::of::<f64>(), TypeId::of::<usize>(), TypeId::of::<u64>(), TypeId::of::<u32>(), TypeId::of::<u16>()];
    let of_type = |argument: &clap::Arg| types.into_iter().find(|kind| argument.get_value_parser().type_id() == *kind);
    let mut found: Vec<_> =
        command.get_arguments().filter_map(|argument| Some((way.to_vec(), argument.get_long()?.to_string(), of_type(argument)?))).collect();
    for inner in command.get_subcommands() {
        let way = [way, &[inner.get_name().to_string()]].concat();
        found.extend(options(inner, &way));
    }
    found
}

/// What is said against a value of an option; `None` when it is taken.
fn refusal((way, option, _): &(Vec<String>, String, TypeId), value: &str) -> Option<String> {
    let words = way.iter().cloned().chain([format!("--{option}={value}")]);
    let error = Arguments::command().try_get_matches_from(words).err()?;
    // Other options may be missing; that is said of values that were taken.
    (error.kind() == ErrorKind::ValueValidation).then(|| error.to_string())
}

#[test]
fn analytic_every_number_of_the_command_line_has_bounds() {
    let all = options(&Arguments::command(), &["flexframe".to_string()]);
    assert!(all.len() > 25, "{} options", all.len());
    for option in &all {
        for value in ["1e308", "-1e308", "nan", "inf", "-inf", "18446744073709551616", "x", ""] {
            let said = refusal(option, value).unwrap_or_else(|| panic!("{option:?} takes {value}"));
            let names_the_limit = ["give ", "is not in ", "number too large"].iter().any(|words| said.contains(words));
            let no_number = option.2 != TypeId::of::<f64>() && said.contains("invalid digit") || said.contains("empty string");
            assert!(names_the_limit || no_number, "{option:?} = {value}: {said}");
        }
        assert!(refusal(option, "18446744073709551615").is_some(), "{option:?} has no limit");
        // Whatever else is refused is refused with its limits.
        for value in ["0", "5e-324", "-0", "1e-310"] {
            assert!(
                refusal(option, value)
                    .is_none_or(|said| said.contains("give ") || said.contains("invalid digit") || said.contains("is not in "))
            );
        }
    }
}

#[test]
fn analytic_the_groups_of_the_help_hold_every_command_once() {
    let command = super::command_line();
    let mut known: Vec<String> = command.get_subcommands().map(|found| found.get_name().to_string()).collect();
    let mut told: Vec<String> = super::GROUPS.iter().flat_map(|(_, names)| names.iter().map(|name| name.to_lowercase())).collect();
    known.sort();
    told.sort();
    assert_eq!(known, told);
}
