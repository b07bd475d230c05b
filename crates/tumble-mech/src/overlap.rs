//! Bodies whose drawings share a piece of the plane: they would have to meet, and nothing says that they do.
//!
//! The tests are on the safe side: what only touches does not overlap, nor do two points, and holes hide what is in them.

use std::collections::{HashMap, HashSet};
use std::ops::Range;

use tumble_ode::InitialState;

use crate::body::Body;
use crate::equations::Equations;
use crate::error::ModelError;
use crate::joint::Joint;
use crate::mode::Mode;
use crate::sets::Sets;
use crate::shape::Shape;
use crate::warnings::ModelWarning;

/// In parts of the extents of both bodies: starts are given with fewer digits than this, and what touches need not fit better.
const TOUCH: f64 = 1e-6;

/// So many pairs are counted: nobody reads on, and there may be as many as the square of the bodies.
const MOST_PAIRS: usize = 100;

type Point = [f64; 2];

/// A shape at the start, m, world axes.
#[derive(Clone, Debug)]
enum Outline {
    /// Corners in order: one is a point, two are a rod.
    Straight(Vec<Point>),
    Round {
        centre: Point,
        radius: f64,
        is_hollow: bool,
    },
}

/// A body at the start.
#[derive(Debug)]
struct Placed {
    body: usize,
    /// Of what is joined, directly or through others.
    assembly: usize,
    outlines: Vec<Outline>,
    left: f64,
    right: f64,
}

impl Equations {
    /// That bodies which no joints connect and no contact lets meet overlap at the start: one pair, and how many there are.
    pub(crate) fn overlap(&self, start: &InitialState<Mode>) -> Result<Option<ModelWarning>, ModelError> {
        let mut placed = self.placed(start)?;
        placed.sort_by(|a, b| a.left.total_cmp(&b.left));
        let met = self.pairs().iter().filter_map(|pair| Some([pair.body, pair.other?]));
        let met: HashSet<[usize; 2]> = met.map(|[a, b]| [a.min(b), a.max(b)]).collect();
        let meets = |a: usize, b: usize| met.contains(&[a.min(b), a.max(b)]);
        let pairs = placed.iter().enumerate().flat_map(|(index, one)| {
            let near = placed[index + 1..].iter().take_while(|other| other.left < one.right);
            near.filter(|other| !meets(one.body, other.body) && one.overlaps(other))
                .map(|other| [one.body, other.body])
        });
        let pairs: Vec<[usize; 2]> = pairs.take(MOST_PAIRS).collect();
        let Some([one, other]) = pairs.first().copied() else { return Ok(None) };
        let name = |body: usize| self.model().bodies[body].name.clone();
        let [first, second] = [name(one.min(other)), name(one.max(other))];
        Ok(Some(ModelWarning::Overlap { first, second, others: pairs.len() - 1 }))
    }

    fn placed(&self, start: &InitialState<Mode>) -> Result<Vec<Placed>, ModelError> {
        let model = self.model();
        let assemblies = assemblies(&model.bodies, &model.joints);
        let (mut formulas, mut sketches) = (vec![], vec![]);
        for (body, known) in model.bodies.iter().enumerate() {
            let masses = formulas.len();
            formulas.extend(known.parts.iter().map(|part| part.mass.clone()));
            let sketch = |part: &crate::body::Part| {
                let (corners, round) = drawn(&part.shape);
                let first = formulas.len();
                let places = known.points_at(&corners).into_iter().map(|point| point.position());
                formulas.extend(places.flat_map(|place| place.components().to_vec()));
                let corners = first..formulas.len();
                formulas.extend(round.iter().map(|(radius, _)| radius.clone()));
                Sketch { corners, is_hollow: round.map(|(_, is_hollow)| is_hollow) }
            };
            let parts: Vec<Sketch> = known.parts.iter().map(sketch).collect();
            sketches.push((body, masses..masses + parts.len(), parts));
        }
        let values = self.values_at(start, &formulas)?;
        let whole =
            sketches.into_iter().filter(|(_, masses, _)| values[masses.clone()].iter().all(|m| *m >= 0.0));
        Ok(whole.map(|(body, _, parts)| Placed::of(body, assemblies[body], &parts, &values)).collect())
    }
}

/// Where among the values those of a shape are.
struct Sketch {
    corners: Range<usize>,
    is_hollow: Option<bool>,
}

/// Corners or centre of a shape, and if it is round its radius and whether there is nothing in it.
fn drawn(shape: &Shape) -> (Vec<tumble_expr::Vector>, Option<(tumble_expr::Expr, bool)>) {
    match shape {
        Shape::Point { at } => (vec![at.clone()], None),
        Shape::Rod { from, to, .. } => (vec![from.clone(), to.clone()], None),
        Shape::Box { .. } | Shape::Polygon { .. } => {
            (shape.edges().into_iter().map(|[corner, _]| corner).collect(), None)
        }
        Shape::Disk { centre, radius } | Shape::Ball { centre, radius } => {
            (vec![centre.clone()], Some((radius.clone(), false)))
        }
        Shape::Ring { centre, radius } | Shape::Shell { centre, radius } => {
            (vec![centre.clone()], Some((radius.clone(), true)))
        }
    }
}

