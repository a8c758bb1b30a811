// A ray through the drawn surface: climb and descend the pyramid of maxima (maximum mipmaps, Tevs et al. 2008), find
// the patch, solve it. Needs surface.wgsl.

struct Ray {
    // From the clipmap's centre; y above the datum.
    origin: vec3<f32>,
    direction: vec3<f32>,
}

struct Found {
    // Distance along the ray; negative where nothing was hit.
    t: f32,
    level: u32,
    cell: vec2<i32>,
    // Loop turns, for the heat map.
    steps: u32,
}

const MARCH_STEPS: u32 = 768u;
const TOP_MIP: u32 = 6u;

// The first root of q0 + q1 s + q2 s² in [0, length]; negative where there is none.
fn first_root(q0: f32, q1: f32, q2: f32, length: f32) -> f32 {
    if (q0 <= 0.0) {
        return 0.0;
    }
    let d = q1 * q1 - 4.0 * q2 * q0;
    if (d < 0.0) {
        return -1.0;
    }
    let q = -0.5 * (q1 + select(-1.0, 1.0, q1 >= 0.0) * sqrt(d));
    // A zero divisor gives an infinity, which no comparison accepts.
    let a = select(-1.0, q0 / q, q != 0.0);
    let b = select(-1.0, q / q2, q2 != 0.0);
    var s = -1.0;
    if (a >= 0.0 && a <= length) {
        s = a;
    }
    if (b >= 0.0 && b <= length && (s < 0.0 || b < s)) {
        s = b;
    }
    return s;
}

// The finest level that draws the ground at this point.
fn level_at(p: vec2<f32>) -> u32 {
    let c = max(abs(p.x), abs(p.y));
    var level = 0u;
    while (level < clipmap.count && c >= clipmap.levels[level].outer * clipmap.levels[level].texel) {
        level++;
    }
    return level;
}

// When the ray enters the square of half-width r around the centre; a large number where it does not.
fn enters_square(ray: Ray, inverse: vec2<f32>, r: f32) -> f32 {
    let a = (vec2<f32>(-r) - ray.origin.xz) * inverse;
    let b = (vec2<f32>(r) - ray.origin.xz) * inverse;
    let near = max(min(a.x, b.x), min(a.y, b.y));
    let far = min(max(a.x, b.x), max(a.y, b.y));
    return select(1e30, near, near <= far);
}

// When the ray enters the finer level that a level holds in its middle. A ray that starts in the middle never does.
fn enters_finer(ray: Ray, inverse: vec2<f32>, level: u32) -> f32 {
    if (level == 0u) {
        return 1e30;
    }
    let finer = clipmap.levels[level - 1u];
    return select(enters_square(ray, inverse, finer.outer * finer.texel), 1e30, finer.outer <= 0.0);
}

fn march(ray: Ray, t_start: f32, t_far: f32) -> Found {
    var t = t_start;
    var p = (ray.origin + ray.direction * t).xz;
    var level = level_at(p);
    if (level >= clipmap.count) {
        return Found(-1.0, 0u, vec2<i32>(0), 0u);
    }
    var mip = TOP_MIP;
    let direction = ray.direction.xz;
    let positive = direction >= vec2<f32>(0.0);
    // A direction that is all but level with an axis never crosses that axis' lines.
    let inverse = select(1.0 / direction, vec2<f32>(1e30), abs(direction) < vec2<f32>(1e-20));

    // What depends on the level alone.
    var l = clipmap.levels[level];
    var enters = enters_finer(ray, inverse, level);
    var origin = ray.origin.xz * l.per_metre + l.fraction;
    var d = direction * l.per_metre;
    var cell = vec2<i32>(floor(origin + d * t));

    for (var step = 0u; step < MARCH_STEPS; step++) {
        // The node, and when the ray leaves it.
        let low = (((l.base + cell) >> vec2<u32>(mip)) << vec2<u32>(mip)) - l.base;
        let high = low + vec2<i32>(1 << mip);
        let exits = (select(vec2<f32>(low), vec2<f32>(high), positive) - origin) * inverse * l.texel;
        var t_exit = max(min(exits.x, exits.y), t);
        let finer = enters > t && enters < t_exit;
        t_exit = select(t_exit, enters, finer);

        if (mip == 0u) {
            let h = corners(l, level, cell);
            let at = origin - vec2<f32>(cell) + d * t;
            let a = h.y - h.x;
            let b = h.z - h.x;
            let c = h.w - h.y - b;
            let q0 = ray.origin.y + ray.direction.y * t - (h.x + a * at.x + b * at.y + c * at.x * at.y);
            let q1 = ray.direction.y - (a * d.x + b * d.y + c * (at.x * d.y + at.y * d.x));
            let q2 = -c * d.x * d.y;
            let s = first_root(q0, q1, q2, t_exit - t);
            if (s >= 0.0) {
                return Found(select(-1.0, t + s, t + s <= t_far), level, cell, step);
            }
        } else {
            let highest = node_bounds(l, level, cell, low, mip).y;
            let y = ray.origin.y + ray.direction.y * t;
            if (min(y, ray.origin.y + ray.direction.y * t_exit) <= highest) {
                // Not before the ray has fallen to the node's highest point.
                if (y > highest) {
                    t = clamp((highest - ray.origin.y) / ray.direction.y, t, t_exit);
                }
                mip -= 1u;
                cell = clamp(vec2<i32>(floor(origin + d * t)), low, high - vec2<i32>(1));
                continue;
            }
        }

        // On to the neighbour, named exactly by the side that the ray leaves through: no patch is skipped by rounding.
        t = t_exit;
        if (t > t_far) {
            break;
        }
        p = (ray.origin + ray.direction * t).xz;
        let outside = max(abs(p.x), abs(p.y)) * l.per_metre >= l.outer;
        if (finer || outside) {
            level = select(level + 1u, level - 1u, finer);
            if (level >= clipmap.count) {
                break;
            }
            l = clipmap.levels[level];
            enters = enters_finer(ray, inverse, level);
            origin = ray.origin.xz * l.per_metre + l.fraction;
            d = direction * l.per_metre;
            cell = vec2<i32>(floor(origin + d * t));
            mip = select(max(mip, 1u) - 1u, min(mip + 1u, TOP_MIP), finer);
            continue;
        }
        let last = l.base + cell;
        cell = clamp(vec2<i32>(floor(origin + d * t)), low, high - vec2<i32>(1));
        let side = select(low - vec2<i32>(1), high, positive);
        cell = select(vec2<i32>(cell.x, side.y), vec2<i32>(side.x, cell.y), exits.x <= exits.y);
        let up = vec2<u32>(mip + 1u);
        if (mip < TOP_MIP && any(((l.base + cell) >> up) != (last >> up))) {
            mip += 1u;
        }
    }
    return Found(-1.0, 0u, vec2<i32>(0), MARCH_STEPS);
}
