// Where the field that is being evaluated begins: its numbers, layers, blocks of image words, and anchors at a place.

var<private> field_base: vec4<u32>;

fn field_bases(index: u32) -> vec4<u32> {
    let at = 4u * index;
    return vec4<u32>(vec4<f32>(field_numbers[at], field_numbers[at + 1u], field_numbers[at + 2u], field_numbers[at + 3u]));
}

fn field_number(i: u32) -> f32 {
    return field_numbers[field_base.x + i];
}
