//! The ground's material on the device: the shipped WGSL against its twin on the CPU, and what an edit compiles.

use bevy::prelude::*;
use bevy::render::RenderApp;
use bevy::render::render_resource::PipelineCache;
use bevy_horizon::prelude::*;
use bevy_horizon::world::{CurvatureRule, HeightRule, NoiseLayer};
use bevy_horizon_workspace::stage::Stage;
use horizon_field::Compiled;
use horizon_field::field::arbitrary::{Pictures, Random};
use horizon_field::field::{Contents, Fractal};
use horizon_field::material::arbitrary::all_rules;
use horizon_field::material::{CompiledMaterial, GroundPoint, Look};

use crate::device;

/// Where they are compared, in metres from the world's origin.
const PLACES: [[f64; 3]; 3] = [[0.0; 3], [1e6, 0.0, -1e6], [-1e9, 0.0, 1e9]];
/// The texels at which they are, in metres: a cache's are powers of two.
const TEXELS: [f32; 4] = [0.25, 2.0, 32.0, 1024.0];
/// Points for each place and texel.
const COUNT: usize = 512;
/// How far albedo, roughness and reflectance may be apart.
const TOLERANCE: f32 = 2e-3;

const MAIN: &str = "
@group(1) @binding(0) var<storage, read> points: array<vec4<f32>>;
@group(1) @binding(1) var<storage, read> material: Material;
@group(1) @binding(2) var<storage, read_write> looks: array<vec4<u32>>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let point = points[id.x];
    let anchor = u32(point.w);
    let cutoff = 0.75 * point.z;
    let ground = height(anchor, point.xy, cutoff);
    let look = material_at(anchor, point.xy, point.z, cutoff, ground);
    looks[2u * id.x] = vec4<u32>(bitcast<vec3<u32>>(look.albedo), bitcast<u32>(look.roughness));
    looks[2u * id.x + 1u] = vec4<u32>(bitcast<u32>(look.reflectance), material_packed(look, vec2<u32>(id.x & 63u, id.x >> 6u)), 0u, 0u);
}
";

/// A point: which place, where from it, and the texel.
type Point = (usize, [f32; 2], f32);

fn points(random: &mut Random) -> Vec<Point> {
    let mut all = Vec::new();
    for place in 0..PLACES.len() {
        for texel in TEXELS {
            for _ in 0..COUNT {
                all.push((place, [(); 2].map(|()| random.within(0.0, 64.0 * f64::from(texel)) as f32), texel));
            }
        }
    }
    all
}

/// What the device makes of the points: albedo, roughness, reflectance, and the packed word.
fn on_device(material: &CompiledMaterial, height: &Compiled<2>, points: &[Point]) -> Vec<([f32; 5], u32)> {
    let fields: Vec<&Compiled<2>> = core::iter::once(height).chain(material.fields()).collect();
    let contents = Contents::new(&fields);
    let rows: usize = fields.iter().map(|field| field.layer_count()).sum();
    let mut anchors = Vec::new();
    for metres in PLACES {
        let place = Place::from_metres(metres);
        fields.iter().for_each(|field| field.append_anchor_bytes(&field.anchor(&place), &mut anchors));
    }
    let words: Vec<[f32; 4]> =
        points.iter().map(|(place, q, texel)| [q[0], q[1], *texel, (place * rows) as f32]).collect();
    let uniform = material.rows();
    let groups: [&[&[u8]]; 2] = [
        &[&contents.layers, &anchors, &contents.numbers, &contents.images],
        &[bytemuck::cast_slice(&words), bytemuck::cast_slice(&uniform[..])],
    ];
    let source = [&material.kernel(0, height).source, MAIN].join("\n");
    let bytes = device::run(&source, &groups, 32 * points.len(), points.len() as u32 / 64);
    bytemuck::cast_slice::<u8, [u32; 8]>(&bytes)
        .iter()
        .map(|w| ([w[0], w[1], w[2], w[3], w[4]].map(f32::from_bits), w[5]))
        .collect()
}

