//! Where boxes of the plane lie: a tree of bounding boxes, so that a question touches only what is near.

use core::ops::Range;

/// A box of the plane, in metres from the index' origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Box2 {
    pub low: [f64; 2],
    pub high: [f64; 2],
}

impl Box2 {
    pub const EMPTY: Self = Self { low: [f64::INFINITY; 2], high: [f64::NEG_INFINITY; 2] };

    pub fn around(centre: [f64; 2], half: [f64; 2]) -> Self {
        Self { low: [0, 1].map(|k| centre[k] - half[k]), high: [0, 1].map(|k| centre[k] + half[k]) }
    }

    pub fn joined(&self, other: &Self) -> Self {
        Self {
            low: [0, 1].map(|k| self.low[k].min(other.low[k])),
            high: [0, 1].map(|k| self.high[k].max(other.high[k])),
        }
    }

    pub fn touches(&self, other: &Self) -> bool {
        (0..2).all(|k| self.low[k] <= other.high[k] && other.low[k] <= self.high[k])
    }

    pub fn holds(&self, other: &Self) -> bool {
        (0..2).all(|k| self.low[k] <= other.low[k] && other.high[k] <= self.high[k])
    }
}

#[derive(Clone, Debug)]
struct Node {
    bounds: Box2,
    items: Range<u32>,
    /// The second child; the first one follows its parent. 0 for a leaf.
    second: u32,
    /// The first node after its subtree.
    past: u32,
}

/// Boxes by their numbers.
#[derive(Clone, Debug, Default)]
pub(super) struct Index {
    boxes: Vec<Box2>,
    items: Vec<u32>,
    /// A parent comes before its children.
    nodes: Vec<Node>,
}

/// Boxes of a leaf.
const LEAF: usize = 4;

impl Index {
    pub fn new(boxes: Vec<Box2>) -> Self {
        let mut index = Self { items: (0..boxes.len() as u32).collect(), boxes, nodes: Vec::new() };
        if !index.boxes.is_empty() {
            index.build(0..index.items.len());
        }
        index
    }

    /// Halves the boxes of a node at the median along its longer side, and so on down.
    fn build(&mut self, range: Range<usize>) {
        let boxes = &self.boxes;
        let bounds = self.items[range.clone()].iter().fold(Box2::EMPTY, |all, i| all.joined(&boxes[*i as usize]));
        let at = self.nodes.len();
        self.nodes.push(Node { bounds, items: range.start as u32..range.end as u32, second: 0, past: at as u32 + 1 });
        if range.len() <= LEAF {
            return;
        }
        let axis = usize::from(bounds.high[1] - bounds.low[1] > bounds.high[0] - bounds.low[0]);
        let middle = |i: &u32| boxes[*i as usize].low[axis] + boxes[*i as usize].high[axis];
        let half = range.len() / 2;
        // Ties by number, so that the tree is the same on every platform.
        self.items[range.clone()].select_nth_unstable_by(half, |a, b| middle(a).total_cmp(&middle(b)).then(a.cmp(b)));
        self.build(range.start..range.start + half);
        self.nodes[at].second = self.nodes.len() as u32;
        self.build(range.start + half..range.end);
        self.nodes[at].past = self.nodes.len() as u32;
    }

    /// The numbers of the boxes that touch `area`, in rising order, but for those that `taken` takes: it is asked of boxes
    /// that lie within the area as a whole, a node of them at a time, with the node's number. Returns how many nodes were
    /// looked at, too.
    pub fn touching(&self, area: &Box2, mut taken: impl FnMut(usize) -> bool) -> (Vec<u32>, usize) {
        let (mut found, mut looked, mut at) = (Vec::new(), 0, 0);
        while at < self.nodes.len() {
            let node = &self.nodes[at];
            looked += 1;
            if !node.bounds.touches(area) || (area.holds(&node.bounds) && taken(at)) {
                at = node.past as usize;
                continue;
            }
            if node.second == 0 {
                let items = &self.items[node.items.start as usize..node.items.end as usize];
                found.extend(items.iter().filter(|i| self.boxes[**i as usize].touches(area)));
            }
            at += 1;
        }
        found.sort_unstable();
        (found, looked)
    }

    /// For each node, what `join` makes of what `of` says of its boxes.
    pub fn gather<T: Clone>(&self, of: impl Fn(u32) -> T, join: impl Fn(&T, &T) -> T) -> Vec<T> {
        let mut all: Vec<Option<T>> = vec![None; self.nodes.len()];
        for (at, node) in self.nodes.iter().enumerate().rev() {
            let children = match node.second {
                0 => self.items[node.items.start as usize..node.items.end as usize]
                    .iter()
                    .map(|i| of(*i))
                    .reduce(|a, b| join(&a, &b)),
                second => all[at + 1].as_ref().zip(all[second as usize].as_ref()).map(|(a, b)| join(a, b)),
            };
            all[at] = children;
        }
        all.into_iter().flatten().collect()
    }
}
