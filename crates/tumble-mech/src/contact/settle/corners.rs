//! A corner on a corner: a little to one side one edge's normal counts, to the other another's.

use std::collections::BTreeSet;

use tumble_expr::Expr;
use tumble_ode::Reason;

use super::{Lasting, STANDS, Settling, Touched};
use crate::contact::pair::Rule;
use crate::mode::Mode;
use crate::record::Jump;

/// Two contacts are at one point if they are nearer than this part of the extent of a body.
const ONE_POINT: f64 = 1e-9;
/// Sine of the angle from which on two normals are two.
const TWO_WAYS: f64 = 1e-6;
/// Two are on a common floor if both are nearer to it than this part of the extent of a body: bounces that are about to end are lower, and
/// what they do not decide on it they do not decide above it.
const ON_IT: f64 = 1e-6;

impl Settling<'_> {
    /// A corner that slides along an edge passes over the end at which the next edge begins; refused is one that strikes a corner in
    /// the air: nothing says which way they push.
    pub(super) fn pass_corners(&mut self, jump: &Jump<Mode>) -> Result<(), Reason> {
        let closes = |position: &usize| self.touch.rate[*position] < -STANDS * self.speed[*position];
        if !self.part.iter().any(closes) {
            return Ok(());
        }
        let mut passed = vec![];
        for [one, other] in self.on_corners(&self.part, jump)? {
            match [one, other].map(|position| closes(&position)) {
                [true, true] if !self.are_on_one_floor(one) => return Err(self.corner_on_corner(one, other)),
                [true, false] => passed.push(one),
                [false, true] => passed.push(other),
                // On a common floor corners meet by themselves, and both edges push.
                [true, true] | [false, false] => {}
            }
        }
        self.pass_by(passed);
        Ok(())
    }

    /// Lets these contacts have no part in what happens at this instant.
    fn pass_by(&mut self, some: Vec<usize>) {
        self.part.retain(|position| !some.contains(position));
        self.beyond.extend(some);
    }

    /// Drops contacts that were to last though the motion takes them beyond the ends of their edges; whether there are any. The places that one corner
    /// cannot take, seen from the other body, end in a convex corner with a face for each of the two contacts. Along either face the other contact's gap
    /// becomes negative, and counts for nothing there. Where it opens while the first stands, the motion has left the first's face, whose
    /// push would hold back what nothing holds.
    pub(super) fn pass_ends(
        &mut self,
        lasting: &Lasting,
        touched: &Touched,
        jump: &Jump<Mode>,
    ) -> Result<bool, Reason> {
        let held: Vec<usize> = lasting.modes.iter().map(|(position, _)| *position).collect();
        let opens = |position: &usize| {
            let moves = self.touch.rate[*position] > 0.0 && !self.stands(*position);
            let begins_to = self.stands(*position) && self.then[*position] > self.zero();
            (moves || begins_to) && !held.contains(position) && self.may_touch(*position, touched)
        };
        let opening: Vec<usize> = (0..self.touch.pairs.len()).filter(opens).collect();
        if held.is_empty() || opening.is_empty() {
            return Ok(false);
        }
        let couples = self.on_corners(&[held, opening.clone()].concat(), jump)?;
        let beyond = couples.into_iter().filter_map(|[one, other]| {
            match [one, other].map(|position| opening.contains(&position)) {
                [true, false] => Some(other),
                [false, true] => Some(one),
                [true, true] | [false, false] => None,
            }
        });
        let beyond: Vec<usize> = beyond.collect();
        let is_any = !beyond.is_empty();
        self.pass_by(beyond);
        Ok(is_any)
    }

    /// Contacts of the same two, of some, at one point with two normals.
    fn on_corners(&self, some: &[usize], jump: &Jump<Mode>) -> Result<Vec<[usize; 2]>, Reason> {
        let pair = |position: &usize| &self.equations.pairs()[self.touch.pairs[*position]];
        let is_sharp = |position: &usize| pair(position).has_edge() && !pair(position).is_round();
        let sharp: Vec<usize> = some.iter().copied().filter(is_sharp).collect();
        let couples = (0..sharp.len()).flat_map(|i| (0..i).map(move |j| [j, i]));
        let are_of_two = |couple: &[usize; 2]| {
            let [a, b] = couple.map(|index| pair(&sharp[index]));
            (a.rule, a.body, a.other) == (b.rule, b.body, b.other)
        };
        let couples: Vec<[usize; 2]> = couples.filter(are_of_two).collect();
        if couples.is_empty() {
            return Ok(vec![]);
        }
        let of = |position: &usize| {
            [pair(position).point().components(), pair(position).normal.components()].concat()
        };
        let formulas: Vec<Expr> = sharp.iter().flat_map(of).collect();
        let values =
            self.equations.values(&formulas, &jump.mode, self.now.time, &jump.states, self.now.inputs)?;
        let is_one = |couple: &[usize; 2]| {
            let [a, b] = couple.map(|index| &values[4 * index..4 * index + 4]);
            let apart = libm::hypot(a[0] - b[0], a[1] - b[1]);
            apart <= ONE_POINT * self.touch.size && (a[2] * b[3] - a[3] * b[2]).abs() > TWO_WAYS
        };
        Ok(couples.into_iter().filter(is_one).map(|couple| couple.map(|index| sharp[index])).collect())
    }

    /// Whether the two of a contact both touch another body or a surface, or are as good as on it.
    fn are_on_one_floor(&self, position: usize) -> bool {
        let pair = |position: usize| &self.equations.pairs()[self.touch.pairs[position]];
        let is_near = |own: &usize| self.touch.gap[*own] <= ON_IT * self.touch.size;
        let near: Vec<usize> = (0..self.touch.pairs.len()).filter(is_near).collect();
        // A surface by its rule, a body by its index.
        let under = |body: usize| -> BTreeSet<(Option<Rule>, Option<usize>)> {
            let own = near.iter().map(|own| pair(*own)).filter(|own| own.has(body));
            own.map(|own| match own.other {
                None => (Some(own.rule), None),
                Some(other) => (None, Some(if own.body == body { other } else { own.body })),
            })
            .collect()
        };
        let struck = pair(position);
        struck.other.is_some_and(|other| !under(struck.body).is_disjoint(&under(other)))
    }

    fn corner_on_corner(&self, one: usize, other: usize) -> Reason {
        let [one, other] =
            [one, other].map(|position| &self.equations.pairs()[self.touch.pairs[position]].name);
        Reason::Model(format!(
            "`{one}` and `{other}` strike at one point, a corner on a corner: which way they push there is not determined. Let the corners \
             miss each other by a little"
        ))
    }
}
