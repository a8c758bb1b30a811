// What the ground looks like, per texel: the four regions of a landscape by height (mud, sand, grass, rock) with
// noise-shifted, smooth boundaries, grass on flat ground only, strata on steep rock, and snow by height and slope.

struct Material {
    mud: vec4<f32>,
    sand: vec4<f32>,
    grass: vec4<f32>,
    dry_grass: vec4<f32>,
    rock: vec4<f32>,
    strata: vec4<f32>,
    snow: vec4<f32>,
    // Heights of the boundaries, in metres: mud-sand, sand-grass, grass-rock, snow line.
    boundaries: vec4<f32>,
    // Half-widths of the boundaries, in metres.
    softness: vec4<f32>,
    // The normal's y under which there is no grass, and under which there is no snow.
    grass_flatness: f32,
    snow_flatness: f32,
    // Metres of one stratum.
    strata_thickness: f32,
}

fn above(h: f32, boundary: f32, half_width: f32) -> f32 {
    return smoothstep(boundary - half_width, boundary + half_width, h);
}

// Value noise along one axis: the strata.
fn strata_noise(s: f32) -> f32 {
    let i = floor(s);
    let f = s - i;
    let a = f32(pcg(bitcast<u32>(i32(i))) >> 8u) / 16777215.0;
    let b = f32(pcg(bitcast<u32>(i32(i) + 1)) >> 8u) / 16777215.0;
    return mix(a, b, f * f * f * (f * (f * 6.0 - 15.0) + 10.0));
}

// Albedo, as its square root so that dark colours keep their steps in 8 bits, and gloss.
fn material_at(anchor: u32, q: vec2<f32>, texel: f32, cutoff: f32, ground: vec3<f32>) -> vec4<f32> {
    let up = inverseSqrt(1.0 + dot(ground.yz, ground.yz));
    let shift = material_edge(anchor, q, cutoff).x;
    let tint = material_tint(anchor, q, cutoff).x;
    let h = ground.x + shift;
    // A texel holds all the heights that its slope spans: boundaries are at least as soft as that.
    let softness = material.softness + vec4<f32>(0.5 * texel * length(ground.yz));

    let strata = strata_noise((ground.x + 0.3 * shift) / material.strata_thickness);
    let steep = 1.0 - smoothstep(0.62, 0.88, up);
    let rock = mix(material.rock, material.strata, steep * strata) * (1.0 + 0.25 * tint);

    let flat_enough = smoothstep(material.grass_flatness - 0.06, material.grass_flatness + 0.06, up + 0.04 * tint);
    let grass = mix(material.grass, material.dry_grass, smoothstep(-0.35, 0.35, tint));
    var colour = mix(material.mud, material.sand, above(h, material.boundaries.x, softness.x));
    colour = mix(colour, mix(rock, grass, flat_enough), above(h, material.boundaries.y, softness.y));
    colour = mix(colour, rock, above(h, material.boundaries.z, softness.z));
    let snow = above(h, material.boundaries.w, softness.w)
        * smoothstep(material.snow_flatness - 0.08, material.snow_flatness + 0.08, up);
    colour = mix(colour, material.snow, snow);
    return vec4<f32>(sqrt(clamp(colour.rgb, vec3<f32>(0.0), vec3<f32>(1.0))), colour.a);
}
