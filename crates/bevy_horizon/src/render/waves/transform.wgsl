// From a tile's waves to a grid of them: height and displacement by one fast Fourier transform. horizon_field's transform.rs derives
// it, and is the twin. Needs bindings.wgsl.

// Two complex numbers each. A stage reads one half, and writes the other.
var<workgroup> line: array<vec4<f32>, 2u * GRID>;

// Both products with a complex number.
fn times(pair: vec4<f32>, by: vec2<f32>) -> vec4<f32> {
    return pair * by.x + vec4<f32>(-pair.y, pair.x, -pair.w, pair.z) * by.y;
}

// The sum over m of x_m e^(2πi m j / GRID), by Stockham's method. Returns where the line's result begins.
fn transform(lane: u32) -> u32 {
    var begin = 0u;
    for (var stage = 0u; stage < STAGES; stage++) {
        workgroupBarrier();
        let width = 1u << stage;
        let k = lane & (width - 1u);
        let a = line[begin + lane];
        let b = times(line[begin + lane + GRID / 2u], roots[k * ((GRID / 2u) >> stage)]);
        begin = GRID - begin;
        let to = begin + 2u * lane - k;
        line[to] = a + b;
        line[to + width] = a - b;
    }
    workgroupBarrier();
    return begin;
}

// The wave vector of a place in the line, −GRID/2 to GRID/2 − 1.
fn wave_of(place: u32) -> i32 {
    return i32(place) - select(0, i32(GRID), place >= GRID / 2u);
}

// The complex amplitude of a wave vector at the time.
fn amplitude(layer: u32, n: vec2<i32>) -> vec2<f32> {
    let at = vec2<u32>(n + vec2<i32>(REACH));
    let mode = modes[(layer * ROWS + at.y) * ROWS + at.x];
    // In whole 2⁻³² of a turn, from −½ to ½: exact, and where sines are most so.
    let turn = bitcast<i32>(bitcast<u32>(i32(mode.z)) * clock.x);
    let angle = f32(turn) * 1.4629180792671596e-9;
    let c = cos(angle);
    let s = sin(angle);
    return vec2<f32>(mode.x * c + mode.y * s, mode.y * c - mode.x * s);
}

// Height and displacement along x as one complex number, displacement along z as another.
fn evolved(layer: u32, n: vec2<i32>) -> vec4<f32> {
    let a = amplitude(layer, n);
    let b = amplitude(layer, -n);
    let g = 0.5 * vec2<f32>(a.x + b.x, a.y - b.y);
    let turn = layers[layer].choppiness * vec2<f32>(n) / max(length(vec2<f32>(n)), 1.0);
    return vec4<f32>((1.0 - turn.x) * g, turn.y * vec2<f32>(-g.y, g.x));
}

@compute @workgroup_size(64, 1, 1)
fn sea_rows(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    for (var i = 0u; i < 2u; i++) {
        let place = lane + i * (GRID / 2u);
        let n = vec2<i32>(wave_of(place), i32(group.x) - REACH);
        var pair = vec4<f32>(0.0);
        if (abs(n.x) <= REACH) {
            pair = evolved(group.y, n);
        }
        line[place] = pair;
    }
    let begin = transform(lane);
    for (var i = 0u; i < 2u; i++) {
        let place = lane + i * (GRID / 2u);
        rows[(group.y * ROWS + group.x) * GRID + place] = line[begin + place];
    }
}

@compute @workgroup_size(64, 1, 1)
fn sea_columns(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    for (var i = 0u; i < 2u; i++) {
        let place = lane + i * (GRID / 2u);
        let n = wave_of(place);
        var pair = vec4<f32>(0.0);
        if (abs(n) <= REACH) {
            pair = rows[(group.y * ROWS + u32(n + REACH)) * GRID + group.x];
        }
        line[place] = pair;
    }
    let begin = transform(lane);
    for (var i = 0u; i < 2u; i++) {
        let place = lane + i * (GRID / 2u);
        grid[(group.y * GRID + place) * GRID + group.x] = line[begin + place];
    }
}
