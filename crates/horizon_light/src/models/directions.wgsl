// Directions over the sphere, for what arrives at a point of the air from all round; the twin of directions.rs.

// Nodes and weights of Gauss's rule on [0, 1].
const POLAR: array<vec2<f32>, 6> = array(
    vec2(0.03376524, 0.085662246),
    vec2(0.16939531, 0.18038079),
    vec2(0.3806904, 0.23395696),
    vec2(0.6193096, 0.23395696),
    vec2(0.8306047, 0.18038079),
    vec2(0.96623474, 0.085662246),
);
// Cosines of azimuths from the sun, on one side.
const AZIMUTHS: array<f32, 4> = array(0.9238795, 0.38268343, -0.38268343, -0.9238795);

const DIRECTIONS: u32 = 48u;

struct Direction {
    view: SkyRay,
    // Component along the sun's azimuth.
    sunward: f32,
    distance: f32,
    ground: bool,
    // Steradians.
    weight: f32,
}

// A ray: its altitude, in metres; the cosines of vertical and ray, vertical and sun, ray and sun.
struct SkyRay {
    h: f32,
    mu: f32,
    mu_s: f32,
    nu: f32,
}

fn direction(air: Medium, h: f32, mu_s: f32, index: u32) -> Direction {
    let ground = index >= 24u;
    var polar = POLAR;
    var azimuths = AZIMUTHS;
    let node = polar[(index / 4u) % 6u];
    let horizon = horizon_cosine(air.radius, h);
    let span = select(1.0, -1.0, ground) - horizon;
    let mu = horizon + span * node.x;
    var distance = distance_to_top(air.radius, air.height, h, mu);
    if ground {
        distance = distance_to_ground(air.radius, h, mu);
    }
    let x = sine(mu) * azimuths[index % 4u];
    let nu = clamp(mu * mu_s + x * sine(mu_s), -1.0, 1.0);
    return Direction(SkyRay(h, mu, mu_s, nu), x, distance, ground, abs(span) * node.y * 1.57079633); // 2 pi over four azimuths
}

fn sunward(mu: f32, mu_s: f32, nu: f32) -> f32 {
    let most = sine(mu);
    return clamp((nu - mu * mu_s) / max(sine(mu_s), 1e-6), -most, most);
}

fn sine(cosine: f32) -> f32 {
    return sqrt(max((1.0 - cosine) * (1.0 + cosine), 0.0));
}
