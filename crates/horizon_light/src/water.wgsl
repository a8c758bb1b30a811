// What light does on and in water; the twin of water.rs and water/, where the reasons stand. y is up, depth counts downward from
// the mean surface; eta: refractive index where light goes to over that where it comes from. Lengths in metres, coefficients per
// metre.

const WATER_PI: f32 = 3.14159265;
const WATER_SKY_COSINE: f32 = 0.84;
const WATER_SKY_PEAK: f32 = 0.47;
const WATER_KIRK: vec4<f32> = vec4<f32>(5.6, 2.5, 0.975, 0.629);
const WATER_GATHERED: f32 = 0.2;
const WATER_MILKY: f32 = 5.0;
const WATER_FARTHEST: f32 = 1e7;
const WATER_LOWEST_SUN: f32 = 0.01;
const WATER_MOLECULES: f32 = 0.835;
const WATER_ROUGHEST: f32 = 0.2;
const WATER_NARROWEST: f32 = 1e-6;
const WATER_FIT: vec2<f32> = vec2<f32>(1.43, 0.105);
const WATER_DIFFUSE: vec3<f32> = vec3<f32>(0.3156, 0.7267, 5.4);
const WATER_BRIGHTEST: f32 = 10.0;

struct Water {
    absorption: vec3<f32>,
    index: f32,
    // By particles, and the mean cosine of it.
    scattering: vec3<f32>,
    anisotropy: f32,
    // Scattering by the water itself.
    molecules: vec3<f32>,
    // Albedo of dense foam.
    foam: f32,
}

// What lights the water just below its surface.
struct WaterLight {
    // Towards the sun as seen from under water.
    sun: vec3<f32>,
    // On level planes.
    sun_irradiance: vec3<f32>,
    sky_irradiance: vec3<f32>,
}

// How one source's light falls with depth: K per metre, and upwelling radiance over downwelling irradiance.
struct WaterField {
    decay: vec3<f32>,
    up: vec3<f32>,
}

struct WaterRefracted {
    direction: vec3<f32>,
    total: bool,
}

// Surface

fn water_beyond_squared(cosine: f32, eta: f32) -> f32 {
    return (eta - 1.0) * (eta + 1.0) + cosine * cosine;
}

// Reflectance for unpolarised light; 1 where reflection is total.
fn water_fresnel(cosine: f32, eta: f32) -> f32 {
    let c = min(abs(cosine), 1.0);
    let squared = water_beyond_squared(c, eta);
    if squared <= 0.0 {
        return 1.0;
    }
    let g = sqrt(squared);
    let across = (c - g) / max(c + g, 1e-20);
    let within = (eta * eta * c - g) / max(eta * eta * c + g, 1e-20);
    return min(0.5 * (across * across + within * within), 1.0);
}

// What is left of radiance that crosses the surface, (1 - F) eta^2.
fn water_crossing(cosine: f32, eta: f32) -> f32 {
    return (1.0 - water_fresnel(cosine, eta)) * eta * eta;
}

// Snell's law; mirrored where reflection is total.
fn water_refract(direction: vec3<f32>, normal: vec3<f32>, eta: f32) -> WaterRefracted {
    let along = dot(direction, normal);
    let squared = water_beyond_squared(min(abs(along), 1.0), eta);
    if squared <= 0.0 {
        return WaterRefracted(direction - 2.0 * along * normal, true);
    }
    let root = sqrt(squared);
    let forward = select(root, -root, along < 0.0);
    return WaterRefracted((direction + (forward - along) * normal) / eta, false);
}

fn water_critical_cosine(index: f32) -> f32 {
    return sqrt(max((index - 1.0) * (index + 1.0), 0.0)) / index;
}

// Reflectance for all of a uniform sky.
fn water_diffuse_reflectance(index: f32) -> f32 {
    let u = index - 1.0;
    return u * (WATER_DIFFUSE.x + WATER_DIFFUSE.y * u) / (1.0 + WATER_DIFFUSE.z * u);
}

// Rough surface

// Distribution function and density of the standard normal, for x >= 0.
fn water_normal(x: f32) -> vec2<f32> {
    let y = min(x, 10.0);
    let e = exp(-0.5 * y * y);
    let t = 1.0 / (1.0 + 0.231641888 * y);
    let tail = t * (0.127414796 + t * (-0.142248368 + t * (0.7107068705 + t * (-0.726576013 + t * 0.5307027145))));
    return vec2<f32>(1.0 - tail * e, 0.39894228 * e);
}

// Facets seen, per unit of area of the plane.
fn water_seen(m: f32, w: f32) -> f32 {
    let normal = water_normal(m / max(w, 1e-15));
    return m * normal.x + w * normal.y;
}

// Mean reflectance over Gaussian slopes; cosine between view and mean normal, variance of slopes along the view.
fn water_reflectance(cosine: f32, variance: f32, index: f32) -> f32 {
    let c = clamp(cosine, 0.0, 1.0);
    let v = clamp(variance, 1e-12, WATER_ROUGHEST);
    let sigma = sqrt(v);
    let w = sigma * sqrt((1.0 - c) * (1.0 + c));
    let normal = water_normal(c / max(w, 1e-15));
    let facing = c + w * w * normal.x / (c * normal.x + w * normal.y);
    let bow = WATER_FIT.x * sigma * v / (v + WATER_FIT.y * c * c);
    return water_fresnel(min(facing / (1.0 + bow), 1.0), index);
}

