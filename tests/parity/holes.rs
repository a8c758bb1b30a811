//! Rays through holes: the shipped march, over two levels made by hand, against a march by brute force over the same drawn surface.

use bevy_horizon::render::shader_constants;
use horizon_field::field::arbitrary::Random;

use crate::device;

const SURFACE: &str = include_str!("../../crates/bevy_horizon/src/render/cache/surface.wgsl");
const LOOK: &str = include_str!("../../crates/bevy_horizon/src/render/passes/look.wgsl");
const RAY: &str = include_str!("../../crates/bevy_horizon/src/render/cache/ray.wgsl");
const MARCH: &str = include_str!("../../crates/bevy_horizon/src/render/cache/march.wgsl");

/// Texels along a level's side, in 4 × 4 tiles.
const SIDE: i32 = 256;
const TILE: i32 = 64;
const TILE_BOUNDS: usize = 1367;
const TILE_LOOKS: usize = 6656;
const RAYS: usize = 8192;

/// A level: metres per texel, where it is blended into the next, and where in its middle texel the centre lies.
struct Level {
    texel: f64,
    inner: f64,
    outer: f64,
    fraction: [f64; 2],
}

const LEVELS: [Level; 2] = [
    Level { texel: 0.25, inner: 80.0, outer: 100.0, fraction: [0.25, 0.625] },
    Level { texel: 0.5, inner: 240.0, outer: 120.0, fraction: [0.125, 0.3125] },
];

/// High above the datum, where f32 has few digits left.
fn height([x, z]: [f64; 2]) -> f32 {
    let waves = 3.0 * (0.21 * x + 0.3).sin() * (0.17 * z).cos() + 1.5 * (0.4 * z - 0.1 * x).sin();
    (700.0 + waves + 0.6 * (0.9 * x).sin() * (1.1 * z).sin()) as f32
}

/// Rows of round and square holes.
fn is_hole([x, z]: [f64; 2]) -> bool {
    let [u, v] = [x, z].map(|x| (x / 9.0 - (x / 9.0).round()) * 9.0);
    if (x / 9.0).round() as i32 & 1 == 0 { u.hypot(v) < 3.0 } else { u.abs().max(v.abs()) < 2.0 }
}

impl Level {
    fn place(&self, [i, j]: [i32; 2]) -> [f64; 2] {
        [(f64::from(i) - self.fraction[0]) * self.texel, (f64::from(j) - self.fraction[1]) * self.texel]
    }

    /// How far a texel is blended into the next level.
    fn blend(&self, [i, j]: [i32; 2]) -> f64 {
        let off = (f64::from(i) - self.fraction[0]).abs().max((f64::from(j) - self.fraction[1]).abs());
        if self.inner >= self.outer { 0.0 } else { ((off - self.inner) / (self.outer - self.inner)).clamp(0.0, 1.0) }
    }
}

fn between(h: [f64; 4], u: f64, v: f64) -> f64 {
    (h[0] * (1.0 - u) + h[1] * u) * (1.0 - v) + (h[2] * (1.0 - u) + h[3] * u) * v
}

fn corners([i, j]: [i32; 2]) -> [[i32; 2]; 4] {
    [[i, j], [i + 1, j], [i, j + 1], [i + 1, j + 1]]
}

/// The drawn surface: its height, and whether the nearest texel is a hole.
fn drawn(p: [f64; 2]) -> (f64, bool) {
    let chebyshev = p[0].abs().max(p[1].abs());
    let level = usize::from(chebyshev >= LEVELS[0].outer * LEVELS[0].texel);
    let l = &LEVELS[level];
    let at = [0, 1].map(|k| p[k] / l.texel + l.fraction[k]);
    let cell = at.map(|at| at.floor() as i32);
    let heights = corners(cell).map(|corner| {
        let own = f64::from(height(l.place(corner)));
        let blend = l.blend(corner);
        if blend == 0.0 {
            return own;
        }
        let coarse = &LEVELS[1];
        let below = corner.map(|c| c >> 1);
        let [u, v] = corner.map(|c| 0.5 * f64::from(c & 1));
        own + blend * (between(corners(below).map(|c| f64::from(height(coarse.place(c)))), u, v) - own)
    });
    let nearest = at.map(|at| (at + 0.5).floor() as i32);
    (between(heights, at[0] - f64::from(cell[0]), at[1] - f64::from(cell[1])), is_hole(l.place(nearest)))
}

