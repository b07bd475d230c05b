//! Shapes of bodies, in body coordinates, with the mass properties of uniform density.

use tumble_expr::{Expr, Vector};

/// A plane figure, or a solid whose plane of motion is a plane of symmetry. Lengths in m, body axes.
#[derive(Clone, Debug)]
pub enum Shape {
    /// A mass without extent.
    Point {
        /// Where it is.
        at: Vector,
    },
    /// A thin straight rod.
    Rod {
        /// One end.
        from: Vector,
        /// The other end.
        to: Vector,
        /// Radius of its round ends, m: by it they touch surfaces; it has no part in the mass properties.
        end_radius: Expr,
    },
    /// A solid disk or cylinder, turning about its axis.
    Disk {
        /// Its centre.
        centre: Vector,
        /// Its radius.
        radius: Expr,
    },
    /// A thin ring or hoop.
    Ring {
        /// Its centre.
        centre: Vector,
        /// Its radius.
        radius: Expr,
    },
    /// A solid ball.
    Ball {
        /// Its centre.
        centre: Vector,
        /// Its radius.
        radius: Expr,
    },
    /// A thin spherical shell.
    Shell {
        /// Its centre.
        centre: Vector,
        /// Its radius.
        radius: Expr,
    },
    /// A solid rectangle, its sides along the body axes at angle zero.
    Box {
        /// Its centre.
        centre: Vector,
        /// Along body x.
        width: Expr,
        /// Along body y.
        height: Expr,
    },
    /// A solid polygon with these corners in order, either way round.
    Polygon {
        /// Its corners.
        corners: Vec<Vector>,
    },
}

impl Shape {
    /// Centre of mass, m, body axes.
    pub fn centre(&self) -> Vector {
        match self {
            Self::Point { at } => at.clone(),
            Self::Rod { from, to, .. } => Expr::from(0.5) * (from + to),
            Self::Disk { centre, .. } | Self::Ring { centre, .. } | Self::Ball { centre, .. } => {
                centre.clone()
            }
            Self::Shell { centre, .. } | Self::Box { centre, .. } => centre.clone(),
            Self::Polygon { corners } => polygon::centre(corners),
        }
    }

    /// Moment of inertia about the centre of mass over the mass, m^2.
    pub fn gyration(&self) -> Expr {
        let squared = |length: &Expr| length * length;
        match self {
            Self::Point { .. } => Expr::zero(),
            Self::Rod { from, to, .. } => square(&(to - from)) / 12,
            Self::Disk { radius, .. } => squared(radius) / 2,
            Self::Ring { radius, .. } => squared(radius),
            Self::Ball { radius, .. } => squared(radius) * 2 / 5,
            Self::Shell { radius, .. } => squared(radius) * 2 / 3,
            Self::Box { width, height, .. } => (squared(width) + squared(height)) / 12,
            Self::Polygon { corners } => polygon::gyration(corners),
        }
    }

    /// Largest distance of its matter from its centre of mass, m.
    pub fn reach(&self) -> Expr {
        match self {
            Self::Point { .. } => Expr::zero(),
            Self::Rod { from, to, .. } => (to - from).norm() / 2,
            Self::Disk { radius, .. } | Self::Ring { radius, .. } => radius.clone(),
            Self::Ball { radius, .. } | Self::Shell { radius, .. } => radius.clone(),
            Self::Box { width, height, .. } => Expr::norm(vec![width.clone(), height.clone()]) / 2,
            Self::Polygon { corners } => polygon::reach(corners),
        }
    }

