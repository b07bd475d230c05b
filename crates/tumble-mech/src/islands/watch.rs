//! An event that several groups have a part in, or two bodies that may meet: where that is shown not to come, while they are motions of
//! their own.

use std::collections::HashMap;

use tumble_expr::{Branches, Interval, Jets};
use tumble_ode::{Of as Layout, Piece, Reason, Solver};

use super::Island;
use super::near::Near;
use crate::carried::is_crossing;
use crate::equations::Equations;
use crate::mode::Mode;

/// A stretch in which an event cannot be excluded is cut down to this part of what was asked for: two or three steps as one motion cost
/// about as much as that takes.
const FINEST: f64 = 1.0 / 64.0;
/// Islands that meet again and again stay one motion for so many steps at most before they are looked at.
const LONGEST_WAIT: u32 = 1024;
/// Bodies that meet each other take short steps then.
const LONGEST_WAIT_OF_BODIES: u32 = 16;

/// What is watched.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Of {
    Event(usize),
    /// Whether they touch; the lesser first.
    Bodies([usize; 2]),
}

/// An event that several groups have a part in, or bodies of several that may meet.
pub(super) struct Watch {
    pub(super) of: Of,
    groups: Vec<usize>,
    /// Those of them that it reads, in order.
    readers: Vec<usize>,
    /// Up to this time it is known not to come, as long as those it is of are several motions, s.
    known_until: f64,
    /// Whether it may come then.
    is_doubtful: bool,
    /// Whether what its islands do next has changed since it was looked at.
    pub(super) is_stale: bool,
    /// When they became several last, and the length of the step before, s.
    parted: f64,
    step: f64,
    /// How long they were one motion then, in steps.
    wait: u32,
    ranges: HashMap<Vec<Mode>, Ranges>,
}

/// What an island does next, or did last.
pub(super) struct Along {
    pub(super) mode: Mode,
    pub(super) piece: Piece,
}

/// What it takes to look at a watch.
pub(super) struct Sight<'a> {
    pub(super) equations: &'a Equations,
    pub(super) inputs: &'a [f64],
    pub(super) near: &'a Near<'a>,
}

/// Finds ranges of a function in modes beside each other.
struct Ranges {
    jets: Jets<Interval>,
    layout: Vec<Layout>,
}

impl Watch {
    /// The events that several groups of a component have a part in.
    pub(super) fn all(equations: &Equations, component: usize, start: f64) -> Vec<Self> {
        let components = equations.components();
        let of = |event: usize| {
            let groups = components.of_event(event).to_vec();
            let is_own = groups.len() > 1 && components.of_group(groups[0]) == component;
            is_own.then(|| {
                let readers = components.read_by([&equations.model().events[event].when]);
                Self::new(Of::Event(event), groups, readers, start)
            })
        };
        (0..equations.model().events.len()).filter_map(of).collect()
    }

    /// Two bodies that have not met up to a time, s.
    pub(super) fn of_bodies(equations: &Equations, bodies: [usize; 2], known_until: f64) -> Self {
        let mut groups = bodies.map(|body| equations.components().group_of(body)).to_vec();
        groups.sort_unstable();
        Self::new(Of::Bodies(bodies), groups.clone(), groups, known_until)
    }

    fn new(of: Of, groups: Vec<usize>, readers: Vec<usize>, known_until: f64) -> Self {
        Self {
            of,
            groups,
            readers,
            known_until,
            is_doubtful: false,
            is_stale: true,
            parted: f64::NEG_INFINITY,
            step: 0.0,
            wait: 1,
            ranges: HashMap::new(),
        }
    }

    /// The event, if it is one.
    pub(super) fn of_event(&self) -> Option<usize> {
        match self.of {
            Of::Event(event) => Some(event),
            Of::Bodies(_) => None,
        }
    }

    /// Whether it reads any of these groups.
    pub(super) fn reads(&self, groups: &[usize]) -> bool {
        self.readers.iter().any(|group| groups.contains(group))
    }

    /// Whether any of these groups has a part in it.
    pub(super) fn is_of(&self, groups: &[usize]) -> bool {
        self.groups.iter().any(|group| groups.contains(group))
    }

    /// Whether it need not be looked at for what may come up to a time, s.
    pub(super) fn is_settled(&self, to: f64) -> bool {
        self.is_doubtful || self.known_until >= to
    }

    /// From when on it may come, s, as far as it was looked at.
    pub(super) fn doubt(&self) -> Option<f64> {
        self.is_doubtful.then_some(self.known_until)
    }

    /// Looks whether it may come along what its islands do next, up to a time, s.
    pub(super) fn look(&mut self, sight: &Sight<'_>, along: &[Along], to: f64) {
        self.known_until = self.excluded_to(sight, along, [self.known_until, to]);
        self.is_doubtful = self.known_until < to;
    }

    /// Time up to which its function keeps its sign, from one time on and at most to another, s.
    fn excluded_to(&mut self, sight: &Sight<'_>, along: &[Along], [mut known, to]: [f64; 2]) -> f64 {
        let mut step = to - known;
        let shortest = FINEST * step;
        while known < to {
            let end = (known + step).min(to);
            if end <= known {
                break;
            }
            // What has no formula here is for the equations of all of them to tell.
            if self.is_excluded(sight, along, [known, end]).unwrap_or(false) {
                known = end;
            } else if step <= shortest {
                break;
            } else {
                step *= 0.5;
            }
        }
        known
    }

    /// It is a guard of the one motion that all it is of are.
    pub(super) fn clear(&mut self) {
        self.is_doubtful = false;
    }

