//! Where the methods of the sources fail: the naive way beside ours. Rows of the list that other files test: far places
//! (`anchoring`), thin features and rays along the lattice (`march`), parameters and files (`worlds`), and the units of
//! `horizon_field`.

use bevy::prelude::*;
use bevy_horizon::prelude::*;
use horizon_field::field::{Clamp, Fractal, NoImages, Noise, Remap};
use horizon_field::march::{Anchored, Cast, Counts, Ray, Surface, Tolerance, cast};
use horizon_field::{Compiled, real::Jet};

use bevy_horizon_workspace::stage::{NEAR, Stage};

fn fbm(octaves: f64) -> Compiled<2> {
    let fractal = Fractal { wavelength: 400.0, amplitude: 100.0, octaves, seed: 4, ..default() };
    Field::Fractal(fractal).compile(&NoImages).unwrap()
}

/// Seed 000 eq. 2.2 sums i = 0 ..= n, which is n + 1 layers.
#[test]
fn n_octaves_are_n_layers() {
    for n in 0..8 {
        assert_eq!(fbm(f64::from(n)).layer_count(), n as usize);
    }
}

/// An octave that is cut off must fade. The naive cut drops it whole where its wave gets shorter than two texels.
#[test]
fn a_cut_off_octave_fades() {
    let field = fbm(6.0);
    let at = field.anchor(&Place::from_metres([123.0, 0.0, 77.0]));
    let ours = |cutoff: f64| field.value(&at, [5.0, 3.0], cutoff);
    let naive = |cutoff: f64| {
        let octaves = (0..6).filter(|i| 400.0 / f64::from(1 << i) > 2.0 * cutoff).count();
        fbm(octaves as f64).value(&at_of(&fbm(octaves as f64)), [5.0, 3.0], 0.0)
    };
    fn at_of(field: &Compiled<2>) -> horizon_field::field::Anchors<2> {
        field.anchor(&Place::from_metres([123.0, 0.0, 77.0]))
    }
    let jump = |f: &dyn Fn(f64) -> f64| {
        (0..2000).map(|i| 5.0 + f64::from(i) * 0.1).map(|c| (f(c + 0.1) - f(c)).abs()).fold(0.0, f64::max)
    };
    let (naive, ours) = (jump(&naive), jump(&ours));
    println!("largest step over a tenth of a metre of texel: naive {naive:.3} m, ours {ours:.3} m");
    assert!(naive > 2.0, "the naive cut must pop: {naive}");
    assert!(ours < 0.5, "ours must fade: {ours}");
}

/// Seed 000 B.1.2 interpolates by the cubic smoothstep, whose second derivative jumps at every lattice line.
#[test]
fn curvature_is_continuous_at_lattice_lines() {
    let cubic = |t: f64| t * t * (3.0 - 2.0 * t);
    let quintic = |t: f64| t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    // One cell rises from 0 to 1, the next falls back: the second derivative from the left and from the right.
    let jump = |s: &dyn Fn(f64) -> f64| {
        let f = |x: f64| if x < 1.0 { s(x) } else { 1.0 - s(x - 1.0) };
        let h = 1e-4;
        let second = |x: f64| (f(x + h) - 2.0 * f(x) + f(x - h)) / (h * h);
        (second(1.0 + 2.0 * h) - second(1.0 - 2.0 * h)).abs() + (second(2.0 * h) - 0.0).abs()
    };
    assert!(jump(&cubic) > 5.0, "the cubic must jump");
    assert!(jump(&quintic) < 0.1);
    // And so does the field's own gradient: its second derivative across a lattice line.
    let noise = Field::Noise(Noise { wavelength: 100.0, amplitude: 100.0, seed: 2, ..default() })
        .compile::<2>(&NoImages)
        .unwrap();
    let at = noise.anchor(&Place::ORIGIN);
    let g = |x: f64| noise.jet(&at, [x, 31.0], 0.0).g[0];
    let h = 1e-3;
    let seconds: Vec<f64> = (0..200_000).map(|i| f64::from(i) * h).map(|x| (g(x + h) - g(x)) / h).collect();
    let largest = seconds.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f64::max);
    assert!(largest < 1e-4, "the second derivative jumps by {largest} per metre");
}

