//! Plants that were felled: names, which is all that a saved game or another player needs.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};

use super::plant::PlantId;

/// A set of felled plants, in the order of their names.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Felled(BTreeSet<PlantId>);

impl Felled {
    /// Fells a plant; returns whether it was not felled before.
    pub fn fell(&mut self, id: PlantId) -> bool {
        self.0.insert(id)
    }

    /// Lets a plant stand again; returns whether it was felled.
    pub fn restore(&mut self, id: PlantId) -> bool {
        self.0.remove(&id)
    }

    /// Whether a plant is felled.
    pub fn holds(&self, id: PlantId) -> bool {
        // Most worlds fell none.
        !self.0.is_empty() && self.0.contains(&id)
    }

    /// How many are felled.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether none is felled.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The felled plants' names.
    pub fn iter(&self) -> impl Iterator<Item = PlantId> {
        self.0.iter().copied()
    }

    /// The plants that are felled in one of two sets only: whose cells look different.
    pub fn changes<'a>(&'a self, other: &'a Self) -> impl Iterator<Item = PlantId> + 'a {
        self.0.symmetric_difference(&other.0).copied()
    }
}

impl FromIterator<PlantId> for Felled {
    fn from_iter<I: IntoIterator<Item = PlantId>>(ids: I) -> Self {
        Self(ids.into_iter().collect())
    }
}
