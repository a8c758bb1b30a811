// The solids of plants, and the cast of a ray against them; the twin of solid.rs, cast.rs and record.rs.
//
// Notation: a ray is origin + t·direction, in metres of a frame whose y is metres above the records' datum; `cell` is a cell's
// corner (its least x and z) in that frame; `spacing` the cells' edge. Nearby frames keep their digits: begin a ray where it
// enters the dual cell, not at the eye. A plant's own space has its foot at the origin and stands upright: x and z less
// `shear` times y. Straight rays stay straight there, and t stays t.
//
// Every solid is an ellipsoid, ‖p / r‖ = k ≤ 1. A crown's are eaten by foliage n in [0, 1] from outside, k ≤ 1 − foliage·n, so
// that they bound it. min(r)·(k − 1) has a slope of at most 1; with the foliage, 1 + min(r)·foliage·L, where L bounds n's slope.
//
// Whoever includes it defines, with bindings of its own,
//   var<uniform> plant_forest: PlantForest;
//   var plant_foliage: texture_3d<f32>;           64³ R8Unorm with all mips
//   var plant_foliage_sampler: sampler;           repeating, linear within and between mips
//   fn plant_at(cell: vec2<i32>) -> Plant         the record of a cell

const PLANT_STANDS: u32 = 1u;
const PLANT_ELLIPSOIDS: u32 = 4u;
const PLANT_STEPS: u32 = 160u;
// The shortest step in a crown, in pixels; after how many steps it begins to grow, so that a ray along the skin gets on; and
// how much, with each step.
const PLANT_STEP: f32 = 0.25;
const PLANT_PATIENCE: u32 = 24u;
const PLANT_HURRY: f32 = 1.1;
// Texels along the foliage table's edge, and its coarsest mip.
const PLANT_TEXELS: f32 = 64.0;
const PLANT_COARSEST: f32 = 6.0;

// What was hit.
const PLANT_NOTHING: u32 = 0u;
const PLANT_CROWN: u32 = 1u;
const PLANT_TRUNK: u32 = 2u;

// One cell's plant, of 32 bytes.
struct Plant {
    // Where in its cell, 0 to 1: x in the low half, z in the high one, unorm16.
    offset: u32,
    // Metres above the datum.
    foot: f32,
    // Metres.
    height: f32,
    // Of the crown, in metres.
    radius: f32,
    // Bits 0 to 3 the species, 4 to 7 flags (PLANT_STANDS), 8 to 15 the turn, 16 to 23 the tint.
    kind: u32,
    hash: u32,
    // The ground's normal, its x and z, snorm16.
    normal: u32,
    free: u32,
}

struct PlantSpecies {
    // Ellipsoids: the centre's height in heights, the radius along x and z in radii, along y in heights, and the centre's
    // distance from the trunk in radii.
    crown: array<vec4<f32>, 4>,
    // The same; no radius where there is no trunk.
    trunk: vec4<f32>,
    // Linear colours of the youngest and the oldest plant's leaves, and of the bark.
    young: vec3<f32>,
    // How much of an ellipsoid the foliage eats.
    foliage: f32,
    old: vec3<f32>,
    // How far a top leans at most, in heights.
    lean: f32,
    bark: vec3<f32>,
    // The crown's extinction, per metre.
    density: f32,
    // How many ellipsoids the crown has.
    ellipsoids: u32,
    // The foliage table's period, in metres.
    period: f32,
    // How much of the light goes through a leaf.
    translucency: f32,
    free: f32,
}

struct PlantForest {
    species: array<PlantSpecies, 4>,
    // Bounds of the foliage table's slope, per period, one for each mip from the finest on; each holds for all coarser ones.
    slope: array<vec4<f32>, 2>,
    // How far the wind moves the tops, in metres; no farther than the forest's `sway`.
    sway: vec2<f32>,
    // The gusts' phase, 0 to 2π.
    gust: f32,
    spacing: f32,
    // The foliage table's mean.
    mean: f32,
    free0: f32,
    free1: f32,
    free2: f32,
}

// A plant in a frame.
struct PlantSolid {
    // The foot.
    foot: vec3<f32>,
    height: f32,
    // Metres of x and z for each metre of y.
    shear: vec2<f32>,
    radius: f32,
    species: u32,
    // The cosine and sine of the turn.
    turn: vec2<f32>,
    hash: u32,
}

struct PlantHit {
    // Metres along the ray, of which the direction is of length 1.
    t: f32,
    // PLANT_NOTHING, PLANT_CROWN or PLANT_TRUNK.
    part: u32,
    // The cell that was hit, as `plant_at` takes it.
    cell: vec2<i32>,
}

