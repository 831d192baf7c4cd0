//! From the base model to the effects that it lacks: one, then two, then three, each time over all that could be.

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::adequacy::{Adequacy, LinearisedFit, judge};
use super::bootstrap::Bootstrap;
use super::candidate::{Candidate, promises, tries};
use super::dictionary::Dictionary;
use super::stage::Stage;
use crate::impact::effects::{Model, Spec, candidates};
use crate::impact::fit::FitProblem;

/// p-value below which something is missing.
pub const RARE: f64 = 0.01;
/// Sets of one size that are carried on to the next.
const CARRIED: usize = 5;
/// Larger sets from which effects are taken out again.
const DROPPED: usize = 4;
/// By how much a score has to fall to count.
const BETTER: f64 = 1.0;
/// Sets of the next size that are fitted.
const FITTED: usize = 14;

/// Sets of one size.
#[derive(Clone, Debug)]
pub struct Level {
    /// Best score first.
    pub candidates: Vec<Candidate>,
    /// Whether the best is enough.
    pub adequacy: Adequacy,
}

/// A set of effects that is not fitted yet: its ids, and the models to start from with the sum of squares each promises.
type Promised = (Vec<&'static str>, Vec<(f64, Model)>);

/// All that was looked at.
#[derive(Clone, Debug)]
pub struct Search {
    /// The base model first, then sets of one effect, of two …; the model as it was given alone, where that is enough.
    pub levels: Vec<Level>,
    /// The effects that the model had already, with the p-value of what they leave, where they are not enough.
    pub not_enough: Option<(Candidate, f64)>,
}

/// What a search needs.
pub struct SearchContext<'a> {
    /// Mean waves.
    pub problem: &'a FitProblem,
    /// Bootstrap replicates.
    pub bootstrap: &'a Bootstrap,
    /// The effects that are tried.
    pub catalogue: &'a [&'static Spec],
    /// Most effects.
    pub most: usize,
    /// Called with the stage that begins.
    pub stage: &'a (dyn Fn(Stage) + Sync),
}

impl Search {
    /// Searches from a model's base on; `None` when the base cannot be fitted.
    pub fn run(setting: &SearchContext, model: &Model) -> Option<Self> {
        let not_enough = match setting.given(model) {
            Some(level) if setting.is_enough(&level) => return Some(Self { levels: vec![level], not_enough: None }),
            given => given.map(|Level { mut candidates, adequacy }| (candidates.remove(0), adequacy.p)),
        };
        let base = Candidate::base(setting.problem, model)?;
        let mut dictionary = Dictionary::on(setting.problem, base.model(), setting.catalogue)?;
        (setting.stage)(Stage::Effects(1));
        let adequacy = setting.adequacy(&base, &dictionary)?;
        let singles = setting.singles(&base, &dictionary)?;
        let mut levels = vec![Level { candidates: vec![base], adequacy }];
        let mut candidates = setting.freed(singles);
        for size in 1..=setting.most {
            let best = candidates.first()?;
            dictionary = Dictionary::on(setting.problem, best.model(), setting.catalogue)?;
            let adequacy = setting.adequacy(best, &dictionary)?;
            let enough = adequacy.p >= RARE && setting.may_be(best);
            levels.push(Level { candidates, adequacy });
            if enough || size == setting.most || (levels[0].adequacy.p >= RARE && setting.may_be(&levels[0].candidates[0])) {
                break;
            }
            (setting.stage)(Stage::Effects(size + 1));
            candidates = setting.freed(setting.larger(&levels[size].candidates, &dictionary)?);
            if setting.dropped(&candidates, &mut levels[size].candidates) {
                let best = levels[size].candidates.first()?;
                dictionary = Dictionary::on(setting.problem, best.model(), setting.catalogue)?;
                levels[size].adequacy = setting.adequacy(best, &dictionary)?;
                if levels[size].adequacy.p >= RARE && setting.may_be(&levels[size].candidates[0]) {
                    break;
                }
                candidates = setting.freed(setting.larger(&levels[size].candidates, &dictionary)?);
            }
        }
        Some(Self { levels, not_enough })
    }

    /// The model with the effects that it has already, where they are enough.
    pub fn as_given(setting: &SearchContext, model: &Model) -> Option<Self> {
        let level = setting.given(model).filter(|level| setting.is_enough(level))?;
        Some(Self { levels: vec![level], not_enough: None })
    }
}

