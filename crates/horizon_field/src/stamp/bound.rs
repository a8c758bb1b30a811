//! What is proven of stamped ground over a box. Notation: the box is `centre` ± `half`, R its half diagonal; d the distance
//! from a part's core, L that less the radius.
//!
//! A weight is w(L) = S(1 − L / f), with S the smoothstep of the fifth degree and f the falloff. |S'| is at most 15/8 and
//! |S''| at most 10/√3; d is 1-Lipschitz and its curvature is at most 1/d ≤ 1/L. Across, w bends by |w'|/L ≤
//! 30 t (1 − t)² / f² ≤ 40/9/f², less than along, so that 10/√3/f² bounds its curvature everywhere: where the part is whole
//! and where it is gone as well.

use super::part::{Part, smooth};
use crate::field::Bound;
use crate::field::model::Model;
use crate::fractal::Algebra;
use crate::real::Jet;

/// Of the quintic smoothstep: the largest slope, and the largest curvature.
const STEEPEST: f64 = 1.875;
const CURVATURE: f64 = 5.773_503;

/// Of a value, for the evaluation's rounding.
const RELATIVE: f64 = 1e-12;

/// A slope that no ground has: more than the heights and falloffs that are allowed can make.
const STEEPER: f64 = 1e30;

/// The sum of |g| times the box' extents.
fn along(g: [f64; 2], half: [f64; 2]) -> f64 {
    g[0].abs() * half[0] + g[1].abs() * half[1]
}

/// The products of two intervals of finite ends.
fn product(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    let all = [a[0] * b[0], a[0] * b[1], a[1] * b[0], a[1] * b[1]];
    all.into_iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
}

fn sum(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] + b[0], a[1] + b[1]]
}

fn hull(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0].min(b[0]), a[1].max(b[1])]
}

/// What is proven of a part's weight; `None` where it does not reach into the box.
fn weight(part: &Part<f64>, centre: [f64; 2], half: [f64; 2]) -> Option<Model<2>> {
    let radius = (half[0] * half[0] + half[1] * half[1]).sqrt();
    let per = part.per_falloff;
    // How far rounding may move a point against the part, in metres.
    let misplaced = 1e-15 * [centre, half, part.centre].iter().flatten().map(|x| x.abs()).sum::<f64>();
    let (_, beyond) = part.beyond(centre);
    let over = beyond.map(|x| x.max(0.0));
    let distance = (over[0] * over[0] + over[1] * over[1]).sqrt() + beyond[0].max(beyond[1]).min(0.0) - part.radius;
    let share = |distance: f64| smooth((1.0 - distance.max(0.0) * per).max(0.0));
    let reach = radius + misplaced;
    if (distance - reach) * per >= 1.0 {
        return None;
    }
    let pad = RELATIVE + STEEPEST * per * misplaced;
    let (low, high) = (share(distance + reach) - pad, share(distance - reach) + pad);
    let jet = part.weight(centre);
    let steepest = STEEPEST * per * (1.0 + RELATIVE);
    let turn = CURVATURE * per * (per * reach) + RELATIVE * per;
    let slope = jet.g.map(|g| [(g - turn).max(-steepest), (g + turn).min(steepest)]);
    let curved = Bound { v: jet.v, g: jet.g, rest: 0.5 * turn * radius + pad, low, high, slope };
    let straight = Bound { g: [0.0; 2], rest: steepest * radius + pad, ..curved };
    let tighter = if curved.rest <= straight.rest { curved } else { straight };
    let tighter = if distance + reach <= 0.0 { Bound { rest: pad, slope: [[0.0; 2]; 2], ..curved } } else { tighter };
    Some(Model::new(tighter, half))
}

/// The larger of two weights: b + max(a − b, 0).
fn larger(a: Model<2>, b: Model<2>) -> Model<2> {
    if a.bound.low >= b.bound.high {
        return a;
    }
    if b.bound.low >= a.bound.high {
        return b;
    }
    let mut most = b.plus(a.plus(b.scaled(-1.0)).at_least(0.0));
    most.bound.slope = [0, 1].map(|k| hull(a.bound.slope[k], b.bound.slope[k]));
    most.within(a.bound.low.max(b.bound.low), a.bound.high.max(b.bound.high))
}

/// The parts of one stamp that reach into a box: their weights, and their planes at its centre.
type Group = [(Model<2>, Jet<f64, 2>)];

