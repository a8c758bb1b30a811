// Where a march along a ray takes its samples; the twin of steps.rs, where the reasons stand.

struct Steps {
    lowest: f32,
    first: f32,
    width: f32,
}

fn steps_new(radius: f32, h: f32, mu: f32, distance: f32, count: u32) -> Steps {
    let lowest = clamp(-(radius + h) * mu, 0.0, distance);
    let first = -sqrt(lowest);
    return Steps(lowest, first, (sqrt(distance - lowest) - first) / f32(count));
}

// The sample and the length of the cell, in metres.
fn steps_step(steps: Steps, i: u32) -> vec2<f32> {
    let t = steps.first + steps.width * f32(i);
    let middle = t + 0.5 * steps.width;
    let end = t + steps.width;
    return vec2(max(steps.lowest + middle * abs(middle), 0.0), end * abs(end) - t * abs(t));
}
