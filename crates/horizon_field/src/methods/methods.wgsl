// The plain marches of a height field: twins of steps.rs and sphere.rs, operation by operation.
//
// A ray is at p(t) = origin + t · direction, with t in metres and direction of unit length; y is up. Its clearance is
// f(t) = y(t) − ground(x(t), z(t)). The includer defines `fn ground(p: vec2<f32>) -> f32`, the height at x and z in metres
// from the place that the origin is counted from. No ground is above `high`, and the ray is clear up to `t_start`.

const MARCH_STEPS: u32 = 4096u;
const MARCH_BISECTIONS: u32 = 64u;

// Where a ray meets the ground, in metres along it, or a negative number; and what that cost.
struct Traced {
    t: f32,
    evaluations: u32,
    steps: u32,
}

fn march_clearance(origin: vec3<f32>, direction: vec3<f32>, t: f32) -> f32 {
    let p = origin + t * direction;
    return p.y - ground(p.xz);
}

// The interval of t on which the ray is not above the highest ground; where there is none it ends where it starts.
fn march_span(origin: vec3<f32>, direction: vec3<f32>, t_start: f32, far: f32, high: f32) -> vec2<f32> {
    let room = high - origin.y;
    let fall = direction.y;
    var span = vec2<f32>(t_start, far);
    if room < 0.0 {
        if fall >= 0.0 {
            return vec2<f32>(t_start, t_start);
        }
        span.x = max(span.x, room / fall);
    } else if fall > 0.0 {
        span.y = min(span.y, room / fall);
    }
    return span;
}

// Where the line through (low, above) and (high, below) crosses zero; below ≤ 0 < above.
fn march_crossing(low: f32, high: f32, above: f32, below: f32) -> f32 {
    return high - (high - low) * below / (below - above);
}

// Seed 000's march: steps of a + b·t + c·f, then k bisections, then linear interpolation.
fn march_fixed(
    origin: vec3<f32>, direction: vec3<f32>, t_start: f32, far: f32, high: f32, a: f32, b: f32, c: f32, k: u32,
) -> Traced {
    var traced = Traced(-1.0, 0u, 0u);
    let span = march_span(origin, direction, t_start, far, high);
    if !(span.x < span.y) {
        return traced;
    }
    var t = span.x;
    var above = march_clearance(origin, direction, t);
    traced.evaluations += 1u;
    if above <= 0.0 {
        traced.t = t;
        return traced;
    }
    while traced.steps < MARCH_STEPS && t < span.y {
        traced.steps += 1u;
        let next = min(t + (a + b * t + c * above), span.y);
        let below = march_clearance(origin, direction, next);
        traced.evaluations += 1u;
        if below <= 0.0 {
            var ends = vec2<f32>(t, next);
            var sides = vec2<f32>(above, below);
            for (var i = 0u; i < min(k, MARCH_BISECTIONS); i += 1u) {
                let middle = 0.5 * (ends.x + ends.y);
                let side = march_clearance(origin, direction, middle);
                traced.evaluations += 1u;
                if side <= 0.0 {
                    ends.y = middle;
                    sides.y = side;
                } else {
                    ends.x = middle;
                    sides.x = side;
                }
            }
            traced.t = march_crossing(ends.x, ends.y, sides.x, sides.y);
            return traced;
        }
        t = next;
        above = below;
    }
    return traced;
}

// Seed 002's march: steps of delta times the distance, within the first metre as at its end; then linear interpolation.
fn march_linear(
    origin: vec3<f32>, direction: vec3<f32>, t_start: f32, far: f32, high: f32, delta: f32,
) -> Traced {
    var traced = Traced(-1.0, 0u, 0u);
    let span = march_span(origin, direction, t_start, far, high);
    if !(span.x < span.y) {
        return traced;
    }
    var t = span.x;
    var above = march_clearance(origin, direction, t);
    traced.evaluations += 1u;
    if above <= 0.0 {
        traced.t = t;
        return traced;
    }
    while traced.steps < MARCH_STEPS && t < span.y {
        traced.steps += 1u;
        let next = min(t + delta * max(t, 1.0), span.y);
        let below = march_clearance(origin, direction, next);
        traced.evaluations += 1u;
        if below <= 0.0 {
            traced.t = march_crossing(t, next, above, below);
            return traced;
        }
        t = next;
        above = below;
    }
    return traced;
}

// Sphere tracing, after Keinert et al. 2014: steps of omega times the radius f / √(1 + slope²), within which no ground is.
// `pixel` is the radius, per metre of distance, at which the ray meets the ground.
fn march_sphere(
    origin: vec3<f32>, direction: vec3<f32>, t_start: f32, far: f32, high: f32, slope: f32, pixel: f32, omega: f32,
) -> Traced {
    var traced = Traced(-1.0, 0u, 0u);
    let span = march_span(origin, direction, t_start, far, high);
    if !(span.x < span.y) {
        return traced;
    }
    let shrink = 1.0 / sqrt(1.0 + slope * slope);
    var t = span.x;
    var last = t;
    var last_radius = 0.0;
    var relax = omega;
    var best = t;
    var best_radius = 0.0;
    while traced.steps < MARCH_STEPS {
        traced.steps += 1u;
        let radius = shrink * march_clearance(origin, direction, t);
        traced.evaluations += 1u;
        if relax > 1.0 && abs(radius) + last_radius < t - last {
            // The spheres do not overlap: back to the plain step.
            relax = 1.0;
            t = last + last_radius;
            continue;
        }
        if radius <= pixel * t {
            traced.t = t;
            return traced;
        }
        if best_radius == 0.0 || radius * best < best_radius * t {
            best = t;
            best_radius = radius;
        }
        if t + radius >= span.y {
            return traced;
        }
        last = t;
        last_radius = radius;
        t = min(t + relax * radius, span.y);
    }
    traced.t = best;
    return traced;
}
