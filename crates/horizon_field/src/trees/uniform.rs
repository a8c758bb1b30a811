//! The forest's numbers for the device: `PlantForest` in `solids.wgsl`.

use super::foliage::Foliage;
use super::forest::{Forest, MAX_SPECIES};
use super::species::Species;

/// Bytes of the uniform.
pub const UNIFORM_BYTES: usize = 640;

/// The wind that moves the tops.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wind {
    /// How far the tops are moved along x and z, in metres; a forest's `sway` limits its length.
    pub sway: [f64; 2],
    /// The gusts' phase, in radians. Plants are moved by 0.5 to 1 of the sway, each with a phase of its own.
    pub gust: f64,
}

impl Wind {
    /// The same, no stronger than a forest bears, and free of NaN.
    pub(super) fn within(&self, forest: &Forest) -> Self {
        let finite = |x: f64| if x.is_finite() { x } else { 0.0 };
        let sway = self.sway.map(finite);
        let length = libm::hypot(sway[0], sway[1]);
        let share = if length > forest.sway { forest.sway / length } else { 1.0 };
        Self { sway: sway.map(|x| x * share), gust: finite(self.gust).rem_euclid(core::f64::consts::TAU) }
    }
}

impl Species {
    fn append_bytes(&self, bytes: &mut Vec<u8>) {
        let mut rows = [[0.0; 4]; 5];
        let crown = self.shape.crown();
        rows[..crown.len()].copy_from_slice(crown);
        rows[4] = self.trunk_row().unwrap_or([0.0; 4]);
        let coloured = |[r, g, b]: [f64; 3], last: f64| [r, g, b, last];
        let colours =
            [coloured(self.young, self.foliage), coloured(self.old, self.lean), coloured(self.bark, self.density)];
        rows.iter().chain(&colours).flatten().for_each(|x| bytes.extend((*x as f32).to_le_bytes()));
        bytes.extend((crown.len() as u32).to_le_bytes());
        [self.period(), self.translucency, 0.0].iter().for_each(|x| bytes.extend((*x as f32).to_le_bytes()));
    }
}

impl Forest {
    /// The uniform's bytes, little-endian, in this wind.
    pub fn uniform_bytes(&self, wind: &Wind) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(UNIFORM_BYTES);
        for i in 0..MAX_SPECIES {
            self.species.get(i).unwrap_or(&Species::default()).append_bytes(&mut bytes);
        }
        let foliage = Foliage::table();
        let wind = wind.within(self);
        let slopes = (0..8).map(|mip| foliage.slope(mip));
        let rest = [wind.sway[0], wind.sway[1], wind.gust, self.spacing, foliage.mean(), 0.0, 0.0, 0.0];
        slopes.chain(rest).for_each(|x| bytes.extend((x as f32).to_le_bytes()));
        bytes
    }
}
