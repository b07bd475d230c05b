//! Bodies that may meet, while they are motions of their own: where they are shown to be apart.
//!
//! Circles about them are looked at up to a *horizon*, by the ranges of their centres up to there: those that come near each other then are
//! watched more finely. It goes further once all motions have come to it, by as much as leaves few of them near each other.

use std::collections::HashSet;

use tumble_ode::Piece;

use super::start::Places;
use super::watch::Along;
use crate::contact::{Circles, Surrounding, meeting, meeting_within};
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

/// Where bodies are that may meet, and how far ahead that has been looked at.
pub(super) struct Near<'a> {
    equations: &'a Equations,
    /// Of those that may meet bodies of other groups.
    circles: Circles,
    /// s
    pub(super) horizon: f64,
    /// By how much it went further last, s.
    span: f64,
    until: f64,
}

impl<'a> Near<'a> {
    /// Of the bodies of some groups, as they are at the start.
    pub(super) fn of(equations: &'a Equations, groups: &[usize], places: &Places<'_>, until: f64) -> Self {
        let start = places.start();
        let group = |body: usize| equations.components().group_of(body);
        let is_own = |body: usize| groups.binary_search(&group(body)).is_ok();
        let couples = equations.pair_list().couples.iter();
        let couples = couples.filter(|[a, b]| groups.len() > 1 && is_own(*a) && group(*a) != group(*b));
        let bodies = couples.flatten().copied();
        let instant = (start.time, &start.states[..]);
        let circles = Circles::of(equations, bodies, &start.mode, instant, &start.inputs);
        let horizon = if circles.is_empty() { f64::INFINITY } else { start.time };
        Self { equations, circles, horizon, span: until - start.time, until }
    }

    /// Whether any bodies may meet.
    pub(super) fn has_any(&self) -> bool {
        !self.circles.is_empty()
    }

    /// Circles of the bodies of a mode from one time to another along a piece.
    pub(super) fn along(&self, mode: &Mode, piece: &Piece, between: [f64; 2]) -> Vec<Surrounding> {
        if !self.has_any() {
            return vec![];
        }
        let mut ranges = vec![];
        piece.ranges_between(between, &mut ranges);
        self.circles.within(self.equations, mode, |state| ranges[state])
    }

    /// The same at an instant.
    pub(super) fn at(&self, mode: &Mode, states: &[f64]) -> Vec<Surrounding> {
        self.circles.at(self.equations, mode, states)
    }

    /// Bodies of two lists that may meet and are not shown to be apart, the lesser first.
    pub(super) fn meeting<'b>(
        &'b self,
        some: &'b [Surrounding],
        others: &'b [Surrounding],
    ) -> impl Iterator<Item = [usize; 2]> + 'b {
        meeting(some, others, &self.equations.pair_list().couples)
    }

    /// Whether two bodies are apart from one time to another, along what their islands do next.
    pub(super) fn are_apart(&self, [a, b]: [usize; 2], along: &[Along], between: [f64; 2]) -> bool {
        let circles = along.iter().flat_map(|Along { mode, piece }| self.along(mode, piece, between));
        let circles: Vec<Surrounding> = circles.collect();
        let of = |body: usize| circles.iter().find(|circle| circle.body == body);
        of(a).zip(of(b)).is_some_and(|(a, b)| a.is_apart(b))
    }

    /// Longest step of bodies that may part, s.
    pub(super) fn stride(&self) -> f64 {
        self.span * STRIDE
    }

    /// Joins the parts whose bodies may meet and are not shown to be apart.
    pub(super) fn join(&self, circles: &[Surrounding], parts: &[Vec<usize>], sets: &mut Sets) {
        let part = |body: usize| {
            let group = self.equations.components().group_of(body);
            parts.iter().position(|groups| groups.binary_search(&group).is_ok())
        };
        for [a, b] in self.all_meeting(circles) {
            part(a).zip(part(b)).into_iter().for_each(|(a, b)| sets.join(a, b));
        }
    }

    /// All bodies of a list that may meet and are not shown to be apart.
    pub(super) fn all_meeting(&self, circles: &[Surrounding]) -> HashSet<[usize; 2]> {
        meeting_within(circles, &self.equations.pair_list().couples)
    }

    /// Takes the horizon further; `circles` says where the bodies are from there up to a time, s.
    pub(super) fn go_further(&mut self, circles: &impl Fn(&Self, f64) -> Vec<Surrounding>) {
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
