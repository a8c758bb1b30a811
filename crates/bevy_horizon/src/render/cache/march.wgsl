// A ray through the drawn surface: climb and descend the pyramid of maxima (maximum mipmaps, Tevs et al. 2008), find
// the patch, solve it. Where a hole takes the ground away, the ray goes on under it, and all is upside down until it comes out. Needs
// ray.wgsl, view.wgsl, surface.wgsl, look.wgsl, and HEAT, which says whether to count.

struct Found {
    // Distance along the ray; negative where nothing was hit.
    t: f32,
    level: u32,
    cell: vec2<i32>,
    // Loop turns, and what was loaded of heights and bounds; counted for heat maps alone.
    steps: u32,
    loads: u32,
}

const MARCH_STEPS: u32 = 768u;
const TOP_MIP: u32 = 6u;
// Where a ray starts close above the ground.
const START_MIP: u32 = 2u;

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

// Where a ray is on its way: in which level, and which node of its pyramid.
struct Walk {
    t: f32,
    level: u32,
    mip: u32,
    cell: vec2<i32>,
    steps: u32,
    loads: u32,
    // 1 above the ground, −1 under it.
    side: f32,
    // What depends on the level alone: the level, the ray in its texels, and when the ray enters the next finer one.
    l: Level,
    origin: vec2<f32>,
    d: vec2<f32>,
    enters: f32,
}

// A node: its cells, and when the ray leaves it, through which side, and whether into a finer level.
struct Node {
    low: vec2<i32>,
    high: vec2<i32>,
    t_exit: f32,
    through_x: bool,
    finer: bool,
}

fn enter_level(walk: ptr<function, Walk>, ray: Ray, inverse: vec2<f32>, level: u32) {
    (*walk).level = level;
    if (level >= clipmap.count) {
        return;
    }
    let l = clipmap.levels[level];
    (*walk).l = l;
    (*walk).origin = ray.origin.xz * l.per_metre + l.fraction;
    (*walk).d = ray.direction.xz * l.per_metre;
    (*walk).enters = enters_finer(ray, inverse, level);
    (*walk).cell = vec2<i32>(floor((*walk).origin + (*walk).d * (*walk).t));
}

fn node_of(walk: Walk, inverse: vec2<f32>, positive: vec2<bool>) -> Node {
    let low = (((walk.l.base + walk.cell) >> vec2<u32>(walk.mip)) << vec2<u32>(walk.mip)) - walk.l.base;
    let high = low + vec2<i32>(1 << walk.mip);
    let exits = (select(vec2<f32>(low), vec2<f32>(high), positive) - walk.origin) * inverse * walk.l.texel;
    let t_exit = max(min(exits.x, exits.y), walk.t);
    let finer = walk.enters > walk.t && walk.enters < t_exit;
    return Node(low, high, select(t_exit, walk.enters, finer), exits.x <= exits.y, finer);
}

// On to the neighbour, named exactly by the side that the ray leaves through: no patch is skipped by rounding.
fn leave(walk: ptr<function, Walk>, ray: Ray, node: Node, inverse: vec2<f32>, positive: vec2<bool>) {
    (*walk).t = node.t_exit;
    let p = (ray.origin + ray.direction * node.t_exit).xz;
    let outside = max(abs(p.x), abs(p.y)) * (*walk).l.per_metre >= (*walk).l.outer;
    if (node.finer || outside) {
        (*walk).mip = select(max((*walk).mip, 1u) - 1u, min((*walk).mip + 1u, TOP_MIP), node.finer);
        enter_level(walk, ray, inverse, select((*walk).level + 1u, (*walk).level - 1u, node.finer));
        return;
    }
    let base = (*walk).l.base;
    let last = base + (*walk).cell;
    let along = clamp(vec2<i32>(floor((*walk).origin + (*walk).d * node.t_exit)), node.low, node.high - vec2<i32>(1));
    let side = select(node.low - vec2<i32>(1), node.high, positive);
    let cell = select(vec2<i32>(along.x, side.y), vec2<i32>(side.x, along.y), node.through_x);
    let up = vec2<u32>((*walk).mip + 1u);
    let climbs = (*walk).mip < TOP_MIP && any(((base + cell) >> up) != (last >> up));
    (*walk).cell = cell;
    (*walk).mip += select(0u, 1u, climbs);
}

// Down the pyramid: until the ray stands before a patch, or has left the world. Its own loop, so that the lanes of a
// group solve their patches together (Aila & Laine 2009).
fn descend(walk: ptr<function, Walk>, ray: Ray, inverse: vec2<f32>, positive: vec2<bool>, t_far: f32) {
    while ((*walk).mip > 0u && (*walk).t <= t_far && (*walk).level < clipmap.count && (*walk).steps < MARCH_STEPS) {
        (*walk).steps += 1u;
        let node = node_of(*walk, inverse, positive);
        if (HEAT) {
            (*walk).loads += select(1u, 2u, is_blended((*walk).l, node.low, f32(1u << (*walk).mip)));
        }
        let extremes = node_bounds((*walk).l, (*walk).level, (*walk).cell, node.low, (*walk).mip);
        let highest = select(-extremes.x, extremes.y, (*walk).side > 0.0);
        let line = (*walk).side * vec2<f32>(ray.origin.y, ray.direction.y);
        let y = line.x + line.y * (*walk).t;
        if (min(y, line.x + line.y * node.t_exit) > highest) {
            leave(walk, ray, node, inverse, positive);
            continue;
        }
        // Not before the ray has fallen to the node's highest point.
        if (y > highest) {
            (*walk).t = clamp((highest - line.x) / line.y, (*walk).t, node.t_exit);
        }
        (*walk).mip -= 1u;
        let at = vec2<i32>(floor((*walk).origin + (*walk).d * (*walk).t));
        (*walk).cell = clamp(at, node.low, node.high - vec2<i32>(1));
    }
}

