//! Where a droplet scatters light to, per steradian. WGSL twin: `phase.wgsl`.
//!
//! One form holds both models: a share of Draine's function, (1 + αν²)/(1 + α(1 + 2g²)/3) times Henyey and Greenstein's, beside a
//! lobe of theirs. With α = 0 it is the two lobes.

use super::layer::{CloudLayer, CloudPhase};
use crate::water::body::lobe;
use horizon_field::Real;

/// A phase function; laid out as the shader's `CloudPhase`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phase<T> {
    /// Mean cosine of the forward lobe.
    pub forward: T,
    /// That of the other one, before it is stretched.
    pub other: T,
    /// Draine's α.
    pub alpha: T,
    /// The other's share.
    pub share: T,
}

impl<T: Real> Phase<T> {
    /// Of a layer that passes [`CloudLayer::check`].
    pub fn new(layer: &CloudLayer) -> Self {
        let [forward, other, alpha, share] = match layer.phase {
            CloudPhase::Lobes => [layer.asymmetry, layer.back_asymmetry, 0.0, layer.back_share].map(f64::from),
            CloudPhase::Droplets => droplets(f64::from(layer.droplet)),
        };
        Self { forward: T::of(forward), other: T::of(other), alpha: T::of(alpha), share: T::of(share) }
    }

    /// Its value where light turns by an angle of cosine `nu`.
    #[inline]
    pub fn at(&self, nu: T) -> T {
        let third = T::of(1.0 / 3.0);
        let stretch = (T::ONE + self.alpha * nu * nu)
            / (T::ONE + self.alpha * (T::ONE + T::of(2.0) * self.other * self.other) * third);
        (T::ONE - self.share) * lobe(self.forward, nu) + self.share * lobe(self.other, nu) * stretch
    }

    /// The same with means of `by` times as much: how light that was scattered before is spread.
    #[inline]
    pub fn flattened(&self, by: T) -> Self {
        Self { forward: self.forward * by, other: self.other * by, alpha: self.alpha * by, share: self.share }
    }

    /// Mean cosine. Of Draine's function it is g (1 + α(3 + 2g²)/5)/(1 + α(1 + 2g²)/3).
    pub fn mean_cosine(&self) -> T {
        let (g, square) = (self.other, self.other * self.other);
        let top = T::ONE + self.alpha * (T::of(3.0) + T::of(2.0) * square) * T::of(0.2);
        let bottom = T::ONE + self.alpha * (T::ONE + T::of(2.0) * square) * T::of(1.0 / 3.0);
        (T::ONE - self.share) * self.forward + self.share * g * top / bottom
    }
}

impl Phase<f64> {
    /// A cosine drawn from it; `uniform` gives numbers in [0, 1).
    pub fn draw(&self, mut uniform: impl FnMut() -> f64) -> f64 {
        if uniform() >= self.share {
            return drawn(self.forward, uniform());
        }
        // Draine's is Henyey and Greenstein's, kept with the chance (1 + αν²)/(1 + α).
        loop {
            let nu = drawn(self.other, uniform());
            if uniform() * (1.0 + self.alpha) < 1.0 + self.alpha * nu * nu {
                return nu;
            }
        }
    }
}

/// The cosine below which Henyey and Greenstein's lobe holds the part `u`.
fn drawn(g: f64, u: f64) -> f64 {
    let x = 2.0 * u - 1.0;
    // (1 + g² − ((1 − g²)/(1 + gx))²)/(2g), multiplied out so that nothing is divided by g.
    let top = 2.0 * x + g * (x * x + 3.0) + 2.0 * g * g * x + g * g * g * (x * x - 1.0);
    let bottom = 1.0 + g * x;
    (top / (2.0 * bottom * bottom)).clamp(-1.0, 1.0)
}

/// g, g, α and the share for droplets of a diameter of 5 to 50 µm (Jendersie and d'Eon 2023, *An Approximate Mie Scattering Function
/// for Fog and Cloud Rendering*).
fn droplets(diameter: f64) -> [f64; 4] {
    let d = diameter.clamp(5.0, 50.0);
    [
        libm::exp(-0.099_056_7 / (d - 1.671_54)),
        libm::exp(-2.206_79 / (d + 3.910_29) - 0.428_934),
        libm::exp(3.624_89 - 8.292_88 / (d + 5.528_25)),
        libm::exp(-0.599_085 / (d - 0.641_583) - 0.665_888),
    ]
}
