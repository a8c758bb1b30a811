//! A tile of plants as `grove.wgsl` reads it: records, and a pyramid of what the plants fill from below and above.

use horizon_field::trees::{Forest, MAX_SPECIES, Plant, RECORD_WORDS, Species};

use super::window::TILE;

/// Vectors of four words before the bounds: the records.
const BOUNDS: usize = (TILE * TILE) as usize * RECORD_WORDS / 4;
/// Nodes of the pyramid: 32² + 16² + 8² + 4² + 2² + 1.
const NODES: usize = 1365;
/// Words of a tile.
pub const TILE_WORDS: usize = 4 * (BOUNDS + 1 + NODES.div_ceil(4));

/// Metres that bounds are wider than the plants: more than all that f32 rounds.
const SLACK: f32 = 0.02;
const EMPTY: [f32; 2] = [f32::INFINITY, f32::NEG_INFINITY];

/// The lowest and the highest that each species' plants reach, in heights from the foot.
#[derive(Clone, Copy, Debug)]
pub struct Extents([[f32; 2]; MAX_SPECIES]);

impl Extents {
    /// Those of a forest.
    pub fn new(forest: &Forest) -> Self {
        let mut extents = [[0.0; 2]; MAX_SPECIES];
        for (extent, species) in extents.iter_mut().zip(&forest.species) {
            *extent = extent_of(species);
        }
        Self(extents)
    }

    fn of(&self, plant: &Plant) -> [f32; 2] {
        let foot = plant.foot() as f32;
        let [low, high] = self.0[usize::from(plant.species).min(MAX_SPECIES - 1)];
        [foot + low * plant.height - SLACK, foot + high * plant.height + SLACK]
    }
}

fn extent_of(species: &Species) -> [f32; 2] {
    let trunk = species.trunk_row();
    let rows = species.shape.crown().iter().chain(&trunk);
    rows.fold([0.0f32; 2], |[low, high], row| [low.min((row[0] - row[2]) as f32), high.max((row[0] + row[2]) as f32)])
}

fn joined(a: [f32; 2], b: [f32; 2]) -> [f32; 2] {
    [a[0].min(b[0]), a[1].max(b[1])]
}

/// A tile, as it is stored.
pub struct Packed {
    /// What the shaders read.
    pub words: Vec<u32>,
    /// The cells of the tile in which a plant stands: 32 z + x.
    pub standing: Vec<u16>,
    /// From where to where its plants reach, in metres above the datum; the lower is the higher where there are none.
    pub heights: [f32; 2],
}

