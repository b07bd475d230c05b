//! The islands of one component on their way: what is coupled now is one motion, with its own mode, steps, scales and errors.
//!
//! # Law
//! Each island proposes its next step. The one whose step ends first takes it, and carries out the jump at its end; what the others
//! have proposed reaches beyond, so that a step is shortened at most and no event is ever undone. An event that reads several islands,
//! or acts on them, is no guard of any of them. It is shown not to come within a step that is taken, by ranges of its function along what
//! the islands have proposed (`watch`); where that cannot be shown, their steps end there and they are one island for a while, in
//! whose mode the event is a guard like any other: it is located and carried out as in one motion. An island falls apart where no joint holds
//! it together and no such event is near.
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

mod race;
mod start;
mod watch;

use tumble_ode::{Accuracy, Carried, Cause, Handover, Refusal, Solver};

use crate::equations::Equations;
use crate::islands::start::Places;
use crate::islands::watch::Watch;
use crate::mode::Mode;
use crate::parameters::time_symbol;
use crate::record::Happening;
use crate::singular::Passages;
use crate::tracks::Track;
pub(crate) use race::Refused;

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
    /// Events that several groups have a part in.
    watches: Vec<Watch>,
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
    /// Whether it has been refused.
    is_refused: bool,
    /// Steps to be taken before it may fall apart.
    wait: u32,
}

