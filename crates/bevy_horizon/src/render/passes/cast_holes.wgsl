// The ground in a shadow map, without what holes take away: light falls through them as it is seen through them. Needs cast.wgsl and
// look.wgsl.

struct Corner {
    @builtin(position) position: vec4<f32>,
    // In texels of the level, as cells are counted.
    @location(0) at: vec2<f32>,
    @location(1) @interpolate(flat) level: u32,
}

@vertex
fn cast_pierced(@builtin(vertex_index) vertex: u32, @builtin(instance_index) instance: u32) -> Corner {
    let one = patches[instance];
    let cell = vertex_cell(one, vertex);
    return Corner(in_map(one, cell), vec2<f32>(cell), one.level);
}

@fragment
fn keep_ground(corner: Corner) {
    let l = clipmap.levels[corner.level];
    let cell = clamp(vec2<i32>(floor(corner.at + 0.5)), l.low, l.high - vec2<i32>(1));
    if (is_hole(texel_index(l, cell))) {
        discard;
    }
}
