//! What a study found, as a page.

use std::collections::BTreeMap;

use super::document::Block;
use crate::figures::decimals;
use crate::study::{Axis, Column, Indices, IndicesError, Outcome, Outcomes, Study};

/// Most rows of the front, and most reasons of refusals, that are listed.
const LISTED: usize = 30;

/// What a page is made of.
pub struct StudyReport<'a> {
    /// The study.
    pub study: &'a Study,
    /// Its rows.
    pub outcomes: &'a Outcomes,
    /// The goals of the front.
    pub goals: &'a [String],
    /// The rows that none beats, with the goals' figures.
    pub front: &'a [(usize, Vec<f64>)],
    /// The indices of some columns.
    pub indices: &'a [(usize, Indices)],
    /// Why other columns of a study that is made for indices have none.
    pub without_indices: &'a [(usize, IndicesError)],
}

impl StudyReport<'_> {
    /// The page's title.
    pub fn title(&self) -> String {
        format!("Study {}", self.study.name)
    }

    /// The page; `plots` are the charts, path and bytes.
    pub fn blocks(&self, plots: &[(String, Vec<u8>)]) -> Vec<Block> {
        let figure = |name: &str, caption: &str| {
            let svg = plots.iter().find(|(path, _)| path == &format!("{name}.svg"));
            svg.map(|(_, bytes)| Block::Figure {
                name: name.into(),
                svg: String::from_utf8_lossy(bytes).into_owned(),
                caption: caption.into(),
            })
        };
        let mut blocks = vec![Block::Text(self.counts()), self.ranges()];
        blocks.extend(Column::caveats(&self.study.columns).into_iter().map(|[_, caveat]| Block::Text(caveat.into())));
        if !self.goals.is_empty() {
            blocks.push(Block::Heading("Frames that none beats".into()));
            blocks.push(Block::Text(self.front_in_words()));
        }
        blocks.extend(figure("pareto", "The front: of two frames on it each is better in one of the goals."));
        blocks.extend((!self.front.is_empty()).then(|| self.front_table()));
        blocks.push(Block::Heading("All frames".into()));
        blocks.extend(figure("parallel", "Each line is a frame; an axis reaches from its least value to its largest."));
        if !(self.indices.is_empty() && self.without_indices.is_empty()) {
            blocks.push(Block::Heading("What explains the figures".into()));
            blocks.extend((!self.indices.is_empty()).then(|| Block::Text(self.indices_in_words())));
            for (column, indices) in self.indices {
                let name = self.study.columns[*column].name();
                blocks.extend(figure(&format!("indices-{name}"), &format!("Sobol' indices of {name}, with 95 % intervals.")));
                blocks.push(self.index_table(indices));
            }
            let without = self.without_indices.iter();
            blocks
                .extend(without.map(|(column, why)| Block::Text(format!("{} has no indices: {why}.", self.study.columns[*column].name()))));
        }
        blocks.push(Block::Heading("What fails".into()));
        blocks.extend(self.failures());
        blocks
    }

    fn counts(&self) -> String {
        let (known, refused, rows) = (self.outcomes.known(), self.outcomes.refused(), self.study.rows());
        format!(
            "{known} of {rows} rows are evaluated, on {}. {refused} of them are no frames: their numbers do not go together, or a part cannot be made.",
            self.study.base_name()
        )
    }

    fn ranges(&self) -> Block {
        let row = |axis: &Axis| {
            let over = match axis {
                Axis::Number(vary) => format!("{} to {}", vary.bounds[0], vary.bounds[1]),
                Axis::Listed(_) | Axis::Stated(_) => "as listed".into(),
                Axis::Name { names, .. } => names.join(", "),
            };
            vec![axis.key(), over, axis.unit().into()]
        };
        Block::Table(["key", "range", "unit"].map(String::from).to_vec(), self.study.axes.iter().map(row).collect())
    }

    fn front_in_words(&self) -> String {
        let limits = if self.study.columns.iter().any(|column| matches!(column, Column::Violations)) {
            "every one keeps every limit that the study looks at"
        } else {
            "whether they keep their limits is not known, as the study does not count violations"
        };
        let goals = self.goals.join(" and ");
        format!("None of these {} rows is beaten by another in {goals}; {limits}. Between the rows nothing is known.", self.front.len())
    }

    fn front_table(&self) -> Block {
        let with_unit = |goal: &String| {
            let unit = self.study.columns.iter().find(|column| column.name() == *goal).map_or("", Column::unit);
            if unit.is_empty() { goal.clone() } else { format!("{goal}, {unit}") }
        };
        let head = ["row".to_string()].into_iter().chain(self.goals.iter().map(with_unit)).chain(self.study.axes.iter().map(Axis::key));
        let row = |(row, figures): &(usize, Vec<f64>)| {
            let figures = figures.iter().map(|figure| decimals(*figure, 3));
            let inputs = self.study.inputs(*row).into_iter().map(|input| input.field());
            [row.to_string()].into_iter().chain(figures).chain(inputs).collect()
        };
        Block::Table(head.collect(), self.front.iter().take(LISTED).map(row).collect())
    }

    fn indices_in_words(&self) -> String {
        let left_out = self.indices.iter().map(|(_, indices)| indices.left_out).max().unwrap_or(0);
        let groups = self.indices.iter().map(|(_, indices)| indices.groups).min().unwrap_or(0);
        let warning = if left_out == 0 {
            String::new()
        } else {
            format!(
                " {left_out} groups are left out, as one of their rows is no frame: the axes are then not independent, and the shares \
                 are approximate. Narrower ranges mend that."
            )
        };
        format!("Shares of a figure's variance over these ranges, from {groups} groups of rows.{warning}")
    }

    fn index_table(&self, indices: &Indices) -> Block {
        let told = |index: &crate::study::Index| format!("{} ± {}", decimals(index.share, 3), decimals(index.half_interval, 3));
        let row = |(at, axis): (usize, &Axis)| vec![axis.key(), told(&indices.first[at]), told(&indices.total[at])];
        let head = ["key", "first order", "total"].map(String::from).to_vec();
        Block::Table(head, self.study.axes.iter().enumerate().map(row).collect())
    }

    /// How many rows violate each rule, and why rows are no frames.
    fn failures(&self) -> Vec<Block> {
        let (rows, known) = (self.study.rows(), self.outcomes.known());
        let violating = |at: usize| (0..rows).filter(|row| self.outcomes.figure(*row, at).is_some_and(|margin| margin < 0.0)).count();
        let margins = self.study.columns.iter().enumerate().filter_map(|(at, column)| match column {
            Column::Margin(rule) => Some((violating(at), rule)),
            _ => None,
        });
        let mut by_rule: Vec<_> = margins.filter(|(count, _)| *count > 0).collect();
        by_rule.sort_by(|(a, a_rule), (b, b_rule)| b.cmp(a).then(a_rule.id.cmp(b_rule.id)));
        let by_rule: Vec<Vec<String>> =
            by_rule.into_iter().map(|(count, rule)| vec![rule.id.into(), rule.title.into(), count.to_string()]).collect();
        let mut reasons: BTreeMap<String, usize> = BTreeMap::new();
        for row in 0..rows {
            if let Some(Outcome::Refused(why)) = self.outcomes.of(row) {
                *reasons.entry(kind_of(why)).or_default() += 1;
            }
        }
        let mut refusals: Vec<(String, usize)> = reasons.into_iter().collect();
        refusals.sort_by(|(a, a_count), (b, b_count)| b_count.cmp(a_count).then(a.cmp(b)));
        let reasons: Vec<Vec<String>> = refusals.iter().take(LISTED).cloned().map(|(why, count)| vec![why, count.to_string()]).collect();
        let head = |words: &[&str]| words.iter().map(ToString::to_string).collect();
        let mut blocks = Vec::new();
        // A study may count violations without a margin of each rule.
        let counted = self.study.columns.iter().position(|column| matches!(column, Column::Violations));
        let violating =
            counted.map_or(0, |at| (0..rows).filter(|row| self.outcomes.figure(*row, at).is_some_and(|count| count > 0.0)).count());
        if violating > 0 {
            let which = if by_rule.is_empty() { "; give the measures `margin.RULE` to see which" } else { "" };
            let refused: usize = refusals.iter().map(|(_, count)| count).sum();
            let none = if refused == 0 { String::new() } else { format!("; {refused} rows are no frames") };
            blocks.push(Block::Text(format!("{violating} of {} frames violate a limit{which}{none}.", known - refused)));
        }
        if violating == 0 && by_rule.is_empty() && reasons.is_empty() {
            blocks.push(Block::Text("Nothing that the study looks at.".into()));
        }
        if !by_rule.is_empty() {
            blocks.push(Block::Table(head(&["rule", "what it is", "rows that violate it"]), by_rule));
        }
        if !reasons.is_empty() {
            blocks.push(Block::Table(head(&["why a row is no frame", "rows"]), reasons));
        }
        blocks
    }
}

/// A reason by which rows are counted: its numbers are left out, each a `…`. A name with digits in it stays.
fn kind_of(why: &str) -> String {
    let without_number = |word: &str| {
        let end = word.trim_start_matches(['-', '(']).trim_end_matches([',', ';', ':', ')', '.', '°', '%']);
        if end.parse::<f64>().is_ok() { word.replace(end, "…") } else { word.to_string() }
    };
    why.split_whitespace().map(without_number).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_reasons_differ_by_their_words_alone() {
        let told = "the struts would tilt by -12.5 deg (at most 80); battery-2s-850 stays, 3mm too.";
        assert_eq!(kind_of(told), "the struts would tilt by -… deg (at most …); battery-2s-850 stays, 3mm too.");
        assert_eq!(kind_of("1.0"), "…");
        assert_eq!(kind_of("the struts would tilt by 0.3°, or be 94 % out"), "the struts would tilt by …°, or be … % out");
    }
}
