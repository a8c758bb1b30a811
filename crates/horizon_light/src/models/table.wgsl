// Tables of two coordinates, with their texels at the ends of the range too, interpolated linearly; the twin of table.rs.

struct Cell {
    // The texel before the coordinates, and how far they are on to the next ones.
    first: vec2<u32>,
    part: vec2<f32>,
}

fn cell(uv: vec2<f32>, size: vec2<u32>) -> Cell {
    let at = clamp(uv, vec2(0.0), vec2(1.0)) * vec2<f32>(size - 1u);
    let first = min(floor(at), vec2<f32>(size - 2u));
    return Cell(vec2<u32>(first), at - first);
}

// Of the texels at first, first + x, first + y, first + x + y.
fn bilinear(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, d: vec3<f32>, part: vec2<f32>) -> vec3<f32> {
    return mix(mix(a, b, part.x), mix(c, d, part.x), part.y);
}

fn coordinate(texel: vec2<u32>, size: vec2<u32>) -> vec2<f32> {
    return vec2<f32>(texel) / vec2<f32>(size - 1u);
}
