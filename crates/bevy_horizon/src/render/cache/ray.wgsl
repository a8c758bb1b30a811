// A ray in the passes' coordinates.
struct Ray {
    // From the clipmap's centre; y above the datum.
    origin: vec3<f32>,
    direction: vec3<f32>,
}
