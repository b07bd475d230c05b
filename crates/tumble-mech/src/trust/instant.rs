//! The error of one quantity at one instant of a motion.

use std::collections::BTreeSet;
use std::sync::Arc;

use tumble_expr::{Branches, Drawn, Expr, Jets, Node, Rounding, is_short};
use tumble_ode::{MotionState, Occurrence, Side};

use crate::contact::Change;
use crate::evaluator::evaluate;
use crate::mode::Mode;
use crate::record::{Happening, Record};
use crate::run::{Run, RunError};
use crate::trust::check_run::CheckRun;
use crate::trust::errors::{self, Errors, larger};
use crate::trust::part::{Part, event_blur, instant_blur, kinematics};
use crate::trust::{SAFETY, ULPS};

/// Rates are differences over this part of a piece: far more than rounding tells apart, far less than anything changes in.
const RATE_PART: f64 = 1e-6;
/// And over as many spacings of the time, where the piece is that long: late in a long run rounding is coarse beside a short piece.
const RATE_ULPS: f64 = 1024.0;
/// Events before and after an instant that may belong on its other side.
const NEIGHBOURS: usize = 4;
/// The rounding error of a quantity, in units of the largest of those that were drawn.
const NOISE: f64 = 2.0;
/// Seeds of the draws.
const SEEDS: [u64; 4] = [0x6e6f_6973, 0x6265_6c6f, 0x7769_7468, 0x696e_2121];

/// An instant of a motion.
#[derive(Clone, Copy, Debug)]
pub struct At {
    /// When, s.
    pub time: f64,
    /// Which value is meant at an event.
    pub side: Side,
    /// Error of the time, s.
    pub off: f64,
}

impl Part {
    /// See [`super::Trust::error_at`].
    pub(super) fn error_at(&self, formula: &Expr, at: At) -> Result<Option<f64>, RunError> {
        let (run, motion) = (&self.run, self.run.motion());
        let Some(place) = motion.place_at(at.time, at.side) else { return Ok(None) };
        let mut quantity = Quantity::new(run, formula, &place)?;
        let noise = NOISE * quantity.noise();
        if !depends_on_motion(run, formula) {
            return Ok(Some(noise));
        }
        let Some(states) = self.states_at(at.time).filter(|_| at.time <= self.end()) else { return Ok(None) };
        let carried = quantity.carried(&states);
        let (mut along, is_compared) = (carried, at.time <= self.compared_end());
        if is_compared {
            let of = std::slice::from_ref(formula);
            let near = Errors::near(run, &self.checks, self.compared_end(), of, at.time)?;
            let direct = near.at(at.time).map(|errors| errors[0]);
            along = direct.filter(|direct| direct.is_finite() && *direct <= carried).unwrap_or(carried);
            // Between the places where the runs were compared they may be farther apart.
            along = larger(along, self.difference(formula, (quantity.value, at))?);
        }
        let rounded = if is_short(at.time) { 0.0 } else { f64::EPSILON * at.time };
        let moved = quantity.rate() * at.off.max(rounded) + self.jumps(formula, at)?;
        Ok(Some(along + noise + moved + self.run.left_open(formula, at.time, at.side)?))
    }

    /// The largest difference of a formula to the check runs at one instant, with their safety; zero where they do not come to it.
    /// `value` is what it is in the motion.
    fn difference(&self, formula: &Expr, (value, at): (f64, At)) -> Result<f64, RunError> {
        let mut worst = 0.0;
        for check in &self.checks {
            let found = errors::difference(check, formula, value, (at.time, at.side))?;
            worst = larger(worst, found.filter(|found| found.is_finite()).unwrap_or(0.0));
        }
        Ok(worst)
    }