/// How far two packed looks are apart, in steps of each part: three bytes of albedo, roughness, reflectance.
fn steps(a: u32, b: u32) -> u32 {
    [(0, 255), (8, 255), (16, 255), (27, 31), (24, 7)]
        .map(|(shift, mask)| ((a >> shift) & mask).abs_diff((b >> shift) & mask))
        .into_iter()
        .max()
        .unwrap_or(0)
}

#[test]
fn materials_agree() {
    let hills = Field::Fractal(Fractal { wavelength: 9000.0, amplitude: 4000.0, octaves: 12.0, seed: 8, ..default() });
    let height = hills.compile::<2>(&Pictures).unwrap();
    for (name, material) in [("the default", TerrainMaterial::default()), ("all rules", all_rules())] {
        let material = material.compile(&Pictures).unwrap();
        let points = points(&mut Random::new(4));
        let found = on_device(&material, &height, &points);
        let anchors = PLACES.map(|metres| {
            let place = Place::from_metres(metres);
            (height.anchor(&place), material.anchor(&place))
        });
        let (mut worst, mut packed) = (0.0f32, 0);
        let mut seen = [0.0f32; 7];
        for (i, ((place, q, texel), (numbers, word))) in points.iter().zip(&found).enumerate() {
            let (ground, fields) = &anchors[*place];
            let look: Look<f32> =
                material.look(fields, &GroundPoint { height: &height, anchors: ground, q: *q, texel: *texel });
            let [r, g, b] = look.albedo;
            for (found, expected) in numbers.iter().zip([r, g, b, look.roughness, look.reflectance]) {
                assert!(found.is_finite(), "{name}: {numbers:?} at {q:?}");
                worst = worst.max((found - expected).abs());
            }
            let [r, g, b, roughness, reflectance] = *numbers;
            let own = Look { albedo: [r, g, b], roughness, reflectance, ..look };
            packed = packed.max(steps(*word, own.packed([i as u32 & 63, i as u32 >> 6])));
            (0..7).for_each(|k| seen[k] = seen[k].max(look.shares[k]));
        }
        println!("{name}: {worst:.1e} apart over {} points, {packed} steps when packed", points.len());
        assert!(worst <= TOLERANCE, "{name}: {worst} apart");
        assert!(packed <= 1, "{name}: {packed} steps apart when packed");
        let layers = if name == "all rules" { 7 } else { 6 };
        assert!(seen[..layers].iter().all(|share| *share > 0.2), "{name}: every layer must show somewhere: {seen:?}");
    }
}

fn pipelines(stage: &Stage) -> usize {
    stage.off.app.sub_app(RenderApp).world().resource::<PipelineCache>().pipelines().count()
}

/// A colour, a range, a noise that is no longer another's: numbers. A rule of another kind of field is not.
#[test]
fn a_materials_numbers_compile_nothing() {
    let mut stage = Stage::new(160, 90);
    stage.light();
    let hills = Field::Fractal(Fractal { wavelength: 3000.0, amplitude: 200.0, octaves: 8.0, ..default() });
    let terrain = stage.world().spawn(Terrain::new(hills)).id();
    stage.look(Transform::from_xyz(0.0, 900.0, 0.0).looking_to(Vec3::new(0.2, -1.0, -0.6), Vec3::Y));
    stage.settle();
    let (before, compiled) = (stage.colour(), pipelines(&stage));
    {
        let mut terrain = stage.world().get_mut::<Terrain>(terrain).unwrap();
        let grass = &mut terrain.material.layers[1];
        grass.surface.colour = [0.8, 0.1, 0.1];
        grass.surface.tint = Some(NoiseLayer { wavelength: 55.0, ..default() });
        grass.height = Some(HeightRule { high: 5000.0, ..default() });
    }
    stage.settle();
    let after = stage.colour();
    assert_eq!(pipelines(&stage), compiled);
    assert!(before != after, "the ground must change its look");

    stage.world().get_mut::<Terrain>(terrain).unwrap().material.layers[1].curvature = Some(CurvatureRule::default());
    stage.settle();
    stage.off.update();
    assert_eq!(pipelines(&stage), compiled + 1);
}
