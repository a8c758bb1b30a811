//! A window of tiles of a lattice of plants, which follows a camera: which tile each slot stores, and which are to be filled. Pure
//! arithmetic: no device.

/// Cells along a tile's side.
pub const TILE: i64 = 32;

/// A place in the window's storage.
#[derive(Clone, Copy, Debug, Default)]
struct Slot {
    /// The tile that it is for.
    tile: [i64; 2],
    /// What is stored, in the window's count of changes; 0 where nothing is.
    version: u64,
    /// A job fills it.
    asked: bool,
}

/// Square, toroidal: a tile's slot is its index modulo the side.
#[derive(Debug)]
pub struct Window {
    side: i64,
    /// The tile whose low corner is the window's middle.
    middle: [i64; 2],
    slots: Vec<Slot>,
    /// Grows with each change of what tiles hold.
    version: u64,
    placed: bool,
}

impl Window {
    /// A window of so many tiles a side: a power of two.
    pub fn new(side: u32) -> Self {
        let side = i64::from(side);
        let slots = vec![Slot::default(); (side * side) as usize];
        Self { side, middle: [0; 2], slots, version: 1, placed: false }
    }

    /// Tiles along a side.
    pub fn side(&self) -> i64 {
        self.side
    }

    /// The cells that it spans, from low up to high, without it.
    pub fn cells(&self) -> [[i64; 2]; 2] {
        let low = self.middle.map(|middle| (middle - self.side / 2).wrapping_mul(TILE));
        [low, low.map(|low| low.wrapping_add(self.side * TILE))]
    }

    /// How many cells around the middle's tiles are in it whatever a camera does before it moves on.
    pub fn reach(side: u32) -> i64 {
        (i64::from(side) / 2 - 1) * TILE
    }

    /// Follows a camera that stands in a cell: it moves only when the camera has left the two tiles around its middle, so that one that
    /// walks to and fro over a tile's edge fills nothing. The slots that must be emptied.
    pub fn follow(&mut self, cell: [i64; 2]) -> Vec<usize> {
        let tile = cell.map(|cell| cell.div_euclid(TILE));
        for (middle, tile) in self.middle.iter_mut().zip(tile) {
            *middle = if self.placed { (*middle).clamp(tile, tile.saturating_add(1)) } else { tile };
        }
        self.placed = true;
        let mut emptied = Vec::new();
        for tile in self.tiles() {
            let index = self.slot(tile);
            let slot = &mut self.slots[index];
            if slot.tile != tile {
                if slot.version > 0 {
                    emptied.push(index);
                }
                *slot = Slot { tile, ..Slot::default() };
            }
        }
        emptied
    }

    fn tiles(&self) -> impl Iterator<Item = [i64; 2]> + use<> {
        let (low, side) = (self.middle.map(|middle| middle - self.side / 2), self.side);
        (0..side).flat_map(move |z| (0..side).map(move |x| [low[0] + x, low[1] + z]))
    }

    fn slot(&self, tile: [i64; 2]) -> usize {
        let [x, z] = tile.map(|tile| tile.rem_euclid(self.side) as usize);
        z * self.side as usize + x
    }

    /// All tiles are to be filled again; what is stored stays until then.
    pub fn invalidate(&mut self) {
        self.version += 1;
    }

    /// The tiles that hold any of these cells are to be filled again: from low up to high, with it.
    pub fn invalidate_cells(&mut self, low: [i64; 2], high: [i64; 2]) {
        // A tile also bounds the plants one cell beyond it.
        let [low, high] = [low.map(|cell| (cell - 1).div_euclid(TILE)), high.map(|cell| cell.div_euclid(TILE))];
        let before = self.version;
        self.version += 1;
        for slot in &mut self.slots {
            if (0..2).all(|axis| (low[axis]..=high[axis]).contains(&slot.tile[axis])) {
                slot.asked = false;
            } else if slot.version == before {
                slot.version = self.version;
            }
        }
    }

    /// What tiles that are asked for now are of: it grows with each change.
    pub fn version(&self) -> u64 {
        self.version
    }

