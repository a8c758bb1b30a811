// What water mirrors: what is on the screen, as it was drawn there; else the ground, by a ray of its own; else the sky. Needs
// water.wgsl, and mirrored_ground() of water_ground.wgsl or water_no_ground.wgsl.

const MIRROR_STEPS: u32 = 20u;

// How far a point of a ray lies behind what is drawn there, in metres; negative before it, or where nothing of use is drawn. `w` of
// the pixel.
fn behind_drawn(body: u32, p: vec3<f32>) -> vec3<f32> {
    let at = pixel_of(p);
    if (at.x < 0.0) {
        return vec3<f32>(at, -1.0);
    }
    let depth = drawn_depths(vec2<i32>(at)).x;
    if (depth <= 0.0) {
        return vec3<f32>(at, -1.0);
    }
    let seen = drawn_at(at, depth);
    // What is under water is not mirrored.
    if (waters.bodies[body].above + seen.y < 0.0) {
        return vec3<f32>(at, -1.0);
    }
    return vec3<f32>(at, dot(view.back, seen - p));
}

fn mirrored_light(body: u32, o: vec3<f32>, direction: vec3<f32>, position: vec4<f32>) -> vec3<f32> {
    let ground = mirrored_ground(o, direction);
    let end = select(min(ground.t, 2e3), 2e3, ground.t < 0.0);
    // Steps that grow: near things need the finest.
    var last = 0.0;
    var t = max(0.05, 2.0 * footprint_at(length(o)));
    let growth = pow(max(end / t, 1.0), 1.0 / f32(MIRROR_STEPS));
    for (var i = 0u; i < MIRROR_STEPS; i++) {
        let seen = behind_drawn(body, o + direction * t);
        if (seen.z > 0.0 && seen.z < 1.5 * (t - last) + 0.1) {
            var a = last;
            var b = t;
            var hit = seen;
            for (var k = 0u; k < 5u; k++) {
                let m = 0.5 * (a + b);
                let at = behind_drawn(body, o + direction * m);
                if (at.z > 0.0) {
                    b = m;
                    hit = at;
                } else {
                    a = m;
                }
            }
            let veil = veil_along(direction, b);
            return drawn_light(hit.xy) * veil.through + veil.light;
        }
        last = t;
        t *= growth;
    }
    if (ground.t >= 0.0) {
        let veil = veil_along(direction, ground.t);
        return ground.light * veil.through + veil.light;
    }
    return sky_from(direction);
}
