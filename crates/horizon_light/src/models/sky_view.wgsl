// The sky all round a camera inside the air as a table; the twin of sky_view.rs, where the reasons stand. The host declares
// fn sky_view_texel(x: u32, y: u32, layer: u32) -> vec3<f32>, which sky_view_compute.wgsl fills: layer 0 with soft light, 1 with that of
// aerosols, without its phase. Its rows are those above the horizon, from it on, then those below, from it on.

const SKY_VIEW_AZIMUTHS: u32 = 48u;
const SKY_VIEW_ABOVE: u32 = 48u;
const SKY_VIEW_BELOW: u32 = 24u;

fn sky_view_layer(c: Cell, first_row: u32, layer: u32) -> vec3<f32> {
    let y = c.first.y + first_row;
    return bilinear(
        sky_view_texel(c.first.x, y, layer),
        sky_view_texel(c.first.x + 1u, y, layer),
        sky_view_texel(c.first.x, y + 1u, layer),
        sky_view_texel(c.first.x + 1u, y + 1u, layer),
        c.part,
    );
}

// Radiance of the sky, or of the bare ground, for a ray from the table's own altitude and sun.
fn sky_view_radiance(air: Medium, view: SkyRay) -> vec3<f32> {
    let ground = hits_ground(air.radius, view.h, view.mu);
    let rows = select(SKY_VIEW_ABOVE, SKY_VIEW_BELOW, ground);
    let c = cell(sky_view_coordinates(air, view, ground), vec2(SKY_VIEW_AZIMUTHS, rows));
    let first_row = select(0u, SKY_VIEW_ABOVE, ground);
    let mie = sky_view_layer(c, first_row, 1u);
    return sky_view_layer(c, first_row, 0u) + mie * mie_phase(air.mie_asymmetry, view.nu);
}

fn sky_view_coordinates(air: Medium, view: SkyRay, ground: bool) -> vec2<f32> {
    let horizon = horizon_cosine(air.radius, view.h);
    let sign = select(1.0, -1.0, ground);
    let span = 1.0 - sign * horizon;
    let w = sqrt(max((1.0 - sign * view.mu) / span, 0.0));
    let gap = sign * (view.mu - horizon) / (span * (1.0 + w));
    let run = sine(view.mu);
    var azimuth = 1.0;
    if run > 0.0 {
        azimuth = sunward(view.mu, view.mu_s, view.nu) / run;
    }
    return vec2(sqrt(max(0.5 * (1.0 - azimuth), 0.0)), sqrt(max(gap, 0.0)));
}

// The ray of the table's coordinates, on its half above or below the horizon.
fn sky_view_ray(air: Medium, h: f32, mu_s: f32, ground: bool, uv: vec2<f32>) -> SkyRay {
    let horizon = horizon_cosine(air.radius, h);
    let gap = uv.y * uv.y;
    let rise = gap * (2.0 - gap);
    let sign = select(1.0, -1.0, ground);
    let mu = horizon + (sign - horizon) * rise;
    let azimuth = 1.0 - 2.0 * uv.x * uv.x;
    return SkyRay(h, mu, mu_s, clamp(mu * mu_s + sine(mu) * sine(mu_s) * azimuth, -1.0, 1.0));
}
