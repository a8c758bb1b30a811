// The plants around a view: a window of the forest's lattice of cells, in tiles of 32 × 32, stored toroidally, and over each tile a
// pyramid of what its plants fill from below and above. Needs horizon_field's solids.wgsl.
//
// Notation. Cells are counted from the one that holds the passes' origin; the *frame* is that cell's corner: x and z are metres from
// there, y is metres above the datum. A *dual* cell (i, j) is the square between the middles of the cells i, i+1, j, j+1, whose plants
// alone can reach into it. The pyramid is of dual cells; a tile has those that are named by its own cells.

struct Grove {
    // The cell that holds the passes' origin, modulo the window; where the origin lies from that cell's corner, in metres.
    base: vec2<i32>,
    shift: vec2<f32>,
    // The window's cells: from low up to high, without it.
    low: vec2<i32>,
    high: vec2<i32>,
    // The eye's x and z in the frame, in metres.
    eye: vec2<f32>,
    // So many metres from it plants begin to shrink, and so many are left none.
    fades: f32,
    reach: f32,
    // Tiles along the window's side: a power of two.
    side: u32,
}

@group(0) @binding(6) var<uniform> grove: Grove;
@group(0) @binding(7) var<storage, read> grove_tiles: array<vec4<u32>>;
@group(0) @binding(8) var<uniform> plant_forest: PlantForest;

const GROVE_BITS: u32 = 5u;
const GROVE_TILE: u32 = 32u;
// In vectors of four words: a tile's plants, and those with the base and the unit of its bounds, in metres, and then a word a node.
const GROVE_BOUNDS: u32 = 2048u;
const GROVE_STRIDE: u32 = 2391u;
const GROVE_STEPS: u32 = 768u;

fn grove_index(cell: vec2<i32>) -> vec2<u32> {
    return vec2<u32>(grove.base + cell) & vec2<u32>(grove.side * GROVE_TILE - 1u);
}

fn grove_tile(at: vec2<u32>) -> u32 {
    return ((at.y >> GROVE_BITS) * grove.side + (at.x >> GROVE_BITS)) * GROVE_STRIDE;
}

fn plant_at(cell: vec2<i32>) -> Plant {
    let at = grove_index(cell);
    let within = at & vec2<u32>(GROVE_TILE - 1u);
    let i = grove_tile(at) + 2u * ((within.y << GROVE_BITS) + within.x);
    let a = grove_tiles[i];
    let b = grove_tiles[i + 1u];
    var plant = Plant(a.x, bitcast<f32>(a.y), bitcast<f32>(a.z), bitcast<f32>(a.w), b.x, b.y, b.z, b.w);
    let from_eye = distance(plant_forest.spacing * (vec2<f32>(cell) + unpack2x16unorm(plant.offset)), grove.eye);
    let left = clamp((grove.reach - from_eye) / (grove.reach - grove.fades), 0.0, 1.0);
    plant.height *= left;
    plant.radius *= left;
    plant.kind = select(plant.kind, 0u, left <= 0.0);
    return plant;
}

// A plant in the frame.
fn grove_solid(plant: Plant, cell: vec2<i32>) -> PlantSolid {
    return plant_solid(plant, plant_forest.spacing * vec2<f32>(cell));
}

// From the passes' coordinates to the frame.
fn grove_point(p: vec3<f32>) -> vec3<f32> {
    return p + vec3<f32>(grove.shift.x, 0.0, grove.shift.y);
}

// From where to where plants fill the 2^mip × 2^mip dual cells around one; mip 0 to 5.
fn grove_bounds(dual: vec2<i32>, mip: u32) -> vec2<f32> {
    let at = grove_index(dual);
    let node = (at & vec2<u32>(GROVE_TILE - 1u)) >> vec2<u32>(mip);
    let head = grove_tile(at) + GROVE_BOUNDS;
    let i = (4096u - (4096u >> (2u * mip))) / 3u + (node.y << (GROVE_BITS - mip)) + node.x;
    let word = grove_tiles[head + 1u + (i >> 2u)][i & 3u];
    if (word == 0u) {
        return vec2<f32>(1e30, -1e30);
    }
    let unit = bitcast<vec2<f32>>(grove_tiles[head].xy);
    return unit.x + unit.y * vec2<f32>(f32(word & 0xffffu), f32(word >> 16u));
}

// A ray's way through the dual cells.
struct GroveWalk {
    // In dual cells: where the ray begins, what it does in a metre, and the inverse of that.
    origin: vec2<f32>,
    d: vec2<f32>,
    inverse: vec2<f32>,
    // The height that it begins at, and what that does in a metre.
    y: vec2<f32>,
    t: f32,
    end: f32,
    // The node that it stands in, when it leaves it, and whether through a side of equal x.
    cell: vec2<i32>,
    mip: u32,
    low: vec2<i32>,
    t_exit: f32,
    through_x: bool,
    steps: u32,
}

