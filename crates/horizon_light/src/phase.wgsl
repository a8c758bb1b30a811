// Phase functions, per steradian; the twin of phase.rs. nu: cosine of the angle of deflection.

fn rayleigh_phase(nu: f32) -> f32 {
    return 0.059683104 * (1.0 + nu * nu); // 3/(16 pi)
}

// Cornette and Shanks 1992.
fn mie_phase(g: f32, nu: f32) -> f32 {
    // 1 + g^2 - 2 g nu as a sum of squares: it neither cancels nor turns negative when g and nu approach 1.
    let gap = 1.0 - g;
    let base = gap * gap + 2.0 * g * (1.0 - nu);
    let k = 0.119366207 * (1.0 - g * g) / (2.0 + g * g); // 3/(8 pi)
    return k * (1.0 + nu * nu) / (base * sqrt(base));
}
