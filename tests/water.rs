//! Water in pictures, through the whole plugin: where its surface lies, and what is seen on it, through it and in it.

mod bodies;
mod horizon;
mod light;
mod meshes;
mod pan;
mod refusals;
mod samples;
mod shore;
mod surface;
mod within;

use bevy::ecs::system::RunSystemOnce;
use bevy::prelude::*;
use bevy::render::RenderApp;
use bevy::render::render_resource::{CachedPipelineState, PipelineCache};
use bevy_horizon::prelude::*;
use bevy_horizon::render::ready::Progress;
use bevy_horizon_workspace::stage::{FOV, NEAR, Stage};

/// A stage of this size with water on the level 0, whose time stands; without light.
fn stage(size: [u32; 2], water: Water) -> Stage {
    let mut stage = Stage::new(size[0], size[1]);
    stage.world().resource_mut::<Time<Virtual>>().pause();
    stage.world().spawn(water);
    stage
}

/// Water without waves and without ripples.
fn still() -> Water {
    Water { waves: Waves::Still, ripples: 0.0, ..default() }
}

/// Frames until all is made. Still water alone has nothing that is counted.
fn settle(stage: &mut Stage) {
    (0..6).for_each(|_| stage.off.update());
    if stage.world().resource::<Progress>().get().total > 0 {
        stage.settle();
    }
    accepted(stage);
}

/// The device took everything.
fn accepted(stage: &Stage) {
    assert!(stage.off.app.should_exit().is_none(), "the device refused something");
    for pipeline in stage.off.app.sub_app(RenderApp).world().resource::<PipelineCache>().pipelines() {
        assert!(matches!(pipeline.state, CachedPipelineState::Ok(_)), "{:?}", pipeline.state);
    }
}

/// What the query answers under each point, at the water's time moved on by so many seconds.
fn answers(stage: &mut Stage, points: Vec<Vec3>, later: f64) -> Vec<Option<f32>> {
    let time = stage.world().resource::<WaterTime>().0 + later;
    let ask = move |water: HorizonQuery| points.iter().map(|p| water.water_height(*p, time)).collect::<Vec<_>>();
    stage.world().run_system_once(ask).expect("the query's resources are there")
}

/// A perspective camera: how a picture's pixels and the world go together.
#[derive(Clone, Copy)]
struct Eye {
    pose: Transform,
    fov: f32,
    size: [u32; 2],
}

impl Eye {
    /// With the stage's field of view.
    fn new(pose: Transform, size: [u32; 2]) -> Self {
        Self { pose, fov: FOV, size }
    }

    /// Straight down from a place, x to the right, z down.
    fn down(at: Vec3, fov: f32, size: [u32; 2]) -> Self {
        Self { pose: Transform::from_translation(at).looking_to(Vec3::NEG_Y, Vec3::NEG_Z), fov, size }
    }

    /// Becomes a stage's camera.
    fn put(&self, stage: &mut Stage) {
        stage.look(self.pose);
        let camera = stage.camera;
        let lens = PerspectiveProjection { fov: self.fov, near: NEAR, ..default() };
        stage.world().entity_mut(camera).insert(Projection::Perspective(lens));
    }

    /// The picture's extent, in pixels.
    fn extent(&self) -> Vec2 {
        Vec2::new(self.size[0] as f32, self.size[1] as f32)
    }

    /// Half the picture's width and height at a distance of 1.
    fn half(&self) -> Vec2 {
        let [width, height] = self.size.map(|side| side as f32);
        Vec2::new(width / height, 1.0) * (0.5 * self.fov).tan()
    }

    /// How many pixels there are.
    fn pixels(&self) -> usize {
        (self.size[0] * self.size[1]) as usize
    }

    /// The centre of a pixel, row by row.
    fn centre(&self, i: usize) -> Vec2 {
        let width = self.size[0] as usize;
        Vec2::new((i % width) as f32, (i / width) as f32) + 0.5
    }

    /// Where a point of the picture looks: 1 long along the view's axis.
    fn ahead(&self, pixel: Vec2) -> Vec3 {
        let ndc = (pixel / self.extent() - 0.5) * Vec2::new(2.0, -2.0);
        self.pose.rotation * (ndc * self.half()).extend(-1.0)
    }

    /// What is drawn at a pixel's centre, by its depth.
    fn point(&self, i: usize, depth: f32) -> Vec3 {
        self.pose.translation + self.ahead(self.centre(i)) * (NEAR / depth)
    }

    /// The point of the picture that looks to a direction; it must lie before the camera.
    fn towards(&self, direction: Vec3) -> Vec2 {
        let p = self.pose.rotation.inverse() * direction;
        (p.truncate() / (-p.z * self.half()) * Vec2::new(0.5, -0.5) + 0.5) * self.extent()
    }

    /// The pixel that shows a point.
    fn pixel(&self, point: Vec3) -> usize {
        let at = self.towards(point - self.pose.translation);
        assert!(at.cmpge(Vec2::ZERO).all() && at.cmplt(self.extent()).all(), "{point} is not in view: {at}");
        at.y as usize * self.size[0] as usize + at.x as usize
    }

    /// Where a point of the picture looks at the plane at a height.
    fn on_plane(&self, pixel: Vec2, height: f32) -> Option<Vec3> {
        let ahead = self.ahead(pixel);
        let t = (height - self.pose.translation.y) / ahead.y;
        (t.is_finite() && t > 0.0).then(|| self.pose.translation + ahead * t)
    }

    /// Pixels that are drawn as nothing is in them, nor a pixel around them.
    fn misplaced(&self, drawn: impl Fn(usize) -> bool, truth: impl Fn(Vec2) -> bool) -> usize {
        let around = [[0.0, 0.0], [-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]];
        let wrong = |i: &usize| around.iter().all(|by| truth(self.centre(*i) + Vec2::from_array(*by)) != drawn(*i));
        (0..self.pixels()).filter(wrong).count()
    }
}

/// Every number of a picture is one.
fn finite(colours: &[[f32; 4]]) -> bool {
    colours.iter().flatten().all(|x| x.is_finite() && *x >= 0.0)
}