    /// See [`super::Trust::compared`]; `found` is what it comes to in each check run.
    pub(super) fn compared(&self, formula: &Expr, at: At, found: &[f64]) -> Result<Option<f64>, RunError> {
        let motion = self.run.motion();
        let Some(place) = motion.place_at(at.time, at.side).filter(|_| at.time <= self.end()) else {
            return Ok(None);
        };
        let mut quantity = Quantity::new(&self.run, formula, &place)?;
        let off = |(check, found): (&CheckRun, &f64)| check.safety * (found - quantity.value).abs();
        let off = self.checks.iter().zip(found).map(off).fold(0.0, larger);
        let rounding = NOISE * quantity.noise() + ULPS * f64::EPSILON * quantity.value.abs();
        let blur = if at.off > 0.0 { quantity.rate() * instant_blur(&motion, at.time) } else { 0.0 };
        let moved = blur + self.jumps(formula, at)?;
        Ok(Some(off + rounding + moved + self.run.left_open(formula, at.time, at.side)?))
    }

    /// By how much the formula jumps at events that may come before the instant or after it; one that is itself the instant
    /// is asked for on one side, and then only what the end of a Zeno sequence leaves out counts: the bounces that were to come.
    fn jumps(&self, formula: &Expr, at: At) -> Result<f64, RunError> {
        let motion = self.run.motion();
        let events = &motion.events;
        let next = events.partition_point(|event| event.time < at.time);
        let near = next.saturating_sub(NEIGHBOURS)..(next + NEIGHBOURS).min(events.len());
        let mut sum = 0.0;
        for index in near {
            let time = events[index].time;
            let error = self.event_error(time).unwrap_or(0.0) + event_blur(&motion, time);
            let part = if time == at.time { self.left_out(&events[index])? } else { 1.0 };
            if part > 0.0 && (time - at.time).abs() <= error.max(at.off) {
                let sides = self.run.observe(std::slice::from_ref(formula))?.at_event(index);
                sum += part * sides.map_or(0.0, |[before, after]| (after[0] - before[0]).abs());
            }
        }
        Ok(if sum.is_finite() { sum } else { 0.0 })
    }

    /// The part of what an event changes that the end of a Zeno sequence in it leaves out: nothing of others. Of one contact that bounces with the
    /// restitution e all that is to come is e of the whole; several may pass to each other what is left, and nothing less than all is claimed.
    fn left_out(&self, event: &Occurrence<Record>) -> Result<f64, RunError> {
        if !event.record.ends_zeno_sequence() {
            return Ok(0.0);
        }
        let pairs = event.record.happened.iter().filter_map(|happening| match happening {
            Happening::Contact { pair, change: Change::Impact | Change::Zeno } => Some(*pair),
            _ => None,
        });
        let pairs: BTreeSet<usize> = pairs.collect();
        let [only] = Vec::from_iter(pairs)[..] else { return Ok(1.0) };
        let Run { equations, inputs, .. } = &self.run;
        let Some(restitution) = equations.pairs()[only].law.restitution() else { return Ok(1.0) };
        let mode = &self.run.trajectory().modes[event.mode_before];
        let restitution = std::slice::from_ref(restitution);
        let e = equations.values(restitution, mode, event.time, &event.before, inputs)?[0];
        Ok((SAFETY * e).min(1.0))
    }
}

/// See [`super::Trust::rounding_at`]; the run is one motion.
pub(super) fn rounding_at(
    run: &Run,
    formula: &Expr,
    (time, side): (f64, Side),
) -> Result<Option<f64>, RunError> {
    let motion = run.motion();
    let Some(place) = motion.place_at(time, side) else { return Ok(None) };
    Ok(Some(NOISE * Quantity::new(run, formula, &place)?.noise()))
}

/// Whether a formula holds anything of the motion, and not parameters alone.
pub fn depends_on_motion(run: &Run, formula: &Expr) -> bool {
    let parameters = run.equations.model().parameters.symbols();
    formula.symbols().iter().any(|symbol| !parameters.contains(symbol))
}

/// A formula at a place of the motion.
struct Quantity<'a> {
    run: &'a Run,
    formula: &'a Expr,
    place: &'a MotionState<'a>,
    jets: Jets<f64>,
    value: f64,
}

impl<'a> Quantity<'a> {
    fn new(run: &'a Run, formula: &'a Expr, place: &'a MotionState<'a>) -> Result<Self, RunError> {
        let mode = &run.trajectory().modes[place.mode];
        let jets = run.equations.evaluator(mode, std::slice::from_ref(formula), &run.inputs)?;
        let mut quantity = Self { run, formula, place, jets, value: 0.0 };
        quantity.value = quantity.at(place);
        Ok(quantity)
    }

