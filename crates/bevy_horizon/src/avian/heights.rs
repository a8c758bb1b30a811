//! The field's heights as colliders: the one way that they take.

use avian3d::parry::shape::{HeightField, HeightFieldCellStatus, HeightFieldFlags, SharedShape};
use avian3d::parry::utils::Array2;
use avian3d::prelude::Collider;
use bevy::prelude::*;

use crate::query::Ground;

/// The ground's heights at the corners of a square's cells, in Bevy's coordinates: for each x, those along z. All heights of
/// tiles come through here.
pub fn tile_heights(ground: &Ground, centre: Vec3, side: f32, cells: u32) -> Vec<f32> {
    let at = move |i: u32| side * (i as f32 / cells as f32 - 0.5);
    let along_z = move |x: f32| (0..=cells).map(move |j| centre + Vec3::new(x, 0.0, at(j)));
    let corners: Vec<Vec3> = (0..=cells).flat_map(|i| along_z(at(i))).collect();
    ground.heights(&corners)
}

/// A collider of a square piece of ground, for an entity that stands unturned at `centre`: `cells` × `cells` squares of two
/// triangles each, whose corners lie on the field. `None` where a height is not finite, or without an extent.
///
/// It is a surface without thickness. Contacts push upwards alone, and edges between its triangles do not trip what rolls
/// over them. Cells whose middle lies in a hole are not there.
pub fn ground_collider(ground: &Ground, centre: Vec3, side: f32, cells: u32) -> Option<Collider> {
    let cells = cells.max(1);
    if !(centre.is_finite() && side.is_finite() && side > 0.0) {
        return None;
    }
    // About the centre, where f32 has the more digits.
    let heights: Vec<f32> = tile_heights(ground, centre, side, cells).iter().map(|height| height - centre.y).collect();
    if !heights.iter().all(|height| height.is_finite()) {
        return None;
    }
    // Parry's rows run along z, and its arrays are stored column by column.
    let corners = cells as usize + 1;
    let heights = Array2::new(corners, corners, heights);
    let mut field = HeightField::with_flags(heights, Vec3::new(side, 1.0, side), HeightFieldFlags::FIX_INTERNAL_EDGES);
    if ground.has_holes() {
        let at = |i: u32| side * ((i as f32 + 0.5) / cells as f32 - 0.5);
        for (i, j) in (0..cells).flat_map(|i| (0..cells).map(move |j| (i, j))) {
            // Rows run along z here too.
            if ground.is_hole(centre + Vec3::new(at(j), 0.0, at(i))) {
                field.set_cell_status(i as usize, j as usize, HeightFieldCellStatus::CELL_REMOVED);
            }
        }
    }
    Some(SharedShape::new(field).into())
}
