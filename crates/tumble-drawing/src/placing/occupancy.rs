//! Finding room for labels among things already drawn.

use crate::geometry::{dot, length, minus, nearest};
use crate::rect::Rect;

/// Room kept between a label and anything else, in pixels.
pub(crate) const CLEARANCE: f64 = 3.0;

/// What a line or the edge of a box under a label costs, compared with a pixel of overlap with a box.
const LINE_COST: f64 = 60.0;
/// What lying on a face costs.
const FACE_COST: f64 = 5.0;
/// As how many lines an arrow counts for a leader that crosses it: one that meets an arrow seems to point at it.
const ARROW: f64 = 4.0;
/// As how often a leader counts that goes along a line, in which it is lost, and the sine of the angle below which it does.
const ALONG: f64 = 3.0;
const ALONG_SINE: f64 = 0.25;
/// Half the width of an arrow's shaft, in pixels, with what keeps a letter from touching it.
const HALF_SHAFT: f64 = 1.9;
/// What leaving the area costs.
const OUTSIDE_COST: f64 = 1e6;

/// A line that is drawn.
#[derive(Clone, Debug)]
struct Line {
    points: Vec<[f64; 2]>,
    /// What it lies in, if it has points.
    within: Option<Rect>,
    /// As how many it counts for a leader that crosses it.
    weight: f64,
    /// Pixels from its middle to where it ends.
    half: f64,
}

impl Line {
    fn new(points: Vec<[f64; 2]>, weight: f64, half: f64) -> Self {
        let within = Rect::around(points.iter().copied());
        Self { points, within, weight, half }
    }

    /// How many of its pieces meet the rectangle, or whether its only point does.
    fn crossings(&self, place: &Rect) -> usize {
        let place = place.grown(self.half);
        match self.points[..] {
            [only] => usize::from(place.contains(only)),
            _ => self.pieces().filter(|[p, q]| place.meets_line(*p, *q)).count(),
        }
    }

    fn pieces(&self) -> impl Iterator<Item = [[f64; 2]; 2]> {
        self.points.windows(2).map(|w| [w[0], w[1]])
    }
}

/// The occupied part of a page.
#[derive(Clone, Debug)]
pub(crate) struct Occupancy {
    area: Rect,
    boxes: Vec<Rect>,
    lines: Vec<Line>,
    faces: Vec<Vec<[f64; 2]>>,
}

impl Occupancy {
    /// Nothing drawn yet; labels must stay in `area`.
    pub(crate) fn new(area: Rect) -> Self {
        Self { area, boxes: Vec::new(), lines: Vec::new(), faces: Vec::new() }
    }

    /// Marks a rectangle as taken.
    pub(crate) fn add_box(&mut self, taken: Rect) {
        self.boxes.push(taken);
    }

    /// Marks a polyline as taken.
    pub(crate) fn add_line(&mut self, points: Vec<[f64; 2]>) {
        self.lines.push(Line::new(points, 1.0, 0.0));
    }

    /// Marks the shaft of an arrow as taken.
    pub(crate) fn add_arrow(&mut self, shaft: [[f64; 2]; 2]) {
        self.lines.push(Line::new(shaft.to_vec(), ARROW, HALF_SHAFT));
    }

    /// Marks an arrow that is bent as taken.
    pub(crate) fn add_bent_arrow(&mut self, shaft: Vec<[f64; 2]>) {
        self.lines.push(Line::new(shaft, 1.0, HALF_SHAFT));
    }

    /// Marks the inside of a closed outline as taken; its rim is a line of its own.
    pub(crate) fn add_face(&mut self, corners: Vec<[f64; 2]>) {
        self.faces.push(corners);
    }

    /// Whether nothing drawn so far touches the rectangle.
    pub(crate) fn is_free(&self, place: &Rect) -> bool {
        self.boxes.iter().all(|taken| taken.overlap(place) == 0.0) && self.crossings(place) == 0
    }

