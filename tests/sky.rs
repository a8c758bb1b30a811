//! The air: how far the drawn sky is off the truth, how it looks, and that it leaves others alone.

use bevy::camera::Exposure;
use bevy::prelude::*;
use bevy::render::RenderApp;
use bevy::render::render_resource::PipelineCache;
use bevy_horizon::prelude::*;
use bevy_horizon::world::towards_sun;
use bevy_horizon_workspace::stage::Stage;
use horizon_charts::context::Context;
use horizon_charts::experiments::sky::{default_errors, default_pictures};
use horizon_light::medium::Medium;

use crate::golden::compare;

/// The default model on the device against Monte Carlo, at every eighth direction; `cargo charts --only sky` has all.
#[test]
fn the_default_sky_is_that_of_monte_carlo() {
    let directory = std::env::temp_dir().join("horizon_sky");
    let errors = default_errors(&Context::new(directory, false), 8).expect("the truth is committed");
    println!("{errors:?}");
    let limits = [0.02, 0.02, 0.03, 0.05, 0.20, 0.03];
    assert_eq!(errors.len(), limits.len());
    for ((name, error), limit) in errors.into_iter().zip(limits) {
        assert!(error <= limit, "sun at {name}: RMS {error}, at most {limit}");
    }
}

/// Pictures of 640 × 360 in 8 bits against all orders of scattering in double precision: `horizon_light`'s `reference::picture` says
/// how they are exposed and tonemapped. The ground is the reference's own too; without it, the sky alone is held to the same.
#[test]
fn pictures_of_the_default_sky_are_those_of_all_orders() {
    let directory = std::env::temp_dir().join("horizon_sky");
    let pictures = default_pictures(&Context::new(directory, false)).expect("the truth is committed");
    let limits = [(65.0, 47.0), (88.0, 40.0)];
    assert_eq!(pictures.len(), limits.len());
    for ((view, psnr), (zenith, least)) in pictures.into_iter().zip(limits) {
        println!("sun at {zenith}°: {psnr:.1?} dB");
        assert_eq!(view.sun_zenith, zenith);
        assert!(psnr.into_iter().all(|psnr| psnr >= least), "sun at {zenith}°: {psnr:?} dB, at least {least}");
    }
}

/// A stage under Earth's air with its sun at an elevation in degrees, towards −z.
fn under_sun(elevation: f32, ev100: f32) -> Stage {
    let mut stage = Stage::new(320, 180);
    let towards = towards_sun(0.0, elevation.to_radians());
    stage.world().spawn((Sunlight, DirectionalLight::default(), Transform::default().looking_to(-towards, Vec3::X)));
    stage.world().spawn(Atmosphere::default());
    let camera = stage.camera;
    stage.world().entity_mut(camera).insert(Exposure { ev100 });
    stage
}

fn sky_picture(elevation: f32, ev100: f32, h: f32, forward: Vec3) -> image::RgbaImage {
    let mut stage = under_sun(elevation, ev100);
    stage.look(Transform::from_xyz(0.0, h, 0.0).looking_to(forward, Vec3::Y));
    stage.settle();
    stage.off.screenshot()
}

#[test]
fn golden_sky_at_noon() {
    compare("sky_noon", &sky_picture(58.0, 13.5, 100.0, Vec3::new(0.0, 0.7, -1.0)));
}

#[test]
fn golden_sky_at_sunset() {
    compare("sky_sunset", &sky_picture(2.0, 11.0, 100.0, Vec3::new(0.1, 0.25, -1.0)));
}

#[test]
fn golden_sky_at_twilight() {
    compare("sky_twilight", &sky_picture(-4.0, 5.5, 100.0, Vec3::new(0.0, 0.45, -1.0)));
}

#[test]
fn golden_sky_from_100_km() {
    compare("sky_100_km", &sky_picture(12.0, 13.0, 100_000.0, Vec3::new(0.6, -0.2, -1.0)));
}

#[test]
fn a_moonless_night_is_dark_and_has_no_nan() {
    let mut stage = under_sun(-40.0, -3.0);
    stage.look(Transform::from_xyz(0.0, 100.0, 0.0).looking_to(Vec3::new(0.0, 0.3, -1.0), Vec3::Y));
    stage.settle();
    let colours = stage.colour();
    assert!(colours.iter().flatten().all(|x| x.is_finite() && *x >= 0.0));
    let brightest = colours.iter().map(|c| c[1]).fold(0.0, f32::max) / Exposure { ev100: -3.0 }.exposure();
    assert!((1e-4..1e-2).contains(&brightest), "{brightest} cd/m²");
}

