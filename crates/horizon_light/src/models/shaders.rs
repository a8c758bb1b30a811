//! The models' WGSL, in pieces that a host joins. None has directives; what a piece needs of its host it says in its first lines.

/// Rays, phases, densities, the uniform `Medium`, tables, steps, and how the transmittance table is made. Needs nothing.
pub const BASE: &str = concat!(
    include_str!("../geometry.wgsl"),
    include_str!("../phase.wgsl"),
    include_str!("../profile.wgsl"),
    include_str!("air.wgsl"),
    include_str!("table.wgsl"),
    include_str!("steps.wgsl"),
    include_str!("transmittance_compute.wgsl"),
);

/// The shared march, after [`BASE`] and with one of [`ONCE`], [`MOMENTS`] and [`ISOTROPIC`]. Reads transmittance.
pub const SCATTER: &str =
    concat!(include_str!("transmittance.wgsl"), include_str!("scatter.wgsl"), include_str!("directions.wgsl"));

/// Rays, and their directions relative to the sun; needs nothing. In [`SCATTER`] too.
pub const DIRECTIONS: &str = include_str!("directions.wgsl");

/// Reading transmittance alone, after [`BASE`].
pub const TRANSMITTANCE: &str = include_str!("transmittance.wgsl");

/// Spherical harmonics of a direction, for light given by its moments. In [`MOMENTS_COMPUTE`] too.
pub const HARMONICS: &str = include_str!("harmonics.wgsl");

/// Single scattering.
pub const ONCE: &str = include_str!("once.wgsl");

/// How the moments are made: the first pass with [`ONCE`], further ones with [`MOMENTS`].
pub const MOMENTS_COMPUTE: &str = concat!(include_str!("harmonics.wgsl"), include_str!("moments_compute.wgsl"));

/// Multiple scattering by moments, after [`MOMENTS_COMPUTE`]. Reads moments.
pub const MOMENTS: &str = include_str!("moments.wgsl");

/// Isotropic multiple scattering. Reads its table.
pub const ISOTROPIC: &str = include_str!("isotropic.wgsl");

/// How the isotropic table is made: with [`ONCE`].
pub const ISOTROPIC_COMPUTE: &str = include_str!("isotropic_compute.wgsl");

/// How the sky view is made, with any model; goes with [`SKY_VIEW`].
pub const SKY_VIEW_COMPUTE: &str = include_str!("sky_view_compute.wgsl");

/// Drawing from the sky view, after [`BASE`] and [`DIRECTIONS`] or [`SCATTER`]. Reads the sky view.
pub const SKY_VIEW: &str = include_str!("sky_view.wgsl");

/// Single scattering over flat ground, after [`BASE`] and [`SCATTER`].
pub const PLANAR: &str = include_str!("planar.wgsl");
