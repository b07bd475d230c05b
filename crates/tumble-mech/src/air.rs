//! The air around the bodies: its velocity at every place and time.

use tumble_expr::{Expr, Substitution, Vector, is_identically_zero};

use crate::anchor::place_symbols;

/// Velocity of the air, m/s, world axes, as a formula of the time and of the place, whose symbols are
/// [`place_symbols`].
#[derive(Clone, Debug)]
pub struct Wind(pub Vector);

impl Wind {
    /// Air at rest.
    pub fn still() -> Self {
        Self(Vector::planar(Expr::zero(), Expr::zero()))
    }

    /// Velocity at a place, m/s.
    pub fn at(&self, place: &Vector) -> Vector {
        let mut here = Substitution::default();
        for (symbol, formula) in place_symbols().into_iter().zip(place.components()) {
            here.insert(symbol, formula.clone());
        }
        self.0.map(|component| here.apply(component))
    }

    /// Whether its velocity changes linearly from place to place, or not at all.
    pub fn is_affine(&self) -> bool {
        let [x, y] = place_symbols();
        let second = |component: &Expr, a, b| is_identically_zero(&component.derivative(a).derivative(b));
        let affine = |component: &Expr| {
            second(component, &x, &x) && second(component, &x, &y) && second(component, &y, &y)
        };
        // A branch may change its sign along a line: each sign alone says nothing of the whole.
        let smooth = |component: &Expr| !component.branches_on(&[x.clone(), y.clone()]);
        self.0.components().iter().all(|component| smooth(component) && affine(component))
    }
}