fn water_sun_variance(radius: f32) -> f32 {
    return 0.125 * radius * radius;
}

// The sun's reflection: radiance per irradiance on a plane that faces the sun. `radius`: the sun's angular one.
fn water_glitter(
    view: vec3<f32>, sun: vec3<f32>, normal: vec3<f32>, variance: vec2<f32>, radius: f32, index: f32,
) -> f32 {
    let halfway = view + sun;
    let level = max(normal.y, 1e-4);
    let lit = dot(sun, normal) / level;
    if halfway.y < 1e-4 || lit <= 0.0 {
        return 0.0;
    }
    let plane = max(dot(view, normal) / level, 0.0);
    let p = -halfway.x / halfway.y;
    let q = -halfway.z / halfway.y;
    let dp = p + normal.x / level;
    let dq = q + normal.z / level;
    let disc = max(radius, WATER_NARROWEST);
    let tau = 0.5 * disc * disc / (halfway.y * halfway.y);
    let a = vec3<f32>(p * sun.z, -sun.z, sun.y - p * sun.x);
    let b = vec3<f32>(q * sun.z - sun.y, sun.x, -q * sun.x);
    let x = max(variance.x, 0.0);
    let z = max(variance.y, 0.0);
    let facing = sun.y - p * sun.x - q * sun.z;
    let determinant = x * z + tau * (x * dot(b, b) + z * dot(a, a)) + tau * tau * facing * facing;
    let across = dp * b - dq * a;
    let exponent = (z * dp * dp + x * dq * dq + tau * dot(across, across)) / determinant;
    let steep = 1.0 + p * p + q * q;
    let density = exp(-0.5 * exponent) * steep * steep / (2.0 * WATER_PI * sqrt(determinant));
    let seen_all = water_seen(plane, sqrt(x * view.x * view.x + z * view.z * view.z));
    let lit_all = water_seen(lit, sqrt(x * sun.x * sun.x + z * sun.z * sun.z));
    let masked = lit / max(seen_all * lit + plane * max(lit_all - lit, 0.0), 1e-12);
    let cosine = dot(view, halfway) / sqrt(dot(halfway, halfway));
    return water_fresnel(cosine, index) * min(density * masked * 0.25, 1.0 / (WATER_PI * disc * disc));
}

// Body

fn water_attenuation(water: Water) -> vec3<f32> {
    return water.absorption + water.scattering + water.molecules;
}

// Which share of a Henyey-Greenstein lobe lies behind.
fn water_backward_share(g: f32) -> f32 {
    let root = sqrt(1.0 + g * g);
    return (1.0 - g) / (root * (1.0 + g + root));
}

fn water_backscattering(water: Water) -> vec3<f32> {
    return water_backward_share(water.anisotropy) * water.scattering + 0.5 * water.molecules;
}

// Henyey and Greenstein's phase function.
fn water_lobe(g: f32, nu: f32) -> f32 {
    let gap = 1.0 - abs(g);
    let base = gap * gap + 2.0 * abs(g) * select(1.0 - nu, 1.0 + nu, g < 0.0);
    return 0.25 / WATER_PI * (1.0 - g * g) / (base * sqrt(base));
}

// (1 - e^-x)/x for x >= 0, by its series where that cancels.
fn water_faded(x: vec3<f32>) -> vec3<f32> {
    let y = min(x, vec3<f32>(1e-2));
    let series = 1.0 - y * (0.5 - y / 6.0);
    return select((1.0 - exp(-x)) / max(x, vec3<f32>(1e-2)), series, x < vec3<f32>(1e-2));
}

// What is left of a beam, which draws images.
fn water_transmittance(water: Water, distance: f32) -> vec3<f32> {
    return exp(-water_attenuation(water) * clamp(distance, 0.0, WATER_FARTHEST));
}

// What arrives besides, blurred: of a bed's mean radiance less the water's own upwelling there.
fn water_blurred(water: Water, distance: f32) -> vec3<f32> {
    let reach = clamp(distance, 0.0, WATER_FARTHEST);
    let beam = water_attenuation(water);
    let kept = min(water_field(water, 1.0).decay, beam);
    let forward = (beam - kept) * reach;
    return exp(-kept * reach) * forward * water_faded(forward);
}

// `sun_irradiance` on a plane that faces the sun, `sky_irradiance` on a level one, both above the water.
fn water_lit(water: Water, sun: vec3<f32>, sun_irradiance: vec3<f32>, sky_irradiance: vec3<f32>) -> WaterLight {
    let x = sun.x / water.index;
    let z = sun.z / water.index;
    let up = max(sqrt(max(1.0 - x * x - z * z, 0.0)), WATER_LOWEST_SUN);
    let above = max(sun.y, 0.0);
    let enters = above * (1.0 - water_fresnel(above, water.index));
    let sky = 1.0 - water_diffuse_reflectance(water.index);
    return WaterLight(vec3<f32>(x, up, z), sun_irradiance * enters, sky_irradiance * sky);
}

