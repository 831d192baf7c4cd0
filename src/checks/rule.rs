//! The record of a rule: everything that a check, a table, a report or a search needs of it, beside its code.

use super::finding::Finding;
use super::scene::Scene;
use crate::params::PartName;

/// A rule of the checks. Tables, reports and searches read this record and name no rule themselves.
pub struct Rule {
    /// Its identifier in findings, reports and lists of accepted findings.
    pub id: &'static str,
    /// Its name for a person.
    pub title: &'static str,
    /// What holds when the rule is kept: a clause, without capital and full stop.
    pub requires: &'static str,
    /// Units that its findings can have.
    pub units: &'static [&'static str],
    /// Where its limits come from; empty when they are fixed in the program.
    pub limits: &'static [Limit],
    /// The keys that change its findings most directly.
    pub levers: Levers,
    /// What a violation is blamed on before the levers.
    pub blame: Blame,
    /// How a search for better frames keeps it.
    pub in_search: InSearch,
    /// How its findings come about.
    pub(super) found: Found,
}

/// Where a limit comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limit {
    /// A key of the frame file, for subjects that begin with these words; an empty beginning is any subject.
    Key {
        /// How the subjects begin.
        subject: &'static str,
        /// The key with its table.
        key: &'static str,
    },
    /// The printer's entry of the catalogue.
    Printer,
    /// The material's entry of the catalogue.
    Material,
    /// `[limits]` of `params/mechanics.toml`.
    Mechanics,
}

/// Keys that change findings most directly, three at the most a finding.
#[derive(Clone, Copy, Debug)]
pub enum Levers {
    /// A set for each kind of subject.
    Sets(&'static [&'static [&'static str]]),
    /// The sets of each printed part.
    OfPart(fn(PartName) -> Vec<&'static [&'static str]>),
}

/// What a violation is blamed on, before the levers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Blame {
    /// Nothing else.
    Levers,
    /// The heaviest lines of the mass table.
    Masses {
        /// Whether the value is the sum of these masses: reports then name the largest, and list them by weight, wherever they
        /// are stated.
        summed: bool,
    },
    /// Keys of the frame file, for subjects that begin with these words; the first that fits counts.
    Keys(&'static [(&'static str, &'static [&'static str])]),
}

/// How a search for better frames keeps a rule.
#[derive(Clone, Copy)]
pub enum InSearch {
    /// As constraints on every frame that is looked at.
    Constraints {
        /// A constraint for the tightest of the findings whose subjects begin with each of these words. Subjects that pull different
        /// ways need constraints of their own: together they have a kink where they are equal, and a search by planes stops there.
        subjects: &'static [&'static str],
        /// Whether little room means that the rule limits the answer. It does not where the value is meant to be at its limit.
        binds: bool,
    },
    /// The same, for the tightest finding of each sort, by its subject.
    Sorted {
        /// The sorts; each subject is of one.
        sorts: &'static [Sort],
        /// Whether little room means that the rule limits the answer.
        binds: bool,
    },
    /// On the best frames at the end only, for the reason given.
    AtTheEnd(&'static str),
    /// Only if a goal requests it, for the reason given.
    AsGoal(&'static str),
}

/// Findings of a rule that pull one way.
#[derive(Clone, Copy)]
pub struct Sort {
    /// In words.
    pub name: &'static str,
    /// Whether a subject is of it.
    pub is_of: fn(&str) -> bool,
}

/// How long a pass over a frame takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Cost {
    /// What can be asked of a sketch, whose parts are bent as in another frame: no pass is of this cost, but most quick ones can be asked.
    Sketch,
    /// Short enough for every frame of a search.
    Quick,
    /// Longer than all quick ones together.
    Slow,
}

/// How the findings of a rule come about.
pub(super) enum Found {
    /// By passes over the design.
    By(&'static [Pass]),
    /// In a pass of another rule, which looks at the same places.
    WithAnother,
    /// From the prediction of the frame's mechanics, where that is asked for.
    FromPrediction,
}

/// A pass over the design.
pub(super) struct Pass {
    pub cost: Cost,
    pub find: Find,
    /// What of it can be asked of a sketch.
    sketched: Option<Find>,
}

/// What looks at a design.
pub(super) type Find = fn(&Scene) -> Vec<Finding>;

impl Pass {
    pub const fn quick(find: Find) -> Self {
        Self { cost: Cost::Quick, find, sketched: Some(find) }
    }

    /// A quick pass of which only this can be asked of a sketch: the rest depends on how parts are bent.
    pub const fn quick_where_bent(find: Find, sketched: Option<Find>) -> Self {
        Self { cost: Cost::Quick, find, sketched }
    }

    pub const fn slow(find: Find) -> Self {
        Self { cost: Cost::Slow, find, sketched: None }
    }

    /// What looks at a design when no more than this may be spent.
    pub fn up_to(&self, dearest: Cost) -> Option<Find> {
        if dearest == Cost::Sketch { self.sketched } else { (self.cost <= dearest).then_some(self.find) }
    }
}

impl Rule {
    /// The key of the frame file that holds the limit of a subject, where there is one.
    pub fn limit_key(&self, subject: &str) -> Option<&'static str> {
        self.limits.iter().find_map(|limit| match limit {
            Limit::Key { subject: begins, key } if subject.starts_with(begins) => Some(*key),
            Limit::Printer => Some("printer"),
            Limit::Key { .. } | Limit::Material | Limit::Mechanics => None,
        })
    }

    /// The constraints of a search, in words. None for a rule that is kept otherwise.
    pub fn constraints(&self) -> Vec<&'static str> {
        match self.in_search {
            InSearch::Constraints { subjects, .. } => subjects.to_vec(),
            InSearch::Sorted { sorts, .. } => sorts.iter().map(|sort| sort.name).collect(),
            InSearch::AtTheEnd(_) | InSearch::AsGoal(_) => Vec::new(),
        }
    }

    /// Whether a finding with this subject is of a constraint.
    pub fn concerns(&self, constraint: &str, subject: &str) -> bool {
        match self.in_search {
            InSearch::Sorted { sorts, .. } => sorts.iter().any(|sort| sort.name == constraint && (sort.is_of)(subject)),
            InSearch::Constraints { .. } | InSearch::AtTheEnd(_) | InSearch::AsGoal(_) => subject.starts_with(constraint),
        }
    }

    /// Whether a search asks it on its best frames only.
    pub fn is_asked_at_the_end(&self) -> bool {
        matches!(self.in_search, InSearch::AtTheEnd(_))
    }

    /// Whether its findings come from the prediction of the drop, which is made on request only.
    pub fn needs_prediction(&self) -> bool {
        matches!(self.found, Found::FromPrediction)
    }

    /// Whether little room means that the rule limits the answer of a search.
    pub fn binds(&self) -> bool {
        matches!(self.in_search, InSearch::Constraints { binds: true, .. } | InSearch::Sorted { binds: true, .. })
    }

    /// Whether its findings come about in a pass of its own.
    pub fn has_own_pass(&self) -> bool {
        matches!(self.found, Found::By(_))
    }

    /// What the rule requires, as a sentence.
    pub fn sentence(&self) -> String {
        sentence(self.requires)
    }
}

/// A clause as a sentence: with a capital and a full stop.
fn sentence(clause: &str) -> String {
    let mut letters = clause.chars();
    let first: String = letters.next().into_iter().flat_map(char::to_uppercase).collect();
    format!("{first}{}.", letters.as_str())
}