/// Seed 000 appendix C sums the layers' normals. The normal of a sum is that of the summed gradients.
#[test]
fn normals_come_from_summed_gradients() {
    let layers = [fbm(1.0), fbm(2.0), fbm(3.0)];
    let place = Place::from_metres([50.0, 0.0, 60.0]);
    let whole = &layers[2];
    let g = whole.jet(&whole.anchor(&place), [0.0, 0.0], 0.0).g;
    let normal = |g: [f64; 2]| Vec3::new(-g[0] as f32, 1.0, -g[1] as f32).normalize();
    let h = 1e-4;
    let value = |q: [f64; 2]| whole.value(&whole.anchor(&place), q, 0.0);
    let truth =
        normal([(value([h, 0.0]) - value([-h, 0.0])) / (2.0 * h), (value([0.0, h]) - value([0.0, -h])) / (2.0 * h)]);
    // Each octave's own gradient is the difference between sums.
    let gradients: Vec<[f64; 2]> = layers.iter().map(|f| f.jet(&f.anchor(&place), [0.0, 0.0], 0.0).g).collect();
    let own = |i: usize| if i == 0 { gradients[0] } else { [0, 1].map(|k| gradients[i][k] - gradients[i - 1][k]) };
    let naive = (0..3).map(|i| normal(own(i))).sum::<Vec3>().normalize();
    println!(
        "naive {:.3}°, ours {:.5}°",
        naive.angle_between(truth).to_degrees(),
        normal(g).angle_between(truth).to_degrees()
    );
    assert!(naive.angle_between(truth) > 0.05, "the sum of normals must be off");
    assert!(normal(g).angle_between(truth) < 1e-3);
}

/// Seed 000 eq. 3.4: steps of c times the height, c ≥ 1, leap through ground that is steeper than the ray.
#[test]
fn height_steps_leap_through_steep_ground() {
    // Walls: noise, steepened and cut off.
    let waves = Field::Noise(Noise { wavelength: 60.0, amplitude: 900.0, seed: 8, ..default() });
    let walls = Field::Clamp(Clamp { field: waves.into(), low: 0.0, high: 60.0 }).compile::<2>(&NoImages).unwrap();
    let surface = Anchored::new(&walls, &Place::ORIGIN);
    let mut leapt = 0;
    for i in 0..400 {
        let angle = f64::from(i) * 0.157;
        let start = [f64::from(i) * 13.0, f64::from(i) * -7.0];
        let origin = [start[0], surface.jet(start).v + 3.0, start[1]];
        let ray = Ray::new(origin, [angle.cos(), -0.004, angle.sin()]).unwrap();
        let Cast::Hit(hit) = cast(&surface, &ray, 400.0, Tolerance::default(), &mut Counts::default()) else {
            continue;
        };
        // s = a + b d + c height, with seed 000's a = 5 and c = 2.
        let mut t = 0.0;
        let naive = loop {
            let [x, y, z] = ray.at(t);
            let over = y - surface.jet([x, z]).v;
            if over <= 0.0 || t > 400.0 {
                break t;
            }
            t += 5.0 + 0.004 * t + 2.0 * over;
        };
        leapt += usize::from(naive > hit.t + 10.0);
        // Ours: nothing lies under ground before the hit.
        for k in 0..4000 {
            let [x, y, z] = ray.at(hit.t * f64::from(k) / 4000.0);
            let Jet { v, .. } = surface.jet([x, z]);
            assert!(y > v - 1e-4, "under ground by {} before the hit", v - y);
        }
    }
    println!("fixed steps leapt through {leapt} walls");
    assert!(leapt > 20, "the naive march must leap: {leapt}");
}

fn shown(setup: impl FnOnce(&mut Stage)) -> (Vec<f32>, image::RgbaImage) {
    let mut stage = Stage::new(160, 90);
    setup(&mut stage);
    stage.settle();
    (stage.depth(), stage.off.screenshot())
}

