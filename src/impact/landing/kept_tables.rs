//! Landings of the legs that were looked at last.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};

use super::descent::Descent;
use super::legged_body::Legs;
use super::table::LandingTable;
use crate::impact::fit::Expected;

/// Legs whose landings are kept: those of a step of a fit, and of its difference quotients.
const MOST_KEPT: usize = 16;

/// What the landings of one body and one model depend on: the legs, how it comes down from each height, and how records are read.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct TableKey {
    pub legs: Legs,
    pub descents: Vec<Descent>,
    pub expected: Expected,
}

/// Tables of landings, the last one first. A fit asks for those of the same legs several times: it moves the slopes alone, too, and begins where
/// another one ended.
#[derive(Debug, Default)]
pub(super) struct KeptTables(Mutex<VecDeque<(TableKey, Arc<Vec<LandingTable>>)>>);

impl KeptTables {
    /// The tables of a key, which are computed where they are not known.
    pub fn of(&self, key: TableKey, computed: impl FnOnce() -> Option<Vec<LandingTable>>) -> Option<Arc<Vec<LandingTable>>> {
        if let Some(known) = self.known(&key) {
            return Some(known);
        }
        let tables = Arc::new(computed()?);
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        kept.truncate(MOST_KEPT - 1);
        kept.push_front((key, tables.clone()));
        Some(tables)
    }

    fn known(&self, key: &TableKey) -> Option<Arc<Vec<LandingTable>>> {
        let kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        kept.iter().find(|(known, _)| known == key).map(|(_, tables)| tables.clone())
    }
}
