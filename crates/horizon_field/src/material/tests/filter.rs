//! What a texel holds is the mean of its ground: shares stay from afar, edges soften, and nothing shows steps.

use crate::field::arbitrary::{Pictures, Random};
use crate::field::{Compiled, Field, Fractal, NoImages, Noise};
use crate::material::arbitrary::all_rules;
use crate::material::compile::NOISE_VARIANCE;
use crate::material::{
    CompiledMaterial, GroundPoint, HeightRule, Look, MaterialLayer, NoiseLayer, NoiseRule, StrataRule, Surface,
    TerrainMaterial,
};
use crate::place::Place;

fn plane(height: Field) -> Compiled<2> {
    height.compile(&NoImages).unwrap()
}

fn single(layer: MaterialLayer) -> CompiledMaterial {
    TerrainMaterial { layers: vec![layer], ..TerrainMaterial::default() }.compile(&NoImages).unwrap()
}

/// The look at points of 100 km.
fn looks(material: &CompiledMaterial, height: &Compiled<2>, texel: f64, count: usize) -> Vec<Look<f64>> {
    let mut random = Random::new(5);
    let (anchors, places) = (height.anchor(&Place::ORIGIN), material.anchor(&Place::ORIGIN));
    let mut look = || {
        let q = [(); 2].map(|()| random.within(0.0, 1e5));
        material.look(&places, &GroundPoint { height, anchors: &anchors, q, texel })
    };
    (0..count).map(|_| look()).collect()
}

fn share(looks: &[Look<f64>]) -> f64 {
    looks.iter().map(|look| look.shares[1]).sum::<f64>() / looks.len() as f64
}

#[test]
fn the_variance_of_noise_is_as_stated() {
    let noise = plane(Field::from(Noise { wavelength: 10.0, amplitude: 1.0, seed: 3, ..Noise::default() }));
    let anchors = noise.anchor(&Place::ORIGIN);
    let mut random = Random::new(1);
    let count = 400_000;
    let squares = (0..count).map(|_| {
        let q = [(); 2].map(|()| random.within(0.0, 1e5));
        noise.value::<f64>(&anchors, q, 0.0).powi(2)
    });
    let variance = squares.sum::<f64>() / f64::from(count);
    println!("variance {variance:.5}");
    assert!((variance / NOISE_VARIANCE - 1.0).abs() < 0.02, "{variance}");
}

/// Patches where a noise is high. Octaves that a texel can't show are taken from the noise, which then no longer reaches
/// the threshold: patches vanish in the distance. Widened by what was lost, the threshold keeps their share.
#[test]
fn patches_keep_their_share_from_afar() {
    let noise = NoiseLayer { wavelength: 40.0, amplitude: 1.0, octaves: 5.0, seed: 4 };
    let rule = NoiseRule { noise: noise.clone(), low: 0.3, soft: 0.05, ..NoiseRule::default() };
    let material = single(MaterialLayer { noise: Some(rule.clone()), ..MaterialLayer::default() });
    let level = plane(Field::Constant(0.0));
    let at = |texel| share(&looks(&material, &level, texel, 20_000));
    let near = at(0.0);

    let naive = plane(noise.field());
    let anchors = naive.anchor(&Place::ORIGIN);
    let mut random = Random::new(6);
    let mut naive_at = |texel: f64| {
        let one = |q| f64::from(naive.value::<f64>(&anchors, q, 0.75 * texel) > rule.low);
        (0..20_000).map(|_| one([(); 2].map(|()| random.within(0.0, 1e5)))).sum::<f64>() / 20_000.0
    };
    let naive_near = naive_at(0.0);
    let mut worst = (1.0f64, 1.0f64);
    for texel in [1.0, 8.0, 16.0, 32.0, 128.0] {
        let (ours, naive) = (at(texel) / near, naive_at(texel) / naive_near);
        println!("texel {texel}: share {ours:.3} of {near:.3}, without widening {naive:.3} of {naive_near:.3}");
        worst = (worst.0.min(ours).min(1.0 / ours), worst.1.min(naive));
    }
    assert!((near - naive_near).abs() < 0.02, "{near} and {naive_near}");
    assert!(worst.0 > 0.8, "{worst:?}");
    assert!(worst.1 < 0.1, "the naive threshold must fail: {worst:?}");
}

