//! The islands of one component on their way: what is coupled now is one motion, with its own mode, steps, scales and errors.
//!
//! # Law
//! Each island proposes its next step. The one whose step ends first takes it, and carries out the jump at its end; what the others
//! have proposed reaches beyond, so that a step is shortened at most and no event is ever undone. An event that reads several islands,
//! or acts on them, is no guard of any of them. It is shown not to come within a step that is taken, by ranges of its function along what
//! the islands have proposed (`watch`); where that cannot be shown, their steps end there and they are one island for a while, in
//! whose mode the event is a guard like any other: it is located and carried out as in one motion. So are bodies that may meet: circles
//! about them are shown to be apart (`near`). An island falls apart where no joint or contact holds it together and no such event is near.
//!
//! # Symbols and units
//! Times in s; groups and components as in [`crate::components`].
//!
//! # Sign and frame
//! None.
//!
//! # Validity
//! A jump of one island may carry a function across zero that others have a part in: its event comes then, at the same instant, as a
//! jump of all of them. Of two islands that come to one instant the one that came to be first goes first.
//!
//! # Source
//! The design of conservative simulation in parallel: Chandy and Misra, IEEE Trans. Software Eng. SE-5 (1979). Islands that take
//! steps back instead: Mirtich, Timewarp rigid body simulation, SIGGRAPH 2000.
//!
//! # Checked by
//! `tests/islands.rs`: the same motion as in one island, beside it and against closed forms.

mod join;
mod near;
mod race;
mod start;
mod watch;

use tumble_ode::{Accuracy, Refusal, Solver};

use crate::contact::Surrounding;
use crate::equations::Equations;
use crate::islands::near::Near;
use crate::islands::start::Places;
use crate::islands::watch::{Along, Of, Sight, Watch};
use crate::parameters::time_symbol;
use crate::record::Happening;
use crate::singular::Passages;
use crate::tracks::Track;
pub(crate) use race::{Reached, Refused};

/// The islands of a component, and what has become of those before them.
struct Islands<'a> {
    equations: &'a Equations,
    inputs: &'a [f64],
    until: f64,
    accuracy: Accuracy,
    /// In the order in which they came to be.
    all: Vec<Island<'a>>,
    /// Each with how many came to be before it.
    finished: Vec<(usize, Track)>,
    born: usize,
    /// Events that several groups have a part in, and bodies of several that are near each other.
    watches: Vec<Watch>,
    near: Near<'a>,
    /// When all end, if not where they were to, s.
    end: Option<f64>,
    /// Why that is, where it is no event, and which of them is at fault.
    refused: Option<(usize, Refusal)>,
}

/// Groups that are one motion now.
struct Island<'a> {
    /// How many came to be before it.
    born: usize,
    groups: Vec<usize>,
    solver: Solver<'a, Equations>,
    /// What it has seen of singular configurations on its way.
    passages: Passages,
    /// When it came to rest for good, if it has.
    rest: Option<f64>,
    has_begun: bool,
    /// When the step that it has proposed ends, s.
    end: f64,
    /// Whether it has been refused.
    is_refused: bool,
    /// Steps to be taken before it may fall apart.
    wait: u32,
    /// Where its bodies are up to the horizon.
    circles: Vec<Surrounding>,
    /// Whether what it does next has changed since that was looked at.
    is_stale: bool,
}

/// Events of several islands that may come.
struct Meeting {
    /// Which of the watches.
    watches: Vec<usize>,
    /// s
    time: f64,
    /// Whether they have come: a jump of one of them has carried them across zero.
    is_now: bool,
}

impl<'a> Islands<'a> {
    /// The islands of a component at the start.
    fn new(
        equations: &'a Equations,
        component: usize,
        places: &Places<'a>,
        until: f64,
        accuracy: Accuracy,
    ) -> Self {
        let components = equations.components();
        let groups = &components.all()[component];
        let mut islands = Self {
            equations,
            inputs: &places.start().inputs,
            until,
            accuracy,
            all: vec![],
            finished: vec![],
            born: 0,
            watches: Watch::all(equations, component, places.start().time),
            near: Near::of(equations, groups, places, until),
            end: None,
            refused: None,
        };
        for own in islands.together(places.start(), equations.coupled(&places.start().mode, groups)) {
            let start = places.of_some(&components.bodies_of(&own));
            islands.add(own, Solver::new(equations, start, until, accuracy), None, 1);
        }
        islands
    }

