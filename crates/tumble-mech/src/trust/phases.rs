//! Which stretches of a motion and its check run belong together.

use std::collections::{HashMap, VecDeque};

use tumble_ode::Side;

use crate::record::{Happening, Record};
use crate::run::Run;
use crate::trust::errors::BRIEF;
use crate::trust::own::Own;
use crate::trust::{Divergence, Horizon};

/// Two Zeno sequences end at one time if that differs by no more than this part of it: their last impacts need not
/// match. So do contacts with compliant surfaces that one of two runs has more of.
const SAME_LIMIT: f64 = 1e-6;

/// A stretch that ends with a compliant contact is the same in both runs where its lengths differ by no more than this part: else one of them may have left
/// the surface for a moment, and the other not.
const ALIKE: f64 = 0.1;
/// Beginnings and ends of compliant contacts that only one of two runs has are followed no further.
const MOST_PASSED: usize = 16;

type Event = tumble_ode::Occurrence<Record>;

/// Stretches of both runs between events that both have.
#[derive(Clone, Debug, Default)]
pub(super) struct Phases {
    /// Start and end of each, s, in the run and in the check run.
    pub(super) all: Vec<[Stretch; 2]>,
    /// Where the check run diverges, if it does.
    pub(super) divergence: Option<Horizon>,
    /// Times of the events that both have, s, in the run and in the check run; also of those that change nothing.
    pub(super) recorded: Vec<[f64; 2]>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stretch {
    pub(super) start: f64,
    pub(super) end: f64,
    /// Whether it is of the last impacts of a Zeno sequence, which the runs need not have in the same number: what is off within it
    /// passes with it.
    pub(super) ends_zeno_sequence: bool,
}

/// Walks along both runs, event by event, as far as they agree.
///
/// Events that only record change nothing: that one run has one more of them, at the edge of what it asks for, says
/// nothing of the motion.
pub(super) fn phases(first: &Run, second: &Run) -> Phases {
    let (runs, own) = ([first, second], &Own::of(first));
    let ends = runs.map(|run| run.trajectory().end().unwrap_or(0.0));
    let mut found = Phases { recorded: recorded(runs, own), ..Phases::default() };
    let changing = runs.map(|run| changing(run, own));
    let (mut from, mut at) = ([0.0; 2], [0; 2]);
    loop {
        let events = [0, 1].map(|run| changing[run].get(at[run]).copied());
        let matching = match events {
            [None, None] => break,
            [Some(a), Some(b)] if is_same(runs, own, [a, b]) => Some([a, b]),
            _ => None,
        };
        if !matching.is_some_and(|events| is_certain(first, from, events))
            && let Some(next) =
                after_compliant(runs, &changing, own, at).or_else(|| over(first, &changing, at))
        {
            at = next;
            continue;
        }
        let (next, is_zeno) = match matching {
            Some([a, _]) => (at.map(|index| index + 1), a.record.ends_zeno_sequence()),
            None => match after_zeno_sequences(&changing, own, at) {
                Some(next) => (next, true),
                None => {
                    let times = [0, 1].map(|run| events[run].map_or(ends[run], |event| event.time));
                    found.diverge(runs, [from, times], events);
                    return found;
                }
            },
        };
        let to = [0, 1].map(|run| changing[run][next[run] - 1].time);
        found.push(from, to, is_zeno);
        (from, at) = (to, next);
    }
    found.push(from, ends, false);
    // One of them stopped early, without an event.
    let last = ends[0].min(ends[1]);
    let is_stopped = first.all_tracks().is_stopped || first.trajectory().last_event().is_some();
    if ends[1] < ends[0] && !is_stopped {
        found.divergence = Some(Horizon { time: last, reason: Divergence::Refused });
    }
    found
}

impl Phases {
    /// The stretch that a time of the run lies in.
    pub(super) fn stretch(&self, time: f64, side: Side) -> Option<[Stretch; 2]> {
        let holds = |here: &Stretch| match side {
            Side::Before => time <= here.end,
            Side::After => time < here.end,
        };
        self.all.iter().find(|[here, _]| holds(here)).or(self.all.last()).copied()
    }

    /// The time of the check run that is as long after the last event as `time` is in the run.
    pub(super) fn counterpart(&self, time: f64, side: Side) -> Option<f64> {
        let [here, there] = self.stretch(time, side)?;
        Some((there.start + (time - here.start)).clamp(there.start, there.end))
    }

