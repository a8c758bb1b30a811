//! The nodes' parameters: meaning, unit, range and default, once each.
//!
//! Lengths are metres and angles radians. A number outside its range is refused by [`Field::check`](super::Field::check).

#[cfg(feature = "reflect")]
use bevy_reflect::std_traits::ReflectDefault;
use serde::{Deserialize, Serialize};

use super::child::Child;
use super::param::{Numbers, Param, Params, node};
use super::{Edge, Field};
use crate::fractal::Rule;
use crate::noise::Basis;

/// The parameter of [`Field::Constant`].
pub const HEIGHT: Param = Param { min: -1e6, max: 1e6, unit: "m", help: "The height." };

node! {
    /// A height image, laid on the plane and smoothed by a cubic B-spline, which is C² and stays within the texels'
    /// heights. In space it stands upright: the same at every y.
    ImageField {
        path: String = String::new(), "Where the image source finds the image: 8 or 16 bit grey PNG.";
        centre: [f64; 2] = [0.0; 2], "The image's centre, as x and z.", in -1e9 .. 1e9 "m";
        size: [f64; 2] = [4096.0; 2], "The image's extent along x and z.", in 1e-3 .. 1e9 "m";
        low: f64 = 0.0, "The height of black.", in -1e6 .. 1e6 "m";
        high: f64 = 500.0, "The height of white.", in -1e6 .. 1e6 "m";
        edge: Edge = Edge::Clamp, "What lies beyond the image's edge.";
    }
}

node! {
    /// One octave of noise.
    Noise {
        basis: Basis = Basis::Gradient, "The kind of noise.";
        wavelength: f64 = 1000.0, "The lattice's period.", in 1e-3 .. 1e8 "m";
        amplitude: f64 = 100.0, "The height of noise 1.", in -1e6 .. 1e6 "m";
        rotation: f64 = 0.0, "The lattice's rotation: in the plane about y, in space about (1, 1, 1).", in -1e3 .. 1e3 "rad";
        seed: u32 = 0, "The seed.", in 0.0 .. 4294967295.0 "";
    }
}

node! {
    /// A sum of octaves: fBm, or one of Musgrave's multifractals.
    Fractal {
        rule: Rule = Rule::Fbm, "How octaves combine.";
        basis: Basis = Basis::Gradient, "The kind of noise.";
        wavelength: f64 = 4000.0, "The first octave's wavelength.", in 1e-3 .. 1e8 "m";
        amplitude: f64 = 600.0, "The height that the rule's 1 stands for.", in -1e6 .. 1e6 "m";
        octaves: f64 = 12.0, "How many octaves; the last one counts by the fraction.", in 0.0 .. 24.0 "";
        lacunarity: f64 = 2.0, "The frequency of an octave, as a multiple of the one before it.", in 1.01 .. 16.0 "";
        gain: f64 = 0.5, "The amplitude of an octave, as a multiple of the one before it.", in 1e-3 .. 0.999 "";
        offset: f64 = 1.0, "Musgrave's offset: what a multifractal adds to its noise. fBm has none.", in 0.0 .. 16.0 "";
        rotation: f64 = 0.6, "The rotation of an octave against the one before it, which hides the lattice.", in -1e3 .. 1e3 "rad";
        seed: u32 = 0, "The seed; octaves have different ones.", in 0.0 .. 4294967295.0 "";
    }
}

node! {
    /// Domain warping: the field, asked at a displaced point.
    Warp {
        field: Child = Field::default().into(), "The field that is asked.";
        x: Child = Field::from(Noise::default()).into(), "The displacement along x, in metres.";
        z: Child = Field::from(Noise { seed: 1, ..Noise::default() }).into(), "The displacement along z, in metres.";
        y: Option<Child> = None, "The displacement along y, in metres; the plane has no y and ignores it.";
    }
}

node! {
    /// The dual height map of seed 000, eq. 3.2: a local field, scaled by how high a global one is:
    /// `g + clamp((g − low) / (high − low), 0, 1) · l`.
    Dual {
        local: Child = Field::from(Fractal { seed: 1, ..Fractal::default() }).into(), "The local field l.";
        global: Child = Field::default().into(), "The global field g.";
        low: f64 = 0.0, "Where the global field is this low, the local one is absent.", in -1e6 .. 1e6 "m";
        high: f64 = 500.0, "Where the global field is this high, the local one is whole.", in -1e6 .. 1e6 "m";
    }
}

node! {
    /// A field of the plane, laid on space by three projections, along the axes. They are weighted by |n|ᵏ, where n is the
    /// direction from the world's origin: for planets about it. In the plane it is the field itself.
    Triplanar {
        field: Child = Field::default().into(), "The field of the plane.";
        sharpness: u32 = 4, "The exponent k.", in 1.0 .. 16.0 "";
    }
}

node! {
    /// The smaller of two fields, rounded where they meet; never above either.
    SmoothMin {
        a: Child = Field::default().into(), "One field.";
        b: Child = Field::Constant(100.0).into(), "The other field.";
        radius: f64 = 10.0, "The difference below which the two are blended; the rounding is a quarter of it deep.", in 1e-3 .. 1e6 "m";
    }
}

node! {
    /// A field, limited to a range.
    Clamp {
        field: Child = Field::default().into(), "The field.";
        low: f64 = 0.0, "The lower limit.", in -1e6 .. 1e6 "m";
        high: f64 = 1000.0, "The upper limit.", in -1e6 .. 1e6 "m";
    }
}

node! {
    /// A linear map of heights, which also goes on outside both ranges.
    Remap {
        field: Child = Field::default().into(), "The field.";
        from: [f64; 2] = [0.0, 1.0], "Two heights of the field.", in -1e6 .. 1e6 "m";
        to: [f64; 2] = [0.0, 1.0], "What the two become.", in -1e6 .. 1e6 "m";
    }
}

node! {
    /// Terraces: within each step a height is drawn towards the middle of the step, with a continuous slope.
    Terrace {
        field: Child = Field::default().into(), "The field.";
        step: f64 = 50.0, "The height of a terrace.", in 1e-3 .. 1e6 "m";
        sharpness: f64 = 0.8, "0 leaves the field as it is; at 1 the terraces' treads are level.", in 0.0 .. 1.0 "";
    }
}

node! {
    /// A blend of two fields by a third one: `outside` where the mask is low, `inside` where it is high, smoothstep between.
    Mask {
        mask: Child = Field::default().into(), "The mask.";
        low: f64 = 0.0, "At this height of the mask and below there is only `outside`.", in -1e6 .. 1e6 "m";
        high: f64 = 100.0, "At this height of the mask and above there is only `inside`.", in -1e6 .. 1e6 "m";
        outside: Child = Field::default().into(), "The field where the mask is low.";
        inside: Child = Field::Constant(100.0).into(), "The field where the mask is high.";
    }
}
