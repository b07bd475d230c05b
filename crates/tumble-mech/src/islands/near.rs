//! Bodies that may meet, while they are motions of their own: where they are shown to be apart.
//!
//! Circles about them are looked at up to a *horizon*, by the ranges of their centres up to there: those that come near each other then are
//! watched more finely. It goes further once all motions have come to it, by as much as leaves few of them near each other.

use std::collections::HashSet;

use tumble_ode::Piece;

use super::start::Places;
use super::watch::Along;
use crate::contact::{Circles, Stretch};
use crate::equations::Equations;
use crate::mode::Mode;
use crate::sets::Sets;

/// So many pairs a body may be near each other within a horizon, beside those that are at its start.
const FEW: usize = 2;
/// And so many whatever the number of bodies.
const FEWEST: usize = 8;
/// The horizon is not nearer than this part of the run: what is near each other all along is not told apart by it.
const NEAREST: f64 = 1e-9;
/// Bodies that meet and part again take steps of this part of a horizon.
const STRIDE: f64 = 1.0 / 8.0;

/// Which bodies may meet, where they are, and how far ahead that has been looked at.
pub(super) struct Near {
    /// Of those that may meet others.
    circles: Circles,
    /// The lesser body first.
    meets: HashSet<[usize; 2]>,
    /// s
    pub(super) horizon: f64,
    /// By how much it went further last, s.
    span: f64,
    until: f64,
}

impl Near {
    /// Of the bodies of some groups, as they are at the start.
    pub(super) fn of(equations: &Equations, groups: &[usize], places: &Places<'_>, until: f64) -> Self {
        let start = places.start();
        let group = |body: usize| equations.components().group_of(body);
        let is_own = |body: usize| groups.binary_search(&group(body)).is_ok();
        let ends = equations.pairs().iter().filter_map(|pair| Some([pair.body, pair.other?]));
        let meets = ends.filter(|[a, b]| is_own(*a) && is_own(*b) && group(*a) != group(*b));
        let meets: HashSet<[usize; 2]> = meets.map(|[a, b]| [a.min(b), a.max(b)]).collect();
        let instant = (start.time, &start.states[..]);
        let bodies = meets.iter().flatten().copied();
        let circles = Circles::of(equations, bodies, &start.mode, instant, &start.inputs);
        let horizon = if meets.is_empty() { f64::INFINITY } else { start.time };
        Self { circles, meets, horizon, span: until - start.time, until }
    }

    /// Circles of the bodies of a mode from one time to another along a piece.
    pub(super) fn along(
        &self,
        equations: &Equations,
        mode: &Mode,
        piece: &Piece,
        between: [f64; 2],
    ) -> Vec<Stretch> {
        let mut ranges = vec![];
        if self.circles.has_any(mode) {
            piece.ranges_between(between, &mut ranges);
        }
        self.circles.within(equations, mode, |state| ranges[state])
    }

    /// The same at an instant.
    pub(super) fn at(&self, equations: &Equations, mode: &Mode, states: &[f64]) -> Vec<Stretch> {
        self.circles.at(equations, mode, states)
    }

    /// Bodies of two lists that may meet and are not shown to be apart, the lesser first.
    pub(super) fn meeting<'a>(
        &'a self,
        some: &'a [Stretch],
        others: &'a [Stretch],
    ) -> impl Iterator<Item = [usize; 2]> + 'a {
        let both = some.iter().flat_map(move |one| others.iter().map(move |other| (one, other)));
        let near = both.filter(|(one, other)| !one.is_apart(other));
        let bodies = near.map(|(one, other)| [one.body.min(other.body), one.body.max(other.body)]);
        bodies.filter(|bodies| self.meets.contains(bodies))
    }

    /// Whether two bodies are apart from one time to another, along what their islands do next.
    pub(super) fn are_apart(
        &self,
        equations: &Equations,
        [a, b]: [usize; 2],
        along: &[Along],
        between: [f64; 2],
    ) -> bool {
        let circles: Vec<Stretch> = along
            .iter()
            .flat_map(|Along { mode, piece }| self.along(equations, mode, piece, between))
            .collect();
        let of = |body: usize| circles.iter().find(|circle| circle.body == body);
        of(a).zip(of(b)).is_some_and(|(a, b)| a.is_apart(b))
    }

    /// Longest step of bodies that may part, s.
    pub(super) fn stride(&self) -> f64 {
        self.span * STRIDE
    }

    /// Joins the parts whose bodies may meet and are not shown to be apart.
    pub(super) fn join(
        &self,
        equations: &Equations,
        circles: &[Stretch],
        parts: &[Vec<usize>],
        sets: &mut Sets,
    ) {
        let part = |body: usize| {
            let group = equations.components().group_of(body);
            parts.iter().position(|groups| groups.binary_search(&group).is_ok())
        };
        for (index, circle) in circles.iter().enumerate() {
            for [a, b] in self.meeting(std::slice::from_ref(circle), &circles[index + 1..]) {
                part(a).zip(part(b)).into_iter().for_each(|(a, b)| sets.join(a, b));
            }
        }
    }

    /// All bodies of islands that may meet and are not shown to be apart.
    pub(super) fn all_meeting(&self, islands: &[Vec<Stretch>]) -> HashSet<[usize; 2]> {
        let each = islands.iter().enumerate();
        each.flat_map(|(index, one)| {
            islands[index + 1..].iter().flat_map(|other| self.meeting(one, other).collect::<Vec<_>>())
        })
        .collect()
    }

    /// Takes the horizon further; `circles` says where the bodies of islands are from there up to a time, s.
    pub(super) fn go_further(&mut self, circles: &impl Fn(&Self, f64) -> Vec<Vec<Stretch>>) {
        let from = self.horizon;
        let near = |known: &Self, to: f64| known.all_meeting(&circles(known, to)).len();
        let most = near(self, from) + FEW * self.circles.count() + FEWEST;
        let least = NEAREST * self.until.abs();
        self.span = (2.0 * self.span).min(self.until - from);
        while self.span > least && near(self, from + self.span) > most {
            self.span *= 0.5;
        }
        let to = from + self.span;
        self.horizon = if to >= self.until || to <= from { f64::INFINITY } else { to };
    }
}
