//! How fine texels must be for a patch to be as smooth as what it stands for.

use horizon_field::{Compiled, Place};

use super::clipmap::{COARSEST, FINEST};

/// How far a bilinear patch may bow from the field, in metres, at 49 places of 50: what stands on the ground at the height that a
/// query answers shall neither float nor sink.
const BOW: f64 = 0.005;
/// The most halvings below an eighth of the finest wave: cliffs bow at any size.
const HALVINGS: u32 = 5;
/// Places at which the bow is measured.
const PLACES: u32 = 256;

/// log2 of the texel, in metres, below which nothing of the field is gained. An eighth of the finest wave is fine enough for a fractal,
/// whose finest waves are low; a swell of one wave bows by a thirteenth of its amplitude over that.
pub fn grain(field: &Compiled<2>) -> i32 {
    let limits = (f64::from(FINEST), f64::from(COARSEST));
    let mut exponent = (field.finest_wavelength() / 8.0).log2().floor().clamp(limits.0, limits.1) as i32;
    for _ in 0..HALVINGS {
        if exponent <= FINEST || bow(field, f64::from(exponent).exp2()) <= BOW {
            break;
        }
        exponent -= 1;
    }
    exponent
}

/// The bow of patches of this size at 49 places of 50, in metres.
fn bow(field: &Compiled<2>, texel: f64) -> f64 {
    let anchors = field.anchor(&Place::ORIGIN);
    // A lattice of irrational steps (Roberts 2018) meets no period of the field's.
    let places =
        (0..PLACES).map(|i| [0.754_877_666_246_693, 0.569_840_290_998_053].map(|step| f64::from(i) * step * 997.0));
    let points: Vec<[f64; 2]> = places
        .flat_map(|[x, z]| {
            [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0], [0.5, 0.5]].map(|[a, b]| [x + a * texel, z + b * texel])
        })
        .collect();
    let mut heights = vec![0.0; points.len()];
    field.values_f64(&anchors, &points, 0.0, &mut heights);
    let bows = heights.chunks_exact(5).map(|h| (h[4] - 0.25 * (h[0] + h[1] + h[2] + h[3])).abs());
    let mut bows: Vec<f64> = bows.collect();
    bows.sort_unstable_by(f64::total_cmp);
    bows[bows.len() * 49 / 50]
}

#[cfg(test)]
mod tests {
    use super::*;
    use horizon_field::field::{Field, Fractal, NoImages, Noise};

    fn compiled(field: Field) -> Compiled<2> {
        field.compile(&NoImages).expect("the field is good")
    }

    #[test]
    fn a_swell_takes_finer_texels_than_an_eighth_of_its_wave() {
        let field = compiled(Field::Noise(Noise { wavelength: 80.0, amplitude: 16.0, ..Noise::default() }));
        let naive = bow(&field, 8.0);
        let ours = bow(&field, f64::from(grain(&field)).exp2());
        assert!(naive > 0.1 && ours <= BOW, "{naive} and {ours}");
    }

    #[test]
    fn a_fractal_hardly_does() {
        let field = Fractal { wavelength: 6000.0, amplitude: 1500.0, octaves: 13.0, gain: 0.47, ..Fractal::default() };
        let field = compiled(Field::Fractal(field));
        let eighth = (field.finest_wavelength() / 8.0).log2().floor() as i32;
        assert!((eighth - 1..=eighth).contains(&grain(&field)), "{} against {eighth}", grain(&field));
    }

    #[test]
    fn a_plane_takes_the_coarsest() {
        assert_eq!(grain(&compiled(Field::Constant(3.0))), COARSEST);
    }
}
