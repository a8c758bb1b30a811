//! Water: surfaces at a level, with waves.

use std::sync::Arc;

use bevy::prelude::*;
use horizon_field::field::Param;
use horizon_field::waves::{Sea, SeaSurface, Waves, WavesError};
use horizon_field::{FieldError, Place};
use horizon_light::water::WaterOptics;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::water_mask::{MaskTable, WaterMask};
use super::{ParamError, check_params};

/// A body of water: an endless sea, or a lake within an outline. Where the ground stands higher, it is the shore.
///
/// Its level is the height of the entity's `GlobalTransform`, its middle the x and z of that; rotation and scale are not
/// honoured. Where [`WorldOrigin`](super::WorldOrigin) moves, the game shifts it, or gives it a [`WaterPlace`]. `Visibility` hides it, `RenderLayers` choose the cameras that see it. A camera sees up to eight bodies.
///
/// ```no_run
/// # use bevy::prelude::*;
/// # use bevy_horizon::prelude::*;
/// fn flood(mut commands: Commands) {
///     commands.spawn((Water::default(), Transform::from_xyz(0.0, 12.0, 0.0)));
/// }
/// ```
#[derive(Component, Clone, Debug, PartialEq, Reflect, Serialize, Deserialize)]
#[reflect(Component, Default, Clone, PartialEq)]
#[require(Transform)]
#[cfg_attr(feature = "render", require(Visibility))]
#[serde(default, deny_unknown_fields)]
pub struct Water {
    /// How far it reaches. Default: without end.
    pub outline: WaterOutline,
    /// How it moves. Default: a breeze over open water.
    pub waves: Waves,
    /// What it is like inside. Default: clear sea.
    pub optics: WaterOptics,
    /// How readily it foams, on crests and on the shore: 0 never. Default: 1.
    #[reflect(@Param { min: 0.0, max: 4.0, unit: "", help: "How readily it foams" })]
    pub foam: f32,
    /// Variance of the slopes of ripples that are too fine for the waves' tiles. Default: 0.002.
    #[reflect(@Param { min: 0.0, max: 0.1, unit: "", help: "Variance of the slopes of the finest ripples" })]
    pub ripples: f32,
}

impl Default for Water {
    fn default() -> Self {
        Self { outline: default(), waves: default(), optics: default(), foam: 1.0, ripples: 0.002 }
    }
}

/// On [`Water`]: where in the world its middle is, exactly, whatever its transform and the [`WorldOrigin`](super::WorldOrigin) are. Its y is
/// the level.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
pub struct WaterPlace(pub Place);

/// How far a body of water reaches, around its entity.
#[derive(Clone, Debug, Default, PartialEq, Reflect, Serialize, Deserialize)]
#[reflect(Default, Clone, PartialEq)]
pub enum WaterOutline {
    /// To the horizon.
    #[default]
    Endless,
    /// A disc.
    Disc(WaterDisc),
    /// A rectangle along the axes.
    Rectangle(WaterRectangle),
    /// Where a field is above 0.
    Mask(WaterMask),
}

/// A round body of water.
#[derive(Clone, Copy, Debug, PartialEq, Reflect, Serialize, Deserialize)]
#[reflect(Default, Clone, PartialEq)]
#[serde(default, deny_unknown_fields)]
pub struct WaterDisc {
    /// Its radius, in metres. Default: 100.
    #[reflect(@Param { min: 0.01, max: 1e6, unit: "m", help: "Radius" })]
    pub radius: f32,
}

impl Default for WaterDisc {
    fn default() -> Self {
        Self { radius: 100.0 }
    }
}

/// A rectangular body of water.
#[derive(Clone, Copy, Debug, PartialEq, Reflect, Serialize, Deserialize)]
#[reflect(Default, Clone, PartialEq)]
#[serde(default, deny_unknown_fields)]
pub struct WaterRectangle {
    /// From its middle to its sides along x and z, in metres. Default: 100.
    #[reflect(@Param { min: 0.01, max: 1e6, unit: "m", help: "From the middle to the sides" })]
    pub half: [f32; 2],
}

impl Default for WaterRectangle {
    fn default() -> Self {
        Self { half: [100.0; 2] }
    }
}

