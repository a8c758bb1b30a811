//! Waves on the device against those of the CPU, through the whole plugin.

use bevy::prelude::*;
use bevy::render::RenderApp;
use bevy::render::render_resource::{
    BufferDescriptor, BufferUsages, CachedPipelineState, CommandEncoderDescriptor, Extent3d, MapMode, Origin3d,
    PipelineCache, PollType, TexelCopyBufferInfo, TexelCopyBufferLayout, TexelCopyTextureInfo, Texture, TextureAspect,
};
use bevy::render::renderer::{RenderDevice, RenderQueue};
use bevy_horizon::HorizonPlugins;
use bevy_horizon::render::waves::SeaTiles;
use bevy_horizon::world::{Water, WaterTime};
use bevy_horizon_workspace::offscreen::{self, Offscreen};
use horizon_field::waves::{
    CASCADES, FbmWaves, GRID, Gerstner, Moments, PERIOD, Sea, SeaSurface, Sines, Spectrum, Tiles, Waves,
};

/// An app in which these waters are, at a time that stands.
fn afloat(waves: &[Waves], time: f64) -> Offscreen {
    let mut off = Offscreen::new((offscreen::plugins(), HorizonPlugins), 16, 16);
    let target = off.target();
    let world = off.app.world_mut();
    world.spawn((Camera3d::default(), target));
    world.spawn_batch(waves.iter().cloned().map(|waves| Water { waves, ..default() }).collect::<Vec<_>>());
    world.resource_mut::<Time<Virtual>>().pause();
    world.resource_mut::<WaterTime>().0 = time;
    for _ in 0..4 {
        off.update();
    }
    off
}

/// A level of a texture, layer by layer.
fn read(off: &Offscreen, texture: &Texture, level: u32) -> Vec<Vec<[f32; 4]>> {
    let world = off.app.sub_app(RenderApp).world();
    let (device, queue) = (world.resource::<RenderDevice>(), world.resource::<RenderQueue>());
    let side = GRID as u32 >> level;
    let row = (side * 8).next_multiple_of(256);
    let layers = texture.depth_or_array_layers();
    let buffer = device.create_buffer(&BufferDescriptor {
        label: None,
        size: u64::from(row * side * layers),
        usage: BufferUsages::COPY_DST | BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let mut encoder = device.create_command_encoder(&CommandEncoderDescriptor::default());
    encoder.copy_texture_to_buffer(
        TexelCopyTextureInfo { texture, mip_level: level, origin: Origin3d::ZERO, aspect: TextureAspect::All },
        TexelCopyBufferInfo {
            buffer: &buffer,
            layout: TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row), rows_per_image: Some(side) },
        },
        Extent3d { width: side, height: side, depth_or_array_layers: layers },
    );
    queue.submit([encoder.finish()]);
    let slice = buffer.slice(..);
    slice.map_async(MapMode::Read, |result| result.expect("the buffer can be mapped"));
    device.poll(PollType::wait_indefinitely()).expect("the device answers");
    let mapped = slice.get_mapped_range();
    let texel = |layer: u32, z: u32, x: u32| {
        let at = ((layer * side + z) * row + x * 8) as usize;
        [0, 2, 4, 6].map(|i| half::f16::from_le_bytes([mapped[at + i], mapped[at + i + 1]]).to_f32())
    };
    (0..layers)
        .map(|layer| (0..side).flat_map(|z| (0..side).map(move |x| (z, x))).map(|(z, x)| texel(layer, z, x)).collect())
        .collect()
}

/// The root mean square of the difference, and the largest, as shares of the root mean square of the CPU's values.
fn apart(device: &[[f32; 4]], cpu: &[[f32; 4]], channel: usize) -> [f64; 2] {
    let pairs = || device.iter().zip(cpu).map(|(a, b)| [f64::from(a[channel]), f64::from(b[channel])]);
    let mean = |of: &dyn Fn([f64; 2]) -> f64| (pairs().map(of).sum::<f64>() / device.len() as f64).sqrt();
    let size = mean(&|[_, b]| b * b).max(1e-4);
    let most = pairs().map(|[a, b]| (a - b).abs()).fold(0.0, f64::max);
    [mean(&|[a, b]| (a - b) * (a - b)) / size, most / size]
}

fn textures(off: &Offscreen) -> [Texture; 2] {
    off.app.sub_app(RenderApp).world().resource::<SeaTiles>().textures.clone()
}

