//! Motions that are polynomials in time, as formulas.

use num_rational::BigRational;
use tumble_expr::{Expr, Substitution, Symbol};

use crate::algebra::{Algebra, Imported, Leaf};

/// Position and velocity as formulas of the time since a phase began.
#[derive(Clone, Debug)]
pub struct ClosedForm {
    /// The integral of the velocity, with the position at the start.
    pub position: Expr,
    /// The integral of the acceleration, with the velocity at the start.
    pub velocity: Expr,
}

/// Coefficients of a formula as a polynomial in a symbol, from the constant one on, each in its short form.
///
/// `None` where exact algebra does not show it to be one, where its degree is above 16, and where the formula carries a
/// mistake or is too large.
pub fn polynomial_in(formula: &Expr, symbol: &Symbol) -> Option<Vec<Expr>> {
    let mut algebra = Algebra::default();
    let mut imported = Imported::default();
    let leaf = algebra.leaf(Leaf {
        name: symbol.name.to_string(),
        dimension: symbol.dimension,
        positive: false,
        definition: None,
    });
    let id = algebra.import(&mut imported, formula).ok()?;
    let coefficients = algebra.coefficients(id, leaf)?;
    algebra.check().ok()?;
    Some(coefficients.into_iter().map(|id| algebra.export(id)).collect())
}

/// Integrates an acceleration that is a polynomial in the time since a phase began, from a position and a velocity.
///
/// The acceleration is a formula of `time`, which was `start` when the phase began; the result is one of `elapsed`, the
/// time since. `None` where [`polynomial_in`] is.
pub fn integrate_twice(
    acceleration: &Expr,
    (time, start): (&Symbol, &Expr),
    elapsed: &Symbol,
    (position, velocity): (&Expr, &Expr),
) -> Option<ClosedForm> {
    let s = Expr::from(elapsed.clone());
    let mut shifted = Substitution::default();
    shifted.insert(time.clone(), start + &s);
    let coefficients = polynomial_in(&shifted.apply(acceleration), elapsed)?;
    let mut motion = ClosedForm { position: position + velocity * &s, velocity: velocity.clone() };
    for (degree, coefficient) in (0..).zip(coefficients) {
        let power = |degree: i32| if degree == 1 { s.clone() } else { s.powi(degree) };
        let once = over(&coefficient, degree + 1);
        motion.position = motion.position + over(&once, degree + 2) * power(degree + 2);
        motion.velocity = motion.velocity + once * power(degree + 1);
    }
    Some(motion)
}

fn over(formula: &Expr, divisor: i32) -> Expr {
    formula * Expr::number(BigRational::new(1.into(), divisor.into()))
}