    fn add(&mut self, groups: Vec<usize>, solver: Solver<'a, Equations>, rest: Option<f64>, wait: u32) {
        let passages = Passages::default();
        let (has_begun, is_refused) = (false, false);
        self.all.push(Island {
            born: self.born,
            groups,
            solver,
            passages,
            rest,
            has_begun,
            end: f64::NEG_INFINITY,
            is_refused,
            wait,
            circles: vec![],
            is_stale: true,
        });
        self.born += 1;
        self.disturb(self.all.len() - 1);
    }

    /// Time up to which all are known, s.
    fn time(&self) -> f64 {
        self.all.iter().map(|island| island.solver.time()).fold(f64::INFINITY, f64::min)
    }

    fn is_done(&self) -> bool {
        self.all.iter().all(|island| self.is_over(island))
    }

    fn is_over(&self, island: &Island<'_>) -> bool {
        let is_beyond = self.end.is_some_and(|end| island.solver.time() >= end);
        island.is_refused || island.solver.is_done() || is_beyond
    }

    /// Goes on by one step of the island whose step ends first, or by making one of several.
    fn advance(&mut self) {
        let Some((next, end)) = self.propose() else { return };
        match self.meeting() {
            Some(meeting) if meeting.time < end => self.merge(&meeting),
            _ if self.near.horizon < end => self.look_further(),
            _ => self.take(next),
        }
    }

    /// Finds the next steps; which ends first, and when, s. `None` where there is none, or other islands have come to be at the start
    /// of one.
    fn propose(&mut self) -> Option<(usize, f64)> {
        let mut first: Option<(usize, f64)> = None;
        for index in 0..self.all.len() {
            if self.is_over(&self.all[index]) {
                continue;
            }
            if !std::mem::replace(&mut self.all[index].has_begun, true) {
                let refusal = self.all[index].solver.begin().err();
                self.look_ahead(index, refusal);
                if self.follow_jump(index) {
                    return None;
                }
                if self.is_over(&self.all[index]) {
                    continue;
                }
            }
            match self.propose_own(index) {
                Ok(end) => {
                    if self.all[index].end != end {
                        self.all[index].end = end;
                        self.disturb(index);
                    }
                    if first.is_none_or(|(_, known)| end < known) {
                        first = Some((index, end));
                    }
                }
                Err(refusal) => self.look_ahead(index, Some(refusal)),
            }
        }
        let (next, end) = first?;
        let limit = self.end.map_or(end, |limit| end.min(limit));
        if limit < end {
            self.all[next].solver.cut_short(limit);
        }
        Some((next, limit))
    }

    /// Finds the next step of an island, short where its bodies may soon go different ways; the time at which it ends, s.
    fn propose_own(&mut self, index: usize) -> Result<f64, Refusal> {
        let Self { all, near, equations, .. } = self;
        let Island { solver, groups, .. } = &mut all[index];
        let is_new = !solver.has_proposal();
        let end = solver.propose()?;
        let is_loose = is_new
            && groups.len() > 1
            && near.has_any()
            && solver.now().is_some_and(|now| equations.coupled(now.mode, groups).len() > 1);
        let shorter = solver.time() + near.stride();
        if !is_loose || end <= shorter || shorter <= solver.time() {
            return Ok(end);
        }
        solver.cut_short(shorter);
        solver.propose()
    }

    /// Looks ahead for singular configurations, and ends all where an island was refused.
    fn look_ahead(&mut self, index: usize, refusal: Option<Refusal>) {
        let island = &mut self.all[index];
        let refusal = island.passages.watch(self.equations, &mut island.solver, self.inputs, refusal);
        if let Some(refusal) = refusal {
            island.is_refused = true;
            let born = island.born;
            self.disturb(index);
            if self.end_at(refusal.time) {
                self.refused = Some((born, refusal));
            }
        }
    }

    /// Ends all at a time, s; `false` where they end before it.
    fn end_at(&mut self, time: f64) -> bool {
        let is_first = self.end.is_none_or(|end| time < end);
        if is_first {
            self.end = Some(time);
            self.refused = None;
        }
        is_first
    }

