//! All motions that contacts with friction allow at an instant.
//!
//! # Law
//!
//! With w what gaps and slips do, b what they would do without pushes, z the pushes and A the response, `w = b + A z`; of each contact
//! `w_n >= 0`, `z_n >= 0`, one of the two zero, and of each surface Coulomb's law (`contact/sticking`). Rigid bodies have no memory of how hard
//! they are pressed: with friction these conditions may hold for several w. A *choice* says of each contact whether it is held and of each
//! surface whether it sticks or slides, and which way. Its conditions are linear, and so is what is left open where its rows depend on each
//! other. All choices are tried, and w that differ are told apart.
//!
//! What may begin to slip is decided with static coefficients, so that what can stick does, which is a law and not a choice; how it goes on
//! follows from kinetic ones.
//!
//! Where there are several motions, the one that keeps every contact as it was goes on, and it is said that there are others: nothing
//! happens at this instant that would end it, as a contact mode ends by a condition that fails (Genot and Brogliato). Where none does, as
//! at the start, nothing in the laws prefers one of them, and all are told instead of one being chosen: schemes that choose, by the order of
//! their unknowns or by the least force, hide that the model says nothing (Stewart 2000; Pang and Trinkle 1996).
//!
//! # Symbols and units
//!
//! w and b (m/s^2), z (N), A (1/kg).
//!
//! # Sign and frame
//!
//! Gaps open with w_n > 0; slips are along the normal turned clockwise.
//!
//! # Validity
//!
//! Accelerations at one instant, with no impact in it. Few contacts: choices are four for each contact that slips by itself.
//!
//! # Source
//!
//! Pang and Trinkle, Complementarity formulations and existence of solutions of dynamic multi-rigid-body contact problems with Coulomb
//! friction, Mathematical Programming 73 (1996); Stewart, Rigid-body dynamics with friction and impact, SIAM Review 42 (2000); Genot and
//! Brogliato, New results on Painleve paradoxes, European Journal of Mechanics A 18 (1999).
//!
//! # Checked by
//!
//! `tests/several_motions.rs`: jammed between walls, a corner, what one friction makes certain and another does not; `tests/painleve.rs`.

use nalgebra::{DMatrix, DVector};

use crate::contact::certain::SPARE;
use crate::contact::complementarity::{DEPENDENT, moved};
use crate::contact::grip::{Grip, Way};
use crate::contact::settle::BALANCED;
use crate::contact::sticking::{Patch, Pushes, Rough};
use crate::linear_program::best;

/// Motions whose accelerations differ by less than this part are one.
const ONE: f64 = 1e-6;
/// What is left of an equation, or is lacking in a condition, in units of what is zero: elimination has made it larger.
const LEFT: f64 = 100.0;

/// Motions that differ.
pub(super) struct Motions {
    pub(super) found: Vec<Pushes>,
    /// Whether what is between some of them is possible as well.
    pub(super) is_between: bool,
    /// Whether pushes of any size make more of them.
    pub(super) is_unbounded: bool,
}

/// Who pushes and who sticks or slides, with the friction of what begins to slip.
struct Choice<'a> {
    of: &'a Rough<'a>,
    held: &'a [usize],
    grips: &'a [Grip],
    /// Of the two coefficients.
    which: usize,
}

/// Ends of what a choice leaves open, and whether some of it has no end.
type Ends<T> = (Vec<T>, bool);

/// Pushes with which equations hold: one, and directions in which they may change.
struct Line {
    unknowns: DVector<f64>,
    open: DMatrix<f64>,
}

