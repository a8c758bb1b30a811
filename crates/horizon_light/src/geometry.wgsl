// Rays through a shell of air round a sphere; the twin of geometry.rs, where the reasons stand. h: altitude >= 0, mu:
// cosine between the local vertical and the ray, radius: the ground's; lengths in metres.

fn shell_excess(radius: f32, level: f32, h: f32) -> f32 {
    return (h - level) * (radius + radius + h + level);
}

fn shell_discriminant(radius: f32, level: f32, h: f32, mu: f32) -> f32 {
    let r = radius + h;
    let a = radius + level;
    let c = shell_excess(radius, level, h);
    if c < a * a {
        return r * mu * (r * mu) - c;
    }
    return a * a - r * r * ((1.0 - mu) * (1.0 + mu));
}

fn hits_ground(radius: f32, h: f32, mu: f32) -> bool {
    return mu < 0.0 && shell_discriminant(radius, 0.0, h, mu) >= 0.0;
}

fn distance_to_ground(radius: f32, h: f32, mu: f32) -> f32 {
    let ahead = max(-(radius + h) * mu, 0.0);
    let root = sqrt(max(shell_discriminant(radius, 0.0, h, mu), 0.0));
    if ahead > 0.0 && root > 0.0 {
        return shell_excess(radius, 0.0, h) / (ahead + root);
    }
    return ahead;
}

fn distance_to_top(radius: f32, height: f32, h: f32, mu: f32) -> f32 {
    let along = (radius + h) * mu;
    let below = max(-shell_excess(radius, height, h), 0.0);
    let root = sqrt(along * along + below);
    if along > 0.0 {
        return below / (along + root);
    }
    return root - along;
}

// Near and far distance in the air; both 0 for a ray that misses it.
fn air_interval(radius: f32, height: f32, h: f32, mu: f32) -> vec2<f32> {
    if h <= height {
        return vec2(0.0, distance_to_top(radius, height, h, mu));
    }
    let square = shell_discriminant(radius, height, h, mu);
    if mu >= 0.0 || square <= 0.0 {
        return vec2(0.0);
    }
    let far = sqrt(square) - (radius + h) * mu;
    return vec2(shell_excess(radius, height, h) / far, far);
}

fn distance_to_end(radius: f32, height: f32, h: f32, mu: f32) -> f32 {
    if hits_ground(radius, h, mu) {
        return distance_to_ground(radius, h, mu);
    }
    return distance_to_top(radius, height, h, mu);
}

// Altitude and local cosine after `distance`.
fn advance(radius: f32, h: f32, mu: f32, distance: f32) -> vec2<f32> {
    let along = (radius + h) * mu;
    let grown = max(h * (radius + radius + h) + distance * (distance + along + along), 0.0);
    let above = grown / (radius + sqrt(radius * radius + grown));
    return vec2(above, clamp((along + distance) / (radius + above), -1.0, 1.0));
}

fn advance_sun(radius: f32, h: f32, mu_s: f32, nu: f32, distance: f32, above: f32) -> f32 {
    return clamp(((radius + h) * mu_s + distance * nu) / (radius + above), -1.0, 1.0);
}

fn horizon_distance(radius: f32, h: f32) -> f32 {
    return sqrt(shell_excess(radius, 0.0, h));
}

fn horizon_cosine(radius: f32, h: f32) -> f32 {
    return -horizon_distance(radius, h) / (radius + h);
}

fn lowest_altitude(radius: f32, h: f32, mu: f32) -> f32 {
    if mu >= 0.0 {
        return h;
    }
    return advance(radius, h, mu, -(radius + h) * mu).x;
}
