//! The shipped WGSL against the CPU: hashes and lattices bit for bit, fields within a share of their range.

mod bits;
mod holes;
mod stamps;
mod sun_words;
mod water;

use std::time::Instant;

use horizon_field::field::arbitrary::{self, BASES, Pictures, Random};
use horizon_field::field::kernel::module;
use horizon_field::field::{Anchors, Contents, Noise};
use horizon_field::{Compiled, Field, Jet, Place};

use crate::device;

/// Where fields are compared, in metres from the world's origin.
const PLACES: [[f64; 3]; 3] = [[0.0; 3], [1e6, -1e6, 1e6], [-1e9, 1e9, 1e9]];
/// The grids' spacings on which they are, in the finest wavelengths of the field: all octaves are whole; some fade; most
/// are gone.
const TEXELS: [f64; 3] = [0.5, 0.75, 16.0];
/// How far points lie from their anchor, in texels: a tile of the cache.
const TILE: f64 = 64.0;
/// A gradient may jump within this many texels: there, values agree, but gradients need not.
const JUMP: f64 = 2e-4;
/// How far gradients may be apart, as a share of the steepest.
const GRADIENT: f64 = 1e-3;
/// How far f64 gradients may be off the central differences of f64 values, as a share of the steepest.
const DIFFERENCE: f64 = 1e-5;
/// The largest share of points that may lie in a jump.
const JUMPS: f64 = 0.01;

/// Points of a field, by place, then by texel.
struct Points<const D: usize> {
    anchors: Vec<Anchors<D>>,
    /// For each place, offsets from its anchor with the texel.
    at: Vec<Vec<([f32; D], f32)>>,
}

impl<const D: usize> Points<D> {
    /// `count` points, a multiple of 64, for each place and texel.
    fn new(compiled: &Compiled<D>, count: usize, random: &mut Random) -> Self {
        let finest = Some(compiled.finest_wavelength()).filter(|finest| finest.is_finite()).unwrap_or(1.0);
        let anchors = PLACES.map(|metres| compiled.anchor(&Place::from_metres(metres))).into();
        let mut tiles = || {
            TEXELS
                .iter()
                .flat_map(|texel| vec![(texel * finest) as f32; count])
                .map(|texel| ([(); D].map(|()| (f64::from(texel) * random.within(0.0, TILE)) as f32), texel))
                .collect()
        };
        Self { anchors, at: PLACES.map(|_| tiles()).into() }
    }

    fn iter(&self) -> impl Iterator<Item = (&Anchors<D>, [f32; D], f32)> {
        self.anchors
            .iter()
            .zip(&self.at)
            .flat_map(|(anchors, at)| at.iter().map(move |(q, texel)| (anchors, *q, *texel)))
    }

    /// What the device makes of the field `name` of a kernel whose places have the anchors of `fields`.
    fn on_device(&self, source: &str, name: &str, fields: &[&Compiled<D>]) -> Vec<Jet<f32, D>> {
        let contents = Contents::new(fields);
        let rows: usize = fields.iter().map(|field| field.layer_count()).sum();
        let mut anchors = Vec::new();
        for metres in PLACES {
            let place = Place::from_metres(metres);
            fields.iter().for_each(|field| field.append_anchor_bytes(&field.anchor(&place), &mut anchors));
        }
        if anchors.is_empty() {
            anchors.resize(48, 0);
        }
        let points: Vec<[f32; 4]> = self
            .iter()
            .map(|(_, q, texel)| {
                let mut point = [0.0, 0.0, 0.0, texel];
                point[..D].copy_from_slice(&q);
                point
            })
            .collect();
        let (q, pad) = if D == 2 { ("xy", ", 0.0") } else { ("xyz", "") };
        let main = format!(
            "
@group(1) @binding(0) var<storage, read> points: array<vec4<f32>>;
@group(1) @binding(1) var<storage, read_write> jets: array<vec4<f32>>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {{
    let point = points[id.x];
    jets[id.x] = vec4<f32>({name}(id.x / {}u * {rows}u, point.{q}, point.w){pad});
}}
",
            self.at[0].len()
        );
        let groups: [&[&[u8]]; 2] =
            [&[&contents.layers, &anchors, &contents.numbers, &contents.images], &[bytemuck::cast_slice(&points)]];
        let bytes = device::run(&[source, &main].join("\n"), &groups, 16 * points.len(), points.len() as u32 / 64);
        bytemuck::cast_slice::<u8, [f32; 4]>(&bytes)
            .iter()
            .map(|jet| Jet { v: jet[0], g: core::array::from_fn(|k| jet[k + 1]) })
            .collect()
    }
}

