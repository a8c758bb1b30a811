//! Terrain, made ready: the field tree checked and flattened, once per change.

use std::sync::Arc;

use bevy::prelude::*;
use horizon_field::stamp::StampError;
use horizon_field::{Compiled, FieldError};
use thiserror::Error;

use super::{CompiledStamps, ParamError, Terrain, TerrainMaterial, check_params};

/// What [`Terrain`] became: the compiled height field and the noises of its material. Shared with queries and renderer.
/// After a bad edit the last good one stays.
#[derive(Component, Clone, Debug)]
pub struct CompiledTerrain(pub(crate) Arc<TerrainFields>);

#[derive(Debug)]
pub(crate) struct TerrainFields {
    pub height: Compiled<2>,
    #[cfg_attr(not(feature = "render"), expect(dead_code, reason = "only the picture has a look"))]
    pub material: TerrainMaterial,
    #[cfg_attr(not(feature = "render"), expect(dead_code, reason = "only the picture has a look"))]
    pub edge: Compiled<2>,
    #[cfg_attr(not(feature = "render"), expect(dead_code, reason = "only the picture has a look"))]
    pub tint: Compiled<2>,
}

impl CompiledTerrain {
    /// Checks and compiles.
    ///
    /// # Errors
    /// A parameter out of range, or a field that makes no sense; both name the place.
    pub fn new(terrain: &Terrain) -> Result<Self, TerrainError> {
        check_params("terrain.material", &terrain.material)?;
        if !terrain.material.boundaries.is_sorted() {
            return Err(TerrainError::Boundaries(terrain.material.boundaries));
        }
        Ok(Self(Arc::new(TerrainFields {
            height: terrain.field.compile(&terrain.images)?,
            material: terrain.material.clone(),
            edge: terrain.material.edge.field().compile(&terrain.images)?,
            tint: terrain.material.tint.field().compile(&terrain.images)?,
        })))
    }

    /// The height field.
    pub fn height(&self) -> &Compiled<2> {
        &self.0.height
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
    /// The heights of the material's boundaries do not rise.
    #[error("terrain.material.boundaries is {0:?}, but must rise")]
    Boundaries([f32; 4]),
    /// A stamp makes no sense.
    #[error(transparent)]
    Stamp(#[from] StampError),
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