/// A tile, from the plants of its cells and of those one cell beyond it along x and z.
pub fn pack(tile: [i64; 2], plants: &[Plant], extents: &Extents) -> Packed {
    let side = TILE as usize;
    let mut words = vec![0; TILE_WORDS];
    let mut standing = Vec::new();
    let mut cells = vec![EMPTY; (side + 1) * (side + 1)];
    for plant in plants {
        let [x, z] = [0, 1].map(|axis| plant.id.0[axis].wrapping_sub(tile[axis].wrapping_mul(TILE)));
        if !(0..=TILE).contains(&x) || !(0..=TILE).contains(&z) {
            continue;
        }
        let [x, z] = [x, z].map(|i| i as usize);
        cells[z * (side + 1) + x] = extents.of(plant);
        if x < side && z < side {
            standing.push((z * side + x) as u16);
            let at = RECORD_WORDS * (z * side + x);
            words[at..at + RECORD_WORDS].copy_from_slice(&plant.to_words(0.0));
        }
    }
    let dual = |i: usize| {
        let at = i / side * (side + 1) + i % side;
        [1, side + 1, side + 2].iter().fold(cells[at], |bounds, next| joined(bounds, cells[at + next]))
    };
    let mut nodes: Vec<_> = (0..side * side).map(dual).collect();
    let (mut from, mut width) = (0, side);
    while width > 1 {
        let half = width / 2;
        for i in 0..half * half {
            let at = from + i / half * 2 * width + i % half * 2;
            let node = [1, width, width + 1].iter().fold(nodes[at], |bounds, next| joined(bounds, nodes[at + next]));
            nodes.push(node);
        }
        (from, width) = (from + width * width, half);
    }
    let [low, high] = nodes[nodes.len() - 1];
    if low <= high {
        let unit = ((high - low) / 65_535.0).max(1e-6);
        words[4 * BOUNDS] = low.to_bits();
        words[4 * BOUNDS + 1] = unit.to_bits();
        for (word, [from, to]) in words[4 * BOUNDS + 4..].iter_mut().zip(&nodes) {
            if from <= to {
                let from = ((from - low) / unit).floor().clamp(0.0, 65_535.0) as u32;
                let to = ((to - low) / unit).ceil().clamp(1.0, 65_535.0) as u32;
                *word = from | to << 16;
            }
        }
    }
    Packed { words, standing, heights: [low, high] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use horizon_field::Place;
    use horizon_field::trees::PlantId;

    fn plant(cell: [i64; 2], foot: f64, height: f32) -> Plant {
        Plant {
            id: PlantId(cell),
            place: Place::from_metres([0.0, foot, 0.0]),
            offset: [0; 2],
            height,
            radius: 1.0,
            species: 0,
            turn: 0,
            tint: 0,
            hash: 0,
            normal: [0.0; 2],
        }
    }

    /// What the shader reads.
    fn bounds(words: &[u32], x: usize, z: usize, mip: usize) -> Option<[f32; 2]> {
        let i = (4096 - (4096 >> (2 * mip))) / 3 + (z >> mip) * (32 >> mip) + (x >> mip);
        let word = words[4 * (BOUNDS + 1) + i];
        let [base, unit] = [0, 1].map(|i| f32::from_bits(words[4 * BOUNDS + i]));
        (word != 0).then_some([base + unit * (word & 0xffff) as f32, base + unit * (word >> 16) as f32])
    }

    #[test]
    fn every_node_bounds_the_plants_that_reach_into_it() {
        let extents = Extents::new(&Forest::default());
        let tile = [-3, 7];
        let mut plants = Vec::new();
        for (i, z) in (0..=32).enumerate() {
            for x in (i % 5..=32).step_by(5) {
                let cell = [tile[0] * 32 + x as i64, tile[1] * 32 + z];
                plants.push(plant(cell, 800.0 + (x * 13 % 37) as f64 - 2.0 * z as f64, 4.0 + (x % 3) as f32));
            }
        }
        let Packed { words, standing, .. } = pack(tile, &plants, &extents);
        let own = |plant: &&Plant| (0..2).all(|axis| plant.id.0[axis].div_euclid(32) == tile[axis]);
        assert_eq!(standing.len(), plants.iter().filter(own).count());
        let mut loosest = 0.0f32;
        for plant in &plants {
            let [x, z] = [0, 1].map(|axis| plant.id.0[axis] - 32 * tile[axis]);
            let [low, high] = extents.of(plant);
            for (x, z) in [(x - 1, z - 1), (x, z - 1), (x - 1, z), (x, z)] {
                if !(0..32).contains(&x) || !(0..32).contains(&z) {
                    continue;
                }
                for mip in 0..6 {
                    let found = bounds(&words, x as usize, z as usize, mip).expect("a plant is there");
                    assert!(found[0] <= low + SLACK && found[1] >= high - SLACK, "{found:?} of {low} to {high}");
                }
            }
            loosest = loosest.max(high - low);
        }
        assert!(loosest > 4.0);
    }

    #[test]
    fn an_empty_tile_is_zeros() {
        let empty = pack([0, 0], &[], &Extents::new(&Forest::default()));
        assert!(empty.words.iter().all(|word| *word == 0) && empty.standing.is_empty());
        // A neighbour's plant is in the bounds, but not among the records.
        let Packed { words, standing, .. } =
            pack([0, 0], &[plant([32, 5], 10.0, 5.0)], &Extents::new(&Forest::default()));
        assert!(standing.is_empty());
        assert!(words[..4 * BOUNDS].iter().all(|word| *word == 0));
        assert!(bounds(&words, 31, 5, 0).is_some() && bounds(&words, 31, 4, 0).is_some());
        assert!(bounds(&words, 30, 5, 0).is_none() && bounds(&words, 31, 6, 0).is_none());
    }

    #[test]
    fn the_shader_has_the_same_sizes() {
        let shader = include_str!("grove.wgsl");
        assert!(shader.contains(&format!("const GROVE_BOUNDS: u32 = {BOUNDS}u;")));
        assert!(shader.contains(&format!("const GROVE_STRIDE: u32 = {}u;", TILE_WORDS / 4)));
        assert!(shader.contains(&format!("const GROVE_TILE: u32 = {TILE}u;")));
    }
}