impl Rough<'_> {
    /// Every motion once, of accelerations with forces; what slips already goes on to, and `forced` are ways in which others have to.
    pub(super) fn motions(&self, forced: &[Option<Way>]) -> Motions {
        let mut motions = Motions { found: vec![], is_between: false, is_unbounded: false };
        let mut known: Vec<DVector<f64>> = vec![];
        for grips in choices(forced) {
            for held in self.only_set(&grips).map_or_else(|| self.all_sets(), |only| vec![only]) {
                if !self.is_first(&grips, forced, &held) {
                    continue;
                }
                let choice = Choice { of: self, held: &held, grips: &grips, which: 0 };
                let (all, is_unbounded) = choice.motions();
                motions.is_between |= all.len() > 1;
                motions.is_unbounded |= is_unbounded;
                for motion in all {
                    if !known.iter().any(|known| self.are_one(known, &motion.then)) {
                        known.push(motion.then.clone());
                        motions.found.push(choice.going_on().unwrap_or(motion));
                    }
                }
            }
        }
        motions
    }

    /// The contacts that push by a choice of grips, where whatever acts there is one such set: responses along the normals are positive definite,
    /// and so all their principal minors positive.
    fn only_set(&self, grips: &[Grip]) -> Option<Vec<usize>> {
        let begins = |(patch, grip): (&Patch, &Grip)| match grip {
            Grip::Slides(way) if patch.slips.is_none() => Grip::Strains(*way),
            grip => *grip,
        };
        let grips: Vec<Grip> = self.patches.iter().zip(grips).map(begins).collect();
        let reduced = self.reduced(&grips)?;
        let mut mean = (&reduced.matrix + reduced.matrix.transpose()) / 2.0;
        (0..mean.nrows()).for_each(|i| mean[(i, i)] *= 1.0 - SPARE);
        mean.cholesky()?;
        let found = self.solved(&grips, reduced)?;
        let sticking = grips.iter().filter(|grip| **grip == Grip::Sticks).count();
        (found.holding.len() == sticking).then_some(found.held)
    }

    /// Whether accelerations are of one motion.
    fn are_one(&self, one: &DVector<f64>, other: &DVector<f64>) -> bool {
        (one - other).amax() <= ONE * one.amax().max(self.zero / BALANCED)
    }

    /// Friction without anything that presses is none: of the grips of such a patch one is tried.
    fn is_first(&self, grips: &[Grip], forced: &[Option<Way>], held: &[usize]) -> bool {
        let mut all = self.patches.iter().zip(grips).zip(forced);
        all.all(|((patch, grip), forced)| {
            forced.is_some() || *grip == Grip::Slides(Way::Forward) || self.is_pressed(patch, held)
        })
    }

    /// Whether something may press a patch, of what is held.
    fn is_pressed(&self, patch: &Patch, held: &[usize]) -> bool {
        let presses = |contact: &usize| held.contains(contact) || self.loads[*contact] > 0.0;
        patch.contacts.iter().any(|(contact, _)| presses(contact))
    }
}

