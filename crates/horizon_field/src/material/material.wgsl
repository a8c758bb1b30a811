// The ground's look, by layers; the twin of eval.rs. Follows a kernel that has `height` and `material_field`, and one of the
// two `material_curvature`. A global `material: Material` holds the numbers.

struct MaterialLayer {
    // Albedo and roughness; second albedo and reflectance.
    colour: vec4<f32>,
    second: vec4<f32>,
    // Ranges: low, high, the edges' half-width squared, and how much of a field is added.
    height: vec4<f32>,
    slope: vec4<f32>,
    curvature: vec4<f32>,
    noise: vec4<f32>,
    mask: vec4<f32>,
    // Strata: bands per metre, how much of a noise is added; then the blend of the two albedos, squared.
    strata: vec4<f32>,
    // The fields of height, slope, strata and tint.
    fields: vec4<f32>,
    // The fields of noise and mask; the rules that there are, as bits.
    more: vec4<f32>,
}

struct Material {
    // How many layers, how many fields, the curvature's scale.
    head: vec4<f32>,
    // For each texel size and field: its shape, its largest value, by how much its steepness over a texel widens edges, and
    // by how much its lost octaves do.
    fields: array<vec4<f32>, 384>,
    // The base, and what lies over it.
    layers: array<MaterialLayer, 17>,
}

struct MaterialLook {
    albedo: vec3<f32>,
    roughness: f32,
    reflectance: f32,
}

// A texel of ground.
struct MaterialGround {
    height: f32,
    // The normal's y.
    up: f32,
    // The heights that its slope spans, as what they widen edges by; and that of its cut-off, in metres.
    relief: f32,
    span: f32,
    // Where the fields of its size begin.
    row: u32,
}

const MATERIAL_FIELDS: u32 = 16u;
const MATERIAL_LAYERS: u32 = 17u;
const MATERIAL_FIRST_TEXEL: i32 = -10;
const MATERIAL_TEXELS: i32 = 24;
const MATERIAL_WIDENING: f32 = 5.0;
// The rules' bits.
const MATERIAL_HEIGHT: u32 = 1u;
const MATERIAL_SLOPE: u32 = 2u;
const MATERIAL_CURVATURE: u32 = 4u;
const MATERIAL_NOISE: u32 = 8u;
const MATERIAL_MASK: u32 = 16u;
const MATERIAL_STRATA: u32 = 32u;
const MATERIAL_TINT: u32 = 64u;
// Of the fields that are needed, the bit of the curvature.
const MATERIAL_BEND: u32 = 0x80000000u;

// Each field's value at the texel, and by how much it widens edges, squared.
var<private> material_values: array<vec2<f32>, 16>;

