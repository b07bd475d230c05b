//! The numbers of an island's pairs at an instant: what impacts and lasting contacts are found from.
//!
//! With M the masses, J the gradients of the gaps' rates and B those of the joints' rows, impulses P at the pairs change velocities by
//! `M^-1 (J^T P + B^T Q)`, with `Q = -(B M^-1 B^T)^-1 B M^-1 J^T P` so that the joints hold.

use std::collections::HashMap;
use std::sync::Arc;

use nalgebra::{DMatrix, DVector};
use tumble_expr::{Branches, Jets, Rounded};
use tumble_ode::{Crossing, Reason};

use crate::contact::complementarity::{BALANCES, DEPENDENT};
use crate::contact::settle::{BALANCED, STANDS};
use crate::contact::slip::Slips;
use crate::coordinates::Measure;
use crate::equations::Equations;
use crate::link::{InstantTape, Measured, Pushes, Slipping};
use crate::mode::Mode;
use crate::product::product;
use crate::restrained::{Gradients, respond};

/// Where and when.
#[derive(Clone, Copy)]
pub(crate) struct Now<'a> {
    pub(crate) time: f64,
    /// When the event before it was, s.
    pub(crate) since: f64,
    pub(crate) inputs: &'a [f64],
    /// What rounding has left out of the states.
    pub(crate) compensation: &'a [f64],
    /// Largest values that each kind of state has had, by [`Measure`].
    pub(crate) scales: &'a [f64],
}

/// A moment, as a part of the time since the last event, in which loads began or went down to zero; and of the time, of which rounding leaves less.
const MOMENT: [f64; 2] = [1e-4, 1e-9];
/// A moment at the start, s, where nothing says how long anything takes: loads are smooth in it.
const FIRST_MOMENT: f64 = 1e-9;
/// Moments to look at, one after the other: what a load is after the last is still small beside what it will be.
const LATER: [f64; 3] = [1.0, 1e2, 1e4];

impl<'a> Now<'a> {
    /// So little later that nothing has moved, and so much that loads that were none are some; then later, for loads that grow more slowly.
    pub(crate) fn moments(self) -> impl Iterator<Item = Self> {
        LATER.into_iter().map(move |times| {
            let length = (MOMENT[0] * (self.time - self.since)).max(times * MOMENT[1] * self.time);
            Self { time: self.time + if length > 0.0 { length } else { times * FIRST_MOMENT }, ..self }
        })
    }

    pub(crate) fn of(at: &Crossing<'a, Mode>) -> Self {
        let Crossing { time, since, inputs, compensation, scales, .. } = *at;
        Self { time, since, inputs, compensation, scales }
    }
}

/// Rounding may leave of a velocity that came to rest this part of the largest there was, in units of what `STANDS`
/// makes of it.
const LEFT: f64 = 1e-3;

/// Pairs whose gap is larger than this part of the extent of a body have no part in what happens at an instant: what is too short to be
/// followed does not go as far.
const NEAR: f64 = 1e-2;
/// What is beyond an edge by more than this part of the extent of a body is not in touch with it, but behind it.
const BEHIND: f64 = 1e-9;
/// Gaps of one body that are zero within so many times their rounding error close at one instant; rates that are so are zero.
const ONE_INSTANT: f64 = 16.0;

/// An island's pairs at an instant, by their order among its own.
pub(crate) struct Touch {
    /// Largest extent of a body, m; zero where none has any.
    pub(crate) size: f64,
    /// Index of each among all pairs.
    pub(crate) pairs: Vec<usize>,
    /// m; infinite where they cannot touch.
    pub(crate) gap: DVector<f64>,
    /// Gaps below this are zero but for rounding, m.
    pub(crate) blur: DVector<f64>,
    /// m/s
    pub(crate) rate: DVector<f64>,
    /// Rounding in a rate is relative to this, m/s.
    pub(crate) speed: DVector<f64>,
    /// Accelerations of the gaps without lasting contacts of this island, m/s^2.
    pub(crate) free: DVector<f64>,
    /// Rounding in accelerations is relative to this: what all forces would do if none were against another, m/s^2.
    pub(crate) strength: f64,
    /// How many times the mass of the lightest body that moves the heaviest has.
    pub(crate) unlike: f64,
    /// Restitution of each; zero where the surface is compliant.
    pub(crate) restitution: DVector<f64>,
    /// Forces of those that are pressed into compliant surfaces, N; zero of all others, and of a surface that pulls.
    pub(crate) loads: DVector<f64>,
    /// Of those with friction, along their surfaces.
    pub(crate) slips: Slips,
    /// Change of rate i by a unit impulse at j, 1/kg; rates of gaps come first, then those of slips.
    pub(crate) response: DMatrix<f64>,
    /// The same of accelerations by unit forces, where loads read these: an impact does not know such loads.
    pushes: Option<DMatrix<f64>>,
    /// Change of each velocity state by a unit impulse at j.
    kicks: DMatrix<f64>,
    /// Index of each velocity state.
    velocities: Vec<usize>,
    /// The rows of joints that hold.
    pub(crate) joints: Joined,
}

