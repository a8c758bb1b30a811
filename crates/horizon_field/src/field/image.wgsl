// Height images as uniform cubic B-splines; the twin of image.rs. field_images holds two texels a word.

struct HeightImage {
    // The first word.
    first: u32,
    // Texels along x and z.
    size: vec2<i32>,
    // 0 clamp, 1 mirror, 2 repeat.
    edge: u32,
}

// The cell (hi, lo) modulo n < 2^15, as if floored: the words' remainders, recombined.
fn image_modulo(lo: u32, hi: u32, n: i32) -> i32 {
    let m = u32(n);
    let high = bitcast<i32>(hi) % n;
    let base = (0xffffffffu % m + 1u) % m;
    let above = u32(select(high, high + n, high < 0));
    return i32((above * base + lo % m) % m);
}

// The texel of coordinate (hi, lo) + k on an axis of n texels.
fn image_index(lo: u32, hi: u32, k: i32, n: i32, edge: u32) -> i32 {
    if edge == 0u {
        let small = bitcast<i32>(lo);
        let fits = bitcast<i32>(hi) == (small >> 31u) && abs(small) < 0x40000000;
        let far = select(0x40000000, -0x40000000, bitcast<i32>(hi) < 0);
        return clamp(select(far, small, fits) + k, 0, n - 1);
    }
    let period = select(n, 2 * n, edge == 1u);
    let i = (image_modulo(lo, hi, period) + k + 2 * period) % period;
    return select(i, min(i, period - 1 - i), edge == 1u);
}

fn image_texel(image: HeightImage, column: i32, row: i32) -> f32 {
    let texel = u32(row * image.size.x + column);
    let word = field_images[image.first + (texel >> 1u)];
    return f32((word >> ((texel & 1u) * 16u)) & 0xffffu);
}

fn image_weights(t: f32) -> vec4<f32> {
    let s = 1.0 - t;
    return vec4<f32>(s * s * s, t * t * (3.0 * t - 6.0) + 4.0, s * s * (3.0 * s - 6.0) + 4.0, t * t * t) * (1.0 / 6.0);
}

fn image_slopes(t: f32) -> vec4<f32> {
    let s = 1.0 - t;
    return vec4<f32>(-(s * s), t * (3.0 * t - 4.0), -(s * (3.0 * s - 4.0)), t * t) * 0.5;
}

// The value, in [0, 1], and the gradient per texel.
fn image2(p: LatticePoint2, image: HeightImage) -> vec3<f32> {
    let wx = image_weights(p.fraction.x);
    let dx = image_slopes(p.fraction.x);
    let wz = image_weights(p.fraction.y);
    let dz = image_slopes(p.fraction.y);
    let c0 = image_index(p.lo.x, p.hi.x, -1, image.size.x, image.edge);
    let c1 = image_index(p.lo.x, p.hi.x, 0, image.size.x, image.edge);
    let c2 = image_index(p.lo.x, p.hi.x, 1, image.size.x, image.edge);
    let c3 = image_index(p.lo.x, p.hi.x, 2, image.size.x, image.edge);
    var sum = vec3<f32>(0.0);
    for (var j = 0; j < 4; j++) {
        let row = image_index(p.lo.y, p.hi.y, j - 1, image.size.y, image.edge);
        let texels = vec4<f32>(
            image_texel(image, c0, row),
            image_texel(image, c1, row),
            image_texel(image, c2, row),
            image_texel(image, c3, row));
        let v = dot(wx, texels);
        sum += vec3<f32>(wz[j] * v, wz[j] * dot(dx, texels), dz[j] * v);
    }
    return sum * (1.0 / 65535.0);
}
