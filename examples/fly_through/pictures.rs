//! Frames and film as files, written by a thread of their own so that drawing does not wait.

use std::error::Error;
use std::fs::{self, File};
use std::io::BufWriter;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{SyncSender, sync_channel};
use std::thread::JoinHandle;

use image::RgbaImage;
use png::{BitDepth, ColorType, Compression, Encoder, Filter, Writer};

/// What can go wrong, for a person to read.
pub type Failure = Box<dyn Error + Send + Sync>;

/// Pictures that may wait for the thread.
const QUEUE: usize = 8;

/// A thread that writes PNG frames, and all of them as one animated PNG.
pub struct Pictures {
    queue: SyncSender<RgbaImage>,
    thread: JoinHandle<Result<(), Failure>>,
    frames: PathBuf,
    film: PathBuf,
}

impl Pictures {
    /// Starts to write so many frames of this size into a directory; older frames in it go.
    pub fn start(directory: &Path, size: [u32; 2], count: u32, fps: u16) -> Result<Self, Failure> {
        let named = |error| format!("{}: {error}", directory.display());
        fs::create_dir_all(directory).map_err(named)?;
        let directory = directory.canonicalize().map_err(named)?;
        for entry in fs::read_dir(&directory).map_err(named)?.flatten() {
            if is_frame(&entry.file_name().to_string_lossy()) {
                fs::remove_file(entry.path()).map_err(named)?;
            }
        }
        let film = directory.join("film.png");
        let mut writer = film_writer(&film, size, count, fps)?;
        let frames = directory.clone();
        let (queue, pictures) = sync_channel::<RgbaImage>(QUEUE);
        let thread = std::thread::spawn(move || {
            for (index, picture) in pictures.iter().enumerate() {
                let rgb = image::DynamicImage::from(picture).into_rgb8();
                rgb.save(directory.join(format!("frame_{index:04}.png")))?;
                writer.write_image_data(&rounded(rgb.into_raw()))?;
            }
            Ok(writer.finish()?)
        });
        Ok(Self { queue, thread, frames, film })
    }

    /// The next frame. Waits only if the thread is far behind.
    pub fn push(&self, picture: RgbaImage) {
        // A thread that failed takes no more; `finish` says why.
        let _ = self.queue.send(picture);
    }

    /// Waits until all is written, and says where the frames and the film are.
    pub fn finish(self) -> Result<(PathBuf, PathBuf), Failure> {
        drop(self.queue);
        self.thread.join().map_err(|_| "the thread that writes pictures panicked")??;
        Ok((self.frames, self.film))
    }
}

/// Whether a file is a frame of an earlier film.
fn is_frame(name: &str) -> bool {
    let number = name.strip_prefix("frame_").and_then(|name| name.strip_suffix(".png"));
    number.is_some_and(|number| number.len() >= 4 && number.bytes().all(|byte| byte.is_ascii_digit()))
}

fn film_writer(
    path: &Path,
    [width, height]: [u32; 2],
    count: u32,
    fps: u16,
) -> Result<Writer<BufWriter<File>>, Failure> {
    let file = File::create(path).map_err(|error| format!("{}: {error}", path.display()))?;
    let mut encoder = Encoder::new(BufWriter::new(file), width, height);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::Balanced);
    encoder.set_filter(Filter::Paeth);
    encoder.set_animated(count, 0)?;
    encoder.set_frame_delay(1, fps)?;
    Ok(encoder.write_header()?)
}

/// Six bits a channel: the film takes half the space, and in motion nobody sees it. The frames keep all eight.
fn rounded(mut bytes: Vec<u8>) -> Vec<u8> {
    for byte in &mut bytes {
        *byte = (byte.saturating_add(2) & 0xFC) | (*byte >> 6);
    }
    bytes
}
