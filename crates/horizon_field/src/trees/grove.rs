//! Plants around rays: tiles of them, filled when a ray first comes near, and the cast through them.

use std::collections::HashMap;

use super::cast::{Cone, DualCells, PlantHit, PlantWork};
use super::cells::{Block, cell_corner, cell_of};
use super::felled::Felled;
use super::plant::Plant;
use super::planting::{PlantGround, Planting, TILE};
use super::solid::{Part, Solid};
use super::uniform::Wind;
use crate::Place;
use crate::march::{Anchored, Ray, Surface};
use crate::real::Real;

/// How far a ray is followed, in metres.
pub const FARTHEST: f64 = 1e5;

/// What rounding may take from a reach, in metres.
const HAIR: f64 = 1e-3;

/// The plants of one tile.
struct Tile {
    /// What is proven of the ground's height.
    ground: [f64; 2],
    /// Row by row; none before a ray comes near.
    plants: Option<Vec<Option<Plant>>>,
}

/// A forest on its ground, which remembers the plants that rays came near.
pub struct Grove<'a> {
    planting: &'a Planting,
    ground: PlantGround<'a>,
    felled: &'a Felled,
    wind: Wind,
    tallest: f64,
    tiles: Vec<Tile>,
    /// Which one is where.
    index: HashMap<[i64; 2], usize>,
    /// The last one that was asked for: mostly it is the next one, too.
    last: Option<([i64; 2], usize)>,
}

impl<'a> Grove<'a> {
    /// The forest, without wind.
    pub fn new(planting: &'a Planting, ground: PlantGround<'a>, felled: &'a Felled) -> Self {
        let tallest = planting.tallest();
        Self {
            planting,
            ground,
            felled,
            wind: Wind::default(),
            tallest,
            tiles: Vec::new(),
            index: HashMap::new(),
            last: None,
        }
    }

    /// The same in a wind.
    pub fn in_wind(self, wind: &Wind) -> Self {
        Self { wind: wind.within(self.planting.forest()), ..self }
    }

