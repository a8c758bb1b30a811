// The drawn surface: the cached heights, bilinear in each patch, every level blended into the next at its rim.
//
// Notation. A *level* is a square of n × n texels around the clipmap's centre; a level's texel is twice the last's.
// A *cell* (i, j) is a texel's index relative to the texel that holds the centre; the patch of that name spans
// i..i+1, j..j+1. The *fraction* is where in its texel the centre lies. Storage is toroidal and in tiles of 64 × 64
// texels. x and z are metres from the centre, y is metres above the datum.

struct Level {
    // Metres per texel, and its inverse.
    texel: f32,
    per_metre: f32,
    // Chebyshev distance from the centre, in texels, where blending into the next level begins, and where it is done.
    inner: f32,
    outer: f32,
    // The centre's texel, modulo n; where in it the centre lies.
    base: vec2<i32>,
    fraction: vec2<f32>,
    // Where in the buffers the level is stored.
    @size(16) slot: u32,
}

struct Clipmap {
    // Finest first.
    levels: array<Level, 20>,
    count: u32,
    // Tiles along a side.
    side: u32,
}

@group(0) @binding(0) var<uniform> clipmap: Clipmap;

const TILE: u32 = 64u;
const TILE_BITS: u32 = 6u;
const TILE_TEXELS: u32 = 4096u;
// 32² + 16² + 8² + 4² + 2² + 1
const TILE_BOUNDS: u32 = 1365u;
const TILE_LIGHTS: u32 = 1024u;

// The tile that stores a cell of a level, and the cell's texel in it.
fn stored(level: u32, cell: vec2<i32>) -> vec3<u32> {
    let side = i32(clipmap.side * TILE);
    var at = clipmap.levels[level].base + cell;
    at += select(vec2<i32>(0), vec2<i32>(side), at < vec2<i32>(0));
    at -= select(vec2<i32>(0), vec2<i32>(side), at >= vec2<i32>(side));
    let texel = vec2<u32>(at);
    let tile = (clipmap.levels[level].slot * clipmap.side + (texel.y >> TILE_BITS)) * clipmap.side + (texel.x >> TILE_BITS);
    return vec3<u32>(tile, texel & vec2<u32>(TILE - 1u));
}

fn texel_index(level: u32, cell: vec2<i32>) -> u32 {
    let at = stored(level, cell);
    return at.x * TILE_TEXELS + (at.z << TILE_BITS) + at.y;
}

fn stored_height(level: u32, cell: vec2<i32>) -> f32 {
    return heights[texel_index(level, cell)];
}

// The lowest and highest point of the 2^mip × 2^mip patches around a cell; mip 1 to 6.
fn stored_bounds(level: u32, cell: vec2<i32>, mip: u32) -> vec2<f32> {
    let at = stored(level, cell);
    let offset = (4096u - (4096u >> (2u * (mip - 1u)))) / 3u;
    return bounds[at.x * TILE_BOUNDS + offset + ((at.z >> mip) << (TILE_BITS - mip)) + (at.y >> mip)];
}

// The cell of the next coarser level that holds a cell.
fn coarser(level: u32, cell: vec2<i32>) -> vec2<i32> {
    return ((clipmap.levels[level].base & vec2<i32>(1)) + cell) >> vec2<u32>(1u);
}

// How far a cell's corner is blended into the next level: 0 inside, 1 at the rim.
fn blend_at(level: u32, cell: vec2<f32>) -> f32 {
    let d = abs(cell - clipmap.levels[level].fraction);
    let inner = clipmap.levels[level].inner;
    return clamp((max(d.x, d.y) - inner) / (clipmap.levels[level].outer - inner), 0.0, 1.0);
}

fn bilinear(h: vec4<f32>, u: f32, v: f32) -> f32 {
    return mix(mix(h.x, h.y, u), mix(h.z, h.w, u), v);
}

fn stored_corners(level: u32, cell: vec2<i32>) -> vec4<f32> {
    return vec4<f32>(
        stored_height(level, cell),
        stored_height(level, cell + vec2<i32>(1, 0)),
        stored_height(level, cell + vec2<i32>(0, 1)),
        stored_height(level, cell + vec2<i32>(1, 1)));
}

// The heights of a patch's corners (00, 10, 01, 11), blended. Grids nest, so that a patch lies in one coarser patch.
fn corners(level: u32, cell: vec2<i32>) -> vec4<f32> {
    var h = stored_corners(level, cell);
    let low = vec2<f32>(cell);
    let w = vec4<f32>(
        blend_at(level, low),
        blend_at(level, low + vec2<f32>(1.0, 0.0)),
        blend_at(level, low + vec2<f32>(0.0, 1.0)),
        blend_at(level, low + vec2<f32>(1.0, 1.0)));
    if (any(w > vec4<f32>(0.0)) && level + 1u < clipmap.count) {
        let c = stored_corners(level + 1u, coarser(level, cell));
        let s = 0.5 * vec2<f32>((clipmap.levels[level].base + cell) & vec2<i32>(1));
        h = mix(h, vec4<f32>(
            bilinear(c, s.x, s.y), bilinear(c, s.x + 0.5, s.y),
            bilinear(c, s.x, s.y + 0.5), bilinear(c, s.x + 0.5, s.y + 0.5)), w);
    }
    return h;
}

// The highest point that the drawn surface can have in the 2^mip × 2^mip patches around a cell.
fn node_bounds(level: u32, cell: vec2<i32>, low: vec2<i32>, mip: u32) -> vec2<f32> {
    var b = stored_bounds(level, cell, mip);
    let half = 0.5 * f32(1u << mip);
    let far = abs(vec2<f32>(low) + half - clipmap.levels[level].fraction) + half;
    if (max(far.x, far.y) > clipmap.levels[level].inner && level + 1u < clipmap.count) {
        let c = stored_bounds(level + 1u, coarser(level, cell), max(mip - 1u, 1u));
        b = vec2<f32>(min(b.x, c.x), max(b.y, c.y));
    }
    return b;
}
