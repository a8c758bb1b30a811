//! Speed against accuracy on the device: seed 000's march over a grid of its four parameters, the other rivals, and the
//! cache, in four views, at a small size and at full size.

use std::cell::OnceCell;

use bevy_horizon::prelude::HorizonCamera;
use bevy_horizon_workspace::views::{Seen, four};
use horizon_field::Place;
use horizon_field::methods::Method;
use serde_json::{Map, Value};

use crate::context::Context;
use crate::experiment::{ChartsError, Experiment, NamedChart};
use crate::gpu::{Cost, Rig, Shot};
use crate::march::{self, Device, MarchRow, OURS};
use crate::store::Table;

/// The experiment.
#[derive(Clone, Copy, Debug)]
pub struct MarchGpu;

const GRID: &str = "march_grid";
const FULL: &str = "march";
/// Metres that the camera goes in a frame: 10 m/s at 60 frames a second.
const STEP: f64 = 10.0 / 60.0;
const SMALL: [usize; 2] = [160, 90];
/// Frames over which the medians that count are taken.
const FRAMES: usize = 20;
/// Error budgets of ours, in pixels.
const BUDGETS: [f32; 3] = [0.5, 4.0, 8.0];

/// Seed 000's march over its parameters.
fn fixed_steps() -> Vec<Method> {
    let mut grid = Vec::new();
    for a in [0.5, 2.0, 10.0] {
        for b in [0.001, 0.004, 0.01] {
            for c in [0.1, 0.3, 0.5, 0.9] {
                for k in [2, 10] {
                    grid.push(Method::FixedStep { a, b, c, k });
                }
            }
        }
    }
    grid
}

/// The other rivals that the device can draw.
fn others() -> Vec<Method> {
    vec![
        Method::Linear { delta: 0.02 },
        Method::Linear { delta: 0.01 },
        Method::SphereTracing { omega: 1.6, pixel: 0.05 },
        Method::SphereTracing { omega: 1.0, pixel: 0.05 },
    ]
}

fn named(method: &Method) -> (String, String) {
    match method {
        Method::FixedStep { a, b, c, k } => ("fixed step".into(), format!("a={a} b={b} c={c} k={k}")),
        Method::Linear { delta } => ("linear".into(), format!("delta={delta}")),
        Method::SphereTracing { omega, .. } if *omega > 1.0 => ("over-relaxed".into(), format!("omega={omega}")),
        _ => ("sphere tracing".into(), String::new()),
    }
}

/// A rig that is made when it is first needed.
struct Lazy<'a> {
    ctx: &'a Context,
    seen: &'a Seen,
    size: [usize; 2],
    rival: OnceCell<std::cell::RefCell<Rig<'a>>>,
}

impl<'a> Lazy<'a> {
    fn new(ctx: &'a Context, seen: &'a Seen, size: [usize; 2]) -> Self {
        Self { ctx, seen, size, rival: OnceCell::new() }
    }

    /// A rival's row, over about so many frames, at least one; fewer where a frame takes long and `patience` runs out.
    fn rival(&self, method: Method, frames: usize) -> Result<MarchRow, ChartsError> {
        let rig = self.rival.get_or_init(|| {
            let shot = Shot { size: self.size, camera: HorizonCamera::default(), rival: Some(method), zoom: 1.0 };
            Rig::new(self.seen, shot).into()
        });
        let mut rig = rig.borrow_mut();
        rig.set_rival(method);
        rig.move_to(0.0);
        let cost = rig.cost(frames, STEP);
        rig.move_to(FRAMES as f64 * STEP);
        let (name, settings) = named(&method);
        row(self.ctx, &mut rig, name, settings, cost, frames)
    }

    fn ours(&self, budget: f32) -> Result<MarchRow, ChartsError> {
        let camera = HorizonCamera { error_budget: budget, ..HorizonCamera::default() };
        let mut rig = Rig::new(self.seen, Shot { size: self.size, camera, rival: None, zoom: 1.0 });
        let cost = rig.cost(FRAMES, STEP);
        row(self.ctx, &mut rig, OURS.into(), format!("budget={budget}"), cost, FRAMES)
    }
}

fn row(
    ctx: &Context,
    rig: &mut Rig,
    method: String,
    settings: String,
    cost: Cost,
    frames: usize,
) -> Result<MarchRow, ChartsError> {
    let [evaluations, loads] = rig.work();
    let report = rig.report(ctx)?;
    Ok(MarchRow {
        run: ctx.run,
        device: Device::Gpu,
        view: rig.view().to_owned(),
        evals_per_ray: if method == OURS { cost.texels / rig.rays() } else { evaluations },
        loads_per_ray: if method == OURS { loads } else { 0.0 },
        method,
        settings,
        frames: frames as u64,
        ms: cost.ground,
        fill_ms: cost.fill,
        missed: report.missed as u64,
        false_hits: report.false_hits as u64,
        silhouette_share: report.silhouette_share(),
        ide_px_mean: report.ide_pixels.mean,
        normal_px_p99: report.surface.p99,
        hde_px_mean: report.hde_pixels.mean,
    })
}

