//! What a kind of plant looks like: meaning, unit, range and default of its parameters, once each.

#[cfg(feature = "reflect")]
use bevy_reflect::std_traits::ReflectDefault;
use serde::{Deserialize, Serialize};

use crate::field::param::{Numbers, Param, Params, node};

/// An ellipsoid of a plant: the centre's height in heights, the radius along x and z in radii, along y in heights, and the
/// centre's distance from the trunk in radii.
pub type Row = [f64; 4];

/// A plant's outline.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "reflect", derive(bevy_reflect::Reflect), reflect(Clone, Debug, Default, PartialEq))]
pub enum PlantShape {
    /// A trunk with a crown of several boughs.
    #[default]
    Broadleaf,
    /// A trunk with a crown that tapers to the top.
    Conifer,
    /// Boughs from the ground on.
    Bush,
    /// A boulder, half in the ground.
    Rock,
}

impl PlantShape {
    /// The crown's ellipsoids, at most four. None is higher than 1, nor wider than 1 with its distance from the trunk.
    pub const fn crown(self) -> &'static [Row] {
        match self {
            Self::Broadleaf => {
                &[[0.62, 0.8, 0.36, 0.0], [0.55, 0.56, 0.26, 0.42], [0.7, 0.5, 0.24, 0.4], [0.48, 0.5, 0.2, 0.48]]
            }
            Self::Conifer => {
                &[[0.26, 1.0, 0.16, 0.0], [0.45, 0.78, 0.2, 0.0], [0.64, 0.54, 0.2, 0.0], [0.82, 0.3, 0.18, 0.0]]
            }
            Self::Bush => &[[0.4, 0.85, 0.55, 0.1], [0.35, 0.6, 0.45, 0.38], [0.3, 0.55, 0.5, 0.42]],
            Self::Rock => &[[0.35, 0.9, 0.6, 0.05], [0.25, 0.6, 0.5, 0.38]],
        }
    }

    /// How high the trunk reaches, in heights; 0 for what has none. It is an ellipsoid about the foot.
    pub const fn trunk(self) -> f64 {
        match self {
            Self::Broadleaf => 0.75,
            Self::Conifer => 0.95,
            Self::Bush | Self::Rock => 0.0,
        }
    }
}

node! {
    /// A kind of plant.
    Species {
        shape: PlantShape = PlantShape::Broadleaf, "The outline.";
        height: [f64; 2] = [4.5, 8.5], "The heights of the youngest and the oldest.", in 0.1 .. 200.0 "m";
        radius: f64 = 0.35, "The crown's greatest radius, as a part of the height.", in 0.02 .. 4.0 "";
        trunk: f64 = 0.08, "The trunk's radius at the foot, as a part of the crown's; bushes and rocks have none.", in 0.0 .. 0.5 "";
        lean: f64 = 0.02, "How far a top leans at most, as a part of the height.", in 0.0 .. 0.3 "";
        foliage: f64 = 0.4, "How deep foliage eats into the crown, as a part of its ellipsoids' radii.", in 0.0 .. 0.8 "";
        clump: f64 = 1.2, "The size of a clump of leaves.", in 0.02 .. 20.0 "m";
        density: f64 = 0.9, "How much light the crown takes, for each metre in it.", in 0.0 .. 100.0 "1/m";
        translucency: f64 = 0.3, "How much of the light that meets a leaf goes on through it.", in 0.0 .. 1.0 "";
        young: [f64; 3] = [0.09, 0.16, 0.03], "The leaves' albedo on the youngest plant, linear.", in 0.0 .. 1.0 "";
        old: [f64; 3] = [0.05, 0.1, 0.025], "The leaves' albedo on the oldest plant, linear.", in 0.0 .. 1.0 "";
        bark: [f64; 3] = [0.09, 0.065, 0.045], "The bark's albedo, linear.", in 0.0 .. 1.0 "";
    }
}

impl Species {
    /// How far from its trunk the largest plant reaches, without wind, in metres.
    pub fn reach(&self) -> f64 {
        (self.radius + self.lean) * self.height[1]
    }

    /// The foliage table's period, in metres: it holds this many clumps along each edge.
    pub fn period(&self) -> f64 {
        super::foliage::CLUMPS * self.clump
    }

    /// The trunk, as an ellipsoid; `None` where there is none.
    pub fn trunk_row(&self) -> Option<Row> {
        let high = self.shape.trunk();
        (high > 0.0 && self.trunk > 0.0).then_some([0.0, self.trunk, high, 0.0])
    }
}
