//! The shader of a field: the library's WGSL that it needs, and the functions of its trees. Numbers are read from a buffer by
//! index, so the source depends on the trees' structure alone.

use std::collections::BTreeSet;

use self::emit::{Needs, function, line, types};
use super::compile::Compiled;
use super::tree::Tree;
use super::{curve, image};
use crate::fractal::{self, Rule};
use crate::noise::Basis;
use crate::{hash, lattice};

mod emit;

const WALK: &str = include_str!("walk.wgsl");
const BASE: &str = include_str!("base.wgsl");
const PLANE_ACCESS: &str = include_str!("plane.wgsl");
const SPACE_ACCESS: &str = include_str!("space.wgsl");
const TRIPLANAR: &str = include_str!("triplanar.wgsl");

/// A shader module, without entry point.
///
/// It declares, in one group: binding 0 `field_layers`, 1 `field_anchors`, 2 `field_numbers`, 3 `field_images`, all
/// read-only storage; and it defines `fn field(anchor_base: u32, q: vec2<f32>, cutoff: f32) -> vec3<f32>`, the value and
/// its gradient per metre at `q` metres from the place whose anchors begin at `anchor_base`. In space q is a
/// `vec3<f32>`, and the result a `vec4<f32>`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Kernel {
    /// The WGSL.
    pub source: String,
    /// A hash of the tree's structure, the same on every platform: equal for fields that differ in numbers only.
    pub structure: u64,
}

impl Kernel {
    /// The structure is FNV-1a of the source, 64 bits.
    pub(crate) fn new(source: String) -> Self {
        let mix = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        let structure = source.bytes().fold(0xcbf2_9ce4_8422_2325, mix);
        Self { source, structure }
    }
}

impl<const D: usize> Compiled<D> {
    /// The field's shader, with its bindings in this group: a [`module`] of one function, `field`.
    pub fn kernel(&self, group: u32) -> Kernel {
        module(group, &[("field", self)])
    }
}

/// One shader for several fields, each a function by its name. Their layers, anchors, numbers and images lie in the same
/// buffers, one field's after the other's: see [`Contents`](super::Contents).
pub fn module<const D: usize>(group: u32, fields: &[(&str, &Compiled<D>)]) -> Kernel {
    joined(group, fields, None)
}

/// A [`module`] with `more` fields behind the named ones, which one function reaches by number:
/// `fn name(shape: u32, index: u32, anchor_base: u32, q: vec2<f32>, cutoff: f32) -> vec3<f32>`. The index counts from the
/// first of all the fields, and the shape is that of [`shapes`]. Fields of one shape share their code: how many of them
/// there are is no part of the structure.
pub fn module_with<const D: usize>(
    group: u32,
    fields: &[(&str, &Compiled<D>)],
    name: &str,
    more: &[&Compiled<D>],
) -> Kernel {
    joined(group, fields, Some((name, more)))
}

/// The shape of each field, counted from 0 in order of appearance: fields that differ in numbers only have the same.
pub fn shapes<const D: usize>(fields: &[&Compiled<D>]) -> Vec<usize> {
    Functions::default().shapes(fields, "shape").1
}

/// The functions of a module.
#[derive(Default)]
struct Functions {
    text: String,
    planes: usize,
    needs: Needs,
}

impl Functions {
    /// The function of a tree. Those of its planes are written down.
    fn tree<const D: usize>(&mut self, tree: &Tree<D>, name: &str) -> String {
        let first = self.planes;
        for plane in &tree.planes {
            let name = format!("field_plane{}", self.planes);
            self.text += &function(plane, &name, "shift: u32, ", "shift", self.planes, &mut self.needs);
            self.planes += 1;
        }
        function(tree, name, "", "0u", first, &mut self.needs)
    }

    /// The different functions of these fields, all by one name, and which of them each field has.
    fn shapes<const D: usize>(&mut self, fields: &[&Compiled<D>], name: &str) -> (Vec<String>, Vec<usize>) {
        let mut found: Vec<String> = Vec::new();
        let shape = |field: &&Compiled<D>| {
            let text = self.tree(field.tree(), name);
            found.iter().position(|known| *known == text).unwrap_or_else(|| {
                found.push(text);
                found.len() - 1
            })
        };
        let shapes = fields.iter().map(shape).collect();
        (found, shapes)
    }

