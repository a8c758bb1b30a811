// Plants: one ray a pixel through the grove, as far as what was drawn lets it; lit by Bevy's own functions as the ground is, but for
// the sun, which shines around and through leaves. Needs shade.wgsl, pixel_ray.wgsl, canopy_light.wgsl, and declarations of
// depth_at() and depth_samples().

const PI: f32 = 3.14159265;
// Of a pixel's normal, how much is the crown's as a whole: leaves are too small to be lit one by one.
const SMOOTH: f32 = 0.25;
// Leaves within a clump, as a part of the foliage's period; how much darker and lighter than the mean they are.
const LEAF: f32 = 0.14;
const MOTTLE: f32 = 3.2;

struct Tree {
    @location(0) colour: vec4<f32>,
    @builtin(frag_depth) depth: f32,
}

// What a plant looks like where it was hit.
struct Bark {
    normal: vec3<f32>,
    albedo: vec3<f32>,
    // How much of the sun's light goes on through a leaf.
    translucency: f32,
    // The part of the sky that leaves over it leave open.
    open: f32,
    // How far from here, towards the sun, the plant's own crown ends, in metres.
    out: f32,
}

// How wide a pixel is at a distance, in metres.
fn pixel_width(t: f32) -> f32 {
    return view.pixel * select(t, 1.0, view.orthographic != 0u);
}

// How far the farthest is that was drawn in a pixel.
fn drawn_until(pixel: PixelRay, position: vec4<f32>) -> f32 {
    var depth = 1.0;
    for (var i = 0; i < depth_samples(); i++) {
        depth = min(depth, depth_at(vec2<i32>(position.xy), i));
    }
    if (depth <= 0.0 && view.orthographic == 0u) {
        return view.far;
    }
    return min(view.far, distance(view_point(ndc_of(position), depth), pixel.start));
}

// The first plant on a ray of the frame.
fn cast_grove(origin: vec3<f32>, direction: vec3<f32>, t_near: f32, t_far: f32) -> PlantHit {
    var walk = grove_walk(origin, direction, t_near, t_far, GROVE_BITS);
    for (var i = 0u; i < GROVE_STEPS; i++) {
        if (!grove_next(&walk)) {
            break;
        }
        // From where the ray enters, so that no far distance is subtracted from another.
        let length = min(walk.t_exit, walk.end) - walk.t;
        let from_here = origin + direction * walk.t;
        let cone = vec2<f32>(pixel_width(walk.t), select(view.pixel, 0.0, view.orthographic != 0u));
        let hit = plant_dual_cast(walk.cell, from_here, direction, vec2<f32>(0.0, length), cone);
        if (hit.part != PLANT_NOTHING) {
            return PlantHit(walk.t + hit.t, hit.part, hit.cell);
        }
        grove_leave(&walk);
    }
    return PlantHit(0.0, PLANT_NOTHING, vec2<i32>(0));
}

// How deep a point lies in the ellipsoids of its crown, as a part of how deep foliage eats into them.
fn plant_sunk(solid: PlantSolid, p: vec3<f32>) -> f32 {
    let q = plant_own(solid, p);
    var deepest = 0.0;
    for (var i = 0u; i < plant_forest.species[solid.species].ellipsoids; i++) {
        let e = plant_ellipsoid(solid, i);
        deepest = max(deepest, 1.0 - length((q - e.centre) / e.radii));
    }
    return clamp(deepest / max(plant_forest.species[solid.species].foliage, 1e-3), 0.0, 1.0);
}

// Where a ray from within a crown has left the last of its ellipsoids.
fn plant_out(solid: PlantSolid, p: vec3<f32>, direction: vec3<f32>) -> f32 {
    let o = plant_own(solid, p);
    let d = plant_own_direction(solid, direction);
    var out = 0.0;
    for (var i = 0u; i < plant_forest.species[solid.species].ellipsoids; i++) {
        let chord = plant_chord(plant_ellipsoid(solid, i), o, d);
        out = max(out, select(0.0, chord.y, chord.x <= chord.y));
    }
    return out;
}

