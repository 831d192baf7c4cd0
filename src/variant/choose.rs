//! Whole choices: which battery, which material, which rod, besides the numbers that vary.
//!
//! Each combination of names is first looked at with the numbers of the frame as it is. The search then follows the nearest few.

use rayon::prelude::*;

use super::ended::Ended;
use super::point::Point;
use super::problem::{SearchProblem, Solution, SolveError};
use super::search::AT_ONCE;
use super::solve::{before, solve};
use crate::params::FrameFile;
use crate::params::frame_file::Value;

/// How many of the combinations are followed.
const FOLLOWED: usize = 3;

/// A key that holds a name, and the names that it may hold.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NameChoice {
    /// The key with its table.
    pub key: String,
    /// The names.
    pub names: Vec<String>,
}

/// An answer with its names.
pub struct Chosen {
    /// The name of each key.
    pub names: Vec<(String, String)>,
    /// Combinations that the frame refuses, in words, each with the reason: they were not searched.
    pub refused: Vec<String>,
    /// The rest of the answer; its count of frames is that of all combinations.
    pub solution: Solution,
}

/// Searches over names and numbers.
///
/// # Errors
/// When there are more combinations than half the frames, or no frame that was looked at keeps every limit.
pub fn choose(problem: &SearchProblem, choices: &[NameChoice]) -> Result<Chosen, SolveError> {
    if choices.is_empty() {
        return solve(problem).map(|solution| Chosen { names: Vec::new(), refused: Vec::new(), solution });
    }
    let count = choices.iter().fold(1_usize, |count, choice| count.saturating_mul(choice.names.len()));
    if count > problem.most / 2 {
        let count = if count == usize::MAX { "more than can be counted".into() } else { count.to_string() };
        let most = problem.most;
        return Err(SolveError::Problem(format!("--choose has {count} combinations, and half of {most} frames are fewer; raise --frames")));
    }
    let Begun { each: mut begun, refused: refused_names } = Begun::of(problem, choices);
    let mut looked_at = begun.len() + refused_names.len();
    begun.sort_by(|(a, ..), (b, ..)| a.order(b));
    let each = (problem.most - looked_at) / FOLLOWED.min(begun.len()).max(1);
    let (mut best, mut refused): (Option<Chosen>, Option<SolveError>) = (None, None);
    for (_, names, file) in begun.into_iter().take(FOLLOWED) {
        match solve(&SearchProblem { file: &file, most: each, ..problem.clone() }) {
            Ok(solution) => {
                looked_at += solution.looked_at;
                let better =
                    best.as_ref().is_none_or(|best| problem.value(&solution.evaluation) < problem.value(&best.solution.evaluation));
                let stopped = solution.ended == Ended::Stopped;
                if better {
                    best = Some(Chosen { names, refused: Vec::new(), solution });
                }
                if stopped {
                    break;
                }
            }
            Err(error) => {
                let mut stopped = false;
                if let SolveError::Infeasible { looked_at: count, ended, .. } = &error {
                    looked_at += count;
                    stopped = *ended == Ended::Stopped;
                }
                refused = Some(refused.unwrap_or(error));
                if stopped {
                    break;
                }
            }
        }
    }
    match (best, refused) {
        (Some(mut best), _) => {
            best.solution.looked_at = looked_at;
            best.refused = refused_names;
            Ok(best)
        }
        (None, Some(SolveError::Infeasible { ended, nearest, missed, .. })) => {
            Err(SolveError::Infeasible { looked_at, ended, nearest, missed })
        }
        (None, Some(error)) => Err(error),
        (None, None) => Err(SolveError::Problem(format!("--choose: the frame refuses every combination; {}", refused_names.join("; ")))),
    }
}

/// Combinations that were looked at with the numbers of the frame as it is.
struct Begun {
    /// What is known of each, its names, and the file with them.
    each: Vec<(Point, Names, FrameFile)>,
    /// Those that the frame refuses, in words, with the reason.
    refused: Vec<String>,
}

/// A key and its name, for each key.
type Names = Vec<(String, String)>;

impl Begun {
    /// Side by side; until somebody ends the search.
    fn of(problem: &SearchProblem, choices: &[NameChoice]) -> Self {
        let mut begun = Self { each: Vec::new(), refused: Vec::new() };
        for group in combinations(choices).chunks(AT_ONCE) {
            let look = |names: &Names| {
                let file = with(problem.file, names);
                (before(&SearchProblem { file: &file, ..problem.clone() }), file)
            };
            let looked: Vec<_> = group.par_iter().map(look).collect();
            let mut is_ended = false;
            for (names, (at_start, file)) in group.iter().zip(looked) {
                match at_start {
                    Ok((point, ended)) => {
                        is_ended |= ended;
                        begun.each.push((point, names.clone(), file));
                    }
                    Err(reason) => begun.refused.push(format!("{}: {reason}", in_words(names))),
                }
            }
            if is_ended {
                break;
            }
        }
        begun
    }
}

/// Every way to choose a name for each key.
fn combinations(choices: &[NameChoice]) -> Vec<Names> {
    choices.iter().fold(vec![Vec::new()], |all, choice| {
        let longer = |begun: &Names| {
            let begun = begun.clone();
            choice.names.iter().map(move |name| [begun.clone(), vec![(choice.key.clone(), name.clone())]].concat())
        };
        all.iter().flat_map(longer).collect()
    })
}

/// `bought.battery = battery-2s-850, printer = prusa-mk4`.
fn in_words(names: &[(String, String)]) -> String {
    names.iter().map(|(key, name)| format!("{key} = {name}")).collect::<Vec<_>>().join(", ")
}

/// The file with these names.
fn with(file: &FrameFile, names: &[(String, String)]) -> FrameFile {
    let mut file = file.clone();
    for (key, name) in names {
        file.ask(key, Value::Text(name.clone()), format!("--choose {key}"));
    }
    file
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_combinations_are_all_ways_to_choose() {
        let choice = |key: &str, names: &[&str]| NameChoice { key: key.into(), names: names.iter().map(ToString::to_string).collect() };
        let all = combinations(&[choice("a", &["1", "2"]), choice("b", &["x", "y", "z"])]);
        let told: Vec<String> = all.iter().map(|names| names.iter().map(|(_, name)| name.as_str()).collect()).collect();
        assert_eq!(told, ["1x", "1y", "1z", "2x", "2y", "2z"]);
        assert_eq!(combinations(&[]), vec![Vec::new()]);
    }
}
