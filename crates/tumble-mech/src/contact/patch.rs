//! Friction that several points of a body have together, told point by point.
//!
//! Points that slip alike are on one line along a surface, so that only the sum of their friction moves anything, and one of them is given it all:
//! perhaps more than Coulomb's law lets it have, or where it does not press. What each has is not determined while they stick; it is told as the
//! normal forces share the load, `f_i = f N_i / sum N`, with which every point is within its cone where one can be.

use tumble_expr::units::N;
use tumble_expr::{Expr, Relation};

use super::grip::Grip;
use crate::equations::Equations;
use crate::link::TermOf;
use crate::mode::Mode;
use crate::term::Term;

impl Equations {
    /// The terms that act in a mode, each with what it is and whether it keeps a row, with friction of what sticks at several points shared
    /// by them.
    pub(crate) fn acting_with_shares(&self, mode: &Mode) -> Vec<(TermOf, bool, Term)> {
        let sharing: Vec<(usize, Vec<usize>)> = mode
            .sticking()
            .filter(|pair| !self.pairs()[*pair].is_rolling())
            .map(|stuck| (stuck, self.together(stuck, mode)))
            .filter(|(_, together)| together.len() > 1)
            .collect();
        let is_shared = |of: &TermOf| matches!(of, TermOf::Friction(pair, _) if sharing.iter().any(|(stuck, _)| stuck == pair));
        let own = self.acting_terms(mode).filter(|(of, _)| !is_shared(of));
        let shares = sharing.iter().flat_map(|(stuck, together)| self.shares(*stuck, together));
        own.map(|(of, keeps)| (of, keeps, self.term(of).clone())).chain(shares).collect()
    }

    /// What each of the points that stick together has of the friction of one.
    fn shares(&self, stuck: usize, together: &[usize]) -> Vec<(TermOf, bool, Term)> {
        let normals = |pair: &usize| Expr::from(self.pairs()[*pair].force_symbol());
        let all = together.iter().map(normals).fold(0 * N, |sum, next| sum + next);
        let friction = Expr::from(self.pairs()[stuck].friction_symbol());
        let share = |pair: &usize| {
            let pressed = Expr::compare(Relation::Less, Expr::zero(), &all / (1 * N));
            let otherwise = if *pair == stuck { friction.clone() } else { 0 * &friction };
            Expr::select(pressed, &friction * normals(pair) / &all, otherwise)
        };
        let of = |pair: &usize| {
            let (share, tangent) = (share(pair), self.pairs()[*pair].tangent());
            let sides = self.pair_list().friction_terms(*pair).iter().zip([1, -1]).enumerate();
            let of_side = |(side, (term, sign)): (usize, (&Term, i32))| {
                let term = Term { force: sign * &share * &tangent, ..term.clone() };
                (TermOf::Friction(*pair, side), true, term)
            };
            sides.map(of_side).collect::<Vec<_>>()
        };
        together.iter().flat_map(of).collect()
    }

    /// The pairs that stick with one, itself included.
    fn together(&self, stuck: usize, mode: &Mode) -> Vec<usize> {
        let alike = |pair: usize| self.pairs()[pair].slips_with(pair);
        let sticks = mode.grips.iter().filter(|(_, grip)| matches!(grip, Grip::Sticks | Grip::Follows));
        let own = alike(stuck);
        sticks.map(|(pair, _)| *pair).filter(|pair| alike(*pair) == own).collect()
    }
}
