//! Tables of two coordinates, with their texels at the ends of the range too, interpolated linearly. WGSL twin: `table.wgsl`.

use horizon_field::Real;

use super::air::Rgb;

/// `width` × `height` texels of `LAYERS` colours.
#[derive(Clone, Debug, PartialEq)]
pub struct Table<T, const LAYERS: usize> {
    /// Texels of the first coordinate, at least 2.
    pub width: usize,
    /// Texels of the second coordinate, at least 2.
    pub height: usize,
    /// Row by row.
    pub texels: Vec<[Rgb<T>; LAYERS]>,
}

impl<T: Real, const LAYERS: usize> Table<T, LAYERS> {
    /// A table of what `texel` says of each column and row.
    pub fn of(width: usize, height: usize, texel: impl Fn(usize, usize) -> [Rgb<T>; LAYERS]) -> Self {
        let texels = (0..width * height).map(|i| texel(i % width, i / width)).collect();
        Self { width, height, texels }
    }

    /// The value at coordinates in [0, 1], the nearest edge's outside.
    #[inline]
    pub fn at(&self, u: T, v: T) -> [Rgb<T>; LAYERS] {
        let ((x, along), (y, up)) = (cell(u, self.width), cell(v, self.height));
        let first = y * self.width + x;
        let [a, b] = [&self.texels[first], &self.texels[first + 1]];
        let [c, d] = [&self.texels[first + self.width], &self.texels[first + self.width + 1]];
        let mut value = [[T::ZERO; 3]; LAYERS];
        for l in 0..LAYERS {
            for k in 0..3 {
                let low = a[l][k] + (b[l][k] - a[l][k]) * along;
                let high = c[l][k] + (d[l][k] - c[l][k]) * along;
                value[l][k] = low + (high - low) * up;
            }
        }
        value
    }

    /// Bytes of the table as it is here, without padding.
    pub fn bytes(&self) -> usize {
        size_of_val(self.texels.as_slice())
    }
}

/// The texel before coordinate `u` of `count`, and how far `u` is on to the next.
#[inline]
pub(crate) fn cell<T: Real>(u: T, count: usize) -> (usize, T) {
    let x = u.clamp(T::ZERO, T::ONE) * T::of((count - 1) as f64);
    let first = x.floor().min(T::of((count - 2) as f64));
    (first.to_i64() as usize, x - first)
}

/// The coordinate of texel `i` of `count`.
#[inline]
pub(crate) fn coordinate<T: Real>(i: usize, count: usize) -> T {
    T::of(i as f64 / (count - 1) as f64)
}
