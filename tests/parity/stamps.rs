//! Stamps: the shipped WGSL, over the parts that the host writes for a tile, against the CPU.

use horizon_field::field::arbitrary::Random;
use horizon_field::stamp::{PART_BYTES, WGSL, arbitrary};
use horizon_field::{Jet, Place, Stamps};

use crate::device;

/// Points of a set of stamps.
const POINTS: usize = 4096;
/// The tile's side and its grids' cut-offs, in metres.
const SIDE: f64 = 64.0;
const CUTOFFS: [f64; 3] = [0.0, 2.0, 8.0];

#[test]
fn stamps_are_the_cpus() {
    let source = format!(
        "{WGSL}
@group(0) @binding(0) var<storage, read> parts: array<StampPart>;
@group(0) @binding(1) var<storage, read> points: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read> bases: array<vec4<f32>>;
@group(0) @binding(3) var<storage, read_write> jets: array<vec4<f32>>;

fn stamp_part(i: u32) -> StampPart {{
    return parts[i];
}}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {{
    let p = points[id.x];
    jets[id.x] = vec4<f32>(stamped(u32(p.z), u32(p.w), p.xy, bases[id.x].xyz), 0.0);
}}
"
    );
    let mut random = Random::new(51);
    let (mut worst, mut steepest, mut moved) = (0.0_f64, 0.0_f64, 0);
    for place in [[0.0; 3], [1e6, 0.0, -1e6], [-1e9, 0.0, 1e9]].map(Place::from_metres) {
        for cutoff in CUTOFFS {
            let middle = place.translated([0.5 * SIDE, 0.0, 0.5 * SIDE]);
            let stamps: Vec<_> = (0..20).map(|_| arbitrary::stamp(&mut random, &middle, SIDE, 8.0)).collect();
            let stamps = Stamps::compile(&stamps).unwrap();
            let at = stamps.at(&place);
            // Of another tile, before this one's.
            let mut parts = vec![0; 3 * PART_BYTES];
            let [count, holes] = at.append_bytes([0.5 * SIDE; 2], [0.5 * SIDE; 2], cutoff, &mut parts);
            assert_eq!((parts.len(), holes), ((3 + count as usize) * PART_BYTES, 0));
            let mut within = |high: f64| random.within(0.0, high) as f32;
            let points: Vec<[f32; 4]> = (0..POINTS).map(|_| [within(SIDE), within(SIDE), 3.0, count as f32]).collect();
            let bases: Vec<[f32; 4]> = (0..POINTS).map(|_| [within(30.0), within(1.0), within(1.0), 0.0]).collect();
            let groups: [&[&[u8]]; 1] = [&[&parts, bytemuck::cast_slice(&points), bytemuck::cast_slice(&bases)]];
            let bytes = device::run(&source, &groups, 16 * POINTS, POINTS as u32 / 64);
            let found: &[[f32; 4]] = bytemuck::cast_slice(&bytes);
            for ((point, base), found) in points.iter().zip(&bases).zip(found) {
                let q = [point[0], point[1]];
                let base = Jet { v: base[0], g: [base[1], base[2]] };
                let expected = at.jet(q, cutoff as f32, base);
                moved += usize::from(expected != base);
                worst = worst.max(f64::from((found[0] - expected.v).abs()));
                // In a crease of a path either side may be taken.
                let exact = at.jet(q.map(f64::from), cutoff, Jet { v: base.v.into(), g: base.g.map(f64::from) });
                let off = (0..2).map(|k| f64::from((found[k + 1] - expected.g[k]).abs()));
                let off = off.fold(0.0, f64::max) / (1.0 + exact.g[0].hypot(exact.g[1]));
                if off > 1e-3 {
                    let aside = |h: f32| at.jet([q[0] + h, q[1] + h], cutoff as f32, base).g;
                    let (a, b) = (aside(-1e-3), aside(1e-3));
                    let bend = (0..2).map(|k| f64::from((a[k] - b[k]).abs())).fold(0.0, f64::max);
                    assert!(bend > 1e-2, "gradients {found:?} and {expected:?} at {q:?}");
                } else {
                    steepest = steepest.max(off);
                }
            }
        }
    }
    println!(
        "values are apart by {worst:e} m at most, gradients by {steepest:e} of themselves; {moved} points are moved"
    );
    assert!(worst < 1e-3 && moved > POINTS);
}

#[test]
fn holes_are_the_cpus() {
    let source = format!(
        "{WGSL}
@group(0) @binding(0) var<storage, read> parts: array<StampPart>;
@group(0) @binding(1) var<storage, read> points: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read_write> holes: array<u32>;

fn stamp_part(i: u32) -> StampPart {{
    return parts[i];
}}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {{
    let p = points[id.x];
    holes[id.x] = select(0u, 1u, stamp_hole(u32(p.z), u32(p.w), p.xy));
}}
"
    );
    let mut random = Random::new(52);
    let (mut inside, mut apart) = (0, 0);
    for place in [[0.0; 3], [-1e9, 0.0, 1e9]].map(Place::from_metres) {
        for cutoff in CUTOFFS {
            let middle = place.translated([0.5 * SIDE, 0.0, 0.5 * SIDE]);
            let stamps = (0..20).map(|_| arbitrary::stamp(&mut random, &middle, SIDE, 8.0));
            let mut stamps: Vec<_> = stamps.collect();
            stamps.extend((0..20).map(|_| arbitrary::hole(&mut random, &middle, 0.5 * SIDE, 12.0)));
            let stamps = Stamps::compile(&stamps).unwrap();
            let at = stamps.at(&place);
            let mut parts = Vec::new();
            let [first, count] = at.append_bytes([0.5 * SIDE; 2], [0.5 * SIDE; 2], cutoff, &mut parts);
            let mut within = || random.within(0.0, SIDE) as f32;
            let points: Vec<[f32; 4]> = (0..POINTS).map(|_| [within(), within(), first as f32, count as f32]).collect();
            let groups: [&[&[u8]]; 1] = [&[&parts, bytemuck::cast_slice(&points)]];
            let bytes = device::run(&source, &groups, 4 * POINTS, POINTS as u32 / 64);
            let found: &[u32] = bytemuck::cast_slice(&bytes);
            for (point, found) in points.iter().zip(found) {
                let expected = at.is_hole([point[0], point[1]], cutoff as f32);
                inside += usize::from(expected);
                apart += usize::from(expected != (*found == 1));
            }
        }
    }
    println!("{inside} points lie in holes, {apart} are apart");
    // A device may round an edge otherwise.
    assert!(inside > POINTS && apart < 4);
}
