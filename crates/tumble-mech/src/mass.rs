//! # Law
//! Mass properties of parts joined rigidly: `M = sum m_i`, `M c = sum m_i c_i`, and by the parallel-axis theorem
//! `I = sum (I_i + m_i |c_i - c|^2)`.
//! # Symbols and units
//! m mass (kg), c centre of mass (m), I moment of inertia about the centre of mass (kg m^2).
//! # Sign and frame
//! Body axes, any origin; I is about the axis out of the plane.
//! # Validity
//! Rigid parts; uniform density within each part; motion in a plane of symmetry.
//! # Source
//! Any text on rigid bodies: moments of inertia of simple bodies, Steiner's theorem.
//! # Checked by
//! Tests below: closed forms of each shape, a polygon against the box and the disk, parts against the whole.

use tumble_expr::{Expr, Vector};

use crate::body::Part;
use crate::shape::square;

/// Mass, centre of mass and moment of inertia of a body, as formulas of the parameters.
#[derive(Clone, Debug)]
pub struct MassProperties {
    /// kg
    pub mass: Expr,
    /// m, body axes
    pub centre: Vector,
    /// About the centre of mass, kg m^2.
    pub inertia: Expr,
}

impl MassProperties {
    /// Of one uniform part.
    pub(crate) fn of_part(part: &Part) -> Self {
        let mass = part.mass.clone();
        let inertia = &mass * part.shape.gyration();
        Self { mass, centre: part.shape.centre(), inertia }
    }

    /// Of parts joined rigidly. One part keeps its own formulas, so that they print as they are known.
    pub(crate) fn joined(parts: &[Self]) -> Self {
        if let [only] = parts {
            return only.clone();
        }
        let sum =
            |term: &dyn Fn(&Self) -> Expr| parts.iter().map(term).fold(Expr::zero(), |sum, next| sum + next);
        let mass = sum(&|part| part.mass.clone());
        let component = |i: usize| sum(&|part| &part.mass * &part.centre[i]) / &mass;
        let centre = Vector::planar(component(0), component(1));
        let inertia = sum(&|part| &part.inertia + &part.mass * square(&(&part.centre - &centre)));
        Self { mass, centre, inertia }
    }

    /// Moment of inertia about another point of the body, kg m^2.
    pub(crate) fn inertia_about(&self, point: &Vector) -> Expr {
        &self.inertia + &self.mass * square(&(&self.centre - point))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parameters::Parameters;
    use crate::{Body, Shape};
    use tumble_expr::units::{KG, M};

    fn at(x: f64, y: f64) -> Vector {
        Vector::planar(x * M, y * M)
    }

    fn numbers(parts: Vec<(Shape, f64)>) -> [f64; 4] {
        let parts = parts.into_iter().map(|(shape, mass)| Part { shape, mass: mass * KG }).collect();
        let properties = Body::from_parts("body", parts).mass_properties();
        let formulas = [&properties.mass, properties.centre.x(), properties.centre.y(), &properties.inertia];
        let values = Parameters::default().evaluate(&formulas.map(Clone::clone)).expect("numbers");
        [values[0], values[1], values[2], values[3]]
    }

    fn close(found: [f64; 4], expected: [f64; 4]) {
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-14 * expected.abs().max(1.0), "{found} is not {expected}");
        }
    }

    #[test]
    fn simple_shapes() {
        let centre = at(1.0, 2.0);
        let r = 3.0 * M;
        let round = |shape: Shape| numbers(vec![(shape, 2.0)]);
        close(round(Shape::Disk { centre: centre.clone(), radius: r.clone() }), [2.0, 1.0, 2.0, 9.0]);
        close(round(Shape::Ring { centre: centre.clone(), radius: r.clone() }), [2.0, 1.0, 2.0, 18.0]);
        close(round(Shape::Ball { centre: centre.clone(), radius: r.clone() }), [2.0, 1.0, 2.0, 7.2]);
        close(round(Shape::Shell { centre: centre.clone(), radius: r }), [2.0, 1.0, 2.0, 12.0]);
        close(round(Shape::Point { at: centre.clone() }), [2.0, 1.0, 2.0, 0.0]);
        close(
            round(Shape::Rod { from: at(1.0, 0.0), to: at(1.0, 4.0), end_radius: Expr::zero() }),
            [2.0, 1.0, 2.0, 32.0 / 12.0],
        );
        let plate = Shape::Box { centre, width: 3.0 * M, height: 4.0 * M };
        close(round(plate), [2.0, 1.0, 2.0, 50.0 / 12.0]);
    }

    #[test]
    fn a_polygon_is_the_box_it_draws() {
        for corners in
            [vec![(0., 0.), (3., 0.), (3., 4.), (0., 4.)], vec![(0., 4.), (3., 4.), (3., 0.), (0., 0.)]]
        {
            let corners = corners.into_iter().map(|(x, y)| at(x + 100.0, y - 50.0)).collect();
            close(numbers(vec![(Shape::Polygon { corners }, 2.0)]), [2.0, 101.5, -48.0, 50.0 / 12.0]);
        }
    }

    #[test]
    fn a_polygon_of_many_corners_is_nearly_a_disk() {
        let n = 1000;
        let angle = |i: i32| std::f64::consts::TAU * f64::from(i) / f64::from(n);
        let corners = (0..n).map(|i| at(angle(i).cos(), angle(i).sin())).collect();
        let found = numbers(vec![(Shape::Polygon { corners }, 2.0)]);
        assert!((found[3] - 1.0).abs() < 2e-5, "{found:?}");
    }

    #[test]
    fn halves_make_the_whole() {
        let rod = |from: f64, to: f64, m: f64| {
            let end_radius = Expr::zero();
            (Shape::Rod { from: at(from, 0.0), to: at(to, 0.0), end_radius }, m)
        };
        let whole = numbers(vec![rod(-1.0, 3.0, 4.0)]);
        close(numbers(vec![rod(-1.0, 1.0, 2.0), rod(1.0, 3.0, 2.0)]), whole);
        // A hole is a part of negative mass.
        close(numbers(vec![rod(-1.0, 5.0, 6.0), rod(3.0, 5.0, -2.0)]), whole);
    }

    #[test]
    fn two_points_make_a_dumbbell() {
        // Two equal points at distance 2a from each other: I = 2 m a^2.
        let point = |x: f64| (Shape::Point { at: at(x, 0.0) }, 1.5);
        close(numbers(vec![point(-2.0), point(4.0)]), [3.0, 1.0, 0.0, 27.0]);
    }
}