/// Rows of joints at an instant, which impulses of their own keep.
pub(crate) struct Joined {
    /// Index of each among all rows of joints.
    pub(crate) rows: Vec<usize>,
    /// Impulse of each by a unit impulse at a pair.
    pub(crate) share: DMatrix<f64>,
}

impl Touch {
    /// Adds impulses at the pairs, and then along the surfaces, to the velocities. Where they balance but for rounding nothing changes: what falls flat stays
    /// flat.
    pub(crate) fn kick(&self, impulses: &DVector<f64>, states: &mut [f64]) {
        let changes = (&self.kicks * impulses, self.kicks.abs() * impulses.abs());
        for (index, (change, size)) in changes.0.iter().zip(&changes.1).enumerate() {
            if change.abs() > BALANCES * size {
                states[self.velocities[index]] += change;
            }
        }
    }

    /// What unit forces of contacts that last do to accelerations, 1/kg.
    pub(crate) fn pushes(&self) -> &DMatrix<f64> {
        self.pushes.as_ref().unwrap_or(&self.response)
    }

    /// How many velocities joints leave free.
    pub(crate) fn freedoms(&self) -> usize {
        self.velocities.len() - self.joints.rows.len()
    }

    /// Whether loads read forces of contacts or joints.
    pub(crate) fn is_fed(&self) -> bool {
        self.pushes.is_some()
    }

    /// What is behind an edge does not touch it.
    fn pass_over(&mut self, has_edge: impl Fn(usize) -> bool) {
        for (position, pair) in self.pairs.iter().enumerate() {
            if self.gap[position] < -BEHIND * self.size && has_edge(*pair) {
                self.gap[position] = f64::INFINITY;
            }
        }
    }

    /// Takes rounding out of what joints keep where it is: no push moves it. `free` is the response without joints.
    fn clear(&mut self, free: &DMatrix<f64>) {
        let zero = BALANCED * self.strength;
        let accelerations = self.free.iter_mut().chain(&mut self.slips.free);
        for (row, acceleration) in accelerations.enumerate() {
            if self.response[(row, row)] <= DEPENDENT * free[(row, row)] {
                for matrix in std::iter::once(&mut self.response).chain(&mut self.pushes) {
                    matrix.fill_row(row, 0.0);
                    matrix.fill_column(row, 0.0);
                }
                *acceleration = if acceleration.abs() <= zero { 0.0 } else { *acceleration };
            }
        }
    }

    fn is_finite(&self) -> bool {
        let slips = self.slips.rate.iter().chain(&self.slips.free);
        let pushes = self.pushes.iter().flatten();
        let all = self.rate.iter().chain(&self.loads).chain(&self.free).chain(slips).chain(pushes);
        all.into_iter().all(|value| value.is_finite())
    }

    /// Position of a pair among the island's own.
    pub(crate) fn position(&self, pair: usize) -> Option<usize> {
        self.pairs.iter().position(|known| *known == pair)
    }
}

