// What drawing with moments.wgsl and each pass that makes its table share; the twin of moments.rs, where the reasons stand. The first
// pass goes with once.wgsl, `sunlit`; further ones with moments.wgsl, not `sunlit`.

// Texels over the sun's height, and over altitude.
const MOMENTS_SIZE: vec2<u32> = vec2(32u, 12u);
const MOMENTS_STEPS: u32 = 8u;
// Passes after the first.
const MOMENTS_PASSES: u32 = 2u;

fn sun_coordinate(air: Medium, mu_s: f32) -> f32 {
    let night = sqrt(-air.night);
    let root = sqrt(abs(mu_s));
    return (select(root, -root, mu_s < 0.0) + night) / (1.0 + night);
}

fn sun_cosine(air: Medium, u: f32) -> f32 {
    let night = sqrt(-air.night);
    let root = u * (1.0 + night) - night;
    return clamp(root * abs(root), -1.0, 1.0);
}

// Cosines and sines of the angles that part the 45 degrees of a direction evenly.
const MOMENTS_FAN: array<vec2<f32>, 4> = array(
    vec2(0.95694035, -0.29028466),
    vec2(0.9951847, -0.09801714),
    vec2(0.9951847, 0.09801714),
    vec2(0.95694035, 0.29028466),
);

// What one of a texel's directions brings to its moments: their sum over DIRECTIONS is the texel of this order.
fn moments_direction(air: Medium, texel: vec2<u32>, index: u32, sunlit: bool) -> array<vec3<f32>, 6> {
    let uv = coordinate(texel, MOMENTS_SIZE);
    let d = direction(air, uv.y * uv.y * air.height, sun_cosine(air, uv.x), index);
    let light = gather_all(air, d.view, d.distance, d.ground, MOMENTS_STEPS, sunlit);
    let soft = light.soft * d.weight;
    let y = harmonics(d.view.mu, d.sunward);
    var sum = array(soft * y[0], soft * y[1], soft * y[2], soft * y[3], soft * y[4], soft * y[5]);
    if sunlit {
        let run = sine(d.view.mu);
        let aside = sqrt(max(run * run - d.sunward * d.sunward, 0.0));
        var fan = MOMENTS_FAN;
        for (var i = 0u; i < 4u; i += 1u) {
            let x = d.sunward * fan[i].x - aside * fan[i].y;
            let nu = clamp(d.view.mu * d.view.mu_s + x * sine(d.view.mu_s), -1.0, 1.0);
            let mie = light.mie * (d.weight * 0.25 * mie_phase(air.mie_asymmetry, nu));
            let z = harmonics(d.view.mu, x);
            for (var k = 0u; k < 6u; k += 1u) {
                sum[k] += mie * z[k];
            }
        }
    }
    return sum;
}

// All of a texel's directions, by one invocation.
fn moments_compute(air: Medium, texel: vec2<u32>, sunlit: bool) -> array<vec3<f32>, 6> {
    var sum = array<vec3<f32>, 6>();
    for (var i = 0u; i < DIRECTIONS; i += 1u) {
        let part = moments_direction(air, texel, i, sunlit);
        for (var k = 0u; k < 6u; k += 1u) {
            sum[k] += part[k];
        }
    }
    return sum;
}

// What to multiply the last order by when it joins the sum, so that all further ones are in it, from harmonic 0 of the last two.
fn geometric_series(before: vec3<f32>, last: vec3<f32>) -> vec3<f32> {
    let ratio = select(vec3(0.0), clamp(last / max(before, vec3(1e-37)), vec3(0.0), vec3(0.95)), before > vec3(0.0));
    return 1.0 / (1.0 - ratio);
}