    /// The nearest tiles that are out of date, up to so many; they count as asked for.
    pub fn ask(&mut self, cell: [i64; 2], count: usize) -> Vec<[i64; 2]> {
        let at = cell.map(|cell| cell.div_euclid(TILE));
        let mut wanted: Vec<_> = self
            .tiles()
            .filter(|tile| {
                let slot = &self.slots[self.slot(*tile)];
                slot.version != self.version && !slot.asked
            })
            .collect();
        wanted.sort_by_key(|tile| tile[0].abs_diff(at[0]).max(tile[1].abs_diff(at[1])));
        wanted.truncate(count);
        for tile in &wanted {
            let index = self.slot(*tile);
            self.slots[index].asked = true;
        }
        wanted
    }

    /// Takes a tile that was filled as it should be at a version: the slot that stores it, while it is wanted.
    pub fn fill(&mut self, tile: [i64; 2], version: u64) -> Option<usize> {
        let index = self.slot(tile);
        let slot = &mut self.slots[index];
        if slot.tile != tile || version < slot.version {
            return None;
        }
        // One that changed while it was filled is asked for again; until then the older one is better than none.
        slot.asked = false;
        slot.version = version;
        Some(index)
    }

    /// Whether any tile is stored.
    pub fn any(&self) -> bool {
        self.slots.iter().any(|slot| slot.version > 0)
    }

    /// Tiles that are up to date, and all.
    pub fn progress(&self) -> (usize, usize) {
        let done = self.slots.iter().filter(|slot| slot.version == self.version).count();
        (done, self.slots.len())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fill_all(window: &mut Window, cell: [i64; 2]) -> usize {
        let asked = window.ask(cell, usize::MAX);
        let version = window.version();
        asked.iter().filter(|tile| window.fill(**tile, version).is_some()).count()
    }

    #[test]
    fn a_camera_that_walks_to_and_fro_fills_nothing() {
        let mut window = Window::new(8);
        assert!(window.follow([0, 0]).is_empty());
        assert_eq!(fill_all(&mut window, [0, 0]), 64);
        for cell in [[-1, 3], [0, -5], [-TILE, -TILE], [TILE - 1, TILE - 1]] {
            assert!(window.follow(cell).is_empty());
            assert_eq!(fill_all(&mut window, cell), 0);
        }
        // One tile further, one strip.
        assert_eq!(window.follow([TILE, 0]).len(), 8);
        assert_eq!(fill_all(&mut window, [TILE, 0]), 8);
    }

    #[test]
    fn the_camera_stands_well_within() {
        let mut window = Window::new(8);
        for step in -300..300i64 {
            let cell = [7 * step, -3 * step * step];
            window.follow(cell);
            let [low, high] = window.cells();
            for axis in 0..2 {
                let margin = (cell[axis] - low[axis]).min(high[axis] - 1 - cell[axis]);
                assert!(margin >= Window::reach(8), "{margin} at {cell:?}");
            }
        }
    }

    #[test]
    fn far_from_the_origin_it_is_the_same() {
        let far = 1i64 << 40;
        let mut window = Window::new(8);
        window.follow([far + 5, -far - 5]);
        assert_eq!(fill_all(&mut window, [far + 5, -far - 5]), 64);
        assert_eq!(window.progress(), (64, 64));
    }

    #[test]
    fn an_edit_fills_the_tiles_that_it_touches() {
        let mut window = Window::new(8);
        window.follow([0, 0]);
        fill_all(&mut window, [0, 0]);
        window.invalidate_cells([5, 5], [6, 6]);
        assert_eq!(window.progress(), (63, 64));
        assert_eq!(window.ask([0, 0], 9), [[0, 0]]);
        // The first column of a tile is also the last bound of its neighbour.
        fill_all(&mut window, [0, 0]);
        window.invalidate_cells([0, 5], [0, 5]);
        assert_eq!(window.ask([0, 0], 9).len(), 2);
    }

    #[test]
    fn what_changed_while_it_was_filled_is_filled_again() {
        let mut window = Window::new(8);
        window.follow([0, 0]);
        let asked = window.ask([0, 0], usize::MAX);
        let old = window.version();
        window.invalidate();
        assert!(asked.iter().all(|tile| window.fill(*tile, old).is_some()));
        assert_eq!(window.progress(), (0, 64));
        assert_eq!(fill_all(&mut window, [0, 0]), 64);
        assert_eq!(window.progress(), (64, 64));
    }
}
