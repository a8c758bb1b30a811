//! The models' parameters: meaning, unit, range and default, once each.
//!
//! A heading is where something goes to, from −z (north) towards +x (east).

#[cfg(feature = "reflect")]
use bevy_reflect::std_traits::ReflectDefault;
use serde::{Deserialize, Serialize};

use crate::field::param::{Numbers, Param, Params, node};

node! {
    /// A few sines, each shorter and lower than the one before it, as seed 003 has them for its larger waves.
    Sines {
        count: u32 = 8, "How many waves; each is 0.8 times as long as the one before it.", in 1.0 .. 20.0 "";
        wavelength: f64 = 24.0, "The longest wave's length.", in 0.05 .. 10000.0 "m";
        amplitude: f64 = 0.5, "The sum of all amplitudes: no crest is higher. Waves are as high as they are long.", in 0.0 .. 100.0 "m";
        heading: f64 = 0.8, "Where the wind blows to.", in -1e3 .. 1e3 "rad";
        spread: f64 = 0.7, "How far from the wind's heading a wave's may be.", in 0.0 .. 3.15 "rad";
        seed: u32 = 0, "The seed of headings and phases.", in 0.0 .. 4294967295.0 "";
    }
}

node! {
    /// Trochoidal waves (Gerstner 1802): as [`Sines`], but water also moves along, so that crests are sharp and troughs flat.
    Gerstner {
        count: u32 = 8, "How many waves; each is 0.8 times as long as the one before it.", in 1.0 .. 20.0 "";
        wavelength: f64 = 24.0, "The longest wave's length.", in 0.05 .. 10000.0 "m";
        amplitude: f64 = 0.5, "The sum of all amplitudes: no crest is higher. Waves are as high as they are long.", in 0.0 .. 100.0 "m";
        steepness: f64 = 0.7, "How near to a cusp crests come: 0 leaves sines, at 1 there is a cusp where all crests meet, and never a loop.", in 0.0 .. 1.0 "";
        heading: f64 = 0.8, "Where the wind blows to.", in -1e3 .. 1e3 "rad";
        spread: f64 = 0.7, "How far from the wind's heading a wave's may be.", in 0.0 .. 3.15 "rad";
        seed: u32 = 0, "The seed of headings and phases.", in 0.0 .. 4294967295.0 "";
    }
}

node! {
    /// Octaves of gradient noise that drift with the wind (seed 000 §3.4.4). They are no water waves: long and short ones are
    /// equally fast.
    FbmWaves {
        wavelength: f64 = 12.0, "The first octave's wavelength.", in 0.05 .. 10000.0 "m";
        amplitude: f64 = 0.3, "The height of the first octave's noise 1.", in 0.0 .. 50.0 "m";
        octaves: u32 = 5, "How many octaves; those too short for the tiles are left out.", in 1.0 .. 8.0 "";
        lacunarity: f64 = 2.0, "The frequency of an octave, as a multiple of the one before it.", in 1.25 .. 4.0 "";
        gain: f64 = 0.5, "The amplitude of an octave, as a multiple of the one before it.", in 1e-3 .. 0.999 "";
        heading: f64 = 0.8, "Where the wind blows to.", in -1e3 .. 1e3 "rad";
        speed: f64 = 2.0, "How fast the noise drifts, rounded to whole tiles a period.", in 0.0 .. 100.0 "m/s";
        seed: u32 = 0, "The seed.", in 0.0 .. 4294967295.0 "";
    }
}

node! {
    /// A wind sea: the JONSWAP spectrum (Hasselmann et al. 1973) with random amplitudes and phases (Tessendorf 2001).
    Spectrum {
        wind: f64 = 7.0, "The wind's speed, 10 m above the water. Without wind there are no waves.", in 0.0 .. 60.0 "m/s";
        fetch: f64 = 20000.0, "How far the wind has blown over water. Where the sea is fully developed, more of it changes nothing.", in 1.0 .. 1e9 "m";
        heading: f64 = 0.8, "Where the wind blows to.", in -1e3 .. 1e3 "rad";
        focus: f64 = 6.0, "The exponent s of the spreading cos²ˢ(θ/2) about the wind's heading: the larger, the longer the crests.", in 0.0 .. 100.0 "";
        choppiness: f64 = 1.0, "How far water moves along with the waves, as a multiple of how far it moves up: sharpens crests. 1 is physical.", in 0.0 .. 2.0 "";
        seed: u32 = 0, "The seed.", in 0.0 .. 4294967295.0 "";
    }
}
