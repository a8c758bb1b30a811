//! What the cache keeps of the sun at a point, in 16 bits: packed and read again by the shipped shader.

use horizon_field::field::arbitrary::Random;

use crate::device;

const SUN_SEEN: &str = include_str!("../../crates/bevy_horizon/src/render/cache/sun_seen.wgsl");
const WORDS: usize = 8192;

/// The part of a disc of radius 1 that lies above a line at height x.
fn disc_above(x: f64) -> f64 {
    let c = x.clamp(-1.0, 1.0);
    0.5 - (c * (1.0 - c * c).sqrt() + c.asin()) / std::f64::consts::PI
}

/// Both numbers rounded by themselves, to 128 and 256 steps.
fn naive_depth([x, penumbra]: [f64; 2]) -> f64 {
    let round = |log: f64, steps: f64| (log * steps).round() / steps;
    (round(x.log2() / 14.0, 127.0) * 14.0).exp2() * (round((penumbra.log2() + 10.0) / 24.0, 255.0) * 24.0 - 10.0).exp2()
}

#[test]
fn a_shadows_depth_is_kept_to_half_a_percent() {
    let mut random = Random::new(17);
    // From two penumbras to thousands deep; then parts of the disc.
    let mut points: Vec<[f64; 2]> =
        (0..WORDS / 2).map(|_| [random.within(1.0, 13.0).exp2(), random.within(-9.0, 13.0).exp2()]).collect();
    points.extend((0..WORDS / 2).map(|_| [random.within(-1.2, 0.99), random.within(-9.0, 13.0).exp2()]));
    let given: Vec<[f32; 2]> = points.iter().map(|point| point.map(|x| x as f32)).collect();
    let main = "
@group(0) @binding(0) var<storage, read> given: array<vec2<f32>>;
@group(0) @binding(1) var<storage, read_write> found: array<vec4<f32>>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let word = packed_sun(given[id.x].x, given[id.x].y);
    found[id.x] = vec4<f32>(unpacked_depth(word), unpacked_penumbra(word), unpacked_seen(word), f32(word));
}
";
    let source = [SUN_SEEN, main].join("\n");
    let bytes = device::run(&source, &[&[bytemuck::cast_slice(&given)]], 16 * WORDS, WORDS as u32 / 64);
    let found: &[[f32; 4]] = bytemuck::cast_slice(&bytes);
    let off = |read: f64, true_value: f64| (read / true_value - 1.0).abs();
    let (mut ours, mut naive, mut narrow) = (0.0f64, 0.0f64, 0.0f64);
    for ([x, penumbra], [depth, width, seen, word]) in points.iter().zip(found) {
        assert!(*word < 65536.0, "{word} is more than 16 bits");
        if *x >= 1.0 {
            assert_eq!(*seen, 0.0, "all of the disc is hidden at {x}");
            ours = ours.max(off(f64::from(*depth), x * penumbra));
            naive = naive.max(off(naive_depth([*x, *penumbra]), x * penumbra));
            continue;
        }
        narrow = narrow.max(off(f64::from(*width), *penumbra));
        assert!((f64::from(*seen) - disc_above(*x)).abs() < 0.6 / 127.0, "{seen} of the disc at {x}");
        // The disc's part tells little of where the line is near the disc's edges.
        let line = f64::from(*depth) / f64::from(*width);
        assert!((line - x.max(-1.0)).abs() < 0.08, "the line is at {line}, and should be at {x}");
    }
    println!(
        "depths are off by at most {:.2} %, naively {:.1} %; penumbras by {:.1} %",
        100.0 * ours,
        100.0 * naive,
        100.0 * narrow
    );
    assert!(ours < 0.006 && naive > 0.05 && narrow < 0.035, "{ours}, {naive}, {narrow}");
}
