//! Friction that several points of a body have together, told point by point.
//!
//! Points that slip alike are on one line along a surface, so that only the sum of their friction moves anything, and one of them is given it all:
//! perhaps more than Coulomb's law lets it have, or where it does not press. What each has is not determined while they stick; it is told as the
//! normal forces share the load, `f_i = f N_i / sum N`, with which every point is within its cone where one can be.

use tumble_expr::units::N;
use tumble_expr::{Expr, Relation};

use super::grip::Grip;
use crate::equations::Equations;
use crate::mode::Mode;
use crate::term::{Law, Term};

impl Equations {
    /// The terms that act in a mode, with friction of what sticks at several points shared by them.
    pub(crate) fn acting_with_shares(&self, mode: &Mode) -> Vec<Term> {
        let mut terms: Vec<Term> = self.acting(mode).into_iter().cloned().collect();
        for stuck in mode.sticking().filter(|pair| !self.pairs()[*pair].is_rolling()) {
            let together = self.together(stuck, mode);
            if together.len() < 2 {
                continue;
            }
            let normals = |pair: &usize| Expr::from(self.pairs()[*pair].force_symbol());
            let all = together.iter().map(normals).reduce(|sum, next| sum + next);
            let Some(all) = all else { continue };
            let friction = Expr::from(self.pairs()[stuck].friction_symbol());
            let whole = self.pair_list().friction_terms(stuck);
            terms
                .retain(|term| !(term.law == Law::Friction && whole.iter().any(|own| own.load == term.load)));
            for pair in &together {
                let pressed = Expr::compare(Relation::Less, Expr::zero(), &all / (1 * N));
                let share = &friction * normals(pair) / &all;
                let otherwise = if *pair == stuck { friction.clone() } else { 0 * &friction };
                let share = Expr::select(pressed, share, otherwise);
                let sides = self.pair_list().friction_terms(*pair).iter().zip([1, -1]);
                let tangent = self.pairs()[*pair].tangent();
                terms.extend(
                    sides.map(|(term, sign)| Term { force: sign * &share * &tangent, ..term.clone() }),
                );
            }
        }
        terms
    }

    /// The pairs that stick with one, itself included.
    fn together(&self, stuck: usize, mode: &Mode) -> Vec<usize> {
        let alike = |pair: usize| self.pairs()[pair].slips_with(pair);
        let sticks = mode.grips.iter().filter(|(_, grip)| matches!(grip, Grip::Sticks | Grip::Follows));
        let own = alike(stuck);
        sticks.map(|(pair, _)| *pair).filter(|pair| alike(*pair) == own).collect()
    }
}
