//! What a study says of each frame.

use super::bill_figure::{BILL_FIGURES, BillFigure};
use super::recovery::RecoveryMeasure;
use crate::checks::{CATALOGUE, Rule, Verdict};
use crate::export::bill::Bill;
use crate::variant::{Better, Evaluation, MEASURES, Measure, caveats};

/// A column of figures.
#[derive(Clone, Copy)]
pub enum Column {
    /// A measure.
    Measure(&'static Measure),
    /// The tightest margin of a rule, in the unit of its findings; below zero where it is violated.
    Margin(&'static Rule),
    /// How many findings of the rules that the study looks at are violated.
    Violations,
    /// A figure of the bill of materials.
    Bill(&'static BillFigure),
    /// A figure of a row of hidden effects.
    Recovery(&'static RecoveryMeasure),
}

/// How the column of a rule's margin begins.
pub(super) const MARGIN: &str = "margin.";
/// The column of the count of violations.
const VIOLATIONS: &str = "violations";

impl Column {
    /// Its name.
    pub fn name(&self) -> String {
        match self {
            Self::Measure(measure) => measure.name.into(),
            Self::Margin(rule) => format!("{MARGIN}{}", rule.id),
            Self::Violations => VIOLATIONS.into(),
            Self::Bill(figure) => figure.name.into(),
            Self::Recovery(measure) => measure.name.into(),
        }
    }

    /// The unit of its figures; empty for a plain number, and for a rule that has findings in several.
    pub fn unit(&self) -> &'static str {
        match self {
            Self::Measure(measure) => measure.unit,
            Self::Margin(rule) => match rule.units {
                [unit] => unit,
                _ => "",
            },
            Self::Violations => "",
            Self::Bill(figure) => figure.unit,
            Self::Recovery(measure) => measure.unit,
        }
    }

    /// Its name, and its unit where it has one.
    pub fn with_unit(&self) -> String {
        if self.unit().is_empty() { self.name() } else { format!("{}, {}", self.name(), self.unit()) }
    }

    /// A figure as it is reported.
    pub fn reported(&self, figure: f64) -> String {
        match self {
            Self::Measure(measure) => measure.reported(Some(figure)),
            _ => format!("{figure:.2}"),
        }
    }

    /// Whether less of it is better, or more.
    pub fn better(&self) -> Better {
        match self {
            Self::Measure(measure) => measure.better,
            Self::Bill(figure) => figure.better,
            Self::Margin(_) | Self::Violations | Self::Recovery(_) => Better::Neither,
        }
    }

    /// What has to be said of some columns, each once: a name of that, and the sentence.
    pub fn caveats(columns: &[Self]) -> Vec<[&'static str; 2]> {
        caveats(columns.iter().filter_map(|column| if let Self::Measure(measure) = column { Some(*measure) } else { None }))
    }

    /// The words that its figures stand for, by their place; none where they are numbers.
    pub fn words(&self) -> Option<&'static [&'static str]> {
        self.recovery()?.words
    }

    /// The word that a figure stands for, where the column has words.
    pub fn word(&self, figure: f64) -> Option<&'static str> {
        self.words()?.get(figure as usize).copied()
    }

    /// The figure of a row of hidden effects that it is.
    pub(super) fn recovery(&self) -> Option<&'static RecoveryMeasure> {
        if let Self::Recovery(measure) = self { Some(measure) } else { None }
    }

    /// The columns of a name: one, or those of all margins.
    pub(super) fn of(name: &str) -> Option<Vec<Self>> {
        if name == "margins" {
            return Some(rules_of_margins().map(Self::Margin).collect());
        }
        if name == VIOLATIONS {
            return Some(vec![Self::Violations]);
        }
        let margin = name.strip_prefix(MARGIN).and_then(|id| rules_of_margins().find(|rule| rule.id == id));
        let measure = MEASURES.iter().find(|measure| measure.name == name);
        let bill = BILL_FIGURES.iter().find(|figure| figure.name == name);
        margin.map(Self::Margin).or(measure.map(Self::Measure)).or(bill.map(Self::Bill)).map(|column| vec![column])
    }

    /// Every name that [`Column::of`] knows.
    pub(super) fn names() -> Vec<String> {
        let margins = rules_of_margins().map(|rule| format!("{MARGIN}{}", rule.id));
        let plain = ["margins", VIOLATIONS].map(String::from);
        let bill = BILL_FIGURES.iter().map(|figure| figure.name.to_string());
        MEASURES.iter().map(|measure| measure.name.to_string()).chain(bill).chain(plain).chain(margins).collect()
    }

    /// The rules that it asks for.
    pub(super) fn rules(&self) -> Vec<&'static Rule> {
        match self {
            Self::Measure(measure) => CATALOGUE.iter().copied().filter(|rule| measure.reads(rule.id)).collect(),
            Self::Margin(rule) if rule.has_own_pass() => vec![rule],
            Self::Margin(_) | Self::Violations => rules_of_margins().collect(),
            Self::Bill(_) | Self::Recovery(_) => Vec::new(),
        }
    }

    /// Its figure of a frame, whose bill is made where a column asks for it; none where the frame has no such thing.
    pub(super) fn of_frame<'a>(&self, evaluation: &Evaluation, bill: impl Fn() -> &'a Bill) -> Option<f64> {
        match self {
            Self::Measure(measure) => measure.of(evaluation),
            Self::Margin(rule) => {
                let own = evaluation.findings.iter().filter(|f| f.rule == rule.id && f.verdict != Verdict::Note);
                // What is meant to be zero has no room, and says something only once it is broken.
                let says = own.filter(|finding| finding.limit != 0.0 || finding.margin < 0.0);
                says.map(|finding| finding.margin).filter(|margin| margin.is_finite()).reduce(f64::min)
            }
            Self::Violations => Some(evaluation.findings.iter().filter(|f| f.verdict == Verdict::Violated).count() as f64),
            Self::Bill(figure) => figure.of_bill(bill()),
            Self::Recovery(_) => None,
        }
    }

    /// Whether the frame's own mechanics have to be asked.
    pub(super) fn is_mechanics(&self) -> bool {
        matches!(self, Self::Measure(measure) if measure.is_mechanics())
    }
}

/// The rules that are kept on every frame of a search: quick enough for every frame of a study, too.
fn rules_of_margins() -> impl Iterator<Item = &'static Rule> {
    CATALOGUE.iter().copied().filter(|rule| !rule.constraints().is_empty())
}
