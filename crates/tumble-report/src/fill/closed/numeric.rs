//! Stretches whose motion was found as polynomials in time, with the numbers of one run: what contacts and joints hold has no formula of
//! its own here, and moves as simply.

use std::ops::Range;

use tumble_expr::{Dimension, Symbol, is_identically_zero};
use tumble_mech::Run;
use tumble_notation::Math;
use tumble_ode::Piece;
use tumble_scene::Study;

use super::{Coordinate, coordinates, elapsed_since, from_to, is_jump, line};
use crate::fill::names::{Names, math, quantity};
use crate::fill::words;
use crate::report::{Block, Definition, Phase, Text, Typeset};
use crate::results::{Case, CaseError};

/// Of more bodies the numbers are in the tables.
const MOST_BODIES: usize = 3;
/// Coefficients of the highest power of the time that is read, and those before.
const MOST_POWERS: usize = 5;
/// Those of an acceleration that does not change.
const UNIFORM: usize = 3;
/// Part of the run that a stretch lasts whose powers may be compared with rounding: in a short one any motion is uniform.
const LASTS: f64 = 0.01;
/// What a power of the time adds over the whole stretch to a coordinate, in parts of the largest there is: less is rounding.
const ROUNDING: f64 = 1e-13;

/// A stretch of a motion between two instants at which it changes.
pub(super) struct Between<'r> {
    /// Its number among those that last.
    number: usize,
    pub(super) pieces: Vec<&'r Piece>,
    /// Whether something ends it before the run does.
    ends: bool,
    pub(super) until: f64,
}

impl Between<'_> {
    pub(super) fn length(&self) -> f64 {
        self.until - self.pieces[0].start
    }

    /// Whether its first piece says all of it: as it was found, or, where equations have more in them than comes of it, to rounding; a box on a
    /// slope does not turn.
    fn is_polynomial(&self, end: f64) -> bool {
        let states = &self.pieces[0].states;
        let is_short = states.iter().all(|row| row.len() <= MOST_POWERS);
        let is_uniform = |row: &[f64]| !has_powers(&without_rounding(row, self.length()), UNIFORM);
        let is_simple = is_short || (self.length() >= LASTS * end && states.iter().all(is_uniform));
        let moves = states.iter().any(|row| has_powers(&without_rounding(row, self.length()), 1));
        moves && is_simple && self.pieces.iter().all(|piece| piece.time_series.is_none()) && self.goes_on()
    }

    /// Whether the other pieces go on as the first does.
    fn goes_on(&self) -> bool {
        let (first, last) = (self.pieces[0], self.pieces[self.pieces.len() - 1]);
        let later = last.start - first.start + last.length;
        let at = |row: &[f64], time: f64| row.iter().rev().fold(0.0, |sum, part| sum * time + part);
        let is_same = |(one, other): (&[f64], &[f64])| {
            let most = one.iter().enumerate().map(|(power, part)| part.abs() * later.powi(power as i32));
            (at(one, later) - at(other, last.length)).abs() <= ROUNDING * most.fold(0.0, f64::max)
        };
        first.states.len() == last.states.len() && first.states.iter().zip(last.states.iter()).all(is_same)
    }
}

/// Of the first stretches those in which something moves, as polynomials in time.
pub(super) fn stretches(run: &Run, most: usize) -> Vec<Between<'_>> {
    let trajectory = run.trajectory();
    let changes = trajectory
        .events
        .iter()
        .filter(|event| event.mode_before != event.mode_after || event.record.happened.iter().any(is_jump));
    let mut begins: Vec<f64> = std::iter::once(0.0).chain(changes.map(|event| event.time)).collect();
    begins.dedup();
    let end = run.end().unwrap_or(0.0);
    let ends = begins.iter().skip(1).copied().chain([end]);
    let each = begins.iter().zip(ends).filter(|(from, until)| *from < until).enumerate().take(most);
    let found = each.filter_map(|(number, (from, until))| {
        let is_within = |piece: &&Piece| piece.start < until && piece.end > *from;
        let pieces: Vec<&Piece> = trajectory.pieces.iter().filter(is_within).collect();
        let stretch = Between { number, pieces, ends: until < end, until };
        (!stretch.pieces.is_empty() && stretch.is_polynomial(end)).then_some(stretch)
    });
    found.collect()
}