struct PlantEllipsoid {
    centre: vec3<f32>,
    radii: vec3<f32>,
}

fn plant_stands(plant: Plant) -> bool {
    return ((plant.kind >> 4u) & PLANT_STANDS) != 0u;
}

fn plant_species_of(plant: Plant) -> u32 {
    return min(plant.kind & 15u, 3u);
}

// The age, from the youngest 0 to the oldest 1, for colours.
fn plant_tint(plant: Plant) -> f32 {
    return f32((plant.kind >> 16u) & 255u) / 255.0;
}

// The ground's normal at the foot.
fn plant_ground_normal(plant: Plant) -> vec3<f32> {
    let n = unpack2x16snorm(plant.normal);
    return vec3<f32>(n.x, sqrt(max(1.0 - dot(n, n), 0.0)), n.y);
}

fn plant_solid(plant: Plant, cell: vec2<f32>) -> PlantSolid {
    let species = plant_species_of(plant);
    let angle = f32((plant.kind >> 8u) & 255u) * (6.2831853 / 256.0);
    let turn = vec2<f32>(cos(angle), sin(angle));
    let lean = plant_forest.species[species].lean * f32(plant.hash >> 24u) / 255.0;
    let phase = f32(plant.hash & 0xffffu) * (6.2831853 / 65536.0);
    let sway = plant_forest.sway * (0.75 + 0.25 * sin(plant_forest.gust + phase));
    let at = cell + plant_forest.spacing * unpack2x16unorm(plant.offset);
    let foot = vec3<f32>(at.x, plant.foot, at.y);
    return PlantSolid(foot, plant.height, lean * turn + sway / plant.height, plant.radius, species, turn, plant.hash);
}

// A point of the frame, in the plant's own space; a direction with `plant_own_direction`.
fn plant_own(solid: PlantSolid, p: vec3<f32>) -> vec3<f32> {
    return plant_own_direction(solid, p - solid.foot);
}

fn plant_own_direction(solid: PlantSolid, d: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(d.x - solid.shear.x * d.y, d.y, d.z - solid.shear.y * d.y);
}

// A gradient of the plant's own space, in the frame.
fn plant_gradient_out(solid: PlantSolid, g: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(g.x, g.y - solid.shear.x * g.x - solid.shear.y * g.z, g.z);
}

// An ellipsoid of the crown, by its row of the table.
fn plant_ellipsoid(solid: PlantSolid, i: u32) -> PlantEllipsoid {
    // Each turned against the one before it by the golden angle.
    var by = vec2<f32>(1.0, 0.0);
    if i == 1u { by = vec2<f32>(-0.73736888, 0.67549029); }
    if i == 2u { by = vec2<f32>(0.08742572, -0.99617104); }
    if i == 3u { by = vec2<f32>(0.60843886, 0.79360075); }
    let row = plant_forest.species[solid.species].crown[i];
    let out = row.w * solid.radius;
    let side = out * vec2<f32>(by.x * solid.turn.x - by.y * solid.turn.y, by.x * solid.turn.y + by.y * solid.turn.x);
    let across = row.y * solid.radius;
    return PlantEllipsoid(
        vec3<f32>(side.x, row.x * solid.height, side.y),
        vec3<f32>(across, row.z * solid.height, across));
}

fn plant_trunk(solid: PlantSolid) -> PlantEllipsoid {
    let row = plant_forest.species[solid.species].trunk;
    let across = row.y * solid.radius;
    return PlantEllipsoid(vec3<f32>(0.0, row.x * solid.height, 0.0), vec3<f32>(across, row.z * solid.height, across));
}

// Where a ray of the plant's own space is inside of an ellipsoid; from 1 to 0 where nowhere.
fn plant_chord(ellipsoid: PlantEllipsoid, origin: vec3<f32>, direction: vec3<f32>) -> vec2<f32> {
    let o = (origin - ellipsoid.centre) / ellipsoid.radii;
    let d = direction / ellipsoid.radii;
    // From the nearest point, not from the origin: no square of a distance is subtracted from another.
    let dd = dot(d, d);
    let middle = -dot(o, d) / dd;
    let nearest = o + middle * d;
    let room = 1.0 - dot(nearest, nearest);
    if !(room > 0.0) {
        return vec2<f32>(1.0, 0.0);
    }
    let half = sqrt(room / dd);
    return vec2<f32>(middle - half, middle + half);
}

// How far along a ray the plant's middle lies.
fn plant_along(solid: PlantSolid, origin: vec3<f32>, direction: vec3<f32>) -> f32 {
    let half = 0.5 * solid.height;
    return dot(solid.foot + half * vec3<f32>(solid.shear.x, 1.0, solid.shear.y) - origin, direction);
}