impl Choice<'_> {
    /// The motion of a choice, or the ends of what it leaves open; none where a condition fails.
    fn motions(&self) -> Ends<Pushes> {
        self.line().map_or((vec![], false), |line| self.ends(&line))
    }

    /// The same choice with kinetic coefficients, where it is one motion.
    fn going_on(&self) -> Option<Pushes> {
        let mut slips = self.of.patches.iter().zip(self.grips);
        let differs = |(patch, grip): (&Patch, &Grip)| {
            !grip.is_still() && patch.slips.is_none() && patch.friction[0] != patch.friction[1]
        };
        if !slips.any(differs) {
            return None;
        }
        let (mut motions, _) = Choice { which: 1, ..*self }.motions();
        motions.pop().filter(|_| motions.is_empty())
    }

    /// Friction of a patch that slides for each unit of what presses it.
    fn part(&self, patch: &Patch, grip: Grip) -> Option<f64> {
        let friction = patch.friction[if patch.slips.is_some() { 1 } else { self.which }];
        match grip {
            Grip::Slides(way) | Grip::Strains(way) => Some(-f64::from(way.sign()) * friction),
            Grip::Sticks | Grip::Follows => None,
        }
    }

    fn patches(&self) -> impl Iterator<Item = (&Patch, Option<f64>)> {
        self.of.patches.iter().zip(self.grips).map(|(patch, grip)| (patch, self.part(patch, *grip)))
    }

    /// Rows that stand still: of contacts that are held, then of what sticks.
    fn rows(&self) -> Vec<usize> {
        let sticking = self.patches().filter(|(_, part)| part.is_none());
        self.held.iter().copied().chain(sticking.map(|(patch, _)| patch.row())).collect()
    }

    /// All pushes by the forces of those rows, without loads.
    fn pushes(&self, forces: &DVector<f64>, loads: &DVector<f64>) -> DVector<f64> {
        let mut pushes = DVector::zeros(self.of.response.nrows());
        self.rows().into_iter().zip(forces).for_each(|(row, force)| pushes[row] = *force);
        for (patch, part) in self.patches() {
            let Some(part) = part else { continue };
            patch.contacts.iter().for_each(|(contact, row)| {
                pushes[*row] = part * (loads[*contact] + pushes[*contact]);
            });
        }
        pushes
    }

    /// The pushes with which those rows stand still.
    fn line(&self) -> Option<Line> {
        let (rows, none) = (self.rows(), DVector::zeros(self.of.response.nrows()));
        let of_loads = self.pushes(&DVector::zeros(rows.len()), &self.of.loads);
        let without = &self.of.without + self.of.response * of_loads;
        let size = |row: usize| match self.of.response[(row, row)] {
            own if own > 0.0 => 1.0 / libm::sqrt(own),
            _ => 1.0,
        };
        let sizes: Vec<f64> = rows.iter().map(|row| size(*row)).collect();
        let mut table = DMatrix::zeros(rows.len(), rows.len() + 1);
        for column in 0..rows.len() {
            let mut unit = DVector::zeros(rows.len());
            unit[column] = sizes[column];
            let moved = self.of.response * self.pushes(&unit, &none);
            rows.iter().enumerate().for_each(|(row, of)| table[(row, column)] = sizes[row] * moved[*of]);
        }
        rows.iter().enumerate().for_each(|(row, of)| table[(row, rows.len())] = -sizes[row] * without[*of]);
        let zero: Vec<f64> = sizes.iter().map(|size| LEFT * self.of.zero * size).collect();
        let mut line = solved(table, &zero)?;
        for (index, size) in sizes.iter().enumerate() {
            line.unknowns[index] *= size;
            line.open.row_mut(index).scale_mut(*size);
        }
        Some(line)
    }

    /// What must not be negative, m/s^2, by pushes and what they do; linear in both.
    fn conditions(&self, pushes: &DVector<f64>, loads: &DVector<f64>, then: &DVector<f64>) -> Vec<f64> {
        let own = |row: usize| self.of.response[(row, row)];
        let across = self.of.contacts.iter().map(|contact| match self.held.contains(contact) {
            true => own(*contact) * pushes[*contact],
            false => then[*contact],
        });
        let along = self.of.patches.iter().zip(self.grips).flat_map(|(patch, grip)| {
            let row = patch.row();
            match grip {
                Grip::Slides(_) if patch.slips.is_some() || !self.of.is_pressed(patch, self.held) => vec![],
                Grip::Slides(way) | Grip::Strains(way) => vec![f64::from(way.sign()) * then[row]],
                Grip::Sticks | Grip::Follows => {
                    let pressed =
                        patch.contacts.iter().map(|(contact, _)| pushes[*contact] + loads[*contact]);
                    let most = patch.friction[0] * pressed.sum::<f64>();
                    vec![own(row) * (most - pushes[row]), own(row) * (most + pushes[row])]
                }
            }
        });
        across.chain(along).collect()
    }

    /// Ends of what is open, as far as motions differ there and conditions hold.
    fn ends(&self, line: &Line) -> Ends<Pushes> {
        let response = self.of.response;
        let pushes = self.pushes(&line.unknowns, &self.of.loads);
        let then = moved(response, &self.of.without, &pushes);
        let values = DVector::from_vec(self.conditions(&pushes, &self.of.loads, &then));
        if line.open.is_empty() {
            let holds = values.iter().all(|value| *value >= -self.of.zero);
            return (if holds { vec![self.motion(pushes, then)] } else { vec![] }, false);
        }
        let none = DVector::zeros(response.nrows());
        let open: Vec<DVector<f64>> =
            line.open.column_iter().map(|column| self.pushes(&column.into_owned(), &none)).collect();
        let open = DMatrix::from_columns(&open);
        let moved = self.moved(&open);
        let slopes: Vec<DVector<f64>> = (0..open.ncols())
            .map(|index| {
                let [pushes, moved] = [&open, &moved].map(|of| of.column(index).into_owned());
                DVector::from_vec(self.conditions(&pushes, &none, &moved))
            })
            .collect();
        let slopes = DMatrix::from_columns(&slopes);
        let moving = moved.row_iter().filter(|row| row.amax() > 0.0).map(|row| row.transpose());
        let measures: Vec<DVector<f64>> = moving.collect();
        let (places, is_unbounded) = corners(&values, &slopes, &measures, LEFT * self.of.zero);
        let at = |place: &DVector<f64>| self.motion(&pushes + &open * place, &then + &moved * place);
        let mut ends: Vec<Pushes> = vec![];
        for end in places.iter().map(at) {
            if !ends.iter().any(|known| self.of.are_one(&known.then, &end.then)) {
                ends.push(end);
            }
        }
        (ends, is_unbounded)
    }

    /// What pushes in some directions do, without rounding where they balance.
    fn moved(&self, open: &DMatrix<f64>) -> DMatrix<f64> {
        let sizes = self.of.response.abs() * open.abs();
        let moved = self.of.response * open;
        moved.zip_map(&sizes, |moved, size| if moved.abs() > DEPENDENT * size { moved } else { 0.0 })
    }

    fn motion(&self, pushes: DVector<f64>, then: DVector<f64>) -> Pushes {
        let holding = self.rows().split_off(self.held.len());
        Pushes { pushes, then, held: self.held.to_vec(), grips: self.grips.to_vec(), holding }
    }
}