    /// The first event of several islands that may come within the steps that they have proposed.
    fn meeting(&mut self) -> Option<Meeting> {
        self.see_who_is_near();
        let mut first: Option<Meeting> = None;
        for watch in 0..self.watches.len() {
            if std::mem::take(&mut self.watches[watch].is_stale) {
                self.look(watch);
            }
            if let Some(time) = self.watches[watch].doubt()
                && first.as_ref().is_none_or(|known| time < known.time)
            {
                first = Some(Meeting { watches: vec![watch], time, is_now: false });
            }
        }
        first
    }

    /// The events that an island has a part in are to be looked at again.
    fn disturb(&mut self, index: usize) {
        self.all[index].is_stale = true;
        let groups = &self.all[index].groups;
        for watch in self.watches.iter_mut().filter(|watch| watch.is_of(groups)) {
            watch.is_stale = true;
        }
    }

    /// Islands that have a part in an event, in order.
    fn of_watch(&self, watch: usize) -> Vec<usize> {
        self.of_watches(&[watch])
    }

    /// Islands that have a part in any of several events, in order.
    fn of_watches(&self, watches: &[usize]) -> Vec<usize> {
        let has =
            |island: &Island<'_>| watches.iter().any(|watch| self.watches[*watch].is_of(&island.groups));
        (0..self.all.len()).filter(|index| has(&self.all[*index])).collect()
    }

    /// Watches the bodies that are near others up to the horizon, of the islands whose next steps are new.
    fn see_who_is_near(&mut self) {
        if !self.near.has_any() {
            return;
        }
        let stale: Vec<usize> = (0..self.all.len()).filter(|index| self.all[*index].is_stale).collect();
        for &index in &stale {
            let (from, to) = (self.all[index].solver.time(), self.near.horizon);
            self.all[index].circles = self.circles(index, [from, to]);
        }
        for index in stale {
            self.all[index].is_stale = false;
            for other in (0..self.all.len()).filter(|other| *other != index) {
                let pairs: Vec<[usize; 2]> =
                    self.near.meeting(&self.all[index].circles, &self.all[other].circles).collect();
                let time = self.all[index].solver.time().max(self.all[other].solver.time());
                pairs.into_iter().for_each(|bodies| self.watch_bodies(bodies, time));
            }
        }
    }

    fn watch_bodies(&mut self, bodies: [usize; 2], time: f64) {
        if !self.watches.iter().any(|watch| watch.of == Of::Bodies(bodies)) {
            self.watches.push(Watch::of_bodies(self.equations, bodies, time));
        }
    }

    /// Where bodies of an island are from one time to another, as far as its next step goes.
    fn circles(&self, index: usize, [from, to]: [f64; 2]) -> Vec<Surrounding> {
        let Some(Along { mode, piece }) = self.all[index].along() else { return vec![] };
        self.near.along(&mode, &piece, [from, to.min(piece.end)])
    }

