// Noise that comes again after `period` lattice cells, at u periods in [0, 1)^3; the twin of periodic.rs. Values only.

// The hash of an axis at cell + i, which comes again. period is at least 1, cell + i at least -1.
fn periodic_axis(cell: i32, period: u32, seed: u32) -> u32 {
    return hash_axis(u32(cell + i32(period)) % period, 0u, seed);
}

fn gradient3_periodic(u: vec3<f32>, period: u32, seed: u32) -> f32 {
    let p = u * f32(period);
    let cell = vec3<i32>(floor(p));
    let f = p - floor(p);
    let r = f - 1.0;
    let t = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    let dt = vec3<f32>(0.0);
    let x0 = periodic_axis(cell.x, period, hash_axis_seed(seed, 0u));
    let x1 = periodic_axis(cell.x + 1, period, hash_axis_seed(seed, 0u));
    let y0 = periodic_axis(cell.y, period, hash_axis_seed(seed, 1u));
    let y1 = periodic_axis(cell.y + 1, period, hash_axis_seed(seed, 1u));
    let z0 = periodic_axis(cell.z, period, hash_axis_seed(seed, 2u));
    let z1 = periodic_axis(cell.z + 1, period, hash_axis_seed(seed, 2u));
    let near = gradient_layer(x0, x1, y0, y1, z0, f.xy, f.z, t, dt).x;
    let far = gradient_layer(x0, x1, y0, y1, z1, f.xy, r.z, t, dt).x;
    return (near + t.z * (far - near)) * (2.0 / 3.0);
}

fn worley3_periodic(u: vec3<f32>, period: u32, seed: u32) -> f32 {
    let p = u * f32(period);
    let cell = vec3<i32>(floor(p));
    let f = p - floor(p);
    var nearest = vec4<f32>(0.0, 0.0, 0.0, 100.0);
    for (var k = 0; k < 3; k++) {
        let hash_z = periodic_axis(cell.z + k - 1, period, hash_axis_seed(seed, 2u));
        for (var j = 0; j < 3; j++) {
            let hash_y = periodic_axis(cell.y + j - 1, period, hash_axis_seed(seed, 1u));
            for (var i = 0; i < 3; i++) {
                let hash_x = periodic_axis(cell.x + i - 1, period, hash_axis_seed(seed, 0u));
                let centre = vec3<f32>(f32(i), f32(j), f32(k)) - 0.5;
                nearest = worley_offer3(nearest, f, centre, hash_mix3(hash_x, hash_y, hash_z));
            }
        }
    }
    return sqrt(nearest.w) * WORLEY_SLOPE3 - 1.0;
}
