//! What models of clouds are measured on: a slab, a sphere and a cumulus, each under three suns, seen along a fixed list of rays.

use super::{Lit, Matter};
use crate::clouds::phase::Phase;
use crate::clouds::span::spans;
use crate::clouds::{Cloud, CloudLayer, CloudPoint, CloudVolume, Weather};
use horizon_field::Place;

/// Zenith angles of the suns, in degrees.
pub const SUNS: [f64; 3] = [25.0, 60.0, 80.0];

/// A scene of the truth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scene {
    /// An even slab, of optical depth 12 from face to face.
    Slab,
    /// An even sphere, of optical depth 18 across.
    Sphere,
    /// A single cloud of billows, of optical depth 25 and more.
    Cumulus,
}

impl Scene {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Slab, Self::Sphere, Self::Cumulus];

    /// In the truth's table.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Slab => "slab",
            Self::Sphere => "sphere",
            Self::Cumulus => "cumulus",
        }
    }

    /// Rays that see it, each by its start and direction: the sun stands over +x.
    pub fn rays(self) -> Vec<[[f64; 3]; 2]> {
        if self == Self::Slab {
            let mut rays = Vec::new();
            for mu in [-0.9, -0.5, -0.2, 0.2, 0.5, 0.9_f64] {
                for azimuth in [0.0_f64, 60.0, 120.0, 180.0] {
                    let (sine, turn) = ((1.0 - mu * mu).sqrt(), azimuth.to_radians());
                    let y = if mu > 0.0 { 0.0 } else { 3_000.0 };
                    rays.push([[0.0, y, 0.0], [sine * libm::cos(turn), mu, sine * libm::sin(turn)]]);
                }
            }
            return rays;
        }
        // Parallel rays on lattices, slightly upward, from four sides.
        let (centre, [half_width, half_height]) = match self {
            Self::Sphere => ([0.0, 1_500.0, 0.0], [285.0, 285.0]),
            _ => ([0.0, 1_420.0, 0.0], [600.0, 380.0]),
        };
        let [columns, rows] = if self == Self::Sphere { [5, 5] } else { [9, 6] };
        let mut rays = Vec::new();
        for side in [0.0_f64, 60.0, 120.0, 180.0] {
            let (sine, cosine) = (libm::sin(side.to_radians()), libm::cos(side.to_radians()));
            let (lift, level) = (0.2, 0.96_f64.sqrt());
            let toward = [level * cosine, lift, level * sine];
            let (right, up) = ([-sine, 0.0, cosine], [-lift * cosine, level, -lift * sine]);
            for row in 0..rows {
                for column in 0..columns {
                    let place = |i: i32, n: i32| (2.0 * f64::from(i) + 1.0) / f64::from(n) - 1.0;
                    let (x, y) = (half_width * place(column, columns), half_height * place(row, rows));
                    let from = core::array::from_fn(|k| centre[k] + x * right[k] + y * up[k] - 5_000.0 * toward[k]);
                    rays.push([from, toward]);
                }
            }
        }
        rays
    }
}

/// Towards a sun of this zenith angle in degrees.
pub fn sun(zenith: f64) -> [f64; 3] {
    let angle = zenith.to_radians();
    [libm::sin(angle), libm::cos(angle), 0.0]
}

/// The scenes, ready to be lit.
#[derive(Clone, Debug)]
pub struct Scenes {
    volume: CloudVolume,
    cloud: Cloud<f64>,
}

/// Faces of the slab, in metres.
const SLAB: [f64; 2] = [1_000.0, 1_600.0];
/// Extinction of slab and sphere, per metre.
const EVEN: [f64; 2] = [0.02, 0.03];
/// The sphere's radius, and its centre's altitude.
const SPHERE: [f64; 2] = [300.0, 1_500.0];
/// The cumulus' radius, in metres.
const RADIUS: f64 = 800.0;
/// What the cumulus is made of.
pub const CUMULUS: CloudLayer =
    CloudLayer { top: 1_850.0, coverage: 0.85, extinction: 0.03, size: 2_600.0, detail: 500.0, ..CloudLayer::CUMULUS };

