//! From a row of hidden effects to its figures.

use std::sync::{Arc, Mutex, PoisonError};

use super::ceiling::Judge;
use super::findings::{Asks, Findings};
use super::measure::RecoveryMeasure;
use super::setting::{Case, Recovery};
use super::truth::Truth;
use crate::impact::synthetic::ScatterLaw;

/// The judge of the rows of one seed: level, law and seed, and none where there is no such judge.
type KnownJudge = ((usize, ScatterLaw, u64), Option<Arc<Judge>>);

/// Makes drops and diagnoses them, row by row. Rows of one seed share the judge of the ceiling.
pub struct Worker<'a> {
    recovery: &'a Recovery,
    asked: Vec<Asks>,
    judge: Mutex<Option<KnownJudge>>,
}

impl<'a> Worker<'a> {
    /// One that answers these columns.
    pub fn new(recovery: &'a Recovery, columns: impl IntoIterator<Item = &'static RecoveryMeasure>) -> Self {
        Self { recovery, asked: columns.into_iter().map(|measure| measure.asks).collect(), judge: Mutex::default() }
    }

    /// The figures of a row for some columns, or why there are no such drops.
    ///
    /// # Errors
    /// When the truth cannot be made, or its drops cannot be diagnosed.
    pub fn row(&self, row: usize, columns: &[&'static RecoveryMeasure]) -> Result<Vec<Option<f64>>, String> {
        let case = &self.recovery.cases[row];
        let mut findings = Findings::of(self.recovery, case, &self.asked)?;
        if self.asked.contains(&Asks::Ceiling)
            && let (Truth::One(spec), Some(strength)) = (case.truth, case.strength)
        {
            findings.ceiling = self.judge(case).and_then(|judge| judge.share(spec.id, strength));
        }
        Ok(columns.iter().map(|measure| measure.of(&findings)).collect())
    }

    fn judge(&self, case: &Case) -> Option<Arc<Judge>> {
        let key = (case.level, case.law, case.seed);
        let mut known = self.judge.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, judge)) = known.as_ref().filter(|(of, _)| *of == key) {
            return judge.clone();
        }
        let judge = Judge::of(self.recovery, case.level, case.law, case.seed).map(Arc::new);
        *known = Some((key, judge.clone()));
        judge
    }
}
