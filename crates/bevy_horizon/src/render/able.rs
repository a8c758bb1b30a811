//! What a device may lack: said once, and the game goes on.

use bevy::core_pipeline::core_3d::CORE_3D_DEPTH_FORMAT;
use bevy::prelude::*;
use bevy::render::render_resource::TextureFormatFeatureFlags;
use bevy::render::renderer::{RenderAdapter, RenderDevice};
use bevy::render::settings::WgpuLimits;
use thiserror::Error;

use super::extract::ExtractedHorizonCamera;

/// Invocations of the largest work group of the caches' passes, and the storage buffers of the fill.
const INVOCATIONS: u32 = 256;
const BUFFERS: u32 = 8;

/// Why a device draws no worlds.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum DeviceLacks {
    /// Compute shaders, or large enough ones.
    #[error("the device runs compute shaders of {0} invocations; the ground's cache needs {INVOCATIONS}")]
    Compute(u32),
    /// Storage buffers.
    #[error("the device has {0} storage buffers for a shader; the ground's cache needs {BUFFERS}")]
    Buffers(u32),
}

/// Whether a device of these limits draws worlds.
///
/// # Errors
/// What it lacks.
pub fn check_device(limits: &WgpuLimits) -> Result<(), DeviceLacks> {
    if limits.max_compute_invocations_per_workgroup < INVOCATIONS {
        return Err(DeviceLacks::Compute(limits.max_compute_invocations_per_workgroup));
    }
    if limits.max_storage_buffers_per_shader_stage < BUFFERS {
        return Err(DeviceLacks::Buffers(limits.max_storage_buffers_per_shader_stage));
    }
    Ok(())
}

/// Whether worlds are drawn at all; where not, it was said.
pub(crate) struct Able(pub bool);

impl Able {
    pub fn new(device: &RenderDevice) -> Self {
        let checked = check_device(&device.limits());
        if let Err(lack) = &checked {
            error!("no world is drawn: {lack}");
        }
        Self(checked.is_ok())
    }
}

/// The most samples, up to those asked for, that a format can have.
fn possible_samples(wanted: Msaa, flags: TextureFormatFeatureFlags) -> Msaa {
    [Msaa::Sample8, Msaa::Sample4, Msaa::Sample2]
        .into_iter()
        .filter(|msaa| msaa.samples() <= wanted.samples())
        .find(|msaa| flags.sample_count_supported(msaa.samples()))
        .unwrap_or(Msaa::Off)
}

/// Cameras with more samples than the device has would end the app: they get what it has. This is the renderer's copy of the component,
/// not the game's.
pub(crate) fn limit_samples(
    mut views: Query<(Entity, &mut Msaa), With<ExtractedHorizonCamera>>,
    adapter: Option<Res<RenderAdapter>>,
    mut said: Local<Vec<(Entity, u32)>>,
) {
    let Some(adapter) = adapter else { return };
    for (entity, mut msaa) in &mut views {
        if *msaa == Msaa::Off {
            continue;
        }
        let possible = possible_samples(*msaa, adapter.get_texture_format_features(CORE_3D_DEPTH_FORMAT).flags);
        if possible == *msaa {
            continue;
        }
        let wanted = msaa.samples();
        if !said.contains(&(entity, wanted)) {
            said.push((entity, wanted));
            error!("the device has no {wanted} samples a pixel: a camera is drawn with {}", possible.samples());
        }
        *msaa = possible;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_device_lacks_is_named() {
        assert_eq!(check_device(&WgpuLimits::default()), Ok(()));
        let none = WgpuLimits { max_compute_invocations_per_workgroup: 0, ..default() };
        assert_eq!(check_device(&none), Err(DeviceLacks::Compute(0)));
        let few = WgpuLimits { max_storage_buffers_per_shader_stage: 4, ..default() };
        assert!(check_device(&few).unwrap_err().to_string().contains("4 storage buffers"));
    }

    #[test]
    fn samples_are_those_that_there_are() {
        let four = TextureFormatFeatureFlags::MULTISAMPLE_X4;
        assert_eq!(possible_samples(Msaa::Sample8, four), Msaa::Sample4);
        assert_eq!(possible_samples(Msaa::Sample4, four), Msaa::Sample4);
        assert_eq!(possible_samples(Msaa::Sample2, four), Msaa::Off);
    }
}
