//! The table: its range, its period, its slope and its mips.

use crate::field::arbitrary::Random;
use crate::trees::{Foliage, MIPS, TEXELS};

#[test]
fn the_table_is_as_wide_as_a_byte_and_repeats() {
    let table = Foliage::table();
    let finest = table.texels(0);
    assert_eq!(finest.len(), TEXELS.pow(3));
    assert_eq!((finest.iter().min(), finest.iter().max()), (Some(&0), Some(&255)));
    assert!((0.3..0.7).contains(&table.mean()), "{}", table.mean());
    let mut random = Random::new(1);
    for _ in 0..1000 {
        let u = [0; 3].map(|_| random.within(0.0, 1.0));
        let level = random.within(0.0, 6.0);
        let there = u.map(|u| u + f64::from(random.pick(&[-3, 0, 1, 7])));
        assert!((table.value(u, level) - table.value(there, level)).abs() < 1e-12);
        assert!((table.value(u.map(|u| u as f32), level as f32) - table.value(u, level) as f32).abs() < 1e-4);
    }
    // The seam is no different from any other place.
    let step = |x: f64| (table.value([x, 0.3, 0.6], 0.0) - table.value([x + 1.0 / 64.0, 0.3, 0.6], 0.0)).abs();
    let most = (0..63).map(|i| step((f64::from(i) + 0.5) / 64.0)).fold(0.0, f64::max);
    assert!(step(63.5 / 64.0) <= 1.5 * most);
}

#[test]
fn no_slope_is_steeper_than_its_bound_which_is_nearly_reached() {
    let table = Foliage::table();
    let mut random = Random::new(2);
    let mut nearest = 0.0f64;
    for _ in 0..400_000 {
        let u = [0; 3].map(|_| random.within(0.0, 1.0));
        let level = random.pick(&[0.0, 0.0, 0.5, 1.0, 2.7, 4.0, 6.0]);
        let by = [0; 3].map(|_| random.within(-1.0, 1.0));
        let length = by.iter().map(|x| x * x).sum::<f64>().sqrt();
        let there = core::array::from_fn(|k| u[k] + 1e-4 * by[k] / length);
        let slope = (table.value(u, level) - table.value(there, level)).abs() / 1e-4;
        let bound = table.slope(level as usize);
        assert!(slope <= bound * (1.0 + 1e-6), "{slope} of {bound} at level {level}");
        if level == 0.0 {
            nearest = nearest.max(slope / bound);
        }
    }
    println!(
        "slopes {:?} per period; {nearest} of the first was met",
        [0, 1, 2, 3, 4, 5, 6].map(|mip| table.slope(mip))
    );
    assert!(nearest > 0.6);
    // A bound of corners alone, as a table without texels between would have it, is broken.
    assert!((1..MIPS).all(|mip| table.slope(mip) <= table.slope(mip - 1)));
}

#[test]
fn mips_keep_the_mean() {
    let table = Foliage::table();
    for mip in 0..MIPS {
        let texels = table.texels(mip);
        let mean = texels.iter().map(|t| f64::from(*t)).sum::<f64>() / texels.len() as f64 / 255.0;
        assert!((mean - table.mean()).abs() < 0.005, "mip {mip}: {mean}");
    }
}
