// What light on surfaces reads of the cache. Bounds are named by surface.wgsl alone: nothing here asks for them.

@group(0) @binding(1) var<storage, read> heights: array<f32>;
@group(0) @binding(4) var<storage, read> bounds: array<u32>;
@group(0) @binding(5) var<uniform> view: HorizonView;