/// The blue hour. The published wavelengths miss most of ozone's band, and make it purple.
#[test]
fn the_zenith_of_twilight_is_blue() {
    let zenith = |medium: Medium| {
        let mut stage = under_sun(-4.0, 5.5);
        let world = stage.world();
        world.query::<&mut Atmosphere>().single_mut(world).expect("one air").medium = medium;
        stage.look(Transform::from_xyz(0.0, 100.0, 0.0).looking_to(Vec3::Y, Vec3::NEG_Z));
        stage.settle();
        let colours = stage.colour();
        colours[colours.len() / 2 + 160]
    };
    let [red, green, blue, _] = zenith(Medium::EARTH);
    assert!(blue > 1.5 * green && green > red, "{red}, {green}, {blue}");
    let [red, green, _, _] = zenith(Medium::BRUNETON);
    assert!(red > 1.2 * green, "published: {red}, {green}");
}

/// Bevy's own air in place of ours: nothing of ours is in the sky, and the ground is drawn all the same.
#[test]
fn bevys_own_atmosphere_is_left_alone() {
    let mut stage = Stage::new(160, 90);
    stage.light();
    stage.world().spawn(Terrain::default());
    let medium = stage
        .world()
        .resource_mut::<Assets<bevy::light::atmosphere::ScatteringMedium>>()
        .add(bevy::light::atmosphere::ScatteringMedium::earth(64, 64));
    stage.world().spawn(bevy::light::Atmosphere::earth(medium));
    let camera = stage.camera;
    stage.world().entity_mut(camera).insert(bevy::pbr::AtmosphereSettings::default());
    stage.look(Transform::from_xyz(0.0, 600.0, 0.0).looking_to(Vec3::new(0.0, -0.2, -1.0), Vec3::Y));
    stage.settle();
    let picture = stage.off.screenshot();
    assert!(picture.get_pixel(80, 4)[2] > 40, "Bevy's sky shows: {:?}", picture.get_pixel(80, 4));
    let cache = stage.off.app.sub_app(RenderApp).world().resource::<PipelineCache>();
    let labels = cache.pipelines().map(|pipeline| format!("{:?}", pipeline.descriptor));
    let ours = ["horizon_sky", "horizon_veil", "sky_table"];
    assert!(!labels.into_iter().any(|label| ours.iter().any(|name| label.contains(name))));
}

/// The light that Bevy's meshes get: white above, red and dim where the sun is low, gone at night; a bad edit is refused.
#[test]
fn the_sun_s_light_is_what_the_air_leaves_of_it() {
    let lux = |elevation: f32, h: f32| {
        let mut stage = under_sun(elevation, 13.0);
        stage.world().init_resource::<GlobalAmbientLight>();
        stage.look(Transform::from_xyz(0.0, h, 0.0));
        stage.frame();
        stage.frame();
        let world = stage.world();
        let light = *world.query::<&DirectionalLight>().single(world).expect("one sun");
        let colour = light.color.to_linear();
        (
            Vec3::new(colour.red, colour.green, colour.blue) * light.illuminance,
            world.resource::<GlobalAmbientLight>().brightness,
        )
    };
    let (space, _) = lux(60.0, 70_000.0);
    let (noon, noon_sky) = lux(60.0, 10.0);
    let (low, _) = lux(2.0, 10.0);
    let (down, night_sky) = lux(-10.0, 10.0);
    let luminance = |rgb: Vec3| rgb.dot(Vec3::new(0.2126, 0.7152, 0.0722));
    assert!((125e3..140e3).contains(&luminance(space)), "{space}");
    assert!((85e3..120e3).contains(&luminance(noon)), "{noon}");
    assert!(low.x > 3.0 * low.z && luminance(low) < 0.3 * luminance(noon), "{low}");
    assert_eq!(down, Vec3::ZERO);
    assert!((2e3..8e3).contains(&noon_sky) && night_sky < 1.0, "{noon_sky}, {night_sky}");
}

#[test]
fn bad_air_is_refused_and_the_last_stays() {
    let mut stage = under_sun(30.0, 13.0);
    stage.look(Transform::from_xyz(0.0, 10.0, 0.0));
    stage.settle();
    let before = stage.off.screenshot();
    let world = stage.world();
    let mut air = world.query::<&mut Atmosphere>().single_mut(world).expect("one air");
    air.medium.mie_height = f64::NAN;
    stage.off.update();
    let world = stage.world();
    let mut air = world.query::<&mut Atmosphere>().single_mut(world).expect("one air");
    air.medium = Medium { wavelengths: [550.0, 550.0, 440.0], ..default() };
    stage.off.update();
    let rejected = stage.world().resource_mut::<Messages<bevy_horizon::world::AtmosphereRejected>>();
    let mut messages = rejected.get_cursor();
    let fields: Vec<_> = messages.read(&rejected).map(|message| message.error.field.clone()).collect();
    assert_eq!(fields, ["atmosphere.medium.mie_height", "atmosphere.medium.wavelengths[1]"]);
    assert_eq!(before, stage.off.screenshot());
}
