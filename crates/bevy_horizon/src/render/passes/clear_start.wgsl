// Where a ray starts: behind all the air that the clearance table (clearance.wgsl) proves empty. Needs view.wgsl.

// The distance up to which the ray is clear; 1e30 where it never meets the ground.
fn clear_until(direction: vec3<f32>) -> f32 {
    if (view.columns.y == 0u) {
        return 0.0;
    }
    let a = abs(direction.xz);
    let along_x = a.x >= a.y;
    let major = max(max(a.x, a.y), 1e-20);
    // Quadrants 0 to 3 lie around +x, +z, −x, −z.
    let toward = select(direction.z, direction.x, along_x);
    let quadrant = select(1u, 0u, along_x) + select(2u, 0u, toward > 0.0);
    let s = select(-direction.x, direction.z, along_x) / select(toward, select(-1e-20, 1e-20, toward > 0.0), abs(toward) < 1e-20);
    let per_quadrant = view.columns.z;
    let within = min(u32(0.5 * (s + 1.0) * f32(per_quadrant)), per_quadrant - 1u);
    let all = 4u * per_quadrant;
    let column = (quadrant * per_quadrant + within + all - view.columns.x) % all;
    let bin = floor((direction.y / (major + abs(direction.y)) - view.slopes.x) * view.slopes.y);
    if (column >= view.columns.y || bin < 0.0) {
        return 0.0;
    }
    return clearance[column * BINS + min(u32(bin), BINS - 1u)] / major;
}