    /// By how much the time of an event is off between both runs, s; `None` if only one of them has it.
    pub(super) fn off(&self, time: f64) -> Option<f64> {
        let changing = self.all.iter().map(|[here, there]| [here.end, there.end]);
        let [here, there] = changing.chain(self.recorded.iter().copied()).find(|[here, _]| *here == time)?;
        Some((here - there).abs())
    }

    fn push(&mut self, from: [f64; 2], to: [f64; 2], ends_zeno_sequence: bool) {
        let stretch = |run: usize| Stretch { start: from[run], end: to[run], ends_zeno_sequence };
        self.all.push([0, 1].map(stretch));
        if ends_zeno_sequence {
            let lengths = self.all.iter().map(|[here, _]| here.end - here.start);
            let brief = BRIEF * lengths.fold(0.0, f64::max);
            let last = self.all.iter_mut().rev().take_while(|[here, _]| here.end - here.start <= brief);
            last.for_each(|[here, _]| here.ends_zeno_sequence = true);
        }
    }

    fn diverge(&mut self, runs: [&Run; 2], [from, to]: [[f64; 2]; 2], events: [Option<&Event>; 2]) {
        let time = to[0].min(to[1]);
        let names = |run: usize| {
            let event = events[run].filter(|event| event.time <= time);
            event.map(|event| runs[run].equations.names_of(&event.record)).unwrap_or_default()
        };
        self.push(from, [time.max(from[0]), time.max(from[1])], false);
        let reason = Divergence::Events { first: names(0), second: names(1) };
        self.divergence = Some(Horizon { time, reason });
    }
}

/// Events that change the motion of some bodies or end it.
fn changing<'a>(run: &'a Run, own: &Own) -> Vec<&'a Event> {
    let motion = run.trajectory();
    let end = motion.end();
    let changes = |event: &&Event| own.changes(motion, event) || end == Some(event.time);
    motion.events.iter().filter(|event| own.has(motion, event) && changes(event)).collect()
}

/// Times of the events that both runs have, also where they fall together in one of them only: the first of a kind in both, the second, and so on.
fn recorded([first, second]: [&Run; 2], own: &Own) -> Vec<[f64; 2]> {
    let mut later: HashMap<Happening, VecDeque<f64>> = HashMap::new();
    for event in own.events(second.trajectory()) {
        for happening in own.happened(&event.record) {
            later.entry(happening).or_default().push_back(event.time);
        }
    }
    let off = |event: &Event| {
        let there = own.happened(&event.record).into_iter();
        let there = there.map(|happening| later.get_mut(&happening).and_then(VecDeque::pop_front));
        // Each counts, also where another is not found.
        let there: Vec<Option<f64>> = there.collect();
        let there: Option<Vec<f64>> = there.into_iter().collect();
        let furthest = |a: f64, b: f64| if (a - event.time).abs() < (b - event.time).abs() { b } else { a };
        Some([event.time, there?.into_iter().reduce(furthest)?])
    };
    own.events(first.trajectory()).filter_map(off).collect()
}

/// Whether the same things happen, between the same modes.
fn is_same(runs: [&Run; 2], own: &Own, [a, b]: [&Event; 2]) -> bool {
    let mode = |run: usize, index: usize| own.mode(&runs[run].trajectory().modes[index]);
    own.happened(&a.record) == own.happened(&b.record)
        && mode(0, a.mode_before) == mode(1, b.mode_before)
        && mode(0, a.mode_after) == mode(1, b.mode_after)
}

/// The events after the next ends of Zeno sequences, where these are the same in both.
fn after_zeno_sequences(runs: &[Vec<&Event>; 2], own: &Own, at: [usize; 2]) -> Option<[usize; 2]> {
    let next = |run: usize| {
        let rest = runs[run].iter().enumerate().skip(at[run]);
        rest.filter(|(_, event)| event.record.ends_zeno_sequence()).map(|(index, _)| index).next()
    };
    let [a, b] = [next(0)?, next(1)?];
    let events = [runs[0][a], runs[1][b]];
    let [a_happened, b_happened] = events.map(|event| own.happened(&event.record));
    (a_happened == b_happened && is_at_once(events)).then_some([a + 1, b + 1])
}

