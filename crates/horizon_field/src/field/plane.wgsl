// A plane's layers lie in the arrays as they are.

fn layer_at2(i: u32) -> Layer2 {
    return field_layers[field_base.y + i];
}

fn anchor_at2(i: u32) -> Anchor2 {
    return field_anchors[field_base.w + i];
}
