// Functions of one number, which shape heights; the twin of curve.rs. Each returns (value, slope).

fn curve_clamp(u: f32, low: f32, high: f32) -> vec2<f32> {
    return vec2<f32>(clamp(u, low, high), select(0.0, 1.0, u > low && u < high));
}

fn curve_ramp(u: f32, low: f32, inverse: f32) -> vec2<f32> {
    let t = (u - low) * inverse;
    return vec2<f32>(clamp(t, 0.0, 1.0), select(0.0, inverse, t > 0.0 && t < 1.0));
}

fn curve_step(u: f32, low: f32, inverse: f32) -> vec2<f32> {
    let t = clamp((u - low) * inverse, 0.0, 1.0);
    return vec2<f32>(t * t * (3.0 - 2.0 * t), 6.0 * t * (1.0 - t) * inverse);
}

fn curve_terrace(u: f32, step: f32, inverse: f32, sharpness: f32) -> vec2<f32> {
    let t = u * inverse;
    let k = floor(t);
    let f = t - k;
    let shaped = f + sharpness * (f * f * (3.0 - 2.0 * f) - f);
    return vec2<f32>((k + shaped) * step, 1.0 + sharpness * (6.0 * f * (1.0 - f) - 1.0));
}

fn curve_round(u: f32, radius: f32, quarter: f32) -> vec2<f32> {
    let left = radius - u;
    if u <= -radius {
        return vec2<f32>(u, 1.0);
    }
    if u >= radius {
        return vec2<f32>(0.0);
    }
    return vec2<f32>(-(left * left * quarter), 2.0 * left * quarter);
}
