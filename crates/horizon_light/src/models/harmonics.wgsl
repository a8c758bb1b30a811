// Real spherical harmonics up to degree 2 that are even in azimuth from the sun: of a direction with cosine mu to the vertical and
// component x along the sun's azimuth. The twin of moments.rs.

fn harmonics(mu: f32, x: f32) -> array<f32, 6> {
    let square = max((1.0 - mu) * (1.0 + mu) - x * x, 0.0);
    return array(
        0.282094792,
        0.488602512 * mu,
        0.488602512 * x,
        0.315391565 * (3.0 * mu * mu - 1.0),
        1.09254843 * mu * x,
        0.546274215 * (x * x - square),
    );
}
