//! What is proven of an image over a rectangle of texels: exact from the control values where they are few, else from
//! a pyramid of minima and maxima.

use super::Edge;
use super::image::HeightImage;

/// Texels per block of the pyramid's finest level. Finer rectangles look at the texels themselves.
const BLOCK: usize = 8;

/// Up to how many control values per axis a rectangle is bounded from the texels themselves.
const FINE: usize = 12;

/// A level of the pyramid: the smallest and the largest texel of each block.
#[derive(Debug)]
struct Level {
    width: usize,
    blocks: Vec<[u16; 2]>,
}

/// Minima and maxima of an image's blocks: 8×8 texels, then twice as coarse each, down to one.
#[derive(Debug)]
pub(super) struct RangePyramid {
    levels: Vec<Level>,
    /// The largest differences between neighbours along x and z.
    steps: [u16; 2],
}

/// What is proven over a rectangle, with values in [0, 1] and lengths in texels.
#[derive(Clone, Copy, Debug)]
pub(super) struct ImageBound {
    /// The smallest and the largest value.
    pub value: [f64; 2],
    /// The smallest and the largest slope along x and z.
    pub slope: [[f64; 2]; 2],
    /// The largest absolute second derivatives: along x, mixed, along z.
    pub curvature: [f64; 3],
}

fn hull(a: [u16; 2], b: [u16; 2]) -> [u16; 2] {
    [a[0].min(b[0]), a[1].max(b[1])]
}

impl RangePyramid {
    pub(super) fn new(image: &HeightImage) -> Self {
        let (width, height) = (image.width as usize, image.height as usize);
        let mut levels = vec![Level::reduced(width, height, BLOCK, |x, y| [image.texels[y * width + x]; 2])];
        loop {
            let last = &levels[levels.len() - 1];
            let (width, height) = (last.width, last.blocks.len() / last.width);
            if width == 1 && height == 1 {
                break;
            }
            let next = Level::reduced(width, height, 2, |x, y| last.blocks[y * width + x]);
            levels.push(next);
        }
        let (mut along_x, mut along_z) = (0, 0);
        for (y, row) in image.texels.chunks(width).enumerate() {
            // An image that repeats has one more difference: from the last texel to the first.
            let next =
                if y + 1 < height { &image.texels[(y + 1) * width..(y + 2) * width] } else { &image.texels[..width] };
            along_x = row.windows(2).map(|pair| pair[0].abs_diff(pair[1])).fold(along_x, u16::max);
            along_x = along_x.max(row[0].abs_diff(row[width - 1]));
            along_z = row.iter().zip(next).map(|(a, b)| a.abs_diff(*b)).fold(along_z, u16::max);
        }
        Self { levels, steps: [along_x, along_z] }
    }

    /// The range of all values, and a Lipschitz constant per texel.
    pub(super) fn everywhere(&self) -> ([f64; 2], f64) {
        let [low, high] = self.levels[self.levels.len() - 1].blocks[0].map(|v| f64::from(v) / 65535.0);
        let [x, z] = self.steps.map(|step| f64::from(step) / 65535.0);
        ([low, high], (x * x + z * z).sqrt())
    }

    /// Bounds for all points whose cells lie within `cells`, the first and the last of both axes.
    pub(super) fn bound(&self, image: &HeightImage, edge: Edge, cells: [[i64; 2]; 2]) -> ImageBound {
        // A patch is made of the control values from one before its cell to two after it.
        let touched = cells.map(|[first, last]| [first.saturating_sub(1), last.saturating_add(2)]);
        let count = touched.map(|[first, last]| last.saturating_sub(first).saturating_add(1));
        if count.iter().all(|count| *count <= FINE as i64) {
            return fine_bound(image, edge, touched.map(|[first, _]| first), count.map(|count| count as usize));
        }
        let inside = [inside(touched[0], image.width, edge), inside(touched[1], image.height, edge)];
        let value = self.range(inside).map(|v| f64::from(v) / 65535.0);
        let steps = self.steps.map(|step| f64::from(step) / 65535.0);
        ImageBound { value, slope: steps.map(|step| [-step, step]), curvature: [f64::INFINITY; 3] }
    }

