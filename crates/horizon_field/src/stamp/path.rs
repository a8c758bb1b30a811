//! Paths: a smooth curve through points, cut into straight parts.

/// A straight part, from one point to another.
pub(super) type Straight = [[f64; 3]; 2];

/// The most parts between two points.
const MOST: f64 = 64.0;

fn combine(terms: &[(f64, [f64; 3])]) -> [f64; 3] {
    [0, 1, 2].map(|axis| terms.iter().map(|(by, p)| by * p[axis]).sum())
}

fn in_plan(a: [f64; 3], b: [f64; 3]) -> f64 {
    let (x, z) = (b[0] - a[0], b[2] - a[2]);
    (x * x + z * z).sqrt()
}

/// Slopes of the curve at its points, per metre in plan: those of the parabola through a point and its neighbours; at
/// the ends the curve is straight.
fn tangents(points: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let chord = |i: usize| in_plan(points[i], points[i + 1]);
    let slope = |i: usize| combine(&[(1.0 / chord(i), points[i + 1]), (-1.0 / chord(i), points[i])]);
    let last = points.len() - 1;
    let inner = |i: usize| {
        let (before, after) = (chord(i - 1), chord(i));
        let whole = before + after;
        combine(&[(after / whole, slope(i - 1)), (before / whole, slope(i))])
    };
    let end = |chord: [f64; 3], next: Option<[f64; 3]>| next.map_or(chord, |m| combine(&[(1.5, chord), (-0.5, m)]));
    (0..=last)
        .map(|i| match i {
            0 => end(slope(0), (last > 1).then(|| inner(1))),
            i if i == last => end(slope(last - 1), (last > 1).then(|| inner(last - 1))),
            i => inner(i),
        })
        .collect()
}

/// The curve through points, as straight parts that are nowhere farther than `tolerance` metres from it. Successive
/// points differ in plan.
pub(super) fn straights(points: &[[f64; 3]], tolerance: f64) -> Vec<Straight> {
    let tangents = tangents(points);
    let mut parts = Vec::new();
    let mut from = points[0];
    for (i, pair) in points.windows(2).enumerate() {
        let (p, q) = (pair[0], pair[1]);
        let chord = in_plan(p, q);
        let (m, n) = (tangents[i].map(|m| m * chord), tangents[i + 1].map(|n| n * chord));
        // The second derivative of a cubic is linear: largest at an end.
        let bends = [
            combine(&[(6.0, q), (-6.0, p), (-4.0, m), (-2.0, n)]),
            combine(&[(-6.0, q), (6.0, p), (2.0, m), (4.0, n)]),
        ];
        let bend = bends.map(|b| b.iter().map(|x| x * x).sum::<f64>()).into_iter().fold(0.0, f64::max).sqrt();
        let count = (bend / (8.0 * tolerance)).sqrt().ceil().clamp(1.0, MOST);
        for k in 1..=count as usize {
            let t = k as f64 / count;
            let (t2, t3) = (t * t, t * t * t);
            let curve =
                [(2.0 * t3 - 3.0 * t2 + 1.0, p), (t3 - 2.0 * t2 + t, m), (3.0 * t2 - 2.0 * t3, q), (t3 - t2, n)];
            let to = if t == 1.0 { q } else { combine(&curve) };
            // A part without a length has no direction: the next one begins where it does.
            if in_plan(from, to) > 1e-6 {
                parts.push([from, to]);
                from = to;
            }
        }
    }
    parts
}
