//! Whether a step is known everywhere, and not only where it was looked at.
//!
//! A step is accepted if along all of it the defect `p'(s) - f(t(s), p(s))` is bounded by a millionth of the scale of its rate,
//! or by the accuracy if that is larger; if nothing weaker hides in it, see [`defect`]; and if it is settled where each watched
//! function is zero: those are its series' zeros and no others. What is not settled at once is halved, down to parts that are too small, see [`halvings`]. The step then ends where
//! the first part begins that is not settled; if that is the beginning, it becomes that part.
//!
//! The scale of a rate is the largest that it has been, and that of the state over the length of the run: a force that has not
//! acted yet has no scale of its own, and forces that balance each other far from the origin have none either.

mod clear;
mod defect;
mod halvings;
mod watched;

use smallvec::{SmallVec, smallvec};
use tumble_expr::{Rounded, Scalar, Slot, Turning};

use clear::Clear;
pub(crate) use halvings::Halvings;
use halvings::first_unsettled;
use watched::Watched;

use crate::Reason;
use crate::enclosure::{Enclosure, Path, Vanishing};
use crate::engine::{Engine, Hit};
use crate::expansion::{Expansion, Near};
use crate::polynomial;
use crate::scale::Scales;
use crate::work::Work;

/// A value that is this part of its terms is zero but for rounding.
const VANISHES: f64 = 64.0 * f64::EPSILON;

/// Rates and what is watched, with rounding errors, at the start of a step.
#[derive(Clone, Debug, Default)]
pub(crate) struct Noise {
    /// Of the rate of each state: its rounding error, absolute.
    pub(crate) rates: Vec<f64>,
    /// The rates themselves.
    pub(crate) values: Vec<f64>,
}

/// What a whole step is held to.
pub(crate) struct Demand<'a> {
    pub(crate) scales: &'a Scales,
    /// Local tolerance.
    pub(crate) tolerance: f64,
    /// What was asked for the whole run.
    pub(crate) accuracy: f64,
    pub(crate) noise: &'a Noise,
}

/// A step of that length.
#[derive(Clone, Copy)]
pub(crate) struct Stretch<'a> {
    pub(crate) expansion: &'a Expansion,
    pub(crate) length: f64,
    pub(crate) hits: &'a [Hit],
}

/// A step that is not known to its end.
pub(crate) struct Unknown {
    /// Up to there, in the parameter, it is.
    pub(crate) length: f64,
    /// What is not known beyond.
    pub(crate) of: Doubt,
}

/// What a step may be shorter for.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Doubt {
    /// A state, or the time after them, that does not obey its equation.
    Leaf(usize),
    /// Something whose zeros are not known.
    Zeros(What),
    /// A lazily evaluated guard, counted after the others.
    Near(usize),
}

/// What a watched function is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum What {
    Branch(usize),
    Guard(usize),
    Table(usize),
}

/// What rounding makes of the end of a step.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Blur {
    /// By how much it may have moved it, s.
    pub(crate) time: f64,
    /// How fast the rate grows at which what ends it is crossed, relative, 1/s.
    pub(crate) growth: f64,
}

impl Engine {
    /// Rates at the start of a step, with what rounding makes of them. A state of which rounding left something out is not
    /// exact, even if it has few digits.
    pub(crate) fn noise(&mut self, time: f64, states: &[f64], compensation: &[f64]) -> Noise {
        let mut noise = Noise::default();
        self.watch_noise(&mut noise, (time, states, compensation));
        noise
    }

    /// The same, into what is there already.
    pub(crate) fn watch_noise(
        &mut self,
        noise: &mut Noise,
        (time, states, compensation): (f64, &[f64], &[f64]),
    ) {
        let leaf = |(state, left_out): (&f64, &f64)| match *left_out == 0.0 {
            true => Rounded::leaf(*state),
            false => Rounded::computed(*state),
        };
        self.round(Rounded::leaf(time), states.iter().zip(compensation).map(leaf));
        noise.rates.clear();
        noise.values.clear();
        for state in 0..self.system.len() {
            let rate = self.rounded.value_of(state);
            noise.rates.push(rate.noise());
            noise.values.push(rate.value);
        }
    }

    /// Evaluates everything with rounding errors.
    fn round(&mut self, time: Rounded, states: impl Iterator<Item = Rounded>) {
        let (mut leaves, mut signs) =
            (std::mem::take(&mut self.rounded_leaves), std::mem::take(&mut self.rounded_signs));
        leaves.clear();
        leaves.extend(states);
        signs.clear();
        signs.extend(self.signs().iter().map(|sign| Rounded::splat(*sign)));
        self.rounded.start(time, &leaves, tumble_expr::Branches::Frozen(&signs));
        (self.rounded_leaves, self.rounded_signs) = (leaves, signs);
    }

