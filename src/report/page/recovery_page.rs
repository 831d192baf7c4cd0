//! How often the diagnoses of a study are right, as a page.

use super::document::Block;
use crate::figures::decimals;
use crate::study::recovery::{Accuracy, Fact, Share, Table};
use crate::study::{Outcomes, Study};

/// What a page is made of.
pub struct RecoveryReport<'a> {
    /// The study.
    pub study: &'a Study,
    /// Its rows.
    pub outcomes: &'a Outcomes,
    /// Their tables.
    pub accuracy: &'a Accuracy,
}

impl RecoveryReport<'_> {
    /// The page's title.
    pub fn title(&self) -> String {
        format!("Study {}", self.study.name)
    }

    /// The page.
    pub fn blocks(&self) -> Vec<Block> {
        let (known, refused, rows) = (self.outcomes.known(), self.outcomes.refused(), self.study.rows());
        let counts = format!(
            "{known} of {rows} rows are known. {refused} are refused: within its bounds the effect does not reach the strength, or its drops \
             cannot be diagnosed. In brackets 95 % intervals of the shares for independent rows (Wilson); rows of one seed share their \
             random numbers, so they are too narrow where several are of one seed."
        );
        std::iter::once(Block::Text(counts)).chain(self.tables()).collect()
    }

    /// The tables alone.
    pub fn tables(&self) -> Vec<Block> {
        let one = |table: &Table| [Block::Heading(table.title.into()), self.table(table)];
        self.accuracy.tables.iter().flat_map(one).collect()
    }

    fn table(&self, table: &Table) -> Block {
        let line = |(name, facts): &(String, Vec<Fact>)| std::iter::once(name.clone()).chain(facts.iter().map(formatted)).collect();
        let head = std::iter::once(table.of.to_string()).chain(self.settings());
        Block::Table(head.collect(), table.lines.iter().map(line).collect())
    }

    /// What the columns are of: the level, and the law where there are several.
    fn settings(&self) -> Vec<String> {
        let settings = &self.accuracy.settings;
        let one_law = settings.windows(2).all(|pair| pair[0].1 == pair[1].1);
        let named = settings.iter().map(|(level, law)| match one_law {
            true => format!("level {level}"),
            false => format!("level {level}, {}", law.name()),
        });
        named.collect()
    }

    /// The facts as rows of a table of their own: table, line, level, law, how many, of how many, the share or number, its interval, words.
    pub fn facts(&self) -> Vec<[String; FACTS.len()]> {
        let mut rows = Vec::new();
        for table in &self.accuracy.tables {
            for (name, facts) in &table.lines {
                for ((level, law), fact) in self.accuracy.settings.iter().zip(facts).filter(|(_, fact)| **fact != Fact::None) {
                    let mut row = <[String; FACTS.len()]>::default();
                    row[..4].clone_from_slice(&[table.title.into(), name.clone(), level.to_string(), law.name().into()]);
                    match fact {
                        Fact::Share(share) => row[4..9].clone_from_slice(&of_share(share)),
                        Fact::Number(number) => row[6] = number.to_string(),
                        Fact::Words(words) => row[9].clone_from(words),
                        Fact::None => {}
                    }
                    rows.push(row);
                }
            }
        }
        rows
    }
}

/// The columns of the facts.
pub const FACTS: [&str; 10] = ["table", "line", "level", "law", "good", "all", "value", "least", "most", "words"];

fn of_share(share: &Share) -> [String; 5] {
    let [least, most] = share.interval();
    [share.good.to_string(), share.all.to_string(), share.share().to_string(), least.to_string(), most.to_string()]
}

fn formatted(fact: &Fact) -> String {
    match fact {
        Fact::Share(share) => {
            let [least, most] = share.interval().map(|end| decimals(end, 2));
            format!("{}/{} = {} ({least} to {most})", share.good, share.all, decimals(share.share(), 2))
        }
        Fact::Number(number) => decimals(*number, 3),
        Fact::Words(words) => words.clone(),
        Fact::None => "-".into(),
    }
}
