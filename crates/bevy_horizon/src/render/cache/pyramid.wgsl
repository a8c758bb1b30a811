// The pyramid of a tile: the lowest and highest point of 2 × 2 patches, and of each 2 × 2 of those, up to the tile. A
// patch at the tile's far sides takes its neighbours' texels. Needs surface.wgsl.

@group(0) @binding(1) var<storage, read> heights: array<f32>;
@group(0) @binding(2) var<storage, read_write> bounds: array<vec2<f32>>;

struct TileJob {
    // The level, and the tile's first cell, relative to the centre's.
    level: u32,
    cell: vec2<i32>,
}

@group(0) @binding(3) var<storage, read> jobs: array<TileJob>;

var<workgroup> lowest: array<f32, 1024>;
var<workgroup> highest: array<f32, 1024>;

@compute @workgroup_size(16, 16, 1)
fn pyramid(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_id) id: vec3<u32>) {
    let job = jobs[group.x];
    let l = clipmap.levels[job.level];
    let out = tile_of(l, wrapped(l, job.cell)) * TILE_BOUNDS;
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
        bounds[out + node.y * 32u + node.x] = vec2<f32>(low, high);
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
            bounds[out + offset + id.y * side + id.x] = vec2<f32>(low, high);
        }
        offset += side * side;
        side /= 2u;
        stride *= 2u;
    }
}