/// The smallest and the largest of 1000 values from all over the world.
fn range<const D: usize>(compiled: &Compiled<D>, random: &mut Random) -> [f64; 2] {
    (0..1000).fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], _| {
        let place = Place::from_metres([(); 3].map(|()| random.within(-1e6, 1e6)));
        let v = compiled.value_f64(&compiled.anchor(&place), [0.0; D], 0.0);
        [low.min(v), high.max(v)]
    })
}

fn length<const D: usize>(g: [f64; D]) -> f64 {
    g.iter().map(|g| g * g).sum::<f64>().sqrt()
}

fn apart<const D: usize>(a: [f64; D], b: [f64; D]) -> f64 {
    length::<D>(core::array::from_fn(|k| a[k] - b[k]))
}

/// Worst figures of a comparison, as shares.
#[derive(Default)]
struct Report {
    /// Device against CPU f32, of the range.
    value: f64,
    /// CPU f32 against f64, of the range: what rounding alone does.
    rounding: f64,
    /// Device against CPU f32, of the steepest, apart from jumps.
    gradient: f64,
    /// f64 gradients against differences, of the steepest, apart from jumps.
    difference: f64,
    /// Points in jumps.
    jumps: f64,
}

/// How much the gradient bends over the distance `by` around q: quadratically little, but where it jumps.
fn bend<const D: usize>(compiled: &Compiled<D>, anchors: &Anchors<D>, q: [f64; D], by: f64, texel: f64) -> f64 {
    let gradient = |axis: usize, by: f64| {
        let mut q = q;
        q[axis] += by;
        compiled.jet_f64(anchors, q, texel).g
    };
    let here = compiled.jet_f64(anchors, q, texel).g;
    (0..D)
        .flat_map(|axis| [0.25, 0.5, 1.0].map(|part| (axis, part * by)))
        .map(|(axis, by)| {
            let (before, after) = (gradient(axis, -by), gradient(axis, by));
            length::<D>(core::array::from_fn(|k| before[k] + after[k] - 2.0 * here[k]))
        })
        .fold(0.0, f64::max)
}

fn compare<const D: usize>(
    compiled: &Compiled<D>,
    points: &Points<D>,
    found: &[Jet<f32, D>],
    random: &mut Random,
) -> Report {
    let truths: Vec<Jet<f64, D>> =
        points.iter().map(|(at, q, texel)| compiled.jet_f64(at, q.map(f64::from), f64::from(texel))).collect();
    let [low, high] = truths.iter().fold(range(compiled, random), |[low, high], jet| [low.min(jet.v), high.max(jet.v)]);
    // A field that is the same everywhere, up to rounding, has its height for a range, and that over a texel for a slope.
    let height = low.abs().max(high.abs()).max(1e-3);
    let (range, least) = if high - low > 1e-9 * height {
        (high - low, f64::MIN_POSITIVE)
    } else {
        (height, height / f64::from(points.at[0][0].1))
    };
    let steepest = truths.iter().map(|jet| length(jet.g)).fold(least, f64::max);
    let mut report = Report::default();
    let mut jumps = 0;
    for (i, ((at, q, texel), (truth, found))) in points.iter().zip(truths.iter().zip(found)).enumerate() {
        let expected = compiled.jet_f32(at, q, texel);
        let v = f64::from(expected.v);
        assert!(found.v.is_finite() && found.g.iter().all(|g| g.is_finite()), "{found:?} at {q:?}");
        report.value = report.value.max((f64::from(found.v) - v).abs() / range);
        report.rounding = report.rounding.max((v - truth.v).abs() / range);

        let (q, texel) = (q.map(f64::from), f64::from(texel));
        let gradient = apart(expected.g.map(f64::from), found.g.map(f64::from)) / steepest;
        let difference = if i % 8 == 0 { difference(compiled, at, q, texel, truth.g) / steepest } else { 0.0 };
        let off = gradient > GRADIENT || difference > DIFFERENCE;
        if off && bend(compiled, at, q, JUMP * texel, texel) > 0.1 * (gradient.max(difference) * steepest) {
            jumps += 1;
        } else {
            report.gradient = report.gradient.max(gradient);
            report.difference = report.difference.max(difference);
        }
    }
    report.jumps = f64::from(jumps) / found.len() as f64;
    report
}

/// How far a gradient is off the central differences of the values.
fn difference<const D: usize>(
    compiled: &Compiled<D>,
    anchors: &Anchors<D>,
    q: [f64; D],
    texel: f64,
    gradient: [f64; D],
) -> f64 {
    let h = 2e-5 * texel;
    let differences = core::array::from_fn(|axis| {
        let (mut before, mut after) = (q, q);
        before[axis] -= h;
        after[axis] += h;
        (compiled.value_f64(anchors, after, texel) - compiled.value_f64(anchors, before, texel))
            / (after[axis] - before[axis])
    });
    apart(gradient, differences)
}

