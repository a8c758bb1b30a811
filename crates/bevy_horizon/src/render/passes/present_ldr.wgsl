// An LDR view is tonemapped where it is shaded, as Bevy's own materials are.
#import bevy_render::view::View as BevyView
#import bevy_core_pipeline::tonemapping::tone_mapping

@group(0) @binding(10) var<uniform> bevy_view: BevyView;

fn present(colour: vec4<f32>) -> vec4<f32> {
    return tone_mapping(colour, bevy_view.color_grading);
}
