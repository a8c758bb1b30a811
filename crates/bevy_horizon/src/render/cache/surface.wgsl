// The drawn surface: the cached heights, bilinear in each patch, every level blended into the next at its rim.
//
// Notation. A *level* is a square of n × n texels around the clipmap's centre; a level's texel is twice the last's.
// A *cell* (i, j) is a texel's index relative to the texel that holds the centre; the patch of that name spans
// i..i+1, j..j+1. The *fraction* is where in its texel the centre lies. Storage is toroidal and in tiles of 64 × 64
// texels. x and z are metres from the centre, y is metres above the datum. Needs the constants of shaders.rs.

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
    // The cells that hold ground: from low up to high, without it.
    low: vec2<i32>,
    high: vec2<i32>,
    // Where in the buffers the level is stored.
    @size(16) slot: u32,
}

struct Clipmap {
    // Finest first.
    levels: array<Level, MAX_LEVELS>,
    count: u32,
    // Tiles along a side.
    side: u32,
}

@group(0) @binding(0) var<uniform> clipmap: Clipmap;

// A cell's index along each axis of a level's storage: brought into 0 .. n, from at most n outside.
fn wrapped(l: Level, cell: vec2<i32>) -> vec2<u32> {
    let side = vec2<i32>(i32(clipmap.side * TILE));
    var at = l.base + cell;
    at += select(vec2<i32>(0), side, at < vec2<i32>(0));
    at -= select(vec2<i32>(0), side, at >= side);
    return vec2<u32>(at);
}

// The tile that stores a texel.
fn tile_of(l: Level, at: vec2<u32>) -> u32 {
    return (l.slot * clipmap.side + (at.y >> TILE_BITS)) * clipmap.side + (at.x >> TILE_BITS);
}

fn texel_index(l: Level, cell: vec2<i32>) -> u32 {
    let at = wrapped(l, cell);
    return tile_of(l, at) * TILE_TEXELS + ((at.y & (TILE - 1u)) << TILE_BITS) + (at.x & (TILE - 1u));
}

fn stored_height(l: Level, cell: vec2<i32>) -> f32 {
    return heights[texel_index(l, cell)];
}

// The indices of a patch's corners: 00, 10, 01, 11. The axes are taken apart once each.
fn corner_indices(l: Level, cell: vec2<i32>) -> vec4<u32> {
    let a = wrapped(l, cell);
    let b = wrapped(l, cell + vec2<i32>(1));
    let x = ((vec2<u32>(a.x, b.x) >> vec2<u32>(TILE_BITS)) << vec2<u32>(2u * TILE_BITS)) + (vec2<u32>(a.x, b.x) & vec2<u32>(TILE - 1u));
    let y = (((vec2<u32>(a.y, b.y) >> vec2<u32>(TILE_BITS)) * clipmap.side) << vec2<u32>(2u * TILE_BITS))
        + ((vec2<u32>(a.y, b.y) & vec2<u32>(TILE - 1u)) << vec2<u32>(TILE_BITS));
    return vec4<u32>(l.slot * clipmap.side * clipmap.side * TILE_TEXELS) + vec4<u32>(x.x, x.y, x.x, x.y) + vec4<u32>(y.x, y.x, y.y, y.y);
}

fn stored_corners(l: Level, cell: vec2<i32>) -> vec4<f32> {
    let i = corner_indices(l, cell);
    return vec4<f32>(heights[i.x], heights[i.y], heights[i.z], heights[i.w]);
}

// The lowest and highest point of the 2^mip × 2^mip patches around a cell; mip 1 to 6.
fn stored_bounds(l: Level, cell: vec2<i32>, mip: u32) -> vec2<f32> {
    let at = wrapped(l, cell);
    let offset = (TILE_TEXELS - (TILE_TEXELS >> (2u * (mip - 1u)))) / 3u;
    let node = (at & vec2<u32>(TILE - 1u)) >> vec2<u32>(mip);
    let tile = tile_of(l, at) * TILE_BOUNDS;
    let word = bounds[tile + BOUNDS_HEAD + offset + (node.y << (TILE_BITS - mip)) + node.x];
    return bitcast<f32>(bounds[tile]) + bitcast<f32>(bounds[tile + 1u]) * vec2<f32>(f32(word & 0xffffu), f32(word >> 16u));
}