impl MarchGpu {
    /// All settings at the small size.
    fn grid(&self, ctx: &Context, seen: &Seen, table: &mut Table<MarchRow>) -> Result<(), ChartsError> {
        let small = Lazy::new(ctx, seen, SMALL);
        let methods = if ctx.quick { fixed_steps().into_iter().step_by(11).collect() } else { fixed_steps() };
        for method in methods.into_iter().chain(others()) {
            let (name, settings) = named(&method);
            if !table.has(&(Device::Gpu, seen.view.name.into(), name, settings)) {
                table.push(small.rival(method, 3)?)?;
            }
        }
        Ok(())
    }

    /// Ours, and the rivals that come into question against it, at full size.
    fn full(
        &self,
        ctx: &Context,
        seen: &Seen,
        grid: &[MarchRow],
        table: &mut Table<MarchRow>,
    ) -> Result<(), ChartsError> {
        let name = seen.view.name;
        let full = Lazy::new(ctx, seen, ctx.pick([240, 135], [1280, 720]));
        let mut ours = Vec::new();
        for budget in BUDGETS {
            let row = full.ours(budget)?;
            ours.push(row.clone());
            table.push(row)?;
        }
        // From the fastest at the small size to the slowest, until one is as exact as ours is by default, and another one,
        // as the two sizes may disagree about which is faster.
        let mut order: Vec<(f64, Method)> = Vec::new();
        for method in fixed_steps() {
            let (method_name, settings) = named(&method);
            let found =
                grid.iter().find(|row| row.view == name && row.method == method_name && row.settings == settings);
            // An error in pixels does not shrink with the pixels: what is too large there is too large here.
            let hopeful = |row: &&MarchRow| row.is_no_worse_than(&ours[0]);
            if let Some(row) = found.filter(hopeful) {
                order.push((row.ms, method));
            }
        }
        order.sort_by(|a, b| a.0.total_cmp(&b.0));
        let default = &ours[0];
        let mut reached = 0;
        for (_, method) in &order {
            let tried = full.rival(*method, 1)?;
            if tried.is_no_worse_than(default) {
                table.push(full.rival(*method, ctx.pick(3, FRAMES))?)?;
                reached += 1;
                if reached == 2 {
                    break;
                }
            } else {
                table.push(tried)?;
            }
        }
        if reached == 0 {
            // The most exact of them, timed as well as ours is.
            let tried: Vec<_> = table.rows().iter().filter(|row| row.view == name && !row.is_ours()).cloned().collect();
            if let Some(best) = march::most_exact(&tried) {
                let method = order.iter().map(|(_, method)| *method).find(|m| named(m).1 == best.settings);
                if let Some(method) = method {
                    table.push(full.rival(method, ctx.pick(3, FRAMES))?)?;
                }
            }
        }
        for method in others().into_iter().step_by(2) {
            table.push(full.rival(method, 1)?)?;
        }
        Ok(())
    }
}

impl Experiment for MarchGpu {
    fn name(&self) -> &'static str {
        "march"
    }

    fn about(&self) -> &'static str {
        "speed against accuracy of each way to march, on the device"
    }

    fn tables(&self) -> &'static [&'static str] {
        &[FULL, GRID]
    }

    fn measure(&self, ctx: &Context) -> Result<(), ChartsError> {
        let mut grid = ctx.table::<MarchRow>(GRID)?;
        let mut table = ctx.table::<MarchRow>(FULL)?;
        let views = four();
        let progress = ctx.progress(self.name(), 2 * views.len());
        for view in views {
            let name = view.name;
            let seen = Seen::new(view, Place::ORIGIN)?;
            self.grid(ctx, &seen, &mut grid)?;
            progress.done(&format!("{name}, grid"));
            if !table.rows().iter().any(|row| row.view == name && row.method == "over-relaxed") {
                self.full(ctx, &seen, grid.rows(), &mut table)?;
            }
            progress.done(&format!("{name}, full size"));
        }
        Ok(())
    }

    fn draw(&self, ctx: &Context) -> Result<Vec<NamedChart>, ChartsError> {
        Ok(march::charts(&ctx.rows(FULL)?, Device::Gpu))
    }

    fn summary(&self, ctx: &Context) -> Result<Map<String, Value>, ChartsError> {
        Ok(march::summary(&ctx.rows(FULL)?, Device::Gpu))
    }
}
