//! Ranges of data and their place on the page.

/// Ranges narrower than this, relative to their values, are rounding noise
/// about a constant and are drawn as one.
const NOISE: f64 = 1e-12;

/// Values beyond this are treated as not finite, so that spans cannot overflow.
const LARGEST: f64 = 1e300;

/// Spans below this are zero to us: powers of ten near it lose digits.
const SMALLEST: f64 = 1e-290;

/// Half-width of the range drawn around a constant, relative to it.
const AROUND_CONSTANT: f64 = 0.1;

/// Whether a value can be drawn.
pub fn drawable(value: f64) -> bool {
    value.abs() < LARGEST
}

/// A closed interval of values, in the unit of its axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// Least value.
    pub low: f64,
    /// Greatest value.
    pub high: f64,
}

impl Range {
    /// The interval between two values, in either order.
    pub fn new(a: f64, b: f64) -> Self {
        Self { low: a.min(b), high: a.max(b) }
    }

    /// The smallest range holding all drawable values, if there are any.
    pub fn of(values: impl IntoIterator<Item = f64>) -> Option<Self> {
        let mut values = values.into_iter().filter(|v| drawable(*v));
        let first = values.next()?;
        Some(values.fold(Self::new(first, first), |range, v| Self {
            low: range.low.min(v),
            high: range.high.max(v),
        }))
    }

    /// The smallest ranges of x and y that hold all points.
    pub(crate) fn of_points(points: &[[f64; 2]]) -> Option<[Self; 2]> {
        let [x, y] = [0, 1].map(|k| Self::of(points.iter().map(|p| p[k])));
        x.zip(y).map(Into::into)
    }

    /// Width of the interval.
    pub fn span(&self) -> f64 {
        self.high - self.low
    }

    /// Middle of the interval.
    pub fn middle(&self) -> f64 {
        self.low + self.span() / 2.0
    }

    /// Whether the value lies inside or at an end.
    pub fn contains(&self, value: f64) -> bool {
        (self.low..=self.high).contains(&value)
    }

    /// The interval grown on both sides by `fraction` of its span.
    pub fn padded(&self, fraction: f64) -> Self {
        let by = fraction * self.span();
        Self { low: self.low - by, high: self.high + by }
    }

    /// The interval widened about its middle to at least `span`.
    pub fn widened(&self, span: f64) -> Self {
        let by = ((span - self.span()) / 2.0).max(0.0);
        Self { low: self.low - by, high: self.high + by }
    }

    /// Whether the interval is a single value, up to rounding noise.
    pub fn is_constant(&self) -> bool {
        self.span() <= (NOISE * self.low.abs().max(self.high.abs())).max(SMALLEST)
    }

    /// A range that can be drawn: unchanged unless constant, else with room around the value.
    pub fn opened(&self) -> Self {
        if !self.is_constant() {
            return *self;
        }
        let middle = self.middle();
        let by = if middle.abs() <= SMALLEST { 1.0 } else { AROUND_CONSTANT * middle.abs() };
        Self { low: middle - by, high: middle + by }
    }
}

impl Default for Range {
    fn default() -> Self {
        Self { low: 0.0, high: 1.0 }
    }
}

/// A linear map from values to pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    /// The values shown.
    pub range: Range,
    /// Pixel of the least value.
    pub start: f64,
    /// Pixel of the greatest value.
    pub end: f64,
}

impl Scale {
    /// The map that takes `range.low` to `start` and `range.high` to `end` (pixels).
    pub fn new(range: Range, start: f64, end: f64) -> Self {
        Self { range, start, end }
    }

    /// Pixel of a value; NaN stays NaN.
    pub fn pixel(&self, value: f64) -> f64 {
        self.start + (value - self.range.low) / self.range.span() * (self.end - self.start)
    }

    /// Pixels per unit, positive.
    pub fn density(&self) -> f64 {
        (self.end - self.start).abs() / self.range.span()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_ignore_what_cannot_be_drawn() {
        let range = Range::of([f64::NAN, 1.0, f64::INFINITY, -2.0, 1e305]);
        assert_eq!(range, Some(Range::new(-2.0, 1.0)));
        assert_eq!(Range::of([f64::NAN]), None);
    }

    #[test]
    fn constants_get_room_on_both_sides() {
        for c in [0.0, 9.81, -3e-12, 1e6, -1e250, 1e-310] {
            let range = Range::new(c, c).opened();
            assert!(range.low < c && c < range.high, "{c}: {range:?}");
        }
    }

    #[test]
    fn rounding_noise_is_a_constant_and_a_small_change_is_not() {
        assert!(Range::new(12.3, 12.3 + 4e-15).is_constant());
        assert!(!Range::new(1e6, 1e6 + 1e-3).is_constant());
        assert!(!Range::new(0.0, 1e-20).is_constant());
    }

    #[test]
    fn scales_may_run_downwards() {
        let scale = Scale::new(Range::new(0.0, 2.0), 100.0, 0.0);
        assert_eq!([0.0, 1.0, 2.0].map(|v| scale.pixel(v)), [100.0, 50.0, 0.0]);
        assert_eq!(scale.density(), 50.0);
    }
}