    /// By how much rounding errors of the guards that end a step may have moved its end, s: the error of the function over its
    /// rate, or, where that is small, what its bend makes of it. `left_out` is what rounding had left out of the states at the start
    /// of the step, from which the guards' series begin; what they change by has rounding errors of its own size.
    pub(crate) fn blur(
        &mut self,
        hits: &[Hit],
        expansion: &Expansion,
        length: f64,
        (time, states): (f64, &[f64]),
        left_out: &[f64],
    ) -> Result<Blur, Reason> {
        let guards =
            hits.iter().filter_map(|hit| if let Hit::Guard(guard) = hit { Some(*guard) } else { None });
        if guards.clone().next().is_none() {
            return Ok(Blur::default());
        }
        let leaf = |((state, left_out), series): ((&f64, &f64), &[f64])| Rounded {
            value: *state,
            error: left_out.abs() / f64::EPSILON + polynomial::change(series, length),
        };
        let leaves = states.iter().zip(left_out).zip(expansion.states.iter()).map(leaf);
        self.round(Rounded::computed(time), leaves);
        let first = self.system.len() + usize::from(self.system.transformed);
        let rate = expansion.time.as_ref().map_or(1.0, |series| polynomial::slope(series, length));
        let mut worst = Blur::default();
        for guard in guards {
            let (noise, series) = match guard.checked_sub(self.system.guards) {
                None => (self.rounded.value_of(first + guard).noise(), expansion.guards.get(guard)),
                Some(lazy) => {
                    let near = expansion.near.iter().find(|near| near.index == lazy);
                    (self.lazy_guards.noise(lazy, time, states)?, near.map(|near| &near.series[..]))
                }
            };
            let Some(series) = series else { continue };
            let ahead = polynomial::shifted(series, length);
            let [slope, bend] = [1, 2].map(|power| ahead.get(power).copied().unwrap_or(0.0));
            let moved = (noise / slope.abs()).min((noise / bend.abs()).sqrt()) * rate;
            if moved.is_finite() && moved >= worst.time {
                worst = Blur { time: moved, growth: 2.0 * bend / (slope * rate) };
            }
        }
        Ok(worst)
    }

    /// How far a step is known, if not to its end; unless all is to be proved, by formulas alone that may be narrow.
    pub(crate) fn unknown(
        &mut self,
        step: Stretch<'_>,
        demand: &Demand<'_>,
        is_proved: bool,
        work: &mut Work,
    ) -> Result<Option<Unknown>, Reason> {
        let is_looked_at = self.system.exact_degree.is_none() && (is_proved || self.system.may_be_narrow);
        let own = match if is_looked_at { self.clear(step, demand) } else { Clear::Whole } {
            Clear::Whole => None,
            Clear::Part(part) => Some(part),
            Clear::Not => self.own_unknown(step, demand, work),
        };
        let step = match &own {
            Some(own) => Stretch { length: own.length, hits: &[], ..step },
            None => step,
        };
        let beside = self.lazy_unknown(step, demand, is_proved, work)?;
        Ok(beside.or(own))
    }

    /// The same for what the tape of the flow computes.
    fn own_unknown(&mut self, step: Stretch<'_>, demand: &Demand<'_>, work: &mut Work) -> Option<Unknown> {
        let made = || Enclosure::new(self.system.tape.clone(), &self.inputs);
        let mut enclosure = self.enclosure.take().unwrap_or_else(made);
        let path = step.path();
        self.weigh(step.expansion);
        let watched = self.watched(step, demand);
        let vanishing = self.vanishing(step);
        let [nothing, at_start, at_end] = &vanishing;
        let mut halvings = self.halvings;
        let found = first_unsettled(step.length, &mut halvings, |part| {
            work.enclosures += 1;
            let (is_first, is_last) = (part[0] == 0.0, part[1] == step.length);
            let norms = match (is_first && at_start != nothing, is_last && at_end != nothing) {
                (true, _) => Some(Vanishing { norms: at_start, at_end: false }),
                (false, true) => Some(Vanishing { norms: at_end, at_end: true }),
                _ => None,
            };
            enclosure.look(path, part, self.signs(), norms);
            let unsettled = |(slot, watched): &&(Slot, Watched<'_>)| {
                !watched.is_settled(enclosure.of(*slot), part, step.length)
            };
            match watched.iter().find(unsettled) {
                Some((_, watched)) => Some(Doubt::Zeros(watched.what)),
                None => self.disobeys(&enclosure, part, demand).or_else(|| match norms {
                    None if self.system.may_be_narrow => self.hides(&mut enclosure, path, part, demand, work),
                    _ => None,
                }),
            }
        });
        self.enclosure = Some(enclosure);
        self.halvings = halvings;
        found
    }

