// How much the slope grows over `scale` metres: the Laplacian times that, by differences of gradients over the scale, or
// over the cut-off where that is longer. Waves that these differences can't show are left out. Above 0 in hollows.
fn material_curvature(anchor: u32, q: vec2<f32>, scale: f32, cutoff: f32) -> f32 {
    let span = max(scale, cutoff);
    var sum = 0.0;
    for (var i = 0u; i < 4u; i++) {
        let side = select(-1.0, 1.0, (i & 1u) == 0u);
        let axis = select(vec2<f32>(0.0, side), vec2<f32>(side, 0.0), i < 2u);
        sum += dot(axis, height(anchor, q + (0.5 * span) * axis, span).yz);
    }
    return sum * (scale / span);
}