// Which mip of the foliage a pixel of this many metres shows.
fn plant_level(species: u32, footprint: f32) -> f32 {
    let texel = plant_forest.species[species].period / PLANT_TEXELS;
    return clamp(log2(max(footprint, 1e-9) / texel), 0.0, PLANT_COARSEST);
}

// The foliage n at a point of the plant's own space.
fn plant_leaves(solid: PlantSolid, q: vec3<f32>, level: f32) -> f32 {
    let shift = vec3<f32>(vec3<u32>(solid.hash, solid.hash >> 10u, solid.hash >> 20u) & vec3<u32>(1023u)) / 1024.0;
    let u = q / plant_forest.species[solid.species].period + shift;
    return textureSampleLevel(plant_foliage, plant_foliage_sampler, u, level).x;
}

// The crown's function at a point of its own space: below 0 inside.
fn plant_crown(solid: PlantSolid, q: vec3<f32>, level: f32) -> f32 {
    let eaten = 1.0 - plant_forest.species[solid.species].foliage * plant_leaves(solid, q, level);
    var f = 3.0e38;
    for (var i = 0u; i < plant_forest.species[solid.species].ellipsoids; i++) {
        let e = plant_ellipsoid(solid, i);
        f = min(f, min(e.radii.x, e.radii.y) * (length((q - e.centre) / e.radii) - eaten));
    }
    return f;
}

// How much faster than 1 the crown's function may change, for each metre of its own space.
fn plant_slope(solid: PlantSolid, level: f32) -> f32 {
    let species = solid.species;
    let mip = u32(level);
    let bound = plant_forest.slope[mip >> 2u][mip & 3u] / plant_forest.species[species].period;
    var widest = 0.0;
    for (var i = 0u; i < plant_forest.species[species].ellipsoids; i++) {
        let row = plant_forest.species[species].crown[i];
        widest = max(widest, min(row.y * solid.radius, row.z * solid.height));
    }
    return 1.0 + plant_forest.species[species].foliage * widest * bound;
}

// The crown's outward normal at a point of the frame, not of unit length: a difference over `width` metres.
fn plant_crown_normal(solid: PlantSolid, p: vec3<f32>, width: f32, level: f32) -> vec3<f32> {
    let q = plant_own(solid, p);
    let a = vec3<f32>(1.0, -1.0, -1.0);
    let g = a.xyy * plant_crown(solid, q + width * a.xyy, level)
        + a.yyx * plant_crown(solid, q + width * a.yyx, level)
        + a.yxy * plant_crown(solid, q + width * a.yxy, level)
        + a.xxx * plant_crown(solid, q + width * a.xxx, level);
    return plant_gradient_out(solid, g);
}

// The normal of the ellipsoid that is nearest, without foliage: what a crown far away is lit by.
fn plant_smooth_normal(solid: PlantSolid, p: vec3<f32>) -> vec3<f32> {
    let q = plant_own(solid, p);
    var f = 3.0e38;
    var g = vec3<f32>(0.0, 1.0, 0.0);
    for (var i = 0u; i < plant_forest.species[solid.species].ellipsoids; i++) {
        let e = plant_ellipsoid(solid, i);
        let k = (q - e.centre) / e.radii;
        let depth = min(e.radii.x, e.radii.y) * (length(k) - 1.0);
        if depth < f {
            f = depth;
            g = k / e.radii;
        }
    }
    return plant_gradient_out(solid, g);
}

fn plant_trunk_normal(solid: PlantSolid, p: vec3<f32>) -> vec3<f32> {
    let e = plant_trunk(solid);
    return plant_gradient_out(solid, (plant_own(solid, p) - e.centre) / (e.radii * e.radii));
}

// Whether a ray comes near enough to a plant, within `range`, to meet it: most of a dual cell's four it does not. By bounds alone.
fn plant_is_near(plant: Plant, cell: vec2<f32>, origin: vec3<f32>, direction: vec3<f32>, range: vec2<f32>) -> bool {
    let species = plant_species_of(plant);
    let reach = plant.radius + plant_forest.species[species].lean * plant.height + length(plant_forest.sway) + 1e-3;
    let away = cell + plant_forest.spacing * unpack2x16unorm(plant.offset) - origin.xz;
    let across = away.x * direction.z - away.y * direction.x;
    let y = origin.y + direction.y * range - plant.foot;
    return across * across <= reach * reach * dot(direction.xz, direction.xz)
        && max(y.x, y.y) >= -plant.height && min(y.x, y.y) <= 1.01 * plant.height;
}

