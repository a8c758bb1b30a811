//! Where a camera draws: into a part of its target, as upscalers ask for it, and into an image that another camera looks at.

use bevy::camera::{Exposure, Hdr, MainPassResolutionOverride, RenderTarget};
use bevy::core_pipeline::prepass::{DeferredPrepass, DepthPrepass};
use bevy::core_pipeline::tonemapping::Tonemapping;
use bevy::pbr::DefaultOpaqueRendererMethod;
use bevy::prelude::*;
use bevy::render::RenderApp;
use bevy::render::sync_world::RenderEntity;
use bevy_horizon::prelude::*;
use bevy_horizon::world::Surface;
use bevy_horizon_workspace::offscreen::target_image;
use bevy_horizon_workspace::stage::{FOV, NEAR, Stage};
use horizon_field::field::Fractal;
use image::RgbaImage;

/// Smooth hills of one colour: what a finer cache shows is the same.
fn hills() -> Terrain {
    let base = Surface { colour: [0.3; 3], second: None, roughness: 1.0, reflectance: 0.0, ..default() };
    let material = TerrainMaterial { base, layers: Vec::new(), ..default() };
    let field = Fractal { wavelength: 900.0, amplitude: 160.0, octaves: 2.0, seed: 3, ..default() };
    Terrain { material, ..Terrain::new(Field::Fractal(field)) }
}

fn stage([width, height]: [u32; 2], deferred: bool) -> Stage {
    let mut stage = Stage::new(width, height);
    let camera = stage.camera;
    stage.light();
    let world = stage.world();
    world.spawn(hills());
    if deferred {
        world.insert_resource(DefaultOpaqueRendererMethod::deferred());
        world.entity_mut(camera).insert((DepthPrepass, DeferredPrepass));
    }
    stage
}

/// Ground below, sky above.
fn outlook(at: Vec3, towards: f32) -> Transform {
    Transform::from_translation(at).looking_to(Vec3::new(0.1, -0.3, towards), Vec3::Y)
}

/// Linear colours of two pictures, as an eye would have them: how many 255ths apart, on average, and what share is more than 8
/// apart.
fn difference(a: &[[f32; 4]], b: &[[f32; 4]]) -> [f64; 2] {
    let seen = |c: f32| f64::from(c.clamp(0.0, 1.0).sqrt()) * 255.0;
    let apart = |(a, b): (&[f32; 4], &[f32; 4])| (0..3).map(|k| (seen(a[k]) - seen(b[k])).abs()).fold(0.0, f64::max);
    let all: Vec<f64> = a.iter().zip(b).map(apart).collect();
    let count = all.len() as f64;
    [all.iter().sum::<f64>() / count, all.iter().filter(|d| **d > 8.0).count() as f64 / count]
}

#[test]
fn a_main_pass_of_another_size_is_filled_exactly() {
    const FULL: [u32; 2] = [192, 108];
    const PART: [u32; 2] = [128, 72];
    for deferred in [false, true] {
        for render_scale in [1.0, 0.5] {
            let set = |size: [u32; 2]| {
                let mut stage = stage(size, deferred);
                stage.world().spawn(Atmosphere::default());
                let camera = stage.camera;
                stage.world().get_mut::<HorizonCamera>(camera).unwrap().render_scale = render_scale;
                stage.look(outlook(Vec3::new(0.0, 260.0, 0.0), -1.0));
                stage.settle();
                stage
            };
            let mut native = set(PART);
            let mut stage = set(FULL);
            let unasked = stage.depth();
            // As upscalers do it: on the renderer's own entity.
            let camera = stage.camera;
            let view = stage.world().get::<RenderEntity>(camera).expect("the camera is rendered").id();
            let render = stage.off.app.sub_app_mut(RenderApp).world_mut();
            render.entity_mut(view).insert(MainPassResolutionOverride(UVec2::from(PART)));
            stage.settle();
            let (depth, colour) = (stage.depth(), stage.colour());
            let (native_depth, native_colour) = (native.depth(), native.colour());
            assert!(depth != unasked, "the override must reach the passes");

            let [width, height] = PART.map(|side| side as usize);
            let full = FULL[0] as usize;
            let inside = |i: usize| i % full < width && i / full < height;
            assert!((0..depth.len()).all(|i| inside(i) || depth[i] == 0.0), "nothing is drawn beside it");
            assert!(colour.iter().all(|pixel| pixel.iter().all(|c| c.is_finite())), "NaN in the picture");
            let part = |i: usize| i / width * full + i % width;
            let ground = |depth: f32| depth > 0.0;
            let count = native_depth.iter().filter(|depth| ground(**depth)).count();
            let other = (0..width * height).filter(|i| ground(native_depth[*i]) != ground(depth[part(*i)])).count();
            let drawn: Vec<[f32; 4]> = (0..width * height).map(|i| colour[part(i)]).collect();
            let [mean, far] = difference(&drawn, &native_colour);
            let dark = drawn.iter().zip(&native_colour).filter(|(a, b)| a[1] < 0.5 * b[1]).count();
            println!(
                "deferred {deferred}, scale {render_scale}: {other} of {count} pixels of ground differ, colours by {mean:.2} on \
                 average, {:.2} % by more than 8, {dark} are unlit",
                100.0 * far
            );
            assert!(count > width * height / 3 && count < width * height, "ground and sky must show: {count}");
            // A stripe of a pixel's width is 72 pixels and more.
            assert!(other < 24, "{other} pixels of ground differ");
            assert!(dark < 24, "{dark} pixels are unlit");
            assert!(mean < 1.0 && far < 0.01, "mean {mean}, {far} by more than 8");
        }
    }
}

