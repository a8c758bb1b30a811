//! Which patches of the ground a light may see, and how fine they should be. Pure geometry: no device.

use bevy::math::{Mat4, Vec3, Vec3Swizzles, Vec4};
use bevy::render::view::ExtractedView;
use bytemuck::{Pod, Zeroable};

use super::super::super::cache::Cache;
use super::super::super::cache::clipmap::DrawnLevel;

/// Quads along a patch's side.
pub const QUADS: u16 = 16;
/// The most texels along a quad's side: a patch is then a tile.
const WIDEST: i32 = 4;
/// How wide a quad should be, in texels of the shadow map: silhouettes bend by a hundredth of that over a hill that is a hundred wide.
const QUAD_IN_MAP: f32 = 16.0;
/// Quads that a vertex is pushed away from the light.
pub const PUSH: f32 = 2.0;

/// `Patch` of `cast.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
#[repr(C)]
pub struct Patch {
    level: u32,
    quad: i32,
    cell: [i32; 2],
}

/// A light's view of the ground.
pub struct LightView {
    pub clip_from_ground: Mat4,
    pub place: Vec4,
    /// Metres of a texel of the map; at a metre from the light where that is a point.
    texel: f32,
    /// How far it reaches, in metres.
    range: f32,
}

impl LightView {
    /// As seen from a terrain's cache, whose centre is at `centre` in Bevy's coordinates.
    pub fn new(view: &ExtractedView, centre: Vec3, range: f32) -> Self {
        let clip_from_world =
            view.clip_from_world.unwrap_or_else(|| view.clip_from_view * view.world_from_view.to_matrix().inverse());
        let orthographic = view.clip_from_view.w_axis.w == 1.0;
        let place = if orthographic {
            view.world_from_view.back().extend(0.0)
        } else {
            (view.world_from_view.translation() - centre).extend(1.0)
        };
        let size = view.viewport.z.max(1) as f32;
        Self {
            clip_from_ground: clip_from_world * Mat4::from_translation(centre),
            place,
            texel: 2.0 / (view.clip_from_view.x_axis.x.abs().max(1e-9) * size),
            range,
        }
    }

    fn is_sun(&self) -> bool {
        self.place.w == 0.0
    }

    /// How wide quads should be around a point, in metres.
    fn quad_at(&self, at: Vec3) -> f32 {
        let distance = if self.is_sun() { 1.0 } else { self.place.truncate().distance(at).max(1.0) };
        QUAD_IN_MAP * self.texel * distance
    }

    /// Whether the map is of where a box stands: not only of what it may cast on.
    fn covers(&self, low: Vec3, high: Vec3) -> bool {
        let middle = self.clip_from_ground * (0.5 * (low + high)).extend(1.0);
        !self.is_sun() || middle.z <= middle.w
    }

    /// Whether a box may be seen in the map, or cast into it from before its near plane.
    pub fn sees(&self, low: Vec3, high: Vec3) -> bool {
        if !self.is_sun() {
            let place = self.place.truncate();
            if place.distance_squared(place.clamp(low, high)) > self.range * self.range {
                return false;
            }
        }
        let corners = (0..8).map(|i| {
            let pick = |bit: i32, low: f32, high: f32| if i & bit == 0 { low } else { high };
            self.clip_from_ground
                * Vec4::new(pick(1, low.x, high.x), pick(2, low.y, high.y), pick(4, low.z, high.z), 1.0)
        });
        // Outside when all corners lie beyond the same plane.
        let mut beyond = [true; 5];
        for corner in corners {
            let [x, y, z, w] = corner.to_array();
            // Reverse-z: 0 is far.
            for (all, out) in beyond.iter_mut().zip([x > w, x < -w, y > w, y < -w, z < 0.0]) {
                *all &= out;
            }
        }
        !beyond.contains(&true)
    }
}

/// The patches that a light may see, of levels whose quads are not much finer than the map. Where texels are wider than quads should
/// be, as under smooth ground, every texel is a quad; ground that only casts into the map from far away has wider ones.
pub fn patches(cache: &Cache, light: &LightView, heights: [f32; 2], patches: &mut Vec<Patch>) {
    let metres = |exponent: i32| (exponent as f32).exp2();
    let coarsest = cache.drawn.iter().rposition(|level| level.outer > 0.0);
    let mut inner = 0.0;
    for (i, level) in cache.drawn.iter().enumerate() {
        let texel = metres(level.exponent);
        let too_fine = light.is_sun() && WIDEST as f32 * texel < light.quad_at(Vec3::ZERO) && Some(i) != coarsest;
        if level.outer <= 0.0 || too_fine {
            continue;
        }
        let finest = inner == 0.0;
        let rim = level.outer * texel;
        let tile = i32::from(QUADS) * WIDEST;
        for corner in squares(level.low, level.high, tile) {
            let (low, high) = bounds(level, corner, tile, heights);
            // What a finer level has whole, and some to spare, so that the two overlap; and what lies beyond the rim.
            let spare = inner - 8.0 * texel;
            let hidden = low.xz().min_element() > -spare && high.xz().max_element() < spare;
            let outside = low.xz().max_element() > rim || high.xz().min_element() < -rim;
            if hidden || outside || !light.sees(low, high) {
                continue;
            }
            let wanted = light.quad_at(light.place.truncate().clamp(low, high));
            let least = if finest && light.covers(low, high) { 1 } else { WIDEST };
            let quad = [WIDEST, 2].into_iter().find(|quad| *quad as f32 * texel <= wanted).unwrap_or(1).max(least);
            let side = i32::from(QUADS) * quad;
            let end = corner.map(|c| c + tile);
            for cell in squares(corner, end, side) {
                let (low, high) = bounds(level, cell, side, heights);
                if side == tile || light.sees(low, high) {
                    patches.push(Patch { level: i as u32, quad, cell });
                }
            }
        }
        inner = rim;
    }
}

/// The first cells of the squares of so many texels in a rectangle of cells.
fn squares(low: [i32; 2], high: [i32; 2], side: i32) -> impl Iterator<Item = [i32; 2]> {
    let rows = (low[1]..high[1]).step_by(side as usize);
    rows.flat_map(move |z| (low[0]..high[0]).step_by(side as usize).map(move |x| [x, z]))
}

/// The box that a square of so many texels may fill, as it is pushed.
fn bounds(level: &DrawnLevel, cell: [i32; 2], side: i32, heights: [f32; 2]) -> (Vec3, Vec3) {
    let texel = (level.exponent as f32).exp2();
    let [x, z] = [0, 1].map(|k| (cell[k] as f32 - level.fraction[k]) * texel);
    let (width, push) = (side as f32 * texel, PUSH * WIDEST as f32 * texel);
    (Vec3::new(x, heights[0], z) - push, Vec3::new(x + width, heights[1], z + width) + push)
}