/// How far values may be apart, as a share of the range: a multifractal multiplies its octaves' errors, and a warp turns
/// errors of the displacement into errors of the place.
fn tolerance(field: &Field) -> f64 {
    let text = format!("{field:?}");
    let steep = ["Warp(", "rule: Heterogeneous", "rule: Hybrid", "rule: Ridged"].iter().any(|part| text.contains(part));
    if steep { 1e-4 } else { 1e-5 }
}

/// Compares a field, and prints how far it is off.
fn check<const D: usize>(name: &str, field: &Field, count: usize) -> Report {
    let compiled = field.compile::<D>(&Pictures).unwrap_or_else(|error| panic!("{name}: {error}"));
    let mut random = Random::new(3);
    let points = Points::new(&compiled, count, &mut random);
    let found = points.on_device(&compiled.kernel(0).source, "field", &[&compiled]);
    let report = compare(&compiled, &points, &found, &mut random);
    let Report { value, rounding, gradient, difference, jumps } = report;
    println!(
        "{D}D {name:26} value {value:.1e} (rounding {rounding:.1e}) gradient {gradient:.1e}, against differences \
         {difference:.1e}, in jumps {:.2} %",
        100.0 * jumps
    );
    report
}

fn assert_gradients(name: &str, report: &Report) {
    assert!(report.gradient <= GRADIENT, "{name}: gradients are {:e} of the steepest apart", report.gradient);
    assert!(report.difference <= DIFFERENCE, "{name}: gradients are {:e} off the differences", report.difference);
    assert!(report.jumps < JUMPS, "{name}: {} of the points are in jumps", report.jumps);
}

fn check_all<const D: usize>(fields: &[(String, Field)]) {
    let start = Instant::now();
    for (name, field) in fields {
        let report = check::<D>(name, field, 512);
        assert!(report.value <= tolerance(field), "{name}: {:e} of the range apart", report.value);
        assert_gradients(name, &report);
    }
    println!("{} fields, {} points each, in {:.1?}", fields.len(), 512 * PLACES.len() * TEXELS.len(), start.elapsed());
}

#[test]
fn noises_agree() {
    let fields: Vec<_> = BASES
        .into_iter()
        .map(|basis| {
            (format!("{basis:?} noise"), Field::from(Noise { basis, seed: 7, rotation: 0.4, ..Noise::default() }))
        })
        .collect();
    check_all::<2>(&fields);
    check_all::<3>(&fields);
}

#[test]
fn nodes_agree_in_the_plane() {
    check_all::<2>(&arbitrary::every_kind(4));
}

#[test]
fn nodes_agree_in_space() {
    check_all::<3>(&arbitrary::every_kind(5));
}

/// Random trees may be steep: a narrow band of a high field, blown up. So the device may also be off by as much as f32
/// itself is, give or take the order of its operations.
fn check_trees<const D: usize>(seed: u32, trees: u32) {
    let mut random = Random::new(seed);
    let (mut worst, mut steep) = (0.0f64, 0);
    for i in 0..trees {
        // Deep ones are few: a software driver needs seconds to compile them.
        let field = arbitrary::field(&mut random, if i % 5 == 0 { 3 } else { 2 });
        let name = format!("tree {i} ({})", field.name());
        let report = check::<D>(&name, &field, 128);
        let allowed = tolerance(&field);
        if report.value > allowed {
            steep += 1;
            assert!(report.value <= 4.0 * report.rounding, "{name}: {:e} of the range apart", report.value);
        } else {
            worst = worst.max(report.value);
        }
        assert_gradients(&name, &report);
    }
    println!("{D}D: {trees} trees, {worst:.1e} of the range apart; {steep} that are steep, by their own rounding");
    assert!(10 * steep <= trees, "{steep} of {trees} trees");
}

#[test]
fn trees_agree_in_the_plane() {
    check_trees::<2>(6, 70);
}

#[test]
fn trees_agree_in_space() {
    check_trees::<3>(7, 30);
}

#[test]
fn fields_of_one_kernel_do_not_mix() {
    let mut random = Random::new(8);
    let fields = ["Image", "Fractal", "Mask"].map(|kind| arbitrary::node(kind, &mut random, 2));
    let compiled = fields.each_ref().map(|field| field.compile::<2>(&Pictures).unwrap());
    let [a, b, c] = &compiled;
    let kernel = module(0, &[("a", a), ("b", b), ("c", c)]);
    for ((name, field), compiled) in ["a", "b", "c"].into_iter().zip(&fields).zip(&compiled) {
        let points = Points::new(compiled, 256, &mut random);
        let found = points.on_device(&kernel.source, name, &[a, b, c]);
        let report = compare(compiled, &points, &found, &mut random);
        assert!(report.value <= tolerance(field), "{name}: {:e} of the range apart", report.value);
        assert_gradients(name, &report);
    }
}