/// How many 255ths pixels of two pictures are apart, at the 99th percentile.
fn apart(a: &RgbaImage, b: &RgbaImage, pixels: impl Iterator<Item = ([u32; 2], [u32; 2])>) -> u8 {
    let apart = pixels.map(|([x, y], [u, v])| {
        let (a, b) = (a.get_pixel(x, y), b.get_pixel(u, v));
        (0..3).map(|k| a[k].abs_diff(b[k])).max().expect("three channels")
    });
    let mut all: Vec<u8> = apart.collect();
    all.sort_unstable();
    all[(all.len() - 1) * 99 / 100]
}

#[test]
fn a_picture_within_the_picture_shows_the_world() {
    const OUTER: [u32; 2] = [320, 180];
    const INNER: [u32; 2] = [160, 90];
    let here = outlook(Vec3::new(0.0, 260.0, 0.0), -1.0);
    // Elsewhere, and the other way: a cache of its own.
    let there = outlook(Vec3::new(9000.0, 300.0, 0.0), 1.0);
    for deferred in [false, true] {
        let mut inner = stage(INNER, deferred);
        inner.look(there);
        inner.settle();
        let inner = inner.off.screenshot();

        let mut outer = stage(OUTER, deferred);
        outer.look(here);
        let camera = outer.camera;
        // What the screen shows is tonemapped once.
        outer.world().entity_mut(camera).insert(Tonemapping::None);
        outer.settle();
        let without = outer.off.screenshot();

        let image = target_image(&mut outer.off.app, INNER[0], INNER[1]);
        let world = outer.world();
        let second = world.spawn((
            Camera3d::default(),
            RenderTarget::from(image.clone()),
            Camera { order: -1, ..default() },
            Hdr,
            Msaa::Off,
            Exposure { ev100: 13.5 },
            Tonemapping::AgX,
            Projection::Perspective(PerspectiveProjection { fov: FOV, near: NEAR, ..default() }),
            HorizonCamera::default(),
            there,
        ));
        let second = second.id();
        if deferred {
            world.entity_mut(second).insert((DepthPrepass, DeferredPrepass));
        }
        // A screen that fills the middle half of the view: a pixel of the one is a pixel of the other.
        let away = 2.0;
        let height = away * (0.5 * FOV).tan();
        let screen = Rectangle::new(height * OUTER[0] as f32 / OUTER[1] as f32, height);
        let screen = world.resource_mut::<Assets<Mesh>>().add(screen);
        let material = world.resource_mut::<Assets<StandardMaterial>>().add(StandardMaterial {
            base_color_texture: Some(image),
            unlit: true,
            ..default()
        });
        let place = Transform::from_translation(here.translation + here.forward() * away).with_rotation(here.rotation);
        world.spawn((Mesh3d(screen), MeshMaterial3d(material), place));
        outer.settle();
        let both = outer.off.screenshot();

        let corner = [0, 1].map(|k| (OUTER[k] - INNER[k]) / 2);
        // Without the screen's own edge.
        let shown = || (1..INNER[1] - 1).flat_map(|y| (1..INNER[0] - 1).map(move |x| [x, y]));
        let on_view = |[x, y]: [u32; 2]| [corner[0] + x, corner[1] + y];
        let on_screen = apart(&inner, &both, shown().map(|at| (at, on_view(at))));
        let behind = apart(&without, &both, shown().map(|at| (on_view(at), on_view(at))));
        let covers = |k: usize, at: u32| at + 1 >= corner[k] && at <= corner[k] + INNER[k];
        let all = (0..OUTER[1]).flat_map(|y| (0..OUTER[0]).map(move |x| [x, y]));
        let beside = all.filter(|[x, y]| !covers(0, *x) || !covers(1, *y));
        let around = apart(&without, &both, beside.map(|at| (at, at)));
        println!(
            "deferred {deferred}: {on_screen} of 255 apart on the screen, {around} around it, {behind} from what it hides"
        );
        let lit = inner.pixels().filter(|pixel| pixel[1] > 30).count();
        assert!(lit > inner.pixels().count() / 2, "{lit} pixels are lit");
        assert!(on_screen <= 4, "deferred {deferred}: {on_screen} on the screen");
        assert!(around <= 4, "deferred {deferred}: {around} around the screen");
        assert!(behind > 8, "deferred {deferred}: the screen must hide other ground");
    }
}
