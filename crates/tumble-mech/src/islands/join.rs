//! Where several islands become one, and one becomes several.

use tumble_ode::{Carried, Cause, Handover, Solver};

use super::start::Places;
use super::watch::Sight;
use super::{Island, Islands, Meeting};
use crate::equations::Equations;
use crate::mode::Mode;
use crate::sets::Sets;
use crate::tracks::Track;

impl Islands<'_> {
    /// Makes one island of those that have a part in events. What happens to any of them at that very instant happens first: it may make
    /// more events happen, or take back what has made these.
    pub(super) fn merge(&mut self, Meeting { watches, time, is_now }: &Meeting) {
        let of = self.of_watches(watches);
        let mut carried = vec![];
        for &index in &of {
            self.all[index].solver.cut_short(*time);
            if self.all[index].solver.has_proposal() {
                let refusal = self.all[index].solver.take().err();
                self.look_ahead(index, refusal);
                carried.extend(self.see_jump(index));
            }
        }
        if of.iter().any(|index| self.all[*index].is_refused) {
            return;
        }
        if !carried.is_empty() {
            let once = |watch: &usize| watches.contains(watch) != carried.contains(watch);
            let watches = (0..self.watches.len()).filter(once).collect();
            return self.merge(&Meeting { watches, time: *time, is_now: true });
        }
        if of.len() < 2 {
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
        if *is_now {
            let events = self.equations.events(&handover.start.mode);
            let is_of =
                |event: &usize| watches.iter().any(|watch| self.watches[*watch].of_event() == Some(*event));
            let guards = events.iter().enumerate().filter(|(_, event)| is_of(event));
            handover.start.causes.extend(guards.map(|(guard, _)| Cause::Guard(guard)));
        }
        let waits: Vec<u32> = watches.iter().map(|watch| self.watches[*watch].met(*time)).collect();
        for watch in self.watches.iter_mut().filter(|watch| watch.is_of(&groups)) {
            watch.forget_after(*time);
        }
        let solver = Solver::resumed(self.equations, handover, self.until, self.accuracy);
        self.add(groups, solver, rest, waits.into_iter().max().unwrap_or(1));
    }

    /// Ends an island where it is; its groups, and what it hands over.
    fn hand_over(&mut self, index: usize) -> (Vec<usize>, Handover<Mode>) {
        let Island { born, groups, solver, .. } = self.all.remove(index);
        let (motion, handover) = solver.hand_over();
        self.finished.push((born, Track { groups: groups.clone(), motion: motion.into() }));
        (groups, handover)
    }

    /// Makes several islands of one that nothing holds together any more, if no event of several of them is near.
    pub(super) fn part(&mut self, index: usize) {
        let island = &self.all[index];
        let rest = island.rest;
        if island.groups.len() < 2 || island.wait > 0 || island.solver.is_done() {
            return;
        }
        let Some(now) = island.solver.now() else { return };
        let parts = self.equations.coupled(now.mode, &island.groups);
        let parts = self.far_parts(index, parts);
        if parts.len() < 2 {
            return;
        }
        let step = self.all[index].solver.trajectory().pieces.last();
        let step = step.map_or(0.0, |piece| piece.end - piece.start);
        let (_, handover) = self.hand_over(index);
        let time = handover.start.time;
        for watch in &mut self.watches {
            if parts.iter().filter(|part| watch.is_of(part)).count() > 1 {
                watch.part(time, step);
            }
        }
        for groups in parts {
            let own = restricted(self.equations, &handover, &groups);
            let solver = Solver::resumed(self.equations, own, self.until, self.accuracy);
            self.add(groups, solver, rest, 1);
        }
    }

    /// Parts of an island, those together that came near each other within the later half of the last step, or that an event has to
    /// do with which did.
    fn far_parts(&mut self, index: usize, parts: Vec<Vec<usize>>) -> Vec<Vec<usize>> {
        let Self { all, watches, equations, inputs, near, .. } = self;
        let solver = &all[index].solver;
        let Some(piece) = solver.trajectory().pieces.last() else { return vec![] };
        if parts.len() < 2 || piece.time_series.is_some() {
            return vec![];
        }
        let mode = &solver.trajectory().modes[piece.mode];
        let sight = Sight { equations, inputs, near };
        let mut sets = Sets::new(parts.len());
        // Bodies that may meet are all looked at together.
        for watch in watches.iter_mut().filter(|watch| watch.of_event().is_some()) {
            let of: Vec<usize> = (0..parts.len()).filter(|part| watch.is_of(&parts[*part])).collect();
            if of.len() > 1 && !watch.is_far(&sight, mode, piece) {
                of.windows(2).for_each(|two| sets.join(two[0], two[1]));
            }
        }
        let half = [0.5 * (piece.start + piece.end), piece.end];
        near.join(&near.along(mode, piece, half), &parts, &mut sets);
        joined_parts(parts, sets)
    }

    /// Groups in parts, those together whose bodies are near each other at the start.
    pub(super) fn together(
        &self,
        start: &tumble_ode::InitialState<Mode>,
        parts: Vec<Vec<usize>>,
    ) -> Vec<Vec<usize>> {
        let mut sets = Sets::new(parts.len());
        let circles = self.near.at(&start.mode, &start.states);
        self.near.join(&circles, &parts, &mut sets);
        joined_parts(parts, sets)
    }
}

/// Parts that are sets of others.
fn joined_parts(parts: Vec<Vec<usize>>, sets: Sets) -> Vec<Vec<usize>> {
    let (sets, _) = sets.in_order();
    let together = sets.into_iter().map(|of| {
        let mut groups: Vec<usize> = of.into_iter().flat_map(|part| parts[part].clone()).collect();
        groups.sort_unstable();
        groups
    });
    together.collect()
}

/// What several islands hand over to one.
fn joined(equations: &Equations, handovers: Vec<Handover<Mode>>) -> Handover<Mode> {
    let modes: Vec<&Mode> = handovers.iter().map(|handover| &handover.start.mode).collect();
    let (mode, layout) = equations.laid_out(&modes);
    let carried: Vec<&Carried> = handovers.iter().map(|handover| &handover.carried).collect();
    let carried = Carried::joined(&carried);
    let state = |of: fn(&tumble_ode::InitialState<Mode>) -> &Vec<f64>| {
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
