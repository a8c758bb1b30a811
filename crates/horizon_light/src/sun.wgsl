// The sun's disc: the twin of `sun.rs`, which derives it. u = sin²θ / sin²α: square of the sine of the angle from the
// disc's centre, over that of its radius.

const SUN_MEAN = array<f32, 6>(1.0, 0.66666667, 0.5, 0.4, 0.33333333, 0.28571429);
const SUN_CHORD = array<f32, 6>(2.0, 1.57079633, 1.33333333, 1.17809725, 1.06666667, 0.98174770);
const SUN_SOFTEST: f32 = 0.00390625;
const SUN_PI: f32 = 3.14159265;

struct SunDisc {
    // Luminance at the centre, above the air.
    center: vec3<f32>,
    // Sine of the angular radius.
    sine: f32,
    // Coefficients of each channel's limb law.
    limb: array<vec3<f32>, 6>,
}

// The part of the disc's light from its centre to u, over the centre's luminance; odd in u.
fn sun_gathered(disc: SunDisc, u: f32) -> vec3<f32> {
    let rest = max(1.0 - abs(u), 0.0);
    let mu = sqrt(rest);
    let a0 = disc.limb[0] * SUN_MEAN[0];
    let a1 = disc.limb[1] * SUN_MEAN[1];
    let a2 = disc.limb[2] * SUN_MEAN[2];
    let a3 = disc.limb[3] * SUN_MEAN[3];
    let a4 = disc.limb[4] * SUN_MEAN[4];
    let a5 = disc.limb[5] * SUN_MEAN[5];
    let total = a0 + a1 + a2 + a3 + a4 + a5;
    let outside = ((((a5 * mu + a4) * mu + a3) * mu + a2) * mu + a1) * mu + a0;
    let inside = total - outside * rest;
    return select(inside, -inside, u < 0.0);
}

// Luminance in the direction `view` of a star at `sun`, both of length 1, as a pixel `pixel` radians wide sees it.
fn sun_luminance(disc: SunDisc, view: vec3<f32>, sun: vec3<f32>, pixel: f32) -> vec3<f32> {
    let between = view - sun;
    let chord = dot(between, between);
    let t = max(pixel, 0.0) / (2.0 * disc.sine);
    let width = max(t * (2.0 + t), SUN_SOFTEST);
    let u = chord * (1.0 - 0.25 * chord) / (disc.sine * disc.sine);
    if chord > 2.0 || u >= 1.0 + width {
        return vec3<f32>(0.0);
    }
    let mean = (sun_gathered(disc, u + width) - sun_gathered(disc, u - width)) / (2.0 * width);
    return disc.center * max(mean, vec3<f32>(0.0));
}

// Which part of the star's light comes over a straight horizon; `elevation` is the sine of the angle above it.
fn sun_visible(disc: SunDisc, elevation: f32) -> vec3<f32> {
    let x = clamp(elevation / disc.sine, -1.0, 1.0);
    let s2 = (1.0 - x) * (1.0 + x);
    let s = sqrt(s2);
    let n1 = (x * s + acos(-x)) / 2.0;
    let n2 = (x * s2 + 2.0 * (1.0 + x)) / 3.0;
    let n3 = (x * s * s2 + 3.0 * n1) / 4.0;
    let n4 = (x * s2 * s2 + 4.0 * n2) / 5.0;
    let n5 = (x * s * s2 * s2 + 5.0 * n3) / 6.0;
    let n6 = (x * s2 * s2 * s2 + 6.0 * n4) / 7.0;
    let seen = disc.limb[0] * (SUN_CHORD[0] * n1) + disc.limb[1] * (SUN_CHORD[1] * n2) + disc.limb[2] * (SUN_CHORD[2] * n3)
        + disc.limb[3] * (SUN_CHORD[3] * n4) + disc.limb[4] * (SUN_CHORD[4] * n5) + disc.limb[5] * (SUN_CHORD[5] * n6);
    // Above the air no light is lost: 1 at x = 1, by the same sums.
    return clamp(seen / (SUN_PI * sun_gathered(disc, 1.0)), vec3<f32>(0.0), vec3<f32>(1.0));
}

// Sine of the sun's angle above the horizon of a sphere of radius `radius`, at altitude h.
fn sun_above_horizon(mu_s: f32, h: f32, radius: f32) -> f32 {
    let r = radius + h;
    let dip = sqrt(max(h * (radius + r), 0.0)) / r;
    let sin_s = sqrt(max((1.0 - mu_s) * (1.0 + mu_s), 0.0));
    let sum = mu_s * (radius / r) + sin_s * dip;
    return select(sum, max(max(sum, mu_s), dip), mu_s > 0.0);
}
