// The pyramid of a tile: the lowest and highest point of 2 × 2 patches, and of each 2 × 2 of those, up to the tile. A
// patch at the tile's far sides takes its neighbours' texels. Bounds are stored in 16 bits each, counted from a little under
// the tile's lowest point in steps of its relief, and rounded outwards. Needs surface.wgsl.

@group(0) @binding(1) var<storage, read> heights: array<f32>;
@group(0) @binding(2) var<storage, read_write> bounds: array<u32>;

struct TileJob {
    // The level, and the tile's first cell, relative to the centre's.
    level: u32,
    cell: vec2<i32>,
}

@group(0) @binding(3) var<storage, read> jobs: array<TileJob>;

var<workgroup> lowest: array<f32, 1024>;
var<workgroup> highest: array<f32, 1024>;
var<workgroup> extremes: array<vec2<f32>, 256>;

// What a tile's bounds are counted from, and in: steps that no rounding of a sum can reach across a quarter of.
fn scale_of(low: f32, high: f32) -> vec2<f32> {
    let step = max((high - low) / 65000.0, 5e-7 * max(abs(low), abs(high)) + 1e-9);
    return vec2<f32>(low - step, step);
}

fn packed(low: f32, high: f32, scale: vec2<f32>) -> u32 {
    let q = (vec2<f32>(low, high) - scale.x) / scale.y;
    return (u32(ceil(q.y + 0.25)) << 16u) | u32(floor(q.x - 0.25));
}

@compute @workgroup_size(16, 16, 1)
fn pyramid(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_id) id: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let job = jobs[group.x];
    let l = clipmap.levels[job.level];
    let out = tile_of(l, wrapped(l, job.cell)) * TILE_BOUNDS;
    var all = vec2<f32>(1e30, -1e30);
    // Mip 1: 32 × 32 nodes of 3 × 3 texels, four to a thread.
    for (var i = 0u; i < 4u; i++) {
        let node = vec2<u32>(id.x + 16u * (i & 1u), id.y + 16u * (i >> 1u));
        var low = 1e30;
        var high = -1e30;
        for (var k = 0; k < 9; k++) {
            // Past the level's last texel lies the other side of the torus, and no patch.
            let h = stored_height(l, min(job.cell + vec2<i32>(node * 2u) + vec2<i32>(k % 3, k / 3), l.high - vec2<i32>(1)));
            low = min(low, h);
            high = max(high, h);
        }
        lowest[node.y * 32u + node.x] = low;
        highest[node.y * 32u + node.x] = high;
        all = vec2<f32>(min(all.x, low), max(all.y, high));
    }
    extremes[lane] = all;
    for (var round = 1u; round <= 8u; round++) {
        let half = 256u >> round;
        workgroupBarrier();
        if (lane < half) {
            let a = extremes[lane];
            let b = extremes[lane + half];
            extremes[lane] = vec2<f32>(min(a.x, b.x), max(a.y, b.y));
        }
    }
    workgroupBarrier();
    let scale = scale_of(extremes[0].x, extremes[0].y);
    if (lane == 0u) {
        bounds[out] = bitcast<u32>(scale.x);
        bounds[out + 1u] = bitcast<u32>(scale.y);
    }
    for (var i = 0u; i < 4u; i++) {
        let node = lane + 256u * i;
        bounds[out + BOUNDS_HEAD + node] = packed(lowest[node], highest[node], scale);
    }
    var offset = 1024u;
    var side = 16u;
    var stride = 1u;
    for (var mip = 2u; mip <= 6u; mip++) {
        workgroupBarrier();
        if (id.x < side && id.y < side) {
            let at = (id.y * 2u * stride) * 32u + id.x * 2u * stride;
            let low = min(min(lowest[at], lowest[at + stride]), min(lowest[at + 32u * stride], lowest[at + 33u * stride]));
            let high = max(max(highest[at], highest[at + stride]), max(highest[at + 32u * stride], highest[at + 33u * stride]));
            // In place: the node's own first entry, which no other thread of this round reads.
            lowest[at] = low;
            highest[at] = high;
            bounds[out + BOUNDS_HEAD + offset + id.y * side + id.x] = packed(low, high, scale);
        }
        offset += side * side;
        side /= 2u;
        stride *= 2u;
    }
}
