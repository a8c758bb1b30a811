//! The shader of a field: the library's WGSL that it needs, and one function in single assignments. Numbers are read
//! from a buffer by index, so the source depends on the tree's structure alone.

use core::fmt::Write;
use std::collections::BTreeSet;

use super::compile::Compiled;
use super::curve::{self, Curve};
use super::tree::{FractalNode, Node, Tree};
use super::{compile, image};
use crate::fractal::{self, Rule};
use crate::noise::Basis;
use crate::{hash, lattice};

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

/// Which parts of the library the nodes call.
#[derive(Default)]
struct Needs {
    octaves: Vec<(Rule, Basis, usize)>,
    image: bool,
    curve: bool,
}

/// A line of code. Writing into a string can't fail.
fn line(text: &mut String, code: core::fmt::Arguments) {
    let _ = text.write_fmt(code);
    text.push('\n');
}

/// The types of a domain of `d` dimensions: of points, and of values with gradients.
fn types(d: usize) -> (String, String, &'static str) {
    (format!("vec{d}<f32>"), format!("vec{}<f32>", d + 1), if d == 2 { "yz" } else { "yzw" })
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

/// A function of a whole tree.
fn function<const D: usize>(
    tree: &Tree<D>,
    name: &str,
    parameter: &str,
    shift: &'static str,
    first_plane: usize,
    needs: &mut Needs,
) -> String {
    let mut emitter = Emitter { body: String::new(), next: 0, shift, first_plane, needs };
    let result = emitter.node(&tree.root, "q");
    let (point, jet, _) = types(D);
    format!(
        "\nfn {name}({parameter}anchor_base: u32, q: {point}, cutoff: f32) -> {jet} {{\n{}    return {result};\n}}\n",
        emitter.body
    )
}

/// Code in single assignments.
struct Emitter<'a> {
    body: String,
    next: usize,
    /// What is added to the index of a layer.
    shift: &'static str,
    /// The index of the tree's first plane in the module.
    first_plane: usize,
    needs: &'a mut Needs,
}

