// Where a droplet scatters light to, per steradian; the twin of phase.rs.

// Henyey and Greenstein's.
fn cloud_lobe(g: f32, nu: f32) -> f32 {
    let gap = 1.0 - abs(g);
    let base = gap * gap + 2.0 * abs(g) * select(1.0 - nu, 1.0 + nu, g < 0.0);
    return 0.079577472 * (1.0 - g * g) / (base * sqrt(base)); // 1/(4 pi)
}

fn cloud_phase(phase: CloudPhase, nu: f32) -> f32 {
    let stretch = (1.0 + phase.alpha * nu * nu) / (1.0 + phase.alpha * (1.0 + 2.0 * phase.other * phase.other) / 3.0);
    return (1.0 - phase.share) * cloud_lobe(phase.forward, nu) + phase.share * cloud_lobe(phase.other, nu) * stretch;
}

fn cloud_phase_flattened(phase: CloudPhase, by: f32) -> CloudPhase {
    return CloudPhase(phase.forward * by, phase.other * by, phase.alpha * by, phase.share);
}