/// Where a ray first comes to the drawn ground from above.
fn brute(ray: &[[f32; 4]; 2]) -> Option<f64> {
    const STEP: f64 = 0.01;
    let at = |t: f64| [0, 1, 2].map(|k| f64::from(ray[0][k]) + t * f64::from(ray[1][k]));
    let over = |t: f64| {
        let [x, y, z] = at(t);
        y > drawn([x, z]).0
    };
    let rim = LEVELS[1].outer * LEVELS[1].texel;
    let (mut above, mut t) = (over(0.0), 0.0);
    loop {
        let [x, y, z] = at(t + STEP);
        if x.abs().max(z.abs()) >= rim || !(600.0..800.0).contains(&y) {
            return None;
        }
        if over(t + STEP) != above {
            let [mut low, mut high] = [t, t + STEP];
            for _ in 0..40 {
                let middle = 0.5 * (low + high);
                *(if over(middle) == above { &mut low } else { &mut high }) = middle;
            }
            let [x, _, z] = at(high);
            if above && !drawn([x, z]).1 {
                return Some(high);
            }
            above = !above;
        }
        t += STEP;
    }
}

/// Where a texel is stored: its tile, and its place in it.
fn stored(level: usize, cell: [i32; 2]) -> (usize, usize) {
    let [x, z] = cell.map(|c| c.rem_euclid(SIDE));
    let tiles = SIDE / TILE;
    let tile = (level as i32 * tiles + z / TILE) * tiles + x / TILE;
    (tile as usize, ((z % TILE) * TILE + x % TILE) as usize)
}

/// The buffers of both levels: the clipmap, heights, bounds and looks.
fn buffers() -> [Vec<u8>; 4] {
    let mut clipmap: Vec<u8> = Vec::new();
    for (slot, l) in LEVELS.iter().enumerate() {
        let numbers = [l.texel, 1.0 / l.texel, l.inner, l.outer].map(|x| x as f32);
        clipmap.extend(bytemuck::bytes_of(&numbers));
        clipmap.extend(bytemuck::bytes_of(&[0i32; 2]));
        clipmap.extend(bytemuck::bytes_of(&l.fraction.map(|x| x as f32)));
        clipmap.extend(bytemuck::bytes_of(&[-SIDE / 2, -SIDE / 2, SIDE / 2, SIDE / 2]));
        clipmap.extend(bytemuck::bytes_of(&[slot as u32, 0, 0, 0]));
    }
    clipmap.resize(20 * 64, 0);
    clipmap.extend(bytemuck::bytes_of(&[LEVELS.len() as u32, (SIDE / TILE) as u32]));
    let tiles = LEVELS.len() * ((SIDE / TILE) * (SIDE / TILE)) as usize;
    let mut heights = vec![0.0f32; tiles * 4096];
    let mut bounds = vec![0u32; tiles * TILE_BOUNDS];
    let mut looks = vec![0u32; tiles * TILE_LOOKS];
    let range = -SIDE / 2..SIDE / 2;
    for (level, l) in LEVELS.iter().enumerate() {
        for cell in range.clone().flat_map(|j| range.clone().map(move |i| [i, j])) {
            let (tile, at) = stored(level, cell);
            heights[tile * 4096 + at] = height(l.place(cell));
            let word = if is_hole(l.place(cell)) { 0x00ff_ffff } else { 0xd8ff_ffff };
            looks[tile * TILE_LOOKS + 3 * (at >> 1) + (at & 1)] = word;
        }
        for first in range.clone().step_by(64).flat_map(|j| range.clone().step_by(64).map(move |i| [i, j])) {
            let tile = stored(level, first).0 * TILE_BOUNDS;
            let (low, step) = (690.0f32, 0.001f32);
            (bounds[tile], bounds[tile + 1]) = (low.to_bits(), step.to_bits());
            let mut offset = 2;
            for mip in 1..=6 {
                let side = TILE >> mip;
                for node in (0..side).flat_map(|z| (0..side).map(move |x| [x, z])) {
                    let reach = |k: usize| {
                        let from = first[k] + (node[k] << mip);
                        from..=(from + (1 << mip)).min(SIDE / 2 - 1)
                    };
                    let all = reach(1).flat_map(|j| reach(0).map(move |i| height(l.place([i, j]))));
                    let [least, most] = all.fold([1e9f32, -1e9], |[low, high], h| [low.min(h), high.max(h)]);
                    let word =
                        (((most - low) / step).ceil() as u32 + 1) << 16 | (((least - low) / step).floor() as u32 - 1);
                    bounds[tile + offset + (node[1] * side + node[0]) as usize] = word;
                }
                offset += (side * side) as usize;
            }
        }
    }
    let bytes = |words: &[u32]| bytemuck::cast_slice(words).to_vec();
    [clipmap, bytemuck::cast_slice(&heights).to_vec(), bytes(&bounds), bytes(&looks)]
}

