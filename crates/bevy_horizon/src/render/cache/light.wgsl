// How the ground hides the sun's disc, for one point in 2 × 2 texels. The ground's horizon towards the sun is the largest
// (h − h₀) / d; where it stands between the disc's lower and upper edge, part of the disc is hidden: a penumbra as wide as
// the sun's angular radius makes it, without rays to sample. Where it hides the whole disc, what matters is how deep the point
// lies in the shadow, for what stands there above the ground: the largest h − h₀ − d · tan(elevation). The pyramid prunes what stays
// below what was found so far. Needs surface.wgsl and sun_seen.wgsl.

struct Sun {
    // Level direction towards the sun.
    towards: vec2<f32>,
    // Tangent of the elevation of the disc's lower edge, its centre and its upper edge.
    low: f32,
    centre: f32,
    high: f32,
    // The disc's angular radius, in radians.
    radius: f32,
    // Nothing of the ground is higher, in metres above the datum.
    highest: f32,
}

@group(0) @binding(1) var<storage, read> heights: array<f32>;
@group(0) @binding(2) var<storage, read> bounds: array<u32>;

struct TileJob {
    level: u32,
    cell: vec2<i32>,
}

@group(0) @binding(3) var<storage, read> jobs: array<TileJob>;
@group(0) @binding(4) var<uniform> sun: Sun;
@group(0) @binding(5) var<storage, read_write> looks: array<u32>;

const LIGHT_STEPS: u32 = 256u;

// The height of a level at a point, in its texels.
fn level_height(l: Level, at: vec2<f32>) -> f32 {
    let cell = clamp(vec2<i32>(floor(at)), l.low, l.high - vec2<i32>(2));
    let f = at - vec2<f32>(cell);
    return between_corners(stored_corners(l, cell), f.x, f.y);
}

// What hides the sun: the tangent of its elevation, at least that of the disc's lower edge, and how far away it is. Once it hides all
// of the disc: how deep the shadow is over the point, in metres, of its own.
struct Horizon {
    tangent: f32,
    depth: f32,
    d: f32,
}

// Takes ground of height h, over the point's, at a distance.
fn raise(found: ptr<function, Horizon>, h: f32, d: f32) {
    if ((*found).tangent < sun.high) {
        if (h > (*found).tangent * d) {
            (*found).tangent = h / d;
            (*found).d = d;
            (*found).depth = h - sun.centre * d;
        }
    } else if (h - sun.centre * d > (*found).depth) {
        (*found).depth = h - sun.centre * d;
        (*found).d = d;
    }
}

// Ground over the point that is no higher than this, at a distance, changes nothing.
fn matters_above(found: Horizon, d: f32) -> f32 {
    return select(found.depth + sun.centre * d, found.tangent * d, found.tangent < sun.high);
}

fn horizon(start_level: u32, start: vec2<i32>) -> Horizon {
    var level = start_level;
    var l = clipmap.levels[level];
    var cell = start;
    let centre = (vec2<f32>(start) - l.fraction) * l.texel;
    var origin = vec2<f32>(start);
    var h0 = stored_height(l, start);
    let positive = sun.towards >= vec2<f32>(0.0);
    let inverse = select(1.0 / sun.towards, select(vec2<f32>(-1e30), vec2<f32>(1e30), positive), abs(sun.towards) < vec2<f32>(1e-20));
    var found = Horizon(sun.low, 0.0, l.texel);
    var d = 0.0;
    var mip = 1u;
    for (var step = 0u; step < LIGHT_STEPS; step++) {
        if (h0 + matters_above(found, d) > sun.highest) {
            break;
        }
        let low = (((l.base + cell) >> vec2<u32>(mip)) << vec2<u32>(mip)) - l.base;
        let high = low + vec2<i32>(1 << mip);
        let exits = (select(vec2<f32>(low), vec2<f32>(high), positive) - origin) * inverse * l.texel;
        let d_exit = max(min(exits.x, exits.y), d);
        if (mip == 0u) {
            let h = stored_corners(l, cell);
            let at = origin + sun.towards * l.per_metre * d_exit - vec2<f32>(cell);
            if (d_exit > 0.75 * l.texel) {
                raise(&found, between_corners(h, at.x, at.y) - h0, d_exit);
            }
        } else {
            let b = stored_bounds(l, cell, mip);
            if (b.y - h0 > min(matters_above(found, d), matters_above(found, d_exit))) {
                // A node whose relief is a fraction of the sun's disc is as good as a point.
                if (b.y - b.x > 0.25 * sun.radius * d) {
                    mip -= 1u;
                    cell = clamp(vec2<i32>(floor(origin + sun.towards * l.per_metre * d)), low, high - vec2<i32>(1));
                    continue;
                }
                raise(&found, 0.5 * (b.x + b.y) - h0, max(0.5 * (d + d_exit), l.texel));
            }
        }
        d = d_exit;
        let last = l.base + cell;
        cell = clamp(vec2<i32>(floor(origin + sun.towards * l.per_metre * d)), low, high - vec2<i32>(1));
        let side = select(low - vec2<i32>(1), high, positive);
        cell = select(vec2<i32>(cell.x, side.y), vec2<i32>(side.x, cell.y), exits.x <= exits.y);
        // Past the last patch: the next level. Where the two differ, the point is taken along, or ground that the coarser
        // level has a little higher would shadow it.
        if (any(cell < l.low) || any(cell >= l.high - vec2<i32>(1 << mip))) {
            level += 1u;
            if (level >= clipmap.count) {
                break;
            }
            let p = centre + sun.towards * d;
            h0 -= level_height(l, p * l.per_metre + l.fraction);
            l = clipmap.levels[level];
            origin = centre * l.per_metre + l.fraction;
            h0 += level_height(l, p * l.per_metre + l.fraction);
            cell = vec2<i32>(floor(p * l.per_metre + l.fraction));
            if (any(cell < l.low) || any(cell >= l.high - vec2<i32>(1))) {
                break;
            }
            mip = 0u;
            continue;
        }
        let up = vec2<u32>(mip + 1u);
        if (mip < TILE_BITS && any(((l.base + cell) >> up) != (last >> up))) {
            mip += 1u;
        }
    }
    return found;
}

// What a group found, before two points become a word.
var<workgroup> seen: array<u32, 64>;

@compute @workgroup_size(8, 8, 1)
fn light(@builtin(global_invocation_id) id: vec3<u32>, @builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let job = jobs[group.z];
    let cell = job.cell + vec2<i32>(id.xy * 2u);
    let found = horizon(job.level, cell);
    let penumbra = (sun.high - sun.centre) * found.d;
    let hidden = (found.tangent - sun.centre) / (sun.high - sun.centre);
    seen[lane] = packed_sun(select(hidden, max(found.depth / penumbra, 1.0), hidden >= 1.0), penumbra);
    workgroupBarrier();
    if ((lane & 1u) == 0u) {
        let l = clipmap.levels[job.level];
        let word = seen[lane] | (seen[lane + 1u] << 16u);
        looks[tile_of(l, wrapped(l, cell)) * TILE_LOOKS + LIGHTS_AT + ((id.y * 32u + id.x) >> 1u)] = word;
    }
}
