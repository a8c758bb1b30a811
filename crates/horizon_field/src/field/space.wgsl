// In space, the layers of projected planes lie in the arrays as layers whose third row and column are absent.

fn layer_at3(i: u32) -> Layer3 {
    return field_layers[field_base.y + i];
}

fn anchor_at3(i: u32) -> Anchor3 {
    return field_anchors[field_base.w + i];
}

fn layer_at2(i: u32) -> Layer2 {
    let layer = field_layers[field_base.y + i];
    return Layer2(vec4<f32>(layer.row0.xy, layer.row1.xy), layer.seed, 0u, 0u, 0u);
}

fn anchor_at2(i: u32) -> Anchor2 {
    let anchor = field_anchors[field_base.w + i];
    return Anchor2(anchor.fraction.xy, anchor.lo.xy, anchor.hi.xy);
}
