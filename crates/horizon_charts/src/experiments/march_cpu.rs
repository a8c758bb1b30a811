//! Speed against accuracy on the CPU: the rivals' twins, and what is certified without a cache.

use std::time::Instant;

use bevy_horizon_workspace::stage::FOV;
use bevy_horizon_workspace::views::{Seen, four, truth_camera};
use horizon_field::Place;
use horizon_field::march::Anchored;
use horizon_field::methods::{HeightField, Method, picture};
use horizon_field::metrics::Report;
use serde_json::{Map, Value};

use crate::context::Context;
use crate::experiment::{ChartsError, Experiment, NamedChart};
use crate::gpu::truth;
use crate::march::{self, Device, MarchRow};

/// The experiment.
#[derive(Clone, Copy, Debug)]
pub struct MarchCpu;

const TABLE: &str = "march_cpu";
const SIZE: [usize; 2] = [160, 90];

fn methods() -> Vec<(&'static str, String, Method)> {
    let mut all = Vec::new();
    for (a, b) in [(1.0, 0.004), (10.0, 0.01)] {
        all.push(("fixed step", format!("a={a} b={b} c=0.5 k=6"), Method::FixedStep { a, b, c: 0.5, k: 6 }));
    }
    all.push(("linear", "delta=0.01".into(), Method::Linear { delta: 0.01 }));
    for pixel in [0.05, 0.5] {
        for omega in [1.0, 1.6] {
            let name = if omega > 1.0 { "over-relaxed" } else { "sphere tracing" };
            all.push((name, format!("omega={omega} pixel={pixel}"), Method::SphereTracing { omega, pixel }));
        }
    }
    for pixel in [0.0, 0.05, 0.25] {
        all.push(("segment tracing", format!("pixel={pixel}"), Method::Segment { pixel }));
        all.push(("interval bisection", format!("pixel={pixel}"), Method::Bisection { pixel }));
    }
    all
}

impl Experiment for MarchCpu {
    fn name(&self) -> &'static str {
        "march_cpu"
    }

    fn about(&self) -> &'static str {
        "speed against accuracy on the CPU, with what is certified without a cache"
    }

    fn tables(&self) -> &'static [&'static str] {
        &[TABLE]
    }

    fn measure(&self, ctx: &Context) -> Result<(), ChartsError> {
        let mut table = ctx.table::<MarchRow>(TABLE)?;
        let views = four();
        let progress = ctx.progress(self.name(), views.len());
        for view in views {
            let name = view.name;
            let seen = Seen::new(view, Place::ORIGIN)?;
            let camera = truth_camera(&seen.pose(0.0), FOV, SIZE);
            let truth = truth(ctx, &format!("{name}_cpu"), &seen, camera)?;
            let ground = HeightField::new(&seen.ground, &seen.place);
            let surface = Anchored::new(&seen.ground, &seen.place);
            for (method_name, settings, method) in methods() {
                if table.has(&(Device::Cpu, name.into(), method_name.into(), settings.clone())) {
                    continue;
                }
                let start = Instant::now();
                let (depth, work) = picture(&method, &ground, &camera, f64::from(seen.view.far), 2);
                let ms = start.elapsed().as_secs_f64() * 1e3;
                let report = Report::new(&surface, &truth, &depth);
                table.push(MarchRow {
                    run: ctx.run,
                    device: Device::Cpu,
                    view: name.to_owned(),
                    method: method_name.to_owned(),
                    settings,
                    frames: 1,
                    ms,
                    fill_ms: 0.0,
                    evals_per_ray: work.evaluations as f64 / depth.len() as f64,
                    loads_per_ray: 0.0,
                    missed: report.missed as u64,
                    false_hits: report.false_hits as u64,
                    silhouette_share: report.silhouette_share(),
                    ide_px_mean: report.ide_pixels.mean,
                    normal_px_p99: report.surface.p99,
                    hde_px_mean: report.hde_pixels.mean,
                })?;
            }
            progress.done(name);
        }
        Ok(())
    }

    fn draw(&self, ctx: &Context) -> Result<Vec<NamedChart>, ChartsError> {
        Ok(march::charts(&ctx.rows(TABLE)?, Device::Cpu))
    }

    fn summary(&self, ctx: &Context) -> Result<Map<String, Value>, ChartsError> {
        Ok(march::summary(&ctx.rows(TABLE)?, Device::Cpu))
    }
}