impl Emitter<'_> {
    /// A new name for a value.
    fn set(&mut self, value: core::fmt::Arguments) -> String {
        let name = format!("v{}", self.next);
        self.next += 1;
        line(&mut self.body, format_args!("    let {name} = {value};"));
        name
    }

    /// The code of a node at the point `q`; gives the name of its value.
    fn node<const D: usize>(&mut self, node: &Node<D>, q: &str) -> String {
        let (_, jet, g) = types(D);
        let shift = self.shift;
        match node {
            Node::Constant { number, .. } => {
                let zeros = if D == 2 { "0.0, 0.0" } else { "0.0, 0.0, 0.0" };
                self.set(format_args!("{jet}(field_number({number}u), {zeros})"))
            }
            Node::Image(node) => self.image::<D>(node.number, q),
            Node::Fractal(FractalNode { rule, basis, number, .. }) => {
                if !self.needs.octaves.contains(&(*rule, *basis, D)) {
                    self.needs.octaves.push((*rule, *basis, D));
                }
                let (rule, basis) = (rule.function(), basis.function());
                self.set(format_args!("field_{rule}_{basis}{D}({number}u, {shift}, anchor_base, {q}, cutoff)"))
            }
            Node::Warp { field, by } => self.warp(field, by, q),
            Node::Triplanar { plane, number, .. } => self.triplanar(*plane, *number, q),
            Node::Add(nodes) => self.fold(nodes, q, |a, b| format!("{a} + {b}")),
            Node::Multiply(nodes) => self.fold(nodes, q, |a, b| format!("field_product{D}({a}, {b})")),
            Node::Min(nodes) => self.fold(nodes, q, |a, b| format!("select({a}, {b}, {b}.x < {a}.x)")),
            Node::Max(nodes) => self.fold(nodes, q, |a, b| format!("select({a}, {b}, {b}.x > {a}.x)")),
            Node::Linear { field, number, .. } => {
                let field = self.node(field, q);
                let scaled = self.set(format_args!("{field} * field_number({number}u)"));
                let shift = number + 1;
                self.set(format_args!("{jet}({scaled}.x + field_number({shift}u), {scaled}.{g})"))
            }
            Node::Curve { field, curve, number } => {
                let field = self.node(field, q);
                self.curve::<D>(curve, *number, &field)
            }
            Node::SmoothMin { a, b, round, number } => {
                let (a, b) = (self.node(a, q), self.node(b, q));
                let difference = self.set(format_args!("{a} - {b}"));
                let rounded = self.curve::<D>(round, *number, &difference);
                self.set(format_args!("{b} + {rounded}"))
            }
            Node::Dual { local, global, ramp, number } => {
                let (global, local) = (self.node(global, q), self.node(local, q));
                let share = self.curve::<D>(ramp, *number, &global);
                self.set(format_args!("{global} + field_product{D}({local}, {share})"))
            }
            Node::Mask { mask, outside, inside, step, number } => {
                let mask = self.node(mask, q);
                let share = self.curve::<D>(step, *number, &mask);
                let (outside, inside) = (self.node(outside, q), self.node(inside, q));
                self.set(format_args!("{outside} + field_product{D}({inside} - {outside}, {share})"))
            }
        }
    }

    fn fold<const D: usize>(&mut self, nodes: &[Node<D>], q: &str, combine: impl Fn(&str, &str) -> String) -> String {
        let first = self.node(&nodes[0], q);
        nodes[1..].iter().fold(first, |sum, node| {
            let next = self.node(node, q);
            let both = combine(&sum, &next);
            self.set(format_args!("{both}"))
        })
    }

    fn curve<const D: usize>(&mut self, curve: &Curve, number: usize, of: &str) -> String {
        self.needs.curve = true;
        let function = curve.function();
        let numbers: Vec<String> =
            (0..curve.numbers().len()).map(|k| format!("field_number({}u)", number + k)).collect();
        let numbers = numbers.join(", ");
        self.set(format_args!("field_curved{D}({of}, {function}({of}.x, {numbers}))"))
    }

    fn warp<const D: usize>(&mut self, field: &Node<D>, by: &[Option<Box<Node<D>>>; D], q: &str) -> String {
        let (point, jet, g) = types(D);
        let by: Vec<Option<String>> = by.iter().map(|by| by.as_ref().map(|by| self.node(by, q))).collect();
        let components: Vec<String> =
            by.iter().map(|by| by.as_ref().map_or("0.0".into(), |by| format!("{by}.x"))).collect();
        let components = components.join(", ");
        let moved = self.set(format_args!("{q} + {point}({components})"));
        let inner = self.node(field, &moved);
        let mut gradient = format!("{inner}.{g}");
        for (axis, by) in ["y", "z", "w"].into_iter().zip(&by) {
            if let Some(by) = by {
                gradient += &format!(" + {inner}.{axis} * {by}.{g}");
            }
        }
        self.set(format_args!("{jet}({inner}.x, {gradient})"))
    }

    fn image<const D: usize>(&mut self, number: usize, q: &str) -> String {
        self.needs.image = true;
        let shift = self.shift;
        let (_, jet, g) = types(D);
        let at = |k: usize| format!("field_number({}u)", number + k);
        let index = self.set(format_args!("{shift} + u32({})", at(0)));
        let layer = self.set(format_args!("layer_at{D}({index})"));
        let point = self.set(format_args!("lattice{D}({layer}, anchor_at{D}(anchor_base + {index}), {q})"));
        let texel = self.set(format_args!("LatticePoint2({point}.lo.xy, {point}.hi.xy, {point}.fraction.xy)"));
        let block = compile::IMAGE_BLOCK;
        let image = self.set(format_args!(
            "HeightImage((field_base.z + u32({})) * {block}u, vec2<i32>(i32({}), i32({})), u32({}))",
            at(3),
            at(4),
            at(5),
            at(6)
        ));
        let flat = self.set(format_args!("image2({texel}, {image})"));
        let per_texel = if D == 2 { format!("{flat}.yz") } else { format!("vec3<f32>({flat}.yz, 0.0)") };
        let scaled = self.set(format_args!("{jet}({flat}.x, per_metre{D}({layer}, {per_texel})) * {}", at(2)));
        self.set(format_args!("{jet}({scaled}.x + {}, {scaled}.{g})", at(1)))
    }

    fn triplanar(&mut self, plane: usize, number: usize, q: &str) -> String {
        let plane = self.first_plane + plane;
        let at = |k: usize| format!("field_number({}u)", number + k);
        let rows = self.set(format_args!("u32({})", at(1)));
        let count = self.set(format_args!("u32({})", at(2)));
        let weights = self
            .set(format_args!("triplanar_weights(anchor_at3(anchor_base + {rows}).fraction + {q}, u32({}))", at(0)));
        let flat = ["yz", "xz", "xy"].map(|axes| axes);
        let [a, b, c]: [String; 3] = core::array::from_fn(|k| {
            let axes = flat[k];
            self.set(format_args!("field_plane{plane}({rows} + 1u + {k}u * {count}, anchor_base, {q}.{axes}, cutoff)"))
        });
        let x = self.set(format_args!("field_product3(vec4<f32>({a}.x, 0.0, {a}.yz), {weights}.x)"));
        let y = self.set(format_args!("field_product3(vec4<f32>({b}.xy, 0.0, {b}.z), {weights}.y)"));
        let z = self.set(format_args!("field_product3(vec4<f32>({c}, 0.0), {weights}.z)"));
        self.set(format_args!("{x} + {y} + {z}"))
    }
}
