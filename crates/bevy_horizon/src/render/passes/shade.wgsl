// Light on ground and meshes, by Bevy's own functions, with what the world knows better put in its place: how much of the sun the
// ground hides, beyond every cascade and with its true penumbra; what crowns of plants leave of it; the sun's colour at the point
// itself; and the sky's light by the direction that a surface faces. Needs view.wgsl, surface.wgsl, look.wgsl, sunlit.wgsl, a daylight
// and a canopy.
#import bevy_pbr::{
    ambient as bevy_ambient,
    lighting as bevy_lighting,
    mesh_types as bevy_mesh_types,
    mesh_view_bindings as bevy_bindings,
    mesh_view_types as bevy_view_types,
    pbr_functions as bevy_functions,
    pbr_types as bevy_types,
    shadows as bevy_shadows,
}
#ifdef SCREEN_SPACE_AMBIENT_OCCLUSION
#import bevy_pbr::ssao_utils as bevy_ssao
#endif

// A point of the drawn ground or of a mesh, in the passes' coordinates, and in Bevy's.
fn drawn_point(position: vec4<f32>, depth: f32) -> vec3<f32> {
    return view.eye + world_direction(view_point(ndc_of(position), depth));
}

fn bevy_point(p: vec3<f32>) -> vec4<f32> {
    return vec4<f32>(bevy_bindings::view.world_position + (p - view.eye), 1.0);
}

// From the eye's own place: through the world's coordinates it would change where Bevy's origin is moved.
fn towards_eye(p: vec3<f32>) -> vec3<f32> {
    return select(normalize(view.eye - p), view.back, view.orthographic != 0u);
}

// The part of the sun's disc that the ground leaves to a point, and, in the penumbra, how high that is; all where nothing is known.
fn sun_over_ground(p: vec3<f32>) -> vec2<f32> {
    if (view.self_shadow == 2u && !daylight_is_own()) {
        return vec2<f32>(0.0);
    }
    let level = level_at(p.xz);
    if (view.self_shadow != 1u || level >= clipmap.count) {
        return vec2<f32>(1.0, 0.0);
    }
    // What lies on the drawn ground within its rounding stands on it.
    let above = p.y - ground_height(level, p.xz) - 1e-3 - 1e-5 * distance(p, view.eye);
    let seen = sun_seen_from(level, p.xz, above);
    if (seen <= 0.0 || seen >= 1.0) {
        return vec2<f32>(seen, 0.0);
    }
    return vec2<f32>(seen, penumbra_at(level, p.xz));
}

// The scene's sun among Bevy's directional lights; their count where it is not there.
fn sun_index() -> u32 {
    let count = bevy_bindings::lights.n_directional_lights;
    for (var i = 0u; i < count; i++) {
        if (dot(bevy_bindings::lights.directional_lights[i].direction_to_light, view.sun_towards) > 0.99999) {
            return i;
        }
    }
    return count;
}

// What a surface sends to the eye, as Bevy's functions take it.
fn lighting_input(pbr: bevy_types::PbrInput) -> bevy_lighting::LightingInput {
    var input: bevy_lighting::LightingInput;
    let n_v = max(dot(pbr.N, pbr.V), 0.0001);
    let roughness = bevy_lighting::perceptualRoughnessToRoughness(pbr.material.perceptual_roughness);
    input.layers[0].NdotV = n_v;
    input.layers[0].N = pbr.N;
    input.layers[0].R = reflect(-pbr.V, pbr.N);
    input.layers[0].perceptual_roughness = pbr.material.perceptual_roughness;
    input.layers[0].roughness = roughness;
    input.P = pbr.world_position.xyz;
    input.V = pbr.V;
    input.diffuse_color = bevy_functions::calculate_diffuse_color(pbr.material.base_color.rgb, pbr.material.metallic, 0.0, 0.0);
    input.metallic = pbr.material.metallic;
    input.F0_dielectric = bevy_functions::calculate_F0_dielectric(pbr.material.reflectance);
    input.F0_metallic = pbr.material.base_color.rgb;
    input.F_ab = bevy_lighting::F_AB(pbr.material.perceptual_roughness, n_v);
#ifdef STANDARD_MATERIAL_CLEARCOAT
    input.layers[1].NdotV = max(dot(pbr.clearcoat_N, pbr.V), 0.0001);
    input.layers[1].N = pbr.clearcoat_N;
    input.layers[1].R = reflect(-pbr.V, pbr.clearcoat_N);
    input.layers[1].perceptual_roughness = pbr.material.clearcoat_perceptual_roughness;
    input.layers[1].roughness = bevy_lighting::perceptualRoughnessToRoughness(pbr.material.clearcoat_perceptual_roughness);
    input.clearcoat_strength = pbr.material.clearcoat;
#endif
    return input;
}

// How much of the sun Bevy's shadow map leaves to a point over the surface.
fn sun_in_map(pbr: bevy_types::PbrInput, i: u32, above: f32) -> f32 {
    let flags = bevy_bindings::lights.directional_lights[i].flags;
    let receives = (pbr.flags & bevy_mesh_types::MESH_FLAGS_SHADOW_RECEIVER_BIT) != 0u;
    if (!receives || (flags & bevy_view_types::DIRECTIONAL_LIGHT_FLAGS_SHADOWS_ENABLED_BIT) == 0u) {
        return 1.0;
    }
    let view_z = dot(view.back, pbr.world_position.xyz - bevy_bindings::view.world_position);
    let point = pbr.world_position + vec4<f32>(0.0, above, 0.0, 0.0);
    return bevy_shadows::fetch_directional_shadow(i, point, pbr.world_normal, view_z, pbr.frag_coord.xy);
}