    /// Whether a line or a point runs through the rectangle.
    pub(crate) fn is_crossed(&self, place: &Rect) -> bool {
        self.crossings(place) > 0
    }

    /// Line pieces that the straight line from `a` to `b` crosses.
    pub(crate) fn crossed_by(&self, a: [f64; 2], b: [f64; 2]) -> usize {
        self.lines.iter().flat_map(Line::pieces).filter(|piece| lines_cross([a, b], *piece)).count()
    }

    /// How often the straight line from `a` to `b` crosses lines, or comes nearer to one than `apart`, each by its weight: once for
    /// pieces in a row, however fine a curve is cut, and more where it goes along one.
    pub(crate) fn touched_by(&self, a: [f64; 2], b: [f64; 2], apart: f64) -> f64 {
        let [x, y] = [0, 1].map(|k| (a[k].min(b[k]) - apart, a[k].max(b[k]) + apart));
        // Most are nowhere near.
        let is_past = |p: [f64; 2], q: [f64; 2]| {
            let is_past = |k: usize, (low, high): (f64, f64)| {
                (p[k] < low && q[k] < low) || (p[k] > high && q[k] > high)
            };
            is_past(0, x) || is_past(1, y)
        };
        let is_touched =
            |[p, q]: [[f64; 2]; 2]| !is_past(p, q) && squared_distance([a, b], [p, q]) < apart * apart;
        let counts = |piece: [[f64; 2]; 2]| match is_touched(piece) {
            false => 0.0,
            true if is_along([a, b], piece) => ALONG,
            true => 1.0,
        };
        let times = |line: &Line| {
            let (runs, last) = line.pieces().map(counts).fold((0.0, 0.0), |(runs, run), count| match count {
                0.0 => (runs + run, 0.0),
                _ => (runs, f64::max(run, count)),
            });
            line.weight * (runs + last)
        };
        let is_near = |line: &&Line| {
            line.within
                .is_some_and(|within| !is_past([within.x, within.y], [within.right(), within.bottom()]))
        };
        self.lines.iter().filter(is_near).map(times).sum()
    }

    /// What it costs to draw over the rectangle: pixels of overlap with
    /// boxes, and as many as seem fair for lines, edges, faces and leaving the area.
    pub(crate) fn burden(&self, place: &Rect) -> f64 {
        let overlaps = self.boxes.iter().map(|taken| taken.overlap(place)).filter(|shared| *shared > 0.0);
        let overlap: f64 = overlaps.map(|shared| LINE_COST + shared).sum();
        let outside = if self.area.encloses(place) { 0.0 } else { OUTSIDE_COST };
        let faces = self.faces.iter().filter(|face| covers(face, place)).count();
        outside + overlap + LINE_COST * self.crossings(place) as f64 + FACE_COST * faces as f64
    }

    /// Line pieces that meet the rectangle.
    fn crossings(&self, place: &Rect) -> usize {
        self.lines.iter().map(|line| line.crossings(place)).sum()
    }
}

/// Whether the middle or a corner of the rectangle lies in the closed outline.
pub(crate) fn covers(face: &[[f64; 2]], place: &Rect) -> bool {
    let [right, bottom] = [place.right(), place.bottom()];
    let corners = [[place.x, place.y], [right, place.y], [place.x, bottom], [right, bottom], place.centre()];
    corners.iter().any(|p| is_inside(face, *p))
}

/// Whether a point lies in a closed outline: a ray to the right leaves it an odd number of times.
fn is_inside(face: &[[f64; 2]], p: [f64; 2]) -> bool {
    let edges = face.iter().zip(face.iter().cycle().skip(1));
    let crosses = |(a, b): &(&[f64; 2], &[f64; 2])| {
        (a[1] > p[1]) != (b[1] > p[1]) && p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
    };
    edges.filter(crosses).count() % 2 == 1
}

