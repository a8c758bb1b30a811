//! The sampling kernel of a terrain: the field's generated WGSL, with the fill pass behind it. Written in the main world,
//! once for each structure of the tree; numbers do not enter.

use bevy::platform::collections::HashMap;
use bevy::prelude::*;
use bevy::shader::Shader;
use horizon_field::Compiled;

use super::cache::grain;
use super::shaders::fill_source;
use crate::world::{CompiledTerrain, TerrainFields};

/// The shader that fills a terrain's cache.
#[derive(Component, Clone)]
pub struct TerrainKernel {
    /// The hash of the fields' structure.
    pub structure: u64,
    pub shader: Handle<Shader>,
    /// log2 of the texel, in metres, below which nothing of the height is gained.
    pub grain: i32,
}

/// The fields of a terrain in the order of its kernel: the height, then what its material uses.
pub fn fields_of(fields: &TerrainFields) -> Vec<&Compiled<2>> {
    core::iter::once(&fields.height).chain(fields.material.fields()).collect()
}

/// The kernels that were written, by structure: a tree that comes back, as undo brings it, compiles nothing. A game has
/// as many as it has had structures.
#[derive(Resource, Default)]
pub struct Kernels(HashMap<u64, Handle<Shader>>);

pub fn write_kernels(
    mut commands: Commands,
    mut shaders: ResMut<Assets<Shader>>,
    mut kernels: ResMut<Kernels>,
    changed: Query<(Entity, &CompiledTerrain, Option<&TerrainKernel>), Changed<CompiledTerrain>>,
) {
    for (entity, compiled, old) in &changed {
        let kernel = compiled.0.material.kernel(0, &compiled.0.height);
        let grain = grain(&compiled.0.height);
        if old.is_some_and(|old| (old.structure, old.grain) == (kernel.structure, grain)) {
            continue;
        }
        let shader = kernels.0.entry(kernel.structure).or_insert_with(|| {
            let path = format!("bevy_horizon/generated/{:016x}.wgsl", kernel.structure);
            shaders.add(Shader::from_wgsl(fill_source(&kernel.source), path))
        });
        let shader = shader.clone();
        commands.entity(entity).insert(TerrainKernel { structure: kernel.structure, shader, grain });
    }
}