    /// The smallest and the largest texel of a rectangle.
    fn range(&self, [columns, rows]: [[usize; 2]; 2]) -> [u16; 2] {
        let mut shift = BLOCK.trailing_zeros();
        let mut level = 0;
        let blocks = |[first, last]: [usize; 2], shift: u32| (last >> shift) - (first >> shift) + 1;
        while blocks(columns, shift).max(blocks(rows, shift)) > 4 {
            shift += 1;
            level += 1;
        }
        let Level { width, blocks } = &self.levels[level];
        let mut range = [u16::MAX, u16::MIN];
        for row in rows[0] >> shift..=rows[1] >> shift {
            for column in columns[0] >> shift..=columns[1] >> shift {
                range = hull(range, blocks[row * width + column]);
            }
        }
        range
    }
}

impl Level {
    /// A level whose blocks are `by`×`by` of another's.
    fn reduced(width: usize, height: usize, by: usize, at: impl Fn(usize, usize) -> [u16; 2]) -> Self {
        let coarse = width.div_ceil(by);
        let mut blocks = vec![[u16::MAX, u16::MIN]; coarse * height.div_ceil(by)];
        for y in 0..height {
            for x in 0..width {
                let block = &mut blocks[y / by * coarse + x / by];
                *block = hull(*block, at(x, y));
            }
        }
        Self { width: coarse, blocks }
    }
}

/// The texels of an axis that the coordinates from `first` to `last` may show, past the edge as well.
fn inside([first, last]: [i64; 2], size: u32, edge: Edge) -> [usize; 2] {
    let size = i64::from(size);
    let length = last.saturating_sub(first);
    let all = [0, size - 1];
    let range = match edge {
        Edge::Clamp => [first.clamp(0, size - 1), last.clamp(0, size - 1)],
        Edge::Repeat => {
            let first = first.rem_euclid(size);
            if length < size - first { [first, first + length] } else { all }
        }
        Edge::Mirror => {
            let first = first.rem_euclid(2 * size);
            let last = first.saturating_add(length);
            let mirrored = |i: i64| 2 * size - 1 - i;
            if last < size {
                [first, last]
            } else if last < 2 * size {
                if first < size { [first.min(mirrored(last)), size - 1] } else { [mirrored(last), mirrored(first)] }
            } else {
                all
            }
        }
    };
    range.map(|i| i as usize)
}

/// Bounds from the texels themselves. A derivative of a B-spline is a B-spline of lower degree of its control values'
/// differences, and each lies within the range of its control values.
fn fine_bound(image: &HeightImage, edge: Edge, first: [i64; 2], [width, height]: [usize; 2]) -> ImageBound {
    let mut texels = [[0.0; FINE]; FINE];
    for (j, row) in texels.iter_mut().enumerate().take(height) {
        let start = HeightImage::index(first[1].saturating_add(j as i64), image.height, edge) * image.width as usize;
        for (i, texel) in row.iter_mut().enumerate().take(width) {
            let column = HeightImage::index(first[0].saturating_add(i as i64), image.width, edge);
            *texel = f64::from(image.texels[start + column]) / 65535.0;
        }
    }
    let mut value = [f64::INFINITY, f64::NEG_INFINITY];
    let mut slope = [value; 2];
    let mut curvature = [0.0_f64; 3];
    let include = |range: &mut [f64; 2], v: f64| *range = [range[0].min(v), range[1].max(v)];
    for j in 0..height {
        for i in 0..width {
            let c = texels[j][i];
            include(&mut value, c);
            if i + 1 < width {
                include(&mut slope[0], texels[j][i + 1] - c);
            }
            if j + 1 < height {
                include(&mut slope[1], texels[j + 1][i] - c);
            }
            if i + 2 < width {
                curvature[0] = curvature[0].max((texels[j][i + 2] - 2.0 * texels[j][i + 1] + c).abs());
            }
            if i + 1 < width && j + 1 < height {
                curvature[1] = curvature[1].max((texels[j + 1][i + 1] - texels[j + 1][i] - texels[j][i + 1] + c).abs());
            }
            if j + 2 < height {
                curvature[2] = curvature[2].max((texels[j + 2][i] - 2.0 * texels[j + 1][i] + c).abs());
            }
        }
    }
    ImageBound { value, slope, curvature }
}