impl Equations {
    /// The numbers of the pairs among the bodies of an island that touch or nearly do.
    pub(crate) fn touch(
        &self,
        island: &[usize],
        mode: &Mode,
        states: &[f64],
        now: Now<'_>,
    ) -> Result<Touch, Reason> {
        let mut all = self.pair_list().among(island);
        all.retain(|pair| !self.pair_list().captures.contains_key(pair));
        let velocities = self.velocities_of(mode, island);
        let tape = self.island_tape(island, mode, &all)?;
        let jets = to_second_order(&tape, (states, &velocities), now);
        let (pairs, tape) =
            self.near(mode, &all, &Numbers { tape: &tape, jets: &jets, dofs: velocities.len() });
        let joints = self.independent_rows_of(mode, island).into_iter().map(|(index, _)| index).collect();
        let read = Numbers { tape: &tape, jets: &jets, dofs: velocities.len() };
        let (inverse, pushed) = (read.of_bodies(0), read.of_bodies(1));
        let (rows, slips) =
            (read.rows(), Slips::read(&tape.slips, &self.pair_list().owner, |output| carried(&jets, output)));
        let (kicks, joints) = read.kicks(&rows, joints).ok_or_else(|| self.not_independent(island))?;
        let measures: Vec<Measure> =
            island.iter().flat_map(|body| self.velocity_measures(*body)).copied().collect();
        let rounded = rounded(&tape, states, now);
        let [blur, rounding] = blur(&rounded, &tape, now);
        // What is left of forces that come to zero at this instant is rounding of the time.
        let left = |dof: usize| rounded.value_of(tape.bodies + read.dofs + dof).noise() / BALANCED;
        let forces = &pushed + DVector::from_fn(read.dofs, |dof, _| left(dof));
        let speed = |row: usize, rate: f64| -> f64 {
            let own = |dof: usize| rows[(row, dof)] * states[velocities[dof]];
            let left = |dof: usize| rows[(row, dof)].abs() * LEFT * now.scales[measures[dof] as usize];
            let surface = rate - (0..read.dofs).map(own).sum::<f64>();
            let moving = (0..read.dofs).map(|dof| own(dof).abs() + left(dof)).sum::<f64>() + surface.abs();
            // Far from the origin places are rounded so much that the normals turn by it: a corner that is come to seems to be passed.
            moving.max(rounding[row] / STANDS)
        };
        let speeds = |first: usize, rates: &DVector<f64>| {
            DVector::from_fn(rates.len(), |index, _| speed(first + index, rates[index]))
        };
        let (rate, free) = (read.column(&Measured::rate), read.column(&Measured::end));
        let accelerations = stacked_column(&free, &slips.free).abs();
        let limits = pairs.iter().map(|pair| self.pairs()[*pair].limits.len());
        let mut touch = Touch {
            size: read.size(),
            gap: read.gaps(limits),
            blur,
            speed: speeds(0, &rate),
            rate,
            strength: (rows.abs() * inverse.component_mul(&forces) + accelerations).max(),
            free,
            unlike: unlike(&inverse, &measures),
            restitution: read.column(&|pair| pair.end() + 1),
            loads: read.column(&|pair| pair.end() + 2).map(|load| load.max(0.0)),
            response: product(&rows, &kicks),
            pushes: tape.pushes.as_ref().map(|pushes| read.pushes(pushes)),
            slips: Slips { speed: speeds(pairs.len(), &slips.rate), ..slips },
            pairs,
            kicks,
            velocities,
            joints,
        };
        touch.pass_over(|pair| self.pairs()[pair].has_edge());
        let each = &rows * DMatrix::from_diagonal(&inverse);
        touch.clear(&product(&each, &rows.transpose()));
        if touch.is_finite() { Ok(touch) } else { Err(self.not_finite(island)) }
    }

    /// Those of some pairs that matter at an instant, with where their numbers stand: of many bodies most are far from each other.
    fn near(&self, mode: &Mode, all: &[usize], read: &Numbers<'_>) -> (Vec<usize>, InstantTape) {
        let limits = all.iter().map(|pair| self.pairs()[*pair].limits.len());
        let (gaps, most) = (read.gaps(limits), NEAR * read.size());
        let is_near = |position: &usize| {
            let (pair, gap) = (all[*position], gaps[*position]);
            let may_touch = most == 0.0 || (gap <= most && !(gap < -most && self.pairs()[pair].has_edge()));
            may_touch || gap.is_nan() || mode.contact_mode(pair).is_some()
        };
        let near: Vec<usize> = (0..all.len()).filter(is_near).collect();
        let tape = read.tape;
        let places: HashMap<usize, usize> = near.iter().copied().zip(0..).collect();
        let kept =
            |slip: &Slipping| Some(Slipping { position: *places.get(&slip.position)?, ..slip.clone() });
        let pushes = tape.pushes.as_ref().map(|pushes| {
            let along = tape.slips.iter().zip(all.len()..).filter(|(slip, _)| kept(slip).is_some());
            pushes.only(near.iter().copied().chain(along.map(|(_, row)| row)).collect())
        });
        let slips = tape.slips.iter().filter_map(kept).collect();
        let pairs = near.iter().map(|position| tape.pairs[*position].clone()).collect();
        let near = near.into_iter().map(|position| all[position]).collect();
        let (rows, bodies) = (tape.rows.clone(), tape.bodies);
        (near, InstantTape { tape: Arc::clone(&tape.tape), pairs, slips, rows, bodies, pushes })
    }

