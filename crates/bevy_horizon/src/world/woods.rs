//! What grows on a terrain as it stands: the one source of plants, for questions and for the picture.

use std::sync::Arc;

#[cfg(feature = "render")]
use horizon_field::stamp::{Area, Mode, Placed};
#[cfg(feature = "render")]
use horizon_field::trees::{Block, Forest};
use horizon_field::trees::{Felled, ForestError, Plant, PlantGround, Planting};
use horizon_field::{Place, Stamps};

use super::TerrainFields;

/// Plants of a terrain: with its stamps, and without what was felled.
#[derive(Debug)]
pub(crate) struct Woods {
    pub planting: Planting,
    pub terrain: Arc<TerrainFields>,
    pub stamps: Arc<Stamps>,
    pub felled: Felled,
}

/// Where plants of two woods differ.
#[cfg(feature = "render")]
pub(crate) enum WoodsChange {
    /// Anywhere.
    Everywhere,
    /// In these rectangles of cells: from a cell to another, with it.
    Cells(Vec<[[i64; 2]; 2]>),
}

impl Woods {
    fn ground(&self) -> PlantGround<'_> {
        PlantGround { field: &self.terrain.height, stamps: &self.stamps }
    }

    /// The plants of a rectangle of the plane.
    pub fn plants_in(&self, corner: &Place, size: [f64; 2]) -> Result<Vec<Plant>, ForestError> {
        self.planting.plants_in(self.ground(), &self.felled, corner, size)
    }
}

/// What only the picture asks.
#[cfg(feature = "render")]
impl Woods {
    /// What grows, as it was compiled.
    pub fn forest(&self) -> &Forest {
        self.planting.forest()
    }

    /// The edge of a cell, in metres.
    pub fn spacing(&self) -> f64 {
        self.forest().spacing
    }

    /// The plants of a block of cells.
    pub fn plants(&self, corner: [i64; 2], size: [u32; 2]) -> Vec<Plant> {
        self.planting.plants(self.ground(), &self.felled, Block { corner, size })
    }

    /// The cell that holds a place, and how far that is from the cell's corner, in metres.
    pub fn cell(&self, place: &Place) -> ([i64; 2], [f64; 2]) {
        let cell = self.planting.cell_of(place);
        let [x, _, z] = place.minus(&Place::of_cell([cell[0], 0, cell[1]], self.spacing()));
        (cell, [x, z])
    }

    /// The width of the widest crown, in metres.
    pub fn widest(&self) -> f64 {
        let widths = self.forest().species.iter().map(|species| 2.0 * species.radius * species.height[1]);
        widths.fold(0.0, f64::max)
    }

    /// Where its plants are others than those of older woods.
    pub fn change(&self, old: &Self) -> WoodsChange {
        let same = self.forest() == old.forest() && Arc::ptr_eq(&self.terrain, &old.terrain);
        // What the sets call changes are those of the ground.
        if !same || clearings(&self.stamps) != clearings(&old.stamps) {
            return WoodsChange::Everywhere;
        }
        let felled = self.felled.changes(&old.felled).map(|id| [id.0; 2]);
        let stamped = old.stamps.changes(&self.stamps);
        WoodsChange::Cells(felled.chain(stamped.iter().map(|area| self.cells_of(area))).collect())
    }

    fn cells_of(&self, area: &Area) -> [[i64; 2]; 2] {
        let far = area.place.translated([area.size[0], 0.0, area.size[1]]);
        [&area.place, &far].map(|place| self.planting.cell_of(place))
    }
}

/// The stamps that keep plants away.
#[cfg(feature = "render")]
fn clearings(stamps: &Stamps) -> Vec<&Placed> {
    stamps.placed().filter(|placed| matches!(placed.edit.mode, Mode::KeepTrees | Mode::Hole)).collect()
}
