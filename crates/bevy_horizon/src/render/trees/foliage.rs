//! The table of foliage as a texture. It is the same for all forests.

use bevy::render::render_resource::{
    AddressMode, Extent3d, FilterMode, MipmapFilterMode, Sampler, SamplerDescriptor, TextureDataOrder,
    TextureDescriptor, TextureDimension, TextureFormat, TextureUsages, TextureView, TextureViewDescriptor,
};
use bevy::render::renderer::{RenderDevice, RenderQueue};
use horizon_field::trees::{Foliage, MIPS, TEXELS};

/// The texture, and how it is read: it repeats, and is linear within and between mips.
pub struct FoliageTexture {
    pub view: TextureView,
    pub sampler: Sampler,
}

impl FoliageTexture {
    pub fn new(device: &RenderDevice, queue: &RenderQueue) -> Self {
        let foliage = Foliage::table();
        let side = TEXELS as u32;
        let texture = TextureDescriptor {
            label: Some("horizon_foliage"),
            size: Extent3d { width: side, height: side, depth_or_array_layers: side },
            mip_level_count: MIPS as u32,
            sample_count: 1,
            dimension: TextureDimension::D3,
            format: TextureFormat::R8Unorm,
            usage: TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST,
            view_formats: &[],
        };
        let texels: Vec<u8> = (0..MIPS).flat_map(|mip| foliage.texels(mip)).copied().collect();
        let texture = device.create_texture_with_data(queue, &texture, TextureDataOrder::MipMajor, &texels);
        let sampler = device.create_sampler(&SamplerDescriptor {
            label: Some("horizon_foliage"),
            address_mode_u: AddressMode::Repeat,
            address_mode_v: AddressMode::Repeat,
            address_mode_w: AddressMode::Repeat,
            mag_filter: FilterMode::Linear,
            min_filter: FilterMode::Linear,
            mipmap_filter: MipmapFilterMode::Linear,
            ..SamplerDescriptor::default()
        });
        Self { view: texture.create_view(&TextureViewDescriptor::default()), sampler }
    }
}
