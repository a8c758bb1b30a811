// Fills tiles with the field: height, normal and material, once per texel. Follows the field's generated kernel, which
// declares height(), material_edge() and material_tint(), and material.wgsl.

struct Job {
    // The tile in the buffers, and its first anchor.
    tile: u32,
    anchor: u32,
    // Metres per texel.
    texel: f32,
    padding: u32,
}

@group(1) @binding(0) var<storage, read> jobs: array<Job>;
@group(1) @binding(1) var<uniform> material: Material;
@group(1) @binding(2) var<storage, read_write> heights: array<f32>;
@group(1) @binding(3) var<storage, read_write> looks: array<vec2<u32>>;

// A normal's x and z in 12 bits each; the low 8 bits are free.
fn pack_normal(gradient: vec2<f32>) -> u32 {
    let n = -gradient * inverseSqrt(1.0 + dot(gradient, gradient));
    let q = vec2<u32>(clamp(round(n * 2047.0 + 2048.0), vec2<f32>(0.0), vec2<f32>(4095.0)));
    return (q.x << 20u) | (q.y << 8u);
}

@compute @workgroup_size(8, 8, 1)
fn fill(@builtin(global_invocation_id) id: vec3<u32>, @builtin(workgroup_id) group: vec3<u32>) {
    // By the group, so that a compiler sees that all of it reads the same layers and anchors.
    let job = jobs[group.z];
    let q = vec2<f32>(id.xy) * job.texel;
    // An octave is whole down to waves of 1.5 texels, and gone at 0.75: texels lie still in the world, so that what little
    // aliases does not crawl, and thin ridges keep their height for longer.
    let cutoff = 0.75 * job.texel;
    let ground = height(job.anchor, q, cutoff);
    let index = job.tile * 4096u + id.y * 64u + id.x;
    heights[index] = ground.x;
    let colour = material_at(job.anchor, q, job.texel, cutoff, ground);
    looks[index] = vec2<u32>(pack_normal(ground.yz), pack4x8unorm(colour));
}