/// Whether two pieces of straight lines cross.
pub(crate) fn lines_cross([a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2]) -> bool {
    let side =
        |p: [f64; 2], q: [f64; 2], r: [f64; 2]| (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
    side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
}

/// Whether two pieces of straight lines have nearly one direction.
fn is_along([a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2]) -> bool {
    let (one, other) = (minus(b, a), minus(d, c));
    (one[0] * other[1] - one[1] * other[0]).abs() < ALONG_SINE * length(one) * length(other)
}

/// The square of the distance of two pieces of straight lines.
fn squared_distance([a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2]) -> f64 {
    if lines_cross([a, b], [c, d]) {
        return 0.0;
    }
    let from = |p: [f64; 2], line: [[f64; 2]; 2]| {
        let way = minus(p, nearest(p, line));
        dot(way, way)
    };
    let ends = [from(a, [c, d]), from(b, [c, d]), from(c, [a, b]), from(d, [a, b])];
    ends.into_iter().fold(f64::INFINITY, f64::min)
}

/// A rectangle whose nearest point lies `reach` from the anchor in `direction`.
pub(crate) fn beside(anchor: [f64; 2], direction: [f64; 2], reach: f64, width: f64, height: f64) -> Rect {
    let reach = reach / direction[0].hypot(direction[1]);
    let x = anchor[0] + direction[0] * (reach + width / 2.0);
    let y = anchor[1] + direction[1] * (reach + height / 2.0);
    Rect::centred([x, y], width, height)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn page() -> Occupancy {
        Occupancy::new(Rect::new(0.0, 0.0, 200.0, 200.0))
    }

    #[test]
    fn a_curve_is_crossed_as_often_as_it_is_met_however_fine_it_is_cut() {
        let round = |steps: u32| {
            let at = |i: u32| (std::f64::consts::TAU * f64::from(i) / f64::from(steps)).sin_cos();
            (0..=steps).map(|i| [100.0 + 25.0 * at(i).1, 100.0 + 25.0 * at(i).0]).collect::<Vec<_>>()
        };
        for steps in [12, 60, 600] {
            let mut page = page();
            page.add_line(round(steps));
            assert_eq!(page.touched_by([90.0, 95.0], [150.0, 95.0], 2.0), 1.0, "from within");
            assert_eq!(page.touched_by([50.0, 95.0], [150.0, 95.0], 2.0), 2.0, "across");
        }
    }

    #[test]
    fn a_leader_along_a_line_counts_more_than_one_across() {
        let mut page = page();
        page.add_line(vec![[50.0, 100.0], [150.0, 100.0]]);
        assert_eq!(page.touched_by([60.0, 101.0], [90.0, 103.0], 2.0), ALONG);
        assert_eq!(page.touched_by([60.0, 90.0], [90.0, 110.0], 2.0), 1.0);
    }

    #[test]
    fn an_arrow_counts_more_than_other_lines() {
        let mut page = page();
        page.add_line(vec![[100.0, 0.0], [100.0, 200.0]]);
        page.add_line(vec![[120.0, 0.0], [120.0, 200.0]]);
        page.add_arrow([[50.0, 0.0], [50.0, 200.0]]);
        let touched = |from: f64, to: f64| page.touched_by([from, 90.0], [to, 90.0], 2.0);
        assert!(touched(30.0, 70.0) > touched(80.0, 140.0));
    }

    #[test]
    fn faces_cost_even_where_no_line_is_met() {
        let mut page = page();
        page.add_face(vec![[0.0, 0.0], [100.0, 0.0], [100.0, 100.0], [0.0, 100.0]]);
        assert_eq!(page.burden(&Rect::new(40.0, 40.0, 10.0, 10.0)), FACE_COST);
        assert_eq!(page.burden(&Rect::new(120.0, 40.0, 10.0, 10.0)), 0.0);
        assert!(lines_cross([[0.0, 0.0], [2.0, 2.0]], [[0.0, 2.0], [2.0, 0.0]]));
        assert!(!lines_cross([[0.0, 0.0], [1.0, 1.0]], [[3.0, 2.0], [2.0, 3.0]]));
    }
}
