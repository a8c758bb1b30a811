//! What stands where: the one function that the queries and the picture share.
//!
//! Cells are taken by tiles, each with an anchor of its own, so that a plant has the same bits whichever block asks for it.
//! Within a tile the fields are evaluated in batches, and whatever a cheap rule leaves out, dear ones don't see: the hash,
//! then the density, the ground's height, its slope, the stamps.

use std::sync::Arc;

use super::cells::{Block, cell_corner, cell_of};
use super::check::ForestError;
use super::felled::Felled;
use super::forest::Forest;
use super::plant::{Plant, PlantId};
use crate::field::{Compiled, Field, ImageSource};
use crate::hash::{hash2, pcg};
use crate::real::Jet;
use crate::stamp::Stamps;
use crate::{FieldError, Place};

/// Cells along a tile's edge.
pub(super) const TILE: i64 = 16;

/// What keeps a forest's hashes apart from those of noise with the same seed.
const SALT: u32 = 0x7472_6565;

/// The ground that plants stand on.
#[derive(Clone, Copy, Debug)]
pub struct PlantGround<'a> {
    /// The field.
    pub field: &'a Compiled<2>,
    /// The stamps on it.
    pub stamps: &'a Stamps,
}

/// A forest, checked and ready to be asked. Cheap to clone.
#[derive(Clone, Debug)]
pub struct Planting {
    parts: Arc<Parts>,
}

#[derive(Debug)]
struct Parts {
    forest: Forest,
    density: Compiled<2>,
    species_of: Compiled<2>,
}

impl Forest {
    /// Checks the forest, and makes it ready; `path` is what messages call it.
    ///
    /// # Errors
    /// What [`Forest::check`] refuses, and fields that can't be computed.
    pub fn compile(&self, path: &str, images: &dyn ImageSource) -> Result<Planting, ForestError> {
        self.check(path)?;
        let compiled = |name: &str, field: &Field| {
            field
                .compile(images)
                .map_err(|error: FieldError| ForestError::Field { path: format!("{path}.{name}"), error })
        };
        let density = compiled("density", &self.density)?;
        let species_of = compiled("species_of", &self.species_of)?;
        // As the device has it: then multiples of it are exact.
        let forest = Self { spacing: f64::from(self.spacing as f32), ..self.clone() };
        Ok(Planting { parts: Arc::new(Parts { forest, density, species_of }) })
    }
}

/// A cell in which something may grow.
#[derive(Clone, Copy)]
struct Candidate {
    cell: [i64; 2],
    hash: u32,
    offset: [u16; 2],
}

/// A share of 1, from some bits.
fn share(bits: u32) -> f64 {
    f64::from(bits & 0xffff) / 65535.0
}

impl Candidate {
    fn new(cell: [i64; 2], forest: &Forest) -> Self {
        let hash = hash2(cell, forest.seed ^ SALT);
        let place = pcg(hash.wrapping_add(1));
        let offset = [place, place >> 16].map(|bits| {
            let at = 0.5 + forest.jitter * (share(bits) - 0.5);
            (65535.0 * at).round() as u16
        });
        Self { cell, hash, offset }
    }

    /// Random bits, its own.
    fn bits(&self, which: u32) -> u32 {
        pcg(self.hash.wrapping_add(which))
    }

    /// Where it stands, from a corner of cells, in metres.
    fn at(&self, corner: [i64; 2], spacing: f64) -> [f64; 2] {
        [0, 1].map(|k| (self.cell[k].wrapping_sub(corner[k]) as f64 + f64::from(self.offset[k]) / 65535.0) * spacing)
    }

    /// Whether it stands, where this share of cells holds a plant.
    fn stands(&self, density: f64) -> bool {
        f64::from(self.bits(2)) < density * 4_294_967_296.0
    }
}

impl Planting {
    /// The forest; its spacing is rounded to single precision.
    pub fn forest(&self) -> &Forest {
        &self.parts.forest
    }

    /// The height of the tallest plant, in metres.
    pub fn tallest(&self) -> f64 {
        self.forest().species.iter().map(|species| species.height[1]).fold(0.0, f64::max)
    }

    /// All plants of a block of cells, tile by tile.
    pub fn plants(&self, ground: PlantGround<'_>, felled: &Felled, block: Block) -> Vec<Plant> {
        let mut plants = Vec::new();
        if block.size.contains(&0) {
            return plants;
        }
        let first = block.corner.map(|cell| cell.div_euclid(TILE));
        let tiles =
            [0, 1].map(|k| (block.corner[k].rem_euclid(TILE) + i64::from(block.size[k]) - 1).div_euclid(TILE) + 1);
        for z in 0..tiles[1] {
            for x in 0..tiles[0] {
                self.tile(ground, felled, [first[0].wrapping_add(x), first[1].wrapping_add(z)], &block, &mut plants);
            }
        }
        plants
    }

