// Lights the ground where its geometry left its depth. Meshes that a prepass drew lie before it by then, and are drawn over what is
// lit here in vain. Needs shade.wgsl, and declarations of depth_at() and
// depth_samples().

@fragment
fn shade(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    for (var i = 0; i < depth_samples(); i++) {
        let depth = depth_at(vec2<i32>(position.xy), i);
        if (depth <= 0.0) {
            continue;
        }
        let p = drawn_point(position, depth);
        let level = level_at(p.xz);
        // A mesh's sample; or an orthographic view's sky, where depth is not 0.
        if (level >= clipmap.count || abs(p.y - ground_height(level, p.xz)) > 0.01 + 1e-3 * distance(p, view.eye)) {
            continue;
        }
        let look = look_at(level, p.xz);
        var pbr = bevy_types::pbr_input_new();
        pbr.material.base_color = vec4<f32>(look.albedo, 1.0);
        pbr.material.perceptual_roughness = look.roughness;
        pbr.material.reflectance = vec3<f32>(look.reflectance);
        pbr.material.flags |= bevy_types::STANDARD_MATERIAL_FLAGS_FOG_ENABLED_BIT;
        pbr.flags = bevy_mesh_types::MESH_FLAGS_SHADOW_RECEIVER_BIT;
        pbr.is_orthographic = view.orthographic != 0u;
        pbr.frag_coord = vec4<f32>(position.xy, depth, 1.0);
        pbr.world_position = bevy_point(p);
        pbr.world_normal = look.normal;
        pbr.N = look.normal;
        pbr.clearcoat_N = look.normal;
        pbr.V = towards_eye(p);
        return lit(pbr, p, position);
    }
    discard;
}
