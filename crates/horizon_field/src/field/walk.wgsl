// How nodes combine; the twin of what walk.rs and eval.rs do with jets. All quantities are (value, gradient).

fn field_product2(a: vec3<f32>, b: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(a.x * b.x, a.x * b.yz + b.x * a.yz);
}

fn field_product3(a: vec4<f32>, b: vec4<f32>) -> vec4<f32> {
    return vec4<f32>(a.x * b.x, a.x * b.yzw + b.x * a.yzw);
}

// A curve's (value, slope) at a.x.
fn field_curved2(a: vec3<f32>, curve: vec2<f32>) -> vec3<f32> {
    return vec3<f32>(curve.x, curve.y * a.yz);
}

fn field_curved3(a: vec4<f32>, curve: vec2<f32>) -> vec4<f32> {
    return vec4<f32>(curve.x, curve.y * a.yzw);
}