/// A band of heights on a slope: a texel that spans it many times over shows the band's share of its heights. The product
/// of two softened steps shows a quarter of it at most, however narrow the band is.
#[test]
fn a_narrow_band_keeps_its_share_on_a_slope() {
    let slope = plane(Field::from(Fractal { wavelength: 1e6, amplitude: 4e5, octaves: 1.0, ..Fractal::default() }));
    let anchors = slope.anchor(&Place::ORIGIN);
    let jet = slope.jet::<f64>(&anchors, [2e5, 1e5], 0.0);
    let rule = HeightRule { low: jet.v, high: jet.v + 10.0, soft: 0.5, shift: 0.0, ..HeightRule::default() };
    let material = single(MaterialLayer { height: Some(rule), ..MaterialLayer::default() });
    let places = material.anchor(&Place::ORIGIN);
    let look =
        |x: f64, texel| material.look(&places, &GroundPoint { height: &slope, anchors: &anchors, q: [x, 1e5], texel });
    let total = |texel: f64| (-4000..4000).map(|i| look(2e5 + f64::from(i), texel).shares[1]).sum::<f64>();
    let (near, afar) = (total(0.0), total(2048.0));
    println!("slope {:.2?}: the band is {near:.1} m wide, and {afar:.1} m at 2 km a texel", jet.g);
    assert!(near > 5.0 && (afar / near - 1.0).abs() < 0.05, "{near} and {afar}");

    let step = |x: f64, half: f64| {
        let t = (0.5 * x / half + 0.5).clamp(0.0, 1.0);
        t * t * (3.0 - 2.0 * t)
    };
    let half = 0.5 * 2048.0 * jet.g[0].hypot(jet.g[1]);
    let height = |i: i32| f64::from(i) * jet.g[0];
    let naive: f64 = (-4000..4000).map(|i| step(height(i), half) * (1.0 - step(height(i) - 10.0, half))).sum();
    println!("by the product of two steps, {naive:.1} m");
    assert!(naive > 3.0 * near, "the naive band must fail");
}

#[test]
fn strata_end_in_their_mean() {
    let layer =
        MaterialLayer { strata: Some(StrataRule { shift: 0.0, ..StrataRule::default() }), ..MaterialLayer::default() };
    let material = single(layer);
    let hills =
        plane(Field::from(Fractal { wavelength: 3000.0, amplitude: 1500.0, octaves: 3.0, ..Fractal::default() }));
    let spread = |texel| {
        let looks = looks(&material, &hills, texel, 2000);
        let mean = share(&looks);
        (mean, (looks.iter().map(|look| (look.shares[1] - mean).powi(2)).sum::<f64>() / 2000.0).sqrt())
    };
    let (near, afar) = (spread(0.0), spread(1024.0));
    println!("strata: mean and deviation {near:.3?} near, {afar:.3?} afar");
    assert!((near.0 - 0.5).abs() < 0.05 && (afar.0 - 0.5).abs() < 0.02 && near.1 > 0.2 && afar.1 < 0.02);
}

#[test]
fn shares_are_whole() {
    let material = TerrainMaterial::default().compile(&NoImages).unwrap();
    let hills = plane(Field::from(Fractal { amplitude: 2500.0, ..Fractal::default() }));
    let mut seen = [0.0f64; 6];
    for texel in [0.0, 1.0, 100.0] {
        for look in looks(&material, &hills, texel, 2000) {
            let sum: f64 = look.shares.iter().sum();
            assert!(
                (sum - 1.0).abs() < 1e-12 && look.shares.iter().all(|share| (0.0..=1.0).contains(share)),
                "{look:?}"
            );
            assert!(look.albedo.iter().all(|x| (0.0..=1.0).contains(x)) && (0.089..=1.0).contains(&look.roughness));
            (0..6).for_each(|i| seen[i] = seen[i].max(look.shares[i]));
        }
    }
    assert!(seen.iter().all(|most| *most > 0.5), "every layer shows somewhere: {seen:?}");
}