    /// The ground.
    #[cfg(feature = "baselines")]
    pub(super) fn ground(&self) -> PlantGround<'a> {
        self.ground
    }

    /// The plant of a cell, if one stands.
    pub fn plant(&mut self, cell: [i64; 2]) -> Option<Plant> {
        self.near(cell, [f64::NEG_INFINITY, f64::INFINITY])
    }

    /// The same, unless none of its tile can have a part between two heights.
    fn near(&mut self, cell: [i64; 2], heights: [f64; 2]) -> Option<Plant> {
        let key = cell.map(|cell| cell.div_euclid(TILE));
        let Self { planting, ground, felled, tallest, .. } = *self;
        let corner = key.map(|key| key.wrapping_mul(TILE));
        let at = match self.last {
            Some((last, at)) if last == key => at,
            _ => *self.index.entry(key).or_insert_with(|| {
                let half = 0.5 * TILE as f64 * planting.forest().spacing;
                let anchor = cell_corner(corner, planting.forest().spacing);
                let bound = Anchored::stamped(ground.field, ground.stamps, &anchor).bound([half; 2], [half; 2]);
                self.tiles.push(Tile { ground: [bound.low, bound.high], plants: None });
                self.tiles.len() - 1
            }),
        };
        self.last = Some((key, at));
        let tile = &mut self.tiles[at];
        if heights[1] < tile.ground[0] - tallest || heights[0] > tile.ground[1] + tallest {
            return None;
        }
        let plants = tile.plants.get_or_insert_with(|| {
            let mut rows = vec![None; (TILE * TILE) as usize];
            for plant in planting.plants(ground, felled, Block { corner, size: [TILE as u32; 2] }) {
                let [x, z] = [0, 1].map(|k| plant.id.0[k].wrapping_sub(corner[k]));
                rows[(z * TILE + x) as usize] = Some(plant);
            }
            rows
        });
        let [x, z] = cell.map(|cell| cell.rem_euclid(TILE));
        plants[(z * TILE + x) as usize]
    }

    /// The nearest plant that a ray meets within `t_max` metres, proven as [`Solid::truth`] proves it. The ray's x and z are
    /// metres from `place`, its y is the height above the world's zero; the ground is not in its way, and nothing farther than
    /// [`FARTHEST`] is looked at. `cone` says how fine the foliage is.
    pub fn cast(&mut self, place: &Place, ray: &Ray, t_max: f64, cone: Cone) -> Option<PlantHit> {
        let each = |solid: &Solid<f64>, start, direction, range, footprint, _: &mut PlantWork| {
            solid.truth(start, direction, range, footprint)
        };
        self.search(place, ray, t_max, cone, &mut PlantWork::default(), each)
    }

    /// The same as the picture has it, by [`Solid::cast`]: computed within each dual cell in `T`, and with its work counted.
    pub fn cast_as<T: Real>(
        &mut self,
        place: &Place,
        ray: &Ray,
        t_max: f64,
        cone: Cone,
        work: &mut PlantWork,
    ) -> Option<PlantHit> {
        self.search(place, ray, t_max, cone, work, Solid::<T>::cast)
    }

    /// Walks the dual cells, and asks `each` of four plants.
    fn search<T: Real>(
        &mut self,
        place: &Place,
        ray: &Ray,
        t_max: f64,
        cone: Cone,
        work: &mut PlantWork,
        each: impl Fn(&Solid<T>, [T; 3], [T; 3], [T; 2], T, &mut PlantWork) -> Option<(T, Part)>,
    ) -> Option<PlantHit> {
        let spacing = self.spacing();
        let (base, within) = cell_of(place, spacing);
        let [x, y, z] = ray.origin();
        let origin = [x + within[0], y, z + within[1]];
        let [dx, dy, dz] = ray.direction();
        let range = self.heights(ray, t_max)?;
        for (dual, [enter, leave]) in DualCells::new([origin[0], origin[2]], [dx, dz], spacing, range) {
            work.cells += 1;
            let ends = [enter, leave].map(|t| y + t * dy);
            let heights = [ends[0].min(ends[1]), ends[0].max(ends[1])];
            // From the corner that the four cells share, and from where the ray comes in: small numbers.
            let corner = dual.map(|dual| (dual + 1) as f64 * spacing);
            let start = [origin[0] + enter * dx - corner[0], y + enter * dy, origin[2] + enter * dz - corner[1]];
            let datum = start[1];
            let from = [start[0], 0.0, start[2]];
            let start = from.map(T::of);
            let direction = [dx, dy, dz].map(T::of);
            let mut nearest: Option<(T, Part, Plant)> = None;
            for side in [[0, 0], [1, 0], [0, 1], [1, 1]] {
                let cell = core::array::from_fn(|k| base[k].wrapping_add(dual[k] + side[k]));
                let Some(plant) = self.near(cell, heights) else { continue };
                work.plants += 1;
                let at = |k: usize| ((side[k] - 1) as f64 + f64::from(plant.offset[k]) / 65535.0) * spacing;
                let foot = [at(0), plant.foot() - datum, at(1)];
                if !self.may_meet(&plant, foot, [from[0], from[2]], [dx, dz], heights.map(|y| y - datum)) {
                    continue;
                }
                let solid = self.solid::<T>(&plant, foot);
                let footprint = T::of(cone.at(enter + solid.depth(start, direction).f64()));
                let end = nearest.as_ref().map_or(T::of(leave - enter), |(t, ..)| *t);
                if let Some((t, part)) = each(&solid, start, direction, [T::ZERO, end], footprint, work) {
                    nearest = Some((t, part, plant));
                }
            }
            if let Some((t, part, plant)) = nearest {
                let t = enter + t.f64();
                return Some(PlantHit { t, plant, part, normal: self.normal(place, ray, t, &plant, part, cone) });
            }
        }
        None
    }

    /// Whether a ray that is between two heights may meet a plant, by the upright cylinder that holds it: most rays pass by.
    fn may_meet(&self, plant: &Plant, foot: [f64; 3], [x, z]: [f64; 2], [dx, dz]: [f64; 2], heights: [f64; 2]) -> bool {
        let forest = self.planting.forest();
        let species = &forest.species[usize::from(plant.species)];
        let [height, radius] = [plant.height, plant.radius].map(f64::from);
        let reach = radius + species.lean * height + forest.sway + HAIR;
        let beside = (foot[0] - x) * dz - (foot[2] - z) * dx;
        beside * beside <= reach * reach * (dx * dx + dz * dz) + HAIR
            && heights[0] <= foot[1] + height + HAIR
            && heights[1] >= foot[1] - height - HAIR
    }

    /// The solid of a plant whose foot is at `foot` in some frame, in this wind.
    pub fn solid<T: Real>(&self, plant: &Plant, foot: [f64; 3]) -> Solid<T> {
        let species = &self.planting.forest().species[usize::from(plant.species)];
        Solid::new(plant, species, foot, &self.wind)
    }

    /// The cells' edge, in metres.
    pub fn spacing(&self) -> f64 {
        self.planting.forest().spacing
    }

    /// The part of a ray on which there can be plants.
    pub(super) fn heights(&self, ray: &Ray, t_max: f64) -> Option<[f64; 2]> {
        let (low, high) = self.ground.stamps.range(self.ground.field.range());
        let (y, dy) = (ray.origin()[1], ray.direction()[1]);
        let mut range = [0.0, t_max.clamp(0.0, FARTHEST)];
        if t_max.is_nan() {
            return None;
        }
        for (limit, sign) in [(high + self.tallest, 1.0), (low - self.tallest, -1.0)] {
            let (room, climb) = (sign * (limit - y), sign * dy);
            if climb == 0.0 && room < 0.0 {
                return None;
            }
            if climb > 0.0 {
                range[1] = range[1].min(room / climb);
            } else if climb < 0.0 {
                range[0] = range[0].max(room / climb);
            }
        }
        (range[0] <= range[1]).then_some(range)
    }

    fn normal(&self, place: &Place, ray: &Ray, t: f64, plant: &Plant, part: Part, cone: Cone) -> [f64; 3] {
        let [x, _, z] = plant.place.minus(place);
        let solid = self.solid::<f64>(plant, [x, plant.foot(), z]);
        let footprint = cone.at(solid.depth(ray.origin(), ray.direction()));
        solid.normal(part, ray.at(t), footprint.max(1e-3), solid.level(footprint))
    }
}
