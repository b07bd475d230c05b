//! Guards outside the tape of the field: a comparison for those that are far from zero, an expansion for those near.
//!
//! A lazy_guard g with slopes L changes along a step by at most `sum L_i |x_i(s) - x_i(0)|`, and a state by at most
//! `sum |c_k| s^k`. What it last was, less what it may have changed since, is its clearance: while the next step cannot
//! use that up, it is not evaluated at all. Those that depend on the same states, as all places do by which two bodies may meet, are a
//! bunch, which is looked at as a whole first.

mod bunch;
mod plan;

use std::sync::Arc;

use tumble_expr::{Branches, Jets, LEFT_OUT, Rounded, Rounding, Row, Scalar, rounded_sum};

use crate::enclosure::{Enclosure, Path};
use crate::expansion::{Expansion, Near};
use crate::hybrid::Direction;
use crate::polynomial::{self, slope, value};
use crate::program::{Program, values};
use crate::radius::of_own_size;
use crate::scale::Scales;
use crate::{Coefficients, Reason};
use bunch::Bunch;
pub use plan::Watched;
pub(crate) use plan::{WatchPlan, WatchTape};

/// A lazily evaluated guard's series may miss its value by this many tolerances: the order's rule aims at 1.
const SLACK: f64 = 4.0;
/// Rounding errors of a series' value, in units of the last place of its largest term.
const ROUNDING: f64 = 32.0 * f64::EPSILON;
/// Rounding errors of a value, in units of the last place of the lengths it is the difference of.
const VALUE_ROUNDING: f64 = 4.0 * f64::EPSILON;
/// Of what rounding alone makes of a value: less is not worth another step, whose end is rounded too. What is left is the same in check runs of
/// equal numbers, so that it has to be less than what errors are stated for.
const NOISE: f64 = 2.0;
/// A corrected zero is to leave less than this part of the value: what does not come down is rounding.
const BETTER: f64 = 0.5;
/// A zero that is further away than this part of the step is another one, or that of what is nothing but rounding.
const MOST_DELAY: f64 = 1e-3;
/// Where in a step a series is compared with the value.
const PLACES: [f64; 2] = [0.618, 1.0];
/// What the draws for guards are told apart by from those for other numbers.
const NUMBERS: u64 = u64::MAX - 1;

pub(crate) struct LazyGuards {
    all: Vec<Watch>,
    bunches: Vec<Bunch>,
    order: usize,
    /// The states that the clearances hold for.
    known_at: Vec<f64>,
}

struct Watch {
    of: Arc<WatchTape>,
    inputs: Vec<f64>,
    /// Index of each state in the layout.
    states: Vec<usize>,
    slopes: Option<Vec<(usize, f64)>>,
    /// Up to which size they hold.
    reach: f64,
    group: usize,
    direction: Direction,
    rounding: Rounding,
    /// The lazily evaluated guard is at least so far from zero.
    clearance: f64,
    /// In a check run, what it is off by at all instants, known once it is evaluated: numbers and inputs are moved by whole ulps,
    /// and two that stand against each other may be moved alike.
    offset: Option<f64>,
    /// Built when it is first evaluated.
    jets: Option<Jets<f64>>,
    /// Built when it is first near.
    enclosure: Option<Enclosure>,
}

