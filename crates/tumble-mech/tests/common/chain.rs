//! Chains, for tests and benchmarks.

use tumble_expr::units::{KG, M, S};
use tumble_expr::{Expr, Vector};
use tumble_mech::{Anchor, Body, Gravity, Joint, Model, Start};

/// m/s^2
pub(crate) const G: f64 = 9.81;

/// A named point of a body.
pub(crate) fn named(body: &Body, point: &str) -> Anchor {
    Anchor::Material(body.named_point(point).expect("given"))
}

/// Uniform rods of 1 m that hang from the origin, each pinned to the one before, each at its angle from straight down and with its
/// mass, kg, by its number.
pub(crate) fn chain(angles: impl IntoIterator<Item = f64>, mass: fn(usize) -> i32) -> (Model, Vec<Body>) {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(G * M / (S * S));
    let mut bodies: Vec<Body> = vec![];
    for (index, angle) in angles.into_iter().enumerate() {
        let rod = Body::rod(format!("rod{index}"), [0 * M, 0 * M], [0 * M, -1 * M]).mass(mass(index) * KG);
        let rod = rod.with_point("top", [0 * M, 0 * M]).with_point("tip", [0 * M, -1 * M]);
        let body = model.add(rod);
        let above = match bodies.last() {
            None => Anchor::World(Vector::planar(0 * M, 0 * M)),
            Some(above) => named(above, "tip"),
        };
        model.join(Joint::pin(format!("joint{index}"), [above, named(&body, "top")]));
        model.starts.push((body.name.clone(), Start::default().angle(Expr::from(angle))));
        bodies.push(body);
    }
    (model, bodies)
}
