//! The field: a small tree of data that says how high the ground is, or how far from a surface a point of space.
//!
//! Data flows through the files in this order: [`nodes`] (parameters) → [`check`] (refusal) → [`compile`] (lattices,
//! numbers, images) → [`eval`] (value and gradient), [`bound`] and [`spread`] (what is proven of a region, and of all),
//! [`kernel`] (the shader). `walk` is the one recursion over the compiled tree, which the evaluators share; `query` and
//! `batch` are those that make one value, and many of them, fast.

#[cfg(feature = "reflect")]
use bevy_reflect::std_traits::ReflectDefault;
use serde::{Deserialize, Serialize};

pub mod bound;
pub mod bytes;
pub mod check;
pub mod child;
pub mod compile;
pub mod eval;
pub mod image;
pub mod kernel;
pub mod nodes;
pub mod param;
pub mod spread;

mod batch;
mod curve;
mod layers;
pub(crate) mod model;
mod query;
mod ranges;
mod sample;
mod tree;
mod walk;

#[doc(hidden)]
pub mod arbitrary;
#[cfg(test)]
mod tests;

pub use bound::Bound;
pub use bytes::Contents;
pub use check::FieldError;
pub use child::Child;
pub use compile::{Anchors, Compiled};
pub use image::{HeightImage, ImageDirectory, ImageSource, NoImages};
pub use kernel::Kernel;
pub use nodes::{Clamp, Dual, Fractal, ImageField, Mask, Noise, Remap, SmoothMin, Terrace, Triplanar, Warp};
pub use param::Param;

/// What an implicit world is: a function of the plane (x, z), or of space (x, y, z), in metres.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(
    feature = "reflect",
    derive(bevy_reflect::Reflect),
    reflect(no_field_bounds, Clone, Debug, Default, PartialEq)
)]
#[serde(deny_unknown_fields)]
pub enum Field {
    /// The same height everywhere, in metres; from −10⁶ to 10⁶.
    Constant(#[cfg_attr(feature = "reflect", reflect(@nodes::HEIGHT))] f64),
    /// A height image.
    Image(ImageField),
    /// One octave of noise.
    Noise(Noise),
    /// Octaves of noise: fBm or a multifractal.
    Fractal(Fractal),
    /// A field, asked at a displaced point.
    Warp(Warp),
    /// Local relief that grows with a global field.
    Dual(Dual),
    /// A field of the plane on a body in space.
    Triplanar(Triplanar),
    /// The sum of fields.
    Add(Vec<Field>),
    /// The product of fields.
    Multiply(Vec<Field>),
    /// The smallest of fields.
    Min(Vec<Field>),
    /// The largest of fields.
    Max(Vec<Field>),
    /// The smaller of two, rounded where they meet.
    SmoothMin(SmoothMin),
    /// A field, limited to a range.
    Clamp(Clamp),
    /// A field, its heights mapped linearly.
    Remap(Remap),
    /// A field in terraces.
    Terrace(Terrace),
    /// Two fields, blended by a third.
    Mask(Mask),
}

impl Default for Field {
    fn default() -> Self {
        Self::Fractal(Fractal::default())
    }
}

/// What lies beyond an image's edge.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "reflect", derive(bevy_reflect::Reflect), reflect(Clone, Debug, Default, PartialEq))]
pub enum Edge {
    /// The outermost texels, for ever.
    #[default]
    Clamp,
    /// The image, mirrored at each edge.
    Mirror,
    /// The image again.
    Repeat,
}

/// How a field lies in its parent.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Link {
    /// In a list.
    Index(usize),
    /// In a parameter.
    Name(&'static str),
}

impl Field {
    /// The node's name, as files spell it.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Constant(_) => "Constant",
            Self::Image(_) => "Image",
            Self::Noise(_) => "Noise",
            Self::Fractal(_) => "Fractal",
            Self::Warp(_) => "Warp",
            Self::Dual(_) => "Dual",
            Self::Triplanar(_) => "Triplanar",
            Self::Add(_) => "Add",
            Self::Multiply(_) => "Multiply",
            Self::Min(_) => "Min",
            Self::Max(_) => "Max",
            Self::SmoothMin(_) => "SmoothMin",
            Self::Clamp(_) => "Clamp",
            Self::Remap(_) => "Remap",
            Self::Terrace(_) => "Terrace",
            Self::Mask(_) => "Mask",
        }
    }

    /// Calls `each` on the fields right inside this one.
    pub(crate) fn children<'a>(&'a self, each: &mut dyn FnMut(Link, &'a Field)) {
        match self {
            Self::Constant(_) | Self::Image(_) | Self::Noise(_) | Self::Fractal(_) => {}
            Self::Warp(warp) => {
                each(Link::Name("field"), &warp.field);
                each(Link::Name("x"), &warp.x);
                each(Link::Name("z"), &warp.z);
                if let Some(y) = &warp.y {
                    each(Link::Name("y"), y);
                }
            }
            Self::Dual(dual) => {
                each(Link::Name("local"), &dual.local);
                each(Link::Name("global"), &dual.global);
            }
            Self::Triplanar(triplanar) => each(Link::Name("field"), &triplanar.field),
            Self::Add(fields) | Self::Multiply(fields) | Self::Min(fields) | Self::Max(fields) => {
                fields.iter().enumerate().for_each(|(index, field)| each(Link::Index(index), field));
            }
            Self::SmoothMin(min) => {
                each(Link::Name("a"), &min.a);
                each(Link::Name("b"), &min.b);
            }
            Self::Clamp(clamp) => each(Link::Name("field"), &clamp.field),
            Self::Remap(remap) => each(Link::Name("field"), &remap.field),
            Self::Terrace(terrace) => each(Link::Name("field"), &terrace.field),
            Self::Mask(mask) => {
                each(Link::Name("mask"), &mask.mask);
                each(Link::Name("outside"), &mask.outside);
                each(Link::Name("inside"), &mask.inside);
            }
        }
    }

    /// The paths of all images, each once, in the order of the tree.
    pub fn image_paths(&self) -> Vec<String> {
        let mut paths = Vec::new();
        let mut stack = vec![self];
        while let Some(field) = stack.pop() {
            if let Self::Image(image) = field
                && !paths.contains(&image.path)
            {
                paths.push(image.path.clone());
            }
            let first = stack.len();
            field.children(&mut |_, child| stack.push(child));
            stack[first..].reverse();
        }
        paths
    }
}

macro_rules! from_node {
    ($($name:ident($node:ty)),* $(,)?) => {
        $(impl From<$node> for Field {
            fn from(node: $node) -> Self {
                Self::$name(node)
            }
        })*
    };
}
from_node!(
    Image(ImageField),
    Noise(Noise),
    Fractal(Fractal),
    Warp(Warp),
    Dual(Dual),
    Triplanar(Triplanar),
    SmoothMin(SmoothMin),
    Clamp(Clamp),
    Remap(Remap),
    Terrace(Terrace),
    Mask(Mask),
);