    /// Where what is watched is zero exactly, as a difference of numbers with few digits may be, finds the sizes of its parts.
    fn weigh(&mut self, expansion: &Expansion) {
        let tape = &self.system.tape;
        let first = self.system.len() + usize::from(self.system.transformed);
        let mut slots = tape.guards().iter().chain(&tape.outputs()[first..]);
        if slots.any(|slot| self.size_of(*slot) == 0.0) {
            let states = expansion.states.iter().map(|series| Rounded::computed(series[0]));
            self.round(Rounded::computed(expansion.start), states);
        }
    }

    /// Sum of the sizes of what a slot was made of at the start of the step.
    pub(crate) fn size_of(&self, slot: Slot) -> f64 {
        let value = self.rounded.slot(slot)[0];
        value.error.max(value.value.abs())
    }

    /// Name of what a step may be shorter for.
    pub(crate) fn name_of_doubt(&self, doubt: Doubt) -> String {
        match doubt {
            Doubt::Leaf(leaf) => {
                self.system.names.get(leaf).cloned().unwrap_or_else(|| "the time".to_owned())
            }
            Doubt::Zeros(what) => self.name_of(what),
            Doubt::Near(guard) => self.system.guard_names[guard].clone(),
        }
    }

    /// Name of something that ends steps.
    pub(crate) fn name_of(&self, what: What) -> String {
        let tape = &self.system.tape;
        match what {
            What::Branch(branch) => tape.describe_with(tape.guards()[branch], &self.system.names),
            What::Guard(guard) => format!("event {}", self.system.guard_names[guard]),
            What::Table(table) => tape.tables()[table].table.0.name.clone(),
        }
    }

    /// Which norms of the tape are zero nowhere, at the start and at the end of a step.
    fn vanishing(&self, step: Stretch<'_>) -> [SmallVec<[bool; 16]>; 3] {
        let nothing = smallvec![false; self.system.tape.norms()];
        let [mut at_start, mut at_end] = [(); 2].map(|()| SmallVec::clone(&nothing));
        for (turning, turn) in self.turnings().iter().zip(&step.expansion.turnings) {
            if let Turning::Norm { index, .. } = turning {
                at_start[*index] =
                    self.is_vanishing(*index) || turn.components.iter().all(|component| component[0] == 0.0);
            }
        }
        for hit in step.hits {
            if let Hit::Turning(turning) = hit
                && let Turning::Norm { index, .. } = self.turnings()[*turning]
            {
                at_end[index] = self.vanishes_at(*turning, step.expansion, step.length);
            }
        }
        [nothing, at_start, at_end]
    }

    /// The same for lazily evaluated guards that are near.
    fn lazy_unknown(
        &mut self,
        step: Stretch<'_>,
        demand: &Demand<'_>,
        is_proved: bool,
        work: &mut Work,
    ) -> Result<Option<Unknown>, Reason> {
        let Stretch { expansion, mut length, .. } = step;
        let mut shortest = None;
        for Near { index, series, .. } in &expansion.near {
            if !is_proved && !self.lazy_guards.may_be_narrow(*index)? {
                continue;
            }
            let guard = self.system.guards + index;
            let is_hit = shortest.is_none() && step.hits.contains(&Hit::Guard(guard));
            let zeros = self.zeros_of_guard(guard);
            let size = demand.scales.of(self.lazy_guards.group(*index));
            let watched = Watched::new((What::Guard(guard), series, 0.0), size, zeros, is_hit, length);
            let found = self.lazy_guards.with_enclosure(*index, expansion, |enclosure, path| {
                first_unsettled(length, &mut Halvings::default(), |part| {
                    work.enclosures += 1;
                    let signs = enclosure.signs(path, part);
                    enclosure.look(path, part, &signs, None);
                    let settled = watched.is_settled(enclosure.output(0), part, length);
                    (!settled).then_some(Doubt::Near(guard))
                })
            })?;
            if let Some(found) = found {
                length = found.length;
                shortest = Some(found);
            }
        }
        Ok(shortest)
    }
}

impl<'a> Stretch<'a> {
    fn path(self) -> Path<'a> {
        let Expansion { start, states, time, .. } = self.expansion;
        Path { start: *start, states, time: time.as_deref() }
    }
}
