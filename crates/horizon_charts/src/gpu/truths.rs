//! Truth pictures, which take a minute at full size: computed once, and kept beside the tables.

use std::fs;

use bevy_horizon_workspace::views::Seen;
use horizon_field::march::{Anchored, Counts};
use horizon_field::truth::{TruthCamera, TruthPicture, TruthPixel};

use crate::context::Context;
use crate::experiment::ChartsError;

/// Numbers of a pixel in the file.
const NUMBERS: usize = 4;

/// The truth about a view from this camera, from the file of that name where it is of the same camera.
pub fn truth(ctx: &Context, name: &str, seen: &Seen, camera: TruthCamera) -> Result<TruthPicture, ChartsError> {
    let file = ctx.out.join("truths").join(format!("{name}.f64"));
    let mut head = Vec::new();
    for axis in [camera.position, camera.right, camera.up, camera.forward] {
        head.extend(axis);
    }
    head.extend([camera.width as f64, camera.height as f64, f64::from(seen.view.far), camera.footprint(1.0)]);
    if let Some(pixels) = fs::read(&file).ok().and_then(|bytes| parse(&bytes, &head)) {
        return Ok(TruthPicture { camera, pixels, counts: Counts::default() });
    }
    let surface = Anchored::new(&seen.ground, &seen.place);
    let truth = surface.picture(camera, f64::from(seen.view.far), 2);
    let numbers = truth.pixels.iter().flat_map(|p| [p.t, p.range[0], p.range[1], f64::from(u8::from(p.silhouette))]);
    let bytes: Vec<u8> = head.iter().copied().chain(numbers).flat_map(f64::to_le_bytes).collect();
    fs::create_dir_all(ctx.out.join("truths")).map_err(ChartsError::io(&file))?;
    fs::write(&file, bytes).map_err(ChartsError::io(&file))?;
    Ok(truth)
}

/// The pixels of a file with this head, all of them.
fn parse(bytes: &[u8], head: &[f64]) -> Option<Vec<TruthPixel>> {
    let numbers: Vec<f64> =
        bytes.chunks_exact(8).map(|bytes| f64::from_le_bytes(bytes.try_into().expect("eight bytes"))).collect();
    let pixels = numbers.strip_prefix(head)?.chunks_exact(NUMBERS);
    let pixels: Vec<_> = pixels.map(|p| TruthPixel { t: p[0], range: [p[1], p[2]], silhouette: p[3] != 0.0 }).collect();
    let [width, height] = [head[12] as usize, head[13] as usize];
    (pixels.len() == width * height).then_some(pixels)
}
