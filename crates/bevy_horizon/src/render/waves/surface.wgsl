// What stands over each texel of the plane, and how steep it is. horizon_field's resolve.rs says how, and is the twin, with tiles.rs.
// Needs bindings.wgsl.

// Height, displacement along x and z; and how these change from texel to texel.
struct Water {
    value: vec3<f32>,
    along: vec3<f32>,
    across: vec3<f32>,
}

// The grid goes on across its edge.
fn water_at(layer: u32, at: vec2<i32>) -> vec3<f32> {
    let wrapped = vec2<u32>(at) & vec2<u32>(GRID - 1u);
    return grid[(layer * GRID + wrapped.y) * GRID + wrapped.x].xyz;
}

fn linear_water(layer: u32, at: vec2<f32>) -> Water {
    let first = vec2<i32>(floor(at));
    let t = at - floor(at);
    let a = water_at(layer, first);
    let b = water_at(layer, first + vec2<i32>(1, 0));
    let c = water_at(layer, first + vec2<i32>(0, 1));
    let d = water_at(layer, first + vec2<i32>(1, 1));
    let row = a + t.x * (b - a);
    let next = c + t.x * (d - c);
    return Water(row + t.y * (next - row), (b - a) + t.y * ((d - c) - (b - a)), next - row);
}

// Catmull and Rom's weights of four texels.
fn weights(t: f32) -> vec4<f32> {
    return vec4<f32>(
        0.5 * t * (t * (2.0 - t) - 1.0),
        1.0 + 0.5 * t * t * (3.0 * t - 5.0),
        0.5 * t * (1.0 + t * (4.0 - 3.0 * t)),
        0.5 * t * t * (t - 1.0),
    );
}

fn weight_slopes(t: f32) -> vec4<f32> {
    return vec4<f32>(
        t * (2.0 - 1.5 * t) - 0.5,
        t * (4.5 * t - 5.0),
        0.5 + t * (4.0 - 4.5 * t),
        t * (1.5 * t - 1.0),
    );
}

fn cubic_water(layer: u32, at: vec2<f32>) -> Water {
    let first = vec2<i32>(floor(at)) - vec2<i32>(1);
    let t = at - floor(at);
    let x = weights(t.x);
    let x_slopes = weight_slopes(t.x);
    var z = weights(t.y);
    var z_slopes = weight_slopes(t.y);
    var sum = Water(vec3<f32>(0.0), vec3<f32>(0.0), vec3<f32>(0.0));
    for (var row = 0; row < 4; row++) {
        let a = water_at(layer, first + vec2<i32>(0, row));
        let b = water_at(layer, first + vec2<i32>(1, row));
        let c = water_at(layer, first + vec2<i32>(2, row));
        let d = water_at(layer, first + vec2<i32>(3, row));
        let value = x.x * a + x.y * b + x.z * c + x.w * d;
        sum.value += z.x * value;
        sum.along += z.x * (x_slopes.x * a + x_slopes.y * b + x_slopes.z * c + x_slopes.w * d);
        sum.across += z_slopes.x * value;
        z = z.yzwx;
        z_slopes = z_slopes.yzwx;
    }
    return sum;
}

// Newton's step from a point of the water, and the determinant of 1 + ∇D. `at` is in texels, `per` texels to a metre.
fn newton(water: Water, at: vec2<f32>, over_texel: vec2<f32>, per: f32) -> vec3<f32> {
    let off = at + water.value.yz * per - over_texel;
    let a = 1.0 + water.along.y * per;
    let b = water.across.y * per;
    let c = water.along.z * per;
    let d = 1.0 + water.across.z * per;
    let determinant = a * d - b * c;
    let step = vec2<f32>(b * off.y - d * off.x, c * off.x - a * off.y) / max(determinant, LEAST_DETERMINANT);
    return vec3<f32>(clamp(step, vec2<f32>(-FARTHEST_STEP), vec2<f32>(FARTHEST_STEP)), determinant);
}

@compute @workgroup_size(8, 8, 1)
fn sea_over(@builtin(global_invocation_id) id: vec3<u32>) {
    let layer = layers[id.z];
    let per = 1.0 / layer.texel;
    let texel = vec2<f32>(id.xy);
    var at = texel;
    for (var i = 0u; i < LINEAR_STEPS; i++) {
        at += newton(linear_water(id.z, at), at, texel, per).xy;
    }
    let water = cubic_water(id.z, at);
    let last = newton(water, at, texel, per);
    let height = water.value.x + water.along.x * last.x + water.across.x * last.y;
    over[(id.z * GRID + id.y) * GRID + id.x] =
        vec2<f32>(clamp(height, -layer.bound, layer.bound), clamp(1.0 - last.z, 0.0, 1.0));
}

@group(1) @binding(0) var surface: texture_storage_2d_array<rgba16float, write>;
@group(1) @binding(1) var moments: texture_storage_2d_array<rgba16float, write>;

fn height_over(layer: u32, at: vec2<u32>) -> f32 {
    let wrapped = at & vec2<u32>(GRID - 1u);
    return over[(layer * GRID + wrapped.y) * GRID + wrapped.x].x;
}

// By central differences of the fourth order, along an axis.
fn slope_over(layer: u32, at: vec2<u32>, axis: vec2<u32>) -> f32 {
    let near = height_over(layer, at + axis) - height_over(layer, at + (GRID - 1u) * axis);
    let far = height_over(layer, at + 2u * axis) - height_over(layer, at + (GRID - 2u) * axis);
    return clamp((8.0 * near - far) / (12.0 * layers[layer].texel), -STEEPEST, STEEPEST);
}

@compute @workgroup_size(8, 8, 1)
fn sea_texels(@builtin(global_invocation_id) id: vec3<u32>) {
    let here = over[(id.z * GRID + id.y) * GRID + id.x];
    let x = slope_over(id.z, id.xy, vec2<u32>(1u, 0u));
    let z = slope_over(id.z, id.xy, vec2<u32>(0u, 1u));
    textureStore(surface, id.xy, id.z, vec4<f32>(here.x, x, z, here.y));
    textureStore(moments, id.xy, id.z, vec4<f32>(x * x, z * z, x * z, here.x * here.x));
}
