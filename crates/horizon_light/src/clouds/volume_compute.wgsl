// Makes the clouds' noise; the twin of volume.rs, where the channels and the reasons stand.

const CLOUD_TEXELS: u32 = 64u;
const CLOUD_MIPS: u32 = 7u;
const CLOUD_CELLS: u32 = 4u;
const CLOUD_GRADIENT: vec3<f32> = vec3<f32>(0.572, 0.286, 0.142);
const CLOUD_WORLEY: vec3<f32> = vec3<f32>(0.625, 0.25, 0.125);
const CLOUD_SPREAD_LOW: vec3<f32> = vec3<f32>(0.714, 0.412, 0.447);
const CLOUD_SPREAD_HIGH: vec3<f32> = vec3<f32>(0.907, 0.588, 0.796);
const CLOUD_SEEDS: vec2<u32> = vec2<u32>(12648661u, 11604238u);

// A texel of the finest mip, to be stored in linear 8 bits.
fn cloud_texel(texel: vec3<u32>) -> vec4<f32> {
    let u = (vec3<f32>(texel) + 0.5) / f32(CLOUD_TEXELS);
    var gradient = 0.0;
    var billows = 0.0;
    for (var octave = 0u; octave < 3u; octave++) {
        let period = CLOUD_CELLS << octave;
        gradient += CLOUD_GRADIENT[octave] * gradient3_periodic(u, period, CLOUD_SEEDS.x + octave);
        billows += CLOUD_WORLEY[octave] * (0.5 - 0.5 * worley3_periodic(u, period, CLOUD_SEEDS.y + octave));
    }
    gradient = 0.5 + 0.5 * gradient;
    let raw = vec3<f32>(billows + gradient * (1.0 - billows), gradient, billows);
    let t = clamp((raw - CLOUD_SPREAD_LOW) / (CLOUD_SPREAD_HIGH - CLOUD_SPREAD_LOW), vec3<f32>(0.0), vec3<f32>(1.0));
    return vec4<f32>(t * t * (3.0 - 2.0 * t), 1.0);
}

// A texel of mip 1: interpolation reaches a texel beyond the block.
fn cloud_border_most(block: vec3<u32>) -> vec4<f32> {
    var most = vec4<f32>(0.0);
    for (var i = 0u; i < 64u; i++) {
        let corner = 2u * block + vec3<u32>(i & 3u, (i >> 2u) & 3u, i >> 4u) + CLOUD_TEXELS - 1u;
        most = max(most, cloud_finer(corner % CLOUD_TEXELS));
    }
    return most;
}

// A texel of the mips after it.
fn cloud_most(block: vec3<u32>) -> vec4<f32> {
    var most = vec4<f32>(0.0);
    for (var i = 0u; i < 8u; i++) {
        most = max(most, cloud_finer(2u * block + vec3<u32>(i & 1u, (i >> 1u) & 1u, i >> 2u)));
    }
    return most;
}
