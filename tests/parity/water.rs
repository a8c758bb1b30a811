//! Water: what the shipped WGSL makes of light on and in it, against the CPU.

use horizon_field::field::arbitrary::Random;
use horizon_light::water::body::Water;
use horizon_light::water::caustics::{BRIGHTEST, focus};
use horizon_light::water::foam::covered;
use horizon_light::water::rough::{glitter, reflectance};
use horizon_light::water::surface::{critical_cosine, crossing, fresnel, refract};
use horizon_light::water::{WGSL, WaterOptics};

use crate::device;

/// Points that are compared, a multiple of 64.
const POINTS: usize = 4096;

/// How far values may be apart, as a share of themselves.
const TOLERANCE: f64 = 1e-3;

const WATERS: [WaterOptics; 6] = [
    WaterOptics::PURE,
    WaterOptics::CLEAR_SEA,
    WaterOptics::COAST,
    WaterOptics::LAKE,
    WaterOptics::GLACIER_MILK,
    WaterOptics::SWAMP,
];

/// Irradiances above the water, of sun and sky.
const LIGHT: [[f32; 3]; 2] = [[1.0, 0.9, 0.8], [0.2, 0.3, 0.5]];
/// The sun's angular radius.
const SUN: f32 = 0.004_675;

const MAIN: &str = "
struct Point {
    view: vec3<f32>,
    depth: f32,
    sun: vec3<f32>,
    distance: f32,
    normal: vec3<f32>,
    cosine: f32,
    variance: vec2<f32>,
    leaves: f32,
    hessian: f32,
}

@group(0) @binding(0) var<storage, read> waters: array<Water>;
@group(0) @binding(1) var<storage, read> points: array<Point>;
@group(0) @binding(2) var<storage, read_write> found: array<array<vec4<f32>, 7>>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let water = waters[id.x % 6u];
    let p = points[id.x];
    let light = water_lit(water, p.sun, vec3<f32>(1.0, 0.9, 0.8), vec3<f32>(0.2, 0.3, 0.5));
    let up = water_upwelling(water, light, p.depth);
    let eta = select(water.index, 1.0 / water.index, p.leaves > 0.5);
    let ray = water_refract(p.view, p.normal, eta);
    let bend = vec3<f32>(p.hessian, 0.3 * p.hessian, -0.5 * p.hessian);
    let glitter = water_glitter(p.view, p.sun, p.normal, p.variance, 0.004675, water.index);
    found[id.x][0] = vec4<f32>(water_in_scatter(water, light, p.depth, p.view, p.distance), water_fresnel(p.cosine, eta));
    found[id.x][1] = vec4<f32>(water_irradiance(water, light, p.depth), water_reflectance(p.cosine, p.variance.x, water.index));
    found[id.x][2] = vec4<f32>(up, light.sun.y);
    found[id.x][3] = vec4<f32>(water_transmittance(water, p.distance), select(0.0, 1.0, ray.total));
    found[id.x][4] = vec4<f32>(water_blurred(water, p.distance), water_focus(bend, p.depth, water.index, WATER_BRIGHTEST));
    found[id.x][5] = vec4<f32>(water_foam(up, light.sky_irradiance, water.foam, p.cosine), water_crossing(p.cosine, eta));
    found[id.x][6] = vec4<f32>(ray.direction, glitter);
}
";

/// What the rows of the output hold, in three numbers and in the fourth, with the size below which they are compared as if
/// they had it.
const NAMES: [[(&str, f64); 2]; 7] = [
    [("in-scatter", 1e-6), ("Fresnel", 1e-2)],
    [("irradiance", 1e-6), ("rough", 1e-2)],
    [("upwelling", 1e-6), ("sun under water", 1e-2)],
    [("transmittance", 1e-6), ("total", 1.0)],
    [("blurred", 1e-6), ("focus", 1e-2)],
    [("foam", 1e-6), ("crossing", 1e-2)],
    [("refracted", 1.0), ("glitter", 1e-2)],
];

fn name(k: usize) -> (&'static str, f64) {
    NAMES[k / 4][k % 4 / 3]
}