/// Seed 002 interpolates its first step from lh = ly = 0; a camera under the ground needs its own answer: it sees ground,
/// right at the near plane, and nothing else.
#[test]
fn a_camera_under_the_ground_sees_ground() {
    let (depth, _) = shown(|stage| {
        stage.light();
        stage.world().spawn((Terrain::new(Field::Constant(10.0)), Atmosphere::default()));
        stage.look(Transform::from_xyz(0.0, 2.0, 0.0).looking_to(Vec3::new(0.1, 0.2, -1.0), Vec3::Y));
    });
    assert!(depth.iter().all(|d| *d > 0.99), "the ground begins at the near plane");
}

/// Straight down, straight up, exactly level: no NaN, no hole.
#[test]
fn vertical_and_level_rays_end() {
    let look = |direction: Vec3, up: Vec3| {
        shown(|stage| {
            stage.light();
            stage.world().spawn((Terrain::new(Field::Constant(0.0)), Atmosphere::default()));
            stage.look(Transform::from_xyz(0.0, 40.0, 0.0).looking_to(direction, up));
        })
    };
    let (down, _) = look(Vec3::NEG_Y, Vec3::NEG_Z);
    for depth in &down {
        assert!((NEAR / depth - 40.0).abs() < 0.01, "{depth}");
    }
    let (up, picture) = look(Vec3::Y, Vec3::NEG_Z);
    assert!(up.iter().all(|depth| *depth == 0.0));
    assert!(picture.pixels().all(|p| p[2] > 0), "the sky has no hole");
    let (level, _) = look(Vec3::NEG_Z, Vec3::Y);
    assert!(level[..160 * 45].iter().all(|depth| *depth == 0.0) && level[160 * 50..].iter().all(|depth| *depth > 0.0));
}

/// Clear air under a sun of this angular radius.
fn air(sun_radius: f32) -> Atmosphere {
    let medium = horizon_light::medium::Medium { sun_radius: sun_radius.into(), ..default() };
    let gradient = SkyGradient { haze: 0.0, ..default() };
    Atmosphere { model: SkyModel::Gradient, medium, gradient, ..default() }
}

/// How wide the middle four fifths of a penumbra are, in metres: the shadow is a plateau's, under a sun of this angular radius.
fn penumbra(radius: f32) -> f32 {
    // A plateau 100 m high on one half of the plane, its edge along z, a sun low over it.
    let ramp = Field::Image(horizon_field::field::ImageField {
        path: "step".into(),
        size: [8192.0, 8192.0],
        low: 0.0,
        high: 100.0,
        ..default()
    });
    let png = {
        let mut png = std::io::Cursor::new(Vec::new());
        let image = image::GrayImage::from_fn(1024, 4, |x, _| image::Luma([if x < 512 { 255 } else { 0 }]));
        image.write_to(&mut png, image::ImageFormat::Png).unwrap();
        png.into_inner()
    };
    let mut terrain = Terrain::new(ramp);
    terrain.images =
        [("step".to_string(), horizon_field::field::HeightImage::from_png(&png).unwrap())].into_iter().collect();
    let mut stage = Stage::new(160, 90);
    let sun = Sun { azimuth: -std::f32::consts::FRAC_PI_2, elevation: 0.25, ..default() };
    let light = DirectionalLight { illuminance: 1e5, shadow_maps_enabled: true, ..default() };
    stage.world().spawn((light, sun.transform()));
    stage.world().spawn((terrain, air(radius)));
    let camera = stage.camera;
    stage.world().get_mut::<HorizonCamera>(camera).unwrap().debug = DebugView::Light;
    // From above: 320 m across, the shadow's edge some 390 m from the step.
    stage.look(Transform::from_xyz(395.0, 156.0, 0.0).looking_to(Vec3::NEG_Y, Vec3::NEG_Z));
    stage.settle();
    // Before tonemapping, which pulls the two ends together.
    let row: Vec<f32> = stage.colour()[45 * 160..46 * 160].iter().map(|pixel| pixel[1]).collect();
    assert!(row[0] < 0.01 && row[159] > 0.99, "the row must go from shadow to light: {row:?}");
    let at = |part: f32| {
        let i = row.windows(2).position(|pair| pair[0] < part && pair[1] >= part).expect("the part is there");
        i as f32 + (part - row[i]) / (row[i + 1] - row[i])
    };
    // 160 columns span 2 · 156 m · tan(30°) · 16/9.
    (at(0.9) - at(0.1)) * 2.0 * 156.0 * 0.57735 * 16.0 / 9.0 / 160.0
}