/// Whether events of the same kind that follow others in both runs are one in both: what compliant contacts do may be of another time.
fn is_certain(run: &Run, from: [f64; 2], [a, b]: [&Event; 2]) -> bool {
    let lasts = [a.time - from[0], b.time - from[1]];
    let are_alike = (lasts[0] - lasts[1]).abs() <= ALIKE * lasts[0].max(lasts[1]);
    are_alike || is_at_once([a, b]) || !is_of_compliant(run, a)
}

/// The next events that both have at once, where only compliant contacts begin and end before: a surface that is left for a moment, or just
/// not, pushes as much in both. Of what they differ by there, the difference of the states tells.
fn after_compliant(
    runs: [&Run; 2],
    changing: &[Vec<&Event>; 2],
    own: &Own,
    at: [usize; 2],
) -> Option<[usize; 2]> {
    let passed = [0, 1].map(|run| compliant(runs[0], &changing[run][at[run]..]).min(MOST_PASSED));
    let ways = (1..=passed[0] + passed[1])
        .flat_map(|sum| (0..=sum.min(passed[0])).map(move |first| [at[0] + first, at[1] + sum - first]));
    let mut ways = ways.filter(|[_, second]| *second <= at[1] + passed[1]);
    ways.find(|next| match [0, 1].map(|run| changing[run].get(next[run]).copied()) {
        [Some(a), Some(b)] => is_at_once([a, b]) && is_same(runs, own, [a, b]),
        _ => false,
    })
}

/// The ends of both, where only compliant contacts begin and end before.
fn over(run: &Run, changing: &[Vec<&Event>; 2], at: [usize; 2]) -> Option<[usize; 2]> {
    let ends = [0, 1].map(|run| changing[run].len());
    let is_over = |of: usize| at[of] + compliant(run, &changing[of][at[of]..]) == ends[of];
    (is_over(0) && is_over(1)).then_some(ends)
}

/// How many of some events are of compliant contacts before the first that is not.
fn compliant(run: &Run, events: &[&Event]) -> usize {
    events.iter().take_while(|event| is_of_compliant(run, event)).count()
}

/// Whether all that happens is of compliant contacts.
fn is_of_compliant(run: &Run, event: &Event) -> bool {
    let is_own = |happening: &Happening| match happening {
        Happening::Contact { pair, .. } => !run.equations.pairs()[*pair].is_rigid(),
        _ => false,
    };
    event.record.impulses.is_empty() && event.record.happened.iter().all(is_own)
}

fn is_at_once([a, b]: [&Event; 2]) -> bool {
    (a.time - b.time).abs() <= SAME_LIMIT * a.time
}

#[cfg(test)]
mod tests {
    use tumble_expr::units::{KG, M, S};
    use tumble_ode::Direction;

    use super::*;
    use crate::{Action, Body, ContactLaw, Gravity, Model, Start, Surface};

    /// A ball that bounces, with an event at each of its tops.
    fn run() -> Run {
        let mut model = Model::new();
        model.gravity = Gravity::Vertical(10 * M / (S * S));
        let ball = model.add(Body::point("ball").mass(1 * KG));
        model
            .starts
            .push(("ball".into(), Start::default().at([0 * M, 1 * M]).velocity([0 * M / S, 1 * M / S])));
        let law = ContactLaw::Rigid { restitution: 0.9.into() };
        model.surface(Surface::floor("floor", 0 * M, law));
        model.events.push(crate::Event {
            name: "top".into(),
            when: ball.kinematics().velocity().y().clone(),
            direction: Direction::Falling,
            action: Action::Record,
        });
        model.simulate(&[], 2 * S).expect("a motion")
    }

    #[test]
    fn runs_diverge_by_what_changes_them_only() {
        let first = run();
        let bounces = changing(&first, &Own::of(&first)).len();
        assert!(bounces > 1 && bounces < first.trajectory().events.len());

        let without = |left_out: &dyn Fn(&Event) -> bool| {
            let mut motion = first.trajectory().clone();
            let last = motion.events.iter().rposition(left_out).expect("there are such events");
            motion.events.remove(last);
            Run::of(first.equations.clone(), motion, first.inputs.clone())
        };
        let other = without(&|event| event.record.happened == [Happening::Event(0)]);
        let found = phases(&first, &other);
        assert!(found.divergence.is_none());
        assert_eq!(found.all.len(), bounces + 1);
        // The time of the last one is known in one run only.
        assert_eq!(found.recorded.len(), first.trajectory().events.len() - 1);

        let other = without(&|event| event.before != event.after);
        assert!(phases(&first, &other).divergence.is_some());
    }
}
