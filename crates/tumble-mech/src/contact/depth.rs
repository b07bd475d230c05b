//! How deep two convex figures are in each other: what starts so is refused.
//!
//! Each is the hull of some places, thickened by a radius. Where the hulls share no place the depth is what the radii are longer than
//! their distance; else it is the least way by which one is led out of the other, along the normal of one of their edges.

type Point = [f64; 2];

/// The hull of places, corners of a polygon in order or two ends or one centre, with all that is nearer to it than the radius, m.
#[derive(Clone, Debug)]
pub(crate) struct Hull {
    pub(crate) places: Vec<Point>,
    pub(crate) radius: f64,
}

/// How deep two are in each other, m; negative where they are apart.
pub(crate) fn depth(one: &Hull, other: &Hull) -> f64 {
    let axes = axes(one, other);
    let apart = axes.iter().map(|axis| gap_along(*axis, one, other)).fold(f64::NEG_INFINITY, f64::max);
    let radii = one.radius + other.radius;
    let [a, b] = [one, other].map(|hull| &hull.places);
    radii - if apart > 0.0 || axes.is_empty() { distance(a, b) } else { apart }
}

/// Unit vectors along which what is apart can be told apart: normals of edges, both ways, and along those of what is a line only.
fn axes(one: &Hull, other: &Hull) -> Vec<Point> {
    let of = |hull: &Hull| {
        let edges = edges(&hull.places).into_iter().map(|[a, b]| {
            let length = libm::hypot(b[0] - a[0], b[1] - a[1]);
            [(b[1] - a[1]) / length, (a[0] - b[0]) / length]
        });
        let is_line = hull.places.len() == 2;
        let all = edges.flat_map(|[x, y]| {
            [Some([x, y]), Some([-x, -y]), is_line.then_some([-y, x]), is_line.then_some([y, -x])]
        });
        all.flatten().collect::<Vec<_>>()
    };
    [of(one), of(other)].concat()
}

/// Distance from the far side of one to the near side of the other along an axis.
fn gap_along(axis: Point, one: &Hull, other: &Hull) -> f64 {
    let along = |place: &Point| axis[0] * place[0] + axis[1] * place[1];
    let far = one.places.iter().map(along).fold(f64::NEG_INFINITY, f64::max);
    other.places.iter().map(along).fold(f64::INFINITY, f64::min) - far
}

fn edges(places: &[Point]) -> Vec<[Point; 2]> {
    let count = if places.len() > 2 { places.len() } else { places.len().saturating_sub(1) };
    (0..count).map(|index| [places[index], places[(index + 1) % places.len()]]).collect()
}

/// Least distance of what does not cross.
fn distance(a: &[Point], b: &[Point]) -> f64 {
    let from = |places: &[Point], others: &[Point]| {
        let to = |place: &Point| {
            let edges = edges(others).into_iter().map(|edge| from_edge(edge, *place));
            let corners = others.iter().map(|other| libm::hypot(place[0] - other[0], place[1] - other[1]));
            edges.chain(corners).fold(f64::INFINITY, f64::min)
        };
        places.iter().map(to).fold(f64::INFINITY, f64::min)
    };
    from(a, b).min(from(b, a))
}

fn from_edge([a, b]: [Point; 2], place: Point) -> f64 {
    let (along, way) = ([b[0] - a[0], b[1] - a[1]], [place[0] - a[0], place[1] - a[1]]);
    let square = along[0] * along[0] + along[1] * along[1];
    let part = ((way[0] * along[0] + way[1] * along[1]) / square).clamp(0.0, 1.0);
    libm::hypot(way[0] - part * along[0], way[1] - part * along[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: f64, y: f64) -> Hull {
        Hull { places: vec![[x, y], [x + 1.0, y], [x + 1.0, y + 1.0], [x, y + 1.0]], radius: 0.0 }
    }

    fn disk(x: f64, y: f64, radius: f64) -> Hull {
        Hull { places: vec![[x, y]], radius }
    }

    fn rod(a: Point, b: Point, radius: f64) -> Hull {
        Hull { places: vec![a, b], radius }
    }

    #[track_caller]
    fn expect(one: &Hull, other: &Hull, expected: f64) {
        for found in [depth(one, other), depth(other, one)] {
            assert!((found - expected).abs() < 1e-15, "{found} and not {expected}");
        }
    }

    #[test]
    fn depths_of_what_is_apart_touches_and_overlaps() {
        expect(&square(0.0, 0.0), &square(1.25, 0.5), -0.25);
        expect(&square(0.0, 0.0), &square(1.0, 0.5), 0.0);
        expect(&square(0.0, 0.0), &square(0.75, 0.5), 0.25);
        // Beside a corner the distance counts, not the way along an edge's normal.
        expect(&square(0.0, 0.0), &disk(1.3, 1.4, 0.75), 0.25);
        expect(&square(0.0, 0.0), &disk(0.5, 1.0, 0.25), 0.25);
        expect(&disk(0.0, 0.0, 1.0), &disk(3.0, 4.0, 5.0), 1.0);
        // Rods that cross: no end of one is in the other.
        expect(&rod([-1.0, 0.0], [1.0, 0.0], 0.0), &rod([0.0, -0.25], [0.0, 2.0], 0.0), 0.25);
        expect(&rod([-1.0, 0.0], [1.0, 0.0], 0.1), &rod([0.0, 0.25], [0.0, 2.0], 0.2), 0.05);
        // End to end on one line.
        expect(&rod([-1.0, 0.0], [1.0, 0.0], 0.0), &rod([1.5, 0.0], [2.0, 0.0], 0.0), -0.5);
    }
}
