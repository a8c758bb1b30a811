//! Draws the pictures that models of the sky are measured against, by all orders of scattering in double precision: those of
//! `reference::picture`. Some two minutes on one core.
//!
//! `cargo run -p horizon_light --example pictures -- assets/truth`

use std::error::Error;
use std::fs::File;
use std::path::PathBuf;

use horizon_light::medium::Medium;
use horizon_light::reference::orders::{Orders, Resolution};
use horizon_light::reference::picture::{HEIGHT, VIEWS, WIDTH};
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder};

fn main() -> Result<(), Box<dyn Error>> {
    let directory = PathBuf::from(std::env::args().nth(1).ok_or("say into which directory")?);
    let medium = Medium::BRUNETON;
    let sky = Orders::new(&medium, Resolution::FINE, 1e-4);
    for view in VIEWS {
        let picture = view.picture(&medium, |ray| sky.radiance(&ray));
        let file = File::create(directory.join(view.file()))?;
        let encoder = PngEncoder::new_with_quality(file, CompressionType::Best, FilterType::Adaptive);
        encoder.write_image(picture.as_flattened(), WIDTH as u32, HEIGHT as u32, ExtendedColorType::Rgb8)?;
        eprintln!("sun at {}°: done", view.sun_zenith);
    }
    Ok(())
}
