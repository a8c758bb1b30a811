//! The rivals that the charts hold the cache against: on the device they are what their twins are on the CPU.

use bevy_horizon::prelude::*;
use bevy_horizon::render::rivals::{RivalMarch, RivalsPlugin};
use bevy_horizon_workspace::stage::{FOV, NEAR, Stage};
use bevy_horizon_workspace::views::{Seen, distances, four, truth_camera};
use horizon_field::methods::{HeightField, Method, Setting, Work};

const SIZE: [usize; 2] = [64, 36];

#[test]
fn the_device_marches_as_the_twins_do() {
    for view in [four()[1].clone(), four()[3].clone()] {
        let seen = Seen::new(view.clone(), Place::ORIGIN).unwrap();
        let mut stage = Stage::with_plugins((HorizonPlugins, RivalsPlugin), SIZE[0] as u32, SIZE[1] as u32);
        stage.light();
        stage.world().spawn(Terrain::new(view.field.clone()));
        let camera = stage.camera;
        stage.world().get_mut::<HorizonCamera>(camera).unwrap().far = view.far;
        let pose = seen.pose(0.0);
        stage.look(pose);
        let truth_camera = truth_camera(&pose, FOV, SIZE);
        let ground = HeightField::new(&seen.ground, &seen.place);
        // With the share of the distance by which two runs of the method may differ: the device starts at the near plane, and
        // without bisection a hit is as exact as a step is long. And with how many pixels in a hundred may differ: spheres that
        // creep past an edge end wherever rounding ends them.
        for (method, share, differ) in [
            (Method::FixedStep { a: 2.0, b: 0.004, c: 0.5, k: 6 }, 1e-3, 1),
            (Method::Linear { delta: 0.02 }, 0.02, 1),
            (Method::SphereTracing { omega: 1.6, pixel: 0.05 }, 1e-3, 8),
        ] {
            stage.world().entity_mut(camera).insert(RivalMarch(method));
            for _ in 0..4 {
                stage.off.update();
            }
            let drawn = distances(&stage.depth(), &truth_camera, NEAR);
            stage.world().get_mut::<HorizonCamera>(camera).unwrap().debug = DebugView::Work;
            stage.off.update();
            let counted: f64 = stage.colour().iter().map(|pixel| f64::from(pixel[0])).sum();
            stage.world().get_mut::<HorizonCamera>(camera).unwrap().debug = DebugView::None;
            let setting = Setting::new(&ground, f64::from(view.far), truth_camera.footprint(1.0));
            let mut work = Work::default();
            let (mut hits, mut off) = (0, 0);
            for (i, drawn) in drawn.iter().enumerate() {
                let twin = method.cast_f32(&setting, &truth_camera.pixel_ray(i), &mut work).map(f64::from);
                hits += usize::from(twin.is_some());
                off += usize::from(match (drawn, twin) {
                    (Some(a), Some(b)) => (a - b).abs() > share * b + 0.05,
                    (None, None) => false,
                    _ => true,
                });
            }
            // Rounding may turn a ray that grazes; the twin does not count the normal, which every hit takes once.
            let expected = work.evaluations as f64 + hits as f64;
            println!(
                "{} {method}: {off} of {} pixels off, {counted} evaluations, {expected} on the CPU",
                view.name,
                drawn.len()
            );
            assert!(hits > 500);
            assert!(off * 100 <= differ * drawn.len(), "{} {method}: {off} pixels off", view.name);
            assert!((counted / expected - 1.0).abs() < 0.02, "{} {method}: {counted}, {expected}", view.name);
        }
    }
}
