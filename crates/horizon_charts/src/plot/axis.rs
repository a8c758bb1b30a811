//! Axes, linear and logarithmic, as one coordinate type: so that no chart is written once for each pair of them.

use core::ops::Range;

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};

/// How values are laid out along an axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scale {
    /// In proportion.
    #[default]
    Linear,
    /// By their logarithm. A value that has none lies at the axis's lower end.
    Log,
}

/// An axis.
#[derive(Clone, Debug)]
pub struct Axis {
    /// What it shows, with its unit.
    pub label: String,
    /// How.
    pub scale: Scale,
    /// What it reaches at least. Values decide where it has none; values outside lie at its ends.
    pub limits: Option<[f64; 2]>,
}

impl Axis {
    /// A linear axis that reaches as far as the values.
    pub fn linear(label: impl Into<String>) -> Self {
        Self { label: label.into(), scale: Scale::Linear, limits: None }
    }

    /// A logarithmic axis that reaches as far as the values.
    pub fn log(label: impl Into<String>) -> Self {
        Self { label: label.into(), scale: Scale::Log, limits: None }
    }

    /// The axis with these ends.
    pub fn from_to(self, low: f64, high: f64) -> Self {
        Self { limits: Some([low, high]), ..self }
    }

    /// The axis's extent over these values; `None` where none of them can be shown. With `room` it goes on a little past
    /// them, so that no mark touches the frame.
    pub(super) fn span(&self, values: impl IntoIterator<Item = f64>, room: bool) -> Option<Span> {
        let log = self.scale == Scale::Log;
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for value in values.into_iter().filter(|v| v.is_finite() && !(log && *v <= 0.0)) {
            (low, high) = (low.min(value), high.max(value));
        }
        if low > high {
            return None;
        }
        if let Some([least, most]) = self.limits {
            return Some(Span { low: least, high: most, log });
        }
        let scaled = Span { low, high, log };
        let [mut from, mut to] = [low, high].map(|v| scaled.level(v));
        let share = if room { 0.05 } else { 0.0 };
        // One value alone has an axis about it.
        let pad = if to > from { share * (to - from) } else { 0.5 * from.abs().max(1.0) };
        // A linear axis that begins near 0 begins at it: lengths are then in proportion.
        if !log && from >= 0.0 && from < 0.35 * to {
            from = 0.0;
        } else {
            from -= pad;
        }
        to += pad;
        let unscaled = |level: f64| if log { 10.0_f64.powf(level) } else { level };
        Some(Span { low: unscaled(from), high: unscaled(to), log })
    }
}

/// The extent of an axis, as plotters wants it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Span {
    pub low: f64,
    pub high: f64,
    pub log: bool,
}

impl Span {
    /// The value on the scale on which the axis is even.
    fn level(&self, value: f64) -> f64 {
        if self.log { value.max(f64::MIN_POSITIVE).log10() } else { value }
    }

    fn decades(&self, most: usize) -> Vec<f64> {
        let (low, high) = (self.level(self.low), self.level(self.high));
        let within = |v: &f64| self.level(*v) >= low - 1e-9 && self.level(*v) <= high + 1e-9;
        let decades = (low.floor() as i32)..=(high.ceil() as i32);
        if high - low < 2.2 {
            let steps: &[f64] = if high - low < 1.2 { &[1.0, 2.0, 3.0, 5.0, 7.0] } else { &[1.0, 2.0, 5.0] };
            return decades.flat_map(|e| steps.iter().map(move |s| s * 10.0_f64.powi(e))).filter(within).collect();
        }
        let count = (high.floor() - low.ceil()) as usize + 1;
        let each = count.div_ceil(most.max(2)) as i32;
        decades.filter(|e| e % each == 0).map(|e| 10.0_f64.powi(e)).filter(within).collect()
    }

    fn steps(&self, most: usize) -> Vec<f64> {
        let rough = (self.high - self.low) / most.max(2) as f64;
        let power = 10.0_f64.powf(rough.log10().floor());
        let step = power * [1.0, 2.0, 5.0].into_iter().find(|s| s * power >= rough * 0.999).unwrap_or(10.0);
        let (first, last) = ((self.low / step - 1e-9).ceil() as i64, (self.high / step + 1e-9).floor() as i64);
        (first..=last).map(|i| i as f64 * step).collect()
    }
}

impl Ranged for Span {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        let (low, high) = (self.level(self.low), self.level(self.high));
        let share = ((self.level(*value) - low) / (high - low)).clamp(0.0, 1.0);
        limit.0 + (share * f64::from(limit.1 - limit.0)).round() as i32
    }

    fn key_points<H: KeyPointHint>(&self, hint: H) -> Vec<f64> {
        let most = hint.bold_points();
        if self.log { self.decades(most) } else { self.steps(most) }
    }

    fn range(&self) -> Range<f64> {
        self.low..self.high
    }
}

impl ValueFormatter<f64> for Span {
    fn format_ext(&self, value: &f64) -> String {
        tick(*value)
    }
}

/// A tick's number: plain, or a power of ten where plain would be long.
pub(super) fn tick(value: f64) -> String {
    // Multiples of a step carry rounding with them: 0.30000000000000004.
    let rounded: f64 = format!("{value:.6e}").parse().unwrap_or(value);
    let size = rounded.abs();
    if rounded == 0.0 || (9.99e-4..1e4).contains(&size) {
        return format!("{rounded}").replace('-', "−");
    }
    let text = format!("{rounded:e}");
    let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let raised: String = exponent.chars().map(superscript).collect();
    match digits {
        "1" => format!("10{raised}"),
        digits => format!("{}·10{raised}", digits.replace('-', "−")),
    }
}

fn superscript(c: char) -> char {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    c.to_digit(10).map_or('⁻', |digit| DIGITS[digit as usize])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_within() {
        let linear = Axis::linear("").span([0.2, 9.3], false).unwrap();
        assert_eq!((linear.low, linear.steps(6)), (0.0, vec![0.0, 2.0, 4.0, 6.0, 8.0]));
        let log = Axis::log("").span([0.0, 1e-3, f64::NAN, 2e4], false).unwrap();
        assert!((log.low - 1e-3).abs() < 1e-12 && log.decades(10).len() == 8);
        assert_eq!(log.decades(4).len(), 4);
        assert_eq!(Axis::log("").from_to(1.0, 10.0).span([2.0], false).unwrap().decades(10), [1., 2., 3., 5., 7., 10.]);
        assert!(Axis::log("").span([0.0, -1.0, f64::INFINITY], true).is_none());
        assert!(Axis::linear("").span([3.0], true).is_some_and(|span| span.low < 3.0 && 3.0 < span.high));
    }

    #[test]
    fn a_log_axis_is_even_in_ratios_and_keeps_zero_at_its_end() {
        let span = Span { low: 0.1, high: 1000.0, log: true };
        let at = |v: f64| span.map(&v, (0, 400));
        assert_eq!([0.0, 0.1, 1.0, 10.0, 1000.0, 1e9].map(at), [0, 0, 100, 200, 400, 400]);
    }

    #[test]
    fn numbers_are_readable() {
        assert_eq!([0.1 * 3.0, 1e4, 1e-6, -0.5, 250.0, 3e7].map(tick), ["0.3", "10⁴", "10⁻⁶", "−0.5", "250", "3·10⁷"]);
    }
}
