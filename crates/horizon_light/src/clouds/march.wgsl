// Where a ray is in a layer, and what it meets there; the twin of span.rs and march.rs, where the reasons stand. Needs geometry.wgsl.
// radius: the planet's, 0 for a plane.

const CLOUD_FARTHEST: f32 = 1e6;
const CLOUD_MOST_STEPS: u32 = 1024u;
const CLOUD_SKIP_MIP: u32 = 2u;

struct CloudRay {
    origin: CloudPoint,
    toward: vec3<f32>,
    radius: f32,
}

struct CloudSteps {
    first: f32,
    growth: f32,
    jitter: f32,
}

struct CloudMarched {
    light: vec3<f32>,
    transmittance: f32,
    depth: f32,
    samples: u32,
}

// Below an altitude, from the start on.
fn cloud_ahead(radius: f32, level: f32, h: f32, mu: f32) -> vec2<f32> {
    let along = (radius + h) * mu;
    let excess = shell_excess(radius, level, h);
    if excess <= 0.0 {
        let root = sqrt(max(along * along - excess, 0.0));
        if along > 0.0 {
            return vec2<f32>(0.0, -excess / (along + root));
        }
        return vec2<f32>(0.0, root - along);
    }
    let square = shell_discriminant(radius, level, h, mu);
    if along >= 0.0 || square <= 0.0 {
        return vec2<f32>(0.0);
    }
    let far = sqrt(square) - along;
    return vec2<f32>(excess / far, far);
}

// Two spans, (near, far, near, far); empty ones have no length.
fn cloud_spans(radius: f32, base: f32, top: f32, h: f32, mu: f32) -> vec4<f32> {
    if radius <= 0.0 {
        let down = base - h;
        let up = top - h;
        if mu == 0.0 {
            return vec4<f32>(0.0, select(0.0, CLOUD_FARTHEST, down <= 0.0 && up >= 0.0), 0.0, 0.0);
        }
        let far = min(max(down / mu, up / mu), CLOUD_FARTHEST);
        let near = max(min(down / mu, up / mu), 0.0);
        return select(vec4<f32>(0.0), vec4<f32>(near, far, 0.0, 0.0), far > near);
    }
    let outer = cloud_ahead(radius, top, h, mu);
    if outer.y <= outer.x {
        return vec4<f32>(0.0);
    }
    let inner = cloud_ahead(radius, base, h, mu);
    if inner.y <= inner.x {
        return vec4<f32>(outer, 0.0, 0.0);
    }
    if inner.x <= outer.x {
        return vec4<f32>(inner.y, outer.y, 0.0, 0.0);
    }
    return vec4<f32>(outer.x, inner.x, inner.y, outer.y);
}

fn cloud_mu(ray: CloudRay) -> f32 {
    return clamp(dot(ray.origin.up, ray.toward), -1.0, 1.0);
}

fn cloud_point(ray: CloudRay, distance: f32) -> CloudPoint {
    let at = ray.origin.at + distance * ray.toward;
    let mu = cloud_mu(ray);
    if ray.radius <= 0.0 {
        return CloudPoint(at, ray.origin.altitude + mu * distance, ray.origin.up);
    }
    let above = advance(ray.radius, ray.origin.altitude, mu, distance).x;
    let up = (ray.origin.up * (ray.radius + ray.origin.altitude) + distance * ray.toward) / (ray.radius + above);
    return CloudPoint(at, above, up);
}

fn cloud_ray_spans(cloud: Cloud, ray: CloudRay) -> vec4<f32> {
    return cloud_spans(ray.radius, cloud.base, cloud.base + cloud.thickness, ray.origin.altitude, cloud_mu(ray));
}

// How far there is nothing in the block at `distance`: a distance not less.
fn cloud_empty_until(cloud: Cloud, ray: CloudRay, distance: f32) -> f32 {
    if cloud.model == CLOUD_SHEET {
        return distance;
    }
    let point = cloud_point(ray, distance);
    let blocks = CLOUD_BLOCKS / f32(1u << CLOUD_SKIP_MIP);
    let u = cloud_shape_at(cloud, point) * blocks;
    let speed = ray.toward * (cloud.per_shape * blocks);
    let part = u - floor(u);
    let ways = select(part, 1.0 - part, speed > vec3<f32>(0.0)) / max(abs(speed), vec3<f32>(1e-30));
    let until = min(min(ways.x, ways.y), ways.z);
    let a = cloud_height(cloud, point.altitude);
    let b = cloud_height(cloud, cloud_point(ray, distance + until).altitude);
    let sag = select(0.0, until * until / (8.0 * max(ray.radius, 1.0) * cloud.thickness), ray.radius > 0.0);
    let noise = cloud_volume_most(vec3<i32>(floor(u)), CLOUD_SKIP_MIP);
    let weather = cloud_weather_most(cloud, point.at, until);
    let bound = cloud_base_density(cloud, noise, min(a, b) - sag, max(a, b), weather);
    return select(distance + until, distance, bound > 0.0);
}

// Equal cells over a span.
fn cloud_even_steps(span: vec2<f32>, count: u32, jitter: f32) -> CloudSteps {
    return CloudSteps(max(span.y - span.x, 1e-3) / f32(clamp(count, 1u, CLOUD_MOST_STEPS)), 0.0, jitter);
}

fn cloud_cell_start(steps: CloudSteps, k: u32) -> f32 {
    let u = max(f32(k) - steps.jitter, 0.0);
    return u * (steps.first + 0.5 * steps.growth * u);
}

fn cloud_cell(steps: CloudSteps, distance: f32) -> u32 {
    let root = sqrt(steps.first * steps.first + 2.0 * steps.growth * distance);
    let u = 2.0 * distance / (steps.first + root) + steps.jitter;
    return u32(min(floor(u), f32(CLOUD_MOST_STEPS)));
}

// (1 - e^-x)/x for x >= 0.
fn cloud_faded(x: f32) -> f32 {
    if x < 1e-2 {
        return 1.0 - x * (0.5 - x / 6.0);
    }
    return (1.0 - exp(-x)) / x;
}

// Where in a cell of optical depth x what leaves it comes from in the mean.
fn cloud_seen_at(x: f32) -> f32 {
    if x < 0.1 {
        return 0.5 - x / 12.0;
    }
    return 1.0 / x - 1.0 / (exp(min(x, 80.0)) - 1.0);
}

// One more cell of a march: `length` of it are passed, which send `source` per extinction.
fn cloud_passed(marched: CloudMarched, extinction: f32, source: vec3<f32>, length: f32, middle: f32) -> CloudMarched {
    let depth = extinction * length;
    let left = marched.transmittance * exp(-depth);
    let met = 1.0 - marched.transmittance;
    let now = 1.0 - left;
    let moment = marched.depth * met + (marched.transmittance - left) * middle;
    return CloudMarched(
        marched.light + marched.transmittance * depth * cloud_faded(depth) * source,
        left,
        select(0.0, moment / max(now, 1e-30), now > 0.0),
        marched.samples + 1u,
    );
}
