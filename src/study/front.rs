//! The rows of a study that no other row beats.

use super::column::Column;
use super::outcomes::Outcomes;
use super::plan::Study;
use crate::variant::{Better, beats, resolved};

/// There is no front of these goals.
#[derive(Debug, thiserror::Error, PartialEq, Eq)]
pub enum FrontError {
    /// The study does not say it.
    #[error("the study has no measure `{name}`; of its measures {known} can be goals")]
    NoSuchGoal {
        /// What was asked for.
        name: String,
        /// The measures that can be goals.
        known: String,
    },
    /// It is said of each row, and neither end of it is the better one.
    #[error("neither less nor more of `{name}` is better, so it is no goal; of the study's measures {known} can be goals")]
    NoBetterEnd {
        /// What was asked for.
        name: String,
        /// The measures that can be goals.
        known: String,
    },
}

/// The columns of a study that are better when they are less, or more.
fn goals(study: &Study) -> Vec<(usize, Column)> {
    study.columns.iter().copied().enumerate().filter(|(_, column)| column.better() != Better::Neither).collect()
}

/// The rows of which no other keeps every limit that the study looks at and is better in one of the goals and in none worse, by the
/// first goal; with each the goals' figures, which are compared by five digits. Rows that violate a limit are left out where the study counts violations.
///
/// # Errors
/// When the study does not have a goal among its columns.
pub fn front(study: &Study, outcomes: &Outcomes, names: &[String]) -> Result<Vec<(usize, Vec<f64>)>, FrontError> {
    let known = goals(study);
    let mut wanted = Vec::new();
    for name in names {
        let listed = || known.iter().map(|(_, column)| column.name()).collect::<Vec<_>>().join(", ");
        wanted.push(match known.iter().find(|(_, column)| column.name() == *name) {
            Some(found) => found,
            None if study.columns.iter().any(|column| column.name() == *name) => {
                return Err(FrontError::NoBetterEnd { name: name.clone(), known: listed() });
            }
            None => return Err(FrontError::NoSuchGoal { name: name.clone(), known: listed() }),
        });
    }
    let counted = study.columns.iter().position(|column| matches!(column, Column::Violations));
    let keeps = |row: usize| counted.is_none_or(|at| outcomes.figure(row, at) == Some(0.0));
    let of_row = |row: usize| wanted.iter().map(|(at, _)| outcomes.figure(row, *at)).collect::<Option<Vec<f64>>>();
    let mut candidates: Vec<(usize, Vec<f64>)> =
        (0..study.rows()).filter(|row| keeps(*row)).filter_map(|row| Some((row, of_row(row)?))).collect();
    let worth = |figures: &[f64]| -> Vec<f64> {
        wanted.iter().zip(figures).map(|((_, column), figure)| resolved(column.better().sign() * figure)).collect()
    };
    candidates.sort_by(|(a_row, a), (b_row, b)| {
        let (a, b) = (worth(a), worth(b));
        let first = a.iter().zip(&b).map(|(a, b)| a.total_cmp(b)).find(|order| order.is_ne());
        first.unwrap_or(std::cmp::Ordering::Equal).then(a_row.cmp(b_row))
    });
    // In this order only a row before it, and only one of the front, can beat a row.
    let mut front: Vec<(usize, Vec<f64>)> = Vec::new();
    for (row, figures) in candidates {
        let own = worth(&figures);
        let beaten = front.iter().any(|(_, other)| beats(&worth(other), &own));
        if !beaten {
            front.push((row, figures));
        }
    }
    Ok(front)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::params::files::Memory;
    use crate::study::Outcome;

    fn study(rows: usize) -> Study {
        let text =
            format!("samples = {rows}\nmeasures = [\"mass\", \"clearance.propeller\", \"violations\"]\n[vary]\ncage_rod = [100, 200]\n");
        let files = Memory([("s.toml".into(), text.into_bytes())].into_iter().collect());
        super::super::plan_file::load("s.toml", &files).expect("is a plan")
    }

    proptest! {
        /// By the definition, row against row: less mass and more clearance are better, and who violates a limit is none.
        #[test]
        fn analytic_the_front_is_what_no_other_beats(rows in prop::collection::vec((0_u8..6, 0_u8..6, 0_u8..2), 1..60)) {
            let study = study(rows.len());
            let mut outcomes = Outcomes::none(rows.len());
            for (row, (mass, clearance, violations)) in rows.iter().enumerate() {
                let figures = [mass, clearance, violations].map(|figure| Some(f64::from(*figure)));
                outcomes.learn(row, Outcome::Figures(figures.to_vec()));
            }
            let goals = ["mass", "clearance.propeller"].map(String::from);
            let found = front(&study, &outcomes, &goals).expect("are goals");
            let keeps: Vec<(u8, u8)> = rows.iter().filter(|row| row.2 == 0).map(|row| (row.0, row.1)).collect();
            let beaten = |(mass, clearance): (u8, u8)| {
                keeps.iter().any(|other| other.0 <= mass && other.1 >= clearance && *other != (mass, clearance))
            };
            let mut expected: Vec<(u8, u8)> = keeps.iter().copied().filter(|row| !beaten(*row)).collect();
            expected.sort_unstable();
            let figures: Vec<(u8, u8)> = found.iter().map(|(_, figures)| (figures[0] as u8, figures[1] as u8)).collect();
            prop_assert_eq!(figures, expected);
        }
    }

    #[test]
    fn planted_a_goal_that_the_study_does_not_have_is_named() {
        let error = front(&study(3), &Outcomes::none(3), &["peak".to_string()]).expect_err("is none");
        assert!(error.to_string().contains("of its measures mass, clearance.propeller can be goals"), "{error}");
        let error = front(&study(3), &Outcomes::none(3), &["violations".to_string()]).expect_err("is no goal");
        assert!(error.to_string().starts_with("neither less nor more of `violations` is better"), "{error}");
    }
}
