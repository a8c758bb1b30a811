//! Woods on hills, and views of them: the rays, and the truth about each.

use std::thread;

use horizon_field::field::{Compiled, Field, Fractal, NoImages};
use horizon_field::march::{Anchored, Cast, Ray};
use horizon_field::trees::{
    Cone, Felled, Forest, Grove, PlantGround, PlantShape, Planting, Solid, Species, Wind, nearest_truth,
};
use horizon_field::truth::{Projection, TruthCamera};
use horizon_field::{Place, Stamps};

use crate::experiment::ChartsError;

/// How far rays are followed, in metres: the truth tries every plant.
pub const FAR: f64 = 300.0;
/// Vertical field of view, in radians.
const FOV: f64 = core::f64::consts::FRAC_PI_3;
/// By how many footprints a neighbour's distance is another: the pixel is then a silhouette. Foliage is rough, ground is not.
const SILHOUETTE: f64 = 6.0;
/// How fine the way back to the canopy's edge is looked at, in metres.
const FINE: f64 = 0.02;

/// The ground.
pub fn hills() -> Field {
    Fractal { wavelength: 600.0, amplitude: 90.0, octaves: 7.0, gain: 0.4, seed: 12, ..Fractal::default() }.into()
}

/// What grows on it, with such a density: dense woods of two kinds.
pub fn forest(density: Field) -> Forest {
    let spruce = Species { shape: PlantShape::Conifer, height: [6.0, 12.0], radius: 0.24, ..Species::default() };
    Forest { density, steepest: 100.0, shore: -1e6, species: vec![Species::default(), spruce], ..Forest::default() }
}

/// Where a camera stands, and how it looks.
#[derive(Clone, Copy, Debug)]
pub struct View {
    /// Its name.
    pub name: &'static str,
    /// How far above the ground at the world's origin, in metres.
    pub above: f64,
    /// Where it looks, before it is normalised.
    pub forward: [f64; 3],
}

/// The views: under the crowns, over them, and past them into the sky.
pub const VIEWS: [View; 3] = [
    View { name: "under", above: 2.0, forward: [0.2, 0.0, -1.0] },
    View { name: "over", above: 25.0, forward: [0.2, -0.25, -1.0] },
    View { name: "past", above: 10.0, forward: [-0.6, 0.04, 0.8] },
];

/// The woods.
pub struct Woods {
    field: Compiled<2>,
    canopy: Compiled<2>,
    stamps: Stamps,
    felled: Felled,
    planting: Planting,
}

/// A ray of a picture, and what is known of it before plants are looked for.
#[derive(Clone, Copy, Debug)]
pub struct Sight {
    /// The ray.
    pub ray: Ray,
    /// Where it ends: at the ground, or at [`FAR`].
    pub end: f64,
    /// Whether the ground is there.
    pub ground: bool,
    /// Where it is nowhere before within the canopy, which reaches as high over the ground as the tallest plant.
    pub nearest: f64,
    /// Where it enters the canopy last.
    pub farthest: f64,
}

/// The truth about a pixel.
#[derive(Clone, Copy, Debug)]
pub struct Truth {
    /// Where the ray through its centre meets a plant.
    pub t: Option<f64>,
    /// Whether, half a pixel away, that is elsewhere.
    pub silhouette: bool,
}

impl Woods {
    /// The woods, as they stand.
    pub fn new() -> Result<Self, ChartsError> {
        let planting = forest(Field::Constant(0.6)).compile("forest", &NoImages)?;
        let raised = Field::Add(vec![hills(), Field::Constant(planting.tallest())]);
        Ok(Self {
            field: hills().compile(&NoImages)?,
            canopy: raised.compile(&NoImages)?,
            stamps: Stamps::default(),
            felled: Felled::default(),
            planting,
        })
    }