    /// Takes the horizon further, and forgets bodies that are far from each other up to there.
    fn look_further(&mut self) {
        let Self { all, near, .. } = self;
        let from = near.horizon;
        let along: Vec<Along> = all.iter().filter_map(Island::along).collect();
        let circles = |near: &Near<'_>, to: f64| -> Vec<Surrounding> {
            let circles = along.iter().flat_map(|Along { mode, piece }| {
                near.along(mode, piece, [from.min(piece.end), to.min(piece.end)])
            });
            circles.collect()
        };
        near.go_further(&circles);
        let known = circles(near, near.horizon);
        let near_each_other = near.all_meeting(&known);
        self.watches.retain(|watch| match watch.of {
            Of::Event(_) => true,
            Of::Bodies(bodies) => near_each_other.contains(&bodies),
        });
        for index in 0..self.all.len() {
            self.disturb(index);
        }
    }

    /// Looks whether an event may come within the steps that its islands have proposed.
    fn look(&mut self, watch: usize) {
        let of = self.of_watch(watch);
        let Self { all, watches, equations, inputs, near, .. } = self;
        let watch = &mut watches[watch];
        if of.len() < 2 {
            return watch.clear();
        }
        let read = of.into_iter().map(|index| &all[index]).filter(|island| watch.reads(&island.groups));
        let read: Vec<&Island<'_>> = read.collect();
        let ends = read.iter().map(|island| match island.solver.is_done() || island.is_refused {
            true => island.solver.time(),
            false => island.end,
        });
        let limit = if watch.of_event().is_some() { f64::INFINITY } else { near.horizon };
        let to = ends.fold(limit, f64::min);
        // One that could not begin has ended all.
        let along = || read.iter().map(|island| island.along()).collect::<Option<Vec<_>>>();
        if !watch.is_settled(to)
            && let Some(along) = along()
        {
            watch.look(&Sight { equations, inputs, near }, &along, to);
        }
    }

    /// Lets an island take the step that it has proposed.
    fn take(&mut self, index: usize) {
        let island = &mut self.all[index];
        let refusal = island.solver.take().err();
        island.wait = island.wait.saturating_sub(1);
        self.disturb(index);
        self.look_ahead(index, refusal);
        if !self.follow_jump(index) {
            self.part(index);
        }
    }

    /// Deals with what the jump of an island, if there was one just now, does to all; whether other islands have come to be.
    fn follow_jump(&mut self, index: usize) -> bool {
        let watches = self.see_jump(index);
        let is_any = !watches.is_empty();
        if is_any {
            let time = self.all[index].solver.time();
            self.merge(&Meeting { watches, time, is_now: true });
        }
        is_any
    }

    /// Sees whether the jump of an island, if there was one just now, has ended its motion, or all; events of several islands that it
    /// has made happen.
    fn see_jump(&mut self, index: usize) -> Vec<usize> {
        let island = &mut self.all[index];
        let time = island.solver.time();
        let Some(record) = island.solver.last_record() else { return vec![] };
        if record.happened.contains(&Happening::Rest) {
            island.rest = Some(time);
        }
        if island.solver.is_stopped() {
            self.end_at(time);
        }
        self.carried(index)
    }

    /// Events of several islands that the jump of one has made happen.
    fn carried(&self, index: usize) -> Vec<usize> {
        let time = self.all[index].solver.time();
        let is_carried = |watch: &usize| {
            if self.watches[*watch].of_event().is_none() {
                return false;
            }
            let reads = |island: &usize| self.watches[*watch].reads(&self.all[*island].groups);
            if !reads(&index) {
                return false;
            }
            let of = self.of_watch(*watch);
            if of.len() < 2 {
                return false;
            }
            let others = of.into_iter().filter(|other| *other != index && reads(other));
            let others: Vec<usize> = others.collect();
            let others: Option<Vec<_>> = others.into_iter().map(|other| self.all[other].at(time)).collect();
            let (equations, inputs) = (self.equations, self.inputs);
            others.is_some_and(|others| {
                self.watches[*watch].is_crossed(equations, inputs, &self.all[index].solver, &others)
            })
        };
        (0..self.watches.len()).filter(is_carried).collect()
    }

    /// When the last of them has come to rest for good, s: 0 of those that lie still. `None` where any may still move.
    fn rest(&self) -> Option<f64> {
        let t = time_symbol();
        let model = self.equations.model();
        let mut events = self.watches.iter().filter_map(Watch::of_event);
        if events.any(|event| model.events[event].when.symbols().contains(&t)) {
            return None;
        }
        let rests = self.all.iter().map(|island| {
            let lies_still = || self.equations.are_at_rest(&island.solver.now()?).then_some(0.0);
            island.rest.or_else(lies_still)
        });
        rests.into_iter().try_fold(0.0, |last: f64, rest| Some(last.max(rest?)))
    }

    /// Whether any of them has come to rest.
    fn has_rest(&self) -> bool {
        self.all.iter().any(|island| island.rest.is_some())
    }

    /// All motions as far as they are found, in the order in which they came to be.
    fn so_far(&self) -> Vec<Track> {
        let on_their_way = self.all.iter().map(|Island { born, groups, solver, .. }| {
            (*born, Track { groups: groups.clone(), motion: solver.so_far().into() })
        });
        let mut all: Vec<_> = self.finished.iter().cloned().chain(on_their_way).collect();
        all.sort_by_key(|(born, _)| *born);
        all.into_iter().map(|(_, track)| track).collect()
    }

    /// All motions in the order in which they came to be, and which of them was refused.
    fn finish(self) -> (Vec<Track>, Option<usize>) {
        let Self { all, mut finished, refused, .. } = self;
        for Island { born, groups, solver, .. } in all {
            finished.push((born, Track { groups, motion: solver.hand_over().0.into() }));
        }
        finished.sort_by_key(|(born, _)| *born);
        let at_fault = refused.and_then(|(born, _)| finished.iter().position(|(own, _)| *own == born));
        (finished.into_iter().map(|(_, track)| track).collect(), at_fault)
    }
}