/// Four seas at once, of every model, after a long time: each tile, channel and level, within what half floats and the device's sines
/// allow.
#[test]
fn tiles_on_the_device_are_those_of_the_cpu() {
    let time = 1e6 + 0.37;
    let waves = [
        Waves::breeze(),
        Waves::Gerstner(Gerstner { steepness: 1.0, ..Gerstner::default() }),
        Waves::Fbm(FbmWaves::default()),
        Waves::Spectrum(Spectrum { wind: 20.0, fetch: 3e3, choppiness: 1.5, ..Spectrum::default() }),
    ];
    let off = afloat(&waves, time);
    let [surface, moments] = textures(&off);
    assert_eq!(surface.depth_or_array_layers() as usize, CASCADES * waves.len());
    let tiles: Vec<Tiles> = waves.iter().map(|waves| Sea::new(waves).expect("in range").tiles(time)).collect();
    for level in [0, 1, 3, 6, 7] {
        let device = [read(&off, &surface, level), read(&off, &moments, level)];
        for (layer, tile) in tiles.iter().flat_map(|tiles| &tiles.tiles).enumerate() {
            let cpu = [&tile.chains().surface[level as usize], &tile.chains().moments[level as usize]];
            for (channel, name) in
                ["height", "slope x", "slope z", "foam", "xx", "zz", "xz", "height²"].iter().enumerate()
            {
                let [of, channel] = [channel / 4, channel % 4];
                let [rms, most] = apart(&device[of][layer], cpu[of], channel);
                // Means of heights and slopes vanish: what is left is rounding.
                let [rms_limit, most_limit] = if level < 6 { [4e-3, 0.05] } else { [0.02, 0.05] };
                let vanishing = level == 7 && of == 0 && channel < 3;
                assert!(
                    vanishing || (rms < rms_limit && most < most_limit),
                    "{} of layer {layer}, level {level}: {rms:.5}, {most:.5}",
                    name
                );
                assert!(device[of][layer].iter().all(|texel| texel[channel].is_finite()));
            }
        }
    }
}

/// Time goes on, and comes again after a period.
#[test]
fn tiles_follow_the_water_s_time() {
    let mut off = afloat(&[Waves::breeze()], 3.0);
    let [surface, _] = textures(&off);
    let first = read(&off, &surface, 0);
    off.app.world_mut().resource_mut::<WaterTime>().0 = 4.0;
    off.update();
    assert_ne!(read(&off, &surface, 0), first);
    off.app.world_mut().resource_mut::<WaterTime>().0 = 3.0 + 1000.0 * PERIOD;
    off.update();
    assert_eq!(read(&off, &surface, 0), first);
    // Bevy's clock moves it, too.
    off.app.world_mut().resource_mut::<Time<Virtual>>().unpause();
    let before = off.app.world().resource::<WaterTime>().0;
    (0..3).for_each(|_| off.update());
    assert!(off.app.world().resource::<WaterTime>().0 > before);
}

/// Without moving water there is nothing; and nothing is left of it.
#[test]
fn still_water_costs_nothing() {
    let mut off = afloat(&[Waves::Still], 1.0);
    let of_seas = |off: &Offscreen| {
        let world = off.app.sub_app(RenderApp).world();
        let pipelines = world.resource::<PipelineCache>();
        let labels = pipelines.pipelines().map(|pipeline| format!("{:?}", pipeline.descriptor));
        let count = labels.filter(|label| label.contains("\"sea_")).count();
        (world.contains_resource::<SeaTiles>(), count)
    };
    assert_eq!(of_seas(&off), (false, 0));
    let sea = off.app.world_mut().spawn(Water { waves: Waves::Sines(Sines::default()), ..default() }).id();
    (0..3).for_each(|_| off.update());
    assert_eq!(of_seas(&off), (true, 5));
    for pipeline in off.app.sub_app(RenderApp).world().resource::<PipelineCache>().pipelines() {
        assert!(matches!(pipeline.state, CachedPipelineState::Ok(_)), "{:?}", pipeline.descriptor);
    }
    off.app.world_mut().entity_mut(sea).despawn();
    off.update();
    off.update();
    assert!(!of_seas(&off).0);
}

/// What is answered is what is drawn, to a millimetre: between texels of the device's tiles.
#[test]
fn answers_are_what_is_drawn() {
    let time = 12.5;
    let off = afloat(&[Waves::breeze()], time);
    let [surface, _] = textures(&off);
    let device = read(&off, &surface, 0);
    let sea = Sea::new(&Waves::breeze()).expect("in range");
    let answers = SeaSurface::new(std::sync::Arc::new(sea.clone()));
    for i in 0..100 {
        let place = [f64::from(i) * 13.7 - 400.0, f64::from(i) * -7.3];
        let drawn: f64 = sea
            .cascades
            .iter()
            .zip(&device)
            .map(|(cascade, texels)| {
                let at = place.map(|x| (x / cascade.side).rem_euclid(1.0) * GRID as f64 - 0.5);
                let [x, z] = at.map(|x| x.floor());
                let [tx, tz] = [at[0] - x, at[1] - z];
                let texel = |i: f64, j: f64| {
                    let [x, z] = [x + i, z + j].map(|x| x.rem_euclid(GRID as f64) as usize);
                    f64::from(texels[z * GRID + x][0])
                };
                let row = |j: f64| texel(0.0, j) + tx * (texel(1.0, j) - texel(0.0, j));
                row(0.0) + tz * (row(1.0) - row(0.0))
            })
            .sum();
        let Moments { height, .. } = answers.tiles(time).moments(place, 0.0);
        assert!((drawn - answers.height(place, time)).abs() < 1e-3, "{drawn}");
        assert!((height - answers.height(place, time)).abs() < 1e-6);
    }
}