    fn ground(&self) -> PlantGround<'_> {
        PlantGround { field: &self.field, stamps: &self.stamps }
    }

    /// The woods around rays.
    pub fn grove(&self) -> Grove<'_> {
        Grove::new(&self.planting, self.ground(), &self.felled)
    }

    /// A view's camera. Its x and z are metres from the world's origin.
    pub fn camera(&self, view: &View, size: [usize; 2]) -> TruthCamera {
        let height = Anchored::new(&self.field, &Place::ORIGIN).value([0.0; 2]);
        let eye = [0.0, height + view.above, 0.0];
        let target = [0, 1, 2].map(|k| eye[k] + view.forward[k]);
        TruthCamera::looking_at(eye, target, Projection::Perspective { fov: FOV }, size)
    }

    /// A pixel's width along a camera's rays.
    pub fn cone(camera: &TruthCamera) -> Cone {
        Cone { start: 0.0, growth: camera.footprint(1.0) }
    }

    /// The rays through the pixels' centres.
    pub fn sights(&self, camera: &TruthCamera) -> Vec<Sight> {
        let ground = Anchored::new(&self.field, &Place::ORIGIN);
        let canopy = Anchored::new(&self.canopy, &Place::ORIGIN);
        let of = |pixel: usize| {
            let ray = camera.pixel_ray(pixel);
            let hit = ground.cast(&ray, FAR).hit();
            let end = hit.map_or(FAR, |hit| hit.t);
            let nearest = match canopy.cast(&ray, end) {
                Cast::Hit(hit) => hit.t,
                Cast::Miss => end,
                Cast::Inside => 0.0,
            };
            let above = |t: f64| {
                let [x, y, z] = ray.at(t);
                y >= canopy.value([x, z])
            };
            let mut farthest = end;
            while farthest > nearest && !above(farthest) {
                farthest -= FINE;
            }
            Sight { ray, end, ground: hit.is_some(), nearest, farthest: farthest.max(nearest) }
        };
        (0..camera.width * camera.height).map(of).collect()
    }

    /// The truth about a camera's pixels, of all plants within [`FAR`].
    pub fn truth(&self, camera: &TruthCamera, threads: usize) -> Result<Vec<Truth>, ChartsError> {
        let half = FAR + self.planting.forest().spacing;
        let corner = Place::from_metres([-half, 0.0, -half]);
        let plants = self.planting.plants_in(self.ground(), &self.felled, &corner, [2.0 * half; 2])?;
        let species = &self.planting.forest().species;
        let standing: Vec<([f64; 2], Solid<f64>)> = plants
            .iter()
            .map(|plant| {
                let [x, _, z] = plant.place.minus(&Place::ORIGIN);
                let species = &species[usize::from(plant.species)];
                ([x, z], Solid::new(plant, species, [x, plant.foot(), z], &Wind::default()))
            })
            .collect();
        let width = 2 * camera.width + 1;
        let mut grid = vec![None; width * (2 * camera.height + 1)];
        let rows = grid.len() / width;
        thread::scope(|scope| {
            for (i, band) in grid.chunks_mut(width * rows.div_ceil(threads.max(1))).enumerate() {
                let first = i * rows.div_ceil(threads.max(1)) * width;
                let standing = &standing;
                scope.spawn(move || {
                    for (j, t) in band.iter_mut().enumerate() {
                        let at = first + j;
                        *t = self.meets(standing, &camera.ray([at % width, at / width]), Self::cone(camera));
                    }
                });
            }
        });
        let judged = |pixel: usize| {
            let [x, y] = [pixel % camera.width, pixel / camera.width];
            let t: Option<f64> = grid[(2 * y + 1) * width + 2 * x + 1];
            let jumps = |other: Option<f64>| match (t, other) {
                (Some(t), Some(other)) => (t - other).abs() > SILHOUETTE * camera.footprint(t),
                (t, other) => t.is_some() != other.is_some(),
            };
            Truth { t, silhouette: (0..9).any(|i| jumps(grid[(2 * y + i / 3) * width + 2 * x + i % 3])) }
        };
        Ok((0..camera.width * camera.height).map(judged).collect())
    }

    /// Where a ray meets a plant before the ground. Plants whose trunk is farther from the ray than a plant may reach, which is
    /// half a cell, are not looked at.
    fn meets(&self, standing: &[([f64; 2], Solid<f64>)], ray: &Ray, cone: Cone) -> Option<f64> {
        let end = Anchored::new(&self.field, &Place::ORIGIN).cast(ray, FAR).hit().map_or(FAR, |hit| hit.t);
        let reach = 0.5 * self.planting.forest().spacing;
        let ([x, _, z], [dx, _, dz]) = (ray.origin(), ray.direction());
        let flat = (dx * dx + dz * dz).max(1e-12);
        let mut near: Vec<(f64, &Solid<f64>)> = standing
            .iter()
            .filter_map(|([at_x, at_z], solid)| {
                let [off_x, off_z] = [at_x - x, at_z - z];
                let t = ((off_x * dx + off_z * dz) / flat).clamp(0.0, end);
                let [off_x, off_z] = [off_x - t * dx, off_z - t * dz];
                (off_x * off_x + off_z * off_z <= reach * reach).then_some((t, solid))
            })
            .collect();
        // From the nearest on: then what lies behind it is soon done with.
        near.sort_by(|a, b| a.0.total_cmp(&b.0));
        let solids: Vec<Solid<f64>> = near.into_iter().map(|(_, solid)| solid.clone()).collect();
        nearest_truth(&solids, ray.origin(), ray.direction(), end, cone).map(|(_, t, _)| t)
    }
}