/// For each body a number that it shares with those it is joined to.
fn assemblies(bodies: &[Body], joints: &[Joint]) -> Vec<usize> {
    let mut sets = Sets::new(bodies.len());
    let index: HashMap<&str, usize> =
        bodies.iter().enumerate().map(|(index, body)| (body.name.as_str(), index)).collect();
    for joint in joints {
        let mut ends = joint.bodies().filter_map(|name| index.get(name).copied());
        if let (Some(a), Some(b)) = (ends.next(), ends.next()) {
            sets.join(a, b);
        }
    }
    (0..bodies.len()).map(|body| sets.least(body)).collect()
}

impl Placed {
    fn of(body: usize, assembly: usize, parts: &[Sketch], values: &[f64]) -> Self {
        let outline = |sketch: &Sketch| {
            let corners: Vec<Point> =
                values[sketch.corners.clone()].chunks_exact(2).map(|place| [place[0], place[1]]).collect();
            match sketch.is_hollow {
                Some(is_hollow) => {
                    Outline::Round { centre: corners[0], radius: values[sketch.corners.end], is_hollow }
                }
                None => Outline::Straight(corners),
            }
        };
        let outlines: Vec<Outline> = parts.iter().map(outline).collect();
        let [left, right] = [-1.0, 1.0].map(|side: f64| {
            side * outlines.iter().map(|outline| outline.reach(side)).fold(f64::NEG_INFINITY, f64::max)
        });
        Self { body, assembly, outlines, left, right }
    }

    fn overlaps(&self, other: &Self) -> bool {
        let touch = TOUCH * (self.right - self.left + other.right - other.left);
        let meets = |one: &Outline| other.outlines.iter().any(|next| overlap(one, next, touch));
        self.assembly != other.assembly && self.outlines.iter().any(meets)
    }
}

impl Outline {
    /// How far it goes to a side, -1 for the left.
    fn reach(&self, side: f64) -> f64 {
        match self {
            Self::Straight(corners) => {
                corners.iter().map(|corner| side * corner[0]).fold(f64::NEG_INFINITY, f64::max)
            }
            Self::Round { centre, radius, .. } => side * centre[0] + radius,
        }
    }
}

/// Whether two outlines share more than what is `touch` deep, m.
fn overlap(one: &Outline, other: &Outline, touch: f64) -> bool {
    match (one, other) {
        (Outline::Straight(a), Outline::Straight(b)) => straight_overlap(a, b, touch),
        (Outline::Straight(a), Outline::Round { centre, radius, is_hollow }) => {
            let [near, far] = distances(a, *centre);
            near < radius - touch && (!is_hollow || far > radius + touch)
        }
        (Outline::Round { .. }, Outline::Straight(_)) => overlap(other, one, touch),
        (
            Outline::Round { centre: a, radius: r, is_hollow: first },
            Outline::Round { centre: b, radius: s, is_hollow: second },
        ) => {
            let apart = distance(*a, *b);
            let is_inside_of = |inner: f64, outer: f64| apart + inner < outer + touch;
            let is_apart = apart > r + s - touch;
            let has_room = *first && is_inside_of(*s, *r) || *second && is_inside_of(*r, *s);
            !(is_apart || has_room)
        }
    }
}

/// Least and greatest distance of what has these corners from a point, m.
fn distances(corners: &[Point], from: Point) -> [f64; 2] {
    let far = corners.iter().map(|corner| distance(*corner, from)).fold(0.0, f64::max);
    if is_within(corners, from) {
        return [0.0, far];
    }
    let near = edges(corners).map(|edge| from_edge(edge, from));
    let near = near.fold(corners.first().map_or(f64::INFINITY, |corner| distance(*corner, from)), f64::min);
    [near, far]
}

/// Lines that cross well inside of both, or a corner, a middle of an edge or the middle of all deep inside the other.
fn straight_overlap(a: &[Point], b: &[Point], touch: f64) -> bool {
    let crosses = |edge: [Point; 2]| edges(b).any(|other| do_cross(edge, other, touch));
    let reaches_into = |one: &[Point], other: &[Point]| {
        marks(one)
            .into_iter()
            .any(|mark| is_within(other, mark) && edges(other).all(|edge| from_edge(edge, mark) > touch))
    };
    edges(a).any(crosses) || reaches_into(a, b) || reaches_into(b, a)
}

fn marks(corners: &[Point]) -> Vec<Point> {
    let middles = edges(corners).map(|[a, b]| [(a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0]);
    let sum = corners.iter().fold([0.0, 0.0], |sum, corner| [sum[0] + corner[0], sum[1] + corner[1]]);
    let middle = sum.map(|sum| sum / corners.len() as f64);
    let middle = (!edges(corners).any(|edge| from_edge(edge, middle) == 0.0)).then_some(middle);
    corners
        .iter()
        .copied()
        .chain(middles)
        .chain(middle.filter(|middle| is_within(corners, *middle)))
        .collect()
}

fn edges(corners: &[Point]) -> impl Iterator<Item = [Point; 2]> + '_ {
    let count = if corners.len() < 3 { corners.len().saturating_sub(1) } else { corners.len() };
    (0..count).map(|index| [corners[index], corners[(index + 1) % corners.len()]])
}

