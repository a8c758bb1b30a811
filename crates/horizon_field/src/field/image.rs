//! Height images, as uniform cubic B-splines: C², and inside the convex hull of the texels around. `image.wgsl` is the
//! twin. Coordinates are texels; a texel's value is the control value at its centre.

use std::path::{Component, Path, PathBuf};

use ::image::{ImageDecoder, codecs::png::PngDecoder};

use super::Edge;
use super::check::MAX_IMAGE;
use crate::lattice::LatticePoint;
use crate::real::{Jet, Real};

/// The WGSL twin. It reads the binding `field_images`, two texels a word.
pub(super) const WGSL: &str = include_str!("image.wgsl");

/// A grey image of heights.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct HeightImage {
    /// Texels along x.
    pub width: u32,
    /// Texels along z.
    pub height: u32,
    /// Rows from −z to +z, each from −x to +x; 0 is black, 65535 white.
    pub texels: Vec<u16>,
}

impl HeightImage {
    /// Decodes a PNG of 8 or 16 bits; of colours, the luminance is taken. Its size is looked at before its texels.
    pub fn from_png(bytes: &[u8]) -> Result<Self, String> {
        let decoder = PngDecoder::new(std::io::Cursor::new(bytes)).map_err(|error| error.to_string())?;
        let (width, height) = decoder.dimensions();
        if width > MAX_IMAGE || height > MAX_IMAGE {
            return Err(format!("{width} × {height} texels are more than {MAX_IMAGE} each"));
        }
        let image = ::image::DynamicImage::from_decoder(decoder).map_err(|error| error.to_string())?;
        Ok(Self { width, height, texels: image.into_luma16().into_raw() })
    }

    /// Whether there are as many texels as the size says, and no more of them than allowed.
    pub(super) fn is_valid(&self) -> bool {
        (1..=MAX_IMAGE).contains(&self.width)
            && (1..=MAX_IMAGE).contains(&self.height)
            && self.texels.len() == self.width as usize * self.height as usize
    }

    /// The index of texel `i` of an axis with `size` texels, past the edge as well.
    pub(super) fn index(i: i64, size: u32, edge: Edge) -> usize {
        let size = i64::from(size);
        let index = match edge {
            Edge::Clamp => i.clamp(0, size - 1),
            Edge::Repeat => i.rem_euclid(size),
            Edge::Mirror => {
                let i = i.rem_euclid(2 * size);
                i.min(2 * size - 1 - i)
            }
        };
        index as usize
    }

    /// The 4×4 control values, as 0 to 65535, of the patch whose first inner texel is `cell`.
    fn control(&self, cell: [i64; 2], edge: Edge) -> [[u16; 4]; 4] {
        let column: [usize; 4] =
            core::array::from_fn(|k| Self::index(cell[0].wrapping_add(k as i64 - 1), self.width, edge));
        core::array::from_fn(|j| {
            let row = Self::index(cell[1].wrapping_add(j as i64 - 1), self.height, edge) * self.width as usize;
            column.map(|column| self.texels[row + column])
        })
    }

    /// The value, in [0, 1], and the gradient per texel. The cell is the texel whose centre lies next on the left.
    #[inline]
    pub(super) fn jet<T: Real>(&self, at: &LatticePoint<T, 2>, edge: Edge) -> Jet<T, 2> {
        let control = self.control(at.cell, edge);
        let ([wx, dx], [wz, dz]) = (spline(at.fraction[0]), spline(at.fraction[1]));
        let mut jet = Jet::constant(T::ZERO);
        for (row, (wz, dz)) in control.iter().zip(wz.into_iter().zip(dz)) {
            let (mut v, mut d) = (T::ZERO, T::ZERO);
            for (texel, (wx, dx)) in row.iter().zip(wx.into_iter().zip(dx)) {
                let texel = T::of_u32(u32::from(*texel));
                v += wx * texel;
                d += dx * texel;
            }
            jet.v += wz * v;
            jet.g[0] += wz * d;
            jet.g[1] += dz * v;
        }
        let white = T::of(1.0 / 65535.0);
        Jet { v: jet.v * white, g: jet.g.map(|g| g * white) }
    }

    /// The texels as the kernel reads them: two a word, the first one in the low half.
    pub(super) fn words(&self) -> impl Iterator<Item = u32> + '_ {
        self.texels.chunks(2).map(|pair| u32::from(pair[0]) | pair.get(1).map_or(0, |high| u32::from(*high) << 16))
    }
}

/// The weights of four control values in a uniform cubic B-spline, and their derivatives.
#[inline(always)]
fn spline<T: Real>(t: T) -> [[T; 4]; 2] {
    let (sixth, half) = (T::of(1.0 / 6.0), T::of(0.5));
    let (two, three, four) = (T::of(2.0), T::of(3.0), T::of(4.0));
    let s = T::ONE - t;
    [
        [
            s * s * s * sixth,
            (t * t * (three * t - two * three) + four) * sixth,
            (s * s * (three * s - two * three) + four) * sixth,
            t * t * t * sixth,
        ],
        [-(s * s * half), t * (three * t - four) * half, -(s * (three * s - four) * half), t * t * half],
    ]
}

/// Where images come from.
pub trait ImageSource {
    /// The image of this path, or why it can't be had.
    fn load(&self, path: &str) -> Result<HeightImage, String>;
}

/// No images at all.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoImages;

impl ImageSource for NoImages {
    fn load(&self, _: &str) -> Result<HeightImage, String> {
        Err("there is no image source".into())
    }
}

/// PNG images under a directory. Paths that lead out of it are refused.
#[derive(Clone, Debug)]
pub struct ImageDirectory {
    root: PathBuf,
}

impl ImageDirectory {
    /// Images under `root`.
    pub fn new(root: impl Into<PathBuf>) -> Self {
        Self { root: root.into() }
    }
}

impl ImageSource for ImageDirectory {
    fn load(&self, path: &str) -> Result<HeightImage, String> {
        if Path::new(path).components().any(|part| !matches!(part, Component::Normal(_) | Component::CurDir)) {
            return Err("the path leads out of the directory of images".into());
        }
        let bytes = std::fs::read(self.root.join(path)).map_err(|error| error.to_string())?;
        HeightImage::from_png(&bytes)
    }
}
