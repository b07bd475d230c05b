//! The motions of a model's components, each found by itself, and of several of them as one where a quantity reads several.

use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap};
use std::convert::Infallible;
use std::ops::ControlFlow;
use std::sync::{Arc, OnceLock};

use tumble_expr::Symbol;
use tumble_ode::{Accuracy, Cause, Event, Of, Reason, Refusal, Solver, Start};

use crate::cache::Cache;
use crate::equations::Equations;
use crate::mode::Mode;
use crate::record::{Happening, Record};
use crate::singular::Passages;

/// One motion at a time goes on by this part of the run: what it uses is at hand, and little is done in vain where another ends all.
const LEAD: f64 = 1.0 / 16.0;

type Motion = tumble_ode::Motion<Equations>;

/// Motions that go on beside each other, from one start to one end.
#[derive(Clone, Debug)]
pub(crate) struct Tracks {
    /// Which components they are of: one each, or all those of the only one.
    pub(crate) components: Vec<usize>,
    each: Vec<Arc<Motion>>,
    /// Whether an event of one of them has ended all.
    pub(crate) is_stopped: bool,
    /// Where each event is, in order of time: the motion and its index there.
    order: Arc<OnceLock<Vec<(usize, usize)>>>,
    /// All as one.
    whole: Arc<OnceLock<Arc<Motion>>>,
    joined: Cache<Vec<usize>, Motion>,
}

impl Tracks {
    /// The only motion, of all these components.
    pub(crate) fn one(components: Vec<usize>, motion: Arc<Motion>) -> Self {
        Self {
            components,
            each: vec![motion],
            is_stopped: false,
            order: Arc::default(),
            whole: Arc::default(),
            joined: Cache::default(),
        }
    }

    fn several(each: Vec<Motion>, is_stopped: bool) -> Self {
        Self {
            components: (0..each.len()).collect(),
            each: each.into_iter().map(Arc::new).collect(),
            is_stopped,
            order: Arc::default(),
            whole: Arc::default(),
            joined: Cache::default(),
        }
    }

    /// The motions, each by itself.
    pub(crate) fn each(&self) -> &[Arc<Motion>] {
        &self.each
    }

    /// All as one.
    pub(crate) fn whole(&self, equations: &Equations) -> &Arc<Motion> {
        match &self.each[..] {
            [one] => one,
            all => self.whole.get_or_init(|| {
                let all: Vec<&Motion> = all.iter().map(Arc::as_ref).collect();
                Arc::new(joined(equations, &all))
            }),
        }
    }

    /// Those of some components; all, where they are one motion already.
    pub(crate) fn of(&self, components: &[usize], equations: &Equations) -> Self {
        if self.each.len() == 1 {
            return self.clone();
        }
        let one = |motion| Self { is_stopped: self.is_stopped, ..Self::one(components.to_vec(), motion) };
        if components.len() == self.each.len() {
            return one(Arc::clone(self.whole(equations)));
        }
        if let [component] = components {
            return one(Arc::clone(&self.each[*component]));
        }
        let join = || {
            let some: Vec<&Motion> = components.iter().map(|index| &*self.each[*index]).collect();
            Ok::<_, Infallible>(joined(equations, &some))
        };
        let motion = self.joined.get(&components.to_vec(), join).unwrap_or_else(|never| match never {});
        one(motion)
    }

    /// Where each event is, in order of time: the motion and its index there.
    pub(crate) fn events(&self) -> &[(usize, usize)] {
        self.order.get_or_init(|| {
            let each = self.each.iter().enumerate();
            let places = each.flat_map(|(of, motion)| (0..motion.events.len()).map(move |index| (of, index)));
            let mut all: Vec<(usize, usize)> = places.collect();
            all.sort_by(|a, b| self.event(*a).time.total_cmp(&self.event(*b).time));
            all
        })
    }

    /// An event by where it is.
    pub(crate) fn event(&self, (of, index): (usize, usize)) -> &Event<Record> {
        &self.each[of].events[index]
    }
}