/// By how far Y, the mean of a stamp's planes, is off the first one: what is proven of it, and of its slope times the
/// stamp's weight.
fn unevenness(group: &Group, whole: &Bound<2>, half: [f64; 2]) -> (Bound<2>, [[f64; 2]; 2]) {
    let first = group[0].1;
    let off = |plane: &Jet<f64, 2>| Jet { v: plane.v - first.v, g: [0, 1].map(|k| plane.g[k] - first.g[k]) };
    let apart = |plane: &Jet<f64, 2>| off(plane).v.abs() + along(off(plane).g, half);
    let farthest = group.iter().map(|(_, plane)| apart(plane)).fold(0.0, f64::max);
    if farthest == 0.0 {
        let even = Bound { v: 0.0, g: [0.0; 2], rest: 0.0, low: 0.0, high: 0.0, slope: [[0.0; 2]; 2] };
        return (even, even.slope);
    }
    let pad = RELATIVE * farthest;
    let reach = farthest + pad;
    // W ∇(S₁/S₀) = W/S₀ Σ (∇wᵢ (yᵢ − Y) + wᵢ ∇yᵢ), where W ≤ S₀ = Σ wᵢ.
    let turns = [0, 1].map(|k| {
        let steepest = |slope: [f64; 2]| slope[0].abs().max(slope[1].abs());
        let turn: f64 = group.iter().map(|(w, _)| steepest(w.bound.slope[k])).sum();
        let tilt = group.iter().map(|(_, plane)| off(plane).g[k].abs()).fold(0.0, f64::max);
        let most = 2.0 * reach * turn + whole.high * tilt + RELATIVE * (reach + tilt);
        [-most, most]
    });
    let anything = Bound { v: 0.0, g: [0.0; 2], rest: reach, low: -reach, high: reach, slope: [[0.0; 2]; 2] };
    let zero = Model::constant(0.0);
    let weights = group.iter().fold(zero, |sum, (w, _)| sum.plus(*w));
    let linear = weights.bound.v - along(weights.bound.g, half) - weights.bound.rest;
    if weights.bound.low.max(linear) < 1e-6 || weights.bound.low.min(weights.bound.v) <= 0.0 {
        return (anything, turns);
    }
    let moves = group.iter().fold(zero, |sum, (w, plane)| {
        let Jet { v, g } = off(plane);
        let spread = along(g, half);
        let plane = Bound { v, g, rest: 0.0, low: v - spread, high: v + spread, slope: g.map(|g| [g, g]) };
        sum.plus(Model::new(plane, half).times(*w))
    });
    let mean = moves.times(weights.reciprocal()).within(-reach, reach).bound;
    let share = [whole.low.max(0.0), whole.high];
    let slope = [0, 1].map(|k| {
        let own = product(share, mean.slope[k]);
        [own[0].max(turns[k][0]), own[1].min(turns[k][1])]
    });
    (mean, slope)
}

/// Ground, of which something is proven, with one stamp on it: h + W (Y − k h), where k is 1 if it levels, and else 0.
fn with_stamp(h: Bound<2>, group: &Group, k: f64, half: [f64; 2]) -> Bound<2> {
    let whole = group[1..].iter().fold(group[0].0, |all, (w, _)| larger(all, *w)).bound;
    let (mean, mean_slope) = unevenness(group, &whole, half);
    let first = group[0].1;
    let spread = along(first.g, half);
    let y = [first.v - spread + mean.low, first.v + spread + mean.high];
    let largest = [h.low, h.high, y[0], y[1], h.v].into_iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let pad = 1e-14 * largest;

    // (1 − kW) h + W Y, with h = H + e, Y = Z + ε, W = w + ω: H + (w + ω)(Z − kH) + (1 − kW) e + W ε.
    let by = Jet { v: first.v + mean.v - k * h.v, g: [0, 1].map(|i| first.g[i] + mean.g[i] - k * h.g[i]) };
    let wobble = (along(whole.g, half) + whole.rest).min((whole.high - whole.v).max(whole.v - whole.low));
    let shares = [whole.low, whole.high];
    let left = shares.map(|w| 1.0 - k * w);
    let rest = by.v.abs() * whole.rest
        + wobble * along(by.g, half)
        + whole.high.abs() * mean.rest
        + left[0].abs().max(left[1].abs()) * h.rest;
    // The height is linear in W: its ends decide.
    let ends = [0, 1].map(|i| sum(product([left[i]; 2], [h.low, h.high]), product([shares[i]; 2], y)));
    let [low, high] = hull(ends[0], ends[1]);
    let off = [y[0] - k * h.high - pad, y[1] - k * h.low + pad];
    let slope = [0, 1].map(|i| {
        let end = |j: usize| sum(product([left[j]; 2], h.slope[i]), product([shares[j]; 2], [first.g[i]; 2]));
        let [low, high] = sum(sum(hull(end(0), end(1)), product(whole.slope[i], off)), mean_slope[i]);
        let pad = RELATIVE * (low.abs() + high.abs() + 1.0);
        [low - pad, high + pad]
    });
    let bound = Bound {
        v: h.v + whole.v * by.v,
        g: [0, 1].map(|i| h.g[i] + whole.v * by.g[i] + by.v * whole.g[i]),
        rest: rest + pad,
        low: low - pad,
        high: high + pad,
        slope,
    };
    Model::new(bound, half).bound
}

/// What is proven of ground with parts on it, in their order.
pub(super) fn stamped(
    parts: impl Iterator<Item = Part<f64>>,
    centre: [f64; 2],
    half: [f64; 2],
    mut ground: Bound<2>,
) -> Bound<2> {
    let mut group = Vec::new();
    for part in parts {
        group.extend(weight(&part, centre, half).map(|w| (w, part.plane(centre))));
        if part.last && !group.is_empty() {
            ground = with_stamp(ground, &group, part.levels, half);
            group.clear();
        }
    }
    ground
}

/// The same ground, parts of which are only known to lie somewhere between two heights.
pub(super) fn anywhere(ground: Bound<2>, (low, high): (f64, f64)) -> Bound<2> {
    let (low, high) = (low.min(ground.low), high.max(ground.high));
    let slope = [[-STEEPER, STEEPER]; 2];
    Bound { v: 0.5 * (low + high), g: [0.0; 2], rest: 0.5 * (high - low), low, high, slope }
}
