//! Pictures that skies answer to: what a camera on the ground sees towards the sun, in 8 bits.
//!
//! The camera stands 2 m above the ground, and looks up by so much that the horizon lies at the lower third. The sun's disc is left out.
//! Under the horizon is the reference's own ground.

use crate::geometry::hits_ground;
use crate::medium::Medium;
use crate::reference::Ray;
use crate::spectrum::Star;

/// Columns of a picture.
pub const WIDTH: usize = 640;
/// Rows of a picture.
pub const HEIGHT: usize = 360;
/// The camera's altitude, in metres.
pub const ALTITUDE: f64 = 2.0;
/// The vertical field of view, in radians.
pub const FOV: f64 = core::f64::consts::FRAC_PI_3;
/// Where the camera looks: along the sun's azimuth, and up. The angle's tangent is a third of half the field's.
pub const FORWARD: [f64; 2] = [0.981_980_506_061_965_7, 0.188_982_236_504_613_6];

/// A sun, and an exposure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// The sun's zenith angle, in degrees.
    pub sun_zenith: f64,
    /// Exposure value at ISO 100: an HDR colour is luminance, in cd/m², over 1.2 · 2^EV.
    pub ev100: f64,
}

/// The pictures of which there is a truth: by day, and before sunset. Exposures bring their mean to the middle grey.
pub const VIEWS: [View; 2] = [View { sun_zenith: 65.0, ev100: 13.0 }, View { sun_zenith: 88.0, ev100: 11.0 }];

impl View {
    /// The truth's file in `assets/truth`.
    pub fn file(&self) -> String {
        format!("sky_{}.png", self.sun_zenith)
    }

    /// The ray through the middle of a pixel, counted from the upper left; columns have the sun's azimuth in their middle.
    pub fn ray(&self, column: usize, row: usize) -> Ray {
        let tangent = (0.5 * FOV).tan();
        let side = |i: usize, count: usize| (2.0 * i as f64 + 1.0) / count as f64 - 1.0;
        let right = side(column, WIDTH) * tangent * WIDTH as f64 / HEIGHT as f64;
        let above = -side(row, HEIGHT) * tangent;
        let [level, rise] = FORWARD;
        let (along, up) = (level - above * rise, rise + above * level);
        let length = (1.0 + right * right + above * above).sqrt();
        let (sine, mu_s) = self.sun_zenith.to_radians().sin_cos();
        let nu = (along * sine + up * mu_s) / length;
        Ray { h: ALTITUDE, mu: up / length, mu_s, nu: nu.clamp(-1.0, 1.0) }
    }

    /// Every pixel's ray, row by row.
    pub fn rays(&self) -> impl Iterator<Item = Ray> {
        (0..WIDTH * HEIGHT).map(|i| self.ray(i % WIDTH, i / WIDTH))
    }

    /// What luminance, in cd/m², becomes in an HDR picture.
    pub fn exposure(&self) -> f64 {
        1.0 / (1.2 * self.ev100.exp2())
    }

    /// A pixel of the picture, from radiance at the medium's wavelengths.
    pub fn pixel(&self, to_rgb: &[[f64; 3]; 3], radiance: [f64; 3]) -> [u8; 3] {
        let luminance = to_rgb.map(|row| (0..3).map(|k| row[k] * radiance[k]).sum::<f64>());
        tonemapped(luminance.map(|x| x * self.exposure()))
    }

    /// Peak signal to noise ratio of two pictures, in dB, over the channels of the pixels whose rays count: 20 log₁₀ of 255 over the
    /// root of the mean square of differences. Infinite where they are the same.
    pub fn psnr(&self, a: &[[u8; 3]], b: &[[u8; 3]], counts: impl Fn(&Ray) -> bool) -> f64 {
        let (mut sum, mut count) = (0.0, 0.0);
        for ((a, b), _) in a.iter().zip(b).zip(self.rays()).filter(|(_, ray)| counts(ray)) {
            sum += (0..3).map(|k| (f64::from(a[k]) - f64::from(b[k])).powi(2)).sum::<f64>();
            count += 3.0;
        }
        -10.0 * (sum / count / (255.0 * 255.0)).log10()
    }

    /// The picture of a sky given by its radiance.
    pub fn picture(&self, medium: &Medium, sky: impl FnMut(Ray) -> [f64; 3]) -> Vec<[u8; 3]> {
        let to_rgb = Star::of(medium).matrix();
        self.rays().map(sky).map(|radiance| self.pixel(&to_rgb, radiance)).collect()
    }
}

/// Linear sRGB in 8 bits: 1 − e⁻ˣ to the power 1/2.2 (Bruneton 2017). What is below 0 is outside of sRGB, and brought to its edge.
pub fn tonemapped(colour: [f64; 3]) -> [u8; 3] {
    colour.map(|x| (255.0 * (-(-x.max(0.0)).exp_m1()).powf(1.0 / 2.2)).round() as u8)
}

/// Whether a ray leaves the air past the sun, whose disc is blurred over a pixel.
pub fn sees_sky(medium: &Medium, ray: &Ray) -> bool {
    passes_sun(medium, ray) && !hits_ground(medium.radius, ray.h, ray.mu)
}

/// Whether a ray sees no part of the sun's disc, blurred over a pixel.
pub fn passes_sun(medium: &Medium, ray: &Ray) -> bool {
    ray.nu < (2.0 * medium.sun_radius).cos()
}
