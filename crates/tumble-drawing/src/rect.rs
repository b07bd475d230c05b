//! Axis-parallel rectangles on the page (pixels, y down).

use crate::svg::Element;

/// Pixels by which rounding misplaces nothing.
const BEYOND: f64 = 1e-6;

/// A rectangle on the page: corner of least x and y, width and height, in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rect {
    /// Left edge.
    pub x: f64,
    /// Top edge.
    pub y: f64,
    /// Width.
    pub width: f64,
    /// Height.
    pub height: f64,
}

impl Rect {
    /// A rectangle from its top left corner and its size.
    pub fn new(x: f64, y: f64, width: f64, height: f64) -> Self {
        Self { x, y, width, height }
    }

    /// A rectangle from its centre and its size.
    pub fn centred(centre: [f64; 2], width: f64, height: f64) -> Self {
        Self::new(centre[0] - width / 2.0, centre[1] - height / 2.0, width, height)
    }

    /// The smallest rectangle holding all finite `points`, each `[x, y]`.
    pub fn around(points: impl IntoIterator<Item = [f64; 2]>) -> Option<Self> {
        let mut points = points.into_iter().filter(|p| p[0].is_finite() && p[1].is_finite());
        let first = points.next()?;
        Some(points.fold(Self::new(first[0], first[1], 0.0, 0.0), Rect::with_point))
    }

    fn with_point(self, p: [f64; 2]) -> Self {
        let (x, y) = (self.x.min(p[0]), self.y.min(p[1]));
        Self::new(x, y, self.right().max(p[0]) - x, self.bottom().max(p[1]) - y)
    }

    /// An element of this place and size.
    pub(crate) fn element(&self, name: &'static str) -> Element {
        let Self { x, y, width, height } = *self;
        Element::new(name).attrs([("x", x), ("y", y), ("width", width), ("height", height)])
    }

    /// Right edge.
    pub fn right(&self) -> f64 {
        self.x + self.width
    }

    /// Bottom edge.
    pub fn bottom(&self) -> f64 {
        self.y + self.height
    }

    /// Centre `[x, y]`.
    pub fn centre(&self) -> [f64; 2] {
        [self.x + self.width / 2.0, self.y + self.height / 2.0]
    }

    /// The rectangle grown by `margin` on every side.
    pub fn grown(&self, margin: f64) -> Self {
        Self::new(self.x - margin, self.y - margin, self.width + 2.0 * margin, self.height + 2.0 * margin)
    }

    /// The rectangle with more to its left and right.
    pub(crate) fn wider(&self, by: f64) -> Self {
        Self::new(self.x - by, self.y, self.width + 2.0 * by, self.height)
    }

    /// Whether the point lies inside or on the edge.
    pub fn contains(&self, p: [f64; 2]) -> bool {
        (self.x..=self.right()).contains(&p[0]) && (self.y..=self.bottom()).contains(&p[1])
    }

    /// Distance of the nearest points of two rectangles; 0 where they meet.
    pub(crate) fn apart(&self, other: &Rect) -> f64 {
        let x = (self.x - other.right()).max(other.x - self.right()).max(0.0);
        let y = (self.y - other.bottom()).max(other.y - self.bottom()).max(0.0);
        x.hypot(y)
    }

    /// Whether `other` lies wholly inside.
    pub fn encloses(&self, other: &Rect) -> bool {
        self.contains([other.x, other.y]) && self.contains([other.right(), other.bottom()])
    }

    /// Area shared with `other`, in square pixels.
    pub fn overlap(&self, other: &Rect) -> f64 {
        let width = self.right().min(other.right()) - self.x.max(other.x);
        let height = self.bottom().min(other.bottom()) - self.y.max(other.y);
        width.max(0.0) * height.max(0.0)
    }

    /// Whether the straight line from `a` to `b` meets the rectangle.
    pub fn meets_line(&self, a: [f64; 2], b: [f64; 2]) -> bool {
        self.parameters_inside(a, b).is_some()
    }

    /// The part of the straight line from `a` to `b` that lies inside.
    pub fn clipped_line(&self, a: [f64; 2], b: [f64; 2]) -> Option<[[f64; 2]; 2]> {
        let at = |t: f64| [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
        self.parameters_inside(a, b).map(|(from, to)| [at(from), at(to)])
    }

    /// Whether both ends lie beyond one edge, by more than rounding.
    fn is_past(&self, a: [f64; 2], b: [f64; 2]) -> bool {
        let past = |a: f64, b: f64, low: f64, high: f64| {
            (a < low - BEYOND && b < low - BEYOND) || (a > high + BEYOND && b > high + BEYOND)
        };
        past(a[0], b[0], self.x, self.right()) || past(a[1], b[1], self.y, self.bottom())
    }

    /// Parameters, 0 at `a` and 1 at `b`, between which the line is inside.
    fn parameters_inside(&self, a: [f64; 2], b: [f64; 2]) -> Option<(f64, f64)> {
        // Most lines of a picture are nowhere near: it takes no division to see that.
        if self.is_past(a, b) {
            return None;
        }
        let spans = [(a[0], b[0] - a[0], self.x, self.right()), (a[1], b[1] - a[1], self.y, self.bottom())];
        let inside = |(from, to): (f64, f64), (start, delta, low, high): (f64, f64, f64, f64)| {
            if delta == 0.0 {
                return if (low..=high).contains(&start) { (from, to) } else { (1.0, 0.0) };
            }
            let (s, t) = ((low - start) / delta, (high - start) / delta);
            (from.max(s.min(t)), to.min(s.max(t)))
        };
        Some(spans.into_iter().fold((0.0, 1.0), inside)).filter(|(from, to)| from <= to)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn overlap_is_the_shared_area() {
        let a = Rect::new(0.0, 0.0, 4.0, 4.0);
        assert_eq!(a.overlap(&Rect::new(2.0, 3.0, 10.0, 10.0)), 2.0);
        assert_eq!(a.overlap(&Rect::new(5.0, 5.0, 1.0, 1.0)), 0.0);
        assert_eq!(
            [a.apart(&Rect::new(3.0, 3.0, 9.0, 9.0)), a.apart(&Rect::new(7.0, -6.0, 1.0, 2.0))],
            [0.0, 5.0]
        );
    }

    #[test]
    fn lines_are_clipped_exactly() {
        let r = Rect::new(0.0, 0.0, 2.0, 1.0);
        assert!(r.meets_line([-1.0, 0.5], [3.0, 0.5]));
        assert!(r.meets_line([-1.0, -1.0], [3.0, 3.0]));
        assert!(!r.meets_line([-1.0, 1.0], [1.0, 3.0]));
        assert!(!r.meets_line([-1.0, 2.0], [3.0, 2.0]));
        assert!(r.meets_line([1.0, 0.5], [1.0, 0.5]));
        assert_eq!(r.clipped_line([-1.0, 0.5], [3.0, 0.5]), Some([[0.0, 0.5], [2.0, 0.5]]));
    }

    #[test]
    fn bounds_skip_what_is_not_finite() {
        let r = Rect::around([[1.0, 2.0], [f64::NAN, 0.0], [-1.0, 5.0]]);
        assert_eq!(r, Some(Rect::new(-1.0, 2.0, 2.0, 3.0)));
        assert_eq!(Rect::around([]), None);
    }
}