// The way of a ray of the frame from t_start to t_end, begun in a node of this mip.
fn grove_walk(origin: vec3<f32>, direction: vec3<f32>, t_start: f32, t_end: f32, mip: u32) -> GroveWalk {
    var walk: GroveWalk;
    let per_metre = 1.0 / plant_forest.spacing;
    walk.origin = origin.xz * per_metre - 0.5;
    walk.d = direction.xz * per_metre;
    let along = abs(walk.d) < vec2<f32>(1e-20);
    walk.inverse = select(1.0 / walk.d, select(vec2<f32>(-1e30), vec2<f32>(1e30), walk.d >= vec2<f32>(0.0)), along);
    walk.y = vec2<f32>(origin.y, direction.y);
    // The dual cells whose four plants are all in the window.
    let low = vec2<f32>(grove.low);
    let high = vec2<f32>(grove.high - vec2<i32>(1));
    let a = (low - walk.origin) * walk.inverse;
    let b = (high - walk.origin) * walk.inverse;
    let enters = max(min(a.x, b.x), min(a.y, b.y));
    let leaves = min(max(a.x, b.x), max(a.y, b.y));
    walk.t = max(t_start, enters);
    walk.end = min(t_end, leaves);
    walk.cell = clamp(vec2<i32>(floor(walk.origin + walk.d * walk.t)), grove.low, grove.high - vec2<i32>(2));
    walk.mip = mip;
    return walk;
}

fn grove_node(walk: ptr<function, GroveWalk>) {
    let mip = vec2<u32>((*walk).mip);
    (*walk).low = (((grove.base + (*walk).cell) >> mip) << mip) - grove.base;
    let high = (*walk).low + vec2<i32>(1 << (*walk).mip);
    let ahead = select(vec2<f32>((*walk).low), vec2<f32>(high), (*walk).d >= vec2<f32>(0.0));
    let exits = (ahead - (*walk).origin) * (*walk).inverse;
    (*walk).t_exit = max(min(exits.x, exits.y), (*walk).t);
    (*walk).through_x = exits.x <= exits.y;
}

// The cell of the node that the ray stands in at t.
fn grove_within(walk: GroveWalk) -> vec2<i32> {
    let at = vec2<i32>(floor(walk.origin + walk.d * walk.t));
    return clamp(at, walk.low, walk.low + vec2<i32>((1 << walk.mip) - 1));
}

// On to the neighbour, named exactly by the side that the ray leaves through: no dual cell is skipped by rounding.
fn grove_leave(walk: ptr<function, GroveWalk>) {
    let last = grove.base + (*walk).cell;
    (*walk).t = (*walk).t_exit;
    let along = grove_within(*walk);
    let side = select((*walk).low - vec2<i32>(1), (*walk).low + vec2<i32>(1 << (*walk).mip), (*walk).d >= vec2<f32>(0.0));
    (*walk).cell = select(vec2<i32>(along.x, side.y), vec2<i32>(side.x, along.y), (*walk).through_x);
    let up = vec2<u32>((*walk).mip + 1u);
    let climbs = (*walk).mip < GROVE_BITS && any(((grove.base + (*walk).cell) >> up) != (last >> up));
    (*walk).mip += select(0u, 1u, climbs);
    if (any((*walk).cell < grove.low) || any((*walk).cell > grove.high - vec2<i32>(2))) {
        (*walk).end = -1.0;
    }
}

// On to the next dual cell in which the ray may meet a plant: it stands before that, with t_exit. False where there is none. Its own
// loop, so that the lanes of a group test their plants together.
fn grove_next(walk: ptr<function, GroveWalk>) -> bool {
    while ((*walk).t < (*walk).end && (*walk).steps < GROVE_STEPS) {
        (*walk).steps += 1u;
        grove_node(walk);
        let filled = grove_bounds((*walk).cell, (*walk).mip);
        let y = (*walk).y.x + (*walk).y.y * vec2<f32>((*walk).t, min((*walk).t_exit, (*walk).end));
        if (max(y.x, y.y) < filled.x || min(y.x, y.y) > filled.y) {
            grove_leave(walk);
            continue;
        }
        if ((*walk).mip == 0u) {
            return true;
        }
        // Not before the ray has fallen to the highest plant.
        if (y.x > filled.y) {
            (*walk).t = clamp((filled.y - (*walk).y.x) / (*walk).y.y, (*walk).t, (*walk).t_exit);
        }
        let cell = grove_within(*walk);
        (*walk).mip -= 1u;
        (*walk).cell = cell;
    }
    return false;
}
