//! An atmosphere, made ready: checked, and with what the CPU asks of it.

use std::sync::Arc;

use bevy::prelude::*;
use bevy::tasks::{AsyncComputeTaskPool, Task, block_on, poll_once};
use horizon_light::medium::Medium;
use horizon_light::models::air::Air;
use horizon_light::models::moments::Moments;
use horizon_light::models::transmittance::Transmittance;
use horizon_light::spectrum::Star;

use super::{Atmosphere, ParamError, SkyModel, check_atmosphere};

/// What [`Atmosphere`] became. After a bad edit the last good one stays.
#[derive(Component, Clone, Debug)]
pub struct CompiledAtmosphere {
    #[cfg_attr(not(feature = "render"), expect(dead_code, reason = "only the picture has light"))]
    pub(crate) atmosphere: Atmosphere,
    /// The diffuse light of its medium; none under a gradient.
    pub(crate) light: Option<Arc<AirLight>>,
}

/// The light in a medium, as the CPU asks for it: with all orders of scattering, whatever model draws.
#[derive(Debug)]
pub(crate) struct AirLight {
    medium: Medium,
    #[cfg_attr(not(feature = "render"), expect(dead_code, reason = "only the picture has light"))]
    pub air: Air<f32>,
    #[cfg_attr(not(feature = "render"), expect(dead_code, reason = "only the picture has light"))]
    pub moments: Moments<f32>,
    /// From values at the medium's wavelengths to linear sRGB: integrals over the spectrum, and so not for every frame.
    #[cfg_attr(not(feature = "render"), expect(dead_code, reason = "only the picture has light"))]
    pub to_rgb: [[f64; 3]; 3],
}

impl AirLight {
    fn new(medium: Medium) -> Self {
        let air = Air::new(&medium);
        let transmittance = Transmittance::new(&air);
        let moments = Moments::new(&air, &transmittance);
        let to_rgb = Star::of(&medium).matrix();
        Self { medium, air, moments, to_rgb }
    }
}

/// An atmosphere was rejected; what was there before stays.
#[derive(Message, Clone, Debug)]
pub struct AtmosphereRejected {
    /// The atmosphere's entity.
    pub entity: Entity,
    /// Why.
    pub error: ParamError,
}

/// The light of a medium that is being computed; the last one lights the scene until it is there.
#[derive(Component)]
pub(crate) struct Brightening(Task<AirLight>);

/// Checks atmospheres that changed, and computes their light: the first time at once, so that no frame is dark, then in the
/// background.
pub(crate) fn compile_atmospheres(
    mut commands: Commands,
    changed: Query<(Entity, &Atmosphere, Option<&CompiledAtmosphere>), Changed<Atmosphere>>,
    mut rejected: MessageWriter<AtmosphereRejected>,
) {
    for (entity, atmosphere, old) in &changed {
        if let Err(error) = check_atmosphere(atmosphere) {
            error!("atmosphere {entity} was rejected, what was there before stays: {error}");
            rejected.write(AtmosphereRejected { entity, error });
            continue;
        }
        let medium = atmosphere.medium;
        let last = old.and_then(|old| old.light.clone());
        let light = match last {
            // A server has no picture to light.
            _ if atmosphere.model == SkyModel::Gradient || cfg!(not(feature = "render")) => None,
            Some(last) => {
                if last.medium != medium {
                    let task = AsyncComputeTaskPool::get().spawn(async move { AirLight::new(medium) });
                    commands.entity(entity).insert(Brightening(task));
                }
                Some(last)
            }
            None => Some(Arc::new(AirLight::new(medium))),
        };
        commands.entity(entity).insert(CompiledAtmosphere { atmosphere: atmosphere.clone(), light });
    }
}

/// Takes the light that is there by now.
pub(crate) fn brighten(
    mut commands: Commands,
    mut pending: Query<(Entity, &mut Brightening, &mut CompiledAtmosphere)>,
) {
    for (entity, mut task, mut compiled) in &mut pending {
        if let Some(light) = block_on(poll_once(&mut task.0)) {
            compiled.light = Some(Arc::new(light));
            commands.entity(entity).remove::<Brightening>();
        }
    }
}

/// Air that is no more lights nothing.
pub(crate) fn forget_atmosphere(removed: On<Remove, Atmosphere>, mut commands: Commands) {
    if let Ok(mut entity) = commands.get_entity(removed.entity) {
        entity.try_remove::<(CompiledAtmosphere, Brightening)>();
    }
}