/// Seed 000, algorithm 1: a penumbra that knows nothing of the sun's size. Ours is as wide as the sun makes it: over a
/// height of 100 m at elevation e, from 100/tan(e + ρ) to 100/tan(e − ρ). A tenth of a disc lies more than 0.687 of its radius
/// over its centre.
#[test]
fn the_penumbra_is_as_wide_as_the_sun() {
    for radius in [0.01f32, 0.04] {
        let measured = penumbra(radius);
        let expected = 100.0 / (0.25 - 0.687 * radius).tan() - 100.0 / (0.25 + 0.687 * radius).tan();
        println!("sun of radius {radius}: four fifths of the penumbra are {measured:.1} m wide, of {expected:.1} m");
        assert!((measured / expected - 1.0).abs() < 0.12, "radius {radius}: {measured} m of {expected} m");
    }
}

/// Seed 000 §3.2.3 has grass where the normal's y is below the threshold; §3.2.4 lets shadow darken everything. Ours:
/// grass on flat ground, rock on steep; and night leaves the ambient light.
#[test]
fn grass_is_flat_and_shadow_is_lit_by_the_sky() {
    let albedo = |slope: f64| {
        let tilted = Field::Image(horizon_field::field::ImageField {
            path: "ramp".into(),
            size: [65536.0, 65536.0],
            low: 0.0,
            high: 65536.0 * slope,
            ..default()
        });
        let mut png = std::io::Cursor::new(Vec::new());
        let image = image::ImageBuffer::<image::Luma<u16>, _>::from_fn(256, 4, |x, _| image::Luma([x as u16 * 257]));
        image::DynamicImage::ImageLuma16(image).write_to(&mut png, image::ImageFormat::Png).unwrap();
        let mut terrain = Terrain::new(Field::Remap(Remap {
            field: tilted.into(),
            from: [0.0, 1.0],
            to: [100.0 - 32768.0 * slope, 101.0 - 32768.0 * slope],
        }));
        let height = horizon_field::field::HeightImage::from_png(png.get_ref()).unwrap();
        terrain.images = [("ramp".to_string(), height)].into_iter().collect();
        terrain.material.edge.amplitude = 0.0;
        let (_, picture) = shown(|stage| {
            stage.world().spawn(terrain);
            let camera = stage.camera;
            stage.world().get_mut::<HorizonCamera>(camera).unwrap().debug = DebugView::Albedo;
            stage.look(Transform::from_xyz(0.0, 300.0, 0.0).looking_to(Vec3::NEG_Y, Vec3::NEG_Z));
        });
        picture.get_pixel(80, 45).0
    };
    let (flat, steep) = (albedo(0.05), albedo(1.5));
    println!("flat {flat:?}, steep {steep:?}");
    let [r, g, b] = [0, 1, 2].map(|i| f32::from(flat[i]));
    assert!(g > r && b < 0.75 * g, "flat ground is green: {flat:?}");
    let [r, g, b] = [0, 1, 2].map(|i| f32::from(steep[i]));
    assert!(r >= g && b > 0.85 * g, "steep ground is rock: {steep:?}");

    let (_, night) = shown(|stage| {
        stage.world().insert_resource(GlobalAmbientLight { brightness: 20_000.0, ..default() });
        stage.world().spawn(Terrain::default());
        stage.look(Transform::from_xyz(0.0, 900.0, 0.0).looking_to(Vec3::NEG_Y, Vec3::NEG_Z));
    });
    assert!(night.pixels().all(|p| p[0].max(p[1]).max(p[2]) > 3), "without a sun there still is a sky");
}
