// Stamps: local edits of the ground; the twin of part.rs. Needs stamp_part(i: u32) -> StampPart.

struct StampPart {
    // In its own axes a box spans centre ± extent, and all that is nearer than the radius; metres from the anchor.
    centre: vec2<f32>,
    // Cosine and sine of the angle of the box' first axis.
    axis: vec2<f32>,
    extent: vec2<f32>,
    radius: f32,
    per_falloff: f32,
    // At the centre: the height that the ground is levelled to, or by how much it is raised; and the gradient of that.
    height: f32,
    // How much of the part shows on this grid.
    presence: f32,
    slope: vec2<f32>,
    // 1 where the part levels, 0 where it raises.
    levels: f32,
    // Not 0 where it is its stamp's last part.
    last: u32,
}

// How whole a part is at a point, and the gradient of that.
fn stamp_weight(part: StampPart, q: vec2<f32>) -> vec3<f32> {
    let at = q - part.centre;
    let along = vec2<f32>(at.x * part.axis.x + at.y * part.axis.y, at.y * part.axis.x - at.x * part.axis.y);
    let over = max(abs(along) - part.extent, vec2<f32>(0.0));
    let length_over = sqrt(over.x * over.x + over.y * over.y);
    let u = 1.0 - max(length_over - part.radius, 0.0) * part.per_falloff;
    if (u <= 0.0) {
        return vec3<f32>(0.0);
    }
    let left = u * (1.0 - u);
    let slope = -30.0 * left * left * part.per_falloff * part.presence / max(length_over, 1e-30);
    let g = select(slope * over, -slope * over, along < vec2<f32>(0.0));
    let smooth_u = u * u * u * (10.0 + u * (6.0 * u - 15.0));
    return vec3<f32>(part.presence * smooth_u, g.x * part.axis.x - g.y * part.axis.y, g.x * part.axis.y + g.y * part.axis.x);
}

// Whether a point lies within any of some parts, where these are whole: in a hole.
fn stamp_hole(first: u32, count: u32, q: vec2<f32>) -> bool {
    var hole = false;
    for (var i = 0u; i < count; i++) {
        let part = stamp_part(first + i);
        let at = q - part.centre;
        let along = vec2<f32>(at.x * part.axis.x + at.y * part.axis.y, at.y * part.axis.x - at.x * part.axis.y);
        let over = max(abs(along) - part.extent, vec2<f32>(0.0));
        hole = hole || over.x * over.x + over.y * over.y <= part.radius * part.radius;
    }
    return hole;
}

// The ground (height and gradient) at a point, with parts on it, in their order.
fn stamped(first: u32, count: u32, q: vec2<f32>, base: vec3<f32>) -> vec3<f32> {
    var ground = base;
    // Of the parts of one stamp: the largest weight, the sum of weights, and of weights times how far the ground is moved.
    var whole = vec3<f32>(0.0);
    var weights = vec3<f32>(0.0);
    var moves = vec3<f32>(0.0);
    for (var i = 0u; i < count; i++) {
        let part = stamp_part(first + i);
        let w = stamp_weight(part, q);
        if (w.x > 0.0) {
            let at = q - part.centre;
            let plane = vec3<f32>(part.height + (part.slope.x * at.x + part.slope.y * at.y), part.slope);
            let by = plane - part.levels * ground;
            whole = select(whole, w, w.x > whole.x);
            weights += w;
            moves += vec3<f32>(w.x * by.x, w.yz * by.x + w.x * by.yz);
        }
        if (part.last != 0u && weights.x > 0.0) {
            let mean = moves.x / weights.x;
            let share = whole.x / weights.x;
            ground += vec3<f32>(whole.x * mean, whole.yz * mean + share * (moves.yz - mean * weights.yz));
            whole = vec3<f32>(0.0);
            weights = vec3<f32>(0.0);
            moves = vec3<f32>(0.0);
        }
    }
    return ground;
}