/// Places y with `values + slopes y >= 0`: the farthest by each of some measures, or one where there are none of these; and whether there is none
/// that is the farthest.
fn corners(
    values: &DVector<f64>,
    slopes: &DMatrix<f64>,
    measures: &[DVector<f64>],
    zero: f64,
) -> Ends<DVector<f64>> {
    let (rows, count) = slopes.shape();
    // y is the difference of two that are not negative; the last unknown is what all conditions have to spare.
    let both = |of: &DVector<f64>| {
        DVector::from_fn(2 * count, |i, _| if i < count { of[i] } else { -of[i - count] })
    };
    let place = |x: &DVector<f64>| DVector::from_fn(count, |index, _| x[index] - x[count + index]);
    let split = DMatrix::from_fn(rows, 2 * count, |row, column| match column {
        column if column < count => -slopes[(row, column)],
        column => slopes[(row, column - count)],
    });
    let lacking = values.iter().fold(0.0, |most: f64, value| most.max(-value));
    let mut table = split.clone().resize(rows + 1, 2 * count + 1, 0.0);
    table.column_mut(2 * count).fill(1.0);
    let room = values.add_scalar(lacking).push(lacking);
    let mut aim = DVector::zeros(2 * count + 1);
    aim[2 * count] = 1.0;
    let Some((_, x)) = best(&aim, &table, &room).filter(|(spared, _)| *spared >= lacking - zero) else {
        return (vec![], false);
    };
    let first = place(&x);
    let room = (values + slopes * &first).map(|left| left.max(0.0));
    let ends: Vec<_> =
        measures.iter().flat_map(|of| [both(of), both(&-of)]).map(|aim| best(&aim, &split, &room)).collect();
    let is_unbounded = ends.iter().any(Option::is_none);
    let ends = ends.into_iter().flatten().map(|(_, x)| &first + place(&x));
    (if measures.is_empty() { vec![first] } else { ends.collect() }, is_unbounded)
}

