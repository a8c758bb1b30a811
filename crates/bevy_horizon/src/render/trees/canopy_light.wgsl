// What light the crowns leave: along a ray towards the sun, and straight from above. Beer and Lambert's law through the crowns'
// ellipsoids, as foliage leaves them in the mean. Needs grove.wgsl.

// Dual cells towards the sun in which plants are looked for, and the optical depth behind which nothing is left.
const CANOPY_CELLS: u32 = 12u;
const CANOPY_DARK: f32 = 5.0;

// The optical depth of the four plants around a dual cell along a ray of the frame, within it.
fn canopy_depth(dual: vec2<i32>, origin: vec3<f32>, direction: vec3<f32>, range: vec2<f32>) -> f32 {
    var depth = 0.0;
    for (var i = 0; i < 4; i++) {
        let cell = dual + vec2<i32>(i & 1, i >> 1u);
        let plant = plant_at(cell);
        if (plant_stands(plant) && plant_is_near(plant, plant_forest.spacing * vec2<f32>(cell), origin, direction, range)) {
            depth += plant_depth(grove_solid(plant, cell), origin, direction, range);
        }
    }
    return depth;
}

// The part of the sun's light that reaches a point of the passes' coordinates through the crowns.
fn canopy_transmittance(p: vec3<f32>, towards_sun: vec3<f32>) -> f32 {
    let origin = grove_point(p);
    var walk = grove_walk(origin, towards_sun, 0.0, grove.reach, 1u);
    var depth = 0.0;
    for (var i = 0u; i < CANOPY_CELLS; i++) {
        if (depth > CANOPY_DARK || !grove_next(&walk)) {
            break;
        }
        depth += canopy_depth(walk.cell, origin, towards_sun, vec2<f32>(walk.t, min(walk.t_exit, walk.end)));
        grove_leave(&walk);
    }
    return exp(-depth);
}

// The part of the sky that a point sees: half of it straight above, half at a slant, which is taken for open.
fn canopy_open(p: vec3<f32>) -> f32 {
    let origin = grove_point(p);
    let dual = vec2<i32>(floor(origin.xz / plant_forest.spacing - 0.5));
    if (any(dual < grove.low) || any(dual > grove.high - vec2<i32>(2)) || origin.y > grove_bounds(dual, 0u).y) {
        return 1.0;
    }
    return 0.5 + 0.5 * exp(-canopy_depth(dual, origin, vec3<f32>(0.0, 1.0, 0.0), vec2<f32>(0.0, 1e4)));
}