/// Motions of several components as one.
fn joined(equations: &Equations, parts: &[&Motion]) -> Motion {
    let as_one = |modes: &[&Mode]| {
        let mode = equations.as_one(modes);
        let names: Vec<_> = modes.iter().map(|mode| equations.states(mode)).collect();
        let place = |symbol: &Symbol| -> Of {
            let mut found = names
                .iter()
                .enumerate()
                .filter_map(|(part, own)| Some([part, own.iter().position(|known| known == symbol)?]));
            found.next().expect("a state of all is that of one")
        };
        let layout = equations.states(&mode).iter().map(place).collect();
        (mode, layout)
    };
    Motion::joined(parts, &as_one)
}

impl Equations {
    /// The motions from a start, with why they could not all go on to the end, and which of them; `progress` is told the time that
    /// all have come to.
    pub(crate) fn follow(
        &self,
        start: &Start<Mode>,
        until: f64,
        accuracy: Accuracy,
        progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> (Tracks, Option<(usize, Refusal)>) {
        let components = self.components().all();
        let starts = Starts::of(self, start);
        let solver = |bodies: &Vec<usize>| Solver::new(self, starts.of_some(bodies), until, accuracy);
        let mut race = Race::new(components.iter().map(solver).collect(), &start.inputs, until - start.time);
        let refused = race.run(self, progress);
        let is_stopped = race.end.is_some() && refused.is_none();
        let tracks = race.finish();
        match components {
            [_] => {
                (Tracks::one(vec![0], Arc::new(tracks.into_iter().next().expect("one component"))), refused)
            }
            _ => (Tracks::several(tracks, is_stopped), refused),
        }
    }
}

/// A start of all bodies, to be taken apart.
struct Starts<'a> {
    equations: &'a Equations,
    whole: &'a Start<Mode>,
    /// Where each state is.
    places: HashMap<Symbol, usize>,
    apart: Vec<usize>,
}

impl<'a> Starts<'a> {
    fn of(equations: &'a Equations, whole: &'a Start<Mode>) -> Self {
        let places = equations.states(&whole.mode).into_iter().enumerate();
        let places = places.map(|(place, symbol)| (symbol, place)).collect();
        Self { equations, whole, places, apart: equations.apart(&whole.mode) }
    }

    /// The start of some bodies alone.
    fn of_some(&self, bodies: &[usize]) -> Start<Mode> {
        let Self { equations, whole, .. } = self;
        let mode = equations.restricted(&whole.mode, bodies);
        let places: Vec<usize> = equations.states(&mode).iter().map(|symbol| self.places[symbol]).collect();
        let some = |of: &[f64]| places.iter().map(|place| of[*place]).collect();
        let apart = equations.apart(&mode);
        let causes = whole.causes.iter().filter_map(|cause| match cause {
            Cause::LazyGuard(index) => apart.binary_search(&self.apart[*index]).ok().map(Cause::LazyGuard),
            other => Some(*other),
        });
        Start {
            states: some(&whole.states),
            compensation: some(&whole.compensation),
            causes: causes.collect(),
            inputs: whole.inputs.clone(),
            mode,
            ..**whole
        }
    }
}

/// Motions beside each other: the one that is furthest behind goes on next, so that none is far beyond where all end; what is
/// beyond is cut off.
struct Race<'a> {
    solvers: Vec<Solver<'a, Equations>>,
    inputs: &'a [f64],
    /// What each has seen of singular configurations on its way.
    passages: Vec<Passages>,
    /// Of those that have come to rest for good, when.
    rest: Vec<Option<f64>>,
    /// The first that may not be at rest.
    witness: usize,
    /// When all end, if not where they were to.
    end: Option<f64>,
    /// Why that is, where it is no event, and which of them is at fault.
    refused: Option<(usize, Refusal)>,
    /// By how much one may lead all others, s.
    lead: f64,
}

impl<'a> Race<'a> {
    fn new(mut solvers: Vec<Solver<'a, Equations>>, inputs: &'a [f64], span: f64) -> Self {
        if let Some((first, others)) = solvers.split_first_mut() {
            others.iter_mut().for_each(|other| other.share_memory(first));
        }
        Self {
            inputs,
            passages: solvers.iter().map(|_| Passages::default()).collect(),
            rest: vec![None; solvers.len()],
            solvers,
            witness: 0,
            end: None,
            refused: None,
            lead: span * LEAD,
        }
    }