// The cell of the next coarser level that holds a cell.
fn coarser(l: Level, cell: vec2<i32>) -> vec2<i32> {
    return ((l.base & vec2<i32>(1)) + cell) >> vec2<u32>(1u);
}

// How far a point (in texels from the centre's texel) is blended into the next level: 0 inside, 1 at the rim.
fn blend_at(l: Level, at: vec2<f32>) -> f32 {
    let d = abs(at - l.fraction);
    // The coarsest level has none to be blended into.
    if (l.inner >= l.outer) {
        return 0.0;
    }
    return clamp((max(d.x, d.y) - l.inner) / (l.outer - l.inner), 0.0, 1.0);
}

// Whether anything of the square low .. low + size, in texels, is blended.
fn is_blended(l: Level, low: vec2<i32>, size: f32) -> bool {
    let far = abs(vec2<f32>(low) + 0.5 * size - l.fraction) + 0.5 * size;
    return max(far.x, far.y) > l.inner && l.inner < l.outer;
}

fn between_corners(h: vec4<f32>, u: f32, v: f32) -> f32 {
    return mix(mix(h.x, h.y, u), mix(h.z, h.w, u), v);
}

// The heights of a patch's corners (00, 10, 01, 11), blended. Grids nest, so that a patch lies in one coarser patch.
fn corners(l: Level, level: u32, cell: vec2<i32>) -> vec4<f32> {
    let h = stored_corners(l, cell);
    if (!is_blended(l, cell, 1.0)) {
        return h;
    }
    let low = vec2<f32>(cell);
    let w = vec4<f32>(
        blend_at(l, low),
        blend_at(l, low + vec2<f32>(1.0, 0.0)),
        blend_at(l, low + vec2<f32>(0.0, 1.0)),
        blend_at(l, low + vec2<f32>(1.0, 1.0)));
    let c = stored_corners(clipmap.levels[level + 1u], coarser(l, cell));
    let s = 0.5 * vec2<f32>((l.base + cell) & vec2<i32>(1));
    return mix(h, vec4<f32>(
        between_corners(c, s.x, s.y), between_corners(c, s.x + 0.5, s.y),
        between_corners(c, s.x, s.y + 0.5), between_corners(c, s.x + 0.5, s.y + 0.5)), w);
}

// The lowest and highest point that the drawn surface can have in a node, whose first cell is `low`.
fn node_bounds(l: Level, level: u32, cell: vec2<i32>, low: vec2<i32>, mip: u32) -> vec2<f32> {
    var b = stored_bounds(l, cell, mip);
    if (is_blended(l, low, f32(1u << mip))) {
        let c = stored_bounds(clipmap.levels[level + 1u], coarser(l, cell), max(mip, 2u) - 1u);
        b = vec2<f32>(min(b.x, c.x), max(b.y, c.y));
    }
    return b;
}

// The finest level that draws the ground at this point.
fn level_at(p: vec2<f32>) -> u32 {
    let c = max(abs(p.x), abs(p.y));
    var level = 0u;
    while (level < clipmap.count && c >= clipmap.levels[level].outer * clipmap.levels[level].texel) {
        level++;
    }
    return level;
}

// The drawn ground's height at a point of a level.
fn ground_height(level: u32, p: vec2<f32>) -> f32 {
    let l = clipmap.levels[level];
    let at = p * l.per_metre + l.fraction;
    let f = at - floor(at);
    return between_corners(corners(l, level, vec2<i32>(floor(at))), f.x, f.y);
}
