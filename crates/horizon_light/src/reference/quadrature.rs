//! Integrals whose error is known: Gauss and Kronrod's nested rules, halved where they disagree.

use crate::reference::accumulate;

/// Nodes in [0, 1] of Kronrod's 15-point rule on [−1, 1], their weights, and those of Gauss's 7-point rule inside it
/// (QUADPACK, Piessens et al. 1983, `qk15`).
const NODES: [(f64, f64, f64); 8] = [
    (0.991_455_371_120_812_6, 0.022_935_322_010_529_224, 0.0),
    (0.949_107_912_342_758_5, 0.063_092_092_629_978_55, 0.129_484_966_168_869_7),
    (0.864_864_423_359_769_1, 0.104_790_010_322_250_18, 0.0),
    (0.741_531_185_599_394_5, 0.140_653_259_715_525_92, 0.279_705_391_489_276_64),
    (0.586_087_235_467_691_1, 0.169_004_726_639_267_9, 0.0),
    (0.405_845_151_377_397_2, 0.190_350_578_064_785_42, 0.381_830_050_505_118_9),
    (0.207_784_955_007_898_47, 0.204_432_940_075_298_9, 0.0),
    (0.0, 0.209_482_141_084_727_82, 0.417_959_183_673_469_4),
];

/// Halvings after which an interval is taken as it is: 2⁻⁴⁰ of a path is below a millimetre.
const DEPTH: u32 = 40;

/// The integrals of `N` functions over the intervals between sorted `ends`, each to `relative` of the sum of the
/// magnitudes that a first pass over all intervals finds. Ends belong where the functions have kinks.
pub fn integrate<const N: usize>(mut functions: impl FnMut(f64) -> [f64; N], ends: &[f64], relative: f64) -> [f64; N] {
    let mut total = [0.0; N];
    let mut pending: Vec<(f64, f64, u32, Rule<N>)> = ends
        .windows(2)
        .filter(|pair| pair[1] > pair[0])
        .map(|pair| (pair[0], pair[1], 0, rule(&mut functions, pair[0], pair[1])))
        .collect();
    let mut tolerance = [0.0; N];
    for (_, _, _, first) in &pending {
        accumulate(&mut tolerance, |k| relative * first.sum[k].abs());
    }
    while let Some((start, end, depth, found)) = pending.pop() {
        if depth == DEPTH || (0..N).all(|k| found.error[k] <= tolerance[k]) {
            accumulate(&mut total, |k| found.sum[k]);
        } else {
            let middle = 0.5 * (start + end);
            pending.push((start, middle, depth + 1, rule(&mut functions, start, middle)));
            pending.push((middle, end, depth + 1, rule(&mut functions, middle, end)));
        }
    }
    total
}

struct Rule<const N: usize> {
    sum: [f64; N],
    /// The difference of both rules, which is far above the finer one's error.
    error: [f64; N],
}

fn rule<const N: usize>(functions: &mut impl FnMut(f64) -> [f64; N], start: f64, end: f64) -> Rule<N> {
    let (centre, half) = (0.5 * (start + end), 0.5 * (end - start));
    let (mut fine, mut coarse) = ([0.0; N], [0.0; N]);
    let mut add = |x: f64, weight: f64, gauss: f64| {
        let values = functions(centre + half * x);
        for k in 0..N {
            fine[k] += half * weight * values[k];
            coarse[k] += half * gauss * values[k];
        }
    };
    for (x, weight, gauss) in NODES {
        add(x, weight, gauss);
        if x > 0.0 {
            add(-x, weight, gauss);
        }
    }
    Rule { sum: fine, error: core::array::from_fn(|k| (fine[k] - coarse[k]).abs()) }
}

/// Nodes and weights of Gauss's rule with `n` points on [−1, 1], the nodes rising: roots of the Legendre polynomial by
/// Newton's method.
pub fn gauss_legendre(n: usize) -> Vec<(f64, f64)> {
    let mut rule: Vec<_> = (0..n)
        .map(|i| {
            let mut x = (core::f64::consts::PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
            let mut slope = 1.0;
            for _ in 0..100 {
                let (mut before, mut value) = (0.0, 1.0);
                for k in 1..=n {
                    let k = k as f64;
                    (before, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k);
                }
                slope = n as f64 * (x * value - before) / (x * x - 1.0);
                let step = value / slope;
                x -= step;
                if step.abs() < 1e-15 {
                    break;
                }
            }
            (x, 2.0 / ((1.0 - x * x) * slope * slope))
        })
        .collect();
    rule.reverse();
    rule
}