/// A point as the shader has it.
fn point(random: &mut Random) -> [f32; 16] {
    let mut direction = |lowest: f64| {
        let cosine: f64 = random.within(lowest, 1.0);
        let (sine, azimuth) = ((1.0 - cosine * cosine).sqrt(), random.within(0.0, core::f64::consts::TAU));
        [sine * azimuth.cos(), cosine, sine * azimuth.sin()].map(|x| x as f32)
    };
    let (view, sun, normal) = (direction(-1.0), direction(-0.1), direction(0.9));
    // Some views look level, some along the mirrored sun.
    let view = match random.bits() % 8 {
        0 => [0.6, 0.0, -0.8],
        1 => [-sun[0], sun[1], -sun[2]],
        _ => view,
    };
    let mut size = |low: f64, high: f64| random.magnitude(low, high) as f32;
    let (depth, distance) = (size(1e-3, 100.0), size(1e-3, 1e3));
    let (x, z, hessian) = (size(1e-4, 0.2), size(1e-4, 0.2), size(1e-3, 10.0));
    let cosine = random.within(0.0, 1.0) as f32;
    let leaves = (random.bits() % 2) as f32;
    let [a, b, c] = view;
    let [d, e, f] = sun;
    let [g, h, i] = normal;
    [a, b, c, depth, d, e, f, distance, g, h, i, cosine, x, z, leaves, hessian]
}

/// What the CPU makes of it.
fn expected(optics: &WaterOptics, p: &[f32; 16]) -> [f32; 28] {
    let water = Water::<f32>::new(optics);
    let [view, sun, normal] = [0, 4, 8].map(|i| [p[i], p[i + 1], p[i + 2]]);
    let (depth, distance, cosine, variance) = (p[3], p[7], p[11], [p[12], p[13]]);
    let eta = if p[14] > 0.5 { 1.0 / water.index } else { water.index };
    let light = water.lit(sun, LIGHT[0], LIGHT[1]);
    let up = water.upwelling(&light, depth);
    let ray = refract(view, normal, eta);
    let bend = [p[15], 0.3 * p[15], -0.5 * p[15]];
    let rows = [
        (water.in_scatter(&light, depth, view, distance), fresnel(cosine, eta)),
        (water.irradiance(&light, depth), reflectance(cosine, variance[0], water.index)),
        (up, light.sun[1]),
        (water.transmittance(distance), f32::from(u8::from(ray.total))),
        (water.blurred(distance), focus(bend, depth, water.index, BRIGHTEST as f32)),
        (covered(up, light.sky_irradiance, water.foam, cosine), crossing(cosine, eta)),
        (ray.direction, glitter(view, sun, normal, variance, SUN, water.index)),
    ];
    core::array::from_fn(|i| {
        let (colour, last) = rows[i / 4];
        if i % 4 < 3 { colour[i % 4] } else { last }
    })
}

#[test]
fn water_is_the_cpus() {
    let mut random = Random::new(61);
    let waters: Vec<f32> = WATERS
        .iter()
        .flat_map(|w| {
            let ([a, b, c], [d, e, f], [g, h, i]) = (w.absorption, w.scattering, w.molecules);
            [a, b, c, w.index, d, e, f, w.anisotropy, g, h, i, w.foam]
        })
        .collect();
    let points: Vec<[f32; 16]> = (0..POINTS).map(|_| point(&mut random)).collect();
    let groups: [&[&[u8]]; 1] = [&[bytemuck::cast_slice(&waters), bytemuck::cast_slice(&points)]];
    let bytes = device::run(&[WGSL, MAIN].concat(), &groups, 28 * 4 * POINTS, POINTS as u32 / 64);
    let found: &[[f32; 28]] = bytemuck::cast_slice(&bytes);
    let mut worst = [0.0_f64; 28];
    let mut glitters = 0;
    for (i, (p, found)) in points.iter().zip(found).enumerate() {
        let optics = &WATERS[i % WATERS.len()];
        let expected = expected(optics, p);
        // At the critical angle reflection is total or not by the last digit, and its slope is infinite.
        let edge = |cosine: f32| p[14] > 0.5 && (cosine.abs() - critical_cosine(optics.index)).abs() < 1e-3;
        let along: f32 = (0..3).map(|k| p[k] * p[8 + k]).sum();
        glitters += usize::from(expected[27] > 1e-2);
        for (k, (found, expected)) in found.iter().zip(expected).enumerate() {
            let (name, least) = name(k);
            assert!(found.is_finite(), "{name} at {p:?}: {found}");
            let skipped = match name {
                "Fresnel" | "crossing" => edge(p[11]),
                "total" | "refracted" => edge(along),
                _ => false,
            };
            if !skipped {
                let off = f64::from((found - expected).abs()) / f64::from(expected.abs()).max(least);
                worst[k] = worst[k].max(off);
                assert!(off < TOLERANCE, "{name} at {p:?} in {optics:?}: {found}, not {expected}");
            }
        }
    }
    let report: Vec<_> = (0..28).map(|k| format!("{} {:.0e}", name(k).0, worst[k])).collect();
    println!("apart by at most: {}", report.join(", "));
    assert!(glitters > POINTS / 50, "{glitters} glitter");
}