/// Why a body of water was refused.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum WaterError {
    /// A parameter is out of its range.
    #[error(transparent)]
    Param(#[from] ParamError),
    /// Its waves make no sense.
    #[error(transparent)]
    Waves(#[from] WavesError),
    /// The field of its outline makes no sense.
    #[error(transparent)]
    Mask(#[from] FieldError),
}

impl Water {
    /// Checks it; `path` is what messages call it.
    ///
    /// # Errors
    /// What makes no sense, by its field.
    pub fn check(&self, path: &str) -> Result<(), WaterError> {
        check_params(path, self)?;
        match &self.outline {
            WaterOutline::Endless => {}
            WaterOutline::Disc(disc) => check_params(&format!("{path}.outline.Disc"), disc)?,
            WaterOutline::Rectangle(rectangle) => check_params(&format!("{path}.outline.Rectangle"), rectangle)?,
            WaterOutline::Mask(mask) => {
                check_params(&format!("{path}.outline.Mask"), mask)?;
                mask.field.check()?;
            }
        }
        self.waves.check(&format!("{path}.waves"))?;
        Ok(())
    }
}

/// What [`Water`] became: checked, with its waves made ready. Bodies with the same waves share them. After a bad edit the last
/// good one stays.
#[derive(Component, Clone, Debug)]
pub struct CompiledWater {
    pub(crate) water: Arc<Water>,
    /// Its waves; `None` where it is still.
    pub(crate) surface: Option<Arc<SeaSurface>>,
    /// The table of its outline, where that is a mask.
    pub(crate) mask: Option<Arc<MaskTable>>,
}

impl CompiledWater {
    /// Checks it, and makes it ready; its waves are those of another where they are the same.
    fn new<'a>(water: &Water, known: impl Iterator<Item = &'a Self>) -> Result<Self, WaterError> {
        water.check("water")?;
        let surface = match { known }.find(|other| other.water.waves == water.waves) {
            Some(other) => other.surface.clone(),
            None => {
                let sea = Sea::new(&water.waves)?;
                (!sea.is_still()).then(|| Arc::new(SeaSurface::new(Arc::new(sea))))
            }
        };
        let mask = match &water.outline {
            WaterOutline::Mask(mask) => Some(Arc::new(MaskTable::new(mask)?)),
            _ => None,
        };
        Ok(Self { water: Arc::new(water.clone()), surface, mask })
    }

    /// Whether a place is within its outline, relative to its middle.
    pub(crate) fn contains(&self, [x, z]: [f64; 2]) -> bool {
        match &self.water.outline {
            WaterOutline::Endless => true,
            WaterOutline::Disc(WaterDisc { radius }) => x * x + z * z <= f64::from(*radius).powi(2),
            WaterOutline::Rectangle(WaterRectangle { half }) => x.abs() <= half[0].into() && z.abs() <= half[1].into(),
            WaterOutline::Mask(_) => self.mask.as_ref().is_some_and(|mask| mask.contains([x, z])),
        }
    }
}

/// A body of water was rejected; what was there before stays.
#[derive(Message, Clone, Debug)]
pub struct WaterRejected {
    /// The water's entity.
    pub entity: Entity,
    /// Why.
    pub error: WaterError,
}

/// Compiles water that changed.
pub(crate) fn compile_waters(
    mut commands: Commands,
    changed: Query<(Entity, &Water), Changed<Water>>,
    known: Query<&CompiledWater>,
    mut rejected: MessageWriter<WaterRejected>,
) {
    let mut fresh: Vec<CompiledWater> = Vec::new();
    for (entity, water) in &changed {
        match CompiledWater::new(water, known.iter().chain(&fresh)) {
            Ok(compiled) => {
                fresh.push(compiled.clone());
                commands.entity(entity).insert(compiled);
            }
            Err(error) => {
                error!("water {entity} was rejected, what was there before stays: {error}");
                rejected.write(WaterRejected { entity, error });
            }
        }
    }
}

/// Water that is no more is not drawn.
pub(crate) fn forget_water(removed: On<Remove, Water>, mut commands: Commands) {
    if let Ok(mut entity) = commands.get_entity(removed.entity) {
        entity.try_remove::<CompiledWater>();
    }
}