/// Single precision, as the device computes, against double precision, at places far from the origin.
#[test]
fn single_precision_is_enough() {
    let hills = plane(Field::from(Fractal { wavelength: 9000.0, amplitude: 4000.0, seed: 8, ..Fractal::default() }));
    for (material, layers) in [(TerrainMaterial::default(), 6), (all_rules(), 7)] {
        let material = material.compile(&Pictures).unwrap();
        let mut random = Random::new(4);
        let (mut worst, mut seen) = (0.0f64, [0.0f64; 17]);
        for metres in [[0.0; 3], [1e6, 0.0, -1e6], [-1e9, 0.0, 1e9]] {
            let place = Place::from_metres(metres);
            let (anchors, places) = (hills.anchor(&place), material.anchor(&place));
            for texel in [0.25f32, 2.0, 32.0, 1024.0] {
                for _ in 0..512 {
                    let q = [(); 2].map(|()| random.within(0.0, 64.0 * f64::from(texel)) as f32);
                    let single = material.look(&places, &GroundPoint { height: &hills, anchors: &anchors, q, texel });
                    let (q, texel) = (q.map(f64::from), f64::from(texel));
                    let double = material.look(&places, &GroundPoint { height: &hills, anchors: &anchors, q, texel });
                    let apart = (0..3).map(|k| (f64::from(single.albedo[k]) - double.albedo[k]).abs());
                    worst = apart.fold(worst, f64::max).max((f64::from(single.roughness) - double.roughness).abs());
                    (0..17).for_each(|i| seen[i] = seen[i].max(double.shares[i]));
                }
            }
        }
        println!("f32 is {worst:.1e} off f64; the layers show up to {seen:.2?}");
        assert!(worst < 1e-3, "{worst}");
        assert!(seen[..layers].iter().all(|most| *most > 0.2), "every layer shows somewhere: {seen:?}");
    }
}

/// Thirty-two steps of roughness over a kilometre of smooth ground: rounded to the nearest, each is a line that shows.
/// Rounded by lot, a tile's mean is what it was.
#[test]
fn packing_shows_no_steps() {
    let mut worst = (0.0f32, 0.0f32);
    for i in 0..100 {
        let look = Look {
            albedo: [0.2, 0.4, 0.6],
            roughness: 0.1 + 0.0089 * i as f32,
            reflectance: 0.01 * i as f32,
            shares: [0.0; 17],
        };
        let texels = (0..4096u32).map(|i| look.packed([i % 64, i / 64]));
        let sums = texels.fold((0.0, 0.0), |sums, word| {
            let byte = word >> 24;
            assert_eq!(word & 0xff_ffff, (114) | (161 << 8) | (198 << 16), "albedo");
            (sums.0 + (byte >> 3) as f32 / 31.0, sums.1 + (byte & 7) as f32 / 7.0)
        });
        let off = (sums.0 / 4096.0 - look.roughness).abs().max((sums.1 / 4096.0 - look.reflectance).abs());
        let nearest = |x: f32, steps: f32| ((x * steps).round() / steps - x).abs();
        worst.0 = worst.0.max(off);
        worst.1 = worst.1.max(nearest(look.roughness, 31.0)).max(nearest(look.reflectance, 7.0));
    }
    println!("means are off by {:.4}; rounded to the nearest, by {:.4}", worst.0, worst.1);
    assert!(worst.0 < 0.006 && worst.1 > 0.05, "{worst:?}");
}

/// The five bits of roughness leave 0 to holes, whatever the roughness is.
#[test]
fn no_look_is_taken_for_a_hole() {
    let (mut least, mut naive) = (31, 31);
    for roughness in [-1.0, 0.0, 0.03, 0.089, 1.0, f32::NAN] {
        let look = Look { albedo: [0.0; 3], roughness, reflectance: 0.0, shares: [0.0; 17] };
        least = (0..4096u32).map(|i| look.packed([i % 64, i / 64]) >> 27).fold(least, u32::min);
        naive = naive.min((roughness * 31.0) as u32);
    }
    assert_eq!((least, naive), (1, 0));
}

#[test]
fn a_surface_of_one_colour_has_no_noise() {
    let plain = TerrainMaterial { base: Surface::default(), layers: Vec::new(), ..TerrainMaterial::default() };
    assert_eq!(plain.compile(&NoImages).unwrap().fields().count(), 0);
}