// When the ray leaves the square of half-width r around the centre.
fn leaves_square(ray: Ray, inverse: vec2<f32>, r: f32) -> f32 {
    let a = (vec2<f32>(-r) - ray.origin.xz) * inverse;
    let b = (vec2<f32>(r) - ray.origin.xz) * inverse;
    return min(max(a.x, b.x), max(a.y, b.y));
}

// How high the ray is above the patch that it stands before, s metres on: q0 + q1 s + q2 s².
fn over_patch(walk: Walk, ray: Ray) -> vec3<f32> {
    let h = corners(walk.l, walk.level, walk.cell);
    let at = walk.origin - vec2<f32>(walk.cell) + walk.d * walk.t;
    let a = h.y - h.x;
    let b = h.z - h.x;
    let c = h.w - h.y - b;
    let q0 = ray.origin.y + ray.direction.y * walk.t - (h.x + a * at.x + b * at.y + c * at.x * at.y);
    let q1 = ray.direction.y - (a * walk.d.x + b * walk.d.y + c * (at.x * walk.d.y + at.y * walk.d.x));
    return vec3<f32>(q0, q1, -c * walk.d.x * walk.d.y);
}

// Where q0 + q1 s + q2 s² falls through 0, and where it rises through it; a large number where it does not.
fn crossings(q: vec3<f32>) -> vec2<f32> {
    let d = q.y * q.y - 4.0 * q.z * q.x;
    if (d <= 0.0) {
        return vec2<f32>(1e30);
    }
    let r = -0.5 * (q.y + select(-1.0, 1.0, q.y >= 0.0) * sqrt(d));
    // At r / q2 the slope is q1 + 2 r, whose sign is not q1's; at the other root it is.
    let a = select(1e30, r / q.z, q.z != 0.0);
    let b = select(1e30, q.x / r, r != 0.0);
    return select(vec2<f32>(b, a), vec2<f32>(a, b), q.y >= 0.0);
}

// Whether the texel that is nearest to the ray, s metres on, is a hole's.
fn in_hole(walk: Walk, s: f32) -> bool {
    let at = walk.origin - vec2<f32>(walk.cell) + walk.d * (walk.t + s);
    return is_hole(texel_index(walk.l, walk.cell + select(vec2<i32>(0), vec2<i32>(1), at >= vec2<f32>(0.5))));
}

// As first_root, where there may be holes: how far on the ray meets the patch from above, and not in a hole; negative where it
// does not. The walk's side becomes that on which the ray leaves the patch.
fn pierce(walk: ptr<function, Walk>, q: vec3<f32>, length: f32) -> f32 {
    var under_since = 0.0;
    // What was above, and begins under the patch and rises, has come out of the last one within rounding: it is under this one yet.
    if (q.x > 0.0 || ((*walk).side > 0.0 && q.y < 0.0)) {
        (*walk).side = 1.0;
        let s = first_root(q.x, q.y, q.z, length);
        if (s < 0.0 || !in_hole(*walk, s)) {
            return s;
        }
        under_since = s;
    }
    (*walk).side = -1.0;
    // Down, and up.
    let roots = crossings(q);
    if (roots.y >= under_since && roots.y <= length) {
        (*walk).side = 1.0;
        if (roots.x > roots.y && roots.x <= length) {
            if (!in_hole(*walk, roots.x)) {
                return roots.x;
            }
            (*walk).side = -1.0;
        }
    }
    return -1.0;
}

fn march(ray: Ray, t_start: f32, far: f32) -> Found {
    if (clipmap.count == 0u || t_start > far) {
        return Found(-1.0, 0u, vec2<i32>(0), 0u, 0u);
    }
    let positive = ray.direction.xz >= vec2<f32>(0.0);
    // A direction that is all but level with an axis never crosses that axis' lines.
    let inverse = select(1.0 / ray.direction.xz, select(vec2<f32>(-1e30), vec2<f32>(1e30), positive), abs(ray.direction.xz) < vec2<f32>(1e-20));
    // The world ends at the coarsest level's rim: behind it lie patches that were never filled.
    let coarsest = clipmap.levels[clipmap.count - 1u];
    let t_far = min(far, leaves_square(ray, inverse, coarsest.outer * coarsest.texel));
    var walk: Walk;
    walk.t = t_start;
    walk.mip = select(TOP_MIP, START_MIP, t_start > 0.0);
    walk.side = 1.0;
    enter_level(&walk, ray, inverse, level_at((ray.origin + ray.direction * t_start).xz));
    if (view.holes != 0u && walk.level < clipmap.count) {
        walk.side = select(-1.0, 1.0, over_patch(walk, ray).x > 0.0);
    }
    while (walk.steps < MARCH_STEPS) {
        descend(&walk, ray, inverse, positive, t_far);
        if (walk.t > t_far || walk.level >= clipmap.count) {
            break;
        }
        walk.steps += 1u;
        let node = node_of(walk, inverse, positive);
        if (HEAT) {
            walk.loads += select(4u, 8u, is_blended(walk.l, walk.cell, 1.0));
        }
        let q = over_patch(walk, ray);
        var s: f32;
        if (view.holes == 0u) {
            s = first_root(q.x, q.y, q.z, node.t_exit - walk.t);
        } else {
            s = pierce(&walk, q, node.t_exit - walk.t);
        }
        if (s >= 0.0) {
            return Found(select(-1.0, walk.t + s, walk.t + s <= t_far), walk.level, walk.cell, walk.steps, walk.loads);
        }
        leave(&walk, ray, node, inverse, positive);
    }
    return Found(-1.0, 0u, vec2<i32>(0), walk.steps, walk.loads);
}
