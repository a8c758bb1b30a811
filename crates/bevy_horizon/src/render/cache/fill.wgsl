// Fills tiles with the field: height, normal and material, once per texel. Follows the terrain's kernel, which declares
// height(), material_at() and material_packed(), and stamp.wgsl. Needs the constants of shaders.rs.

struct Job {
    // The tile in the buffers, and its first anchor.
    tile: u32,
    anchor: u32,
    // Metres per texel.
    texel: f32,
    // The stamps that reach into the tile: the first of their parts, how many move the ground, and how many holes follow.
    stamp: u32,
    stamps: u32,
    holes: u32,
}

@group(1) @binding(0) var<storage, read> jobs: array<Job>;
@group(1) @binding(1) var<uniform> material: Material;
@group(1) @binding(2) var<storage, read_write> heights: array<f32>;
@group(1) @binding(3) var<storage, read_write> looks: array<u32>;
@group(1) @binding(4) var<storage, read> stamp_parts: array<StampPart>;

fn stamp_part(i: u32) -> StampPart {
    return stamp_parts[i];
}

// A normal's x and z in 8 bits each. Rounded by lot, which is the same in every tile: smooth ground shows no steps.
fn pack_normal(gradient: vec2<f32>, texel: vec2<u32>) -> u32 {
    let n = -gradient * inverseSqrt(1.0 + dot(gradient, gradient));
    let lot = pcg(texel.x + (texel.y << 6u));
    let dither = vec2<f32>(f32(lot & 0xffffu), f32(lot >> 16u)) / 65536.0;
    let q = vec2<u32>(clamp(floor(n * 127.0 + 127.5 + dither), vec2<f32>(0.0), vec2<f32>(255.0)));
    return (q.x << 8u) | q.y;
}

var<workgroup> normals: array<u32, 64>;

@compute @workgroup_size(8, 8, 1)
fn fill(@builtin(global_invocation_id) id: vec3<u32>, @builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    // By the group, so that a compiler sees that all of it reads the same layers and anchors.
    let job = jobs[group.z];
    let q = vec2<f32>(id.xy) * job.texel;
    // An octave is whole down to waves of twice as many texels, and gone at the cut-off: texels lie still in the world, so that what
    // little aliases does not crawl, and thin ridges keep their height for longer.
    let cutoff = CUTOFF * job.texel;
    let ground = stamped(job.stamp, job.stamps, q, height(job.anchor, q, cutoff));
    let index = job.tile * TILE_TEXELS + (id.y << TILE_BITS) + id.x;
    heights[index] = ground.x;
    let look = material_at(job.anchor, q, job.texel, cutoff, ground);
    // Three words a pair of texels: two looks, then both normals.
    let pair = job.tile * TILE_LOOKS + 3u * ((index & (TILE_TEXELS - 1u)) >> 1u);
    // A hole is a roughness of 0, which no ground has.
    let word = material_packed(look, id.xy);
    looks[pair + (index & 1u)] = select(word, word & 0x07ffffffu, stamp_hole(job.stamp + job.stamps, job.holes, q));
    normals[lane] = pack_normal(ground.yz, id.xy);
    workgroupBarrier();
    if ((lane & 1u) == 0u) {
        looks[pair + 2u] = normals[lane] | (normals[lane + 1u] << 16u);
    }
}
