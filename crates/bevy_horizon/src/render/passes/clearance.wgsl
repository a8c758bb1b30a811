// How far the rays of a camera are clear of the ground: a table over azimuth and slope, so that no pixel marches through
// the empty air before its first hill. One walk outwards serves all pixels of a column of the world: where the ground's
// skyline, seen from the eye, first rises above a slope is where rays of that slope may first meet the ground. The walk
// takes the pyramid's maxima over all that a column can hold, so that the table never promises too much. Needs view.wgsl
// and surface.wgsl.
//
// Notation. Distances here are Chebyshev's, c = max(|x|, |z|) from the eye: rings of equal c are squares, along which
// the minor coordinate is s · c. A *column* is a range of s within one of four quadrants. A ray's slope is m = dy / dc;
// its *bin* is linear in v = m / (1 + |m|), which takes all slopes into (−1, 1).

@group(0) @binding(1) var<storage, read> heights: array<f32>;
@group(0) @binding(2) var<storage, read> bounds: array<u32>;
@group(0) @binding(3) var<uniform> view: HorizonView;
@group(0) @binding(4) var<storage, read_write> clearance: array<f32>;

const RINGS: u32 = 1024u;
const LANES: u32 = 64u;
const RINGS_PER_LANE: u32 = 16u;
const NEVER: f32 = 1e30;

// The highest slope under which each ring, or one nearer, can be seen.
var<workgroup> skyline: array<f32, 1024>;
var<workgroup> slices: array<f32, 64>;

// Where a ring begins. The first is the square around the eye.
fn ring_at(i: u32) -> f32 {
    return select(view.rings.x * exp2(f32(i) * view.rings.y), 0.0, i == 0u);
}

// No ground within the box (metres from the clipmap's centre) is drawn higher.
fn highest(low: vec2<f32>, high: vec2<f32>) -> f32 {
    let nearest = max(max(low, -high), vec2<f32>(0.0));
    let farthest = max(abs(low), abs(high));
    let from_c = max(nearest.x, nearest.y);
    let to_c = max(farthest.x, farthest.y);
    var top = -NEVER;
    for (var level = 0u; level < clipmap.count; level++) {
        let l = clipmap.levels[level];
        let rim = l.outer * l.texel;
        if (rim <= 0.0 || (from_c >= rim && level + 1u < clipmap.count)) {
            continue;
        }
        let last = l.high - vec2<i32>(2);
        let a = clamp(vec2<i32>(floor(low * l.per_metre + l.fraction)), l.low, last);
        let b = clamp(vec2<i32>(floor(high * l.per_metre + l.fraction)), l.low, last);
        let size = u32(max(max(b.x - a.x, b.y - a.y), 1));
        let mip = min(32u - countLeadingZeros(size), TILE_BITS);
        let up = vec2<u32>(mip);
        let first = (l.base + a) >> up;
        let count = ((l.base + b) >> up) - first + vec2<i32>(1);
        for (var j = 0; j < count.y; j++) {
            for (var i = 0; i < count.x; i++) {
                let node = ((first + vec2<i32>(i, j)) << up) - l.base;
                let cell = clamp(node, l.low, last);
                top = max(top, node_bounds(l, level, cell, node, mip).y);
            }
        }
        if (to_c < rim) {
            break;
        }
    }
    return top;
}

// The least slope that passes over everything between two rings, in the column s0 .. s1 of a quadrant.
fn slope_over(quadrant: u32, s: vec2<f32>, c: vec2<f32>) -> f32 {
    let minor = vec2<f32>(min(s.x * c.x, s.x * c.y), max(s.y * c.x, s.y * c.y));
    var low = vec2<f32>(c.x, minor.x);
    var high = vec2<f32>(c.y, minor.y);
    if (c.x <= 0.0) {
        low = vec2<f32>(-c.y);
        high = vec2<f32>(c.y);
    } else if (quadrant == 1u) {
        low = vec2<f32>(-minor.y, c.x);
        high = vec2<f32>(-minor.x, c.y);
    } else if (quadrant == 2u) {
        low = vec2<f32>(-c.y, -minor.y);
        high = vec2<f32>(-c.x, -minor.x);
    } else if (quadrant == 3u) {
        low = vec2<f32>(minor.x, -c.y);
        high = vec2<f32>(minor.y, -c.x);
    }
    let top = highest(view.eye.xz + low, view.eye.xz + high);
    // As much higher as the march's own sums are rounded.
    let rise = top - view.eye.y + 1e-6 * (abs(top) + abs(view.eye.y));
    let near = select(rise / c.x, select(-NEVER, NEVER, rise >= 0.0), c.x <= 0.0);
    return max(near, rise / c.y);
}

@compute @workgroup_size(64, 1, 1)
fn clear(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let per_quadrant = view.columns.z;
    let column = (view.columns.x + group.x) % (4u * per_quadrant);
    let quadrant = column / per_quadrant;
    // A hair wider than its pixels' rays are rounded.
    let left = 2.0 * f32(column % per_quadrant) / f32(per_quadrant) - 1.0;
    let s = vec2<f32>(left, left + 2.0 / f32(per_quadrant)) + vec2<f32>(-1e-5, 1e-5);
    var over = -NEVER;
    for (var k = 0u; k < RINGS_PER_LANE; k++) {
        let i = lane * RINGS_PER_LANE + k;
        over = max(over, slope_over(quadrant, s, vec2<f32>(ring_at(i), ring_at(i + 1u))));
        skyline[i] = over;
    }
    slices[lane] = over;
    workgroupBarrier();
    var nearer = -NEVER;
    for (var other = 0u; other < lane; other++) {
        nearer = max(nearer, slices[other]);
    }
    for (var k = 0u; k < RINGS_PER_LANE; k++) {
        let i = lane * RINGS_PER_LANE + k;
        skyline[i] = max(skyline[i], nearer);
    }
    workgroupBarrier();
    for (var bin = lane; bin < BINS; bin += LANES) {
        // The least slope of the bin, and a hair less.
        let v = clamp(view.slopes.x + (f32(bin) - 0.01) / view.slopes.y, -0.999999, 0.999999);
        let slope = v / (1.0 - abs(v));
        // The first ring whose skyline is not under it.
        var from_ring = 0u;
        var to_ring = RINGS;
        while (from_ring < to_ring) {
            let middle = (from_ring + to_ring) / 2u;
            if (skyline[middle] < slope) {
                from_ring = middle + 1u;
            } else {
                to_ring = middle;
            }
        }
        clearance[group.x * BINS + bin] = select(ring_at(from_ring), NEVER, from_ring == RINGS);
    }
}
