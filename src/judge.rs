//! The drawn ground against the certified truth, view after view on one stage; and views drawn by lot.

use bevy::prelude::*;
use bevy_horizon::prelude::*;
use horizon_field::field::{Field, FieldError, Fractal, Noise, Warp};
use horizon_field::fractal::Rule;
use horizon_field::hash::pcg;
use horizon_field::march::Anchored;
use horizon_field::metrics::Report;
use horizon_field::noise::Basis;

use crate::stage::{FOV, NEAR, Stage};
use crate::views::{Seen, View, distances, truth_camera};

/// A stage whose pictures are held against the truth.
pub struct Judge {
    /// The stage.
    pub stage: Stage,
    terrain: Entity,
    size: [usize; 2],
}

impl Judge {
    /// A stage for pictures of this size.
    pub fn new(size: [usize; 2]) -> Self {
        let mut stage = Stage::new(size[0] as u32, size[1] as u32);
        let terrain = stage.world().spawn_empty().id();
        Self { stage, terrain, size }
    }

    /// Draws a view with Bevy's origin at `place`, and reports how far it is off the truth.
    pub fn report(&mut self, view: &View, place: Place) -> Result<Report, FieldError> {
        let seen = Seen::new(view.clone(), place)?;
        let (terrain, camera) = (self.terrain, self.stage.camera);
        let world = self.stage.world();
        world.insert_resource(WorldOrigin(place));
        world.entity_mut(terrain).insert(Terrain::new(view.field.clone()));
        world.get_mut::<HorizonCamera>(camera).expect("the stage's camera draws worlds").far = view.far;
        let pose = seen.pose(0.0);
        self.stage.look(pose);
        self.stage.settle();
        let depth = self.stage.depth();
        let camera = truth_camera(&pose, FOV, self.size);
        let surface = Anchored::new(&seen.ground, &place);
        let truth = surface.picture(camera, f64::from(view.far), 2);
        Ok(Report::new(&surface, &truth, &distances(&depth, &camera, NEAR)))
    }
}

/// Numbers by lot: the same for the same seed, on every machine.
struct Lot(u32);

impl Lot {
    /// Between two numbers.
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = pcg(self.0.wrapping_add(0x9e37_79b9));
        low + (high - low) * f64::from(self.0) / 4_294_967_296.0
    }

    fn one_of<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.between(0.0, all.len() as f64) as usize]
    }

    fn fractal(&mut self, wavelength: [f64; 2]) -> Fractal {
        let wavelength = self.between(wavelength[0], wavelength[1]);
        Fractal {
            rule: self.one_of(&[Rule::Fbm, Rule::Heterogeneous, Rule::Hybrid, Rule::Ridged]),
            basis: self.one_of(&[Basis::Value, Basis::Gradient, Basis::Simplex]),
            wavelength,
            amplitude: wavelength * self.between(0.05, 0.3),
            octaves: self.between(10.0, 16.0),
            lacunarity: self.between(1.8, 2.2),
            gain: self.between(0.4, 0.52),
            seed: self.between(0.0, 4e9) as u32,
            ..Fractal::default()
        }
    }
}

/// A field and a camera over it, by lot: fractals of all rules, some of them sums, some of them warped; cameras from a
/// metre to a kilometre above the ground, looking anywhere but up.
pub fn by_lot(seed: u32) -> View {
    let mut lot = Lot(pcg(seed));
    let first = Field::Fractal(lot.fractal([1000.0, 8000.0]));
    let field = match lot.between(0.0, 3.0) as u32 {
        0 => first,
        1 => Field::Add(vec![first, Field::Fractal(lot.fractal([300.0, 3000.0]))]),
        _ => {
            let shift = |lot: &mut Lot| {
                let wavelength = lot.between(500.0, 3000.0);
                Field::Noise(Noise {
                    wavelength,
                    amplitude: 0.15 * wavelength,
                    seed: lot.between(0.0, 4e9) as u32,
                    ..Noise::default()
                })
            };
            Field::Warp(Warp { field: first.into(), x: shift(&mut lot).into(), z: shift(&mut lot).into(), y: None })
        }
    };
    let heading = lot.between(0.0, core::f64::consts::TAU);
    View {
        name: "by lot",
        field,
        at: [lot.between(-1e4, 1e4), lot.between(-1e4, 1e4)],
        above: 10f64.powf(lot.between(0.0, 3.0)),
        forward: [heading.sin() as f32, lot.between(-0.8, 0.15) as f32, heading.cos() as f32],
        far: lot.between(5e3, 4e4) as f32,
    }
}
