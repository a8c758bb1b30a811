// The simplest air. Needs horizon_light's gradient.wgsl.

struct GradientAir {
    sky: GradientSky,
    // Extinction at the datum, per metre.
    haze: f32,
    // Metres over which the haze thins by e.
    haze_height: f32,
    // Cosine of the sun's angular radius; luminance of its disc, in cd/m².
    sun_cosine: f32,
    sun_luminance: f32,
}
