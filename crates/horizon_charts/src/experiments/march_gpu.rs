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
/// How many times as long as ours a rival may take before slower ones are no longer tried.
const SLOW: f64 = 25.0;
/// Error budgets of ours, in pixels.
const BUDGETS: [f32; 2] = [0.5, 4.0];

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
fn others() -> [Method; 4] {
    [
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

    /// A rival's row, over so many frames. What is only tried, in one frame, takes its count of evaluations from the small
    /// size, where one is there.
    fn rival(&self, method: Method, frames: usize, counted: Option<f64>) -> Result<MarchRow, ChartsError> {
        let rig = self.rival.get_or_init(|| {
            let shot = Shot { size: self.size, camera: HorizonCamera::default(), rival: Some(method), zoom: 1.0 };
            Rig::new(self.seen, shot).into()
        });
        let mut rig = rig.borrow_mut();
        rig.move_to(0.0);
        rig.set_rival(method);
        let cost = rig.cost(frames, STEP);
        rig.move_to(FRAMES as f64 * STEP);
        let evaluations = counted.unwrap_or_else(|| rig.work()[0]);
        let (name, settings) = named(&method);
        row(self.ctx, &mut rig, (name, settings), cost, frames, [evaluations, 0.0])
    }

    fn ours(&self, budget: f32) -> Result<MarchRow, ChartsError> {
        let camera = HorizonCamera { error_budget: budget, ..HorizonCamera::default() };
        let mut rig = Rig::new(self.seen, Shot { size: self.size, camera, rival: None, zoom: 1.0 });
        let cost = rig.cost(FRAMES, STEP);
        let work = [cost.texels / rig.rays(), rig.work()[1]];
        row(self.ctx, &mut rig, (OURS.into(), format!("budget={budget}")), cost, FRAMES, work)
    }
}

fn row(
    ctx: &Context,
    rig: &mut Rig,
    (method, settings): (String, String),
    cost: Cost,
    frames: usize,
    [evals_per_ray, loads_per_ray]: [f64; 2],
) -> Result<MarchRow, ChartsError> {
    let report = rig.report(ctx)?;
    Ok(MarchRow {
        run: ctx.run,
        device: Device::Gpu,
        view: rig.view().to_owned(),
        evals_per_ray,
        loads_per_ray,
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
        let methods = if ctx.quick { fixed_steps().into_iter().step_by(17).collect() } else { fixed_steps() };
        for method in methods.into_iter().chain(others()) {
            let (name, settings) = named(&method);
            if !table.has(&(Device::Gpu, seen.view.name.into(), name, settings)) {
                table.push(small.rival(method, 2, None)?)?;
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
        // From the fastest at the small size to the slowest, until one is as exact as ours is by default.
        let mut order: Vec<(&MarchRow, Method)> = Vec::new();
        for method in fixed_steps() {
            let (method_name, settings) = named(&method);
            let found =
                grid.iter().find(|row| row.view == name && row.method == method_name && row.settings == settings);
            order.extend(found.filter(|row| hopeful(row, &ours[0])).map(|row| (row, method)));
        }
        order.sort_by(|a, b| a.0.ms.total_cmp(&b.0.ms));
        let mut best: Option<(MarchRow, Method)> = None;
        for (small, method) in &order {
            let tried = full.rival(*method, 1, Some(small.evals_per_ray))?;
            let (reaches, last_ms) = (tried.is_no_worse_than(&ours[0]), tried.ms);
            if !reaches {
                table.push(tried.clone())?;
            }
            if reaches || best.as_ref().is_none_or(|(best, _)| march::most_exact([best, &tried]) == Some(&tried)) {
                best = Some((tried, *method));
            }
            // What takes so much longer, and all that is slower, can but make the ratio larger.
            let slow = last_ms > SLOW * ours[0].total_ms();
            if reaches || slow {
                break;
            }
        }
        // That one, or the most exact where none is, is timed as well as ours is.
        if let Some((_, method)) = best {
            table.push(full.rival(method, ctx.pick(3, FRAMES), None)?)?;
        }
        let [.., relaxed, _] = others();
        table.push(full.rival(relaxed, 1, None)?)?;
        Ok(())
    }
}

/// Whether a setting may be as exact as ours at full size. An error in metres is the same at both sizes, so that in pixels it
/// grows with their number: eightfold. Half of that is asked for, as the two pictures see different rays.
fn hopeful(small: &MarchRow, ours: &MarchRow) -> bool {
    let growth = 0.5 * 1280.0 / SMALL[0] as f64;
    small.missed <= ours.missed && small.false_hits <= ours.false_hits && small.ide_px_mean * growth <= ours.ide_px_mean
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
        // A quick run shows that it works: in the first view and the last.
        let views: Vec<_> = four().into_iter().step_by(ctx.pick(3, 1)).collect();
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
