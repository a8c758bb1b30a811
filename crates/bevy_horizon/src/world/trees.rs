//! Plants on the ground: trees, bushes and rocks.

use std::sync::Arc;

use bevy::prelude::*;
use horizon_field::field::Param;
use horizon_field::trees::{self, Forest, ForestError};
use serde::{Deserialize, Serialize};

use super::woods::Woods;
use super::{CompiledStamps, CompiledTerrain, ParamError, Terrain, check_params};

/// What grows on a [`Terrain`](super::Terrain): on the same entity. Nothing of it is an entity of its own: every plant follows from the
/// forest's parameters and from where it stands, and the picture and [`HorizonQuery::trees_in`](crate::query::HorizonQuery::trees_in) know the same ones.
///
/// Stamps of [`Mode::KeepTrees`](horizon_field::stamp::Mode::KeepTrees) keep plants away, and so do holes; [`Felled`] takes single ones.
/// Plants are drawn as far as their crowns are wider than about a pixel and a half, and at most some three and a half kilometres
/// with the default spacing; towards there they shrink into the ground. Debug views show the ground alone.
#[derive(Component, Clone, Debug, PartialEq, Reflect, Serialize, Deserialize)]
#[reflect(Component, Default, Clone, PartialEq)]
#[serde(default, deny_unknown_fields)]
pub struct Trees {
    /// What grows, and where.
    pub forest: Forest,
    /// How far the wind moves the tops along x and z, in metres; the forest's `sway` is the most. −20 to 20. Default: none.
    #[reflect(@Param { min: -20.0, max: 20.0, unit: "m", help: "How far the wind moves the tops along x and z" })]
    pub wind: [f32; 2],
    /// How long a gust lasts, in seconds of Bevy's `Time`. 0.1 to 600. Default: 4.
    #[reflect(@Param { min: 0.1, max: 600.0, unit: "s", help: "How long a gust lasts" })]
    pub gust: f32,
}

impl Default for Trees {
    fn default() -> Self {
        Self { forest: Forest::default(), wind: [0.0; 2], gust: 4.0 }
    }
}

impl Trees {
    /// Such a forest, without wind.
    pub fn new(forest: Forest) -> Self {
        Self { forest, ..default() }
    }

    /// Refuses what makes no sense, but for the forest's fields.
    pub(crate) fn check(&self, path: &str) -> Result<(), TreesError> {
        self.forest.check(&format!("{path}.forest"))?;
        check_params(path, self)?;
        Ok(())
    }
}

/// On the entity of [`Trees`]: plants that stand no more, by their names. To be saved, or sent to other players.
#[derive(Component, Clone, Debug, Default, PartialEq, Eq, Deref, DerefMut, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Felled(pub trees::Felled);

/// On a terrain with [`Trees`]: what grows on it as it stands, with its stamps and without what was felled. Shared with queries and
/// renderer. After a bad edit the last good one stays.
#[derive(Component, Clone, Debug)]
pub struct CompiledTrees {
    pub(crate) woods: Arc<Woods>,
    pub(crate) trees: Trees,
}

/// Why trees were rejected.
#[derive(Clone, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TreesError {
    /// The forest makes no sense.
    #[error(transparent)]
    Forest(#[from] ForestError),
    /// A parameter is out of its range.
    #[error(transparent)]
    Param(#[from] ParamError),
}

/// Trees were rejected; what was there before stays.
#[derive(Message, Clone, Debug)]
pub struct TreesRejected {
    /// The terrain's entity.
    pub entity: Entity,
    /// Why.
    pub error: TreesError,
}

type Grounds<'w, 's> = Query<
    'w,
    's,
    (
        Entity,
        Ref<'static, Trees>,
        &'static Terrain,
        Ref<'static, CompiledTerrain>,
        Option<Ref<'static, CompiledStamps>>,
        Option<Ref<'static, Felled>>,
        Option<&'static CompiledTrees>,
    ),
>;

/// Compiles trees that changed, or whose ground did.
pub(crate) fn compile_trees(
    mut commands: Commands,
    grounds: Grounds,
    mut unfelled: RemovedComponents<Felled>,
    mut rejected: MessageWriter<TreesRejected>,
) {
    let unfelled: Vec<_> = unfelled.read().collect();
    for (entity, trees, ground, terrain, stamps, felled, old) in &grounds {
        let changed = trees.is_changed()
            || terrain.is_changed()
            || stamps.as_ref().is_some_and(|stamps| stamps.is_changed())
            || felled.as_ref().is_some_and(|felled| felled.is_changed())
            || unfelled.contains(&entity);
        if !changed {
            continue;
        }
        // The wind alone, or the ground, need no new fields. An image may be another under the same name.
        let kept = old.filter(|old| old.trees.forest == trees.forest && !terrain.is_changed());
        let planting = trees.check("trees").and_then(|()| match kept {
            Some(old) => Ok(old.woods.planting.clone()),
            None => Ok(trees.forest.compile("trees.forest", &ground.images)?),
        });
        match planting.map(|planting| Woods {
            planting,
            terrain: terrain.0.clone(),
            stamps: stamps.map(|stamps| stamps.0.clone()).unwrap_or_default(),
            felled: felled.map(|felled| felled.0.clone()).unwrap_or_default(),
        }) {
            Ok(woods) => {
                commands.entity(entity).insert(CompiledTrees { woods: Arc::new(woods), trees: Trees::clone(&trees) });
            }
            Err(error) => {
                error!("the trees of terrain {entity} were rejected, what was there before stays: {error}");
                rejected.write(TreesRejected { entity, error });
            }
        }
    }
}

/// Trees that are no more stand nowhere.
pub(crate) fn forget_trees(removed: On<Remove, Trees>, mut commands: Commands) {
    if let Ok(mut entity) = commands.get_entity(removed.entity) {
        entity.try_remove::<CompiledTrees>();
    }
}

/// Nor do those whose ground is no more.
pub(crate) fn forget_grown(removed: On<Remove, CompiledTerrain>, mut commands: Commands) {
    if let Ok(mut entity) = commands.get_entity(removed.entity) {
        entity.try_remove::<CompiledTrees>();
    }
}