    /// Nothing is known of it after a time, s, from which on those it is of may move in another way.
    pub(super) fn forget_after(&mut self, time: f64) {
        (self.known_until, self.is_doubtful) = (self.known_until.min(time), false);
    }

    /// Those it is of become several motions, s, after a step of so many.
    pub(super) fn part(&mut self, time: f64, step: f64) {
        (self.known_until, self.is_doubtful, self.parted, self.step) = (time, false, time, step);
    }

    /// Those it is of become one motion; steps to be taken before they may be several again.
    pub(super) fn met(&mut self, time: f64) -> u32 {
        let is_soon = time - self.parted < self.step;
        let longest = if self.of_event().is_some() { LONGEST_WAIT } else { LONGEST_WAIT_OF_BODIES };
        self.wait = if is_soon { (2 * self.wait).min(longest) } else { 1 };
        self.wait
    }

    /// Whether an event did not come near along the later half of the last piece of a motion of all that it is of.
    pub(super) fn is_far(&mut self, sight: &Sight<'_>, mode: &Mode, piece: &Piece) -> bool {
        let along = [Along { mode: mode.clone(), piece: piece.clone() }];
        let half = [0.5 * (piece.start + piece.end), piece.end];
        self.excluded_to(sight, &along, half) == piece.end
    }

    /// Whether its function keeps its sign between two times, s, or its bodies are apart.
    fn is_excluded(
        &mut self,
        Sight { equations, inputs, near }: &Sight<'_>,
        along: &[Along],
        between: [f64; 2],
    ) -> Result<bool, Reason> {
        let event = match self.of {
            Of::Event(event) => event,
            Of::Bodies(bodies) => return Ok(near.are_apart(bodies, along, between)),
        };
        let modes: Vec<Mode> = along.iter().map(|along| along.mode.clone()).collect();
        let ranges = match self.ranges.entry(modes) {
            std::collections::hash_map::Entry::Occupied(known) => known.into_mut(),
            std::collections::hash_map::Entry::Vacant(place) => {
                let ranges = Ranges::new(equations, place.key(), inputs, event)?;
                place.insert(ranges)
            }
        };
        Ok(ranges.of(along, between).definite_sign() != 0.0)
    }

    /// Whether the last jump of an island has carried its function across zero, others being in these modes and states.
    pub(super) fn is_crossed(
        &self,
        equations: &Equations,
        inputs: &[f64],
        solver: &Solver<'_, Equations>,
        others: &[(Mode, Vec<f64>)],
    ) -> bool {
        let (Some(jump), Some(event)) = (solver.trajectory().events.last(), self.of_event()) else {
            return false;
        };
        let event = &equations.model().events[event];
        let modes = &solver.trajectory().modes;
        let value = |mode: &Mode, states: &Vec<f64>| {
            let own = [(mode.clone(), states.clone())];
            let all: Vec<&(Mode, Vec<f64>)> = own.iter().chain(others).collect();
            let modes: Vec<&Mode> = all.iter().map(|(mode, _)| mode).collect();
            let (mode, layout) = equations.laid_out(&modes);
            let states: Vec<f64> = layout.iter().map(|[part, state]| all[*part].1[*state]).collect();
            equations.values(std::slice::from_ref(&event.when), &mode, jump.time, &states, inputs)
        };
        let before = value(&modes[jump.mode_before], &jump.before);
        let after = value(&modes[jump.mode_after], &jump.after);
        match (before, after) {
            (Ok(before), Ok(after)) => is_crossing(before[0], after[0], event.direction),
            // The equations of all of them tell why there is no value.
            _ => false,
        }
    }
}

impl Ranges {
    fn new(equations: &Equations, modes: &[Mode], inputs: &[f64], event: usize) -> Result<Self, Reason> {
        let modes: Vec<&Mode> = modes.iter().collect();
        let (mode, layout) = equations.laid_out(&modes);
        let formula = std::slice::from_ref(&equations.model().events[event].when);
        let inputs: Vec<Interval> = inputs.iter().map(|value| Interval::point(*value)).collect();
        let jets = Jets::new(equations.motion_tape(&mode, formula)?, 0, &inputs);
        Ok(Self { jets, layout })
    }

    /// A range that holds all values of the function between two times.
    fn of(&mut self, along: &[Along], between: [f64; 2]) -> Interval {
        let states = along.iter().map(|Along { piece, .. }| {
            let mut states = vec![];
            piece.ranges_between(between, &mut states);
            states
        });
        let states: Vec<Vec<Interval>> = states.collect();
        let all: Vec<Interval> = self.layout.iter().map(|[part, state]| states[*part][*state]).collect();
        self.jets.start(Interval::new(between[0], between[1]), &all, Branches::Free);
        self.jets.value_of(0)
    }
}

impl Island<'_> {
    /// What it does next; what it did last, where it goes on no more.
    pub(super) fn along(&self) -> Option<Along> {
        let known = self.solver.trajectory();
        let piece = self.solver.proposed().or_else(|| known.pieces.last().cloned())?;
        Some(Along { mode: known.modes[piece.mode].clone(), piece })
    }

    /// Its mode and states at a time within what it does next.
    pub(super) fn at(&self, time: f64) -> Option<(Mode, Vec<f64>)> {
        let now = self.solver.now()?;
        let states = match self.solver.proposed() {
            Some(piece) if time > now.time => piece.states_at(time),
            _ => now.states.to_vec(),
        };
        Some((now.mode.clone(), states))
    }
}