fn material_ramp(x: f32, half_width: f32) -> f32 {
    let t = clamp(0.5 * x / half_width + 0.5, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

// How much of a texel lies in a range. The difference of two steps: as they widen, the share of the range stays.
fn material_band(band: vec4<f32>, x: f32, widening: f32) -> f32 {
    let half_width = sqrt(band.z + widening);
    return max(material_ramp(x - band.x, half_width) - material_ramp(x - band.y, half_width), 0.0);
}

// Whether x, shifted by a noise, may lie in a range, and whether it may lie at an edge: if not, the noise is not asked.
fn material_reach(band: vec4<f32>, x: f32, widening: f32, i: u32) -> vec2<bool> {
    let field = material.fields[i];
    let m = sqrt(band.z + widening + band.w * band.w * field.w) + abs(band.w) * field.y;
    return vec2<bool>(x > band.x - m && x < band.y + m, abs(x - band.x) < m || abs(x - band.y) < m);
}

// How much of the strata shows on a texel: bands that its span of heights holds several of are gone.
fn material_strata_fade(strata: vec4<f32>, span: f32) -> f32 {
    return clamp(1.0 / (strata.x * max(span, 1e-20)) - 1.0, 0.0, 1.0);
}

// Value noise along the height.
fn material_strata(s: f32) -> f32 {
    let i = floor(s);
    let f = s - i;
    let a = f32(pcg(bitcast<u32>(i32(i))) >> 8u) / 16777215.0;
    let b = f32(pcg(bitcast<u32>(i32(i) + 1)) >> 8u) / 16777215.0;
    return mix(a, b, f * f * f * (f * (f * 6.0 - 15.0) + 10.0));
}

// Whether a layer may lie on a texel, and the fields that it then needs.
fn material_needs(i: u32, ground: MaterialGround) -> vec2<u32> {
    let rules = u32(material.layers[i].more.z);
    let fields = vec4<u32>(material.layers[i].fields);
    let more = vec4<u32>(material.layers[i].more);
    var needed = 0u;
    var possible = true;
    if ((rules & MATERIAL_HEIGHT) != 0u) {
        let reach = material_reach(material.layers[i].height, ground.height, ground.relief, ground.row + fields.x);
        possible = possible && reach.x;
        needed |= select(0u, 1u << fields.x, reach.y);
    }
    if ((rules & MATERIAL_SLOPE) != 0u) {
        let reach = material_reach(material.layers[i].slope, ground.up, 0.0, ground.row + fields.y);
        possible = possible && reach.x;
        needed |= select(0u, 1u << fields.y, reach.y);
    }
    if ((rules & MATERIAL_STRATA) != 0u && material_strata_fade(material.layers[i].strata, ground.span) > 0.0) {
        needed |= 1u << fields.z;
    }
    needed |= select(0u, MATERIAL_BEND, (rules & MATERIAL_CURVATURE) != 0u);
    needed |= select(0u, 1u << more.x, (rules & MATERIAL_NOISE) != 0u);
    needed |= select(0u, 1u << more.y, (rules & MATERIAL_MASK) != 0u);
    needed |= select(0u, 1u << fields.w, (rules & MATERIAL_TINT) != 0u);
    return vec2<u32>(select(0u, 1u, possible), needed);
}

// How much of a texel a layer covers.
fn material_weight(i: u32, ground: MaterialGround, bend: f32) -> f32 {
    let rules = u32(material.layers[i].more.z);
    let fields = vec4<u32>(material.layers[i].fields);
    let more = vec4<u32>(material.layers[i].more);
    var weight = 1.0;
    if ((rules & MATERIAL_HEIGHT) != 0u) {
        let band = material.layers[i].height;
        let v = material_values[fields.x];
        weight *= material_band(band, ground.height + band.w * v.x, ground.relief + band.w * band.w * v.y);
    }
    if ((rules & MATERIAL_SLOPE) != 0u) {
        let band = material.layers[i].slope;
        let v = material_values[fields.y];
        weight *= material_band(band, ground.up + band.w * v.x, band.w * band.w * v.y);
    }
    if ((rules & MATERIAL_CURVATURE) != 0u) {
        weight *= material_band(material.layers[i].curvature, bend, 0.0);
    }
    if ((rules & MATERIAL_NOISE) != 0u) {
        let v = material_values[more.x];
        weight *= material_band(material.layers[i].noise, v.x, v.y);
    }
    if ((rules & MATERIAL_MASK) != 0u) {
        let v = material_values[more.y];
        weight *= material_band(material.layers[i].mask, v.x, v.y);
    }
    if ((rules & MATERIAL_STRATA) != 0u) {
        let strata = material.layers[i].strata;
        let s = (ground.height + strata.y * material_values[fields.z].x) * strata.x;
        weight *= mix(0.5, material_strata(s), material_strata_fade(strata, ground.span));
    }
    return weight;
}

// The look of a texel, `q` metres from the anchor. The cut-off must be 0.75 texels, and the texel a power of two metres.
fn material_at(anchor: u32, q: vec2<f32>, texel: f32, cutoff: f32, jet: vec3<f32>) -> MaterialLook {
    let slope = length(jet.yz);
    let spread = texel * slope;
    let exponent = i32((bitcast<u32>(texel) >> 23u) & 255u) - 127;
    let row = MATERIAL_FIELDS * u32(clamp(exponent - MATERIAL_FIRST_TEXEL, 0, MATERIAL_TEXELS - 1));
    let relief = (MATERIAL_WIDENING / 12.0) * spread * spread;
    let ground = MaterialGround(jet.x, inverseSqrt(1.0 + slope * slope), relief, cutoff * slope, row);
    let layers = min(u32(material.head.x), MATERIAL_LAYERS);
    let fields = min(u32(material.head.y), MATERIAL_FIELDS);

    var present = 0u;
    var needed = 0u;
    for (var i = 0u; i < layers; i++) {
        let needs = material_needs(i, ground);
        if (needs.x != 0u) {
            present |= 1u << i;
            needed |= needs.y;
        }
    }
    var bend = 0.0;
    if ((needed & MATERIAL_BEND) != 0u) {
        bend = material_curvature(anchor, q, material.head.z, cutoff);
    }
    for (var i = 0u; i < fields; i++) {
        material_values[i] = vec2<f32>(0.0);
        if ((needed & (1u << i)) != 0u) {
            let field = material.fields[row + i];
            let v = material_field(u32(field.x), i + 1u, anchor, q, cutoff);
            material_values[i] = vec2<f32>(v.x, field.w + field.z * texel * texel * dot(v.yz, v.yz));
        }
    }
    var look = MaterialLook(vec3<f32>(0.0), 0.0, 0.0);
    for (var i = 0u; i < layers; i++) {
        var weight = 0.0;
        if ((present & (1u << i)) != 0u) {
            weight = material_weight(i, ground, bend);
        }
        if (weight > 0.0) {
            let colour = material.layers[i].colour;
            let second = material.layers[i].second;
            var albedo = colour.rgb;
            if ((u32(material.layers[i].more.z) & MATERIAL_TINT) != 0u) {
                let v = material_values[u32(material.layers[i].fields.w)];
                albedo = mix(albedo, second.rgb, material_ramp(v.x, sqrt(material.layers[i].strata.z + v.y)));
            }
            look.albedo = mix(look.albedo, albedo, weight);
            look.roughness = mix(look.roughness, colour.w, weight);
            look.reflectance = mix(look.reflectance, second.w, weight);
        }
    }
    return look;
}

// Four bytes: the albedo as its square root, so that dark colours keep their steps; then roughness in five bits over
// reflectance in three, rounded by lot, which is the same in every tile: smooth ground shows no steps. The five bits are 1 at least: a
// cache writes 0 where there is a hole.
fn material_packed(look: MaterialLook, texel: vec2<u32>) -> u32 {
    let lot = pcg(pcg(texel.x + (texel.y << 6u)));
    let dither = vec2<f32>(f32(lot & 0xffffu), f32(lot >> 16u)) / 65536.0;
    let steps = vec2<f32>(31.0, 7.0);
    let parts = vec2<u32>(clamp(floor(vec2<f32>(look.roughness, look.reflectance) * steps + dither), vec2<f32>(1.0, 0.0), steps));
    let albedo = sqrt(clamp(look.albedo, vec3<f32>(0.0), vec3<f32>(1.0)));
    return pack4x8unorm(vec4<f32>(albedo, 0.0)) | (((parts.x << 3u) | parts.y) << 24u);
}
