// The weights of a triplanar projection; the twin of `weights` in eval.rs. Each is (value, gradient).

struct TriplanarWeights {
    x: vec4<f32>,
    y: vec4<f32>,
    z: vec4<f32>,
}

fn triplanar_weights(p: vec3<f32>, sharpness: u32) -> TriplanarWeights {
    let largest = max(abs(p.x), max(abs(p.y), abs(p.z)));
    if largest <= 0.0 {
        let third = vec4<f32>(1.0 / 3.0, 0.0, 0.0, 0.0);
        return TriplanarWeights(third, third, third);
    }
    let inverse = 1.0 / largest;
    let a = abs(p) * inverse;
    var power = vec3<f32>(1.0);
    for (var i = 1u; i < min(sharpness, 16u); i++) {
        power = power * a;
    }
    let slope = f32(sharpness) * power * select(vec3<f32>(inverse), vec3<f32>(-inverse), p < vec3<f32>(0.0));
    let powers = power * a;
    let share = 1.0 / (powers.x + powers.y + powers.z);
    let v = powers * share;
    return TriplanarWeights(
        vec4<f32>(v.x, (vec3<f32>(1.0, 0.0, 0.0) - v.x) * slope * share),
        vec4<f32>(v.y, (vec3<f32>(0.0, 1.0, 0.0) - v.y) * slope * share),
        vec4<f32>(v.z, (vec3<f32>(0.0, 0.0, 1.0) - v.z) * slope * share));
}
