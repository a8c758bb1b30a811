//! A view on a stage, by a method, at a size: what it costs, and how far it is off.

use bevy::prelude::Projection;
use bevy::prelude::{PerspectiveProjection, default};
use bevy::render::RenderApp;
use bevy_horizon::prelude::*;
use bevy_horizon::render::cache::Caches;
use bevy_horizon::render::rivals::{RivalMarch, RivalsPlugin};
use bevy_horizon_workspace::stage::{FOV, NEAR, Stage};
use bevy_horizon_workspace::views::{Seen, distances, truth_camera};
use horizon_field::march::Anchored;
use horizon_field::methods::Method;
use horizon_field::metrics::Report;

use super::truth;
use crate::context::Context;
use crate::experiment::ChartsError;
use crate::measure::samples::median;

/// How a view is drawn.
#[derive(Clone, Debug)]
pub struct Shot {
    /// The picture's size, in pixels.
    pub size: [usize; 2],
    /// How the camera draws.
    pub camera: HorizonCamera,
    /// The rival that draws in place of the cache, if one does.
    pub rival: Option<Method>,
    /// How many times as long the focal length is as the stage's.
    pub zoom: f32,
}

/// What frames cost, in milliseconds of the device.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cost {
    /// The ground's passes: the median over the frames.
    pub ground: f64,
    /// The cache's passes: the mean, as they come in bursts.
    pub fill: f64,
    /// Whole frames on the clock: the median.
    pub frame: f64,
    /// The longest of them.
    pub worst: f64,
    /// Texels filled in a frame, on average.
    pub texels: f64,
}

/// A view, ready to be measured.
pub struct Rig<'a> {
    stage: Stage,
    seen: &'a Seen,
    shot: Shot,
    travelled: f64,
}

const GROUND: [&str; 4] = ["horizon_clearance", "horizon_ground_scaled", "horizon_ground", "horizon_rival"];
const FILL: [&str; 3] = ["horizon_fill", "horizon_pyramid", "horizon_light"];

impl<'a> Rig<'a> {
    /// Sets the stage, and draws until the cache is filled.
    pub fn new(seen: &'a Seen, shot: Shot) -> Self {
        let [width, height] = shot.size.map(|side| side as u32);
        let mut stage = Stage::with_plugins((HorizonPlugins, RivalsPlugin), width, height);
        stage.light();
        stage.world().insert_resource(WorldOrigin(seen.place));
        stage.world().spawn(Terrain::new(seen.view.field.clone()));
        let camera = stage.camera;
        let fov = 2.0 * ((FOV / 2.0).tan() / shot.zoom).atan();
        let lens = Projection::Perspective(PerspectiveProjection { fov, near: NEAR, ..default() });
        stage.world().entity_mut(camera).insert((HorizonCamera { far: seen.view.far, ..shot.camera.clone() }, lens));
        if let Some(method) = shot.rival {
            stage.world().entity_mut(camera).insert(RivalMarch(method));
        }
        let mut rig = Self { stage, seen, shot, travelled: 0.0 };
        rig.go(0.0);
        if rig.shot.rival.is_some() {
            for _ in 0..3 {
                rig.stage.frame();
            }
        } else {
            rig.stage.settle();
        }
        rig
    }

    fn go(&mut self, metres: f64) {
        self.travelled += metres;
        self.stage.look(self.seen.pose(self.travelled));
    }

    /// Draws so many frames, in each of which the camera goes on by so many metres.
    pub fn cost(&mut self, frames: usize, metres: f64) -> Cost {
        // What went before is not counted.
        self.spent(&GROUND);
        self.spent(&FILL);
        let before = self.tiles();
        let mut ground = GROUND.map(|_| Vec::new());
        let (mut total, mut fill) = (Vec::new(), 0.0);
        for _ in 0..frames {
            self.go(metres);
            total.push(self.stage.frame());
            for (times, name) in ground.iter_mut().zip(GROUND) {
                times.extend(self.stage.spent(name));
            }
            fill += self.spent(&FILL);
        }
        let ground = ground.into_iter().filter(|times| !times.is_empty()).map(median).sum();
        let texels = (self.tiles() - before) as f64 * 4096.0 / frames as f64;
        let worst = total.iter().copied().fold(0.0, f64::max);
        Cost { ground, fill: fill / frames as f64, frame: median(total), worst, texels }
    }

    /// Another rival draws.
    pub fn set_rival(&mut self, method: Method) {
        let camera = self.stage.camera;
        self.stage.world().entity_mut(camera).insert(RivalMarch(method));
        self.shot.rival = Some(method);
        // Timestamps come back a frame late: those of the last method with this frame, and those of this frame with the next.
        self.stage.frame();
    }

    /// The camera is so many metres from where it began, without having been between.
    pub fn move_to(&mut self, travelled: f64) {
        self.travelled = travelled;
        self.go(0.0);
    }

    /// The view's name.
    pub fn view(&self) -> &'static str {
        self.seen.view.name
    }

    /// Rays of a picture.
    pub fn rays(&self) -> f64 {
        (self.shot.size[0] * self.shot.size[1]) as f64
    }

    fn spent(&mut self, passes: &[&'static str]) -> f64 {
        passes.iter().flat_map(|name| self.stage.spent(name)).sum()
    }

    fn tiles(&self) -> u64 {
        self.stage.off.app.sub_app(RenderApp).world().resource::<Caches>().tiles_filled()
    }

    /// What the next frame's rays cost on average: turns of ours, evaluations of a rival's; and loads of heights and bounds.
    pub fn work(&mut self) -> [f64; 2] {
        let camera = self.stage.camera;
        let set = |stage: &mut Stage, view: DebugView| {
            stage.world().get_mut::<HorizonCamera>(camera).expect("the stage's camera draws worlds").debug = view;
        };
        set(&mut self.stage, DebugView::Work);
        self.stage.frame();
        let picture = self.stage.colour();
        set(&mut self.stage, DebugView::None);
        self.stage.frame();
        [0, 1].map(|channel| picture.iter().map(|pixel| f64::from(pixel[channel])).sum::<f64>() / picture.len() as f64)
    }

    /// How far the next frame is off the truth, from where the camera stands now.
    pub fn report(&mut self, ctx: &Context) -> Result<Report, ChartsError> {
        let pose = self.seen.pose(self.travelled);
        let fov = 2.0 * ((FOV / 2.0).tan() / self.shot.zoom).atan();
        let camera = truth_camera(&pose, fov, self.shot.size);
        let [width, height] = self.shot.size;
        let name = format!("{}_{width}x{height}_{}_{:.3}", self.seen.view.name, self.shot.zoom, self.travelled);
        let truth = truth(ctx, &name, self.seen, camera)?;
        let depth = self.stage.depth();
        let surface = Anchored::new(&self.seen.ground, &self.seen.place);
        Ok(Report::new(&surface, &truth, &distances(&depth, &camera, NEAR)))
    }
}