/// An event of several islands that may come.
#[derive(Clone, Copy)]
struct Meeting {
    /// Which of the watches.
    watch: usize,
    /// s
    time: f64,
    /// Whether it has come: a jump of one of them has carried it across zero.
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
            end: None,
            refused: None,
        };
        for own in equations.coupled(&places.start().mode, groups) {
            let start = places.of_some(&components.bodies_of(&own));
            islands.add(own, Solver::new(equations, start, until, accuracy), None, 1);
        }
        islands
    }

    fn add(&mut self, groups: Vec<usize>, solver: Solver<'a, Equations>, rest: Option<f64>, wait: u32) {
        let passages = Passages::default();
        self.all.push(Island { born: self.born, groups, solver, passages, rest, is_refused: false, wait });
        self.born += 1;
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

    /// Goes on by one step of the island that is furthest behind, or by making one of several.
    fn advance(&mut self) {
        let Some((next, end)) = self.propose() else { return };
        match self.meeting(next, end) {
            Some(meeting) => self.merge(meeting),
            None => self.take(next),
        }
    }

    /// Finds the next steps; which ends first, and when, s.
    fn propose(&mut self) -> Option<(usize, f64)> {
        let mut first: Option<(usize, f64)> = None;
        for index in 0..self.all.len() {
            if self.is_over(&self.all[index]) {
                continue;
            }
            match self.all[index].solver.propose() {
                Ok(end) if first.is_none_or(|(_, known)| end < known) => first = Some((index, end)),
                Ok(_) => {}
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

    /// Looks ahead for singular configurations, and ends all where an island was refused.
    fn look_ahead(&mut self, index: usize, refusal: Option<Refusal>) {
        let island = &mut self.all[index];
        let refusal = island.passages.watch(self.equations, &mut island.solver, self.inputs, refusal);
        if let Some(refusal) = refusal {
            island.is_refused = true;
            let born = island.born;
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

    /// The first event of several islands that may come before one takes its step, which ends at `end`.
    fn meeting(&mut self, next: usize, end: f64) -> Option<Meeting> {
        let (mut moved, mut limit, mut found) = (vec![next], end, None);
        // What ends the steps of some earlier may be known less far of others that they meet.
        loop {
            let mut first: Option<Meeting> = None;
            for watch in 0..self.watches.len() {
                let of = self.of_watch(watch);
                if of.len() < 2 || !of.iter().any(|island| moved.contains(island)) {
                    continue;
                }
                let time = self.known(watch, &of, limit);
                if time < first.map_or(limit, |known| known.time) {
                    first = Some(Meeting { watch, time, is_now: false });
                }
            }
            let Some(meeting) = first else { return found };
            (moved, limit, found) = (self.of_watch(meeting.watch), meeting.time, Some(meeting));
        }
    }

    /// Islands that have a part in an event, in order.
    fn of_watch(&self, watch: usize) -> Vec<usize> {
        let groups = &self.watches[watch].groups;
        let has = |island: &Island<'_>| groups.iter().any(|group| island.groups.contains(group));
        (0..self.all.len()).filter(|index| has(&self.all[*index])).collect()
    }

    /// Time up to which an event is known not to come, at most `to`, s.
    fn known(&mut self, watch: usize, of: &[usize], to: f64) -> f64 {
        let Self { all, watches, equations, inputs, .. } = self;
        let along: Option<Vec<_>> = of.iter().map(|island| all[*island].along()).collect();
        along.map_or(f64::NEG_INFINITY, |along| watches[watch].known_to(equations, inputs, &along, to))
    }

    /// Lets an island take the step that it has proposed.
    fn take(&mut self, index: usize) {
        let island = &mut self.all[index];
        let refusal = island.solver.take().err();
        island.wait = island.wait.saturating_sub(1);
        self.look_ahead(index, refusal);
        let island = &mut self.all[index];
        let (time, is_stopped) = (island.solver.time(), island.solver.is_stopped());
        let happened = island.solver.last_record().map(|record| record.happened.contains(&Happening::Rest));
        if happened == Some(true) {
            island.rest = Some(time);
        }
        if is_stopped {
            self.end_at(time);
        }
        match happened.and_then(|_| self.carried(index)) {
            Some(meeting) => self.merge(meeting),
            None => self.part(index),
        }
    }

    /// An event of several islands that the jump of one has made happen.
    fn carried(&self, index: usize) -> Option<Meeting> {
        let time = self.all[index].solver.time();
        (0..self.watches.len()).find_map(|watch| {
            let of = self.of_watch(watch);
            let others: Vec<_> = of.iter().filter(|other| **other != index).collect();
            if others.len() + 1 != of.len() || others.is_empty() {
                return None;
            }
            let others: Option<Vec<_>> = others.into_iter().map(|other| self.all[*other].at(time)).collect();
            let others = others?;
            let is_now =
                self.watches[watch].is_crossed(self.equations, self.inputs, &self.all[index].solver, &others);
            is_now.then_some(Meeting { watch, time, is_now })
        })
    }

    /// Makes one island of those that have a part in an event.
    fn merge(&mut self, Meeting { watch, time, is_now }: Meeting) {
        let of = self.of_watch(watch);
        for &index in &of {
            let island = &mut self.all[index];
            island.solver.cut_short(time);
            let refusal = island.solver.take().err();
            self.look_ahead(index, refusal);
        }
        if of.iter().any(|index| self.all[*index].is_refused) {
            return;
        }
        let rests: Vec<Option<f64>> = of.iter().map(|index| self.all[*index].rest).collect();
        let rest = rests.into_iter().try_fold(0.0, |last: f64, rest| Some(last.max(rest?)));
        let (mut groups, mut handovers) = (vec![], vec![]);
        for &index in of.iter().rev() {
            let (own, handover) = self.hand_over(index);
            groups.extend(own);
            handovers.push(handover);
        }
        groups.sort_unstable();
        handovers.reverse();
        let mut handover = joined(self.equations, handovers);
        if is_now {
            let events = self.equations.events(&handover.start.mode);
            let guard = events.iter().position(|event| *event == self.watches[watch].event);
            handover.start.causes.extend(guard.map(Cause::Guard));
        }
        let wait = self.watches[watch].met(time);
        for watch in self.watches.iter_mut().filter(|watch| watch.is_of(&groups)) {
            watch.forget_after(time);
        }
        let solver = Solver::resumed(self.equations, handover, self.until, self.accuracy);
        self.add(groups, solver, rest, wait);
    }

    /// Ends an island where it is; its groups, and what it hands over.
    fn hand_over(&mut self, index: usize) -> (Vec<usize>, Handover<Mode>) {
        let Island { born, groups, solver, .. } = self.all.remove(index);
        let (motion, handover) = solver.hand_over();
        if !motion.pieces.is_empty() || !motion.events.is_empty() {
            self.finished.push((born, Track { groups: groups.clone(), motion: motion.into() }));
        }
        (groups, handover)
    }

    /// Makes several islands of one that nothing holds together any more, if no event of several of them is near.
    fn part(&mut self, index: usize) {
        let island = &self.all[index];
        let rest = island.rest;
        if island.groups.len() < 2 || island.wait > 0 || island.solver.is_done() {
            return;
        }
        let Some(now) = island.solver.now() else { return };
        let parts = self.equations.coupled(now.mode, &island.groups);
        if parts.len() < 2 || !self.may_part(index, &parts) {
            return;
        }
        let (_, handover) = self.hand_over(index);
        let time = handover.start.time;
        for watch in &mut self.watches {
            if parts.iter().filter(|part| watch.is_of(part)).count() > 1 {
                watch.part(time);
            }
        }
        for groups in parts {
            let own = restricted(self.equations, &handover, &groups);
            let solver = Solver::resumed(self.equations, own, self.until, self.accuracy);
            self.add(groups, solver, rest, 1);
        }
    }

    /// Whether no event of several of these parts came near within the last step.
    fn may_part(&mut self, index: usize, parts: &[Vec<usize>]) -> bool {
        let Self { all, watches, equations, inputs, .. } = self;
        let solver = &all[index].solver;
        let Some(piece) = solver.trajectory().pieces.last() else { return false };
        let mode = &solver.trajectory().modes[piece.mode];
        let is_between = |watch: &&mut Watch| parts.iter().filter(|part| watch.is_of(part)).count() > 1;
        watches.iter_mut().filter(is_between).all(|watch| watch.is_far(equations, inputs, mode, piece))
    }

    /// When the last of them has come to rest for good, s: 0 of those that lie still. `None` where any may still move.
    fn rest(&self) -> Option<f64> {
        let t = time_symbol();
        let model = self.equations.model();
        if self.watches.iter().any(|watch| model.events[watch.event].when.symbols().contains(&t)) {
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

    /// All motions in the order in which they came to be, and which of them was refused.
    fn finish(self) -> (Vec<Track>, Option<usize>) {
        let Self { all, mut finished, refused, .. } = self;
        for Island { born, groups, solver, .. } in all {
            finished.push((born, Track { groups, motion: solver.finish().into() }));
        }
        finished.sort_by_key(|(born, _)| *born);
        let at_fault = refused.and_then(|(born, _)| finished.iter().position(|(own, _)| *own == born));
        (finished.into_iter().map(|(_, track)| track).collect(), at_fault)
    }
}

/// What several islands hand over to one.
fn joined(equations: &Equations, handovers: Vec<Handover<Mode>>) -> Handover<Mode> {
    let modes: Vec<&Mode> = handovers.iter().map(|handover| &handover.start.mode).collect();
    let (mode, layout) = equations.laid_out(&modes);
    let carried: Vec<&Carried> = handovers.iter().map(|handover| &handover.carried).collect();
    let carried = Carried::joined(&carried);
    let state = |of: fn(&tumble_ode::Start<Mode>) -> &Vec<f64>| {
        layout.iter().map(|[part, state]| of(&handovers[*part].start)[*state]).collect()
    };
    let (states, compensation) = (state(|start| &start.states), state(|start| &start.compensation));
    let mut start = handovers[0].start.clone();
    (start.mode, start.states, start.compensation) = (mode, states, compensation);
    Handover { start, carried }
}

/// What an island hands over to a part of it.
fn restricted(equations: &Equations, whole: &Handover<Mode>, groups: &[usize]) -> Handover<Mode> {
    let start = Places::of(equations, &whole.start).of_some(&equations.components().bodies_of(groups));
    let carried = match equations.is_settling(&start.mode, None) {
        true => whole.carried.clone(),
        false => whole.carried.clone().without_wakes(),
    };
    Handover { start, carried }
}
