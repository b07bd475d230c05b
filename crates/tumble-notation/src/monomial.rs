//! What a formula is a multiple of.

use num_traits::One;
use tumble_expr::{Exponent, Expr};

use crate::algebra::{Algebra, Factor, Form, Imported};
use crate::rational::Rational;

/// The numbers and powers of symbols that a formula is a multiple of: `m L^2/12` of `m L^2/12 + m L^2/4 sin(theta)^2`.
///
/// `None` where the formula carries a mistake or is too large.
pub fn monomial_of(formula: &Expr) -> Option<Expr> {
    let mut algebra = Algebra::default();
    let id = algebra.import(&mut Imported::default(), formula).ok()?;
    let product = algebra.raw_product(Rational::one(), &[(id, Exponent::one())]);
    let (by, _) = algebra.split(product);
    let is_plain =
        |(part, _): &Factor| matches!(algebra.form(*part), Form::Symbol(_) | Form::Pi | Form::Unit(_));
    let plain: Vec<Factor> = algebra.factors(product).into_iter().filter(is_plain).collect();
    let monomial = algebra.raw_product(by, &plain);
    algebra.check().ok()?;
    Some(algebra.export(monomial))
}

#[cfg(test)]
mod tests {
    use super::*;
    use tumble_expr::Dimension;

    #[test]
    fn a_monomial_is_what_all_terms_share() {
        let [m, l] =
            [("m", Dimension::MASS), ("L", Dimension::LENGTH)].map(|(name, of)| Expr::symbol(name, of));
        let sine = Expr::symbol("theta", Dimension::NONE).sin();
        let shared = &m * &l * &l / 12;
        let whole = &shared + &shared * (3 * &sine * &sine);
        let found = monomial_of(&whole).expect("a formula");
        let text = |formula: &Expr| crate::Notation::new().formula(formula).expect("short").text();
        assert_eq!(text(&found), text(&shared));
        assert_eq!(text(&monomial_of(&(1 + &sine)).expect("a formula")), "1");
    }
}
