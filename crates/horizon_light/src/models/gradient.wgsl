// The cheapest sky: the twin of `gradient.rs`, which says where its numbers come from.

const GRADIENT_SUNSET: f32 = 0.049079754601226995;
const GRADIENT_FADE: f32 = 54.0;
const GRADIENT_LOW: f32 = 0.15;

// Linear sRGB in cd/m².
struct GradientSky {
    zenith: vec3<f32>,
    // Per metre.
    haze: f32,
    horizon: vec3<f32>,
    night: f32,
    sunset: vec3<f32>,
}

// Luminance of the sky; mu and mu_s are the heights of view and sun over the level, nu the cosine between them.
fn gradient_luminance(sky: GradientSky, mu: f32, mu_s: f32, nu: f32) -> vec3<f32> {
    let by_day = GRADIENT_SUNSET + (1.0 - GRADIENT_SUNSET) * sqrt(max(mu_s, 0.0));
    let by_night = GRADIENT_SUNSET * exp(GRADIENT_FADE * min(mu_s, 0.0));
    let day = select(by_night, by_day, mu_s > 0.0);
    let low = mu_s / GRADIENT_LOW;
    let towards = 0.5 * (1.0 + nu);
    let warm = exp(-low * low) * towards * towards;
    let over = 1.0 - clamp(mu, 0.0, 1.0);
    let horizon = mix(sky.horizon, sky.sunset, warm);
    return mix(sky.zenith, horizon, over * over) * day + vec3<f32>(sky.night);
}

// How much of a thing's light comes through so many metres of haze.
fn gradient_transmittance(sky: GradientSky, distance: f32) -> f32 {
    return exp(-sky.haze * distance);
}