// Where, within `range`, a ray first meets a solid, and what: `footprint` is a pixel's width there, in metres. What is passed
// over is thinner than the shortest step.
fn plant_cast(solid: PlantSolid, origin: vec3<f32>, direction: vec3<f32>, range: vec2<f32>, footprint: f32) -> PlantHit {
    var hit = PlantHit(range.y, PLANT_NOTHING, vec2<i32>(0));
    let o = plant_own(solid, origin);
    let d = plant_own_direction(solid, direction);

    if plant_forest.species[solid.species].trunk.y > 0.0 {
        let chord = plant_chord(plant_trunk(solid), o, d);
        let start = max(chord.x, range.x);
        if start <= min(chord.y, hit.t) {
            hit.t = start;
            hit.part = PLANT_TRUNK;
        }
    }

    var enter = 3.0e38;
    var leave = -3.0e38;
    for (var i = 0u; i < plant_forest.species[solid.species].ellipsoids; i++) {
        let chord = plant_chord(plant_ellipsoid(solid, i), o, d);
        if chord.x <= chord.y {
            enter = min(enter, chord.x);
            leave = max(leave, chord.y);
        }
    }
    enter = max(enter, range.x);
    let cut = hit.t < leave;
    leave = min(leave, hit.t);
    if !(enter <= leave) {
        return hit;
    }
    let level = plant_level(solid.species, footprint);
    let per_metre = 1.0 / length(d);
    let pace = per_metre / plant_slope(solid, level);
    var least = PLANT_STEP * footprint * per_metre;
    var t = enter;
    // The step that led here, and the function before it.
    var step = 0.0;
    var before = 1.0;
    for (var i = 0u; i < PLANT_STEPS; i++) {
        let f = plant_crown(solid, o + t * d, level);
        if f < 0.0 {
            return PlantHit(t + step * f / (before - f), PLANT_CROWN, vec2<i32>(0));
        }
        if i >= PLANT_PATIENCE {
            least *= PLANT_HURRY;
        }
        step = max(least, f * pace);
        before = f;
        t += step;
        if t > leave {
            // What ends a ray within a crown may stand just behind its skin.
            let last = leave - (t - step);
            if cut && last > 0.0 {
                let f = plant_crown(solid, o + leave * d, level);
                if f < 0.0 {
                    return PlantHit(leave + last * f / (before - f), PLANT_CROWN, vec2<i32>(0));
                }
            }
            return hit;
        }
    }
    return hit;
}

// The nearest hit among the four plants that can reach into a dual cell: the square, half a cell off, around the corner that the
// cells `dual` and `dual + 1` share. The frame is that of the cell (0, 0)'s corner. `cone` is a pixel's width at the ray's
// origin, and how much it grows for each metre; it is taken once for each plant, so that dual cells agree on it.
fn plant_dual_cast(
    dual: vec2<i32>, origin: vec3<f32>, direction: vec3<f32>, range: vec2<f32>, cone: vec2<f32>) -> PlantHit {
    var hit = PlantHit(range.y, PLANT_NOTHING, dual);
    for (var i = 0; i < 4; i++) {
        let cell = dual + vec2<i32>(i & 1, i >> 1u);
        let plant = plant_at(cell);
        let corner = plant_forest.spacing * vec2<f32>(cell);
        if !plant_stands(plant) || !plant_is_near(plant, corner, origin, direction, vec2<f32>(range.x, hit.t)) {
            continue;
        }
        let solid = plant_solid(plant, corner);
        let footprint = max(cone.x + cone.y * plant_along(solid, origin, direction), 1e-6);
        let found = plant_cast(solid, origin, direction, vec2<f32>(range.x, hit.t), footprint);
        if found.part != PLANT_NOTHING {
            hit = PlantHit(found.t, found.part, cell);
        }
    }
    return hit;
}

// The optical depth of a plant's crown along a ray, within `range`: chords through the ellipsoids, as the mean foliage leaves them.
fn plant_depth(solid: PlantSolid, origin: vec3<f32>, direction: vec3<f32>, range: vec2<f32>) -> f32 {
    let o = plant_own(solid, origin);
    let d = plant_own_direction(solid, direction);
    let left = 1.0 - plant_forest.species[solid.species].foliage * plant_forest.mean;
    var depth = 0.0;
    for (var i = 0u; i < plant_forest.species[solid.species].ellipsoids; i++) {
        var e = plant_ellipsoid(solid, i);
        e.radii *= left;
        let chord = plant_chord(e, o, d);
        depth += max(min(chord.y, range.y) - max(chord.x, range.x), 0.0);
    }
    return depth * plant_forest.species[solid.species].density;
}
