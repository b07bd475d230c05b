//! Functions whose zeros are watched along a step, with what is known of each.

use std::cell::OnceCell;

use smallvec::SmallVec;
use tumble_expr::{Row, Slot};

use super::{Demand, Stretch, VANISHES, What};
use crate::enclosure::Bounds;
use crate::engine::{Engine, Hit, ahead};
use crate::polynomial;
use crate::roots::roots;
use crate::settle::{Known, is_settled};

/// Which end of its segment an argument has come to is told from what it is, to this part of it.
const NEAR: f64 = 1e-9;

/// Something whose zeros are watched.
pub(super) struct Watched<'a> {
    pub(super) what: What,
    series: &'a [f64],
    /// What is taken from the series and the slot.
    offset: f64,
    zeros: usize,
    ends_at_zero: bool,
    sign: f64,
    /// Sum of the sizes of what it is made of, at the start of the step.
    size: f64,
    /// What has no effect along the step.
    nothing: f64,
    found: OnceCell<SmallVec<[f64; 4]>>,
}

impl<'a> Watched<'a> {
    pub(super) fn new(
        (what, series, offset): (What, &'a [f64], f64),
        size: f64,
        zeros: usize,
        is_hit: bool,
        length: f64,
    ) -> Self {
        let powers = std::iter::successors(Some(1.0), |power| Some(power * length));
        let terms: Row = series.iter().zip(powers).map(|(c, power)| c * power).collect();
        let term = |k: usize| if k == 0 { series[0] - offset } else { terms[k] };
        let largest = (0..series.len()).map(|k| term(k).abs()).fold(offset.abs() * VANISHES, f64::max);
        let counts = |k: &usize| term(*k).abs() > VANISHES * largest;
        // Of a series beyond the range of numbers nothing is read.
        let first = match largest.is_finite() {
            true => (zeros..series.len()).find(counts).unwrap_or(series.len()),
            false => zeros,
        };
        let end = polynomial::value(series, length) - offset;
        Self {
            what,
            series,
            offset,
            zeros: first,
            sign: if first < series.len() { term(first).signum() } else { 0.0 },
            ends_at_zero: is_hit || (largest.is_finite() && end.abs() <= VANISHES * largest),
            size: size + offset.abs(),
            nothing: 0.0,
            found: OnceCell::new(),
        }
    }

    pub(super) fn is_settled(&self, bounds: Bounds<'_>, [low, high]: [f64; 2], length: f64) -> bool {
        let roots = || {
            let found = self.found.get_or_init(|| {
                let mut series = Row::from_slice(self.series);
                series[0] -= self.offset;
                let crossing = roots(ahead(&series, self.zeros), length).into_iter();
                crossing.filter(|root| root.crosses_to.is_some()).map(|root| root.at).collect()
            });
            found.iter().filter(|at| low < **at && **at < high).count()
        };
        let is_first = low == 0.0;
        let known = Known {
            zeros: if is_first { self.zeros } else { 0 },
            sign: self.sign,
            ends_at_zero: high == length && self.ends_at_zero,
            roots: &roots,
            size: self.size,
            nothing: self.nothing,
        };
        is_settled(&bounds.less(self.offset), known)
    }
}

impl Engine {
    /// Functions of the tape whose zeros are watched, each with its slot.
    pub(super) fn watched<'a>(
        &self,
        step: Stretch<'a>,
        demand: &Demand<'_>,
    ) -> SmallVec<[(Slot, Watched<'a>); 4]> {
        let Stretch { expansion, length, hits } = step;
        let tape = &self.system.tape;
        let active = self.active();
        let branches = tape.guards().iter().enumerate().filter(|(branch, _)| active.branches[*branch]);
        let branches = branches.map(|(branch, slot)| {
            let is_hit = hits.iter().any(|hit| matches!(hit, Hit::Branch(hit, _) if *hit == branch));
            let zeros = usize::from(self.is_zero_branch(branch));
            (
                *slot,
                Watched::new(
                    (What::Branch(branch), &expansion.branches[branch], 0.0),
                    self.size_of(*slot),
                    zeros,
                    is_hit,
                    length,
                ),
            )
        });
        let first = self.system.len() + usize::from(self.system.transformed);
        let guards = expansion.guards.iter().enumerate().map(|(guard, series)| {
            let is_hit = hits.contains(&Hit::Guard(guard));
            let (slot, zeros) = (tape.outputs()[first + guard], self.zeros_of_guard(guard));
            let of = (What::Guard(guard), series, 0.0);
            let nothing = self.moves_nothing(guard, (expansion, length), demand.scales);
            (slot, Watched { nothing, ..Watched::new(of, self.size_of(slot), zeros, is_hit, length) })
        });
        let tables = tape.tables().iter().enumerate().filter(|(lookup, _)| active.tables[*lookup]);
        let knots = tables.flat_map(|(lookup, table)| {
            let segment = self.signs()[tape.guards().len() + lookup] as usize;
            let ends = table.table.0.ends(segment).into_iter().filter(|knot| knot.is_finite());
            let series = &expansion.arguments[lookup];
            let passes = hits.iter().any(|hit| matches!(hit, Hit::Knot(hit, _) if *hit == lookup));
            let end = polynomial::value(series, length);
            let is_near = move |knot: f64| (end - knot).abs() <= NEAR * knot.abs().max(end.abs());
            ends.map(move |knot| {
                let watched = Watched::new(
                    (What::Table(lookup), series, knot),
                    self.size_of(table.of),
                    0,
                    passes && is_near(knot),
                    length,
                );
                (table.of, watched)
            })
        });
        branches.chain(guards).chain(knots).collect()
    }
}