impl Scenes {
    /// Makes the noise.
    pub fn new() -> Self {
        Self { volume: CloudVolume::new(), cloud: Cloud::new(&CUMULUS, &Place::ORIGIN, 0.0) }
    }

    /// The volume that the cumulus is made of.
    pub const fn volume(&self) -> &CloudVolume {
        &self.volume
    }

    /// The cumulus' layer.
    pub const fn cloud(&self) -> &Cloud<f64> {
        &self.cloud
    }

    /// Where droplets scatter light to, in all scenes.
    pub const fn phase(&self) -> Phase<f64> {
        self.cloud.phase
    }

    /// The weather that leaves one cumulus.
    pub fn weather(&self, at: [f64; 3]) -> Weather<f64> {
        let part = (at[0] * at[0] + at[2] * at[2]) / (RADIUS * RADIUS);
        let Weather { coverage, kind } = self.cloud.weather;
        Weather { coverage: coverage * (1.0 - part).max(0.0), kind }
    }

    /// A scene's matter.
    pub const fn matter(&self, scene: Scene) -> SceneMatter<'_> {
        SceneMatter { scenes: self, scene }
    }

    /// A scene under a sun.
    pub fn lit<'a>(&self, matter: &'a SceneMatter<'a>, zenith: f64) -> Lit<'a, SceneMatter<'a>> {
        Lit { matter, phase: self.phase(), sun: sun(zenith) }
    }
}

impl Default for Scenes {
    fn default() -> Self {
        Self::new()
    }
}

/// The matter of one scene.
#[derive(Clone, Copy, Debug)]
pub struct SceneMatter<'a> {
    scenes: &'a Scenes,
    scene: Scene,
}

impl Matter for SceneMatter<'_> {
    fn extinction(&self, at: [f64; 3]) -> f64 {
        match self.scene {
            Scene::Slab => EVEN[0],
            Scene::Sphere => EVEN[1],
            Scene::Cumulus => {
                let Scenes { cloud, volume, .. } = self.scenes;
                let point = CloudPoint { at, up: [0.0, 1.0, 0.0], altitude: at[1] };
                cloud.extinction * cloud.density(volume, &point, &self.scenes.weather(at))
            }
        }
    }

    fn most(&self) -> f64 {
        match self.scene {
            Scene::Slab => EVEN[0],
            Scene::Sphere => EVEN[1],
            Scene::Cumulus => self.scenes.cloud.extinction,
        }
    }

    fn span(&self, from: [f64; 3], toward: [f64; 3]) -> [f64; 2] {
        let slab = |[base, top]: [f64; 2]| spans(0.0, base, top, from[1], toward[1])[0];
        match self.scene {
            Scene::Slab => slab(SLAB),
            Scene::Sphere => {
                let [x, y, z] = [from[0], from[1] - SPHERE[1], from[2]];
                roots(1.0, x * toward[0] + y * toward[1] + z * toward[2], x * x + y * y + z * z - SPHERE[0] * SPHERE[0])
            }
            Scene::Cumulus => {
                let (x, z) = (from[0], from[2]);
                let flat = toward[0] * toward[0] + toward[2] * toward[2];
                let round = roots(flat, x * toward[0] + z * toward[2], x * x + z * z - RADIUS * RADIUS);
                let level = slab([f64::from(CUMULUS.base), f64::from(CUMULUS.top)]);
                [round[0].max(level[0]), round[1].min(level[1])]
            }
        }
    }
}

/// Where a t² + 2 b t + c < 0, from t = 0 on.
fn roots(a: f64, b: f64, c: f64) -> [f64; 2] {
    if a <= 1e-12 {
        return if c < 0.0 { [0.0, 1e6] } else { [0.0; 2] };
    }
    let square = b * b - a * c;
    if square <= 0.0 {
        return [0.0; 2];
    }
    let root = square.sqrt();
    [((-b - root) / a).max(0.0), ((root - b) / a).max(0.0)]
}