/// The stretches after the first ones, which have formulas, as they are shown: so many at most.
pub(super) fn phases(
    study: &Study,
    names: &Names,
    case: &Case,
    (known, most): (usize, usize),
) -> Result<Vec<Phase>, CaseError> {
    if study.model.bodies.len() > MOST_BODIES {
        return Ok(vec![]);
    }
    let stretches = stretches(&case.run, most).into_iter().filter(|one| one.number >= known);
    stretches.map(|one| phase(study, names, case, &one)).collect()
}

fn phase(study: &Study, names: &Names, case: &Case, stretch: &Between<'_>) -> Result<Phase, CaseError> {
    let (begins, elapsed) = (stretch.pieces[0].start, Math::symbol(&elapsed_since(stretch.number)));
    let mut block = Block { lines: lines(study, names, case, stretch), ..Block::default() };
    if stretch.number > 0 {
        let since = format!("time since {}", quantity(begins, "s").to_plain());
        block.definitions.push(Definition { symbol: math(&elapsed), meaning: since.into() });
    }
    let mode = &case.run.trajectory().modes[stretch.pieces[0].mode];
    let name = Text::from(words::mode(study, &case.run.equations, mode));
    let span = from_to(begins, stretch.ends.then_some(stretch.until), stretch.ends);
    Ok(Phase { name, span, symbols: vec![], numbers: vec![block] })
}

/// Places and velocities of what moves, and of the only body also where it stays.
fn lines(study: &Study, names: &Names, case: &Case, stretch: &Between<'_>) -> Vec<Typeset> {
    let first = stretch.pieces[0];
    let states = case.run.equations.states(&case.run.trajectory().modes[first.mode]);
    let known = |symbol: &Symbol| {
        let row = states.iter().position(|state| state == symbol)?;
        Some((symbol.clone(), without_rounding(&first.states[row], stretch.length())))
    };
    let turns = |one: &Coordinate| {
        let inertia = &study.model.bodies[one.body].mass_properties().inertia;
        one.position.dimension != Dimension::NONE || !is_identically_zero(inertia)
    };
    let all = (0..study.model.bodies.len()).flat_map(|body| coordinates(study, body)).filter(turns);
    let mut both: Vec<[(Symbol, Vec<f64>); 2]> =
        all.filter_map(|one| Some([known(&one.position)?, known(&one.velocity)?])).collect();
    // What is nothing beside the others of its kind is none: where it is at first, and what it moves by.
    let kinds = [0..1, 1..MOST_POWERS];
    let size = |(power, part): (usize, &f64)| part.abs() * stretch.length().powi(power as i32);
    let largest = |symbol: &Symbol, kind: &Range<usize>| {
        let alike = both.iter().flatten().filter(|(other, _)| other.dimension == symbol.dimension);
        let of_kind =
            alike.flat_map(|(_, powers)| powers.iter().enumerate()).filter(|one| kind.contains(&one.0));
        of_kind.map(size).fold(0.0, f64::max)
    };
    let least: Vec<[f64; 2]> = both
        .iter()
        .flatten()
        .map(|(symbol, _)| kinds.each_ref().map(|kind| ROUNDING * largest(symbol, kind)))
        .collect();
    for ((_, powers), least) in both.iter_mut().flatten().zip(least) {
        let is_none = |(power, part): (usize, &f64)| size((power, part)) <= least[power.min(1)];
        *powers = powers.iter().enumerate().map(|one| if is_none(one) { 0.0 } else { *one.1 }).collect();
    }
    let is_one = study.model.bodies.len() == 1;
    let shown = both.iter().flat_map(|both| match (has_powers(&both[0].1, 1), is_one) {
        (true, _) => &both[..],
        // What does not move has no velocity.
        (false, true) => &both[..1],
        (false, false) => &[],
    });
    let elapsed = Math::symbol(&elapsed_since(stretch.number));
    shown.map(|(symbol, powers)| line(names, symbol, powers, &elapsed)).collect()
}

/// Whether it has a power of the time, or one above that.
fn has_powers(powers: &[f64], least: usize) -> bool {
    powers.iter().skip(least).any(|part| *part != 0.0)
}

/// The coefficients of a polynomial of a time, without what rounding has left of them.
pub(super) fn without_rounding(row: &[f64], length: f64) -> Vec<f64> {
    let part = |(power, value): (usize, &f64)| value.abs() * length.powi(power as i32);
    let most = row.iter().enumerate().map(part).fold(0.0, f64::max);
    row.iter().enumerate().map(|one| if part(one) <= ROUNDING * most { 0.0 } else { *one.1 }).collect()
}
