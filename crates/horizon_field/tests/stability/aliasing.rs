//! Section 5: octaves finer than a pixel.

use horizon_field::field::arbitrary::RULES;
use horizon_field::field::{Anchors, Fractal, NoImages};
use horizon_field::fractal::Rule;
use horizon_field::{Compiled, Field, Jet, Place};

use super::statistics::{correlation, largest, rms};

/// Hills of 1 km with detail down to 3 cm.
const OCTAVES: u8 = 16;

fn hills(rule: Rule, octaves: u8) -> (Compiled<2>, Anchors<2>) {
    let octaves = f64::from(octaves);
    let fractal = Fractal { rule, wavelength: 1000.0, amplitude: 100.0, octaves, seed: 3, ..Fractal::default() };
    let hills = Field::from(fractal).compile::<2>(&NoImages).unwrap();
    let at = hills.anchor(&Place::from_metres([1e6, 0.0, -3e5]));
    (hills, at)
}

/// Pixels of this width on the ground, in metres: as seen from a few kilometres.
const PIXEL: f64 = 10.0;
/// Pixels along each side of a picture.
const SIDE: i32 = 40;

/// The jets at the middles of a picture's pixels, of a camera that moved by `shift`.
fn picture((hills, at): &(Compiled<2>, Anchors<2>), cutoff: f64, shift: f64) -> Vec<Jet<f64, 2>> {
    let pixels = (0..SIDE).flat_map(|j| (0..SIDE).map(move |i| [f64::from(i) * PIXEL + shift, f64::from(j) * PIXEL]));
    pixels.map(|q| hills.jet_f64(at, q, cutoff)).collect()
}

/// What the pixels should show: the mean over each, of 16 by 16 samples.
fn means((hills, at): &(Compiled<2>, Anchors<2>)) -> Vec<Jet<f64, 2>> {
    const EACH: i32 = 16;
    let offset = |i: i32| (f64::from(i) + 0.5) / f64::from(EACH) - 0.5;
    let mean = |i: i32, j: i32| {
        let mut mean = Jet::constant(0.0);
        for (a, b) in (0..EACH).flat_map(|b| (0..EACH).map(move |a| (a, b))) {
            let q = [(f64::from(i) + offset(a)) * PIXEL, (f64::from(j) + offset(b)) * PIXEL];
            let jet = hills.jet_f64(at, q, 0.0);
            mean.v += jet.v / 256.0;
            (mean.g[0], mean.g[1]) = (mean.g[0] + jet.g[0] / 256.0, mean.g[1] + jet.g[1] / 256.0);
        }
        mean
    };
    (0..SIDE).flat_map(|j| (0..SIDE).map(move |i| (i, j))).map(|(i, j)| mean(i, j)).collect()
}

/// The root mean squares of the differences of two pictures: of heights, in metres, and of slopes.
fn apart(a: &[Jet<f64, 2>], b: &[Jet<f64, 2>]) -> [f64; 2] {
    let pairs = || a.iter().zip(b);
    [rms(pairs().map(|(a, b)| a.v - b.v)), rms(pairs().flat_map(|(a, b)| [a.g[0] - b.g[0], a.g[1] - b.g[1]]))]
}

#[test]
fn octaves_finer_than_a_pixel_alias() {
    let hills = hills(Rule::Fbm, OCTAVES);
    let truth = means(&hills);
    let [naive, ours] = [0.0, PIXEL].map(|cutoff| apart(&picture(&hills, cutoff, 0.0), &truth));
    println!("off the pixels' means, in metres and as slopes: all octaves {naive:.3?}, faded {ours:.3?}");
    // The energy of what is not there: its square.
    assert!(naive[1] > 3.0 * ours[1], "all octaves must alias: {naive:?}, {ours:?}");
    assert!(naive[0] > 1.2 * ours[0], "{naive:?}, {ours:?}");
    let whole = rms(truth.iter().flat_map(|jet| jet.g));
    assert!(naive[1] > whole && ours[1] < 0.5 * whole, "{naive:?} and {ours:?} of slopes of {whole}");
}

#[test]
fn octaves_finer_than_a_pixel_sparkle() {
    // A camera that moves by a quarter of a pixel sees nearly what it saw.
    let hills = hills(Rule::Fbm, OCTAVES);
    let moved = |cutoff: f64| {
        let [before, after] = [0.0, 0.25 * PIXEL].map(|shift| picture(&hills, cutoff, shift));
        let slopes = |picture: &[Jet<f64, 2>]| picture.iter().flat_map(|jet| jet.g).collect::<Vec<_>>();
        (apart(&before, &after)[1], correlation(&slopes(&before), &slopes(&after)))
    };
    let (naive, ours) = (moved(0.0), moved(PIXEL));
    println!("slopes change by (rms, and what is left in common): all octaves {naive:.3?}, faded {ours:.3?}");
    assert!(naive.0 > 4.0 * ours.0 && naive.1 < 0.5, "all octaves must sparkle: {naive:?}, {ours:?}");
    assert!(ours.1 > 0.9, "{ours:?}");
}

#[test]
fn a_cut_off_fades_and_does_not_pop() {
    // A camera that draws back, its pixels growing from 1 m to 60 m, by a thousandth a frame and by half of that: what
    // fades moves by half as much, what pops by as much as ever.
    for rule in RULES {
        let whole = hills(rule, OCTAVES);
        let cut: Vec<_> = (0..=OCTAVES).map(|octaves| hills(rule, octaves)).collect();
        let kept = |cutoff: f64| (0..OCTAVES).filter(|i| 1000.0 / f64::from(1u32 << i) > 2.0 * cutoff).count();
        let largest_step = |frame: f64, at: &dyn Fn(f64) -> Jet<f64, 2>| {
            let frames = (60.0f64.ln() / frame.ln()) as i32;
            let jets: Vec<_> = (0..frames).map(|i| at(frame.powi(i))).collect();
            let heights = largest(jets.windows(2).map(|pair| pair[1].v - pair[0].v));
            let slopes = largest(jets.windows(2).flat_map(|pair| [0, 1].map(|k| pair[1].g[k] - pair[0].g[k])));
            [heights, slopes]
        };
        let [mut naive, mut ours] = [[[0.0f64; 2]; 2]; 2];
        for q in [[0.0, 0.0], [123.4, 56.7], [-400.0, 77.0]] {
            for (k, frame) in [1.001, 1.0005].into_iter().enumerate() {
                let popping = |cutoff: f64| {
                    let (hills, at) = &cut[kept(cutoff)];
                    hills.jet_f64(at, q, 0.0)
                };
                let fading = |cutoff: f64| whole.0.jet_f64(&whole.1, q, cutoff);
                for (worst, steps) in
                    [(&mut naive[k], largest_step(frame, &popping)), (&mut ours[k], largest_step(frame, &fading))]
                {
                    *worst = [0, 1].map(|i| worst[i].max(steps[i]));
                }
            }
        }
        println!("{rule:?}: steps in metres and as slopes: cut {naive:.4?}, faded {ours:.4?}");
        for i in 0..2 {
            assert!(naive[1][i] > 0.95 * naive[0][i], "{rule:?}: what is cut must pop: {naive:?}");
            assert!(ours[0][i] < 0.02 * naive[0][i], "{rule:?}: {ours:?} of {naive:?}");
            assert!(ours[1][i] < 0.6 * ours[0][i], "{rule:?}: what fades has no step: {ours:?}");
        }
    }
}