    /// Goes on until all have ended; why that is too early, if it is, and which of them is at fault.
    fn run(
        &mut self,
        equations: &Equations,
        progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Option<(usize, Refusal)> {
        let mut behind: BinaryHeap<Reverse<(Time, usize)>> =
            (0..self.solvers.len()).map(|index| Reverse((Time(self.solvers[index].time()), index))).collect();
        while let Some(Reverse((Time(time), index))) = behind.pop() {
            if self.end.is_some_and(|end| time >= end) {
                break;
            }
            let next = behind.peek().map_or(f64::INFINITY, |Reverse((Time(time), _))| *time);
            if self.lead(index, next, equations, progress).is_break() {
                let time = next.min(self.solvers[index].time());
                self.end = Some(time);
                return Some((index, Refusal { time, reason: Reason::Interrupted }));
            }
            self.end_at_rest(equations);
            let solver = &self.solvers[index];
            let is_refused = self.refused.as_ref().is_some_and(|(refused, _)| *refused == index);
            if !solver.is_done() && !is_refused {
                behind.push(Reverse((Time(solver.time()), index)));
            }
        }
        self.refused.take()
    }

    /// Lets one that is furthest behind go on until it leads by some time; `next` is that of the one after it. Whether it was
    /// interrupted.
    fn lead(
        &mut self,
        index: usize,
        next: f64,
        equations: &Equations,
        progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        loop {
            let solver = &mut self.solvers[index];
            let refusal = solver.advance().err();
            if let Some(refusal) = self.passages[index].watch(equations, solver, self.inputs, refusal) {
                if self.end.is_none_or(|end| refusal.time < end) {
                    self.end = Some(refusal.time);
                    self.refused = Some((index, refusal));
                }
                return ControlFlow::Continue(());
            }
            let (time, is_done) = (solver.time(), solver.is_done());
            if solver.is_stopped() && self.end.is_none_or(|end| time < end) {
                self.end = Some(time);
                self.refused = None;
            }
            let is_rest = |record: &Record| record.happened.contains(&Happening::Rest);
            if self.solvers[index].last_record().is_some_and(is_rest) {
                self.rest[index] = Some(time);
            }
            let is_last = is_done && next.is_infinite();
            if progress(time.min(next)).is_break() && !is_last {
                return ControlFlow::Break(());
            }
            if is_done || time > next + self.lead || self.end.is_some_and(|end| time >= end) {
                return ControlFlow::Continue(());
            }
        }
    }

    /// Ends the motions where the last of them has come to rest, once one has: the others may lie still from the start.
    fn end_at_rest(&mut self, equations: &Equations) {
        if !equations.model().stops_at_rest || self.rest.iter().all(Option::is_none) {
            return;
        }
        // All before this one are known to be at rest.
        while let Some(rest) = self.rest.get_mut(self.witness) {
            let lies_still = || equations.are_at_rest(&self.solvers[self.witness].now()?).then_some(0.0);
            *rest = rest.or_else(lies_still);
            if rest.is_none() {
                return;
            }
            self.witness += 1;
        }
        let last = self.rest.iter().flatten().copied().fold(0.0, f64::max);
        if self.end.is_none_or(|end| last < end) {
            self.end = Some(last);
            self.refused = None;
        }
    }

    fn finish(self) -> Vec<Motion> {
        let Self { solvers, rest, end, .. } = self;
        let last = end.and_then(|end| rest.iter().position(|rest| *rest == Some(end)));
        let mut found: Vec<Motion> = solvers.into_iter().map(Solver::finish).collect();
        for (index, motion) in found.iter_mut().enumerate() {
            if let Some(end) = end {
                motion.cut(end);
            }
            // All have come to rest when the last of them has.
            if rest[index].is_some() && last != Some(index) {
                forget_rest(motion);
            }
        }
        found
    }
}

/// Takes out that these bodies have come to rest, and the events that were nothing else.
fn forget_rest(motion: &mut Motion) {
    motion.events.retain_mut(|event| {
        let was_something = !event.record.happened.is_empty();
        event.record.happened.retain(|happening| *happening != Happening::Rest);
        let is_something = !event.record.happened.is_empty() || event.before != event.after;
        is_something || (was_something && event.mode_before != event.mode_after)
    });
}

/// A time that is compared as a number.
#[derive(Clone, Copy, PartialEq)]
struct Time(f64);

impl Eq for Time {}

impl PartialOrd for Time {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Time {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.0.total_cmp(&other.0)
    }
}