    /// The straight lines it is bounded by, or is, each by its two ends, m, body axes.
    pub fn edges(&self) -> Vec<[Vector; 2]> {
        let round = |corners: &[Vector]| {
            let next = corners.iter().cycle().skip(1);
            corners.iter().zip(next).map(|(a, b)| [a.clone(), b.clone()]).collect()
        };
        match self {
            Self::Rod { from, to, .. } => vec![[from.clone(), to.clone()]],
            Self::Polygon { corners } => round(corners),
            Self::Box { centre, width, height } => {
                let corner = |x: i32, y: i32| centre + Vector::planar(width * x / 2, height * y / 2);
                round(&[corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)])
            }
            _ => vec![],
        }
    }

    /// Places of which it is the hull, thickened by a radius, m, body axes; corners in order.
    pub(crate) fn hull(&self) -> (Vec<Vector>, Expr) {
        match self {
            Self::Point { at } => (vec![at.clone()], Expr::zero()),
            Self::Rod { from, to, end_radius } => (vec![from.clone(), to.clone()], end_radius.clone()),
            Self::Disk { centre, radius } | Self::Ring { centre, radius } => {
                (vec![centre.clone()], radius.clone())
            }
            Self::Ball { centre, radius } | Self::Shell { centre, radius } => {
                (vec![centre.clone()], radius.clone())
            }
            Self::Box { .. } | Self::Polygon { .. } => {
                (self.edges().into_iter().map(|[corner, _]| corner).collect(), Expr::zero())
            }
        }
    }

    /// Lengths that must be positive, with their names.
    pub(crate) fn sizes(&self) -> Vec<(&'static str, Expr)> {
        match self {
            Self::Point { .. } => vec![],
            Self::Rod { from, to, .. } => vec![("length", (to - from).norm())],
            Self::Disk { radius, .. } | Self::Ring { radius, .. } => vec![("radius", radius.clone())],
            Self::Ball { radius, .. } | Self::Shell { radius, .. } => vec![("radius", radius.clone())],
            Self::Box { width, height, .. } => vec![("width", width.clone()), ("height", height.clone())],
            Self::Polygon { corners } => vec![("area", polygon::area(corners).abs().sqrt())],
        }
    }

    /// Lengths that may be zero and must not be negative, with their names.
    pub(crate) fn radii(&self) -> Vec<(&'static str, Expr)> {
        match self {
            Self::Rod { end_radius, .. } => vec![("end radius", end_radius.clone())],
            _ => vec![],
        }
    }

    /// Places in body coordinates, for checking their dimensions.
    pub(crate) fn places(&self) -> Vec<&Vector> {
        match self {
            Self::Point { at } => vec![at],
            Self::Rod { from, to, .. } => vec![from, to],
            Self::Disk { centre, .. } | Self::Ring { centre, .. } | Self::Ball { centre, .. } => vec![centre],
            Self::Shell { centre, .. } | Self::Box { centre, .. } => vec![centre],
            Self::Polygon { corners } => corners.iter().collect(),
        }
    }
}

/// Squared length of a vector in the plane.
pub(crate) fn square(v: &Vector) -> Expr {
    v.x() * v.x() + v.y() * v.y()
}

/// Sums over the triangles that the edges make with the first corner, each weighted by its signed area: cancellation
/// stays small wherever the body's origin is.
mod polygon {
    use tumble_expr::{Expr, Vector};

    use super::square;

    struct Triangle {
        /// Twice the signed area.
        doubled: Expr,
        a: Vector,
        b: Vector,
    }

    fn triangles(corners: &[Vector]) -> Vec<Triangle> {
        let first = &corners[0];
        let spokes: Vec<Vector> = corners[1..].iter().map(|corner| corner - first).collect();
        let pairs = spokes.windows(2);
        pairs
            .map(|pair| Triangle {
                doubled: pair[0].cross_planar(&pair[1]),
                a: pair[0].clone(),
                b: pair[1].clone(),
            })
            .collect()
    }

    fn sum(terms: impl Iterator<Item = Expr>) -> Expr {
        terms.fold(Expr::zero(), |sum, term| sum + term)
    }

    /// Signed area, counter-clockwise positive.
    pub(super) fn area(corners: &[Vector]) -> Expr {
        sum(triangles(corners).into_iter().map(|t| t.doubled)) / 2
    }

    pub(super) fn centre(corners: &[Vector]) -> Vector {
        &corners[0] + centre_from_first(corners)
    }

    /// A triangle's centroid is a third of its corners' sum; the first corner is the origin here.
    fn centre_from_first(corners: &[Vector]) -> Vector {
        let triangles = triangles(corners);
        let whole = sum(triangles.iter().map(|t| t.doubled.clone())) * 3;
        let component = |i: usize| sum(triangles.iter().map(|t| &t.doubled * (&t.a[i] + &t.b[i]))) / &whole;
        Vector::planar(component(0), component(1))
    }

    /// A triangle with one corner at the origin has second moment `area (a.a + a.b + b.b) / 6` about it.
    pub(super) fn gyration(corners: &[Vector]) -> Expr {
        let triangles = triangles(corners);
        let whole = sum(triangles.iter().map(|t| t.doubled.clone()));
        let moment = |t: &Triangle| {
            let mixed = t.a.x() * t.b.x() + t.a.y() * t.b.y();
            &t.doubled * (square(&t.a) + mixed + square(&t.b))
        };
        let about_first = sum(triangles.iter().map(moment)) / (whole * 6);
        about_first - square(&centre_from_first(corners))
    }

    pub(super) fn reach(corners: &[Vector]) -> Expr {
        let centre = centre(corners);
        let distances = corners.iter().map(|corner| (corner - &centre).norm());
        distances
            .reduce(|far, next| Expr::binary(tumble_expr::Binary::Max, far, next))
            .unwrap_or_else(Expr::zero)
    }
}