    /// The plants that stand in a rectangle of the plane, from its corner of the least x and z on, in metres.
    ///
    /// # Errors
    /// A rectangle of more than [`MAX_CELLS`](super::MAX_CELLS) cells.
    pub fn plants_in(
        &self,
        ground: PlantGround<'_>,
        felled: &Felled,
        corner: &Place,
        size: [f64; 2],
    ) -> Result<Vec<Plant>, ForestError> {
        let block = Block::over(corner, size, self.forest().spacing)?;
        let mut plants = self.plants(ground, felled, block);
        plants.retain(|plant| {
            let [x, _, z] = plant.place.minus(corner);
            (0.0..=size[0]).contains(&x) && (0.0..=size[1]).contains(&z)
        });
        Ok(plants)
    }

    /// The plant of this name, if it stands.
    pub fn plant(&self, ground: PlantGround<'_>, felled: &Felled, id: PlantId) -> Option<Plant> {
        self.plants(ground, felled, Block { corner: id.0, size: [1; 2] }).pop()
    }

    /// The cell that holds a place.
    pub fn cell_of(&self, place: &Place) -> [i64; 2] {
        cell_of(place, self.forest().spacing).0
    }

    /// Appends the plants of a tile that are in a block.
    fn tile(&self, ground: PlantGround<'_>, felled: &Felled, tile: [i64; 2], block: &Block, plants: &mut Vec<Plant>) {
        let Parts { forest, density, species_of } = &*self.parts;
        let corner = tile.map(|tile| tile.wrapping_mul(TILE));
        let anchor = cell_corner(corner, forest.spacing);

        let cells = (0..TILE * TILE).map(|i| [corner[0].wrapping_add(i % TILE), corner[1].wrapping_add(i / TILE)]);
        let standing = cells.filter(|cell| block.holds(*cell) && !felled.holds(PlantId(*cell)));
        let mut left: Vec<Candidate> = standing.map(|cell| Candidate::new(cell, forest)).collect();
        let places = |left: &[Candidate]| -> Vec<[f64; 2]> {
            left.iter().map(|candidate| candidate.at(corner, forest.spacing)).collect()
        };

        let stamps = ground.stamps.at(&anchor);
        let kept = |q: [f64; 2]| if ground.stamps.is_empty() { 1.0 } else { 1.0 - stamps.clearing(q) };
        let mut q = places(&left);
        let mut values = vec![0.0; q.len()];
        density.values_f64(&density.anchor(&anchor), &q, 0.0, &mut values);
        let mut shares =
            values.iter().zip(&q).map(|(density, q)| if *density > 0.0 { density * kept(*q) } else { 0.0 });
        left.retain(|candidate| shares.next().is_some_and(|share| candidate.stands(share)));
        if left.is_empty() {
            return;
        }

        q = places(&left);
        let anchors = ground.field.anchor(&anchor);
        values.resize(q.len(), 0.0);
        ground.field.values_f64(&anchors, &q, 0.0, &mut values);
        // How steep it is under a plant is a matter of the plant's own scale, not of the pebbles there.
        let mut grounds = vec![Jet::constant(0.0); q.len()];
        ground.field.jets_f64(&anchors, &q, forest.spacing, &mut grounds);
        for ((jet, height), q) in grounds.iter_mut().zip(&values).zip(&q) {
            jet.v = *height;
            if !ground.stamps.is_empty() {
                *jet = stamps.jet(*q, 0.0, *jet);
            }
        }
        species_of.values_f64(&species_of.anchor(&anchor), &q, 0.0, &mut values);

        for (((candidate, q), jet), kind) in left.iter().zip(&q).zip(&grounds).zip(&values) {
            let highest = forest.tree_line - forest.ragged * share(candidate.bits(3));
            let [gx, gz] = jet.g;
            let steep = gx * gx + gz * gz > forest.steepest * forest.steepest;
            if jet.v >= forest.level + forest.shore && jet.v <= highest && !steep {
                plants.push(forest.grown(candidate, anchor.translated([q[0], jet.v, q[1]]), jet.g, *kind));
            }
        }
    }
}

impl Forest {
    /// What grows from a candidate, on ground of this gradient, where `species_of` has this value.
    fn grown(&self, candidate: &Candidate, place: Place, [gx, gz]: [f64; 2], kind: f64) -> Plant {
        let sizes = candidate.bits(4);
        let (age, slender) = (share(sizes), share(sizes >> 16));
        let looks = candidate.bits(5);
        let count = self.species.len();
        let kind = kind + self.mixing * (share(looks >> 8) - 0.5);
        let which = ((kind * count as f64).max(0.0) as usize).min(count - 1);
        let species = &self.species[which];
        let height = species.height[0] + age * (species.height[1] - species.height[0]);
        let up = 1.0 / (1.0 + gx * gx + gz * gz).sqrt();
        Plant {
            id: PlantId(candidate.cell),
            place,
            offset: candidate.offset,
            height: height as f32,
            // Up to a fifth slimmer than its species is.
            radius: (species.radius * height * (1.0 - 0.2 * slender)) as f32,
            species: which as u8,
            turn: looks as u8,
            tint: (255.0 * age).round() as u8,
            hash: candidate.hash,
            normal: [(-gx * up) as f32, (-gz * up) as f32],
        }
    }
}