/// Whether a ray to the right leaves the polygon once more than it enters it.
fn is_within(corners: &[Point], [x, y]: Point) -> bool {
    let crossed = edges(corners)
        .filter(|[a, b]| (a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]));
    corners.len() > 2 && crossed.count() % 2 == 1
}

fn from_edge([a, b]: [Point; 2], from: Point) -> f64 {
    let along = [b[0] - a[0], b[1] - a[1]];
    let square = along[0] * along[0] + along[1] * along[1];
    let part = ((from[0] - a[0]) * along[0] + (from[1] - a[1]) * along[1]) / square;
    let part = if part.is_finite() { part.clamp(0.0, 1.0) } else { 0.0 };
    distance([a[0] + part * along[0], a[1] + part * along[1]], from)
}

/// Whether the ends of each line lie on two sides of the other, none of them near it.
fn do_cross(one: [Point; 2], other: [Point; 2], touch: f64) -> bool {
    let parts = |[a, b]: [Point; 2], ends: [Point; 2]| {
        let length = distance(a, b);
        let [p, q] =
            ends.map(|end| ((b[0] - a[0]) * (end[1] - a[1]) - (b[1] - a[1]) * (end[0] - a[0])) / length);
        p.abs() > touch && q.abs() > touch && (p > 0.0) != (q > 0.0)
    };
    parts(one, other) && parts(other, one)
}

fn distance(a: Point, b: Point) -> f64 {
    libm::hypot(a[0] - b[0], a[1] - b[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    const SMALL: f64 = 1e-9;

    fn square(x: f64, y: f64) -> Outline {
        Outline::Straight(vec![[x, y], [x + 1.0, y], [x + 1.0, y + 1.0], [x, y + 1.0]])
    }

    fn disk(x: f64, radius: f64, is_hollow: bool) -> Outline {
        Outline::Round { centre: [x, 0.0], radius, is_hollow }
    }

    fn rod(a: Point, b: Point) -> Outline {
        Outline::Straight(vec![a, b])
    }

    #[track_caller]
    fn expect(one: &Outline, other: &Outline, overlaps: bool) {
        assert_eq!(overlap(one, other, SMALL), overlaps, "{one:?} {other:?}");
        assert_eq!(overlap(other, one, SMALL), overlaps, "{other:?} {one:?}");
    }

    #[test]
    fn what_touches_does_not_overlap() {
        expect(&square(0.0, 0.0), &square(1.0, 0.0), false);
        expect(&square(0.0, 0.0), &square(0.3, 1.0), false);
        expect(&disk(0.0, 1.0, false), &disk(2.0, 1.0, false), false);
        expect(&square(0.0, 0.0), &disk(2.0, 1.0, false), false);
        expect(&rod([0.0, 0.0], [1.0, 0.0]), &rod([0.5, 0.0], [0.5, 1.0]), false);
        expect(&rod([0.0, 1.0], [1.0, 1.0]), &square(0.0, 0.0), false);
        expect(&Outline::Straight(vec![[0.0, 0.5]]), &square(0.0, 0.0), false);
    }

    #[test]
    fn what_shares_a_piece_of_the_plane_overlaps() {
        expect(&square(0.0, 0.0), &square(0.0, 0.0), true);
        expect(&square(0.0, 0.0), &square(0.5, 0.0), true);
        expect(&square(0.0, 0.0), &square(0.5, 0.5), true);
        expect(&disk(0.0, 1.0, false), &disk(1.9, 1.0, false), true);
        expect(&disk(0.0, 1.0, false), &disk(0.1, 0.1, false), true);
        expect(&square(0.0, 0.0), &disk(1.9, 1.0, false), true);
        expect(&rod([0.0, 0.0], [1.0, 0.0]), &rod([0.5, -1.0], [0.5, 1.0]), true);
        expect(&rod([-1.0, 0.5], [2.0, 0.5]), &square(0.0, 0.0), true);
        expect(&Outline::Straight(vec![[0.5, 0.5]]), &square(0.0, 0.0), true);
        expect(&Outline::Straight(vec![[0.5, 0.0]]), &disk(0.0, 1.0, false), true);
    }

    #[test]
    fn what_is_hollow_has_room() {
        expect(&disk(0.0, 1.0, true), &disk(0.1, 0.1, false), false);
        expect(&disk(0.0, 1.0, true), &disk(1.0, 0.1, false), true);
        expect(&disk(0.0, 1.0, true), &disk(0.5, 1.0, true), true);
        expect(&disk(0.0, 1.0, true), &disk(0.0, 0.5, true), false);
        expect(&disk(0.0, 2.0, true), &square(0.0, 0.0), false);
        expect(&disk(0.0, 1.0, true), &disk(0.0, 3.0, false), true);
    }
}
