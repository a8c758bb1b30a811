//! The code of a tree: a function in single assignments, node by node.

use core::fmt::Write;

use super::super::compile;
use super::super::curve::Curve;
use super::super::tree::{FractalNode, Node, Tree};
use crate::fractal::Rule;
use crate::noise::Basis;

/// Which parts of the library the nodes call.
#[derive(Default)]
pub(super) struct Needs {
    pub octaves: Vec<(Rule, Basis, usize)>,
    pub image: bool,
    pub curve: bool,
}

/// A line of code. Writing into a string can't fail.
pub(super) fn line(text: &mut String, code: core::fmt::Arguments) {
    let _ = text.write_fmt(code);
    text.push('\n');
}

/// The types of a domain of `d` dimensions: of points, and of values with gradients.
pub(super) fn types(d: usize) -> (String, String, &'static str) {
    (format!("vec{d}<f32>"), format!("vec{}<f32>", d + 1), if d == 2 { "yz" } else { "yzw" })
}

/// A function of a whole tree.
pub(super) fn function<const D: usize>(
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
        let flat = ["yz", "xz", "xy"];
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
