// How dense a cloud is, from 0 to 1; the twin of density.rs, where the reasons stand. The host gives:
//   fn cloud_volume(u: vec3<f32>) -> vec3<f32>            the noise at u periods, filtered linearly, repeating
//   fn cloud_volume_most(block: vec3<i32>, mip: u32) -> vec3<f32>     the texel of a mip; any block's index
//   fn cloud_weather(cloud: Cloud, at: vec3<f32>) -> vec2<f32>        coverage and kind; cloud.weather, if nothing is bound
//   fn cloud_weather_most(cloud: Cloud, at: vec3<f32>, reach: f32) -> vec2<f32>   the most of each within a reach

const CLOUD_SHEET: u32 = 0u;
const CLOUD_SLAB: u32 = 1u;
const CLOUD_BILLOW: u32 = 2u;
const CLOUD_BLOCKS: f32 = 64.0;
const CLOUD_RISE: f32 = 0.07;
const CLOUD_FALL: vec4<f32> = vec4<f32>(0.15, 0.3, 0.35, 1.0);
const CLOUD_TURN: f32 = 5.0;

// Phase function: a forward lobe, and another that stretches along the axis by alpha.
struct CloudPhase {
    forward: f32,
    other: f32,
    alpha: f32,
    share: f32,
}

struct Cloud {
    offset: vec3<f32>,
    per_shape: f32,
    detail_offset: vec3<f32>,
    per_detail: f32,
    base: f32,
    thickness: f32,
    extinction: f32,
    softness: f32,
    erosion: f32,
    model: u32,
    // Coverage and kind where nothing else is bound.
    weather: vec2<f32>,
    phase: CloudPhase,
}

struct CloudPoint {
    at: vec3<f32>,
    altitude: f32,
    up: vec3<f32>,
}

fn cloud_height(cloud: Cloud, altitude: f32) -> f32 {
    return (altitude - cloud.base) / cloud.thickness;
}

// Before erosion, at heights from low to high: at most.
fn cloud_base_density(cloud: Cloud, noise: vec3<f32>, low: f32, high: f32, weather: vec2<f32>) -> f32 {
    if high < 0.0 || low > 1.0 {
        return 0.0;
    }
    let least = 1.0 - clamp(weather.x, 0.0, 1.0);
    var above = noise.y - least;
    if cloud.model == CLOUD_SLAB {
        let off = max(max(low - 0.5, 0.5 - high), 0.0);
        above = 2.0 * (noise.y - least - off);
    } else if cloud.model == CLOUD_BILLOW {
        let ends = mix(CLOUD_FALL.xy, CLOUD_FALL.zw, clamp(weather.y, 0.0, 1.0));
        let rise = high / CLOUD_RISE;
        let fall = (ends.y - low) / (ends.y - ends.x);
        above = noise.x * clamp(min(rise, fall), 0.0, 1.0) - least;
    }
    return clamp(above / cloud.softness, 0.0, 1.0);
}

fn cloud_eroded(cloud: Cloud, base: f32, billows: f32, height: f32) -> f32 {
    let turn = select(1.0, clamp(height * CLOUD_TURN, 0.0, 1.0), cloud.model == CLOUD_BILLOW);
    let lost = cloud.erosion * (billows + turn * (1.0 - billows - billows));
    return clamp((base - lost) / (1.0 - lost), 0.0, 1.0);
}

// In periods.
fn cloud_shape_at(cloud: Cloud, point: CloudPoint) -> vec3<f32> {
    let lift = select(0.0, point.altitude - cloud.base, cloud.model == CLOUD_SHEET);
    return (point.at - lift * point.up) * cloud.per_shape + cloud.offset;
}

fn cloud_density(cloud: Cloud, point: CloudPoint, weather: vec2<f32>) -> f32 {
    let height = cloud_height(cloud, point.altitude);
    if height < 0.0 || height > 1.0 {
        return 0.0;
    }
    let noise = cloud_volume(cloud_shape_at(cloud, point));
    let base = cloud_base_density(cloud, noise, height, height, weather);
    if base <= 0.0 || cloud.erosion <= 0.0 {
        return base;
    }
    let billows = cloud_volume(point.at * cloud.per_detail + cloud.detail_offset).z;
    return cloud_eroded(cloud, base, billows, height);
}

// The block of a mip at u periods.
fn cloud_block(u: vec3<f32>, mip: u32) -> vec3<i32> {
    return vec3<i32>(floor(u * (CLOUD_BLOCKS / f32(1u << mip))));
}
