// The sun's light in a cloud; the twin of light.rs, where the reasons stand.

const CLOUD_OCTAVES: u32 = 4u;
// Octaves beyond the first: light, extinction towards the sun, asymmetry.
const CLOUD_DIFFUSE_1: vec3<f32> = vec3<f32>(1.03, 0.45, 0.9);
const CLOUD_DIFFUSE_2: vec3<f32> = vec3<f32>(0.889, 0.08, 0.4);
const CLOUD_DIFFUSE_3: vec3<f32> = vec3<f32>(0.485, 0.015, 0.0);

struct CloudQuality {
    // Cells over each span, and samples towards the sun.
    steps: u32,
    sun_samples: u32,
    // How far is looked towards the sun, in metres: 25 over extinction is enough.
    reach: f32,
    // By which part of a cell all are shifted: 0 to 1.
    jitter: f32,
    // Of what lies behind: less is nothing.
    least: f32,
    // 1: light scattered once.
    octaves: u32,
}

fn cloud_octave(phase: CloudPhase, nu: f32, depth: f32, octave: vec3<f32>) -> f32 {
    return octave.x * cloud_phase(cloud_phase_flattened(phase, octave.z), nu) * exp(-octave.y * depth);
}

// Light per irradiance and scattering, per steradian, behind an optical depth towards the sun.
fn cloud_source(phase: CloudPhase, nu: f32, depth: f32, density: f32, octaves: u32) -> f32 {
    let once = cloud_phase(phase, nu) * exp(-depth);
    var more = 0.0;
    if octaves > 1u {
        more += cloud_octave(phase, nu, depth, CLOUD_DIFFUSE_1);
    }
    if octaves > 2u {
        more += cloud_octave(phase, nu, depth, CLOUD_DIFFUSE_2);
    }
    if octaves > 3u {
        more += cloud_octave(phase, nu, depth, CLOUD_DIFFUSE_3);
    }
    return once + more * sqrt(max(density, 0.0));
}

// Optical depth from the ray's start towards its end, within a reach; samples lie closer near the start.
fn cloud_sun_depth(cloud: Cloud, ray: CloudRay, samples: u32, reach: f32) -> f32 {
    let spans = cloud_ray_spans(cloud, ray);
    let count = max(samples, 1u);
    let per = 1.0 / f32(count);
    var depth = 0.0;
    for (var s = 0u; s < 2u; s++) {
        let span = select(spans.zw, spans.xy, s == 0u);
        let length = min(span.y, reach) - span.x;
        if length <= 0.0 {
            continue;
        }
        for (var i = 0u; i < count; i++) {
            let a = f32(i) * per;
            let b = f32(i + 1u) * per;
            let point = cloud_point(ray, span.x + 0.5 * (a * a + b * b) * length);
            depth += (b - a) * (b + a) * length * cloud_density(cloud, point, cloud_weather(cloud, point.at));
        }
    }
    return depth * cloud.extinction;
}

// A cloud along a ray, from cut.x to cut.y metres, under a sun in the direction `sun` of an irradiance of 1, going on from what was
// marched before. light.x of the result is the sun's; light.y is 1 - transmittance, summed like it: what even light of radiance 1 from
// all sides adds.
fn cloud_march(
    before: CloudMarched, cloud: Cloud, ray: CloudRay, cut: vec2<f32>, sun: vec3<f32>, quality: CloudQuality,
) -> CloudMarched {
    var marched = before;
    let nu = clamp(dot(ray.toward, sun), -1.0, 1.0);
    let spans = cloud_ray_spans(cloud, ray);
    for (var s = 0u; s < 2u; s++) {
        let span = select(spans.zw, spans.xy, s == 0u);
        let near = max(span.x, cut.x);
        let far = min(span.y, cut.y);
        if far <= near {
            continue;
        }
        let steps = cloud_even_steps(span, quality.steps, quality.jitter);
        let whole = span.y - span.x;
        var k = cloud_cell(steps, near - span.x);
        while k < CLOUD_MOST_STEPS {
            let start = cloud_cell_start(steps, k);
            let end = min(cloud_cell_start(steps, k + 1u), whole);
            if span.x + start >= far || marched.transmittance < quality.least {
                break;
            }
            let length = min(span.x + end, far) - max(span.x + start, near);
            let middle = span.x + 0.5 * (start + end);
            k += 1u;
            if length <= 0.0 {
                continue;
            }
            let empty = cloud_empty_until(cloud, ray, middle);
            if empty > middle {
                k = max(k, cloud_cell(steps, max(empty - span.x, 0.0)));
                continue;
            }
            let point = cloud_point(ray, middle);
            let density = cloud_density(cloud, point, cloud_weather(cloud, point.at));
            let extinction = cloud.extinction * density;
            if extinction <= 0.0 {
                marched.samples += 1u;
                continue;
            }
            let front = span.x + start + (end - start) * cloud_seen_at(extinction * (end - start));
            let towards_sun = CloudRay(cloud_point(ray, front), sun, ray.radius);
            let depth = cloud_sun_depth(cloud, towards_sun, quality.sun_samples, quality.reach);
            let source = cloud_source(cloud.phase, nu, depth, density, quality.octaves);
            marched = cloud_passed(marched, extinction, vec3<f32>(source, 1.0, 0.0), length, middle);
        }
    }
    return marched;
}