fn water_field(water: Water, cosine: f32) -> WaterField {
    let a = water.absorption;
    let diffuse = (1.0 - water.anisotropy) * water.scattering + water.molecules;
    let turns = max(WATER_KIRK.x * cosine - WATER_KIRK.y, 0.0);
    let decay = sqrt(a * (a + turns * diffuse)) / cosine;
    let once = 2.0 * water_backscattering(water) * (WATER_KIRK.z - WATER_KIRK.w * cosine);
    let milky = diffuse / max(diffuse + WATER_MILKY * a, vec3<f32>(1e-30));
    let y = once + max(0.375 * diffuse - once, vec3<f32>(0.0)) * milky;
    let ratio = y / max(a + y + sqrt(a * (a + y + y)), vec3<f32>(1e-30));
    return WaterField(decay, ratio / WATER_PI);
}

// Irradiance on a level plane, from above.
fn water_irradiance(water: Water, light: WaterLight, depth: f32) -> vec3<f32> {
    let z = clamp(depth, 0.0, WATER_FARTHEST);
    return light.sun_irradiance * exp(-water_field(water, light.sun.y).decay * z)
        + light.sky_irradiance * exp(-water_field(water, WATER_SKY_COSINE).decay * z);
}

// Radiance that deep water sends up, the same to all sides.
fn water_upwelling(water: Water, light: WaterLight, depth: f32) -> vec3<f32> {
    let z = clamp(depth, 0.0, WATER_FARTHEST);
    let sun = water_field(water, light.sun.y);
    let sky = water_field(water, WATER_SKY_COSINE);
    return light.sun_irradiance * sun.up * exp(-sun.decay * z) + light.sky_irradiance * sky.up * exp(-sky.decay * z);
}

// One source's light scattered into a ray: `scattered` is the scattering towards the eye, per metre and steradian.
fn water_part(
    water: Water, cosine: f32, scattered: vec3<f32>, turned: vec3<f32>, depth: f32, end: f32, down: f32, distance: f32,
) -> vec3<f32> {
    let field = water_field(water, cosine);
    let beam = water_attenuation(water);
    let near = field.decay * depth;
    let far = field.decay * end + beam * distance;
    let reach = distance * water_faded(abs(beam + field.decay * down) * distance);
    let gathered = 1.0 + WATER_GATHERED * (1.0 - WATER_PI * field.up);
    return (scattered / cosine + turned * field.up * gathered) * exp(-min(near, far)) * reach;
}

// Light scattered into `distance` of a view ray from `depth`: radiance where it starts. Ends at the surface at the latest.
fn water_in_scatter(water: Water, light: WaterLight, depth: f32, direction: vec3<f32>, distance: f32) -> vec3<f32> {
    let down = clamp(-direction.y, -1.0, 1.0);
    let start = clamp(depth, 0.0, WATER_FARTHEST);
    var reach = clamp(distance, 0.0, WATER_FARTHEST);
    if -down * reach > start {
        reach = start / -down;
    }
    let end = max(start + down * reach, 0.0);
    let toward = clamp(dot(light.sun, direction), -1.0, 1.0);
    let sun_molecules = (1.0 + WATER_MOLECULES * toward * toward) / (4.0 * WATER_PI * (1.0 + WATER_MOLECULES / 3.0));
    let sun_scattered = water.scattering * water_lobe(water.anisotropy, toward) + water.molecules * sun_molecules;
    let sky_scattered = water.scattering * min(water_lobe(water.anisotropy * WATER_SKY_COSINE, -down), WATER_SKY_PEAK)
        + water.molecules * (0.25 / WATER_PI);
    let backward = water_backscattering(water);
    let turned = backward + (water.scattering + water.molecules - 2.0 * backward) * (0.5 * (1.0 + down));
    return light.sun_irradiance * water_part(water, light.sun.y, sun_scattered, turned, start, end, down, reach)
        + light.sky_irradiance * water_part(water, WATER_SKY_COSINE, sky_scattered, turned, start, end, down, reach);
}

// How much brighter the bed is than under a flat surface; `hessian`: d2h/dx2, d2h/dxdz, d2h/dz2 of the surface's height.
fn water_focus(hessian: vec3<f32>, depth: f32, index: f32, bound: f32) -> f32 {
    let h = clamp(max(depth, 0.0) * (1.0 - 1.0 / index) * hessian, vec3<f32>(-1e15), vec3<f32>(1e15));
    let area = (1.0 + h.x) * (1.0 + h.z) - h.y * h.y;
    let least = 1.0 / (bound * bound);
    return sqrt((1.0 + least) / (area * area + least));
}

// Radiance of a surface of which foam covers a share; irradiance on a level plane.
fn water_foam(radiance: vec3<f32>, irradiance: vec3<f32>, albedo: f32, coverage: f32) -> vec3<f32> {
    return mix(radiance, irradiance * (albedo / WATER_PI), clamp(coverage, 0.0, 1.0));
}