    /// Pairs of bodies whose gaps are at most so many times their rounding error, whether or not they last, each with how many that is.
    pub(crate) fn meeting(
        &self,
        mode: &Mode,
        states: &[f64],
        now: Now<'_>,
        most: f64,
    ) -> Result<Vec<(usize, f64)>, Reason> {
        let mut pairs = self.pairs_among(mode, &mode.bodies);
        pairs.retain(|pair| self.pairs()[*pair].other.is_some());
        if pairs.is_empty() {
            return Ok(vec![]);
        }
        let tape = self.gaps_tape(mode, &pairs)?;
        let blurs = gaps_in_blurs(&tape, states, now);
        Ok(pairs.into_iter().zip(blurs).filter(|(_, blurs)| *blurs <= most).collect())
    }

    fn not_finite(&self, island: &[usize]) -> Reason {
        let bodies = self.body_names(island);
        Reason::Model(format!("where {bodies} touches, its velocity or acceleration is not a finite number"))
    }

    /// Names of bodies for a message.
    pub(crate) fn body_names(&self, bodies: &[usize]) -> String {
        let names = bodies.iter().map(|body| format!("`{}`", self.model().bodies[*body].name));
        names.collect::<Vec<_>>().join(", ")
    }

    fn not_independent(&self, island: &[usize]) -> Reason {
        let names = self.body_names(island);
        Reason::Model(format!("the joints of {names} do not determine their impulses here"))
    }

    /// What kind each velocity of a body is of.
    fn velocity_measures(&self, body: usize) -> &'static [Measure] {
        match self.pivot_arm(body) {
            None => &[Measure::Speed, Measure::Speed, Measure::AngularRate],
            Some(_) => &[Measure::AngularRate],
        }
    }
}

/// The tape's numbers; gaps and normals of bodies are made of differences of much larger numbers, and what rounding has left out of places is
/// found to second order: at 1e9 m it is the millionth part of a body's size. Velocities are as they are: what an impulse makes zero is zero.
fn to_second_order(tape: &InstantTape, (states, velocities): (&[f64], &[usize]), now: Now<'_>) -> Jets<f64> {
    let mut jets = Jets::new(Arc::clone(&tape.tape), 2, now.inputs);
    jets.start(now.time, states, Branches::Free);
    for (leaf, compensation) in now.compensation.iter().take(states.len()).enumerate() {
        jets.set(leaf, 1, if velocities.contains(&leaf) { 0.0 } else { *compensation });
    }
    jets.set(states.len(), 1, 0.0);
    jets.extend(1);
    (0..=states.len()).for_each(|leaf| jets.set(leaf, 2, 0.0));
    jets.extend(2);
    jets
}

/// A number with what rounding left out of places.
fn carried(jets: &Jets<f64>, output: usize) -> f64 {
    let series = jets.output(output);
    let first = if series[1].is_finite() { series[0] + series[1] } else { series[0] };
    // What is zero by its form stays so.
    if series[2].is_finite() && first != 0.0 { first + series[2] } else { first }
}

/// The numbers of a tape at an instant.
struct Numbers<'a> {
    tape: &'a InstantTape,
    jets: &'a Jets<f64>,
    /// How many velocities there are.
    dofs: usize,
}

