//! Where the results of steps are kept.

use std::any::Any;
use std::collections::BTreeMap;
use std::fmt::Debug;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::key::Key;

/// Results outlive so many changes without being used, unless a memo says otherwise.
const CHANGES: u64 = 4;

/// A place for results beyond the life of the program. What cannot be kept is not kept: a storage never fails.
pub trait Storage: Send + Sync {
    /// What was written under a key, as it was.
    fn read(&self, key: &Key) -> Option<Vec<u8>>;
    /// Whether it takes anything in.
    fn writes(&self) -> bool {
        true
    }
    /// Writes something under a key.
    fn write(&self, key: &Key, bytes: &[u8]);
}

/// The results of steps, for any number of threads.
pub struct Memo {
    kept: Mutex<Kept>,
    storage: Option<Box<dyn Storage>>,
    changes: u64,
}

impl Default for Memo {
    fn default() -> Self {
        Self::lasting(CHANGES)
    }
}

/// A step that was carried out.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Made {
    /// The step.
    pub step: &'static str,
    /// Of what.
    pub subject: String,
}

#[derive(Default)]
struct Kept {
    results: BTreeMap<Key, Entry>,
    change: u64,
    made: BTreeMap<Made, usize>,
}

struct Entry {
    value: Arc<dyn Any + Send + Sync>,
    used: u64,
}

impl Memo {
    /// One whose results outlive so many changes without being used.
    pub fn lasting(changes: u64) -> Self {
        Self { kept: Mutex::default(), storage: None, changes }
    }

    /// One that keeps results on a storage, too.
    pub fn on(storage: Box<dyn Storage>) -> Self {
        Self { storage: Some(storage), ..Self::default() }
    }

