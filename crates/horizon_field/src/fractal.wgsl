// Fractal sums of octaves; the twin of fractal.rs, which states the recurrences. All quantities are (value, gradient).
// A loop calls `<rule>_start`, then `<rule>_step` once for each octave: n is its noise, w its weight gain^i, fade its
// fade in [0, 1]; offset is Musgrave's. The result is `state.result`.

const FRACTAL_RIDGE_GAIN: f32 = 2.0;

// How much of a wavelength shows on a grid of spacing `cutoff`; all of it where the cut-off is 0.
fn fractal_fade(wavelength: f32, cutoff: f32) -> f32 {
    return clamp(wavelength / max(cutoff, 1e-20) - 1.0, 0.0, 1.0);
}

struct FractalState2 {
    result: vec3<f32>,
    weight: vec3<f32>,
}

fn fractal_constant2(v: f32) -> vec3<f32> {
    return vec3<f32>(v, 0.0, 0.0);
}

fn fractal_product2(a: vec3<f32>, b: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(a.x * b.x, a.x * b.yz + b.x * a.yz);
}

fn fractal_at_most_one2(a: vec3<f32>) -> vec3<f32> {
    return select(fractal_constant2(1.0), a, a.x < 1.0);
}

// The state with one more contribution and the next weight, both faded.
fn fractal_next2(state: FractalState2, contribution: vec3<f32>, weight: vec3<f32>, fade: f32) -> FractalState2 {
    return FractalState2(state.result + contribution * fade, state.weight * (1.0 - fade) + weight * fade);
}

fn fbm_start2(offset: f32) -> FractalState2 {
    return FractalState2(fractal_constant2(0.0), fractal_constant2(1.0));
}

fn fbm_step2(state: FractalState2, n: vec3<f32>, w: f32, offset: f32, fade: f32) -> FractalState2 {
    return FractalState2(state.result + n * (w * fade), state.weight);
}

fn heterogeneous_start2(offset: f32) -> FractalState2 {
    return FractalState2(fractal_constant2(offset), fractal_constant2(1.0 + offset));
}

fn heterogeneous_step2(state: FractalState2, n: vec3<f32>, w: f32, offset: f32, fade: f32) -> FractalState2 {
    let contribution = fractal_product2(n, state.weight) * (w / (1.0 + w * offset));
    return fractal_next2(state, contribution, state.result + contribution, fade);
}

fn hybrid_start2(offset: f32) -> FractalState2 {
    return FractalState2(fractal_constant2(0.0), fractal_constant2(1.0));
}

fn hybrid_step2(state: FractalState2, n: vec3<f32>, w: f32, offset: f32, fade: f32) -> FractalState2 {
    let share = (n + fractal_constant2(offset)) * w;
    let signal = fractal_product2(share, fractal_at_most_one2(state.weight));
    return fractal_next2(state, signal, signal, fade);
}

fn ridged_start2(offset: f32) -> FractalState2 {
    return FractalState2(fractal_constant2(0.0), fractal_constant2(1.0));
}

fn ridged_step2(state: FractalState2, n: vec3<f32>, w: f32, offset: f32, fade: f32) -> FractalState2 {
    let crest = fractal_constant2(offset) - select(n, -n, n.x < 0.0);
    let signal = fractal_product2(fractal_product2(crest, crest), state.weight);
    return fractal_next2(state, signal * w, fractal_at_most_one2(signal * FRACTAL_RIDGE_GAIN), fade);
}

struct FractalState3 {
    result: vec4<f32>,
    weight: vec4<f32>,
}

fn fractal_constant3(v: f32) -> vec4<f32> {
    return vec4<f32>(v, 0.0, 0.0, 0.0);
}

fn fractal_product3(a: vec4<f32>, b: vec4<f32>) -> vec4<f32> {
    return vec4<f32>(a.x * b.x, a.x * b.yzw + b.x * a.yzw);
}

fn fractal_at_most_one3(a: vec4<f32>) -> vec4<f32> {
    return select(fractal_constant3(1.0), a, a.x < 1.0);
}

// The state with one more contribution and the next weight, both faded.
fn fractal_next3(state: FractalState3, contribution: vec4<f32>, weight: vec4<f32>, fade: f32) -> FractalState3 {
    return FractalState3(state.result + contribution * fade, state.weight * (1.0 - fade) + weight * fade);
}

fn fbm_start3(offset: f32) -> FractalState3 {
    return FractalState3(fractal_constant3(0.0), fractal_constant3(1.0));
}

fn fbm_step3(state: FractalState3, n: vec4<f32>, w: f32, offset: f32, fade: f32) -> FractalState3 {
    return FractalState3(state.result + n * (w * fade), state.weight);
}

fn heterogeneous_start3(offset: f32) -> FractalState3 {
    return FractalState3(fractal_constant3(offset), fractal_constant3(1.0 + offset));
}

fn heterogeneous_step3(state: FractalState3, n: vec4<f32>, w: f32, offset: f32, fade: f32) -> FractalState3 {
    let contribution = fractal_product3(n, state.weight) * (w / (1.0 + w * offset));
    return fractal_next3(state, contribution, state.result + contribution, fade);
}

fn hybrid_start3(offset: f32) -> FractalState3 {
    return FractalState3(fractal_constant3(0.0), fractal_constant3(1.0));
}

fn hybrid_step3(state: FractalState3, n: vec4<f32>, w: f32, offset: f32, fade: f32) -> FractalState3 {
    let share = (n + fractal_constant3(offset)) * w;
    let signal = fractal_product3(share, fractal_at_most_one3(state.weight));
    return fractal_next3(state, signal, signal, fade);
}

fn ridged_start3(offset: f32) -> FractalState3 {
    return FractalState3(fractal_constant3(0.0), fractal_constant3(1.0));
}

fn ridged_step3(state: FractalState3, n: vec4<f32>, w: f32, offset: f32, fade: f32) -> FractalState3 {
    let crest = fractal_constant3(offset) - select(n, -n, n.x < 0.0);
    let signal = fractal_product3(fractal_product3(crest, crest), state.weight);
    return fractal_next3(state, signal * w, fractal_at_most_one3(signal * FRACTAL_RIDGE_GAIN), fade);
}
