use bevy::prelude::*;
use bevy_horizon::prelude::*;
use bevy_horizon_workspace::offscreen::{self, Offscreen};

#[test]
fn first_picture() {
    let mut off = Offscreen::new((offscreen::plugins(), HorizonPlugins), 640, 360);
    let world = off.app.world_mut();
    let var = |name: &str| std::env::var(name).ok();
    if var("NOTERRAIN").is_none() {
        world.spawn(Terrain::default());
    }
    if var("NOSKY").is_none() {
        world.spawn(Atmosphere::default());
    }
    world.spawn((DirectionalLight { illuminance: 100_000.0, ..default() }, Sun::default().transform()));
    world.insert_resource(GlobalAmbientLight {
        color: Color::linear_rgb(0.62, 0.78, 1.0),
        brightness: 5000.0,
        ..default()
    });
    let target = off.target();
    let ev: f32 = std::env::var("EV").ok().and_then(|v| v.parse().ok()).unwrap_or(15.0);
    let height: f32 = std::env::var("Y").ok().and_then(|v| v.parse().ok()).unwrap_or(400.0);
    off.app.world_mut().spawn((
        Camera3d::default(),
        target,
        bevy::camera::Exposure { ev100: ev },
        HorizonCamera {
            debug: match var("DEBUG").as_deref() {
                Some("n") => DebugView::Normal,
                Some("s") => DebugView::Steps,
                Some("l") => DebugView::Level,
                Some("v") => DebugView::Light,
                Some("a") => DebugView::Albedo,
                _ => DebugView::None,
            },
            ..default()
        },
        if var("MSAA").is_some() { Msaa::Sample4 } else { Msaa::Off },
        Transform::from_xyz(0.0, height, 0.0).looking_to(Vec3::new(0.3, -0.15, -1.0), Vec3::Y),
    ));
    for i in 0..40 {
        let start = std::time::Instant::now();
        off.update();
        let p = off.app.world().resource::<bevy_horizon::render::ready::Progress>().get();
        println!("{i} {:?} {:?}", p, start.elapsed());
        if i > 3 && p.done == p.total {
            break;
        }
    }
    for _ in 0..8 {
        let s = std::time::Instant::now();
        off.update();
        println!("steady {:?}", s.elapsed());
    }
    off.screenshot().save(var("OUT").unwrap_or("/tmp/first.png".into())).unwrap();
}
