//! Refusal: what a field must not be, found before anything is computed from it, and named by the node's path.

use super::nodes::HEIGHT;
use super::param::{Param, Params};
use super::{Field, Link};

/// How deep a tree may be.
pub const MAX_DEPTH: usize = 64;
/// How many nodes a tree may have: more than any world needs, and few enough for one kernel.
pub const MAX_NODES: usize = 1024;
/// How many octaves a tree may have, all its nodes together.
pub const MAX_OCTAVES: usize = 256;
/// The largest edge of a height image, in texels.
pub const MAX_IMAGE: u32 = 8192;
/// How high a field may reach, in metres: its square still is a finite `f32`.
pub const MAX_HEIGHT: f64 = 1e12;

/// Why a field is refused. `path` names the node, such as `field.Add[1].Fractal.gain`.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "each message says what its fields are")]
pub enum FieldError {
    /// A parameter is NaN or infinite.
    #[error("{path} is {value}, not a finite number")]
    NotFinite { path: String, value: f64 },
    /// A parameter lies outside its range.
    #[error("{path} is {value}, outside {min} to {max} {unit}")]
    OutOfRange { path: String, value: f64, min: f64, max: f64, unit: &'static str },
    /// Two parameters are in the wrong order, or equal where they must differ.
    #[error("{path} runs from {low} to {high}: it must rise")]
    Empty { path: String, low: f64, high: f64 },
    /// A sum, product, minimum or maximum of nothing.
    #[error("{path} holds no field")]
    NoFields { path: String },
    /// The tree is too deep.
    #[error("{path} is nested deeper than {MAX_DEPTH} nodes")]
    TooDeep { path: String },
    /// The tree has too many nodes.
    #[error("the field has more than {MAX_NODES} nodes")]
    TooManyNodes,
    /// The tree has too many octaves.
    #[error("the field has {octaves} octaves, more than {MAX_OCTAVES}")]
    TooManyOctaves { octaves: usize },
    /// The field, or a part of it, may reach heights that single precision can't carry.
    #[error("the field may reach {height:e} m, more than {MAX_HEIGHT:e} m: a product or a remap grows without need")]
    TooHigh { height: f64 },
    /// An image could not be had.
    #[error("{path}: the image \"{image}\" can't be read: {reason}")]
    Image { path: String, image: String, reason: String },
    /// An image is empty or too large.
    #[error("{path}: the image \"{image}\" has {width} × {height} texels, outside 1 to {MAX_IMAGE} each")]
    ImageSize { path: String, image: String, width: u32, height: u32 },
}

/// A node on the way of the check, with the way back to the root.
struct Visit<'a> {
    field: &'a Field,
    parent: Option<(usize, Link)>,
    depth: usize,
}

/// The path of a visited node.
fn path(visits: &[Visit], mut index: usize) -> String {
    let mut links = Vec::new();
    while let Some((parent, link)) = visits[index].parent {
        links.push((visits[parent].field.name(), link));
        index = parent;
    }
    let mut path = String::from("field");
    for (name, link) in links.into_iter().rev() {
        path += match link {
            Link::Index(at) => format!(".{name}[{at}]"),
            Link::Name(parameter) => format!(".{name}.{parameter}"),
        }
        .as_str();
    }
    path
}

/// The first number of a node that is not in its declared range.
pub(crate) fn check_numbers(node: &dyn Params, path: &dyn Fn() -> String) -> Result<(), FieldError> {
    let mut found = Ok(());
    node.params(&mut |name, param, value| {
        if found.is_ok() {
            found = check_number(name, param, value, path);
        }
    });
    found
}

pub(crate) fn check_number(
    name: &str,
    &Param { min, max, unit, .. }: &Param,
    value: f64,
    path: &dyn Fn() -> String,
) -> Result<(), FieldError> {
    let path = || if name.is_empty() { path() } else { format!("{}.{name}", path()) };
    if !value.is_finite() {
        return Err(FieldError::NotFinite { path: path(), value });
    }
    if value < min || value > max {
        return Err(FieldError::OutOfRange { path: path(), value, min, max, unit });
    }
    Ok(())
}

/// What a node's parameters must be to each other.
fn check_node(field: &Field, path: &dyn Fn() -> String) -> Result<(), FieldError> {
    let rises = |low: f64, high: f64, rises: bool| {
        if rises { Ok(()) } else { Err(FieldError::Empty { path: path(), low, high }) }
    };
    match field {
        Field::Constant(height) => check_number("", &HEIGHT, *height, path),
        Field::Image(node) => check_numbers(node, path),
        Field::Noise(node) => check_numbers(node, path),
        Field::Fractal(node) => check_numbers(node, path),
        Field::Warp(_) => Ok(()),
        Field::Dual(node) => check_numbers(node, path).and_then(|()| rises(node.low, node.high, node.low < node.high)),
        Field::Triplanar(node) => check_numbers(node, path),
        Field::Add(fields) | Field::Multiply(fields) | Field::Min(fields) | Field::Max(fields) => {
            if fields.is_empty() {
                Err(FieldError::NoFields { path: path() })
            } else {
                Ok(())
            }
        }
        Field::SmoothMin(node) => check_numbers(node, path),
        Field::Clamp(node) => {
            check_numbers(node, path).and_then(|()| rises(node.low, node.high, node.low <= node.high))
        }
        Field::Remap(node) => check_numbers(node, path)
            .and_then(|()| rises(node.from[0], node.from[1], (node.from[1] - node.from[0]).abs() >= 1e-6)),
        Field::Terrace(node) => check_numbers(node, path),
        Field::Mask(node) => check_numbers(node, path).and_then(|()| rises(node.low, node.high, node.low < node.high)),
    }
}

/// How many octaves one node evaluates.
fn octaves(field: &Field) -> usize {
    match field {
        Field::Noise(_) => 1,
        Field::Fractal(fractal) => fractal.octaves.ceil() as usize,
        _ => 0,
    }
}

impl Field {
    /// Refuses a field that can't be computed. Walks without recursion, so that no depth of the tree overflows the stack.
    /// Images are not looked at: [`Field::compile`] loads them.
    pub fn check(&self) -> Result<(), FieldError> {
        let mut visits = vec![Visit { field: self, parent: None, depth: 1 }];
        let mut total = 0;
        let mut at = 0;
        while at < visits.len() {
            let Visit { field, depth, .. } = visits[at];
            let node = || format!("{}.{}", path(&visits, at), field.name());
            if depth > MAX_DEPTH {
                return Err(FieldError::TooDeep { path: node() });
            }
            check_node(field, &node)?;
            total += octaves(field);
            if total > MAX_OCTAVES {
                return Err(FieldError::TooManyOctaves { octaves: total });
            }
            field.children(&mut |link, child| {
                if visits.len() <= MAX_NODES {
                    visits.push(Visit { field: child, parent: Some((at, link)), depth: depth + 1 });
                }
            });
            if visits.len() > MAX_NODES {
                return Err(FieldError::TooManyNodes);
            }
            at += 1;
        }
        Ok(())
    }

    /// The path of the first image node that asks for `image`.
    pub(super) fn path_of_image(&self, image: &str) -> String {
        let mut visits = vec![Visit { field: self, parent: None, depth: 1 }];
        let mut at = 0;
        while at < visits.len() {
            let field = visits[at].field;
            if matches!(field, Field::Image(node) if node.path == image) {
                break;
            }
            field.children(&mut |link, child| {
                visits.push(Visit { field: child, parent: Some((at, link)), depth: 0 });
            });
            at += 1;
        }
        format!("{}.Image", path(&visits, at.min(visits.len() - 1)))
    }
}
