//! Terrain, made ready: the field tree checked and flattened, once per change.

use std::sync::Arc;

use bevy::prelude::*;
use horizon_field::material::{CompiledMaterial, MaterialError};
use horizon_field::stamp::StampError;
use horizon_field::{Compiled, FieldError};
use thiserror::Error;

use super::{CompiledStamps, ParamError, Terrain, WaterError};
use super::{CompiledStamps, ParamError, Terrain, TreesError};

/// What [`Terrain`] became: the compiled height field and the compiled material. Shared with queries and renderer.
/// After a bad edit the last good one stays.
#[derive(Component, Clone, Debug)]
pub struct CompiledTerrain(pub(crate) Arc<TerrainFields>);

#[derive(Debug)]
pub(crate) struct TerrainFields {
    pub height: Compiled<2>,
    pub material: CompiledMaterial,
}

impl CompiledTerrain {
    /// Checks and compiles.
    ///
    /// # Errors
    /// A parameter out of range, or a field that makes no sense; both name the place.
    pub fn new(terrain: &Terrain) -> Result<Self, TerrainError> {
        Ok(Self(Arc::new(TerrainFields {
            height: terrain.field.compile(&terrain.images)?,
            material: terrain.material.compile(&terrain.images)?,
        })))
    }

    /// The height field.
    pub fn height(&self) -> &Compiled<2> {
        &self.0.height
    }

    /// The material: [`CompiledMaterial::look`] says how a place looks, and which layers show there.
    pub fn material(&self) -> &CompiledMaterial {
        &self.0.material
    }
}

/// Why a terrain was rejected.
#[derive(Clone, Debug, Error)]
#[non_exhaustive]
pub enum TerrainError {
    /// The field makes no sense.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// A parameter is out of its range.
    #[error(transparent)]
    Param(#[from] ParamError),
    /// The material makes no sense.
    #[error(transparent)]
    Material(#[from] MaterialError),
    /// A stamp makes no sense.
    #[error(transparent)]
    Stamp(#[from] StampError),
    /// A body of water makes no sense.
    #[error(transparent)]
    Water(#[from] WaterError),
    /// Plants make no sense.
    #[error(transparent)]
    Trees(#[from] TreesError),
}

/// A terrain was rejected; what was there before stays.
#[derive(Message, Clone, Debug)]
pub struct TerrainRejected {
    /// The terrain's entity.
    pub entity: Entity,
    /// Why.
    pub error: TerrainError,
}

/// Compiles terrain that changed.
pub(crate) fn compile_terrain(
    mut commands: Commands,
    changed: Query<(Entity, &Terrain), Changed<Terrain>>,
    mut rejected: MessageWriter<TerrainRejected>,
) {
    for (entity, terrain) in &changed {
        match CompiledTerrain::new(terrain) {
            Ok(compiled) => {
                commands.entity(entity).insert(compiled);
            }
            Err(error) => {
                error!("terrain {entity} was rejected, what was there before stays: {error}");
                rejected.write(TerrainRejected { entity, error });
            }
        }
    }
}

/// Ground that is no more answers no questions.
pub(crate) fn forget_terrain(removed: On<Remove, Terrain>, mut commands: Commands) {
    if let Ok(mut entity) = commands.get_entity(removed.entity) {
        entity.try_remove::<(CompiledTerrain, CompiledStamps)>();
    }
}