// How much of it the map and contact shadows leave.
fn sun_in_cascades(pbr: bevy_types::PbrInput, i: u32, above: f32) -> f32 {
    let flags = bevy_bindings::lights.directional_lights[i].flags;
    if ((pbr.flags & bevy_mesh_types::MESH_FLAGS_SHADOW_RECEIVER_BIT) == 0u) {
        return 1.0;
    }
    var left = sun_in_map(pbr, i, above);
#ifdef CONTACT_SHADOWS
#ifdef DEPTH_PREPASS
    let contact_steps = bevy_bindings::contact_shadows_settings.linear_steps;
    if (contact_steps > 0u && left > 0.0 && (flags & bevy_view_types::DIRECTIONAL_LIGHT_FLAGS_CONTACT_SHADOWS_ENABLED_BIT) != 0u) {
        left *= bevy_functions::calculate_contact_shadow(
            pbr.world_position.xyz, pbr.frag_coord.xy, bevy_bindings::lights.directional_lights[i].direction_to_light, contact_steps);
    }
#endif
#endif
    return left;
}

// What Bevy's sun lacks, or has too much of. Bevy adds each light up by itself, so that the sun's part can be taken out and put in
// again as it should be.
fn mended_sun(pbr: bevy_types::PbrInput, p: vec3<f32>) -> vec3<f32> {
    let i = sun_index();
    if (i >= bevy_bindings::lights.n_directional_lights || dot(pbr.N, view.sun_towards) <= 0.0) {
        return vec3<f32>(0.0);
    }
    var input = lighting_input(pbr);
    let bevy_sun = bevy_bindings::lights.directional_lights[i].color.rgb;
    let receives = (pbr.flags & bevy_mesh_types::MESH_FLAGS_SHADOW_RECEIVER_BIT) != 0u;
    let seen = select(vec2<f32>(1.0, 0.0), sun_over_ground(p), receives);
    var through = 1.0;
    if (receives && view.self_shadow == 1u && seen.x > 0.0) {
        through = canopy_transmittance(p, view.sun_towards);
    }
    let own = daylight_is_own();
    if (!own && seen.x >= 1.0 && through >= 1.0) {
        return vec3<f32>(0.0);
    }
    let left = sun_in_cascades(pbr, i, 0.0);
    // The ground's edge in the map is hard. In its penumbra the map is asked above that edge, and only meshes hide more.
    var over = left;
    if (seen.y > 0.0) {
        over = sun_in_cascades(pbr, i, 2.0 * seen.y);
    }
    let wanted = select(bevy_sun, sunlight_at(p), own) * min(min(over, seen.x), through) - bevy_sun * left;
    if (all(abs(wanted) <= vec3<f32>(0.0))) {
        return vec3<f32>(0.0);
    }
    if (all(bevy_sun > vec3<f32>(1e-3))) {
        return bevy_lighting::directional_light(i, &input, true) / bevy_sun * wanted;
    }
    // A sun that is gone at the camera, and still on the peaks.
    var to_sun = bevy_lighting::derive_lighting_input(pbr.N, pbr.V, view.sun_towards);
    return (input.diffuse_color * bevy_lighting::Fd_Burley(&input, &to_sun)
        + bevy_lighting::specular(&input, &to_sun, input.layers[0].roughness, 1.0)) * to_sun.NdotL * wanted;
}

// What Bevy's ambient light lacks: the direction that the sky's light comes from.
fn mended_sky(pbr: bevy_types::PbrInput) -> vec3<f32> {
    if (!daylight_is_own() || any(bevy_bindings::lights.ambient_color.rgb <= vec3<f32>(0.0))) {
        return vec3<f32>(0.0);
    }
    let input = lighting_input(pbr);
    let f0 = bevy_functions::calculate_F0(pbr.material.base_color.rgb, pbr.material.metallic, pbr.material.reflectance);
    let flat_light = bevy_ambient::ambient_light(pbr.world_position, pbr.N, pbr.V, input.layers[0].NdotV, input.diffuse_color,
        f0, pbr.material.perceptual_roughness, pbr.diffuse_occlusion);
    // As much as Bevy has it, by the direction that it comes from: `shine` has the sky's for level ground.
    let level_light = max(skylight_on(vec3<f32>(0.0, 1.0, 0.0)), vec3<f32>(1e-20));
    return flat_light * (skylight_on(pbr.N) / level_light - vec3<f32>(1.0));
}

// A lit surface, ready for its target.
fn lit(surface: bevy_types::PbrInput, p: vec3<f32>, position: vec4<f32>) -> vec4<f32> {
    var pbr = surface;
#ifdef SCREEN_SPACE_AMBIENT_OCCLUSION
    let open = textureLoad(bevy_bindings::screen_space_ambient_occlusion_texture, vec2<i32>(position.xy), 0i).r;
    pbr.diffuse_occlusion = min(pbr.diffuse_occlusion, bevy_ssao::ssao_multibounce(open, pbr.material.base_color.rgb));
    // Lagarde & de Rousiers 2014, "Moving Frostbite to Physically Based Rendering", listing 26.
    let rough = bevy_lighting::perceptualRoughnessToRoughness(pbr.material.perceptual_roughness);
    let n_v = max(dot(pbr.N, pbr.V), 0.0001);
    pbr.specular_occlusion = saturate(pow(n_v + open, exp2(-16.0 * rough - 1.0)) - 1.0 + open);
#endif
    pbr.diffuse_occlusion *= canopy_open(p);
    var colour = bevy_functions::apply_pbr_lighting(pbr);
    let mended = mended_sun(pbr, p) + mended_sky(pbr);
    colour = vec4<f32>(max(colour.rgb + bevy_bindings::view.exposure * mended, vec3<f32>(0.0)), colour.a);
    return bevy_functions::main_pass_post_lighting_processing(pbr, colour);
}
