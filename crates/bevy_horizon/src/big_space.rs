//! The world's origin follows big_space's floating origin.
//!
//! ```no_run
//! use bevy::prelude::*;
//! use bevy_horizon::prelude::*;
//! use big_space::prelude::*;
//!
//! fn main() {
//!     let plugins = DefaultPlugins.build().disable::<TransformPlugin>();
//!     App::new()
//!         .add_plugins((plugins, BigSpaceDefaultPlugins, HorizonPlugins, HorizonBigSpacePlugin))
//!         .add_systems(Startup, setup)
//!         .run();
//! }
//!
//! fn setup(mut commands: Commands) {
//!     // Outside of the big space, at Bevy's own origin.
//!     commands.spawn(Terrain::default());
//!     commands.spawn_big_space(Grid::new(2000.0, 100.0), |root| {
//!         let far = CellCoord::new(500_000, 0, -500_000);
//! #       #[cfg(feature = "render")]
//!         root.spawn_spatial((Camera3d::default(), HorizonCamera::default(), FloatingOrigin, far));
//!     });
//! }
//! ```
//!
//! The grid that counts is the root's, that of the `BigSpace` itself: the middle of its cell 0 is the world's origin, and the
//! middle of the cell that the floating origin is in is Bevy's. Where there are several big spaces, the first one counts that
//! has a floating origin.
//!
//! A terrain stays outside of the big space, an entity without parent at Bevy's origin: it is the [`WorldOrigin`] that says which
//! of its places are drawn. In a grid it would be moved twice, once by its transform and once by the origin. A floating
//! origin in a grid inside of the root's may lie anywhere in it, but must not be turned against it: the ground does not turn.

use ::big_space::prelude::{BigSpace, BigSpaceSystems, CellCoord, Grid};
use bevy::math::DQuat;
use bevy::prelude::*;
use horizon_field::Place;

use crate::HorizonSystems;
use crate::world::WorldOrigin;

/// Writes [`WorldOrigin`] from big_space's floating origin, in [`HorizonSystems::Origin`].
pub struct HorizonBigSpacePlugin;

impl Plugin for HorizonBigSpacePlugin {
    fn build(&self, app: &mut App) {
        let follow = || {
            follow_floating_origin
                .in_set(HorizonSystems::Origin)
                .after(BigSpaceSystems::LocalFloatingOrigins)
                .before(BigSpaceSystems::PropagateHighPrecision)
        };
        app.add_systems(PostStartup, follow())
            .add_systems(PostUpdate, follow())
            .configure_sets(PostUpdate, HorizonSystems::Origin.before(HorizonSystems::Compile));
    }
}

/// The place of the world at a translation in a cell of a root grid: exact to f64 within ±2⁵⁵ cells.
pub fn place_in_grid(grid: &Grid, cell: &CellCoord, translation: Vec3) -> Place {
    let cell = [whole(cell.x), whole(cell.y), whole(cell.z)];
    Place::of_cell(cell, grid.cell_edge_length().into()).translated(translation.to_array().map(f64::from))
}

/// A coordinate of whatever width big_space was built with.
fn whole(coordinate: impl TryInto<i64>) -> i64 {
    coordinate.try_into().unwrap_or(i64::MAX)
}

fn follow_floating_origin(spaces: Query<(&BigSpace, &Grid)>, mut origin: ResMut<WorldOrigin>) {
    let Some((_, grid)) = spaces.iter().find(|(space, _)| space.floating_origin.is_some()) else { return };
    let local = grid.local_floating_origin();
    if local.rotation().angle_between(DQuat::IDENTITY) > 1e-6 {
        warn_once!(
            "the floating origin's grid is turned against the big space's, and the ground does not turn with it"
        );
    }
    origin.set_if_neq(WorldOrigin(place_in_grid(grid, &local.cell(), local.translation())));
}

#[cfg(test)]
mod tests {
    use super::*;
    use horizon_field::CELL;

    #[test]
    fn cells_become_places() {
        let grid = Grid::new(2000.0, 100.0);
        let place = |x, y, z, by| place_in_grid(&grid, &CellCoord::new(x, y, z), by);
        assert_eq!(place(0, 0, 0, Vec3::ZERO), Place::ORIGIN);
        for (cell, metres) in [(500_000, 1e9), (-500_000, -1e9), (1, 2000.0), (-1, -2000.0), (2, 4000.0), (-2, -4000.0)]
        {
            let expected = Place::from_metres([metres, 0.0, -metres]);
            assert_eq!(place(cell, 0, -cell, Vec3::ZERO), expected);
            // Offsets carry over the borders of the world's cells, both ways.
            for by in [96.0, -96.0, 1000.125, -1000.125] {
                let expected = Place::from_metres([metres + f64::from(by), 0.0, -metres - f64::from(by)]);
                assert_eq!(place(cell, 0, -cell, Vec3::new(by, 0.0, -by)), expected);
            }
        }
        // The border itself belongs to the cell above it.
        let grid = Grid::new(CELL as f32, 100.0);
        let on_border = place_in_grid(&grid, &CellCoord::new(-3, 0, 7), Vec3::ZERO);
        assert_eq!(on_border, Place { cell: [-3, 0, 7], offset: [0.0; 3] });
        let below = place_in_grid(&grid, &CellCoord::new(-3, 0, 7), Vec3::new(-0.5, 0.0, 0.0));
        assert_eq!(below, Place { cell: [-4, 0, 7], offset: [CELL - 0.5, 0.0, 0.0] });
    }

    #[test]
    fn single_precision_would_not_do() {
        let grid = Grid::new(2000.0, 100.0);
        let cell = CellCoord::new(500_000, 0, 0);
        let by = Vec3::new(3.25, 0.0, 0.0);
        let naive = grid.grid_position(&cell, &Transform::from_translation(by));
        let exact = place_in_grid(&grid, &cell, by).minus(&Place::from_metres([1e9, 0.0, 0.0]))[0];
        assert_eq!(exact, 3.25);
        assert!((f64::from(naive.x) - 1e9 - exact).abs() > 1.0);
    }
}