fn bark_of(hit: PlantHit, p: vec3<f32>) -> Bark {
    let plant = plant_at(hit.cell);
    let solid = grove_solid(plant, hit.cell);
    let species = solid.species;
    let out = plant_out(solid, p, view.sun_towards);
    if (hit.part == PLANT_TRUNK) {
        return Bark(normalize(plant_trunk_normal(solid, p)), plant_forest.species[species].bark, 0.0, 0.7, out);
    }
    let width = pixel_width(hit.t);
    let level = plant_level(species, width);
    let texel = plant_forest.species[species].period / PLANT_TEXELS;
    let whole = normalize(plant_smooth_normal(solid, p));
    let near = plant_crown_normal(solid, p, clamp(width, 0.5 * texel, 0.25 * solid.radius), level);
    let here = select(whole, near / max(length(near), 1e-20), dot(near, near) > 0.0);
    // Far away a wood is lit as the ground is on which it stands.
    let far = clamp(level / PLANT_COARSEST, 0.0, 1.0);
    var normal = mix(here, whole, max(SMOOTH, far));
    normal += 0.5 * far * plant_ground_normal(plant);
    let albedo = mix(plant_forest.species[species].young, plant_forest.species[species].old, plant_tint(plant));
    // Leaves and the gaps between them, in the mean of a pixel.
    let leaves = plant_leaves(solid, plant_own(solid, p) / LEAF, clamp(log2(width / (LEAF * texel)), 0.0, PLANT_COARSEST));
    let mottle = clamp(1.0 + MOTTLE * (leaves - plant_forest.mean), 0.3, 2.0);
    let open = 1.0 - 0.75 * plant_sunk(solid, p);
    return Bark(normal / max(length(normal), 1e-20), albedo * mottle, plant_forest.species[species].translucency, open, out);
}

// The sun on a plant, less what Bevy already has of it.
fn sun_on_plant(pbr: bevy_types::PbrInput, p: vec3<f32>, bark: Bark) -> vec3<f32> {
    let i = sun_index();
    if (i >= bevy_bindings::lights.n_directional_lights) {
        return vec3<f32>(0.0);
    }
    var input = lighting_input(pbr);
    let had = bevy_lighting::directional_light(i, &input, true);
    let sun = select(bevy_bindings::lights.directional_lights[i].color.rgb, sunlight_at(p), daylight_is_own());
    var seen = sun_over_ground(p).x;
    if (seen > 0.0) {
        // The plant stands in the shadow map too: it is asked where the sun's ray enters the crown.
        var outside = pbr;
        outside.flags = bevy_mesh_types::MESH_FLAGS_SHADOW_RECEIVER_BIT;
        outside.world_position = bevy_point(p + view.sun_towards * (bark.out + 0.05));
        seen = min(seen, sun_in_map(outside, i, 0.0));
        seen = min(seen, canopy_transmittance(p, view.sun_towards));
    }
    // Leaves stand at all angles: light wraps around a crown, and shines through it towards whoever looks into the sun.
    let wrap = 1.5 * bark.translucency;
    let front = clamp((dot(pbr.N, view.sun_towards) + wrap) / ((1.0 + wrap) * (1.0 + wrap)), 0.0, 1.0);
    let against = max(-dot(pbr.V, view.sun_towards), 0.0);
    let through = bark.translucency * (0.25 + 0.75 * against * against * against);
    return sun * seen * bark.albedo / PI * ((1.0 - bark.translucency) * front + through) - had;
}

fn lit_plant(hit: PlantHit, p: vec3<f32>, position: vec4<f32>, depth: f32) -> vec4<f32> {
    let bark = bark_of(hit, grove_point(p));
    var pbr = bevy_types::pbr_input_new();
    pbr.material.base_color = vec4<f32>(bark.albedo, 1.0);
    pbr.material.perceptual_roughness = 0.95;
    pbr.material.reflectance = vec3<f32>(0.2);
    pbr.material.flags |= bevy_types::STANDARD_MATERIAL_FLAGS_FOG_ENABLED_BIT;
    // No shadow map is asked at the surface: it lies within the crown that was drawn into it.
    pbr.flags = 0u;
    pbr.is_orthographic = view.orthographic != 0u;
    pbr.frag_coord = vec4<f32>(position.xy, depth, 1.0);
    pbr.world_position = bevy_point(p);
    pbr.world_normal = bark.normal;
    pbr.N = bark.normal;
    pbr.clearcoat_N = bark.normal;
    pbr.V = towards_eye(p);
    pbr.diffuse_occlusion = vec3<f32>(bark.open * canopy_open(p));
    pbr.specular_occlusion = bark.open;
    var colour = bevy_functions::apply_pbr_lighting(pbr);
    let mended = sun_on_plant(pbr, p, bark) + mended_sky(pbr);
    colour = vec4<f32>(max(colour.rgb + bevy_bindings::view.exposure * mended, vec3<f32>(0.0)), 1.0);
    return bevy_functions::main_pass_post_lighting_processing(pbr, colour);
}

@fragment
fn plants(@builtin(position) position: vec4<f32>) -> Tree {
    let pixel = pixel_ray(position);
    let origin = grove_point(pixel.ray.origin);
    let hit = cast_grove(origin, pixel.ray.direction, pixel.t_near, drawn_until(pixel, position));
    if (hit.part == PLANT_NOTHING) {
        discard;
    }
    let depth = depth_of(pixel, hit.t);
    return Tree(lit_plant(hit, pixel.ray.origin + pixel.ray.direction * hit.t, position, depth), depth);
}