    /// A field's function: it says where the field lies in the buffers, then walks its tree.
    fn named<const D: usize>(&mut self, name: &str, index: usize, field: &Compiled<D>) {
        let tree = self.tree(field.tree(), &format!("{name}_tree"));
        let (point, jet, _) = types(D);
        self.text += &tree;
        self.text += &format!(
            "
fn {name}(anchor_base: u32, q: {point}, cutoff: f32) -> {jet} {{
    field_base = field_bases({index}u);
    return {name}_tree(anchor_base, q, cutoff);
}}
"
        );
    }

    /// The function of the fields that are reached by number.
    fn numbered<const D: usize>(&mut self, name: &str, fields: &[&Compiled<D>]) {
        let tree = format!("{name}_tree");
        let (point, jet, _) = types(D);
        let mut branches = String::new();
        for (shape, text) in self.shapes(fields, &tree).0.into_iter().enumerate() {
            self.text += &text.replacen(&tree, &format!("{tree}{shape}"), 1);
            line(&mut branches, format_args!("    if shape == {shape}u {{"));
            line(&mut branches, format_args!("        return {tree}{shape}(anchor_base, q, cutoff);"));
            line(&mut branches, format_args!("    }}"));
        }
        self.text += &format!(
            "
fn {name}(shape: u32, index: u32, anchor_base: u32, q: {point}, cutoff: f32) -> {jet} {{
    field_base = field_bases(index);
{branches}    return {jet}(0.0);
}}
"
        );
    }
}

fn joined<const D: usize>(
    group: u32,
    fields: &[(&str, &Compiled<D>)],
    more: Option<(&str, &[&Compiled<D>])>,
) -> Kernel {
    let mut functions = Functions::default();
    for (index, (name, field)) in fields.iter().enumerate() {
        functions.named(name, index, field);
    }
    if let Some((name, more)) = more {
        functions.numbered(name, more);
    }
    let Functions { text: functions, planes, needs } = functions;

    let mut source = String::new();
    for (binding, (name, of)) in [
        ("layers", format!("Layer{D}")),
        ("anchors", format!("Anchor{D}")),
        ("numbers", "f32".into()),
        ("images", "u32".into()),
    ]
    .into_iter()
    .enumerate()
    {
        line(
            &mut source,
            format_args!("@group({group}) @binding({binding}) var<storage, read> field_{name}: array<{of}>;"),
        );
    }
    source += "\n";
    let bases: BTreeSet<&str> = needs.octaves.iter().map(|(_, basis, _)| basis.wgsl()).collect();
    let library = [lattice::WGSL, hash::WGSL, WALK]
        .into_iter()
        .chain(bases)
        .chain((!needs.octaves.is_empty()).then_some(fractal::WGSL))
        .chain(needs.image.then_some(image::WGSL))
        .chain(needs.curve.then_some(curve::WGSL))
        .chain((planes > 0).then_some(TRIPLANAR));
    library.for_each(|part| {
        source += part;
        source += "\n";
    });
    for part in [BASE, if D == 2 { PLANE_ACCESS } else { SPACE_ACCESS }] {
        source += part;
        source += "\n";
    }
    for (rule, basis, dimensions) in &needs.octaves {
        source += &octaves(*rule, *basis, *dimensions);
    }
    source += &functions;
    Kernel::new(source)
}

/// The loop over octaves of one rule and basis.
fn octaves(rule: Rule, basis: Basis, d: usize) -> String {
    let (rule, basis) = (rule.function(), basis.function());
    let (point, jet, g) = types(d);
    format!(
        "
fn field_{rule}_{basis}{d}(number: u32, shift: u32, anchor_base: u32, q: {point}, cutoff: f32) -> {jet} {{
    let offset = field_number(number + 1u);
    let first = shift + u32(field_number(number + 2u));
    let count = min(u32(field_number(number + 3u)), 24u);
    let octaves = u32(field_number(number + 4u));
    var state = {rule}_start{d}(offset);
    for (var i = 0u; i < count; i++) {{
        let octave = octaves + 3u * i;
        let fade = fractal_fade(field_number(octave), cutoff) * field_number(octave + 2u);
        if fade <= 0.0 {{
            break;
        }}
        let layer = layer_at{d}(first + i);
        let noise = {basis}{d}(lattice{d}(layer, anchor_at{d}(anchor_base + first + i), q), layer.seed);
        let n = {jet}(noise.x, per_metre{d}(layer, noise.{g}));
        state = {rule}_step{d}(state, n, field_number(octave + 1u), offset, fade);
    }}
    return state.result * field_number(number);
}}
"
    )
}