/// All solutions of equations, the right sides last in their table; `None` where they contradict each other by more than what is zero.
fn solved(mut table: DMatrix<f64>, zero: &[f64]) -> Option<Line> {
    let count = table.nrows();
    let size = table.columns(0, count).iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    let (mut rows, mut columns): (Vec<usize>, Vec<usize>) = (vec![], vec![]);
    while let Some((row, column)) = largest(&table, &rows, &columns, DEPENDENT * size) {
        let pivot = table.row(row) / table[(row, column)];
        for other in 0..count {
            let changed =
                if other == row { pivot.clone() } else { table.row(other) - &pivot * table[(other, column)] };
            table.set_row(other, &changed);
        }
        rows.push(row);
        columns.push(column);
    }
    let contradicts = |row: usize| table[(row, count)].is_nan() || table[(row, count)].abs() > zero[row];
    if (0..count).any(|row| !rows.contains(&row) && contradicts(row)) {
        return None;
    }
    let mut line =
        Line { unknowns: DVector::zeros(count), open: DMatrix::zeros(count, count - columns.len()) };
    rows.iter().zip(&columns).for_each(|(row, column)| line.unknowns[*column] = table[(*row, count)]);
    for (index, free) in (0..count).filter(|column| !columns.contains(column)).enumerate() {
        line.open[(free, index)] = 1.0;
        rows.iter()
            .zip(&columns)
            .for_each(|(row, column)| line.open[(*column, index)] = -table[(*row, free)]);
    }
    Some(line)
}

/// The largest entry that is no pivot's row or column.
fn largest(table: &DMatrix<f64>, rows: &[usize], columns: &[usize], least: f64) -> Option<(usize, usize)> {
    let open =
        |known: &[usize]| (0..table.nrows()).filter(|index| !known.contains(index)).collect::<Vec<_>>();
    let (rows, columns) = (open(rows), open(columns));
    let all = rows.iter().flat_map(|row| columns.iter().map(|column| (*row, *column)));
    let all = all.filter(|place| table[*place].abs() > least);
    all.max_by(|a, b| table[*a].abs().total_cmp(&table[*b].abs()))
}

/// All choices of grips, but for what has to slide one way.
fn choices(forced: &[Option<Way>]) -> Vec<Vec<Grip>> {
    let free = [Grip::Sticks, Grip::Slides(Way::Forward), Grip::Slides(Way::Backward)];
    forced.iter().fold(vec![vec![]], |choices, forced| {
        let own = forced.map_or(free.to_vec(), |way| vec![Grip::Slides(way)]);
        choices.iter().flat_map(|known| own.iter().map(|grip| [&known[..], &[*grip]].concat())).collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::certain::tests::{Draw, random};

    /// Where one set is said to be the only one, every other that is possible is the same motion.
    #[test]
    fn the_only_set_is_the_only_one() {
        let mut draw = Draw(11);
        let (mut only, mut possible) = (0, 0);
        for index in 0..2000 {
            let friction = 0.02 * f64::from(index % 60);
            let rough = random(&mut draw, [1 + index as usize % 3, 3 + index as usize % 3], friction);
            let forced: Vec<Option<Way>> = rough.patches.iter().map(|patch| patch.slips).collect();
            for grips in choices(&forced) {
                let Some(held) = rough.only_set(&grips) else { continue };
                let motions =
                    |held: &[usize]| Choice { of: &rough, held, grips: &grips, which: 0 }.motions().0;
                let found = motions(&held);
                let mut others = rough.all_sets().into_iter().flat_map(|held| motions(&held));
                only += 1;
                possible += found.len();
                let is_found = |other: Pushes| found.iter().any(|own| rough.are_one(&own.then, &other.then));
                assert!(others.all(is_found), "{index} {grips:?}");
            }
        }
        assert!(only > 5000 && possible > 1000, "{only} {possible}");
    }
}
