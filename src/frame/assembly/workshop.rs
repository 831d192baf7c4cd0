//! Parts that were made before: the next design takes those whose recipe is the same.

use std::collections::BTreeMap;

use super::printed::{Printed, Recipe};
use crate::params::PartName;

/// The last of each part, with the recipe that it was made by. A part follows from its recipe alone, so one that is taken
/// from here is the one that would be made.
#[derive(Default)]
pub struct Workshop {
    shelf: BTreeMap<PartName, (Recipe, Printed)>,
}

impl Workshop {
    /// The part by this recipe, when it is there.
    pub(super) fn find(&self, name: PartName, recipe: &Recipe) -> Option<Printed> {
        self.shelf.get(&name).filter(|(known, _)| known == recipe).map(|(_, part)| part.clone())
    }

    /// Keeps a part.
    pub(super) fn keep(&mut self, recipe: Recipe, part: Printed) {
        self.shelf.insert(part.name, (recipe, part));
    }
}
