//! The scalar that the mathematics is generic over: `f32`, as the device computes, and `f64`, as truths are computed.

use core::fmt::Debug;
use core::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

/// A floating-point scalar. Only exactly rounded operations are here, so that results are bit-identical across
/// platforms: no `sin`, `exp` or `pow`, which differ between C libraries, and no fused multiply-add.
pub trait Real:
    Copy
    + Debug
    + PartialOrd
    + Default
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
{
    /// 0.
    const ZERO: Self;
    /// 1.
    const ONE: Self;
    /// The nearest value to `x`.
    fn of(x: f64) -> Self;
    /// The nearest value to `x`.
    fn of_u32(x: u32) -> Self;
    /// Widened to `f64`.
    fn f64(self) -> f64;
    /// The largest integer not above.
    fn floor(self) -> Self;
    /// Truncated to an integer, saturating.
    fn to_i64(self) -> i64;
    /// The square root, correctly rounded.
    fn sqrt(self) -> Self;
    /// The absolute value.
    fn abs(self) -> Self;
    /// The smaller one.
    fn min(self, other: Self) -> Self;
    /// The larger one.
    fn max(self, other: Self) -> Self;
    /// Limited to `[low, high]`.
    fn clamp(self, low: Self, high: Self) -> Self {
        self.max(low).min(high)
    }
}

macro_rules! real {
    ($t:ty) => {
        impl Real for $t {
            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;
            #[inline(always)]
            fn of(x: f64) -> Self {
                x as $t
            }
            #[inline(always)]
            fn of_u32(x: u32) -> Self {
                x as $t
            }
            #[inline(always)]
            fn f64(self) -> f64 {
                self as f64
            }
            #[inline(always)]
            fn floor(self) -> Self {
                <$t>::floor(self)
            }
            #[inline(always)]
            fn to_i64(self) -> i64 {
                self as i64
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                <$t>::sqrt(self)
            }
            #[inline(always)]
            fn abs(self) -> Self {
                <$t>::abs(self)
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                if self < other { self } else { other }
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                if self > other { self } else { other }
            }
        }
    };
}
real!(f32);
real!(f64);

/// `f` of each axis, as a plain loop: [`core::array::from_fn`] keeps loops around it from becoming vector instructions.
#[inline(always)]
pub(crate) fn axes<X: Copy + Default, const D: usize>(f: impl Fn(usize) -> X) -> [X; D] {
    let mut all = [X::default(); D];
    let mut k = 0;
    while k < D {
        all[k] = f(k);
        k += 1;
    }
    all
}

/// A value and its gradient, at a point of `D` dimensions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet<T, const D: usize> {
    /// The value.
    pub v: T,
    /// The gradient, per unit of the coordinates that the value was asked at.
    pub g: [T; D],
}

impl<T: Real, const D: usize> Jet<T, D> {
    /// A constant: its gradient is zero.
    #[inline(always)]
    pub fn constant(v: T) -> Self {
        Self { v, g: [T::ZERO; D] }
    }
}