/// Rays from above and from below, most of them flat.
fn rays() -> Vec<[[f32; 4]; 2]> {
    let mut random = Random::new(91);
    let mut one = || {
        let [x, z] = [(); 2].map(|()| random.within(-40.0, 40.0));
        let up = random.pick(&[1.0, 1.0, -1.0]) * random.magnitude(0.2, 12.0);
        let d = [random.within(-1.0, 1.0), random.within(-0.5, 0.3), random.within(-1.0, 1.0)];
        let length = d.iter().map(|x| x * x).sum::<f64>().sqrt();
        let [dx, dy, dz] = d.map(|d| (d / length) as f32);
        [[x as f32, (drawn([x, z]).0 + up) as f32, z as f32, 0.0], [dx, dy, dz, 0.0]]
    };
    (0..RAYS).map(|_| one()).collect()
}

/// The distance that the device finds for each ray, and how many turns it takes.
fn march(buffers: &[Vec<u8>; 4], rays: &[[[f32; 4]; 2]], holes: u32) -> Vec<[f32; 4]> {
    let main = "
struct View {
    holes: u32,
}

@group(0) @binding(1) var<storage, read> heights: array<f32>;
@group(0) @binding(2) var<storage, read> bounds: array<u32>;
@group(0) @binding(4) var<storage, read> rays: array<vec4<f32>>;
@group(0) @binding(5) var<storage, read> view: View;
@group(0) @binding(6) var<storage, read_write> found: array<vec4<f32>>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let hit = march(Ray(rays[2u * id.x].xyz, rays[2u * id.x + 1u].xyz), 0.0, 1e4);
    found[id.x] = vec4<f32>(hit.t, f32(hit.steps), 0.0, 0.0);
}
";
    let source = ["const HEAT: bool = true;", &shader_constants(), SURFACE, LOOK, RAY, MARCH, main].join("\n");
    let source = source.replace("var<uniform> clipmap", "var<storage, read> clipmap");
    let [clipmap, heights, bounds, looks] = buffers;
    let groups: [&[&[u8]]; 1] = [&[clipmap, heights, bounds, looks, bytemuck::cast_slice(rays), &holes.to_le_bytes()]];
    let bytes = device::run(&source, &groups, 16 * RAYS, RAYS as u32 / 64);
    bytemuck::cast_slice(&bytes).to_vec()
}

#[test]
fn rays_through_holes_are_those_of_brute_force() {
    let (buffers, rays) = (buffers(), rays());
    let [ours, naive] = [1, 0].map(|holes| march(&buffers, &rays, holes));
    let expected: Vec<Option<f64>> = rays.iter().map(brute).collect();
    let off = |found: &[[f32; 4]]| {
        let wrong = |(found, expected): &(&[f32; 4], &Option<f64>)| match expected {
            Some(t) => (f64::from(found[0]) - t).abs() > 5e-3 + 1e-3 * t,
            None => found[0] >= 0.0,
        };
        found.iter().zip(&expected).filter(wrong).count()
    };
    let turns = |found: &[[f32; 4]]| found.iter().map(|one| f64::from(one[1])).sum::<f64>() / RAYS as f64;
    let longest = ours.iter().map(|one| one[1]).fold(0.0, f32::max);
    let (wrong, naively) = (off(&ours), off(&naive));
    println!("of {RAYS} rays {wrong} are not where brute force has them, and {naively} without holes");
    println!("{} turns a ray, {longest} at most; {} without holes", turns(&ours), turns(&naive));
    // Those that graze the ground or a hole's edge, nearer than f32 tells.
    assert!(wrong < RAYS / 500 && naively > RAYS / 10, "{wrong} and {naively}");
    assert!(longest < 700.0, "{longest} turns");
}