impl SearchContext<'_> {
    /// Whether a candidate is enough.
    pub fn adequacy(&self, candidate: &Candidate, dictionary: &Dictionary) -> Option<Adequacy> {
        let jacobian = self.problem.sensitivity(&candidate.fitted)?;
        let seen = LinearisedFit { jacobian, effects: dictionary.columns.clone(), samples: self.problem.expected.samples };
        let deviation = self.problem.measured() - self.problem.prediction(candidate.model())?;
        judge(&deviation, &seen, self.bootstrap)
    }

    /// Whether the best of a level explains the drops, and may be.
    fn is_enough(&self, level: &Level) -> bool {
        level.adequacy.p >= RARE && self.may_be(&level.candidates[0])
    }

    /// A model with the effects that it has already.
    fn given(&self, model: &Model) -> Option<Level> {
        let given = Candidate::given(self.problem, model)?;
        let adequacy = self.adequacy(&given, &Dictionary::on(self.problem, given.model(), self.catalogue)?)?;
        Some(Level { candidates: vec![given], adequacy })
    }

    /// Takes the best sets to their minima, and holds or frees defaults there.
    fn freed(&self, candidates: Vec<Candidate>) -> Vec<Candidate> {
        let best = |candidate: Candidate| candidate.settled(self.problem).restarted(self.problem).held(self.problem).freed(self.problem);
        let one = |(at, candidate): (usize, Candidate)| if at < CARRIED { best(candidate) } else { candidate };
        self.ranked(candidates.into_par_iter().enumerate().map(one).collect())
    }

    /// Takes each effect out of the best sets and refits what stays: a smaller set that was caught in a worse minimum
    /// is replaced. Whether the best of the smaller sets became another.
    fn dropped(&self, larger: &[Candidate], smaller: &mut Vec<Candidate>) -> bool {
        let Some(before) = smaller.first().map(|best| best.score) else { return false };
        let without = |from: &Candidate, id: &str| {
            let mut model = from.model().clone();
            model.effects.retain(|listed| listed.spec.id != id);
            model
        };
        let models: Vec<Model> =
            larger.iter().take(DROPPED).flat_map(|from| from.ids().into_iter().map(move |id| without(from, id))).collect();
        let refitted: Vec<Candidate> =
            models.into_par_iter().filter_map(|model| Some(Candidate::best(self.problem, [model])?.settled(self.problem))).collect();
        for again in refitted {
            match smaller.iter_mut().find(|known| known.ids() == again.ids()) {
                Some(known) if known.worth() > again.worth() => *known = again,
                Some(_) => {}
                None => smaller.push(again),
            }
        }
        *smaller = self.ranked(std::mem::take(smaller));
        smaller[0].score < before - BETTER
    }

    /// Whether a set can explain what is seen in single readings: where they clip below the sensor's own limit, none without a lower limit can.
    pub fn may_be(&self, candidate: &Candidate) -> bool {
        self.problem.seen_limit_g.is_none() || candidate.model().limits_readings()
    }

    /// Best score first, sets that cannot be behind those that can.
    fn ranked(&self, mut candidates: Vec<Candidate>) -> Vec<Candidate> {
        candidates.sort_by(|a, b| self.may_be(b).cmp(&self.may_be(a)).then(a.score.total_cmp(&b.score)));
        candidates
    }

    /// Every effect alone.
    fn singles(&self, base: &Candidate, dictionary: &Dictionary) -> Option<Vec<Candidate>> {
        let promises = promises(self.problem, &base.fitted, dictionary)?;
        let fit = |id: &str| Candidate::best(self.problem, tries(&promises, id).into_iter().map(|start| start.on(base.model())));
        Some(self.ranked(candidates(self.catalogue, base.model()).into_par_iter().filter_map(|spec| fit(spec.id)).collect()))
    }

    /// Sets with one effect more, from the best of one size; each of the best is also swapped, as its effects come from
    /// different sets. `on_first` is what effects change on top of the first one.
    fn larger(&self, smaller: &[Candidate], on_first: &Dictionary) -> Option<Vec<Candidate>> {
        let carried = smaller.iter().take(CARRIED);
        let mut found: BTreeMap<Vec<&'static str>, Candidate> = BTreeMap::new();
        let mut open: Vec<&Candidate> = carried.collect();
        for round in 0..2 {
            let mut promised: BTreeMap<Vec<&'static str>, Vec<(f64, Model)>> = BTreeMap::new();
            let on = |at: usize, from: &Candidate| {
                let is_first = (round, at) == (0, 0);
                if is_first { Some(on_first.clone()) } else { Dictionary::on(self.problem, from.model(), self.catalogue) }
            };
            let dictionaries: Vec<(&Candidate, Dictionary)> =
                open.iter().enumerate().filter_map(|(at, from)| Some((*from, on(at, from)?))).collect();
            for (from, dictionary) in &dictionaries {
                for promise in promises(self.problem, &from.fitted, dictionary)? {
                    let model = promise.start.on(from.model());
                    promised.entry(ids(&model)).or_default().push((promise.sum, model));
                }
            }
            let mut sets: Vec<Promised> = promised.into_iter().filter(|(ids, _)| !found.contains_key(ids)).collect();
            sets.iter_mut().for_each(|(_, models)| models.sort_by(|a, b| a.0.total_cmp(&b.0)));
            sets.sort_by(|a, b| a.1[0].0.total_cmp(&b.1[0].0));
            let fitted: Vec<(Vec<&'static str>, Candidate)> = sets
                .into_par_iter()
                .take(FITTED)
                .filter_map(|(ids, models)| Some((ids, Candidate::best(self.problem, models.into_iter().take(3).map(|(_, model)| model))?)))
                .collect();
            found.extend(fitted);
            // The parts of the best set that were not carried: from there its other part could be swapped.
            let best = found.values().min_by(|a, b| self.may_be(b).cmp(&self.may_be(a)).then(a.score.total_cmp(&b.score)))?.ids();
            let done: Vec<Vec<&'static str>> = dictionaries.iter().map(|(from, _)| from.ids()).collect();
            open = smaller.iter().filter(|from| from.ids().iter().all(|id| best.contains(id)) && !done.contains(&from.ids())).collect();
            if open.is_empty() {
                break;
            }
        }
        Some(self.ranked(found.into_values().collect()))
    }
}

fn ids(model: &Model) -> Vec<&'static str> {
    model.effects.iter().map(|listed| listed.spec.id).collect()
}
