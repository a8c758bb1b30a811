// Plants in a shadow map: each ellipsoid as a quad that faces the light, through its middle, cut out to the ellipse that it is from
// there. A crown lets as much light through as its chord has it, by dapples: in the mean Beer and Lambert's law, and sharp near by.
// Needs grove.wgsl.

struct Light {
    // From the passes' coordinates to the map's clip space.
    clip_from_ground: mat4x4<f32>,
    // Where the light is, in the passes' coordinates, or, with w = 0, the direction towards it.
    place: vec4<f32>,
}

// The cells of the plants, 16 bits each for x and z.
@group(0) @binding(4) var<storage, read> standing: array<u32>;
@group(0) @binding(5) var<uniform> light: Light;

// The width of a dapple, in metres.
const DAPPLE: f32 = 0.25;

struct Blot {
    @builtin(position) position: vec4<f32>,
    // Where in the ellipse: its edge is at 1.
    @location(0) at: vec2<f32>,
    // Dapples along the ellipse's radius; the optical depth through its middle, negative where it is solid.
    @location(1) @interpolate(flat) dapples: f32,
    @location(2) @interpolate(flat) depth: f32,
    @location(3) @interpolate(flat) hash: u32,
}

@vertex
fn cast_plant(@builtin(vertex_index) vertex: u32, @builtin(instance_index) instance: u32) -> Blot {
    let word = bitcast<i32>(standing[instance]);
    let cell = vec2<i32>((word << 16u) >> 16u, word >> 16u);
    let plant = plant_at(cell);
    let solid = grove_solid(plant, cell);
    // Four of the crown, and the trunk.
    let part = vertex / 6u;
    let trunk = part == PLANT_ELLIPSOIDS;
    var there = part < plant_forest.species[solid.species].ellipsoids;
    if (trunk) {
        there = plant_forest.species[solid.species].trunk.y > 0.0;
    }
    if (!plant_stands(plant) || !there) {
        return Blot(vec4<f32>(2.0, 2.0, 0.5, 1.0), vec2<f32>(0.0), 0.0, 0.0, 0u);
    }
    var e = plant_trunk(solid);
    if (!trunk) {
        e = plant_ellipsoid(solid, part);
        e.radii *= 1.0 - 0.5 * plant_forest.species[solid.species].foliage * plant_forest.mean;
    }
    let shift = vec3<f32>(grove.shift.x, 0.0, grove.shift.y);
    let middle = plant_place(solid, e.centre) - shift;
    let to_light = normalize(light.place.xyz - middle * light.place.w);
    // Where the ellipsoid is a unit sphere.
    let k = plant_own_direction(solid, to_light) / e.radii;
    let n = normalize(k);
    let across = normalize(cross(n, select(vec3<f32>(0.0, 1.0, 0.0), vec3<f32>(1.0, 0.0, 0.0), abs(n.y) > 0.9)));
    let corner = vertex % 6u;
    let right = corner == 1u || corner == 3u || corner == 4u;
    let below = corner == 2u || corner == 4u || corner == 5u;
    let at = vec2<f32>(select(-1.0, 1.0, right), select(-1.0, 1.0, below));
    let p = plant_place(solid, e.centre + e.radii * (at.x * across + at.y * cross(n, across))) - shift;
    var clip = light.clip_from_ground * vec4<f32>(p, 1.0);
    if (light.place.w == 0.0) {
        // What stands between the light and a cascade casts into it from its near plane.
        clip.z = min(clip.z, clip.w);
    }
    let depth = 2.0 / length(k) * plant_forest.species[solid.species].density;
    return Blot(clip, at, max(e.radii.x, e.radii.y) / DAPPLE, select(depth, -1.0, trunk), solid.hash + part);
}

// A point of the plant's own space, in the frame.
fn plant_place(solid: PlantSolid, q: vec3<f32>) -> vec3<f32> {
    return solid.foot + vec3<f32>(q.x + solid.shear.x * q.y, q.y, q.z + solid.shear.y * q.y);
}

// Evenly in 0 to 1, the same for a place of a plant wherever the map's texels lie.
fn dapple(at: vec2<i32>, hash: u32) -> f32 {
    let both = bitcast<vec2<u32>>(at) * vec2<u32>(747796405u, 2654435769u);
    let state = (both.x + both.y + hash) * 747796405u + 2891336453u;
    let word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return f32(((word >> 22u) ^ word) >> 8u) / 16777216.0;
}

@fragment
fn keep_crown(blot: Blot) {
    let r = dot(blot.at, blot.at);
    if (r > 1.0) {
        discard;
    }
    if (blot.depth >= 0.0 && dapple(vec2<i32>(floor(blot.at * blot.dapples)), blot.hash) < exp(-blot.depth * sqrt(1.0 - r))) {
        discard;
    }
}
