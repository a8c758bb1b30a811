use super::*;
use crate::field::arbitrary::Random;

#[test]
fn probe() {
    let seas = [
        ("sines", Waves::Sines(Sines::default())),
        ("gerstner .7", Waves::Gerstner(Gerstner::default())),
        ("gerstner .9", Waves::Gerstner(Gerstner { steepness: 0.9, ..Gerstner::default() })),
        ("gerstner 1", Waves::Gerstner(Gerstner { steepness: 1.0, ..Gerstner::default() })),
        ("gerstner 1 one", Waves::Gerstner(Gerstner { steepness: 1.0, count: 1, ..Gerstner::default() })),
        ("fbm", Waves::Fbm(FbmWaves::default())),
        ("lake", Waves::lake()),
        ("breeze", Waves::breeze()),
        ("gale", Waves::gale()),
        ("young", Waves::Spectrum(Spectrum { fetch: 100.0, wind: 20.0, ..Spectrum::default() })),
    ];
    for (name, waves) in seas {
        let start = std::time::Instant::now();
        let sea = Sea::new(&waves).unwrap();
        let made = start.elapsed();
        let start = std::time::Instant::now();
        let tiles = sea.tiles(1234.5);
        let filled = start.elapsed();
        println!("{name}: {made:?} {filled:?} rest {} bound {}", sea.rest, sea.bound());
        for (cascade, tile) in sea.cascades.iter().zip(&tiles.tiles) {
            let one = Sea { cascades: vec![cascade.clone()], rest: 0.0 };
            let one_tiles = Tiles { tiles: vec![tile.clone()] };
            let sigma = cascade.height_variance().sqrt();
            let mut random = Random::new(5);
            let (mut texels, mut worst, mut between, mut slopes, mut least, mut folds) =
                (0.0, 0.0f64, 0.0, 0.0, 1.0f64, 0);
            let count = 300;
            for _ in 0..count {
                let [i, j] = [0, 1].map(|_| random.bits() as usize % GRID);
                let at = [i, j].map(|i| (i as f64 + 0.5) * cascade.texel());
                let exact = one.exact(at, 1234.5);
                least = least.min(exact.determinant);
                if exact.determinant < 0.0 {
                    folds += 1;
                    continue;
                }
                let [h, sx, sz, _] = tile.surface[0][j * GRID + i].map(f64::from);
                texels += (h - exact.height).powi(2);
                worst = worst.max((h - exact.height).abs());
                slopes += (sx - exact.slope[0]).powi(2) + (sz - exact.slope[1]).powi(2);
                let at = at.map(|x| x + random.within(0.0, cascade.texel()));
                between += (one_tiles.height(at) - one.height_exact(at, 1234.5)).powi(2);
            }
            let rms = |sum: f64| (sum / count as f64).sqrt();
            println!(
                "  L {:.2} waves {} σ {sigma:.4} slope {:.4} | texel rms {:.5} worst {:.5} between {:.5} of σ; slope rms {:.4} of; least det {least:.3} folds {folds}",
                cascade.side,
                cascade.waves.len(),
                cascade.slope_variance().sqrt(),
                rms(texels) / sigma,
                worst / sigma,
                rms(between) / sigma,
                rms(slopes) / cascade.slope_variance().sqrt()
            );
        }
    }
}
