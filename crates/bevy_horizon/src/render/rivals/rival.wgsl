// The ground by a rival's march: the full field at every step, and once more for the normal. Needs a kernel of height() in
// group 1, view.wgsl and the rivals' methods.wgsl.

struct Rival {
    // 0: fixed step, 1: linear interpolation, 2: sphere tracing.
    kind: u32,
    bisections: u32,
    // Nothing of the ground is higher, or steeper.
    high: f32,
    slope: f32,
    // a, b and c; or the step per metre; or the over-relaxation and the radius per metre.
    numbers: vec4<f32>,
}

@group(0) @binding(0) var<uniform> view: HorizonView;
@group(0) @binding(1) var<uniform> rival: Rival;

fn ground(p: vec2<f32>) -> f32 {
    return height(0u, p, 0.0).x;
}

struct Ground {
    @location(0) colour: vec4<f32>,
    @builtin(frag_depth) depth: f32,
}

@fragment
fn draw(@builtin(position) position: vec4<f32>) -> Ground {
    let near = view_point(ndc_of(position), 1.0);
    let local = normalize(near);
    let direction = world_direction(local);
    let n = rival.numbers;
    var traced: Traced;
    switch rival.kind {
        case 0u: {
            traced = march_fixed(view.eye, direction, length(near), view.far, rival.high, n.x, n.y, n.z, rival.bisections);
        }
        case 1u: {
            traced = march_linear(view.eye, direction, length(near), view.far, rival.high, n.x);
        }
        default: {
            traced = march_sphere(view.eye, direction, length(near), view.far, rival.high, rival.slope, n.y, n.x);
        }
    }
    if (view.debug == 9u) {
        // Numbers, for programs to read: evaluations, the normal's included.
        return Ground(vec4<f32>(f32(traced.evaluations + select(0u, 1u, traced.t >= 0.0)), 0.0, 0.0, 1.0), 1e-6);
    }
    if (traced.t < 0.0) {
        discard;
    }
    let gradient = height(0u, (view.eye + traced.t * direction).xz, 0.0).yz;
    let normal = vec3<f32>(-gradient.x, 1.0, -gradient.y) * inverseSqrt(1.0 + dot(gradient, gradient));
    let light = view.sun * max(dot(normal, view.sun_direction), 0.0) / 3.14159265 + view.ambient;
    let clip = view.clip_from_view * vec4<f32>(0.0, 0.0, local.z * traced.t, 1.0);
    return Ground(vec4<f32>(0.2 * light * view.exposure, 1.0), clip.z / clip.w);
}