    fn at(&mut self, place: &MotionState<'_>) -> f64 {
        evaluate(&mut self.jets, place);
        self.jets.value_of(0)
    }

    /// The rounding error of the formula itself, from numbers and states that are rounded: the largest of some that it may have. One that
    /// two parts of it have from one number goes out of their difference.
    fn noise(&self) -> f64 {
        SEEDS.into_iter().map(|seed| self.off(Rounding::perturbed(seed)).abs()).fold(0.0, larger)
    }

    /// One of those errors; zero where there is none that is a number.
    fn off(&self, rounding: Rounding) -> f64 {
        let (run, MotionState { time, states, .. }) = (self.run, self.place);
        let leaf = |(index, value): (usize, &f64), is_exact: bool| {
            Drawn::rounded(*value, is_exact, rounding, index as u64)
        };
        let number = |at: (usize, &f64)| leaf(at, is_short(*at.1));
        let state = |at: (usize, &f64)| leaf(at, *time == 0.0 && is_short(*at.1));
        let inputs: Vec<Drawn> = run.inputs.iter().enumerate().map(number).collect();
        let states: Vec<Drawn> = states.iter().enumerate().map(state).collect();
        let mut jets = Jets::new(Arc::new(self.jets.tape().rounded(rounding)), 0, &inputs);
        jets.start(number((states.len(), time)), &states, Branches::Free);
        let found = jets.value_of(0);
        let off = found.value - self.value + found.off();
        if off.is_finite() { off } else { 0.0 }
    }

    /// What errors of the states, by [`kinematics`], do to the value, each by itself.
    fn carried(&mut self, errors: &[f64]) -> f64 {
        let symbols = self.run.equations.states(&self.run.trajectory().modes[self.place.mode]);
        let known = kinematics(self.run);
        let mut sum = 0.0;
        for (state, symbol) in symbols.into_iter().enumerate() {
            let is_state = |known: &Expr| matches!(known.node(), Node::Symbol(known) if *known == symbol);
            let Some(index) = known.iter().position(is_state) else { continue };
            let change = |quantity: &mut Self, by: f64| {
                let mut place = quantity.place.clone();
                place.states[state] += by;
                (quantity.at(&place) - quantity.value).abs()
            };
            let error = errors[index];
            sum += change(self, error).max(change(self, -error));
        }
        sum
    }

    /// How fast the value changes, per s, on the way there: what an event comes to depends on what was before it.
    fn rate(&mut self) -> f64 {
        let Some(piece) = self.run.trajectory().piece_at(self.place.time, Side::Before) else { return 0.0 };
        // A joint that begins to hold brings states of its own, and so do bodies that are one motion with these from now on.
        let mode = &self.run.trajectory().modes[piece.mode];
        let names = |mode: &Mode| self.run.equations.states(mode);
        let mut other = None;
        if names(mode) != names(&self.run.trajectory().modes[self.place.mode]) {
            match self.run.equations.evaluator(mode, std::slice::from_ref(self.formula), &self.run.inputs) {
                Ok(jets) => other = Some(jets),
                Err(_) => return 0.0,
            }
        }
        let jets = other.as_mut().unwrap_or(&mut self.jets);
        let length = piece.end - piece.start;
        let step = (RATE_PART * length).max(RATE_ULPS * f64::EPSILON * self.place.time).min(length);
        let mut rate = 0.0_f64;
        for time in [self.place.time - step, self.place.time + step] {
            if time < piece.start || time > piece.end {
                continue;
            }
            let place = |time: f64| MotionState {
                mode: piece.mode,
                time,
                states: piece.states_at(time),
                piece: Some(piece),
            };
            let mut value = |time: f64| {
                evaluate(jets, &place(time));
                jets.value_of(0)
            };
            let change = value(time) - value(self.place.time);
            let change = change.abs() / (time - self.place.time).abs();
            rate = if change.is_finite() { rate.max(change) } else { rate };
        }
        rate
    }
}