impl Numbers<'_> {
    /// One of each pair.
    fn column(&self, of: &dyn Fn(&Measured) -> usize) -> DVector<f64> {
        let values = self.tape.pairs.iter().map(|pair| carried(self.jets, of(pair)));
        DVector::from_iterator(self.tape.pairs.len(), values)
    }

    /// `limits` is how many each of them has.
    fn gaps(&self, limits: impl Iterator<Item = usize>) -> DVector<f64> {
        let gaps = self.tape.pairs.iter().zip(limits).map(|(pair, limits)| {
            let gap = carried(self.jets, pair.position);
            let mut limits = (0..limits).map(|limit| self.jets.value_of(pair.end() + 3 + limit));
            if limits.all(|limit| limit >= 0.0) { gap } else { f64::INFINITY }
        });
        DVector::from_iterator(self.tape.pairs.len(), gaps)
    }

    /// Those by velocity, in the order of [`Equations::island_tape`].
    fn of_bodies(&self, which: usize) -> DVector<f64> {
        DVector::from_fn(self.dofs, |dof, _| self.jets.value_of(self.tape.bodies + which * self.dofs + dof))
    }

    /// Largest extent of a body, m; it stands behind two numbers by velocity.
    fn size(&self) -> f64 {
        self.jets.value_of(self.tape.bodies + 2 * self.dofs)
    }

    fn pushes(&self, of: &Pushes) -> DMatrix<f64> {
        DMatrix::from_fn(of.count(), of.count(), |row, column| self.jets.value_of(of.place(row, column)))
    }

    fn masses(&self) -> DVector<f64> {
        DVector::from_fn(self.dofs, |dof, _| self.jets.value_of(self.tape.bodies + 2 * self.dofs + 1 + dof))
    }

    fn gradients<'r>(&self, rows: impl Iterator<Item = &'r Measured>) -> Gradients {
        let slopes = |row: &Measured| {
            let all = row.slopes().map(|(dof, at)| (dof, carried(self.jets, at)));
            all.filter(|(_, slope)| *slope != 0.0).collect()
        };
        Gradients { rows: rows.map(slopes).collect(), columns: self.dofs }
    }

    /// Slopes of all gaps' rates, then of those along surfaces.
    fn rows(&self) -> DMatrix<f64> {
        let along = self.tape.slips.iter().map(|slip| &slip.row);
        self.gradients(self.tape.pairs.iter().chain(along)).dense()
    }

    /// What unit impulses do to velocities, and what joints add to them; `None` where joints leave that open.
    fn kicks(&self, rows: &DMatrix<f64>, joints: Vec<usize>) -> Option<(DMatrix<f64>, Joined)> {
        if joints.is_empty() {
            let kicks = DMatrix::from_diagonal(&self.of_bodies(0)) * rows.transpose();
            return Some((kicks, Joined { rows: vec![], share: DMatrix::zeros(0, rows.nrows()) }));
        }
        let none = DMatrix::zeros(joints.len(), rows.nrows());
        let of_joints = self.gradients(self.tape.rows.iter());
        let (kicks, share) = respond(&self.masses(), &of_joints, &rows.transpose(), &none)?;
        Some((kicks, Joined { rows: joints, share }))
    }
}

/// Gaps of a tape in their rounding errors, whichever sign.
fn gaps_in_blurs(tape: &InstantTape, states: &[f64], now: Now<'_>) -> Vec<f64> {
    let jets = rounded(tape, states, now);
    let in_blurs = |pair: &Measured| match jets.value_of(pair.position).value.abs() {
        0.0 => 0.0,
        gap => gap / blur_of(&jets, pair, now),
    };
    tape.pairs.iter().map(in_blurs).collect()
}

/// What rounding leaves of gaps that are zero, and of the rates of gaps and slips that are.
fn blur(jets: &Jets<Rounded>, tape: &InstantTape, now: Now<'_>) -> [DVector<f64>; 2] {
    let gaps = tape.pairs.iter().map(|pair| blur_of(jets, pair, now));
    let rows = tape.pairs.iter().chain(tape.slips.iter().map(|slip| &slip.row));
    let rates = rows.map(|row| ONE_INSTANT * jets.value_of(row.rate()).noise());
    [gaps.collect::<Vec<_>>(), rates.collect()].map(DVector::from_vec)
}

/// The rounding error of the gap itself, and what its rate makes of that of the time, m.
fn blur_of(jets: &Jets<Rounded>, pair: &Measured, now: Now<'_>) -> f64 {
    let [gap, rate] = [pair.position, pair.rate()].map(|output| jets.value_of(output));
    ONE_INSTANT * (gap.noise() + rate.value.abs() * f64::EPSILON * now.time)
}

/// A tape with its running rounding errors.
fn rounded(tape: &InstantTape, states: &[f64], now: Now<'_>) -> Jets<Rounded> {
    let rounded = |values: &[f64]| values.iter().map(|value| Rounded::leaf(*value)).collect::<Vec<_>>();
    let mut jets = Jets::new(Arc::clone(&tape.tape), 0, &rounded(now.inputs));
    jets.start(Rounded::leaf(now.time), &rounded(states), Branches::Free);
    jets
}

/// How many times the least of the masses is in the largest, by velocity, of those that move; infinite where one has none.
fn unlike(inverse: &DVector<f64>, measures: &[Measure]) -> f64 {
    let along = inverse.iter().zip(measures).filter(|(_, measure)| **measure == Measure::Speed);
    let [least, most] = along.fold([f64::INFINITY, 0.0], |[least, most]: [f64; 2], (lightness, _)| {
        [least.min(*lightness), most.max(*lightness)]
    });
    most / least
}

/// Entries of one vector, then of another.
pub(super) fn stacked_column(first: &DVector<f64>, then: &DVector<f64>) -> DVector<f64> {
    DVector::from_iterator(first.len() + then.len(), first.iter().chain(then).copied())
}
