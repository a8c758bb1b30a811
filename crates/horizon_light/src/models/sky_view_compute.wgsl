// How the sky view is made; the twin of sky_view.rs, where the reasons stand. Goes with sky_view.wgsl.

// What the table holds at a texel: its two layers.
fn sky_view_compute(air: Medium, h: f32, mu_s: f32, texel: vec2<u32>, count: u32) -> Scattered {
    let ground = texel.y >= SKY_VIEW_ABOVE;
    let rows = select(SKY_VIEW_ABOVE, SKY_VIEW_BELOW, ground);
    let row = texel.y - select(0u, SKY_VIEW_ABOVE, ground);
    let view = sky_view_ray(air, h, mu_s, ground, coordinate(vec2(texel.x, row), vec2(SKY_VIEW_AZIMUTHS, rows)));
    var distance = distance_to_top(air.radius, air.height, h, view.mu);
    if ground {
        distance = distance_to_ground(air.radius, h, view.mu);
    }
    return gather_all(air, view, distance, ground, count, true);
}
