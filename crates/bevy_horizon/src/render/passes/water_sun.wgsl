// How much of the sun comes to a place on water: what ground and meshes leave of it. Needs Bevy's bindings, view.wgsl, and
// sun_over_ground_at() of water_ground.wgsl or water_no_ground.wgsl.
#import bevy_pbr::{
    mesh_view_bindings as bevy_bindings,
    mesh_view_types as bevy_view_types,
    shadows as bevy_shadows,
}
#ifdef TONEMAP_IN_SHADER
#import bevy_core_pipeline::tonemapping::tone_mapping
#endif

fn water_present(colour: vec4<f32>) -> vec4<f32> {
#ifdef TONEMAP_IN_SHADER
    return tone_mapping(colour, bevy_bindings::view.color_grading);
#else
    return colour;
#endif
}

fn sun_over_water(o: vec3<f32>, position: vec4<f32>) -> f32 {
    var left = sun_over_ground_at(o);
    if (left <= 0.0) {
        return 0.0;
    }
    let count = bevy_bindings::lights.n_directional_lights;
    for (var i = 0u; i < count; i++) {
        if (dot(bevy_bindings::lights.directional_lights[i].direction_to_light, view.sun_towards) > 0.99999) {
            let flags = bevy_bindings::lights.directional_lights[i].flags;
            if ((flags & bevy_view_types::DIRECTIONAL_LIGHT_FLAGS_SHADOWS_ENABLED_BIT) != 0u) {
                let point = vec4<f32>(bevy_bindings::view.world_position + o, 1.0);
                let z = dot(view.back, o);
                left = min(left, bevy_shadows::fetch_directional_shadow(i, point, vec3<f32>(0.0, 1.0, 0.0), z, position.xy));
            }
            break;
        }
    }
    return left;
}