    /// The result of a step: one that was kept, or that of carrying it out, which is kept then. `inputs` are all that the step
    /// reads. The subject is for [`Memo::made`] alone.
    pub fn get<T: Serialize + DeserializeOwned + Send + Sync + 'static>(
        &self,
        step: &'static str,
        subject: &str,
        inputs: &impl Debug,
        make: impl FnOnce() -> T,
    ) -> Arc<T> {
        self.get_worth(step, subject, inputs, make, |_| true)
    }

    /// The same of a step of which many a result is sooner made again than read: only those that are worth it go to the storage.
    pub fn get_worth<T: Serialize + DeserializeOwned + Send + Sync + 'static>(
        &self,
        step: &'static str,
        subject: &str,
        inputs: &impl Debug,
        make: impl FnOnce() -> T,
        is_worth: impl FnOnce(&T) -> bool,
    ) -> Arc<T> {
        match self.obtained(step, subject, inputs, || Ok::<T, std::convert::Infallible>(make()), is_worth) {
            Ok(value) => value,
            Err(never) => match never {},
        }
    }

    /// The same of a step whose result is quicker made again than read: it is kept in memory only, and is no step of
    /// [`Memo::made`].
    pub fn hold<T: Send + Sync + 'static>(&self, step: &'static str, inputs: &impl Debug, make: impl FnOnce() -> T) -> Arc<T> {
        let key = Key::of(step, inputs);
        let held = self.lock().used(&key).and_then(|value| value.downcast::<T>().ok());
        held.unwrap_or_else(|| {
            let value = make();
            self.lock().keep(key, value)
        })
    }

    /// The same of a step that can fail; failures are not kept.
    ///
    /// # Errors
    /// Those of the step.
    pub fn try_get<T: Serialize + DeserializeOwned + Send + Sync + 'static, E>(
        &self,
        step: &'static str,
        subject: &str,
        inputs: &impl Debug,
        make: impl FnOnce() -> Result<T, E>,
    ) -> Result<Arc<T>, E> {
        self.obtained(step, subject, inputs, make, |_| true)
    }

    fn obtained<T: Serialize + DeserializeOwned + Send + Sync + 'static, E>(
        &self,
        step: &'static str,
        subject: &str,
        inputs: &impl Debug,
        make: impl FnOnce() -> Result<T, E>,
        is_worth: impl FnOnce(&T) -> bool,
    ) -> Result<Arc<T>, E> {
        let key = Key::of(step, inputs);
        if let Some(value) = self.lock().used(&key).and_then(|value| value.downcast::<T>().ok()) {
            return Ok(value);
        }
        let stored = self.storage.as_ref().and_then(|storage| storage.read(&key));
        if let Some(value) = stored.and_then(|bytes| postcard::from_bytes::<T>(&bytes).ok()) {
            return Ok(self.lock().keep(key, value));
        }
        let value = make()?;
        if let Some(storage) = self.storage.as_ref().filter(|storage| storage.writes() && is_worth(&value))
            && let Ok(bytes) = postcard::to_allocvec(&value)
        {
            storage.write(&key, &bytes);
        }
        let mut kept = self.lock();
        *kept.made.entry(Made { step, subject: subject.into() }).or_default() += 1;
        Ok(kept.keep(key, value))
    }

    /// Begins another change of the inputs: results that were not used for some changes are dropped.
    pub fn changed(&self) {
        let mut kept = self.lock();
        kept.change += 1;
        let oldest = kept.change.saturating_sub(self.changes);
        kept.results.retain(|_, entry| entry.used >= oldest);
    }

    /// The steps that were carried out since this was last asked, and how often each.
    pub fn made(&self) -> BTreeMap<Made, usize> {
        std::mem::take(&mut self.lock().made)
    }

    /// A thread that ends in the middle of a step leaves whole results behind.
    fn lock(&self) -> MutexGuard<'_, Kept> {
        self.kept.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Kept {
    fn used(&mut self, key: &Key) -> Option<Arc<dyn Any + Send + Sync>> {
        let change = self.change;
        self.results.get_mut(key).map(|entry| {
            entry.used = change;
            entry.value.clone()
        })
    }

    fn keep<T: Send + Sync + 'static>(&mut self, key: Key, value: T) -> Arc<T> {
        let value = Arc::new(value);
        self.results.insert(key, Entry { value: value.clone(), used: self.change });
        value
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A storage that tests look into.
    #[derive(Clone, Default)]
    struct InMemory(Arc<Mutex<BTreeMap<Key, Vec<u8>>>>);

    impl Storage for InMemory {
        fn read(&self, key: &Key) -> Option<Vec<u8>> {
            self.0.lock().expect("no thread ended").get(key).cloned()
        }

        fn write(&self, key: &Key, bytes: &[u8]) {
            self.0.lock().expect("no thread ended").insert(*key, bytes.to_vec());
        }
    }

    fn squared(memo: &Memo, number: f64) -> f64 {
        *memo.get("square", "number", &number, || number * number)
    }

    fn count(memo: &Memo) -> usize {
        memo.made().values().sum()
    }

    #[test]
    fn analytic_a_step_is_carried_out_once_for_its_inputs() {
        let memo = Memo::default();
        assert_eq!([3.0, 4.0, 3.0].map(|number| squared(&memo, number)), [9.0, 16.0, 9.0]);
        assert_eq!(count(&memo), 2);
        assert_eq!((squared(&memo, 4.0), count(&memo)), (16.0, 0));
    }

    #[test]
    fn analytic_what_is_not_used_is_dropped_after_some_changes() {
        let memo = Memo::default();
        squared(&memo, 3.0);
        squared(&memo, 4.0);
        for _ in 0..2 * CHANGES {
            memo.changed();
            squared(&memo, 3.0);
        }
        assert_eq!(count(&memo), 2);
        squared(&memo, 4.0);
        assert_eq!(count(&memo), 1);
    }

    #[test]
    fn analytic_a_storage_outlives_the_memo_and_failures_are_not_kept() {
        let storage = InMemory::default();
        let on = || Memo::on(Box::new(storage.clone()));
        assert_eq!((squared(&on(), 3.0), squared(&on(), 3.0)), (9.0, 9.0));
        let memo = on();
        squared(&memo, 3.0);
        assert_eq!(count(&memo), 0);
        assert_eq!(memo.try_get("root", "number", &1, || Err::<f64, _>("none")).err(), Some("none"));
        assert_eq!(memo.try_get("root", "number", &1, || Ok::<_, &str>(1.0)).map(|value| *value), Ok(1.0));
    }

    #[test]
    fn analytic_results_that_are_worth_it_go_to_the_storage() {
        let storage = InMemory::default();
        let memo = Memo::on(Box::new(storage.clone()));
        let squared = |number: f64| *memo.get_worth("square", "number", &number, || number * number, |square| *square > 10.0);
        assert_eq!([3.0, 4.0, 3.0].map(squared), [9.0, 16.0, 9.0]);
        // In memory each was kept.
        assert_eq!((count(&memo), storage.0.lock().expect("no thread ended").len()), (2, 1));
    }

    #[test]
    fn planted_a_damaged_result_is_made_again() {
        let storage = InMemory::default();
        let memo = Memo::on(Box::new(storage.clone()));
        squared(&memo, 3.0);
        storage.0.lock().expect("no thread ended").values_mut().for_each(|bytes| bytes.truncate(3));
        let memo = Memo::on(Box::new(storage));
        assert_eq!((squared(&memo, 3.0), count(&memo)), (9.0, 1));
    }

    #[test]
    fn analytic_results_outlive_as_many_changes_as_were_asked_for() {
        for changes in [2, 7] {
            let memo = Memo::lasting(changes);
            let made_after = |idle: u64| {
                squared(&memo, 5.0);
                memo.made();
                (0..idle).for_each(|_| memo.changed());
                squared(&memo, 5.0);
                count(&memo)
            };
            assert_eq!((made_after(changes), made_after(changes + 1)), (0, 1), "{changes}");
        }
    }
}