impl LazyGuards {
    pub(crate) fn new(program: &Program, inputs: &[f64], order: usize) -> Self {
        let mut slopes = values(&program.slopes, inputs).into_iter();
        let watch = |of: &Arc<WatchTape>| Watch::new(of, program.rounding, inputs, &mut slopes);
        let all: Vec<Watch> = program.watches.iter().map(watch).collect();
        Self { bunches: Bunch::all(&all), all, order, known_at: vec![] }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// The motion comes to these states, perhaps from far away.
    pub(crate) fn enter(&mut self, states: &[f64]) {
        let same = |index: usize| self.known_at.get(index) == Some(&states[index]);
        self.bunches.iter_mut().filter(|bunch| !bunch.stays(same)).for_each(Bunch::forget);
        self.known_at.clear();
        self.known_at.extend_from_slice(states);
    }

    /// Expands those that a step of this length might bring to zero; `compensation` is what the states' rounding left
    /// out.
    pub(crate) fn approach(
        &mut self,
        expansion: &mut Expansion,
        length: f64,
        compensation: &[f64],
    ) -> Result<(), Reason> {
        let travel = travel(expansion, length);
        expansion.near.clear();
        for bunch in &mut self.bunches {
            if bunch.is_clear(&travel) {
                continue;
            }
            let own = bunch.members.clone();
            bunch.settle(&mut self.all[own.clone()]);
            for index in own.clone() {
                self.all[index].approach(index, expansion, &travel, compensation, self.order)?;
            }
            bunch.learn(&self.all[own]);
        }
        Ok(())
    }

    /// A step of this length was taken, to these states.
    pub(crate) fn moved(&mut self, expansion: &Expansion, length: f64, states: &[f64]) {
        if self.all.is_empty() {
            return;
        }
        let travel = travel(expansion, length);
        self.bunches.iter_mut().for_each(|bunch| bunch.moved(&travel));
        self.known_at.clear();
        self.known_at.extend_from_slice(states);
    }

    /// Largest error of the near ones' series along a step, in units of what is allowed.
    pub(crate) fn excess(
        &mut self,
        expansion: &Expansion,
        length: f64,
        scales: &Scales,
        tolerance: f64,
    ) -> f64 {
        let mut worst: f64 = 0.0;
        for Near { index, series, .. } in &expansion.near {
            let watch = &mut self.all[*index];
            let scale = scales.of(watch.group);
            for s in PLACES.map(|place| place * length) {
                let error = (watch.value(expansion, s) - value(series, s)).abs();
                let terms = series.iter().rev().fold(0.0, |sum, c| sum * s + c.abs());
                let allowed = SLACK * tolerance * scale + ROUNDING * terms.max(scale);
                worst = if error.is_nan() { f64::NAN } else { worst.max(error / allowed) };
            }
        }
        worst
    }

    /// Index of the group that one's error is measured against.
    pub(crate) fn group(&self, index: usize) -> usize {
        self.all[index].group
    }

    /// Rounding error of one at an instant; what rounding left out of its states is known, and what it leaves out of numbers and
    /// inputs is the same at all instants.
    pub(crate) fn noise(&mut self, index: usize, time: f64, states: &[f64]) -> Result<f64, Reason> {
        let [all, same] = self.all[index].noise(time, states, self.order)?;
        Ok(all - same)
    }

    /// Whether one may change within a stretch that its coefficients do not show.
    pub(crate) fn may_be_narrow(&mut self, index: usize) -> Result<bool, Reason> {
        Ok(self.all[index].jets(self.order)?.tape().may_be_narrow())
    }

    /// Looks at one along an expansion, in its own states.
    pub(crate) fn with_enclosure<T>(
        &mut self,
        index: usize,
        expansion: &Expansion,
        look: impl FnOnce(&mut Enclosure, Path<'_>) -> T,
    ) -> Result<T, Reason> {
        let watch = &mut self.all[index];
        let tape = watch.jets(self.order)?.tape().clone();
        let states = Coefficients::of(watch.states.iter().map(|state| &expansion.states[*state]));
        let path = Path { start: expansion.start, states: &states, time: expansion.time.as_deref() };
        let enclosure = watch.enclosure.get_or_insert_with(|| Enclosure::new(tape, &watch.inputs));
        Ok(look(enclosure, path))
    }

    /// How much later than `s` one is zero by its value, where its series misses that by more than the value's
    /// rounding: the terms of a long step's series are larger than their sum, and they are those of the rounded states.
    pub(crate) fn delay(
        &mut self,
        index: usize,
        expansion: &Expansion,
        s: f64,
        (scales, compensation): (&Scales, &[f64]),
    ) -> Option<f64> {
        let Near { series, .. } = expansion.near.iter().find(|near| near.index == index)?;
        let (watch, order) = (&mut self.all[index], self.order);
        let is_whole = watch.states.iter().all(|state| compensation[*state] == 0.0);
        if is_whole || order == 0 || expansion.time.is_some() {
            let rounding = VALUE_ROUNDING * scales.of(watch.group);
            return delay(series, s, rounding, |s| watch.value(expansion, s));
        }
        let states: Vec<f64> = expansion.states.iter().map(|series| value(series, s)).collect();
        let [all, same] = watch.noise(expansion.start + s, &states, order).ok()?;
        delay(series, s, NOISE * (all - same), |s| watch.value_beyond(expansion, s, compensation))
    }
}

/// How much later than `s` a guard with this series is zero by its value, where that is more than rounding and comes nearer to zero so.
pub(crate) fn delay(series: &[f64], s: f64, rounding: f64, mut at: impl FnMut(f64) -> f64) -> Option<f64> {
    let here = at(s);
    let delay = -here / slope(series, s);
    let is_near = delay.abs() <= MOST_DELAY * s;
    (here.abs() > rounding && is_near && at(s + delay).abs() < here.abs() * BETTER).then_some(delay)
}

/// Reach of the near ones' expansions.
pub(crate) fn radius(expansion: &Expansion) -> f64 {
    expansion.near.iter().fold(f64::INFINITY, |radius, near| of_own_size(&near.series, radius))
}

/// By how much each state can change within a step.
fn travel(expansion: &Expansion, length: f64) -> Row {
    expansion.states.iter().map(|series| polynomial::change(series, length)).collect()
}

impl Watch {
    /// `values` has the slopes of this lazily evaluated guard next.
    fn new(
        of: &Arc<WatchTape>,
        rounding: Rounding,
        inputs: &[f64],
        values: &mut impl Iterator<Item = f64>,
    ) -> Self {
        let plan = &of.plan;
        let slopes = plan.slopes.as_ref().map(|slopes| {
            let with_value = slopes.iter().zip(values.by_ref()).map(|(state, value)| (*state, value.abs()));
            with_value.collect()
        });
        let reach = if plan.has_reach { values.next() } else { None };
        Self {
            of: Arc::clone(of),
            inputs: plan.inputs.iter().map(|index| inputs[*index]).collect(),
            states: plan.states.clone(),
            slopes,
            reach: reach.unwrap_or(f64::INFINITY),
            group: plan.group,
            direction: plan.direction,
            rounding,
            clearance: 0.0,
            offset: rounding.is_nearest().then_some(0.0),
            jets: None,
            enclosure: None,
        }
    }

    /// How far it is at least from a zero that counts, where it was just evaluated to `here`.
    fn clear_of(&self, here: f64) -> f64 {
        let conditions = self.of.plan.of.conditions();
        if conditions == 0 {
            // Found beyond zero, by rounding, it is near however short the step.
            let is_beyond = self.direction != Direction::Both && self.direction.allows(here);
            return if is_beyond { 0.0 } else { here.abs() };
        }
        let jets = self.jets.as_ref().expect("it was just evaluated");
        let broken = (1..=conditions).map(|condition| -jets.value_of(condition));
        broken.fold(here.abs(), f64::max).min(self.reach)
    }

    /// Evaluates it if a step in which the states travel so far might bring it to zero, and expands it if it still might.
    fn approach(
        &mut self,
        index: usize,
        expansion: &mut Expansion,
        travel: &[f64],
        compensation: &[f64],
        order: usize,
    ) -> Result<(), Reason> {
        let needed = self.change(travel);
        if self.clearance > needed {
            return Ok(());
        }
        self.set_off(expansion, order)?;
        let here = self.start(expansion, compensation, order)?;
        self.clearance = self.clear_of(here);
        // NaN counts as near: the expansion then says what is wrong.
        if self.clearance <= needed || self.clearance.is_nan() {
            let near = self.expand(index, expansion, here, order)?;
            expansion.near.push(near);
        }
        Ok(())
    }

    /// By how much it can change while the states travel so far.
    fn change(&self, travel: &[f64]) -> f64 {
        match &self.slopes {
            None => f64::INFINITY,
            Some(slopes) => slopes.iter().map(|(state, slope)| slope * travel[*state]).sum(),
        }
    }

    fn jets(&mut self, order: usize) -> Result<&mut Jets<f64>, Reason> {
        if self.jets.is_none() {
            self.jets = Some(Jets::new(self.of.tape()?, order, &self.inputs));
        }
        Ok(self.jets.as_mut().expect("just built"))
    }

    /// Rounding error at an instant, and what of it is that of numbers and inputs.
    fn noise(&mut self, time: f64, states: &[f64], order: usize) -> Result<[f64; 2], Reason> {
        let tape = self.jets(order)?.tape().clone();
        let input = |value: &f64| Rounded { error: LEFT_OUT * Rounded::leaf(*value).error, value: *value };
        let inputs: Vec<Rounded> = self.inputs.iter().map(input).collect();
        let own: Vec<Rounded> = self.states.iter().map(|state| Rounded::splat(states[*state])).collect();
        let mut value = Jets::new(tape, 0, &inputs);
        value.set_errors_of_numbers(LEFT_OUT);
        let noise = |value: &mut Jets<Rounded>| {
            value.start(Rounded::computed(time), &own, Branches::Free);
            value.value_of(0).noise()
        };
        let all = noise(&mut value);
        value.settle();
        Ok([all, all - noise(&mut value)])
    }

    /// Finds what it is off by, once: guards that hold the same numbers are off by the same.
    fn set_off(&mut self, expansion: &Expansion, order: usize) -> Result<(), Reason> {
        if self.offset.is_none() {
            let states: Vec<f64> = expansion.states.iter().map(|series| series[0]).collect();
            let [_, same] = self.noise(expansion.start, &states, order)?;
            let same = if same.is_finite() { same } else { 0.0 };
            self.offset = Some(self.rounding.draw(same, NUMBERS) * same);
        }
        Ok(())
    }

    /// Value at the start of an expansion: at the rounded states, and what the compensations add to first order.
    fn start(&mut self, expansion: &Expansion, compensation: &[f64], order: usize) -> Result<f64, Reason> {
        let compensations: Row = self.states.iter().map(|state| compensation[*state]).collect();
        let states: Row = self.states.iter().map(|state| expansion.states[*state][0]).collect();
        let is_whole = order == 0 || compensations.iter().all(|compensation| *compensation == 0.0);
        self.jets(order)?;
        Ok(self.value_with((expansion.start, 0.0), &states, &compensations, is_whole))
    }

    /// Value at states, and what is left out of them and of the time adds to first order.
    fn value_with(
        &mut self,
        (time, left_out): (f64, f64),
        states: &[f64],
        compensations: &[f64],
        is_whole: bool,
    ) -> f64 {
        let offset = self.offset.unwrap_or(0.0);
        let jets = self.jets.as_mut().expect("a near lazy_guard was evaluated");
        jets.start(time, states, Branches::Free);
        if is_whole {
            return jets.value_of(0) + offset;
        }
        for (leaf, compensation) in compensations.iter().chain([&left_out]).enumerate() {
            jets.set(leaf, 1, *compensation);
        }
        jets.extend(1);
        jets.output(0)[0] + (jets.output(0)[1] + offset)
    }

    /// Value along an expansion at what the states are before they are rounded.
    fn value_beyond(&mut self, expansion: &Expansion, s: f64, compensation: &[f64]) -> f64 {
        let beyond = |state: &usize| {
            let series = &expansion.states[*state];
            rounded_sum(series[0], polynomial::increment(series, s) + compensation[*state])
        };
        let (states, compensations): (Vec<f64>, Vec<f64>) = self.states.iter().map(beyond).unzip();
        self.value_with(rounded_sum(expansion.start, s), &states, &compensations, false)
    }

    /// Its series along an expansion whose start it was just evaluated at.
    fn expand(
        &mut self,
        index: usize,
        expansion: &Expansion,
        here: f64,
        order: usize,
    ) -> Result<Near, Reason> {
        self.jets(order)?;
        let Self { jets: Some(jets), states, .. } = self else { unreachable!("just built") };
        let coefficient = |series: &[f64], k: usize| series.get(k).copied().unwrap_or(0.0);
        for k in 1..=order {
            for (leaf, state) in states.iter().enumerate() {
                jets.set(leaf, k, coefficient(&expansion.states[*state], k));
            }
            let series = expansion.time.as_ref();
            let time = series.map_or(f64::from(u8::from(k == 1)), |series| coefficient(series, k));
            jets.set(states.len(), k, time);
            jets.extend(k);
        }
        let mut series = Row::from_slice(jets.output(0));
        series[0] = here;
        let conditions = 1..=self.of.plan.of.conditions();
        let conditions = conditions.map(|condition| Row::from_slice(jets.output(condition))).collect();
        Ok(Near { index, series, conditions })
    }

    fn value(&mut self, expansion: &Expansion, s: f64) -> f64 {
        let states: Row = self.states.iter().map(|state| value(&expansion.states[*state], s)).collect();
        let time = expansion.time.as_ref().map_or(expansion.start + s, |series| value(series, s));
        let jets = self.jets.as_mut().expect("a near lazy_guard was evaluated");
        jets.start(time, &states, Branches::Free);
        jets.value_of(0) + self.offset.unwrap_or(0.0)
    }
}
